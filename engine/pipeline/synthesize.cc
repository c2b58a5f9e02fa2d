#include "engine/pipeline/synthesize.h"

#include <string>

#include "engine/io/file.h"
#include "engine/io/middlebury.h"
#include "engine/io/ply.h"
#include "engine/io/text.h"
#include "engine/io/write_image.h"
#include "engine/pipeline/run.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNotOurs = "is there already and was not written by quorum; choose another folder";

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(path, ignored));
}

/// A folder into which a temple goes: a new one, or one that holds a temple, to be replaced.
class TempleFolder {
 public:
  static Expected<TempleFolder> open(const fs::path& folder) {
    const fs::path readme = folder / "README.txt";
    const fs::path cameras = folder / "temple_par.txt";
    const bool is_temple = is_there(cameras) && read_file(readme).value_or("").starts_with("temple: ");
    for (const fs::path& path : {readme, cameras})
      if (!is_temple && is_there(path)) return path_failure(path, kNotOurs);
    QUORUM_TRY(make_folder(folder));
    return TempleFolder(folder, is_temple);
  }

  /// A file with the same bytes stays; it may be of a run that was killed.
  Expected<void> write(const std::string& name, const std::string& bytes) const {
    const fs::path path = folder_ / name;
    if (!is_temple_ && is_there(path)) {
      if (read_file(path).value_or("") == bytes) return {};
      return path_failure(path, kNotOurs);
    }
    return write_file(path, bytes);
  }

 private:
  TempleFolder(fs::path folder, bool is_temple) : folder_(std::move(folder)), is_temple_(is_temple) {}

  fs::path folder_;
  bool is_temple_;
};

}  // namespace

Expected<void> synthesize_temple(const fs::path& folder, const TempleOptions& options, const Progress& progress) {
  constexpr double kSurfaceEdge = 0.001;  // of the triangles of gt.ply, meters
  QUORUM_TRY(options.check());
  QUORUM_ASSIGN(const TempleFolder output, TempleFolder::open(folder));
  const Scene scene = make_temple_scene(options);
  for (int view = 0; view < static_cast<int>(scene.views.size()); ++view) {
    if (progress.stop_requested()) return std::unexpected(stopped());
    QUORUM_ASSIGN(const auto picture, encode_png(render_temple(scene, view, options)));
    QUORUM_TRY(output.write(scene.views[static_cast<std::size_t>(view)].image_path.string(), picture));
  }
  QUORUM_ASSIGN(const auto surface, encode_ply(temple_surface(kSurfaceEdge)));
  QUORUM_TRY(output.write("gt.ply", surface));
  return write_middlebury(folder, "temple", scene);
}

}  // namespace quorum
