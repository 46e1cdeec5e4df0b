// SPDX-License-Identifier: Apache-2.0
#include "draw/draw_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include "base/error.h"
#include "draw/caster_list.h"
#include "draw/clipped_mesh.h"
#include "draw/cluster_draws.h"
#include "draw/instance_data.h"
#include "draw/light_sets.h"
#include "draw/material_list.h"
#include "draw/place_list.h"
#include "draw/shadow_list.h"
#include "draw/shell_list.h"
#include "draw/triangle_precision.h"
#include "math/transform.h"

namespace luxo {
namespace {

// Light that is interpolated between vertices needs vertices where light changes, also on flat surfaces. An
// outline is as wide as the slope of what is interpolated says, which long facets of a cone get wrong.
constexpr double kVertexSpacingPx = 12;

// Of triangles that cover as few pixels, as their boxes have them, fragments read from buffers what others
// are given by vertices: a million takes lavapipe 0.6 of the time at 0.4 pixels each, 0.7 at 2.4, 0.85 at 7.
constexpr std::uint64_t kSmallTrianglePx = 8;
/// Of fewer a frame saves less than 2 ms, and their pipeline takes some 50 to make.
constexpr std::uint64_t kManyTriangles = 1U << 15U;

/// Of a pixel in the middle of the picture: searches for what is seen through leave to rays where single
/// precision rounds away more than some thousandths of that (kMaxRounding in shaders/lib/cell_ray.glsl).
/// Where rays are slanted, toward the corners, what they are off by is longer on the screen, by as much as
/// they are longer than the axis. Outputs of geometry tell these points, which a thousandth of a pixel is the
/// most for (kPointPx): rounding and what Newton's method leaves of it are as much each.
float partOfPixel(const View& view, const DrawOptions& options) {
  constexpr double kOfGeometry = 1.0 / 10;
  const double longest = view.perspective() ? std::sqrt(1 + glm::dot(view.halfExtent, view.halfExtent)) : 1;
  return static_cast<float>((showsGeometry(options.output) ? kOfGeometry : 1) / longest);
}

bool needsLights(const DrawState& state) {
  return state.output == Output::Color &&
         (state.shading == Shading::Flat || state.shading == Shading::Gouraud ||
          state.shading == Shading::Phong || state.shading == Shading::Exact ||
          state.shading == Shading::Toon);
}

MeshDesc meshDescOf(const SnapshotNode& node, const VisibleNode& visible, Shading shading, const View& view) {
  MeshDesc desc{.uniform = node.segments, .tolerance = visible.toleranceObject};
  if (shading == Shading::Gouraud || (shading == Shading::Toon && !node.surface.flatNormal()))
    desc.longestEdge =
        std::max(kLeastSpacing, kVertexSpacingPx * (view.perspective() ? visible.nearestDepth : 1) /
                                    (visible.stretch * visible.pixelsPerUnit));
  return desc;
}

/// Whether front faces hide all back faces.
bool hidesBackFaces(const VisibleNode& visible, const SnapshotNode& node, MeshCache& meshes) {
  return visible.closedFromOutside && meshes.boundsSolid(node.surface, node.parameters);
}

/// Back faces are not drawn where the material says so, or front faces hide them.
FaceCulling cullingOf(const VisibleNode& visible, const SnapshotNode& node, const DrawOptions& options,
                      MeshCache& meshes) {
  return options.cullBackFaces && (visible.hideBackFaces || hidesBackFaces(visible, node, meshes))
             ? FaceCulling::Back
             : FaceCulling::None;
}

/// Turns visible nodes into draws.
class DrawLister {
 public:
  DrawLister(const Snapshot& snapshot, const VisibleList& visible, const DrawOptions& options,
             Geometry& geometry)
      : snapshot_(snapshot),
        visible_(visible),
        options_(options),
        geometry_(geometry),
        list_{.origin = shadingOrigin(snapshot)},
        lightSets_(snapshot, options, list_.origin, list_.lightSets),
        materials_(snapshot, visible, options, list_),
        shells_(snapshot, options, geometry, list_),
        casters_(snapshot, geometry, list_) {
    list_.view = viewData(snapshot, visible, list_.origin);
  }

