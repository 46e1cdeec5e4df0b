// SPDX-License-Identifier: Apache-2.0
#include "draw/ray_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "base/stopwatch.h"
#include "draw/ray_layers.h"
#include "draw/rest_frame.h"
#include "math/sampling.h"
#include "reference/audit.h"
#include "reference/verification.h"
#include "surface/spread.h"
#include "tessellate/parallel.h"

namespace luxo {
namespace {

constexpr std::uint64_t kPixelsPerProbe = 4096, kFewestProbes = 64;
/// Pixels: of the depth of a certified point no more is lost, however large the numbers are. Where three
/// roundings may move it by kMaxTolerancePx it is searched for in double, or not certified; and of triangles
/// the corners are held to half of what an outline may be off (triangle_precision.h).
constexpr double kMaxRayRoundingPx = shared::kDepthRounding / (3 * 0x1p-24) * shared::kMaxTolerancePx;
constexpr double kMaxTrianglesPx = 0.5 * kSilhouettePx;
const shared::ReachingLight kAllReaches{.shadows = 0, .transmittance = Vec3f(1)};

double depthInBuffer(const View& view, double depth) {
  return view.perspective() ? view.near / depth : (view.far - depth) / (view.far - view.near);
}

/// The inverse; 0 is infinitely far away.
double depthOf(const View& view, float inBuffer) {
  if (inBuffer == 0) return std::numeric_limits<double>::infinity();
  return view.perspective() ? view.near / inBuffer : view.far - inBuffer * (view.far - view.near);
}

/// Upper bound of the distances that points of a node's pixels are computed from; of a surface without end,
/// those of most of it.
double reachOf(const View& view, const SnapshotNode& node) {
  const Box box = isFinite(node.boundsObject) ? node.boundsObject : node.surface.framing(node.parameters);
  const Box placed = transformBounds(node.worldFromObject, box);
  const Vec3 world = glm::max(glm::abs(placed.min - view.eye), glm::abs(placed.max - view.eye));
  const Vec3 object = glm::max(glm::abs(box.min), glm::abs(box.max));
  return glm::length(world) + glm::length(object) * largestStretch(node.worldFromObject.linear);
}

/// A point of a mesh's surface.
struct MeshPoint {
  std::uint32_t node;
  Vec2 parameters;
};

/// That which a pixel shows, if it shows one.
std::optional<MeshPoint> pointOf(const ShownMeshes& shown, PixelPlace pixel) {
  if (shown.nodes.empty()) return std::nullopt;
  const shared::ShownPoint& point =
      shown.points[static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(shown.width) +
                   static_cast<std::size_t>(pixel.x)];
  const auto node = std::ranges::find(shown.nodes, point.numberOfMaterial - 1, &PlacedNode::material);
  return node == shown.nodes.end() ? std::nullopt : std::optional(MeshPoint{node->node, point.parameters});
}

}  // namespace

double depthRounding(const View& view, const SnapshotNode& node) {
  return shared::kDepthRounding * reachOf(view, node);
}

shared::ReachingLight reachingLight(const reference::Caster& caster, const reference::Hit& hit,
                                    const LightGroup& group, bool& certified, bool ofMesh) {
  shared::ReachingLight reaches = kAllReaches;
  for (std::size_t bit = 0; bit < group.lights.size(); ++bit) {
    const auto light = group.lights[bit];
    if (!light || (!ofMesh && !caster.shinesOn(*light, hit))) continue;
    const Vec3 part = caster.reaching(*light, hit, certified);
    if (part == Vec3(0)) reaches.shadows |= 1U << bit;
    if (group.transmits) reaches.transmittance = Vec3f(part);
  }
  return reaches;
}

std::vector<PixelPlace> auditedPixels(PixelSize size, const Audit& audit,
                                      std::span<const PixelPlace> outlines) {
  std::vector<PixelPlace> pixels;
  if (audit.extent == AuditExtent::None) return pixels;
  const auto width = static_cast<std::uint64_t>(size.width), height = static_cast<std::uint64_t>(size.height);
  const std::uint64_t all = width * height;
  const std::uint64_t usual = std::max({all / kPixelsPerProbe, kFewestProbes, audit.atLeast});
  if (audit.extent == AuditExtent::All || usual >= all) {
    for (std::int32_t y = 0; y < size.height; ++y)
      for (std::int32_t x = 0; x < size.width; ++x) pixels.push_back({x, y});
    return pixels;
  }
  pixels.assign(outlines.begin(), outlines.end());
  for (std::uint64_t k = 0; k < usual; ++k) {
    const Vec2 at = quasirandomPoint(static_cast<double>(k)) * Vec2(size.width, size.height);
    pixels.push_back({std::min(static_cast<std::int32_t>(at.x), size.width - 1),
                      std::min(static_cast<std::int32_t>(at.y), size.height - 1)});
  }
  const auto place = [](const PixelPlace& p) { return std::pair(p.y, p.x); };
  std::ranges::sort(pixels, {}, place);
  pixels.erase(std::unique(pixels.begin(), pixels.end()), pixels.end());
  return pixels;
}

std::vector<Doubt> everywhere(PixelSize size, std::vector<Doubt> doubts) {
  std::vector<Doubt> all;
  auto next = doubts.begin();
  for (const PixelPlace pixel : auditedPixels(size, {.extent = AuditExtent::All}, {})) {
    all.push_back({.pixel = pixel});
    if (next == doubts.end() || next->pixel != pixel) continue;
    all.back().layers = next->layers;
    all.back().meshes = std::move(next++->meshes);
  }
  return all;
}

void CertifiedRays::begin(const Snapshot& snapshot, const DrawOptions& options,
                          std::function<bool()> goesOn) {
  goesOn_ = std::move(goesOn);
  treesMs_ = rounding_ = 0;
  mostRoundingPx_ = kMaxRayRoundingPx;
  nodes_.clear();
  receivers_.clear();
  all_.resize(snapshot.nodes.size());
  std::iota(all_.begin(), all_.end(), 0U);
  caster_.emplace(snapshot, shapes_, reference::Cells::WhereRaysGo, Shading::Exact,
                  showsGeometry(options.output) ? std::optional(options.shading) : std::nullopt);
  layers_.clear();
  exactLight_ = options.output == Output::Color && options.shading == Shading::Exact &&
                options.shadows == ShadowKinds::All && !occludesAmbient(snapshot, options) &&
                std::ranges::none_of(snapshot.lights, &SnapshotLight::approximate);
  for (std::uint32_t i = 0; i < snapshot.nodes.size(); ++i) {
    const bool surface = findsSurface(snapshot, snapshot.nodes[i], options),
               layers = findsLayers(snapshot, snapshot.nodes[i], options);
    if (surface) nodes_.push_back(i);
    if (layers) layers_.push_back(i);
    const Material& material = snapshot.materials[snapshot.nodes[i].material.index];
    exactLight_ &= surface || layers || material.invisible();
    if (!material.invisible() && !seenThrough(snapshot, snapshot.nodes[i], options)) receivers_.push_back(i);
    if (surface && snapshot.nodes[i].surface.isPolygonal()) mostRoundingPx_ = kMaxTrianglesPx;
    if (surface || layers) rounding_ = std::max(rounding_, depthRounding(snapshot.view, snapshot.nodes[i]));
  }
}

Vec2 CertifiedRays::sampled(PixelPlace pixel) const {
  return Vec2(pixel.x + 0.5, pixel.y + 0.5) + caster_->snapshot().view.sampleOffsetPx;
}

std::vector<reference::Ray> CertifiedRays::prepare(std::size_t count, const auto& pixelAt,
                                                   std::size_t worth) {
  const Stopwatch watch;
  std::vector<reference::Ray> rays;
  rays.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 at = sampled(pixelAt(i));
    rays.push_back(caster_->rayThrough(at.x, at.y));
  }
  caster_->prepareFor(rays, nodes_, worth);
  caster_->prepareFor(rays, layers_, worth);
  treesMs_ += watch.milliseconds();
  return rays;
}

