#include "tools/run_colmap.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <string>
#include <vector>

#include "engine/io/file.h"

extern char** environ;

namespace quorum {
namespace {

namespace fs = std::filesystem;

/// A call of colmap; name: of its log and of the note that it is done.
struct Step {
  std::string name;
  std::vector<std::string> arguments;
};

bool is_photograph(const fs::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return std::ranges::count(std::initializer_list<std::string>{".jpg", ".jpeg", ".png", ".tif", ".tiff"}, extension) >
         0;
}

/// A line per photograph: what tells it from another one. Sorted.
Expected<std::vector<std::string>> describe(const fs::path& photos) {
  std::vector<std::string> lines;
  std::error_code code;
  for (fs::recursive_directory_iterator entry(photos, code); !code && entry != fs::recursive_directory_iterator();
       entry.increment(code))
    if (entry->is_regular_file() && is_photograph(entry->path()))
      lines.push_back(fmt::format("{} {} {}", fs::relative(entry->path(), photos).string(), entry->file_size(),
                                  entry->last_write_time().time_since_epoch().count()));
  if (code) return failure(ErrorKind::kInput, fmt::format("{}: cannot be listed: {}", photos.string(), code.message()));
  if (lines.size() < 3)
    return failure(ErrorKind::kInput, fmt::format("{}: holds {} photographs (jpg, png, tif), expected 3 or more",
                                                  photos.string(), lines.size()));
  std::ranges::sort(lines);
  return lines;
}

/// Runs colmap with its output in a file.
Expected<void> call(const Step& step, const fs::path& log) {
  std::vector<std::string> words = {"colmap"};
  words.insert(words.end(), step.arguments.begin(), step.arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  ::posix_spawn_file_actions_adddup2(&actions, 1, 2);
  ::setenv("QT_QPA_PLATFORM", "offscreen", 0);  // it asks for a display even where it shows nothing
  pid_t process = 0;
  const int problem = ::posix_spawnp(&process, "colmap", &actions, nullptr, pointers.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (problem == ENOENT)
    return failure(ErrorKind::kInput,
                   "colmap is not installed; install it (Debian: apt install colmap), or give photographs with known "
                   "cameras to quorum reconstruct");
  if (problem != 0) return failure(ErrorKind::kInput, fmt::format("colmap can't be started (error {})", problem));
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  return failure(ErrorKind::kInput, fmt::format("colmap {} failed; see {}", step.arguments[0], log.string()));
}

std::vector<Step> steps_for(const fs::path& photos, const fs::path& work, int max_image_size) {
  const std::string database = (work / "database.db").string();
  std::vector<std::string> undistort = {"image_undistorter",
                                        "--image_path",
                                        photos.string(),
                                        "--input_path",
                                        (work / "sparse/0").string(),
                                        "--output_path",
                                        (work / "dense").string(),
                                        "--output_type",
                                        "COLMAP"};
  if (max_image_size > 0) undistort.insert(undistort.end(), {"--max_image_size", std::to_string(max_image_size)});
  return {{"features",
           {"feature_extractor", "--database_path", database, "--image_path", photos.string(),
            "--SiftExtraction.use_gpu", "0"}},
          {"matches", {"exhaustive_matcher", "--database_path", database, "--SiftMatching.use_gpu", "0"}},
          {"cameras",
           {"mapper", "--database_path", database, "--image_path", photos.string(), "--output_path",
            (work / "sparse").string()}},
          {"undistorted", std::move(undistort)}};
}

}  // namespace

Expected<void> run_colmap(const fs::path& photos, const fs::path& work, int max_image_size, Progress& progress) {
  const auto lines = describe(photos);
  if (!lines) return std::unexpected(lines.error());
  std::string input = fmt::format("size {}\n", max_image_size);
  for (const std::string& line : *lines) input += line + "\n";
  if (auto made = make_folder(work / "sparse"); !made) return made;
  const std::vector<Step> steps = steps_for(photos, work, max_image_size);
  progress.stage("finding cameras", static_cast<int>(steps.size()));
  bool stale = false;
  for (const Step& step : steps) {
    if (progress.stop_requested()) return failure(ErrorKind::kStopped, "stopped as asked; finished steps are kept");
    const fs::path note = work / (step.name + ".done");
    const auto done_for = read_file(note);
    stale = stale || !done_for || *done_for != input;
    if (stale) {
      std::error_code ignored;
      fs::remove(note, ignored);
      if (step.name == "features") fs::remove(work / "database.db", ignored);
      if (auto called = call(step, work / (step.name + ".log")); !called) return called;
      if (step.name == "cameras" && !fs::exists(work / "sparse/0", ignored))
        return failure(ErrorKind::kInput,
                       "colmap found no cameras: the photographs share too little; take more of them");
      if (auto written = write_file(note, input); !written) return written;
    }
    progress.step();
  }
  return {};
}

}  // namespace quorum
