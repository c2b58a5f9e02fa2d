// Options of the library, by name and typed.
#include "engine/pipeline/run_options.h"
#include "tests/host/api/api_scene.h"

namespace quorum {
namespace {

using v0::Options;

std::string value_of(const Options& options, const char* name) {
  const auto value = options.get(name);
  return value ? *value : value.error().message;
}

TEST(ApiOptions, AllOfAWholeRunAreListed) {
  const auto listed = v0::list_options();
  std::vector<std::string> names;
  for (const RunOption& option : run_option_table())
    if (option.stage != RunStage::kShards) names.push_back(option.name);
  ASSERT_EQ(listed.size(), names.size());
  for (std::size_t i = 0; i < listed.size(); ++i) {
    EXPECT_EQ(listed[i].name, names[i]);
    EXPECT_FALSE(listed[i].help.empty()) << names[i];
    EXPECT_EQ(value_of(Options(), listed[i].name.c_str()), listed[i].usual) << names[i];
  }
}

TEST(ApiOptions, NumbersSwitchesAndTextsAreTaken) {
  Options options;
  options.set("neighbors", 6).set("threshold", 0.75).set("voxel-size", 0.0005).set("fill-holes", true);
  options.set("confirm", false).set("memory", "4GiB").set("bounds", {-1, -2.5, 0, 1, 2, 3}).set("tile", "32 8");
  ASSERT_TRUE(options.check()) << options.check().error().message;
  EXPECT_EQ(value_of(options, "neighbors"), "6");
  EXPECT_EQ(value_of(options, "threshold"), "0.75");
  EXPECT_EQ(value_of(options, "voxel-size"), "5e-04");
  EXPECT_EQ(value_of(options, "fill-holes"), "true");
  EXPECT_EQ(value_of(options, "confirm"), "false");
  EXPECT_EQ(value_of(options, "memory"), "4294967296");
  EXPECT_EQ(value_of(options, "bounds"), "-1 -2.5 0 1 2 3");
  EXPECT_EQ(value_of(options, "tile"), "32 8");
  EXPECT_EQ(value_of(options, "window"), "5");
}

TEST(ApiOptions, SwitchesGoBothWaysAndByTheProgramsNames) {
  Options options;
  options.set("confirm", false).set("confirm", true).set("fill-holes", true).set("fill-holes", "false");
  EXPECT_EQ(value_of(options, "confirm"), "true");
  EXPECT_EQ(value_of(options, "fill-holes"), "false");
  options.set("no-confirm", true).set("no-slant", true);
  EXPECT_EQ(value_of(options, "confirm"), "false");
  EXPECT_EQ(value_of(options, "window-model"), "plane");
  options.set("no-confirm", false).set("no-slant", false);
  EXPECT_EQ(value_of(options, "confirm"), "true");
  EXPECT_EQ(value_of(options, "window-model"), "slanted");
}

TEST(ApiOptions, WhatIsSetOverrulesQualityInAnyOrder) {
  for (const bool quality_first : {true, false}) {
    Options options;
    if (quality_first) options.set("quality", "high");
    options.set("neighbors", 5);
    if (!quality_first) options.set("quality", "high");
    EXPECT_EQ(value_of(options, "neighbors"), "5");
    EXPECT_EQ(value_of(options, "second-window"), "9");
  }
}

TEST(ApiOptions, TheFirstFailureIsKept) {
  Options options;
  options.set("neighbors", 6).set("window", 4).set("voxel-sise", 1).set("neighbors", 3);
  expect_error(options.check(), v0::ErrorKind::kUsage, {"option window 4", "3 to 15, odd"});
  expect_error(options.get("neighbors"), v0::ErrorKind::kUsage, {"option window 4"});
  expect_error(v0::Scene::read("nowhere", options), v0::ErrorKind::kUsage, {"option window 4"});
}

TEST(ApiOptions, WhatIsNoneIsRefused) {
  const auto refused = [](const char* name, const auto& value) { return Options().set(name, value).check(); };
  expect_error(refused("voxel-sise", 1), v0::ErrorKind::kUsage, {"option voxel-sise", "did you mean voxel-size?"});
  expect_error(refused("shard", "1/2"), v0::ErrorKind::kUsage, {"no such option"});
  expect_error(refused("neighbors", 2.5), v0::ErrorKind::kUsage, {"neighbors 2.5", "2 to 32"});
  expect_error(refused("neighbors", true), v0::ErrorKind::kUsage, {"neighbors true", "2 to 32"});
  expect_error(refused("threshold", -1), v0::ErrorKind::kUsage, {"threshold -1"});
  expect_error(refused("fill-holes", "yes"), v0::ErrorKind::kUsage, {"fill-holes yes", "true or false"});
  expect_error(refused("fill-holes", 1), v0::ErrorKind::kUsage, {"fill-holes 1", "true or false"});
  expect_error(refused("masks", ""), v0::ErrorKind::kUsage, {"masks", "a folder"});
  expect_error(refused("tile", "32"), v0::ErrorKind::kUsage, {"tile 32"});
  expect_error(refused("bounds", std::vector<double>{1, 2}), v0::ErrorKind::kUsage, {"bounds"});
  expect_error(Options().get("voxel"), v0::ErrorKind::kUsage, {"option voxel", "no such option"});
  expect_error(Options().set("neighbors", 2).set("min-votes", 3).check(), v0::ErrorKind::kUsage, {"min-votes 3"});
}

TEST(ApiOptions, CopiesAreIndependent) {
  Options first;
  first.set("neighbors", 6);
  Options second = first;
  second.set("neighbors", 3);
  EXPECT_EQ(value_of(first, "neighbors"), "6");
  EXPECT_EQ(value_of(second, "neighbors"), "3");
}

}  // namespace
}  // namespace quorum
