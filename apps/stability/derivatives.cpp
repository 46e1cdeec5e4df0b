// SPDX-License-Identifier: Apache-2.0
// ST-05 to 07: derivatives and bounds, for every surface of the catalogue.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <string>

#include "math/float32.h"
#include "stability/cases.h"
#include "stability/device_formula.h"
#include "stability/dual.h"
#include "surface/catalogue.h"
#include "tessellate/parallel.h"

namespace luxo {
namespace {

/// Points of a patch, with the tangents there: of the truth, in double and as the device has them.
struct Tangents {
  std::vector<Vec3> du, dv;
};

struct Points {
  std::vector<double> u, v;  // exact in float, too
  std::vector<Vec2f> single;

  void add(double x, double y) {
    u.push_back(roundedToFloat(x));
    v.push_back(roundedToFloat(y));
    single.emplace_back(u.back(), v.back());
  }
};

Points randomPoints(const Domain& domain, std::size_t count, std::mt19937& random) {
  std::uniform_real_distribution<double> anywhere(0, 1);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double u = anywhere(random), v = anywhere(random);
    points.add(domain.u.lo + domain.u.width() * u, domain.v.lo + domain.v.width() * v);
  }
  return points;
}

Tangents trueTangents(const Patch& patch, const Points& points) {
  Graph graph;
  const DualFormula formula(graph, patch.function->position.expressions(graph));
  const std::size_t count = points.u.size(), chunk = 1024;
  Tangents result{std::vector<Vec3>(count), std::vector<Vec3>(count)};
  forEachIndex((count + chunk - 1) / chunk, true, [&](std::size_t part) {
    for (std::size_t i = part * chunk; i < std::min(count, (part + 1) * chunk); ++i) {
      const auto p = formula.at(points.u[i], points.v[i], patch.constants);
      result.du[i] = Vec3(p[0].du, p[1].du, p[2].du);
      result.dv[i] = Vec3(p[0].dv, p[1].dv, p[2].dv);
    }
  });
  return result;
}

/// How a surface's tangents are found: the subject of ST-05, or the naive way of ST-06.
class Differentiator {
 public:
  explicit Differentiator(gpu::Context& context) : context_(&context) {}
  virtual ~Differentiator() = default;

  [[nodiscard]] virtual Tangents inDouble(const Patch& patch, const Points& points) = 0;
  [[nodiscard]] virtual Tangents inFloat(const Patch& patch, const Points& points) = 0;

 protected:
  /// Patches that share a function share what is compiled.
  DeviceFormula& onDevice(const Patch& patch, const Tape& tape) {
    auto& formula = formulas_[patch.function];
    if (!formula) {
      Graph graph;
      formula = std::make_unique<DeviceFormula>(*context_, graph, tape.expressions(graph));
    }
    return *formula;
  }

 private:
  gpu::Context* context_;
  std::map<std::shared_ptr<const SurfaceFunction>, std::unique_ptr<DeviceFormula>> formulas_;
};

template <class Number>
Vec3 vectorOf(const std::vector<std::vector<Number>>& values, std::size_t first, std::size_t i) {
  return {values[first][i], values[first + 1][i], values[first + 2][i]};
}

/// What luxo does: the formula's exact derivatives.
class Exact : public Differentiator {
 public:
  using Differentiator::Differentiator;

  Tangents inDouble(const Patch& patch, const Points& points) override {
    return tangentsOf(patch.function->tangents.evaluate(points.u, points.v, patch.constants));
  }
  Tangents inFloat(const Patch& patch, const Points& points) override {
    return tangentsOf(onDevice(patch, patch.function->tangents).at(points.single, patch.constants));
  }

 private:
  template <class Number>
  static Tangents tangentsOf(const std::vector<std::vector<Number>>& values) {
    Tangents tangents;
    for (std::size_t i = 0; i < values[0].size(); ++i) {
      tangents.du.push_back(vectorOf(values, 3, i));
      tangents.dv.push_back(vectorOf(values, 6, i));
    }
    return tangents;
  }
};

/// Central differences of positions, with the steps that suit the precision best.
class Differences : public Differentiator {
 public:
  using Differentiator::Differentiator;

  Tangents inDouble(const Patch& patch, const Points& points) override {
    return differences(points, 1e-5, [&](const Points& shifted) {
      return patch.function->position.evaluate(shifted.u, shifted.v, patch.constants);
    });
  }
  Tangents inFloat(const Patch& patch, const Points& points) override {
    return differences(points, 4e-3, [&](const Points& shifted) {
      return onDevice(patch, patch.function->position).at(shifted.single, patch.constants);
    });
  }