void CertifiedRays::lookTwice(std::size_t count, const auto& look, const auto& certified,
                              const auto& refineCells) {
  std::vector<std::size_t> chosen(count);
  std::iota(chosen.begin(), chosen.end(), std::size_t{0});
  const auto lookAtAll = [&] {
    forEachIndex(chosen.size(), chosen.size() >= reference::kRaysForAllCores, [&](std::size_t k) {
      if (goesOn_()) look(chosen[k]);
    });
  };
  lookAtAll();
  std::erase_if(chosen, certified);
  if (chosen.empty()) return;
  refineCells(std::span<const std::size_t>(chosen));
  lookAtAll();
}

double CertifiedRays::rounding() const {
  const View& view = caster_->snapshot().view;
  return rounding_ + (view.perspective() ? 0 : shared::kDepthRounding * (view.far - view.near));
}

double CertifiedRays::roundingAt(double depth) const {
  const View& view = caster_->snapshot().view;
  const double pixel = (view.perspective() ? depth : 1) / view.pixelsPerUnit;
  return std::min(rounding(),
                  rounding() - rounding_ + shared::kDepthRounding * depth + mostRoundingPx_ * pixel);
}

bool CertifiedRays::confirms(const reference::Caster::First& seen, float shown) const {
  if (!(shown > 0) || !seen.hit || !seen.certified) return false;
  const View& view = caster_->snapshot().view;
  const double depth = glm::dot(seen.hit->position - view.eye, view.forward());
  const double pixel = (view.perspective() ? depth : 1) / view.pixelsPerUnit;
  // However steep the surface is: where it is grazed another layer may be as near as its slope allows.
  return std::abs(depthOf(view, shown) - depth) <= roundingAt(depth) + kPointPx * pixel;
}

