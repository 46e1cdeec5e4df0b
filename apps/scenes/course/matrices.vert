// SPDX-License-Identifier: Apache-2.0
// Matrices: ftransform() is projection * model and view * vertex; m[3] is the last column, a translation.
#version 120
varying vec4 shown;
void main() {
  vec4 clip = gl_ProjectionMatrix * (gl_ModelViewMatrix * gl_Vertex);
  mat4 moved = mat4(1.0, 0.0, 0.0, 0.0,   // a column, not a row
                    0.0, 1.0, 0.0, 0.0,
                    0.0, 0.0, 1.0, 0.0,
                    0.1, 0.2, 0.3, 1.0);
  bool isColumn = moved[3] == vec4(0.1, 0.2, 0.3, 1.0) && moved * vec4(0.0, 0.0, 0.0, 1.0) == moved[3];
  bool isTransposed = transpose(moved)[0] == vec4(1.0, 0.0, 0.0, 0.1);
  vec3 back = vec3(gl_ModelViewMatrixInverse * (gl_ModelViewMatrix * gl_Vertex)) - gl_Vertex.xyz;
  bool isInverse = all(lessThan(abs(back), vec3(1e-4)));
  // Where it is on the screen, as a colour; black where a rule is broken.
  shown = isColumn && isTransposed && isInverse ? vec4(0.5 * clip.xy / clip.w + 0.5, 0.5, 1.0) : vec4(0.0);
  gl_Position = clip;
}
