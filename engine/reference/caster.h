// SPDX-License-Identifier: Apache-2.0
// What one ray sees of a snapshot, and the light that comes along it: exact surfaces, exact shadows, double
// precision.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reference/roots.h"
#include "reference/shape.h"
#include "scene/lesson.h"
#include "scene/normal_map.h"
#include "scene/snapshot.h"

namespace luxo::reference {

/// From so many rays on it is worth waking all cores for them.
inline constexpr std::size_t kRaysForAllCores = 8;

/// A point of a surface that a ray meets. World space.
struct Hit {
  double t = 0;            ///< metres along the ray
  std::uint32_t node = 0;  ///< index into Snapshot::nodes
  double u = 0, v = 0;
  Vec3 position{0};
  Vec3 normal{0};          ///< unit; outward, or toward the viewer where two-sided; of triangles interpolated
  Vec3 facet{0};           ///< unit: of the triangle itself; of a formula the normal
  Footprint footprint{0};  ///< of the view's pixel, where the material has a map or lines
  NormalFrame frame{0};    ///< of the side that is shown, with it
  bool back = false;       ///< the ray comes from behind the surface
  std::uint32_t patch = 0;  ///< of the surface, or which triangle
  bool certified = true;
};

inline constexpr int kOpennessRays = 256;
/// Of a light with a radius whose shadow a map estimates: points of its disc, a sunflower's, whose rays tell
/// which part of it is seen; and how far off that is where what hides it ends in a straight edge, at most.
/// Measured: 0.052 over all edges; of n points 1.2 n^-0.75.
inline constexpr std::uint32_t kSeenPartRays = 64;
inline constexpr double kSeenPartOff = 0.06;
inline constexpr int kMaxLayers = 1024;  ///< of surfaces that are seen through, behind each other

/// Of drawings: edges are a pixel wide, half of which is beside them, measured over the pixels of two rows
/// and columns, and as far off as the mesh is, a pixel at most by what normals between vertices add to that.
inline constexpr double kDrawnEdgePx = 2.5;

/// Of a pixel: the step of differences that measure derivatives, which leave some 1e-4 of these.
inline constexpr double kDerivativePx = 1e-4;

/// When the cells of surfaces that have no closed form are built: at once, all of them; or by prepareFor().
enum class Cells { AtOnce, WhereRaysGo };

/// Reads a snapshot, which must outlive it. Safe from any thread once built. Cost of building: the cells of
/// the distinct surfaces that have no closed form.
class Caster {
 public:
  /// `shading`: of materials that do not say otherwise. What it decides is which of them are drawings (toon).
  explicit Caster(const Snapshot& snapshot, Shading shading = Shading::Exact);
  /// Only what the cache does not have yet is built. The cache may go. With `geometryIn` rays go on behind
  /// what has holes alone, as pictures of the geometry in that shading have it (Material::seenThroughIn).
  Caster(const Snapshot& snapshot, ShapeCache& cache, Cells cells = Cells::AtOnce,
         Shading shading = Shading::Exact, std::optional<Shading> geometryIn = std::nullopt);

  /// The ray of a picture's point: pixel coordinates, x to the right, y down.
  [[nodiscard]] Ray rayThrough(double x, double y) const;

  /// What a ray comes upon, in order of distance: the points of what is seen through (not where its opacity
  /// is 0), up to the first opaque one. Back faces count as the materials say.
  struct Sight {
    std::vector<Hit> hits;
    bool certified = true;  ///< every hit and every miss is proven
  };
  [[nodiscard]] Sight look(const Ray& ray) const { return look(ray, Invisible::Skipped); }
  /// Points that nothing is seen of, as their opacity is 0, may be told, too; not of a material of which
  /// nothing is seen anywhere.
  enum class Invisible { Skipped, Told };
  [[nodiscard]] Sight look(const Ray& ray, Invisible invisible) const {
    return look({ray}, rangeOf(ray), invisible);
  }

  /// Of these the nearest that pictures of the geometry show: not in a hole. Null: there is none.
  [[nodiscard]] const Hit* firstShown(const Sight& sight) const;

