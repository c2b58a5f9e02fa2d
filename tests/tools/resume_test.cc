// A workspace knows what it was made from: what fits is kept, what does not is made anew or refused.
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/tools/tool_test.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

class Resume : public ToolTest {
 protected:
  void SetUp() override { synthesize(8, 96); }

  std::vector<std::string> command(const std::string& name, const std::string& output,
                                   const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {name,  scene().string(), "-o", below(output).string(), "--device",
                                          "cpu", "--quiet"};
    if (name != "depth") arguments.insert(arguments.end(), {"--min-component", "0"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  Files run(const std::string& name, const std::string& output, const std::vector<std::string>& more = {}) {
    const ProgramResult result = quorum_program(command(name, output, more));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return results(output);
  }
  /// Everything that a run leaves but run.json, which tells times.
  Files results(const std::string& output) {
    Files files = files_below(below(output));
    files.erase("run.json");
    return files;
  }
  nlohmann::json report(const std::string& output) {
    return nlohmann::json::parse(file_bytes(below(output) / "run.json"), nullptr, false);
  }
  int kept(const std::string& output) { return report(output)["kept_depth_maps"].get<int>(); }
  fs::path map(const std::string& output, const std::string& file) { return below(output) / "depth" / file; }
};

TEST_F(Resume, TheSameRunAgainKeepsEveryDepthMapAndEndsInTheSameBytes) {
  const Files first = run("reconstruct", "result");
  EXPECT_EQ(kept("result"), 0);
  const auto time = fs::last_write_time(map("result", "temple0003.depth.pfm"));
  expect_same_files(first, run("reconstruct", "result"));
  EXPECT_EQ(kept("result"), 8);
  EXPECT_EQ(report("result")["kept_certainties"], 8);
  EXPECT_TRUE(report("result")["depth_maps"].empty());
  EXPECT_EQ(fs::last_write_time(map("result", "temple0003.depth.pfm")), time);
  expect_same_files(first, run("reconstruct", "result", {"--restart"}));
  EXPECT_EQ(kept("result"), 0);
}

TEST_F(Resume, OptionsRedoTheStagesThatTheyChange) {
  run("reconstruct", "result");
  run("reconstruct", "result", {"--min-confidence", "0.02"});
  EXPECT_EQ(kept("result"), 8);
  EXPECT_EQ(report("result")["kept_certainties"], 8);
  const Files slope = run("reconstruct", "result", {"--max-slope", "60"});
  EXPECT_EQ(kept("result"), 8);
  EXPECT_EQ(report("result")["kept_certainties"], 0);
  expect_same_files(slope, run("reconstruct", "other", {"--max-slope", "60"}));
  const Files window = run("reconstruct", "result", {"--window", "7"});
  EXPECT_EQ(kept("result"), 0);
  expect_same_files(window, run("reconstruct", "other", {"--window", "7", "--restart"}));
  // What changes no result changes no work either.
  run("reconstruct", "result", {"--window", "7", "--threads", "1", "--tile", "16", "4"});
  EXPECT_EQ(kept("result"), 8);
}

TEST_F(Resume, AnotherPhotographMaskOrBoxRedoesTheViewsThatUseIt) {
  run("depth", "result", {"--neighbors", "2"});
  fs::copy_file(scene() / "temple0002.png", scene() / "temple0001.png", fs::copy_options::overwrite_existing);
  const Files changed = run("depth", "result", {"--neighbors", "2"});
  EXPECT_GT(kept("result"), 0);
  EXPECT_LT(kept("result"), 8);
  EXPECT_EQ(report("result")["depth_maps"].size(), static_cast<std::size_t>(8 - kept("result")));
  expect_same_files(changed, run("depth", "other", {"--neighbors", "2"}));
  run("depth", "result", {"--neighbors", "2", "--bounds", "0 -0.05 -0.05 0.05 0.05 0.05"});
  EXPECT_EQ(kept("result"), 0);
}

TEST_F(Resume, AfterAKillOnlyTheRestIsDone) {
  const Files whole = run("reconstruct", "whole");
  for (const int view : {1, 4, 8}) {
    fs::remove_all(below("result"));
    Program program(built_program("quorum"), command("reconstruct", "result"));
    const fs::path record = map("result", "temple000" + std::to_string(view) + ".depth.json");
    for (int wait = 0; wait < 60'000 && !fs::exists(record); ++wait)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    program.send(SIGKILL);
    program.wait();
    expect_same_files(whole, run("reconstruct", "result"));
    EXPECT_GE(kept("result"), view);
    EXPECT_EQ(report("result")["depth_maps"].size(), static_cast<std::size_t>(8 - kept("result")));
  }
}

TEST_F(Resume, LeftOversOfKilledRunsAreSwept) {
  const Files whole = run("reconstruct", "result");
  for (const fs::path& folder : {below("result"), below("result") / "depth"})
    std::ofstream(folder / ".quorum-4194000-3.tmp") << "left";
  std::ofstream(below("result") / ".quorum-lookalike.txt") << "kept";
  Files expected = whole;
  expected[".quorum-lookalike.txt"] = "kept";
  expect_same_files(expected, run("reconstruct", "result"));
}

TEST_F(Resume, FuseRefusesMapsOfMixedOptions) {
  run("reconstruct", "result");
  run("depth", "other", {"--window", "7"});
  for (const auto& entry : fs::directory_iterator(below("other") / "depth"))
    if (entry.path().filename().string().starts_with("temple0003."))
      fs::copy_file(entry.path(), map("result", entry.path().filename()), fs::copy_options::overwrite_existing);
  expect_failure(quorum_program(command("fuse", "result")), 3,
                 {"temple0003", "window 7", "temple0001", "with 5", "run `quorum depth`"});
  expect_same_files(run("reconstruct", "whole"), run("reconstruct", "result"));
  EXPECT_EQ(kept("result"), 7);
}

TEST_F(Resume, FuseRefusesMapsOfAnotherSceneOrOfNone) {
  run("depth", "result");
  const std::string cameras = file_bytes(scene() / "temple_par.txt");
  const std::size_t last_number = cameras.find_last_of(' ', cameras.find_last_of("0123456789")) + 1;
  const std::string moved = cameras.substr(0, last_number) + "0.55\n";  // the last camera
  write_text(scene() / "temple_par.txt", moved);
  expect_failure(quorum_program(command("fuse", "result")), 3, {"camera", "run `quorum depth`"});
  write_text(scene() / "temple_par.txt", cameras);
  run("fuse", "result");
  fs::copy_file(scene() / "temple0005.png", scene() / "temple0006.png", fs::copy_options::overwrite_existing);
  expect_failure(quorum_program(command("fuse", "result")), 3, {"photograph", "run `quorum depth`"});
  write_text(map("result", "temple0001.depth.json"), "[]");
  expect_failure(quorum_program(command("fuse", "result")), 3, {"temple0001", "does not say", "run `quorum depth`"});
}

TEST_F(Resume, FuseTakesTheOptionsOfTheDepthMaps) {
  const std::vector<std::string> options = {"--max-angle", "70", "--window", "7", "--no-slant", "--depth-step", "4mm"};
  const Files whole = run("reconstruct", "whole", options);
  run("depth", "parts", options);
  expect_same_files(whole, run("fuse", "parts"));
  EXPECT_EQ(report("whole")["options"], report("parts")["options"]);
}

TEST_F(Resume, StatusTellsWhatIsThereAndWhatIsMissing) {
  run("reconstruct", "result");
  const ProgramResult whole = quorum_program({"status", below("result").string()});
  EXPECT_EQ(whole.exit_code, 0) << whole.err;
  for (const std::string part : {"done", "depth maps   8", "all made with", "window 5", "mesh.ply"})
    EXPECT_TRUE(contains(whole.out, part)) << part << " is not in: " << whole.out;
  fs::remove(map("result", "temple0003.depth.json"));
  fs::remove(below("result") / "run.json");
  const ProgramResult part = quorum_program({"status", below("result").string()});
  for (const std::string said : {"not finished", "depth maps   7", "missing      temple0003"})
    EXPECT_TRUE(contains(part.out, said)) << said << " is not in: " << part.out;
  expect_failure(quorum_program({"status", below("none").string()}), 3, {below("none").string(), "check the path"});
}

TEST_F(Resume, NoOlderMeshStandsBesideAFailedRun) {
  run("reconstruct", "result", {"--cloud"});
  ASSERT_TRUE(fs::exists(below("result") / "mesh.ply"));
  const ProgramResult failed =
      quorum_program(command("reconstruct", "result", {"--window", "7"}), {.file_size_limit = 20 << 10});
  expect_failure(failed, 3, {"cannot write"});
  for (const std::string name : {"mesh.ply", "fused.ply", "run.json"})
    EXPECT_FALSE(fs::exists(below("result") / name)) << name;
}

TEST_F(Resume, ASecondRunInTheSameFolderIsRefusedAndNamesTheFirst) {
  Program first(built_program("quorum"), command("reconstruct", "result", {"--threads", "1", "--step-pixels", "0.05"}));
  for (int wait = 0; wait < 1000 && !fs::exists(below("result") / ".quorum.lock"); ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  char host[256] = "";
  ASSERT_EQ(::gethostname(host, sizeof(host) - 1), 0);
  for (const std::string name : {"reconstruct", "depth", "fuse"})
    expect_failure(quorum_program(command(name, "result")), 3,
                   {below("result").string(), "another run works here", "quorum reconstruct, process ", host});
  first.send(SIGKILL);
  first.wait();
  EXPECT_TRUE(fs::exists(below("result") / ".quorum.lock"));
  run("reconstruct", "result");
  EXPECT_FALSE(fs::exists(below("result") / ".quorum.lock"));
}

}  // namespace
}  // namespace quorum
