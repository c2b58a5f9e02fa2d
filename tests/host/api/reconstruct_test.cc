// Runs by the library: progress, stop, failures, and where results lie.
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tests/host/api/api_scene.h"

namespace quorum {
namespace {

using v0::ErrorKind;
using v0::Options;
using v0::Results;
using v0::RunSettings;
using v0::Scene;

TEST_F(ApiReconstruct, ProgressIsToldToItsEnd) {
  synthesize(8, 80);
  std::vector<std::string> stages;
  std::vector<std::string> notes;
  double last = 0;
  int depth_steps = 0;
  RunSettings settings;
  settings.on_progress = [&](const v0::Progress& progress) {
    if (stages.empty() || stages.back() != progress.stage) stages.emplace_back(progress.stage);
    EXPECT_GE(progress.run_percent, last);
    EXPECT_LE(progress.done, progress.steps);
    last = progress.run_percent;
    if (progress.stage == "computing depth maps") depth_steps = progress.done;
  };
  settings.on_note = [&](std::string_view line) { notes.emplace_back(line); };
  const auto results = v0::reconstruct(read(), options(), settings);
  ASSERT_TRUE(results) << results.error().message;
  ASSERT_GE(stages.size(), 4U);
  EXPECT_EQ(stages.front(), "computing depth maps");
  EXPECT_EQ(stages.back(), "extracting the mesh");
  EXPECT_EQ(depth_steps, 8);
  EXPECT_NEAR(last, 100, 0.01);
  ASSERT_GE(notes.size(), 2U);
  EXPECT_TRUE(contains(notes[0], "8 views, on CPU")) << notes[0];
}

TEST_F(ApiReconstruct, AStoppedRunGoesOn) {
  synthesize(8, 80);
  const Scene scene = read();
  int asked = 0;
  RunSettings settings;
  settings.workspace = below("out");
  settings.should_stop = [&] { return ++asked > 2; };
  expect_error(v0::reconstruct(scene, options(), settings), ErrorKind::kStopped, {"stopped"});
  EXPECT_EQ(asked, 3);
  settings.should_stop = {};
  const auto results = v0::reconstruct(scene, options(), settings);
  ASSERT_TRUE(results) << results.error().message;
  const auto report = nlohmann::json::parse(*results->report());
  EXPECT_EQ(report["kept_depth_maps"], 2);
  settings.restart = true;
  const auto anew = v0::reconstruct(scene, options(), settings);
  ASSERT_TRUE(anew) << anew.error().message;
  EXPECT_EQ(nlohmann::json::parse(*anew->report())["kept_depth_maps"], 0);
}

TEST_F(ApiReconstruct, WhatCallersThrowComesOutAgain) {
  synthesize(4, 64);
  const Scene scene = read();
  int told = 0;
  RunSettings settings;
  settings.on_progress = [&](const v0::Progress& progress) {
    ++told;
    if (progress.done == 1) throw std::out_of_range("the caller's own");
  };
  EXPECT_THROW(static_cast<void>(v0::reconstruct(scene, options(), settings)), std::out_of_range);
  EXPECT_EQ(told, 2);
  settings.on_progress = {};
  settings.should_stop = []() -> bool { throw std::out_of_range("the caller's own"); };
  EXPECT_THROW(static_cast<void>(v0::reconstruct(scene, options(), settings)), std::out_of_range);
}

TEST_F(ApiReconstruct, WithoutAMeshThereAreDepthMaps) {
  synthesize(4, 64);
  RunSettings settings;
  settings.mesh = false;
  const auto results = v0::reconstruct(read(), Options().set("device", "cpu"), settings);
  ASSERT_TRUE(results) << results.error().message;
  const auto map = results->depth_map(0);
  ASSERT_TRUE(map) << map.error().message;
  EXPECT_EQ(map->certainty.size(), map->depth.size());
  EXPECT_EQ(map->normal.size(), 3 * map->depth.size());
  EXPECT_TRUE(map->correlation.empty());
  expect_error(results->mesh(), ErrorKind::kInput, {"mesh.ply"});
}

TEST_F(ApiReconstruct, TemporaryFilesGoWithTheLastCopy) {
  synthesize(8, 80);
  std::filesystem::path folder;
  {
    const auto results = v0::reconstruct(read(), options());
    ASSERT_TRUE(results) << results.error().message;
    const Results copy = *results;
    folder = copy.folder();
    EXPECT_TRUE(std::filesystem::exists(folder / "mesh.ply"));
    for (const auto& [name, bytes] : files_below(folder)) EXPECT_FALSE(name.ends_with(".png")) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(folder));
}

TEST_F(ApiReconstruct, WhatCannotBeDoneIsRefused) {
  synthesize(4, 64);
  const Scene scene = read();
  const auto refused = [&](const Options& options, const RunSettings& settings = {}) {
    return v0::reconstruct(scene, options, settings);
  };
  expect_error(refused(Options().set("window", 4)), ErrorKind::kUsage, {"option window 4"});
  expect_error(refused(Options().set("device", "no such device")), ErrorKind::kNoDevice, {"no such device"});
  expect_error(refused(Options().set("max-image-size", 32)), ErrorKind::kUsage, {"max-image-size 32", "Scene::read"});
  expect_error(refused(options().set("memory", "1kB")), ErrorKind::kMemory, {});
  RunSettings settings;
  settings.mesh = false;
  settings.report_page = true;
  expect_error(refused(options(), settings), ErrorKind::kUsage, {"report_page"});
  settings = {};
  settings.workspace = below("scene") / "README.txt" / "out";
  expect_error(refused(options(), settings), ErrorKind::kInput, {"README.txt"});
}

}  // namespace
}  // namespace quorum
