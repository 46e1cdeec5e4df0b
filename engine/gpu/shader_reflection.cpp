// SPDX-License-Identifier: Apache-2.0
#include "gpu/shader_reflection.h"

#include <fmt/format.h>
#include <spirv_cross/spirv_cross.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <unordered_set>

#include "base/error.h"
#include "gpu/shader_cost.h"
#include "gpu/spirv_instructions.h"

namespace luxo::gpu {
namespace {

using spirv_cross::SPIRType;

constexpr std::string_view kLooseBlock = "gl_DefaultUniformBlock";

std::string scalarOf(const SPIRType& type) {
  switch (type.basetype) {
    case SPIRType::Boolean:
      return "bool";
    case SPIRType::Int:
      return "int";
    case SPIRType::UInt:
      return "uint";
    case SPIRType::Float:
      return "float";
    case SPIRType::Double:
      return "double";
    case SPIRType::Int64:
      return "int64_t";
    case SPIRType::UInt64:
      return "uint64_t";
    default:
      return "unknown";
  }
}

/// "vec" of float, "ivec" of int.
std::string prefixOf(const std::string& scalar) {
  return scalar == "float" ? "" : scalar == "uint" ? "u" : scalar.substr(0, 1);
}

/// Of a matrix that of its columns.
std::string vectorName(const SPIRType& type) {
  const std::string scalar = scalarOf(type);
  return type.vecsize > 1 ? fmt::format("{}vec{}", prefixOf(scalar), type.vecsize) : scalar;
}

/// Sizes, the outermost first.
std::vector<std::uint32_t> arrayOf(const spirv_cross::Compiler& compiler, const SPIRType& type) {
  std::vector<std::uint32_t> sizes;
  // The innermost comes first there.
  for (std::size_t i = type.array.size(); i-- > 0;)
    sizes.push_back(type.array_size_literal[i] ? type.array[i]
                                               : compiler.get_constant(type.array[i]).scalar());
  return sizes;
}

std::string imageOf(const SPIRType& type) {
  constexpr std::string_view kDimensions[] = {"1D", "2D", "3D", "Cube", "2DRect", "Buffer", "SubpassData"};
  const auto dimension = static_cast<std::size_t>(type.image.dim);
  return fmt::format("{}{}{}{}{}",
                     type.basetype == SPIRType::SampledImage ? "sampler"
                     : type.image.sampled == 2               ? "image"
                                                             : "texture",
                     dimension < std::size(kDimensions) ? kDimensions[dimension] : "",
                     type.image.ms ? "MS" : "", type.image.arrayed ? "Array" : "",
                     type.image.depth ? "Shadow" : "");
}

/// Of a capability that plain GLSL has no need of; empty: it has.
std::string beyondPlainGlsl(spv::Capability capability) {
  constexpr spv::Capability kPlain[] = {
      spv::CapabilityMatrix,           spv::CapabilityShader,           spv::CapabilityFloat64,
      spv::CapabilitySampledRect,      spv::CapabilitySampled1D,        spv::CapabilityImage1D,
      spv::CapabilitySampledCubeArray, spv::CapabilitySampledBuffer,    spv::CapabilityImageBuffer,
      spv::CapabilityImageQuery,       spv::CapabilityDerivativeControl};
  constexpr std::pair<spv::Capability, std::string_view> kNames[] = {
      {spv::CapabilityRayQueryKHR, "ray queries"},
      {spv::CapabilityRayTracingKHR, "ray tracing"},
      {spv::CapabilityGroupNonUniform, "subgroups"},
      {spv::CapabilityPhysicalStorageBufferAddresses, "addresses of buffers"},
      {spv::CapabilityInt64, "64-bit integers"},
      {spv::CapabilityInt16, "16-bit integers"},
      {spv::CapabilityFloat16, "16-bit floats"},
      {spv::CapabilityInt8, "8-bit integers"},
      {spv::CapabilitySampleRateShading, "samples one by one"},
      {spv::CapabilityInterpolationFunction, "interpolation at other places"},
      {spv::CapabilityGeometry, "geometry programs"},
      {spv::CapabilityInputAttachment, "input attachments"}};
  if (std::ranges::find(kPlain, capability) != std::end(kPlain)) return {};
  const auto* const known =
      std::ranges::find(kNames, capability, &std::pair<spv::Capability, std::string_view>::first);
  return known != std::end(kNames)
             ? std::string(known->second)
             : fmt::format("the capability {} of SPIR-V", static_cast<std::uint32_t>(capability));
}

std::string beyondPlainGlsl(const Instruction& instruction) {
  const std::span<const std::uint32_t> words = instruction.words;
  if (words.size() < 2) return {};
  if (instruction.operation == spv::OpCapability)
    return beyondPlainGlsl(static_cast<spv::Capability>(words[1]));
  if (instruction.operation == spv::OpExtension) return fmt::format("the extension {}", textAt(words, 1));
  if (instruction.operation == spv::OpExtInstImport)
    return textAt(words, 2) == "GLSL.std.450" ? "" : fmt::format("the instructions {}", textAt(words, 2));
  if (instruction.operation != spv::OpExecutionMode || words.size() < 3) return {};
  constexpr spv::ExecutionMode kPlain[] = {spv::ExecutionModeOriginUpperLeft,
                                           spv::ExecutionModeDepthReplacing, spv::ExecutionModeLocalSize};
  const auto mode = static_cast<spv::ExecutionMode>(words[2]);
  if (std::ranges::find(kPlain, mode) != std::end(kPlain)) return {};
  return mode == spv::ExecutionModeEarlyFragmentTests
             ? "early_fragment_tests"
             : fmt::format("the execution mode {} of SPIR-V", words[2]);
}

class Reflection {
 public:
  explicit Reflection(std::span<const std::uint32_t> spirv)
      : spirv_(spirv), compiler_(spirv.data(), spirv.size()) {}

