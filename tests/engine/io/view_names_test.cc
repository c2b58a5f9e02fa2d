#include "engine/io/view_names.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "engine/core/printable.h"
#include "tests/engine/io/io_test.h"

namespace quorum {
namespace {

std::vector<View> views_of(const std::vector<std::string>& image_names) {
  std::vector<View> views(image_names.size());
  for (std::size_t i = 0; i < views.size(); ++i) views[i].image_name = image_names[i];
  return views;
}

std::vector<std::string> names_of(const std::vector<std::string>& image_names) {
  std::vector<View> views = views_of(image_names);
  const auto named = name_views(views);
  EXPECT_TRUE(named) << named.error().message;
  std::vector<std::string> names;
  for (const View& view : views) names.push_back(view.name);
  return names;
}

using Names = std::vector<std::string>;

TEST(ViewNames, OrdinaryOnesAreThoseOfTheFiles) {
  EXPECT_EQ(names_of({"a.png", "left/1.png", "x.y.jpg", "no_extension"}),
            (Names{"a", "left_1", "x.y", "no_extension"}));
  EXPECT_EQ(names_of({"2.png", "2.jpg", "T\xc3\xbcr.jpg"}), (Names{"2.png", "2.jpg", "T\xc3\xbcr"}));
}

TEST(ViewNames, PathsThatLeaveTheirFolderAreCutToTheirFile) {
  EXPECT_EQ(names_of({"/home/me/a.png", "../../b.png", "C:\\photos\\c.jpg", "\\\\host\\d.jpg"}),
            (Names{"a", "b", "c", "d"}));
  EXPECT_EQ(names_of({"/home/left/1.png", "/home/right/1.png"}), (Names{"home_left_1", "home_right_1"}));
  EXPECT_EQ(names_of({"left\\1.png", "left/2.png"}), (Names{"left_1", "left_2"}));
}

TEST(ViewNames, AreUniqueAlsoWhereCaseDoesNotCount) {
  EXPECT_EQ(names_of({"a.jpg", "A.JPG", "a.png"}), (Names{"a.jpg", "A.JPG_2", "a.png"}));
  EXPECT_EQ(names_of({"left/1.png", "left_1.png", "LEFT_1.png"}),
            (Names{"left_1.png", "left_1.png_2", "LEFT_1.png_3"}));
  EXPECT_EQ(names_of({"a.png", "A.png", "a_2.png"})[2], "a_2") << "its own name stays its own";
}

TEST(ViewNames, WhatNoFileShouldBeCalledIsReplaced) {
  EXPECT_EQ(names_of({".hidden.png", "a\x1b[31m.png", "T\xfcr.png", "..", "/"}),
            (Names{"hidden", "a_[31m", "T_r", "view", "view_2"}));
  const Names names = names_of({std::string(300, 'x') + "1.png", std::string(300, 'x') + "2.png"});
  EXPECT_LE(names[0].size(), 100U);
  EXPECT_TRUE(names[0].ends_with("x1"));
  EXPECT_NE(names[0], names[1]);
}

TEST(ViewNames, OneImageTwiceIsRefused) {
  std::vector<View> views = views_of({"a.png", "b.png", "a.png"});
  expect_bad_input(name_views(views), {"\"a.png\" comes twice"});
}

TEST(ViewNames, AreGoodForFilesWhateverTheLabels) {
  std::mt19937 random(5);
  for (int round = 0; round < 300; ++round) {
    std::set<std::string> labels;
    while (labels.size() < 12) {
      std::string label;
      const char* pieces[] = {"a", "A", "/", "\\", ".", "..", "b.png", "\x1b", "\xff", "\xc3\xbc", " ", "_2", "C:"};
      for (std::size_t i = 1 + random() % 6; i > 0; --i) label += pieces[random() % std::size(pieces)];
      if (random() % 20 == 0) label += std::string(200, 'l') + label;
      labels.insert(label);
    }
    std::set<std::string> seen;
    for (const std::string& name : names_of({labels.begin(), labels.end()})) {
      EXPECT_TRUE(seen.insert(folded(name)).second) << name;
      EXPECT_FALSE(name.empty() || name.starts_with('.') || name.size() > 100) << name;
      EXPECT_EQ(name.find_first_of("/\\"), std::string::npos) << name;
      EXPECT_EQ(printable(name), name);
    }
  }
}

TEST(ViewNames, PlainPathsStayBelowTheirFolder) {
  for (const char* plain : {"a.png", "left/1.png", "my photos/a b.jpg", "T\xc3\xbcr"})
    EXPECT_TRUE(is_plain_path(plain)) << plain;
  for (const char* other : {"", "/a", "../a", "a/../b", "a//b", "./a", "a/.b", "a\\b", "a\n", "C:/a", "\xff", "a/"})
    EXPECT_FALSE(is_plain_path(other)) << other;
  EXPECT_FALSE(is_plain_path(std::string(150, 'a')));
}

}  // namespace
}  // namespace quorum
