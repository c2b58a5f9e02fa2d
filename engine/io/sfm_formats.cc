#include "engine/io/sfm_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <system_error>

#include "engine/io/file.h"
#include "engine/io/meshroom.h"
#include "engine/io/metashape.h"
#include "engine/io/openmvg.h"
#include "engine/io/opensfm.h"
#include "engine/io/realitycapture.h"
#include "engine/io/text.h"
#include "engine/io/visualsfm.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;
using Paths = std::vector<fs::path>;

/// The first of some paths that is a file.
Paths first_of(std::initializer_list<fs::path> paths) {
  const auto* found = std::ranges::find_if(paths, is_file);
  return found != paths.end() ? Paths{*found} : Paths{};
}

bool any(const fs::path&) { return true; }

/// The files with an extension that pass a test.
Paths with_extension(const fs::path& folder, std::string_view extension, bool (*is_wanted)(const fs::path&)) {
  Paths found;
  std::error_code code;
  for (fs::directory_iterator entry(folder, code); !code && entry != fs::directory_iterator(); entry.increment(code))
    if (entry->path().extension() == extension && is_file(entry->path()) && is_wanted(entry->path()))
      found.push_back(entry->path());
  if (code == std::errc::not_enough_memory) throw std::bad_alloc();
  std::ranges::sort(found);
  return found;
}

Paths find_openmvg(const fs::path& folder) { return first_of({folder / "sfm_data.json"}); }
Paths find_opensfm(const fs::path& folder) {
  return first_of({folder / "reconstruction.json", folder / "opensfm" / "reconstruction.json"});
}
/// cameras.sfm is one of several that the node StructureFromMotion writes.
Paths find_meshroom(const fs::path& folder) {
  const Paths usual = first_of({folder / "cameras.sfm", folder / "sfm.sfm"});
  return usual.empty() ? with_extension(folder, ".sfm", any) : usual;
}
Paths find_metashape(const fs::path& folder) { return with_extension(folder, ".xml", is_metashape_file); }
Paths find_realitycapture(const fs::path& folder) { return with_extension(folder, ".csv", is_realitycapture_file); }
Paths find_visualsfm(const fs::path& folder) { return with_extension(folder, ".nvm", any); }

constexpr SfmFormat kFormats[] = {
    {"openmvg", SceneFormat::kOpenMvg, "sfm_data.json (OpenMVG)", find_openmvg, read_openmvg},
    {"opensfm", SceneFormat::kOpenSfm, "reconstruction.json (OpenSfM, ODM)", find_opensfm, read_opensfm},
    {"meshroom", SceneFormat::kMeshroom, "*.sfm (Meshroom)", find_meshroom, read_meshroom},
    {"metashape", SceneFormat::kMetashape, "*.xml (Metashape)", find_metashape, read_metashape},
    {"realitycapture", SceneFormat::kRealityCapture, "*.csv (RealityCapture)", find_realitycapture,
     read_realitycapture},
    {"visualsfm", SceneFormat::kVisualSfm, "*.nvm (VisualSFM)", find_visualsfm, read_visualsfm}};

/// Files with cameras that can't be read, by the ends of their names, and how to get others.
struct Unread {
  std::string_view ending;
  std::string_view remedy;
};
constexpr Unread kUnread[] = {
    {"sfm_data.bin", "openMVG_main_ConvertSfM_DataFormat -i sfm_data.bin -o sfm_data.json converts it"},
    {".abc", "aliceVision_convertSfMFormat -i sfm.abc -o cameras.sfm converts it"},
    {".psx", "write the cameras with Metashape's File > Export > Export Cameras"},
    {".psz", "write the cameras with Metashape's File > Export > Export Cameras"},
    {".rcproj", "write RealityCapture's Export > Registration > Internal/External camera parameters"},
    {".rspj", "write RealityScan's Export > Registration > Internal/External camera parameters"},
    {".p4d", "export undistorted photographs and cameras in a format above, such as Bundler's, from Pix4D"},
    {".mvs", "the scene that InterfaceCOLMAP made it from can be read"},
    {"transforms_train.json", "copy it to transforms.json to use the photographs of this part"},
    {"database.db", "run colmap mapper, or quorum photos on the photographs"}};

}  // namespace

std::span<const SfmFormat> sfm_formats() { return kFormats; }

Expected<Scene> read_sfm_format(const SfmFormat& format, const fs::path& folder, const fs::path& images) {
  const Paths found = format.find(folder);
  if (found.empty()) return path_failure(folder, fmt::format("holds no {}", format.files));
  if (found.size() > 1)
    return path_failure(folder, fmt::format("{} files {}: {} and {}; leave one of them", found.size(), format.files,
                                            found[0].filename().string(), found[1].filename().string()));
  return format.read(found.front(), images);
}

std::string unread_cameras(const fs::path& folder) {
  Paths files;
  std::error_code code;
  for (fs::directory_iterator entry(folder, code); !code && entry != fs::directory_iterator(); entry.increment(code))
    files.push_back(entry->path().filename());
  std::ranges::sort(files);
  for (const auto& [ending, remedy] : kUnread)
    for (const fs::path& file : files)
      if (file.string().ends_with(ending)) return fmt::format("{} can't be read; {}", file.string(), remedy);
  return {};
}

}  // namespace quorum