  ShaderInterface interface() {
    ShaderInterface all;
    all.stage = stage();
    all.layout = layout();
    const spirv_cross::ShaderResources resources = compiler_.get_shader_resources();
    active_ = compiler_.get_active_interface_variables();
    all.inputs = variables(resources.stage_inputs);
    all.outputs = variables(resources.stage_outputs);
    addBuiltIns(all);
    addBlocks(all.blocks, resources.uniform_buffers, ShaderBlock::Kind::Uniform);
    addBlocks(all.blocks, resources.storage_buffers, ShaderBlock::Kind::Storage);
    addBlocks(all.blocks, resources.push_constant_buffers, ShaderBlock::Kind::Push);
    for (const auto* some : {&resources.sampled_images, &resources.storage_images, &resources.separate_images,
                             &resources.separate_samplers})
      for (const auto& resource : *some) all.samplers.push_back(sampler(resource));
    for (const spirv_cross::SpecializationConstant& constant : compiler_.get_specialization_constants())
      all.constants.push_back(
          {.name = compiler_.get_name(constant.id),
           .type = typeName(compiler_.get_type(compiler_.get_constant(constant.id).constant_type)),
           .location = constant.constant_id});
    addNames(all);
    return all;
  }

 private:
  [[nodiscard]] ShaderStage stage() const {
    switch (compiler_.get_execution_model()) {
      case spv::ExecutionModelVertex:
        return ShaderStage::Vertex;
      case spv::ExecutionModelGLCompute:
        return ShaderStage::Compute;
      case spv::ExecutionModelFragment:
        return ShaderStage::Fragment;
      case spv::ExecutionModelGeometry:
        return ShaderStage::Geometry;
      case spv::ExecutionModelTessellationControl:
        return ShaderStage::TessellationControl;
      case spv::ExecutionModelTessellationEvaluation:
        return ShaderStage::TessellationEvaluation;
      default:
        throw Error(ErrorKind::Scene,
                    fmt::format("the shader is of the stage {}, which is not read",
                                otherStage(compiler_.get_execution_model())),
                    "vertex, tessellation, geometry, fragment and compute shaders are");
    }
  }

  static std::string otherStage(spv::ExecutionModel model) {
    constexpr std::pair<spv::ExecutionModel, const char*> kNames[] = {
        {spv::ExecutionModelKernel, "kernel, of OpenCL"},
        {spv::ExecutionModelTaskNV, "task"},
        {spv::ExecutionModelMeshNV, "mesh"},
        {spv::ExecutionModelRayGenerationKHR, "ray generation"},
        {spv::ExecutionModelIntersectionKHR, "intersection, of rays"},
        {spv::ExecutionModelAnyHitKHR, "any hit, of rays"},
        {spv::ExecutionModelClosestHitKHR, "closest hit, of rays"},
        {spv::ExecutionModelMissKHR, "miss, of rays"},
        {spv::ExecutionModelCallableKHR, "callable, of rays"}};
    for (const auto& [known, name] : kNames)
      if (known == model) return name;
    return fmt::format("{} of SPIR-V", static_cast<std::uint32_t>(model));
  }

