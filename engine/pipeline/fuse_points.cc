#include "engine/pipeline/fuse_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/io/image_store.h"
#include "engine/pipeline/memory_budget.h"

namespace quorum {
namespace {

constexpr double kAgreement = 0.01;  // of the depth
constexpr double kReprojection = 1.5;
constexpr int kLeastNeighbors = 2;

/// A depth map with what the fusion knows of its view.
struct FusedView {
  const View& view;
  DepthMap map;
  std::vector<bool>& used;  ///< pixels that belong to a point

  [[nodiscard]] std::size_t place(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(map.depth.width) + static_cast<std::size_t>(x);
  }
  [[nodiscard]] Eigen::Vector3d point(int x, int y) const {
    return view.camera.unproject(x, y, static_cast<double>(map.depth.at(x, y)));
  }
};

/// Sums of what agrees on a point.
struct Agreement {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double weight = 0.0;

  void add(const Eigen::Vector3d& point, float confidence) {
    position += static_cast<double>(confidence) * point;
    weight += static_cast<double>(confidence);
  }
};

/// A pixel of a neighbor that agrees with a point.
struct Sighting {
  FusedView* view = nullptr;
  int x = 0;
  int y = 0;
};

/// The pixel of a neighbor that shows the point seen at (x, y), if its depth agrees.
std::optional<Sighting> find_agreeing(FusedView& other, const FusedView& reference, int x, int y,
                                      const Eigen::Vector3d& point) {
  const Eigen::Vector3d pixel = other.view.camera.project(point);
  if (!(pixel.z() > 0 && pixel.x() > -0.5 && pixel.y() > -0.5 && pixel.x() < other.view.width - 0.5 &&
        pixel.y() < other.view.height - 0.5))
    return std::nullopt;
  const int u = static_cast<int>(std::lround(pixel.x()));
  const int v = static_cast<int>(std::lround(pixel.y()));
  const double depth = static_cast<double>(other.map.depth.at(u, v));
  if (depth <= 0 || std::abs(depth - pixel.z()) > kAgreement * pixel.z()) return std::nullopt;
  const Eigen::Vector3d back = reference.view.camera.project(other.point(u, v));
  if (!(back.z() > 0) || std::hypot(back.x() - x, back.y() - y) > kReprojection) return std::nullopt;
  return Sighting{&other, u, v};
}

/// What a view takes at most beside its cloud: maps of it and its neighbors, one of them as a file's bytes, normals,
/// the photograph; and the cloud's growth, if each pixel made a point.
std::uint64_t view_bytes(const Scene& scene, int reference, const std::vector<int>& neighbors, const Mesh& cloud) {
  constexpr std::uint64_t kMapBytes = 12;
  constexpr std::uint64_t kViewBytes = 4 + 12 + 8;
  constexpr std::uint64_t kDistortedBytes = 12;
  const auto area = [](int width, int height) {
    return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  };
  const View& view = scene.views[static_cast<std::size_t>(reference)];
  const std::uint64_t pixels = area(view.width, view.height);
  std::uint64_t bytes = (kMapBytes + kViewBytes) * pixels + kDistortedBytes * area(view.photo_width, view.photo_height);
  for (const int neighbor : neighbors) {
    const View& other = scene.views[static_cast<std::size_t>(neighbor)];
    bytes += kMapBytes * area(other.width, other.height);
  }
  const std::uint64_t points = cloud.vertices.size() + pixels;
  if (points > cloud.vertices.capacity()) bytes += std::max(2 * cloud.vertices.size(), points) * sizeof(Vertex);
  return bytes;
}

/// Drops the points of least confidence: chance agreements where there is no texture.
void drop_doubtful(Mesh& cloud) {
  constexpr float kLeastShare = 0.25F;  // of the median
  std::vector<float> confidences;
  for (const Vertex& vertex : cloud.vertices) confidences.push_back(vertex.confidence);
  if (confidences.empty()) return;
  const auto middle = confidences.begin() + static_cast<std::ptrdiff_t>(confidences.size() / 2);
  std::ranges::nth_element(confidences, middle);
  std::erase_if(cloud.vertices, [least = kLeastShare * *middle](const Vertex& v) { return v.confidence < least; });
}

/// Adds the points that a view begins.
void add_points(FusedView& reference, std::vector<FusedView>& neighbors, const ColorImage& image, Mesh& cloud) {
  const Eigen::Matrix3f world_from_camera = reference.view.camera.camera_from_world.transpose().cast<float>();
  std::vector<Sighting> sightings;
  for (int y = 0; y < reference.map.depth.height; ++y) {
    for (int x = 0; x < reference.map.depth.width; ++x) {
      if (!(reference.map.depth.at(x, y) > 0.0F) || reference.used[reference.place(x, y)]) continue;
      const Eigen::Vector3d point = reference.point(x, y);
      Agreement sum;
      sum.add(point, reference.map.confidence.at(x, y));
      sightings.clear();
      for (FusedView& other : neighbors)
        if (const auto found = find_agreeing(other, reference, x, y, point)) sightings.push_back(*found);
      if (static_cast<int>(sightings.size()) < kLeastNeighbors) continue;
      for (const Sighting& seen : sightings) {
        sum.add(seen.view->point(seen.x, seen.y), seen.view->map.confidence.at(seen.x, seen.y));
        seen.view->used[seen.view->place(seen.x, seen.y)] = true;
      }
      const Eigen::Vector3d position = sum.weight > 0 ? Eigen::Vector3d(sum.position / sum.weight) : point;
      cloud.vertices.push_back({position.cast<float>(), world_from_camera * reference.map.normal.at(x, y),
                                image.at(x, y), static_cast<float>(sum.weight)});
    }
  }
}

}  // namespace

Expected<Mesh> fuse_points(const Scene& scene, const ReconstructOptions& options, const Workspace& workspace,
                           Progress& progress) {
  const auto has_map = [&](int view) {
    return workspace.has_depth_map(scene.views[static_cast<std::size_t>(view)].name);
  };
  std::vector<int> references;
  for (int view = 0; view < static_cast<int>(scene.views.size()); ++view)
    if (has_map(view)) references.push_back(view);
  if (references.empty())
    return failure(ErrorKind::kInput, fmt::format("{}: holds no depth map of this scene; run `quorum depth` first",
                                                  (workspace.folder() / "depth").string()));
  progress.stage("fusing points", static_cast<int>(references.size()));
  std::vector<std::vector<bool>> used(scene.views.size());
  const auto load = [&](int index) -> Expected<FusedView> {
    const View& view = scene.views[static_cast<std::size_t>(index)];
    auto map = workspace.load_depth_map(view.name, view.width, view.height);
    if (!map) return std::unexpected(map.error());
    if (options.confirm) {
      auto certainty = workspace.load_certainty(view.name, view.width, view.height);
      if (!certainty) return std::unexpected(certainty.error());
      map->confidence = std::move(*certainty);
    }
    std::vector<bool>& bits = used[static_cast<std::size_t>(index)];
    bits.resize(map->depth.values.size());
    return FusedView{view, std::move(*map), bits};
  };
  const MemoryBudget budget(options.memory_bytes);
  ImageStore images(scene, 0);
  Mesh cloud;
  for (const int index : references) {
    if (progress.stop_requested()) return failure(ErrorKind::kStopped, "stopped as asked; finished files are kept");
    const std::vector<int> selected = select_views(scene, index, options.views);
    if (auto fits = budget.require(view_bytes(scene, index, selected, cloud), "fusing points"); !fits)
      return std::unexpected(fits.error());
    auto reference = load(index);
    if (!reference) return std::unexpected(reference.error());
    auto normals = workspace.load_normals(reference->view.name, reference->view.width, reference->view.height);
    if (!normals) return std::unexpected(normals.error());
    reference->map.normal = std::move(*normals);
    std::vector<FusedView> neighbors;
    for (const int neighbor : selected) {
      if (!has_map(neighbor)) continue;
      auto loaded = load(neighbor);
      if (!loaded) return std::unexpected(loaded.error());
      neighbors.push_back(std::move(*loaded));
    }
    const auto image = images.image(index);
    if (!image) return std::unexpected(image.error());
    add_points(*reference, neighbors, **image, cloud);
    progress.step();
  }
  drop_doubtful(cloud);
  constexpr std::uint64_t kFileBytes = 35;  // a point in a PLY file, whose bytes are held as a whole
  if (auto fits = budget.require(kFileBytes * cloud.vertices.size(), "writing the cloud"); !fits)
    return std::unexpected(fits.error());
  return cloud;
}

}  // namespace quorum
