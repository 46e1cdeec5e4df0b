// SPDX-License-Identifier: Apache-2.0
// What the CPU hands to the scene shaders: one definition for C++ and GLSL, scalar block layout.
// Positions are in metres relative to the eye, or, where all there is is far from it, to a point near that (draw/
// instance_data.h), with the axes of the world; directions have the axes of the world.
#ifndef LUXO_SHARED_SCENE_DATA_H
#define LUXO_SHARED_SCENE_DATA_H
#include "shared/bindings.h"
#include "shared/types.h"

#ifdef __cplusplus
#include <cstddef>

namespace luxo::shared {
#endif

// What a fragment tells of its point: geometry, as numbers (auxiliary outputs) or colours (debug views); its light; or all
// that lights it later (shaders/lib/found_texel.glsl).
LUXO_CONSTANT kPosition = 0;
LUXO_CONSTANT kNormal = 1;
LUXO_CONSTANT kParameters = 2;
LUXO_CONSTANT kDepth = 3;
LUXO_CONSTANT kId = 4;
LUXO_CONSTANT kResidual = 5;
LUXO_CONSTANT kCertificate = 6;
LUXO_CONSTANT kLight = 7;
LUXO_CONSTANT kFoundTexel = 8;

// Values of a certificate: by the search that found the point, or as a triangle that is the surface has it; by a ray cast
// in double that proves it; or none.
LUXO_CONSTANT kBySearch = 1;
LUXO_CONSTANT kByRay = 2;
LUXO_CONSTANT kUncertified = 3;

// Cells of a shell: a root that is farther from where its search began is not certified. What a shell says of derivatives
// has to hold as far, and a cell more (kSearchedCells).
LUXO_NUMBER kFarCells = 2.0;

// Pixels: where single precision may be farther off no point is certified.
LUXO_NUMBER kMaxTolerancePx = 7e-4;

// The numbers of a patch that is searched for by its equation, instead of parameters, in metres. Of a quadric or of a torus:
LUXO_CONSTANT kQuadricSquares = 0;  // of x, y and z
LUXO_CONSTANT kQuadricHalfY = 3;
LUXO_CONSTANT kQuadricConstant = 4;
LUXO_CONSTANT kQuadricCenter = 5;  // on the axis
LUXO_CONSTANT kTorusRing = 0;
LUXO_CONSTANT kTorusTube = 1;
// Of all: the edges (kRadial: of the distance from the axis, y and z); what u and v go along, where they start and how they
// grow; metres per unit.
LUXO_CONSTANT kEquationLowest = 6;
LUXO_CONSTANT kEquationHighest = 9;
LUXO_CONSTANT kEquationU = 12;
LUXO_CONSTANT kEquationV = 15;
LUXO_CONSTANT kEquationScale = 18;
LUXO_CONSTANT kEquationNumbers = 21;

// What a parameter goes along: Equation::Along.
LUXO_CONSTANT kAlongX = 0;
LUXO_CONSTANT kAlongY = 1;
LUXO_CONSTANT kAlongZ = 2;
LUXO_CONSTANT kAlongRadius = 3;
LUXO_CONSTANT kAlongTurn = 4;
LUXO_CONSTANT kAlongLatitude = 5;
LUXO_CONSTANT kAlongTube = 6;

// Pixels: how far a device may draw the corners of triangles beside where they are (engine/cull/raster_slack.h).
LUXO_NUMBER kMovedPx = 0.015625;

// Of depths, what single precision rounds away of them in a dozen operations: 2^-21.
LUXO_NUMBER kDepthRounding = 4.76837158203125e-7;

// What is in doubt, some bits a pixel, row by row: a search has lost a surface there, or what it has found is not certified,
// even if something else is seen in front of it: the point which that search should have found may be nearer; whether what is
// seen is in shadow was not settled; or what is seen through. And of that, what no ray has proven either.
LUXO_CONSTANT kPointOpenHere = 1;
LUXO_CONSTANT kShadowOpenHere = 2;
LUXO_CONSTANT kLayersOpenHere = 4;
LUXO_CONSTANT kLayersUndecidedHere = 8;
LUXO_CONSTANT kDoubtBits = 4;
LUXO_CONSTANT kDoubtsPerWord = 8;

// Numbers of materials in a found texel, a power of 2, which leaves 12 bits to the residual; and as many as every device has
// room for in a uniform buffer, which a CPU device reads faster than a storage buffer.
LUXO_CONSTANT kMaxFoundMaterials = 1 << 20;
LUXO_CONSTANT kUniformMaterials = 256;

LUXO_CONSTANT kMaxLights = 32;  // of a set

// Instance flags.
LUXO_CONSTANT kTwoSided = 1;    // the normal turns toward the viewer
LUXO_CONSTANT kPlane = 8;       // all in one plane
LUXO_CONSTANT kShowsBack = 16;  // not only the outer side is seen
LUXO_CONSTANT kFromAbove = 32;  // of a plane: seen from where cross(z axis, x axis) of the transform points to
LUXO_CONSTANT kIsSurface = 64;  // the triangles are the surface itself, and rays find its points where it is seen through

// Of a point that a ray has found, and that it does not prove to be the nearest.
LUXO_CONSTANT kUndecided = 128;

// Material flags, which join these.
LUXO_CONSTANT kLectureSpecular = 2;  // the highlight is not gated by N.L > 0
LUXO_CONSTANT kPatternAmbient = 4;   // the ambient colour is the pattern's, times MaterialData::ambient
LUXO_CONSTANT kShadeShift = 8;       // 8 bits from here: ShadeData::number of the lights whose shade is made of it, or 0

// Flags of draws, which join these.
LUXO_CONSTANT kBackSide = 1 << 22;     // these triangles, seen from the front, lead to the back of the surface
LUXO_CONSTANT kNegative = 1 << 23;     // where they are seen from the front, areas of the parameters on it are negative
LUXO_CONSTANT kPerspective = 1 << 24;
LUXO_CONSTANT kPointLight = 1 << 25;   // of the first light that is carried; kFlagsOfLight on, of the next
LUXO_CONSTANT kInverseSquare = 1 << 26;
LUXO_CONSTANT kFlagsOfLight = 2;

// Flags of patches, which join them all.
LUXO_CONSTANT kInward = 1 << 16;    // Su x Sv points inward
LUXO_CONSTANT kWrapsU = 1 << 17;    // the formula goes on beyond the ends of u, which are the same curve
LUXO_CONSTANT kWrapsV = 1 << 18;
LUXO_CONSTANT kPoleLow = 1 << 19;   // the edge of lowest v (with kPolesOfU: of u) is one point
LUXO_CONSTANT kPoleHigh = 1 << 20;  // that of highest
LUXO_CONSTANT kPolesOfU = 1 << 21;
LUXO_CONSTANT kRisesOutward = 1 << 29;  // of an equation: F is positive on the outer side
LUXO_CONSTANT kRadial = 1 << 30;        // what it limits is the distance from the axis, not x
LUXO_CONSTANT kBordered = 1u << 31;     // an edge is a border of the surface

struct ViewData {
  mat4 clipFromRelative;
  vec4 viewer;        // w = 1: the eye; w = 0: the unit direction toward an orthographic viewer
  vec4 forward;       // unit view direction; the depth of what positions are relative to
  vec2 depthRange;    // nearest and farthest depth in the picture, for the depth view
  // Of the middle of the picture, and what pixels right of and below it add: the place that is seen at the depth of what
  // positions are relative to, and how it moves with the depth.
  vec3 placeMiddle, placeRight, placeDown, rayMiddle, rayRight, rayDown;
  vec2 middle;        // of the picture, pixels
  float occlusionRadius;  // metres
};

struct InstanceData {
  vec4 relativeFromObject[3];  // columns; and, in w, coordinates of a point of object space
  vec3 translation;            // where that is
  mat3 normalFromObject;  // cofactor matrix, largest entry 1; unit length is restored per vertex
  uint flags;
  uint material;
  uint id;      // the node's number in file order, from 1
  vec4 domain;  // u and v at the lower corner, width in u and v
};

struct MaterialData {
  vec3 ambient;  // ka * La: already multiplied by the scene's ambient light
  float shininess;
  vec3 diffuse;
  float opacity;  // 0: of what is not seen through
  vec3 specular;
  uint flags;
  uint firstPatternParameter;  // in the buffer of them all
  uint pattern;                // 1 + index among the picture's patterns; 0: none; or
  uint blend;                  // below; and of what is seen through its node's number, from bit kIdShift on
  float leastOpaque;           // lib/cutoff.glsl
};

// Of opacities: luxo::kLeastShown (scene/material.h).
LUXO_NUMBER kLeastShown = 0.0009765625;

// A material whose meshes are drawn again to light the points that they have put down.
LUXO_CONSTANT kDrawnAgain = 0xffffffffu;

// What comes through from behind: 1 - opacity of it; all of it; 1 - opacity of it times the diffuse colour.
LUXO_CONSTANT kBlendOver = 0;
LUXO_CONSTANT kBlendAdd = 1;
LUXO_CONSTANT kBlendMultiply = 2;
LUXO_CONSTANT kBlendMode = 3;  // the bits of these
LUXO_CONSTANT kIdShift = 2;

// The numbers of a texture (shaders/lib/texture.glsl), by draw/texture_list.cpp.
LUXO_CONSTANT kTextureLinear = 0;    // columns of the matrix that takes u and v to the image
LUXO_CONSTANT kTextureConstant = 4;  // what is added
LUXO_CONSTANT kTextureTint = 6;
LUXO_CONSTANT kTextureSize = 9;
LUXO_CONSTANT kTextureLevels = 11;
LUXO_CONSTANT kTextureFirst = 12;    // the first texel's index: 65536 times the first number, and the second
LUXO_CONSTANT kTextureWraps = 14;    // of u, of v: luxo::TextureWrap (scene/texture_map.h)
LUXO_CONSTANT kTextureNearest = 16;  // instead of a filter
LUXO_CONSTANT kTextureAnisotropy = 17;
LUXO_CONSTANT kTextureNumbers = 18;
LUXO_CONSTANT kNormalNumbers = 9;  // after those of a map of normals: columns of the matrix that turns its vectors

// Of wraps; the other repeats the image.
LUXO_CONSTANT kWrapClamp = 1;
LUXO_CONSTANT kWrapMirror = 2;

// Of half an axis of the octahedron, for the normals of points at rest (shaders/lib/rest_frame.glsl): 15 bits a number.
LUXO_NUMBER kRestSteps = 16383.0;

// The numbers of a material's shader, by draw/material_program.cpp; its uniforms are behind them. Matrices by
// columns.
LUXO_CONSTANT kShaderOrigin = 0;  // of positions: what they are relative to, in the world
LUXO_CONSTANT kShaderObjectFromRelative = 3;
LUXO_CONSTANT kShaderObjectOrigin = 12;  // what is added
LUXO_CONSTANT kShaderAmbient = 15;       // the scene's ambient light
LUXO_CONSTANT kShaderRelativeFromObject = 18;  // of directions
LUXO_CONSTANT kShaderNumbers = 27;

struct LightData {
  vec4 position;  // w = 1: a point; w = 0: the unit direction toward a light at infinity
  vec3 radiance;  // color * intensity
  uint inverseSquare;
};

// What finding the surface in a pixel takes beside InstanceData, at the same index. Rows are linear functions of the
// object's points (w: the constant term).
//
// A search in double computes with numbers that are sums of two floats, 48 bits: devices read them faster than doubles.
//
// Of a plane that is found as such rows are functions of the pixel, right of and below the middle: x / w, z / w and w of
// the place it shows. The fourth numbers are those of the depth, of x, of z and the constant term.
struct ExactInstance {
  vec4 x, y;       // pixels right of and below the middle of the picture, times what `depth` gives (perspective)
  vec4 depth;      // metres along the view axis
  vec4 xLow, yLow, depthLow;  // the second floats of these
  // Of the depth buffer: perspective x / depth, orthographic 1 + y * (depth - x), x being the near plane's depth: so floats
  // tell sides of it as well as they tell depths. Perspective: y / depth is the part of the tolerance that depends on the
  // depth.
  vec2 clipDepth;
  vec2 half_;      // half the picture's size, pixels
  vec3 middle, middleLow;  // a point of object space that relative positions are computed from
  vec3 translation;  // where that is
  float facing;    // +1 or -1: the sign of the parameters' area in the picture on the front of the surface
  float tolerance; // largest residual, pixels; see clipDepth
  uint firstPatch;
  vec3 origin;     // of the shell's vertices, object space
  // Of a plane: metres of the object in a pixel (perspective: at depth 1). Else:
  float thickness; // farther from the surface than this no search looks, pixels (perspective: times depth); see mayHoldEye()
  // In double: pixels and depth, as x, y and depth of what is no plane, of points relative to the shell's origin.
  vec4 shellX, shellY, shellDepth, shellXLow, shellYLow, shellDepthLow;
};

// A patch of a surface.
struct ExactPatch {
  vec4 domain, domainLow;  // lowest u and v, highest u and v
  uint flags;
  uint firstParameter;     // of the formula's parameters, in the buffer of them all: two floats each
};

// Pushed to vertices of a shell.
struct ShellDraw {
  float side;   // of the surface, that these triangles lead to: +1 front, -1 back
  float guard;  // how many times as large as the picture the viewport is
};

// Pushed to vertices that cover a pixel each (shaders/lib/around_place.glsl).
struct RayTarget {
  vec2 size;  // of the target, pixels
  float guard;  // as above
};

// The shade of a light in its focus: what is lit is known in closed form.
struct ShadeData {
  vec3 axis;  // unit, from the vertex through the focus out of the opening
  float cosRim;
  float reach;  // points nearer to the focus than `reach` more than they are along the axis are inside the shade
  uint number;  // from 1, of the first in the light set with the same shade
};

// The cone of a spot (engine/scene/spot_cone.h).
struct SpotData {
  vec3 axis;        // unit, the way that it shines
  vec3 through;     // the point of the axis that is nearest to what positions are relative to: across from there floats are
                    // as good as positions, however far the light is
  float rise;       // 1 - cos outer
  float perPenumbra;  // 1 / (cos inner - cos outer)
};

struct LightSet {
  LightData lights[kMaxLights];  // the shaded ones last
  ShadeData shades[kMaxLights];  // of the shaded ones, in their order
  uint order[kMaxLights];        // of a light's node among those that have some; points of a wide light share it
  SpotData spots[kMaxLights];    // of those of kConstantSpots, at their index among all
};

// A cell of a caster (engine/shadow/caster_cells.h), object space.
struct CasterCell {
  vec2 middle, half_;  // of its u and v, less originOfU
  vec3 bend;           // suprema of |Suu|, |Suv|, |Svv|; the first below 0: nothing is proven
  uint patch_;
  float originOfU, outward;  // outward: +1 or -1, times Su x Sv
  float bendsAway;           // from that side of Su x Sv, +1 or -1, everywhere; 0: not proven
};

// Pushed to the shaders of a shadow that is flattened onto a plane.
struct FlatShadow {
  mat4 clipFromObject;  // to where the light's rays meet the plane
  vec4 height;          // dot(height, (position, 1)): over the plane; of a point light in units of that of the light
  float highest;        // what is no lower casts no shadow
  uint light;           // its bit
  uint receiver;        // number of the plane's material
  vec3 transmittance;   // of a caster that lets light through
};

// One of the pictures of a light's depth map; they are side by side in one target.
struct LightMapFace {
  vec3 right, down, forward;  // unit
  vec3 origin;                // what depths are counted from; the middle of the picture is straight ahead of it
};

LUXO_CONSTANT kLightMapFacesInRow = 3;  // of six

// The depth map of a light, and how points are compared with it (engine/scene/light.h).
struct LightMap {
  LightMapFace faces[6];
  vec4 light;    // w = 1: where it is; w = 0: the direction toward it
  uint faceCount, size;  // of one face, texels
  float texel;   // what one is wide, metres (of a point light: at depth 1)
  vec2 depthOfBuffer;  // of a value x of the depth buffer: the first / x (point light), or the first + the second x
  float bias, slopeBias, normalOffset;
  uint pcf, receiverPlane;
  float radius;
};

struct GridEntry {
  uint cell;
  float nearest;
};

// The numbers of a triangle that rays meet, as draw/caster_list.cpp lists them: its corners, and behind these, where
// something on it depends on them, their parameters.
LUXO_CONSTANT kCornerNumbers = 3;  // of each corner
LUXO_CONSTANT kTriangleNumbers = 3 * kCornerNumbers;
LUXO_CONSTANT kCornerParameters = 2;

LUXO_CONSTANT kParallelLight = 1;
LUXO_CONSTANT kGatedLight = 2;    // it lights nothing that faces away
LUXO_CONSTANT kFlatCaster = 4;
LUXO_CONSTANT kConvexCaster = 8;  // no point of it that faces the light is in its shadow
LUXO_CONSTANT kShowsFront = 32;   // what is seen through: only the outer side is seen
LUXO_CONSTANT kTurnsNormal = 64;  // and its normal turns toward the viewer
LUXO_CONSTANT kTintsLight = 128;  // what it lets through has its diffuse colour
LUXO_CONSTANT kRadialCaster = 256;  // of an equation: what it limits is the distance from the axis, not x
LUXO_CONSTANT kRoundedPoints = 512;  // of an equation: points that floats have moved off it may be its own

// What may keep a light from what is seen: a node, or those of its patches that share their code, as the light sees them
// (engine/shadow/light_grid.h).
struct ShadowCaster {
  mat3 gridFromRelative;    // with gridOrigin: the axes of the grid
  vec3 gridOrigin;
  mat3 objectFromRelative;  // with objectOrigin
  vec3 objectOrigin;
  vec4 lightObject;         // w = 1: where it is; w = 0: the direction toward it
  vec4 lightRelative;       // the same
  vec4 faces[6];            // x and y of the first texel; texels per unit
  uint firstTexel[6];
  uint gridSize;
  uint firstEntry, firstCell, firstParameter, parameters;  // parameters: of each patch
  uint light;        // its bit
  uint flags;        // above
  vec4 plane;        // of a flat caster: dot(plane, (position, 1)) is above 0 on the light's side
  float rounding, roundingPerMetre;  // how far floats leave a point from where it is, metres of the object; of these, for
                                     // each metre from what positions are relative to
  float margin;      // the most of that which the grid has room for
  float pixel;       // what a pixel is wide, metres of the object (perspective: at depth 1)
  float offPixels;   // how far what is drawn may be off its surface
  uint material;     // of found texels that show the caster, and nothing else
  vec3 diffuse;      // of a caster that lets light through, as MaterialData has them
  float opacity, leastOpaque;
  uint firstPatternParameter;
};

// A caster that is known as an equation (engine/surface/equation.h), which keeps the light from what is behind it: in units
// of the equation, from its centre on.
struct ClosedCaster {
  vec4 unitFromRelative[3];  // rows; w: the origin
  vec4 light;                // w = 1: where it is; w = 0: the direction toward it
  vec4 lightRelative;        // the same, as points are
  vec3 squares;              // of a quadric: F = squares . p^2 + 2 halfY y + constant
  float halfY, constant;
  float tube;                // of a torus
  float atLight;             // F where the light is; of one at infinity its sign there
  vec3 lowest, highest;      // x (kRadialCaster: the distance from the axis), y, z: beyond there is nothing
  vec3 rounding, roundingPerMetre;  // how far floats leave a point from where it is, by axis; of these, for each metre from
                                    // what positions are relative to
  float offPerPixel;         // how far what is drawn may be off its surface: metres in a pixel (perspective: at depth 1) by the
                             // part of them that floats leave
  uint light_;               // its bit
  uint flags;                // kGatedLight and on
  uint material;             // of found texels that show the caster, and nothing else
};

// A mesh, or those of its patches that share their code, whose surface's own points are found: those it shows.
struct MeshPlace {
  mat3 relativeFromObject;
  vec3 translation;
  uint firstPatch, patches;         // whose domains are cells
  uint firstParameter, parameters;  // parameters: of each patch
  uint material;                    // of found texels that show it, and nothing else
};

// The point that a pixel of such a mesh shows.
struct ShownPoint {
  vec2 parameters;
  uint numberOfMaterial;  // 1 + that; 0: it shows none
};

// A ray that a material's shader has asked for (trace() in shaders/MATERIALS.md): from the point that it lights, or from
// what an earlier one of its rays has met.
LUXO_CONSTANT kMaxTraces = 16;  // of a point
LUXO_CONSTANT kNoQuestion = 0;
LUXO_CONSTANT kFromPoint = 1;
LUXO_CONSTANT kFromFirstHit = 2;  // and on: of the answers to this point, by their number

struct TraceRay {
  vec3 direction;  // unit
  uint from;       // kFromPoint and on
};

// How many points of a picture have shaders of materials that do what they must not: their loops do not end, they are seen
// through and have not said that they may be, move their vertex, send too many rays.
struct ShaderFaults {
  uint endless, seenThrough, moved, manyTraces;
};

// Such a point is a colour of infinities, by their signs: a bit of each channel, 1 where it is negative.
LUXO_CONSTANT kFaultEndless = 0;
LUXO_CONSTANT kFaultMoved = 2;
LUXO_CONSTANT kFaultManyTraces = 6;
LUXO_CONSTANT kFaultSeenThrough = 7;

// What a pixel asks: the number of its answer, whose place another one may have; and the point that it lights.
struct TraceQuestion {
  TraceRay ray;  // kNoQuestion: none
  uint number;
  vec3 position;
};

struct TraceAnswer {
  TraceRay ray;
  float distance;  // metres; negative: it meets nothing
  vec3 position;
  vec3 normal;  // of the side that the ray meets
  vec2 parameters;
  vec3 color;   // that comes along the ray
  uint inside;  // 1: it meets the back, from within where the surface is closed
};

// Kinds of equations.
LUXO_CONSTANT kClosedPlane = 0;
LUXO_CONSTANT kClosedBall = 1;      // all of an ellipsoid
LUXO_CONSTANT kClosedCentered = 2;  // halfY is 0
LUXO_CONSTANT kClosedQuadric = 3;
LUXO_CONSTANT kClosedTorus = 4;

// So many of one light are looked for at once: as many as a draw can tell its fragments of.
LUXO_CONSTANT kMaxClosedCasters = 2;

// Flags beside the number of the material: a point
LUXO_CONSTANT kLayerMaterial = kMaxFoundMaterials - 1;
LUXO_CONSTANT kLayerOfMesh = 1 << 20;     // of triangles,
LUXO_CONSTANT kLayerAtBorder = 1 << 21;   // or on a border between two cells, which may both have found it
LUXO_CONSTANT kLayerByRay = 1 << 22;      // or found by a ray; of a mesh: what reaches it is
LUXO_CONSTANT kLayerPlaced = 1 << 23;     // of triangles, whose surface's own point is known
LUXO_CONSTANT kLayerOfSurface = 1 << 24;  // of triangles that are the surface, whose points rays find, too
LUXO_CONSTANT kLayerHole = 1 << 25;       // found by a ray where its material is cut out

// A point of what is seen through, in the list of its pixel.
struct LayerPoint {
  uint next;      // 0: it is the last
  float depth;    // metres along the view axis, beyond that of what positions are relative to
  float off;      // by so much it may be off
  uint material;  // with flags
  vec2 normal;    // shaders/lib/octahedral.glsl
  vec2 parameters;
  vec3 light;     // what it reflects, times its opacity; of pictures of geometry the opacity: once it is lit
  vec3 through;   // how much comes through from behind; the same
  vec3 place;     // of one that is kLayerPlaced: the surface's own point, relative,
  uint placeNormal;  // and its normal there
  uint triangle;  // of one of triangles: which of its draw's it is in
};

// Of a band of rows: the points that there are, room for them or not; and fragments in which a device ended a loop over them.
struct LayerCount {
  uint points, ended;
};

// Of a pixel's layers as rays have found them, beside the number of groups of lights: not all of them is proven.
LUXO_CONSTANT kUndecidedLayers = 0x80000000u;

// What maps and shaders of materials ask for beside a point of what is seen through: at its index.
struct LayerDetail {
  vec4 footprint;  // how u and v move from the pixel to the next: to the right, below
  vec4 frame;      // engine/scene/normal_map.h
};

// Groups of lights, what of each of which reaches a point is kept, where there are no more (engine/draw/draw_list.h).
LUXO_CONSTANT kKeptGroups = 4;

// What of a group of lights reaches a point.
struct ReachingLight {
  uint shadows;        // the lights, a bit each, that do not
  vec3 transmittance;  // how much of a light its casters let through, where that light is all there is
};

#ifdef __cplusplus
// Whether no two of some flags, which share a word, have a bit in common.
template <class... Flags>
constexpr bool areApart(Flags... flags) {
  return (std::uint64_t{flags} + ...) == (flags | ...);
}
inline constexpr uint kShadeFlags = 0xffu << kShadeShift;
inline constexpr uint kLightFlags = ((1u << kFlagsOfLight * kCarriedLights) - 1) * kPointLight;
static_assert(areApart(kTwoSided, kPlane, kShowsBack, kFromAbove, kIsSurface, kUndecided, kLectureSpecular, kPatternAmbient,
                       kShadeFlags, kBackSide, kNegative, kPerspective, kLightFlags, kInward, kWrapsU, kWrapsV, kPoleLow,
                       kPoleHigh, kPolesOfU, kRisesOutward, kRadial, kBordered));
static_assert(areApart(kParallelLight, kGatedLight, kFlatCaster, kConvexCaster, kShowsFront, kTurnsNormal, kTintsLight,
                       kRadialCaster, kRoundedPoints), "of casters");
static_assert(kMaxLights < kShadeFlags >> kShadeShift);
static_assert(areApart(kLayerMaterial, kLayerOfMesh, kLayerAtBorder, kLayerByRay, kLayerPlaced, kLayerOfSurface, kLayerHole));
static_assert((kMaxFoundMaterials & kLayerMaterial) == 0, "a mask, below the flags");
// What vertices carry: lights, then their shades, do not reach into what follows; of packed numbers at least all but parameters
// have room, 22 that make the others double among them.
static_assert(kCarriedShades == 1, "whose number is 1");
static_assert(kCarriedLights <= kMaxLights && kCarriedShades <= kCarriedLights && kVertexLights <= kMaxLights);
static_assert(kLocationShades + 2 * kCarriedShades <= kLocationDetail);
static_assert(kLightNumbers * kCarriedLights + kShadeNumbers * kCarriedShades + 22 <= 4 * (kVaryings - kLocationPacked));
// What every device has room for: a uniform buffer, what is pushed.
static_assert(kUniformMaterials * sizeof(MaterialData) <= 16384 && sizeof(LightSet) <= 16384);
static_assert(sizeof(ShellDraw) <= 128 && sizeof(RayTarget) <= 128 && sizeof(FlatShadow) <= 128);
// Every number of a texture, of a material's shader and of an equation has a place of its own, and a point with a fault is
// told by the signs of three channels.
static_assert(kTextureLinear + 4 == kTextureConstant && kTextureConstant + 2 == kTextureTint &&
              kTextureTint + 3 == kTextureSize && kTextureSize + 2 == kTextureLevels && kTextureLevels + 1 == kTextureFirst &&
              kTextureFirst + 2 == kTextureWraps && kTextureWraps + 2 == kTextureNearest &&
              kTextureNearest + 1 == kTextureAnisotropy && kTextureAnisotropy + 1 == kTextureNumbers);
static_assert(kShaderOrigin + 3 == kShaderObjectFromRelative && kShaderObjectFromRelative + 9 == kShaderObjectOrigin &&
              kShaderObjectOrigin + 3 == kShaderAmbient && kShaderAmbient + 3 == kShaderRelativeFromObject &&
              kShaderRelativeFromObject + 9 == kShaderNumbers);
static_assert(kQuadricCenter < kEquationLowest && kTorusTube < kEquationLowest && kEquationScale + 3 == kEquationNumbers);
static_assert(kEquationLowest + 3 == kEquationHighest && kEquationHighest + 3 == kEquationU && kEquationU + 3 == kEquationV &&
              kEquationV + 3 == kEquationScale);
static_assert(2 * kRestSteps < 1 << 15, "15 bits a number");
static_assert(kFaultEndless < 8 && kFaultMoved < 8 && kFaultManyTraces < 8 && kFaultSeenThrough < 8);
static_assert(kPointOpenHere < 1u << kDoubtBits && kShadowOpenHere < 1u << kDoubtBits && kLayersOpenHere < 1u << kDoubtBits && kLayersUndecidedHere < 1u << kDoubtBits && kDoubtBits * kDoubtsPerWord == 32);
static_assert(sizeof(ViewData) == 188 && sizeof(InstanceData) == 124 && sizeof(MaterialData) == 64 && sizeof(LightData) == 32 && sizeof(ShadeData) == 24);
static_assert(kMaxLights <= 32);  // a bit each
static_assert(kKeptGroups == 4, "as addLayer() has them");
static_assert(sizeof(CasterCell) == 44 && sizeof(GridEntry) == 8 && sizeof(ShadowCaster) == 340 && sizeof(ClosedCaster) == 172 && sizeof(LayerPoint) == 76 && sizeof(LayerDetail) == 32 && sizeof(ReachingLight) == 16);
static_assert(sizeof(MeshPlace) == 68 && sizeof(ShownPoint) == 12);
static_assert(sizeof(ExactInstance) == 272 && sizeof(ExactPatch) == 40);
static_assert(sizeof(LightSet) == 2944 && sizeof(SpotData) == 32 && offsetof(LightSet, shades) == 1024 && offsetof(LightSet, order) == 1792 && offsetof(LightSet, spots) == 1920);
static_assert(sizeof(FlatShadow) == 104 && sizeof(LightMapFace) == 48 && sizeof(LightMap) == 348);
static_assert(sizeof(TraceRay) == 16 && sizeof(TraceQuestion) == 32 && sizeof(TraceAnswer) == 68 && sizeof(ShaderFaults) == 16);
static_assert(sizeof(ShellDraw) == 8 && sizeof(RayTarget) == 12);
}  // namespace luxo::shared
#endif
#endif
