// SPDX-License-Identifier: Apache-2.0
// A mirror of metal: Schlick's approximation of what it reflects ("An Inexpensive BRDF Model for Physically-based
// Rendering", 1994), as often as faces of it see each other.

uniform vec3 metal = vec3(0.9, 0.88, 0.84);    // @color
uniform vec3 sky = vec3(0.75, 0.85, 1.0);      // @color
uniform vec3 horizon = vec3(0.95, 0.93, 0.9);  // @color

vec4 material(Point p) {
  vec3 way = reflect(-p.viewer, p.normal);
  vec3 share = metal + (1.0 - metal) * pow(1.0 - clamp(dot(p.normal, p.viewer), 0.0, 1.0), 5.0);
  Hit hit = trace(way);
  return vec4(share * (hit.found ? hit.color : mix(horizon, sky, sqrt(max(way.y, 0.0)))), 1.0);
}
