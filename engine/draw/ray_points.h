// SPDX-License-Identifier: Apache-2.0
// What pixels show where searches leave it open, by rays in double precision: their points, to be drawn with
// the renderer's own light; and whether a picture shows what it should.
//
// A pixel in doubt gets all that is to be known of it: the nearest point of all surfaces whose points are
// found (of meshes nothing), or that there is none; and all points that are seen through there. What was
// drawn there before does not matter.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "draw/draw_list.h"
#include "draw/pixel_rows.h"
#include "reference/caster.h"
#include "reference/shape.h"
#include "scene/snapshot.h"

namespace luxo {

/// A vertex of the triangle that draws a point (shaders/lib/placed_vertex.glsl); three that are equal draw
/// it.
struct RayPoint {
  Vec3f position;  ///< relative to DrawList::origin, metres
  Vec3f normal;    ///< unit; toward the viewer where two-sided
  Vec2f parameters;
  Vec4f place;  ///< of the sample in the target, pixels; its depth as in the depth buffer, and in metres
  Vec4f footprint{0};       ///< of the pixel, where there is a texture: u, v to the right, u, v below
  Vec4f frame{0};           ///< with it (scene/normal_map.h)
  std::uint32_t flags = 0;  ///< shared::kUndecided where the ray proves nothing
};

/// A vertex of the triangle that tells the shadows in a pixel (shaders/ray_shadows.vert); three that are
/// equal do it.
struct RayShadow {
  Vec2f place;  ///< of the sample in the target, pixels
  shared::ReachingLight light{.shadows = 0, .transmittance = Vec3f(1)};
};

/// A vertex of the triangle that puts a pixel's layers in its list (shaders/ray_layers.vert); three that are
/// equal do it.
struct RayLayers {
  Vec2f place;                         ///< of the sample in the target, pixels
  std::uint32_t first = 0, count = 0;  ///< of RayPoints::layerPoints
  std::uint32_t ofMeshes = 0;          ///< of these, after them: points that are there, whose light rays tell
  std::uint32_t groups = 0;            ///< of lights; with shared::kUndecidedLayers
};

/// What rays have found in some pixels.
struct RayPoints {
  std::vector<RayPoint> vertices;  ///< by node
  struct Run {
    std::size_t found;  ///< index into DrawList::found
    std::uint32_t firstVertex, vertexCount;
  };
  std::vector<Run> runs;
  std::vector<PixelPlace> misses;               ///< where nothing is met
  std::vector<std::vector<RayShadow>> shadows;  ///< by DrawList::groups; none where no light has a shadow
  std::vector<RayLayers> layers;
  std::vector<shared::LayerPoint> layerPoints;
  std::vector<shared::ReachingLight> layerLights;  ///< of each all groups
  std::vector<shared::LayerDetail> layerDetails;   ///< of each; 0 where no map or shader asks for them
  std::vector<PixelPlace> pixels;                  ///< what all that changes
  std::uint64_t resolved = 0;                      ///< pixels whose points are these
  std::uint64_t shadowed = 0, layered = 0;         ///< others, whose shadows are, or only layers
  std::uint64_t undecided = 0;  ///< of those resolved: whose ray proves nothing, within rounding of grazing
  std::uint64_t shadowsUndecided = 0;  ///< pixels in which a ray to a light proves nothing
  std::uint64_t layersUndecided = 0;   ///< pixels in which some layer, or what reaches it, is not proven
  std::uint64_t unknown = 0;           ///< pixels that show a node which is not in the list

  [[nodiscard]] bool empty() const {
    return vertices.empty() && misses.empty() && shadows.empty() && layers.empty();
  }
};

/// A pixel that searches leave in doubt.
struct Doubt {
  PixelPlace pixel;
  bool point = true;     ///< in doubt is which it shows: a search was lost, or what it found is not certified
  bool shadows = false;  ///< or only these there
  bool layers = false;   ///< or only what is seen through there
  float shown = 0;       ///< the depth, as in the depth buffer, of a point that its own search has certified
  /// With `layers`: the points of meshes that no ray finds again, but may tell the light of; unless unknown.
  std::optional<std::vector<shared::LayerPoint>> meshes = {};
};

/// All pixels are, whatever they show, beside what is in doubt of them, by rows.
[[nodiscard]] std::vector<Doubt> everywhere(PixelSize size, std::vector<Doubt> doubts = {});

/// What the points that rays find are drawn with: of a draw list.
struct RayDraws {
  std::vector<FoundNode> found;
  std::vector<FoundLayer> layers;
  std::vector<FoundLayer> layerMeshes;  ///< whose layers no ray finds
  std::vector<LightGroup> groups;
  Vec3 origin{0};  ///< what positions in shaders are relative to
  std::optional<Vec3> layersFrom;

