// SPDX-License-Identifier: Apache-2.0
// Steps of a cloth (surface/cloth.h says which, and why they never add energy). One workgroup does them all: a step is
// short, and each of its iterations needs the one before from everywhere. Every point gathers what its neighbours do to
// it, in one order, so that the numbers are the same however many points are done at once.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/cloth_data.h"

layout(local_size_x = kClothInvocations) in;

layout(push_constant, scalar) uniform Constants { ClothData cloth; };
layout(set = kSetCloth, binding = kBindingClothPoints, scalar) coherent buffer Points { vec4 points[]; };
layout(set = kSetCloth, binding = kBindingClothIterations, scalar) readonly buffer Iterations { vec2 iterations[]; };

uint count;
uint width;  // points of a row

void synchronize() {
  memoryBarrierBuffer();
  barrier();
}

vec3 at(uint part, uint i) { return points[part * count + i].xyz; }

/// What resists a move of a mass; damping does as more mass would, and where the ball touches its push and its friction.
float inertia(float mass, bool touched) {
  float rate = 1 / cloth.step;
  return mass * rate * (rate + cloth.damping + (touched ? rate + cloth.friction : 0));
}

/// What a spring to a neighbour that is `apart` pulls with.
vec3 pull(vec3 apart, float stiffness, float rest) {
  float far = length(apart);
  return far > 0 ? stiffness * (1 - rest / far) * apart : vec3(0);  // of any direction the mean
}

/// What bending of a line does to the k-th of its `last` + 1 points, from the two before it to the two after it. Second
/// differences are around points that have one on each side.
vec3 unbend(int k, int last, float stiffness, vec3 p[5]) {
  float before = k > 1 ? stiffness : 0, at = k > 0 && k < last ? stiffness : 0, after = k < last - 1 ? stiffness : 0;
  return 2 * at * (p[1] - 2 * p[2] + p[3]) - before * (p[0] - 2 * p[1] + p[2]) - after * (p[2] - 2 * p[3] + p[4]);
}

/// Forces of springs and bending on a point: of places; or, of the quadratic form that bounds theirs, what changes with
/// these moves. Neighbours that are not there are the point itself, without stiffness.
vec3 elastic(uint part, uint i, bool ofPlaces) {
  uint row = uint((float(i) + 0.5) / float(width)), column = i - row * width;
  uint left = min(column, 1u), right = min(cloth.columns - column, 1u);
  uint front = min(row, 1u), back = min(cloth.rows - row, 1u);
  vec3 here = at(part, i);
  uint first = i - front * width, second = i + back * width;
  vec3 x[5] = {here, at(part, i - left), here, at(part, i + right), here};
  vec3 z[5] = {here, at(part, first), here, at(part, second), here};
  float alongX = (front + back == 2 ? 1 : 0.5) * cloth.stretchX, alongZ = (left + right == 2 ? 1 : 0.5) * cloth.stretchZ;
  vec3 force = vec3(0);
#define SPRING(neighbour, stiffness, rest) \
  force += ofPlaces ? pull(neighbour - here, stiffness, rest) : (stiffness) * (neighbour - here)
  SPRING(x[1], float(left) * alongX, cloth.restX);
  SPRING(x[3], float(right) * alongX, cloth.restX);
  SPRING(z[1], float(front) * alongZ, cloth.restZ);
  SPRING(z[3], float(back) * alongZ, cloth.restZ);
  if (cloth.diagonal > 0) {
    SPRING(at(part, first - left), float(front * left) * cloth.diagonal, cloth.restDiagonal);
    SPRING(at(part, first + right), float(front * right) * cloth.diagonal, cloth.restDiagonal);
    SPRING(at(part, second - left), float(back * left) * cloth.diagonal, cloth.restDiagonal);
    SPRING(at(part, second + right), float(back * right) * cloth.diagonal, cloth.restDiagonal);
  }
#undef SPRING
  if (cloth.bendX > 0) {
    x[0] = at(part, i - min(column, 2u));
    x[4] = at(part, i + min(cloth.columns - column, 2u));
    z[0] = at(part, i - min(row, 2u) * width);
    z[4] = at(part, i + min(cloth.rows - row, 2u) * width);
    force += unbend(int(column), int(cloth.columns), (front + back == 2 ? 1 : 0.5) * cloth.bendX, x);
    force += unbend(int(row), int(cloth.rows), (left + right == 2 ? 1 : 0.5) * cloth.bendZ, z);
  }
  return force;
}

bool isInside(vec3 place) { return cloth.ballRadius > 0 && length(place - cloth.ballCenter) < cloth.ballRadius; }

/// Forces on points as they are, and which of them the ball touches: those in it now, or where their velocities lead.
void findForces() {
  for (uint i = gl_LocalInvocationIndex; i < count; i += kClothInvocations) {
    vec4 place = points[kClothPlaces * count + i];
    vec3 velocity = at(kClothVelocities, i);
    float rate = 1 / cloth.step;
    vec3 force = place.w * (rate * velocity + cloth.gravity) + elastic(kClothPlaces, i, true);
    if (isInside(place.xyz)) {
      vec3 outward = place.xyz - cloth.ballCenter;
      float far = length(outward);
      vec3 direction = far > 0 ? outward / far : vec3(0, 1, 0);
      force += place.w * rate * rate * (cloth.ballRadius * direction - outward);
    }
    bool near = isInside(place.xyz) || isInside(place.xyz + cloth.step * velocity);
    points[kClothForces * count + i] = vec4(force, near ? 1 : 0);
  }
}

/// Moves under these forces, in the first of the two parts.
void findMoves() {
  for (uint k = 0; k < 2 * cloth.iterations; ++k) {
    vec2 iteration = iterations[k % cloth.iterations];
    uint before = kClothMoves + k % 2, after = kClothMoves + (k + 1) % 2;
    for (uint i = gl_LocalInvocationIndex; i < count; i += kClothInvocations) {
      vec3 move = vec3(0), change = vec3(0);
      float mass = points[kClothPlaces * count + i].w;
      if (mass > 0) {  // else it is pinned
        vec4 force = points[kClothForces * count + i];
        float inert = inertia(mass, force.w != 0);
        vec3 residual = force.xyz;
        if (k > 0) {
          move = at(before, i);
          residual += elastic(before, i, false) - inert * move;
        }
        change = iteration.y / (inert + points[kClothVelocities * count + i].w) * residual;
        if (k % cloth.iterations > 0) change += iteration.x * at(kClothChanges, i);
      }
      points[kClothChanges * count + i].xyz = change;
      points[after * count + i].xyz = move + change;
    }
    synchronize();
  }
}

void main() {
  width = cloth.columns + 1;
  count = width * (cloth.rows + 1);
  for (uint step = 0; step < cloth.steps; ++step) {
    findForces();
    synchronize();
    findMoves();
    for (uint i = gl_LocalInvocationIndex; i < count; i += kClothInvocations) {
      vec3 move = at(kClothMoves, i);
      points[kClothPlaces * count + i].xyz += move;
      points[kClothVelocities * count + i].xyz = move / cloth.step;
    }
    synchronize();
  }
}
