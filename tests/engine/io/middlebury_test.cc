#include "engine/io/middlebury.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "engine/io/file.h"
#include "engine/io/par_file.h"
#include "engine/io/write_image.h"
#include "tests/engine/io/io_test.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

const std::string kCamera = " 100 0 20 0 100 15 0 0 1 1 0 0 0 1 0 0 0 1 0.1 -0.2 5";
const std::string kViewLines = "a.png" + kCamera + "\nb.png" + kCamera + "\nc.png" + kCamera + "\n";
const std::string kReadme = "the tiny set\nThe (tight) bounding box is\n(-1 -2 -0.5)\n(1 2 0.5)\n";
const std::string kRemedy = "option bounds \"x0 y0 z0 x1 y1 z1\"";

/// A folder with three images of 40 x 30 pixels, par file and README.
class MiddleburyTest : public testing::Test {
 protected:
  MiddleburyTest() {
    for (const char* name : {"a.png", "b.png", "c.png"})
      EXPECT_TRUE(write_png(path(name), ColorImage(40, 30, make_rgb(1, 2, 3))));
    write_text(path("tiny_par.txt"), "3\n" + kViewLines);
    write_text(path("README.txt"), kReadme);
  }

  [[nodiscard]] fs::path path(const std::string& name) const { return folder_.path() / name; }
  Expected<Scene> read() { return read_middlebury(folder_.path(), {}, {}); }
  Expected<Scene> read_par(const std::string& text) {
    write_text(path("tiny_par.txt"), text);
    return read();
  }
  Expected<Scene> read_readme(const std::string& text) {
    fs::remove(path("README.txt"));  // some file systems flush a file that is overwritten, which takes milliseconds
    write_text(path("README.txt"), text);
    return read();
  }
  Expected<Scene> read_box(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    return read_middlebury(folder_.path(), Bounds{low, high}, {});
  }

  TemporaryFolder folder_;
};

using Middlebury = MiddleburyTest;

TEST_F(Middlebury, ReadsViewsAndBounds) {
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->views.size(), 3U);
  const View& view = scene->views[1];
  EXPECT_EQ(view.name, "b");
  EXPECT_EQ(view.image_path, path("b.png"));
  EXPECT_TRUE(view.mask_path.empty());
  EXPECT_EQ(view.width, 40);
  EXPECT_EQ(view.height, 30);
  EXPECT_EQ(view.camera.intrinsics(0, 2), 20.0);
  EXPECT_EQ(view.camera.intrinsics(1, 2), 15.0);
  EXPECT_EQ(view.camera.camera_from_world, Eigen::Matrix3d::Identity());
  EXPECT_EQ(view.camera.translation, Eigen::Vector3d(0.1, -0.2, 5.0));
  EXPECT_EQ(scene->bounds.low, Eigen::Vector3d(-1.0, -2.0, -0.5));
  EXPECT_EQ(scene->bounds.high, Eigen::Vector3d(1.0, 2.0, 0.5));
}

TEST_F(Middlebury, MatricesAreGivenRowByRow) {
  const auto scene = read_par("x.png 2 4 6 0 8 10 0 0 2 0 -1 0 1 0 0 0 0 1 1 2 3\n");
  ASSERT_FALSE(scene);
  const auto lines = parse_par_file("p", "x.png 2 4 6 0 8 10 0 0 2 0 -1 0 1 0 0 0 0 1 1 2 3\n");
  ASSERT_TRUE(lines) << lines.error().message;
  Eigen::Matrix3d k;
  k << 1, 2, 3, 0, 4, 5, 0, 0, 1;
  Eigen::Matrix3d r;
  r << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  EXPECT_EQ(lines->at(0).camera.intrinsics, k);
  EXPECT_EQ(lines->at(0).camera.camera_from_world, r);
  EXPECT_EQ(lines->at(0).camera.translation, Eigen::Vector3d(1, 2, 3));
}

TEST_F(Middlebury, CountHeaderOrNeitherMayComeFirst) {
  const std::string header =
      "imgname k11 k12 k13 k21 k22 k23 k31 k32 k33 r11 r12 r13 r21 r22 r23 r31 r32 r33 t1 t2 t3\n";
  for (const std::string& first : {std::string(), std::string("3\n"), std::string("\n  3 \n\n"), header,
                                   std::string("\"imgname.png k11 ... t3\"\n")}) {
    const auto scene = read_par(first + kViewLines + "\n");
    ASSERT_TRUE(scene) << first << scene.error().message;
    EXPECT_EQ(scene->views.size(), 3U);
  }
}

