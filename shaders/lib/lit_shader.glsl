// SPDX-License-Identifier: Apache-2.0
// The light on a point of a material that has a shader. The file "material" is made from that (draw/material_program.h).
// Where the material's numbers begin that are no map's is LUXO_SHADER_NUMBERS: from kShaderOrigin on (shared/scene_data.h).
#extension GL_GOOGLE_include_directive : require
#include "lib/found.glsl"
#include "lib/lights.glsl"
#define material luxoMaterial  // others call their own so
#include "lib/material.glsl"
#undef material
#include "lib/pattern.glsl"
#include "lib/maps.glsl"
#include "lib/number.glsl"
#include "lib/scene.glsl"

// What the picture tells whoever reads it, instead of a colour: values that are no numbers. NaN is one that the shader
// gave itself.
const uint kNotANumber = 0x7fc00000u, kInfinity = 0x7f800000u;
// A fault's colour.
vec3 infinities(uint signs) { return uintBitsToFloat(kInfinity | uvec3(signs, signs >> 1, signs >> 2) << 31); }

// For whoever shows the picture without reading its pixels.
layout(scalar, set = kSetScene, binding = kBindingShaderFaults) buffer ShaderFaultsOfPicture {
  ShaderFaults shaderFaults;
};

Found litPoint;
float litOpacity;  // that the shader gives

float shaderNumber(uint k) { return patternParameterAt(LUXO_SHADER_NUMBERS + k); }
vec3 shaderNumbers3(uint k) { return vec3(shaderNumber(k), shaderNumber(k + 1), shaderNumber(k + 2)); }
mat3 shaderMatrix(uint k) { return mat3(shaderNumbers3(k), shaderNumbers3(k + 3), shaderNumbers3(k + 6)); }

// Of the picture, in pixels: of shaders that fill it (mainImage in MATERIALS.md).
vec2 luxoPictureSize() { return 2.0 * view.middle; }

int lightCount() { return int(kPlainLights + kShadedLights); }

Light light(int index) {
  uint i = uint(clamp(index, 0, max(lightCount() - 1, 0)));
  LightData data = lightSet.lights[i];
  vec3 toLight = data.position.xyz - litPoint.position * data.position.w;
  float squared = dot(toLight, toLight), inverseDistance = inversesqrt(max(squared, kTiny));
  float arriving = data.inverseSquare != 0 ? min(inverseDistance * inverseDistance, kMaxAttenuation) : 1.0;
  arriving *= spotAttenuation(i, litPoint.position, toLight);
  vec3 visible = vec3(squared > 0.0 && isReached(i, lightsInShadow(), foundMaterial().flags, toLight) ? 1 : 0);
#ifdef LUXO_SHADOWS
  if (kTransmits) visible *= lightTransmittance();
#endif
  return Light(toLight * inverseDistance, data.position.w != 0.0 ? squared * inverseDistance : 1e30,
               data.radiance * arriving, lightCount() > 0 ? visible : vec3(0));
}

#ifdef LUXO_OPENNESS
vec3 ambientLight() { return openness() * shaderNumbers3(kShaderAmbient); }
#else
vec3 ambientLight() { return shaderNumbers3(kShaderAmbient); }
#endif

vec3 blinnPhong(vec3 diffuse, vec3 specular, float shininess) {
  Material plain = Material(ambientLight() * diffuse, diffuse, specular, shininess, foundMaterial().flags);
  return illuminated(plain, litPoint.position, litPoint.normal, litPoint.viewer);
}

vec3 colorMap(vec2 uv) {
#ifdef LUXO_COLOR_MAP
  return texelOfMap(0, mapParameters(uv));
#else
  return vec3(1);
#endif
}

vec3 specularMap(vec2 uv) {
#ifdef LUXO_SPECULAR_MAP
  return texelOfMap(LUXO_SPECULAR_MAP, mapParameters(uv));
#else
  return vec3(1);
#endif
}

vec3 glowMap(vec2 uv) {
#ifdef LUXO_GLOW_MAP
  return texelOfMap(LUXO_GLOW_MAP, mapParameters(uv));
#else
  return vec3(1);
#endif
}

vec4 texture(int map, vec2 uv) { return wholeTexelOfMap(uint(map), uv); }
vec4 textureGrad(int map, vec2 uv, vec2 right, vec2 below) { return wholeTexelOfMap(uint(map), uv, vec4(right, below)); }

vec3 worldVector(vec3 object) { return shaderMatrix(kShaderRelativeFromObject) * object; }
vec3 objectVector(vec3 world) { return shaderMatrix(kShaderObjectFromRelative) * world; }
vec3 worldNormal(vec3 object) { return object * shaderMatrix(kShaderObjectFromRelative); }

