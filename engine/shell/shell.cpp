// SPDX-License-Identifier: Apache-2.0
#include "shell/shell.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "base/assert.h"
#include "shell/shell_frame.h"
#include "shell/shell_occluder.h"
#include "shell/shell_refinement.h"
#include "surface/formula_rounding.h"
#include "tessellate/block_plan.h"
#include "tessellate/mesh_cache.h"
#include "tessellate/parallel.h"

namespace luxo {
namespace {

/// Bounds hold in real numbers; and what could not be looked at, but is within a bound b of its triangle, may
/// reach over the edge by x and stand sqrt(b^2 - x^2) high there, where the neighbour's plane has come down
/// to b (1 - x / L) at least, L being its height: at most b^3 / 2 L^2 too low, which this covers for
/// triangles higher than 2.3 b.
constexpr double kSlack = 1.1;
/// What single precision rounds away, parts of the shell's size.
constexpr double kRounding = 1e-6;

/// Of the surface's size: no closer is it looked where a formula ends.
constexpr double kOpen = 1.0 / 24;

constexpr int kMaxFinerMeshes = 6;
constexpr std::size_t kMaxRefinedTriangles = 200'000;

/// The surface near a triangle turns less than the triangles around it do, times this; at an edge of the
/// patch some of them are missing. Past a border rays reach what has turned farther: the inside of horns.
constexpr double kReach = 1.25, kReachAtEdge = 2, kReachAtBorder = 3;
/// In a triangle it turns less than it was seen to, times this, with room for a search that begins there.
constexpr double kInside = 1.5;
/// A ray runs inside the slab as far as it is thick, and farther where that grows.
constexpr double kRun = 1.5;

/// Cells: as far as most rays' roots are from where they enter the shell. Measured at 1280x720: with 0.3 of
/// Klein's bottle 169 pixels go to rays, with this or more 3; larger ones make more triangles grazing.
constexpr double kUsualWay = 0.6;

/// Triangles so many times as far from an edge that is a point as they are long do not notice it.
constexpr double kNearPole = 2;

double angleOf(double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); }

/// How high rays have to rise over a triangle, radians, to meet its surface from above only: where the
/// surface turns by `inside` in the triangle, by `around` all around it, and rays that rise at `slope` run
/// from the one to the other.
double leastRise(double inside, double around, double slope) {
  double low = std::min(inside, around), high = around;
  for (int halving = 0; halving < 20; ++halving) {
    const double rise = 0.5 * (low + high);
    (rise < inside + around * std::min(1.0, slope / std::tan(rise)) ? low : high) = rise;
  }
  return high;
}

/// Turns a frame into a shell.
class Builder {
 public:
  Builder(const Surface& surface, std::span<const double> parameters, const CurvatureMap& map,
          const ShellFrame& frame, const ShellDesc& desc)
      : surface_(surface),
        parameters_(parameters),
        map_(map),
        frame_(frame),
        desc_(desc),
        mesh_(frame.mesh()) {}

  void build(Shell& shell) {
    shell.bound = mesh_.bound;
    shell.origin = mesh_.origin;
    shell.proven = std::isfinite(mesh_.bound) && mesh_.dropped == 0;
    moveVertices(shell);
    setCells(shell);
    setChanges(shell);
    shell.medianRadius = medianRadius();
    shell.parameterReach = parameterReach(shell);
    shell.formulaRounding = roundingOf(shell);
    findCones(shell);
    addParts(shell);
    shell.occluder = occluderOf(shell, frame_, distances_, sources_);
  }