RayPoints CertifiedRays::resolve(std::span<const Doubt> doubts, const RayDraws& draws,
                                 const ShownMeshes& shown) {
  std::vector<Doubt> points, others;
  for (const Doubt& doubt : doubts) (doubt.point ? points : others).push_back(doubt);
  RayPoints found;
  const std::vector<char> confirmed = addPoints(points, draws, found);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (confirmed[i] != 0) others.push_back(points[i]);
  std::vector<const Doubt*> changed;
  const auto change = [&](const Doubt& doubt) {
    found.pixels.push_back(doubt.pixel);
    changed.push_back(&doubt);
  };
  for (std::size_t i = 0; i < points.size(); ++i)
    if (confirmed[i] == 0) change(points[i]);
  found.resolved = found.pixels.size();
  for (const Doubt& doubt : others)
    if (doubt.shadows) change(doubt);
  found.shadowed = found.pixels.size() - found.resolved;
  addShadows(found.pixels, shown, draws.groups, found);
  for (const Doubt& doubt : others)
    if (doubt.layers && !doubt.shadows) change(doubt);
  found.layered = found.pixels.size() - found.resolved - found.shadowed;
  addLayers(changed, draws, found);
  return found;
}

std::vector<char> CertifiedRays::addPoints(std::span<const Doubt> doubts, const RayDraws& draws,
                                           RayPoints& points) {
  const auto pixelAt = [&](std::size_t i) { return doubts[i].pixel; };
  const std::vector<reference::Ray> rays = prepare(doubts.size(), pixelAt);
  std::vector<reference::Caster::First> seen(doubts.size());
  lookTwice(
      doubts.size(), [&](std::size_t i) { seen[i] = caster_->firstOf(nodes_, rays[i]); },
      [&](std::size_t i) { return seen[i].certified; },
      [&](std::span<const std::size_t> undecided) {
        static_cast<void>(prepare(
            undecided.size(), [&](std::size_t k) { return pixelAt(undecided[k]); },
            reference::kRaysForFinestCells));
      });

  std::vector<char> confirmed(doubts.size());
  std::vector<std::pair<std::size_t, std::size_t>> hits;  // index into found, pixel
  for (std::size_t i = 0; i < doubts.size(); ++i) {
    if (confirms(seen[i], doubts[i].shown)) {
      confirmed[i] = 1;
      continue;
    }
    points.undecided += !seen[i].certified;
    if (!seen[i].hit) {
      points.misses.push_back(doubts[i].pixel);
      continue;
    }
    const auto node = std::ranges::lower_bound(draws.found, seen[i].hit->node, {}, &FoundNode::node);
    if (node != draws.found.end() && node->node == seen[i].hit->node)
      hits.emplace_back(static_cast<std::size_t>(node - draws.found.begin()), i);
    else
      ++points.unknown;
  }
  std::ranges::stable_sort(hits, {}, &std::pair<std::size_t, std::size_t>::first);
  const View& view = caster_->snapshot().view;
  for (const auto& [node, i] : hits) {
    const reference::Hit& hit = *seen[i].hit;
    const PixelPlace pixel = doubts[i].pixel;
    const double depth = glm::dot(hit.position - view.eye, view.forward());
    if (points.runs.empty() || points.runs.back().found != node)
      points.runs.push_back({node, static_cast<std::uint32_t>(points.vertices.size()), 0});
    points.runs.back().vertexCount += 3;
    points.vertices.insert(points.vertices.end(), 3,
                           {.position = Vec3f(hit.position - draws.origin),
                            .normal = Vec3f(hit.normal),
                            .parameters = Vec2f(hit.u, hit.v),
                            .place = Vec4f(pixel.x + 0.5, pixel.y + 0.5, depthInBuffer(view, depth), depth),
                            .footprint = Vec4f(Vec4(hit.footprint[0], hit.footprint[1])),
                            .frame = frameOf(caster_->snapshot().nodes[hit.node], hit),
                            .flags = seen[i].certified ? 0U : shared::kUndecided});
  }
  return confirmed;
}

