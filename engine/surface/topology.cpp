// SPDX-License-Identifier: Apache-2.0
#include "surface/topology.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace luxo {
namespace {

constexpr int kEdgeSamples = 33;  // odd, so that the middle and the ends of every edge are among them
constexpr double kCoincident =
    1e-12;  // of the extent: 10^4 times what evaluating at 0 and at 2 pi differs by
constexpr double kSameNormal = 1e-7;
constexpr double kNoVolume = 1e-9;  // rounding leaves 1e-13 of a volume that cancels

struct Samples {
  std::vector<Vec3> position, du, dv;
};

std::vector<double> evenly(const Interval& range, int count) {
  std::vector<double> values(count);
  for (int i = 0; i < count; ++i) values[i] = range.lo + range.width() * i / (count - 1);
  values.back() = range.hi;
  return values;
}

Vec3 at(const std::vector<std::vector<double>>& outputs, int first, std::size_t i) {
  return {outputs[first][i], outputs[first + 1][i], outputs[first + 2][i]};
}

Samples sample(const Tape& tangents, const std::vector<double>& u, const std::vector<double>& v,
               std::span<const double> parameters) {
  const auto values = tangents.evaluate(u, v, parameters);
  Samples samples;
  for (std::size_t i = 0; i < u.size(); ++i) {
    samples.position.push_back(at(values, 0, i));
    samples.du.push_back(at(values, 3, i));
    samples.dv.push_back(at(values, 6, i));
  }
  return samples;
}

bool finite(const Vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

double extentOf(const Samples& samples) {
  Box box;
  for (const Vec3& p : samples.position)
    if (finite(p)) box.add(p);
  return box.empty() ? 0 : glm::length(box.extent());
}

bool coincide(const std::vector<Vec3>& a, const std::vector<Vec3>& b, double tolerance) {
  return std::equal(a.begin(), a.end(), b.begin(),
                    [&](const Vec3& p, const Vec3& q) { return glm::length(p - q) <= tolerance; });
}

/// Both edges are the same curve with the same tangents: the surface is smooth across.
bool isSeam(const Samples& a, const Samples& b, double extent) {
  const auto slope = [](const std::vector<Vec3>& d) {
    double longest = 0;
    for (const Vec3& x : d) longest = std::max(longest, glm::length(x));
    return longest;
  };
  return coincide(a.position, b.position, kCoincident * extent) &&
         coincide(a.du, b.du, 1e3 * kCoincident * slope(a.du)) &&
         coincide(a.dv, b.dv, 1e3 * kCoincident * slope(a.dv));
}

bool collapses(const Samples& edge, double extent) {
  return std::all_of(edge.position.begin(), edge.position.end(), [&](const Vec3& p) {
    return glm::length(p - edge.position.front()) <= kCoincident * extent;
  });
}

/// Signed volume by the divergence theorem, midpoint rule, as a part of what would be summed without signs:
/// its sign tells which way Su x Sv points; near 0 there is no inside, however thin the surface.
double signedVolumePart(const SurfaceFunction& function, const Domain& domain,
                        std::span<const double> parameters) {
  constexpr int kCells = 48;
  std::vector<double> u, v;
  for (int j = 0; j < kCells; ++j)
    for (int i = 0; i < kCells; ++i) {
      u.push_back(domain.u.lo + domain.u.width() * (i + 0.5) / kCells);
      v.push_back(domain.v.lo + domain.v.width() * (j + 0.5) / kCells);
    }
  const Samples s = sample(function.tangents, u, v, parameters);
  double volume = 0, unsignedVolume = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    const double cone = glm::dot(s.position[i], glm::cross(s.du[i], s.dv[i]));
    volume += cone;
    unsignedVolume += std::abs(cone);
  }
  return unsignedVolume > 0 ? volume / unsignedVolume : 0;
}

}  // namespace

