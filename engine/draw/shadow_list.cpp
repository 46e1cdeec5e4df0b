// SPDX-License-Identifier: Apache-2.0
#include "draw/shadow_list.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "draw/exact_data.h"
#include "math/transform.h"
#include "surface/spread.h"

namespace luxo {
namespace {

/// Of the distances involved: what a dozen operations of single precision round away.
constexpr double kRounding = 0x1p-21;
/// The sine of a light's height over a plane below which floats do not tell its side.
constexpr double kInPlane = 1e-4;
/// What is nearer to a light than that part of the light's height over a plane has its flattened mesh spread
/// by no more than the inverse, as far as tolerances go.
constexpr double kNearLight = 1.0 / 16;

std::array<Vec3, 8> cornersOf(const Box& box) {
  std::array<Vec3, 8> corners;
  for (int i = 0; i < 8; ++i)
    corners[static_cast<std::size_t>(i)] = {(i & 1 ? box.max : box.min).x, (i & 2 ? box.max : box.min).y,
                                            (i & 4 ? box.max : box.min).z};
  return corners;
}

double distanceTo(const Box& box, const Vec3& p) { return glm::distance(p, glm::clamp(p, box.min, box.max)); }

/// Patches whose points the same code finds, and the parameters of each.
struct Part {
  SurfaceCodePtr code;
  std::vector<std::uint32_t> patches;
  std::vector<std::vector<double>> parameters;
};

/// By their general form, where they have one: surfaces of one name share it.
std::vector<Part> partsOf(SurfaceCodes& codes, const SnapshotNode& node) {
  std::vector<Part> parts;
  for (std::uint32_t i = 0; i < node.surface.patchCount(); ++i) {
    const Patch& patch = node.surface.patches()[i];
    const PatchInputs inputs(patch, node.parameters);
    const std::span<const double> own = inputs;
    std::vector<double> parameters = patch.general ? patch.general->inputs(patch.constants, node.parameters)
                                                   : std::vector<double>(own.begin(), own.end());
    const SurfaceCodePtr code = patch.general ? codes.get(patch.general, parameters.size())
                                              : codes.get(patch.function, parameters.size());
    auto part = std::ranges::find(parts, code, &Part::code);
    if (part == parts.end()) part = parts.insert(parts.end(), {code, {}, {}});
    part->patches.push_back(i);
    part->parameters.push_back(std::move(parameters));
  }
  return parts;
}

class ShadowLister {
 public:
  ShadowLister(const Snapshot& snapshot, const VisibleList& visible, const DrawOptions& options,
               Geometry& geometry, const MaterialList& materials, DrawList& list)
      : snapshot_(snapshot),
        options_(options),
        geometry_(geometry),
        materials_(materials),
        list_(list),
        shadows_(list.shadows) {
    for (const VisibleNode& node : visible.opaque) receivers_.add(snapshot.nodes[node.node].boundsWorld);
    gated_ = std::ranges::none_of(snapshot.materials, &Material::lectureSpecular);
    for (const DrawBatch& batch : list.opaque)
      if (batch.mesh && batch.state.form != Form::Fused)
        offPx_ = std::max(offPx_, options.tolerancePx * (options.standIns ? kStandInTolerance : 1));
  }

  void list(LightGroup& group, std::uint32_t bit, std::uint32_t light) {
    group_ = &group;
    for (const NodeId caster : snapshot_.lights[light].casters) {
      const auto node = std::ranges::lower_bound(snapshot_.nodes, caster.index, {},
                                                 [](const SnapshotNode& n) { return n.id.index; });
      if (node == snapshot_.nodes.end() || node->id != caster) continue;
      if (snapshot_.lights[light].plane)
        flatten(bit, snapshot_.lights[light], *node);
      else
        list(bit, snapshot_.lights[light], *node);
    }
  }

