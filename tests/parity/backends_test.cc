#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <thread>

#include "engine/pipeline/cpu_backend.h"
#include "host/vulkan_backend.h"
#include "tests/parity/parity_test.h"
#include "tests/support/outside_task.h"
#include "tests/support/sphere_scene.h"

namespace quorum {
namespace {

/// The sphere scene, its images padded, and a depth map per view.
struct Input {
  SphereScene sphere;
  std::vector<PaddedImage> images;
  std::vector<DepthMap> maps;

  [[nodiscard]] FusionView view(std::size_t index) const {
    return {maps[index], images[index], sphere.scene.views[index].camera};
  }
};

class BackendsParity : public ParityTest {
 protected:
  static std::unique_ptr<VulkanBackend> vulkan(std::optional<SweepForm> form = {}) {
    return VulkanBackend::create(device(), form).value();
  }

  static Input make_input(int width, int height, unsigned seed) {
    Input input{make_sphere_scene(4, width, height, true, seed), {}, {}};
    CpuBackend cpu;
    for (int index = 0; index < 4; ++index) {
      input.images.push_back(pad_image(input.sphere.images[static_cast<std::size_t>(index)]));
      input.maps.push_back(cpu.sweep_depth(make_sphere_task(input.sphere, index, {})).value());
    }
    return input;
  }

  /// A scene whose images have three sizes.
  static Input make_mixed_input(unsigned seed) {
    Input input{make_sphere_scene(5, 97, 71, true, seed), {}, {}};
    for (const auto& [index, width, height] : {std::tuple{1U, 80, 61}, {2U, 64, 49}, {4U, 80, 61}}) {
      SphereScene other = make_sphere_scene(5, width, height, true, seed);
      input.sphere.scene.views[index] = other.scene.views[index];
      input.sphere.images[index] = std::move(other.images[index]);
    }
    CpuBackend cpu;
    for (int index = 0; index < 5; ++index) {
      input.images.push_back(pad_image(input.sphere.images[static_cast<std::size_t>(index)]));
      input.maps.push_back(cpu.sweep_depth(make_sphere_task(input.sphere, index, {})).value());
    }
    return input;
  }

