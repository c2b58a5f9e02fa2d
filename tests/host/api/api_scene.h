// Scenes for tests of the library.
#pragma once

#include <quorum/quorum.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "tests/tools/tool_test.h"

namespace quorum {

/// Arrays with the pixels that they point to.
struct OwnedArrays {
  std::vector<std::vector<std::uint8_t>> pixels;  ///< of a view each
  v0::SceneArrays arrays;
};

/// The photographs of a scene as arrays of color, with its cameras and its box. Rows of some are padded, the channels
/// of others are in OpenCV's order.
OwnedArrays arrays_of(const v0::Scene& scene, const std::filesystem::path& folder);

/// Three gray photographs of one pixel value, 16 x 12, side by side, which any check of arrays takes.
OwnedArrays flat_arrays();

/// Runs of a scene that the program has made, with options that keep the little surface of few pixels.
class ApiReconstruct : public ToolTest {
 protected:
  static v0::Options options() {
    v0::Options options;
    options.set("device", "cpu").set("maps", "all").set("min-component", 0).set("min-confidence", 0);
    return options;
  }

  v0::Scene read() const {
    auto read = v0::Scene::read(scene());
    if (!read) throw std::runtime_error(read.error().message);
    return *read;
  }

  /// What the program makes of the scene with the same options. more: of its own.
  void run_program(const std::string& output, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {
        "reconstruct", scene().string(),  "-o", below(output).string(), "--quiet", "--device", "cpu", "--maps",
        "all",         "--min-component", "0",  "--min-confidence",     "0"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = quorum_program(arguments);
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
};

/// The line of a failure of this kind holds all of the parts.
template <typename Value>
void expect_error(const v0::Result<Value>& result, v0::ErrorKind kind, const std::vector<std::string>& parts) {
  ASSERT_FALSE(result);
  EXPECT_EQ(static_cast<int>(result.error().kind), static_cast<int>(kind)) << result.error().message;
  EXPECT_EQ(result.error().message.find('\n'), std::string::npos) << result.error().message;
  for (const std::string& part : parts)
    EXPECT_TRUE(contains(result.error().message, part)) << part << " is not in: " << result.error().message;
}

}  // namespace quorum