  /// What takes primitives has several of them, in this order.
  [[nodiscard]] std::vector<std::string> layout() const {
    struct Mode {
      spv::ExecutionMode mode;
      const char* name;
      bool takesNumber = false;
    };
    constexpr Mode kModes[] = {{spv::ExecutionModeInputPoints, "points"},
                               {spv::ExecutionModeInputLines, "lines"},
                               {spv::ExecutionModeInputLinesAdjacency, "lines_adjacency"},
                               {spv::ExecutionModeTriangles, "triangles"},
                               {spv::ExecutionModeInputTrianglesAdjacency, "triangles_adjacency"},
                               {spv::ExecutionModeQuads, "quads"},
                               {spv::ExecutionModeIsolines, "isolines"},
                               {spv::ExecutionModeSpacingEqual, "equal_spacing"},
                               {spv::ExecutionModeSpacingFractionalEven, "fractional_even_spacing"},
                               {spv::ExecutionModeSpacingFractionalOdd, "fractional_odd_spacing"},
                               {spv::ExecutionModeVertexOrderCw, "cw"},
                               {spv::ExecutionModeVertexOrderCcw, "ccw"},
                               {spv::ExecutionModePointMode, "point_mode"},
                               {spv::ExecutionModeOutputPoints, "points out"},
                               {spv::ExecutionModeOutputLineStrip, "line_strip"},
                               {spv::ExecutionModeOutputTriangleStrip, "triangle_strip"},
                               {spv::ExecutionModeOutputVertices, nullptr, true},
                               {spv::ExecutionModeInvocations, "invocations", true}};
    std::vector<std::string> words;
    const spirv_cross::Bitset& modes = compiler_.get_execution_mode_bitset();
    const bool isGeometry = compiler_.get_execution_model() == spv::ExecutionModelGeometry;
    for (const Mode& mode : kModes) {
      if (!modes.get(mode.mode)) continue;
      const char* const name = mode.name ? mode.name : isGeometry ? "max_vertices" : "vertices";
      words.push_back(mode.takesNumber
                          ? fmt::format("{} = {}", name, compiler_.get_execution_mode_argument(mode.mode))
                          : std::string(name));
    }
    if (modes.get(spv::ExecutionModeLocalSize) || modes.get(spv::ExecutionModeLocalSizeId))
      for (std::uint32_t i = 0; i < 3; ++i)
        words.push_back(fmt::format("local_size_{} = {}", "xyz"[i],
                                    compiler_.get_execution_mode_argument(spv::ExecutionModeLocalSize, i)));
    return words;
  }

  [[nodiscard]] std::string typeName(const SPIRType& type) const {
    if (type.basetype == SPIRType::Struct) return compiler_.get_name(type.self);
    if (type.basetype == SPIRType::Sampler) return "sampler";
    if (type.basetype == SPIRType::Image || type.basetype == SPIRType::SampledImage) return imageOf(type);
    if (type.columns <= 1) return vectorName(type);
    const std::string prefix = prefixOf(scalarOf(type));
    return type.columns == type.vecsize ? fmt::format("{}mat{}", prefix, type.columns)
                                        : fmt::format("{}mat{}x{}", prefix, type.columns, type.vecsize);
  }

  /// Name, type and array.
  [[nodiscard]] ShaderVariable described(std::string name, const SPIRType& type) const {
    return {.name = std::move(name), .type = typeName(type), .array = arrayOf(compiler_, type)};
  }

  [[nodiscard]] std::optional<std::uint32_t> decoration(spirv_cross::ID id, spv::Decoration which) const {
    if (!compiler_.has_decoration(id, which)) return std::nullopt;
    return compiler_.get_decoration(id, which);
  }

