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
  std::shared_ptr<Device::State> device;
  CommandsOptions options;
  Recorder recorder;
  Descriptors descriptors;
  std::vector<vk::raii::BufferView> texel_views;  ///< of what is recorded
  Timestamps timestamps;
  std::vector<RegionTiming> timings;
  double last_submission_seconds = 0.0;
  std::string region = "other";            ///< of what is recorded next
  std::optional<std::string> open_region;  ///< of what was recorded last
  bool recording = false;
  std::optional<Error> failed;  ///< while recording

  explicit State(std::shared_ptr<Device::State> from)
      : device(std::move(from)), recorder(device->make_recorder()), descriptors(*device), timestamps(*device) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { device->settle(); }

  void start();
  void end();
  void clear();
  void record(const std::function<void(const vk::raii::CommandBuffer&)>& function);
};

// Before a command: starts recording and the region, as far as they are not.
void Commands::State::start() {
  if (!recording) {
    device->settle();
    recorder.pool.reset();
    descriptors.reset();
    texel_views.clear();
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

void Commands::State::record(const std::function<void(const vk::raii::CommandBuffer&)>& function) {
  if (failed) return;
  const auto recorded = guarded("recording " + region, [&] {
    start();
    function(recorder.commands);
    publish_writes(recorder.commands);
  });
  if (!recorded) failed = recorded.error();
}

namespace {

struct BoundRange {
  std::uint64_t offset = 0;
  std::uint64_t size = 0;
};

// The range of a view in whole words, since kernels read words; at least one.
BoundRange range_of(const BufferView& view) {
  const std::uint64_t capacity = view.buffer->state().capacity;
  QUORUM_CHECK_LE(view.offset, view.buffer->size());
  QUORUM_CHECK_LE(view.size, view.buffer->size() - view.offset);
  const BoundRange range{view.offset, (std::max<std::uint64_t>(view.size, 1) + 3) / 4 * 4};
  QUORUM_CHECK_LE(range.offset + range.size, capacity);
  return range;
}

vk::DescriptorBufferInfo storage_of(const BufferView& view, const vk::PhysicalDeviceLimits& limits) {
  QUORUM_CHECK_EQ(view.offset % limits.minStorageBufferOffsetAlignment, 0U);
  const auto [offset, size] = range_of(view);
  QUORUM_CHECK_LE(size, limits.maxStorageBufferRange);
  return {.buffer = *view.buffer->state().allocation.buffer, .offset = offset, .range = size};
}

vk::raii::BufferView texels_of(const BufferView& view, const Device::State& device) {
  constexpr std::uint64_t kTexelBytes = 16;
  QUORUM_CHECK_EQ(view.offset % device.limits.minTexelBufferOffsetAlignment, 0U);
  QUORUM_CHECK_EQ(view.size % kTexelBytes, 0U);
  QUORUM_CHECK_LE(view.size / kTexelBytes, device.limits.maxTexelBufferElements);
  return {device.device, vk::BufferViewCreateInfo{.buffer = *view.buffer->state().allocation.buffer,
                                                  .format = vk::Format::eR32G32B32A32Uint,
                                                  .offset = view.offset,
                                                  .range = view.size}};
}

// texel_views: keeps what the set refers to.
vk::DescriptorSet bind_buffers(Descriptors& descriptors, std::vector<vk::raii::BufferView>& texel_views,
                               const Kernel::State& kernel, std::span<const BufferView> buffers) {
  const vk::DescriptorSet set = descriptors.make_set(kernel);
  for (std::uint32_t i = 0; i < buffers.size(); ++i) {
    const BufferView& view = buffers[i];
    QUORUM_CHECK_EQ(view.buffer->state().device == kernel.device, true);
    const BufferKind kind = kernel.layout.buffers[i];
    vk::WriteDescriptorSet write{
        .dstSet = set, .dstBinding = i, .descriptorCount = 1, .descriptorType = descriptor_type(kind)};
    vk::DescriptorBufferInfo storage;
    if (kind == BufferKind::kTexels) {
      texel_views.push_back(texels_of(view, *kernel.device));
      write.pTexelBufferView = &*texel_views.back();
    } else {
      storage = storage_of(view, kernel.device->limits);
      write.pBufferInfo = &storage;
    }
    kernel.device->device.updateDescriptorSets(write, {});
  }
  return set;
}

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
  return guarded("making a command buffer on " + device.info().name, [&] {
    auto state = std::make_unique<State>(device.state());
    state->options = options;
    return Commands(std::move(state));
  });
}

void Commands::region(std::string_view name) { state_->region = name; }

void Commands::record(const Kernel& kernel, const Threads& threads, std::span<const std::byte> params,
                      std::span<const BufferView> buffers) {
  const Kernel::State& built = kernel.state();
  QUORUM_CHECK_EQ(built.device == state_->device, true);
  QUORUM_CHECK_EQ(params.size(), built.layout.push_constant_size);
  QUORUM_CHECK_EQ(buffers.size(), built.layout.buffer_count);
  QUORUM_CHECK_GE(threads.x, 0);
  QUORUM_CHECK_GE(threads.y, 0);
  QUORUM_CHECK_GE(threads.z, 0);
  if (threads.x == 0 || threads.y == 0 || threads.z == 0 || state_->failed) return;
  const auto groups = count_groups(built, threads);
  if (!groups) {
    state_->failed = groups.error();
    return;
  }
  state_->record([&](const vk::raii::CommandBuffer& commands) {
    const vk::DescriptorSet set = bind_buffers(state_->descriptors, state_->texel_views, built, buffers);
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *built.pipeline);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *built.pipeline_layout, 0, set, {});
    if (!params.empty()) {
      commands.pushConstants<std::byte>(*built.pipeline_layout, vk::ShaderStageFlagBits::eCompute, 0,
                                        {static_cast<std::uint32_t>(params.size()), params.data()});
    }
    const auto [x, y, z] = *groups;
    commands.dispatch(x, y, z);
  });
}

void Commands::fill_zero(const BufferView& view) {
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
  if (!state.recording && !state.failed) return {};
  if (state.failed) {
    const Error error = *state.failed;
    state.clear();
    return std::unexpected(error);
  }
  const std::string doing = "running " + *state.open_region;
  if (auto ended = guarded(doing, [&] { state.end(); }); !ended) {
    state.clear();
    return ended;
  }
  state.clear();
  const auto began = std::chrono::steady_clock::now();
  if (auto done = state.device->submit(state.recorder, state.options.timeout, doing); !done) return done;
  const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - began;
  return guarded(doing, [&] {
    const double measured = state.timestamps.collect(state.timings);
    state.last_submission_seconds = state.device->timestamp_bits > 0 ? measured : waited.count();
  });
}

const std::vector<RegionTiming>& Commands::timings() const { return state_->timings; }
double Commands::last_submission_seconds() const { return state_->last_submission_seconds; }

}  // namespace quorum
