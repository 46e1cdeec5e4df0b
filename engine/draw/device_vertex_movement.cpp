// SPDX-License-Identifier: Apache-2.0
#include "draw/device_vertex_movement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <list>
#include <span>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "draw/material_errors.h"
#include "draw/material_program.h"
#include "draw/paint.h"
#include "gpu/barrier.h"
#include "gpu/buffer.h"
#include "gpu/descriptor.h"
#include "gpu/frame.h"
#include "gpu/pipeline.h"
#include "gpu/shader_compiler.h"
#include "luxo/shaders/sources.h"
#include "math/transform.h"
#include "shared/loop_rounds.h"
#include "shared/scene_data.h"
#include "shared/vertex_movement.h"

namespace luxo {
namespace {

constexpr std::string_view kMovement = "lib/vertex_movement.glsl";

/// Of those used last: a window that reads a shader again, and again, forgets what that was.
constexpr std::size_t kKeptPrograms = 16;

/// Vertices of the first dispatch, in which what does not end is found out, and of others: as many as take a
/// device less than the second after which systems end what it does, at the loops' bound of instructions.
constexpr std::uint32_t kFirstVertices = 1024, kMaxVertices = 65536;

/// Two ways to round a vertex: 2^-24 of each of the four terms of a product, twice.
constexpr double kAtRest = 0x1p-21;

Mat4 magnitudes(Mat4 m) {
  for (int i = 0; i < 4; ++i) m[i] = glm::abs(m[i]);
  return m;
}

/// A view that has no plane or axis in common with its object, which it sees from `size` away.
std::array<Mat4, 2> someView(double size) {
  const Mat3 turn = rotation(Vec3(0.36, -0.48, 0.8), 0.9);
  Mat4 modelView(turn);
  modelView[3] = Vec4(0.31 * size, -0.17 * size, -3 * size, 1);
  Mat4 projection(0);
  projection[0][0] = 1.3;
  projection[1][1] = 1.7;
  projection[2] = Vec4(0, 0, -1.2, -1);
  projection[3] = Vec4(0, 0, -1.1 * size, 0);
  return {modelView, projection};
}

shared::MovementState stateOf(const Mat4& modelView, const Mat4& projection, double other,
                              const Material& material) {
  return {.modelView = Mat4f(modelView),
          .projection = Mat4f(projection),
          .modelViewInverse = Mat4f(glm::inverse(modelView)),
          .projectionInverse = Mat4f(glm::inverse(projection)),
          .ambient = Vec3f(material.ambientOrDiffuse()),
          .diffuse = Vec3f(material.diffuse),
          .specular = Vec3f(material.specular),
          .shininess = static_cast<float>(material.shininess),
          .other = static_cast<float>(other)};
}

double largest(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

bool stays(const Vec4f& position, const Vec3f& rest) {
  if (!(position.w > 0)) return false;
  const double off = largest(Vec3(position) / double(position.w) - Vec3(rest));
  return off <= kAtRest * largest(Vec3(rest));
}

/// Whether a view shows a place where it is: `shown` is gl_Position there.
class SameInView {
 public:
  SameInView(const Mat4& modelView, const Mat4& projection)
      : clipFromObject_(projection * modelView),
        magnitudes_(magnitudes(projection) * magnitudes(modelView)) {}

  [[nodiscard]] bool operator()(const Vec4f& place, const Vec4f& shown, double size) const {
    // As shaders/lib/course_point.glsl has it; and a program may go by sums as large as the mesh.
    const Vec4 own = clipFromObject_ * Vec4(place), q(shown);
    const Vec4 reach(glm::abs(Vec3(place)) + size * std::abs(double(place.w)), std::abs(double(place.w)));
    const Vec4 rounding = 0x1p-17 * (magnitudes_ * reach);
    const Vec3 off = glm::abs(Vec3(q) * own.w - Vec3(own) * q.w);
    const Vec3 allowed = Vec3(rounding) * std::abs(q.w) + rounding.w * glm::abs(Vec3(q));
    return off.x <= allowed.x && off.y <= allowed.y && off.z <= allowed.z && q.w * own.w > 0;
  }

 private:
  Mat4 clipFromObject_, magnitudes_;
};

/// A tangent of triangles that have moved is none of theirs at rest.
void refuseTangents(const MaterialShader& shader, const gpu::ShaderInterface& interface) {
  for (const gpu::ShaderVariable& input : interface.inputs) {
    if (!input.active || input.name == "uv" || input.name.starts_with("gl_")) continue;
    for (const MaterialShader::File& file : std::span(shader.files).subspan(shader.vertex))
      if (const auto place = placeOf(input.name, file.text))
        throw Error(ErrorKind::Scene,
                    describe(file.name, file.text,
                             {*place,
                              fmt::format("'{}' is of the surface as it is shown, and the program moves it",
                                          input.name),
                              "compute it from gl_Vertex, as the movement is"}));
  }
}

std::vector<shared::VertexAtRest> packed(const VerticesAtRest& vertices) {
  std::vector<shared::VertexAtRest> all;
  all.reserve(vertices.positions.size());
  for (std::size_t i = 0; i < vertices.positions.size(); ++i)
    all.push_back({vertices.positions[i], vertices.normals[i], vertices.uvs[i]});
  return all;
}

}  // namespace

class DeviceVertexMovement::Mover {
 public:
  explicit Mover(gpu::Context& context)
      : context_(context),
        layout_(context, std::vector<gpu::DescriptorBinding>(shared::kMovementBindings,
                                                             {.stages = VK_SHADER_STAGE_COMPUTE_BIT})),
        frames_(context) {}