  [[nodiscard]] std::vector<ShaderVariable> variables(
      const spirv_cross::SmallVector<spirv_cross::Resource>& resources) const {
    std::vector<ShaderVariable> all;
    for (const spirv_cross::Resource& resource : resources) {
      const SPIRType& type = compiler_.get_type(resource.type_id);
      ShaderVariable& variable = all.emplace_back(described(compiler_.get_name(resource.id), type));
      variable.location = decoration(resource.id, spv::DecorationLocation);
      variable.active = active_.contains(resource.id);
      variable.patch = compiler_.has_decoration(resource.id, spv::DecorationPatch);
      if (type.basetype == SPIRType::Struct) {
        variable.members = members(compiler_.get_type(resource.base_type_id), false, {});
        if (variable.name.empty()) variable.name = resource.name;
      }
    }
    std::ranges::stable_sort(all, {}, &ShaderVariable::location);
    return all;
  }

  void addBuiltIns(ShaderInterface& all) {
    struct BuiltIn {
      spv::BuiltIn which;
      std::string_view name, type;
      bool written;
    };
    constexpr BuiltIn kKnown[] = {
        {spv::BuiltInPosition, "gl_Position", "vec4", true},
        {spv::BuiltInPosition, "gl_Position", "vec4", false},
        {spv::BuiltInPointSize, "gl_PointSize", "float", true},
        {spv::BuiltInPointSize, "gl_PointSize", "float", false},
        {spv::BuiltInInvocationId, "gl_InvocationID", "int", false},
        {spv::BuiltInPatchVertices, "gl_PatchVerticesIn", "int", false},
        {spv::BuiltInTessCoord, "gl_TessCoord", "vec3", false},
        {spv::BuiltInTessLevelOuter, "gl_TessLevelOuter", "float[4]", true},
        {spv::BuiltInTessLevelOuter, "gl_TessLevelOuter", "float[4]", false},
        {spv::BuiltInTessLevelInner, "gl_TessLevelInner", "float[2]", true},
        {spv::BuiltInTessLevelInner, "gl_TessLevelInner", "float[2]", false},
        {spv::BuiltInPrimitiveId, "gl_PrimitiveID", "int", true},
        {spv::BuiltInLayer, "gl_Layer", "int", true},
        {spv::BuiltInViewportIndex, "gl_ViewportIndex", "int", true},
        {spv::BuiltInFragDepth, "gl_FragDepth", "float", true},
        {spv::BuiltInVertexIndex, "gl_VertexIndex", "int", false},
        {spv::BuiltInInstanceIndex, "gl_InstanceIndex", "int", false},
        {spv::BuiltInFragCoord, "gl_FragCoord", "vec4", false},
        {spv::BuiltInFrontFacing, "gl_FrontFacing", "bool", false},
        {spv::BuiltInGlobalInvocationId, "gl_GlobalInvocationID", "uvec3", false},
        {spv::BuiltInLocalInvocationId, "gl_LocalInvocationID", "uvec3", false},
        {spv::BuiltInWorkgroupId, "gl_WorkGroupID", "uvec3", false},
        {spv::BuiltInNumWorkgroups, "gl_NumWorkGroups", "uvec3", false},
        {spv::BuiltInLocalInvocationIndex, "gl_LocalInvocationIndex", "uint", false},
        {spv::BuiltInPointCoord, "gl_PointCoord", "vec2", false},
        {spv::BuiltInPrimitiveId, "gl_PrimitiveID", "int", false},
        {spv::BuiltInSampleId, "gl_SampleID", "int", false},
        {spv::BuiltInSamplePosition, "gl_SamplePosition", "vec2", false},
        {spv::BuiltInSampleMask, "gl_SampleMaskIn", "int", false},
        {spv::BuiltInSampleMask, "gl_SampleMask", "int", true},
        {spv::BuiltInHelperInvocation, "gl_HelperInvocation", "bool", false},
        {spv::BuiltInLayer, "gl_Layer", "int", false},
        {spv::BuiltInViewportIndex, "gl_ViewportIndex", "int", false},
        {spv::BuiltInClipDistance, "gl_ClipDistance", "float", false},
        {spv::BuiltInCullDistance, "gl_CullDistance", "float", false},
        {spv::BuiltInBaseVertex, "gl_BaseVertex", "int", false},
        {spv::BuiltInBaseInstance, "gl_BaseInstance", "int", false},
        {spv::BuiltInDrawIndex, "gl_DrawID", "int", false}};
    compiler_.update_active_builtins();
    for (const BuiltIn& known : kKnown)
      if (compiler_.has_active_builtin(known.which,
                                       known.written ? spv::StorageClassOutput : spv::StorageClassInput))
        (known.written ? all.outputs : all.inputs)
            .push_back({.name = std::string(known.name), .type = std::string(known.type)});
  }

