// SPDX-License-Identifier: Apache-2.0
#include "draw/exact_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>
#include <utility>

#include "base/assert.h"
#include "draw/exact_shaders.h"
#include "draw/pixel_rows.h"
#include "gpu/device.h"
#include "reference/verification.h"

namespace luxo {
namespace {

// What a shell proves of a search holds as far as a certified root is from its start.
static_assert(shared::kFarCells + 1 <= kSearchedCells);
static_assert(4 * shared::kVaryings <= gpu::kVaryingComponents);

/// As much as float may round away of a point's place, pixels. The residual accepted is as large, and where
/// the point is lies up to two thirds as much beside where the residual says: points are right to 1e-3. Half
/// of these or more is the formula's own: what that loses, as is measured, and the rest have to fit, too. (Of
/// the teapot at 1024 x 1024 the sum is 9.5e-4, and the worst point 3.6e-4 off; of Klein's bottle 2.3e-4.)
constexpr double kMaxRoundingPx = 6e-4, kPlacePart = 1.0 / 3;
static_assert(static_cast<float>(kMaxRoundingPx + kExactTolerancePx) <= shared::kMaxTolerancePx);
/// As much as what float rounds away may turn the normal, radians, a few times over: colours are then right
/// to a few millionths, 110 dB. Of what is at most that large, pixels, nobody counts them.
constexpr double kMaxTurn = 4e-5, kSmallPx = 100;
/// Nearer than this to an outline a pixel may show either side of it.
constexpr double kOutlinePx = 0.01;

/// What is rounded away of a number, a few times over. Those that a search in double reads have 48 bits.
constexpr double kTimesRounded = 3;
/// That is as measured at the default field of view, 40 degrees of 16 : 9: hypot(1, tan 20 * (1, 16 / 9)).
constexpr double kUsualSlant = 1.245;
constexpr double roundingOf(GlslNumber number) {
  return kTimesRounded * (number == GlslNumber::Float ? 0x1p-24 : 0x1p-48);
}

/// What float leaves of a number.
Vec4f restOf(const Vec4& v) { return Vec4f(v - Vec4(Vec4f(v))); }

/// A point of the world where the object has it, else the object's origin.
Vec3 inObject(const Vec3& point, const Transform& worldFromObject) {
  const Vec3 object = glm::inverse(worldFromObject.linear) * (point - worldFromObject.translation);
  const Vec3f rounded(object);
  return std::isfinite(rounded.x + rounded.y + rounded.z) ? object : Vec3(0);
}

/// How far the node's points are from its origin, in metres of the world, axis by axis: what is long along
/// one axis and stretched along another is no larger for it.
double reach(const SnapshotNode& node) {
  Vec3 along;
  for (int i = 0; i < 3; ++i)
    along[i] = glm::length(node.worldFromObject.linear[i]) *
               std::max(std::abs(node.boundsObject.min[i]), std::abs(node.boundsObject.max[i]));
  return glm::length(along);
}

/// How many times as long as their depth the rays at the corners of the picture are, at least the usual.
double slantOf(const View& view) {
  return view.perspective() ? std::max(std::hypot(1.0, glm::length(view.halfExtent)) / kUsualSlant, 1.0) : 1;
}

/// Pixels that rounding moves a point by: `everywhere`, and `near` over its depth.
struct Rounding {
  double everywhere, near;
};

/// Of what has the size of the distance, and of the object; and how far the next u and v that there are may
/// be from a root: a search that cannot come within its tolerance of one must not take it for a miss.
///
/// At the corner of a picture whose rays are `aslant` times as long as their depth an error moves a point by
/// that many times more pixels, and what has the size of the distance is that many times larger. Of parallel
/// rays there is no distance with room to spare for both what rounding a point and what rounding its place in
/// the picture leaves.
Rounding roundingPx(const View& view, const SnapshotNode& node, const Shell& shell, GlslNumber number) {
  const double aslant = slantOf(view);
  const double rounding = roundingOf(number) * view.pixelsPerUnit * aslant;
  const double nextParameters =
      rounding / kTimesRounded * shell.parameterReach * largestStretch(node.worldFromObject.linear);
  if (view.perspective()) return {rounding * aslant, rounding * reach(node) + nextParameters};
  return {rounding * (glm::length(view.halfExtent) + 2 * reach(node)) + nextParameters, 0};
}

/// The formula's own operations may move a point farther than by what has the object's size, and no residual
/// tells, as it is computed by the same operations. As far on the screen, at most; perspective: over depth.
double formulaPx(const View& view, const SnapshotNode& node, const Shell& shell) {
  const double longest = view.perspective() ? std::hypot(1.0, glm::length(view.halfExtent)) : 1;
  return shell.formulaRounding * largestStretch(node.worldFromObject.linear) * view.pixelsPerUnit * longest;
}

/// A ray that is 70 degrees off the normal meets what is moved along that three times as far off.
double formulaRoundingPx(const View& view, const SnapshotNode& node, const Shell& shell) {
  constexpr double kAslant = 3;
  return kAslant * formulaPx(view, node, shell);
}

Rounding singlePrecisionPx(const View& view, const SnapshotNode& node, const Shell& shell) {
  Rounding rounding = roundingPx(view, node, shell, GlslNumber::Float);
  double& most = view.perspective() ? rounding.near : rounding.everywhere;
  most = std::max(most, formulaRoundingPx(view, node, shell));
  return rounding;
}

constexpr double kNoEdge = 1e30;
/// Of a cone's numbers, what rounding leaves at the apex, where all is 0.
constexpr double kNoWaist = 1e-12;

struct Ends {
  Box edges;            ///< metres, as Equation::edgesOf()
  bool radial = false;  ///< in x: distances from the axis
};

/// Where a patch ends. A cone that is wider than high ends at distances from the axis, as what is off of a
/// height is off by more across it; of heights is left on which side of the apex it is.
Ends endsOf(const Equation& equation, const Domain& domain) {
  Ends ends{equation.edgesOf(domain), equation.isRadial()};
  const bool isSteep = std::sqrt(std::max(-equation.yy, 0.0)) * equation.scale.x < equation.scale.y;
  if (equation.form() != Equation::Form::Quadric || equation.v.along != Equation::Along::Y || isSteep ||
      !(equation.yy < 0) || equation.xx != equation.zz || equation.scale.x != equation.scale.z)
    return ends;
  const double apex = -0.5 * equation.y / equation.yy, atApex = equation.constant + 0.5 * equation.y * apex;
  if (std::abs(atApex) > kNoWaist * std::max(1.0, std::abs(equation.constant))) return ends;
  const double low = ends.edges.min.y - apex * equation.scale.y,
               high = ends.edges.max.y - apex * equation.scale.y;
  const double slack = kNoWaist * (high - low), middle = 0.5 * (low + high);
  if (std::min(std::abs(low), std::abs(high)) > slack && low * high < 0) return ends;
  const double radiusPerHeight = std::sqrt(-equation.yy / equation.xx) * equation.scale.x / equation.scale.y;
  const double least = middle > 0 ? low : -high, most = middle > 0 ? high : -low;
  ends.radial = true;
  ends.edges.min.x = radiusPerHeight * std::max(least, 0.0);
  ends.edges.max.x = radiusPerHeight * most;
  (middle > 0 ? ends.edges.max.y : ends.edges.min.y) = middle > 0 ? kNoEdge : -kNoEdge;
  (middle > 0 ? ends.edges.min.y : ends.edges.max.y) = apex * equation.scale.y;
  return ends;
}

/// Edges that are points are edges of u or of v, never of both.
std::uint32_t flagsOf(const ShellPatch& patch) {
  const bool ofU = patch.collapsedUMin || patch.collapsedUMax;
  const std::optional<Equation>& equation = patch.equation;
  return (patch.orientation < 0 ? shared::kInward : 0) | (patch.wrapsU ? shared::kWrapsU : 0) |
         (patch.wrapsV ? shared::kWrapsV : 0) | (patch.bordered ? shared::kBordered : 0) |
         (patch.collapsedUMin || (!ofU && patch.collapsedVMin) ? shared::kPoleLow : 0) |
         (patch.collapsedUMax || (!ofU && patch.collapsedVMax) ? shared::kPoleHigh : 0) |
         (ofU ? shared::kPolesOfU : 0) | (equation && equation->outward > 0 ? shared::kRisesOutward : 0) |
         (equation && endsOf(*equation, patch.domain).radial ? shared::kRadial : 0);
}

/// What shaders/lib/exact_equation.glsl reads, in metres.
void appendEquation(const Equation& equation, const Domain& domain, std::vector<double>& numbers) {
  const Vec3& scale = equation.scale;
  const Box edges = endsOf(equation, domain).edges;
  Vec3 lowest = glm::max(edges.min, Vec3(-kNoEdge)), highest = glm::min(edges.max, Vec3(kNoEdge));

  const double center = equation.center();
  lowest.y -= center * scale.y;
  highest.y -= center * scale.y;

  std::array<double, shared::kEquationNumbers> list{};
  const auto set = [&](std::uint32_t first, const Vec3& values) {
    for (std::uint32_t k = 0; k < 3; ++k) list[first + k] = values[static_cast<int>(k)];
  };
  if (equation.form() == Equation::Form::Torus) {
    list[shared::kTorusRing] = scale.x;
    list[shared::kTorusTube] = equation.tube * scale.x;
  } else {
    set(shared::kQuadricSquares, Vec3(equation.xx, equation.yy, equation.zz) / (scale * scale));
    list[shared::kQuadricHalfY] = (0.5 * equation.y + equation.yy * center) / scale.y;
    list[shared::kQuadricConstant] = equation.constant + (equation.y + equation.yy * center) * center;
    list[shared::kQuadricCenter] = center * scale.y;
  }
  set(shared::kEquationLowest, lowest);
  set(shared::kEquationHighest, highest);
  set(shared::kEquationU, {static_cast<double>(equation.u.along), equation.u.start, equation.u.rate});
  set(shared::kEquationV, {static_cast<double>(equation.v.along), equation.v.start, equation.v.rate});
  set(shared::kEquationScale, scale);
  numbers.insert(numbers.end(), list.begin(), list.end());
}
static_assert(static_cast<std::uint32_t>(Equation::Along::X) == shared::kAlongX &&
              static_cast<std::uint32_t>(Equation::Along::Y) == shared::kAlongY &&
              static_cast<std::uint32_t>(Equation::Along::Z) == shared::kAlongZ &&
              static_cast<std::uint32_t>(Equation::Along::Radius) == shared::kAlongRadius &&
              static_cast<std::uint32_t>(Equation::Along::Turn) == shared::kAlongTurn &&
              static_cast<std::uint32_t>(Equation::Along::Latitude) == shared::kAlongLatitude &&
              static_cast<std::uint32_t>(Equation::Along::Tube) == shared::kAlongTube);

SurfaceCodePtr ownCode(SurfaceCodes& codes, const Patch& patch, std::size_t parameters, GlslNumber number) {
  return codes.get(patch.function, patch.constants.size() + parameters, number);
}

SurfaceCodePtr generalCode(SurfaceCodes& codes, const Patch& patch, GlslNumber number) {
  return codes.get(patch.general, patch.constants.size() + patch.general->arguments.size(), number);
}

/// Whether a patch is searched for by its general form: its own would have to be compiled.
bool isGeneral(SurfaceCodes& codes, const Patch& patch, const SurfaceCode& own) {
  return patch.general && builtInExactShader(own).empty() &&
         !builtInExactShader(*generalCode(codes, patch, own.number)).empty();
}

/// All but firstPatch.
shared::ExactInstance instanceOf(const View& view, const Vec3& origin, const SnapshotNode& node,
                                 const VisibleNode& visible, const Shell& shell, GlslNumber number,
                                 const PixelRows& rows) {
  const Rounding rounding = roundingPx(view, node, shell, number);
  const double finest = number == GlslNumber::Double ? kDoubleTolerancePx : kExactTolerancePx;
  const double range = view.far - view.near;
  const Transform& world = node.worldFromObject;
  PixelRows ofShell = pixelRows(view, world);
  for (Vec4* row : {&ofShell.x, &ofShell.y, &ofShell.depth}) row->w += glm::dot(Vec3(*row), shell.origin);
  const Vec3 middle = number == GlslNumber::Double ? inObject(origin, world) : Vec3(0);
  return {
      .x = Vec4f(rows.x),
      .y = Vec4f(rows.y),
      .depth = Vec4f(rows.depth),
      .xLow = restOf(rows.x),
      .yLow = restOf(rows.y),
      .depthLow = restOf(rows.depth),
      .clipDepth = view.perspective() ? Vec2f(view.near, rounding.near) : Vec2f(view.near, -1 / range),
      .half_ = Vec2f(0.5 * view.size.width, 0.5 * view.size.height),
      .middle = Vec3f(middle),
      .middleLow = Vec3f(middle - Vec3(Vec3f(middle))),
      .translation = Vec3f(transformPoint(world, middle) - origin),
      .facing = visible.mirrored ? 1.0f : -1.0f,
      .tolerance = static_cast<float>(std::max(finest, rounding.everywhere)),
      .firstPatch = 0,
      .origin = Vec3f(shell.origin),
      .thickness = static_cast<float>(3 * shell.offset * visible.stretch * visible.pixelsPerUnit),
      .shellX = Vec4f(ofShell.x),
      .shellY = Vec4f(ofShell.y),
      .shellDepth = Vec4f(ofShell.depth),
      .shellXLow = restOf(ofShell.x),
      .shellYLow = restOf(ofShell.y),
      .shellDepthLow = restOf(ofShell.depth)};
}

/// No point of the surface in the shell is nearer than its vertices: mostly they are farther than those of
/// the node's box.
double nearestOf(const View& view, const SnapshotNode& node, const Shell& shell) {
  const Vec4 depth = pixelRows(view, node.worldFromObject).depth;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vec3& position : shell.positions)
    nearest = std::min(nearest, glm::dot(depth, Vec4(position, 1)));
  return std::max(nearest, view.near);
}

}  // namespace

