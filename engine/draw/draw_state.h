// SPDX-License-Identifier: Apache-2.0
// What decides the program of a draw: pure data, by which pipelines are made and kept.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>

#include "draw/options.h"
#include "draw/paint.h"
#include "surface/surface_code.h"

namespace luxo {

/// What a draw's fragments do.
enum class Form {
  Fused,                ///< find points, and light them at once
  Found,                ///< write points down, to be lit later
  FoundWithParameters,  ///< with their parameters
  Openness,             ///< find how much ambient light gets to what was written down
  Shade,                ///< light it
  AddLight,             ///< add what more lights have made of it
  MeshPlace,            ///< find which points of its surface a mesh has put down
  LayerPlace,           ///< the same where it is seen through
  Shadow,               ///< find whether a surface keeps a light from what was found
  Transmittance,        ///< how much of a light gets through it
  ShadowsByRays,        ///< write what rays have found of that
  TransmittanceByRays,
  FlatShadow,  ///< are a caster's mesh, flattened onto a plane
  FlatTransmittance,
  LightDepth,          ///< draw a light's depth map
  LightMap,            ///< compare with it
  LayerLightMap,       ///< the same of what is seen through
  Layer,               ///< put points that are seen through in the list of their pixel
  LayerShadow,         ///< find whether a surface keeps a light from those
  LayerTransmittance,  ///< how much of it gets through
  LayersByRays,        ///< put there what rays have found
  ShadeLayers,         ///< light all points of a list
  BlendLayers,         ///< blend them
  Again,      ///< are triangles whose light takes more than their points (Gouraud shading, drawings), lit
  LayerAgain  ///< the same where they are seen through
};

/// What decides the shaders and fixed-function state of a draw. Light counts are part of it (the loops over
/// lights unroll), and so are formulas; which lights they are and the values of parameters are data.
struct DrawState {
  Shading shading = Shading::Phong;
  Output output = Output::Color;
  Form form = Form::Fused;
  std::uint32_t plainLights = 0, shadedLights = 0;
  std::uint32_t spots = 0;  ///< which of them are spots, a bit each
  bool blended = false;
  Paint pattern = {};           ///< where light falls on it; none for views of geometry
  bool footprint = false;       ///< of Form::FoundWithParameters: and with the footprint of the pixel
  bool frame = false;           ///< and with the frame of maps of normals
  bool details = false;         ///< of Form::Layer and LayersByRays: Layers::details
  bool tangents = false;        ///< of triangles that are drawn with such a frame: it is of their tangents
  SurfaceCodePtr surface;       ///< what finds a surface in every pixel; null: triangles are drawn
  bool equation = false;        ///< with it: it is an equation, no formula
  bool grazing = false;         ///< with it: a ray may graze the surface, and meet it more than once
  bool poles = false;           ///< with that: an edge of a patch is one point
  bool walks = false;           ///< with `surface`: that what is found is the first is walked, if need be
  bool frontOnly = false;       ///< with it: rays go on through its back, which is not shown
  bool byRays = false;          ///< points are drawn that rays have found
  bool isSurface = false;       ///< the triangles are the surface itself, not near to it
  bool smallTriangles = false;  ///< cover a few pixels each: their vertices carry little
  bool hidesLines = false;      ///< of a wireframe: its triangles, of which only the depth is drawn
  std::uint32_t patternNumber = 0;  ///< of Form::Shade: MaterialData::pattern
  bool manyMaterials = false;       ///< with it: more than shared::kUniformMaterials
  bool shadows = false;             ///< with it: some lights have shadows that were found
  bool manyGroups = false;          ///< of Form::ShadeLayers: more than have places for what reaches points
  bool addsLight = false;           ///< with it: to what other lights, and the ambient one, have lit
  bool transmits = false;           ///< with it: LightGroup::transmits
  bool occludes = false;            ///< with it: DrawList::occludes
  std::uint32_t closed = 0;         ///< of Form::Shadow and LayerShadow: so many casters, by their equations
  std::uint32_t closedKind = 0;     ///< with it: shared::kClosedPlane and on
  std::uint32_t firstLight = 0;     ///< of Form::Again, in Gouraud shading: of kVertexLights
  std::uint32_t exactShadows = 0;   ///< and the lights, a bit each, that have exact ones
  bool places = false;              ///< of Form::Shadow and Transmittance: DrawList::findsPlaces
  bool givenOrder = false;          ///< of Form::BlendLayers: BlendOrder::Given

  friend auto operator<=>(const DrawState&, const DrawState&) = default;
};

/// What a state shows of the geometry, if it shows geometry.
struct Inspection {
  std::uint32_t quantity;  ///< shared::kPosition and on
  bool asColor;
};
[[nodiscard]] std::optional<Inspection> inspectionOf(const DrawState& state);

/// Whether draws of this state read the mesh's surface parameters.
[[nodiscard]] bool readsParameters(const DrawState& state);

/// Whether its points are lit later.
[[nodiscard]] bool isFoundOnly(const DrawState& state);

/// Whether its triangles are drawn again to light their points.
[[nodiscard]] bool isAgain(const DrawState& state);
/// And with light that is to be added, once for each pixel (Form::AddLight).
[[nodiscard]] bool addsMoreLight(const DrawState& state);

/// Whether it is about points in the lists of what is seen through.
[[nodiscard]] bool isOfLayers(const DrawState& state);

}  // namespace luxo
