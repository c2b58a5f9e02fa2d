// Readers of the other formats, Metashape, RealityCapture and VisualSFM, and what all have in common.
#include "tests/engine/io/sfm_formats_test.h"

namespace quorum {
namespace {

TEST_F(SfmFormats, MetashapeShowsPointsWhereItsManualSays) {
  // cx and cy count from the middle; p1 and p2 are the other way around than OpenCV's.
  write_metashape("frame",
                  "<f>70</f><cx>1.5</cx><cy>-1</cy><k1>-0.1</k1><k2>0.02</k2><k3>0.01</k3><k4>0.004</k4><p1>0.002</p1>"
                  "<p2>-0.003</p2>");
  expect_reprojection(SceneFormat::kMetashape, brown(70, {33.5, 23}, {-0.1, 0.02, 0.01, 0.004}, -0.003, 0.002), false);
  write_metashape("fisheye", "<f>70</f><cx>1.5</cx><cy>-1</cy><k1>0.02</k1><k2>-0.01</k2><k3>0.004</k3>");
  expect_reprojection(SceneFormat::kMetashape, fisheye(70, {33.5, 23}, {0.02, -0.01, 0.004}), false);
  write_metashape("frame", "<f>70</f><b1>2</b1>");
  expect_reprojection(
      SceneFormat::kMetashape, [](double x, double y) { return Vector2d(32 + 72 * x, 24 + 70 * y); }, false);
  const Scene scene = read_scene(folder_.path(), {}).value();
  EXPECT_EQ(scene.notes.at(0), "of 2 chunks \"Chunk 1\" is taken, with the most aligned cameras, 4");
  EXPECT_EQ(scene.notes.at(1), "1 of 5 photographs have no camera and are left out");
}

TEST_F(SfmFormats, MetashapeFilesThatSayOtherThingsAreRefused) {
  write_metashape("frame", "<f>70</f><b2>0.1</b2>");
  expect_bad_input(read_scene(folder_.path(), {}), {"sensor \"3\"", "its b2 is not 0", "optimize"});
  write_metashape("spherical", "<f>70</f>");
  expect_bad_input(read_scene(folder_.path(), {}), {"sensor \"3\"", "\"spherical\""});
  write_metashape("frame", "<f>x</f>");
  expect_bad_input(read_scene(folder_.path(), {}), {"its f is no number"});
  write_metashape("frame", "<f>70</f>");
  change("cameras.xml", "class=\"adjusted\"", "class=\"initial\"");
  expect_bad_input(read_scene(folder_.path(), {}), {"no adjusted calibration"});
  write_metashape("frame", "<f>70</f>");
  change("cameras.xml", "</chunk>", "");
  expect_bad_input(read_scene(folder_.path(), {}), {"cameras.xml: is no XML", "at byte"});
}

TEST_F(SfmFormats, RealityCaptureLooksDownWithoutTurn) {
  // Its angles from the rotations: R = Rz(-heading) Rx(pitch) Ry(roll) from a camera with x right, y up and z back.
  std::string text = "#name,x,y,alt,heading,pitch,roll,f,px,py,k1,k2,k3,k4,t1,t2\n";
  for (int i = 0; i < kViews; ++i) {
    Eigen::Matrix3d r = rotations_[static_cast<std::size_t>(i)].transpose();
    r.rightCols<2>() *= -1;
    const double degrees = 180 / std::numbers::pi;
    text += fmt::format("\"{}\",{},{:.17g},{:.17g},{:.17g},39.375,0.5625,-0.28125,-0.1,0.02,0.01,0.004,0,0\n", name(i),
                        list(centers_[static_cast<std::size_t>(i)], ","), -std::atan2(-r(0, 1), r(1, 1)) * degrees,
                        std::asin(r(2, 1)) * degrees, std::atan2(-r(2, 0), r(2, 2)) * degrees);
  }
  write_text(path("cameras.csv"), text);
  // Millimeters where the longer side, 64 pixels, is 36.
  expect_reprojection(SceneFormat::kRealityCapture, brown(70, {33, 23.5}, {-0.1, 0.02, 0.01, 0.004}, 0, 0), false);
  EXPECT_NE(read_scene(folder_.path(), {})->notes.at(0).find("Brown"), std::string::npos);

  const std::string plain = "#name,x,y,alt,heading,pitch,roll,f\n";
  std::string places;
  for (int i = 0; i < kViews; ++i) places += fmt::format("{},{},0,10,0,0,0,36\n", name(i), i);
  write_text(path("cameras.csv"), plain + places);
  const View view = read_realitycapture(path("cameras.csv"), {}).value().views[0];
  EXPECT_LT((view.camera.optical_axis() - Vector3d(0, 0, -1)).norm(), 1e-12);
  EXPECT_LT((view.camera.camera_from_world.row(1).transpose() - Vector3d(0, -1, 0)).norm(), 1e-12) << "south is down";
}

TEST_F(SfmFormats, RealityCaptureFilesThatSayOtherThingsAreRefused) {
  write_text(path("cameras.csv"), "#name,x,y,alt,heading,pitch,roll,f,t1\na.png,0,0,0,0,0,0,36,0.1\n");
  expect_bad_input(read_scene(folder_.path(), {}), {"cameras.csv:2", "t1 is not 0"});
  write_text(path("cameras.csv"), "#name,x,y,alt\na.png,0,0,0\n");
  expect_bad_input(read_scene(folder_.path(), {}), {"cameras.csv:2", "column heading is missing"});
  write_text(path("cameras.csv"), "#name,x,y,alt,heading,pitch,roll,f\na.png,0,0,0,0,0,0\n");
  expect_bad_input(read_scene(folder_.path(), {}), {"cameras.csv:2", "expected 8 columns, found 7"});
  write_text(path("cameras.csv"), "#name,x,y,alt,heading,pitch,roll,f\na.png,0,0,0,0,zero,0,36\n");
  expect_bad_input(read_scene(folder_.path(), {}), {"cameras.csv:2", "pitch = \"zero\""});
}

TEST_F(SfmFormats, VisualSfmShowsItsOwnPoints) {
  for (const double k : {0.0, -0.1, 0.15}) {
    write_text(path("model.nvm"), "NVM_V3\n\n" + nvm_file(k) + "\n0\n");
    // A measurement m, in focal lengths, times 1 + k m^2 is the ray.
    expect_reprojection(SceneFormat::kVisualSfm, [k](double x, double y) {
      const double r = std::hypot(x, y);
      double m = r;
      for (int i = 0; i < 200; ++i) m = r / (1 + k * m * m);
      return Vector2d(32 + 70 * m / r * x, 24 + 70 * m / r * y);
    });
  }
  write_text(path("model.nvm"), "NVM_V3 FixedK 70 33 72 23\n\n" + nvm_file(0) + "\n0\n");
  expect_reprojection(SceneFormat::kVisualSfm, [](double x, double y) { return Vector2d(33 + 70 * x, 23 + 72 * y); });
}

TEST_F(SfmFormats, VisualSfmsLargestModelIsTaken) {
  const std::string small = "1\na.png\t70 1 0 0 0 0 0 0 0 0\n\n0\n\n";
  write_text(path("model.nvm"), "NVM_V3\n\n" + small + nvm_file(0) + "\n0\n\n#the last part\n0\n");
  const auto scene = read_scene(folder_.path(), {});
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->views.size(), 4U);
  EXPECT_EQ(scene->notes.at(0), "of 2 models the largest is taken, with 4 images");
}

TEST_F(SfmFormats, VisualSfmFilesThatAreMalformedAreRefused) {
  write_text(path("model.nvm"), "NVM_V3_R9T\n");
  expect_bad_input(read_scene(folder_.path(), {}), {"model.nvm:1", "NVM_V3"});
  write_text(path("model.nvm"), "NVM_V3\n\n1\na.png 70 1 0 0 0 0 0 0 0\n");
  expect_bad_input(read_scene(folder_.path(), {}), {"model.nvm:4", "10 numbers"});
  write_text(path("model.nvm"), "NVM_V3\n\n1\na.png 70 1 0 0 0 0 0 0 0 0\n1\n0 0 0 1 2 3 1 5 0 0 0\n");
  expect_bad_input(read_scene(folder_.path(), {}), {"model.nvm:6", "camera \"5\" of 1"});
  write_text(path("model.nvm"), "NVM_V3\n\n" + nvm_file(0).substr(0, 900));
  expect_bad_input(read_scene(folder_.path(), {}), {"model.nvm:"});
}

/// As tests/engine/io/damaged_files_test.cc does; QUORUM_FUZZ_SECONDS: how long to go on, per file.
TEST_F(SfmFormats, DamagedFilesAreReadOrRefusedOnOneLine) {
  write_opensfm(R"("projection_type": "brown", "focal_x": 1.1, "focal_y": 1.1, "k1": -0.1, "p1": 0.002)");
  write_meshroom(
      R"("1", "2", "5")",
      R"("focalLength": "39", "principalPoint": ["1", "-1.5"], "type": "radial3", "distortionParams": ["-0.1", "0.02", "0.01"])");
  write_metashape("frame", "<f>70</f><cx>1.5</cx><k1>-0.1</k1>");
  std::string csv = "#name,x,y,alt,heading,pitch,roll,f,k1\n";
  for (int i = 0; i < kViews; ++i) csv += fmt::format("{},{},0,10,5,0,0,36,-0.1\n", name(i), i);
  const std::map<std::string, std::string> texts = {
      {"sfm_data.json", openmvg_file("pinhole_radial_k3", ", \"disto_k3\": [-0.1, 0.02, 0.01]")},
      {"opensfm/reconstruction.json", read_file(path("opensfm/reconstruction.json")).value()},
      {"opensfm/tracks.csv", read_file(path("opensfm/tracks.csv")).value()},
      {"cameras.sfm", read_file(path("cameras.sfm")).value()},
      {"cameras.xml", read_file(path("cameras.xml")).value()},
      {"cameras.csv", csv},
      {"model.nvm", "NVM_V3\n\n" + nvm_file(-0.1) + "\n0\n"}};
  const char* wanted = std::getenv("QUORUM_FUZZ_SECONDS");
  const double seconds = wanted != nullptr ? std::atof(wanted) : 0.0;
  for (const auto& [file, good] : texts) {
    const bool is_tracks = file == "opensfm/tracks.csv";
    const auto read = [&]() -> Expected<Scene> {
      if (is_tracks) return read_opensfm(path("opensfm/reconstruction.json"), {});
      for (const SfmFormat& format : sfm_formats())
        for (const fs::path& found : format.find(folder_.path()))
          if (found == path(file)) return format.read(found, {});
      return failure(ErrorKind::kInput, "is not recognized");
    };
    if (is_tracks) write_text(path("opensfm/reconstruction.json"), texts.at("opensfm/reconstruction.json"));
    write_text(path(file), good);
    ASSERT_TRUE(read()) << file << ": " << read().error().message;
    const auto start = std::chrono::steady_clock::now();
    const auto elapsed = [&] {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    std::uint32_t seed = 0;
    std::uint32_t refused = 0;
    for (; (seed < 200 || elapsed() < seconds) && !HasFailure(); ++seed) {
      fs::remove(path(file));
      write_text(path(file), mutate(good, seed));
      const auto scene = read();
      if (!scene) {
        ++refused;
        EXPECT_EQ(scene.error().message.find('\n'), std::string::npos) << file << ", seed " << seed;
        EXPECT_EQ(scene.error().kind, ErrorKind::kInput) << file << ", seed " << seed;
        continue;
      }
      for (const View& view : scene->views) EXPECT_EQ(camera_defect(view.camera), nullptr);
      for (const SparsePoint& point : scene->points)
        for (const int view : point.views) EXPECT_LT(static_cast<std::size_t>(view), scene->views.size());
    }
    if (seconds > 0) fmt::print("{}: {} of {} refused\n", file, refused, seed);
    EXPECT_GT(refused, 0U) << file;
    fs::remove(path(file));
  }
}

TEST_F(SfmFormats, WhatCanNotBeReadIsMetWithTheWayToConvertIt) {
  for (const auto& [file, remedy] : {std::pair{"sfm_data.bin", "openMVG_main_ConvertSfM_DataFormat"},
                                     {"sfm.abc", "aliceVision_convertSfMFormat"},
                                     {"project.psx", "Export Cameras"},
                                     {"project.rcproj", "Internal/External camera parameters"}}) {
    write_text(path(file), "");
    expect_bad_input(recognize_format(folder_.path()), {"no cameras in this folder", file, remedy});
    fs::remove(path(file));
  }
  write_text(path("one.nvm"), "");
  write_text(path("two.nvm"), "");
  expect_bad_input(read_scene(folder_.path(), {}), {"2 files *.nvm", "one.nvm and two.nvm", "leave one"});
}

}  // namespace
}  // namespace quorum
