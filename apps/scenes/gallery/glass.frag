// SPDX-License-Identifier: Apache-2.0
// Glass: at each face the ray is split by Fresnel's equations (M. Born and E. Wolf, "Principles of Optics", section 1.5)
// and bent by Snell's law, and what is within takes its share by Beer's (T. Whitted, "An Improved Illumination Model for
// Shaded Display", 1980). Where the ray enters and leaves is exact: points of the surface itself.

uniform float index = 1.5;                        // @slider 1.0 2.5
uniform vec3 absorption = vec3(0.25, 0.06, 0.12);  // @color
uniform int faces = 6;                            // @slider 1 7 6
uniform vec3 sky = vec3(0.75, 0.85, 1.0);         // @color
uniform vec3 horizon = vec3(0.95, 0.93, 0.9);     // @color

uniform float lamp = 4.0;                         // @slider 0 10

// Where a ray meets nothing: a bright strip overhead, for highlights that have a shape.
vec3 around(vec3 way) {
  float up = max(way.y, 0.0), strip = smoothstep(0.16, 0.13, abs(way.x / max(up, 1e-3) - 0.35)) * step(0.5, up);
  return mix(horizon, sky, sqrt(up)) + lamp * strip;
}

// How much of the light is mirrored at a face, the mean of both polarisations; 1 where none gets through.
float fresnel(float cosine, float ratio) {
  float through = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
  if (through <= 0.0) return 1.0;
  float other = sqrt(through);
  float s = (ratio * cosine - other) / (ratio * cosine + other), p = (cosine - ratio * other) / (cosine + ratio * other);
  return 0.5 * (s * s + p * p);
}

vec3 seen(Hit hit, vec3 way) { return hit.found ? hit.color : around(way); }

vec4 material(Point p) {
  vec3 way = -p.viewer, mirrored = reflect(way, p.normal);
  float share = fresnel(dot(p.normal, p.viewer), 1.0 / index);
  vec3 color = share * seen(trace(mirrored), mirrored);
  vec3 left = vec3(1.0 - share);
  // Inside, from face to face: what is mirrored goes on, what gets out is seen. All but the last face mirrors.
  way = refract(way, p.normal, 1.0 / index);
  Hit inner = trace(way);
  for (int face = 0; face < faces; ++face) {
    if (!inner.found) break;
    left *= exp(-absorption * inner.distance);
    vec3 out_ = refract(way, inner.normal, index);
    bool leaves = dot(out_, out_) > 0.0;
    if (leaves || face + 1 == faces) {
      if (!leaves) out_ = reflect(way, inner.normal);
      color += left * seen(trace(inner, out_), out_);
      break;
    }
    way = reflect(way, inner.normal);
    inner = trace(inner, way);
  }
  return vec4(color, 1.0);
}