  /// The same from a hit on, its own point apart, as far as there is something. `travelled`: metres that the
  /// light has come along from there to the eye; a pixel's footprint grows with them as if all surfaces on
  /// the way were flat (J. Amanatides, "Ray tracing with cones", 1984).
  [[nodiscard]] Sight lookFrom(const Hit& hit, const Vec3& direction, double travelled) const;

  /// What a ray meets first of some nodes, as if these were all there are, and opaque.
  struct First {
    std::optional<Hit> hit;
    bool certified = true;
  };
  /// `nodes`: ascending.
  [[nodiscard]] First firstOf(std::span<const std::uint32_t> nodes, const Ray& ray) const;

  /// The point of a formula's surface at (u, v), as a picture shows it on a ray; a thousandth of a patch
  /// beyond its edge is still of the patch, and where several patches meet it is the one nearest to the ray.
  /// Nothing where the formula has no value there. `t` is nobody's.
  [[nodiscard]] std::optional<Hit> pointAt(std::uint32_t node, const Vec2& parameters, const Ray& ray) const;

  /// Builds the cells of those of the nodes whose bounds some of the rays meet, as for `worth` times as many;
  /// no other call at the same time.
  void prepareFor(std::span<const Ray> rays, std::span<const std::uint32_t> nodes,
                  std::size_t worth = 1) const;

  /// What lights add that maps estimate (SnapshotLight::pointOf): what their points do; or what the light at
  /// their middle does, of which the least, or the most, is seen that the truth may be taken for.
  enum class Wide { Points, Least, Most };
  /// Scene-linear colour of a ray's sight over the background. `certified` turns false when a shadow's ray
  /// was not decided. `tilt` is added, cosineLoss() times, to every cosine between a normal and the direction
  /// to a light: of a light in a surface's own plane rounding decides whether it shines there, and whether
  /// what the plane cuts stands before it: one that a tilt lifts above the plane shines freely. Of drawings
  /// it moves all edges by kDrawnEdgePx: with either sign, between the two colours is that of any other
  /// measure of a gradient.
  [[nodiscard]] Vec3 color(const Ray& ray, const Sight& sight, bool& certified, double tilt = 0,
                           Wide wide = Wide::Points) const;

  /// The snapshot's lights, those that maps estimate as a whole.
  [[nodiscard]] std::span<const WholeLight> wholes() const { return wholes_; }
  /// The least and the most that may be taken for the part of a wide light that is seen from a hit, by
  /// kSeenPartRays; or, where 16 around its rim and one to its middle agree, all or nothing: a straight edge
  /// hides no more than 0.002 of what is within. What is below the horizon there, or where rays prove
  /// nothing, is seen or not.
  struct SeenPart {
    Vec3 least{0}, most{0};
  };
  [[nodiscard]] SeenPart seenPart(const WholeLight& whole, const Hit& hit) const;
  /// What of a light is added to a hit of which so much arrives.
  [[nodiscard]] Vec3 shareOf(const SnapshotLight& light, const Hit& hit, const Vec3& toViewer,
                             const Vec3& visible) const {
    return shareOf(light, hit, reflectionAt(hit), toViewer, visible);
  }

  /// What single precision may leave of such a cosine, for 1 of a light that is far away: it has positions
  /// from the eye, and 2^-23 of their length is the larger an angle the nearer the light is; 2^-20 stands
  /// for 1.
  [[nodiscard]] double cosineLoss(const SnapshotLight& light, const Hit& hit) const;

  /// A light that may be in shadow at a hit: what it adds where it is seen (of an opaque surface), and
  /// whether it is.
  struct Shadowed {
    std::uint32_t light = 0;  ///< index into Snapshot::lights
    Vec3 share{0};
    bool visible = true, certified = true;
  };
  /// The lights that have a shadow (SnapshotLight::hasShadow), no estimate, and would add something, in the
  /// snapshot's order.
  [[nodiscard]] std::vector<Shadowed> shadowedLights(const Hit& hit, const Vec3& toViewer) const;
  /// Whether a light adds something to a hit that it adds something to where it sees it.
  [[nodiscard]] bool sees(std::uint32_t light, const Hit& hit) const {
    bool certified = true;
    return shinesOn(light, hit) && reaching(light, hit, certified) != Vec3(0);
  }

