// SPDX-License-Identifier: Apache-2.0
#include "surface_integrals.h"

#include <algorithm>
#include <cmath>

namespace luxo {

std::vector<Jet> jetsOf(const Surface& surface, std::uint32_t patch, const std::vector<double>& u,
                        const std::vector<double>& v) {
  const SurfacePoints points = surface.evaluate(patch, u, v, {});
  const Patch& p = surface.patches()[patch];
  const auto second = p.function->second.evaluate(u, v, p.constants);
  const auto at = [&](int first, std::size_t i) {
    return Vec3(second[first][i], second[first + 1][i], second[first + 2][i]);
  };
  std::vector<Jet> jets;
  for (std::size_t i = 0; i < u.size(); ++i)
    jets.push_back({points.position[i], points.du[i], points.dv[i], at(0, i), at(3, i), at(6, i)});
  return jets;
}

Vec4 integrate(const Surface& surface, int cells,
               const std::function<Vec4(const Jet& jet, double orientation)>& f) {
  const int perPatch = std::max(2, static_cast<int>(cells / std::sqrt(surface.patchCount())));

  constexpr double kNode[] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
  constexpr double kWeight[] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                0.1012285362903763};
  const auto addNodes = [&](const Interval& range, std::vector<double>& nodes, std::vector<double>& weights) {
    const double half = 0.5 * range.width() / perPatch;
    for (int cell = 0; cell < perPatch; ++cell)
      for (int k = 0; k < 4; ++k)
        for (const double side : {-1.0, 1.0}) {
          nodes.push_back(range.lo + half * (2 * cell + 1 + side * kNode[k]));
          weights.push_back(half * kWeight[k]);
        }
  };
  Vec4 sum(0);
  for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
    std::vector<double> us, vs, uWeights, vWeights, u, v, weights;
    addNodes(surface.patchDomain(patch).u, us, uWeights);
    addNodes(surface.patchDomain(patch).v, vs, vWeights);
    for (std::size_t j = 0; j < vs.size(); ++j)
      for (std::size_t i = 0; i < us.size(); ++i) {
        u.push_back(us[i]);
        v.push_back(vs[j]);
        weights.push_back(uWeights[i] * vWeights[j]);
      }
    const std::vector<Jet> jets = jetsOf(surface, patch, u, v);
    for (std::size_t i = 0; i < jets.size(); ++i)
      sum += weights[i] * f(jets[i], surface.topology().orientation(patch));
  }
  return sum;
}

namespace {

/// Coefficients of the two fundamental forms, and what the first one's area element is.
struct Forms {
  double E, F, G, L, M, N, squared;
};

Forms formsOf(const Jet& jet) {
  const Vec3 n = unit(jet.cross());
  const double E = glm::dot(jet.du, jet.du), F = glm::dot(jet.du, jet.dv), G = glm::dot(jet.dv, jet.dv);
  return {E, F, G, glm::dot(jet.duu, n), glm::dot(jet.duv, n), glm::dot(jet.dvv, n), E * G - F * F};
}

}  // namespace

double gaussianCurvature(const Jet& jet) {
  const Forms f = formsOf(jet);
  return (f.L * f.N - f.M * f.M) / f.squared;
}

double meanCurvature(const Jet& jet) {
  const Forms f = formsOf(jet);
  return (f.E * f.N - 2 * f.F * f.M + f.G * f.L) / (2 * f.squared);
}

}  // namespace luxo