bool needsDouble(const View& view, const SnapshotNode& node, const VisibleNode& visible, const Shell& shell) {
  const Rounding place = roundingPx(view, node, shell, GlslNumber::Float),
                 rounding = singlePrecisionPx(view, node, shell);
  const double formula = formulaPx(view, node, shell);
  const auto tooMuch = [&](double depth) {
    const double rounded = place.everywhere + place.near / depth,
                 accepted = std::max(kExactTolerancePx, place.everywhere) + place.near / depth,
                 lost = formula / (view.perspective() ? depth : 1);
    // Steps of a search whose residuals are what the formula loses end by chance.
    return rounded > kMaxRoundingPx || lost > accepted || (1 + kPlacePart) * accepted + lost > kPointPx;
  };
  if (tooMuch(visible.nearestDepth) &&
      (!view.perspective() || (tooMuch(nearestSeen(view, node)) && tooMuch(nearestOf(view, node, shell)))))
    return true;
  const auto roundingAt = [&](double depth) { return rounding.everywhere + rounding.near / depth; };
  const double depth = std::max(visible.centerDepth, view.near);
  const double scale = visible.stretch * visible.pixelsPerUnit / (view.perspective() ? depth : 1);
  return glm::length(node.boundsObject.extent()) * scale > kSmallPx &&
         roundingAt(depth) > kMaxTurn * shell.medianRadius * scale;
}

