// SPDX-License-Identifier: Apache-2.0
#include "draw/shadow_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "draw/caster_list.h"
#include "draw/closed_caster.h"
#include "draw/exact_data.h"
#include "draw/light_map_list.h"
#include "draw/place_list.h"
#include "math/transform.h"
#include "scene/light_view.h"
#include "shadow/shadow_reach.h"
#include "surface/spread.h"

namespace luxo {
namespace {

/// The sine of a light's height over a plane below which floats do not tell its side.
constexpr double kInPlane = 1e-4;
/// What is nearer to a light than that part of the light's height over a plane has its flattened mesh spread
/// by no more than the inverse, as far as tolerances go.
constexpr double kNearLight = 1.0 / 16;

/// Of the size of all there is: rays whose ends are nearer to where they should be are right, as far as a
/// caster's rounding goes, which is 2^-21 of the distances involved.
constexpr double kParallel = 0x1p-30;

const SnapshotNode* nodeOf(const Snapshot& snapshot, NodeId id) {
  const auto node = std::ranges::lower_bound(snapshot.nodes, id.index, {},
                                             [](const SnapshotNode& n) { return n.id.index; });
  return node == snapshot.nodes.end() || node->id != id ? nullptr : &*node;
}

/// Of the distances involved: what double leaves of one.
constexpr double kRoundingBehind = 1e-13;
/// Of a light's distance: as near it is in a plane for rays (Caster::reaching) that are as little as 1e-6
/// aslant.
constexpr double kInItsPlane = 1e-14;

double distanceTo(const Box& box, const Vec3& p) { return glm::distance(p, glm::clamp(p, box.min, box.max)); }

class ShadowLister {
 public:
  ShadowLister(const Snapshot& snapshot, const VisibleList& visible, const DrawOptions& options,
               Geometry& geometry, MaterialList& materials, DrawList& list)
      : snapshot_(snapshot),
        options_(options),
        geometry_(geometry),
        materials_(materials),
        list_(list),
        casters_(snapshot, geometry, list) {
    for (const auto* nodes : {&visible.opaque, &visible.transparent})
      for (const VisibleNode& node : *nodes) {
        seen_.push_back(&snapshot.nodes[node.node]);
        receivers_.add(seen_.back()->boundsWorld);
      }
    // What most is in the shadow of comes first.
    std::ranges::stable_sort(seen_, std::ranges::greater(), [](const SnapshotNode* node) {
      const Vec3 extent = node->boundsWorld.extent();
      return std::max({extent.x, extent.y, extent.z});
    });
    gated_ = std::ranges::none_of(snapshot.materials, &Material::lightsBelowHorizon);
    for (const auto* batches : {&list.opaque, &list.layers.meshes})
      for (const DrawBatch& batch : *batches) offPx_ = std::max(offPx_, offPxOf(batch));
    const auto add = [&](double rounding) { pointRounding_ = std::max(pointRounding_, rounding); };
    for (const PlacedNode& placed : list.placed) add(casters_.roundingOfPlaces(snapshot.nodes[placed.node]));
    for (const std::uint32_t node : list.layers.placed) add(casters_.roundingOfPlaces(snapshot.nodes[node]));
    for (const DrawBatch& batch : list.opaque) add(roundingOf(batch));
  }

  void list(LightGroup& group, std::uint32_t bit, std::uint32_t light) {
    group_ = &group;
    const SnapshotLight from = seen(snapshot_.lights[light]);
    const std::vector<const SnapshotNode*> casters = castersOf(
        from, [&](const SnapshotNode& node) { return !from.map || materialOf(node).letsLightThrough(); });
    if (from.map) mapOf(snapshot_.lights[light]);
    for (const SnapshotNode* caster : casters) {
      if (from.plane)
        flatten(bit, from, *caster);
      else
        list(bit, from, *caster);
    }
    drawClosed();
  }

