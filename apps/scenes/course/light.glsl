// SPDX-License-Identifier: Apache-2.0
// One light on a point in eye space: diffuse, and with Blinn's half vector.
vec4 fromLight(in int i, in vec3 n, in vec3 at) {
  vec3 to = gl_LightSource[i].position.xyz - gl_LightSource[i].position.w * at;
  float d = length(to), cosine = dot(n, to) / d;
  if (cosine <= 0.0) return vec4(0.0);
  float fade = gl_LightSource[i].constantAttenuation + d * d * gl_LightSource[i].quadraticAttenuation;
  float gloss = pow(max(dot(n, normalize(to / d - normalize(at))), 0.0), gl_FrontMaterial.shininess);
  return (gl_FrontLightProduct[i].diffuse * cosine + gl_FrontLightProduct[i].specular * gloss) / fade;
}
