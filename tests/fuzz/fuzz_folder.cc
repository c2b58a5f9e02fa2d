#include "tests/fuzz/fuzz_folder.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>

namespace quorum {
namespace {

namespace fs = std::filesystem;

/// One a process, in memory where the system has such a folder.
const fs::path& base() {
  static const fs::path folder = [] {
    const fs::path memory = "/dev/shm";
    std::error_code ignored;
    const fs::path parent = fs::is_directory(memory, ignored) ? memory : fs::temp_directory_path();
    const fs::path made = parent / ("quorum_fuzz_" + std::to_string(::getpid()));
    std::atexit([] {
      std::error_code code;
      fs::remove_all(base(), code);
    });
    return made;
  }();
  return folder;
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
         c == '-' || c == '/';
}

bool is_harmless(std::string_view name) {
  return !name.empty() && name.size() < 80 && name.front() != '/' && name.back() != '/' &&
         std::ranges::all_of(name, is_letter) && name.find("..") == std::string_view::npos &&
         name.find("//") == std::string_view::npos && std::ranges::count(name, '/') <= 3;
}

void write_file(const fs::path& path, std::string_view bytes) {
  std::error_code ignored;
  fs::create_directories(path.parent_path(), ignored);
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

const fs::path& fill_folder(std::string_view input) {
  constexpr std::string_view kMark = "@@ ";
  constexpr int kMostFiles = 32;
  std::error_code ignored;
  fs::remove_all(base(), ignored);
  fs::create_directories(base(), ignored);
  int files = 0;
  while (files < kMostFiles && input.starts_with(kMark)) {
    const std::size_t line = std::min(input.find('\n'), input.size() - 1);
    const std::string_view name = input.substr(kMark.size(), line - std::min(line, kMark.size()));
    input.remove_prefix(line + 1);
    const std::size_t next = std::min(input.find("\n@@ "), input.size());
    if (is_harmless(name)) write_file(base() / name, input.substr(0, next));
    input.remove_prefix(std::min(next + 1, input.size()));
    ++files;
  }
  return base();
}

const fs::path& write_input(std::string_view input, std::string_view ending) {
  static fs::path path;
  std::error_code ignored;
  fs::create_directories(base(), ignored);
  path = base() / ("input" + std::string(ending));
  write_file(path, input);
  return path;
}

}  // namespace quorum
