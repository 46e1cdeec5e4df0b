// SPDX-License-Identifier: Apache-2.0
// From what is visible to what is drawn: meshes, instance data, light sets, and as few draws as possible.
// Pure data: nothing here knows a device.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "cull/clusters.h"
#include "cull/cull.h"
#include "draw/draw_state.h"
#include "draw/occlusion_culling.h"
#include "draw/options.h"
#include "draw/paint.h"
#include "draw/pixel_rows.h"
#include "draw/statistics.h"
#include "draw/texture_list.h"
#include "scene/snapshot.h"
#include "shadow/caster_cache.h"
#include "shared/flat_pattern.h"
#include "shared/scene_data.h"
#include "shell/shell_cache.h"
#include "tessellate/mesh_cache.h"

namespace luxo {

enum class FaceCulling { None, Back, Front };

/// A curved surface that shows both sides is drawn in two halves. At the silhouette the two meet at equal
/// depth, and rounding must not let a spark of the far side through: opaque far sides are pushed away by a
/// fraction of a pixel's slope, and near sides whose far side may be lit differently are pulled forward
/// alike.
enum class Half { Whole, Near, Far };

/// One indexed draw: consecutive instances of one mesh or of one shell, or some triangles of the shell of one
/// node, in one state.
struct DrawBatch {
  DrawState state;
  std::optional<DrawState> again;                ///< of a mesh that is drawn again to light its points
  std::shared_ptr<const Mesh> mesh;              ///< null where the surface is found in every pixel
  std::shared_ptr<const Shell> shell;            ///< then not null
  std::uint32_t firstIndex = 0, indexCount = 0;  ///< of the mesh, or of a list's shell or cluster indices
  bool someClusters = false;  ///< of a mesh some clusters of which are left out: DrawList::clusterIndices
  FaceCulling culling = FaceCulling::None;
  Half half = Half::Whole;
  bool shared = false;     ///< of a shell: all of its triangles, in the draws of other nodes, too
  bool flat = false;       ///< lies in one plane: its sides never meet
  bool twoSided = false;   ///< each side is lit by itself
  bool bothSides = false;  ///< back faces are seen, too
  bool frontOnly = false;  ///< back faces are not shown, and no front faces hide them
  bool mirrored = false;   ///< the transforms turn counter-clockwise into clockwise
  std::uint32_t lightSet = 0;
  std::uint32_t firstInstance = 0, instanceCount = 0;

  /// Whether its points are the surface's own.
  [[nodiscard]] bool finds() const { return shell || state.isSurface; }
  [[nodiscard]] std::uint32_t triangleCount() const { return indexCount / 3; }
  [[nodiscard]] std::size_t vertexCount() const {
    return shell ? shell->positions.size() : mesh->positions.size();
  }
};

/// A node whose points are found, by searches in its pixels, as the triangles that it is, or by rays, and how
/// such a point is drawn.
struct FoundNode {
  std::uint32_t node = 0;  ///< index into Snapshot::nodes
  std::uint32_t lightSet = 0;
  DrawState state;
  shared::InstanceData instance;
};

/// Surfaces as rays from a light or from the eye meet them (draw/caster_list.h).
struct Casters {
  std::vector<shared::ClosedCaster> closed;
  std::vector<shared::MeshPlace> meshes;
  std::vector<shared::ShadowCaster> casters;
  std::vector<std::uint32_t> gridStarts;
  std::vector<shared::GridEntry> gridEntries;
  std::vector<shared::CasterCell> cells;
  std::vector<float> parameters;  ///< of the casters' formulas, patch by patch
};

/// Looks for a caster, or for some (DrawState::closed), in all pixels of an area.
struct CasterDraw {
  DrawState state;
  std::uint32_t caster = 0;  ///< index into Casters::casters, or of the first in Casters::closed; or ::meshes
  PixelRect area;
};

/// One draw for each light and each caster of a planar shadow.
struct FlatShadowDraw {
  DrawState state;  ///< its pattern, of a caster that lets light through: where, and how much of it
  std::shared_ptr<const Mesh> mesh;
  shared::FlatShadow shadow;
  shared::FlatPattern caster = {};
};

/// A light's depth map (shaders/lib/light_map.glsl), and the meshes in it.
struct LightMapDrawn {
  shared::LightMap map;
  struct Caster {
    std::shared_ptr<const Mesh> mesh;
    std::vector<Mat4f> clipFromObject;  ///< for each face
  };
  std::vector<Caster> casters;
};

/// Lights of a deferred picture that light what was found in one pass, and what is seen through in another:
/// as many as a word has bits for their shadows, or one some of which gets through its casters. The first
/// group comes with the ambient light, the others add theirs.
struct LightGroup {
  std::uint32_t lightSet = 0;
  bool transmits = false;  ///< it is one light, of which a part may come through: by casters, or by a map
  std::uint32_t plainLights = 0, shadedLights = 0;
  std::uint32_t spots = 0;                     ///< which of them are spots, a bit each
  std::vector<DrawState> shades, layerShades;  ///< a draw for each pattern
  std::vector<DrawBatch> again, layerAgain;    ///< meshes that are drawn again
  /// With `lights`: what looks for the casters of each light that may keep it from what is seen.
  std::vector<CasterDraw> shadows, layerShadows;
  std::vector<FlatShadowDraw> flatShadows;
  /// Of one that transmits: a draw for each caster that lets some of the light through.
  std::vector<CasterDraw> transmittances, layerTransmittances;
  std::vector<FlatShadowDraw> flatTransmittances;
  std::optional<LightMapDrawn> map;  ///< of one that transmits
  /// Of each light of the set, index into Snapshot::lights, as rays find its shadow; nothing of lights
  /// without one. Empty where none has one.
  std::vector<std::optional<std::uint32_t>> lights;

