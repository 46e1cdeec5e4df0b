// SPDX-License-Identifier: Apache-2.0
// Melting ice: what is around, mirrored and refracted by a normal that bumps bend, which run down with the water (J. Blinn and
// M. Newell, "Texture and reflection in computer generated images", CACM 1976; Blinn, "Simulation of wrinkled surfaces",
// SIGGRAPH 1978), as much of each as Fresnel's equations say. Around are a room with two lamps, and a table of slate.
#include "noise.glsl"

uniform int part = 0;            // @select ice|slate|water
uniform float time;
uniform float index = 1.31;      // @slider 1.0 2.0
uniform float bump = 0.05;       // metres @slider 0 0.3
uniform float scale = 1.6;       // waves per metre @slider 0.2 8
uniform vec3 flow = vec3(0.0, -0.12, 0.0);  // metres a second
uniform vec3 middle = vec3(0.0);            // of the block, where air is frozen in
uniform float cloud = 1.0;       // how much of it @slider 0 3
uniform vec3 absorbs = vec3(0.55, 0.16, 0.10);      // per metre
uniform vec3 sky = vec3(0.10, 0.14, 0.20);          // @color
uniform vec3 ground = vec3(0.012, 0.015, 0.02);     // @color
uniform float lamps = 7.0;       // @slider 0 20
uniform vec3 stone = vec3(0.030, 0.034, 0.040);     // @color

// A soft rectangle around 0.
float pane(vec2 at, vec2 half_, float soft) {
  vec2 inside = smoothstep(-half_ - soft, -half_ + soft, at) * (1.0 - smoothstep(half_ - soft, half_ + soft, at));
  return inside.x * inside.y;
}

vec3 room(vec3 way) {
  vec3 color = mix(ground, sky, smoothstep(-0.05, 0.15, way.y));
  if (way.y > 0.0) color += lamps * vec3(0.9, 0.96, 1.0) * pane(way.xz / way.y - vec2(-0.5, 0.1), vec2(0.45, 0.7), 0.06);
  if (way.z < 0.0) color += 0.6 * lamps * vec3(1.0, 0.9, 0.78) * pane(way.xy / -way.z - vec2(0.75, 0.45), vec2(0.16, 0.5), 0.04);
  return color;
}

// Slate with veins of quartz, which fade where they are finer than pixels.
vec3 slate(vec3 place, float pixel) {
  float grain = clamp(1.5 - 14.0 * pixel, 0.0, 1.0) * gradientNoise(14.0 * place).w;
  float vein = abs(gradientNoise(0.3 * place + 0.25 * gradientNoise(0.9 * place).xyz).w);
  return stone * (1.0 + 0.5 * grain) + 6.0 * stone * (1.0 - smoothstep(0.0, 0.015 + 0.5 * pixel, vein)) * clamp(1.0 - 4.0 * pixel, 0.0, 1.0);
}

// What comes along a way from a place: the table at y = 0, or the room.
vec3 around(vec3 place, vec3 way) {
  if (way.y >= -1e-3 || place.y < 0.0) return room(way);
  vec3 at = place - place.y / way.y * way;
  float far = length(at.xz);
  return mix(2.0 * slate(at, 0.02), room(way), smoothstep(4.0, 12.0, far));
}

// What is mirrored, of both polarisations.
float fresnel(float c) {
  float g = sqrt(index * index - 1.0 + c * c), s = (g - c) / (g + c), p = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
  return 0.5 * s * s * (1.0 + p * p);
}

// Of a surface that is higher by that along its normal.
vec3 bentNormal(Point p) {
  vec3 slope = vec3(0.0);
  float height = bump;
  float pixel = length(p.Su * p.footprint[0].x + p.Sv * p.footprint[0].y), frequency = scale;
  for (int i = 0; i < 3; ++i) {
    vec3 place = frequency * (p.object - objectVector(flow * time));
    slope += clamp(1.5 - frequency * pixel, 0.0, 1.0) * height * frequency * gradientNoise(place).xyz;
    frequency *= 2.3;
    height *= 0.25;
  }
  slope = worldNormal(slope);
  return normalize(p.normal - slope + dot(slope, p.normal) * p.normal);
}

// Air that is frozen into the block: how much of what is behind it a ray still sees.
float clear(vec3 place, vec3 way) {
  const float kStep = 0.12;
  float sum = 0.0;
  for (int i = 0; i < 9; ++i) {
    vec3 at = place + (float(i) + 0.5) * kStep * way - middle;
    float core = exp(-9.0 * dot(at, at)) * (1.0 + 1.6 * gradientNoise(vec3(6.0, 2.5, 6.0) * (at + middle)).w);
    sum += cloud * max(core, 0.0) * kStep;
  }
  return exp(-2.2 * sum);
}

vec4 material(Point p) {
  bool isStone = part == 1;
  vec3 n = isStone ? p.normal : bentNormal(p);
  float c = clamp(dot(n, p.viewer), 0.02, 1.0), mirrored = fresnel(c);
  vec3 up = vec3(0.0), shine = vec3(0.0);
  for (int i = 0; i < lightCount(); ++i) {
    Light l = light(i);
    // Some light gets through the blocks, which are what stands on the table.
    vec3 seen = part == 0 ? l.visible : mix(vec3(0.30, 0.42, 0.5), vec3(1.0), l.visible);
    float cosine = max(dot(p.normal, l.direction), 0.0);
    up += cosine * seen * l.radiance;
    if (cosine > 0.0) shine += seen * l.radiance * pow(max(dot(n, normalize(l.direction + p.viewer)), 0.0), isStone ? 30.0 : 400.0);
  }
  vec3 toMirror = reflect(-p.viewer, n);
  if (isStone) {
    vec3 color = slate(p.position, length(p.Su * p.footprint[1].x + p.Sv * p.footprint[1].y));
    return vec4(color * (ambientLight() + up) + 0.04 * shine + 0.35 * mirrored * room(toMirror), 1.0);
  }
  vec3 through;
  if (part == 2) {
    through = slate(p.position, 0.01) * (ambientLight() + up);
  } else {
    vec3 way = refract(-p.viewer, n, 1.0 / index);
    float open = clear(p.object, objectVector(way));
    through = exp(-absorbs) * mix(vec3(0.75, 0.85, 0.95) * (0.5 * up + 2.0 * ambientLight()), around(p.position, way), open);
  }
  return vec4(mix(through, around(p.position, toMirror), mirrored) + 2.0 * shine, 1.0);
}
