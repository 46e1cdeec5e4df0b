// SPDX-License-Identifier: Apache-2.0
// One colour, whatever the light: the first program of a course (G. Zachmann, "Computer-Graphik II: Shader", TU Clausthal
// 2007, Hello_GLSL).
uniform vec3 paint = vec3(0.0, 0.0, 1.0);  // @color

vec4 material(Point p) { return vec4(paint, 1.0); }
