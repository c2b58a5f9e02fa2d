#include "host/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "engine/core/check.h"
#include "host/descriptors.h"
#include "host/staging.h"
#include "host/state.h"
#include "host/timestamps.h"

namespace quorum {
namespace {

constexpr std::string_view kTransfers = "transfers";  // the region of copies between host and device

}  // namespace

struct Commands::State {
  Device opened;
  std::shared_ptr<Device::State> device;
  CommandsOptions options;
  Recorder recorder;
  Descriptors descriptors;
  Timestamps timestamps;
  std::vector<RegionTiming> timings;
  double last_submission_seconds = 0.0;
  double carried_seconds = 0.0;  ///< of submissions before the next one
  Staging uploads;
  Staging downloads;
  std::vector<Buffer> used;                ///< by what is recorded
  std::string region = "other";            ///< of what is recorded next
  std::optional<std::string> open_region;  ///< of what was recorded last
  bool recording = false;
  std::optional<Error> failed;  ///< the first failure since the last submission

  State(const Device& on, const CommandsOptions& with)
      : opened(on),
        device(on.state()),
        options(with),
        recorder(device->make_recorder()),
        descriptors(*device),
        timestamps(*device),
        uploads(*device),
        downloads(*device) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { device->settle(); }

  void start(std::string_view in_region);
  void end();
  void clear();
  Expected<void> submit();
  void record(std::string_view in_region, const std::function<void(const vk::raii::CommandBuffer&)>& function);
  Expected<void> upload(const Buffer& to, std::span<const std::byte> bytes, std::uint64_t offset);
  Expected<void> download(const Buffer& from, std::span<std::byte> bytes);
  template <typename Function>
  auto keep(const Function& function) -> std::invoke_result_t<Function>::value_type;
};

// Before a command: starts recording and the region, as far as they are not.
void Commands::State::start(std::string_view in_region) {
  if (!recording) {
    device->settle();
    recorder.pool.reset();
    descriptors.reset();
    recorder.commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    recording = true;
    timestamps.begin(recorder.commands);
  }
  if (open_region == in_region || timestamps.full()) return;
  timestamps.start_region(recorder.commands, in_region);
  if (device->instance.debug_utils) {
    if (open_region) recorder.commands.endDebugUtilsLabelEXT();
    recorder.commands.beginDebugUtilsLabelEXT({.pLabelName = std::string(in_region).c_str()});
  }
  open_region = in_region;
}

void Commands::State::end() {
  timestamps.end(recorder.commands);
  if (device->instance.debug_utils && open_region) recorder.commands.endDebugUtilsLabelEXT();
  recorder.commands.end();
}

void Commands::State::clear() {
  recording = false;
  open_region.reset();
  failed.reset();
  uploads.clear();
}

// What an Expected of function holds; its failure is kept, and after that it is not called.
template <typename Function>
auto Commands::State::keep(const Function& function) -> std::invoke_result_t<Function>::value_type {
  using Value = std::invoke_result_t<Function>::value_type;
  if (failed) return Value();
  auto result = function();
  if (result) return *std::move(result);
  failed = std::move(result).error();
  return Value();
}

void Commands::State::record(std::string_view in_region,
                             const std::function<void(const vk::raii::CommandBuffer&)>& function) {
  keep([&] {
    return guarded(fmt::format("recording {}", in_region), [&] {
      start(in_region);
      function(recorder.commands);
      publish_writes(recorder.commands);
    });
  });
}

// Runs what was recorded, and lets go of the buffers that it used.
Expected<void> Commands::State::submit() {
  last_submission_seconds = std::exchange(carried_seconds, 0.0);
  const std::vector<Buffer> until_done = std::exchange(used, {});
  if (failed) {
    Error error = *std::move(failed);
    clear();
    return std::unexpected(std::move(error));
  }
  if (!recording) return {};
  const std::string doing = "running " + *open_region;
  if (auto ended = guarded(doing, [&] { end(); }); !ended) {
    clear();
    return ended;
  }
  clear();
  const auto began = std::chrono::steady_clock::now();
  QUORUM_TRY(device->submit(recorder, options.timeout, doing));
  const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - began;
  return guarded(doing, [&] {
    const double measured = timestamps.collect(timings);
    last_submission_seconds += device->timestamp_bits > 0 ? measured : waited.count();
  });
}

// Fills a part of a buffer at its place among the commands, through the staging buffer; submits when that is full.
Expected<void> Commands::State::upload(const Buffer& to, std::span<const std::byte> bytes, std::uint64_t offset) {
  QUORUM_CHECK_LE(offset, to.size());
  QUORUM_CHECK_LE(bytes.size(), to.size() - offset);
  device->work.uploaded_bytes += bytes.size();
  while (!bytes.empty()) {
    QUORUM_TRY(uploads.open());
    if (uploads.room() == 0) {
      QUORUM_TRY(submit());
      carried_seconds = last_submission_seconds;
    }
    const auto piece = bytes.first(std::min<std::uint64_t>(bytes.size(), uploads.room()));
    if (!recording) device->settle();  // before what it may still read is overwritten
    const std::uint64_t from = uploads.put(piece);
    record(kTransfers, [&](const vk::raii::CommandBuffer& commands) {
      commands.copyBuffer(uploads.buffer(), *to.state().allocation.buffer,
                          vk::BufferCopy{.srcOffset = from, .dstOffset = offset, .size = piece.size()});
    });
    if (failed) return std::unexpected(*failed);
    used.push_back(to);
    bytes = bytes.subspan(piece.size());
    offset += piece.size();
  }
  return {};
}

// Runs what was recorded, and then a copy to the host; the first piece of it in the same submission.
Expected<void> Commands::State::download(const Buffer& from, std::span<std::byte> bytes) {
  QUORUM_CHECK_LE(bytes.size(), from.size());
  device->work.downloaded_bytes += bytes.size();
  if (bytes.empty()) return submit();
  double seconds = 0.0;
  for (std::uint64_t offset = 0; !bytes.empty();) {
    keep([&] { return downloads.open(); });
    const auto piece = bytes.first(std::min(bytes.size(), kStagingBytes));
    record(kTransfers, [&](const vk::raii::CommandBuffer& commands) {
      commands.copyBuffer(*from.state().allocation.buffer, downloads.buffer(),
                          vk::BufferCopy{.srcOffset = offset, .size = piece.size()});
    });
    QUORUM_TRY(submit());
    seconds += last_submission_seconds;
    downloads.get(piece);
    bytes = bytes.subspan(piece.size());
    offset += piece.size();
  }
  last_submission_seconds = seconds;
  return {};
}

namespace {

// Work groups along each axis that cover the threads; fails (kDevice) if the device does not allow as many.
Expected<std::array<std::uint32_t, 3>> count_groups(const Kernel::State& kernel, const Threads& threads) {
  const std::array wanted = {threads.x, threads.y, threads.z};
  std::array<std::uint32_t, 3> groups = {};
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const std::int64_t group = kernel.layout.group_size[i];
    const std::int64_t count = wanted[i] / group + (wanted[i] % group != 0 ? 1 : 0);
    const std::uint32_t limit = kernel.device->limits.maxComputeWorkGroupCount[i];
    if (count > std::int64_t{limit}) {
      return failure(ErrorKind::kDevice,
                     fmt::format("kernel {}: {} work groups along {} exceed the {} of {}: choose another --device, or "
                                 "use --device cpu",
                                 kernel.name, count, "xyz"[i], limit, kernel.device->info.name));
    }
    groups[i] = static_cast<std::uint32_t>(count);
  }
  return groups;
}

}  // namespace