 private:
  /// Of each point: the largest of the triangles and walls around it, and a little. So along an edge both
  /// planes are as far away as either triangle asks for, and what belongs to one and reaches over the edge a
  /// little is below the other, too; what reaches farther is part of the other's height.
  [[nodiscard]] std::vector<Distances> distances() const {
    const ShellHeights& heights = frame_.heights();
    std::vector<Distances> distances(frame_.pointCount());
    const auto raise = [&](double& largest, double height, double margin) {
      const double least = std::isfinite(height) ? height : desc_.tolerance;
      largest = std::max(largest, kSlack * least + kRounding * frame_.size() + margin);
    };
    for (std::size_t t = 0; t < mesh_.triangleCount(); ++t) {
      const double margin = marginAlong(frame_.facet(t));
      for (const std::uint32_t v : frame_.corners(t)) {
        Distances& d = distances[frame_.pointOf(v)];
        raise(d.out, heights.above[t], margin);
        raise(d.in, heights.below[t], margin);
      }
    }
    for (std::size_t w = 0; w < frame_.walls().size(); ++w)
      for (const std::uint32_t v : {frame_.walls()[w].from, frame_.walls()[w].to}) {
        const std::size_t point = frame_.pointOf(v);
        for (const Vec3& normal : frame_.wallsAround(point)) {
          raise(distances[point].beyond, heights.beyond[w], marginAlong(normal));
          raise(distances[point].within, heights.within[w], marginAlong(normal));
        }
      }
    return distances;
  }

  /// How far the ellipsoid of the margin reaches in that direction; in any, of triangles without one.
  [[nodiscard]] double marginAlong(const Vec3& normal) const {
    const Vec3& axes = desc_.margin;
    const double parts = normal == Vec3(0) ? std::max({axes.x, axes.y, axes.z}) : glm::length(axes * normal);
    return parts * desc_.tolerance;
  }

  void moveVertices(Shell& shell) {
    distances_ = distances();
    struct Moves {
      Vec3 out{0}, in{0};
      bool leadOut = false;
    };
    std::vector<Moves> moves(frame_.pointCount());
    forEachIndex(moves.size(), moves.size() >= kPointsForAllCores, [&](std::size_t p) {
      const std::span<const Vec3> facets = frame_.facetsAround(p), walls = frame_.wallsAround(p);
      const Distances& d = distances_[p];
      const Move out = shortestMove(facets, walls, 1, {d.out, d.beyond});
      const Move in = walls.empty() ? Move{out.way * (-d.in / d.out), out.leadsOut}
                                    : shortestMove(facets, walls, -1, {d.in, d.beyond});
      moves[p] = {out.way, in.way, out.leadsOut && in.leadsOut};
    });
    const std::size_t count = mesh_.positions.size();
    shell.positions.resize(2 * count);
    shell.parameters.resize(2 * count);
    shell.patches.resize(2 * count);
    for (std::uint32_t v = 0; v < count; ++v) {
      const Moves& m = moves[frame_.pointOf(v)];
      shell.positions[v] = mesh_.positions[v] + m.out;
      shell.positions[count + v] = mesh_.positions[v] + m.in;
      shell.parameters[v] = shell.parameters[count + v] = mesh_.parameters[v];
      shell.patches[v] = shell.patches[count + v] = frame_.patchOf(v);
      shell.offset = std::max({shell.offset, glm::length(m.out), glm::length(m.in)});
      shell.proven = shell.proven && m.leadOut;
    }
    if (!std::isfinite(mesh_.bound) || mesh_.dropped > 0) return;  // no box holds what that leaves out
    if (!shell.proven) addPinches(shell, [&](std::uint32_t v) { return !moves[frame_.pointOf(v)].leadOut; });
    addUnfollowed(shell);
  }

  /// Around a pinched vertex triangles leave out some of what they stand for, and their prisms, which may be
  /// turned over, take away from what those of others hold: of their neighbours', measured at 180,000 points
  /// beside pinches.
  template <class Predicate>
  void addPinches(Shell& shell, const Predicate& pinched) const {
    std::vector<char> beside(frame_.pointCount());
    for (std::size_t t = 0; t < mesh_.triangleCount(); ++t)
      if (std::ranges::any_of(frame_.corners(t), pinched))
        for (const std::uint32_t v : frame_.corners(t)) beside[frame_.pointOf(v)] = 1;
    for (std::size_t t = 0; t < mesh_.triangleCount(); ++t)
      if (std::ranges::any_of(frame_.corners(t), [&](std::uint32_t v) { return beside[frame_.pointOf(v)]; }))
        shell.pinches.push_back(around(shell, t));
  }

