#include "engine/pipeline/run_json.h"

#include <nlohmann/json.hpp>

#include "engine/core/memory.h"
#include "engine/core/version.h"

namespace quorum {
namespace {

using Json = nlohmann::ordered_json;

/// The factors of a vertex's weight, as --weights takes them.
Json weights_json(const FusionOptions& fusion) {
  Json factors = Json::array();
  if (fusion.weigh_confidence) factors.push_back("confidence");
  if (fusion.weigh_slant) factors.push_back("slant");
  if (fusion.weigh_border) factors.push_back("border");
  return factors;
}

Json json_of(const ReconstructOptions& options) {
  const auto automatic = [](double length) { return length > 0 ? Json(length) : Json("auto"); };
  const char* rule = options.views.rule == ViewRule::kPoints  ? "points"
                     : options.views.rule == ViewRule::kAngle ? "angle"
                                                              : "auto";
  return {{"neighbors", options.views.neighbor_count},
          {"views", rule},
          {"min_angle_deg", options.views.min_angle_deg},
          {"max_angle_deg", options.views.max_angle_deg},
          {"window", options.sweep.window},
          {"second_window", options.sweep.second_window},
          {"window_model", window_model_name(options.sweep.window_model)},
          {"threshold", options.sweep.threshold},
          {"min_votes", options.sweep.min_votes},
          {"depth_step", automatic(options.sweep.depth_step)},
          {"step_pixels", options.sweep.automatic_step_pixels()},
          {"support_tolerance", options.sweep.support_tolerance},
          {"refinement", options.sweep.refinement},
          {"mask_below", options.mask_below},
          {"voxel_size", automatic(options.fusion.voxel_size)},
          {"truncation", automatic(options.fusion.truncation)},
          {"max_slope_deg", options.fusion.max_slope_deg},
          {"feather", options.fusion.feather},
          {"signed_distance", options.fusion.signed_distance == SignedDistance::kNormal ? "normal" : "ray"},
          {"weights", weights_json(options.fusion)},
          {"fill_holes", options.fusion.fill_holes},
          {"confirm", options.confirm},
          {"min_confidence", options.automatic_confidence ? Json("auto") : Json(options.clean.min_confidence)},
          {"min_component", options.clean.min_component_triangles},
          {"largest_component", options.clean.largest_component}};
}

}  // namespace

std::string options_json(const ReconstructOptions& options) { return json_of(options).dump(2) + "\n"; }

std::string run_json(const Scene& scene, const ReconstructOptions& options, const RunReport& report) {
  Json stages = Json::array();
  for (const StageReport& stage : report.stages)
    stages.push_back({{"name", stage.name}, {"wall_seconds", stage.wall_seconds}, {"cpu_seconds", stage.cpu_seconds}});
  Json kernels = Json::array();
  for (const StageTime& kernel : report.kernels)
    kernels.push_back({{"name", kernel.name}, {"seconds", kernel.seconds}});
  Json views = Json::array();
  for (const ViewReport& view : report.views)
    views.push_back({{"name", view.name},
                     {"neighbors", view.neighbors},
                     {"swept_pixels", view.swept_pixels},
                     {"depth_samples", view.depth_samples},
                     {"valid_pixels", view.valid_pixels}});
  const auto point = [](const Eigen::Vector3d& p) { return Json{p.x(), p.y(), p.z()}; };
  const Json all = {
      {"version", version()},
      {"device", report.device},
      {"scene", {{"views", scene.views.size()}, {"bounds", {point(scene.bounds.low), point(scene.bounds.high)}}}},
      {"options", json_of(options)},
      {"wall_seconds", report.wall_seconds},
      {"cpu_seconds", report.cpu_seconds},
      {"stages", stages},
      {"kernels", kernels},
      {"work",
       {{"sweep_windows", report.sweep.sweep_windows},
        {"sweep_samples", report.sweep.sweep_samples},
        {"refine_windows", report.sweep.refine_windows},
        {"refine_samples", report.sweep.refine_samples}}},
      {"memory_budget_bytes", report.memory_budget_bytes},
      {"peak_memory_bytes", peak_memory_bytes()},
      {"volume",
       {{"voxel_size", report.voxel_size},
        {"truncation", report.truncation},
        {"blocks", report.blocks},
        {"block_views", report.block_views},
        {"slabs", report.slabs}}},
      {"mesh",
       {{"min_confidence", report.min_confidence},
        {"extracted_triangles", report.extracted_triangles},
        {"triangles", report.triangles},
        {"vertices", report.vertices},
        {"filled_vertices", report.filled_vertices}}},
      {"depth_maps", views}};
  return all.dump(2) + "\n";
}

}  // namespace quorum
