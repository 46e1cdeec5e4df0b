// SPDX-License-Identifier: Apache-2.0
#include "draw/measured_pixels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <string>

#include "base/error.h"
#include "draw/accumulation.h"
#include "shared/loop_rounds.h"
#include "shared/scene_data.h"

namespace luxo {

float alphaAt(const std::byte* texels, int x) {
  float alpha;
  std::memcpy(&alpha, texels + sizeof(Vec4f) * x + 3 * sizeof alpha, sizeof alpha);
  return alpha;
}

void addAlphas(const std::byte* texels, int width, MeasuredPixels& measured) {
  MeasuredPixels row = measured;
  for (int x = 0; x < width; ++x) row.add(alphaAt(texels, x));
  measured = row;
}

void addMeanAlphas(const std::byte* texels, int width, MeasuredPixels& measured) {
  for (int x = 0; x < width; ++x) measured.add(Accumulator::alphaOf(alphaAt(texels, x)));
}

void addColors(const std::byte* texels, int width, MeasuredPixels& measured) {
  const auto bitsAt = [texels](int i) {
    std::uint32_t bits;
    std::memcpy(&bits, texels + sizeof bits * static_cast<std::size_t>(i), sizeof bits);
    return bits;
  };
  // From the largest float on a magnitude reaches the sign's place.
  std::uint32_t any = 0;
  for (int i = 0; i < 4 * width; ++i)
    any |= (bitsAt(i) & MeasuredPixels::kMagnitude) + (0x80000000U - MeasuredPixels::kLargest);
  if ((any & ~MeasuredPixels::kMagnitude) == 0) return;
  for (int x = 0; x < width; ++x) {
    std::uint32_t largest = 0;
    for (int c = 0; c < 3; ++c) largest = std::max(largest, bitsAt(4 * x + c) & MeasuredPixels::kMagnitude);
    measured.nonfinite += largest >= MeasuredPixels::kLargest;
    std::uint32_t infinities = 0, signs = 0;
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t bits = bitsAt(4 * x + c), magnitude = bits & MeasuredPixels::kMagnitude;
      infinities += magnitude == MeasuredPixels::kInfinity || magnitude == MeasuredPixels::kLargest;
      signs |= (bits >> 31) << c;
    }
    if (infinities < 3) continue;
    measured.faults.endless += signs == shared::kFaultEndless;
    measured.faults.seenThrough += signs == shared::kFaultSeenThrough;
    measured.faults.moved += signs == shared::kFaultMoved;
    measured.faults.manyTraces += signs == shared::kFaultManyTraces;
  }
}

void showInMagenta(std::span<float> row) {
  const auto isNumber = [](float x) { return std::abs(x) < std::numeric_limits<float>::max(); };
  for (std::size_t i = 0; i + 2 < row.size(); i += 3)
    if (!isNumber(row[i]) || !isNumber(row[i + 1]) || !isNumber(row[i + 2])) {
      row[i] = row[i + 2] = 1;
      row[i + 1] = 0;
    }
}

void refuseShaders(const Snapshot& snapshot, const shared::ShaderFaults& faults) {
  std::set<std::string> names, vertexNames;
  for (const SnapshotNode& node : snapshot.nodes)
    if (const MaterialShaderPtr& shader = snapshot.materials[node.material.index].shader) {
      names.insert(shader->files.front().name);
      if (shader->vertex > 0) vertexNames.insert(shader->files[shader->vertex].name);
    }
  if (names.empty()) return;
  const std::string all = fmt::format("{}", fmt::join(names, ", "));
  if (faults.endless > 0)
    throw Error(
        ErrorKind::Scene,
        fmt::format("{}: there are pixels in which the loops of the shader go round more than {} times, all "
                    "of a point together",
                    all, shared::kLuxoMaxRounds),
        "end them sooner: a loop that never ends would hang the device");
  if (faults.seenThrough > 0)
    throw Error(
        ErrorKind::Scene,
        fmt::format("{}: in {} pixels the shader gives an opacity below 1, and has not said that it may", all,
                    faults.seenThrough),
        "write a line '#pragma luxo opacity' into it, or return 1 as the fourth number");
  if (faults.moved > 0)
    throw Error(
        ErrorKind::Scene,
        fmt::format("{}: in {} pixels the vertex program moves the vertex: gl_Position is not that of "
                    "gl_Vertex, and a surface of a formula is where that has it, as a mesh is whose vertices "
                    "stay",
                    fmt::join(vertexNames, ", "), faults.moved),
        "write gl_Position = ftransform(), and the movement into the surface's \"position\" or the material's "
        "\"displacement\", formulas of time and parameters; or give it a mesh that is fine enough to move");
  if (faults.manyTraces > 0)
    throw Error(ErrorKind::Scene,
                fmt::format("{}: in {} pixels the shader sends more than {} rays into the scene", all,
                            faults.manyTraces, shared::kMaxTraces),
                "send fewer: end loops that follow a ray sooner");
}

}  // namespace luxo
