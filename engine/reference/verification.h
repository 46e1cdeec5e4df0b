// SPDX-License-Identifier: Apache-2.0
// How far a picture is from the truth: coverage, geometry, light, each as numbers with a unit and with the
// pixels that are worst.
//
//     const ReferencePicture truth = castPicture(snapshot);
//     const Verification errors = verify(snapshot, truth, {.color = ..., .uv = ..., .id = ...});
//
// Geometry is compared where the picture shows the layer of the surface that the truth sees: two points are
// of one layer when the surface leads from one to the other without leaving their neighbourhood on the
// screen. Everything else is a mismatch, and what counts is how far the pixel is from where it would be none.
//
// A pixel is wrong (WrongPixels) when it shows a surface where there is none, or none where there is one, or
// another layer, or a point that is more than kPointPx and what float32 leaves of (u, v) off, or a light that
// the truth has in shadow (or the other way round): each only away from outlines and borders of shadows by
// more than kSilhouettePx; or, in exact shading, a colour that nothing within that distance has. Of a mesh,
// whose points are off, lights are judged from the point that is shown, by what each of them alone gives the
// picture (MeasuredPicture::alone). Where a map estimates how much is seen of a light with a radius, a pixel
// is wrong whose light differs from the part that is seen in truth, of the light's disc around its middle, by
// more than kSeenPartOff. Layers touch, and either may be shown, whose points on the ray are as near to each
// other as the depth buffer's rounding, or the one to the other's surface as kPointPx in space.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "image/image.h"
#include "reference/reference.h"
#include "scene/snapshot.h"

namespace luxo {

/// The outputs of one snapshot as luxo::Renderer draws them, one sample per pixel. `id` and `uv` are needed,
/// and `position` where there are triangles, whose points it tells; of the others those that are not empty
/// are judged.
struct MeasuredPicture {
  Image color, depth, position, normal, uv, id;
  /// Of pictures with meshes of formulas, for the light on these to be judged: the colour without any light,
  /// and with each of the snapshot's lights (wholeLights()) alone, without its shadow.
  Image dark = {};
  std::vector<Image> alone = {};
};

struct VerificationOptions {
  Shading shading = Shading::Exact;  ///< of materials that do not say otherwise
  /// Row * width + column of the pixels to judge; empty: all. The truth must hold them and the eight
  /// neighbours of each (withNeighbours).
  std::vector<std::uint32_t> pixels = {};
  double farthestPx = 4;  ///< how far around a mismatched pixel its silhouette is looked for
  /// How far meshes may be off on the screen (FrameError::boundPx). Colours of drawings that are seen through
  /// are judged within it; those of other meshes, which are seen through, are not.
  double boundPx = 0;
  /// Off: mismatches are counted, but how far they are from right stays 0, and WrongPixels stays empty.
  bool silhouettes = true;
  /// Off: a colour that is off is no reason to look for another one than a shadow or a texture. Of shadows
  /// that are approximations borders are lit in part.
  bool colors = true;
  int worst = 5;     ///< pixels listed per metric
  bool flip = true;  ///< of whole pictures; a second per megapixel
  int threads = 0;   ///< 0: all cores. The result does not depend on it.
};

enum class Mismatch : std::uint8_t {
  None,
  Missing,     ///< nothing is shown where the truth sees a surface
  Extra,       ///< a surface is shown where the truth sees nothing
  WrongNode,   ///< another node
  WrongLayer,  ///< another part of the node: what lies behind a fold, or across a crossing
};

/// A pixel, and what is wrong with it.
struct Offence {
  int x = 0, y = 0;
  double error = 0;  ///< in the metric's unit
  Mismatch mismatch = Mismatch::None;
  std::uint32_t measuredNode = 0, trueNode = 0;  ///< numbers as in the `id` output; 0: nothing
  Vec2 measuredParameters{0}, trueParameters{0};
};

/// How one error is spread over the pixels that were compared.
struct ErrorSpread {
  std::uint64_t pixels = 0;
  double rms = 0, p99 = 0, p999 = 0, max = 0;
  /// The largest error of the truth itself once it is rounded to the float32 of the output: what no picture
  /// can be expected to be below.
  double floor = 0;
  std::vector<Offence> worst;  ///< largest first
};

struct CoverageErrors {
  std::uint64_t compared = 0;   ///< pixels whose truth is certain
  std::uint64_t covered = 0;    ///< of these, in the truth
  std::uint64_t both = 0;       ///< of these, that show the true layer
  std::uint64_t undecided = 0;  ///< pixels whose truth is not certain: not compared
  std::uint64_t missing = 0, extra = 0, wrongNode = 0, wrongLayer = 0;
  /// From the centre of a mismatched pixel to the nearest point of the picture plane where the truth is what
  /// the pixel shows: not below the true distance, and within 1e-4 px or 1 % of it; options.farthestPx where
  /// there is none.
  double farthestPx = 0;
  std::uint64_t beyond = 0;    ///< mismatches farther than kSilhouettePx
  std::vector<Offence> worst;  ///< farthest first; error in px