  [[nodiscard]] ShaderVariable sampler(const spirv_cross::Resource& resource) const {
    ShaderVariable variable = described(resource.name, compiler_.get_type(resource.type_id));
    variable.set = decoration(resource.id, spv::DecorationDescriptorSet);
    variable.binding = decoration(resource.id, spv::DecorationBinding);
    variable.active = active_.contains(resource.id);
    return variable;
  }

  void addBlocks(std::vector<ShaderBlock>& blocks,
                 const spirv_cross::SmallVector<spirv_cross::Resource>& resources,
                 ShaderBlock::Kind kind) const {
    for (const spirv_cross::Resource& resource : resources) {
      const SPIRType& type = compiler_.get_type(resource.base_type_id);
      std::unordered_set<std::uint32_t> used;
      for (const spirv_cross::BufferRange& range : compiler_.get_active_buffer_ranges(resource.id))
        used.insert(range.index);
      ShaderBlock block{.name = resource.name,
                        .kind = kind,
                        .loose = resource.name == kLooseBlock,
                        .set = decoration(resource.id, spv::DecorationDescriptorSet).value_or(0),
                        .binding = decoration(resource.id, spv::DecorationBinding).value_or(0),
                        .size = static_cast<std::uint32_t>(compiler_.get_declared_struct_size(type)),
                        .active = active_.contains(resource.id),
                        .members = members(type, true, used)};
      blocks.push_back(std::move(block));
    }
  }

  /// `laidOut`: with offsets. `used`: which members are.
  [[nodiscard]] std::vector<ShaderVariable> members(const SPIRType& type, bool laidOut,
                                                    const std::unordered_set<std::uint32_t>& used) const {
    std::vector<ShaderVariable> all;
    for (std::uint32_t i = 0; i < type.member_types.size(); ++i) {
      const SPIRType& member = compiler_.get_type(type.member_types[i]);
      ShaderVariable& variable = all.emplace_back(described(compiler_.get_member_name(type.self, i), member));
      if (laidOut) {
        variable.offset = compiler_.type_struct_member_offset(type, i);
        variable.size = static_cast<std::uint32_t>(compiler_.get_declared_struct_member_size(type, i));
        if (!member.array.empty()) variable.arrayStride = compiler_.type_struct_member_array_stride(type, i);
        if (member.columns > 1) {
          variable.matrixStride = compiler_.type_struct_member_matrix_stride(type, i);
          variable.rowMajor = compiler_.has_member_decoration(type.self, i, spv::DecorationRowMajor);
        }
        variable.active = used.contains(i);
      }
      // What is pointed to may have a pointer to itself.
      if (member.basetype == SPIRType::Struct && !member.pointer) {
        // Which of its members are used nobody tells.
        std::unordered_set<std::uint32_t> theirs;
        if (variable.active)
          for (std::uint32_t k = 0; k < member.member_types.size(); ++k) theirs.insert(k);
        variable.members = members(member, laidOut, theirs);
      }
    }
    return all;
  }