TEST_F(Middlebury, CarriageReturnsAreAccepted) {
  const auto with_returns = [](std::string text) {
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, 1, '\r');
    return text;
  };
  write_text(path("README.txt"), with_returns(kReadme));
  const auto scene = read_par(with_returns("3\n" + kViewLines));
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->views[2].name, "c");
  EXPECT_EQ(scene->bounds.high.z(), 0.5);
}

TEST_F(Middlebury, MalformedViewIsNamedWithFileAndLine) {
  const auto with_second = [](const std::string& line) { return "3\na.png" + kCamera + "\n" + line + "\n"; };
  expect_bad_input(read_par(with_second("b.png 1 2 3")), {"tiny_par.txt:3: expected 22 fields, found 4"});
  expect_bad_input(read_par(with_second("b.png" + kCamera + " 9")), {"tiny_par.txt:3: expected 22 fields, found 23"});
  expect_bad_input(read_par(with_second("b.png x 0 20 0 100 15 0 0 1 1 0 0 0 1 0 0 0 1 0 0 5")),
                   {"tiny_par.txt:3: k11 = \"x\" is not a number"});
  expect_bad_input(read_par(with_second("b.png 100 0 20 0 100 15 0 0 1 1 0 0 0 1 0 0 0 1 0 0 5,0")),
                   {"tiny_par.txt:3: t3 = \"5,0\" is not a number"});
  expect_bad_input(read_par(with_second("b.png 100 0 20 0 100 15 0 0 1 1 0 0 0 1 0 0 0 2 0 0 5")),
                   {"tiny_par.txt:3: R is not a rotation"});
  expect_bad_input(read_par(with_second("b.png 100 0 20 0 100 15 0 0 0 1 0 0 0 1 0 0 0 1 0 0 5")),
                   {"tiny_par.txt:3: K is singular"});
  expect_bad_input(read_par(with_second("b.png 100 0 20 0 100 15 0 0 1 1 0 0 0 1 0 0 0 1 0 0 nan")),
                   {"tiny_par.txt:3: a camera value is not finite", "correct it, or leave the view out"});
  const auto with_third = [&](const std::string& line) { return with_second(line) + "c.png" + kCamera + "\n"; };
  expect_bad_input(read_par(with_third("b.png 1e30 0 20 0 1e30 15 0 0 1 1 0 0 0 1 0 0 0 1 0 0 5")),
                   {"tiny_par.txt:3: its focal length 1e+30", "correct it, or leave the view out"});
  expect_bad_input(read_par(with_third("b.png 100 0 20 0 100 15 0 0 1 1 0 0 0 1 0 0 0 1 0 0 1e30")),
                   {"tiny_par.txt:3: its position (-0 -0 -1e+30) is beyond all units"});
  expect_bad_input(read_par("a.png x 0 20 0 100 15 0 0 1 1 0 0 0 1 0 0 0 1 0 0 5\n"), {"tiny_par.txt:1: k11"});
}

TEST_F(Middlebury, EachViewHasTheSizeOfItsImage) {
  ASSERT_TRUE(write_png(path("b.png"), ColorImage(50, 20, make_rgb(1, 2, 3))));
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(std::pair(scene->views[0].width, scene->views[0].height), std::pair(40, 30));
  EXPECT_EQ(std::pair(scene->views[1].width, scene->views[1].height), std::pair(50, 20));
  EXPECT_EQ(std::pair(scene->views[2].width, scene->views[2].height), std::pair(40, 30));
}

TEST_F(Middlebury, CountMustBeThatOfTheLines) {
  expect_bad_input(read_par("4\n" + kViewLines), {"tiny_par.txt:1: says 4 views, but 3 follow"});
  expect_bad_input(read_par("2\n" + kViewLines), {"tiny_par.txt:1: says 2 views, but 3 follow"});
  expect_bad_input(read_par("99999999999\n"), {"tiny_par.txt:1: says 99999999999 views, but 0 follow"});
  for (const char* count : {"-3", "3.0", "views"})
    expect_bad_input(read_par(count + ("\n" + kViewLines)), {"tiny_par.txt:1: expected a count", count});
}

