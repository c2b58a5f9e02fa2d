// What devices, buffers and kernels hold of Vulkan. For the files of this layer alone; stages need none of it.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/allocation.h"
#include "host/buffer.h"
#include "host/device.h"
#include "host/instance.h"
#include "host/kernel.h"
#include "host/memory_pool.h"
#include "host/vulkan.h"

namespace quorum {

/// Messages of the validation layer, which may come from any thread.
struct MessageLog {
  std::mutex mutex;
  std::vector<std::string> messages;
};

/// A pool with one command buffer, and the fence that says when it is done.
struct Recorder {
  vk::raii::CommandPool pool = nullptr;
  vk::raii::CommandBuffer commands = nullptr;
  vk::raii::Fence fence = nullptr;
};

/// What was asked of a device, by any thread.
struct WorkCounters {
  std::atomic<std::uint64_t> uploaded_bytes = 0;
  std::atomic<std::uint64_t> downloaded_bytes = 0;
  std::atomic<std::uint64_t> submissions = 0;
  std::atomic<std::uint64_t> dispatches = 0;
  std::atomic<std::uint64_t> allocations = 0;
  std::atomic<std::int64_t> waited_nanoseconds = 0;
};

struct Device::State {
  DeviceInfo info;
  DeviceOptions options;
  Instance instance;
  MessageLog log;
  vk::raii::DebugUtilsMessengerEXT messenger = nullptr;
  vk::raii::PhysicalDevice physical = nullptr;
  vk::PhysicalDeviceLimits limits;
  vk::PhysicalDeviceMemoryProperties memory;
  bool maps_buffers = false;  ///< the host reads and writes them where they are, without copies
  std::uint32_t queue_family = 0;
  std::uint32_t timestamp_bits = 0;  ///< valid bits of a timestamp; 0: the queue has none
  vk::raii::Device device = nullptr;
  vk::raii::Queue queue = nullptr;
  std::mutex queue_mutex;
  bool unanswered = false;  ///< a submission did not end in time; guarded by queue_mutex

  std::mutex transfer_mutex;  ///< guards what follows
  Recorder transfer;
  Allocation staging;

  mutable WorkCounters work;

  std::mutex kernel_mutex;                                      ///< guards what follows
  std::map<std::string, std::weak_ptr<Kernel::State>> kernels;  ///< that were built, by name and constants
  MemoryPool pool;                                              ///< of buffers that are not mapped

  explicit State(Instance from) : instance(std::move(from)) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { settle(); }

  /// A buffer of size bytes in the first kind of memory that has all flags of a wish; wishes from best to worst.
  /// Mapped if that memory is visible to the host and coherent. Throws vk::SystemError.
  Allocation allocate(std::uint64_t size, vk::BufferUsageFlags usage,
                      std::initializer_list<vk::MemoryPropertyFlags> wishes) const;

  /// A mapped buffer of kStagingBytes, for copies to and from buffers that are not. Throws vk::SystemError.
  [[nodiscard]] Allocation allocate_staging() const;

  /// Throws vk::SystemError.
  [[nodiscard]] Recorder make_recorder() const;

  /// Submits what recorder holds and waits. Fails (kDevice) if the device is lost or gives no answer within timeout,
  /// (kMemory) if memory runs out. doing: the clause in front of the message.
  Expected<void> submit(const Recorder& recorder, std::chrono::nanoseconds timeout, std::string_view doing);

  /// Records, submits and waits for a transfer; the caller holds transfer_mutex.
  Expected<void> transfer_now(std::string_view doing,
                              const std::function<void(const vk::raii::CommandBuffer&)>& record);

  /// Waits for a submission that gave no answer in time, before what it may use is destroyed or used again.
  void settle() noexcept;
};

struct Buffer::State {
  std::shared_ptr<Device::State> device;
  std::uint64_t size = 0;      ///< bytes the caller asked for
  std::uint64_t capacity = 0;  ///< bytes there are: size rounded up to whole words, at least one
  Allocation allocation;

  ~State() {
    device->settle();
    if (allocation.mapped == nullptr) device->pool.give(std::move(allocation));
  }
};

struct Kernel::State {
  std::shared_ptr<Device::State> device;
  std::string name;
  KernelLayout layout;
  vk::raii::DescriptorSetLayout set_layout = nullptr;
  vk::raii::PipelineLayout pipeline_layout = nullptr;
  vk::raii::Pipeline pipeline = nullptr;

  ~State() { device->settle(); }
};

/// What Vulkan calls a kind of buffer.
constexpr vk::DescriptorType descriptor_type(BufferKind kind) {
  return kind == BufferKind::kTexels ? vk::DescriptorType::eUniformTexelBuffer : vk::DescriptorType::eStorageBuffer;
}

/// Memory in which buffers are used directly, where there is such: the host reads it fast, too (cached), as on
/// integrated GPUs and software. Discrete GPUs have a window into their memory, but reading through it is slower than a
/// copy.
inline constexpr vk::MemoryPropertyFlags kDirectMemory =
    vk::MemoryPropertyFlagBits::eDeviceLocal | vk::MemoryPropertyFlagBits::eHostVisible |
    vk::MemoryPropertyFlagBits::eHostCoherent | vk::MemoryPropertyFlagBits::eHostCached;

/// The size of the buffers through which values are copied where memory isn't mapped: a copy of this size takes far
/// longer than its submission.
inline constexpr std::uint64_t kStagingBytes = 16U << 20;

/// How long a submission may take before it counts as failed. Drivers reset a GPU that hangs long before.
inline constexpr std::chrono::seconds kPatience{120};

/// Makes what kernels and copies wrote visible to all later kernels, copies and the host.
void publish_writes(const vk::raii::CommandBuffer& commands);

}  // namespace quorum
