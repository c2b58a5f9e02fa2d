// What the tests of the command line share.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/support/run_program.h"

namespace quorum {

/// Keeps the little surface that scenes of few pixels give.
const std::vector<std::string> kKeepAll = {"--min-component", "0", "--min-confidence", "0"};

/// Runs the program under test.
inline ProgramResult quorum_program(const std::vector<std::string>& arguments, const ProgramSetting& setting = {}) {
  return Program(built_program("quorum"), arguments, setting).wait();
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// The failure is one line with all of the parts, on standard error alone.
inline void expect_failure(const ProgramResult& result, int exit_code, const std::vector<std::string>& parts) {
  EXPECT_EQ(result.exit_code, exit_code) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
  EXPECT_TRUE(result.err.ends_with('\n'));
  for (const std::string& part : parts) EXPECT_TRUE(contains(result.err, part)) << part << " is not in: " << result.err;
}

/// Files: their relative paths and their bytes.
using Files = std::map<std::string, std::string>;

/// Every regular file below a folder.
inline Files files_below(const std::filesystem::path& folder) {
  Files files;
  if (!std::filesystem::is_directory(folder)) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[std::filesystem::relative(entry.path(), folder).string()] = file_bytes(entry.path());
  return files;
}

inline void expect_same_files(const Files& expected, const Files& found) {
  EXPECT_EQ(expected.size(), found.size());
  for (const auto& [name, bytes] : expected) {
    ASSERT_TRUE(found.contains(name)) << name;
    const std::string& other = found.at(name);
    const auto difference = std::ranges::mismatch(bytes, other).in1 - bytes.begin();
    EXPECT_TRUE(bytes == other) << name << ": " << bytes.size() << " and " << other.size()
                                << " bytes, the first difference at " << difference;
  }
}

/// A test with a folder of its own, in which the program itself makes a scene.
class ToolTest : public testing::Test {
 protected:
  /// A temple seen from a ring of views. width: of the photographs, pixels.
  void synthesize(int views, int width) {
    const ProgramResult made = quorum_program(
        {"synthesize", scene().string(), "--views", std::to_string(views), "--width", std::to_string(width)});
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }
  [[nodiscard]] std::filesystem::path scene() const { return folder_.path() / "scene"; }
  [[nodiscard]] std::filesystem::path below(const std::string& name) const { return folder_.path() / name; }

 private:
  TemporaryFolder folder_;
};

}  // namespace quorum
