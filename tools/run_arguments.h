// The arguments of the commands that run the pipeline (reconstruct, depth, fuse).
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/io/scene_folder.h"
#include "engine/pipeline/reconstruct.h"
#include "tools/command.h"

namespace quorum {

/// As typed; resolve() turns them into what the pipeline takes.
struct RunArguments {
  std::filesystem::path scene;
  std::filesystem::path output;
  std::vector<std::string> bounds;
  SceneOptions files;
  std::string view_rule = "auto";
  std::string device = "auto";
  int threads = 0;
  std::string memory = "auto";
  std::string simd = "auto";
  std::vector<int> tile = {64, 16};
  std::string window_model = "slanted";
  std::string signed_distance = "normal";
  bool no_slant = false;
  bool no_confirm = false;
  std::string depth_step = "auto";
  std::string voxel_size = "auto";
  std::string truncation = "auto";
  std::vector<std::string> weights = {"confidence", "slant", "border"};
  std::string min_confidence = "auto";
  bool cloud = false;
  bool colmap = false;
  bool quiet = false;
  bool json = false;
  ReconstructOptions options;

  void add_scene_and_output(CLI::App& app);
  void add_output_options(CLI::App& app);
  void add_depth_options(CLI::App& app);
  void add_fusion_options(CLI::App& app);
  /// The same for `quorum fuse`, which has no options of depth maps.
  void add_fuse_options(CLI::App& app);
  void add_device_options(CLI::App& app);
  void add_device_and_output_options(CLI::App& app);
};

/// Adds --format and --images, which say how a scene's folder is to be read.
void add_format_options(CLI::App& app, SceneOptions& files);

/// One of the pipeline's stages, or several.
using PipelineStages = std::function<Expected<void>(const Scene&, const ReconstructOptions&, Backend&, const Workspace&,
                                                    Progress&, RunReport&)>;

/// Depth maps and mesh: the stages of `quorum reconstruct`.
Expected<void> reconstruct_scene(const Scene& scene, const ReconstructOptions& options, Backend& backend,
                                 const Workspace& workspace, Progress& progress, RunReport& report);

/// Reads the scene, opens the device and the workspace, runs the stages and writes run.json. Fails as they do.
Expected<void> run_pipeline(RunArguments& arguments, const PipelineStages& stages);

}  // namespace quorum