Vec3 limitNormal(const SurfaceFunction& function, const Domain& domain, double u, double v,
                 std::span<const double> parameters) {
  const auto crossAt = [&](double s, double t) {
    const auto d = function.twist.evaluate({&s, 1}, {&t, 1}, parameters);
    return std::array<Vec3, 3>{at(d, 0, 0), at(d, 3, 0), at(d, 6, 0)};
  };
  const auto [duv, du, dv] = crossAt(u, v);
  const Vec3 cross = glm::cross(du, dv);
  // A cross product this small against its factors is rounding noise, not a direction.
  const double noise = 1e-12 * (glm::length(du) + glm::length(duv) * domain.v.width()) * glm::length(dv);
  if (glm::length(cross) > noise) return unit(cross);

  const Vec3 twisted = v <= domain.v.mid() ? glm::cross(duv, dv) : -glm::cross(duv, dv);
  if (glm::length(twisted) > 1e-12 * glm::length(duv) * glm::length(dv)) return unit(twisted);

  // Doubly degenerate: the tangent plane of a neighbour, a millionth of the domain toward the middle.
  const auto inward = [](double x, const Interval& range) {
    return x + (x <= range.mid() ? 1 : -1) * 0x1p-20 * range.width();
  };
  const auto near = crossAt(inward(u, domain.u), inward(v, domain.v));
  const Vec3 normal = unit(glm::cross(near[1], near[2]));
  return finite(normal) && normal != Vec3(0) ? normal : Vec3(0, 1, 0);
}

Topology findTopology(const SurfaceFunction& function, const Domain& domain,
                      std::span<const double> parameters, const SurfaceTraits& traits) {
  const std::vector<double> us = evenly(domain.u, kEdgeSamples), vs = evenly(domain.v, kEdgeSamples);
  const auto along = [&](double value) { return std::vector<double>(kEdgeSamples, value); };
  const Samples uMin = sample(function.tangents, along(domain.u.lo), vs, parameters);
  const Samples uMax = sample(function.tangents, along(domain.u.hi), vs, parameters);
  const Samples vMin = sample(function.tangents, us, along(domain.v.lo), parameters);
  const Samples vMax = sample(function.tangents, us, along(domain.v.hi), parameters);
  const Samples middle = sample(function.tangents, us, along(domain.v.mid()), parameters);

  double extent = 0;
  for (const Samples* s : {&uMin, &uMax, &vMin, &vMax, &middle}) extent = std::max(extent, extentOf(*s));
  if (!(extent > 0))
    throw Error(
        ErrorKind::Scene,
        fmt::format("surface '{}' has no size: over u in [{}, {}], v in [{}, {}] its formula is the same "
                    "point, or not a number, everywhere",
                    traits.name, domain.u.lo, domain.u.hi, domain.v.lo, domain.v.hi),
        "check the formula and its domain");

  Topology t;
  if (isSeam(uMin, uMax, extent)) t.uMin = t.uMax = Edge::Seam;
  if (isSeam(vMin, vMax, extent)) t.vMin = t.vMax = Edge::Seam;

  const auto collapsed = [&](const Samples& edge, double v, Vec3& normal) {
    if (!collapses(edge, extent)) return Edge::Border;
    normal = limitNormal(function, domain, us.front(), v, parameters);
    for (const double u : us)
      if (glm::length(limitNormal(function, domain, u, v, parameters) - normal) > kSameNormal)
        return Edge::Apex;
    return Edge::Pole;
  };
  if (t.vMin != Edge::Seam) {
    t.vMin = collapsed(vMin, domain.v.lo, t.vMinNormal);
    t.vMax = collapsed(vMax, domain.v.hi, t.vMaxNormal);
  }

  t.orientation = traits.orientation;
  if (t.seamU() && (t.seamV() || (t.collapsedVMin() && t.collapsedVMax()))) {
    const double volume = signedVolumePart(function, domain, parameters);
    if (std::abs(volume) > kNoVolume) {
      t.closed = true;
      t.orientation = volume > 0 ? 1 : -1;
    }
  }
  return t;
}

}  // namespace luxo
