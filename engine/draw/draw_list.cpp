// SPDX-License-Identifier: Apache-2.0
#include "draw/draw_list.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>

#include "draw/clipped_mesh.h"
#include "draw/exact_data.h"
#include "draw/instance_data.h"
#include "draw/light_sets.h"
#include "draw/material_list.h"
#include "draw/near_section.h"
#include "math/transform.h"
#include "shell/shell_view.h"
#include "surface/spread.h"

namespace luxo {
namespace {

// Light that is interpolated between vertices needs vertices where light changes, also on flat surfaces. An
// outline is as wide as the slope of what is interpolated says, which long facets of a cone get wrong.
constexpr double kVertexSpacingPx = 12;
// Object units: where extreme scales round the above to 0.
constexpr double kLeastSpacing = 1e-200;

// No shell is nearer to its surface than this part of its size, unless a search was lost.
constexpr double kFinestShell = 2e-4;
// Nor farther than this part, however small it is seen: a shell of a few triangles is blind to spikes and
// rims, and searches from it have lost them (the lecture's pseudospheres, 12 pixels large).
constexpr double kCoarsestShell = 1.0 / 64;
// A quadric has neither. That it is one was seen in a shell that is no coarser than the above.
constexpr double kCoarsestQuadric = 1.0 / 4;

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

/// Whether its search is a quadratic equation, which finds the same root from wherever it begins.
bool isQuadric(const Shell& shell) {
  return std::ranges::all_of(shell.patchData, [](const ShellPatch& patch) {
    return patch.equation && patch.equation->form() == Equation::Form::Quadric;
  });
}

/// Homogeneous; not finite where the object is flattened.
Vec4 eyeInObject(const View& view, const Transform& worldFromObject) {
  const Mat3 objectFromWorld = glm::inverse(worldFromObject.linear);
  return view.perspective() ? Vec4(objectFromWorld * (view.eye - worldFromObject.translation), 1)
                            : Vec4(objectFromWorld * -view.forward(), 0);
}

/// Back faces are not drawn where the material says so, or front faces hide them.
FaceCulling cullingOf(const VisibleNode& visible, const SnapshotNode& node, const DrawOptions& options,
                      MeshCache& meshes) {
  const auto hidden = [&] {
    return visible.closedFromOutside && meshes.boundsSolid(node.surface, node.parameters);
  };
  return options.cullBackFaces && (visible.hideBackFaces || hidden()) ? FaceCulling::Back : FaceCulling::None;
}

/// Parts of shells that are seen where rays graze: every so many of the picture's triangles.
constexpr std::size_t kMaxOutlines = 64;

/// Shells of more triangles than pixels, and than this, are not made: rays in all of those pixels take no
/// longer. (Some 10 us a triangle, measured from the teapot to sums of sines; a ray 1 to 5.)
constexpr std::uint64_t kWorthRays = 20'000;

/// Of a mesh that is seen until rays have found what it stands for: times the tolerance.
constexpr double kStandInTolerance = 8;

/// Turns visible nodes into draws.
class DrawLister {
 public:
  DrawLister(const Snapshot& snapshot, const VisibleList& visible, const DrawOptions& options,
             Geometry& geometry, const SearchRefinement& refinement)
      : snapshot_(snapshot),
        visible_(visible),
        options_(options),
        geometry_(geometry),
        refinement_(refinement),
        lightSets_(snapshot, options, list_.lightSets),
        materials_(snapshot, visible, options, list_) {
    list_.view = viewData(snapshot, visible);
  }

  DrawList list() && {
    listOpaque();
    listTransparent();
    std::ranges::stable_sort(list_.opaque, {}, placeInOrder);
    std::ranges::sort(list_.found, {}, &FoundNode::node);
    materials_.listShades();
    listOutlines();
    if (options_.skips.hidden) list_.culledHidden = geometry_.hidden.drop(list_, snapshot_, options_.samples);
    placeSharedIndices();
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
    return std::tuple(b.state, b.mesh.get(), b.shell.get(), b.shared, b.firstIndex, b.culling, b.bothSides,
                      b.mirrored, b.lightSet);
  }

  /// What is lit later comes first, then what is searched for. What hides lines comes before all lines, and
  /// after all that it must not hide.
  static int placeInOrder(const DrawBatch& batch) {
    if (batch.state.form != Form::Fused) return -1;
    if (batch.shell) return 0;
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
    for (Group& group : groups)
      append(list_.opaque, std::move(group.batch), group.instances, {Half::Near, Half::Far});
  }