  /// What OpName says of functions, structures and private variables.
  void addNames(ShaderInterface& all) const {
    std::map<std::uint32_t, std::string> names;
    std::set<std::string> functions, structures, globals, computed;
    std::set<std::uint32_t> privates, constants;
    std::uint32_t entry = 0, function = 0;
    forEachInstruction(spirv_, [&](const Instruction& instruction) {
      const std::span<const std::uint32_t> words = instruction.words;
      const std::uint32_t op = instruction.operation;
      const std::size_t length = words.size();
      if (all.beyond.empty()) all.beyond = beyondPlainGlsl(instruction);
      const auto nameOf = [&](std::size_t word) {
        const auto known = names.find(words[word]);
        return known == names.end() ? std::string() : known->second;
      };
      if (op == spv::OpName && length > 2) {
        names[words[1]] = textAt(words, 2);
      } else if (op == spv::OpKill || op == spv::OpTerminateInvocation ||
                 op == spv::OpDemoteToHelperInvocation) {
        all.discards = true;
      } else if (op == spv::OpLoopMerge) {
        ++all.loops;
      } else if (op == spv::OpFunctionCall && length > 3) {
        const std::string mangled = nameOf(3);
        all.calls.push_back(mangled.substr(0, mangled.find('(')));
      } else if (op == spv::OpEntryPoint && length > 2) {
        entry = words[2];
      } else if (op >= spv::OpConstantTrue && op <= spv::OpSpecConstantOp && length > 2) {
        constants.insert(words[2]);
      } else if (op == spv::OpStore && length > 2 && function == entry && privates.contains(words[1]) &&
                 !constants.contains(words[2])) {
        computed.insert(nameOf(1));
      } else if (op == spv::OpTypeStruct) {
        structures.insert(nameOf(1));
      } else if (op == spv::OpVariable && length > 3 && words[3] == spv::StorageClassPrivate) {
        globals.insert(nameOf(2));
        privates.insert(words[2]);
      } else if (op == spv::OpFunction && length > 2) {
        function = words[2];
        const std::string mangled = nameOf(2);
        functions.insert(mangled.substr(0, mangled.find('(')));
      }
    });
    const auto put = [](std::set<std::string>& from, std::vector<std::string>& to) {
      from.erase("");
      to.assign(from.begin(), from.end());
    };
    put(functions, all.functions);
    put(structures, all.structures);
    put(globals, all.globals);
    put(computed, all.computedGlobals);
  }

  std::span<const std::uint32_t> spirv_;
  spirv_cross::Compiler compiler_;
  std::unordered_set<spirv_cross::VariableID> active_;
};

/// What `read` says of them.
auto ofSpirv(std::span<const std::uint32_t> spirv, const auto& read) {
  constexpr std::uint32_t kMagic = 0x07230203;
  if (spirv.size() <= 5 || spirv.front() != kMagic)
    throw Error(ErrorKind::Scene, "these words are no SPIR-V");
  try {
    return read(spirv);
  } catch (const spirv_cross::CompilerError& error) {
    throw Error(ErrorKind::Scene, fmt::format("this SPIR-V cannot be read: {}", error.what()));
  }
}

}  // namespace

std::uint32_t ShaderVariable::elements() const {
  std::uint32_t product = 1;
  for (const std::uint32_t count : array) product *= count;
  return product;
}

std::string boolOf(const std::string& type) {
  return type == "uint" ? "bool" : fmt::format("b{}", type.substr(1));
}

ShaderInterface reflect(std::span<const std::uint32_t> spirv) {
  // What is called is looked at once for each way there, and forty functions have 2^40 of them. Measured:
  // 720,000 instructions take 20 ms at most.
  constexpr std::uint64_t kMaxShaderInstructions = 1 << 20;
  if (const std::uint64_t instructions = costOf(spirv).instructions; instructions > kMaxShaderInstructions)
    throw Error(
        ErrorKind::Scene,
        fmt::format("with a copy of each function at each of its calls the shader has {} instructions; "
                    "at most {} are read",
                    instructions, kMaxShaderInstructions),
        "call functions in a loop instead of one by one");
  return ofSpirv(spirv, [](std::span<const std::uint32_t> words) { return Reflection(words).interface(); });
}

StageInterface stageInterface(std::span<const std::uint32_t> spirv) {
  return ofSpirv(spirv, [](std::span<const std::uint32_t> words) {
    const spirv_cross::Compiler compiler(words.data(), words.size());
    const spirv_cross::ShaderResources resources = compiler.get_shader_resources();
    StageInterface stage;
    for (const spirv_cross::Resource& input : resources.stage_inputs) {
      const SPIRType& type = compiler.get_type(input.type_id);
      const std::uint32_t first = compiler.get_decoration(input.id, spv::DecorationLocation);
      std::uint32_t locations = type.columns;
      for (const std::uint32_t size : arrayOf(compiler, type)) locations *= size;
      for (std::uint32_t i = 0; i < locations; ++i)
        stage.inputs.push_back({first + i, vectorName(type), compiler.get_name(input.id)});
    }
    std::ranges::sort(stage.inputs, {}, &StageInput::location);
    for (const spirv_cross::Resource& block : resources.push_constant_buffers)
      stage.pushConstantBytes = static_cast<std::uint32_t>(
          compiler.get_declared_struct_size(compiler.get_type(block.base_type_id)));
    return stage;
  });
}

}  // namespace luxo::gpu