  /// Rays look for what may stick out of slabs that it is over.
  void addUnfollowed(Shell& shell) const {
    for (const std::size_t t : frame_.heights().unfollowed) {
      shell.pinches.push_back(around(shell, t));
      shell.proven = false;
    }
  }

  /// Holds what a triangle stands for, from which it is no farther than by the deviation, and its prism,
  /// which devices may draw beside its place.
  [[nodiscard]] Box around(const Shell& shell, std::size_t t) const {
    const std::size_t count = mesh_.positions.size();
    Box triangle, prism;
    for (const std::uint32_t v : frame_.corners(t)) {
      triangle.add(mesh_.positions[v]);
      prism.add(shell.positions[v]);
      prism.add(shell.positions[count + v]);
    }
    const Vec3 moved(marginAlong(Vec3(0))), reach = Vec3(frame_.bound(t)) + moved;
    Box box{triangle.min - reach, triangle.max + reach};
    box.add(Box{prism.min - moved, prism.max + moved});
    return box;
  }

  /// The normal turns along an edge by the edge's length over the radius.
  [[nodiscard]] double medianRadius() const {
    std::vector<std::pair<double, double>> bends;  // curvature, area
    double whole = 0;
    for (std::size_t t = 0; t < mesh_.triangleCount(); ++t) {
      const auto corners = frame_.corners(t);
      const auto at = [&](std::size_t k) { return mesh_.positions[corners[k % 3]]; };
      double curvature = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double length = glm::distance(at(k), at(k + 1));
        const double turn = glm::distance(mesh_.normals[corners[k]], mesh_.normals[corners[(k + 1) % 3]]);
        if (length > 0) curvature = std::max(curvature, turn / length);
      }
      const double area = 0.5 * glm::length(glm::cross(at(1) - at(0), at(2) - at(0)));
      bends.emplace_back(curvature, area);
      whole += area;
    }
    std::ranges::sort(bends, std::greater());
    double sharper = 0;
    for (const auto& [curvature, area] : bends)
      if ((sharper += area) >= 0.5 * whole) return 1 / curvature;
    return std::numeric_limits<double>::infinity();
  }

  /// By u and v, of a triangle of the mesh; not finite where it has no extent in these.
  [[nodiscard]] std::array<Vec3, 2> tangentsOf(std::size_t t) const {
    const auto corners = frame_.corners(t);
    const auto from0 = [&](const auto& of, std::size_t k) { return of[corners[k]] - of[corners[0]]; };
    const Vec2 a = from0(mesh_.parameters, 1), b = from0(mesh_.parameters, 2);
    const Vec3 alongA = from0(mesh_.positions, 1), alongB = from0(mesh_.positions, 2);
    const double area = a.x * b.y - a.y * b.x;
    return {(b.y * alongA - a.y * alongB) / area, (a.x * alongB - b.x * alongA) / area};
  }

  [[nodiscard]] double parameterReach(const Shell& shell) const {
    double most = 0;
    for (std::size_t t = 0; t < mesh_.triangleCount(); ++t) {
      const auto corners = frame_.corners(t);
      const ShellPatch& patch = shell.patchData[frame_.patchOf(corners[0])];
      if (patch.equation) continue;
      const auto [su, sv] = tangentsOf(t);
      for (const std::uint32_t v : corners) {
        const Vec2 at = glm::abs(mesh_.parameters[v] - Vec2(patch.originOfU, 0));
        const double reach = at.x * glm::length(su) + at.y * glm::length(sv);
        if (std::isfinite(reach)) most = std::max(most, reach);
      }
    }
    return most;
  }

  [[nodiscard]] double roundingOf(const Shell& shell) const {
    double most = 0;
    for (std::uint32_t patch = 0; patch < shell.patchData.size(); ++patch)
      if (!shell.patchData[patch].equation)
        most = std::max(most, formulaRounding(surface_, patch, parameters_));
    return most;
  }