TEST_F(Middlebury, FewerThanThreeViewsAreRefused) {
  expect_bad_input(read_par(""), {"tiny_par.txt: holds 0 views, expected 3 or more"});
  expect_bad_input(read_par("2\na.png" + kCamera + "\nb.png" + kCamera + "\n"), {"holds 2 views"});
}

TEST_F(Middlebury, ImageThatIsTwiceOrAbsentIsNamed) {
  expect_bad_input(read_par(kViewLines + "b.png" + kCamera), {"tiny_par.txt:4: the name of image \"b.png\"", "line 2"});
  const auto partial = read_par("my d.png" + kCamera + "\n" + kViewLines);
  ASSERT_TRUE(partial) << partial.error().message;
  EXPECT_EQ(partial->views.size(), 3U);
  EXPECT_EQ(partial->notes.at(0), "1 of 4 photographs is not there and left out: my d.png");
  expect_bad_input(read_par(kViewLines + "x\x1b[1m" + kCamera), {"tiny_par.txt:4", "control characters"});
  fs::rename(path("c.png"), path("d.png"));
  expect_bad_input(read_par(kViewLines),
                   {"tiny_par.txt:3: image \"c.png\" is not in", folder_.path().string(), "2 of 3"});
  fs::rename(path("d.png"), path("c.png"));
  write_text(path("a.png"), "no image");
  expect_bad_input(read_par(kViewLines), {"a.png: is damaged"});
}

TEST_F(Middlebury, FolderWithoutExactlyOneParFileIsNamed) {
  expect_bad_input(read_middlebury(path("none"), {}, {}), {"none: no such folder"});
  expect_bad_input(read_middlebury(path("a.png"), {}, {}), {"a.png: is a file, expected the folder"});
  write_text(path("more_par.txt"), "3\n" + kViewLines);
  expect_bad_input(read(), {"2 par files (more_par.txt, tiny_par.txt)"});
  fs::remove(path("more_par.txt"));
  fs::remove(path("tiny_par.txt"));
  expect_bad_input(read(), {folder_.path().string() + ": no *_par.txt"});
}

TEST_F(Middlebury, BoundsAreFoundWhereverTheReadmeHasThem) {
  const auto scene = read_readme("no box here\n  THE BOUNDING BOX (in m) is:\n\nread on\n\t( -1  -1 -1 ) \n\n(1 1 1)");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->bounds.low, Eigen::Vector3d(-1, -1, -1));
  EXPECT_EQ(scene->bounds.high, Eigen::Vector3d(1, 1, 1));
}

TEST_F(Middlebury, BoundsThatAreMissingOrMalformedAreNamedWithTheRemedy) {
  expect_bad_input(read_readme(""), {"README.txt: no \"bounding box\"", kRemedy});
  expect_bad_input(read_readme("(-1 -1 -1)\n(1 1 1)\n"), {"README.txt: no \"bounding box\"", kRemedy});
  expect_bad_input(read_readme("bounding box\n(-1 -1 -1)\n"), {"README.txt: no \"bounding box\"", kRemedy});
  expect_bad_input(read_readme("bounding box\n(-1 -1 -1)\n(1 x 1)\n"), {"README.txt:3:", "\"(1 x 1)\"", kRemedy});
  expect_bad_input(read_readme("bounding box\n(-1 -1)\n(1 1 1)\n"), {"README.txt:2:", kRemedy});
}

TEST_F(Middlebury, WithoutReadmeTheBoundsAreFound) {
  fs::remove(path("README.txt"));
  expect_bad_input(read(), {"show no depth", kRemedy});
}

TEST_F(Middlebury, GivenBoundsNeedNoReadme) {
  fs::remove(path("README.txt"));
  const auto scene = read_box({-1, -1, -1}, {1, 1, 2});
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->bounds.high.z(), 2.0);
}

TEST_F(Middlebury, EmptyBoundsAreRefused) {
  expect_bad_input(read_box({1, -1, -1}, {-1, 1, 1}), {"bounds (1 -1 -1) (-1 1 1) are empty", kRemedy});
  expect_bad_input(read_box({-1, -1, 1}, {1, 1, 1}), {"are empty", kRemedy});
  expect_bad_input(read_box({-1, -1, std::nan("")}, {1, 1, 1}), {"are empty", kRemedy});
  expect_bad_input(read_box({-1, -1, -1}, {1, 1, INFINITY}), {"are empty", kRemedy});
  expect_bad_input(read_readme("bounding box\n(1 1 1)\n(-1 -1 -1)\n"), {"are empty", kRemedy});
}