  DrawList list() && {
    listOpaque();
    listLayers();
    std::ranges::stable_sort(list_.opaque, {}, placeInOrder);
    std::ranges::sort(list_.found, {}, &FoundNode::node);
    dropClusters(list_, snapshot_, solids_, options_, geometry_.meshes);
    for (auto* batches : {&list_.opaque, &list_.layers.meshes})
      for (DrawBatch& batch : *batches) batch.state.smallTriangles = hasSmallTriangles(batch);
    materials_.listShades();
    listPlaces(snapshot_, visible_, options_, geometry_, materials_, list_);
    listShadows(snapshot_, visible_, options_, geometry_, materials_, list_);
    shells_.listOutlines();
    list_.culledHidden = list_.clusters.culledHidden;
    if (options_.skips.hidden)
      list_.culledHidden += geometry_.hidden.drop(list_, snapshot_, options_.samples);
    shells_.placeSharedIndices();
    if (list_.looksForCasters()) requireTexels(list_.textures);  // something to bind
    return std::move(list_);
  }

 private:
  struct Instance {
    shared::InstanceData data;
    shared::ExactInstance exact;
    std::uint32_t node;
  };

  /// The draws of one node, and its instance.
  struct Item {
    std::vector<DrawBatch> batches;
    Instance instance;
    std::optional<DrawState> found;  ///< of a point that a ray has found; nothing of a mesh
    std::uint32_t lightSet = 0;
  };

  /// What instances must have in common to be drawn at once.
  static auto kindOf(const DrawBatch& b) {
    return std::tuple(b.state, b.again, b.mesh.get(), b.shell.get(), b.shared, b.firstIndex, b.culling,
                      b.bothSides, b.mirrored, b.lightSet);
  }

  /// What is lit later comes first, and of that what finds surfaces, then what finds surfaces. What hides
  /// lines comes before all lines, and after all that it must not hide.
  static int placeInOrder(const DrawBatch& batch) {
    if (batch.state.form != Form::Fused) return batch.shell ? -3 : batch.state.isSurface ? -2 : -1;
    if (batch.finds()) return 0;
    if (batch.state.hidesLines) return 2;
    return batch.state.shading == Shading::Wireframe ? 3 : 1;
  }

  /// Every node joins the first draw of its kind, so that draws stay roughly front to back.
  void listOpaque() {
    struct Group {
      DrawBatch batch;
      std::vector<Instance> instances;
    };
    std::vector<Group> groups;
    std::map<decltype(kindOf(std::declval<DrawBatch>())), std::size_t> groupOf;
    for (const VisibleNode& v : visible_.opaque) {
      Item item = itemOf(v, false);
      if (item.found) list_.found.push_back({v.node, item.lightSet, *item.found, item.instance.data});
      for (DrawBatch& batch : item.batches) {
        const auto [entry, isNew] = groupOf.try_emplace(kindOf(batch), groups.size());
        if (isNew) groups.push_back({std::move(batch), {}});
        groups[entry->second].instances.push_back(item.instance);
      }
    }
    for (Group& group : groups) append(list_.opaque, std::move(group.batch), group.instances);
  }

  /// Points in any order: by the numbers of their materials, which follow the nodes', they may be blended in
  /// the given one.
  void listLayers() {
    const bool isColor = options_.output == Output::Color;
    list_.layers.blend = {.output = options_.output,
                          .form = Form::BlendLayers,
                          .givenOrder = isColor && snapshot_.blendOrder == BlendOrder::Given};
    std::vector<VisibleNode> wires;
    for (const VisibleNode& v : visible_.transparent) {
      const SnapshotNode& node = snapshot_.nodes[v.node];
      const Material& material = snapshot_.materials[node.material.index];
      const Shading shading = material.shadingIn(options_.shading);
      if (shading == Shading::Wireframe)
        wires.push_back(v);
      else if (findsLayers(snapshot_, node, options_) && !node.surface.isPolygonal())
        findLayers(v, node, material);
      else
        listLayerMesh(v, node, material, !isColor || shading == Shading::Exact ? Shading::Phong : shading);
    }
    std::ranges::sort(list_.layers.found, {}, &FoundLayer::node);
    listTransparent(wires);
  }

