// quorum synthesize: a scene of known shape, as a Middlebury folder with its exact surface.
#include "engine/core/option_maker.h"
#include "engine/pipeline/synthesize.h"
#include "tools/add_options.h"

namespace quorum {

int synthesize_command(int argc, char** argv) {
  CommandLine line("Render a small stone temple from known cameras, with its exact surface gt.ply.", "synthesize");
  std::filesystem::path folder;
  TempleOptions options;
  using Make = OptionMaker<TempleOptions>;
  line.add("output", folder, "Folder for the scene; made if missing").required();
  for (const Option<TempleOptions>& option : {
           Make::number("views", QUORUM_MEMBER(views), {3, 1024}, "Photographs to take"),
           Make::choice("cameras", QUORUM_MEMBER(path),
                        {{"ring", CameraPath::kRing}, {"hemisphere", CameraPath::kHemisphere}},
                        "Where the cameras stand"),
           Make::number("width", QUORUM_MEMBER(width), {64, 8192},
                        "Width of the photographs, pixels; the height is 3/4 of it"),
           Make::number("noise", QUORUM_MEMBER(noise), {0, 64}, "Standard deviation of the sensor noise, gray levels"),
           Make::number("texture", QUORUM_MEMBER(texture), {0, 4}, "Strength of the stone's texture; 0: plain plaster"),
           Make::number("gloss", QUORUM_MEMBER(gloss), {0, 1}, "Strength of highlights"),
           Make::choice("lights", QUORUM_MEMBER(lighting),
                        {{"fixed", Lighting::kFixed}, {"per-view", Lighting::kPerView}},
                        "per-view: other places and strengths for each photograph"),
           Make::number("seed", QUORUM_MEMBER(seed), {}, "Same seed, same bytes"),
       })
    add_option(line, options, option);
  return run_command(line, argc, argv, [&] { return synthesize_temple(folder, options); });
}

}  // namespace quorum
