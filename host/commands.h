// Work for a device: transfers, and dispatches in named regions, recorded, submitted, waited for and timed.
//
//   const Buffer reference = commands.upload(image.pixels);
//   const Buffer depths = commands.allocate(depth.size() * sizeof(float));
//   commands.region("sweep_depth");
//   commands.dispatch(sweep_depth, {width, height}, params, {reference, depths});
//   QUORUM_TRY(commands.download(depths, depth));
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "engine/core/error.h"
#include "host/buffer.h"
#include "host/device.h"
#include "host/kernel.h"

namespace quorum {

/// Numbers of threads (not of work groups) along each axis.
struct Threads {
  std::int64_t x = 1;
  std::int64_t y = 1;
  std::int64_t z = 1;
};

/// Time that the device spent in all regions of one name.
struct RegionTiming {
  std::string name;
  double seconds = 0.0;
  std::int64_t count = 0;  ///< regions
};

struct CommandsOptions {
  std::chrono::nanoseconds timeout = std::chrono::seconds(120);  ///< a submission that takes longer has failed
};

/// Records commands that run one after the other; each sees what those before it wrote. The first failure of any call
/// is kept until submit or download tells it: until then nothing is done, and buffers and kernels that are made are
/// none. Move-only; a moved-from object may only be assigned to or destroyed.
class Commands {
 public:
  /// Fails (kDevice, kMemory) if the driver does.
  static Expected<Commands> create(const Device& device, const CommandsOptions& options = {});

  Commands(Commands&& other) noexcept;
  Commands& operator=(Commands&& other) noexcept;
  ~Commands();

  [[nodiscard]] const Device& device() const;

  /// A kernel of shaders/, by name. Fails as Kernel::create does.
  Kernel kernel(std::string_view name, const std::vector<SpecConstant>& constants = {});

  // Buffers. They are filled before what is recorded next runs, and must not be used by what was recorded before. Fail
  // as Buffer::create and Buffer::upload do.

  /// A buffer with undefined content.
  Buffer allocate(std::uint64_t size_bytes, BufferUse use = BufferUse::kWhole);
  Buffer allocate_zeros(std::uint64_t size_bytes, BufferUse use = BufferUse::kWhole);
  /// A buffer that holds values.
  template <PlainValues Range>
  Buffer upload(const Range& values, BufferUse use = BufferUse::kWhole) {
    return upload_bytes(std::as_bytes(std::span(values)), use);
  }
  /// Copies values into a buffer from offset_bytes on.
  template <PlainValues Range>
  void upload(const Range& values, Buffer& to, std::uint64_t offset_bytes) {
    upload_bytes(std::as_bytes(std::span(values)), to, offset_bytes);
  }

  /// Names what is recorded from now on, over submissions too: for the timings, for messages and for debuggers. "other"
  /// until the first call.
  void region(std::string_view name);

  /// Runs the kernel with at least these threads: the counts are rounded up to whole work groups, so the kernel must
  /// ignore threads beyond them. No thread, no dispatch. params: the push constants, of exactly the size that the
  /// kernel declares. buffers: one per binding, in order. The kernel must live until submit returns. A wrong
  /// size or count of these stops the program; more work groups than the device allows make submit fail (kDevice).
  template <typename Params>
  void dispatch(const Kernel& kernel, const Threads& threads, const Params& params,
                std::initializer_list<BufferView> buffers) {
    static_assert(std::is_trivially_copyable_v<Params> && sizeof(Params) <= 128);
    record(kernel, threads, std::as_bytes(std::span(&params, 1)), {buffers.begin(), buffers.size()});
  }
  /// The same for a kernel without push constants.
  void dispatch(const Kernel& kernel, const Threads& threads, std::initializer_list<BufferView> buffers) {
    record(kernel, threads, {}, {buffers.begin(), buffers.size()});
  }

  /// Fills a view with zero bytes; its offset and size are multiples of 4, or it is a whole buffer.
  void fill_zero(const BufferView& view);

  /// Copies a whole buffer into another one, from offset_bytes on; it must fit.
  void copy(const Buffer& from, const Buffer& to, std::uint64_t offset_bytes = 0);

  /// Runs what was recorded and waits for it; then the object is ready to record anew. Fails with the first failure
  /// since the last submission; (kDevice) if the device is lost, fails, or takes longer than the timeout; (kMemory) if
  /// memory runs out.
  Expected<void> submit();

  /// Submits, and fills values from the start of a buffer. Fails as submit does.
  template <PlainValues Range>
  Expected<void> download(const Buffer& from, Range&& values) {
    return download_bytes(from, std::as_writable_bytes(std::span(values)));
  }

  /// Seconds per region name over all submissions, in order of first use. Empty on a queue without timestamps.
  [[nodiscard]] const std::vector<RegionTiming>& timings() const;

  /// Seconds that the device took for the last submission, and for those that an upload or a download made with
  /// it; from submit to
  /// its end on a queue without timestamps.
  [[nodiscard]] double last_submission_seconds() const;

 private:
  struct State;
  explicit Commands(std::unique_ptr<State> state);
  void record(const Kernel& kernel, const Threads& threads, std::span<const std::byte> params,
              std::span<const BufferView> buffers);
  Buffer upload_bytes(std::span<const std::byte> bytes, BufferUse use);
  void upload_bytes(std::span<const std::byte> bytes, Buffer& to, std::uint64_t offset_bytes);
  Expected<void> download_bytes(const Buffer& from, std::span<std::byte> bytes);

  std::unique_ptr<State> state_;
};

}  // namespace quorum