  /// How much of a light (index into Snapshot::lights) reaches a hit that faces it, for what stands between:
  /// from the hit, its own point apart, to so far before the light as is more than roots are off (1e-9 of the
  /// way or 1e-8 of the distances from the origin). So a light that is on a caster is behind none of it, and
  /// shines to both of its sides. `certified` turns false where that was not decided.
  [[nodiscard]] Vec3 reaching(std::uint32_t light, const Hit& hit, bool& certified) const {
    return reaching(snapshot_.lights[light], hit, certified);
  }

  /// A light at a hit: its radiance there and what that adds where nothing stands before it (to an opaque
  /// surface), how much of it reaches the hit, which is only looked for where it shines on it, and what it
  /// adds so.
  struct Lit {
    Vec3 radiance{0}, unshadowed{0}, reaching{0}, share{0};
    bool certified = true;
  };
  [[nodiscard]] Lit lightAt(std::uint32_t light, const Hit& hit, const Vec3& toViewer) const;
  /// What there is where no light reaches: of the ambient light, and glow.
  [[nodiscard]] Vec3 withoutLights(const Hit& hit) const;
  /// How much of the ambient light gets to a hit (scene/ambient_occlusion.h): 1 where there is no occlusion.
  /// By kOpennessRays rays, the same for every point: off by 0.5 % where an edge halves the sky
  /// (tests/unit/openness_test.cpp), and never noise.
  [[nodiscard]] double openness(const Hit& hit) const;
  /// The diffuse colour, of a pattern or a map where the material has one.
  [[nodiscard]] Vec3 diffuseOf(const Hit& hit) const;
  /// With the alpha of a map, where the material has that; of a material with a shader as if it had none.
  [[nodiscard]] double opacityOf(const Hit& hit) const;
  /// Whether there is a hole, where the material's opacity is cut off (Material::cutoff).
  [[nodiscard]] bool cutsOut(const Hit& hit) const {
    return materialOf(hit.node).cutoff > 0 && opacityOf(hit) == 0;
  }

  /// Whether a light is above the plane of a hit's surface, or the material does not ask.
  [[nodiscard]] bool faces(std::uint32_t light, const Hit& hit) const;
  /// Whether a light would add something to a hit that sees it: it faces it, and has it in its cone.
  [[nodiscard]] bool shinesOn(std::uint32_t light, const Hit& hit) const;
  /// Unit.
  [[nodiscard]] Vec3 towardLight(std::uint32_t light, const Hit& hit) const {
    return towardLight(snapshot_.lights[light], hit);
  }
  [[nodiscard]] static Vec3 towardLight(const SnapshotLight& light, const Hit& hit);

  [[nodiscard]] const Snapshot& snapshot() const { return snapshot_; }

 private:
  struct Body {
    PlacedShape shape;
    Mat3 normalFromObject;
    bool mirrored = false, twoSided = false;
    Facing facing = Facing::Both;
    bool transparent = false;
    bool drawing = false;                       ///< toon
    std::array<TexturePlacement, 4> maps = {};  ///< as Material::maps(), where it has them
    Mat3 normalFromTexel{0};
  };

  /// What a hit does to light: the normal that this falls on, and colours.
  struct Reflection {
    Vec3 normal, diffuse, specular, glow;
    double exponent;
  };
  [[nodiscard]] Reflection reflectionAt(const Hit& hit) const;
  [[nodiscard]] Vec3 withoutLights(const Hit& hit, const Reflection& reflection) const;

