#include "engine/pipeline/plan.h"

#include <gtest/gtest.h>

#include "engine/io/write_image.h"
#include "engine/pipeline/cpu_backend.h"
#include "engine/pipeline/memory_estimates.h"
#include "tests/support/sphere_scene.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

/// A sphere whose texture the noise nearly hides, so that full size leaves many pixels without a depth.
struct PlanOfWeakTexture : ::testing::Test {
  PlanOfWeakTexture() {
    for (std::size_t i = 0; i < sphere.images.size(); ++i) {
      View& view = sphere.scene.views[i];
      view.image_path = folder.path() / (view.name + ".png");
      EXPECT_TRUE(write_png(view.image_path, sphere.images[i]));
    }
  }
  static RunOptions options_with(bool half_size) {
    RunOptions options;
    options.sweep.half_size = half_size;
    return options;
  }
  Plan plan(bool half_size) const {
    const RunOptions options = options_with(half_size);
    const auto made = make_plan(sphere.scene, options);
    EXPECT_TRUE(made) << made.error().message;
    return *made;
  }

  TemporaryFolder folder;
  SphereScene sphere = make_weak_sphere_scene(4, 176, 132, 8);
};

TEST_F(PlanOfWeakTexture, ImagesOfHalfTheSizeAreCountedInTimeAndMemory) {
  const Plan with = plan(true);
  const Plan without = plan(false);
  EXPECT_EQ(without.half_seconds, 0.0);
  EXPECT_GT(with.half_seconds, 0.02 * with.depth_seconds);
  EXPECT_LT(with.half_seconds, 0.5 * with.depth_seconds);
  // The mesh takes more than the depth maps of so small photographs, so the memory of the stage is asked for.
  const auto memory = [&](bool half_size) {
    return depth_map_memory(sphere.scene, options_with(half_size), CpuBackend()).total();
  };
  EXPECT_GT(memory(true), memory(false) + 8 * 176 * 132);
}

}  // namespace
}  // namespace quorum
