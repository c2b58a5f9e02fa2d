#include "host/instance.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

namespace quorum {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr std::uint32_t kApiVersion = VK_API_VERSION_1_1;

bool offers(const std::vector<vk::ExtensionProperties>& extensions, std::string_view name) {
  return std::ranges::any_of(extensions, [&](const auto& extension) { return name == extension.extensionName.data(); });
}

Expected<vk::raii::Context> load_vulkan() {
  try {
    return vk::raii::Context();
  } catch (const std::runtime_error&) {
    return failure(ErrorKind::kNoDevice,
                   "there is no Vulkan loader (libvulkan.so.1): install it with a driver (Debian: libvulkan1, "
                   "mesa-vulkan-drivers), or use --device cpu");
  }
}

vk::raii::Instance create_instance(const vk::raii::Context& context, bool validation, bool debug_utils,
                                   bool validation_features) {
  const vk::ApplicationInfo application{.pApplicationName = "quorum", .apiVersion = kApiVersion};
  const std::array enabled{vk::ValidationFeatureEnableEXT::eSynchronizationValidation};
  const vk::ValidationFeaturesEXT features{.enabledValidationFeatureCount = enabled.size(),
                                           .pEnabledValidationFeatures = enabled.data()};
  std::vector<const char*> layers;
  std::vector<const char*> extensions;
  if (validation) layers.push_back(kValidationLayer);
  if (debug_utils) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  if (validation_features) extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
  return {context,
          {.pNext = validation_features ? &features : nullptr,
           .pApplicationInfo = &application,
           .enabledLayerCount = static_cast<std::uint32_t>(layers.size()),
           .ppEnabledLayerNames = layers.data(),
           .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
           .ppEnabledExtensionNames = extensions.data()}};
}

DeviceKind kind_of(vk::PhysicalDeviceType type) {
  switch (type) {
    case vk::PhysicalDeviceType::eDiscreteGpu:
      return DeviceKind::kDiscrete;
    case vk::PhysicalDeviceType::eIntegratedGpu:
      return DeviceKind::kIntegrated;
    case vk::PhysicalDeviceType::eVirtualGpu:
      return DeviceKind::kVirtual;
    case vk::PhysicalDeviceType::eCpu:
      return DeviceKind::kSoftware;
    default:
      return DeviceKind::kOther;
  }
}

std::string version_text(std::uint32_t version) {
  return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                     VK_API_VERSION_PATCH(version));
}

std::uint64_t largest_device_heap(const vk::raii::PhysicalDevice& physical) {
  const vk::PhysicalDeviceMemoryProperties memory = physical.getMemoryProperties();
  std::uint64_t largest = 0;
  for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
    const vk::MemoryHeap& heap = memory.memoryHeaps[i];
    if (heap.flags & vk::MemoryHeapFlagBits::eDeviceLocal) largest = std::max<std::uint64_t>(largest, heap.size);
  }
  return largest;
}

// What Vulkan 1.1 alone does not tell: only where the device has the extensions.
void describe_extensions(const vk::raii::PhysicalDevice& physical, DeviceInfo& info) {
  const auto extensions = physical.enumerateDeviceExtensionProperties();
  if (offers(extensions, VK_KHR_DRIVER_PROPERTIES_EXTENSION_NAME)) {
    const auto chain = physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
    const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
    info.driver_name = driver.driverName.data();
    info.driver_version = driver.driverInfo.data();
    if (driver.driverID == vk::DriverId::eMesaLlvmpipe) info.max_loop_iterations = 65535;
  }
  if (offers(extensions, VK_KHR_SHADER_FLOAT_CONTROLS_EXTENSION_NAME)) {
    const auto chain =
        physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceFloatControlsProperties>();
    const auto& controls = chain.get<vk::PhysicalDeviceFloatControlsProperties>();
    info.rounds_to_nearest_even = controls.shaderRoundingModeRTEFloat32 == VK_TRUE;
    info.preserves_denormals = controls.shaderDenormPreserveFloat32 == VK_TRUE;
  }
}

}  // namespace

Expected<Instance> make_instance(bool validation) {
  QUORUM_ASSIGN(auto context, load_vulkan());
  try {
    auto extensions = context.enumerateInstanceExtensionProperties();
    if (validation) {
      const auto layers = context.enumerateInstanceLayerProperties();
      const auto is_validation = [](const auto& layer) {
        return layer.layerName == std::string_view(kValidationLayer);
      };
      if (std::ranges::none_of(layers, is_validation)) {
        return failure(ErrorKind::kNoDevice,
                       fmt::format("the layer {} is not installed: install it (Debian: vulkan-validationlayers)",
                                   kValidationLayer));
      }
      const auto more = context.enumerateInstanceExtensionProperties(std::string(kValidationLayer));
      extensions.insert(extensions.end(), more.begin(), more.end());
    }
    const bool debug_utils = offers(extensions, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    const bool features = validation && offers(extensions, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
    auto handle = create_instance(context, validation, debug_utils, features);
    return Instance{std::move(context), std::move(handle), debug_utils};
  } catch (const vk::SystemError& exception) {
    return failure(ErrorKind::kNoDevice, fmt::format("there is no usable Vulkan driver ({}): install one (Debian: "
                                                     "mesa-vulkan-drivers), or use --device cpu",
                                                     exception.what()));
  }
}

std::optional<std::uint32_t> compute_queue_family(const vk::raii::PhysicalDevice& physical) {
  const auto families = physical.getQueueFamilyProperties();
  std::optional<std::uint32_t> best;
  int best_score = -1;
  for (std::uint32_t i = 0; i < families.size(); ++i) {
    if (!(families[i].queueFlags & vk::QueueFlagBits::eCompute)) continue;
    const int score =
        (families[i].timestampValidBits > 0 ? 2 : 0) + (families[i].queueFlags & vk::QueueFlagBits::eGraphics ? 0 : 1);
    if (score > best_score) best = i;
    best_score = std::max(best_score, score);
  }
  return best;
}

DeviceInfo describe_device(const vk::raii::PhysicalDevice& physical, int index) {
  const vk::PhysicalDeviceProperties properties = physical.getProperties();
  DeviceInfo info;
  info.index = index;
  info.name = properties.deviceName.data();
  info.kind = kind_of(properties.deviceType);
  info.driver_version = version_text(properties.driverVersion);
  info.api_version = version_text(properties.apiVersion);
  info.max_storage_buffer_range = properties.limits.maxStorageBufferRange;
  info.storage_buffer_alignment = properties.limits.minStorageBufferOffsetAlignment;
  info.max_texel_buffer_elements = properties.limits.maxTexelBufferElements;
  info.largest_device_heap = largest_device_heap(physical);
  info.max_work_group_invocations = properties.limits.maxComputeWorkGroupInvocations;
  info.shared_memory_bytes = properties.limits.maxComputeSharedMemorySize;
  info.has_float64 = physical.getFeatures().shaderFloat64 == VK_TRUE;
  if (properties.apiVersion < kApiVersion) {
    info.defect = fmt::format("it has Vulkan {}, and 1.1 is needed: update its driver", info.api_version);
    return info;
  }
  const auto chain = physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceMaintenance3Properties,
                                             vk::PhysicalDeviceSubgroupProperties>();
  info.max_allocation = chain.get<vk::PhysicalDeviceMaintenance3Properties>().maxMemoryAllocationSize;
  info.subgroup_size = chain.get<vk::PhysicalDeviceSubgroupProperties>().subgroupSize;
  describe_extensions(physical, info);
  if (!compute_queue_family(physical)) info.defect = "it has no queue for compute work";
  return info;
}

}  // namespace quorum