  std::vector<Vec4f> run(const VerticesAtRest& vertices, const Material& material) {
    const Program& program = programOf(Paint::of(material));
    program.text.check(material);
    double size = 0;
    for (const Vec3f& position : vertices.positions) size = std::max(size, largest(Vec3(position)));
    if (!(size > 0)) size = 1;
    const auto [modelView, projection] = someView(size);
    upload(vertices, material,
           {stateOf(Mat4(1), Mat4(1), 0, material), stateOf(modelView, projection, 0.7, material)});
    const auto count = static_cast<std::uint32_t>(vertices.positions.size());
    for (std::uint32_t first = 0; first < count;) {
      const std::uint32_t some = std::min(count - first, first == 0 ? kFirstVertices : kMaxVertices);
      submit(program, {first, some, count});
      std::uint32_t endless = 0;
      std::memcpy(&endless, readFaults_.read().data(), sizeof endless);
      if (endless > 0)
        refuseMovement(*material.shader,
                       fmt::format("there are vertices for which the loops of the program go round more than "
                                   "{} times",
                                   shared::kLuxoMaxRounds),
                       "end them sooner: a loop that never ends would hang the device");
      first += some;
    }
    std::vector<Vec4f> positions(std::size_t{2} * count);
    std::memcpy(positions.data(), read_.read().data(), positions.size() * sizeof(Vec4f));
    requireSameForAllViews(positions, {modelView, projection}, size, *material.shader);
    positions.resize(count);
    for (std::size_t i = 0; i < count; ++i)
      if (!stays(positions[i], vertices.positions[i])) {
        refuseTangents(*material.shader, program.text.interface());
        return positions;
      }
    return {};
  }

 private:
  struct Program {
    Paint paint;
    MaterialProgram text;
    gpu::ComputePipeline pipeline = {};
  };

  const Program& programOf(const Paint& paint) {
    const auto known = std::ranges::find(programs_, paint, &Program::paint);
    if (known != programs_.end()) {
      programs_.splice(programs_.begin(), programs_, known);
      return programs_.front();
    }
    Program program{.paint = paint, .text = MaterialProgram(paint.shader())};
    const MaterialProgram::Joined joined = program.text.movement(paint);
    std::vector<gpu::ShaderSource> sources(std::begin(kShaderSources), std::end(kShaderSources));
    const auto own = joined.sources();
    sources.insert(sources.end(), own.begin(), own.end());
    const gpu::ShaderCompiler::Result compiled = gpu::ShaderCompiler().compile(
        {.source = *std::ranges::find(kShaderSources, kMovement, &gpu::ShaderSource::name),
         .stage = gpu::ShaderStage::Compute,
         .includes = sources,
         .asShown = asProgramsSpell});
    program.pipeline = gpu::ComputePipeline(
        context_, {.name = "vertex movement", .shader = compiled.spirv, .setLayouts = {layout_}});
    programs_.push_front(std::move(program));
    if (programs_.size() > kKeptPrograms) programs_.pop_back();
    return programs_.front();
  }

