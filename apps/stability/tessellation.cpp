// SPDX-License-Identifier: Apache-2.0
// ST-22 to 24: whether the triangles of a surface cover every sample, once.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "stability/cases.h"
#include "stability/pictures.h"
#include "stability/sample_count.h"
#include "surface/catalogue.h"
#include "surface/library.h"
#include "surface/teapot.h"
#include "tessellate/block_mesh.h"
#include "tessellate/tessellator.h"

namespace luxo {
namespace {

using Random = std::mt19937;

double anywhere(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Vec3 anyDirection(Random& random) {
  const double y = anywhere(random, -1, 1), angle = anywhere(random, 0, kTau);
  return {std::sqrt(1 - y * y) * std::cos(angle), y, std::sqrt(1 - y * y) * std::sin(angle)};
}

/// What a camera outside a ball of that radius, anywhere from close by to far off, sees of it.
Mat4 anyCamera(Random& random, double radius, int side) {
  const double distance = radius * std::exp2(anywhere(random, 0.2, 4));
  const Camera camera{.eye = anyDirection(random) * distance,
                      .lookAt = anyDirection(random) * (0.3 * radius),
                      .up = anyDirection(random),
                      .fovY = 2 * std::atan(radius / distance * anywhere(random, 0.5, 1.5)),
                      .near = 1e-3 * radius};
  const View view = viewAt(camera, 0, {side, side});
  const Transform eye = eyeFromObject(view, {});
  Mat4 matrix(eye.linear);
  matrix[3] = Vec4(eye.translation, 1);
  return view.clipFromEye * matrix;
}

// ST-22 -----------------------------------------------------------------------------------------------------

std::vector<Measurement> convexCount(StressContext& context) {
  constexpr int kSide = 64, kAtOnce = 100;  // a sample is a sample in small pictures, too
  const int cameras = context.of(10'000, 1'000);
  SampleCounter counter(context.device(), kSide);
  Random random(22);  // NOLINT: the same numbers every time
  double wrong = 0, covered = 0;
  for (int first = 0; first < cameras; first += kAtOnce) {
    // Many meshes: from two dozen triangles to a thousand.
    const Mesh mesh = tessellate(sphere(1), {}, {.tolerance = std::exp2(anywhere(random, -9, -3))});
    counter.setMesh(mesh.positions, mesh.indices);
    std::vector<Mat4> matrices;
    for (int i = 0; i < kAtOnce; ++i) matrices.push_back(anyCamera(random, 1, kSide));
    for (const SampleCount& count : counter.count(matrices)) {
      if (count.front == 0 && count.back == 0) continue;
      ++covered;
      if (count.front != 1 || count.back != 1) ++wrong;
    }
  }
  return {none(fmt::format("of {:.3g} covered samples, not counted exactly once", covered), wrong, "samples"),
          atLeast("covered samples", covered, cameras)};
}

// ST-23 -----------------------------------------------------------------------------------------------------

/// A vertex's place, bit by bit.
using Place = std::array<double, 3>;

Place placeOf(const Vec3& p) { return {p.x, p.y, p.z}; }

struct MeshEdge {
  std::uint32_t a = 0, b = 0;  // vertices, as the triangle runs
};

/// Edges that no triangle runs along the other way, between the same places. Of a mesh without cracks they
/// are its borders.
std::vector<MeshEdge> unmatchedEdges(const Mesh& mesh) {
  std::map<std::pair<Place, Place>, std::vector<MeshEdge>> open;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3)
    for (int k = 0; k < 3; ++k) {
      const MeshEdge edge{mesh.indices[t + k], mesh.indices[t + (k + 1) % 3]};
      const Place a = placeOf(mesh.positions[edge.a]), b = placeOf(mesh.positions[edge.b]);
      if (a == b) continue;
      const auto other = open.find({b, a});
      if (other == open.end())
        open[{a, b}].push_back(edge);
      else if (other->second.pop_back(); other->second.empty())
        open.erase(other);
    }
  std::vector<MeshEdge> edges;
  for (const auto& [places, left] : open) edges.insert(edges.end(), left.begin(), left.end());
  return edges;
}

/// Whether both ends of an edge lie on one open border of the surface.
bool onBorder(const Surface& surface, const Mesh& mesh, const MeshEdge& edge) {
  const Vec2 a = mesh.parameters[edge.a], b = mesh.parameters[edge.b], middle = (a + b) / 2.0;
  for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
    const Domain& d = surface.patchDomain(patch);
    if (!d.contains(middle.x, middle.y)) continue;
    const auto open = [&](Side side) { return surface.topology().edge(patch, side).kind == Edge::Border; };
    if ((open(Side::UMin) && a.x == d.u.lo && b.x == d.u.lo) ||
        (open(Side::UMax) && a.x == d.u.hi && b.x == d.u.hi) ||
        (open(Side::VMin) && a.y == d.v.lo && b.y == d.v.lo) ||
        (open(Side::VMax) && a.y == d.v.hi && b.y == d.v.hi))
      return true;
  }
  return false;
}

/// Cuts a patch into a random number of tiles, each of a random level of detail from 1 to 64.
void cutAtRandom(const Tile& tile, std::uint32_t patch, Segments least, int depth, Random& random,
                 std::vector<Block>& blocks) {
  if (depth > 0 && random() % 2 == 0) {
    for (const Tile& half : tile.halves(random() % 2 == 0))
      cutAtRandom(half, patch, least, depth - 1, random, blocks);
    return;
  }
  const auto level = [&](std::uint32_t most, double width) {
    const auto wanted = static_cast<std::uint32_t>(std::exp2(anywhere(random, 0, 6.02)));
    return std::max(wanted, static_cast<std::uint32_t>(std::ceil(most * width)));
  };
  blocks.push_back({patch, tile, {level(least.u, tile.widthU()), level(least.v, tile.widthV())}});
}

Mesh patchworkOf(const Surface& surface, Random& random) {
  std::vector<Block> blocks;
  for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch)
    cutAtRandom({}, patch, leastSegments(surface.topology(), patch), 3, random, blocks);
  return meshOfBlocks(surface, {}, std::move(blocks));
}

