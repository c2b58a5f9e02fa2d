// Helpers that several tests share.
#pragma once

#include <filesystem>
#include <string>

namespace quorum {

/// A folder of its own for the running test, empty, removed when the object goes.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Folder of the development data sets ($QUORUM_DATA, else ../shared/data beside the repository), or empty if absent.
std::filesystem::path data_folder();

/// The folder of the project's sources.
std::filesystem::path source_folder();

/// Writes text to a file; for making inputs.
void write_text(const std::filesystem::path& path, const std::string& text);

}  // namespace quorum
