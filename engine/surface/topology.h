// SPDX-License-Identifier: Apache-2.0
// How the patches of a surface hang together: which edges are borders, which are joined to which, which
// collapse to a point; which side is outside; what follows for the whole.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "math/vec.h"
#include "surface/patch.h"

namespace luxo {

/// What an edge of a patch is on the surface.
enum class Edge : std::uint8_t {
  Border,  ///< an open border
  Seam,    ///< the same curve as at least one other edge, of this or another patch: see Joint
  Pole,    ///< one point, with one normal
  Apex,    ///< one point without a normal of its own: it depends on the direction of approach
};

struct EdgeKind {
  Edge kind = Edge::Border;
  Vec3 normal{0};  ///< Pole: the unit limit of Su x Sv

  [[nodiscard]] bool collapsed() const { return kind == Edge::Pole || kind == Edge::Apex; }
};

struct PatchEdge {
  std::uint32_t patch = 0;
  Side side = Side::UMin;

  friend bool operator==(const PatchEdge&, const PatchEdge&) = default;
};

/// Two edges that are the same curve: the point at part s of `a` is the point at part s of `b`, or at 1 - s
/// when reversed. A curve that more than two edges share has a joint from one of them to each other one.
struct Joint {
  PatchEdge a, b;
  bool reversed = false;
  bool flipped = false;  ///< the patches' outward sides are opposite here: the surface has no two sides
  bool smooth = true;    ///< the unit normals are the same on both sides, or opposite where flipped
};

/// What follows from a surface's patches. The parameters' values at time 0 decide.
struct Topology {
  std::vector<std::array<EdgeKind, 4>> edges;  ///< of each patch, by Side
  std::vector<Joint> joints;
  /// Of each patch: +1 when its Su x Sv points outward (closed surfaces) or to the conventional outside (open
  /// ones), else -1. Patches that are joined agree on their outside wherever the surface is orientable.
  std::vector<double> orientations;
  bool closed = false;      ///< encloses a volume
  bool orientable = true;   ///< has two sides; triangles always have: their corners run around the front
  bool borderless = false;  ///< every edge is joined or collapsed, whether or not a volume is enclosed
  int eulerCharacteristic = 1;

  [[nodiscard]] const EdgeKind& edge(std::uint32_t patch, Side side) const {
    return edges[patch][static_cast<std::size_t>(side)];
  }
  [[nodiscard]] double orientation(std::uint32_t patch = 0) const { return orientations[patch]; }

  /// Whether the two u edges (the two v edges) of a one-patch surface are joined point for point, without a
  /// kink.
  [[nodiscard]] bool seamU() const { return wraps(Side::UMin, Side::UMax); }
  [[nodiscard]] bool seamV() const { return wraps(Side::VMin, Side::VMax); }

 private:
  [[nodiscard]] bool wraps(Side lower, Side upper) const;
};

/// Facts about the whole that its author states because the formula cannot tell.
struct StatedTopology {
  std::string_view name;                    ///< of the surface, for messages
  double orientation = 1;                   ///< of open surfaces; of closed ones it is measured
  std::span<const PatchEdge> borders = {};  ///< edges that are borders, whatever their points say
};

/// Finds everything above by looking at points of the edges. Two points count as one when they differ by less
/// than 1e-9 of the surface's extent: 10^6 times what formulas differ by when they are evaluated at 0 and at
/// 2 pi or in two ways, and a fiftieth of what single precision, and so a picture, can tell apart; a domain
/// typed as 0..6.283185307 closes too. Joined are whole edges only: choose domains so that what is joined is
/// an edge. Joints of n patches are found in O(n log n). Cost: about 70 evaluations per patch, 2,300 more for
/// closed surfaces. Throws Error(Scene) when the formula is finite nowhere or one point everywhere; the
/// message names the surface.
[[nodiscard]] Topology findTopology(std::span<const Patch> patches, std::span<const double> parameters,
                                    const StatedTopology& stated);

}  // namespace luxo