 private:
  /// The caster's mesh becomes the shadow on the light's plane, by the projection from the light: with the
  /// plane p . x = 0 and the light l, both of four components, x - (p . x) / (p . l) l (J. Blinn, Me and my
  /// (fake) shadow, 1988).
  void flatten(std::uint32_t bit, const SnapshotLight& light, const SnapshotNode& node) {
    const auto plane = std::ranges::find(snapshot_.nodes, *light.plane, &SnapshotNode::id);
    if (plane == snapshot_.nodes.end() || plane->id == node.id) return;  // what is hidden receives nothing
    const std::uint32_t receiver =
        materials_.numberOfNode(static_cast<std::uint32_t>(&*plane - snapshot_.nodes.data()));
    if (receiver == shared::kMaxFoundMaterials) return;  // nothing of it is in the picture
    const View& view = snapshot_.view;
    const Domain& domain = plane->surface.domain();
    const Vec3 at =
        transformPoint(plane->worldFromObject,
                       plane->surface.position(domain.u.lo + 0.5 * domain.u.width(),
                                               domain.v.lo + 0.5 * domain.v.width(), plane->parameters)) -
        list_.origin;
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
    group_->flatShadows.push_back(
        {.mesh = mesh,
         .shadow = {
             .clipFromObject = Mat4f(Mat4(list_.view.clipFromRelative) * flattened * relativeFromObject),
             .height = Vec4f(heights * relativeFromObject),
             .highest = light.directional() ? std::numeric_limits<float>::max() : 1,
             .light = bit,
             .receiver = receiver}});
  }

  void list(std::uint32_t bit, const SnapshotLight& light, const SnapshotNode& node) {
    const std::optional<PixelRect> area = areaOf(light, node);
    if (!area) return;
    const Mat3& linear = node.worldFromObject.linear;
    const Mat3 inverse = glm::inverse(linear);
    bool found =
        isFinite(node.boundsObject) && isFinite(inverse[0]) && isFinite(inverse[1]) && isFinite(inverse[2]);
    if (found)
      for (const Part& part : partsOf(geometry_.codes, node))
        found &= add(bit, light, node, inverse, part, *area);
    if (!found) list_.byRays.push_back(*area);
  }

  /// Whether a shader can find it.
  bool add(std::uint32_t bit, const SnapshotLight& light, const SnapshotNode& node, const Mat3& inverse,
           const Part& part, const PixelRect& area) {
    if (part.code->isTooLarge()) return false;
    const auto cells = geometry_.casters.cells(node.surface, node.parameters, part.patches);
    if (cells->cells.empty()) return true;
    if (!cells->finite()) return false;
    const Vec3 toLight = Vec3(light.positionWorld) - light.positionWorld.w * node.worldFromObject.translation;
    const Vec4 lightObject(inverse * toLight, light.positionWorld.w);
    const auto grid = geometry_.casters.grid(node.surface, node.parameters, part.patches, lightObject,
                                             options_.shadowGridSize);

    // Normals that turn toward the viewer may face a light from inside.
    const bool turns = snapshot_.materials[node.material.index].twoSided == TwoSided::Yes;
    const Mat3& linear = node.worldFromObject.linear;
    const Vec3 origin = inverse * (list_.origin - node.worldFromObject.translation);
    const Vec3 farthest = glm::max(glm::abs(cells->bounds.min), glm::abs(cells->bounds.max));
    shared::ShadowCaster caster{
        .gridFromRelative = Mat3f(grid->axes * inverse),
        .gridOrigin = Vec3f(grid->axes * (origin - grid->light)),
        .objectFromRelative = Mat3f(inverse),
        .objectOrigin = Vec3f(origin),
        .lightObject = Vec4f(lightObject),
        .lightRelative = Vec4f(Vec3f(Vec3(light.positionWorld) - light.positionWorld.w * list_.origin),
                               light.positionWorld.w),
        .gridSize = static_cast<std::uint32_t>(grid->size),
        .firstEntry = static_cast<std::uint32_t>(shadows_.gridEntries.size()),
        .firstCell = static_cast<std::uint32_t>(shadows_.cells.size()),
        .firstParameter = static_cast<std::uint32_t>(shadows_.parameters.size()),
        .parameters = static_cast<std::uint32_t>(part.parameters[0].size()),
        .light = bit,
        .flags = (light.directional() ? shared::kParallelLight : 0) | (gated_ ? shared::kGatedLight : 0) |
                 (cells->convex && !turns ? shared::kConvexCaster : 0) |
                 (part.patches.size() == node.surface.patchCount() ? shared::kWholeCaster : 0),
        .rounding = static_cast<float>(kRounding * (glm::length(origin) + glm::length(farthest))),
        .roundingPerMetre = static_cast<float>(kRounding * largestStretch(inverse)),
        .margin = static_cast<float>(kGridMargin * cells->size),
        .pixel = static_cast<float>(1 / (snapshot_.view.pixelsPerUnit * largestStretch(linear))),
        .offPixels = static_cast<float>(offPx_),
        .material = materials_.numberOfNode(static_cast<std::uint32_t>(&node - snapshot_.nodes.data()))};
    if (cells->flatNormal) setPlane(light, node, *cells, caster);
    const auto firstStart = static_cast<std::uint32_t>(shadows_.gridStarts.size());
    for (std::size_t i = 0; i < grid->faces.size(); ++i) {
      const LightGrid::Face& face = grid->faces[i];
      caster.faces[i] = Vec4f(Vec4(face.low, face.texels));
      caster.firstTexel[i] = firstStart + face.first;
    }
    shadows_.gridStarts.insert(shadows_.gridStarts.end(), grid->starts.begin(), grid->starts.end());
    for (const LightGrid::Entry& entry : grid->entries)
      shadows_.gridEntries.push_back({entry.cell, entry.nearest});
    addCells(*cells, node.surface, part);
    for (const std::vector<double>& parameters : part.parameters)
      shadows_.parameters.insert(shadows_.parameters.end(), parameters.begin(), parameters.end());
    group_->shadows.push_back({.state = {.form = Form::Shadow, .surface = part.code},
                               .caster = static_cast<std::uint32_t>(shadows_.casters.size()),
                               .area = area});
    shadows_.casters.push_back(caster);
    return true;
  }

