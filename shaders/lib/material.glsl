// SPDX-License-Identifier: Apache-2.0
// What a material's shader is given, and what it gives: shaders/MATERIALS.md is the manual. Names here are for good.
#ifndef LUXO_LIB_MATERIAL_GLSL
#define LUXO_LIB_MATERIAL_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shared/loop_rounds.h"

// The point to be lit. Directions are unit, with the axes of the world.
struct Point {
  vec3 position;   // metres, world
  vec3 object;     // the same on the axes of its node
  vec3 normal;     // exact, of the side that is shown
  vec3 viewer;     // toward the viewer
  vec3 tangent;    // along u, perpendicular to the normal; 0 where there is none
  vec3 bitangent;  // perpendicular to both, on the side that v grows to
  vec3 Su, Sv;     // how the position moves with u and v, metres; 0 where they do not say
  vec2 uv;
  float K, H, k1, k2;  // how the surface itself bends (engine/scene/surface_names.h); 0 of triangles
  mat2 footprint;  // how uv move to the pixel at the right (first column), and to that below
};

struct Light {
  vec3 direction;  // unit, toward the light
  float distance;  // metres; 1e30 of a light at infinity
  vec3 radiance;   // that arrives where nothing is in the way: color * intensity, with its attenuation and cone
  vec3 visible;    // how much of that does arrive, 0 to 1
};

// What a ray meets first.
struct Hit {
  bool found;
  bool inside;     // it meets the back of a surface: from within, where that is closed
  float distance;  // metres along the ray; 1e30 of none
  vec3 position;
  vec3 normal;     // exact, of the side that is met: against the ray
  vec2 uv;
  vec3 color;      // the light that comes along the ray: of none the background
  uint number;     // luxo's own
};

int lightCount();
Light light(int i);
vec3 ambientLight();
// All lights, the ambient one too, by the model that materials without a shader have.
vec3 blinnPhong(vec3 diffuse, vec3 specular, float shininess);
// The material's maps, filtered over the pixel; 1 where there is none.
vec3 colorMap(vec2 uv);
vec3 specularMap(vec2 uv);
vec3 glowMap(vec2 uv);
// A sampler, which is the number of its map's numbers: filtered over the pixel as if uv were the surface's; or as if they
// moved so to the pixel at the right, and to that below.
vec4 texture(int map, vec2 uv);
vec4 textureGrad(int map, vec2 uv, vec2 right, vec2 below);
// From the axes of the point's node to those of the world, and back: of directions, which keep no length where the node is
// scaled; and, by the inverse transposed, of normals and of gradients, which bump maps are made of.
vec3 worldVector(vec3 object);
vec3 objectVector(vec3 world);
vec3 worldNormal(vec3 object);
// A ray from the point that is lit, or onward from what another has met: into the scene, by the reference.
Hit trace(vec3 direction);
Hit trace(Hit from, vec3 direction);

// The shader's: linear RGB, and the opacity, which is 1 unless a line of the shader is `#pragma luxo opacity`.
vec4 material(Point p);

// Loops of shaders end after kLuxoMaxRounds rounds.
uint luxoRounds = 0;
bool luxoStops() { return ++luxoRounds > kLuxoMaxRounds; }
#define LUXO_ASKS if (luxoStops()) break; else

// Whether a vertex program (lib/course_point.glsl) has led its vertex away from the point.
bool luxoMoved = false;
#endif
