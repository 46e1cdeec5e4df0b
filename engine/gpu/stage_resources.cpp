// SPDX-License-Identifier: Apache-2.0
#include "gpu/stage_resources.h"

#include "base/assert.h"
#include "gpu/spirv_instructions.h"

#include <fmt/format.h>
#include <spirv_cross/spirv.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <unordered_map>
#include <utility>

namespace luxo::gpu {
namespace {

/// Names, decorations, types, variables and functions follow each other in this order.
class ResourceReader {
 public:
  explicit ResourceReader(std::span<const std::uint32_t> spirv) {
    forEachInstruction(spirv, [this](const Instruction& i) { read(i.operation, i.words); });
    for (const auto& [id, variable] : variables_)
      if (variable.used) resources_.descriptors.push_back(descriptor(id, variable));
    std::ranges::sort(resources_.outputs);
  }

  StageResources take() { return std::move(resources_); }

 private:
  using Words = std::span<const std::uint32_t>;

  struct Variable {
    std::uint32_t pointer = 0;  ///< its type
    std::uint32_t storage = 0;
    bool used = false;
  };
  struct Place {
    std::uint32_t set = 0, binding = 0;
  };

  void read(std::uint32_t operation, Words words) {
    switch (operation) {
      case spv::OpName:
        names_[at(words, 1)] = textAt(words, 2);
        break;
      case spv::OpDecorate:
        decorate(at(words, 1), at(words, 2), at(words, 3));
        break;
      case spv::OpTypePointer:
      case spv::OpTypeArray:
      case spv::OpTypeRuntimeArray:
      case spv::OpTypeStruct:
      case spv::OpTypeImage:
      case spv::OpTypeSampledImage:
      case spv::OpTypeSampler:
        declared_[at(words, 1)] = words;
        break;
      case spv::OpConstant:
      case spv::OpSpecConstant:
        declared_[at(words, 2)] = words;
        break;
      case spv::OpVariable:
        declare(at(words, 2), {.pointer = at(words, 1), .storage = at(words, 3)});
        break;
      default:
        use(operation, words);
    }
  }

  void decorate(std::uint32_t id, std::uint32_t decoration, std::uint32_t value) {
    if (decoration == spv::DecorationDescriptorSet) places_[id].set = value;
    if (decoration == spv::DecorationBinding) places_[id].binding = value;
    if (decoration == spv::DecorationLocation) locations_[id] = value;
    if (decoration == spv::DecorationSpecId) resources_.constants.push_back({value, std::string(nameOf(id))});
  }

  void declare(std::uint32_t id, const Variable& variable) {
    if (variable.storage == spv::StorageClassPushConstant) resources_.pushConstants = true;
    if (const auto first = locations_.find(id);
        variable.storage == spv::StorageClassOutput && first != locations_.end())
      for (std::uint32_t i = 0; i < typeOf(variable).second; ++i)
        resources_.outputs.push_back(first->second + i);
    if (variable.storage == spv::StorageClassUniformConstant ||
        variable.storage == spv::StorageClassUniform || variable.storage == spv::StorageClassStorageBuffer)
      variables_.emplace(id, variable);
  }

  /// All ways to use such a variable begin with one of these.
  void use(std::uint32_t operation, Words words) {
    switch (operation) {
      case spv::OpLoad:
      case spv::OpAccessChain:
      case spv::OpInBoundsAccessChain:
      case spv::OpArrayLength:
      case spv::OpImageTexelPointer:
      case spv::OpCopyObject:
        markUsed(at(words, 3));
        break;
      case spv::OpStore:
        markUsed(at(words, 1));
        break;
      case spv::OpCopyMemory:
        markUsed(at(words, 1));
        markUsed(at(words, 2));
        break;
      case spv::OpFunctionCall:
        for (std::size_t i = 4; i < words.size(); ++i) markUsed(words[i]);
        break;
      default:
        break;
    }
  }

  void markUsed(std::uint32_t id) {
    if (const auto variable = variables_.find(id); variable != variables_.end()) variable->second.used = true;
  }

  [[nodiscard]] StageDescriptor descriptor(std::uint32_t id, const Variable& variable) const {
    StageDescriptor descriptor{.name = std::string(nameOf(id))};
    if (const auto place = places_.find(id); place != places_.end()) {
      descriptor.set = place->second.set;
      descriptor.binding = place->second.binding;
    }
    const auto [type, count] = typeOf(variable);
    descriptor.count = count;
    descriptor.type = kindOf(type, variable.storage);
    if (descriptor.name.empty()) descriptor.name = nameOf(at(type, 1));
    return descriptor;
  }

  /// That of its elements, and how many there are; 0: it does not say.
  [[nodiscard]] std::pair<Words, std::uint32_t> typeOf(const Variable& variable) const {
    std::uint32_t count = 1;
    Words type = declared(at(declared(variable.pointer), 3));
    for (; operationOf(type) == spv::OpTypeArray || operationOf(type) == spv::OpTypeRuntimeArray;
         type = declared(at(type, 2)))
      count *= operationOf(type) == spv::OpTypeArray ? at(declared(at(type, 3)), 3) : 0;
    return {type, count};
  }