std::vector<std::uint32_t> CertifiedRays::receiversBut(const ShownMeshes& shown) const {
  std::vector<std::uint32_t> others = receivers_;
  std::erase_if(others, [&](std::uint32_t node) {
    return std::ranges::binary_search(shown.nodes, node, {}, &PlacedNode::node);
  });
  return others;
}

void CertifiedRays::addShadows(std::span<const PixelPlace> pixels, const ShownMeshes& shown,
                               std::span<const LightGroup> groups, RayPoints& points) {
  const bool any = std::ranges::any_of(groups, [](const LightGroup& group) { return !group.lights.empty(); });
  if (!any || pixels.empty()) return;
  const std::vector<reference::Ray> rays = prepare(pixels.size(), [&](std::size_t i) { return pixels[i]; });
  const std::vector<std::uint32_t> others = receiversBut(shown);
  struct Found {
    reference::Caster::First seen;
    bool ofMesh = false;
    std::vector<shared::ReachingLight> light;  // by group
    bool certified = true;
  };
  std::vector<Found> all(pixels.size());
  const auto find = [&](std::size_t i) {
    Found found;
    if (const auto point = pointOf(shown, pixels[i])) {
      found.ofMesh = true;
      found.seen.hit = caster_->pointAt(point->node, point->parameters, rays[i]);
      found.seen.certified = found.seen.hit.has_value();
    } else {
      found.seen = caster_->firstOf(others, rays[i]);
    }
    found.certified = found.seen.certified;
    for (const LightGroup& group : groups)
      found.light.push_back(
          found.seen.hit ? reachingLight(*caster_, *found.seen.hit, group, found.certified, found.ofMesh)
                         : kAllReaches);
    all[i] = std::move(found);
  };
  lookTwice(
      pixels.size(), find, [&](std::size_t i) { return all[i].certified; },
      [&](std::span<const std::size_t> undecided) {
        std::vector<reference::Ray> again;
        for (const std::size_t i : undecided) {
          again.push_back(rays[i]);
          for (const LightGroup& group : groups)
            for (const std::optional<std::uint32_t>& light : group.lights)
              if (light && all[i].seen.hit)
                again.push_back({all[i].seen.hit->position, caster_->towardLight(*light, *all[i].seen.hit)});
        }
        caster_->prepareFor(again, all_, reference::kRaysForFinestCells);
      });
  points.shadows.resize(groups.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    points.shadowsUndecided += !all[i].certified;
    all[i].light.resize(groups.size(), kAllReaches);  // of what was cancelled, too
    for (std::size_t g = 0; g < groups.size(); ++g)
      points.shadows[g].insert(
          points.shadows[g].end(), 3,
          {.place = Vec2f(pixels[i].x + 0.5, pixels[i].y + 0.5), .light = all[i].light[g]});
  }
}