  /// Of all that a ray meets the eye's grid says where it may be.
  void findLayers(const VisibleNode& v, const SnapshotNode& node, const Material& material) {
    DrawBatch batch{.state = {.shading = Shading::Exact, .pattern = Paint::of(material)}};
    const LightSets::Choice lights = materials_.lightLayer(batch, lightSets_, node);
    const std::uint32_t number = materials_.numberOf(node.material.index, lights.shadeOf, v.node);
    requireNumber(number);
    list_.layers.found.push_back({v.node, number});
    const View& view = snapshot_.view;
    const PixelRect all{{0, 0}, {view.size.width, view.size.height}};
    const auto area = isFinite(node.boundsWorld) ? casters_.pixelsAround(cornersOf(node.boundsWorld)) : all;
    if (!area) return;
    const Vec4 eye = view.perspective() ? Vec4(view.eye, 1) : Vec4(-view.forward(), 0);
    const CasterCode found = casterCode(geometry_.codes, node.surface, node.parameters);
    auto entry = casters_.entryOf(node, found, eye, options_.layerGridSize);
    if (!entry) list_.byRays.push_back(*area);
    if (!entry || !entry->caster) return;
    entry->caster->material = number;
    entry->caster->pixel *= partOfPixel(view, options_);
    entry->caster->flags |=
        (v.twoSided ? shared::kTurnsNormal : 0) | (v.hideBackFaces ? shared::kShowsFront : 0);
    list_.layers.searches.push_back(
        {.state = {.form = Form::Layer, .details = list_.layers.details, .surface = found.code},
         .caster = casters_.add(*entry->caster),
         .area = *area});
  }

  void listLayerMesh(const VisibleNode& v, const SnapshotNode& node, const Material& material,
                     Shading shading) {
    DrawBatch batch;
    batch.state = {.shading = shading, .pattern = Paint::of(material)};
    batch.culling = v.hideBackFaces ? FaceCulling::Back : FaceCulling::None;
    batch.twoSided = v.twoSided;
    batch.mirrored = v.mirrored;
    const LightSets::Choice lights = materials_.lightLayer(batch, lightSets_, node);
    if (batch.again && node.surface.isPolygonal()) batch.again->tangents = readsTangents(*batch.again);
    batch.lightSet = lights.index;
    batch.state.plainLights = lights.plain;
    batch.state.shadedLights = lights.shaded;
    batch.state.spots = lights.spots;
    batch.state.details = list_.layers.details;
    batch.state.tangents = batch.state.details && node.surface.isPolygonal();
    batch.flat = node.surface.flatNormal().has_value();
    batch.state.isSurface = findsLayers(snapshot_, node, options_);
    Item item{.lightSet = lights.index};
    item.instance.node = v.node;
    const Vec3 origin = addMesh(item, batch, node, v, meshDescOf(node, v, shading, snapshot_.view));
    item.instance.data = instanceData(snapshot_, node, v, list_.origin, origin, true);
    item.instance.data.material = materials_.numberOf(node.material.index, lights.shadeOf, v.node);
    requireNumber(item.instance.data.material);
    if (batch.state.isSurface) {
      item.instance.data.flags |= shared::kIsSurface;
      list_.layers.found.push_back({v.node, item.instance.data.material});
      appendBlurred(snapshot_.view, node, v, list_.origin, origin, list_.byRays);
    }
    for (DrawBatch& drawn : item.batches) {
      if (drawn.indexCount == 0) continue;
      drawn.firstInstance = static_cast<std::uint32_t>(list_.instances.size());
      drawn.instanceCount = 1;
      place(item.instance);
      list_.layers.meshes.push_back(std::move(drawn));
    }
  }