  /// Order is everything, so only neighbours merge, and a surface shows its far side first.
  void listTransparent() {
    for (const VisibleNode& v : visible_.transparent) {
      Item item = itemOf(v, true);
      for (DrawBatch& batch : item.batches) {
        if (!list_.transparent.empty() && kindOf(list_.transparent.back()) == kindOf(batch)) {
          place(item.instance);
          ++list_.transparent.back().instanceCount;
        } else {
          append(list_.transparent, std::move(batch), {&item.instance, 1}, {Half::Far, Half::Near});
        }
      }
    }
  }

  Item itemOf(const VisibleNode& v, bool blended) {
    const SnapshotNode& node = snapshot_.nodes[v.node];
    const Material& material = snapshot_.materials[node.material.index];
    const Shading shading = material.shadingIn(options_.shading);
    DrawBatch batch;
    batch.state = {.shading = shading, .output = options_.output, .blended = blended};
    batch.culling = cullingOf(v, node, options_, geometry_.meshes);
    batch.bothSides = batch.culling == FaceCulling::None;
    batch.flat = node.surface.flatNormal().has_value();
    batch.twoSided = v.twoSided;
    batch.mirrored = v.mirrored;
    LightSets::Choice lights;
    if (needsLights(batch.state)) {
      batch.state.pattern = material.diffusePattern;
      const auto reaching = std::span(visible_.lights).subspan(v.firstLight, v.lightCount);
      lights = materials_.litLater(batch.state) ? materials_.lightLater(batch.state, lightSets_, node)
                                                : lightSets_.choose(reaching, node);
    }
    batch.lightSet = lights.index;
    batch.state.plainLights = lights.plain;
    batch.state.shadedLights = lights.shaded;
    Item item{.lightSet = lights.index};
    item.instance.node = v.node;
    Vec3 origin(0);
    if (findsSurface(snapshot_, node, options_)) {
      item.found = batch.state;
      item.found->byRays = true;
      if (shading == Shading::Exact) item.found->shading = Shading::Phong;
      const std::optional<Vec3> shellOrigin = addShell(item, batch, node, v);
      if (shellOrigin) {
        origin = *shellOrigin;
      } else if (options_.standIns && shading == Shading::Exact) {
        batch.state.shading = Shading::Phong;
        MeshDesc desc = meshDescOf(node, v, Shading::Phong, snapshot_.view);
        desc.tolerance *= kStandInTolerance;
        origin = addMesh(item, batch, node, v, desc);
      }
    } else {
      origin = addMesh(item, batch, node, v, meshDescOf(node, v, shading, snapshot_.view));
    }
    item.instance.data = instanceData(snapshot_, node, v, origin, batch.bothSides);
    item.instance.data.material = materials_.numberOf(node.material.index, lights.shadeOf);
    return item;
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
    if (!refinement_.completes) item.batches.push_back(batch);
    return batch.mesh->origin;
  }