void CertifiedRays::addLayers(std::span<const Doubt* const> doubts, const RayDraws& draws,
                              RayPoints& points) {
  const bool asked = !draws.layers.empty() || std::ranges::any_of(doubts, &Doubt::layers);
  if (!asked || doubts.empty()) return;
  const std::vector<reference::Ray> rays =
      prepare(doubts.size(), [&](std::size_t i) { return doubts[i]->pixel; });
  const LayerRays layers(*caster_, draws);
  std::vector<LayerRays::Seen> seen(doubts.size());
  lookTwice(
      doubts.size(), [&](std::size_t i) { seen[i] = layers.look(rays[i], *doubts[i]); },
      [&](std::size_t i) { return seen[i].certified; },
      [&](std::span<const std::size_t> undecided) {
        std::vector<reference::Ray> again;
        for (const std::size_t i : undecided) {
          again.push_back(rays[i]);
          layers.appendRaysToLights(seen[i], again);
        }
        caster_->prepareFor(again, all_, reference::kRaysForFinestCells);
      });
  for (std::size_t i = 0; i < doubts.size(); ++i) layers.append(seen[i], doubts[i]->pixel, points);
}

AuditResult CertifiedRays::audit(std::span<const DepthProbe> probes, const RayDraws& draws,
                                 const ShownMeshes& shown) {
  const std::vector<LightGroup>& groups = draws.groups;
  static_cast<void>(prepare(probes.size(), [&](std::size_t i) { return probes[i].pixel; }));
  const View& view = caster_->snapshot().view;
  const std::vector<std::uint32_t> others = receiversBut(shown);
  const auto isFirst = [&](const Vec2& at) {
    if (others == nodes_) return true;
    const reference::Caster::First first = caster_->firstOf(others, caster_->rayThrough(at.x, at.y));
    return first.hit && std::ranges::binary_search(nodes_, first.hit->node);
  };
  using enum reference::Judgement;
  std::vector<reference::Judgement> judged(probes.size());
  forEachIndex(probes.size(), probes.size() >= reference::kRaysForAllCores, [&](std::size_t i) {
    if (!goesOn_()) return;
    const Vec2 at = sampled(probes[i].pixel);
    const double depth = depthOf(view, probes[i].depth);
    judged[i] = reference::judge(*caster_, nodes_, at, depth, roundingAt(depth));
    const bool showsFound = probes[i].depth > 0 && !pointOf(shown, probes[i].pixel) && isFirst(at);
    for (std::size_t g = 0; showsFound && g < groups.size(); ++g)
      for (std::size_t bit = 0; judged[i] == Right && bit < groups[g].lights.size(); ++bit)
        if (const auto light = groups[g].lights[bit];
            light && !caster_->snapshot().lights[*light].approximate())
          judged[i] = reference::judgeShadow(
              *caster_, nodes_, at, *light,
              (probes[i].shadows[g] >> bit & 1) != 0 ? Vec3(0) : Vec3(probes[i].transmittances[g]));
    if (judged[i] == Right && draws.layersFrom) {
      const double originDepth = glm::dot(*draws.layersFrom - view.eye, view.forward());
      const double count = probes[i].layers.x, depths = probes[i].layers.y + count * originDepth;
      judged[i] = reference::judgeLayers(*caster_, layers_, at, {count, depths}, rounding());
    }
    if (judged[i] == Right && exactLight_ && probes[i].color)
      judged[i] = reference::judgeColor(*caster_, at, Vec3(*probes[i].color), rounding());
  });
  AuditResult result;
  for (const reference::Judgement judgement : judged) {
    result.failed += judgement == Wrong;
    result.undecided += judgement == Undecided;
  }
  return result;
}

}  // namespace luxo
