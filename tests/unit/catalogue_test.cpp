// SPDX-License-Identifier: Apache-2.0
// Every named surface against what mathematics knows about it.
#include "surface/catalogue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "base/error.h"
#include "catalogue_references.h"
#include "surface_integrals.h"

namespace luxo {
namespace {

constexpr double kUlp = 0x1p-52;

double extentOf(const Surface& surface) { return glm::length(surface.framing({}).extent()); }

struct Parameters {
  std::vector<double> u, v;
};

/// A grid over the domain; with its border, and points as near to it as 1e-9, when `edges`.
Parameters gridOn(const Domain& domain, int count, bool edges) {
  const auto along = [&](const Interval& range) {
    std::vector<double> values;
    for (int i = 0; i < count; ++i) values.push_back(range.lo + range.width() * (i + 0.5) / count);
    if (edges)
      for (const double part : {0.0, 1e-9, 1e-6, 1e-3}) {
        values.push_back(range.lo + part * range.width());
        values.push_back(range.hi - part * range.width());
      }
    return values;
  };
  Parameters grid;
  for (const double v : along(domain.v))
    for (const double u : along(domain.u)) {
      grid.u.push_back(u);
      grid.v.push_back(v);
    }
  return grid;
}

/// The parameters of a reference at a point of a patch: less than a rounding toward its middle, so that the
/// reference has this patch's side of a line where formulas meet.
std::pair<Real, Real> within(const Domain& domain, double u, double v) {
  const auto inward = [](double x, const Interval& range) {
    return x + (range.mid() - static_cast<Real>(x)) * 0x1p-60L;
  };
  return {inward(u, domain.u), inward(v, domain.v)};
}

class CatalogueReferences : public testing::TestWithParam<CatalogueReference> {};

TEST_P(CatalogueReferences, PositionsAreThoseOfTheLiterature) {
  const Surface surface = GetParam().surface();
  const double extent = extentOf(surface);

  double worst = 0, worstResidual = 0;
  for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
    const Parameters at = gridOn(surface.patchDomain(patch), surface.patchCount() > 2 ? 4 : 24, true);
    const SurfacePoints points = surface.evaluate(patch, at.u, at.v, {});
    for (std::size_t i = 0; i < at.u.size(); ++i) {
      const Vec3& p = points.position[i];
      if (GetParam().position) {
        const auto [u, v] = within(surface.patchDomain(patch), at.u[i], at.v[i]);
        worst = std::max(worst, static_cast<double>(glm::length(RealPoint(p) - GetParam().position(u, v))));
      }
      if (GetParam().residual)
        worstResidual =
            std::max(worstResidual, std::abs(static_cast<double>(GetParam().residual(RealPoint(p)))));
    }
  }
  // Formulas of up to a hundred roundings, the worst of them a subtraction that loses three digits.
  EXPECT_LE(worst, 1e3 * kUlp * extent);
  EXPECT_LE(worstResidual, 1e3 * kUlp * extent);
}

TEST_P(CatalogueReferences, TangentsEqualCentralDifferences) {
  // Sixth order in long double, h = 2^-13: truncation h^6 |S7| / 140 is below 1e-14 of the extent for the
  // fastest wave here (eight turns), rounding 2^-64 / h about 1e-15. A surface whose second parametrisation
  // is not written down is differenced in double with h = 2^-8: 2^-52 / h = 6e-14, truncation below 1e-8.
  const Surface surface = GetParam().surface();
  const double extent = extentOf(surface);
  const bool exact = static_cast<bool>(GetParam().position);
  const Real h = exact ? 0x1p-13L : 0x1p-8L;
  double worst = 0;
  for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
    const Domain& domain = surface.patchDomain(patch);
    const auto at = [&](Real u, Real v) {
      return exact ? GetParam().position(u, v)
                   : RealPoint(surface.position(patch, static_cast<double>(u), static_cast<double>(v)));
    };
    for (double s = 0.3; s < 0.8; s += 0.083)
      for (double t = 0.3; t < 0.8; t += 0.083) {
        const double u = domain.u.lo + s * domain.u.width(), v = domain.v.lo + t * domain.v.width();
        const Real hu = h * static_cast<Real>(domain.u.width()), hv = h * static_cast<Real>(domain.v.width());
        const auto difference = [&](Real du, Real dv) {
          RealPoint sum(0);
          for (const auto& [k, weight] : {std::pair(1, 45.0L), {2, -9.0L}, {3, 1.0L}})
            sum += weight * (at(u + k * du, v + k * dv) - at(u - k * du, v - k * dv)) / 60.0L;
          return sum / (du + dv);
        };
        const SurfacePoints points = surface.evaluate(patch, {&u, 1}, {&v, 1}, {});
        worst = std::max(
            worst, static_cast<double>(glm::length(RealPoint(points.du[0]) - difference(hu, 0)) * hu / h));
        worst = std::max(
            worst, static_cast<double>(glm::length(RealPoint(points.dv[0]) - difference(0, hv)) * hv / h));
      }
  }
  EXPECT_LE(worst, (exact ? 1e-12 : 1e-8) * extent);
}

