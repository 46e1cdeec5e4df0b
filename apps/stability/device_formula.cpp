// SPDX-License-Identifier: Apache-2.0
#include "stability/device_formula.h"

#include <cstring>
#include <filesystem>

#include "base/assert.h"
#include "formula/glsl.h"
#include "gpu/shader_compiler.h"
#include "gpu/whole_target.h"
#include "luxo/shaders/sources.h"

namespace luxo {
namespace {

constexpr VkFormat kFormat = VK_FORMAT_R32G32B32A32_SFLOAT;

constexpr std::string_view kVertex = R"(#version 460
void main() { gl_Position = vec4(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0, 0.0, 1.0); }
)";

constexpr std::string_view kFragment = R"(#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/formula.glsl"
layout(scalar, set = 0, binding = 0) readonly buffer Points { vec2 points[]; };
layout(scalar, set = 0, binding = 1) readonly buffer Inputs { float inputs[]; };
layout(location = 0) out vec4 first;
layout(location = 1) out vec4 second;
layout(location = 2) out vec4 third;
float parameterAt(uint k) { return inputs[k]; }
#include "formula"
void main() {
  vec2 p = points[uint(gl_FragCoord.y) * 1024 + uint(gl_FragCoord.x)];
  formula(p.x, p.y, first, second, third);
}
)";

gpu::Buffer bufferOf(gpu::Context& context, std::span<const std::byte> bytes) {
  gpu::Buffer buffer(context, {.size = bytes.size(), .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT});
  buffer.write(0, bytes);
  return buffer;
}

std::string glslOf(Graph& graph, const std::vector<Expr>& outputs, std::size_t most) {
  LUXO_REQUIRE(outputs.size() <= most);
  std::vector<Expr> padded = outputs;
  padded.resize(most);
  const std::span all(padded);
  const GlslOutput targets[] = {
      {"first", all.subspan(0, 4)}, {"second", all.subspan(4, 4)}, {"third", all.subspan(8, 4)}};
  return emitGlsl(graph, "formula", targets);
}

}  // namespace

DeviceFormula::DeviceFormula(gpu::Context& context, Graph& graph, const std::vector<Expr>& outputs)
    : DeviceFormula(context, glslOf(graph, outputs, 4 * kTargets), outputs.size()) {}

DeviceFormula::DeviceFormula(gpu::Context& context, const std::string& glsl, std::size_t outputs)
    : context_(&context), outputs_(outputs), layout_(context, {{}, {}}) {
  LUXO_REQUIRE(outputs <= 4 * kTargets);
  std::vector<gpu::ShaderSource> sources(std::begin(kShaderSources), std::end(kShaderSources));
  sources.push_back({"formula", glsl});
  const gpu::ShaderCompiler compiler((std::filesystem::path()));
  const auto vertex =
      compiler.compile({.source = {"points.vert", kVertex}, .stage = gpu::ShaderStage::Vertex});
  const auto fragment = compiler.compile({.source = {"formula.frag", kFragment}, .includes = sources});
  pipeline_ = gpu::GraphicsPipeline(context, {.name = "formula",
                                              .vertexShader = vertex.spirv,
                                              .fragmentShader = fragment.spirv,
                                              .colors = {{kFormat}, {kFormat}, {kFormat}},
                                              .setLayouts = {layout_}});
}

std::vector<std::vector<float>> DeviceFormula::at(const std::vector<Vec2f>& points,
                                                  std::span<const double> inputs) {
  const VkExtent2D extent{kWidth, static_cast<std::uint32_t>((points.size() + kWidth - 1) / kWidth)};
  std::vector<Vec2f> padded = points;
  padded.resize(std::size_t{extent.width} * extent.height);
  std::vector<float> values(inputs.begin(), inputs.end());
  values.push_back(0);  // a buffer is never empty
  const gpu::Buffer pointBuffer = bufferOf(*context_, std::as_bytes(std::span(padded)));
  const gpu::Buffer inputBuffer = bufferOf(*context_, std::as_bytes(std::span(values)));

  std::vector<gpu::Readback> readbacks = gpu::drawWholeTargets(
      *context_, pipeline_, extent, kFormat, kTargets, [&](gpu::FrameRing& frames, VkCommandBuffer commands) {
        pipeline_.bindSet(commands, 0, frames.descriptors().write(layout_, {pointBuffer, inputBuffer}));
      });

  std::vector<std::vector<float>> results(outputs_, std::vector<float>(points.size()));
  for (std::size_t k = 0; k < outputs_; ++k) {
    const auto bytes = readbacks[k / 4].bytes();
    for (std::size_t i = 0; i < points.size(); ++i)
      std::memcpy(&results[k][i], bytes.data() + (4 * i + k % 4) * sizeof(float), sizeof(float));
  }
  return results;
}

}  // namespace luxo