 private:
  /// How far what a draw shows may be off its surfaces, where their own points are not found.
  [[nodiscard]] double offPxOf(const DrawBatch& batch) const {
    if (!batch.mesh || batch.flat || batch.state.isSurface || batch.state.form == Form::Fused) return 0;
    for (std::uint32_t i = 0; i < batch.instanceCount; ++i) {
      const std::uint32_t node = list_.instanceNodes[batch.firstInstance + i];
      if (snapshot_.nodes[node].surface.isPolygonal()) continue;
      const bool placed = batch.state.form == Form::Layer
                              ? std::ranges::binary_search(list_.layers.placed, node)
                              : std::ranges::binary_search(list_.placed, node, {}, &PlacedNode::node);
      if (!placed) return options_.tolerancePx * (options_.standIns ? kStandInTolerance : 1);
    }
    return 0;
  }

  /// What formulas lose in single precision of the points that searches find, metres.
  [[nodiscard]] double roundingOf(const DrawBatch& batch) const {
    if (!batch.shell || batch.state.surface->number != GlslNumber::Float) return 0;
    double stretch = 0;
    for (std::uint32_t i = 0; i < batch.instanceCount; ++i) {
      const std::uint32_t node = list_.instanceNodes[batch.firstInstance + i];
      stretch = std::max(stretch, largestStretch(snapshot_.nodes[node].worldFromObject.linear));
    }
    return kTimesMeasured * batch.shell->formulaRounding * stretch;
  }

  [[nodiscard]] const Material& materialOf(const SnapshotNode& node) const {
    return snapshot_.materials[node.material.index];
  }

  /// A point light as what it shines on and through sees it.
  [[nodiscard]] SnapshotLight seen(SnapshotLight light) const {
    Box all = receivers_;
    for (const NodeId caster : light.casters)
      if (const SnapshotNode* node = nodeOf(snapshot_, caster); node && isFinite(node->boundsWorld))
        all.add(node->boundsWorld);
    light.positionWorld = parallelWhereFar(light.positionWorld, all, kParallel);
    return light;
  }

  /// Of the opaque ones: light that gets through others is exact. Of a light's point it is the light's. None
  /// where no caster can be between the light and what is seen; a wide light is in many places.
  void mapOf(SnapshotLight light) {
    if (light.pointOf) light.positionWorld = light.pointOf->middle;
    const std::vector<const SnapshotNode*> casters =
        castersOf(light, [&](const SnapshotNode& node) { return !materialOf(node).letsLightThrough(); });
    const auto reaches = [&](const SnapshotNode* node) { return reachesWhatIsSeen(light, *node); };
    if (light.map->radius == 0 && std::ranges::none_of(casters, reaches)) return;
    group_->map = listLightMap(light, casters, receivers_, list_.origin, geometry_.meshes);
  }

  /// Those of a light that may shadow something, which points do not, and are as asked, by what they are:
  /// what rounding leaves of a product depends on the order.
  [[nodiscard]] std::vector<const SnapshotNode*> castersOf(const SnapshotLight& light,
                                                           const auto& isAsked) const {
    std::vector<const SnapshotNode*> casters;
    for (const NodeId caster : light.casters)
      if (const SnapshotNode* node = nodeOf(snapshot_, caster);
          node && !materialOf(*node).invisible() && isAsked(*node) && !behind(light, *node).empty() &&
          largestStretch(node->worldFromObject.linear) > 0)
        casters.push_back(node);
    std::ranges::stable_sort(casters, {}, [&](const SnapshotNode* node) {
      const Box& box = node->boundsWorld;
      const Material& material = materialOf(*node);
      return std::array{box.min.x,          box.min.y,         box.min.z,        box.max.x,
                        box.max.y,          box.max.z,         material.opacity, material.diffuse.x,
                        material.diffuse.y, material.diffuse.z};
    });
    return casters;
  }

  [[nodiscard]] static Vec3 pointOf(const SnapshotNode& node) {
    return transformPoint(node.worldFromObject, node.surface.somePoint(node.parameters));
  }