bool losesEdges(const View& view, const SnapshotNode& node, const VisibleNode& visible, const Shell& shell) {
  const Rounding rounding = singlePrecisionPx(view, node, shell);
  const double depth = view.perspective() ? std::max(visible.nearestDepth, nearestSeen(view, node)) : 1;
  return rounding.everywhere + rounding.near / depth > kOutlinePx;
}

std::vector<Vec3> inPicture(const View& view, const SnapshotNode& node, std::span<const Vec3> points) {
  const PixelRows rows = pixelRows(view, node.worldFromObject);
  const Vec2 middle(0.5 * view.size.width, 0.5 * view.size.height);
  std::vector<Vec3> seen;
  seen.reserve(points.size());
  for (const Vec3& point : points) {
    const double depth = glm::dot(rows.depth, Vec4(point, 1)), width = view.perspective() ? depth : 1;
    seen.emplace_back(middle.x + glm::dot(rows.x, Vec4(point, 1)) / width,
                      middle.y + glm::dot(rows.y, Vec4(point, 1)) / width, depth);
  }
  return seen;
}

shared::ExactInstance exactInstance(const View& view, const Vec3& origin, const SnapshotNode& node,
                                    const VisibleNode& visible, const Shell& shell, GlslNumber number) {
  return instanceOf(view, origin, node, visible, shell, number, pixelRows(view, node.worldFromObject));
}