TEST_F(Middlebury, BoundsThatNoViewSeesAreRefused) {
  // The cameras look along z from z = -5; behind them, beside them, and far off.
  expect_bad_input(read_box({-1, -1, -9}, {1, 1, -7}), {"no view sees the bounds (-1 -1 -9) (1 1 -7)", kRemedy});
  expect_bad_input(read_box({10, -1, -1}, {12, 1, 1}), {"no view sees", kRemedy});
  expect_bad_input(read_box({-1, 1000, -1}, {1, 2000, 1}), {"no view sees", kRemedy});
}

TEST_F(Middlebury, SmallAndVastBoundsAreSeen) {
  EXPECT_TRUE(read_box({0.2, 0.2, 0.0}, {0.201, 0.201, 0.001}));
  EXPECT_TRUE(read_box({-1000, -1000, -1000}, {3000, 3000, 3000}));
}

TEST_F(Middlebury, MasksAreFoundUnderBothNames) {
  const fs::path masks = path("masks");
  fs::create_directory(masks);
  for (const char* name : {"a.png.png", "b.png", "c.png", "c.png.png"}) write_text(masks / name, "x");
  const auto scene = read_middlebury(folder_.path(), {}, masks);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->views[0].mask_path, masks / "a.png.png");
  EXPECT_EQ(scene->views[1].mask_path, masks / "b.png");
  EXPECT_EQ(scene->views[2].mask_path, masks / "c.png.png");
  fs::remove(masks / "b.png");
  expect_bad_input(read_middlebury(folder_.path(), {}, masks), {"masks: no mask b.png.png or b.png for view b"});
  expect_bad_input(read_middlebury(folder_.path(), {}, path("none")), {"none: no such folder of masks"});
}

TEST_F(Middlebury, PhotographsMayStandInAnotherFolder) {
  fs::create_directories(path("half"));
  for (const char* name : {"a.png", "b.png", "c.png"})
    ASSERT_TRUE(write_png(path("half") / name, ColorImage(20, 15, make_rgb(1, 2, 3))));
  const auto scene = read_middlebury(folder_.path(), {}, {}, path("half"));
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->views[1].image_path, path("half/b.png"));
  expect_bad_input(read_middlebury(folder_.path(), {}, {}, path("none")), {"image \"a.png\" is not in", "none"});
}

TEST_F(Middlebury, ReadsBackTheDoublesThatWereWritten) {
  Scene scene = read().value();
  for (int i = 0; i < 3; ++i) {
    Camera& camera = scene.views[i].camera;
    camera.camera_from_world = Eigen::AngleAxisd(0.01 + 0.1 * i, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
    camera.translation = {1.0 / 3.0, -1e-17, 5.0 + i / 7.0};
    camera.intrinsics(0, 0) = 1000.0 / 7.0;
  }
  scene.bounds = {{-0.1, -1.0 / 3.0, -0.7}, {0.1, 1e-300, 0.30000000000000004}};
  fs::remove(path("tiny_par.txt"));
  const auto written = write_middlebury(folder_.path(), "again", scene);
  ASSERT_TRUE(written) << written.error().message;
  EXPECT_TRUE(fs::exists(path("again_par.txt")));
  const auto read_again = read();
  ASSERT_TRUE(read_again) << read_again.error().message;
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(read_again->views[i].name, scene.views[i].name);
    EXPECT_EQ(read_again->views[i].camera.intrinsics, scene.views[i].camera.intrinsics);
    EXPECT_EQ(read_again->views[i].camera.camera_from_world, scene.views[i].camera.camera_from_world);
    EXPECT_EQ(read_again->views[i].camera.translation, scene.views[i].camera.translation);
  }
  EXPECT_EQ(read_again->bounds.low, scene.bounds.low);
  EXPECT_EQ(read_again->bounds.high, scene.bounds.high);
}

TEST_F(Middlebury, WhatCantBeWrittenIsNamed) {
  Scene scene = read().value();
  expect_bad_input(write_middlebury(path("none"), "x", scene), {"none/x_par.txt: cannot write"});
  scene.views[1].image_path = path("b 2.png");
  expect_bad_input(write_middlebury(folder_.path(), "x", scene), {"b 2.png", "space"});
  EXPECT_FALSE(fs::exists(path("x_par.txt")));
}

