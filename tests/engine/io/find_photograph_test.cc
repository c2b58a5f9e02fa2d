#include "engine/io/find_photograph.h"

#include <gtest/gtest.h>

#include "tests/support/test_support.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

TEST(FindPhotograph, TakesEscapesForWhatTheyStandFor) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "my photos");
  const fs::path file = folder.path() / "my photos" / "a (1)ä.JPG";
  write_text(file, "");
  for (const char* name : {"my photos/a (1)ä.JPG", "my%20photos/a%20(1)%C3%A4.JPG", "my%20photos/a%20%281%29%c3%a4.jpg",
                           "my%20photos%5Ca%20(1)%C3%A4.JPG", "file:///C:/x/my%20photos/a%20(1)%C3%A4.JPG",
                           "/elsewhere/my%20photos/a (1)ä.JPG", "file:/my photos/a (1)ä.JPG"})
    EXPECT_EQ(find_photograph(folder.path(), name).lexically_normal(), file) << name;
  EXPECT_EQ(find_photograph_by_end(folder.path() / "my photos", "../images/a%20(1)%C3%A4.JPG"), file);
}

TEST(FindPhotograph, TakesANameAsItIsSaidFirst) {
  const TemporaryFolder folder;
  for (const char* name : {"a%20b.png", "a b.png", "50%.png", "%zz.png"}) write_text(folder.path() / name, "");
  for (const char* name : {"a%20b.png", "a b.png", "50%.png", "%zz.png"})
    EXPECT_EQ(find_photograph(folder.path(), name), folder.path() / name);
  EXPECT_EQ(find_photograph(folder.path(), "50%25.png"), folder.path() / "50%.png");
  EXPECT_EQ(find_photograph(folder.path(), "%25zz.png"), folder.path() / "%zz.png");
}

TEST(FindPhotograph, FindsNoneWhereNoneIs) {
  const TemporaryFolder folder;
  write_text(folder.path() / "a\nb.png", "");
  for (const char* name : {"", "%", "%2", "file:", "file:/", "%20", "a%0Ab.png", "a%00.png", "c%20d.png"}) {
    EXPECT_TRUE(find_photograph(folder.path(), name).empty()) << name;
    EXPECT_TRUE(find_photograph_by_end(folder.path(), name).empty()) << name;
  }
}

}  // namespace
}  // namespace quorum
