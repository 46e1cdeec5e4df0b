// SPDX-License-Identifier: Apache-2.0
// What a surface does to light: L = ambient * La + sum over lights of (diffuse * N.L + specular *
// (N.H)^shininess) * Le.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "math/vec.h"
#include "scene/isoline_set.h"
#include "scene/material_shader.h"
#include "scene/pattern.h"
#include "scene/shading.h"
#include "scene/texture_map.h"

namespace luxo {

/// Which faces are shown, and whether the normal turns toward the viewer.
enum class TwoSided {
  Auto,  ///< Yes for open surfaces; closed ones show both faces with their outward normal
  Yes,   ///< both faces are shown and the normal turns toward the viewer
  No,    ///< back faces are not shown
};

/// What comes through a surface from behind, of an opacity a: (1 - a) of it; all of it; or (1 - a) of it
/// times the diffuse colour, as through stained glass. To that the surface adds a of the light that it
/// reflects itself, highlights included.
enum class Blend { Over, Add, Multiply };

/// How what is seen through comes together: by depth in every pixel, which is right; or node by node as they
/// are given, each over all before it, as in a lecture that shows why order matters.
enum class BlendOrder { Exact, Given };

/// What the vectors of a map of normals are relative to. A texel (r, g, b) is the vector 2 (r, g, b) - 1.
enum class NormalSpace {
  /// x along the surface to where the image's right is, y to where its upper edge is, z along the normal. On
  /// formulas x is unit, along Su, and y is perpendicular to both; on triangles they are MikkTSpace's
  /// (mesh/vertex_tangents.h), interpolated.
  Tangent,
  Object,  ///< the surface's own axes; turned to the side that is shown
};

/// An opacity that is less than a cutoff by no more is above it: textures keep half floats, of alphas up to 1
/// those are off by 2^-12 at most, so that a texel which a file has at the cutoff itself is no hole, however
/// its sums are rounded. A step of 8 bits is sixteen times as much.
inline constexpr double kCutoffSlack = 0x1p-12 + 1e-5;

/// Where the opacity is less than that, whatever says so, nothing is seen in pictures of the geometry, as of
/// opacity 0: that, a quarter of a code of 8 bits, is where opacities leave 0, to more than what floats round
/// away of them. Pictures of light blend it: of many layers, or of a bright light, it is seen.
inline constexpr double kLeastShown = 0x1p-10;

/// Colours are linear RGB factors.
struct Material {
  std::string name = "material";
  Vec3 diffuse{0.7};
  std::optional<Vec3> ambient = std::nullopt;  ///< the diffuse colour unless given
  Vec3 specular{0.2};
  double shininess = 30;  ///< exponent of Blinn's half vector
  double opacity = 1;     ///< 1 is opaque; of less, see `blend`
  Blend blend = Blend::Over;
  TwoSided twoSided = TwoSided::Auto;
  std::optional<Shading> shading = std::nullopt;  ///< overrides the picture's shading, unless that shows data
  bool lectureSpecular = false;                   ///< highlights even where the light is below the horizon
  /// Stands for `diffuse`, and for the ambient colour unless that is given; times `opacity`, if it has one.
  Pattern diffusePattern = {};
  std::vector<double> patternParameters = {};  ///< as many as the pattern has
  /// Lines over the colour that a pattern, a map or none of them gives; where the surface is seen through so
  /// are they. Over what a shader gives they are lit as a material without it and without maps is. Light that
  /// gets through, and models, know nothing of them.
  IsolineSet isolines = {};
  std::vector<double> isolineParameters = {};  ///< as many as they have
  /// Times `diffuse`, and stands for the ambient colour unless that is given; there is none where there is a
  /// pattern.
  TextureMap map = {};
  bool mapOpacity = false;  ///< the alpha of `map` is how opaque the surface is, times `opacity`
  /// With `mapOpacity`, and of mode Over: where it is less opaque than that there is a hole, and all else is
  /// opaque (cutOut()). 0: it is as opaque as it is.
  double cutoff = 0;
  /// Bends the normal that light falls on. A light below the horizon of the surface itself adds nothing,
  /// wherever the map leads. Light between vertices (Gouraud shading) knows nothing of it.
  TextureMap normalMap = {};
  NormalSpace normalSpace = NormalSpace::Tangent;
  double normalScale = 1;       ///< of its x and y, in tangent space
  TextureMap specularMap = {};  ///< times `specular`; drawings (toon) have no highlights
  TextureMap glowMap = {};      ///< times `glow`: light of its own, which shines on nothing else
  Vec3 glow{1};
  /// Lit by the lesson's formula (scene/lesson.h) in exact, Phong and flat shading, where nothing is seen
  /// through; between vertices and in drawings as any other. `shininess` is its exponent, or the byte, red,
  /// of `specularMap`; its ambient light is its own. There is no pattern.
  bool lesson = false;
  /// Lights it instead of all that is above but the maps of colours, which it may ask for: in every pixel,
  /// whatever the shading. There is no pattern and no map of normals. One that says how opaque its points are
  /// (MaterialShader::hasOpacity) is seen through, times `opacity`; what it lets of the light through to
  /// others `opacity` alone says. The ground truth cannot run it: it draws the material without.
  MaterialShaderPtr shader = nullptr;
  std::vector<UniformValue> uniforms = {};  ///< of the shader: those that are given
  /// Of the surface that it is on, where the shader reads it (curvaturePattern() in scene/surface_names.h);
  /// none on triangles, which are flat.
  Pattern curvature = {};
  std::vector<double> curvatureParameters = {};  ///< of the surface: as many as that has

