// SPDX-License-Identifier: Apache-2.0
// What programs in the style of GLSL 1.20 have by themselves (draw/course_style.h). Names are spelled as there:
// gL_Vertex is what a program calls gl_Vertex.
//
// A program by itself (lib/course_alone.glsl) has LUXO_ALONE: there each is what the language had it as, so that what
// only may be read is not written. Joined with luxo's they are variables, which lib/course_point.glsl fills.
#ifndef LUXO_LIB_COURSE_GLSL
#define LUXO_LIB_COURSE_GLSL

const int gL_MaxLights = 8, gL_MaxTextureCoords = 8, gL_MaxTextureUnits = 3, gL_MaxTextureImageUnits = 3,
          gL_MaxVertexTextureImageUnits = 3, gL_MaxVaryingFloats = 64;

struct gL_DepthRangeParameters { float near, far, diff; };
struct gL_MaterialParameters { vec4 emission, ambient, diffuse, specular; float shininess; };
struct gL_LightSourceParameters {
  vec4 ambient, diffuse, specular, position, halfVector;  // position: in eye space
  vec3 spotDirection;
  float spotExponent, spotCutoff, spotCosCutoff, constantAttenuation, linearAttenuation, quadraticAttenuation;
};
struct gL_LightModelParameters { vec4 ambient; };
struct gL_LightModelProducts { vec4 sceneColor; };
struct gL_LightProducts { vec4 ambient, diffuse, specular; };

#ifdef LUXO_ALONE
layout(set = 0, binding = 1) uniform gL_State {
#endif
  mat4 gL_ModelViewMatrix, gL_ProjectionMatrix, gL_ModelViewProjectionMatrix;
  mat4 gL_ModelViewMatrixInverse, gL_ProjectionMatrixInverse, gL_ModelViewProjectionMatrixInverse;
  mat4 gL_ModelViewMatrixTranspose, gL_ProjectionMatrixTranspose, gL_ModelViewProjectionMatrixTranspose;
  mat4 gL_ModelViewMatrixInverseTranspose, gL_ProjectionMatrixInverseTranspose,
      gL_ModelViewProjectionMatrixInverseTranspose;
  mat4 gL_TextureMatrix[gL_MaxTextureCoords];
  mat3 gL_NormalMatrix;
  float gL_NormalScale;
  gL_DepthRangeParameters gL_DepthRange;
  gL_MaterialParameters gL_FrontMaterial, gL_BackMaterial;
  gL_LightSourceParameters gL_LightSource[gL_MaxLights];
  gL_LightModelParameters gL_LightModel;
  gL_LightModelProducts gL_FrontLightModelProduct, gL_BackLightModelProduct;
  gL_LightProducts gL_FrontLightProduct[gL_MaxLights], gL_BackLightProduct[gL_MaxLights];
#ifdef LUXO_ALONE
  vec4 luxoTexels[3];
};
#define LUXO_READ in
#define LUXO_WRITTEN out
#define aTtribute in
#else
#define LUXO_READ
#define LUXO_WRITTEN
#define aTtribute
#define vArying
#define centroid
#endif

#if !defined(LUXO_ALONE) || defined(LUXO_VERTEX)
LUXO_READ vec4 gL_Vertex;
LUXO_READ vec3 gL_Normal;
LUXO_READ vec4 gL_Color, gL_SecondaryColor, gL_MultiTexCoord0, gL_MultiTexCoord1, gL_MultiTexCoord2, gL_MultiTexCoord3,
    gL_MultiTexCoord4, gL_MultiTexCoord5, gL_MultiTexCoord6, gL_MultiTexCoord7;
LUXO_READ float gL_FogCoord;
LUXO_WRITTEN vec4 gL_Position, gL_ClipVertex, gL_FrontColor, gL_BackColor, gL_FrontSecondaryColor,
    gL_BackSecondaryColor, gL_TexCoord[gL_MaxTextureCoords];
LUXO_WRITTEN float gL_PointSize, gL_FogFragCoord;
vec4 fTransform() { return gL_ModelViewProjectionMatrix * gL_Vertex; }
#ifdef LUXO_ALONE
#define vArying out
#endif
#endif

#if !defined(LUXO_ALONE) || !defined(LUXO_VERTEX)
LUXO_READ vec4 gL_FragCoord;
LUXO_WRITTEN vec4 gL_FragColor;
// What a program computes after it shows nowhere: it may as well go on.
bool luxoDiscarded = false;
#define dIscard luxoDiscarded = true
#ifdef LUXO_ALONE
LUXO_READ vec4 gL_Color, gL_SecondaryColor, gL_TexCoord[gL_MaxTextureCoords];
LUXO_READ float gL_FogFragCoord;
#define gL_FrontFacing gl_FrontFacing
#define vArying in
#else
bool gL_FrontFacing;
#endif
#endif

// A sampler is the number of a map, as in the language it is that of a texture unit; or a texture (lib/material.glsl).
#define sAmpler1D int
#define sAmpler2D int

vec4 tExture2D(int map, vec2 uv) {
#ifdef LUXO_ALONE
  return luxoTexels[map] * uv.x;
#else
  if (map > 2) return texture(map, uv);
  return vec4(map == 0 ? colorMap(uv) : map == 1 ? specularMap(uv) : glowMap(uv), 1.0);
#endif
}
vec4 tExture2DProj(int map, vec3 stq) { return tExture2D(map, stq.xy / stq.z); }
vec4 tExture2DProj(int map, vec4 stpq) { return tExture2D(map, stpq.xy / stpq.w); }
vec4 tExture1D(int map, float s) { return tExture2D(map, vec2(s, 0.5)); }
vec4 tExture1DProj(int map, vec2 sq) { return tExture1D(map, sq.x / sq.y); }
vec4 tExture1DProj(int map, vec4 stpq) { return tExture1D(map, stpq.x / stpq.w); }
#endif