  /// Not where the light is in the plane, or nearly.
  void setPlane(const SnapshotLight& light, const SnapshotNode& node, const CasterCells& cells,
                shared::ShadowCaster& caster) const {
    const Vec3 normal = unit(normalMatrix(node.worldFromObject.linear) * *cells.flatNormal);
    const Vec3 at = transformPoint(node.worldFromObject, cells.cells[0].middle);
    const Vec3 toLight = Vec3(light.positionWorld) - light.positionWorld.w * at;
    const double side = glm::dot(normal, toLight);
    if (!(std::abs(side) > kInPlane * glm::length(toLight))) return;
    const Vec3 towardLight = side > 0 ? normal : -normal;
    caster.plane = Vec4f(Vec4(towardLight, -glm::dot(towardLight, at - list_.origin)));
    caster.flags |= shared::kFlatCaster;
  }

  void addCells(const CasterCells& cells, const Surface& surface, const Part& part) {
    for (const CasterCell& cell : cells.cells) {
      const auto patch = std::ranges::find(part.patches, cell.patch) - part.patches.begin();
      const double hu = 0.5 * cell.domain.u.width(), hv = 0.5 * cell.domain.v.width();
      const Patch& of = surface.patches()[cell.patch];
      const double originOfU = of.general ? 0 : of.originOfU();
      const Vec3f bend = cell.proven() ? Vec3f(cell.uu, cell.uv, cell.vv) * kUp : Vec3f(-1);
      shadows_.cells.push_back({.middle = Vec2f(cell.domain.u.lo - originOfU + hu, cell.domain.v.lo + hv),
                                .half_ = Vec2f(hu, hv) * kUp,
                                .bend = bend,
                                .patch_ = static_cast<std::uint32_t>(patch)});
    }
  }

