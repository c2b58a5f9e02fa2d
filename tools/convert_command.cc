// quorum convert: a scene in the format of other programs.
#include <fmt/format.h>

#include <map>

#include "engine/io/convert_scene.h"
#include "engine/io/scene_folder.h"
#include "tools/add_options.h"
#include "tools/messages.h"

namespace quorum {

int convert_command(int argc, char** argv) {
  const std::map<std::string, ConvertedFormat> formats = {{"colmap", ConvertedFormat::kColmap},
                                                          {"colmap-text", ConvertedFormat::kColmapText},
                                                          {"mvsnet", ConvertedFormat::kMvsnet},
                                                          {"transforms", ConvertedFormat::kTransforms}};
  CommandLine line("Write a scene in the format of other programs; distorted photographs are undistorted.", "convert");
  std::filesystem::path scene_folder;
  std::filesystem::path output;
  RunOptions options;
  std::string format;
  line.add("scene", scene_folder, "Folder with the photographs and their cameras").required();
  line.add("--to", format, "Format to write").required().shown_as("colmap, colmap-text, mvsnet or transforms");
  line.add("-o,--output", output, "Folder for the scene; made if missing").required();
  add_named_options(line, options, {"format", "images", "model", "max-image-size", "roi"});
  return run_command(line, argc, argv, [&]() -> Expected<void> {
    const auto named = formats.find(format);
    if (named == formats.end())
      return failure(ErrorKind::kUsage, fmt::format("--to {}: give colmap, colmap-text, mvsnet or transforms", format));
    QUORUM_ASSIGN(const auto scene, read_scene(scene_folder, options.files));
    for (const std::string& note : scene.notes) tell(note);
    return convert_scene(output, scene, named->second);
  });
}

}  // namespace quorum