  /// Adds the draws of a node whose surface is found in every pixel, a draw for each of its formulas. Returns
  /// the origin of the shell's vertices; nothing where all of it is left to rays.
  std::optional<Vec3> addShell(Item& item, DrawBatch batch, const SnapshotNode& node, const VisibleNode& v) {
    const PixelRect pixels = pixelsOf(snapshot_.view, node.boundsWorld);
    // No shell holds what has no end.
    if (!isFinite(node.boundsObject)) {
      list_.byRays.push_back(pixels);
      return std::nullopt;
    }
    // A look at a small part of a large surface needs no finer shell than one at all of it: only its cells
    // must be small enough for a search that begins in them.
    const double size = glm::length(node.boundsObject.extent());
    // What has collapsed into a point at this moment has no size to go by.
    const double coarsest = kCoarsestShell * size > kLeastSpacing ? kCoarsestShell * size
                                                                  : std::numeric_limits<double>::infinity();
    const double wanted = v.toleranceObject / options_.tolerancePx * options_.shellTolerancePx;
    const double tolerance = std::min(std::max(wanted, kFinestShell * size), coarsest);
    const int level = refinement_.level(v.node);
    const auto most = static_cast<double>(std::max(pixels.count(), kWorthRays));
    const double refined = tolerance * std::ldexp(1.0, -2 * level);
    batch.shell = geometry_.shells.get(node.surface, node.parameters, refined, most);
    if (batch.shell && pixels.count() <= options_.sharedPixels && isQuadric(*batch.shell))
      batch.shell = geometry_.shells.get(node.surface, node.parameters,
                                         std::max(refined, std::min(wanted, kCoarsestQuadric * size)), most);
    const bool leavesOut = !batch.shell || (!batch.shell->proven && batch.shell->pinches.empty());
    if (leavesOut || (!options_.doubles && losesEdges(snapshot_.view, node, v, *batch.shell))) {
      list_.byRays.push_back(pixels);
      return std::nullopt;
    }
    for (const Shell::Pinch& pinch : batch.shell->pinches)
      list_.byRays.push_back(
          overlap(pixels, pixelsOf(snapshot_.view, transformBounds(node.worldFromObject, pinch.box()))));
    const auto plane = options_.doubles ? planeIn(snapshot_.view, node, *batch.shell) : std::nullopt;
    // What a formula rounds away nobody knows but by what is lost.
    const bool inDouble =
        !plane && options_.doubles && (level > 0 || needsDouble(snapshot_.view, node, v, *batch.shell));
    const GlslNumber number = inDouble ? GlslNumber::Double : GlslNumber::Float;
    if (isTooLarge(geometry_.codes, node.surface, *batch.shell, node.parameters.size(), number)) {
      ++list_.tooLarge;
      list_.byRays.push_back(pixels);
      return std::nullopt;
    }
    const bool inside = mayHoldEye(snapshot_.view, node, v, *batch.shell);
    item.instance.exact = plane ? exactInstance(snapshot_.view, node, v, *batch.shell, *plane)
                                : exactInstance(snapshot_.view, node, v, *batch.shell, number);
    item.instance.exact.firstPatch = patchesOf(node, *batch.shell);
    batch.shared = !inside && level == 0 && !refinement_.completes && pixels.count() <= options_.sharedPixels;
    const ShellView view(eyeInObject(snapshot_.view, node.worldFromObject), !inside && level == 0);
    for (const Shell::Part& part : batch.shell->parts) {
      batch.state.surface = plane ? geometry_.codes.plane(shared::kEquationNumbers)
                                  : codeOf(geometry_.codes, node.surface, *batch.shell, part.patch,
                                           node.parameters.size(), number);
      batch.state.equation = batch.shell->patchData[part.patch].equation.has_value();
      batch.culling = inside && batch.bothSides ? FaceCulling::None : FaceCulling::Back;
      // A quadric's roots are all known at once.
      const std::optional<Equation>& equation = batch.shell->patchData[part.patch].equation;
      if (inside && !(equation && equation->form() == Equation::Form::Quadric))
        addNearSection(node, *batch.shell, part);
      batch.half = Half::Near;
      addShellDraws(item, batch, view, part.firstIndex, part.frontCount);
      batch.half = Half::Far;
      if (inside && snapshot_.view.perspective()) {
        // From inside the slab its faces are seen from behind. A ray leaves it by the bottom behind the outer
        // side, or, having dipped into that, by the top.
        if (!batch.bothSides) batch.culling = FaceCulling::Front;
        addShellDraws(item, batch, view, part.firstIndex, part.count);
      } else if (batch.bothSides) {
        addShellDraws(item, batch, view, part.wallIndex(), part.frontCount);
      }
    }
    return batch.shell->origin;
  }

  /// What is seen where rays begin inside the shell is found by rays.
  void addNearSection(const SnapshotNode& node, const Shell& shell, const Shell::Part& part) {
    const auto before = static_cast<std::ptrdiff_t>(list_.byRays.size());
    appendNearSection(snapshot_.view, node, shell, part, list_.byRays);
    const auto added = list_.byRays.begin() + before;
    const PixelRect all{{0, 0}, {snapshot_.view.size.width, snapshot_.view.size.height}};
    const auto pixels =
        std::accumulate(added, list_.byRays.end(), std::uint64_t{0},
                        [](std::uint64_t sum, const PixelRect& rect) { return sum + rect.count(); });
    // Of prisms that all are across the picture one is enough.
    if (pixels <= 4 * all.count()) return;
    list_.byRays.erase(added, list_.byRays.end());
    list_.byRays.push_back(all);
  }

