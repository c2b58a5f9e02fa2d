#include <fmt/format.h>

#include "engine/io/scene_folder.h"
#include "host/api/boundary.h"
#include "host/api/options_state.h"
#include "host/api/scene_state.h"
#include "host/run/open_backend.h"

namespace quorum::v0 {
namespace {

/// World as in the scene's files.
Camera outward(const quorum::Camera& camera, const Eigen::Vector3d& offset) {
  Camera given;
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(given.intrinsics.data()) = camera.intrinsics;
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(given.camera_from_world.data()) = camera.camera_from_world;
  Eigen::Map<Eigen::Vector3d>(given.translation.data()) = camera.translation - camera.camera_from_world * offset;
  return given;
}

}  // namespace

Result<Scene> Scene::read(const std::filesystem::path& folder, const Options& options) {
  return at_boundary<Scene>([&]() -> quorum::Expected<Scene> {
    QUORUM_ASSIGN(const quorum::RunOptions run, run_options_of(options));
    const quorum::ThreadLimit limit(run.threads);
    QUORUM_ASSIGN(quorum::Scene scene, quorum::read_scene(folder, run.files));
    return Scene(std::make_shared<const State>(std::move(scene), run, std::nullopt));
  });
}

int Scene::view_count() const { return static_cast<int>(state_->scene.views.size()); }

ViewInfo Scene::view(int index) const {
  require_view(*this, index);
  const quorum::View& view = state_->scene.views[static_cast<std::size_t>(index)];
  return {view.name,       view.image_name, view.width, view.height, outward(view.camera, state_->scene.offset),
          view.near_depth, view.far_depth};
}

std::array<double, 6> Scene::bounds() const {
  const Eigen::Vector3d low = state_->scene.bounds.low + state_->scene.offset;
  const Eigen::Vector3d high = state_->scene.bounds.high + state_->scene.offset;
  return {low.x(), low.y(), low.z(), high.x(), high.y(), high.z()};
}

std::vector<std::string> Scene::notes() const { return state_->scene.notes; }

void require_view(const Scene& scene, int view) {
  if (view < 0 || view >= scene.view_count())
    end_by_misuse(fmt::format("view {} was asked for; the scene has {}", view, scene.view_count()));
}

}  // namespace quorum::v0
