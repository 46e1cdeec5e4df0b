// SPDX-License-Identifier: Apache-2.0
// Value noise on a lattice of hashed integers: 0 to 1, with continuous derivatives. The hash is that of M. Jarzynski and
// M. Olano ("Hash functions for GPU rendering", JCGT 2020: pcg3d), the same on every device.
#ifndef NOISE_GLSL
#define NOISE_GLSL

float latticeValue(ivec3 at) {
  uvec3 v = uvec3(at) * 1664525u + 1013904223u;
  v.x += v.y * v.z;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v ^= v >> 16u;
  v.x += v.y * v.z;
  return float(v.x >> 8u) / 16777216.0;
}

float noise(vec3 place) {
  vec3 low = floor(place), part = place - low, weight = part * part * (3.0 - 2.0 * part);
  ivec3 at = ivec3(low);
  float layers[2];
  for (int z = 0; z < 2; ++z) {
    float near = mix(latticeValue(at + ivec3(0, 0, z)), latticeValue(at + ivec3(1, 0, z)), weight.x);
    float far = mix(latticeValue(at + ivec3(0, 1, z)), latticeValue(at + ivec3(1, 1, z)), weight.x);
    layers[z] = mix(near, far, weight.y);
  }
  return mix(layers[0], layers[1], weight.z);
}

// Octaves of it, each twice as fine and half as strong: 0 to 1.
float turbulence(vec3 place, int octaves) {
  float sum = 0.0, weight = 0.5, all = 0.0;
  for (int i = 0; i < octaves; ++i) {
    sum += weight * abs(2.0 * noise(place) - 1.0);
    all += weight;
    place = 2.0 * place + 17.0;
    weight *= 0.5;
  }
  return sum / all;
}

// Gradient noise, -1 to 1 and 0 on the lattice, with continuous second derivatives (K. Perlin, "Improving noise", SIGGRAPH
// 2002): its derivatives, and it.
vec4 gradientNoise(vec3 place) {
  vec3 low = floor(place), part = place - low;
  vec3 weight = part * part * part * (part * (6.0 * part - 15.0) + 10.0), slope = 30.0 * part * part * (part - 1.0) * (part - 1.0);
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 8; ++i) {
    ivec3 corner = ivec3(i & 1, i >> 1 & 1, i >> 2);
    int edge = int(12.0 * latticeValue(ivec3(low) + corner));  // toward the middle of one of a cube's
    vec2 way = vec2(1 - 2 * (edge & 1), 1 - (edge & 2));
    vec3 gradient = edge < 4 ? vec3(0.0, way) : edge < 8 ? vec3(way.x, 0.0, way.y) : vec3(way, 0.0);
    vec3 w = mix(1.0 - weight, weight, vec3(corner)), s = mix(-slope, slope, vec3(corner));
    float height = dot(gradient, part - vec3(corner));
    sum += vec4(w.x * w.y * w.z * gradient + height * vec3(s.x * w.y * w.z, w.x * s.y * w.z, w.x * w.y * s.z),
                height * w.x * w.y * w.z);
  }
  return sum;
}
#endif