TEST(ParFile, AnyDamageEndsInProperCamerasOrAnError) {
  const std::string good = "3\n" + kViewLines;
  int failures = 0;
  for (std::uint32_t seed = 0; seed < 5000; ++seed) {
    const std::string text = mutate(good, seed);
    const auto lines = parse_par_file("p", text);
    failures += lines ? 0 : 1;
    if (!lines) {
      EXPECT_EQ(lines.error().message.find('\n'), std::string::npos) << "seed " << seed;
      continue;
    }
    EXPECT_LE(lines->size(), text.size() / 40) << "seed " << seed;
    for (const ParLine& line : *lines) EXPECT_EQ(camera_defect(line.camera), nullptr) << "seed " << seed;
  }
  EXPECT_GT(failures, 1000);
  EXPECT_LT(failures, 5000);
}

TEST_F(Middlebury, AnyDamageToTheReadmeEndsInBoundsOrAnError) {
  for (std::uint32_t seed = 0; seed < 1000; ++seed) {
    const auto scene = read_readme(mutate(kReadme, seed));
    if (scene) {
      EXPECT_TRUE(scene->bounds.valid()) << "seed " << seed;
    } else {
      EXPECT_NE(scene.error().message.find("option bounds"), std::string::npos) << scene.error().message;
    }
  }
}

struct RealSet {
  const char* folder;
  std::size_t view_count;
  Bounds bounds;
  Eigen::Vector3d first_translation;
};

TEST(MiddleburyData, RealSetsReadAsTheyArePublished) {
  if (data_folder().empty()) GTEST_SKIP() << "no data folder";
  const std::vector<RealSet> sets = {{"templeSparseRing",
                                      16,
                                      {{-0.073568, 0.021728, -0.012445}, {0.028855, 0.181892, 0.062736}},
                                      {-0.0726637729648, 0.0223360353405, 0.614604845959}},
                                     {"templeRing",
                                      47,
                                      {{-0.023121, -0.038009, -0.091940}, {0.078626, 0.121636, -0.017395}},
                                      {-0.0292149526928, -0.0241923869131, 0.52269561933}},
                                     {"templeFull",
                                      312,
                                      {{-0.054568, 0.001728, -0.042945}, {0.047855, 0.161892, 0.032236}},
                                      {-0.05998547900141842900, 0.00400788029504099870, 0.57088647431543438000}},
                                     {"dinoSparseRing",
                                      16,
                                      {{-0.061897, -0.018874, -0.057845}, {0.010897, 0.068227, 0.015495}},
                                      {-0.010415508744, -0.0294278883669, 0.673097816109}},
                                     {"dinoRing",
                                      48,
                                      {{-0.021897, 0.021126, -0.017845}, {0.050897, 0.108227, 0.055495}},
                                      {-0.0526034704197, 0.023290917003, 0.659119498846}}};
  for (const RealSet& set : sets) {
    const auto scene = read_middlebury(data_folder() / set.folder, {}, {});
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->views.size(), set.view_count) << set.folder;
    EXPECT_EQ(scene->bounds.low, set.bounds.low) << set.folder;
    EXPECT_EQ(scene->bounds.high, set.bounds.high) << set.folder;
    const View& first = scene->views[0];
    EXPECT_EQ(first.camera.translation, set.first_translation) << set.folder;
    EXPECT_EQ(first.width, 640);
    EXPECT_EQ(first.height, 480);
    for (const View& view : scene->views) {
      // The object is in front of every camera, near the middle of the image.
      const Eigen::Vector3d pixel = view.camera.project(scene->bounds.center());
      EXPECT_GT(pixel.z(), 0.4) << view.name;
      EXPECT_TRUE(pixel.x() > 100 && pixel.x() < 540 && pixel.y() > 50 && pixel.y() < 430) << view.name;
    }
  }
  const auto full = read_middlebury(data_folder() / "templeFull", {}, {});
  const Camera& camera = full->views[0].camera;
  EXPECT_EQ(full->views[0].name, "temple0001");
  EXPECT_EQ(camera.intrinsics(0, 0), 1520.4);
  EXPECT_EQ(camera.intrinsics(1, 2), 246.87);
  EXPECT_EQ(camera.camera_from_world(0, 1), 0.99884343581246959000);
  EXPECT_EQ(camera.camera_from_world(2, 0), -0.03624837905512174500);
}

}  // namespace
}  // namespace quorum