  [[nodiscard]] std::uint64_t mismatches() const { return missing + extra + wrongNode + wrongLayer; }
};

/// Closer than this to the silhouette a pixel may be on either side of it.
inline constexpr double kSilhouettePx = 0.01;

/// How far on the screen the point shown may be from the pixel's ray, beyond what rounding (u, v) to float32
/// may move it.
inline constexpr double kPointPx = 1e-3;

/// What a dozen operations of single precision leave of a cosine: a light that is as near to the horizon may
/// be above or below.
inline constexpr double kCosineRounding = 0x1p-20;

/// Each pixel counts once, under the first that holds.
struct WrongPixels {
  std::uint64_t hitMiss = 0;  ///< a surface where there is none, or none where there is one
  std::uint64_t layer = 0;    ///< another node, or another part of the node
  /// A light is seen that is in shadow, or the other way round; or, in exact shading, a texture's
  /// colour is off by 1/255.
  std::uint64_t light = 0;
  /// Of `light`: darker than the truth, as by a shadow too much, and brighter, as by one too few.
  std::uint64_t shadowExtra = 0, shadowMissing = 0;
  std::uint64_t point = 0;  ///< off by more than kPointPx and rounding, or a value that is not a number
  /// In exact shading a colour that is no pattern's is off by 1/255, and no shadow explains it.
  std::uint64_t color = 0;
  std::vector<std::uint32_t> pixels;  ///< row * width + column, ascending

  [[nodiscard]] std::uint64_t total() const { return hitMiss + layer + point + light + color; }
};

struct ColorErrors {
  std::uint64_t pixels = 0;  ///< that show the true layer, off the silhouettes: for the PSNRs
  /// dB for a peak of 1, of scene-linear values and of values clamped and sRGB-coded, neither quantised.
  /// +infinity when equal, and where there is none.
  double psnrLinear = 0, psnrSrgb = 0;
  std::uint64_t differing8 = 0;  ///< of all compared pixels, those with another 8-bit code in some channel
  double differing8Part = 0;     ///< over the covered ones
  std::uint64_t byShader = 0;    ///< pixels whose colour is a material's own shader's: not compared
  /// Pixels in whose light something may be wrong, which is not judged: of see-through meshes that are off,
  /// of meshes where `alone` is missing or ambient occlusion is on, and where the truth proves nothing.
  std::uint64_t unjudged = 0;
  ErrorSpread difference;  ///< largest channel's, scene-linear, same pixels as the PSNRs
  /// Of the whole picture (image/flip.h); nothing when not all pixels' colours were judged.
  std::optional<double> flipMean, flipP999, flipMax;
};

struct Verification {
  CoverageErrors coverage;
  /// On the screen, from the pixel's centre to the surface's point at the (u, v) shown: px. For exact shading
  /// the error that is certified; of meshes (u, v) are interpolated, and may be farther off than the mesh.
  ErrorSpread positionPx;
  /// In space, from the true point to the surface's point at the (u, v) shown, and to the position shown: in
  /// pixels at that depth. Where a surface is seen at a grazing angle a little on the screen is much in
  /// space.
  ErrorSpread parameterPx, pointPx;
  /// Of the depth buffer (reversed, float32) at the true depth.
  ErrorSpread depthUlp;
  ErrorSpread normalDegrees;
  ErrorSpread normalDegreesInside;  ///< off the silhouettes: without the last pixel before one
  ColorErrors color;
  std::uint64_t nanPixels = 0;  ///< of those judged, with a value that is not a number in any output
  WrongPixels wrong;
  Image positionMap;  ///< positionPx per pixel, 1 channel; +infinity: a mismatch; -1: nothing to compare
};

/// Judges a picture. Error(Requirement): an output that is needed is missing, or an image has another size.
/// Cost: a few surface evaluations per pixel, a few hundred rays per mismatched pixel, and cells for these
/// rays once.
[[nodiscard]] Verification verify(const Snapshot& snapshot, const ReferencePicture& truth,
                                  const MeasuredPicture& measured, const VerificationOptions& options = {});

/// About `count` pixels of a picture, evenly spread and the same every time: the first points of a
/// low-discrepancy sequence. All pixels, when there are not more. Ascending.
[[nodiscard]] std::vector<std::uint32_t> spreadPixels(PixelSize size, std::uint64_t count);

/// These pixels and their eight neighbours within the picture, ascending: what to cast (ReferenceOptions) to
/// judge them.
[[nodiscard]] std::vector<std::uint32_t> withNeighbours(PixelSize size,
                                                        const std::vector<std::uint32_t>& pixels);

/// RGB picture of `positionMap`: grey where nothing is compared, a logarithmic ramp from dark violet (1e-6 px
/// and less) to yellow (1 px and more), mismatches white on red squares of 3 x 3; below it a legend strip.
[[nodiscard]] Image errorHeat(const Image& positionMap);

}  // namespace luxo
