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
#endif
