#include "engine/report/page_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/io/file.h"
#include "engine/io/image_store.h"
#include "engine/io/ply.h"
#include "engine/io/preview.h"
#include "engine/io/sha256.h"
#include "engine/mesh/simplify.h"
#include "engine/pipeline/run.h"
#include "engine/report/data_url.h"
#include "engine/report/holes.h"
#include "engine/report/packed_mesh.h"
#include "engine/report/page_texture.h"
#include "engine/report/run_record.h"

namespace quorum {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t kPageTriangles = 160'000;
Json numbers(const Eigen::Vector3d& vector) { return {vector.x(), vector.y(), vector.z()}; }

/// Width of a photograph on the page, pixels: the pictures of all views together stay below some 8 MB.
int picture_width(std::size_t views) { return views <= 48 ? 640 : views <= 120 ? 400 : 240; }

/// Value that a share of the vertices do not exceed; 1 if it would be 0.
float percentile(const Mesh& mesh, double share) {
  std::vector<float> values;
  for (const Vertex& vertex : mesh.vertices) values.push_back(vertex.confidence);
  if (values.empty()) return 1;
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, place);
  return *place > 0 ? *place : 1;
}

Json histogram(const Mesh& mesh, float full) {
  std::vector<std::uint64_t> counts(40);
  for (const Vertex& vertex : mesh.vertices) {
    const auto last = static_cast<float>(counts.size() - 1);
    ++counts[static_cast<std::size_t>(
        std::clamp(vertex.confidence / full * static_cast<float>(counts.size()), 0.0F, last))];
  }
  return {{"full", full}, {"counts", counts}};
}

/// Adds to each vertex the views whose depth meets it within the tolerance, scene units.
void count_views(const Mesh& mesh, const View& view, const Grid<float>& depth, double tolerance,
                 std::vector<int>& counts) {
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const Eigen::Vector3d pixel = view.camera.project(mesh.vertices[i].position.cast<double>());
    if (!(pixel.z() > 0 && pixel.x() > -0.5 && pixel.y() > -0.5 && pixel.x() < depth.width && pixel.y() < depth.height))
      continue;
    const auto x = static_cast<int>(std::lround(pixel.x()));
    const auto y = static_cast<int>(std::lround(pixel.y()));
    if (!depth.contains(x, y) || depth.at(x, y) <= 0) continue;
    if (std::abs(static_cast<double>(depth.at(x, y)) - pixel.z()) < tolerance) ++counts[i];
  }
}

/// What would close a hole, in a line.
std::string remedy(const Scene& scene, const Hole& hole) {
  std::string nearest;
  for (const int view : hole.nearest)
    nearest += fmt::format("{}{} ({:.0f}° away)", nearest.empty() ? "" : " and ", scene.views[view].name,
                           angle_to_view(hole, scene.views[view]));
  if (hole.seen_by.size() < 3)
    return fmt::format(
        "{} of {} photographs look into it: take two or three more from there, between those nearest: {}",
        hole.seen_by.size(), scene.views.size(), nearest);
  return fmt::format(
      "{} photographs look into it, but too few agree on a depth: gloss, weak texture or a deep cavity; closer ones "
      "may help",
      hole.seen_by.size());
}

Json holes_json(const Scene& scene, const Mesh& mesh, const std::vector<Hole>& holes) {
  Json list = Json::array();
  for (const Hole& hole : holes) {
    Json line = Json::array();
    const std::size_t step = hole.edges.size() / 3000 + 1;
    for (std::size_t i = 0; i < hole.edges.size(); i += step)
      for (const std::uint32_t index : hole.edges[i])
        for (const float value : mesh.vertices[index].position) line.push_back(value);
    Json nearest = Json::array();
    for (const int view : hole.nearest) nearest.push_back(scene.views[view].name);
    list.push_back({{"center", numbers(hole.center)},
                    {"normal", numbers(hole.normal)},
                    {"diameter", hole.diameter},
                    {"seen_by", hole.seen_by.size()},
                    {"nearest", nearest},
                    {"remedy", remedy(scene, hole)},
                    {"line", line}});
  }
  return list;
}

Json camera_json(const View& view) {
  Json rotation = Json::array();
  for (int row = 0; row < 3; ++row) rotation.push_back(numbers(view.camera.camera_from_world.row(row).transpose()));
  return {{"center", numbers(view.camera.center())},
          {"rotation", rotation},
          {"size", {view.width, view.height}},
          {"focal", view.camera.intrinsics(1, 1)},
          {"middle", {view.camera.intrinsics(0, 2), view.camera.intrinsics(1, 2)}}};
}