struct Cracks {
  double edges = 0;              ///< without a partner, off the borders
  double magenta = 0, open = 0;  ///< samples of pictures
};

/// A mesh whose borders are closed by fans covers every sample by as many fronts as backs; where one is seen
/// through a crack in the other, or there is a crack in any layer, it does not.
Cracks cracksOf(const Surface& surface, const Mesh& mesh, std::span<const Mat4> cameras,
                SampleCounter& counter) {
  Cracks cracks;
  std::vector<Vec3> positions = mesh.positions;
  std::vector<std::uint32_t> indices = mesh.indices;
  const auto apex = static_cast<std::uint32_t>(positions.size());
  positions.emplace_back(0.1, 0.2, 0.3);
  for (const MeshEdge& edge : unmatchedEdges(mesh)) {
    if (!onBorder(surface, mesh, edge)) {
      ++cracks.edges;
      continue;
    }
    indices.insert(indices.end(), {edge.b, edge.a, apex});
  }
  counter.setMesh(positions, indices);
  for (const SampleCount& count : counter.count(cameras)) {
    if ((count.front == 0) != (count.back == 0)) ++cracks.magenta;
    if (count.front != count.back) ++cracks.open;
  }
  return cracks;
}

Cracks patchworkCracks(StressContext& context) {
  constexpr int kSide = 256, kFramesPerMesh = 4;
  const int frames = context.of(1'000, 60);
  const std::pair<Surface, double> subjects[] = {{torus(1, 0.4), 1.4}, {teapot(), 4.2}, {sphere(1), 1.0}};
  SampleCounter counter(context.device(), kSide);
  Random random(23);  // NOLINT: the same numbers every time
  Cracks sum;
  for (int frame = 0, which = 0; frame < frames; frame += kFramesPerMesh, ++which) {
    const auto& [surface, radius] = subjects[which % 3];
    std::vector<Mat4> cameras;
    for (int i = 0; i < kFramesPerMesh; ++i) cameras.push_back(anyCamera(random, radius, kSide));
    const Cracks cracks = cracksOf(surface, patchworkOf(surface, random), cameras, counter);
    sum.edges += cracks.edges;
    sum.magenta += cracks.magenta;
    sum.open += cracks.open;
  }
  return sum;
}

std::vector<Measurement> randomLevels(StressContext& context) {
  const Cracks cracks = patchworkCracks(context);
  return {none("magenta inside the silhouette", cracks.magenta, "samples"),
          none("samples with a crack in any layer", cracks.open, "samples"),
          none("edges of triangles without a partner", cracks.edges, "edges")};
}

// ST-24 -----------------------------------------------------------------------------------------------------

/// Vertices on the two ends of a direction that the surface joins without a kink, whose places differ.
double seamDifferences(const Surface& surface, const Mesh& mesh) {
  double differences = 0;
  const auto compare = [&](int along, const Interval& range) {
    std::map<double, std::array<std::set<Place>, 2>> sides;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const double across = mesh.parameters[i][along];
      if (across == range.lo || across == range.hi)
        sides[mesh.parameters[i][1 - along]][across == range.hi ? 1 : 0].insert(placeOf(mesh.positions[i]));
    }
    for (const auto& [parameter, places] : sides)
      if (places[0] != places[1]) ++differences;
  };
  // Poles have their vertices in the middle of triangles, not on the seam.
  if (surface.patchCount() == 1 && surface.topology().seamU()) compare(0, surface.domain().u);
  if (surface.patchCount() == 1 && surface.topology().seamV()) compare(1, surface.domain().v);
  return differences;
}

