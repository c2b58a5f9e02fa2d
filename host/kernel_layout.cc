#include "host/kernel_layout.h"

#include <fmt/format.h>
#include <spirv_cross_c.h>

#include <algorithm>
#include <memory>
#include <span>
#include <utility>

namespace quorum {
namespace {

using Context = std::unique_ptr<spvc_context_s, decltype(&spvc_context_destroy)>;

// SPIR-V comes from our own build, so a failure is ours.
void must(spvc_result result, const KernelCode& code) {
  if (result != SPVC_SUCCESS) fail_check(__FILE__, __LINE__, "SPIRV-Cross reads the kernel", code.name, int{result});
}

spvc_compiler parse(const Context& context, const KernelCode& code) {
  spvc_parsed_ir parsed = nullptr;
  must(spvc_context_parse_spirv(context.get(), code.words.data(), code.words.size(), &parsed), code);
  spvc_compiler compiler = nullptr;
  must(spvc_context_create_compiler(context.get(), SPVC_BACKEND_NONE, parsed, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP,
                                    &compiler),
       code);
  return compiler;
}

std::span<const spvc_reflected_resource> resources_of(spvc_resources resources, spvc_resource_type type) {
  const spvc_reflected_resource* list = nullptr;
  std::size_t count = 0;
  spvc_resources_get_resource_list_for_type(resources, type, &list, &count);
  return {list, count};
}

// The kinds of the buffers in the order of their bindings.
std::vector<BufferKind> list_buffers(spvc_compiler compiler, spvc_resources resources, const KernelCode& code) {
  for (const auto type :
       {SPVC_RESOURCE_TYPE_UNIFORM_BUFFER, SPVC_RESOURCE_TYPE_STORAGE_IMAGE, SPVC_RESOURCE_TYPE_SEPARATE_IMAGE,
        SPVC_RESOURCE_TYPE_SEPARATE_SAMPLERS, SPVC_RESOURCE_TYPE_SUBPASS_INPUT}) {
    if (!resources_of(resources, type).empty()) {
      fail_check(__FILE__, __LINE__, "kernel binds storage and texel buffers only", code.name, int{type});
    }
  }
  std::vector<std::pair<std::uint32_t, BufferKind>> bindings;
  const auto add = [&](spvc_resource_type resource_type, BufferKind kind) {
    for (const auto& buffer : resources_of(resources, resource_type)) {
      QUORUM_CHECK_EQ(spvc_compiler_get_decoration(compiler, buffer.id, SpvDecorationDescriptorSet), 0U);
      const spvc_type type = spvc_compiler_get_type_handle(compiler, buffer.type_id);
      QUORUM_CHECK_EQ(spvc_type_get_num_array_dimensions(type), 0U);
      if (kind == BufferKind::kTexels && spvc_type_get_image_dimension(type) != SpvDimBuffer)
        fail_check(__FILE__, __LINE__, "kernel samples no images", code.name, int{resource_type});
      bindings.emplace_back(spvc_compiler_get_decoration(compiler, buffer.id, SpvDecorationBinding), kind);
    }
  };
  add(SPVC_RESOURCE_TYPE_STORAGE_BUFFER, BufferKind::kStorage);
  add(SPVC_RESOURCE_TYPE_SAMPLED_IMAGE, BufferKind::kTexels);
  std::ranges::sort(bindings);
  std::vector<BufferKind> kinds;
  for (const auto& [binding, kind] : bindings) {
    if (binding != kinds.size()) fail_check(__FILE__, __LINE__, "bindings are 0, 1, 2, ...", code.name, binding);
    kinds.push_back(kind);
  }
  return kinds;
}

std::uint32_t push_constant_size(spvc_compiler compiler, spvc_resources resources, const KernelCode& code) {
  const auto blocks = resources_of(resources, SPVC_RESOURCE_TYPE_PUSH_CONSTANT);
  if (blocks.empty()) return 0;
  std::size_t size = 0;
  const spvc_type type = spvc_compiler_get_type_handle(compiler, blocks.front().base_type_id);
  must(spvc_compiler_get_declared_struct_size(compiler, type, &size), code);
  return static_cast<std::uint32_t>(size);
}

std::uint32_t value_of(spvc_compiler compiler, spvc_constant_id id) {
  return spvc_constant_get_scalar_u32(spvc_compiler_get_constant_handle(compiler, id), 0, 0);
}

// Work-group sizes that are specialization constants, by axis; constant_id is meaningless where id is 0.
std::array<spvc_specialization_constant, 3> group_size_constants(spvc_compiler compiler) {
  std::array<spvc_specialization_constant, 3> axes = {};
  spvc_compiler_get_work_group_size_specialization_constants(compiler, &axes[0], &axes[1], &axes[2]);
  return axes;
}

// A constant that serves as work-group size is declared twice under one id, once by glslang without a name and with the
// value 1. The shader's own declaration counts, so that both get one value.
void declare(std::vector<DeclaredConstant>& declared, DeclaredConstant constant) {
  const auto same = std::ranges::find(declared, constant.id, &DeclaredConstant::id);
  if (same == declared.end()) {
    declared.push_back(std::move(constant));
  } else if (same->name.empty()) {
    *same = std::move(constant);
  }
}

std::vector<DeclaredConstant> declared_constants(spvc_compiler compiler, const KernelCode& code) {
  const spvc_specialization_constant* list = nullptr;
  std::size_t count = 0;
  must(spvc_compiler_get_specialization_constants(compiler, &list, &count), code);
  std::vector<DeclaredConstant> declared;
  for (const auto& constant : std::span(list, count)) {
    declare(declared,
            {spvc_compiler_get_name(compiler, constant.id), constant.constant_id, value_of(compiler, constant.id)});
  }
  const auto axes = group_size_constants(compiler);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (axes[i].id == 0) continue;
    const std::string name = fmt::format("local_size_{}", "xyz"[i]);
    declare(declared, {name, axes[i].constant_id, value_of(compiler, axes[i].id)});
  }
  std::ranges::sort(declared, {}, &DeclaredConstant::id);
  return declared;
}

void set_values(std::vector<DeclaredConstant>& declared, const std::vector<SpecConstant>& wanted,
                const KernelCode& code) {
  for (const SpecConstant& constant : wanted) {
    const auto place = std::ranges::find(declared, constant.name, &DeclaredConstant::name);
    if (place == declared.end()) {
      fail_check(__FILE__, __LINE__, "specialization constant is declared in the kernel", constant.name, code.name);
    }
    place->value = constant.value;
  }
}

std::array<std::uint32_t, 3> group_size(spvc_compiler compiler, const std::vector<DeclaredConstant>& declared) {
  std::array<std::uint32_t, 3> size = {1, 1, 1};
  const auto axes = group_size_constants(compiler);
  for (std::uint32_t i = 0; i < axes.size(); ++i) {
    if (axes[i].id == 0) {
      size[i] = spvc_compiler_get_execution_mode_argument_by_index(compiler, SpvExecutionModeLocalSize, i);
    } else {
      size[i] = std::ranges::find(declared, axes[i].constant_id, &DeclaredConstant::id)->value;
    }
  }
  return size;
}

}  // namespace

KernelLayout reflect_kernel(const KernelCode& code, const std::vector<SpecConstant>& constants) {
  spvc_context raw = nullptr;
  must(spvc_context_create(&raw), code);
  const Context context(raw, spvc_context_destroy);
  spvc_compiler compiler = parse(context, code);
  spvc_resources resources = nullptr;
  must(spvc_compiler_create_shader_resources(compiler, &resources), code);

  KernelLayout layout{.buffers = list_buffers(compiler, resources, code),
                      .push_constant_size = push_constant_size(compiler, resources, code),
                      .constants = declared_constants(compiler, code)};
  layout.buffer_count = static_cast<std::uint32_t>(layout.buffers.size());
  set_values(layout.constants, constants, code);
  layout.group_size = group_size(compiler, layout.constants);
  return layout;
}

}  // namespace quorum