  void setCells(Shell& shell) const {
    const std::size_t count = mesh_.positions.size();
    shell.cells.resize(2 * count, Vec2(0));
    for (std::size_t t = 0; t < mesh_.triangleCount(); ++t) {
      const auto uv = [&](std::size_t k) { return mesh_.parameters[mesh_.indices[3 * t + k]]; };
      const Vec2 low = glm::min(glm::min(uv(0), uv(1)), uv(2)),
                 high = glm::max(glm::max(uv(0), uv(1)), uv(2));
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = mesh_.indices[3 * t + k];
        shell.cells[v] = shell.cells[count + v] = glm::max(shell.cells[v], high - low);
      }
    }
  }

  /// Where the patch wraps, what is beyond its edge is all that is at the other one.
  void setChanges(Shell& shell) const {
    const std::size_t count = mesh_.positions.size();
    shell.changes.resize(2 * count);
    for (std::size_t v = 0; v < count; ++v) {
      const ShellPatch& patch = shell.patchData[shell.patches[v]];
      const Vec2 size(patch.domain.u.width(), patch.domain.v.width());
      const Vec2 at = (shell.parameters[v] - Vec2(patch.domain.u.lo, patch.domain.v.lo)) / size;
      const Vec2 cell = shell.cells[v] / size;
      Vec2 low = at - kSearchedCells * cell, high = at + kSearchedCells * cell;
      for (int axis = 0; axis < 2; ++axis)
        if ((axis == 0 ? patch.wrapsU : patch.wrapsV) && (low[axis] < 0 || high[axis] > 1)) {
          low[axis] = 0;
          high[axis] = 1;
        }
      shell.changes[v] = shell.changes[count + v] =
          curvatureAround(map_, shell.patches[v], low, high).change(cell.x, cell.y);
    }
  }

  /// The directions are those of the surface and the triangles around these vertices with room to spare, as
  /// far as rays run inside the slab, and of all rays that run farther there than the triangles are high.
  /// `inside`: the largest angle between the axis and the normals of what is in the triangle, if known.
  [[nodiscard]] NormalCone coneOf(const Shell& shell, const Vec3& axis,
                                  std::span<const std::uint32_t> vertices, double height,
                                  double inside) const {
    double least = 1, thickness = 0;
    bool atEdge = false;
    for (const std::uint32_t v : vertices) {
      if (nearPole(shell, v)) return {};
      const std::size_t point = frame_.pointOf(v);
      least = std::min(least, glm::dot(axis, mesh_.normals[v]));
      for (const Vec3& facet : frame_.facetsAround(point)) least = std::min(least, glm::dot(axis, facet));
      thickness = std::max(
          thickness, kRun * glm::distance(shell.positions[v], shell.positions[mesh_.positions.size() + v]));
      atEdge = atEdge || !frame_.wallsAround(point).empty();
    }
    const bool bordered = shell.patchData[frame_.patchOf(vertices[0])].bordered;
    const double reach = !atEdge ? kReach : bordered ? kReachAtBorder : kReachAtEdge;
    const double around = std::min(reach * angleOf(least), 0.5 * std::numbers::pi);
    const double rise = leastRise(kInside * inside, around, thickness / height);
    if (axis == Vec3(0) || rise >= 0.5 * std::numbers::pi) return {};
    return {.axis = Vec3f(axis),
            .sine = static_cast<float>(std::max(std::sin(rise), thickness / std::hypot(thickness, height)))};
  }

  /// Of the angle to the surface from which on rays meet it so steeply that a root is certified to be the
  /// first without a walk (`certified` of shaders/lib/exact_root.glsl): |J|^2 K^2 r^2 <= 1.8 det^2, where det
  /// is that of the tangents of a cell times the sine. More than 1: from no angle.
  [[nodiscard]] float sineToCertify(const Shell& shell, std::size_t t) const {
    const std::uint32_t corner = frame_.corners(t)[0];
    const auto [su, sv] = tangentsOf(t);
    const Vec3 ju = shell.cells[corner].x * su, jv = shell.cells[corner].y * sv;
    const double size = std::sqrt(glm::dot(ju, ju) + glm::dot(jv, jv)),
                 change = shell.changes[corner] * kUsualWay;
    return static_cast<float>(change * size / (std::sqrt(1.8) * glm::length(glm::cross(ju, jv))));
  }

  /// The largest angle between a triangle's normal and the surface's in it; infinite where unknown.
  [[nodiscard]] double turnInside(std::size_t t) const {
    if (!frame_.smooth(t)) return std::numeric_limits<double>::infinity();
    double least = frame_.heights().alike[t];
    for (const std::uint32_t v : frame_.corners(t))
      least = std::min(least, glm::dot(mesh_.normals[v], frame_.facet(t)));
    return angleOf(least);
  }

  /// Of the triangles of the mesh.
  [[nodiscard]] std::vector<double> heights() const {
    std::vector<double> heights(mesh_.triangleCount());
    for (std::size_t t = 0; t < heights.size(); ++t) {
      const auto at = [&](std::size_t k) { return mesh_.positions[frame_.corners(t)[k]]; };
      const Vec3 a = at(1) - at(0), b = at(2) - at(1), c = at(0) - at(2);
      const double longest = std::sqrt(std::max({glm::dot(a, a), glm::dot(b, b), glm::dot(c, c)}));
      heights[t] = longest > 0 ? glm::length(glm::cross(a, b)) / longest : 0;
    }
    return heights;
  }

  void findCones(const Shell& shell) {
    const std::vector<double> height = heights();
    std::vector<double> lowest(frame_.pointCount(), std::numeric_limits<double>::infinity());
    std::vector<float> certain(frame_.pointCount(), 0);
    for (std::size_t t = 0; t < height.size(); ++t) {
      const auto corners = frame_.corners(t);
      cones_.push_back(coneOf(shell, frame_.facet(t), corners, height[t], turnInside(t)));
      cones_.back().certain = sineToCertify(shell, t);
      for (const std::uint32_t v : corners) {
        const std::size_t point = frame_.pointOf(v);
        lowest[point] = std::min(lowest[point], height[t]);
        certain[point] = std::max(certain[point], cones_.back().certain);
      }
    }
    for (const ShellFrame::WallEdge& wall : frame_.walls()) {
      const std::array ends{wall.from, wall.to};
      Vec3 sum(0);
      for (const std::uint32_t v : ends)
        for (const Vec3& facet : frame_.facetsAround(frame_.pointOf(v))) sum += facet;
      const double length = glm::length(sum);
      wallCones_.push_back(
          coneOf(shell, length > 0 ? sum / length : Vec3(0), ends,
                 std::min(lowest[frame_.pointOf(wall.from)], lowest[frame_.pointOf(wall.to)]),
                 std::numeric_limits<double>::infinity()));
      wallCones_.back().certain =
          std::max(certain[frame_.pointOf(wall.from)], certain[frame_.pointOf(wall.to)]);
    }
  }

  [[nodiscard]] bool nearPole(const Shell& shell, std::uint32_t vertex) const {
    const ShellPatch& patch = shell.patchData[frame_.patchOf(vertex)];
    const Vec2 at = mesh_.parameters[vertex], near = kNearPole * shell.cells[vertex];
    return (patch.collapsedUMin && at.x - patch.domain.u.lo < near.x) ||
           (patch.collapsedUMax && patch.domain.u.hi - at.x < near.x) ||
           (patch.collapsedVMin && at.y - patch.domain.v.lo < near.y) ||
           (patch.collapsedVMax && patch.domain.v.hi - at.y < near.y);
  }

  void addParts(Shell& shell) {
    std::vector<bool> done(surface_.patchCount());
    for (std::uint32_t patch = 0; patch < surface_.patchCount(); ++patch) {
      if (done[patch]) continue;
      std::vector<bool> inPart(surface_.patchCount());
      for (std::uint32_t other = patch; other < surface_.patchCount(); ++other)
        if (surface_.patches()[other].function == surface_.patches()[patch].function)
          inPart[other] = done[other] = true;
      addPart(shell, patch, inPart);
    }
  }

  void addPart(Shell& shell, std::uint32_t patch, const std::vector<bool>& inPart) {
    const auto count = static_cast<std::uint32_t>(mesh_.positions.size());
    std::vector<std::uint32_t>& indices = shell.indices;
    const auto size = [&] { return static_cast<std::uint32_t>(indices.size()); };
    const auto forEachTriangle = [&](const auto& action) {
      for (std::size_t t = 0; t < mesh_.triangleCount(); ++t)
        if (const auto corners = frame_.corners(t); inPart[frame_.patchOf(corners[0])]) action(t, corners);
    };
    Shell::Part part{.patch = patch, .firstIndex = size()};
    forEachTriangle([&](std::size_t t, const auto& c) {
      indices.insert(indices.end(), {c[0], c[1], c[2]});
      shell.cones.push_back(cones_[t]);
      sources_.push_back(t);
    });
    for (std::size_t w = 0; w < frame_.walls().size(); ++w) {
      const ShellFrame::WallEdge& wall = frame_.walls()[w];
      if (!inPart[frame_.patchOf(wall.from)]) continue;
      const std::uint32_t a = wall.from, b = wall.to;
      indices.insert(indices.end(), {b, a, count + a, b, count + a, count + b});
      shell.cones.insert(shell.cones.end(), 2, wallCones_[w]);
      sources_.insert(sources_.end(), 2, w);
    }
    part.frontCount = size() - part.firstIndex;
    forEachTriangle([&](std::size_t t, const auto& c) {
      indices.insert(indices.end(), {count + c[0], count + c[2], count + c[1]});
      shell.cones.push_back(cones_[t]);
      sources_.push_back(t);
    });
    part.count = size() - part.firstIndex;
    if (part.count > 0) shell.parts.push_back(part);
  }

  const Surface& surface_;
  std::span<const double> parameters_;
  const CurvatureMap& map_;
  const ShellFrame& frame_;
  const ShellDesc& desc_;
  const Mesh& mesh_;
  std::vector<NormalCone> cones_, wallCones_;
  std::vector<Distances> distances_;  // of points
  std::vector<std::size_t> sources_;  // of the shell's triangles: triangles of the mesh, or walls
};

}  // namespace

