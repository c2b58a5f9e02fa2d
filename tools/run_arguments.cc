#include "tools/run_arguments.h"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <thread>

#include "engine/core/clock.h"
#include "engine/core/memory.h"
#include "engine/io/file.h"
#include "engine/io/ply.h"
#include "engine/pipeline/colmap_workspace.h"
#include "engine/pipeline/fuse_points.h"
#include "engine/pipeline/run_json.h"
#include "tools/console_progress.h"
#include "tools/open_backend.h"

namespace quorum {
namespace {

constexpr const char* kFusionGroup = "Fusion and mesh (the paper, section 2.2)";
constexpr const char* kDeviceGroup = "Device and output (results are the same on every device)";

Error usage(std::string text) { return {ErrorKind::kUsage, std::move(text)}; }

/// Six numbers, in one argument or in six. Nothing given gives nothing.
Expected<std::optional<Bounds>> parse_bounds(const std::vector<std::string>& arguments) {
  if (arguments.empty()) return std::nullopt;
  std::vector<double> numbers;
  for (const std::string& argument : arguments) {
    const char* at = argument.data();
    const char* end = at + argument.size();
    while (at < end) {
      if (*at == ' ' || *at == ',') {
        ++at;
        continue;
      }
      double number = 0.0;
      const auto [next, problem] = std::from_chars(at, end, number);
      if (problem != std::errc())
        return std::unexpected(usage(fmt::format("--bounds {}: not a number; give x0 y0 z0 x1 y1 z1", argument)));
      numbers.push_back(number);
      at = next;
    }
  }
  if (numbers.size() != 6)
    return std::unexpected(
        usage(fmt::format("--bounds: expected six numbers x0 y0 z0 x1 y1 z1, found {}", numbers.size())));
  return Bounds{{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
}

Expected<CpuSweepOptions> cpu_options(const RunArguments& arguments) {
  CpuSweepOptions cpu;
  if (arguments.simd == "baseline")
    cpu.simd = SimdLevel::kBaseline;
  else if (arguments.simd == "avx2")
    cpu.simd = SimdLevel::kAvx2;
  else if (arguments.simd == "avx512")
    cpu.simd = SimdLevel::kAvx512;
  if (cpu.simd > best_simd_level())
    return std::unexpected(usage(fmt::format("--simd {}: this processor does not have it; give auto", arguments.simd)));
  cpu.tile_width = arguments.tile[0];
  cpu.tile_height = arguments.tile[1];
  if (cpu.tile_width < 8 || cpu.tile_width > 64 || cpu.tile_height < 1 || cpu.tile_height > 64)
    return std::unexpected(
        usage(fmt::format("--tile {} {}: give 8 to 64 and 1 to 64 pixels", cpu.tile_width, cpu.tile_height)));
  return cpu;
}

/// Turns the typed lengths and names into options, and checks all ranges.
Expected<void> resolve(RunArguments& arguments) {
  ReconstructOptions& options = arguments.options;
  for (const WindowModel model : {WindowModel::kSlanted, WindowModel::kPlane, WindowModel::kAxis})
    if (arguments.window_model == window_model_name(model)) options.sweep.window_model = model;
  if (arguments.no_slant && options.sweep.window_model == WindowModel::kSlanted)
    options.sweep.window_model = WindowModel::kPlane;
  options.fusion.signed_distance = arguments.signed_distance == "ray" ? SignedDistance::kRay : SignedDistance::kNormal;
  options.confirm = !arguments.no_confirm;
  options.views.rule = arguments.view_rule == "points"  ? ViewRule::kPoints
                       : arguments.view_rule == "angle" ? ViewRule::kAngle
                                                        : ViewRule::kAutomatic;
  const auto length = [](const char* name, const std::string& text, double& value) -> Expected<void> {
    const auto parsed = parse_length(name, text);
    if (!parsed) return std::unexpected(parsed.error());
    value = *parsed;
    return {};
  };
  for (const auto& parsed : {length("--depth-step", arguments.depth_step, options.sweep.depth_step),
                             length("--voxel-size", arguments.voxel_size, options.fusion.voxel_size),
                             length("--truncation", arguments.truncation, options.fusion.truncation)})
    if (!parsed) return parsed;
  const auto weighs_by = [&](const char* factor) { return std::ranges::count(arguments.weights, factor) > 0; };
  options.fusion.weigh_confidence = weighs_by("confidence");
  options.fusion.weigh_slant = weighs_by("slant");
  options.fusion.weigh_border = weighs_by("border");
  const auto memory = parse_size("--memory", arguments.memory);
  if (!memory) return std::unexpected(memory.error());
  options.memory_bytes = *memory;
  options.automatic_confidence = arguments.min_confidence == "auto";
  if (!options.automatic_confidence) {
    const char* end = arguments.min_confidence.data() + arguments.min_confidence.size();
    const auto [next, problem] = std::from_chars(arguments.min_confidence.data(), end, options.clean.min_confidence);
    if (problem != std::errc() || next != end)
      return std::unexpected(
          usage(fmt::format("--min-confidence {}: give a number, or auto", arguments.min_confidence)));
  }
  if (arguments.threads < 0 || arguments.threads > 1024)
    return std::unexpected(usage(fmt::format("--threads {}: give 1 to 1024, or 0 for all", arguments.threads)));
  return options.check();
}

}  // namespace

void add_format_options(CLI::App& app, SceneOptions& files) {
  const auto formats = scene_format_names();
  std::map<std::string, SceneFormat> names(formats.begin(), formats.end());
  app.add_option("--format", files.format, "How the cameras are written [what the folder shows]")
      ->transform(CLI::CheckedTransformer(names, CLI::ignore_case)
                      .description("auto, middlebury, colmap, transforms, mvsnet, bundler"))
      ->option_text("NAME");
  app.add_option("--images", files.images, "Folder of the photographs [beside the cameras]");
  app.add_option("--max-image-size", files.max_image_size,
                 "Halve photographs until no side has more pixels than this; 0: keep all")
      ->capture_default_str();
}

void RunArguments::add_scene_and_output(CLI::App& app) {
  app.add_option("scene", scene,
                 "Folder with the photographs and their cameras (Middlebury: *_par.txt, images, README.txt; "
                 "COLMAP: images, sparse; nerfstudio, MVSNet, Bundler)")
      ->required();
  add_output_options(app);
  add_format_options(app, files);
}

void RunArguments::add_output_options(CLI::App& app) {
  app.add_option("-o,--output", output, "Folder for the results; made if missing")->required();
  app.add_option("--bounds", bounds,
                 "Box that holds the object, x0 y0 z0 x1 y1 z1 [Middlebury: README.txt; else found]")
      ->expected(1, 6);
  app.add_option("--roi", files.roi, "The same box from a file: six numbers, or a .ply whose extent is taken");
  app.add_option("--masks", files.masks, "Folder with a mask per image (a.jpg.png or a.png); black is left out");
  app.add_flag("--cloud", cloud, "Also fuse the depth maps to a cloud of points, fused.ply");
  app.add_flag("--colmap", colmap, "Also write colmap/, a dense workspace for `colmap stereo_fusion`");
}

void RunArguments::add_depth_options(CLI::App& app) {
  const std::string group = "Depth maps (the paper, sections 2.1 and 4.1)";
  app.add_option("--neighbors", options.views.neighbor_count, "Views that each view is compared with")
      ->capture_default_str()
      ->group(group);
  app.add_option("--views", view_rule,
                 "How these are chosen. points: by shared sparse points; angle: the paper's rule; auto: as the scene's "
                 "files say, else points, else angle")
      ->check(CLI::IsMember({"auto", "points", "angle"}))
      ->capture_default_str()
      ->group(group);
  app.add_option("--min-angle", options.views.min_angle_deg, "Least angle between views chosen by angle, degrees")
      ->capture_default_str()
      ->group(group);
  app.add_option("--max-angle", options.views.max_angle_deg, "Largest angle to a compared view, degrees")
      ->capture_default_str()
      ->group(group);
  app.add_option("--window", options.sweep.window, "Side of the compared windows, pixels: 3, 5 … 15")
      ->capture_default_str()
      ->group(group);
  app.add_option("--second-window", options.sweep.second_window,
                 "Side of larger windows for pixels that find no depth, such as 9 for weak texture; 0: none")
      ->capture_default_str()
      ->group(group);
  app.add_option("--window-model", window_model,
                 "slanted: windows lie on the surface; plane: they follow the plane of the tested depth; axis: the "
                 "paper's axis-aligned windows")
      ->check(CLI::IsMember({"slanted", "plane", "axis"}))
      ->capture_default_str()
      ->group(group);
  app.add_flag("--no-slant", no_slant, "As --window-model plane")->group(group);
  app.add_option("--threshold", options.sweep.threshold, "Correlation from which on a view votes for a depth")
      ->capture_default_str()
      ->group(group);
  app.add_option("--min-votes", options.sweep.min_votes, "Votes that make a depth valid")
      ->capture_default_str()
      ->group(group);
  app.add_option("--depth-step", depth_step, "Distance of depth samples, such as 2.5mm; auto: from --step-pixels")
      ->capture_default_str()
      ->group(group);
  app.add_option("--step-pixels", options.sweep.step_pixels,
                 "Automatic step: largest motion in a compared view, pixels; 0: 2 for slanted windows, else 1")
      ->capture_default_str()
      ->group(group);
  app.add_option(
         "--support-tolerance", options.sweep.support_tolerance,
         "Pixels of a slanted window whose colors differ by more from its center's are left out, as long as 9 of "
         "25 stay; 255: none")
      ->capture_default_str()
      ->group(group);
  app.add_option("--refinement", options.sweep.refinement,
                 "The second pass of plane and axis divides the step by this; 1: no second pass")
      ->capture_default_str()
      ->group(group);
  app.add_option("--mask-below", options.mask_below,
                 "Leave out a background darker than this, 0 to 1 (0.19 for the dino); 0: keep all")
      ->capture_default_str()
      ->group(group);
}

void RunArguments::add_fusion_options(CLI::App& app) {
  const std::string group = kFusionGroup;
  app.add_option("--voxel-size", voxel_size, "Edge of a voxel, such as 0.5mm; auto: a pixel's footprint")
      ->capture_default_str()
      ->group(group);
  app.add_option("--truncation", truncation,
                 "Distance from a surface up to which voxels are filled; auto: 3 voxels; 4 with ray")
      ->capture_default_str()
      ->group(group);
  app.add_option("--signed-distance", signed_distance,
                 "Along what voxels measure it: normal of the surface, or ray, the line of sight as in the paper")
      ->check(CLI::IsMember({"normal", "ray"}))
      ->capture_default_str()
      ->group(group);
  app.add_option("--max-slope", options.fusion.max_slope_deg, "Steepest triangle of a depth map, degrees")
      ->capture_default_str()
      ->group(group);
  app.add_option("--feather", options.fusion.feather, "Pixels over which weights rise from a border")
      ->capture_default_str()
      ->group(group);
  app.add_option("--weights", weights, "What a depth's weight is made of: confidence, slant, border; or none")
      ->delimiter(',')
      ->check(CLI::IsMember({"confidence", "slant", "border", "none"}))
      ->capture_default_str()
      ->group(group);
  app.add_flag("--no-confirm", no_confirm,
               "The paper's confidence alone: depths don't gain or lose by what other views' depth maps say")
      ->group(group);
  app.add_flag(
         "--fill-holes", options.fusion.fill_holes,
         "Close holes by space carving, confidence 0 there; nothing is where masks and --mask-below leave out pixels")
      ->group(group);
  app.add_option("--min-confidence", min_confidence,
                 "Drop triangles of less; 1 is one view that is fully confident; 0 keeps all")
      ->capture_default_str()
      ->group(group);
  app.add_option("--min-component", options.clean.min_component_triangles, "Drop pieces of fewer triangles")
      ->capture_default_str()
      ->group(group);
  app.add_flag("--largest-component", options.clean.largest_component, "Keep the largest piece alone")->group(group);
}

void RunArguments::add_fuse_options(CLI::App& app) {
  add_fusion_options(app);
  app.add_option("--mask-below", options.mask_below,
                 "With --fill-holes: what is darker than this, 0 to 1, and has no depth is background; 0: none")
      ->capture_default_str()
      ->needs("--fill-holes")
      ->group(kFusionGroup);
}

void RunArguments::add_device_options(CLI::App& app) {
  const std::string group = kDeviceGroup;
  app.add_option("--device", device, "auto, cpu, an index or a part of a name of `quorum devices`")
      ->capture_default_str()
      ->group(group);
  app.add_option("--threads", threads, "CPU threads; 0: all")->capture_default_str()->group(group);
  app.add_option("--memory", memory,
                 "What the run may hold in memory, such as 4GiB; auto: three quarters of what is free")
      ->capture_default_str()
      ->group(group);
  app.add_option("--tile", tile, "Tile of the CPU sweep, width height in pixels")
      ->expected(2)
      ->capture_default_str()
      ->group(group);
  app.add_option("--simd", simd, "Instructions of the sweep and the fusion on the CPU")
      ->check(CLI::IsMember({"auto", "baseline", "avx2", "avx512"}))
      ->capture_default_str()
      ->group(group);
  app.add_flag("--quiet", quiet, "Print nothing but errors")->group(group);
}

void RunArguments::add_device_and_output_options(CLI::App& app) {
  add_device_options(app);
  app.add_flag("--json", json, "Print run.json to standard output at the end, and nothing else there")
      ->group(kDeviceGroup);
}

Expected<void> reconstruct_scene(const Scene& scene, const ReconstructOptions& options, Backend& backend,
                                 const Workspace& workspace, Progress& progress, RunReport& report) {
  auto done = compute_depth_maps(scene, options, backend, workspace, progress, report);
  return done ? fuse_depth_maps(scene, options, backend, workspace, progress, report) : done;
}

namespace {

/// What is made of the depth maps beside the mesh.
Expected<void> write_extras(const RunArguments& arguments, const Scene& scene, const Workspace& workspace,
                            Progress& progress, RunReport& report) {
  if (arguments.cloud) {
    const StageTimer timer(report, "fuse_points");
    const auto cloud = fuse_points(scene, arguments.options, workspace, progress);
    if (!cloud) return std::unexpected(cloud.error());
    if (auto written = write_ply(workspace.cloud_path(), *cloud); !written) return written;
  }
  if (!arguments.colmap) return {};
  const StageTimer timer(report, "write_colmap");
  return write_colmap_workspace(workspace.colmap_path(), scene, arguments.options, workspace, progress);
}

}  // namespace

Expected<void> run_pipeline(RunArguments& arguments, const PipelineStages& stages) {
  if (auto resolved = resolve(arguments); !resolved) return resolved;
  auto bounds = parse_bounds(arguments.bounds);
  if (!bounds) return std::unexpected(bounds.error());
  auto cpu = cpu_options(arguments);
  if (!cpu) return std::unexpected(cpu.error());
  std::optional<tbb::global_control> limit;
  if (arguments.threads > 0)
    limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(arguments.threads));

  ConsoleProgress progress(arguments.quiet);
  arguments.files.bounds = *bounds;
  auto scene = read_scene(arguments.scene, arguments.files);
  if (!scene) return std::unexpected(scene.error());
  auto backend = open_backend(arguments.device, *cpu);
  if (!backend) return std::unexpected(backend.error());
  auto workspace = Workspace::open(arguments.output);
  if (!workspace) return std::unexpected(workspace.error());

  RunReport report;
  report.device = (*backend)->description();
  progress.note(fmt::format("{} views, on {}", scene->views.size(), report.device));
  const double wall_start = wall_seconds();
  const double cpu_start = process_cpu_seconds();
  auto done = stages(*scene, arguments.options, **backend, *workspace, progress, report);
  if (done) done = write_extras(arguments, *scene, *workspace, progress, report);
  report.wall_seconds = wall_seconds() - wall_start;
  report.cpu_seconds = process_cpu_seconds() - cpu_start;
  progress.finish();
  if (!done) return done;
  const std::string json = run_json(*scene, arguments.options, report);
  if (auto written = write_file(workspace->report_path(), json); !written) return written;
  if (arguments.json) fmt::print("{}", json);
  progress.note(fmt::format("{}: {:.1f} s, {:.1f} CPU s, {} MiB at most", workspace->folder().string(),
                            report.wall_seconds, report.cpu_seconds, peak_memory_bytes() >> 20));
  return {};
}

}  // namespace quorum