  /// The caster's mesh becomes the shadow on the light's plane, by the projection from the light: with the
  /// plane p . x = 0 and the light l, both of four components, x - (p . x) / (p . l) l (J. Blinn, Me and my
  /// (fake) shadow, 1988).
  void flatten(std::uint32_t bit, const SnapshotLight& light, const SnapshotNode& node) {
    const auto plane = std::ranges::find(snapshot_.nodes, *light.plane, &SnapshotNode::id);
    if (plane == snapshot_.nodes.end() || plane->id == node.id) return;  // what is hidden receives nothing
    const std::uint32_t receiver =
        materials_.numberOfNode(static_cast<std::uint32_t>(&*plane - snapshot_.nodes.data()));
    if (receiver == shared::kMaxFoundMaterials) return;  // nothing of it is in the picture
    if (!mayShadow(light.positionWorld, node.boundsWorld, plane->boundsWorld)) return;
    const View& view = snapshot_.view;
    const Vec3 at = pointOf(*plane) - list_.origin;
    Vec3 normal = unit(normalMatrix(plane->worldFromObject.linear) * *plane->surface.flatNormal());
    const Vec4 from(Vec3(light.positionWorld) - light.positionWorld.w * list_.origin, light.positionWorld.w);
    const Vec3 toLight = Vec3(from) - from.w * at;
    if (glm::dot(normal, toLight) < 0) normal = -normal;
    const double height = glm::dot(normal, toLight), sine = height / glm::length(toLight);
    if (!(sine > kInPlane) || !isFinite(node.boundsWorld)) {
      list_.byRays.push_back({{0, 0}, {view.size.width, view.size.height}});
      return;
    }
    const Vec4 heights = Vec4(normal, -glm::dot(normal, at)) / height;
    const Mat4 flattened = Mat4(1) - glm::outerProduct(from, heights);

    // A mesh is off by as much as the rays of the light spread it.
    double lowest = 0, size = 0;
    for (const Vec3& corner : cornersOf(node.boundsWorld)) {
      lowest = std::max(lowest, glm::dot(heights, Vec4(corner - list_.origin, 1)));
      size = std::max(size, glm::distance(corner, node.boundsWorld.center()));
    }
    const double spread = light.directional() ? 1 : 1 / std::max(1 - lowest, kNearLight);
    const double depth =
        view.perspective() ? std::max(view.near, glm::dot(at + list_.origin - view.eye, view.forward())) : 1;
    const double tolerance = std::clamp(options_.tolerancePx * depth / view.pixelsPerUnit * sine / spread,
                                        1e-4 * size, 1e-2 * size);
    const auto mesh = geometry_.meshes.get(
        node.surface, node.parameters,
        {.uniform = node.segments, .tolerance = tolerance / largestStretch(node.worldFromObject.linear)});
    if (mesh->indices.empty()) return;
    Mat4 relativeFromObject(node.worldFromObject.linear);
    relativeFromObject[3] = Vec4(transformPoint(node.worldFromObject, mesh->origin) - list_.origin, 1);
    const Material& material = materialOf(node);
    const bool through = material.letsLightThrough();
    const Paint pattern = through ? Paint::ofCaster(material) : Paint();
    const bool transmits = through && material.cutoff == 0;
    (transmits ? group_->flatTransmittances : group_->flatShadows)
        .push_back(
            {.state = {.form = transmits ? Form::FlatTransmittance : Form::FlatShadow, .pattern = pattern},
             .mesh = mesh,
             .shadow = {.clipFromObject =
                            Mat4f(Mat4(list_.view.clipFromRelative) * flattened * relativeFromObject),
                        .height = Vec4f(heights * relativeFromObject),
                        .highest = light.directional() ? std::numeric_limits<float>::max() : 1,
                        .light = bit,
                        .receiver = receiver,
                        .transmittance =
                            Vec3f(material.lightThrough(material.opacityAt(0, 0), material.diffuse))},
             .caster = {.firstPatternParameter =
                            pattern.valid() ? materials_.firstPatternParameter(material, node, pattern) : 0,
                        .opacity = static_cast<float>(material.opacity),
                        .leastOpaque = static_cast<float>(material.leastOpaque()),
                        .tintsLight = material.blend == Blend::Multiply ? 1U : 0U}});
  }