  static void requireNumber(std::uint32_t material) {
    if (material >= shared::kMaxFoundMaterials)
      throw Error(ErrorKind::Scene,
                  fmt::format("more than {} nodes are seen through", shared::kMaxFoundMaterials),
                  "make some of them opaque");
  }

  /// Lines over all else. Order is everything, so only neighbours merge.
  void listTransparent(std::span<const VisibleNode> nodes) {
    for (const VisibleNode& v : nodes) {
      Item item = itemOf(v, true);
      for (DrawBatch& batch : item.batches) {
        if (!list_.transparent.empty() && kindOf(list_.transparent.back()) == kindOf(batch)) {
          place(item.instance);
          ++list_.transparent.back().instanceCount;
        } else {
          append(list_.transparent, std::move(batch), {&item.instance, 1});
        }
      }
    }
  }

  /// Light between vertices knows nothing of maps of normals.
  static bool readsTangents(const DrawState& state) {
    return state.pattern.readsFrame() && state.shading != Shading::Gouraud;
  }

  Item itemOf(const VisibleNode& v, bool blended) {
    const SnapshotNode& node = snapshot_.nodes[v.node];
    const Shading shading = snapshot_.materials[node.material.index].shadingIn(options_.shading);
    DrawBatch batch;
    batch.state = {.shading = shading, .output = options_.output, .blended = blended};
    chooseFaces(batch, v, node);
    const LightSets::Choice lights = chooseLights(batch, v, node);
    if (node.surface.isPolygonal()) {
      if (options_.skips.hidden && hidesBackFaces(v, node, geometry_.meshes)) solids_.push_back(v.node);
      batch.state.tangents = batch.state.frame || readsTangents(batch.state);
      if (batch.again) batch.again->tangents = readsTangents(*batch.again);
    }
    Item item{.lightSet = lights.index};
    item.instance.node = v.node;
    const Vec3 origin = addGeometry(item, batch, node, v, shading);
    item.instance.data = instanceData(snapshot_, node, v, list_.origin, origin, batch.bothSides);
    item.instance.data.material = materials_.numberOf(node.material.index, lights.shadeOf, v.node);
    return item;
  }

  void chooseFaces(DrawBatch& batch, const VisibleNode& v, const SnapshotNode& node) {
    batch.culling = cullingOf(v, node, options_, geometry_.meshes);
    batch.bothSides = batch.culling == FaceCulling::None;
    batch.flat = node.surface.flatNormal().has_value();
    batch.frontOnly =
        !batch.bothSides && !batch.flat && v.hideBackFaces && !hidesBackFaces(v, node, geometry_.meshes);
    batch.twoSided = v.twoSided;
    batch.mirrored = v.mirrored;
  }

  LightSets::Choice chooseLights(DrawBatch& batch, const VisibleNode& v, const SnapshotNode& node) {
    LightSets::Choice lights;
    if (needsLights(batch.state)) {
      batch.state.pattern = Paint::of(snapshot_.materials[node.material.index]);
      if (materials_.shadows() && !materials_.litLater(batch.state)) refuseShadows(node);
      const auto reaching = std::span(visible_.lights).subspan(v.firstLight, v.lightCount);
      lights = materials_.litLater(batch.state) ? materials_.lightLater(batch, lightSets_, node)
                                                : lightSets_.choose(reaching, node);
    }
    batch.lightSet = lights.index;
    batch.state.plainLights = lights.plain;
    batch.state.shadedLights = lights.shaded;
    batch.state.spots = lights.spots;
    return lights;
  }

