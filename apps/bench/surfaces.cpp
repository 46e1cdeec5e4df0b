// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/stopwatch.h"
#include "benchmarks.h"
#include "side_by_side.h"
#include "surface/catalogue.h"
#include "surface/library.h"
#include "tessellate/curvature_map.h"
#include "tessellate/tessellator.h"

namespace luxo::bench {
namespace {

/// The surface fills a picture of 720 lines: half a pixel is 1/1440 of its size.
constexpr double kHalfPixel = 1.0 / 1440;

struct SizedSurface {
  Surface surface;
  double tolerance = 0;
};

SizedSurface sized(const CatalogueEntry& entry) {
  Surface surface = makeSurface(entry);
  const double size = glm::length(surface.framing({}).extent());
  return {std::move(surface), kHalfPixel * size};
}

/// From nothing but the compiled formula, and with the map of its curvature, as for every further level.
void tessellateSurface(benchmark::State& state, const CatalogueEntry& entry, bool withMap) {
  const SizedSurface s = sized(entry);
  const CurvatureMap map(s.surface, {});
  const MeshDesc desc{.tolerance = s.tolerance};
  std::size_t triangles = 0;
  for ([[maybe_unused]] auto _ : state) {
    const Mesh mesh = withMap ? tessellate(s.surface, {}, map, desc) : tessellate(s.surface, {}, desc);
    triangles = mesh.triangleCount();
    benchmark::DoNotOptimize(mesh.indices.data());
  }
  state.counters["triangles"] = static_cast<double>(triangles);
}

/// Every frame of a waving flag has bounds, blocks and triangles of its own.
void tessellateMoving(benchmark::State& state) {
  const Surface surface = flag({.phase = [](double t) { return t; }});
  double phase = 0;
  for ([[maybe_unused]] auto _ : state) {
    phase += 0.01;
    benchmark::DoNotOptimize(tessellate(surface, std::vector{phase}, {.tolerance = 4 * kHalfPixel}));
  }
}

// The torus as one writes it for speed when it is the only surface there is.

constexpr double kMajor = 0.8, kMinor = 0.35;
constexpr std::size_t kSide = 256;

/// The centres of kSide cells of 0..1.
std::vector<double> centers() {
  std::vector<double> values(kSide);
  for (std::size_t i = 0; i < kSide; ++i) values[i] = (static_cast<double>(i) + 0.5) / kSide;
  return values;
}

struct Angle {
  double cosine, sine;
};

Angle angleOf(double turns) { return {std::cos(kTau * turns), std::sin(kTau * turns)}; }

void setTorus(SurfacePoints& points, std::size_t i, const Angle& u, const Angle& v) {
  const double rho = kMajor + kMinor * v.cosine;
  points.position[i] = {rho * u.cosine, kMinor * v.sine, -rho * u.sine};
  points.du[i] = kTau * Vec3(-rho * u.sine, 0, -rho * u.cosine);
  points.dv[i] = kTau * kMinor * Vec3(-v.sine * u.cosine, v.cosine, v.sine * u.sine);
}

SurfacePoints torusPoints(std::size_t count) {
  return {std::vector<Vec3>(count), std::vector<Vec3>(count), std::vector<Vec3>(count)};
}

SurfacePoints torusByHand(const std::vector<double>& u, const std::vector<double>& v) {
  SurfacePoints points = torusPoints(u.size());
  for (std::size_t i = 0; i < u.size(); ++i) setTorus(points, i, angleOf(u[i]), angleOf(v[i]));
  return points;
}

SurfacePoints torusGridByHand(const std::vector<double>& u, const std::vector<double>& v) {
  SurfacePoints points = torusPoints(u.size() * v.size());
  std::vector<Angle> column(u.size());
  std::transform(u.begin(), u.end(), column.begin(), angleOf);
  for (std::size_t j = 0; j < v.size(); ++j) {
    const Angle row = angleOf(v[j]);
    for (std::size_t i = 0; i < u.size(); ++i) setTorus(points, j * u.size() + i, column[i], row);
  }
  return points;
}

double largestDifference(const SurfacePoints& a, const SurfacePoints& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.position.size(); ++i)
    largest = std::max({largest, glm::length(a.position[i] - b.position[i]), glm::length(a.du[i] - b.du[i]),
                        glm::length(a.dv[i] - b.dv[i])});
  return largest;
}

template <class Points>
void evaluateTorus(benchmark::State& state, const Points& ours, const Points& byHand) {
  // Both round a few operations on numbers below 8.
  if (!(largestDifference(ours(), byHand()) < 1e-13)) {
    state.SkipWithError("the two do not agree on the torus");
    return;
  }
  sideBySide(
      state, [&](int) { benchmark::DoNotOptimize(ours().position.data()); },
      [&](int) { benchmark::DoNotOptimize(byHand().position.data()); });
  state.SetItemsProcessed(state.iterations() * kSide * kSide);
}

/// The whole catalogue to half a pixel, with a proof, beside as many uniform grids of n x n cells of the
/// torus written by hand, without indices, normals or a bound. `maps_ms`: of the curvature, made once for all
/// levels.
void tessellateCatalogue(benchmark::State& state, std::size_t n) {
  std::vector<SizedSurface> surfaces;
  for (const CatalogueEntry& entry : catalogue()) surfaces.push_back(sized(entry));
  std::vector<CurvatureMap> maps;
  const Stopwatch watch;
  for (const SizedSurface& s : surfaces) maps.emplace_back(s.surface, std::span<const double>());
  const double mapping = watch.milliseconds();
  std::vector<double> side(n + 1);
  for (std::size_t i = 0; i <= n; ++i) side[i] = static_cast<double>(i) / static_cast<double>(n);
  std::size_t triangles = 0;
  sideBySide(
      state,
      [&](int) {
        triangles = 0;
        for (std::size_t i = 0; i < surfaces.size(); ++i) {
          const MeshDesc desc{.tolerance = surfaces[i].tolerance};
          triangles += tessellate(surfaces[i].surface, {}, maps[i], desc).triangleCount();
        }
      },
      [&](int) {
        for (std::size_t i = 0; i < surfaces.size(); ++i)
          benchmark::DoNotOptimize(torusGridByHand(side, side).position.data());
      });
  state.counters["maps_ms"] = mapping;
  state.counters["triangles"] = static_cast<double>(triangles);
  state.counters["triangles_by_hand"] = static_cast<double>(2 * n * n * surfaces.size());
}

void evaluatePoints(benchmark::State& state) {
  std::vector<double> u, v;
  for (const double row : centers())
    for (const double column : centers()) {
      u.push_back(column);
      v.push_back(row);
    }
  const Surface surface = torus(kMajor, kMinor);
  const std::function<SurfacePoints()> ours = [&] { return surface.evaluate(u, v, {}); };
  evaluateTorus(state, ours, {[&] { return torusByHand(u, v); }});
}

void evaluateGrid(benchmark::State& state) {
  const std::vector<double> side = centers();
  const Surface surface = torus(kMajor, kMinor);
  const std::function<SurfacePoints()> ours = [&] { return surface.evaluateGrid(side, side, {}); };
  evaluateTorus(state, ours, {[&] { return torusGridByHand(side, side); }});
}

}  // namespace

