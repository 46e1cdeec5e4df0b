// SPDX-License-Identifier: Apache-2.0
// The vocabulary of scene files: which keys each kind of object may have. The reader reads them, the writer
// writes them, and a test holds the published JSON Schema (scene/luxo-scene-1.schema.json) against them.
// The arguments of named surfaces are in the catalogue (surface/catalogue.h).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "scene/shading.h"

namespace luxo {

/// One kind of object.
struct SceneKeys {
  std::string_view what;        ///< in messages: "a node"
  std::string_view definition;  ///< in the schema's $defs; empty: its root
  std::span<const std::string_view> keys;
  std::size_t required = 0;           ///< how many of them, from the first
  std::string_view whenMissing = {};  ///< what to write for one that is missing
};

namespace keys {

using Names = std::string_view;

inline constexpr std::array<Names, 10> kRootNames = {"luxo",      "$schema",  "render", "params", "textures",
                                                     "materials", "surfaces", "nodes",  "camera", "cameras"};
inline constexpr std::array<Names, 11> kRenderNames = {
    "size",         "time",        "fps",        "samples", "tolerance",        "shading",
    "hidden_lines", "blend_order", "background", "ambient", "ambient_occlusion"};
inline constexpr std::array<Names, 2> kOcclusionNames = {"method", "radius"};
inline constexpr std::array<Names, 4> kParameterNames = {"value", "range", "step", "label"};
inline constexpr std::array<Names, 8> kTextureNames = {"file", "checker", "squares",    "color",
                                                       "wrap", "filter",  "anisotropy", "data"};
inline constexpr std::array<Names, 20> kMaterialNames = {
    "diffuse", "ambient",          "specular", "shininess",  "opacity",      "blend",       "two_sided",
    "shading", "lecture_specular", "map",      "normal_map", "specular_map", "glow_map",    "shader",
    "vertex",  "uniforms",         "let",      "isolines",   "cutoff",       "displacement"};
inline constexpr std::array<Names, 8> kIsolinesNames = {"of", "step",  "at",    "u",
                                                        "v",  "width", "color", "opacity"};
inline constexpr std::array<Names, 4> kTextureMapNames = {"texture", "offset", "scale", "rotate"};
inline constexpr std::array<Names, 5> kColorMapNames = {"texture", "offset", "scale", "rotate", "alpha"};
inline constexpr std::array<Names, 5> kNormalMapNames = {"texture", "offset", "scale", "rotate", "space"};
inline constexpr std::array<Names, 7> kFormulaNames = {"type",   "position", "u",       "v",
                                                       "closed", "let",      "segments"};
inline constexpr std::array<Names, 7> kRevolveNames = {"type", "radius", "height",  "u",
                                                       "v",    "let",    "segments"};
inline constexpr std::array<Names, 6> kTubeNames = {"type", "curve", "radius", "u", "let", "segments"};
inline constexpr std::array<Names, 4> kBezierNames = {"type", "control_points", "patches", "segments"};
inline constexpr std::array<Names, 4> kMeshNames = {"type", "file", "normals", "crease"};
inline constexpr std::array<Names, 12> kClothNames = {"type",    "cells", "size", "density",
                                                      "stretch", "shear", "bend", "damping",
                                                      "gravity", "step",  "pins", "ball"};
inline constexpr std::array<Names, 3> kClothBallNames = {"radius", "center", "friction"};
inline constexpr std::array<Names, 2> kNamedNames = {"type", "segments"};
inline constexpr std::array<Names, 10> kNodeNames = {"name",    "translate", "rotate", "scale", "visible",
                                                     "surface", "material",  "model",  "light", "children"};
inline constexpr std::array<Names, 2> kRotationNames = {"axis", "angle"};
inline constexpr std::array<Names, 11> kLightNames = {"type", "color",        "intensity", "attenuation",
                                                      "spot", "shadow",       "radius",    "shadow_samples",
                                                      "map",  "shadow_plane", "casters"};
inline constexpr std::array<Names, 2> kSpotNames = {"inner", "outer"};
inline constexpr std::array<Names, 6> kMapNames = {"size",          "bias", "slope_bias",
                                                   "normal_offset", "pcf",  "receiver_plane"};
inline constexpr std::array<Names, 7> kCameraNames = {"eye",  "look_at", "up",    "fov_y",
                                                      "near", "type",    "height"};

inline constexpr SceneKeys kRoot{"a scene", "", kRootNames, 1, "write \"luxo\": 1 as the first key"};
inline constexpr SceneKeys kRender{"the render settings", "render", kRenderNames};
inline constexpr SceneKeys kOcclusion{"ambient occlusion", "ambient_occlusion", kOcclusionNames};
inline constexpr SceneKeys kParameter{"a parameter", "parameter", kParameterNames, 1};
inline constexpr SceneKeys kTexture{"a texture", "texture", kTextureNames};
inline constexpr SceneKeys kTextureMap{"a map", "texture_map", kTextureMapNames, 1};
inline constexpr SceneKeys kColorMap{"a map of colours", "color_map", kColorMapNames, 1};
inline constexpr SceneKeys kNormalMap{"a map of normals", "normal_map", kNormalMapNames, 1};
inline constexpr SceneKeys kMaterial{"a material", "material", kMaterialNames};
inline constexpr SceneKeys kIsolines{"isolines", "isolines", kIsolinesNames};
inline constexpr SceneKeys kFormula{"a formula surface", "surface_formula", kFormulaNames, 2};
inline constexpr SceneKeys kRevolve{"a surface of revolution", "surface_revolve", kRevolveNames, 3};
inline constexpr SceneKeys kTube{"a tube", "surface_tube", kTubeNames, 3};
inline constexpr SceneKeys kBezier{"a Bezier surface", "surface_bezier", kBezierNames, 2};
inline constexpr SceneKeys kMesh{"a mesh", "surface_mesh", kMeshNames, 2};
inline constexpr SceneKeys kCloth{"a cloth", "surface_cloth", kClothNames, 1};
inline constexpr SceneKeys kClothBall{"the ball of a cloth", "cloth_ball", kClothBallNames, 1};
inline constexpr SceneKeys kNode{"a node", "node", kNodeNames};
inline constexpr SceneKeys kRotation{"a rotation", "rotation", kRotationNames, 2};
inline constexpr SceneKeys kLight{"a light", "light", kLightNames};
inline constexpr SceneKeys kSpot{"a spot", "spot", kSpotNames};
inline constexpr SceneKeys kMap{"a shadow map", "map", kMapNames};
inline constexpr SceneKeys kCamera{"a camera", "camera", kCameraNames};

/// All of them, but for named surfaces.
inline constexpr std::array kAll = {kRoot,     kRender,     kOcclusion, kParameter, kTexture,   kMaterial,
                                    kIsolines, kTextureMap, kColorMap,  kNormalMap, kFormula,   kRevolve,
                                    kTube,     kBezier,     kMesh,      kCloth,     kClothBall, kNode,
                                    kRotation, kLight,      kSpot,      kMap,       kCamera};

// Words that stand for values, in the order of their enumerations.
inline constexpr std::array<Names, 2> kLightTypes = {"point", "directional"};
inline constexpr std::array<Names, 2> kAttenuations = {"none", "inverse-square"};
inline constexpr std::array<Names, 4> kShadows = {"none", "exact", "map", "planar"};
inline constexpr std::array<Names, 3> kWraps = {"repeat", "clamp", "mirror"};
inline constexpr std::array<Names, 2> kFilters = {"trilinear", "nearest"};
inline constexpr std::array<Names, 2> kNormalSpaces = {"tangent", "object"};
/// kShadingNames, and the lesson's formula.
inline constexpr auto kMaterialShadings = [] {
  std::array<Names, kShadingNames.size() + 1> names{};
  std::ranges::copy(kShadingNames, names.begin());
  names.back() = "lesson";
  return names;
}();
inline constexpr std::array<Names, 3> kBlends = {"over", "add", "multiply"};
inline constexpr std::array<Names, 2> kBlendOrders = {"exact", "given"};
inline constexpr std::array<Names, 2> kOcclusionMethods = {"screen", "rays"};
inline constexpr std::array<Names, 2> kProjections = {"perspective", "orthographic"};
/// Surfaces with a structure of their own; all other types are the catalogue's.
inline constexpr std::array<Names, 6> kShapeTypes = {"formula", "revolve", "tube", "bezier", "mesh", "cloth"};
/// What of a cloth is held: its corners, then its edges.
inline constexpr std::array<Names, 8> kClothPins = {"front_left", "front_right", "back_left", "back_right",
                                                    "front",      "back",        "left",      "right"};
inline constexpr std::array<Names, 3> kNormalRules = {"given", "smooth", "flat"};

}  // namespace keys
}  // namespace luxo