TEST_P(CatalogueReferences, NormalsAreUnitAndAcrossBothTangents) {
  // Edges, poles and apexes included, and as near to them as 1e-9.
  const Surface surface = GetParam().surface();
  for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
    const Parameters at = gridOn(surface.patchDomain(patch), surface.patchCount() > 2 ? 2 : 12, true);
    const SurfacePoints points = surface.evaluate(patch, at.u, at.v, {});
    for (std::size_t i = 0; i < at.u.size(); ++i) {
      const Vec3 n = surface.normal(patch, at.u[i], at.v[i]);
      const auto where = testing::Message() << "patch " << patch << " at " << at.u[i] << ", " << at.v[i];
      ASSERT_NEAR(glm::length(n), 1, 4 * kUlp) << where;
      // A cross product nearly lost to rounding has a normal that is right to fewer digits.
      const double longest = std::max(glm::length(points.du[i]), glm::length(points.dv[i]));
      ASSERT_LE(std::abs(glm::dot(n, points.du[i])), 1e-9 * longest) << where;
      ASSERT_LE(std::abs(glm::dot(n, points.dv[i])), 1e-9 * longest) << where;
      if (GetParam().normal) {
        const auto [u, v] = within(surface.patchDomain(patch), at.u[i], at.v[i]);
        const RealPoint expected = GetParam().normal(u, v);
        ASSERT_LE(glm::length(n - Vec3(expected / glm::length(expected))), 1e-8) << where;
      }
    }
  }
}

TEST_P(CatalogueReferences, AreaVolumeAndTotalCurvature) {
  const Surface surface = GetParam().surface();
  const Topology& topology = surface.topology();
  if (!GetParam().area && !GetParam().volume && !topology.borderless) return;
  const Vec4 sums = integrate(surface, 32, [](const Jet& jet, double outward) {
    const double area = glm::length(jet.cross());
    return Vec4(area, outward * glm::dot(jet.position, jet.cross()) / 3, gaussianCurvature(jet) * area, 0);
  });
  // Where exponents are not whole the integrands are not analytic at the patches' edges.
  const double relative = surface.name().starts_with("super") ? 1e-4 : 1e-9;
  if (GetParam().area) {
    EXPECT_NEAR(sums[0], *GetParam().area, relative * *GetParam().area);
  }
  if (GetParam().volume) {
    EXPECT_TRUE(topology.closed);
    EXPECT_NEAR(sums[1], *GetParam().volume, relative * *GetParam().volume);
  }
  if (topology.closed) {
    EXPECT_GT(sums[1], 0);
  }
  // Gauss-Bonnet: over a surface without border or kinks the Gaussian curvature sums to 2 pi chi.
  if (topology.borderless && GetParam().smooth) {
    EXPECT_NEAR(sums[2], kTau * topology.eulerCharacteristic, 1e-3);
  }
}

TEST_P(CatalogueReferences, CurvatureIsWhatItIsKnownFor) {
  const Surface surface = GetParam().surface();
  const double extent = extentOf(surface);
  const Parameters at = gridOn(surface.domain(), 40, false);
  if (!GetParam().gaussianCurvature && !GetParam().minimal) return;
  for (const Jet& jet : jetsOf(surface, 0, at.u, at.v)) {
    if (GetParam().gaussianCurvature) {
      const double expected = *GetParam().gaussianCurvature;
      ASSERT_NEAR(gaussianCurvature(jet), expected, 1e-9 * std::max(1.0, std::abs(expected)));
    }
    if (GetParam().minimal) {
      ASSERT_NEAR(meanCurvature(jet) * extent, 0, 1e-10);
    }
  }
}

TEST_P(CatalogueReferences, JoinedEdgesAreOneCurveWithOneNormal) {
  const Surface surface = GetParam().surface();
  const double extent = extentOf(surface);
  EXPECT_EQ(std::ranges::all_of(surface.topology().joints, &Joint::smooth), !GetParam().kinked);
  constexpr int kSteps = 17;  // Ends included, but no halves or quarters: that is where pinches are.
  for (const Joint& joint : surface.topology().joints)
    for (int step = 0; step <= kSteps; ++step) {
      const double s = static_cast<double>(step) / kSteps;

      const EdgePoint a = edgePoint(surface.patchDomain(joint.a.patch), joint.a.side, s);
      const EdgePoint b =
          edgePoint(surface.patchDomain(joint.b.patch), joint.b.side, joint.reversed ? 1 - s : s);
      const Vec3 gap = surface.position(joint.a.patch, a.u, a.v) - surface.position(joint.b.patch, b.u, b.v);
      ASSERT_LE(glm::length(gap), 16 * kUlp * extent);
      if (!joint.smooth) continue;
      const Vec3 na = surface.normal(joint.a.patch, a.u, a.v), nb = surface.normal(joint.b.patch, b.u, b.v);
      ASSERT_LE(glm::length(na - (joint.flipped ? -nb : nb)), GetParam().smooth ? 1e-9 : 1e-5);
    }
}

