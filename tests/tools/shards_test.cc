// Shards of a run: any number, in any order, also again, end in the bytes of one run.
#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include "tests/support/sanitizer.h"
#include "tests/tools/tool_test.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

class Shards : public ToolTest {
 protected:
  void SetUp() override { synthesize(8, 96); }

  Words command(const std::string& name, const Words& more = {}, const std::string& output = "shards") {
    Words words = {name, scene().string(), "-o", below(output).string(), "--device", "cpu", "--quiet"};
    if (name == "reconstruct" || name == "join") words.insert(words.end(), {"--min-component", "0"});
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  void run(const std::string& name, const Words& more = {}, const std::string& output = "shards") {
    const ProgramResult result = quorum_program(command(name, more, output));
    ASSERT_EQ(result.exit_code, 0) << name << ": " << result.err;
  }
  /// indices: from 1 on.
  void run_shards(const std::string& name, const std::vector<int>& indices, int count, const Words& more = {}) {
    for (const int index : indices) {
      Words words = more;
      words.insert(words.end(), {"--shard", std::to_string(index) + "/" + std::to_string(count)});
      run(name, words);
    }
  }
  /// Mesh, depth maps, certainties and their records.
  Files results(const std::string& output) {
    Files files = files_below(below(output));
    std::erase_if(files, [](const auto& file) {
      return file.first == "run.json" || file.first.starts_with("shards/") || file.first == ".quorum.lock";
    });
    return files;
  }
  void expect_same_results(const std::string& expected, const std::string& found) {
    const Files one = results(expected);
    const Files other = results(found);
    EXPECT_EQ(one.size(), other.size());
    EXPECT_TRUE(one.contains("mesh.ply"));
    for (const auto& [name, bytes] : one) EXPECT_TRUE(other.contains(name) && other.at(name) == bytes) << name;
  }
};

TEST_F(Shards, AnyOrderAndRerunsEndInTheBytesOfOneRun) {
  run("reconstruct", {}, "whole");
  run_shards("depth", {3, 1, 3, 2}, 3);
  run_shards("confirm", {2, 3, 1, 1}, 3);
  run_shards("fuse", {3, 2, 1, 2}, 3);
  run("join");
  expect_same_results("whole", "shards");
  EXPECT_FALSE(fs::exists(below("shards") / ".quorum.lock"));
  run("join");  // and once more
  expect_same_results("whole", "shards");
}

TEST_F(Shards, MoreShardsThanViewsAndAnotherNumberAtEachStage) {
  run("reconstruct", {}, "whole");
  run_shards("depth", {5, 11, 2, 9, 1, 4, 10, 3, 8, 7, 6}, 11);
  run_shards("confirm", {1}, 1);
  run_shards("fuse", {2, 1}, 2, {"--memory", freed_memory_is_kept() ? "1GiB" : "80MiB"});
  run_shards("fuse", {2, 4, 3, 5, 1}, 5);
  run("join");
  expect_same_results("whole", "shards");
}

TEST_F(Shards, OptionsOfEachStageReachTheMesh) {
  const Words depth = {"--window", "7", "--mask-below", "0.1"};
  const Words fuse = {"--fill-holes", "--voxel-size", "3mm", "--weights", "confidence,border"};
  Words all = depth;
  all.insert(all.end(), fuse.begin(), fuse.end());
  all.insert(all.end(), {"--cloud", "--no-confirm"});
  run("reconstruct", all, "whole");
  run_shards("depth", {1, 2}, 2, depth);
  run_shards("confirm", {1, 2}, 2, {"--no-confirm"});
  Words no_confirm = fuse;
  no_confirm.insert(no_confirm.end(), {"--no-confirm", "--mask-below", "0.1"});
  run_shards("fuse", {1, 2, 3}, 3, no_confirm);
  run("join", {"--cloud"});
  expect_same_results("whole", "shards");
}

TEST_F(Shards, MissingDepthMapsAndCertaintiesAreNamed) {
  run_shards("depth", {1, 3}, 3);
  expect_failure(quorum_program(command("confirm", {"--shard", "1/3"})), 3,
                 {below("shards").string(), "the depth map of temple000", "is missing", "quorum depth"});
  run_shards("depth", {2}, 3);
  run_shards("confirm", {2, 3}, 3);
  expect_failure(quorum_program(command("fuse", {"--shard", "1/2"})), 3,
                 {"the certainty of temple0001", "is missing", "quorum confirm"});
  run_shards("confirm", {1}, 3);
  expect_failure(quorum_program(command("join")), 3, {"holds no part of a surface", "quorum fuse", "--shard"});
  run_shards("fuse", {2}, 2);
  expect_failure(quorum_program(command("join")), 3, {"1 of 2 parts", "quorum fuse --shard 1/2"});
}

TEST_F(Shards, PartsOfOtherDepthMapsOrBrokenOnesAreRefused) {
  run("depth");
  run("confirm");
  run_shards("fuse", {1, 2}, 2);
  const fs::path part = below("shards") / "shards" / "fuse-2-of-2.part";
  const std::string whole = file_bytes(part);
  write_text(part, whole.substr(0, whole.size() - 1));
  expect_failure(quorum_program(command("join")), 3, {"fuse-2-of-2.part", "not whole", "quorum fuse"});
  write_text(part, whole);
  fs::remove(below("shards") / "depth" / "temple0003.depth.json");
  expect_failure(quorum_program(command("join")), 3,
                 {"fuse-1-of-2.part", "other depth maps", "quorum fuse --shard 1/2"});
  EXPECT_FALSE(fs::exists(below("shards") / "mesh.ply"));
}

TEST_F(Shards, WrongShardsAndOptionsOfTheLastStepAreRefused) {
  for (const std::string wrong : {"0/3", "4/3", "3", "1/0", "x/y", "-1/3", "1/10001"})
    expect_failure(quorum_program(command("depth", {"--shard", wrong})), 2, {"--shard " + wrong, "1/N to N/N"});
  expect_failure(quorum_program(command("depth", {"--shard", "1/2", "--colmap"})), 2, {"quorum join"});
  expect_failure(quorum_program(command("fuse", {"--shard", "1/2", "--largest-component"})), 2, {"quorum join"});
  EXPECT_EQ(quorum_program(command("reconstruct", {"--shard", "1/2"})).exit_code, 2);
}

TEST_F(Shards, WorkAtOnceButNoneTwiceAndNoneBesideARun) {
  synthesize(8, 240);  // so that the first takes a while
  Program first(built_program("quorum"),
                command("depth", {"--threads", "1", "--step-pixels", "0.05", "--shard", "1/2"}));
  const fs::path lock = below("shards") / "shards" / "depth-1-of-2.lock";
  for (int wait = 0; wait < 1000 && !fs::exists(lock); ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  expect_failure(quorum_program(command("depth", {"--shard", "1/2"})), 3,
                 {"another run works here", "quorum depth, process", "shard 1/2"});
  expect_failure(quorum_program(command("reconstruct")), 3, {"another run works here", "shard 1/2"});
  run("depth", {"--shard", "2/2"});
  const ProgramResult status = quorum_program({"status", below("shards").string()});
  EXPECT_TRUE(contains(status.out, "1 shards work")) << status.out;
  EXPECT_TRUE(contains(status.out, "shard 1/2")) << status.out;
  EXPECT_TRUE(contains(status.out, "depth: 1 of 2 (missing: 1/2)")) << status.out;
  first.send(SIGKILL);
  first.wait();
  run("depth", {"--shard", "1/2"});
}

}  // namespace
}  // namespace quorum