  /// Whether its shader may move the vertices of meshes.
  [[nodiscard]] bool movesVertices() const { return shader && shader->movesVertices(); }
  [[nodiscard]] Vec3 ambientOrDiffuse() const { return ambient.value_or(diffuse); }
  [[nodiscard]] Shading shadingIn(Shading picture) const {
    if (showsData(picture)) return picture;
    const Shading own = shading.value_or(picture);
    if (!shader) return own;
    return own == Shading::Gouraud ? Shading::Phong : own == Shading::Toon ? Shading::Exact : own;
  }
  /// Whether something behind it may be seen.
  [[nodiscard]] bool transparent() const { return letsLightThrough() || (shader && shader->hasOpacity()); }
  /// Whether nothing is seen of it at some points (kLeastShown). What a shader says, which the ground truth
  /// cannot run, does not count.
  [[nodiscard]] bool hasHoles() const {
    return blend != Blend::Multiply && shading != Shading::Wireframe &&
           (opacity < kLeastShown || diffusePattern.hasOpacity() || mapOpacity);
  }
  /// Whether it is so in a picture of that shading; in one of its geometry nothing but its holes is.
  [[nodiscard]] bool seenThroughIn(Shading picture, bool ofGeometry) const {
    const Shading own = shadingIn(picture);
    if (showsData(own)) return false;
    return ofGeometry ? hasHoles() && own != Shading::Wireframe : transparent();
  }
  /// Whether what is in its shadow may get some light: what is seen through, unless only a shader says so.
  /// Where the opacity is 1 everywhere mode Multiply lets through as little as Over.
  [[nodiscard]] bool letsLightThrough() const {
    return opacity < 1 || blend == Blend::Add || diffusePattern.hasOpacity() || mapOpacity;
  }
  /// Whether its map says how much: by its alpha, or, where it tints the light, by its colour.
  [[nodiscard]] bool mapSaysLightThrough() const {
    return mapOpacity || (map.valid() && blend == Blend::Multiply);
  }
  /// Whether nothing is seen of it, anywhere.
  [[nodiscard]] bool invisible() const { return opacity == 0 && blend != Blend::Multiply; }
  /// In the order of its members; some may be no map.
  [[nodiscard]] std::array<const TextureMap*, 4> maps() const {
    return {&map, &normalMap, &specularMap, &glowMap};
  }
  [[nodiscard]] std::array<TextureMap*, 4> maps() { return {&map, &normalMap, &specularMap, &glowMap}; }
  [[nodiscard]] bool hasMaps() const {
    return map.valid() || normalMap.valid() || specularMap.valid() || glowMap.valid();
  }
  /// Or as if there were some: the lesson's formula, a shader, isolines over one colour.
  [[nodiscard]] bool drawsMaps() const {
    return hasMaps() || drawsLesson() || shader || (isolines.valid() && !diffusePattern.valid());
  }
  /// Whether what of the surface a pixel covers decides its colour.
  [[nodiscard]] bool readsFootprint() const { return drawsMaps() || isolines.valid(); }
  [[nodiscard]] bool drawsLesson() const { return lesson && !transparent(); }
  /// Whether a light adds something to a surface that is turned away from it.
  [[nodiscard]] bool lightsBelowHorizon() const { return lectureSpecular || lesson || shader; }
  /// Without the alpha of a map.
  [[nodiscard]] double opacityAt(double u, double v) const {
    return diffusePattern.hasOpacity() ? opacity * diffusePattern.opacityAt(u, v, patternParameters)
                                       : opacity;
  }
  /// The least opacity that `cutoff` makes opaque; 0: it makes none.
  [[nodiscard]] double leastOpaque() const {
    return cutoff == 0 ? 0 : std::max(cutoff - kCutoffSlack, kCutoffSlack);
  }
  /// What that makes of an opacity.
  [[nodiscard]] double cutOut(double opacityThere) const {
    return cutoff == 0 ? opacityThere : opacityThere >= leastOpaque() ? 1 : 0;
  }
  [[nodiscard]] Vec3 diffuseAt(double u, double v) const {
    return diffusePattern.valid() ? diffusePattern.colorAt(u, v, patternParameters) : diffuse;
  }
  /// A colour with the isolines over it, as a pixel sees them.
  [[nodiscard]] Vec3 underIsolines(const Vec3& color, double u, double v, const Footprint& footprint) const {
    return isolines.valid() ? isolines.over(color, u, v, footprint, isolineParameters) : color;
  }
  /// How much of what is behind a point is seen through it, where it is so opaque and of that colour.
  [[nodiscard]] Vec3 transmission(double opacityThere, const Vec3& diffuseThere) const;
  /// How much of a light gets through there: in mode Add, too, 1 - opacity of it.
  [[nodiscard]] Vec3 lightThrough(double opacityThere, const Vec3& diffuseThere) const;
  friend bool operator==(const Material&, const Material&) = default;
};

/// Throws Error(Scene) naming the material and the value: colours and shininess must be from 0 to
/// kMaxSceneNumber (scene/ranges.h), opacity from 0 to 1.
void validate(const Material& material);

/// Cuts off colours and shininess at kMaxSceneNumber and gives how many numbers that were.
[[nodiscard]] std::uint32_t cutToRange(Material& material);

}  // namespace luxo
