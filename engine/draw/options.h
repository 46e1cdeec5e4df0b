// SPDX-License-Identifier: Apache-2.0
// What to make of a snapshot: quality, what is written to the pixels, and which work may be skipped.
#pragma once

#include <cstdint>

#include "scene/shading.h"

namespace luxo {

/// What the pixels hold: the picture, or an auxiliary output (AOV) of the geometry.
/// Certificate: how the point shown is known: 1 by a search that certified it, 2 by a ray cast in double that
/// proves it to be the nearest, 3 neither, or by a ray that does not; 0 where nothing is shown.
/// Outputs of the geometry are of the nearest point that is in no hole (kLeastShown), seen through or not;
/// certificates are of the worst of all layers, however little is seen of them; where these are certain, of
/// what is behind all, if there is something.
enum class Output { Color, Depth, Position, Normal, Uv, Id, Residual, Certificate };

/// Whether what is behind others can be seen in their holes alone (Material::hasHoles).
[[nodiscard]] constexpr bool showsGeometry(Output output) {
  return output != Output::Color && output != Output::Certificate;
}

/// How many pixels of an exact picture are cast by the reference and compared (Audit::pixels).
enum class AuditExtent { Usual, All, None };
struct Audit {
  AuditExtent extent = AuditExtent::Usual;
  std::uint64_t atLeast = 0;  ///< with Usual: so many, where there are

  friend bool operator==(const Audit&, const Audit&) = default;
};

/// How points get their light: each fragment finds its point and lights it; or points are found first, and
/// those that are seen lit once each. Both give the same picture, to rounding. Auto: fused, which was faster
/// in all but one of the scenes measured on a CPU device, with 1 to 32 lights and 1 to 8 layers (deferred
/// 0.96 to 3.0 times as long; `luxo bench` has it in its table). Deferred is for what has to know all points
/// before the light.
enum class Composition { Auto, Fused, Deferred };

/// Which shadows lights have: none, those of shades in closed form, wherever they light something, or those
/// that have to be found, too.
enum class ShadowKinds { None, ClosedForms, All };

/// Work that no picture needs: no choice changes a bit, or, of `backface` and `hidden`, and of `lights` where
/// more than 32 are left at a node, which are added in groups, 1e-6 (exact shading).
struct Skips {
  bool frustum = true;   ///< nodes, and clusters of meshes, outside the picture
  bool small = true;     ///< nodes that cover no sample
  bool backface = true;  ///< faces, nodes, and clusters of meshes that turn their back
  bool lights = true;    ///< lights that cannot reach a node
  /// Pictures that are still there, and what was found for them where materials alone have changed; uploads
  /// of what the device already has.
  bool unchanged = true;
  bool passes = true;  ///< passes with nothing to draw
  /// What is behind other surfaces, where it is searched for in every pixel, and clusters of meshes behind
  /// solid ones. On CPU devices, which compare depths after the search only, and process vertices slowly.
  bool hidden = true;

  [[nodiscard]] static constexpr Skips none() { return {false, false, false, false, false, false, false}; }

  friend bool operator==(const Skips&, const Skips&) = default;
};

struct DrawOptions {
  Shading shading = Shading::Exact;  ///< of materials that do not say otherwise
  Output output = Output::Color;
  double tolerancePx = 0.5;  ///< how far a mesh may be from its surface on the screen
  /// Exact shading: how far the shell in which the search for a surface begins is from it, about. No error of
  /// the picture: coarser shells have fewer triangles and start the search farther off.
  double shellTolerancePx = 1.5;
  /// Exact shading: where a view magnifies what float rounds away, shaders compute in double, if the device
  /// can.
  bool doubles = true;
  /// Exact shading: what certified rays look at once more. Quality, not a skip.
  Audit audit;
  /// Per pixel, 1 to kMaxSamples: in as many passes; but 4 in one, if the device can, where nothing is
  /// searched for: no exact surface, no shadow, nothing that is seen through, no occlusion, and no ray of a
  /// shader. Auxiliary outputs always take 1, in the pixel's centre; they are never averaged.
  int samples = 1;
  /// Wireframes: lines behind surfaces of wires show, too. Else a surface of wires hides what lines are
  /// behind it, and nothing but lines; one that is seen through hides none.
  bool hiddenLines = false;
  /// Exact shading, of a ScenePainter's pictures that no rays complete: coarse meshes stand in for surfaces
  /// that are left to these.
  bool standIns = false;
  /// Exact shading, of a picture that an audit found wrong: shells four times as near, which every ray is
  /// taken to graze, and searches in double, where they can be.
  bool finerShells = false;
  /// Deferred, whatever this says, where shadows have to be found, something is seen through, ambient light
  /// is occluded, shaders send rays, or more lights reach a node than a set has room for
  /// (shared::kMaxLights). Fused where no light is shown, one pass takes several samples, there are more
  /// lights than that and no node needs it, or more materials than a found texel numbers; shadows, occlusion,
  /// such rays and so many lights are refused there.
  Composition composition = Composition::Auto;
  ShadowKinds shadows = ShadowKinds::All;  ///< others: the light reaches what stands behind something, too
  /// Texels along a side of lights' maps of casters (shadow/light_grid.h): how long shadows take, no more.
  int shadowGridSize = 64;
  /// And of the eye's of what is seen through.
  int layerGridSize = 128;
  /// Exact shading: of what covers no more pixels the triangles are not told apart by how they are seen, so
  /// that all instances of a shell are one draw: the longer search costs less there than a draw of its own
  /// (80 us on a CPU device).
  std::uint64_t sharedPixels = 64 * 64;
  /// And of so many nodes at most, the first in the list: what comes after them shares draws, however large.
  std::size_t maxDrawnApart = 512;
  bool shareShells = true;    ///< off: such instances are drawn one by one, to the same bits
  bool cullBackFaces = true;  ///< off: both faces of everything are rasterised, for looking at meshes
  Skips skips;

  friend bool operator==(const DrawOptions&, const DrawOptions&) = default;
};

}  // namespace luxo
