// SPDX-License-Identifier: Apache-2.0
// Light at the vertex: the colour is a varying of the language's own, and every light of the scene adds to it.
#version 120
void main() {
  vec4 eye = gl_ModelViewMatrix * gl_Vertex;
  vec3 n = normalize(gl_NormalMatrix * gl_Normal), v = normalize(-eye.xyz);
  vec4 sum = gl_FrontLightModelProduct.sceneColor;
  for (int i = 0; i < gl_MaxLights; ++i) {
    vec3 to = gl_LightSource[i].position.xyz - gl_LightSource[i].position.w * eye.xyz;
    float d = length(to);
    float fade = gl_LightSource[i].constantAttenuation +
                 d * (gl_LightSource[i].linearAttenuation + d * gl_LightSource[i].quadraticAttenuation);
    float cosine = dot(n, to) / d;
    if (cosine > 0.0)
      sum += (gl_FrontLightProduct[i].diffuse * cosine +
              gl_FrontLightProduct[i].specular *
                  pow(max(dot(n, normalize(to / d + v)), 0.0), gl_FrontMaterial.shininess)) / fade;
  }
  gl_FrontColor = sum;
  gl_Position = ftransform();
}
