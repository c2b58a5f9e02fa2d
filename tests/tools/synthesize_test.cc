// quorum synthesize: a scene that anyone can make again.
#include "tests/tools/tool_test.h"

namespace quorum {
namespace {

std::map<std::string, std::string> made_scene(const std::filesystem::path& folder,
                                              const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {"synthesize", folder.string(), "--views", "3", "--width", "64"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const ProgramResult result = quorum_program(arguments);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  return files_below(folder);
}

TEST(Synthesize, FolderHoldsPhotographsCamerasBoundsAndTruth) {
  const TemporaryFolder folder;
  const auto files = made_scene(folder.path() / "a");
  std::vector<std::string> names;
  for (const auto& [name, bytes] : files) {
    names.push_back(name);
    EXPECT_FALSE(bytes.empty()) << name;
  }
  EXPECT_EQ(names, (std::vector<std::string>{"README.txt", "gt.ply", "temple0001.png", "temple0002.png",
                                             "temple0003.png", "temple_par.txt"}));
}

TEST(Synthesize, SameSeedGivesTheSameBytes) {
  const TemporaryFolder folder;
  const auto first = made_scene(folder.path() / "a");
  EXPECT_EQ(first, made_scene(folder.path() / "b"));
  EXPECT_NE(first, made_scene(folder.path() / "c", {"--seed", "2"}));
}

TEST(Synthesize, HemisphereMovesTheCameras) {
  const TemporaryFolder folder;
  const auto ring = made_scene(folder.path() / "a");
  const auto hemisphere = made_scene(folder.path() / "b", {"--cameras", "hemisphere"});
  EXPECT_NE(ring.at("temple_par.txt"), hemisphere.at("temple_par.txt"));
  EXPECT_EQ(ring.at("gt.ply"), hemisphere.at("gt.ply"));
}

TEST(Synthesize, ATempleIsReplacedAndNothingElseIs) {
  const TemporaryFolder folder;
  const auto first = made_scene(folder.path() / "a");
  EXPECT_NE(made_scene(folder.path() / "a", {"--seed", "2"}), first);
  for (const char* name : {"README.txt", "gt.ply", "temple0002.png", "temple_par.txt"}) {
    const auto other = folder.path() / (std::string("of ") + name);
    std::filesystem::create_directories(other);
    write_text(other / name, "mine");
    expect_failure(quorum_program({"synthesize", other.string(), "--views", "3", "--width", "64"}), 3,
                   {name, "was not written by quorum", "choose another folder"});
    EXPECT_EQ(file_bytes(other / name), "mine");
  }
}

TEST(Synthesize, FolderBelowAFileIsRefused) {
  const TemporaryFolder folder;
  write_text(folder.path() / "file", "");
  expect_failure(quorum_program({"synthesize", (folder.path() / "file" / "scene").string()}), 3, {"file/scene"});
}

}  // namespace
}  // namespace quorum