  /// All views through one backend, integrated in the given order.
  static BlockPool fuse(Backend& backend, const Input& input, const FusionOptions& options,
                        const std::vector<std::size_t>& order) {
    const VoxelGrid grid = make_voxel_grid(input.sphere.scene, options).value();
    EXPECT_TRUE(backend.begin_volume(grid, options));
    std::vector<std::vector<std::uint32_t>> blocks(order.size());
    std::vector<std::uint32_t> all;
    for (const std::size_t index : order) {
      blocks[index] = backend.collect_blocks(input.view(index)).value();
      all.insert(all.end(), blocks[index].begin(), blocks[index].end());
    }
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    EXPECT_TRUE(backend.allocate_blocks(all));
    for (const std::size_t index : order) EXPECT_TRUE(backend.integrate(input.view(index), blocks[index]));
    return backend.read_blocks().value();
  }
};

TEST_F(BackendsParity, ImagesOfDifferentSizesGiveEqualDepthMapsAndVolumes) {
  const Input input = make_mixed_input(8);
  const std::array backends = {vulkan(SweepForm::kGroups), vulkan(SweepForm::kLanes)};
  CpuBackend cpu;
  for (const WindowModel model : {WindowModel::kSlanted, WindowModel::kPlane}) {
    SweepOptions options;
    options.window_model = model;
    for (const int reference : {0, 1, 2}) {
      const SweepTask task = make_sphere_task(input.sphere, reference, options);
      const DepthMap twin = cpu.sweep_depth(task).value();
      const int width = input.sphere.scene.views[static_cast<std::size_t>(reference)].width;
      ASSERT_EQ(twin.depth.width, width);
      ASSERT_GT(std::ranges::count_if(twin.depth.values, [](float depth) { return depth > 0; }), 500);
      for (std::size_t i = 0; i < backends.size(); ++i) {
        const DepthMap on_device = backends[i]->sweep_depth(task).value();
        const std::string what = fmt::format("model {} view {} form {}", static_cast<int>(model), reference, i);
        ASSERT_TRUE(same_words(on_device.depth.values, twin.depth.values, width, what + " depth"));
        ASSERT_TRUE(same_words(on_device.correlation.values, twin.correlation.values, width, what + " correlation"));
        ASSERT_TRUE(same_words(on_device.confidence.values, twin.confidence.values, width, what + " confidence"));
      }
    }
  }
  FusionOptions fusion;
  fusion.voxel_size = 0.05;
  const std::vector<std::size_t> order = {0, 1, 2, 3, 4};
  const BlockPool twin = fuse(cpu, input, fusion, order);
  const BlockPool on_device = fuse(*backends[0], input, fusion, order);
  ASSERT_GT(twin.indices.size(), 100U);
  EXPECT_EQ(on_device.indices, twin.indices);
  ASSERT_TRUE(same_words(on_device.voxels, twin.voxels, kBlockVoxels, "(voxel, slot)"));
}

TEST_F(BackendsParity, ADeviceWithMemoryOfItsOwnGivesEqualDepthMapsAndVolumes) {
  const Device apart = Device::open(device().info(), {.validation = true, .force_staging = true}).value();
  const std::unique_ptr<VulkanBackend> backend = VulkanBackend::create(apart, SweepForm::kGroups).value();
  const Input input = make_input(97, 71, 11);
  CpuBackend cpu;
  for (const WindowModel model : {WindowModel::kSlanted, WindowModel::kPlane}) {
    SweepOptions options;
    options.window_model = model;
    const SweepTask task = make_sphere_task(input.sphere, 1, options);
    const DepthMap twin = cpu.sweep_depth(task).value();
    const DepthMap on_device = backend->sweep_depth(task).value();
    ASSERT_TRUE(same_words(on_device.depth.values, twin.depth.values, 97, "depth"));
    ASSERT_TRUE(same_words(on_device.confidence.values, twin.confidence.values, 97, "confidence"));
  }
  FusionOptions fusion;
  fusion.voxel_size = 0.05;
  const std::vector<std::size_t> order = {0, 1, 2, 3};
  const BlockPool twin = fuse(cpu, input, fusion, order);
  const BlockPool on_device = fuse(*backend, input, fusion, order);
  EXPECT_EQ(on_device.indices, twin.indices);
  ASSERT_TRUE(same_words(on_device.voxels, twin.voxels, kBlockVoxels, "(voxel, slot)"));
  for (const std::string& message : apart.take_validation_messages()) ADD_FAILURE() << message;
}

TEST_F(BackendsParity, AViewIsTwoSubmissionsAndTheNextOneFindsMemoryAndPhotographs) {
  const Device apart = Device::open(device().info(), {.validation = true, .force_staging = true}).value();
  const std::unique_ptr<VulkanBackend> backend = VulkanBackend::create(apart, SweepForm::kGroups).value();
  const SweepTask task = make_sphere_task(make_sphere_scene(4, 67, 45, true, 13), 1, {});
  const auto cost_of_view = [&] {
    const DeviceWork before = backend->device_work();
    EXPECT_TRUE(backend->sweep_depth(task));
    const DeviceWork after = backend->device_work();
    return DeviceWork{after.uploaded_bytes - before.uploaded_bytes, after.downloaded_bytes - before.downloaded_bytes,
                      after.submissions - before.submissions, after.dispatches - before.dispatches,
                      after.allocations - before.allocations};
  };
  const DeviceWork first = cost_of_view();
  const DeviceWork next = cost_of_view();
  EXPECT_EQ(first.submissions, 2U) << "uploads and the sweep; planes and the download";
  EXPECT_GT(first.allocations, 0U);
  EXPECT_LE(first.dispatches, 12U) << "windows, sweep a neighbor, votes, first planes, a round each";
  EXPECT_EQ(next.downloaded_bytes, sizeof(PixelPlane) * task.ranges.values.size()) << "planes, and nothing else";
  if (next.submissions != 2U) GTEST_SKIP() << "the first view took so long here that batches became smaller";
  EXPECT_EQ(next.allocations, 0U);
  EXPECT_EQ(next.dispatches, first.dispatches);
  const std::uint64_t photographs = (1 + task.neighbors.size()) * task.reference->pixels.size() * sizeof(Rgba);
  EXPECT_EQ(first.uploaded_bytes - next.uploaded_bytes, photographs);
}

TEST_F(BackendsParity, ViewsThatAreSweptAtOnceGiveEqualDepthMaps) {
  const Device apart = Device::open(device().info(), {.validation = true, .force_staging = true}).value();
  const std::unique_ptr<VulkanBackend> backend = VulkanBackend::create(apart, SweepForm::kGroups).value();
  ASSERT_GT(backend->views_at_once(), 1U);
  const Input input = make_input(97, 71, 12);
  CpuBackend cpu;
  std::vector<SweepTask> tasks;
  for (int view = 0; view < 4; ++view) tasks.push_back(make_sphere_task(input.sphere, view, {}));
  std::vector<DepthMap> maps(8);
  std::vector<std::thread> threads;  // one more than there are workers
  for (std::size_t i = 0; i < 4; ++i)
    threads.emplace_back([&, i] {
      maps[i] = backend->sweep_depth(tasks[i]).value();
      maps[i + 4] = backend->sweep_depth(tasks[(i + 1) % 4]).value();
    });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const DepthMap twin = cpu.sweep_depth(tasks[i < 4 ? i : (i - 3) % 4]).value();
    ASSERT_TRUE(same_words(maps[i].depth.values, twin.depth.values, 97, fmt::format("sweep {}", i)));
    ASSERT_TRUE(same_words(maps[i].confidence.values, twin.confidence.values, 97, fmt::format("sweep {}", i)));
  }
  const auto times = backend->kernel_times();
  EXPECT_EQ(std::ranges::count(times, "refine_planes", &StageTime::name), 1);
  for (const std::string& message : apart.take_validation_messages()) ADD_FAILURE() << message;
}

TEST_F(BackendsParity, DepthMapsAreEqualWhereKernelsSeeLittleOfABuffer) {
  const Device limited =
      Device::open(device().info(), {.validation = true, .max_storage_buffer_range = 1U << 16}).value();
  const std::unique_ptr<VulkanBackend> backend = VulkanBackend::create(limited, SweepForm::kLanes).value();
  CpuBackend cpu;
  for (const WindowModel model : {WindowModel::kSlanted, WindowModel::kPlane}) {
    SweepOptions options;
    options.window_model = model;
    const SweepTask task = make_sphere_task(make_sphere_scene(4, 170, 131, true, 9), 1, options);
    ASSERT_GT(task.ranges.values.size() * sizeof(PixelVote), limited.info().max_storage_buffer_range);
    const DepthMap twin = cpu.sweep_depth(task).value();
    const DepthMap on_device = backend->sweep_depth(task).value();
    const std::string what = fmt::format("model {}", static_cast<int>(model));
    ASSERT_GT(std::ranges::count_if(twin.depth.values, [](float depth) { return depth > 0; }), 500);
    ASSERT_TRUE(same_words(on_device.depth.values, twin.depth.values, 170, what + " depth"));
    ASSERT_TRUE(same_words(on_device.correlation.values, twin.correlation.values, 170, what + " correlation"));
    ASSERT_TRUE(same_words(on_device.confidence.values, twin.confidence.values, 170, what + " confidence"));
  }
  for (const std::string& message : limited.take_validation_messages()) ADD_FAILURE() << message;
}

TEST_F(BackendsParity, AViewThatKernelsCannotSeeFailsOnceAndASmallerOneIsSwept) {
  constexpr std::uint64_t kLittle = 1U << 16;
  const Device limited =
      Device::open(device().info(), {.validation = true, .max_storage_buffer_range = kLittle}).value();
  CpuBackend cpu;
  for (const SweepForm form : {SweepForm::kGroups, SweepForm::kLanes}) {
    const std::unique_ptr<VulkanBackend> backend = VulkanBackend::create(limited, form).value();
    const bool groups = form == SweepForm::kGroups;  // these see photographs and planes whole
    const auto large = backend->sweep_depth(make_sphere_task(make_sphere_scene(4, 170, 131, true, 9), 1, {}));
    EXPECT_EQ(large.has_value(), !groups);
    if (!large) {
      EXPECT_EQ(large.error().kind, ErrorKind::kMemory);
      EXPECT_EQ(large.error().message.find("a buffer of"), 0U) << large.error().message;
    }
    // Photographs one by one, but not all in one buffer: then planes are made by the CPU.
    const SweepTask middle = make_sphere_task(make_sphere_scene(6, 60, 56, true, 9), 1, {});
    ASSERT_GT(6 * middle.reference->pixels.size() * sizeof(Rgba), kLittle);
    for (const SweepTask& task : {make_sphere_task(make_sphere_scene(4, 53, 37, true, 9), 1, {}), middle}) {
      const auto swept = backend->sweep_depth(task);
      ASSERT_TRUE(swept) << swept.error().message;
      ASSERT_TRUE(
          same_words(swept->depth.values, cpu.sweep_depth(task).value().depth.values, task.ranges.width, "depth"));
    }
  }
  for (const std::string& message : limited.take_validation_messages()) ADD_FAILURE() << message;
}

TEST_F(BackendsParity, DepthMapsAreEqualInEveryForm) {
  const std::array backends = {vulkan(SweepForm::kGroups), vulkan(SweepForm::kLanes), vulkan()};
  CpuBackend cpu;
  for (const auto& [window, model, seed] : {std::tuple{5, WindowModel::kPlane, 1U},
                                            {15, WindowModel::kPlane, 2U},
                                            {3, WindowModel::kAxis, 3U},
                                            {5, WindowModel::kPlane, 4U},
                                            {5, WindowModel::kSlanted, 5U},
                                            {9, WindowModel::kSlanted, 6U},
                                            {5, WindowModel::kSlanted, 7U}}) {
    SphereScene sphere = make_sphere_scene(5, 97, 71, model != WindowModel::kAxis, seed);
    if (seed == 7U) sphere.scene.bounds.high.z() = -0.7;  // the sphere goes on beyond
    SweepOptions options;
    options.window = window;
    options.window_model = model;
    options.refinement = seed == 4U ? 1 : 10;
    SweepTask task = make_sphere_task(sphere, 2, options);
    if (seed == 7U) look_outside(sphere, 2, task);
    const DepthMap twin = cpu.sweep_depth(task).value();
    for (std::size_t i = 0; i < backends.size(); ++i) {
      if (model == WindowModel::kAxis && i > 0) continue;  // there is one form for it
      const DepthMap on_device = backends[i]->sweep_depth(task).value();
      const std::string what = fmt::format("window {} seed {} form {}", window, seed, i);
      ASSERT_TRUE(same_words(on_device.depth.values, twin.depth.values, 97, what + " depth"));
      ASSERT_TRUE(same_words(on_device.correlation.values, twin.correlation.values, 97, what + " correlation"));
      ASSERT_TRUE(same_words(on_device.confidence.values, twin.confidence.values, 97, what + " confidence"));
    }
    const auto found = std::ranges::count_if(twin.depth.values, [](float depth) { return depth > 0; });
    expect_share(found, 97 * 71, 0.1, 0.8, fmt::format("window {} seed {}", window, seed));
  }
  for (const auto& backend : backends) EXPECT_FALSE(backend->kernel_times().empty());
}

TEST_F(BackendsParity, CollectedBlocksAndPoolsAreEqual) {
  const auto gpu = vulkan();
  CpuBackend cpu;
  const Input input = make_input(97, 71, 5);
  FusionOptions options;
  options.voxel_size = 0.025;
  const VoxelGrid grid = make_voxel_grid(input.sphere.scene, options).value();
  ASSERT_TRUE(gpu->begin_volume(grid, options));
  ASSERT_TRUE(cpu.begin_volume(grid, options));
  for (std::size_t index = 0; index < input.maps.size(); ++index) {
    const auto twin = cpu.collect_blocks(input.view(index)).value();
    ASSERT_TRUE(same_words(gpu->collect_blocks(input.view(index)).value(), twin, 1, fmt::format("view {}", index)));
    expect_share(static_cast<std::int64_t>(twin.size()), static_cast<std::int64_t>(grid.block_count()), 0.05, 0.9,
                 "collected blocks");
  }
  const BlockPool on_device = fuse(*gpu, input, options, {0, 1, 2, 3});
  const BlockPool twin = fuse(cpu, input, options, {0, 1, 2, 3});
  EXPECT_GT(twin.indices.size(), 300U);
  ASSERT_TRUE(same_words(on_device.indices, twin.indices, 1, "block"));
  ASSERT_TRUE(same_words(on_device.voxels, twin.voxels, kBlockVoxels, "(voxel, slot)"));
  const auto seen = std::ranges::count_if(twin.voxels, [](const Voxel& voxel) { return voxel.weight > 0; });
  expect_share(seen, static_cast<std::int64_t>(twin.voxels.size()), 0.05, 0.95, "seen voxels");
}

TEST_F(BackendsParity, TheOrderOfViewsDoesNotMatter) {
  const auto gpu = vulkan();
  const Input input = make_input(67, 45, 6);
  FusionOptions options;
  options.voxel_size = 0.05;
  const BlockPool forward = fuse(*gpu, input, options, {0, 1, 2, 3});
  const BlockPool other = fuse(*gpu, input, options, {2, 0, 3, 1});
  ASSERT_TRUE(same_words(other.indices, forward.indices, 1, "block"));
  ASSERT_TRUE(same_words(other.voxels, forward.voxels, kBlockVoxels, "(voxel, slot)"));
  EXPECT_GT(std::ranges::count_if(forward.voxels, [](const Voxel& voxel) { return voxel.weight > 0; }), 1000);
}

TEST_F(BackendsParity, AnEmptyDepthMapCollectsNothing) {
  const auto gpu = vulkan();
  Input input = make_input(67, 45, 7);
  for (DepthMap& map : input.maps) std::ranges::fill(map.depth.values, 0.0F);
  const BlockPool pool = fuse(*gpu, input, {}, {0, 1, 2, 3});
  EXPECT_TRUE(pool.indices.empty());
  EXPECT_TRUE(pool.voxels.empty());
}

}  // namespace
}  // namespace quorum
