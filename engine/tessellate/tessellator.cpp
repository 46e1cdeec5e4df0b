// SPDX-License-Identifier: Apache-2.0
#include "tessellate/tessellator.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/assert.h"

namespace luxo {
namespace {

/// The bound's coefficients for the whole domain: 8 * deviation = uu / nu^2 + 2 uv / (nu nv) + vv / nv^2.
struct Coefficients {
  double uu, uv, vv;

  [[nodiscard]] double deviation(double nu, double nv) const {
    return (uu / (nu * nu) + 2 * uv / (nu * nv) + vv / (nv * nv)) / 8;
  }
};

Coefficients coefficientsOf(const Surface& surface, std::span<const double> parameters) {
  const PartialBounds m = surface.partialBounds(parameters);
  const double du = surface.domain().u.width(), dv = surface.domain().v.width();
  // The mixed term measures how far points slide along the surface, which moves nothing that is seen
  // - on a flat surface, which is covered exactly whatever its interior edges are: only its borders deviate;
  // - on a surface of revolution, whose cells are plane trapezoids between two rings: a point is within
  //   vv / 8 nv^2 of the chord of its meridian, and that within radius (1 - cos(pi / nu)) <= uu / 8 nu^2 of
  //   the trapezoid.
  const double mixed = surface.flatNormal() || surface.revolution() ? 0 : m.uv;
  return {m.uu * du * du, mixed * du * dv, m.vv * dv * dv};
}

/// Fewest nv for a given nu, as a real number; infinite when nu alone already misses the tolerance.
double segmentsAcross(const Coefficients& c, double nu, double tolerance) {
  if (c.uv == 0 && c.vv == 0) return 1;
  const double room = 8 * tolerance - c.uu / (nu * nu);
  if (!(room > 0)) return std::numeric_limits<double>::infinity();
  const double half = c.uv / nu;
  return (half + std::sqrt(half * half + room * c.vv)) / room;
}

/// The next integer, where a number a rounding error above an integer counts as that.
double roundUp(double segments) { return std::ceil(segments * (1 - 1e-12)); }

}  // namespace

Segments atLeastMinimal(const Surface& surface, Segments segments) {
  const Topology& t = surface.topology();
  const std::uint32_t leastU = t.seamU() ? 3 : 1;
  const std::uint32_t leastV = t.seamV() ? 3 : t.collapsedVMin() && t.collapsedVMax() ? 2 : 1;
  return {std::clamp(segments.u, leastU, kMostSegments), std::clamp(segments.v, leastV, kMostSegments)};
}

Segments segmentsFor(const Surface& surface, std::span<const double> parameters, double tolerance) {
  LUXO_REQUIRE_COMPARE(tolerance, >, 0.0);
  const Coefficients c = coefficientsOf(surface, parameters);
  if (!std::isfinite(c.uu + c.uv + c.vv)) return atLeastMinimal(surface, kUnprovenSegments);
  const Segments least = atLeastMinimal(surface, {});
  const int collapsedRows = surface.topology().collapsedVMin() + surface.topology().collapsedVMax();
  const auto triangles = [&](double nu, double nv) { return nu * (2 * nv - collapsedRows); };

  // Every nu that could lead to the fewest triangles is tried: from the first that leaves room for v, to
  // where not even the nv of infinitely many columns would help.
  const double fewestAcross = std::max<double>(least.v, segmentsAcross({0, 0, c.vv}, 1, tolerance));
  double best = std::numeric_limits<double>::infinity();
  Segments found{c.uu + c.uv > 0 ? kMostSegments : least.u, c.vv + c.uv > 0 ? kMostSegments : least.v};
  double nu = std::max<double>(least.u, roundUp(std::sqrt(c.uu / (8 * tolerance))));
  for (; nu <= kMostSegments && triangles(nu, fewestAcross) < best; ++nu) {
    double nv = std::max<double>(least.v, roundUp(segmentsAcross(c, nu, tolerance)));
    if (c.deviation(nu, nv) > tolerance) ++nv;
    if (nv > kMostSegments || c.deviation(nu, nv) > tolerance || triangles(nu, nv) >= best) continue;
    best = triangles(nu, nv);
    found = {static_cast<std::uint32_t>(nu), static_cast<std::uint32_t>(nv)};
  }
  return found;
}

double deviationBound(const Surface& surface, std::span<const double> parameters, Segments segments) {
  return coefficientsOf(surface, parameters).deviation(segments.u, segments.v);
}

namespace {

/// Which vertex stands at each corner of the parameter grid, after seams are wrapped and collapsed rows
/// merged.
class VertexGrid {
 public:
  VertexGrid(const Topology& topology, Segments n) : topology_(topology), n_(n) {
    columns_ = topology.seamU() ? n.u : n.u + 1;
    rows_ = topology.seamV() ? n.v : n.v + 1;
    for (std::uint32_t j = 0; j < rows_; ++j) {
      rowStart_.push_back(count_);
      count_ += rowSize(j);
    }
  }

