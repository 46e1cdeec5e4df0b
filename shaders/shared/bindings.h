// SPDX-License-Identifier: Apache-2.0
// By which numbers the programs that draw a scene and C++ mean the same: descriptor sets and their bindings, specialization
// constants, and where vertices carry what.
#ifndef LUXO_SHARED_BINDINGS_H
#define LUXO_SHARED_BINDINGS_H
#include "shared/types.h"

#ifdef __cplusplus
namespace luxo::shared {
#endif

// Descriptor sets: of all draws; of draws with a pattern; of draws that find the surface itself in every pixel.
LUXO_CONSTANT kSetScene = 0;
LUXO_CONSTANT kSetPattern = 1;
LUXO_CONSTANT kSetExact = 2;
LUXO_CONSTANT kSetFound = 2;   // of draws that light what an earlier pass has found
LUXO_CONSTANT kSetShadow = 1;  // of draws that find what is in shadow there; they read its points from kSetFound
LUXO_CONSTANT kSetLayers = 3;  // of draws of what is seen through

// Bindings of kSetPattern.
LUXO_CONSTANT kBindingPatternParameters = 0;
LUXO_CONSTANT kBindingTexels = 1;          // of textures
LUXO_CONSTANT kBindingFoundFootprint = 2;  // of textures that light what an earlier pass has found
LUXO_CONSTANT kBindingFoundFrame = 3;      // the same

// Bindings of kSetScene.
LUXO_CONSTANT kBindingView = 0;
LUXO_CONSTANT kBindingInstances = 1;
LUXO_CONSTANT kBindingLights = 2;  // dynamic offset: the set of lights that reach the draw
LUXO_CONSTANT kBindingMaterials = 3;
LUXO_CONSTANT kBindingShaderFaults = 4;
LUXO_CONSTANT kSceneBindings = 5;

// Bindings of kSetExact.
LUXO_CONSTANT kBindingExactInstances = 0;
LUXO_CONSTANT kBindingExactPatches = 1;
LUXO_CONSTANT kBindingExactParameters = 2;
LUXO_CONSTANT kBindingDoubts = 3;
LUXO_CONSTANT kExactBindings = 4;

// Bindings of kSetFound.
LUXO_CONSTANT kBindingFound = 0;
LUXO_CONSTANT kBindingFoundParameters = 1;
LUXO_CONSTANT kBindingUniformMaterials = 2;  // the first kUniformMaterials of them all
LUXO_CONSTANT kBindingShadows = 3;
LUXO_CONSTANT kBindingTransmittance = 4;
LUXO_CONSTANT kBindingPlaces = 5;
LUXO_CONSTANT kBindingOpenness = 6;
LUXO_CONSTANT kBindingTraceQuestions = 7;
LUXO_CONSTANT kBindingTraceStarts = 8;
LUXO_CONSTANT kBindingTraceAnswers = 9;
LUXO_CONSTANT kBindingMoreLight = 10;
LUXO_CONSTANT kFoundBindings = 11;

// Bindings of kSetShadow.
LUXO_CONSTANT kBindingCasters = 0;
LUXO_CONSTANT kBindingGridStarts = 1;
LUXO_CONSTANT kBindingGridEntries = 2;
LUXO_CONSTANT kBindingCasterCells = 3;
LUXO_CONSTANT kBindingCasterParameters = 4;
LUXO_CONSTANT kBindingShadowDoubts = 5;
LUXO_CONSTANT kBindingCasterPatterns = 6;  // their parameters
LUXO_CONSTANT kBindingLightMaps = 7;
LUXO_CONSTANT kBindingLightDepths = 8;
LUXO_CONSTANT kBindingClosedCasters = 9;
LUXO_CONSTANT kBindingMeshPlaces = 10;
LUXO_CONSTANT kBindingShownPoints = 11;
LUXO_CONSTANT kBindingCasterTexels = 12;  // of their textures
LUXO_CONSTANT kShadowBindings = 13;

// Bindings of kSetLayers.
LUXO_CONSTANT kBindingLayerHeads = 0;
LUXO_CONSTANT kBindingLayerPoints = 1;
LUXO_CONSTANT kBindingLayerCount = 2;
LUXO_CONSTANT kBindingLayerDoubts = 3;
LUXO_CONSTANT kBindingLayerDepth = 4;      // of what is not seen through
LUXO_CONSTANT kBindingRayLayers = 5;       // points that rays have found
LUXO_CONSTANT kBindingLayerMaterials = 6;  // the first kUniformMaterials of them all
LUXO_CONSTANT kBindingLayerSums = 7;
LUXO_CONSTANT kBindingRayLayerLight = 8;
LUXO_CONSTANT kBindingLayerDetails = 9;     // of the points, where some material asks for them
LUXO_CONSTANT kBindingRayLayerDetails = 10;
LUXO_CONSTANT kBindingLayersFound = 11;  // what is not seen through
LUXO_CONSTANT kBindingLayerReaches = 12;  // of the points, what of a group of lights reaches them
LUXO_CONSTANT kLayerBindings = 13;

// Specialization constants of the programs that draw a scene. Loops over lights unroll, so that a light that does not
// reach a draw costs nothing.
LUXO_CONSTANT kConstantPlainLights = 0;
LUXO_CONSTANT kConstantShadedLights = 1;
LUXO_CONSTANT kConstantFacetNormal = 2;     // of meshes
LUXO_CONSTANT kConstantQuantity = 3;        // of the next
LUXO_CONSTANT kConstantAsColor = 4;
LUXO_CONSTANT kConstantParameterCount = 5;  // of a formula
LUXO_CONSTANT kConstantPoles = 6;
LUXO_CONSTANT kConstantCertificate = 7;     // of all points that are not searched for
LUXO_CONSTANT kConstantEquation = 8;
LUXO_CONSTANT kConstantManySamples = 9;
LUXO_CONSTANT kConstantPattern = 10;         // number of the pattern that a draw lights: MaterialData::pattern
LUXO_CONSTANT kConstantManyMaterials = 11;   // more than kUniformMaterials
LUXO_CONSTANT kConstantAddsLight = 12;      // to what is lit already: no ambient light
LUXO_CONSTANT kConstantManyGroups = 13;     // of lights: more than have places for what reaches points
LUXO_CONSTANT kConstantTransmits = 14;      // there is one light, some of which gets through its casters
LUXO_CONSTANT kConstantClosedCasters = 15;  // of a draw
LUXO_CONSTANT kConstantClosedKind = 16;     // of them all
LUXO_CONSTANT kConstantFirstLight = 17;     // of kVertexLights of a group
LUXO_CONSTANT kConstantExactShadows = 18;   // the lights, a bit each, that have exact ones
LUXO_CONSTANT kConstantPlaces = 19;         // some points are of meshes, whose surfaces' own points are known
LUXO_CONSTANT kConstantOcclusion = 20;      // of the ambient light
LUXO_CONSTANT kConstantGivenOrder = 21;     // what is seen through is blended node by node
LUXO_CONSTANT kConstantLayerDetails = 22;   // points of what is seen through come with them
LUXO_CONSTANT kConstantCarries = 23;        // vertices carry what is the same all over the draw
LUXO_CONSTANT kConstantFrontOnly = 24;       // only the front of the surface is shown, and rays go on through its back
LUXO_CONSTANT kConstantSpots = 25;          // the lights, a bit each, that are spots
// A number that the shaders have anyway: each other one would be 16 bytes of them all.
LUXO_CONSTANT kConstantWalks = 30;           // that a root is the first is walked, where nothing else proves it

// So many lights are carried from vertices to fragments; more are read from a buffer, which takes a CPU device longer.
LUXO_CONSTANT kCarriedLights = 2;
LUXO_CONSTANT kCarriedShades = 1;

// Attributes: what vertices are given. Of meshes, and of points that rays have found.
LUXO_CONSTANT kAttributePosition = 0;
LUXO_CONSTANT kAttributeNormal = 1;
LUXO_CONSTANT kAttributeParameters = 2;

// Of meshes alone; from the second on of their instance, whose matrices take three each, by columns.
LUXO_CONSTANT kAttributeTangent = 5;
LUXO_CONSTANT kAttributeRelativeFromObject = 7;
LUXO_CONSTANT kAttributeTranslation = kAttributeRelativeFromObject + 3;
LUXO_CONSTANT kAttributeNormalFromObject = kAttributeTranslation + 1;
LUXO_CONSTANT kAttributeInstanceNumbers = kAttributeNormalFromObject + 3;
LUXO_CONSTANT kAttributeDomain = kAttributeInstanceNumbers + 1;

// Of points that rays have found alone.
LUXO_CONSTANT kAttributePointPlace = 3;
LUXO_CONSTANT kAttributePointFootprint = 4;
LUXO_CONSTANT kAttributePointFrame = 5;
LUXO_CONSTANT kAttributePointFlags = 6;

// Of shells.
LUXO_CONSTANT kAttributeShellPosition = 0;
LUXO_CONSTANT kAttributeShellParameters = 1;
LUXO_CONSTANT kAttributeShellCell = 2;
LUXO_CONSTANT kAttributeShellPatch = 3;

// Of what rays have found of the shadows in a pixel.
LUXO_CONSTANT kAttributeShadowPlace = 0;
LUXO_CONSTANT kAttributeShadows = 1;
LUXO_CONSTANT kAttributeTransmittance = 2;

// Of pixels whose layers rays have found.
LUXO_CONSTANT kAttributeLayerPlace = 0;
LUXO_CONSTANT kAttributeLayerRange = 1;

// So many lights are interpolated between vertices, each by itself, in one draw.
LUXO_CONSTANT kVertexLights = 8;

// Locations: where vertices hand to fragments what these get of them. Of surfaces.
LUXO_CONSTANT kLocationPosition = 0;
LUXO_CONSTANT kLocationNormal = 1;
LUXO_CONSTANT kLocationAmbient = 2;
LUXO_CONSTANT kLocationDiffuse = 3;
LUXO_CONSTANT kLocationSpecular = 4;
LUXO_CONSTANT kLocationShininessOpacity = 5;
LUXO_CONSTANT kLocationNumbers = 6;
LUXO_CONSTANT kLocationViewer = 7;
LUXO_CONSTANT kLocationLights = 8;
LUXO_CONSTANT kLocationShades = kLocationLights + 2 * kCarriedLights;
LUXO_CONSTANT kLocationDetail = 14;  // u, v and the like
LUXO_CONSTANT kLocationParameterBounds = 15;
LUXO_CONSTANT kLocationFootprint = 16;
LUXO_CONSTANT kLocationFrame = 17;    // of points that rays have found
LUXO_CONSTANT kLocationTangent = 17;  // of meshes
LUXO_CONSTANT kLocationRestNormal = 18;

// Of surfaces whose geometry is shown, beside position and normal.
LUXO_CONSTANT kLocationInspectedParameters = 2;
LUXO_CONSTANT kLocationInspectedDomain = 3;
LUXO_CONSTANT kLocationInspectedFlagsId = 4;
LUXO_CONSTANT kLocationInspectedDepth = 5;

// Of light that is interpolated, beside the numbers, details and bounds of surfaces; the rest is what no pattern scales.
LUXO_CONSTANT kLocationFront = 0;
LUXO_CONSTANT kLocationBack = 1;
LUXO_CONSTANT kLocationFrontRest = 2;
LUXO_CONSTANT kLocationBackRest = 3;

// Of light that is interpolated where there are shadows, beside the details and bounds of surfaces.
LUXO_CONSTANT kLocationAgainReceived = 0;
LUXO_CONSTANT kLocationAgainNumbers = kLocationAgainReceived + kVertexLights;
LUXO_CONSTANT kLocationAgainAmbient = kLocationAgainNumbers + 1;
LUXO_CONSTANT kLocationAgainDiffuse = kLocationAgainAmbient + 1;
LUXO_CONSTANT kLocationAgainSpecular = kLocationAgainDiffuse + 1;
LUXO_CONSTANT kLocationAgainOpacity = kLocationAgainSpecular + 1;

// Of draws over the whole target, with kLocationLights where they light it.
LUXO_CONSTANT kLocationTargetViewer = 0;
LUXO_CONSTANT kLocationTargetPlace = 1;
LUXO_CONSTANT kLocationTargetRay = 4;
LUXO_CONSTANT kLocationTargetMiddle = 7;

// Of what rays have found of a pixel's shadows, and of its layers.
LUXO_CONSTANT kLocationShadows = 0;
LUXO_CONSTANT kLocationTransmittance = 0;
LUXO_CONSTANT kLocationLayerRange = 0;
LUXO_CONSTANT kLocationLayerGroup = 1;

// Of planar shadows, and of the lines of wireframes.
LUXO_CONSTANT kLocationFlatHeight = 0;
LUXO_CONSTANT kLocationFlatParameters = 1;
LUXO_CONSTANT kLocationLineDiffuse = 0;

// vec4 that vertices of a shell hand to fragments: more than Vulkan promises, as many as devices have.
LUXO_CONSTANT kVaryings = 30;
// From here on they are packed numbers (shaders/lib/exact_interface.glsl): of each light and each shade that is carried, of
// what makes all others double, and of the formula's parameters.
LUXO_CONSTANT kLocationPacked = 15;
LUXO_CONSTANT kLightNumbers = 6;
LUXO_CONSTANT kShadeNumbers = 5;

#ifdef __cplusplus
// Attributes of one kind of vertex have places of their own, among the 16 that every device has. Shaders that declare two at
// one place do not compile; lists of attributes do.
static_assert(kAttributePosition < kAttributeNormal && kAttributeNormal < kAttributeParameters);
static_assert(kAttributeParameters < kAttributeTangent && kAttributeTangent < kAttributeRelativeFromObject && kAttributeDomain < 16);
static_assert(kAttributeParameters < kAttributePointPlace && kAttributePointPlace < kAttributePointFootprint &&
              kAttributePointFootprint < kAttributePointFrame && kAttributePointFrame < kAttributePointFlags);
static_assert(kAttributeShellPosition < kAttributeShellParameters && kAttributeShellParameters < kAttributeShellCell &&
              kAttributeShellCell < kAttributeShellPatch);
static_assert(kAttributeShadowPlace < kAttributeShadows && kAttributeShadows < kAttributeTransmittance);
static_assert(kAttributeLayerPlace < kAttributeLayerRange);
}  // namespace luxo::shared
#endif
#endif