  [[nodiscard]] VkDescriptorType kindOf(Words type, std::uint32_t storage) const {
    switch (operationOf(type)) {
      case spv::OpTypeStruct:
        return storage == spv::StorageClassUniform ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER
                                                   : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
      case spv::OpTypeSampler:
        return VK_DESCRIPTOR_TYPE_SAMPLER;
      case spv::OpTypeSampledImage:
        return VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
      case spv::OpTypeImage: {
        const bool texels = at(type, 3) == spv::DimBuffer;  // samplerBuffer and textureBuffer are the same
        if (at(type, 7) == 1)                               // it is sampled
          return texels ? VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER : VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
        return at(type, 3) == spv::DimSubpassData ? VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT
               : texels                           ? VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER
                                                  : VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
      }
      default:
        return VK_DESCRIPTOR_TYPE_MAX_ENUM;
    }
  }

  static std::uint32_t at(Words words, std::size_t i) { return i < words.size() ? words[i] : 0; }
  static std::uint32_t operationOf(Words words) { return at(words, 0) & 0xffff; }

  [[nodiscard]] Words declared(std::uint32_t id) const {
    const auto found = declared_.find(id);
    return found == declared_.end() ? Words() : found->second;
  }

  [[nodiscard]] std::string_view nameOf(std::uint32_t id) const {
    const auto found = names_.find(id);
    return found == names_.end() ? std::string_view() : found->second;
  }

  std::unordered_map<std::uint32_t, std::string_view> names_;
  std::unordered_map<std::uint32_t, Place> places_;
  std::unordered_map<std::uint32_t, std::uint32_t> locations_;
  std::unordered_map<std::uint32_t, Words> declared_;  ///< types, and constants that are numbers
  std::map<std::uint32_t, Variable> variables_;
  StageResources resources_;
};

std::string_view nameOfKind(VkDescriptorType type) {
  switch (type) {
    case VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER:
    case VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC:
      return "uniform buffer";
    case VK_DESCRIPTOR_TYPE_STORAGE_BUFFER:
    case VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC:
      return "storage buffer";
    case VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER:
      return "combined image sampler";
    case VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER:
      return "uniform texel buffer";
    case VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER:
      return "storage texel buffer";
    case VK_DESCRIPTOR_TYPE_STORAGE_IMAGE:
      return "storage image";
    case VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE:
      return "sampled image";
    case VK_DESCRIPTOR_TYPE_SAMPLER:
      return "sampler";
    case VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT:
      return "input attachment";
    default:
      return "a kind that no pipeline has yet";
  }
}

/// "the fragment shader of "shade"".
std::string nameOfStage(const GivenResources& given) {
  return fmt::format("the {} shader of \"{}\"",
                     given.stage == VK_SHADER_STAGE_VERTEX_BIT     ? "vertex"
                     : given.stage == VK_SHADER_STAGE_FRAGMENT_BIT ? "fragment"
                                                                   : "compute",
                     given.pipeline);
}

void requireDescriptor(const GivenResources& resources, const StageDescriptor& descriptor) {
  const DescriptorBinding* binding = nullptr;
  if (descriptor.set < resources.sets.size() && descriptor.binding < resources.sets[descriptor.set].size())
    binding = &resources.sets[descriptor.set][descriptor.binding];
  const std::string_view kind = binding ? nameOfKind(binding->type) : "nothing";
  const bool hidden = binding && (binding->stages & resources.stage) == 0;
  // A binding is one descriptor (gpu/descriptor.h).
  if (kind == nameOfKind(descriptor.type) && !hidden && descriptor.count <= 1) return;
  const std::string where =
      fmt::format("set {}, binding {} in {}", descriptor.set, descriptor.binding, nameOfStage(resources));
  const std::string given = fmt::format("{}: {}{}", where, kind, hidden ? " of other stages" : "");
  const std::string asked =
      fmt::format("{}: {}{} {}", where, nameOfKind(descriptor.type),
                  descriptor.count > 1 ? fmt::format("[{}]", descriptor.count) : "", descriptor.name);
  LUXO_REQUIRE_COMPARE(given, ==, asked);
}

void requireConstant(const GivenResources& resources, const StageConstant& constant) {
  if (std::ranges::find(resources.constants, constant.id, &SpecializationConstant::id) !=
      resources.constants.end())
    return;
  const std::string where = fmt::format("constant {} in {}", constant.id, nameOfStage(resources));
  const std::string given = fmt::format("{}: nothing", where);
  const std::string asked = fmt::format("{}: a value {}", where, constant.name);
  LUXO_REQUIRE_COMPARE(given, ==, asked);
}

void requireOutput(const GivenResources& resources, const StageResources& asked, std::uint32_t location) {
  if (std::ranges::binary_search(asked.outputs, location)) return;
  const std::string where = fmt::format("attachment {} of {}", location, nameOfStage(resources));
  const std::string given = fmt::format("{}: nothing", where);
  const std::string wanted = fmt::format("{}: an output", where);
  LUXO_REQUIRE_COMPARE(given, ==, wanted);
}

}  // namespace

StageResources stageResources(std::span<const std::uint32_t> spirv) { return ResourceReader(spirv).take(); }

void requireAllGiven(const GivenResources& given, const StageResources& asked) {
  for (const StageDescriptor& descriptor : asked.descriptors) requireDescriptor(given, descriptor);
  for (const StageConstant& constant : asked.constants) requireConstant(given, constant);
  for (std::uint32_t i = 0; i < given.written; ++i) requireOutput(given, asked, i);
}

}  // namespace luxo::gpu