  void upload(const VerticesAtRest& vertices, const Material& material,
              const std::array<shared::MovementState, shared::kMovementStates>& states) {
    const auto buffer = [this](VkDeviceSize size, std::string_view name) {
      return gpu::Buffer(context_,
                         {.size = size,
                          .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                          .name = name});
    };
    const auto readback = [this](VkDeviceSize size, std::string_view name) {
      return gpu::Buffer(context_, {.size = size,
                                    .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                    .memory = gpu::MemoryUse::Readback,
                                    .name = name});
    };
    std::vector<float> numbers(shared::kShaderNumbers);
    appendUniforms(material, numbers);
    const std::vector<shared::VertexAtRest> all = packed(vertices);
    const VkDeviceSize moved = shared::kMovementStates * all.size() * sizeof(Vec4f);
    buffers_ = {buffer(all.size() * sizeof(shared::VertexAtRest), "vertices at rest"),
                buffer(numbers.size() * sizeof(float), "numbers of a vertex program"),
                buffer(sizeof states, "states of a vertex program"), buffer(moved, "moved vertices"),
                buffer(sizeof(std::uint32_t), "faults of a vertex program")};
    read_ = readback(moved, "moved vertices, read");
    readFaults_ = readback(sizeof(std::uint32_t), "faults of a vertex program, read");
    buffers_[shared::kBindingMovedVertices].write(0, std::as_bytes(std::span(all)));
    buffers_[shared::kBindingMovementNumbers].write(0, std::as_bytes(std::span(numbers)));
    buffers_[shared::kBindingMovementStates].write(0, std::as_bytes(std::span(states)));
    constexpr std::uint32_t kNone = 0;
    buffers_[shared::kBindingMovementFaults].write(0, std::as_bytes(std::span(&kNone, 1)));
  }

  void submit(const Program& program, const shared::MovementRange& range) {
    gpu::Buffer &moved = buffers_[shared::kBindingMovedPositions],
                &faults = buffers_[shared::kBindingMovementFaults];
    const VkCommandBuffer commands = frames_.begin();
    gpu::use(commands, {{moved, gpu::Use::ComputeStorage}, {faults, gpu::Use::ComputeStorage}});
    program.pipeline.bind(commands);
    program.pipeline.push(commands, std::as_bytes(std::span(&range, 1)));
    program.pipeline.bindSet(commands, shared::kSetMovement,
                             frames_.descriptors().write(
                                 layout_, {buffers_[0], buffers_[1], buffers_[2], buffers_[3], buffers_[4]}));
    vkCmdDispatch(commands, (range.count + shared::kMovementInvocations - 1) / shared::kMovementInvocations,
                  shared::kMovementStates, 1);
    gpu::use(commands, {{moved, gpu::Use::TransferSource},
                        {faults, gpu::Use::TransferSource},
                        {read_, gpu::Use::TransferDestination},
                        {readFaults_, gpu::Use::TransferDestination}});
    const VkBufferCopy ofFaults{.size = readFaults_.size()}, ofAll{.size = read_.size()};
    vkCmdCopyBuffer(commands, faults, readFaults_, 1, &ofFaults);
    if (range.first + range.count == range.vertices) vkCmdCopyBuffer(commands, moved, read_, 1, &ofAll);
    gpu::use(commands, {{read_, gpu::Use::HostRead}, {readFaults_, gpu::Use::HostRead}});
    frames_.wait(frames_.submit());
  }

  static void requireSameForAllViews(std::span<const Vec4f> positions, const std::array<Mat4, 2>& view,
                                     double size, const MaterialShader& shader) {
    const SameInView same(view[0], view[1]);
    const std::size_t count = positions.size() / 2;
    for (std::size_t i = 0; i < count; ++i) {
      // What is no place, whatever the view, is told by whoever asked for it.
      const auto isPlace = [](const Vec4f& p) {
        return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) && p.w > 0 &&
               std::isfinite(p.w);
      };
      if (!isPlace(positions[i]) || same(positions[i], positions[count + i], size)) continue;
      refuseMovement(
          shader,
          "where the program moves vertices is not the same for all views: it depends on matrices "
          "otherwise than by gl_ModelViewProjectionMatrix, or on lights, textures or tangents; and a "
          "mesh is moved once, for its shadows as for the eye",
          "give gl_Position = gl_ModelViewProjectionMatrix * vec4(place, 1.0) of a place that is "
          "computed from gl_Vertex, gl_Normal, gl_MultiTexCoord0 and uniforms");
    }
  }

  gpu::Context& context_;
  gpu::DescriptorLayout layout_;
  std::list<Program> programs_;  ///< the last used first
  std::array<gpu::Buffer, shared::kMovementBindings> buffers_;
  gpu::Buffer read_, readFaults_;
  gpu::FrameRing frames_;
};

DeviceVertexMovement::DeviceVertexMovement(gpu::ContextDesc desc) : context_(std::move(desc)) {}
DeviceVertexMovement::DeviceVertexMovement(gpu::Context& context) : context_(context) {}
DeviceVertexMovement::~DeviceVertexMovement() = default;

std::vector<Vec4f> DeviceVertexMovement::run(const VerticesAtRest& vertices, const Material& material) {
  if (!mover_) mover_ = std::make_unique<Mover>(context_.get());
  return mover_->run(vertices, material);
}

}  // namespace luxo