/// One view: its pictures, and what its depth map says of the vertices. counts: as count_views.
Expected<Json> view_json(const Workspace& workspace, const View& view, ImageStore& images, int index, int width,
                         const Grid<float>& depth) {
  const auto measured = std::ranges::count_if(depth.values, [](float value) { return value > 0; });
  QUORUM_ASSIGN(const auto photograph, images.image(index));
  QUORUM_ASSIGN(const auto picture, data_url(*photograph, width));
  const bool is_confirmed = !workspace.certainty_record(view.name).empty();
  QUORUM_ASSIGN(const auto certainty, is_confirmed ? workspace.load_certainty(view.name, view.width, view.height)
                                                   : Expected<Grid<float>>(depth));
  QUORUM_ASSIGN(const auto preview,
                data_url(is_confirmed ? color_map_unit(certainty) : color_map_depth(depth), width / 2));
  QUORUM_ASSIGN(const auto bytes, read_file(view.image_path));
  return Json{{"name", view.name},
              {"camera", camera_json(view)},
              {"neighbors", neighbor_names(workspace, view.name)},
              {"valid", static_cast<double>(measured) / std::max<double>(1, static_cast<double>(depth.values.size()))},
              {"photograph", picture},
              {is_confirmed ? "certainty" : "depth", preview},
              {"sha256", sha256(bytes)}};
}

/// JSON that no name of a view can end early as it stands in a page.
std::string for_script(std::string_view json) {
  std::string text;
  text.reserve(json.size());
  for (const char letter : json) {
    if (letter == '<')
      text += "\\u003c";
    else
      text += letter;
  }
  return text;
}

}  // namespace

Expected<std::string> page_data(const Scene& scene, const Workspace& workspace, const MemoryBudget& budget,
                                Progress& progress) {
  QUORUM_ASSIGN(const Json run, read_run(workspace));
  QUORUM_ASSIGN(const Mesh whole, read_ply(workspace.mesh_path(), scene.offset));
  QUORUM_ASSIGN(const auto mesh_bytes, read_file(workspace.mesh_path()));
  const bool is_large = whole.triangles.size() > kPageTriangles;
  QUORUM_ASSIGN(
      const TexturedMesh shown,
      texture_for_page(is_large ? simplify(whole, {.triangles = kPageTriangles}) : whole, scene, budget, progress));
  const Mesh& mesh = shown.mesh;
  const Json truncation = run.value("volume", Json::object()).value("truncation", Json());
  const double tolerance = truncation.is_number() ? truncation.get<double>() : scene.bounds.size().norm() / 200;

  std::vector<Hole> holes = find_holes(whole, bounds_of(run, scene));
  std::vector<int> counts(mesh.vertices.size());
  Json views = Json::array();
  ImageStore images(scene, 0);
  const int width = picture_width(scene.views.size());
  progress.stage("writing the report", static_cast<int>(scene.views.size()));
  for (int i = 0; i < static_cast<int>(scene.views.size()); ++i) {
    const View& view = scene.views[i];
    if (!workspace.has_depth_map(view.name)) continue;  // views that take no part have none
    QUORUM_ASSIGN(const auto depth, workspace.load_depth(view.name, view.width, view.height));
    count_views(mesh, view, depth, tolerance, counts);
    QUORUM_ASSIGN(Json entry, view_json(workspace, view, images, i, width, depth));
    views.push_back(std::move(entry));
    progress.step();
    if (progress.stop_requested()) return std::unexpected(stopped());
  }
  QUORUM_TRY(find_views(
      scene,
      [&](int i) -> Expected<Grid<float>> {
        const View& view = scene.views[i];
        if (!workspace.has_depth_map(view.name)) return Grid<float>(view.width, view.height);
        return workspace.load_depth(view.name, view.width, view.height);
      },
      holes));

  const float full = percentile(whole, 0.95);
  const PackedMesh packed = pack_mesh(mesh, counts, full);
  Json data;
  data["mesh"] = {{"low", numbers(packed.low.cast<double>())},
                  {"size", numbers(packed.size.cast<double>())},
                  {"positions", packed.positions},
                  {"colors", packed.colors},
                  {"confidence", packed.confidence},
                  {"views", packed.views},
                  {"triangles", packed.triangles},
                  {"all_triangles", whole.triangles.size()},
                  {"all_vertices", whole.vertices.size()},
                  {"shown_triangles", mesh.triangles.size()},
                  {"sha256", sha256(mesh_bytes)}};
  QUORUM_ASSIGN(data["mesh"]["texture"], texture_json(shown));
  data["views"] = views;
  data["holes"] = holes_json(scene, whole, holes);
  data["histogram"] = histogram(whole, full);
  data["run"] = run;
  data["verified"] = read_verified(workspace);
  return for_script(data.dump(-1, ' ', true));
}

}  // namespace quorum