  /// Whether something that is seen may be in its shadow.
  [[nodiscard]] bool reachesWhatIsSeen(const SnapshotLight& light, const SnapshotNode& node) const {
    return std::ranges::any_of(seen_, [&](const SnapshotNode* receiver) {
      return receiver == &node ? mayShadowItself(node)
                               : mayShadow(light.positionWorld, node.boundsWorld, receiver->boundsWorld);
    });
  }

  /// Normals that turn toward the viewer may face a light from inside.
  [[nodiscard]] bool mayShadowItself(const SnapshotNode& node) const {
    if (node.surface.flatNormal()) return false;
    if (!gated_ || materialOf(node).twoSided == TwoSided::Yes) return true;
    return !isEllipsoid(node.surface, node.parameters);
  }

  void list(std::uint32_t bit, const SnapshotLight& light, const SnapshotNode& node) {
    const std::optional<PixelRect> area = areaOf(light, node);
    if (!area || !reachesWhatIsSeen(light, node) || addClosed(bit, light, node, *area)) return;
    if (add(bit, light, node, *area)) return;
    if (!node.surface.isPolygonal()) {
      list_.byRays.push_back(*area);
      return;
    }
    if (!std::ranges::all_of(list_.layers.meshes, &DrawBatch::finds))
      refuse(node, "has too many triangles to cast an exact shadow on meshes that are seen through");
    list_.shadowsByRays.push_back(*area);
  }

  [[noreturn]] static void refuse(const SnapshotNode& node, const char* why) {
    throw Error(ErrorKind::Scene,
                fmt::format("node number {} {}, which is not supported yet", node.number, why),
                "leave it out of the lights' \"casters\", or make it opaque");
  }

  /// Whether a shader can find it by its equation.
  bool addClosed(std::uint32_t bit, const SnapshotLight& light, const SnapshotNode& node,
                 const PixelRect& area) {
    if (materialOf(node).letsLightThrough()) return false;
    const auto closed = closedCaster(snapshot_, node, light.positionWorld, list_.origin,
                                     {offPx_, pointRounding_}, geometry_.casters);
    if (!closed) return false;
    Closed& caster = closed_.emplace_back(Closed{closed->data, closed->kind, area});
    caster.data.light_ = bit;
    caster.data.flags |= flagsOf(node, closed->kind == shared::kClosedBall);
    caster.data.material = numberOf(node);
    return true;
  }

  /// Of those that are listed some at once, where they have pixels in common.
  void drawClosed() {
    std::ranges::stable_sort(closed_, {}, &Closed::kind);
    for (std::size_t i = 0; i < closed_.size();) {
      CasterDraw draw{.state = {.form = Form::Shadow,
                                .closed = 0,
                                .closedKind = closed_[i].kind,
                                .places = list_.findsPlaces},
                      .caster = static_cast<std::uint32_t>(list_.casters.closed.size()),
                      .area = closed_[i].area};
      do {
        draw.area = around(draw.area, closed_[i].area);
        list_.casters.closed.push_back(closed_[i].data);
        ++draw.state.closed;
        ++i;
      } while (i < closed_.size() && draw.state.closed < shared::kMaxClosedCasters &&
               closed_[i].kind == draw.state.closedKind &&
               around(draw.area, closed_[i].area).count() <= draw.area.count() + closed_[i].area.count());
      if (group_->lightsPoints()) group_->shadows.push_back(draw);
      if (group_->lightsLayers()) {
        draw.state.form = Form::LayerShadow;
        draw.state.places = false;
        group_->layerShadows.push_back(draw);
      }
    }
    closed_.clear();
  }