void registerSurfaces() {
  for (const CatalogueEntry& entry : catalogue())
    for (const bool withMap : {false, true})
      benchmark::RegisterBenchmark(
          fmt::format("tessellate/{}/{}", entry.name, withMap ? "with_map" : "all").c_str(),
          [&entry, withMap](benchmark::State& state) { tessellateSurface(state, entry, withMap); })
          ->MinTime(0.05)
          ->Unit(benchmark::kMicrosecond);
  benchmark::RegisterBenchmark("tessellate/moving_flag", tessellateMoving)->Unit(benchmark::kMicrosecond);
  for (const std::size_t n : {64, 256})
    benchmark::RegisterBenchmark(fmt::format("tessellate/catalogue/beside_{0}x{0}", n).c_str(),
                                 tessellateCatalogue, n)
        ->UseManualTime()
        ->Iterations(11)
        ->Unit(benchmark::kMillisecond);
  const auto besideHandWritten = [](const char* name, void (*body)(benchmark::State&)) {
    benchmark::RegisterBenchmark(name, body)->UseManualTime()->Iterations(101)->Unit(benchmark::kMillisecond);
  };
  besideHandWritten("evaluate/torus/points", evaluatePoints);
  besideHandWritten("evaluate/torus/grid", evaluateGrid);
}

}  // namespace luxo::bench