  /// A shell, or the mesh that stands in for it, triangles or a mesh. From where its vertices are told.
  /// `shading`: the material's, whatever the state has of it in this pass.
  Vec3 addGeometry(Item& item, DrawBatch& batch, const SnapshotNode& node, const VisibleNode& v,
                   Shading shading) {
    if (!findsSurface(snapshot_, node, options_))
      return addMesh(item, batch, node, v, meshDescOf(node, v, shading, snapshot_.view));
    item.found = batch.state;
    item.found->byRays = true;
    item.found->tangents = false;
    if (shading == Shading::Exact) item.found->shading = Shading::Phong;
    if (node.surface.isPolygonal()) return addTriangles(item, batch, node, v);
    if (auto shell = shells_.add(batch, node, v)) {
      item.batches = std::move(shell->batches);
      item.instance.exact = shell->exact;
      return shell->origin;
    }
    if (!options_.standIns || shading != Shading::Exact) return Vec3(0);
    batch.state.shading = Shading::Phong;
    if (list_.findsPlaces) batch.state.form = Form::FoundWithParameters;
    MeshDesc desc = meshDescOf(node, v, Shading::Phong, snapshot_.view);
    desc.tolerance *= kStandInTolerance;
    return addMesh(item, batch, node, v, desc);
  }

  /// Shadows are found for points that are lit later.
  [[noreturn]] static void refuseShadows(const SnapshotNode& node) {
    throw Error(ErrorKind::Scene,
                fmt::format("node number {} is in shadow, in a scene of more than {} nodes, which is not "
                            "supported yet",
                            node.number, shared::kMaxFoundMaterials - 1),
                "set the lights' shadows to \"none\", or leave out some nodes");
  }

  /// Triangles that are the surface itself; where single precision would move them in the picture, rays find
  /// it. Returns the origin of their vertices.
  Vec3 addTriangles(Item& item, DrawBatch batch, const SnapshotNode& node, const VisibleNode& v) {
    if (batch.state.shading == Shading::Exact) batch.state.shading = Shading::Phong;
    batch.state.isSurface = true;
    const Vec3 origin = addMesh(item, batch, node, v, {});
    appendBlurred(snapshot_.view, node, v, list_.origin, origin, list_.byRays);
    return origin;
  }

  /// Returns the origin of the mesh's vertices.
  Vec3 addMesh(Item& item, DrawBatch batch, const SnapshotNode& node, const VisibleNode& v,
               const MeshDesc& desc) {
    batch.mesh = geometry_.meshes.get(node.surface, node.parameters, desc);
    list_.boundPx = std::max(list_.boundPx, boundPx(snapshot_.view, v, batch.mesh->bound));
    // Curved surfaces have short edges; and of a wireframe all edges are seen.
    if (batch.flat && batch.state.shading != Shading::Wireframe)
      batch.mesh = clippedMesh(snapshot_.view, node, v, batch.mesh);
    batch.indexCount = static_cast<std::uint32_t>(batch.mesh->indices.size());
    item.batches.push_back(batch);
    return batch.mesh->origin;
  }

  /// Adds a draw of these instances; of a curved surface that shows both sides two, in the given order.
  void append(std::vector<DrawBatch>& batches, DrawBatch batch, std::span<const Instance> instances) {
    if (batch.indexCount == 0) return;  // a formula without a single finite triangle
    batch.firstInstance = static_cast<std::uint32_t>(list_.instances.size());
    batch.instanceCount = static_cast<std::uint32_t>(instances.size());
    for (const Instance& instance : instances) place(instance);
    if (hidesLines(batch.state)) {
      batches.push_back(batch);
      batches.back().state.hidesLines = true;
    }
    const bool bothSides =
        !batch.finds() && batch.bothSides && !batch.flat && batch.state.shading != Shading::Wireframe;
    if (!bothSides) {
      batches.push_back(std::move(batch));
      return;
    }
    for (const Half half : {Half::Near, Half::Far}) {
      batch.half = half;
      batch.culling = half == Half::Near ? FaceCulling::Back : FaceCulling::Front;
      batches.push_back(batch);
    }
  }

  /// By the boxes of its instances, so that one side of a closed surface is as good as covers them.
  [[nodiscard]] bool hasSmallTriangles(const DrawBatch& batch) const {
    const Shading shading = batch.state.shading;
    const bool carries = shading == Shading::Flat || shading == Shading::Phong || shading == Shading::Toon;
    if (batch.shell || !carries || inspectionOf(batch.state)) return false;
    const std::uint64_t triangles = std::uint64_t{batch.triangleCount()} * batch.instanceCount;
    if (triangles < kManyTriangles) return false;
    std::uint64_t pixels = 0;
    for (std::uint32_t i = 0; i < batch.instanceCount; ++i)
      pixels +=
          pixelsOf(snapshot_.view, snapshot_.nodes[list_.instanceNodes[batch.firstInstance + i]].boundsWorld)
              .count();
    return pixels < kSmallTrianglePx * triangles;
  }

