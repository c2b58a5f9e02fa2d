#include "host/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "engine/core/check.h"
#include "host/descriptors.h"
#include "host/state.h"
#include "host/timestamps.h"

namespace quorum {

struct Commands::State {
  Device opened;
  std::shared_ptr<Device::State> device;
  CommandsOptions options;
  Recorder recorder;
  Descriptors descriptors;
  Timestamps timestamps;
  std::vector<RegionTiming> timings;
  double last_submission_seconds = 0.0;
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
        timestamps(*device) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { device->settle(); }

  void start();
  void end();
  void clear();
  void record(const std::function<void(const vk::raii::CommandBuffer&)>& function);
  template <typename Function>
  auto keep(const Function& function) -> std::invoke_result_t<Function>::value_type;
};

// Before a command: starts recording and the region, as far as they are not.
void Commands::State::start() {
  if (!recording) {
    device->settle();
    recorder.pool.reset();
    descriptors.reset();
    recorder.commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    recording = true;
    timestamps.begin(recorder.commands);
  }
  if (open_region == region) return;
  timestamps.start_region(recorder.commands, region);
  if (device->instance.debug_utils) {
    if (open_region) recorder.commands.endDebugUtilsLabelEXT();
    recorder.commands.beginDebugUtilsLabelEXT({.pLabelName = region.c_str()});
  }
  open_region = region;
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

void Commands::State::record(const std::function<void(const vk::raii::CommandBuffer&)>& function) {
  keep([&] {
    return guarded("recording " + region, [&] {
      start();
      function(recorder.commands);
      publish_writes(recorder.commands);
    });
  });
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
  state_->keep([&] { return zeros.fill_zero(); });
  return zeros;
}

Buffer Commands::upload_bytes(std::span<const std::byte> bytes, BufferUse use) {
  return state_->keep([&] { return Buffer::of(device(), bytes, use); });
}

void Commands::upload_bytes(std::span<const std::byte> bytes, Buffer& to, std::uint64_t offset_bytes) {
  state_->keep([&] { return to.upload(bytes, offset_bytes); });
}

Expected<void> Commands::download_bytes(const Buffer& from, std::span<std::byte> bytes) {
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
  state_->record([&](const vk::raii::CommandBuffer& commands) {
    const vk::DescriptorSet set = state_->descriptors.bind(built, buffers);
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *built.pipeline);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *built.pipeline_layout, 0, set, {});
    if (!params.empty()) {
      commands.pushConstants<std::byte>(*built.pipeline_layout, vk::ShaderStageFlagBits::eCompute, 0,
                                        {static_cast<std::uint32_t>(params.size()), params.data()});
    }
    commands.dispatch(x, y, z);
  });
}

void Commands::fill_zero(const BufferView& view) {
  if (state_->failed) return;
  QUORUM_CHECK_EQ(view.buffer->state().device == state_->device, true);
  QUORUM_CHECK_EQ(view.offset % 4, 0U);
  QUORUM_CHECK_EQ(view.size % 4 == 0 || view.offset + view.size == view.buffer->size(), true);
  if (view.size == 0) return;
  const BoundRange range = range_of(view);
  state_->record([&](const vk::raii::CommandBuffer& commands) {
    commands.fillBuffer(*view.buffer->state().allocation.buffer, range.offset, range.size, 0);
  });
}

void Commands::copy(const Buffer& from, const Buffer& to) {
  if (state_->failed) return;
  QUORUM_CHECK_EQ(from.state().device == state_->device, true);
  QUORUM_CHECK_EQ(to.state().device == state_->device, true);
  QUORUM_CHECK_EQ(from.size(), to.size());
  if (from.size() == 0) return;
  state_->record([&](const vk::raii::CommandBuffer& commands) {
    commands.copyBuffer(*from.state().allocation.buffer, *to.state().allocation.buffer,
                        vk::BufferCopy{.size = from.size()});
  });
}

Expected<void> Commands::submit() {
  State& state = *state_;
  state.last_submission_seconds = 0.0;
  if (state.failed) {
    Error error = *std::move(state.failed);
    state.clear();
    return std::unexpected(std::move(error));
  }
  if (!state.recording) return {};
  const std::string doing = "running " + *state.open_region;
  if (auto ended = guarded(doing, [&] { state.end(); }); !ended) {
    state.clear();
    return ended;
  }
  state.clear();
  const auto began = std::chrono::steady_clock::now();
  QUORUM_TRY(state.device->submit(state.recorder, state.options.timeout, doing));
  const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - began;
  return guarded(doing, [&] {
    const double measured = state.timestamps.collect(state.timings);
    state.last_submission_seconds = state.device->timestamp_bits > 0 ? measured : waited.count();
  });
}

const std::vector<RegionTiming>& Commands::timings() const { return state_->timings; }
double Commands::last_submission_seconds() const { return state_->last_submission_seconds; }

}  // namespace quorum