  [[nodiscard]] static PixelRect around(const PixelRect& a, const PixelRect& b) {
    return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)},
            {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)}};
  }

  [[nodiscard]] std::uint32_t numberOf(const SnapshotNode& node) const {
    return materials_.numberOfNode(static_cast<std::uint32_t>(&node - snapshot_.nodes.data()));
  }

  /// Normals that turn toward the viewer may face a light from inside.
  [[nodiscard]] std::uint32_t flagsOf(const SnapshotNode& node, bool convex) const {
    const bool turns = materialOf(node).twoSided == TwoSided::Yes;
    return (gated_ ? shared::kGatedLight : 0) | (convex && !turns ? shared::kConvexCaster : 0);
  }

  /// Whether a shader can find it.
  bool add(std::uint32_t bit, const SnapshotLight& light, const SnapshotNode& node, const PixelRect& area) {
    const CasterCode found = casterCode(geometry_.codes, node.surface, node.parameters);
    if (casters_.losesMore(node)) return false;
    const auto entry = casters_.entryOf(node, found, light.positionWorld, options_.shadowGridSize);
    if (!entry) return false;
    if (!entry->caster) return true;
    shared::ShadowCaster caster = *entry->caster;
    caster.light = bit;
    caster.flags |= flagsOf(node, entry->cells->convex);
    caster.offPixels = static_cast<float>(offPx_);
    caster.rounding +=
        static_cast<float>(pointRounding_ * largestStretch(glm::inverse(node.worldFromObject.linear)));
    caster.material = numberOf(node);
    if (entry->cells->flatNormal) setPlane(light, node, *entry->cells, caster);
    CasterDraw draw{.state = {.surface = found.code}, .area = area};
    const Material& material = materialOf(node);
    const bool transmits = material.letsLightThrough();
    if (transmits) {
      if (material.blend == Blend::Multiply) {
        caster.flags |= shared::kTintsLight;
        caster.diffuse = Vec3f(material.diffuse);
      }
      caster.opacity = static_cast<float>(material.opacity);
      caster.leastOpaque = static_cast<float>(material.leastOpaque());
      if (const Paint paint = Paint::ofCaster(material); paint.valid()) {
        draw.state.pattern = paint;
        caster.firstPatternParameter = materials_.firstPatternParameter(material, node, paint);
      }
    }
    draw.caster = casters_.add(caster);
    if (group_->lightsPoints()) {
      draw.state.form = transmits ? Form::Transmittance : Form::Shadow;
      draw.state.places = list_.findsPlaces;
      (transmits ? group_->transmittances : group_->shadows).push_back(draw);
    }
    if (group_->lightsLayers()) {
      draw.state.form = transmits ? Form::LayerTransmittance : Form::LayerShadow;
      draw.state.places = false;
      (transmits ? group_->layerTransmittances : group_->layerShadows).push_back(draw);
    }
    return true;
  }

  /// Not where the light is in the plane, or nearly.
  void setPlane(const SnapshotLight& light, const SnapshotNode& node, const CasterCells& cells,
                shared::ShadowCaster& caster) const {
    const Vec3 normal = unit(normalMatrix(node.worldFromObject.linear) * *cells.flatNormal);
    const Vec3 at = pointOf(node);
    const Vec3 toLight = Vec3(light.positionWorld) - light.positionWorld.w * at;
    const double side = glm::dot(normal, toLight);
    if (!(std::abs(side) > kInPlane * glm::length(toLight))) return;
    const Vec3 towardLight = side > 0 ? normal : -normal;
    caster.plane = Vec4f(Vec4(towardLight, -glm::dot(towardLight, at - list_.origin) - pointRounding_));
    caster.flags |= shared::kFlatCaster;
  }

  /// All that may be in the caster's shadow: of a flat one no box that is on the light's side, if not in the
  /// plane, as all is of a floor, mostly; and nothing where the light is on it.
  [[nodiscard]] Box behind(const SnapshotLight& light, const SnapshotNode& node) const {
    const std::optional<Vec3> flat = node.surface.flatNormal();
    if (!flat) return receivers_;
    const Vec3 at = pointOf(node), normal = unit(normalMatrix(node.worldFromObject.linear) * *flat);
    const double side = glm::dot(normal, Vec3(light.positionWorld) - light.positionWorld.w * at);
    if (light.positionWorld.w != 0 && std::abs(side) <= kInItsPlane * glm::length(Vec3(light.positionWorld)))
      return {};
    if (side == 0) return receivers_;
    Box behind;
    for (const SnapshotNode* receiver : seen_) {
      const Box& box = receiver->boundsWorld;
      if (box.empty()) continue;
      double size = glm::length(at - list_.origin), lowest = std::numeric_limits<double>::infinity();
      for (const Vec3& corner : cornersOf(box)) {
        lowest = std::min(lowest, (side < 0 ? -1 : 1) * glm::dot(normal, corner - at));
        size = std::max(size, glm::distance(corner, at));
      }
      if (!(lowest >= -kRoundingBehind * size)) behind.add(box);
    }
    return behind;
  }

  /// Where all ways lead to one side of the box, they end there: what a half space cuts off a cone of rays is
  /// around the points where it cuts its edges.
  static void shorten(const std::array<Vec3, 8>& corners, const std::array<Vec3, 8>& ways, const Box& box,
                      std::array<double, 8>& lengths) {
    for (int axis = 0; axis < 3; ++axis)
      for (const double sign : {-1.0, 1.0}) {
        const double end = sign < 0 ? box.min[axis] : box.max[axis];
        std::array<double, 8> cut{};
        bool leads = true;
        for (std::size_t i = 0; i < ways.size(); ++i) {
          leads &= sign * ways[i][axis] > kInPlane * glm::length(ways[i]);
          cut[i] = std::max((end - corners[i][axis]) / ways[i][axis], 0.0);
        }
        if (leads && std::ranges::max(cut) < std::ranges::max(lengths)) lengths = cut;
      }
  }

  /// Pixels in which the caster may stand between the light and what is seen: those of all that lies behind
  /// it, as far as there is anything.
  [[nodiscard]] std::optional<PixelRect> areaOf(const SnapshotLight& light, const SnapshotNode& node) const {
    const View& view = snapshot_.view;
    const PixelRect all{{0, 0}, {view.size.width, view.size.height}};
    const Box receivers = behind(light, node);
    if (receivers.empty() || node.boundsWorld.empty()) return std::nullopt;
    if (!isFinite(receivers) || !isFinite(node.boundsWorld)) return all;
    const auto corners = cornersOf(node.boundsWorld), ends = cornersOf(receivers);
    const std::optional<PixelRect> seen = casters_.pixelsAround(ends);
    if (!seen) return std::nullopt;
    // Away from the light, and how many times as far there may be anything.
    std::array<Vec3, 8> ways;
    double most = 0;
    const Vec3 at(light.positionWorld);
    if (light.directional()) {
      double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
      for (const Vec3& corner : corners) nearest = std::min(nearest, -glm::dot(at, corner));
      for (const Vec3& end : ends) farthest = std::max(farthest, -glm::dot(at, end));
      ways.fill(-at);
      most = farthest - nearest;
    } else {
      const double nearest = distanceTo(node.boundsWorld, at);
      double farthest = 0;
      for (const Vec3& end : ends) farthest = std::max(farthest, glm::distance(at, end));
      if (farthest > nearest && !(nearest > 1e-6 * farthest)) return seen;
      for (std::size_t i = 0; i < ways.size(); ++i) ways[i] = corners[i] - at;
      most = farthest / nearest - 1;
    }
    if (!(most > 0)) return std::nullopt;
    std::array<double, 8> lengths;
    lengths.fill(most);
    shorten(corners, ways, receivers, lengths);
    std::vector<Vec3> hull(corners.begin(), corners.end());
    for (std::size_t i = 0; i < ways.size(); ++i) hull.push_back(corners[i] + ways[i] * lengths[i]);
    const std::optional<PixelRect> hidden = casters_.pixelsAround(hull);
    if (!hidden) return std::nullopt;
    const PixelRect both = overlap(*seen, *hidden);
    return both.low.x < both.high.x && both.low.y < both.high.y ? std::optional(both) : std::nullopt;
  }

  const Snapshot& snapshot_;
  const DrawOptions& options_;
  Geometry& geometry_;
  MaterialList& materials_;
  DrawList& list_;
  CasterList casters_;
  struct Closed {
    shared::ClosedCaster data;
    std::uint32_t kind = 0;
    PixelRect area;
  };
  std::vector<Closed> closed_;   // of the light whose casters are listed
  LightGroup* group_ = nullptr;  // of the light whose casters are listed
  std::vector<const SnapshotNode*> seen_;
  Box receivers_;  ///< of these
  bool gated_ = true;
  double offPx_ = kExactTolerancePx;
  double pointRounding_ = 0;  ///< how far from their surfaces points are that light falls on; metres
};

}  // namespace