Commands::Commands(std::unique_ptr<State> state) : state_(std::move(state)) {}
Commands::Commands(Commands&& other) noexcept = default;
Commands& Commands::operator=(Commands&& other) noexcept = default;
Commands::~Commands() = default;

Expected<Commands> Commands::create(const Device& device, const CommandsOptions& options) {
  return guarded("making a command buffer on " + device.info().name,
                 [&] { return Commands(std::make_unique<State>(device, options)); });
}

const Device& Commands::device() const { return state_->opened; }

Kernel Commands::kernel(std::string_view name, const std::vector<SpecConstant>& constants) {
  return state_->keep([&] { return Kernel::create(device(), find_kernel(name), constants); });
}

Buffer Commands::allocate(std::uint64_t size_bytes, BufferUse use) {
  return state_->keep([&] { return Buffer::create(device(), size_bytes, use); });
}

Buffer Commands::allocate_zeros(std::uint64_t size_bytes, BufferUse use) {
  Buffer zeros = allocate(size_bytes, use);
  if (state_->failed) return zeros;
  if (zeros.state().allocation.mapped != nullptr)
    state_->keep([&] { return zeros.fill_zero(); });
  else
    fill_zero(zeros);
  return zeros;
}

Buffer Commands::upload_bytes(std::span<const std::byte> bytes, BufferUse use) {
  Buffer made = allocate(bytes.size(), use);
  upload_bytes(bytes, made, 0);
  return made;
}

