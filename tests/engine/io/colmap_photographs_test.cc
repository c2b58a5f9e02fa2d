// Names, sizes and absence of the photographs of a COLMAP scene.
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/io/write_image.h"
#include "tests/engine/io/colmap_test.h"
#include "tests/engine/io/io_test.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

using ColmapPhotographs = ColmapTest;

TEST_F(ColmapPhotographs, ImagesInFoldersAreNamedApart) {
  ColmapModel model = make_colmap_model("PINHOLE");
  model.images[0].name = "left/1.png";
  model.images[1].name = "right/1.png";
  model.images[2].name = "right/2.png";
  model.images[3].name = "right/2.jpg";
  fs::create_directories(path("images/left"));
  fs::create_directories(path("images/right"));
  write(model);
  write_png(path("images/right/2.jpg"), ColorImage(67, 48)).value();
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  std::vector<std::string> names;
  for (const View& view : scene->views) names.push_back(view.name);
  EXPECT_EQ(names, (std::vector<std::string>{"left_1", "right_1", "right_2.jpg", "right_2.png"}));
}

TEST_F(ColmapPhotographs, PhotographsMustBeThereAndHaveTheirCamerasSize) {
  write(make_colmap_model("SIMPLE_RADIAL"));
  write_png(path("images/b.png"), ColorImage(64, 48)).value();
  expect_bad_input(read(), {"image \"b.png\"", "is 64 x 48, its camera 65 x 48"});
  write_png(path("images/b.png"), ColorImage(48, 65)).value();
  expect_bad_input(read(), {"image \"b.png\"", "is 48 x 65, its camera 65 x 48"});
  fs::remove_all(path("images"));
  expect_bad_input(read(), {"image \"a.png\" of the model is not there", "option images"});
}

TEST_F(ColmapPhotographs, AbsentPhotographsAreLeftOutAndCounted) {
  write(make_colmap_model("SIMPLE_RADIAL"));
  const Scene whole = read().value();
  fs::remove(path("images/a.png"));
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->views.size(), 3U);
  EXPECT_EQ(scene->views[0].name, "b");
  ASSERT_EQ(scene->notes.size(), 1U);
  EXPECT_EQ(scene->notes[0], "1 of 4 photographs is not there and left out: a.png");
  for (const SparsePoint& point : scene->points) {
    EXPECT_FALSE(point.views.empty());
    for (const int view : point.views) {
      const auto other = std::ranges::find(whole.points, point.position, &SparsePoint::position);
      EXPECT_TRUE(std::ranges::binary_search(other->views, view + 1));
    }
  }
  fs::remove(path("images/c.png"));
  expect_bad_input(read(), {"2 of 4 photographs are there", "a.png", "option images"});
}

TEST_F(ColmapPhotographs, PhotographsOfAnotherSizeScaleTheirCameras) {
  const ColmapModel model = make_colmap_model("OPENCV");
  write(model);
  const Scene whole = read().value();
  fs::create_directories(path("images_2"));
  for (std::size_t i = 0; i < 4; ++i)
    write_png(path("images_2") / model.images[i].name, ColorImage(2 * model.cameras[i].width, 96)).value();
  const auto scene = read_colmap(folder_.path(), path("images_2"));
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_FALSE(scene->notes.empty());
  EXPECT_TRUE(scene->notes.back().ends_with("scaled by 2")) << scene->notes.back();
  const Lens& small = *whole.views[1].lens;
  const Lens& large = *scene->views[1].lens;
  for (const Eigen::Vector2d& ray : {Eigen::Vector2d(0, 0), Eigen::Vector2d(0.3, -0.2)}) {
    const Eigen::Vector2d expected = (2 * (small.project(ray).array() + 0.5) - 0.5).matrix();
    EXPECT_LT((large.project(ray) - expected).norm(), 1e-9);
  }
  EXPECT_EQ(scene->views[1].photo_width, 130);
  fs::remove_all(path("images"));
  EXPECT_EQ(read().value().notes.size(), 2U) << "found without being named, and said";
  write_png(path("images_2/b.png"), ColorImage(96, 130)).value();
  expect_bad_input(read(), {"b.png", "is 96 x 130, its camera 65 x 48"});
}

TEST_F(ColmapPhotographs, NamesFromOtherMachinesAreFound) {
  ColmapModel model = make_colmap_model("PINHOLE");
  write(model);
  model.images[0].name = "/elsewhere/images/a.png";
  model.images[1].name = "D:\\photos\\images\\b.PNG";
  model.images[2].name = "c";
  ASSERT_TRUE(write_colmap_model(path("sparse"), model));
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->views.size(), 4U) << scene->notes.at(0);
  std::vector<std::string> names;
  for (const View& view : scene->views) names.push_back(view.name);
  EXPECT_EQ(names, (std::vector<std::string>{"a", "b", "c", "d"}));
  model.images[2].name = "\\elsewhere\\a.png";
  ASSERT_TRUE(write_colmap_model(path("sparse"), model));
  expect_bad_input(read(), {"images/a.png", "photograph of another image, too"});
}

}  // namespace
}  // namespace quorum
