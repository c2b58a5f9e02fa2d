#include "host/kernel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "host/state.h"

namespace quorum {
namespace {

Expected<void> check_limits(const Device::State& device, const std::string& name, const KernelLayout& layout) {
  const vk::PhysicalDeviceLimits& limits = device.limits;
  const auto [x, y, z] = layout.group_size;
  const auto refuse = [&](const std::string& what) {
    return failure(ErrorKind::kDevice, fmt::format("kernel {}: {} of {}: choose another --device, or use --device cpu",
                                                   name, what, device.info.name));
  };
  if (x == 0 || y == 0 || z == 0 || x > limits.maxComputeWorkGroupSize[0] || y > limits.maxComputeWorkGroupSize[1] ||
      z > limits.maxComputeWorkGroupSize[2] || std::uint64_t{x} * y * z > limits.maxComputeWorkGroupInvocations) {
    return refuse(fmt::format("a work group of {} x {} x {} exceeds the {} invocations", x, y, z,
                              limits.maxComputeWorkGroupInvocations));
  }
  const auto storage_count = static_cast<std::uint32_t>(std::ranges::count(layout.buffers, BufferKind::kStorage));
  if (storage_count > limits.maxPerStageDescriptorStorageBuffers) {
    return refuse(fmt::format("{} buffers exceed the {}", storage_count, limits.maxPerStageDescriptorStorageBuffers));
  }
  if (layout.buffer_count - storage_count > limits.maxPerStageDescriptorSampledImages) {
    return refuse(fmt::format("{} texel buffers exceed the {}", layout.buffer_count - storage_count,
                              limits.maxPerStageDescriptorSampledImages));
  }
  if (layout.push_constant_size > limits.maxPushConstantsSize) {
    return refuse(fmt::format("{} bytes of push constants exceed the {}", layout.push_constant_size,
                              limits.maxPushConstantsSize));
  }
  return {};
}

vk::raii::DescriptorSetLayout make_set_layout(const vk::raii::Device& device, const KernelLayout& layout) {
  std::vector<vk::DescriptorSetLayoutBinding> bindings;
  bindings.reserve(layout.buffer_count);
  for (std::uint32_t i = 0; i < layout.buffer_count; ++i) {
    bindings.push_back({.binding = i,
                        .descriptorType = descriptor_type(layout.buffers[i]),
                        .descriptorCount = 1,
                        .stageFlags = vk::ShaderStageFlagBits::eCompute});
  }
  return {device, vk::DescriptorSetLayoutCreateInfo{.bindingCount = layout.buffer_count, .pBindings = bindings.data()}};
}

vk::raii::PipelineLayout make_pipeline_layout(const vk::raii::Device& device, const KernelLayout& layout,
                                              const vk::raii::DescriptorSetLayout& set) {
  const vk::PushConstantRange range{.stageFlags = vk::ShaderStageFlagBits::eCompute, .size = layout.push_constant_size};
  return {device, vk::PipelineLayoutCreateInfo{.setLayoutCount = 1,
                                               .pSetLayouts = &*set,
                                               .pushConstantRangeCount = layout.push_constant_size > 0 ? 1U : 0U,
                                               .pPushConstantRanges = &range}};
}

vk::raii::Pipeline make_pipeline(const vk::raii::Device& device, const KernelCode& code, const Kernel::State& state) {
  const vk::raii::ShaderModule module(
      device, vk::ShaderModuleCreateInfo{.codeSize = code.words.size_bytes(), .pCode = code.words.data()});
  std::vector<vk::SpecializationMapEntry> entries;
  std::vector<std::uint32_t> values;
  for (const DeclaredConstant& constant : state.layout.constants) {
    const auto offset = static_cast<std::uint32_t>(values.size() * sizeof(std::uint32_t));
    entries.push_back({.constantID = constant.id, .offset = offset, .size = sizeof(std::uint32_t)});
    values.push_back(constant.value);
  }
  const vk::SpecializationInfo constants{.mapEntryCount = static_cast<std::uint32_t>(entries.size()),
                                         .pMapEntries = entries.data(),
                                         .dataSize = values.size() * sizeof(std::uint32_t),
                                         .pData = values.data()};
  return {device, nullptr,
          vk::ComputePipelineCreateInfo{.stage = {.stage = vk::ShaderStageFlagBits::eCompute,
                                                  .module = *module,
                                                  .pName = "main",
                                                  .pSpecializationInfo = &constants},
                                        .layout = *state.pipeline_layout}};
}

}  // namespace

Expected<Kernel> Kernel::create(const Device& device, const KernelCode& code,
                                const std::vector<SpecConstant>& constants) {
  std::string key = fmt::format("{} {}", code.name, fmt::ptr(code.words.data()));
  for (const SpecConstant& constant : constants) key += fmt::format(" {}={}", constant.name, constant.value);
  Device::State& on = *device.state();
  const std::scoped_lock lock(on.kernel_mutex);
  if (auto built = on.kernels[key].lock()) return Kernel(std::move(built));
  auto state = std::make_shared<State>();
  state->device = device.state();
  state->name = code.name;
  state->layout = reflect_kernel(code, constants);
  QUORUM_TRY(check_limits(*state->device, state->name, state->layout));
  return guarded(fmt::format("building kernel {} on {}", code.name, device.info().name), [&] {
    const vk::raii::Device& vulkan = state->device->device;
    state->set_layout = make_set_layout(vulkan, state->layout);
    state->pipeline_layout = make_pipeline_layout(vulkan, state->layout, state->set_layout);
    state->pipeline = make_pipeline(vulkan, code, *state);
    on.kernels[key] = state;
    return Kernel(std::move(state));
  });
}

const std::string& Kernel::name() const { return state_->name; }
const KernelLayout& Kernel::layout() const { return state_->layout; }

}  // namespace quorum
