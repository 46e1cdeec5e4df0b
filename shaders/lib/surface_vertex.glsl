// SPDX-License-Identifier: Apache-2.0
// Vertices of a surface that is shaded per fragment. Out: positions as shared/scene_data.h has them.
#define LUXO_VERTEX
#include "lib/carried_lights.glsl"
#include "lib/placed_vertex.glsl"

layout(location = kLocationPosition) sample out vec3 outPosition;
layout(location = kLocationNormal) sample out vec3 outNormal;
layout(location = kLocationAmbient) flat out vec3 outAmbient;
layout(location = kLocationDiffuse) flat out vec3 outDiffuse;
layout(location = kLocationSpecular) flat out vec3 outSpecular;
layout(location = kLocationShininessOpacity) flat out vec2 outShininessOpacity;
layout(location = kLocationNumbers) flat out uvec3 outNumbers;  // flags; the material's number; where its pattern's parameters start
layout(location = kLocationViewer) flat out vec4 outViewer;

invariant gl_Position;

// What is the same all over the draw, for its fragments.
void carryDraw(MaterialData material) {
  outAmbient = material.ambient;
  outDiffuse = material.diffuse;
  outSpecular = material.specular;
  outShininessOpacity = vec2(material.shininess, material.opacity);
  outViewer = view.viewer;
  carryLights();
}

void writeSurfaceVertex(InstanceData instance) {
  outPosition = positionOfVertex(instance);
  outNormal = normalOfVertex(instance);
  MaterialData material = materials[instance.material];
  outNumbers = uvec3(instance.flags | material.flags, instance.material, material.firstPatternParameter);
  if (kCarries) carryDraw(material);
  gl_Position = clipOfVertex(outPosition);
}

// (N.V) |N.V|: near a silhouette this is proportional to the distance from it in the picture, so that its interpolation
// between vertices is exact there. A plane has no silhouette.
float silhouette(InstanceData instance) {
  float facing = dot(outNormal, towardViewer(view.viewer, outPosition));
  return (instance.flags & kPlane) != 0 ? 1.0 : facing * abs(facing);
}
