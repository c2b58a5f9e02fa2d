#include "engine/core/printable.h"

#include <gtest/gtest.h>

namespace quorum {
namespace {

TEST(Printable, OrdinaryTextStaysAsItIs) {
  EXPECT_EQ(printable(""), "");
  EXPECT_EQ(printable("a b.png"), "a b.png");
  EXPECT_EQ(printable("Türme/\xe5\xa1\x94.jpg \xf0\x9f\x97\xbc"), "Türme/\xe5\xa1\x94.jpg \xf0\x9f\x97\xbc");
}

TEST(Printable, EscapesAndLineEndsAreReplaced) {
  EXPECT_EQ(printable("te\x1b[31mple\n\r\t\x7f."), "te?[31mple????.");
  EXPECT_EQ(printable(std::string("a\0b", 3), '_'), "a_b");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "?31m")
      << "the 8-bit escape, in UTF-8";
  EXPECT_EQ(printable("\x9b"
                      "31m"),
            "?31m")
      << "and as a byte";
  EXPECT_EQ(printable("gpj.\xe2\x80\xae"), "gpj.?") << "text from right to left";
  EXPECT_EQ(printable("\xe2\x80\xa8"), "?");
}

TEST(Printable, BytesThatAreNoUtf8AreReplacedOneByOne) {
  EXPECT_EQ(printable("T\xfcrme"), "T?rme");
  EXPECT_EQ(printable("\xe5\xa1"), "??") << "cut off";
  EXPECT_EQ(printable("\xc0\xaf"), "??") << "longer than it has to be";
  EXPECT_EQ(printable("\xed\xa0\x80"), "???") << "half a pair";
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "????") << "beyond Unicode";
}

}  // namespace
}  // namespace quorum
