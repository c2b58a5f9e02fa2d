// What a run cost per unit of work, and what the work takes at least on the same device.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/pipeline/run.h"

namespace quorum {

/// A kernel or stage over a whole run, and the least that its work takes.
struct Cost {
  std::string name;
  std::string unit;  ///< what is counted: "pixel · depth · neighbor"
  double units = 0.0;
  double seconds = 0.0;        ///< of the device (Backend::kernel_times), or CPU seconds of the host
  double operations = 0.0;     ///< at least, 32-bit
  double bytes = 0.0;          ///< at least, read and written
  std::string formula;         ///< of operations and bytes
  double limit_seconds = 0.0;  ///< max(operations / rate, bytes / rate); 0 = unknown

  [[nodiscard]] double nanoseconds_per_unit() const { return units > 0 ? 1e9 * seconds / units : 0.0; }
  [[nodiscard]] double limit_per_unit() const { return units > 0 ? 1e9 * limit_seconds / units : 0.0; }
};

struct BenchReport {
  std::string version;
  std::string device;
  std::string scene;
  int views = 0;
  int width = 0;   ///< of the first view, pixels
  int height = 0;  ///< of the first view, pixels
  DeviceRates rates;
  std::vector<Cost> costs;
  std::vector<StageReport> stages;
  double wall_seconds = 0.0;  ///< from the first photograph to the mesh
  double cpu_seconds = 0.0;   ///< of the process meanwhile
  double host_seconds = 0.0;  ///< of the CPU, outside kernels
  double megapixels = 0.0;    ///< of the views with a depth map
  DeviceWork device_work;
  std::uint64_t bytes_written = 0;  ///< of the files that the run left
  std::uint64_t peak_memory_bytes = 0;

  [[nodiscard]] double host_seconds_per_megapixel() const { return megapixels > 0 ? host_seconds / megapixels : 0.0; }
};

/// The costs of a whole run (depth maps and fusion) that was done. device: what kernels can do; host: what one thread
/// of the CPU can do, for the stages that always run there.
std::vector<Cost> bench_costs(const Scene& scene, const RunOptions& options, const RunReport& report,
                              const DeviceRates& device, const DeviceRates& host);

/// CPU seconds of a run outside kernels. on_host: kernel times are CPU seconds, too.
double seconds_outside_kernels(const RunReport& report, bool on_host);

/// The whole run, then the rates of the machine: these take memory that is not the run's. name: of the scene. Fails as
/// reconstruct() and measure_rates() do.
Expected<BenchReport> bench_run(Run& run, const std::string& name);

}  // namespace quorum
