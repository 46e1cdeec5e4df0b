// SPDX-License-Identifier: Apache-2.0
// Water that reflects a sky, more of it where it is seen aslant, and the sun's glint.
#version 120

uniform vec3 deep = vec3(0.01, 0.08, 0.11);  // @color
uniform vec3 sky = vec3(0.35, 0.55, 0.8);    // @color

varying vec3 normal, eye;

void main() {
  vec3 n = normalize(normal), v = normalize(-eye);
  n = dot(n, v) < 0.0 ? -n : n;
  float aslant = pow(1.0 - max(dot(n, v), 0.0), 5.0);
  vec3 color = mix(deep, sky, 0.02 + 0.98 * aslant);
  for (int i = 0; i < 2; ++i) {
    vec3 light = normalize(gl_LightSource[i].position.xyz - eye * gl_LightSource[i].position.w);
    float glint = pow(max(dot(n, normalize(light + v)), 0.0), 180.0);
    color += gl_LightSource[i].diffuse.rgb * (deep * max(dot(n, light), 0.0) + 0.5 * glint);
  }
  gl_FragColor = vec4(min(color, vec3(1.0)), 1.0);
}
