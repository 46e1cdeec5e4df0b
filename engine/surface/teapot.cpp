// SPDX-License-Identifier: Apache-2.0
#include "surface/teapot.h"

#include <fmt/format.h>

#include <cmath>
#include <span>
#include <tuple>
#include <utility>

#include "base/error.h"

namespace luxo {
namespace {

/// A round section of the classic data: its radius; how far its inner control points are from the axes, which
/// makes it nearly round (0.56 of the radius, but for the knob); its height.
struct Ring {
  double radius, across, y;
};

/// From the centre of the bottom up the body and over the rim: bottom, lower body, upper body, rim. Three
/// rings on, one patch ends and the next begins.
constexpr Ring kBody[] = {
    {0, 0, 0},           {1.425, 0.798, 0}, {1.5, 0.84, 0.075},       {1.5, 0.84, 0.15},
    {1.5, 0.84, 0.225},  {2, 1.12, 0.45},   {2, 1.12, 0.9},           {2, 1.12, 1.35},
    {1.75, 0.98, 1.875}, {1.5, 0.84, 2.4},  {1.4375, 0.805, 2.53125}, {1.3375, 0.749, 2.53125},
    {1.4, 0.784, 2.4},
};

/// From the lid's border up to the top of its knob.
constexpr Ring kLid[] = {
    {1.3, 0.728, 2.4}, {1.3, 0.728, 2.55}, {0.4, 0.224, 2.55}, {0.2, 0.112, 2.7},
    {0, 0, 2.85},      {0.8, 0.45, 3.15},  {0, 0, 3.15},
};

/// A section of the handle or the spout: two points of its outline in the plane z = 0, and how wide it is.
struct Rib {
  double firstX, firstY, secondX, secondY, halfWidth;
};

/// From the upper end, which is inside the body, around to the lower one.
constexpr Rib kHandle[] = {
    {-1.6, 2.025, -1.5, 2.25, 0.3}, {-2.3, 2.025, -2.5, 2.25, 0.3}, {-2.7, 2.025, -3, 2.25, 0.3},
    {-2.7, 1.8, -3, 1.8, 0.3},      {-2.7, 1.575, -3, 1.35, 0.3},   {-2.5, 1.125, -2.65, 0.9375, 0.3},
    {-2, 0.9, -1.9, 0.6, 0.3},
};

/// From the body to the tip, over the lip and down into the mouth.
constexpr Rib kSpout[] = {
    {1.7, 1.425, 1.7, 0.6, 0.66}, {2.6, 1.425, 3.1, 0.825, 0.66},     {2.3, 2.1, 2.4, 2.025, 0.25},
    {2.7, 2.4, 3.3, 2.4, 0.25},   {2.8, 2.475, 3.525, 2.49375, 0.25}, {2.9, 2.475, 3.45, 2.5125, 0.15},
    {2.8, 2.4, 3.2, 2.4, 0.15},
};

/// Every fourth of each band between rings 0 and 3, 3 and 6, ...
void appendTurned(std::span<const Ring> rings, std::vector<BezierPatch>& patches) {
  for (std::size_t first = 0; first + 3 < rings.size(); first += 3)
    for (int quarter = 0; quarter < 4; ++quarter) {
      BezierPatch& patch = patches.emplace_back();
      for (std::size_t j = 0; j < 4; ++j) {
        const auto [radius, across, y] = rings[first + j];
        const double outline[4][2] = {{radius, 0}, {radius, across}, {across, radius}, {0, radius}};
        for (std::size_t i = 0; i < 4; ++i) {
          double a = outline[i][0], b = outline[i][1];
          for (int turn = 0; turn < quarter; ++turn) std::tie(a, b) = std::pair(-b, a);
          patch[4 * j + i] = {a, y, -b};
        }
      }
    }
}

/// Both halves, +Z then -Z, of each stretch between ribs 0 and 3, 3 and 6.
void appendMirrored(std::span<const Rib> ribs, std::vector<BezierPatch>& patches) {
  for (std::size_t start = 0; start + 3 < ribs.size(); start += 3)
    for (const bool back : {false, true}) {
      BezierPatch& patch = patches.emplace_back();
      for (std::size_t j = 0; j < 4; ++j) {
        const Rib& rib = ribs[start + j];
        const double side = back ? -rib.halfWidth : rib.halfWidth;
        const Vec3 first(rib.firstX, rib.firstY, 0), second(rib.secondX, rib.secondY, 0), aside(0, 0, side);
        const Vec3 &from = back ? second : first, &to = back ? first : second;
        patch[4 * j] = from;
        patch[4 * j + 1] = from + aside;
        patch[4 * j + 2] = to + aside;
        patch[4 * j + 3] = to;
      }
    }
}

}  // namespace

std::vector<BezierPatch> teapotPatches() {
  std::vector<BezierPatch> patches;
  appendTurned(kBody, patches);
  appendTurned(kLid, patches);
  appendMirrored(kHandle, patches);
  appendMirrored(kSpout, patches);
  return patches;
}

Surface teapot(double height) {
  if (!(height > 0 && std::isfinite(height)))
    throw Error(ErrorKind::Scene, fmt::format("teapot: height is {}", height),
                "give height a positive, finite length in metres");
  std::vector<BezierPatch> patches = teapotPatches();
  for (BezierPatch& patch : patches)
    for (Vec3& p : patch) p = height * p / kTeapotHeight;
  return bezier(patches, {.name = "teapot"});
}

}  // namespace luxo
