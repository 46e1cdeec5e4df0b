// SPDX-License-Identifier: Apache-2.0
// A thin film, as of oil, soap or a lens's coating: what it reflects of three wavelengths, by Airy's sum of all reflections
// between its two faces (M. Born and E. Wolf, "Principles of Optics", section 1.6.4), the mean of both polarisations.

const float kPi = 3.14159265;
const vec3 kWavelengths = vec3(611.0, 549.0, 464.0);  // nanometres: of sRGB's primaries, about

uniform float thickness = 400.0;   // @slider 0 1200
uniform float uneven = 0.3;        // @slider 0 1
uniform float film = 1.38;         // @slider 1.0 2.5
uniform float base = 1.52;         // @slider 1.0 2.5
uniform vec3 body = vec3(0.02);    // @color
uniform vec3 sky = vec3(1.0, 1.1, 1.3);       // @color
uniform vec3 horizon = vec3(0.55, 0.6, 0.7);  // @color
uniform vec3 ground = vec3(0.1, 0.09, 0.08);  // @color

// Reflected amplitudes at a face, of the two polarisations (Fresnel): of light that comes from index a at cosine ca.
vec2 fresnel(float a, float ca, float b, float cb) {
  return vec2((a * ca - b * cb) / (a * ca + b * cb), (b * ca - a * cb) / (b * ca + a * cb));
}

// The cosine in a medium of that index, of light at that cosine in air; 0 where none gets there.
float refracted(float cosine, float index) {
  return sqrt(max(1.0 - (1.0 - cosine * cosine) / (index * index), 0.0));
}

vec3 reflectance(float cosine, float nanometres) {
  float inFilm = refracted(cosine, film), inBase = refracted(cosine, base);
  vec2 first = fresnel(1.0, cosine, film, inFilm), second = fresnel(film, inFilm, base, inBase);
  vec2 squares = first * first + second * second, product = first * second, both = product * product;
  vec3 phase = 4.0 * kPi * film * nanometres * inFilm / kWavelengths;
  vec3 waves = cos(phase);
  vec3 s = (squares.x + 2.0 * product.x * waves) / (1.0 + both.x + 2.0 * product.x * waves);
  vec3 p = (squares.y + 2.0 * product.y * waves) / (1.0 + both.y + 2.0 * product.y * waves);
  return 0.5 * (s + p);
}

// What is around: a sky that is brightest above, and a ground.
vec3 around(vec3 way) {
  return way.y >= 0.0 ? mix(horizon, sky, smoothstep(0.0, 0.7, way.y)) : mix(horizon, ground, smoothstep(0.0, 0.25, -way.y));
}

vec4 material(Point p) {
  float cosine = clamp(dot(p.normal, p.viewer), 0.0, 1.0);
  float here = thickness * (1.0 + uneven * sin(3.0 * p.object.y + 2.0 * sin(2.0 * p.object.x)));
  vec3 mirrored = 2.0 * dot(p.normal, p.viewer) * p.normal - p.viewer;
  vec3 color = reflectance(cosine, here) * around(mirrored) + body * ambientLight();
  for (int i = 0; i < lightCount(); ++i) {
    Light l = light(i);
    color += body * l.radiance * l.visible * max(dot(p.normal, l.direction), 0.0);
  }
  return vec4(color, 1.0);
}