  [[nodiscard]] bool lightsPoints() const { return !shades.empty() || !again.empty(); }
  [[nodiscard]] bool lightsLayers() const { return !layerShades.empty() || !layerAgain.empty(); }
};

/// Groups of lights whose shadows have targets of their own, where a picture has no more of them. Else all
/// share one, which holds those of the last. Measured: rays settle a pixel of most pictures, for which all
/// shadows were found twice; 64 points of light are two groups. Each takes 4 bytes a pixel,
/// or 20, and 16 a point that is seen through.
inline constexpr std::size_t kKeptGroups = shared::kKeptGroups;

/// A node whose layers are found in every pixel, by searches, as the triangles that it is, or by rays.
struct FoundLayer {
  std::uint32_t node = 0;      ///< index into Snapshot::nodes
  std::uint32_t material = 0;  ///< its number
};

/// A mesh of which each pixel finds the point of its surface.
struct PlacedNode {
  std::uint32_t node = 0;      ///< index into Snapshot::nodes
  std::uint32_t material = 0;  ///< its number
};

/// What is seen through, in the order of its depth in every pixel, or in that of its nodes.
struct Layers {
  std::vector<CasterDraw> searches;
  std::vector<DrawBatch> meshes;
  std::vector<CasterDraw> places;     ///< what finds the points of meshes' surfaces
  std::vector<std::uint32_t> placed;  ///< whose these are: indices into Snapshot::nodes, ascending
  std::vector<FoundLayer> found;      ///< ascending
  DrawState blend;                    ///< what blends them
  bool details = false;  ///< points come with shared::LayerDetail, as a map or a shader asks for it

  [[nodiscard]] bool any() const { return !meshes.empty() || !found.empty(); }
};

struct DrawList {
  shared::ViewData view;
  Vec3 origin{0};  ///< shadingOrigin()
  std::vector<shared::InstanceData> instances;
  std::vector<shared::ExactInstance>
      exactInstances;                            ///< as instances; of those without a shell nothing is read
  std::vector<std::uint32_t> instanceNodes;      ///< as instances: indices into Snapshot::nodes
  std::vector<std::uint32_t> shellIndices;       ///< not empty when a draw has a shell
  std::vector<std::uint32_t> clusterIndices;     ///< not empty when a draw is of some clusters
  std::vector<shared::ExactPatch> exactPatches;  ///< not empty when a draw has a shell
  std::vector<double> exactParameters;           ///< of formulas and equations; see ExactPatch
  std::vector<shared::MaterialData> materials;   ///< of instances; never empty
  std::vector<shared::LightSet> lightSets;       ///< never empty
  std::vector<float> patternParameters;          ///< not empty when a draw has a pattern
  TextureList textures;                          ///< not empty when a draw has a texture
  std::vector<DrawBatch> opaque;  ///< grouped, those that find surfaces first, roughly front to back
  std::vector<FoundNode> found;   ///< ascending
  std::vector<PixelRect> byRays;  ///< where no shell tells what is seen
  std::vector<PixelRect>
      shadowsByRays;                   ///< where triangles may stand before a light that no shader looks for
  std::vector<PixelPlace> outlines;    ///< some of the pixels that searches graze
  std::vector<DrawBatch> transparent;  ///< wires, in this order
  std::uint64_t culledHidden = 0;      ///< triangles that are behind others, every instance counted
  ClusterCounts clusters;              ///< triangles of meshes that are left out, every draw counted
  std::uint64_t tooLarge = 0;          ///< nodes found by rays: their formulas are too large for shaders
  /// Points are found first, and lit once each, by all lights that reach anything.
  bool deferred = false;
  bool findsParameters = false;  ///< of a deferred list: with (u, v), as some pattern asks for them
  bool findsFootprints = false;  ///< with them, as some texture asks for them
  bool findsFrames = false;      ///< with these, as some map of normals asks for them
  bool occludes = false;         ///< of a deferred list: it is seen how much of the ambient light gets where
  bool traces = false;           ///< of a deferred list: points that are lit may send rays into the scene
  bool runsShaders = false;      ///< of materials
  /// Of a deferred list: meshes tell theirs, from which the points of their surfaces are found.
  bool findsPlaces = false;
  std::vector<CasterDraw> places;  ///< what finds these
  std::vector<PlacedNode> placed;  ///< whose points these are
  std::vector<LightGroup> groups;  ///< of a deferred list, and of one with layers
  Casters casters;
  Layers layers;
  double boundPx = 0;  ///< largest proven error of a drawn mesh on the screen

