// Scenes of files and arrays, devices, and results as values.
#include <cmath>

#include "engine/core/version.h"
#include "tests/host/api/api_scene.h"

namespace quorum {
namespace {

using v0::ErrorKind;
using v0::Options;
using v0::Scene;

TEST(ApiResult, TheValueOfAFailureEndsTheProcess) {
  const v0::Result<int> failed(v0::Error{ErrorKind::kInput, "a.txt: is missing"});
  EXPECT_FALSE(failed);
  EXPECT_DEATH(static_cast<void>(*failed), "quorum: .*a.txt: is missing");
  const v0::Result<int> given(17);
  ASSERT_TRUE(given);
  EXPECT_EQ(*given, 17);
  EXPECT_EQ(given.error().message, "");
}

TEST(ApiVersion, IsThatOfTheProject) { EXPECT_EQ(v0::version(), version()); }

TEST(ApiDevice, TheCpuIsTheFirst) {
  const auto devices = v0::list_devices();
  ASSERT_TRUE(devices);
  ASSERT_GE(devices->size(), 1U);
  EXPECT_EQ(devices->front().option, "cpu");
  EXPECT_EQ(devices->front().defect, "");
  const auto chosen = v0::choose_device("cpu");
  ASSERT_TRUE(chosen);
  EXPECT_EQ(chosen->name, devices->front().name);
  expect_error(v0::choose_device("no such device"), ErrorKind::kNoDevice, {"no such device"});
}

TEST(ApiScene, FilesThatAreMissingAreNamed) {
  expect_error(Scene::read("/nowhere/at all"), ErrorKind::kInput, {"/nowhere/at all", "no such folder"});
}

TEST(ApiScene, ArraysComeBackAsTheyWereGiven) {
  OwnedArrays owned = flat_arrays();
  owned.arrays.views[1].name = "left/eye.png";
  owned.arrays.views[2].camera.camera_from_world = {0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1};
  const auto scene = Scene::from_arrays(owned.arrays);
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->view_count(), 3);
  EXPECT_EQ(scene->view(0).name, "view0001");
  EXPECT_EQ(scene->view(1).name, "left_eye");
  EXPECT_EQ(scene->view(1).image_name, "left/eye.png");
  EXPECT_EQ(scene->view(2).width, 16);
  EXPECT_EQ(scene->view(2).height, 12);
  EXPECT_EQ(scene->view(2).camera.intrinsics, owned.arrays.views[2].camera.intrinsics);
  EXPECT_EQ(scene->view(2).camera.camera_from_world, owned.arrays.views[2].camera.camera_from_world);
  EXPECT_EQ(scene->view(2).camera.translation, owned.arrays.views[2].camera.translation);
  EXPECT_EQ(scene->bounds(), *owned.arrays.bounds);
}

TEST(ApiScene, FarFromTheOriginWorldStaysTheCallers) {
  OwnedArrays owned = flat_arrays();
  const double far = 4e6;
  for (v0::ViewArrays& view : owned.arrays.views) view.camera.translation[0] -= far;
  owned.arrays.bounds = {far - 1, -1, -1, far + 1, 1, 1};
  const auto scene = Scene::from_arrays(owned.arrays);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_NEAR(scene->view(1).camera.translation[0], owned.arrays.views[1].camera.translation[0], 1e-6);
  EXPECT_NEAR(scene->bounds()[3], far + 1, 1e-6);
}

TEST(ApiScene, ImagesAreHalvedAsTheOptionSays) {
  Options options;
  options.set("max-image-size", 16);
  OwnedArrays owned = flat_arrays();
  owned.pixels[0].resize(32 * 24, 100);
  for (v0::ViewArrays& view : owned.arrays.views) {
    view.image = {owned.pixels[0].data(), 32, 24, 1};
    view.camera.intrinsics = {40, 0, 16, 0, 40, 12, 0, 0, 1};
  }
  const auto scene = Scene::from_arrays(owned.arrays, options);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->view(0).width, 16);
  EXPECT_DOUBLE_EQ(scene->view(0).camera.intrinsics[0], 20);
}

/// Arrays that `spoil` made wrong, which from_arrays refuses in a line with these parts.
template <typename Spoil>
void expect_refused(const Spoil& spoil, const std::vector<std::string>& parts) {
  OwnedArrays owned = flat_arrays();
  spoil(owned.arrays);
  expect_error(Scene::from_arrays(owned.arrays), ErrorKind::kInput, parts);
}

TEST(ApiScene, ArraysThatAreNoneAreRefused) {
  using Arrays = v0::SceneArrays;
  expect_refused([](Arrays& all) { all.views.pop_back(); }, {"2 views", "3 or more"});
  expect_refused([](Arrays& all) { all.views[1].image.data = nullptr; }, {"view \"view0002\"", "no data"});
  expect_refused([](Arrays& all) { all.views[1].image.width = 0; }, {"view0002", "0 x 12"});
  expect_refused([](Arrays& all) { all.views[1].image.height = -3; }, {"view0002", "16 x -3"});
  expect_refused([](Arrays& all) { all.views[1].image.channels = 4; }, {"4 channels", "1 or 3"});
  expect_refused([](Arrays& all) { all.views[1].image.stride = 15; }, {"stride", "15 bytes", "16"});
  expect_refused([](Arrays& all) { all.views[1].mask = all.views[1].image, all.views[1].mask.height = 11; },
                 {"mask is 16 x 11", "16 x 12"});
  expect_refused([](Arrays& all) { all.views[2].camera.camera_from_world[0] = -1; }, {"view0003", "mirrors"});
  expect_refused([](Arrays& all) { all.views[2].camera.translation[0] = NAN; }, {"view0003", "not finite"});
  expect_refused([](Arrays& all) { all.views[0].neighbors = {1, 0}; }, {"view0001", "neighbor 0"});
  expect_refused([](Arrays& all) { all.views[0].neighbors = {3}; }, {"neighbor 3", "0 to 2"});
  expect_refused([](Arrays& all) { all.views[0].near_depth = 2, all.views[0].far_depth = 1; }, {"from 2 to 1"});
  expect_refused([](Arrays& all) { all.views[0].name = all.views[1].name = "a.png"; }, {"a.png"});
  expect_refused([](Arrays& all) { all.views[0].name = "a\nb"; }, {"control characters"});
  expect_refused([](Arrays& all) { all.points = {{{0, 0, 0}, {0, 3}}}; }, {"point 0", "0 to 2"});
  expect_refused([](Arrays& all) { all.points = {{{0, NAN, 0}, {0}}}; }, {"point 0", "not finite"});
  expect_refused([](Arrays& all) { all.bounds = {1, 1, 1, 0, 0, 0}; }, {"scene"});
}

TEST(ApiScene, OptionsWithoutUseForArraysAreRefused) {
  const OwnedArrays owned = flat_arrays();
  expect_error(Scene::from_arrays(owned.arrays, Options().set("format", "colmap")), ErrorKind::kUsage, {"format"});
  expect_error(Scene::from_arrays(owned.arrays, Options().set("bounds", {0, 0, 0, 1, 1, 1})), ErrorKind::kUsage,
               {"bounds", "one of the two"});
}

TEST(ApiScene, ViewsThatAreNoneEndTheProcess) {
  const auto scene = Scene::from_arrays(flat_arrays().arrays);
  ASSERT_TRUE(scene);
  EXPECT_DEATH(static_cast<void>(scene->view(3)), "view 3 was asked for; the scene has 3");
}

}  // namespace
}  // namespace quorum
