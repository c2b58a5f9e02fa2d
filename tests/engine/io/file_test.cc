#include "engine/io/file.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/parallel_for.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <set>

#include "tests/engine/io/io_test.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

/// While it lives, a file that grows beyond size bytes fails as on a full disk, with another error number.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t size) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limited = before_;
    limited.rlim_cur = size;
    setrlimit(RLIMIT_FSIZE, &limited);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_ = {};
  void (*handler_)(int);
};

TEST(File, ReadsBackWhatWasWritten) {
  const TemporaryFolder folder;
  std::string all_bytes;
  for (int i = 0; i < 100000; ++i) all_bytes += static_cast<char>(i * 7);
  for (const std::string& bytes : {std::string(), std::string("x"), all_bytes}) {
    ASSERT_TRUE(write_file(folder.path() / "a.bin", bytes));
    EXPECT_EQ(read_file(folder.path() / "a.bin").value(), bytes);
  }
  EXPECT_EQ(names_in(folder.path()), std::set<std::string>{"a.bin"});
}

TEST(File, NameWithoutFolderIsInTheCurrentOne) {
  const TemporaryFolder folder;
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  EXPECT_TRUE(write_file("a.txt", "x"));
  EXPECT_EQ(read_file("a.txt").value(), "x");
  fs::current_path(before);
}

TEST(File, IsReadableByOthersAsTheUserSet) {
  const TemporaryFolder folder;
  const mode_t before = umask(022);
  EXPECT_TRUE(write_file(folder.path() / "a.txt", "x"));
  umask(before);
  EXPECT_EQ(fs::status(folder.path() / "a.txt").permissions(), static_cast<fs::perms>(0644));
}

TEST(File, AbsentFileAndFolderAreNamed) {
  const TemporaryFolder folder;
  expect_bad_input(read_file(folder.path() / "none.txt"), {"none.txt: cannot read: no such file", "check the path"});
  expect_bad_input(read_file(folder.path()), {folder.path().string(), "is a folder"});
  expect_bad_input(write_file(folder.path() / "none" / "a.txt", "x"), {"none/a.txt: cannot write: no such file"});
  expect_bad_input(read_file(""), {"cannot read"});
  expect_bad_input(write_file("", "x"), {"cannot write"});
}

TEST(File, PathBelowAFileIsRefused) {
  const TemporaryFolder folder;
  write_text(folder.path() / "file", "x");
  expect_bad_input(write_file(folder.path() / "file" / "a.txt", "x"), {"file/a.txt", "a part of the path is a file"});
  expect_bad_input(read_file(folder.path() / "file" / "a.txt"), {"a part of the path is a file"});
}

TEST(File, FailedWriteLeavesTheOldFileAndNoOther) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_file(folder.path() / "a.txt", "old"));
  {
    const FileSizeLimit limit(1000);
    expect_bad_input(write_file(folder.path() / "a.txt", std::string(5000, 'x')),
                     {"a.txt: cannot write: file too large"});
  }
  EXPECT_EQ(read_file(folder.path() / "a.txt").value(), "old");
  EXPECT_EQ(names_in(folder.path()), std::set<std::string>{"a.txt"});
}

TEST(File, FolderAndPipeAreNeverReplaced) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "sub");
  ASSERT_EQ(mkfifo((folder.path() / "pipe").c_str(), 0600), 0);
  expect_bad_input(write_file(folder.path() / "sub", "x"), {"sub", "is not a regular file"});
  expect_bad_input(write_file(folder.path() / "pipe", "x"), {"pipe", "is not a regular file"});
  expect_bad_input(read_file(folder.path() / "pipe"), {"pipe", "is not a regular file"});
  EXPECT_EQ(names_in(folder.path()), (std::set<std::string>{"pipe", "sub"}));
}

TEST(File, WritersAtTheSameTimeLeaveOneWholeFile) {
  const TemporaryFolder folder;
  tbb::parallel_for(0, 64, [&folder](int i) {
    EXPECT_TRUE(write_file(folder.path() / "a.txt", std::string(20000, static_cast<char>('0' + i))));
  });
  const std::string bytes = read_file(folder.path() / "a.txt").value();
  EXPECT_EQ(bytes, std::string(20000, bytes.at(0)));
  EXPECT_EQ(names_in(folder.path()), std::set<std::string>{"a.txt"});
}

TEST(File, TemporaryFilesOfOthersAreLeftAlone) {
  const TemporaryFolder folder;
  const auto name = [&folder](int i) {
    return folder.path() / (".quorum-" + std::to_string(getpid()) + "-" + std::to_string(i) + ".tmp");
  };
  for (int i = 0; i < 200; ++i) write_text(name(i), "other");
  EXPECT_TRUE(write_file(folder.path() / "a.txt", "mine"));
  EXPECT_EQ(read_file(folder.path() / "a.txt").value(), "mine");
  for (int i = 0; i < 200; ++i) ASSERT_EQ(read_file(name(i)).value(), "other") << i;
}

TEST(FileGroup, FilesAppearTogetherAtTheEnd) {
  const TemporaryFolder folder;
  write_file(folder.path() / "b", "old").value();
  FileGroup group;
  group.add(folder.path() / "a", "one").value();
  group.add(folder.path() / "b", "two").value();
  EXPECT_FALSE(fs::exists(folder.path() / "a"));
  EXPECT_EQ(read_file(folder.path() / "b").value(), "old");
  group.finish().value();
  EXPECT_EQ(names_in(folder.path()), (std::set<std::string>{"a", "b"}));
  EXPECT_EQ(read_file(folder.path() / "b").value(), "two");
  FileGroup().finish().value();
}

TEST(FileGroup, FailureLeavesNothing) {
  const TemporaryFolder folder;
  {
    FileGroup group;
    group.add(folder.path() / "a", "one").value();
    const FileSizeLimit limit(10);
    expect_bad_input(group.add(folder.path() / "b", std::string(100, 'x')), {"b", "cannot write"});
  }
  EXPECT_TRUE(names_in(folder.path()).empty());
}

TEST(MakeFolder, MakesParentsAndKeepsWhatIsThere) {
  const TemporaryFolder folder;
  const fs::path deep = folder.path() / "a" / "b" / "c";
  EXPECT_TRUE(make_folder(deep));
  write_text(deep / "kept", "x");
  EXPECT_TRUE(make_folder(deep));
  EXPECT_TRUE(make_folder(deep / ""));
  EXPECT_EQ(names_in(deep), std::set<std::string>{"kept"});
}

TEST(MakeFolder, FileInTheWayIsNamed) {
  const TemporaryFolder folder;
  write_text(folder.path() / "file", "x");
  expect_bad_input(make_folder(folder.path() / "file"), {"/file: cannot make the folder"});
  expect_bad_input(make_folder(folder.path() / "file" / "sub"), {"file/sub: cannot make the folder"});
}

TEST(MakeFolder, FolderThatTakesNoFilesIsRefused) {
  expect_bad_input(make_folder("/proc/self"), {"/proc/self: cannot write to the folder"});
}

}  // namespace
}  // namespace quorum
