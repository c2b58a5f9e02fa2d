// quorum convert: a scene in the format of other programs.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "engine/io/convert_scene.h"
#include "engine/io/scene_folder.h"
#include "engine/pipeline/workspace.h"
#include "tools/add_options.h"
#include "tools/messages.h"

namespace quorum {
namespace {

/// The maps of a run of the same scene with the same --max-image-size.
PriorSource priors_of(const Workspace& workspace) {
  return [workspace](const View& view) -> Expected<std::optional<PriorMaps>> {
    if (!workspace.has_depth_map(view.name)) return std::optional<PriorMaps>();
    PriorMaps maps;
    QUORUM_ASSIGN(maps.depth, workspace.load_depth(view.name, view.width, view.height));
    QUORUM_ASSIGN(maps.normal, workspace.load_normals(view.name, view.width, view.height));
    if (!workspace.certainty_record(view.name).empty()) {
      QUORUM_ASSIGN(maps.certainty, workspace.load_certainty(view.name, view.width, view.height));
    }
    return maps;
  };
}

Expected<PriorSource> find_priors(const std::filesystem::path& folder, const Scene& scene, ConvertedFormat format) {
  if (folder.empty()) return PriorSource();
  if (format != ConvertedFormat::kTransforms)
    return failure(ErrorKind::kUsage, "--with-depth: only transforms.json (--to nerfstudio) names maps");
  const Workspace workspace = Workspace::at(folder);
  if (std::ranges::none_of(scene.views, [&](const View& view) { return workspace.has_depth_map(view.name); }))
    return failure(ErrorKind::kInput,
                   fmt::format("{}: holds no depth map of a view of this scene; give the output folder of a run of it",
                               folder.string()));
  return priors_of(workspace);
}

}  // namespace

int convert_command(int argc, char** argv) {
  const std::map<std::string, ConvertedFormat> formats = {{"colmap", ConvertedFormat::kColmap},
                                                          {"colmap-text", ConvertedFormat::kColmapText},
                                                          {"mvsnet", ConvertedFormat::kMvsnet},
                                                          {"transforms", ConvertedFormat::kTransforms},
                                                          {"nerfstudio", ConvertedFormat::kTransforms}};
  CommandLine line("Write a scene in the format of other programs; distorted photographs are undistorted.", "convert");
  std::filesystem::path scene_folder;
  std::filesystem::path output;
  RunOptions options;
  std::string format;
  std::filesystem::path workspace;
  line.add("scene", scene_folder, "Folder with the photographs and their cameras").required();
  line.add("--to", format, "Format to write")
      .required()
      .shown_as("colmap, colmap-text, mvsnet or nerfstudio (transforms)");
  line.add("-o,--output", output, "Folder for the scene; made if missing").required();
  line.add("--with-depth", workspace,
           "Output folder of a run of this scene: its depth maps, normals and certainties are written beside "
           "transforms.json, as NumPy files")
      .shown_as("a folder");
  add_named_options(line, options, {"format", "images", "model", "max-image-size", "roi"});
  return run_command(line, argc, argv, [&]() -> Expected<void> {
    const auto named = formats.find(format);
    if (named == formats.end())
      return failure(ErrorKind::kUsage, fmt::format("--to {}: give colmap, colmap-text, mvsnet or nerfstudio", format));
    QUORUM_ASSIGN(const auto scene, read_scene(scene_folder, options.files));
    for (const std::string& note : scene.notes) tell(note);
    QUORUM_ASSIGN(const auto priors, find_priors(workspace, scene, named->second));
    return convert_scene(output, scene, named->second, priors);
  });
}

}  // namespace quorum
