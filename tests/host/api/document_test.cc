// What docs/library.md shows is what is compiled.
#include "tests/host/api/api_scene.h"

namespace quorum {
namespace {

TEST(ApiDocument, ShowsTheExamplesAsTheyAre) {
  const std::filesystem::path docs = source_folder() / "docs";
  const std::string page = file_bytes(docs / "library.md");
  for (const char* example : {"ball.cc", "folder.cc", "CMakeLists.txt"}) {
    const std::string code = file_bytes(docs / "examples" / example);
    ASSERT_FALSE(code.empty()) << example;
    EXPECT_TRUE(contains(page, "\n" + code + "```\n")) << "docs/library.md does not show " << example << " as it is";
  }
}

}  // namespace
}  // namespace quorum
