#include "engine/pipeline/fuse_points.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/io/image_store.h"
#include "engine/io/ply.h"
#include "engine/mesh/drop_specks.h"

namespace quorum {
namespace {

constexpr double kAgreement = 0.01;  // of the depth
constexpr double kReprojection = 1.5;

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
void add_points(FusedView& reference, std::vector<FusedView>& neighbors, const ColorImage& image, int least_views,
                Mesh& cloud) {
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
      if (static_cast<int>(sightings.size()) + 1 < least_views) continue;
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

Expected<Mesh> fuse_points(Run& run) {
  QUORUM_ASSIGN(const std::vector<int> references, run.views_with_depth_map());
  run.progress.stage("fusing points", static_cast<int>(references.size()));
  std::vector<std::vector<bool>> used(run.scene.views.size());
  const auto load = [&](int index) -> Expected<FusedView> {
    const View& view = run.view(index);
    const bool confirmed = run.options.confirm;
    QUORUM_ASSIGN(auto map, run.workspace.load_weighed_depth(view.name, view.width, view.height, confirmed));
    if (confirmed) leave_out_dropped(map.confidence, map.depth);
    std::vector<bool>& bits = used[static_cast<std::size_t>(index)];
    bits.resize(map.depth.values.size());
    return FusedView{view, std::move(map), bits};
  };
  ImageStore images(run.scene, 0);
  Mesh cloud;
  for (const int index : references) {
    if (run.progress.stop_requested()) return std::unexpected(stopped());
    std::vector<int> selected = select_views(run.scene, index, run.options.views);
    QUORUM_TRY(run.require(cloud_memory(run.scene, index, selected, cloud.vertices.size(), cloud.vertices.capacity()),
                           "fusing points"));
    std::erase_if(selected, [&](int neighbor) { return !std::ranges::binary_search(references, neighbor); });
    QUORUM_ASSIGN(auto reference, load(index));
    const View& view = reference.view;
    QUORUM_ASSIGN(reference.map.normal, run.workspace.load_normals(view.name, view.width, view.height));
    std::vector<FusedView> neighbors;
    for (const int neighbor : selected) {
      QUORUM_ASSIGN(auto loaded, load(neighbor));
      neighbors.push_back(std::move(loaded));
    }
    QUORUM_ASSIGN(const auto image, images.image(index));
    add_points(reference, neighbors, *image, run.options.cloud_views, cloud);
    run.progress.step();
  }
  drop_doubtful(cloud);
  return cloud;
}

Expected<void> write_cloud(Run& run) {
  const StageTimer timer(run.report, "fuse_points");
  QUORUM_ASSIGN(Mesh cloud, fuse_points(run));
  cloud.offset = run.scene.offset;
  QUORUM_TRY(run.require(cloud_file_memory(cloud.vertices.size()), "writing the cloud"));
  return write_ply(run.workspace.cloud_path(), cloud, run.options.frame);
}

}  // namespace quorum
