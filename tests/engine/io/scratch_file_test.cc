#include "engine/io/scratch_file.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>

#include "tests/support/test_support.h"

namespace quorum {
namespace {

std::string read_back(const ScratchFile& file, std::uint64_t offset, std::size_t count) {
  std::string bytes(count, '.');
  EXPECT_TRUE(file.read(offset, bytes));
  return bytes;
}

TEST(ScratchFile, GivesBackWhatWasWritten) {
  const TemporaryFolder folder;
  const ScratchFile file = ScratchFile::create(folder.path()).value();
  ASSERT_TRUE(file.write(100, "second"));
  ASSERT_TRUE(file.write(0, "first"));
  EXPECT_EQ(read_back(file, 100, 6), "second");
  EXPECT_EQ(read_back(file, 0, 5), "first");
  EXPECT_EQ(read_back(file, 102, 2), "co");
  ASSERT_TRUE(file.write(100, "other"));
  EXPECT_EQ(read_back(file, 100, 6), "otherd");
}

TEST(ScratchFile, HasNoName) {
  const TemporaryFolder folder;
  const ScratchFile file = ScratchFile::create(folder.path()).value();
  ASSERT_TRUE(file.write(0, "bytes"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(ScratchFile, WhatWasNotWrittenIsAFailure) {
  const TemporaryFolder folder;
  const ScratchFile file = ScratchFile::create(folder.path()).value();
  ASSERT_TRUE(file.write(0, "bytes"));
  std::array<char, 6> more{};
  const auto read = file.read(0, more);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().kind, ErrorKind::kInput);
  EXPECT_NE(read.error().message.find(folder.path().string()), std::string::npos) << read.error().message;
}

TEST(ScratchFile, AFolderThatIsNotThereIsAFailure) {
  const TemporaryFolder folder;
  const auto file = ScratchFile::create(folder.path() / "gone");
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().kind, ErrorKind::kInput);
}

}  // namespace
}  // namespace quorum