  [[nodiscard]] Edge edgeOf(std::uint32_t row) const {
    if (row == 0) return topology_.vMin;
    return row == n_.v ? topology_.vMax : Edge::Border;
  }
  [[nodiscard]] bool collapsed(std::uint32_t row) const {
    return edgeOf(row) == Edge::Pole || edgeOf(row) == Edge::Apex;
  }
  [[nodiscard]] std::uint32_t rowSize(std::uint32_t row) const {
    return edgeOf(row) == Edge::Pole ? 1 : edgeOf(row) == Edge::Apex ? n_.u : columns_;
  }
  /// The vertex at corner `side` (0 left, 1 right) of cell column i, on grid row j.
  [[nodiscard]] std::uint32_t vertex(std::uint32_t i, std::uint32_t side, std::uint32_t j) const {
    if (j == n_.v && topology_.seamV()) j = 0;
    const Edge edge = edgeOf(j);
    if (edge == Edge::Pole) return rowStart_[j];
    if (edge == Edge::Apex) return rowStart_[j] + i;
    return rowStart_[j] + (i + side == n_.u && topology_.seamU() ? 0 : i + side);
  }
  [[nodiscard]] std::uint32_t columns() const { return columns_; }
  [[nodiscard]] std::uint32_t rows() const { return rows_; }
  [[nodiscard]] std::uint32_t count() const { return count_; }

 private:
  Topology topology_;
  Segments n_;
  std::uint32_t columns_ = 0, rows_ = 0, count_ = 0;
  std::vector<std::uint32_t> rowStart_;
};

/// `count` values from lo, at k / segments of the range; the last of segments + 1 is hi itself.
std::vector<double> cuts(const Interval& range, std::uint32_t segments, std::uint32_t count) {
  std::vector<double> values(count);
  for (std::uint32_t k = 0; k < count; ++k)
    values[k] = k == segments ? range.hi : range.lo + range.width() * (static_cast<double>(k) / segments);
  return values;
}

void addVertices(Mesh& mesh, const Surface& surface, std::span<const double> parameters,
                 const VertexGrid& grid) {
  const Domain& domain = surface.domain();
  const std::vector<double> us = cuts(domain.u, mesh.segments.u, grid.columns());
  const std::vector<double> vs = cuts(domain.v, mesh.segments.v, grid.rows());
  const SurfacePoints points = surface.evaluateGrid(us, vs, parameters);
  const double orientation = surface.topology().orientation;

  const auto add = [&](const Vec3& position, const Vec3& normal, double u, double v) {
    mesh.positions.push_back(position);
    mesh.normals.push_back(normal);
    mesh.parameters.emplace_back(u, v);
  };
  for (std::uint32_t j = 0; j < grid.rows(); ++j) {
    if (grid.collapsed(j)) {
      const Vec3 position = points.position[j * us.size()];
      for (std::uint32_t i = 0; i < grid.rowSize(j); ++i) {
        const double u = domain.u.lo + domain.u.width() * ((i + 0.5) / mesh.segments.u);
        add(position, surface.normal(u, vs[j], parameters), u, vs[j]);
      }
      continue;
    }
    for (std::uint32_t i = 0; i < us.size(); ++i) {
      const std::size_t k = j * us.size() + i;
      const Vec3 cross = glm::cross(points.du[k], points.dv[k]);
      // A vanishing cross product (written so that NaN counts too) has a limit that the surface knows how to
      // find.
      const bool regular = glm::length(cross) > 1e-9 * glm::length(points.du[k]) * glm::length(points.dv[k]);
      add(points.position[k], regular ? orientation * unit(cross) : surface.normal(us[i], vs[j], parameters),
          us[i], vs[j]);
    }
  }
}

void addTriangles(Mesh& mesh, double orientation, const VertexGrid& grid) {
  const auto add = [&](std::uint32_t first, std::uint32_t second, std::uint32_t third) {
    if (orientation < 0) std::swap(second, third);
    mesh.indices.insert(mesh.indices.end(), {first, second, third});
  };
  for (std::uint32_t j = 0; j < mesh.segments.v; ++j)
    for (std::uint32_t i = 0; i < mesh.segments.u; ++i) {
      const std::uint32_t a = grid.vertex(i, 0, j), b = grid.vertex(i, 1, j);
      const std::uint32_t c = grid.vertex(i, 1, j + 1), d = grid.vertex(i, 0, j + 1);
      if (grid.collapsed(j)) {
        add(d, a, c);  // a and b are one point; start at d, which knows its column
      } else if (grid.collapsed(j + 1)) {
        add(a, b, c);
      } else {
        add(a, b, c);
        add(a, c, d);
      }
    }
}

}  // namespace

Mesh tessellate(const Surface& surface, std::span<const double> parameters, Segments segments) {
  Mesh mesh;
  mesh.segments = atLeastMinimal(surface, segments);
  const VertexGrid grid(surface.topology(), mesh.segments);
  mesh.positions.reserve(grid.count());
  mesh.normals.reserve(grid.count());
  mesh.parameters.reserve(grid.count());
  mesh.indices.reserve(std::size_t{6} * mesh.segments.u * mesh.segments.v);
  addVertices(mesh, surface, parameters, grid);
  addTriangles(mesh, surface.topology().orientation, grid);
  mesh.bound = deviationBound(surface, parameters, mesh.segments);
  return mesh;
}

}  // namespace luxo
