// How a block is filled: in phases over plain arrays, so that the compiler vectorizes all but reads and the last sums.
// All voxels of the block are projected; those that land in a triangle go on; of these, those within the truncation;
// and only they take weight and color. The whole is compiled for each SIMD level.
#include "engine/volume/integrate.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

#include "engine/core/check.h"
#include "engine/volume/voxel_on_surface.h"

namespace quorum {
namespace {

/// What the phases know of a block's voxels beside their places on the surface.
struct Workspace : BlockOnSurface {
  std::int32_t signed_distance[kBlockVoxels];
  std::int32_t kept[kBlockVoxels];

  // Of those within the truncation.
  std::uint32_t word[4][kBlockVoxels];  // weights of the cell, then texels of the image
  std::int32_t texel_index[kBlockVoxels];
  int texel_u[kBlockVoxels];  // 1/256 pixel
  int texel_v[kBlockVoxels];
  std::int32_t sum[kVoxelWords][kBlockVoxels];  // what is added to the voxel
};

/// Signed distance of a voxel that is not within the truncation.
constexpr std::int32_t kFar = -2 * kDistanceScale;

/// Signed distance of the first count voxels.
[[gnu::always_inline]] inline void measure_distances(const IntegrateParams& params, int count, Workspace& work) {
  constexpr float kScale = static_cast<float>(kDistanceScale);
  const SurfaceMeasure measure(params);
  for (int i = 0; i < count; ++i) {
    const float distance = measure.distance(work, i);
    const bool near = (distance >= -kBehindShare) & (distance <= 1.0F);
    const float near_distance = near ? distance : 0.0F;
    const int signed_distance = static_cast<int>(near_distance * kScale + (kScale + 0.5F)) - kDistanceScale;
    work.signed_distance[i] = near ? signed_distance : kFar;
  }
}

/// Keeps, of the first count voxels, those within the truncation, and reads the weights of their cells. Returns how
/// many.
[[gnu::always_inline]] inline int keep_near(const WeightedSurface& surface, int count, Workspace& work) {
  int near = 0;
  for (int i = 0; i < count; ++i) {
    work.kept[near] = i;
    near += work.signed_distance[i] != kFar ? 1 : 0;
  }
  const std::ptrdiff_t width = surface.weights.width;
  for (int i = 0; i < near; ++i) {
    const int from = work.kept[i];
    work.voxel[i] = work.voxel[from];
    work.triangle[i] = work.triangle[from];
    work.u[i] = work.u[from];
    work.v[i] = work.v[from];
    work.signed_distance[i] = work.signed_distance[from];
    const std::uint32_t* weights = surface.weights.values.data() + work.pixel[from];
    work.word[0][i] = weights[0];
    work.word[1][i] = weights[1];
    work.word[2][i] = weights[width];
    work.word[3][i] = weights[width + 1];
  }
  return near;
}

/// Weights and weighted distances of the first count voxels, and where their colors lie in the image.
[[gnu::always_inline]] inline void weigh(const PaddedImage& image, int count, Workspace& work) {
  const int stride = image.stride();
  for (int i = 0; i < count; ++i) {
    const float u = work.u[i];
    const float v = work.v[i];
    const float fraction_x = fraction_in_cell(u);
    const float fraction_y = fraction_in_cell(v);
    const auto corner = [&](int index) {
      return static_cast<float>(static_cast<std::int32_t>(work.word[index][i] & kWeightScale));
    };
    const int weight =
        static_cast<int>(interpolate_cell(is_split_03(work.triangle[i]), is_second(work.triangle[i]), corner(0),
                                          corner(1), corner(2), corner(3), fraction_x, fraction_y) +
                         0.5F);
    const int iu = static_cast<int>(u * static_cast<float>(kPositionScale) + 0.5F);
    const int iv = static_cast<int>(v * static_cast<float>(kPositionScale) + 0.5F);
    work.texel_index[i] = texel_index(iu, iv, stride);
    work.texel_u[i] = iu;
    work.texel_v[i] = iv;
    work.sum[0][i] = weight;
    work.sum[1][i] = weight * work.signed_distance[i];
  }
}

/// Weighted colors of the first count voxels.
[[gnu::always_inline]] inline void color(const PaddedImage& image, int count, Workspace& work) {
  const std::ptrdiff_t stride = image.stride();
  for (int i = 0; i < count; ++i) {
    const Rgba* texel = image.pixels.data() + work.texel_index[i];
    work.word[0][i] = texel[0];
    work.word[1][i] = texel[1];
    work.word[2][i] = texel[stride];
    work.word[3][i] = texel[stride + 1];
  }
  for (int i = 0; i < count; ++i) {
    const Sample sample = sample_bilinear(work.word[0][i], work.word[1][i], work.word[2][i], work.word[3][i],
                                          work.texel_u[i], work.texel_v[i], kSampleShift);
    const auto in_8_bits = [](std::int32_t value) { return std::min((value + 2048 + 8) >> 4, 255); };
    work.sum[2][i] = work.sum[0][i] * in_8_bits(sample.red);
    work.sum[3][i] = work.sum[0][i] * in_8_bits(sample.green);
    work.sum[4][i] = work.sum[0][i] * in_8_bits(sample.blue);
  }
}

void add_to_block(int count, const Workspace& work, Voxel* block) {
  for (int i = 0; i < count; ++i) {
    Voxel& voxel = block[work.voxel[i]];
    voxel.weight += work.sum[0][i];
    voxel.distance += work.sum[1][i];
    for (int channel = 0; channel < 3; ++channel) voxel.color[channel] += work.sum[2 + channel][i];
  }
}

/// The block whose first voxel is (x, y, z).
[[gnu::always_inline]] inline void integrate_block_body(const WeightedSurface& surface, const IntegrateParams& params,
                                                        int x, int y, int z, Voxel* block) {
  Workspace work;
  project_block(params, x, y, z, work);
  const int on_surface = keep_on_surface(surface.depth, surface.cells, surface.weights, work);
  measure_distances(params, on_surface, work);
  const int near = keep_near(surface, on_surface, work);
  weigh(surface.image, near, work);
  color(surface.image, near, work);
  add_to_block(near, work, block);
}

}  // namespace

IntegrateParams make_integrate_params(const Camera& camera, int width, int height, const VoxelGrid& grid) {
  Eigen::Matrix<double, 3, 4> projection;
  projection.leftCols<3>() = camera.intrinsics * camera.camera_from_world * grid.voxel_size;
  projection.col(3) = camera.intrinsics * camera.to_camera(grid.origin);
  IntegrateParams params{};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      params.projection[4 * row + column] = static_cast<float>(projection(row, column));
  const Eigen::Matrix3d& k = camera.intrinsics;
  params.inverse_focal_x = static_cast<float>(1.0 / k(0, 0));
  params.inverse_focal_y = static_cast<float>(1.0 / k(1, 1));
  params.principal_x = static_cast<float>(k(0, 2));
  params.principal_y = static_cast<float>(k(1, 2));
  params.inverse_truncation = static_cast<float>(1.0 / grid.truncation);
  params.width = width;
  params.height = height;
  params.blocks[0] = grid.blocks[0];
  params.blocks[1] = grid.blocks[1];
  return params;
}

std::vector<BlockSlot> find_slots(const std::vector<std::uint32_t>& blocks, const std::vector<std::uint32_t>& pool) {
  std::vector<BlockSlot> slots;
  slots.reserve(blocks.size());
  std::size_t slot = 0;
  for (const std::uint32_t block : blocks) {
    while (slot < pool.size() && pool[slot] < block) ++slot;
    QUORUM_CHECK_LT(slot, pool.size());
    QUORUM_CHECK_EQ(pool[slot], block);
    slots.push_back({block, static_cast<std::uint32_t>(slot)});
  }
  return slots;
}

void integrate(const WeightedSurface& surface, const std::vector<BlockSlot>& list, const IntegrateParams& params,
               SimdLevel simd, std::vector<Voxel>& voxels) {
  const auto integrate_block = simd_form<integrate_block_body>(simd);
  tbb::parallel_for(std::size_t{0}, list.size(), [&](std::size_t entry) {
    const auto [x, y, z] = first_voxel(params, list[entry].index);
    integrate_block(surface, params, x, y, z,
                    voxels.data() + static_cast<std::size_t>(list[entry].slot) * kBlockVoxels);
  });
}

}  // namespace quorum
