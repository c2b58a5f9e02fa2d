// Readers of formats in JSON: OpenMVG, OpenSfM and Meshroom.
#include "tests/engine/io/sfm_formats_test.h"

namespace quorum {
namespace {

TEST_F(SfmFormats, OpenMvgShowsItsOwnPoints) {
  // The center of the top-left pixel is (0, 0): half a pixel from its corner.
  const Vector2d center(33.5, 23.0);
  write_text(path("sfm_data.json"), openmvg_file("pinhole", ""));
  expect_reprojection(SceneFormat::kOpenMvg, brown(70, center, {}, 0, 0));
  write_text(path("sfm_data.json"), openmvg_file("pinhole_radial_k1", ", \"disto_k1\": [0.1]"));
  expect_reprojection(SceneFormat::kOpenMvg, brown(70, center, {0.1}, 0, 0));
  write_text(path("sfm_data.json"), openmvg_file("pinhole_radial_k3", ", \"disto_k3\": [-0.1, 0.02, 0.01]"));
  expect_reprojection(SceneFormat::kOpenMvg, brown(70, center, {-0.1, 0.02, 0.01}, 0, 0));
  write_text(path("sfm_data.json"),
             openmvg_file("pinhole_brown_t2", ", \"disto_t2\": [-0.1, 0.02, 0.01, 0.002, -0.003]"));
  expect_reprojection(SceneFormat::kOpenMvg, brown(70, center, {-0.1, 0.02, 0.01}, 0.002, -0.003));
  write_text(path("sfm_data.json"), openmvg_file("fisheye", ", \"fisheye\": [0.02, -0.01, 0.004, -0.001]"));
  expect_reprojection(SceneFormat::kOpenMvg, fisheye(70, center, {0.02, -0.01, 0.004, -0.001}));
}

TEST_F(SfmFormats, OpenMvgFilesThatSayOtherThingsAreRefused) {
  write_text(path("sfm_data.json"), openmvg_file("spherical", ""));
  expect_bad_input(read_scene(folder_.path(), {}), {"sfm_data.json", "intrinsic \"0\"", "\"spherical\"", "undistort"});
  write_text(path("sfm_data.json"), openmvg_file("pinhole", ""));
  change("sfm_data.json", "\"focal_length\": 70.0", "\"focal_length\": \"x\"");
  expect_bad_input(read_scene(folder_.path(), {}), {"its focal_length is not there, or is not a number"});
  write_text(path("sfm_data.json"), openmvg_file("pinhole", ""));
  change("sfm_data.json", "\"key\": 23", "\"key\": 99");
  const Scene partial = read_scene(folder_.path(), {}).value();
  EXPECT_EQ(partial.views.size(), 3U);
  EXPECT_EQ(partial.notes.at(0), "1 of 4 photographs have no camera and are left out");
  change("sfm_data.json", "extrinsics", "nothing");
  expect_bad_input(read_scene(folder_.path(), {}), {"no view has a pose", "ConvertSfM_DataFormat"});
  write_text(path("sfm_data.json"), "{\"views\": ");
  expect_bad_input(read_scene(folder_.path(), {}), {"is no JSON object"});
}

TEST_F(SfmFormats, OpenSfmShowsItsOwnPoints) {
  // Lengths count in the longer side, 64, from the middle.
  const Vector2d middle(32, 24);
  write_opensfm(R"("projection_type": "perspective", "focal": 1.1, "k1": -0.1, "k2": 0.02)");
  expect_reprojection(SceneFormat::kOpenSfm, brown(70.4, middle, {-0.1, 0.02}, 0, 0));
  const Vector2d center(32 + 0.64, 24 - 0.32);
  write_opensfm(
      R"("projection_type": "brown", "focal_x": 1.1, "focal_y": 1.1, "c_x": 0.01, "c_y": -0.005, "k1": -0.1, "k2": 0.02, "p1": 0.002, "p2": -0.003, "k3": 0.01)");
  expect_reprojection(SceneFormat::kOpenSfm, brown(70.4, center, {-0.1, 0.02, 0.01}, 0.002, -0.003));
  write_opensfm(R"("projection_type": "fisheye", "focal": 1.1, "k1": 0.02, "k2": -0.01)");
  expect_reprojection(SceneFormat::kOpenSfm, fisheye(70.4, middle, {0.02, -0.01}));
  write_opensfm(
      R"("projection_type": "fisheye_opencv", "focal_x": 1.1, "focal_y": 1.1, "c_x": 0.01, "c_y": -0.005, "k1": 0.02, "k2": -0.01, "k3": 0.004, "k4": -0.001)");
  expect_reprojection(SceneFormat::kOpenSfm, fisheye(70.4, center, {0.02, -0.01, 0.004, -0.001}));
  EXPECT_EQ(read_scene(folder_.path(), {})->notes.at(0), "of 2 reconstructions the largest is taken, with 4 images");
  // Without tracks, whoever has a point before it counts.
  fs::remove(path("opensfm/tracks.csv"));
  EXPECT_EQ(read_scene(folder_.path(), {})->points.at(0).views, (std::vector<int>{0, 1, 2, 3}));
}

TEST_F(SfmFormats, OpenSfmFilesThatSayOtherThingsAreRefused) {
  write_opensfm(R"("projection_type": "spherical")");
  expect_bad_input(read_scene(folder_.path(), {}), {"camera \"v2 x\"", "\"spherical\"", "opensfm undistort"});
  write_opensfm(R"("focal": 1.1)");
  change("opensfm/reconstruction.json", "\"camera\": \"v2 x\"", "\"camera\": \"v3\"");
  expect_bad_input(read_scene(folder_.path(), {}), {"shot \"a.png\"", "its camera is not there"});
  write_opensfm(R"("focal": 1.1)");
  write_text(path("opensfm/tracks.csv"), "a.png 100 7\n");
  expect_bad_input(read_scene(folder_.path(), {}), {"tracks.csv:1", "tabs"});
  write_text(path("opensfm/reconstruction.json"), "{}");
  expect_bad_input(read_scene(folder_.path(), {}), {"no JSON list"});
}

TEST_F(SfmFormats, MeshroomShowsItsOwnPointsInEveryVersion) {
  const Vector2d center(33.5, 23.0);  // (33, 22.5) with pixels that have their centers at whole numbers
  write_meshroom(
      R"("1", "0", "0")",
      R"("type": "radial3", "pxFocalLength": "70", "principalPoint": ["33", "22.5"], "distortionParams": ["-0.1", "0.02", "0.01"])");
  expect_reprojection(SceneFormat::kMeshroom, brown(70, center, {-0.1, 0.02, 0.01}, 0, 0));
  write_meshroom(
      R"("1", "2", "1")",
      R"("type": "brown", "pxFocalLength": ["70", "70"], "principalPoint": ["1", "-1.5"], "distortionParams": ["-0.1", "0.02", "0.01", "0.002", "-0.003"])");
  expect_reprojection(SceneFormat::kMeshroom, brown(70, center, {-0.1, 0.02, 0.01}, 0.002, -0.003));
  const std::string in_mm =
      R"("focalLength": "39.375", "sensorWidth": "36", "pixelRatio": "1", "principalPoint": ["1", "-1.5"], )";
  write_meshroom(R"("1", "2", "5")",
                 in_mm + R"("type": "fisheye4", "distortionParams": ["0.02", "-0.01", "0.004", "-0.001"])");
  expect_reprojection(SceneFormat::kMeshroom, fisheye(70, center, {0.02, -0.01, 0.004, -0.001}));
  write_meshroom(
      R"("1", "2", "8")",
      in_mm +
          R"("type": "pinhole", "distortionType": "radialk1", "distortionParams": ["0.1"], "undistortionParams": "")");
  expect_reprojection(SceneFormat::kMeshroom, brown(70, center, {0.1}, 0, 0));
  write_meshroom(R"("1", "2", "5")", in_mm + R"("type": "fisheye1", "distortionParams": ["0.9"])");
  expect_reprojection(SceneFormat::kMeshroom, [&](double x, double y) {
    const double r = std::hypot(x, y);
    return Vector2d(center + 70 * std::atan(2 * r * std::tan(0.45)) / 0.9 / r * Vector2d(x, y));
  });
  const Scene scene = read_scene(folder_.path(), {}).value();
  EXPECT_EQ(scene.notes.at(0), "1 of 5 photographs have no camera and are left out");
  EXPECT_EQ(scene.views[0].image_name, "a.png") << "without the folders of another machine";
}

TEST_F(SfmFormats, MeshroomFilesThatSayOtherThingsAreRefused) {
  const std::string good = R"("pxFocalLength": "70", "principalPoint": ["33", "22.5"], )";
  write_meshroom(R"("1", "0", "0")", good + R"("type": "3deanamorphic4", "distortionParams": ["1"])");
  expect_bad_input(read_scene(folder_.path(), {}), {"intrinsicId \"5\"", "\"3deanamorphic4\"", "ExportImages"});
  write_meshroom(R"("1", "0", "0")", good + R"("type": "radial3", "distortionParams": ["1"])");
  expect_bad_input(read_scene(folder_.path(), {}), {"distortionParams", "3 numbers"});
  write_meshroom(R"("1", "0", "0")", good + R"("type": "pinhole")");
  change("cameras.sfm", "\"poseId\": \"21\"", "\"rigId\": \"7\", \"poseId\": \"21\"");
  expect_bad_input(read_scene(folder_.path(), {}), {"view \"11\"", "rigs are not read"});
  write_meshroom(R"("2", "0", "0")", good + R"("type": "pinhole")");
  expect_bad_input(read_scene(folder_.path(), {}), {"newer version"});
}

}  // namespace
}  // namespace quorum