  [[nodiscard]] bool exact() const { return !exactPatches.empty(); }
  /// Whether something is looked for in pixels that feedback may be told of.
  [[nodiscard]] bool searches() const { return exact() || findsShadows() || layers.any(); }
  /// Where the sums of their depths tell whether all layers are there, all of which are found then: what
  /// these depths are relative to.
  [[nodiscard]] std::optional<Vec3> layersFrom() const {
    return layers.found.empty() || !std::ranges::all_of(layers.meshes, &DrawBatch::finds)
               ? std::nullopt
               : std::optional(origin);
  }
  /// The nodes whose layers are those of their meshes.
  [[nodiscard]] std::vector<FoundLayer> layerMeshes() const;
  [[nodiscard]] bool findsShadows() const {
    return std::ranges::any_of(
        groups, [](const LightGroup& group) { return !group.lights.empty() || group.transmits; });
  }
  /// Whether what draws the light of a group asks which lights do not get there. Meshes that are drawn again
  /// ask for every group: one without shadows has to say so.
  [[nodiscard]] bool asksForShadows(const LightGroup& group) const {
    return !group.lights.empty() || group.transmits || !group.again.empty();
  }
  /// Whether the shadows of one group outlive those of the next.
  [[nodiscard]] bool keepsShadows() const { return groups.size() <= kKeptGroups; }
  /// Which of their targets a group's are in.
  [[nodiscard]] std::size_t shadowSlot(std::size_t group) const { return keepsShadows() ? group : 0; }
  [[nodiscard]] std::size_t shadowSlotCount() const {
    return keepsShadows() ? std::max<std::size_t>(groups.size(), 1) : 1;
  }
  [[nodiscard]] bool looksForCasters() const { return !casters.casters.empty() || findsShadows(); }
  [[nodiscard]] bool hasLightMaps() const {
    return std::ranges::any_of(groups, [](const LightGroup& group) { return group.map.has_value(); });
  }
  /// More lights than the first add light, which is no drawing's, to meshes that are drawn again.
  [[nodiscard]] bool addsLight() const;
  /// Nothing is drawn over what is found.
  [[nodiscard]] bool onlyFound() const;
};

/// What is kept from frame to frame.
struct Geometry {
  MeshCache meshes;
  ShellCache shells;
  CasterCache casters;
  SurfaceCodes codes;
  OcclusionCulling hidden;

  /// Meshes, shells and casters made so far.
  [[nodiscard]] std::uint64_t tessellated() const {
    return meshes.tessellated() + shells.made() + casters.made();
  }
};

/// Of a mesh that is seen until rays have found what it stands for: times the tolerance.
inline constexpr double kStandInTolerance = 8;

/// Whether a node is seen through: of geometry what has holes is.
[[nodiscard]] bool seenThrough(const Snapshot& snapshot, const SnapshotNode& node,
                               const DrawOptions& options);
/// Whether something is, lines apart.
[[nodiscard]] bool hasLayers(const Snapshot& snapshot, const DrawOptions& options);

/// Whether the ambient light is occluded.
[[nodiscard]] bool occludesAmbient(const Snapshot& snapshot, const DrawOptions& options);
/// Whether the shader of some material may send rays into the scene.
[[nodiscard]] bool tracesRays(const Snapshot& snapshot, const DrawOptions& options);

/// Whether every pixel of a node finds its point of the surface, by a search, a triangle that is the surface,
/// or a ray; and of what is seen through all of them.
[[nodiscard]] bool findsSurface(const Snapshot& snapshot, const SnapshotNode& node,
                                const DrawOptions& options);
[[nodiscard]] bool findsLayers(const Snapshot& snapshot, const SnapshotNode& node,
                               const DrawOptions& options);

/// Throws Error(Scene) when more lights reach a node than a set has room for, and the list is not deferred.
[[nodiscard]] DrawList listDraws(const Snapshot& snapshot, const VisibleList& visible,
                                 const DrawOptions& options, Geometry& geometry);

}  // namespace luxo
