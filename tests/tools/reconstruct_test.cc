// The whole run as a user starts it: the same bytes however it is done, and a surface near the true one.
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

#include "engine/io/image_file.h"
#include "tests/support/sanitizer.h"
#include "tests/tools/tool_test.h"

namespace quorum {
namespace {

class Reconstruct : public ToolTest {
 protected:
  void SetUp() override { synthesize(8, 160); }

  ProgramResult run(const std::string& command, const std::string& output, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {command, scene().string(), "-o", below(output).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return quorum_program(arguments);
  }

  /// Everything that a run leaves but run.json, which tells times.
  Files results(const std::string& output) {
    Files files = files_below(below(output));
    files.erase("run.json");
    return files;
  }

  Files reconstruct(const std::string& output, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = run("reconstruct", output, arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return results(output);
  }

  nlohmann::json report(const std::string& output) {
    return nlohmann::json::parse(file_bytes(below(output) / "run.json"), nullptr, false);
  }
};

/// The device that --device takes for the Vulkan tests, or why there is none.
struct TestDevice {
  std::string request;
  std::string problem;
};

TestDevice find_test_device() {
  const char* given = std::getenv("QUORUM_TEST_DEVICE");
  if (given != nullptr && *given != '\0') return {given, ""};
  const ProgramResult listed = quorum_program({"devices", "--json"});
  const auto json = nlohmann::json::parse(listed.out, nullptr, false);
  if (listed.exit_code != 0 || json.is_discarded()) return {"", "quorum devices fails: " + listed.err};
  for (const auto& device : json["devices"])
    if (device["usable"].get<bool>()) return {std::to_string(device["index"].get<int>()), ""};
  return {"", "no Vulkan device is usable"};
}

TEST_F(Reconstruct, ThreadsTilesAndInstructionsLeaveEveryByteAlone) {
  const Files expected = reconstruct("first", {"--device", "cpu", "--threads", "1"});
  ASSERT_EQ(expected.size(), 8U * 10U + 1U);
  ASSERT_GT(report("first")["mesh"]["triangles"].get<int>(), 1000);
  expect_same_files(expected, reconstruct("threads", {"--device", "cpu", "--threads", "2"}));
  expect_same_files(expected, reconstruct("tile", {"--device", "cpu", "--tile", "17", "5"}));
  expect_same_files(expected, reconstruct("simd", {"--device", "cpu", "--simd", "baseline"}));
}

TEST_F(Reconstruct, OtherOptionsGiveOtherBytes) {
  const Files five = reconstruct("five", {"--device", "cpu"});
  const Files seven = reconstruct("seven", {"--device", "cpu", "--window", "7"});
  EXPECT_NE(five.at("mesh.ply"), seven.at("mesh.ply"));
}

TEST_F(Reconstruct, FillHolesFillsAndIsOffByDefault) {
  const Files open = reconstruct("result", {"--device", "cpu"});
  EXPECT_FALSE(report("result")["options"]["fill_holes"].get<bool>());
  EXPECT_EQ(report("result")["mesh"]["filled_vertices"].get<int>(), 0);
  const Files filled = reconstruct("filled", {"--device", "cpu", "--fill-holes", "--mask-below", "0.02"});
  EXPECT_TRUE(report("filled")["options"]["fill_holes"].get<bool>());
  EXPECT_GT(report("filled")["mesh"]["filled_vertices"].get<int>(), 100);
  EXPECT_NE(open.at("mesh.ply"), filled.at("mesh.ply"));
  const std::vector<std::string> again = {"--device", "cpu", "--quiet"};
  ASSERT_EQ(
      run("fuse", "filled", {"--device", "cpu", "--quiet", "--threads", "1", "--fill-holes", "--mask-below", "0.02"})
          .exit_code,
      0);
  expect_same_files(filled, results("filled"));
  ASSERT_EQ(run("fuse", "result", again).exit_code, 0);
  expect_same_files(open, results("result"));
}

TEST_F(Reconstruct, VulkanDeviceGivesTheSameBytesAsTheCpu) {
  const TestDevice device = find_test_device();
  if (device.request.empty()) {
    const char* required = std::getenv("QUORUM_REQUIRE_DEVICE");
    if (required != nullptr && std::string(required) == "1") FAIL() << device.problem;
    GTEST_SKIP() << device.problem;
  }
  const Files cpu = reconstruct("cpu", {"--device", "cpu"});
  expect_same_files(cpu, reconstruct("vulkan", {"--device", device.request}));
  EXPECT_NE(report("cpu")["device"], report("vulkan")["device"]);
  ASSERT_EQ(run("fuse", "cpu", {"--device", "cpu", "--fill-holes"}).exit_code, 0);
  ASSERT_EQ(run("fuse", "vulkan", {"--device", device.request, "--fill-holes"}).exit_code, 0);
  EXPECT_NE(results("cpu").at("mesh.ply"), cpu.at("mesh.ply"));
  expect_same_files(results("cpu"), results("vulkan"));
  EXPECT_FALSE(report("vulkan")["kernels"].empty());
}

TEST_F(Reconstruct, DepthThenFuseGivesTheSameBytes) {
  const Files whole = reconstruct("whole", {"--device", "cpu"});
  ASSERT_EQ(run("depth", "parts", {"--device", "cpu", "--quiet"}).exit_code, 0);
  EXPECT_FALSE(results("parts").contains("mesh.ply"));
  ASSERT_EQ(run("fuse", "parts", {"--device", "cpu", "--quiet"}).exit_code, 0);
  expect_same_files(whole, results("parts"));
}

TEST_F(Reconstruct, ABudgetIsKeptAndLeavesEveryByteAlone) {
  if (freed_memory_is_kept()) GTEST_SKIP() << "the sanitizer keeps freed memory";
  const std::vector<std::string> fine = {"--device", "cpu", "--voxel-size", "0.6mm"};  // 26 MiB of voxels
  const Files whole = reconstruct("whole", fine);
  ASSERT_EQ(report("whole")["volume"]["slabs"], 1);
  auto with_budget = fine;
  with_budget.insert(with_budget.end(), {"--quiet", "--memory", "1MiB"});
  const ProgramResult refused = run("reconstruct", "tight", with_budget);
  expect_failure(refused, 5, {"budget of 1 MiB", "give --memory "});
  // What the first stage needs at least; the others tell more if they need more.
  ProgramResult tight = refused;
  for (int attempt = 0; attempt < 3 && tight.exit_code == 5; ++attempt) {
    const std::size_t at = tight.err.find("give --memory ") + 14;
    with_budget.back() = tight.err.substr(at, tight.err.find('\n', at) - at);
    tight = run("reconstruct", "tight", with_budget);
  }
  ASSERT_EQ(tight.exit_code, 0) << tight.err;
  expect_same_files(whole, results("tight"));
  const auto tight_report = report("tight");
  EXPECT_LE(tight_report["peak_memory_bytes"].get<double>(), tight_report["memory_budget_bytes"].get<double>());
  EXPECT_GT(tight_report["volume"]["slabs"].get<int>(), 1);
}

TEST_F(Reconstruct, RunJsonTellsWhatWasDone) {
  const ProgramResult result =
      run("reconstruct", "result", {"--device", "cpu", "--quiet", "--json", "--threshold", "0.6"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(result.out, file_bytes(below("result") / "run.json"));

  const nlohmann::json json = report("result");
  ASSERT_FALSE(json.is_discarded()) << result.out;
  EXPECT_EQ("quorum " + json["version"].get<std::string>() + "\n", quorum_program({"--version"}).out);
  EXPECT_TRUE(json["device"].get<std::string>().starts_with("CPU"));
  EXPECT_EQ(json["options"]["threshold"], 0.6);
  EXPECT_EQ(json["options"]["depth_step"], "auto");
  EXPECT_EQ(json["scene"]["views"], 8);
  EXPECT_GT(json["volume"]["voxel_size"].get<double>(), 0.0);
  EXPECT_GT(json["volume"]["blocks"].get<int>(), 0);
  EXPECT_GT(json["peak_memory_bytes"].get<std::uint64_t>(), 1U << 20);
  EXPECT_GE(json["mesh"]["extracted_triangles"].get<int>(), json["mesh"]["triangles"].get<int>());
  std::vector<std::string> stages;
  for (const auto& stage : json["stages"]) {
    stages.push_back(stage["name"]);
    EXPECT_GE(stage["wall_seconds"].get<double>(), 0.0);
    EXPECT_GE(stage["cpu_seconds"].get<double>(), 0.0);
  }
  for (const std::string stage : {"sweep_depth", "collect_blocks", "integrate", "marching_cubes", "clean"})
    EXPECT_TRUE(std::ranges::count(stages, stage) == 1) << stage;
  ASSERT_EQ(json["depth_maps"].size(), 8U);
  for (const auto& view : json["depth_maps"]) {
    EXPECT_GE(view["neighbors"].size(), 2U);
    EXPECT_GT(view["valid_pixels"].get<int>(), 0);
    EXPECT_GE(view["swept_pixels"].get<int>(), view["valid_pixels"].get<int>());
    EXPECT_GE(view["depth_samples"].get<int>(), view["swept_pixels"].get<int>());
  }
}

TEST_F(Reconstruct, ProgressGoesToStandardErrorAndQuietSilencesIt) {
  const ProgramResult loud = run("depth", "result", {"--device", "cpu"});
  EXPECT_EQ(loud.exit_code, 0);
  EXPECT_EQ(loud.out, "");
  EXPECT_TRUE(contains(loud.err, "8 views, on CPU")) << loud.err;
  EXPECT_TRUE(contains(loud.err, "computing depth maps")) << loud.err;
  const ProgramResult quiet = run("depth", "result", {"--device", "cpu", "--quiet"});
  EXPECT_EQ(quiet.exit_code, 0);
  EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST_F(Reconstruct, ViewsWithoutTwoNeighborsAreNotedAndLeftOut) {
  // Four neighbors of the ring, 45 degrees apart: the outer two see one other view each within 60 degrees.
  std::string text = file_bytes(scene() / "temple_par.txt");
  std::size_t end = text.find('\n') + 1;
  const std::size_t begin = end;
  for (int line = 0; line < 4; ++line) end = text.find('\n', end) + 1;
  write_text(scene() / "temple_par.txt", "4\n" + text.substr(begin, end - begin));
  const ProgramResult result = run("depth", "result", {"--device", "cpu", "--max-angle", "60"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(contains(result.err, "temple0001: has 1 neighbor")) << result.err;
  EXPECT_TRUE(contains(result.err, "temple0004: has 1 neighbor")) << result.err;
  EXPECT_FALSE(std::filesystem::exists(below("result") / "depth" / "temple0001.depth.pfm"));
  EXPECT_TRUE(std::filesystem::exists(below("result") / "depth" / "temple0002.depth.pfm"));
  EXPECT_EQ(report("result")["depth_maps"].size(), 2U);
}

TEST_F(Reconstruct, SceneWithoutNeighborsIsRefused) {
  expect_failure(run("reconstruct", "result", {"--device", "cpu", "--max-angle", "10", "--quiet"}), 3,
                 {"two neighbor views", "--max-angle"});
  EXPECT_TRUE(results("result").empty());
}

TEST_F(Reconstruct, SigtermStopsTheRunAndLeavesNoHalfFile) {
  Program program(built_program("quorum"), {"reconstruct", scene().string(), "-o", below("result").string(), "--device",
                                            "cpu", "--threads", "1", "--step-pixels", "0.05", "--quiet"});
  const auto first = below("result") / "depth" / "temple0001.depth.pfm";
  for (int wait = 0; wait < 6000 && !std::filesystem::exists(first); ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ASSERT_TRUE(std::filesystem::exists(first));
  program.send(SIGTERM);
  expect_failure(program.wait(), 143, {"stopped"});
  const Files files = results("result");
  EXPECT_FALSE(files.contains("mesh.ply"));
  EXPECT_FALSE(std::filesystem::exists(below("result") / "run.json"));
  for (const auto& [name, bytes] : files) {
    EXPECT_FALSE(contains(name, ".tmp")) << name;
    if (!name.ends_with(".pfm")) continue;
    EXPECT_GT(bytes.size(), 160U * 120U * 4U) << name;
  }
}

TEST_F(Reconstruct, MeshIsNearTheTrueSurface) {
  std::filesystem::remove_all(scene());
  synthesize(16, 160);
  reconstruct("result", {"--device", "cpu"});
  const ProgramResult evaluated = quorum_program(
      {"evaluate", (below("result") / "mesh.ply").string(), (scene() / "gt.ply").string(), "--threshold", "4mm",
       "--samples", "20000", "--json", "--scene", scene().string(), "--workspace", below("result").string()});
  ASSERT_EQ(evaluated.exit_code, 0) << evaluated.err;
  const auto json = nlohmann::json::parse(evaluated.out, nullptr, false);
  ASSERT_FALSE(json.is_discarded()) << evaluated.out;
  EXPECT_LT(json["accuracy"].get<double>(), 0.004);
  EXPECT_GT(json["accuracy"].get<double>(), 0.0);
  EXPECT_GT(json["completeness"].get<double>(), 0.6);
  EXPECT_LT(json["seen_share"].get<double>(), 1.0);
  EXPECT_GT(json["missed"]["samples"].get<int>(), 10000);
  EXPECT_GT(json["missed"]["never_depth"].get<int>() + json["missed"]["wrong_depth"].get<int>(), 0);
}

TEST_F(Reconstruct, RenderDrawsTheMesh) {
  const std::string truth = (scene() / "gt.ply").string();
  std::vector<std::string> pictures;
  for (const std::string shading : {"shaded", "normal"}) {
    const auto picture = below(shading + ".png");
    const ProgramResult drawn = quorum_program({"render", truth, "--scene", scene().string(), "--view", "temple0002",
                                                "--shading", shading, "-o", picture.string()});
    EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
    pictures.push_back(file_bytes(picture));
    EXPECT_TRUE(pictures.back().starts_with("\x89PNG"));
    EXPECT_GT(pictures.back().size(), 2000U);
  }
  EXPECT_NE(pictures[0], pictures[1]);
}

TEST_F(Reconstruct, RenderByErrorDrawsTheTruthItselfInBlue) {
  const std::string truth = (scene() / "gt.ply").string();
  const auto picture = below("error.png");
  const ProgramResult drawn =
      quorum_program({"render", truth, "--scene", scene().string(), "--view", "temple0002", "--shading", "error",
                      "--truth", truth, "--full-error", "1mm", "-o", picture.string()});
  ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
  const ColorImage image = read_image(picture).value();
  const auto is_blue = [](Rgba pixel) { return blue_of(pixel) > red_of(pixel) + 100; };
  EXPECT_GT(std::ranges::count_if(image.values, is_blue), 1000);
  const auto is_red = [](Rgba pixel) { return red_of(pixel) > blue_of(pixel) + 50; };
  EXPECT_EQ(std::ranges::count_if(image.values, is_red), 0);
}

}  // namespace
}  // namespace quorum
