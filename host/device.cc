#include "host/device.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "host/state.h"

namespace quorum {
namespace {

VKAPI_ATTR VkBool32 VKAPI_CALL keep_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                            const VkDebugUtilsMessengerCallbackDataEXT* data, void* log) {
  auto* messages = static_cast<MessageLog*>(log);
  const std::scoped_lock lock(messages->mutex);
  messages->messages.emplace_back(data->pMessage);
  return VK_FALSE;
}

// Type "general" is left out: loaders use it to talk about drivers of other devices.
vk::raii::DebugUtilsMessengerEXT make_messenger(const Instance& instance, MessageLog& log) {
  using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
  using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
  return {instance.handle,
          vk::DebugUtilsMessengerCreateInfoEXT{.messageSeverity = Severity::eWarning | Severity::eError,
                                               .messageType = Type::eValidation | Type::ePerformance,
                                               .pfnUserCallback = keep_message,
                                               .pUserData = &log}};
}

void open_queue(Device::State& state) {
  const auto families = state.physical.getQueueFamilyProperties();
  state.queue_family = compute_queue_family(state.physical).value();
  state.timestamp_bits = families[state.queue_family].timestampValidBits;
  const float priority = 1.0F;
  const vk::DeviceQueueCreateInfo queue{
      .queueFamilyIndex = state.queue_family, .queueCount = 1, .pQueuePriorities = &priority};
  const vk::PhysicalDeviceFeatures features{.shaderFloat64 = state.info.has_float64 ? VK_TRUE : VK_FALSE};
  state.device = {
      state.physical,
      vk::DeviceCreateInfo{.queueCreateInfoCount = 1, .pQueueCreateInfos = &queue, .pEnabledFeatures = &features}};
  state.queue = {state.device, state.queue_family, 0};
}

// The lowest memory type among allowed that has all flags of a wish, and its flags.
std::pair<std::uint32_t, vk::MemoryPropertyFlags> find_memory(const vk::PhysicalDeviceMemoryProperties& memory,
                                                              std::uint32_t allowed,
                                                              std::initializer_list<vk::MemoryPropertyFlags> wishes) {
  for (const vk::MemoryPropertyFlags wish : wishes) {
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
      const vk::MemoryPropertyFlags flags = memory.memoryTypes[i].propertyFlags;
      if ((allowed >> i & 1U) != 0 && (flags & wish) == wish) return {i, flags};
    }
  }
  throw vk::OutOfDeviceMemoryError("no fitting kind of memory");
}

bool has_memory(const vk::PhysicalDeviceMemoryProperties& memory, vk::MemoryPropertyFlags flags) {
  for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i)
    if ((memory.memoryTypes[i].propertyFlags & flags) == flags) return true;
  return false;
}

}  // namespace

Expected<Device> Device::open(const DeviceInfo& info, const DeviceOptions& options) {
  if (!info.usable()) {
    return failure(ErrorKind::kNoDevice, fmt::format("device {} can't be used: {}", info.name, info.defect));
  }
  QUORUM_ASSIGN(auto instance, make_instance(options.validation));
  const std::string doing = fmt::format("opening device {}", info.name);
  auto state = guarded(doing, [&] {
    auto opened = std::make_shared<State>(std::move(instance));
    opened->options = options;
    const auto devices = opened->instance.handle.enumeratePhysicalDevices();
    if (std::cmp_greater_equal(info.index, devices.size())) return std::shared_ptr<State>();
    opened->physical = devices[static_cast<std::size_t>(info.index)];
    opened->info = describe_device(opened->physical, info.index);
    if (opened->info.name != info.name) return std::shared_ptr<State>();
    opened->limits = opened->physical.getProperties().limits;
    if (options.max_storage_buffer_range > 0) {
      opened->info.max_storage_buffer_range = options.max_storage_buffer_range;
      opened->limits.maxStorageBufferRange = static_cast<std::uint32_t>(options.max_storage_buffer_range);
    }
    opened->memory = opened->physical.getMemoryProperties();
    opened->maps_buffers = !options.force_staging && has_memory(opened->memory, kDirectMemory);
    constexpr std::uint64_t kMostPooled = 1ULL << 30;
    constexpr std::uint64_t kShareOfHeap = 8;
    opened->pool.set_limit(std::min(opened->info.largest_device_heap / kShareOfHeap, kMostPooled));
    if (options.validation) opened->messenger = make_messenger(opened->instance, opened->log);
    open_queue(*opened);
    opened->transfer = opened->make_recorder();
    return opened;
  });
  if (!state) return std::unexpected(state.error());
  if (*state == nullptr) {
    return failure(ErrorKind::kNoDevice, doing + ": it is no longer there: see which devices are left, or use cpu");
  }
  return Device(std::move(*state));
}

const DeviceInfo& Device::info() const { return state_->info; }

bool Device::maps_buffers() const { return state_->maps_buffers; }