  /// Where the near and the far plane are on a ray; they are planes, not spheres.
  struct Range {
    double nearest, farthest;
  };
  [[nodiscard]] Range rangeOf(const Ray& ray) const;
  [[nodiscard]] bool mayMeet(const Ray& ray, std::uint32_t node) const;
  /// Where the next layer is looked for: far enough not to find this one again, near enough not to miss that.
  [[nodiscard]] double beyond(const Ray& ray, const Hit& hit) const;
  /// A pixel's ray, or what became of it.
  struct Beam {
    Ray ray;
    std::optional<double> travelled = std::nullopt;  ///< before it, where it is not the eye's: metres
  };
  [[nodiscard]] Hit hitAt(const Beam& beam, std::uint32_t node, const Root& root) const;
  void placeOnTriangle(const Beam& beam, const Root& root, Hit& hit) const;
  /// How far a pixel on its right, and one below it, is from where the beam is at a hit: metres.
  [[nodiscard]] std::array<Vec3, 2> stepsAt(const Beam& beam, const Hit& hit) const;
  /// From how (u, v) moves with the point of the plane that a hit is in: as S does, where su and sv are in
  /// it.
  [[nodiscard]] Footprint footprintOf(const Beam& beam, const Hit& hit, const Vec3& su, const Vec3& sv) const;
  [[nodiscard]] Sight look(const Beam& beam, const Range& range, Invisible invisible) const;
  void meet(const Beam& beam, std::uint32_t node, const Range& range, Invisible invisible,
            Sight& sight) const;
  /// The nearer one; at one distance what is seen through, by how it looks, so that the order of nodes does
  /// not matter; of two opaque points that of the earlier node.
  [[nodiscard]] bool isInFront(const Hit& a, const Hit& b) const;
  [[nodiscard]] static Vec3 radianceAt(const SnapshotLight& light, const Vec3& position);
  /// What a light adds to a hit; `visible`: how much of it arrives, 0 to 1.
  [[nodiscard]] Vec3 shareOf(const SnapshotLight& light, const Hit& hit, const Reflection& reflection,
                             const Vec3& toViewer, const Vec3& visible, double tilt = 0) const;
  [[nodiscard]] LessonPoint lessonOf(const Reflection& reflection) const;
  [[nodiscard]] const Material& materialOf(std::uint32_t node) const {
    return snapshot_.materials[snapshot_.nodes[node].material.index];
  }
  [[nodiscard]] Vec3 illuminated(const Ray& ray, const Hit& hit, bool& certified, double tilt,
                                 Wide wide) const;
  /// As shaders/lib/toon.glsl draws it, with the derivatives that the surface has there.
  [[nodiscard]] Vec3 drawn(const Ray& ray, const Hit& hit, bool& certified, double tilt) const;
  /// A small step away from a hit, in the plane that touches the surface there, metres, and the surface's
  /// normal.
  struct Beside {
    Vec3 step, normal;
  };
  /// A part of a pixel to the right, and down.
  [[nodiscard]] std::array<Beside, 2> besides(const Ray& ray, const Hit& hit) const;
  [[nodiscard]] Vec3 normalBeside(const Hit& hit, const Vec3& step) const;
  [[nodiscard]] std::optional<std::uint32_t> nodeOf(NodeId id) const;
  /// How far along a way from a hit its own surface may be: a hit is as far off that as rounding leaves it,
  /// and along the way that is more where this grazes it.
  [[nodiscard]] double ownReach(const Hit& hit, const Vec3& direction) const;
  /// How much of a light gets to a hit.
  [[nodiscard]] Vec3 reaching(const SnapshotLight& light, const Hit& hit, bool& certified) const;
  /// Whether a body is in the way of the sky's light: what is cut out where it is no hole, what is seen
  /// through nowhere.
  [[nodiscard]] bool occludes(std::uint32_t node, const Ray& ray, double nearest, double farthest) const;
  /// How much of it a body lets through on the way, the hit's own point apart.
  [[nodiscard]] Vec3 through(std::uint32_t node, const SnapshotLight& light, const Hit& hit,
                             bool& certified) const;

  const Snapshot& snapshot_;
  std::vector<Body> bodies_;  // as Snapshot::nodes
  std::vector<WholeLight> wholes_;
};

}  // namespace luxo::reference
