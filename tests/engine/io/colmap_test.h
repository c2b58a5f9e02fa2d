// A COLMAP scene in a folder, for the tests of its readers.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>

#include "engine/io/colmap.h"
#include "engine/io/file.h"
#include "tests/support/colmap_scene.h"
#include "tests/support/test_support.h"

namespace quorum {

class ColmapTest : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }
  Expected<Scene> read() { return read_colmap(folder_.path(), {}); }
  /// Writes the scene.
  void write(const ColmapModel& model) { write_colmap_scene(folder_.path(), model); }
  /// Changes the bytes of one of its files.
  void change(const std::string& file, const std::function<void(std::string&)>& change) {
    std::string bytes = read_file(path(file)).value();
    change(bytes);
    write_text(path(file), bytes);
  }

  TemporaryFolder folder_;
};

}  // namespace quorum