DeviceWork Device::work() const {
  const WorkCounters& work = state_->work;
  return {work.uploaded_bytes, work.downloaded_bytes, work.submissions,
          work.dispatches,     work.allocations,      1e-9 * static_cast<double>(work.waited_nanoseconds)};
}

std::vector<std::string> Device::take_validation_messages() const {
  const std::scoped_lock lock(state_->log.mutex);
  return std::exchange(state_->log.messages, {});
}

Allocation Device::State::allocate(std::uint64_t size, vk::BufferUsageFlags usage,
                                   std::initializer_list<vk::MemoryPropertyFlags> wishes) const {
  using Flag = vk::MemoryPropertyFlagBits;
  Allocation made;
  made.buffer = {device, vk::BufferCreateInfo{.size = size, .usage = usage}};
  const vk::MemoryRequirements needs = made.buffer.getMemoryRequirements();
  const auto [type, flags] = find_memory(memory, needs.memoryTypeBits, wishes);
  made.memory = {device, vk::MemoryAllocateInfo{.allocationSize = needs.size, .memoryTypeIndex = type}};
  ++work.allocations;
  made.buffer.bindMemory(*made.memory, 0);
  made.bytes = size;
  const vk::MemoryPropertyFlags visible = Flag::eHostVisible | Flag::eHostCoherent;
  if ((flags & visible) == visible) made.mapped = static_cast<std::byte*>(made.memory.mapMemory(0, VK_WHOLE_SIZE));
  return made;
}

Allocation Device::State::allocate_staging() const {
  using Flag = vk::MemoryPropertyFlagBits;
  using Usage = vk::BufferUsageFlagBits;
  const vk::MemoryPropertyFlags mapped = Flag::eHostVisible | Flag::eHostCoherent;
  return allocate(kStagingBytes, Usage::eTransferSrc | Usage::eTransferDst, {mapped | Flag::eHostCached, mapped});
}

Recorder Device::State::make_recorder() const {
  Recorder made;
  made.pool = {device, vk::CommandPoolCreateInfo{.flags = vk::CommandPoolCreateFlagBits::eTransient,
                                                 .queueFamilyIndex = queue_family}};
  vk::raii::CommandBuffers buffers(
      device, {.commandPool = *made.pool, .level = vk::CommandBufferLevel::ePrimary, .commandBufferCount = 1});
  made.commands = std::move(buffers.front());
  made.fence = {device, vk::FenceCreateInfo{}};
  return made;
}

Expected<void> Device::State::submit(const Recorder& recorder, std::chrono::nanoseconds timeout,
                                     std::string_view doing) {
  try {
    {
      const std::scoped_lock lock(queue_mutex);
      device.resetFences(*recorder.fence);
      const vk::SubmitInfo submission{.commandBufferCount = 1, .pCommandBuffers = &*recorder.commands};
      queue.submit(submission, *recorder.fence);
      ++work.submissions;
    }
    const auto limit = static_cast<std::uint64_t>(timeout.count());
    const auto began = std::chrono::steady_clock::now();
    const vk::Result result = device.waitForFences(*recorder.fence, VK_TRUE, limit);
    work.waited_nanoseconds +=
        std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now() - began).count();
    if (result == vk::Result::eSuccess) return {};
    const std::scoped_lock lock(queue_mutex);
    unanswered = true;
    return failure(ErrorKind::kDevice,
                   fmt::format("{}: {} gave no answer within {} s: run again with smaller pieces of work, or use "
                               "--device cpu",
                               doing, info.name, std::chrono::duration<double>(timeout).count()));
  } catch (const vk::SystemError& exception) {
    return std::unexpected(vulkan_error(fmt::format("{} on {}", doing, info.name), exception));
  }
}

Expected<void> Device::State::transfer_now(std::string_view doing,
                                           const std::function<void(const vk::raii::CommandBuffer&)>& record) {
  settle();
  auto recorded = guarded(doing, [&] {
    transfer.pool.reset();
    transfer.commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    record(transfer.commands);
    publish_writes(transfer.commands);
    transfer.commands.end();
  });
  if (!recorded) return recorded;
  return submit(transfer, kPatience, doing);
}

void Device::State::settle() noexcept {
  const std::scoped_lock lock(queue_mutex);
  if (!unanswered) return;
  try {
    device.waitIdle();
  } catch (const vk::SystemError&) {
    // A lost device is idle too.
  }
  unanswered = false;
}

void publish_writes(const vk::raii::CommandBuffer& commands) {
  using Stage = vk::PipelineStageFlagBits;
  using Access = vk::AccessFlagBits;
  const vk::MemoryBarrier barrier{.srcAccessMask = Access::eShaderWrite | Access::eTransferWrite,
                                  .dstAccessMask = Access::eShaderRead | Access::eShaderWrite | Access::eTransferRead |
                                                   Access::eTransferWrite | Access::eHostRead | Access::eHostWrite};
  commands.pipelineBarrier(Stage::eComputeShader | Stage::eTransfer,
                           Stage::eComputeShader | Stage::eTransfer | Stage::eHost, {}, barrier, {}, {});
}

}  // namespace quorum