#ifdef LUXO_TRACES
#include "lib/trace.glsl"
#endif

#ifdef LUXO_CURVATURE_NUMBERS
// The file "curvature" is a pattern's, made from the surface's formula: K, H, k1 and k2 of u and v.
float curvatureParameterAt(uint k) { return shaderNumber(LUXO_CURVATURE_NUMBERS + k); }
#define parameterAt curvatureParameterAt
#define patternPaint curvaturePaint
#include "curvature"
#undef patternPaint
#undef parameterAt
#endif

// How the point moves on its tangent plane to the next pixel: along the ray, which moves by these.
vec3 stepOnPlane(vec3 moved, vec3 ray, vec3 n) { return moved - ray * (dot(n, moved) / dot(n, ray)); }

float numberOr0(float x) { return isNumber(x) ? x : 0.0; }

Point materialPoint(Found found) {
  vec4 frame = normalFrame(), footprint = pixelFootprint();
  Point p;
  p.position = found.position + shaderNumbers3(kShaderOrigin);
  p.object = shaderMatrix(kShaderObjectFromRelative) * found.position + shaderNumbers3(kShaderObjectOrigin);
  p.normal = found.normal;
  p.viewer = found.viewer;
  p.tangent = frame.xyz;
  p.bitangent = frame.w < 0.0 ? cross(frame.xyz, found.normal) : cross(found.normal, frame.xyz);
  p.uv = mapParameters(found.parameters);
  vec4 bend = vec4(0);
#ifdef LUXO_CURVATURE_NUMBERS
  curvaturePaint(p.uv.x, p.uv.y, bend);
#endif
  p.K = numberOr0(bend.x);
  p.H = numberOr0(bend.y);
  p.k1 = numberOr0(bend.z);
  p.k2 = numberOr0(bend.w);
  p.footprint = mat2(footprint.xy, footprint.zw);
  vec2 pixel = gl_FragCoord.xy - view.middle;
  vec3 ray = view.rayMiddle + pixel.x * view.rayRight + pixel.y * view.rayDown;
  float along = dot(found.position, view.forward.xyz), area = determinant(p.footprint);
  vec3 right = stepOnPlane(view.placeRight + along * view.rayRight, ray, found.normal),
       below = stepOnPlane(view.placeDown + along * view.rayDown, ray, found.normal);
  p.Su = p.Sv = vec3(0);
  if (abs(area) > kTiny) {
    p.Su = (right * footprint.w - below * footprint.y) / area;
    p.Sv = (below * footprint.x - right * footprint.z) / area;
  }
  return p;
}

void loadUniforms();

#ifdef LUXO_FIRST_OF_ISOLINES
// Lines are lit as a material without a shader is.
vec3 underIsolines(vec3 color, vec2 parameters) {
  parameters = patternParametersAt(parameters);
  vec4 lines = isolinesOver(parameters.x, parameters.y);
  if (!(lines.a > 0.0)) return color;
  Material line = foundMaterial();
  line.diffuse = lines.rgb / lines.a;
  if ((line.flags & kPatternAmbient) != 0) line.ambient *= line.diffuse;
  return (1.0 - lines.a) * color + lines.a * illuminated(line, litPoint.position, litPoint.normal, litPoint.viewer);
}
#endif

vec3 lit(Found found) {
  litPoint = found;
  litOpacity = 1.0;
  loadUniforms();
  luxoRounds = 0;
#ifdef LUXO_TRACES
  beginTraces();
#endif
  luxoMoved = false;
  vec4 color = luxoMaterial(materialPoint(found));
  if (luxoRounds > kLuxoMaxRounds) {
    atomicAdd(shaderFaults.endless, 1u);
    return infinities(kFaultEndless);
  }
  if (luxoMoved) {
    atomicAdd(shaderFaults.moved, 1u);
    return infinities(kFaultMoved);
  }
#ifdef LUXO_TRACES
  askTraces();
  if (tracesTooOften()) {
    atomicAdd(shaderFaults.manyTraces, 1u);
    return infinities(kFaultManyTraces);
  }
#endif
  bool numbers = isColor(color.rgb) && isNumber(color.a);
  if (!numbers) return vec3(uintBitsToFloat(kNotANumber));
#ifdef LUXO_OPACITY
  litOpacity = clamp(color.a, 0.0, 1.0);
#else
  if (color.a < 1.0) {
    atomicAdd(shaderFaults.seenThrough, 1u);
    return infinities(kFaultSeenThrough);
  }
#endif
#ifdef LUXO_FIRST_OF_ISOLINES
  return underIsolines(color.rgb, found.parameters);
#else
  return color.rgb;
#endif
}

#define material luxoMaterial
#include "material"
#undef material
