// quorum convert: a scene in the format of other programs.
#include <map>

#include "engine/io/convert_scene.h"
#include "engine/io/file.h"
#include "engine/io/scene_folder.h"
#include "tools/run_arguments.h"

namespace quorum {

int convert_command(int argc, char** argv) {
  const std::map<std::string, ConvertedFormat> formats = {{"colmap", ConvertedFormat::kColmap},
                                                          {"colmap-text", ConvertedFormat::kColmapText},
                                                          {"mvsnet", ConvertedFormat::kMvsnet},
                                                          {"transforms", ConvertedFormat::kTransforms}};
  CLI::App app("Write a scene in the format of other programs; distorted photographs are undistorted.", "convert");
  std::filesystem::path scene_folder;
  std::filesystem::path output;
  SceneOptions files;
  ConvertedFormat format = ConvertedFormat::kColmap;
  app.add_option("scene", scene_folder, "Folder with the photographs and their cameras")->required();
  app.add_option("--to", format, "Format to write")
      ->required()
      ->transform(
          CLI::CheckedTransformer(formats, CLI::ignore_case).description("colmap, colmap-text, mvsnet, transforms"))
      ->option_text("NAME");
  app.add_option("-o,--output", output, "Folder for the scene; made if missing")->required();
  add_format_options(app, files);
  app.add_option("--roi", files.roi, "The box that holds the object: a file of six numbers, or a .ply [found]");
  return run_command(app, argc, argv, [&]() -> Expected<void> {
    const auto scene = read_scene(scene_folder, files);
    if (!scene) return std::unexpected(scene.error());
    if (auto made = make_folder(output); !made) return made;
    return convert_scene(output, *scene, format);
  });
}

}  // namespace quorum