/// Places beyond the first that the vertices of collapsed edges are at.
double poleDifferences(const Surface& surface, const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, Side>, std::set<Place>> poles;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    const auto corner = [&](std::size_t k) { return mesh.parameters[mesh.indices[t + k]]; };
    const Vec2 middle = (corner(0) + corner(1) + corner(2)) / 3.0;
    const std::uint32_t patch = surface.patchAt(middle.x, middle.y);
    const Domain& d = surface.patchDomain(patch);
    for (std::size_t k = 0; k < 3; ++k) {
      const bool at[] = {corner(k).x == d.u.lo, corner(k).x == d.u.hi, corner(k).y == d.v.lo,
                         corner(k).y == d.v.hi};
      for (const Side side : kSides)
        if (at[static_cast<int>(side)] && surface.topology().edge(patch, side).collapsed())
          poles[{patch, side}].insert(placeOf(mesh.positions[mesh.indices[t + k]]));
    }
  }
  double differences = 0;
  for (const auto& [pole, places] : poles) differences += static_cast<double>(places.size() - 1);
  return differences;
}

/// Pixels that show nothing, looking from inside a sphere at its seam and at its poles.
double holesFromInside(StressContext& context) {
  double holes = 0;
  for (const Vec3& target : {Vec3(1, 0, 0), Vec3(0, 1, 1e-3), Vec3(0, -1, 1e-3)}) {
    const Camera camera{.eye = Vec3(0.1, 0.05, 0), .lookAt = target};
    holes += emptyCount(context.draw(sceneOf(sphere(1)), camera, Output::Id));
  }
  return holes;
}

std::vector<Measurement> seamsAndPoles(StressContext& context) {
  double seams = 0, poles = 0, edges = 0;
  for (const CatalogueEntry& entry : catalogue()) {
    const Surface surface = makeSurface(entry);
    const Box box = surface.framing({});
    for (const double part : {0.05, 0.003}) {
      const Mesh mesh = tessellate(surface, {}, {.tolerance = part * glm::length(box.max - box.min)});
      seams += seamDifferences(surface, mesh);
      poles += poleDifferences(surface, mesh);
      if (!surface.topology().orientable || mesh.dropped > 0) continue;
      for (const MeshEdge& edge : unmatchedEdges(mesh))
        if (!onBorder(surface, mesh, edge)) ++edges;
    }
  }
  return {none("places on seams that differ between the two sides", seams, "places"),
          none("places of poles beyond one each", poles, "places"),
          none("edges of triangles without a partner", edges, "edges"),
          none("holes seen from inside a sphere", holesFromInside(context), "pixels")};
}

}  // namespace

std::vector<StressCase> tessellationCases() {
  return {{"ST-22", "samples of a convex mesh are covered once from either side", convexCount},
          {"ST-23", "neighbours of random levels of detail leave no cracks", randomLevels},
          {"ST-24", "seams and poles are closed bit by bit", seamsAndPoles}};
}

}  // namespace luxo