TEST_P(CatalogueReferences, AreaVectorsOfAClosedSurfaceSumToZero) {
  const Surface surface = GetParam().surface();
  if (!surface.closed()) return;
  const Vec4 sums = integrate(surface, 32, [](const Jet& jet, double outward) {
    return Vec4(outward * jet.cross(), glm::length(jet.cross()));
  });
  EXPECT_LE(glm::length(Vec3(sums)), 1e-6 * sums.w);
}

std::string testName(std::string label) {
  for (char& c : label)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return label;
}

INSTANTIATE_TEST_SUITE_P(All, CatalogueReferences, testing::ValuesIn(catalogueReferences()),
                         [](const auto& instance) { return testName(instance.param.label); });

TEST(Catalogue, EverySurfaceHasAReference) {
  std::set<std::string_view> referenced;
  for (const CatalogueReference& reference : catalogueReferences()) referenced.insert(reference.entry);
  for (const CatalogueEntry& entry : catalogue()) EXPECT_TRUE(referenced.contains(entry.name)) << entry.name;
}

TEST(Catalogue, BryantKusnerBendsLeast) {
  // The integral of H^2 over any immersed projective plane is at least 12 pi; Kusner's surface attains it.
  const Surface boy = makeSurface("boy_bryant_kusner");
  const auto bending = [](const Jet& jet, double) {
    return Vec4(std::pow(meanCurvature(jet), 2) * glm::length(jet.cross()), 0, 0, 0);
  };
  EXPECT_NEAR(integrate(boy, 32, bending).x, 12 * kPi, 1e-9);
  EXPECT_GT(integrate(makeSurface("boy"), 32, bending).x, 12.5 * kPi);
}

TEST(Catalogue, TopologyIsAsTheTableSays) {
  for (const CatalogueEntry& entry : catalogue()) {
    const Surface surface = makeSurface(entry);
    const Topology& topology = surface.topology();
    EXPECT_EQ(surface.name(), entry.name);
    EXPECT_EQ(topology.borderless, entry.borderless) << entry.name;
    EXPECT_EQ(topology.orientable, entry.orientable) << entry.name;
    EXPECT_EQ(topology.eulerCharacteristic, entry.eulerCharacteristic) << entry.name;
    EXPECT_EQ(topology.closed, entry.borderless && entry.orientable) << entry.name;
  }
}

TEST(Catalogue, PolesAndApexes) {
  const auto kind = [](const char* name, Side side) {
    return makeSurface(name).topology().edge(0, side).kind;
  };
  EXPECT_EQ(kind("sphere", Side::VMin), Edge::Pole);
  EXPECT_EQ(kind("sphere", Side::VMax), Edge::Pole);
  EXPECT_EQ(kind("sphere", Side::UMin), Edge::Seam);
  EXPECT_EQ(kind("cone", Side::VMax), Edge::Apex);
  EXPECT_EQ(kind("boy", Side::VMin), Edge::Pole);
  EXPECT_EQ(kind("boy", Side::VMax), Edge::Pole);
  EXPECT_EQ(kind("boy_bryant_kusner", Side::VMin), Edge::Pole);
  EXPECT_EQ(kind("enneper", Side::VMin), Edge::Pole);
  EXPECT_EQ(kind("tractricoid", Side::VMin), Edge::Border);
}

TEST(Catalogue, NothingOverflowsAtTheEndsOfTheRanges) {
  for (const CatalogueEntry& entry : catalogue())
    for (const CatalogueArgument& argument : entry.arguments)
      for (const double value : {argument.range.lo, argument.range.hi}) {
        Surface surface;
        try {
          surface = makeSurface(entry, std::vector<SurfaceArgument>{
                                           {std::string(argument.name),
                                            std::vector<Animated<double>>(argument.initial.size(), value)}});
        } catch (const Error& error) {
          EXPECT_NE(entry.requirement, "") << entry.name << ": " << error.what();
          continue;
        }
        for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
          const Parameters at = gridOn(surface.patchDomain(patch), 4, true);
          for (const Vec3& p : surface.evaluate(patch, at.u, at.v, {}).position)
            ASSERT_TRUE(std::isfinite(p.x + p.y + p.z))
                << entry.name << ", " << argument.name << " " << value;
        }
      }
}

}  // namespace
}  // namespace luxo
