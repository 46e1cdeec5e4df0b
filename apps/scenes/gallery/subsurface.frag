// SPDX-License-Identifier: Apache-2.0
// Light that scatters inside. How much comes out again is the dipole's diffuse reflectance, of a material's measured scattering
// and absorption (H. W. Jensen et al., "A practical model for subsurface light transport", SIGGRAPH 2001, section 2.3 and its
// table). How far it gets from where it went in: along a ring that is lit from one side, diffusion with absorption has a closed
// form (rings are E. Penner's, "Pre-integrated skin shading", GPU Pro 2, 2011). Light leaks past the horizon, red the farthest.

const float kPi = 3.14159265;

uniform vec3 scattering = vec3(0.74, 0.88, 1.01);   // reduced, per millimetre: of skin
uniform vec3 absorption = vec3(0.032, 0.17, 0.48);  // per millimetre
uniform float index = 1.3;      // @slider 1.0 1.8
uniform float size = 10.0;      // millimetres: the radius of the form's curvature @slider 0.5 100
uniform float gloss = 60.0;     // @slider 1 300

// Of light that comes from everywhere, what is reflected inside, by Egan and Hilgeman's fit.
float inside() { return -1.440 / (index * index) + 0.710 / index + 0.668 + 0.0636 * index; }

vec3 diffuseReflectance() {
  float a = (1.0 + inside()) / (1.0 - inside());
  vec3 albedo = scattering / (scattering + absorption), s = sqrt(3.0 * (1.0 - albedo));
  return 0.5 * albedo * (1.0 + exp(-4.0 / 3.0 * a * s)) * exp(-s);
}

// The solution f of f - f'' / k^2 = max(cos, 0) around a ring, at an angle from the light, 0 to pi: k is its radius over the
// depth that light gets to.
vec3 ring(float angle, vec3 k) {
  float cosine = cos(angle), nearest = min(angle, kPi - angle);
  vec3 leak = 0.5 * k / (k * k + 1.0) * (exp(k * (nearest - 0.5 * kPi)) + exp(-k * (nearest + 0.5 * kPi))) / (1.0 - exp(-kPi * k));
  return k * k / (k * k + 1.0) * max(cosine, 0.0) + leak;
}

// What the surface mirrors, of both polarisations, at that cosine.
float fresnel(float c) {
  float g = sqrt(max(index * index - 1.0 + c * c, 0.0)), s = (g - c) / (g + c), p = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
  return 0.5 * s * s * (1.0 + p * p);
}

vec4 material(Point p) {
  vec3 color = diffuseReflectance(), k = size * sqrt(3.0 * absorption * (scattering + absorption));
  k = clamp(k, vec3(1e-2), vec3(1e3));
  vec3 sum = color * ambientLight();
  for (int i = 0; i < lightCount(); ++i) {
    Light l = light(i);
    float up = dot(p.normal, l.direction), aside = length(cross(p.normal, l.direction));
    // The far side is in the form's own shadow, which is what the leak is about: other shadows end there.
    vec3 visible = mix(vec3(1.0), l.visible, smoothstep(0.0, 0.15, up));
    sum += color * ring(atan(aside, up), k) * l.radiance * visible;
    if (up <= 0.0) continue;
    vec3 h = normalize(l.direction + p.viewer);
    sum += fresnel(dot(h, p.viewer)) * (gloss + 2.0) / 8.0 * pow(max(dot(p.normal, h), 0.0), gloss) * up * l.radiance * l.visible;
  }
  return vec4(sum, 1.0);
}