void addFormulaRounding(const View& view, const SnapshotNode& node, const Shell& shell,
                        shared::ExactInstance& instance) {
  float& most = view.perspective() ? instance.clipDepth.y : instance.tolerance;
  most = std::max(most, static_cast<float>(formulaRoundingPx(view, node, shell)));
}

std::optional<PlaneRows> planeIn(const View& view, const SnapshotNode& node, const Shell& shell) {
  const bool isPlane =
      shell.patchData.size() == 1 && shell.patchData[0].equation && shell.patchData[0].equation->isPlane();
  return isPlane ? planeRows(view, node.worldFromObject) : std::nullopt;
}

shared::ExactInstance exactInstance(const View& view, const Vec3& origin, const SnapshotNode& node,
                                    const VisibleNode& visible, const Shell& shell, const PlaneRows& plane) {
  const Vec4 depth = pixelRows(view, node.worldFromObject).depth;
  const PixelRows rows{
      .x = Vec4(plane.x, depth.x), .y = Vec4(plane.z, depth.z), .depth = Vec4(plane.w, depth.w)};
  shared::ExactInstance instance = instanceOf(view, origin, node, visible, shell, GlslNumber::Double, rows);
  instance.thickness = static_cast<float>(1 / (visible.pixelsPerUnit * visible.stretch));
  return instance;
}