  /// Adds the draws of some of a shell's triangles: of those seen flat, and of those that a ray may graze.
  void addShellDraws(Item& item, DrawBatch batch, const ShellView& view, std::uint32_t firstIndex,
                     std::uint32_t count) {
    if (batch.shared) {
      addSharedDraws(item, std::move(batch), firstIndex, count);
      return;
    }
    const Shell& shell = *batch.shell;
    std::vector<std::uint32_t>& all = list_.shellIndices;
    std::array<std::vector<std::uint32_t>, 2> grazing;  // where no edge is a point, and where one is
    const std::uint32_t node = item.instance.node;
    const std::size_t first = all.size();
    for (std::uint32_t i = firstIndex; i < firstIndex + count; i += 3) {
      const Seen seen = view.seen(shell, i, batch.half == Half::Far ? -1 : 1);
      const std::uint32_t slot = feedbackSlot(node, shell.indices[i]);
      const bool lost = seen == Seen::Transversal && refinement_.lostTransversal(slot);
      const bool again = refinement_.refined(node) || (lost && refinement_.lostJustNow(slot));
      if (seen == Seen::Away || (refinement_.completes && !again)) continue;
      // By its equation a surface is found where it is grazed as it is elsewhere.
      const bool isTransversal = seen == Seen::Transversal && !lost && !batch.state.equation;
      const ShellPatch& patch = shell.patchData[shell.patches[shell.indices[i]]];
      std::vector<std::uint32_t>& indices =
          isTransversal ? all : grazing[!batch.state.equation && patch.hasPole()];
      indices.insert(indices.end(), shell.indices.begin() + i, shell.indices.begin() + i + 3);
    }
    const auto add = [&](std::size_t from) {
      if (from == all.size()) return;
      batch.firstIndex = static_cast<std::uint32_t>(from);
      batch.indexCount = static_cast<std::uint32_t>(all.size() - from);
      item.batches.push_back(batch);
    };
    add(first);
    batch.state.grazing = true;
    for (const bool poles : {false, true}) {
      const std::size_t from = all.size();
      all.insert(all.end(), grazing[poles].begin(), grazing[poles].end());
      batch.state.poles = poles;
      add(from);
    }
  }

  /// Adds the draws of all of these triangles, as if a ray may graze each of them.
  void addSharedDraws(Item& item, DrawBatch batch, std::uint32_t firstIndex, std::uint32_t count) {
    const auto key = std::pair(batch.shell.get(), firstIndex);
    auto known = sharedRanges_.find(key);
    if (known == sharedRanges_.end() || !options_.shareShells)
      known = sharedRanges_.insert_or_assign(key, sharedRanges(*batch.shell, firstIndex, count)).first;
    batch.state.grazing = true;
    for (const bool poles : {false, true}) {
      const auto& [first, end] = known->second[poles];
      if (first == end) continue;
      batch.state.poles = poles;
      batch.firstIndex = first;
      batch.indexCount = end - first;
      item.batches.push_back(batch);
    }
  }

  /// Where in sharedIndices_ the triangles are in whose patch no edge is a point, and those where one is.
  using Ranges = std::array<std::pair<std::uint32_t, std::uint32_t>, 2>;
  Ranges sharedRanges(const Shell& shell, std::uint32_t firstIndex, std::uint32_t count) {
    Ranges ranges;
    const auto size = [&] { return static_cast<std::uint32_t>(sharedIndices_.size()); };
    for (const bool poles : {false, true}) {
      ranges[poles].first = size();
      for (std::uint32_t i = firstIndex; i < firstIndex + count; i += 3) {
        const ShellPatch& patch = shell.patchData[shell.patches[shell.indices[i]]];
        if ((!patch.equation && patch.hasPole()) != poles) continue;
        sharedIndices_.insert(sharedIndices_.end(), shell.indices.begin() + i, shell.indices.begin() + i + 3);
      }
      ranges[poles].second = size();
    }
    return ranges;
  }

  /// After those that are single nodes', of which some are hidden.
  void placeSharedIndices() {
    const auto before = static_cast<std::uint32_t>(list_.shellIndices.size());
    for (DrawBatch& batch : list_.opaque)
      if (batch.shared) batch.firstIndex += before;
    list_.shellIndices.insert(list_.shellIndices.end(), sharedIndices_.begin(), sharedIndices_.end());
  }

