#include "tools/run_colmap.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <string>
#include <vector>

#include "engine/io/colmap.h"
#include "engine/io/file.h"
#include "engine/io/unread_image.h"
#include "engine/io/view_names.h"
#include "tools/colmap_process.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

/// A call of colmap; name: of its log and of the note that it is done.
struct Step {
  std::string name;
  std::string command;
};

bool is_photograph(const fs::path& path) {
  return std::ranges::count(std::initializer_list<std::string>{".jpg", ".jpeg", ".png", ".tif", ".tiff"},
                            folded(path.extension().string())) > 0;
}

/// The photographs that colmap would take, sorted. Links to folders are not followed, so none loops.
Expected<std::vector<fs::path>> list_photographs(const fs::path& photos, Progress& progress) {
  std::vector<fs::path> found;
  std::size_t unread = 0;  // what phones write, and colmap does not read
  std::error_code code;
  for (fs::recursive_directory_iterator entry(photos, code); !code && entry != fs::recursive_directory_iterator();
       entry.increment(code)) {
    std::error_code ignored;
    if (!entry->is_regular_file(ignored)) continue;
    if (is_photograph(entry->path())) found.push_back(entry->path());
    const std::string extension = folded(entry->path().extension().string());
    unread += extension == ".heic" || extension == ".heif" || extension == ".avif" ? 1 : 0;
  }
  if (code)
    return failure(ErrorKind::kInput, fmt::format("{}: cannot be listed: {}; check the path and the permissions",
                                                  photos.string(), code.message()));
  if (found.size() < 3)
    return failure(
        ErrorKind::kInput,
        fmt::format("{}: holds {} photographs (jpg, png, tif), expected 3 or more{}", photos.string(), found.size(),
                    unread > 0 ? fmt::format("; convert the {} of HEIC or AVIF, which colmap does not read, to JPEG "
                                             "(heif-convert)",
                                             unread)
                               : ""));
  if (unread > 0)
    progress.note(fmt::format("{} photographs of HEIC or AVIF are left out, which colmap does not read", unread));
  std::ranges::sort(found);
  return found;
}

/// A line per photograph: what tells it from another one.
std::vector<std::string> describe(const fs::path& photos, const std::vector<fs::path>& paths) {
  std::vector<std::string> lines;
  for (const fs::path& path : paths) {
    std::error_code ignored;
    const auto size = fs::file_size(path, ignored);
    const auto time = fs::last_write_time(path, ignored);
    lines.push_back(
        fmt::format("{} {} {}", path.lexically_relative(photos).string(), size, time.time_since_epoch().count()));
  }
  std::ranges::sort(lines);
  return lines;
}

/// What is missing of a photograph colmap takes for a gray part of the scene, and writes so.
Expected<void> check_photographs(const std::vector<fs::path>& paths, const Progress& progress) {
  for (const fs::path& path : paths) {
    if (progress.stop_requested()) return std::unexpected(stopped_by_request());
    QUORUM_ASSIGN(const auto bytes, read_file(path));
    if (const std::string why = why_unread(path, bytes, true); !why.empty())
      return failure(ErrorKind::kInput, fmt::format("{}: {}", path.string(), why));
  }
  return {};
}

/// The folder as only one run may use it. A colmap inherits the lock, so one that a killed run left keeps it.
Expected<void> lock(const fs::path& work) {
  const int descriptor = ::open((work / "lock").c_str(), O_RDWR | O_CREAT, 0666);
  if (descriptor < 0)
    return failure(ErrorKind::kInput, fmt::format("{}: cannot be written; check the permissions", work.string()));
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return {};  // until the process and its children end
  ::close(descriptor);
  return failure(ErrorKind::kInput, fmt::format("{}: another quorum photos, or a colmap that it left, works here; wait "
                                                "for it, end it, or choose another output folder",
                                                work.string()));
}

