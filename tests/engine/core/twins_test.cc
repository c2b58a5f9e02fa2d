// The arithmetic is written once in GLSL and once in C++ (docs/architecture.md): in files of the same stem, each of
// which names the other in its opening lines.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace quorum {
namespace {

namespace fs = std::filesystem;

/// Files that have no twin of their own, and why.
const std::map<std::string, std::string> kExceptions = {
    {"shaders/measure_operations.comp", "has no result: only its time counts"},
    {"shaders/lib/pixel_tile.glsl", "fills shared memory, and computes nothing"},
    {"shaders/lib/vote_for_block.glsl", "what vote_depth and vote_depth_lanes share; they name the twin"},
};

fs::path source_folder() { return fs::path(__FILE__).parent_path() / "../../.."; }

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// The comment that a file opens with, in one line.
std::string opening_of(const fs::path& path) {
  std::ifstream file(path);
  std::string opening;
  for (std::string line; std::getline(file, line) && line.starts_with("//");) opening += line.substr(2);
  return opening;
}

/// Paths of files below a folder of the sources, from their root: those whose names end so.
std::set<std::string> files_of(const std::string& folder, const std::string& ending, bool with_folders) {
  std::set<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(source_folder() / folder)) {
    const std::string path = entry.path().lexically_relative(source_folder()).generic_string();
    const bool is_below = fs::path(path).parent_path() != folder;
    if (path.ends_with(ending) && (with_folders || !is_below)) files.insert(path);
  }
  return files;
}

/// The file of engine/ with this stem; empty if there is none.
std::string engine_file(const std::string& stem, const std::string& ending) {
  for (const std::string& path : files_of("engine", "/" + stem + ending, true)) return path;
  return "";
}

/// Forms for software Vulkan share the twin of the form for GPUs.
std::string stem_of_twin(const std::string& path) {
  const std::string stem = fs::path(path).stem().string();
  return stem.ends_with("_lanes") ? stem.substr(0, stem.size() - 6) : stem;
}

TEST(Twins, EveryFileOfKernelsHasAHeaderThatNamesIt) {
  const std::set<std::string> files = files_of("shaders/lib", ".glsl", false);
  EXPECT_GE(files.size(), 9U);
  for (const std::string& path : files) {
    if (kExceptions.contains(path)) continue;
    const std::string twin = engine_file(stem_of_twin(path), ".h");
    ASSERT_NE(twin, "") << path << " has no twin: no header of that name in engine/";
    EXPECT_NE(opening_of(source_folder() / path).find("Twin: " + twin), std::string::npos)
        << path << " does not open with \"Twin: " << twin << "\"";
    EXPECT_NE(opening_of(source_folder() / twin).find("Twin: " + path), std::string::npos)
        << twin << " does not open with \"Twin: " << path << "\"";
  }
}

TEST(Twins, EveryKernelHasOneAndATestOfParity) {
  const std::set<std::string> kernels = files_of("shaders", ".comp", false);
  EXPECT_GE(kernels.size(), 13U);
  for (const std::string& path : kernels) {
    if (kExceptions.contains(path)) continue;
    const std::string stem = stem_of_twin(path);
    const std::string twin = engine_file(stem, ".cc");
    ASSERT_NE(twin, "") << path << " has no twin: no source of that name in engine/";
    const std::string folder = fs::path(twin).parent_path().generic_string() + "/";
    EXPECT_NE(opening_of(source_folder() / path).find(folder + stem + "."), std::string::npos)
        << path << " does not open with its twin, " << twin;
    EXPECT_NE(opening_of(source_folder() / (folder + stem + ".h")).find("shaders/" + stem + ".comp"), std::string::npos)
        << folder << stem << ".h does not open with its twin, shaders/" << stem << ".comp";
    const std::string test = "tests/parity/" + fs::path(path).stem().string() + "_test.cc";
    EXPECT_TRUE(fs::exists(source_folder() / test)) << path << " is compared with its twin nowhere: no " << test;
  }
}

TEST(Twins, ExceptionsAreStillThere) {
  for (const auto& [path, reason] : kExceptions) EXPECT_TRUE(fs::exists(source_folder() / path)) << path;
}

TEST(Twins, EveryFileThatASourceNamesExists) {
  const std::regex name("(engine|host|shaders|tests)/[a-z_/]*[a-z_]\\.(h|cc|glsl|comp)\\b");
  int names = 0;
  for (const char* folder : {"engine", "host", "shaders"}) {
    for (const char* ending : {".h", ".cc", ".glsl", ".comp"}) {
      for (const std::string& path : files_of(folder, ending, true)) {
        const std::string text = text_of(source_folder() / path);
        for (std::sregex_iterator match(text.begin(), text.end(), name), end; match != end; ++match, ++names)
          EXPECT_TRUE(fs::exists(source_folder() / match->str())) << path << " names " << match->str();
      }
    }
  }
  EXPECT_GT(names, 500);
}

}  // namespace
}  // namespace quorum