SurfaceCodePtr codeOf(SurfaceCodes& codes, const Surface& surface, const Shell& shell, std::uint32_t patch,
                      std::size_t parameters, GlslNumber number) {
  if (const auto& equation = shell.patchData[patch].equation)
    return codes.get(equation->form(), shared::kEquationNumbers, number);
  const Patch& p = surface.patches()[patch];
  const SurfaceCodePtr own = ownCode(codes, p, parameters, number);
  return isGeneral(codes, p, *own) ? generalCode(codes, p, number) : own;
}

bool isTooLarge(SurfaceCodes& codes, const Surface& surface, const Shell& shell, std::size_t parameters,
                GlslNumber number) {
  return std::ranges::any_of(shell.parts, [&](const Shell::Part& part) {
    return codeOf(codes, surface, shell, part.patch, parameters, number)->isTooLarge();
  });
}

void appendPatches(SurfaceCodes& codes, const Surface& surface, std::span<const double> parameters,
                   const Shell& shell, std::vector<shared::ExactPatch>& patches,
                   std::vector<double>& numbers) {
  for (std::uint32_t i = 0; i < surface.patchCount(); ++i) {
    const ShellPatch& patch = shell.patchData[i];
    const Domain& domain = patch.domain;
    const Vec4 corners(domain.u.lo - patch.originOfU, domain.v.lo, domain.u.hi - patch.originOfU,
                       domain.v.hi);
    patches.push_back({.domain = Vec4f(corners),
                       .domainLow = restOf(corners),
                       .flags = flagsOf(patch),
                       .firstParameter = static_cast<std::uint32_t>(numbers.size())});
    if (patch.equation) {
      appendEquation(*patch.equation, domain, numbers);
      continue;
    }
    const Patch& p = surface.patches()[i];
    if (const SurfaceCodePtr own = ownCode(codes, p, parameters.size(), GlslNumber::Float);
        isGeneral(codes, p, *own)) {
      const std::vector<double> inputs = p.general->inputs(p.constants, parameters);
      numbers.insert(numbers.end(), inputs.begin(), inputs.end());
    } else {
      const PatchInputs inputs(p, parameters);
      const std::span<const double> all = inputs;
      numbers.insert(numbers.end(), all.begin(), all.end());
    }
  }
}

bool mayHoldEye(const View& view, const SnapshotNode& node, const VisibleNode& visible, const Shell& shell) {
  const double reaches = 2 * shell.offset * visible.stretch;
  // Parallel rays begin on the near plane, which is as far away as the scene.
  if (!view.perspective()) return visible.nearestDepth <= view.near + reaches;
  // The corners of the near plane are the farthest of it.
  const double margin = reaches + 2 * view.near * std::hypot(1.0, glm::length(view.halfExtent));
  const Box& box = node.boundsWorld;
  for (int i = 0; i < 3; ++i)
    if (!(view.eye[i] >= box.min[i] - margin && view.eye[i] <= box.max[i] + margin)) return false;
  return true;
}

}  // namespace luxo
