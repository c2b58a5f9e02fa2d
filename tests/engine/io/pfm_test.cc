#include "engine/io/pfm.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "engine/io/file.h"
#include "tests/engine/io/io_test.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

class PfmTest : public testing::Test {
 protected:
  Expected<Grid<float>> read_text(const std::string& text) {
    std::filesystem::remove(path_);  // some file systems flush a file that is overwritten, which takes milliseconds
    write_text(path_, text);
    return read_pfm(path_);
  }

  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "map.pfm";
};

Grid<float> counting_map(int width, int height) {
  Grid<float> map(width, height);
  for (std::size_t i = 0; i < map.values.size(); ++i) map.values[i] = static_cast<float>(i) * 0.75F - 3.0F;
  return map;
}

using Pfm = PfmTest;

TEST_F(Pfm, ReadsBackWhatWasWritten) {
  for (const auto& map :
       {counting_map(7, 5), counting_map(1, 1), counting_map(1, 9), Grid<float>(), counting_map(0, 3)}) {
    ASSERT_TRUE(write_pfm(path_, map));
    EXPECT_EQ(read_pfm(path_).value(), map);
  }
}

TEST_F(Pfm, KeepsValuesThatAreNotFinite) {
  Grid<float> map(3, 1);
  map.values = {std::numeric_limits<float>::infinity(), -0.0F, std::numeric_limits<float>::quiet_NaN()};
  ASSERT_TRUE(write_pfm(path_, map));
  const Grid<float> read = read_pfm(path_).value();
  for (int x = 0; x < 3; ++x)
    EXPECT_EQ(std::bit_cast<std::uint32_t>(read.at(x, 0)), std::bit_cast<std::uint32_t>(map.at(x, 0)));
}

TEST_F(Pfm, ThreeChannelsReadBackAndAreNotTakenForOne) {
  Grid<Eigen::Vector3f> map(5, 4, Eigen::Vector3f::Zero());
  for (std::size_t i = 0; i < map.values.size(); ++i) map.values[i] = {static_cast<float>(i), -1.5F, 0.25F};
  ASSERT_TRUE(write_pfm(path_, map));
  EXPECT_EQ(read_pfm_vectors(path_).value().values, map.values);
  expect_bad_input(read_pfm(path_), {"three channels"});
  ASSERT_TRUE(write_pfm(path_, counting_map(7, 5)));
  expect_bad_input(read_pfm_vectors(path_), {"one channel"});
  write_text(path_, std::string("PF\n1 1\n1.0\n\x3f\x80\0\0\x40\0\0\0\x40\x40\0\0", 23));
  EXPECT_EQ(read_pfm_vectors(path_).value().at(0, 0), Eigen::Vector3f(1, 2, 3)) << "big-endian";
}

TEST_F(Pfm, BottomRowComesFirst) {
  Grid<float> map(1, 2);
  map.at(0, 0) = 1.0F;
  map.at(0, 1) = 2.0F;
  ASSERT_TRUE(write_pfm(path_, map));
  EXPECT_EQ(read_file(path_).value(), std::string("Pf\n1 2\n-1.0\n\x00\x00\x00\x40\x00\x00\x80\x3f", 20));
}

TEST_F(Pfm, PositiveScaleMeansBigEndian) {
  const auto map = read_text(std::string("Pf\n1 2\n2.5\n\x40\x00\x00\x00\x3f\x80\x00\x00", 19));
  ASSERT_TRUE(map) << map.error().message;
  EXPECT_EQ(map->at(0, 0), 1.0F);
  EXPECT_EQ(map->at(0, 1), 2.0F);
}

TEST_F(Pfm, MalformedHeaderIsNamedWithItsLine) {
  expect_bad_input(read_text(""), {"map.pfm:1: expected Pf"});
  expect_bad_input(read_text("P5\n1 1\n255\nx"), {"map.pfm:1:", "\"P5\""});
  expect_bad_input(read_text("PF\n1 1\n-1\n123456789012"), {"map.pfm:1:", "three channels"});
  for (const char* size : {"1", "1 1 1", "-1 1", "1 x", "99999999999 1", ""})
    expect_bad_input(read_text(std::string("Pf\n") + size + "\n-1\n1234"), {"map.pfm:2: expected width and height"});
  for (const char* scale : {"0", "x", "nan", "", "1 2"})
    expect_bad_input(read_text(std::string("Pf\n1 1\n") + scale + "\n1234"), {"map.pfm:3: expected a scale"});
}

TEST_F(Pfm, SizeThatIsNotTheFilesIsRefusedBeforeAnyAllocation) {
  expect_bad_input(read_text("Pf\n1 1\n-1\n123"), {"map.pfm:2:", "take 4 bytes", "found 3"});
  expect_bad_input(read_text("Pf\n1 1\n-1\n12345"), {"take 4 bytes", "found 5"});
  expect_bad_input(read_text("Pf\n2147483647 2147483647\n-1\n1234"), {"take 18446744056529682436 bytes"});
  expect_bad_input(read_text("Pf\n32768 32768\n-1\n"), {"found 0"});
}

TEST_F(Pfm, AbsentFileIsNamed) { expect_bad_input(read_pfm(folder_.path() / "none.pfm"), {"none.pfm: cannot read"}); }

TEST_F(Pfm, AnyDamageEndsInAMapOfTheFilesSizeOrAnError) {
  ASSERT_TRUE(write_pfm(path_, counting_map(4, 3)));
  const std::string good = read_file(path_).value();
  int failures = 0;
  for (std::uint32_t seed = 0; seed < 3000; ++seed) {
    const std::string text = mutate(good, seed);
    const auto map = read_text(text);
    failures += map ? 0 : 1;
    EXPECT_LE(map ? map->values.size() * 4 : 0, text.size()) << "seed " << seed;
  }
  EXPECT_GT(failures, 1000);
  EXPECT_LT(failures, 3000);
}

}  // namespace
}  // namespace quorum