  /// Evenly chosen of all grazing triangles, so that where outlines are dense many are.
  void listOutlines() {
    std::size_t grazing = 0;
    const auto forEachGrazing = [&](const auto& action) {
      for (const DrawBatch& batch : list_.opaque)
        if (batch.shell && batch.state.grazing && !batch.shared)
          for (std::uint32_t i = batch.firstIndex; i < batch.firstIndex + batch.indexCount; i += 3)
            action(batch, i);
    };
    forEachGrazing([&](const DrawBatch&, std::uint32_t) { ++grazing; });
    const std::size_t stride = std::max<std::size_t>(grazing / kMaxOutlines, 1);
    std::size_t number = 0;
    forEachGrazing([&](const DrawBatch& batch, std::uint32_t i) {
      if (number++ % stride != 0) return;
      const SnapshotNode& node = snapshot_.nodes[list_.instanceNodes[batch.firstInstance]];
      Vec3 middle(0);
      for (std::uint32_t k = 0; k < 3; ++k) middle += batch.shell->positions[list_.shellIndices[i + k]] / 3.0;
      const Vec3 eye = eyeFromWorldPoint(snapshot_.view, transformPoint(node.worldFromObject, middle));
      if (snapshot_.view.perspective() && !(-eye.z > snapshot_.view.near)) return;
      const Vec2 pixel = glm::floor(pixelFromEye(snapshot_.view, eye));
      const PixelSize& size = snapshot_.view.size;
      if (pixel.x >= 0 && pixel.y >= 0 && pixel.x < size.width && pixel.y < size.height)
        list_.outlines.push_back({static_cast<std::int32_t>(pixel.x), static_cast<std::int32_t>(pixel.y)});
    });
  }

  /// Where the patches of a surface start; nodes with the same surface and parameters share them.
  std::uint32_t patchesOf(const SnapshotNode& node, const Shell& shell) {
    const auto [entry, isNew] =
        firstPatchOf_.try_emplace(std::pair{node.surface.identity(), node.parameters},
                                  static_cast<std::uint32_t>(list_.exactPatches.size()));
    if (isNew)
      appendPatches(geometry_.codes, node.surface, node.parameters, shell, list_.exactPatches,
                    list_.exactParameters);
    return entry->second;
  }

  /// Adds a draw of these instances; of a curved surface that shows both sides two, in the given order.
  void append(std::vector<DrawBatch>& batches, DrawBatch batch, std::span<const Instance> instances,
              std::array<Half, 2> halves) {
    if (batch.indexCount == 0) return;  // a formula without a single finite triangle
    batch.firstInstance = static_cast<std::uint32_t>(list_.instances.size());
    batch.instanceCount = static_cast<std::uint32_t>(instances.size());
    for (const Instance& instance : instances) place(instance);
    if (hidesLines(batch.state)) {
      batches.push_back(batch);
      batches.back().state.hidesLines = true;
    }
    const bool bothSides =
        !batch.shell && batch.bothSides && !batch.flat && batch.state.shading != Shading::Wireframe;
    if (!bothSides) {
      batches.push_back(std::move(batch));
      return;
    }
    for (const Half half : halves) {
      batch.half = half;
      batch.culling = half == Half::Near ? FaceCulling::Back : FaceCulling::Front;
      batches.push_back(batch);
    }
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
  const SearchRefinement& refinement_;
  DrawList list_;
  LightSets lightSets_;
  MaterialList materials_;
  std::map<std::pair<const void*, std::vector<double>>, std::uint32_t> firstPatchOf_;
  std::map<std::pair<const Shell*, std::uint32_t>, Ranges> sharedRanges_;
  std::vector<std::uint32_t> sharedIndices_;
};

}  // namespace

bool findsSurface(const Snapshot& snapshot, const SnapshotNode& node, const DrawOptions& options) {
  const Material& material = snapshot.materials[node.material.index];
  const Shading shading = material.shadingIn(options.shading);
  return (shading == Shading::Exact || shading == Shading::Residual) && !material.transparent();
}

bool DrawList::onlyFound() const {
  return transparent.empty() && std::ranges::all_of(opaque, [this](const DrawBatch& batch) {
           return deferred ? batch.state.form != Form::Fused : batch.shell != nullptr;
         });
}

DrawList listDraws(const Snapshot& snapshot, const VisibleList& visible, const DrawOptions& options,
                   Geometry& geometry, const SearchRefinement& refinement) {
  return DrawLister(snapshot, visible, options, geometry, refinement).list();
}

}  // namespace luxo