namespace {

bool hasTransparentCaster(const Snapshot& snapshot, const SnapshotLight& light) {
  return std::ranges::any_of(light.casters, [&](NodeId caster) {
    const SnapshotNode* node = nodeOf(snapshot, caster);
    return node && snapshot.materials[node->material.index].letsLightThrough();
  });
}

}  // namespace

bool transmits(const Snapshot& snapshot, const SnapshotLight& light) {
  return light.map || hasTransparentCaster(snapshot, light);
}

bool hasClosedForms(const Snapshot& snapshot, const DrawOptions& options) {
  if (options.shadows != ShadowKinds::All) return options.shadows == ShadowKinds::ClosedForms;
  const auto shaded = std::ranges::count_if(
      snapshot.lights, [](const SnapshotLight& light) { return light.shade.has_value(); });
  return shaded > 0 && shaded <= shared::kMaxLights &&
         std::ranges::none_of(snapshot.nodes, [&](const SnapshotNode& node) {
           return snapshot.materials[node.material.index].shadingIn(options.shading) == Shading::Gouraud;
         });
}

bool asksCasters(const SnapshotLight& light, bool closedForms) {
  return light.hasShadow() && !(closedForms && light.shade);
}

bool findsShadows(const Snapshot& snapshot, const DrawOptions& options) {
  if (options.shadows != ShadowKinds::All || options.output != Output::Color || showsData(options.shading))
    return false;
  const bool closedForms = hasClosedForms(snapshot, options);
  return std::ranges::any_of(snapshot.lights,
                             [&](const SnapshotLight& light) { return asksCasters(light, closedForms); });
}