void Commands::upload_bytes(std::span<const std::byte> bytes, Buffer& to, std::uint64_t offset_bytes) {
  if (state_->failed) return;
  state_->keep([&] {
    return to.state().allocation.mapped != nullptr ? to.upload(bytes, offset_bytes)
                                                   : state_->upload(to, bytes, offset_bytes);
  });
}

Expected<void> Commands::download_bytes(const Buffer& from, std::span<std::byte> bytes) {
  if (state_->failed) return submit();
  if (from.state().allocation.mapped == nullptr) return state_->download(from, bytes);
  QUORUM_TRY(submit());
  return from.download(bytes);
}

void Commands::region(std::string_view name) { state_->region = name; }

void Commands::record(const Kernel& kernel, const Threads& threads, std::span<const std::byte> params,
                      std::span<const BufferView> buffers) {
  if (state_->failed) return;
  const Kernel::State& built = kernel.state();
  QUORUM_CHECK_EQ(built.device == state_->device, true);
  QUORUM_CHECK_EQ(params.size(), built.layout.push_constant_size);
  QUORUM_CHECK_EQ(buffers.size(), built.layout.buffer_count);
  QUORUM_CHECK_GE(threads.x, 0);
  QUORUM_CHECK_GE(threads.y, 0);
  QUORUM_CHECK_GE(threads.z, 0);
  if (threads.x == 0 || threads.y == 0 || threads.z == 0) return;
  const auto [x, y, z] = state_->keep([&] { return count_groups(built, threads); });
  for (const BufferView& view : buffers) state_->used.push_back(*view.buffer);
  state_->record(state_->region, [&](const vk::raii::CommandBuffer& commands) {
    const vk::DescriptorSet set = state_->descriptors.bind(built, buffers);
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *built.pipeline);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *built.pipeline_layout, 0, set, {});
    if (!params.empty()) {
      commands.pushConstants<std::byte>(*built.pipeline_layout, vk::ShaderStageFlagBits::eCompute, 0,
                                        {static_cast<std::uint32_t>(params.size()), params.data()});
    }
    commands.dispatch(x, y, z);
    ++state_->device->work.dispatches;
  });
}

void Commands::fill_zero(const BufferView& view) {
  if (state_->failed) return;
  QUORUM_CHECK_EQ(view.buffer->state().device == state_->device, true);
  QUORUM_CHECK_EQ(view.offset % 4, 0U);
  QUORUM_CHECK_EQ(view.size % 4 == 0 || view.offset + view.size == view.buffer->size(), true);
  if (view.size == 0) return;
  const BoundRange range = range_of(view);
  state_->used.push_back(*view.buffer);
  state_->record(state_->region, [&](const vk::raii::CommandBuffer& commands) {
    commands.fillBuffer(*view.buffer->state().allocation.buffer, range.offset, range.size, 0);
  });
}

void Commands::copy(const Buffer& from, const Buffer& to, std::uint64_t offset_bytes) {
  if (state_->failed) return;
  QUORUM_CHECK_EQ(from.state().device == state_->device, true);
  QUORUM_CHECK_EQ(to.state().device == state_->device, true);
  QUORUM_CHECK_LE(offset_bytes, to.size());
  QUORUM_CHECK_LE(from.size(), to.size() - offset_bytes);
  if (from.size() == 0) return;
  state_->used.insert(state_->used.end(), {from, to});
  state_->record(kTransfers, [&](const vk::raii::CommandBuffer& commands) {
    commands.copyBuffer(*from.state().allocation.buffer, *to.state().allocation.buffer,
                        vk::BufferCopy{.dstOffset = offset_bytes, .size = from.size()});
  });
}

Expected<void> Commands::submit() { return state_->submit(); }

const std::vector<RegionTiming>& Commands::timings() const { return state_->timings; }
double Commands::last_submission_seconds() const { return state_->last_submission_seconds; }

}  // namespace quorum
