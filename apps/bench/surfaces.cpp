// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "benchmarks.h"
#include "side_by_side.h"
#include "surface/library.h"
#include "tessellate/tessellator.h"

namespace luxo::bench {
namespace {

/// About as large as a picture of 720 lines shows it at a distance of its own height: half a pixel is 1/1440
/// of it.
constexpr double kHalfPixel = 2.0 / 1440;

struct NamedSurface {
  const char* name;
  Surface (*make)();
};

constexpr NamedSurface kSurfaces[] = {
    {"rectangle", [] { return rectangle(2, 2); }}, {"disk", [] { return disk(1); }},
    {"cylinder", [] { return cylinder(1, 2); }},   {"cone", [] { return cone(1, 0, 2); }},
    {"sphere", [] { return sphere(1); }},          {"paraboloid", [] { return paraboloid(0.2, 1.8); }},
    {"torus", [] { return torus(0.8, 0.35); }},    {"flag", [] { return flag({.phase = 0.3}); }},
};

std::vector<double> parametersOf(const Surface& surface) {
  std::vector<double> values;
  for (const Animated<double>& parameter : surface.parameters()) values.push_back(parameter.at(0));
  return values;
}

void tessellateSurface(benchmark::State& state, const Surface& surface, const MeshDesc& desc) {
  const std::vector<double> parameters = parametersOf(surface);
  std::size_t vertices = 0;
  for ([[maybe_unused]] auto _ : state) {
    const Mesh mesh = tessellate(surface, parameters, desc);
    vertices += mesh.positions.size();
    benchmark::DoNotOptimize(mesh.indices.data());
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(vertices));
}

/// From the formula, compiled and differentiated, to proven bounds: a surface keeps what it once found.
void boundSurface(benchmark::State& state, const NamedSurface& named) {
  for ([[maybe_unused]] auto _ : state) {
    const Surface surface = named.make();
    benchmark::DoNotOptimize(surface.partialBounds(parametersOf(surface)));
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
  for (const NamedSurface& named : kSurfaces) {
    const Surface surface = named.make();
    const std::pair<const char*, MeshDesc> meshes[] = {{"half_pixel", {.tolerance = kHalfPixel}},
                                                       {"64x64", {.uniform = Segments{64, 64}}},
                                                       {"256x256", {.uniform = Segments{256, 256}}}};
    for (const auto& [grid, desc] : meshes)
      benchmark::RegisterBenchmark(fmt::format("tessellate/{}/{}", named.name, grid).c_str(),
                                   tessellateSurface, surface, desc)
          ->Unit(benchmark::kMicrosecond);
    benchmark::RegisterBenchmark(fmt::format("partial_bounds/{}", named.name).c_str(), boundSurface, named)
        ->Unit(benchmark::kMicrosecond);
  }
  const auto besideHandWritten = [](const char* name, void (*body)(benchmark::State&)) {
    benchmark::RegisterBenchmark(name, body)->UseManualTime()->Iterations(101)->Unit(benchmark::kMillisecond);
  };
  besideHandWritten("evaluate/torus/points", evaluatePoints);
  besideHandWritten("evaluate/torus/grid", evaluateGrid);
}

}  // namespace luxo::bench