  [[nodiscard]] bool hidesLines(const DrawState& state) const {
    return state.shading == Shading::Wireframe && state.output == Output::Color && !state.blended &&
           !options_.hiddenLines;
  }

  void place(const Instance& instance) {
    list_.instances.push_back(instance.data);
    list_.exactInstances.push_back(instance.exact);
    list_.instanceNodes.push_back(instance.node);
  }

  const Snapshot& snapshot_;
  const VisibleList& visible_;
  const DrawOptions& options_;
  Geometry& geometry_;
  DrawList list_;
  LightSets lightSets_;
  MaterialList materials_;
  ShellList shells_;
  CasterList casters_;
  std::vector<std::uint32_t> solids_;  ///< meshes that hide what is behind
};

}  // namespace

bool seenThrough(const Snapshot& snapshot, const SnapshotNode& node, const DrawOptions& options) {
  return snapshot.materials[node.material.index].seenThroughIn(options.shading,
                                                               showsGeometry(options.output));
}

bool hasLayers(const Snapshot& snapshot, const DrawOptions& options) {
  return std::ranges::any_of(snapshot.nodes, [&](const SnapshotNode& node) {
    const Material& material = snapshot.materials[node.material.index];
    return seenThrough(snapshot, node, options) && !material.invisible() &&
           material.shadingIn(options.shading) != Shading::Wireframe;
  });
}

bool occludesAmbient(const Snapshot& snapshot, const DrawOptions& options) {
  return options.output == Output::Color && !showsData(options.shading) && snapshot.ambientOcclusion.any() &&
         snapshot.ambient != Vec3(0);
}

bool tracesRays(const Snapshot& snapshot, const DrawOptions& options) {
  return options.output == Output::Color && !showsData(options.shading) &&
         std::ranges::any_of(snapshot.nodes, [&](const SnapshotNode& node) {
           const MaterialShaderPtr& shader = snapshot.materials[node.material.index].shader;
           return shader && shader->traces();
         });
}

bool findsSurface(const Snapshot& snapshot, const SnapshotNode& node, const DrawOptions& options) {
  const Material& material = snapshot.materials[node.material.index];
  const Shading shading = material.shadingIn(options.shading);
  return (shading == Shading::Exact || shading == Shading::Residual) && !material.invisible() &&
         !seenThrough(snapshot, node, options);
}

bool findsLayers(const Snapshot& snapshot, const SnapshotNode& node, const DrawOptions& options) {
  const Material& material = snapshot.materials[node.material.index];
  return seenThrough(snapshot, node, options) && !material.invisible() &&
         material.shadingIn(options.shading) == Shading::Exact;
}

bool DrawList::addsLight() const {
  return std::ranges::any_of(groups, [](const LightGroup& group) {
    return std::ranges::any_of(group.again,
                               [](const DrawBatch& again) { return addsMoreLight(again.state); });
  });
}

bool DrawList::onlyFound() const {
  return transparent.empty() && std::ranges::all_of(opaque, [this](const DrawBatch& batch) {
           return batch.finds() && (!deferred || batch.state.form != Form::Fused);
         });
}

std::vector<FoundLayer> DrawList::layerMeshes() const {
  std::vector<FoundLayer> nodes;
  for (const DrawBatch& batch : layers.meshes)
    if (!batch.finds())
      nodes.push_back({instanceNodes[batch.firstInstance], instances[batch.firstInstance].material});
  return nodes;
}

DrawList listDraws(const Snapshot& snapshot, const VisibleList& visible, const DrawOptions& options,
                   Geometry& geometry) {
  return DrawLister(snapshot, visible, options, geometry).list();
}

}  // namespace luxo
