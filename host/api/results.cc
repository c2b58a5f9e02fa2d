#include <fmt/format.h>

#include "engine/io/file.h"
#include "engine/io/ply.h"
#include "host/api/boundary.h"
#include "host/api/results_state.h"
#include "host/api/scene_state.h"

namespace quorum::v0 {
namespace {

using quorum::Expected;

std::vector<float> flat(const std::vector<Eigen::Vector3f>& vectors) {
  std::vector<float> values;
  values.reserve(3 * vectors.size());
  for (const Eigen::Vector3f& vector : vectors) values.insert(values.end(), vector.data(), vector.data() + 3);
  return values;
}

/// The maps of a view that are there.
Expected<DepthMap> load(const quorum::Workspace& workspace, const quorum::View& view) {
  const auto has = [&](bool correlation, bool confidence, bool normals) {
    return workspace.has_maps(view.name, {correlation, confidence, normals});
  };
  DepthMap map{view.width, view.height, {}, {}, {}, {}, {}};
  QUORUM_ASSIGN(auto depth, workspace.load_depth(view.name, view.width, view.height));
  map.depth = std::move(depth.values);
  if (has(true, true, false)) {
    QUORUM_ASSIGN(auto all, workspace.load_depth_map(view.name, view.width, view.height));
    map.correlation = std::move(all.correlation.values);
    map.confidence = std::move(all.confidence.values);
  } else if (has(false, true, false)) {
    QUORUM_ASSIGN(auto weighed, workspace.load_weighed_depth(view.name, view.width, view.height, false));
    map.confidence = std::move(weighed.confidence.values);
  }
  if (has(false, false, true)) {
    QUORUM_ASSIGN(const auto normals, workspace.load_normals(view.name, view.width, view.height));
    map.normal = flat(normals.values);
  }
  if (!workspace.certainty_record(view.name).empty()) {
    QUORUM_ASSIGN(auto certainty, workspace.load_certainty(view.name, view.width, view.height));
    map.certainty = std::move(certainty.values);
  }
  return map;
}

Mesh outward(const quorum::Mesh& mesh) {
  Mesh given;
  for (const quorum::Vertex& vertex : mesh.vertices) {
    given.positions.insert(given.positions.end(), vertex.position.data(), vertex.position.data() + 3);
    given.normals.insert(given.normals.end(), vertex.normal.data(), vertex.normal.data() + 3);
    for (const std::uint32_t channel :
         {quorum::red_of(vertex.color), quorum::green_of(vertex.color), quorum::blue_of(vertex.color)})
      given.colors.push_back(static_cast<std::uint8_t>(channel));
    given.confidence.push_back(vertex.confidence);
  }
  for (const auto& triangle : mesh.triangles)
    given.triangles.insert(given.triangles.end(), triangle.begin(), triangle.end());
  given.offset = {mesh.offset.x(), mesh.offset.y(), mesh.offset.z()};
  return given;
}

const quorum::View& view_at(const Scene& scene, int index) {
  require_view(scene, index);
  return scene.state()->scene.views[static_cast<std::size_t>(index)];
}

}  // namespace

Result<Results> Results::open(const Scene& scene, const std::filesystem::path& workspace) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(workspace, ignored))
    return Error{ErrorKind::kInput, fmt::format("{}: no such folder; check the path", workspace.string())};
  return Results(std::make_shared<const State>(scene, quorum::Workspace::at(workspace), std::nullopt));
}

const Scene& Results::scene() const { return state_->scene; }

const std::filesystem::path& Results::folder() const { return state_->workspace.folder(); }

bool Results::has_depth_map(int view) const {
  return state_->workspace.has_depth_map(view_at(state_->scene, view).name);
}

Result<DepthMap> Results::depth_map(int view) const {
  const quorum::View& asked = view_at(state_->scene, view);
  return at_boundary<DepthMap>([&]() -> Expected<DepthMap> {
    if (!has_depth_map(view))
      return quorum::failure(quorum::ErrorKind::kInput,
                             fmt::format("{}: holds no depth map of view {}; the notes of its run tell why",
                                         (folder() / "depth").string(), asked.name));
    return load(state_->workspace, asked);
  });
}

Result<Mesh> Results::mesh() const {
  return at_boundary<Mesh>([&]() -> Expected<Mesh> {
    QUORUM_ASSIGN(const quorum::Mesh mesh,
                  quorum::read_ply(state_->workspace.mesh_path(), state_->scene.state()->scene.offset));
    return outward(mesh);
  });
}

Result<std::string> Results::report() const {
  return at_boundary<std::string>([&] { return quorum::read_file(state_->workspace.report_path()); });
}

}  // namespace quorum::v0
