// The least that the work takes, in 32-bit operations of the CPU's form and in bytes. Counted are the operations that
// no arrangement of the same arithmetic avoids; reads of texels, loops and addresses are free. docs/performance.md has
// the table.
#include "engine/bench/bench_report.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "engine/core/host_rates.h"
#include "engine/core/memory.h"
#include "engine/core/version.h"
#include "engine/pipeline/reconstruct.h"

namespace quorum {
namespace {

// A window of the sweep: one new sample of the neighbor, and what every window does for itself.
constexpr double kWarp = 30;         // 6 for (x', y', z'), 7 reciprocal, 6 scaling, 5 inside, 6 fractions and address
constexpr double kInterpolate = 42;  // 8 masks, 16 along x, 18 along y
constexpr double kProducts = 10;     // 5 for b·b, 5 for a·b
constexpr double kSums = 20;         // 5 running sums: one in, one out, along the row and down the column
constexpr double kNcc = 33;          // 14 covariance and variance, 10 reciprocal_sqrt, 5 products and tests, 4 votes
constexpr double kWindowOperations = kWarp + kInterpolate + kProducts + kSums + kNcc;
// A sample of a window on a tilted plane: 8 for its position and fractions, 42 interpolation, 10 products, 10 sums.
constexpr double kTiltedSampleOperations = 8 + kInterpolate + kProducts + 10;

constexpr double kVoxelOperations = 33;   // 18 projection, 7 reciprocal, 2 for (u, v), 6 tests
constexpr double kVertexOperations = 24;  // a point on a ray: for each axis 2 for the position, 6 for the blocks
constexpr double kCellOperations = 25;    // five edges of a cell: 5 differences and 3 tests on each, shared by two
constexpr double kWeightOperations = 50;  // slopes, normal, cosine, ramp, weight
constexpr double kVoxelTests = 2;         // marching cubes: seen? inside?
constexpr double kVoxelBytes = sizeof(Voxel);

/// What the report counts, summed over the views.
struct Totals {
  double sweep_windows = 0.0;   // pixel · depth · neighbor
  double refine_windows = 0.0;  // a few too many: planes beyond the first and the last don't exist
  double valid_pixels = 0.0;
  double pixels = 0.0;  // of the views with a depth map
  double images = 0.0;  // pixels read by the sweeps: reference and neighbors
};

Totals total(const Scene& scene, const RunOptions& options, const RunReport& report) {
  Totals sum;
  for (const ViewReport& view : report.views) {
    const auto neighbors = static_cast<double>(view.neighbors.size());
    const auto found = std::ranges::find(scene.views, view.name, &View::name);
    const double pixels = static_cast<double>(found->width) * found->height;
    const auto valid = static_cast<double>(view.valid_pixels);
    sum.sweep_windows += static_cast<double>(view.depth_samples) * neighbors;
    const bool second_pass = options.sweep.refinement > 1 && !options.sweep.is_slanted();
    sum.refine_windows += second_pass ? valid * (2 * options.sweep.refinement - 1) * neighbors : 0.0;
    sum.valid_pixels += valid;
    sum.pixels += pixels;
    sum.images += pixels * (1.0 + neighbors);
  }
  return sum;
}

double kernel_seconds(const RunReport& report, const std::string& name) {
  const auto kernel = std::ranges::find(report.kernels, name, &StageTime::name);
  return kernel != report.kernels.end() ? kernel->seconds : 0.0;
}

double stage_cpu_seconds(const RunReport& report, const std::string& name) {
  const auto stage = std::ranges::find(report.stages, name, &StageReport::name);
  return stage != report.stages.end() ? stage->cpu_seconds : 0.0;
}

double limit(double operations, double bytes, const DeviceRates& rates) {
  if (!(rates.operations_per_second > 0 && rates.bytes_per_second > 0)) return 0.0;
  return std::max(operations / rates.operations_per_second, bytes / rates.bytes_per_second);
}

}  // namespace

std::vector<Cost> bench_costs(const Scene& scene, const RunOptions& options, const RunReport& report,
                              const DeviceRates& device, const DeviceRates& host) {
  const Totals sum = total(scene, options, report);
  const auto blocks = static_cast<double>(report.blocks);
  const auto block_views = static_cast<double>(report.block_views);
  const double points = 2 * std::ceil(report.truncation / (0.5 * kBlockSide * report.voxel_size)) + 1;
  std::vector<Cost> costs;
  const auto add = [&](const char* name, const char* unit, double units, double seconds, double operations,
                       double bytes, const char* formula, const DeviceRates& rates) {
    costs.push_back({name, unit, units, seconds, operations, bytes, formula, limit(operations, bytes, rates)});
  };
  const auto kernel = [&](const char* name) { return kernel_seconds(report, name); };
  add("sweep_depth", "pixel · depth · neighbor", sum.sweep_windows, kernel("sweep_depth"),
      kWindowOperations * sum.sweep_windows, 4 * sum.images + 20 * sum.pixels,
      "135 operations a window; 4 bytes a pixel of reference and neighbors, 20 of ranges and votes", device);
  if (options.sweep.is_slanted()) {
    const auto samples = static_cast<double>(report.sweep.refine_samples);  // 0 on a device that does not count them
    const auto windows = static_cast<double>(report.sweep.refine_windows);
    if (windows > 0)
      add("refine_planes", "pixel · plane · neighbor", windows, kernel("refine_planes"),
          kTiltedSampleOperations * samples, 4 * sum.images + 24 * sum.pixels,
          "70 operations a sample; 4 bytes a pixel of reference and neighbors, 24 of planes", device);
    else
      add("refine_planes", "pixel · view", sum.pixels, kernel("refine_planes"), 0.0, 4 * sum.images + 24 * sum.pixels,
          "4 bytes a pixel of reference and neighbors, 24 of planes; operations are not counted", device);
  } else {
    add("refine_depth", "pixel · depth · neighbor", sum.refine_windows, kernel("refine_depth"),
        kWindowOperations * sum.refine_windows, 4 * sum.images + 20 * sum.pixels, "as sweep_depth", device);
  }
  if (const double vote = kernel("vote_depth"); vote > 0) {
    const double windows = sum.sweep_windows + sum.refine_windows;
    add("vote_depth", "pixel · depth · neighbor", windows, vote, 4 * windows, 4 * windows,
        "4 operations and 4 bytes a window", device);
  }
  add("range_surface", "pixel · view", 2 * sum.pixels, kernel("range_surface"), kCellOperations * 2 * sum.valid_pixels,
      12 * 2 * sum.pixels, "25 operations a valid pixel, 12 bytes a pixel; twice a view", device);
  add("weigh_surface", "pixel · view", 2 * sum.pixels, kernel("weigh_surface"),
      kWeightOperations * 2 * sum.valid_pixels, 16 * 2 * sum.pixels,
      "50 operations a valid pixel, 16 bytes a pixel; twice a view", device);
  add("collect_blocks", "block · view", block_views, kernel("collect_blocks"),
      kVertexOperations * points * sum.valid_pixels, 8 * sum.pixels,
      "24 operations a point, 2 ceil(truncation / half a block) + 1 points a valid pixel; 8 bytes a pixel", device);
  add("integrate", "voxel · view", kBlockVoxels * block_views, kernel("integrate"),
      kVoxelOperations * kBlockVoxels * block_views, 16 * sum.pixels + kVoxelBytes * kBlockVoxels * blocks,
      "33 operations a voxel · view; 16 bytes a pixel, 20 bytes a voxel once", device);
  add("marching_cubes", "block", blocks, stage_cpu_seconds(report, "marching_cubes"),
      kVoxelTests * kBlockVoxels * blocks,
      kVoxelBytes * kBlockVoxels * blocks + 28.0 * static_cast<double>(report.extracted_triangles),
      "1024 operations and 10240 bytes a block, 28 bytes a triangle and its half vertex", host);
  return costs;
}

double seconds_outside_kernels(const RunReport& report, bool on_host) {
  double seconds = report.cpu_seconds;
  if (on_host)
    for (const StageTime& kernel : report.kernels) seconds -= kernel.seconds;
  return std::max(seconds, 0.0);
}

namespace {

std::uint64_t bytes_in(const std::filesystem::path& folder) {
  std::uint64_t bytes = 0;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, ignored))
    if (entry.is_regular_file(ignored)) bytes += entry.file_size(ignored);
  return bytes;
}

}  // namespace