/// Runs a step.
Expected<void> run_step(const Step& step, const fs::path& photos, const fs::path& work, int max_image_size,
                        const Progress& progress) {
  const std::string database = (work / "database.db").string();
  const fs::path sparse = work / "sparse";
  std::error_code ignored;
  std::vector<std::string> arguments = {step.command};
  const auto add = [&arguments](std::vector<std::string> more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
  };
  if (step.name == "features") {
    fs::remove(work / "database.db", ignored);
    QUORUM_ASSIGN(const auto off, without_gpu(step.command, {"--FeatureExtraction.use_gpu", "--SiftExtraction.use_gpu"},
                                              work, progress));
    add({"--database_path", database, "--image_path", photos.string()});
    add(off);
  } else if (step.name == "matches") {
    QUORUM_ASSIGN(const auto off,
                  without_gpu(step.command, {"--FeatureMatching.use_gpu", "--SiftMatching.use_gpu"}, work, progress));
    add({"--database_path", database});
    add(off);
  } else if (step.name == "cameras") {
    fs::remove_all(sparse, ignored);
    QUORUM_TRY(make_folder(sparse));
    add({"--database_path", database, "--image_path", photos.string(), "--output_path", sparse.string()});
  } else {
    const auto models = list_colmap_models(work);
    if (models.empty())
      return failure(ErrorKind::kInput, fmt::format("{}: holds no model; remove {} and run again", sparse.string(),
                                                    (work / "cameras.done").string()));
    fs::remove_all(work / "dense", ignored);
    add({"--image_path", photos.string(), "--input_path", models.front().path.string(), "--output_path",
         (work / "dense").string(), "--output_type", "COLMAP"});
    if (max_image_size > 0) add({"--max_image_size", std::to_string(max_image_size)});
  }
  const fs::path log = work / (step.name + ".log");
  QUORUM_ASSIGN(const int status, call_colmap(arguments, log, progress));
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  return failure(ErrorKind::kInput, fmt::format("colmap {} failed; see {}", step.command, log.string()));
}

/// Says how many photographs have cameras now.
Expected<void> tell_registered(const fs::path& work, std::size_t photograph_count, Progress& progress) {
  const auto models = list_colmap_models(work);
  if (models.empty())
    return failure(ErrorKind::kInput, "colmap found no cameras: the photographs share too little; take more of them");
  const std::string of_several =
      models.size() > 1 ? fmt::format(", in the largest of {} models that share nothing", models.size()) : "";
  progress.note(
      fmt::format("{} of {} photographs registered{}", models.front().image_count, photograph_count, of_several));
  return {};
}

}  // namespace

Expected<void> run_colmap(const fs::path& photos, const fs::path& work, int max_image_size, Progress& progress) {
  std::error_code ignored;
  const fs::path inside = fs::weakly_canonical(work, ignored).lexically_relative(fs::weakly_canonical(photos, ignored));
  if (!inside.empty() && *inside.begin() != "..")
    return failure(ErrorKind::kInput, fmt::format("{}: lies in the folder of photographs, where colmap would take its "
                                                  "pictures for photographs; choose another output folder",
                                                  work.string()));
  QUORUM_ASSIGN(const auto photographs, list_photographs(photos, progress));
  const std::vector<std::string> lines = describe(photos, photographs);
  std::string input = fmt::format("size {}\n", max_image_size);
  for (const std::string& line : lines) input += line + "\n";
  QUORUM_TRY(make_folder(work));
  QUORUM_TRY(lock(work));
  const Step steps[] = {{"features", "feature_extractor"},
                        {"matches", "exhaustive_matcher"},
                        {"cameras", "mapper"},
                        {"undistorted", "image_undistorter"}};
  progress.stage("finding cameras", static_cast<int>(std::size(steps)));
  bool stale = false;
  for (const Step& step : steps) {
    if (progress.stop_requested()) return std::unexpected(stopped_by_request());
    const fs::path note = work / (step.name + ".done");
    const auto done_for = read_file(note);
    stale = stale || !done_for || *done_for != input;
    if (stale) {
      fs::remove(note, ignored);
      if (step.name == "features") QUORUM_TRY(check_photographs(photographs, progress));
      QUORUM_TRY(run_step(step, photos, work, max_image_size, progress));
    }
    if (step.name == "cameras") QUORUM_TRY(tell_registered(work, lines.size(), progress));
    if (stale) QUORUM_TRY(write_file(note, input));
    progress.step();
  }
  return {};
}

}  // namespace quorum
