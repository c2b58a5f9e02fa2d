#include "engine/io/text.h"

#include <gtest/gtest.h>

namespace quorum {
namespace {

using Tokens = std::vector<std::string_view>;

TEST(SplitTokens, SpacesTabsAndCarriageReturnsSeparate) {
  EXPECT_EQ(split_tokens("a.png 1\t -2.5\r"), (Tokens{"a.png", "1", "-2.5"}));
  EXPECT_EQ(split_tokens("one"), Tokens{"one"});
  EXPECT_EQ(split_tokens(""), Tokens());
  EXPECT_EQ(split_tokens(" \t\r"), Tokens());
}

TEST(ParseNumber, TakesTheWholeTokenOrNothing) {
  EXPECT_EQ(parse_number<double>("-1.5e-3"), -1.5e-3);
  EXPECT_EQ(parse_number<int>("47"), 47);
  for (const char* token : {"", "1.5x", "x", "1,5", " 1", "1 ", "--1", "0x10"})
    EXPECT_FALSE(parse_number<double>(token)) << token;
  EXPECT_FALSE(parse_number<int>("1.5"));
  EXPECT_FALSE(parse_number<int>("2147483648"));
  EXPECT_FALSE(parse_number<std::uint64_t>("-1"));
}

TEST(LineReader, CountsLinesOfBothEndings) {
  LineReader lines("a\r\n\nb\n  \r\nc");
  EXPECT_EQ(lines.next(), "a");
  EXPECT_EQ(lines.position(), 3U);
  EXPECT_EQ(lines.next_filled(), "b");
  EXPECT_EQ(lines.number(), 3);
  EXPECT_EQ(lines.next_filled(), "c");
  EXPECT_EQ(lines.number(), 5);
  EXPECT_EQ(lines.position(), 11U);
  EXPECT_EQ(lines.next(), std::nullopt);
  EXPECT_EQ(lines.next_filled(), std::nullopt);
}

TEST(LineReader, EmptyTextHasNoLine) {
  EXPECT_EQ(LineReader("").next(), std::nullopt);
  EXPECT_EQ(LineReader("\n").next(), "");
}

TEST(QuoteToken, ShowsNothingThatBreaksTheLine) {
  EXPECT_EQ(quote_token("k11"), "\"k11\"");
  EXPECT_EQ(quote_token("a\nb\x01\xff"), "\"a?b??\"");
  EXPECT_EQ(quote_token(std::string(100, 'x')), '"' + std::string(40, 'x') + "...\"");
}

}  // namespace
}  // namespace quorum
