// SPDX-License-Identifier: Apache-2.0
// Where a vertex program in the style of GLSL 1.20 moves the vertices of a mesh. The file "material" is both programs
// (CourseProgram::movement): they share initialisers.
//
// With all matrices the identity gl_Position is a place in the object, exactly what the program makes of it. That is the
// first state. In the second the matrices are those of a view, and the rest other numbers: gl_Position is then the same
// place as that view has it, unless the program asks for more than a mesh can have that is moved once for all views.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/material.glsl"
#include "shared/vertex_movement.h"

layout(local_size_x = kMovementInvocations) in;

layout(push_constant, scalar) uniform Constants { MovementRange range; };
layout(set = kSetMovement, binding = kBindingMovedVertices, scalar) readonly buffer Vertices { VertexAtRest vertices[]; };
layout(set = kSetMovement, binding = kBindingMovementNumbers, scalar) readonly buffer Numbers { float numbers[]; };
layout(set = kSetMovement, binding = kBindingMovementStates, scalar) readonly buffer States { MovementState states[]; };
layout(set = kSetMovement, binding = kBindingMovedPositions, scalar) writeonly buffer Positions { vec4 positions[]; };
layout(set = kSetMovement, binding = kBindingMovementFaults, scalar) buffer Faults { uint endless; };

float luxoOther;

float shaderNumber(uint k) { return numbers[k]; }
vec3 colorMap(vec2 uv) { return vec3(luxoOther + uv.x); }
vec3 specularMap(vec2 uv) { return vec3(luxoOther + uv.x); }
vec3 glowMap(vec2 uv) { return vec3(luxoOther + uv.x); }
vec4 texture(int map, vec2 uv) { return vec4(luxoOther + uv.x); }

// Of the fragment program, which does not run here.
#define dFdx(p) (p)
#define dFdy(p) (p)
#define fwidth(p) (p)
#define dFdxFine(p) (p)
#define dFdyFine(p) (p)
#define fwidthFine(p) (p)
#define dFdxCoarse(p) (p)
#define dFdyCoarse(p) (p)
#define fwidthCoarse(p) (p)

#include "material"
#include "lib/course_matrices.glsl"

void loadState(MovementState state) {
  luxoOther = state.other;
  gL_ModelViewMatrix = state.modelView;
  gL_ProjectionMatrix = state.projection;
  gL_ModelViewMatrixInverse = state.modelViewInverse;
  gL_ProjectionMatrixInverse = state.projectionInverse;
  luxoDeriveMatrices();
  gL_NormalMatrix = transpose(mat3(gL_ModelViewMatrixInverse));
  gL_FrontMaterial = gL_MaterialParameters(vec4(0, 0, 0, 1), vec4(state.ambient, 1), vec4(state.diffuse, 1),
                                           vec4(state.specular, 1), state.shininess);
  gL_BackMaterial = gL_FrontMaterial;
  vec4 other = vec4(vec3(state.other), 1);
  gL_LightModel.ambient = other;
  gL_FrontLightModelProduct.sceneColor = other;
  gL_BackLightModelProduct = gL_FrontLightModelProduct;
  for (int i = 0; i < gL_MaxLights; ++i) {
    gL_LightSource[i] = gL_LightSourceParameters(other, other, other, other, other, other.xyz, state.other, state.other,
                                                 state.other, state.other, state.other, state.other);
    gL_FrontLightProduct[i] = gL_LightProducts(other, other, other);
    gL_BackLightProduct[i] = gL_FrontLightProduct[i];
  }
}

void loadVertex(VertexAtRest vertex) {
  gL_Vertex = vec4(vertex.position, 1);
  gL_Normal = vertex.normal;
  luxoLoadTexCoords(vertex.uv);
  luxoLoadColors();
  gL_FogCoord = gL_FogFragCoord = -(gL_ModelViewMatrix * gL_Vertex).z;
  gL_Position = vec4(0);
}

void main() {
  if (gl_GlobalInvocationID.x >= range.count) return;
  uint vertex = range.first + gl_GlobalInvocationID.x, state = gl_GlobalInvocationID.y;
  loadState(states[state]);
  loadVertex(vertices[vertex]);
  loadUniforms();
  luxoRounds = 0;
  luxoMoveVertex(vertices[vertex].uv);
  positions[state * range.vertices + vertex] = gL_Position;
  if (luxoRounds > kLuxoMaxRounds) atomicAdd(endless, 1u);
}