void listShadows(const Snapshot& snapshot, const VisibleList& visible, const DrawOptions& options,
                 Geometry& geometry, MaterialList& materials, DrawList& list) {
  if (list.groups.empty() || !materials.shadows()) return;
  const bool closedForms = hasClosedForms(snapshot, options);
  ShadowLister lister(snapshot, visible, options, geometry, materials, list);
  for (std::size_t i = 0; i < list.groups.size(); ++i) {
    LightGroup& group = list.groups[i];
    const std::vector<std::uint32_t>& lights = materials.lightsOf(i);
    const auto casts = [&](std::uint32_t light) { return asksCasters(snapshot.lights[light], closedForms); };
    if (std::ranges::none_of(lights, casts)) continue;
    // Whether rays tell of its shadow.
    const auto isFound = [&](std::uint32_t light) {
      return casts(light) &&
             (!snapshot.lights[light].map || hasTransparentCaster(snapshot, snapshot.lights[light]));
    };
    const bool finds = std::ranges::any_of(lights, isFound);
    for (std::uint32_t bit = 0; bit < lights.size(); ++bit) {
      if (finds) group.lights.push_back(isFound(lights[bit]) ? std::optional(lights[bit]) : std::nullopt);
      if (casts(lights[bit])) lister.list(group, bit, lights[bit]);
    }
    group.transmits = std::ranges::any_of(
        lights, [&](std::uint32_t light) { return transmits(snapshot, snapshot.lights[light]); });
    for (DrawState& shade : group.shades) {
      shade.shadows = true;
      shade.transmits = group.transmits;
    }
    for (DrawState& shade : group.layerShades) shade.transmits = group.transmits;
    std::uint32_t exact = 0;
    for (std::uint32_t bit = 0; bit < lights.size(); ++bit)
      if (const SnapshotLight& light = snapshot.lights[lights[bit]];
          casts(lights[bit]) && !light.approximate())
        exact |= 1U << bit;
    for (auto* batches : {&group.again, &group.layerAgain})
      for (DrawBatch& batch : *batches) {
        batch.state.transmits = group.transmits;
        batch.state.exactShadows = batch.state.shading == Shading::Gouraud ? exact : 0;
      }
  }
}

}  // namespace luxo