std::optional<Shell> makeShell(const Surface& surface, std::span<const double> parameters,
                               const CurvatureMap& map, const ShellDesc& wanted) {
  LUXO_REQUIRE_COMPARE(wanted.tolerance, >, 0.0);
  const std::vector<std::optional<Equation>> equations = equationsOf(surface, parameters);
  ShellDesc desc = wanted;
  const Box box = surface.framing(parameters);
  const double size = box.empty() ? 0 : glm::length(box.extent());
  if (std::ranges::all_of(equations, &std::optional<Equation>::has_value))
    desc.tolerance = std::min(kEquationTolerance * desc.tolerance,
                              2 * std::max(desc.tolerance, toleranceLevel(kCoarseEquation * size)));
  std::vector<Block> blocks =
      planBlocks(surface, parameters, map, {.tolerance = desc.tolerance}, kOpen * size);
  if (std::ranges::any_of(blocks, &Block::open)) return std::nullopt;
  std::ranges::stable_sort(blocks, {}, &Block::patch);
  // A top and a bottom of two triangles a cell.
  const auto tooMany = [&] {
    double triangles = 0;
    for (const Block& block : blocks) triangles += 4.0 * block.segments.u * block.segments.v;
    return triangles > desc.mostTriangles;
  };
  const auto isInterrupted = [&] { return desc.interrupted && desc.interrupted(); };
  if (tooMany() || isInterrupted()) return std::nullopt;

  Shell shell;
  for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
    shell.patchData.push_back(readPatch(surface, patch, parameters, size));
    shell.patchData.back().originOfU = surface.patches()[patch].originOfU();
    shell.patchData.back().equation = equations[patch];
  }

  ShellLook look(surface, parameters, shell.patchData);
  auto frame = std::make_unique<ShellFrame>(surface, parameters, map, blocks, shell.patchData, look);
  for (int k = 0; k < kMaxFinerMeshes && frame->mesh().triangleCount() < kMaxRefinedTriangles; ++k) {
    if (!refineForShell(surface, parameters, desc, *frame, blocks)) break;
    if (tooMany() || isInterrupted()) return std::nullopt;
    frame = std::make_unique<ShellFrame>(surface, parameters, map, blocks, shell.patchData, look);
  }
  if (isInterrupted()) return std::nullopt;
  Builder(surface, parameters, map, *frame, desc).build(shell);
  return shell;
}

}  // namespace luxo