  RayDraws() = default;
  explicit RayDraws(const DrawList& list)
      : found(list.found),
        layers(list.layers.found),
        layerMeshes(list.layerMeshes()),
        groups(list.groups),
        origin(list.origin),
        layersFrom(list.layersFrom()) {}
};

/// The points that the pixels of a picture show of meshes, whose light rays start there.
struct ShownMeshes {
  std::vector<PlacedNode> nodes;           ///< of which no pixel shows anything else
  std::vector<shared::ShownPoint> points;  ///< by rows; none without nodes
  std::int32_t width = 0;                  ///< of a row
};

/// A pixel of a picture, and what its depth buffer holds there.
struct DepthProbe {
  PixelPlace pixel;
  float depth = 0;
  std::vector<std::uint32_t> shadows = {};  ///< the lights of each group that do not reach it, a bit each
  std::vector<Vec3f> transmittances = {};   ///< of those that transmit
  Vec2f layers{0};                  ///< how many points are seen through there, and the sum of their depths
  std::optional<Vec3f> color = {};  ///< scene-linear; nothing of one that is not known to 1/255
};

struct AuditResult {
  std::uint64_t failed = 0, undecided = 0;
};

/// Pixels that tell whether a picture is right, for its size alone: spread evenly, the same every time, one
/// in 4,096 and at least 64, or as many as asked for. Ascending by row.
[[nodiscard]] std::vector<PixelPlace> auditedPixels(PixelSize size, const Audit& audit,
                                                    std::span<const PixelPlace> outlines);

/// What single precision leaves of the depths of a node's points, metres; of a surface without end, of most
/// of it.
[[nodiscard]] double depthRounding(const View& view, const SnapshotNode& node);

/// What of the lights of a group reaches a hit, or, of a mesh, whose normal is another one, a point that may
/// face away from them. `certified` turns false where a ray proves nothing.
[[nodiscard]] shared::ReachingLight reachingLight(const reference::Caster& caster, const reference::Hit& hit,
                                                  const LightGroup& group, bool& certified, bool ofMesh);

/// Casts rays of one picture after the other, and keeps what it casts them against. Single-threaded; all
/// cores work.
class CertifiedRays {
 public:
  /// `snapshot` must outlive what is asked of it. `goesOn` is asked before every ray, from any thread: once
  /// it says no, what follows is not looked at and answers mean nothing. Cost: copies of its shapes' handles.
  void begin(
      const Snapshot& snapshot, const DrawOptions& options,
      std::function<bool()> goesOn = [] { return true; });

  /// Settles what is in doubt. Where a ray proves that the certified point which is shown is the first, what
  /// was lost is behind it: that pixel stays as it is, as if what was lost had been left out as hidden.
  /// Cost: some 10 us a pixel and core, a hundredfold where surfaces are grazed.
  [[nodiscard]] RayPoints resolve(std::span<const Doubt> doubts, const RayDraws& draws,
                                  const ShownMeshes& shown);
  /// Shadows are looked at where no mesh stands before what is found, but not of lights whose shadows are
  /// approximations; colours where all of the picture is exact.
  [[nodiscard]] AuditResult audit(std::span<const DepthProbe> probes, const RayDraws& draws,
                                  const ShownMeshes& shown);

  /// Milliseconds spent on cells since begin().
  [[nodiscard]] double treesMs() const { return treesMs_; }

 private:
  /// What single precision leaves of a depth, metres, where nothing else bounds it.
  [[nodiscard]] double rounding() const;
  /// Of that which a depth buffer tells of a certified point.
  [[nodiscard]] double roundingAt(double depth) const;
  /// Builds what rays through the pixels are cast against, each worth so many.
  std::vector<reference::Ray> prepare(std::size_t count, const auto& pixelAt, std::size_t worth = 1);
  /// Calls `look` with the indices below `count`, on all cores if there are many; then, once more, with those
  /// that are not `certified`, after `refineCells` was given these: what few cells leave undecided many may
  /// not.
  void lookTwice(std::size_t count, const auto& look, const auto& certified, const auto& refineCells);
  /// Whether the point that is shown at that depth is what a ray has seen.
  [[nodiscard]] bool confirms(const reference::Caster::First& seen, float shown) const;
  /// Adds the points of pixels, and tells which are confirmed by their rays instead.
  [[nodiscard]] std::vector<char> addPoints(std::span<const Doubt> doubts, const RayDraws& draws,
                                            RayPoints& points);
  /// Adds the shadows in pixels, each of which shows a point of a mesh, or else what a ray through it sees
  /// first.
  void addShadows(std::span<const PixelPlace> pixels, const ShownMeshes& shown,
                  std::span<const LightGroup> groups, RayPoints& points);
  /// Adds all points that are seen through in pixels, with their shadows, and those of the meshes there.
  void addLayers(std::span<const Doubt* const> doubts, const RayDraws& draws, RayPoints& points);
  [[nodiscard]] Vec2 sampled(PixelPlace pixel) const;
  /// What is not seen through, but for the nodes whose points are shown.
  [[nodiscard]] std::vector<std::uint32_t> receiversBut(const ShownMeshes& shown) const;

  reference::ShapeCache shapes_;
  std::optional<reference::Caster> caster_;
  std::function<bool()> goesOn_;
  std::vector<std::uint32_t> nodes_;      ///< whose points are found, ascending
  std::vector<std::uint32_t> layers_;     ///< whose layers are found, ascending
  std::vector<std::uint32_t> receivers_;  ///< what is not seen through, ascending
  std::vector<std::uint32_t> all_;        ///< ascending
  bool exactLight_ = false;               ///< and points: no mesh, no approximate shadow, all light
  double rounding_ = 0;                   ///< of depths, for the size of what is found; metres
  double mostRoundingPx_ = 0;             ///< and the most that it is where a point is certified
  double treesMs_ = 0;
};

}  // namespace luxo