  /// Pixels in which the caster may stand between the light and what is seen: those of all that lies behind
  /// it, as far as there is anything.
  [[nodiscard]] std::optional<PixelRect> areaOf(const SnapshotLight& light, const SnapshotNode& node) const {
    const View& view = snapshot_.view;
    const PixelRect all{{0, 0}, {view.size.width, view.size.height}};
    if (receivers_.empty() || node.boundsWorld.empty()) return std::nullopt;
    if (!isFinite(receivers_) || !isFinite(node.boundsWorld)) return all;
    std::vector<Vec3> hull;
    const auto corners = cornersOf(node.boundsWorld), ends = cornersOf(receivers_);
    const Vec3 at(light.positionWorld);
    if (light.directional()) {
      double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
      for (const Vec3& corner : corners) nearest = std::min(nearest, -glm::dot(at, corner));
      for (const Vec3& end : ends) farthest = std::max(farthest, -glm::dot(at, end));
      if (farthest <= nearest) return std::nullopt;
      for (const Vec3& corner : corners)
        hull.insert(hull.end(), {corner, corner - at * (farthest - nearest)});
    } else {
      const double nearest = distanceTo(node.boundsWorld, at);
      double farthest = 0;
      for (const Vec3& end : ends) farthest = std::max(farthest, glm::distance(at, end));
      if (farthest <= nearest) return std::nullopt;
      if (!(nearest > 1e-6 * farthest)) return all;
      for (const Vec3& corner : corners)
        hull.insert(hull.end(), {corner, at + (corner - at) * (farthest / nearest)});
    }
    return pixelsAround(hull, all);
  }

  [[nodiscard]] std::optional<PixelRect> pixelsAround(std::span<const Vec3> hull,
                                                      const PixelRect& all) const {
    const View& view = snapshot_.view;
    const PixelRows rows = pixelRows(view, {});
    const Vec2 middle(0.5 * view.size.width, 0.5 * view.size.height);
    Vec2 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const Vec3& p : hull) {
      const double depth = glm::dot(rows.depth, Vec4(p, 1)), width = view.perspective() ? depth : 1;
      if (view.perspective() && !(depth > view.near)) return all;
      const Vec2 pixel = middle + Vec2(glm::dot(rows.x, Vec4(p, 1)), glm::dot(rows.y, Vec4(p, 1))) / width;
      low = glm::min(low, pixel - 1.0);
      high = glm::max(high, pixel + 1.0);
    }
    const auto within = [](double x, int most) {
      return static_cast<std::int32_t>(std::clamp(x, 0.0, 1.0 * most));
    };
    const PixelRect rect{{within(std::floor(low.x), all.high.x), within(std::floor(low.y), all.high.y)},
                         {within(std::ceil(high.x), all.high.x), within(std::ceil(high.y), all.high.y)}};
    if (rect.low.x >= rect.high.x || rect.low.y >= rect.high.y) return std::nullopt;
    return rect;
  }

  static constexpr float kUp = 1 + 0x1p-22F;  ///< a float that is rounded down is no bound

  const Snapshot& snapshot_;
  const DrawOptions& options_;
  Geometry& geometry_;
  const MaterialList& materials_;
  DrawList& list_;
  Shadows& shadows_;
  LightGroup* group_ = nullptr;  // of the light whose casters are listed
  Box receivers_;
  bool gated_ = true;
  double offPx_ = kExactTolerancePx;
};

}  // namespace

bool findsShadows(const Snapshot& snapshot, const DrawOptions& options) {
  return options.shadows == ShadowKinds::All && options.output == Output::Color &&
         std::ranges::any_of(snapshot.lights,
                             [](const SnapshotLight& light) { return !light.casters.empty(); });
}

void listShadows(const Snapshot& snapshot, const VisibleList& visible, const DrawOptions& options,
                 Geometry& geometry, const MaterialList& materials, DrawList& list) {
  if (!list.deferred || list.groups[0].shades.empty() || !materials.shadows()) return;
  ShadowLister lister(snapshot, visible, options, geometry, materials, list);
  for (std::size_t i = 0; i < list.groups.size(); ++i) {
    LightGroup& group = list.groups[i];
    const std::vector<std::uint32_t>& lights = materials.lightsOf(i);
    const auto casts = [&](std::uint32_t light) { return !snapshot.lights[light].casters.empty(); };
    if (std::ranges::none_of(lights, casts)) continue;
    for (std::uint32_t bit = 0; bit < lights.size(); ++bit) {
      group.lights.push_back(casts(lights[bit]) ? std::optional(lights[bit]) : std::nullopt);
      if (casts(lights[bit])) lister.list(group, bit, lights[bit]);
    }
    for (DrawState& shade : group.shades) shade.shadows = true;
  }
}

}  // namespace luxo