 private:
  template <class Evaluate>
  static Tangents differences(const Points& points, double step, const Evaluate& evaluate) {
    const auto along = [&](double du, double dv) {
      Points low, high;
      for (std::size_t i = 0; i < points.u.size(); ++i) {
        low.add(points.u[i] - du, points.v[i] - dv);
        high.add(points.u[i] + du, points.v[i] + dv);
      }
      const auto before = evaluate(low), after = evaluate(high);
      std::vector<Vec3> slopes;
      for (std::size_t i = 0; i < points.u.size(); ++i) {
        // The step that was really taken, between numbers exact in float.
        const double width = high.u[i] - low.u[i] + (high.v[i] - low.v[i]);
        slopes.push_back((vectorOf(after, 0, i) - vectorOf(before, 0, i)) / width);
      }
      return slopes;
    };
    return {along(step, 0), along(0, step)};
  }
};

/// The largest error of a tangent, and the largest true one.
struct Largest {
  double error = 0, length = 0;

  void add(const std::vector<Vec3>& got, const std::vector<Vec3>& truth) {
    for (std::size_t i = 0; i < got.size(); ++i) {
      const double wanted = glm::length(truth[i]), difference = glm::length(got[i] - truth[i]);
      if (!std::isfinite(wanted)) continue;
      length = std::max(length, wanted);
      error = std::isnan(difference) ? std::numeric_limits<double>::infinity() : std::max(error, difference);
    }
  }
  [[nodiscard]] double relative() const { return error / length; }
  /// In units of the last place, in float, of the largest tangent.
  [[nodiscard]] double ulps() const { return error / std::ldexp(1.0, std::ilogb(length) - 23); }
};

struct Worst {
  double value = 0;
  std::string_view surface;