Expected<BenchReport> bench_run(Run& run, const std::string& name) {
  QUORUM_TRY(reconstruct(run));
  BenchReport bench;
  bench.peak_memory_bytes = peak_memory_bytes();
  bench.bytes_written = bytes_in(run.workspace.folder());
  run.progress.stage("measuring the machine", 1);
  QUORUM_ASSIGN(bench.rates, run.backend.measure_rates());
  const HostRates host = measure_host_rates();
  run.progress.step();
  bench.version = version();
  bench.device = run.report.device;
  bench.scene = name;
  bench.views = static_cast<int>(run.scene.views.size());
  bench.width = run.scene.views[0].width;
  bench.height = run.scene.views[0].height;
  bench.wall_seconds = run.report.wall_seconds;
  bench.cpu_seconds = run.report.cpu_seconds;
  bench.stages = run.report.stages;
  bench.device_work = run.report.device_work;
  bench.host_seconds = seconds_outside_kernels(run.report, run.backend.runs_on_host());
  bench.megapixels = total(run.scene, run.options, run.report).pixels * 1e-6;
  bench.costs = bench_costs(run.scene, run.options, run.report, bench.rates,
                            {host.operations_per_second / host.threads, host.bytes_per_second / host.threads});
  return bench;
}

}  // namespace quorum