  void add(double next, std::string_view name) {
    if (next > value) *this = {next, name};
  }
};

/// Of one surface: in double, relative to the largest tangent, and in float, in ulps.
struct DerivativeErrors {
  std::string_view surface;
  double inDouble = 0, inFloat = 0;
};

std::vector<DerivativeErrors> measure(Differentiator& differentiator, std::size_t count) {
  std::vector<DerivativeErrors> errors;
  std::mt19937 random(5);  // NOLINT: the same numbers every time
  for (const CatalogueEntry& entry : catalogue()) {
    const Surface surface = makeSurface(entry);
    std::array<Largest, 2> inDouble, inFloat;
    for (Patch patch : surface.patches()) {
      // What is not exact in float is an error of the input, not of the derivative.
      for (double& constant : patch.constants) constant = roundedToFloat(constant);
      const Points points =
          randomPoints(patch.domain, std::max<std::size_t>(count / surface.patchCount(), 64), random);
      const Tangents truth = trueTangents(patch, points);
      const Tangents fine = differentiator.inDouble(patch, points);
      const Tangents coarse = differentiator.inFloat(patch, points);
      inDouble[0].add(fine.du, truth.du);
      inDouble[1].add(fine.dv, truth.dv);
      inFloat[0].add(coarse.du, truth.du);
      inFloat[1].add(coarse.dv, truth.dv);
    }
    errors.push_back({entry.name, std::max(inDouble[0].relative(), inDouble[1].relative()),
                      std::max(inFloat[0].ulps(), inFloat[1].ulps())});
  }
  return errors;
}

constexpr double kMaxInDouble = 1e-13, kMaxUlps = 8;

std::size_t pointsOf(const StressContext& context) {
  return static_cast<std::size_t>(context.of(1'000'000, 10'000));
}

std::vector<Measurement> exactDerivatives(StressContext& context) {
  Exact exact(context.device());
  const std::vector<DerivativeErrors> all = measure(exact, pointsOf(context));
  const DerivativeErrors& worst = *std::ranges::max_element(all, {}, &DerivativeErrors::inDouble);
  std::vector<Measurement> measurements = {
      atMost(fmt::format("error in double over the largest tangent, worst surface ({})", worst.surface),
             worst.inDouble, kMaxInDouble)};
  for (const DerivativeErrors& one : all)
    measurements.push_back(
        atMost(fmt::format("error on the device: {}", one.surface), one.inFloat, kMaxUlps, "ulp"));
  return measurements;
}

std::vector<Measurement> finiteDifferences(StressContext& context) {
  Differences differences(context.device());
  const std::vector<DerivativeErrors> all = measure(differences, pointsOf(context) / 10);
  const auto missed = [&](double DerivativeErrors::*error, double most) {
    return static_cast<double>(
        std::ranges::count_if(all, [&](const DerivativeErrors& one) { return one.*error > most; }));
  };
  return {atLeast("surfaces that fail ST-05 in double", missed(&DerivativeErrors::inDouble, kMaxInDouble), 1),
          atLeast("surfaces that fail ST-05 on the device", missed(&DerivativeErrors::inFloat, kMaxUlps), 1)};
}

/// A random rectangle of a random patch, down to a 256th of its sides.
struct RandomCell {
  std::uint32_t patch = 0;
  Domain domain;
};

RandomCell randomCell(const Surface& surface, std::mt19937& random) {
  std::uniform_real_distribution<double> anywhere(0, 1);
  const auto part = [&](const Interval& range) {
    const double width = range.width() * std::exp2(-8 * anywhere(random));
    const double low = range.lo + (range.width() - width) * anywhere(random);
    return Interval(low, std::min(low + width, range.hi));
  };
  RandomCell cell;
  cell.patch = static_cast<std::uint32_t>(random() % surface.patchCount());
  const Domain& patch = surface.patchDomain(cell.patch);
  cell.domain.u = part(patch.u);
  cell.domain.v = part(patch.v);
  return cell;
}

/// The largest distance, of random points, between a cell cut into two triangles and the surface at the same
/// parameters.
double deviation(const Surface& surface, const RandomCell& cell, int points, std::mt19937& random) {
  const auto& [u, v] = cell.domain;
  const auto corner = [&](double x, double y) { return surface.position(cell.patch, x, y); };
  const Vec3 low = corner(u.lo, v.lo), high = corner(u.hi, v.hi);
  const Vec3 right = corner(u.hi, v.lo), left = corner(u.lo, v.hi);
  std::uniform_real_distribution<double> anywhere(0, 1);
  double most = 0;
  for (int i = 0; i < points; ++i) {
    const double x = anywhere(random), y = anywhere(random);
    const Vec3 onTriangle = x >= y ? low + (x - y) * (right - low) + y * (high - low)
                                   : low + (y - x) * (left - low) + x * (high - low);
    const Vec3 onSurface = corner(u.lo + x * (u.hi - u.lo), v.lo + y * (v.hi - v.lo));
    most = std::max(most, glm::length(onTriangle - onSurface));
  }
  return most;
}

std::vector<Measurement> boundsHold(StressContext& context) {
  const int points = 100, cells = context.of(10'000, 2'000);
  std::mt19937 random(7);  // NOLINT: the same numbers every time
  std::vector<double> tightness;
  Worst worst;
  while (static_cast<int>(tightness.size()) < cells)
    for (const CatalogueEntry& entry : catalogue()) {
      const Surface surface = makeSurface(entry);
      for (int i = 0; i < 20; ++i) {
        const RandomCell cell = randomCell(surface, random);
        const auto proven = surface.boundCell(cell.patch, cell.domain, {});
        const double hu = cell.domain.u.width(), hv = cell.domain.v.width();
        const PartialBounds& second = proven.second;
        const double bound = (second.uu * hu * hu + 2 * second.uv * hu * hv + second.vv * hv * hv) / 8;
        // Below a 1e-9 of the surface the rounding of its points, 1e-15, would be what is measured.
        const double size = glm::length(surface.position(cell.patch, cell.domain.u.lo, cell.domain.v.lo));
        if (proven.kinked || !std::isfinite(bound) || bound < 1e-9 * std::max(size, 1.0)) continue;
        tightness.push_back(deviation(surface, cell, points, random) / bound);
        worst.add(tightness.back(), entry.name);
      }
    }
  const auto middle = tightness.begin() + static_cast<std::ptrdiff_t>(tightness.size() / 2);
  std::ranges::nth_element(tightness, middle);
  return {atMost(fmt::format("measured over bound, worst cell ({})", worst.surface), worst.value, 1 + 1e-6),
          atLeast("measured over bound, median cell", *middle, 0.4)};
}

}  // namespace

std::vector<StressCase> derivativeCases() {
  return {{"ST-05", "tangents of all surfaces against dual numbers in long double", exactDerivatives},
          {"ST-06", "finite differences would not pass ST-05", finiteDifferences},
          {"ST-07", "no cell deviates more than its bound", boundsHold}};
}

}  // namespace luxo
