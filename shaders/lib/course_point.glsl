// SPDX-License-Identifier: Apache-2.0
// A point as programs in the style of GLSL 1.20 see it. Their vertex program runs at the point itself, in the pixel: it
// is what interpolation between vertices comes to where these are ever nearer to each other. So all shadings have the
// same, and nobody has to know of triangles. Of triangles whose vertices it has moved (lib/vertex_movement.glsl) it runs
// at the point that was moved to here.
#extension GL_GOOGLE_include_directive : require
#include "lib/course_matrices.glsl"
#include "lib/rest_frame.glsl"

// Columns: the axes of the object in the scene, and back.
mat3 luxoRelativeFromObject, luxoObjectFromRelative;
mat3 luxoEyeAxes;  // from the scene's
bool luxoHasMoved;
vec4 luxoHere;     // where the point is, in the object: gL_Vertex, unless that has moved

vec3 luxoOnAxesOfObject(vec3 direction) { return unitOrZero(luxoObjectFromRelative * direction); }

void luxoLoadMatrices() {
  bool perspective = view.viewer.w != 0.0;
  vec3 forward = view.forward.xyz, right = perspective ? view.rayRight : view.placeRight,
       down = perspective ? view.rayDown : view.placeDown;
  vec3 eye = perspective ? view.viewer.xyz : view.placeMiddle - view.forward.w * forward;
  luxoEyeAxes = transpose(mat3(normalize(right), -normalize(down), -forward));
  luxoObjectFromRelative = shaderMatrix(kShaderObjectFromRelative);
  luxoRelativeFromObject = determinant(luxoObjectFromRelative) != 0.0 ? inverse(luxoObjectFromRelative) : mat3(0);
  mat3 linear = luxoEyeAxes * luxoRelativeFromObject;
  gL_ModelViewMatrix = mat4(linear);
  gL_ModelViewMatrix[3] = vec4(luxoEyeAxes * (-luxoRelativeFromObject * shaderNumbers3(kShaderObjectOrigin) - eye), 1.0);
  gL_NormalMatrix = luxoEyeAxes * transpose(luxoObjectFromRelative);
  // Near and far are those of what there is to see.
  float near = max(view.depthRange.x, 1e-6), far = max(view.depthRange.y, 1.001 * near);
  gL_ProjectionMatrix = mat4(0);
  gL_ProjectionMatrix[0][0] = 1.0 / (length(right) * view.middle.x);
  gL_ProjectionMatrix[1][1] = 1.0 / (length(down) * view.middle.y);
  gL_ProjectionMatrix[2] = perspective ? vec4(0, 0, -(far + near) / (far - near), -1) : vec4(0, 0, -2.0 / (far - near), 0);
  gL_ProjectionMatrix[3] = perspective ? vec4(0, 0, -2.0 * far * near / (far - near), 0)
                                       : vec4(0, 0, -(far + near) / (far - near), 1);
  gL_ModelViewMatrixInverse = inverse(gL_ModelViewMatrix);
  gL_ProjectionMatrixInverse = inverse(gL_ProjectionMatrix);
  luxoDeriveMatrices();
}

void luxoLoadMaterial() {
  Material plain = foundMaterial();
  vec3 scene = shaderNumbers3(kShaderAmbient);  // ambient light, which the material's number is a product with
  vec3 ambient = (plain.flags & kPatternAmbient) != 0
                     ? plain.diffuse
                     : mix(plain.diffuse, plain.ambient / max(scene, vec3(kTiny)), greaterThan(scene, vec3(0)));
  gL_FrontMaterial = gL_MaterialParameters(vec4(0, 0, 0, 1), vec4(ambient, 1), vec4(plain.diffuse, 1),
                                           vec4(plain.specular, 1), plain.shininess);
  gL_BackMaterial = gL_FrontMaterial;
  gL_LightModel.ambient = vec4(ambientLight(), 1);
  gL_FrontLightModelProduct.sceneColor = vec4(ambient * ambientLight(), 1);
  gL_BackLightModelProduct = gL_FrontLightModelProduct;
}

// The scene's lights in the order of their nodes; one is as bright as it is visible from the point. What stands for a wide
// light, some points of it, is one again.
void luxoLoadLights() {
  float points[gL_MaxLights];
  for (int i = 0; i < gL_MaxLights; ++i) {
    points[i] = 0.0;
    gL_LightSource[i] = gL_LightSourceParameters(vec4(0, 0, 0, 1), vec4(0, 0, 0, 1), vec4(0, 0, 0, 1), vec4(0), vec4(0),
                                                 vec3(0, 0, -1), 0.0, 180.0, -1.0, 1.0, 0.0, 0.0);
  }
  vec3 here = (gL_ModelViewMatrix * luxoHere).xyz;
  for (int i = 0; i < lightCount(); ++i) {
    LightData data = lightSet.lights[i];
    uint k = lightSet.order[i];
    if (k >= gL_MaxLights) continue;
    vec3 away = data.position.xyz - litPoint.position * data.position.w;
    points[k] += 1.0;
    gL_LightSource[k].position += vec4(luxoEyeAxes * away + here * data.position.w, data.position.w);
    gL_LightSource[k].diffuse.rgb += data.radiance * light(i).visible * spotAttenuation(i, litPoint.position, away);
    if ((kSpots & 1u << i) != 0) {
      // Its cone is in its brightness: within it the exponent 0 leaves that as it is.
      SpotData spot = spotAt(i);
      gL_LightSource[k].spotDirection = luxoEyeAxes * spot.axis;
      gL_LightSource[k].spotCosCutoff = 1.0 - spot.rise;
      gL_LightSource[k].spotCutoff = degrees(2.0 * asin(sqrt(0.5 * spot.rise)));
    }
    if (data.inverseSquare != 0) gL_LightSource[k].constantAttenuation = 0.0;
  }
  for (int i = 0; i < gL_MaxLights; ++i) {
    vec4 position = points[i] > 0.0 ? gL_LightSource[i].position / points[i] : vec4(0, 0, 1, 0);
    gL_LightSource[i].position = position;
    gL_LightSource[i].halfVector = vec4(unitOrZero(unitOrZero(position.xyz) + vec3(0, 0, 1)), 0);
    gL_LightSource[i].quadraticAttenuation = 1.0 - gL_LightSource[i].constantAttenuation;
    gL_LightSource[i].specular = gL_LightSource[i].diffuse;
    gL_FrontLightProduct[i] = gL_LightProducts(vec4(0, 0, 0, 1), gL_FrontMaterial.diffuse * gL_LightSource[i].diffuse,
                                               gL_FrontMaterial.specular * gL_LightSource[i].specular);
    gL_BackLightProduct[i] = gL_FrontLightProduct[i];
  }
}

void luxoLoadPoint(Point p) {
  luxoLoadMatrices();
  luxoHere = gL_Vertex = vec4(p.object, 1);
  gL_Normal = unitOrZero(transpose(luxoRelativeFromObject) * p.normal);
  vec4 frame = normalFrame();
  luxoHasMoved = isRest(frame);
  if (luxoHasMoved) {
    gL_Vertex.xyz = frame.xyz;
    gL_Normal = restNormal(frame);
  }
  luxoLoadMaterial();
#ifdef LUXO_READS_LIGHTS
  luxoLoadLights();
#endif
  luxoLoadTexCoords(p.uv);
  vec4 clip = gL_ModelViewProjectionMatrix * luxoHere;
  gL_FragCoord = vec4(gl_FragCoord.x, 2.0 * view.middle.y - gl_FragCoord.y, 0.5 * clip.z / clip.w + 0.5, 1.0 / clip.w);
  gL_FrontFacing = dot(p.normal, p.viewer) >= 0.0;
  luxoLoadColors();
  gL_FogCoord = gL_FogFragCoord = -(gL_ModelViewMatrix * luxoHere).z;
  gL_Position = gL_FragColor = vec4(0);
  luxoDiscarded = false;
}

// The light that the scene's own materials have, as where no program runs at vertices.
vec4 luxoFixedColor() {
  return vec4(illuminated(Material(gL_FrontLightModelProduct.sceneColor.rgb, gL_FrontMaterial.diffuse.rgb,
                                   gL_FrontMaterial.specular.rgb, gL_FrontMaterial.shininess, foundMaterial().flags),
                          litPoint.position, litPoint.normal, litPoint.viewer), 1);
}

mat4 luxoMagnitudes(mat4 m) { return mat4(abs(m[0]), abs(m[1]), abs(m[2]), abs(m[3])); }

// Whether gl_Position is another place than the vertex's own: a surface is where its formula has it, and triangles whose
// vertices stay are where they are. A product of four terms is rounded by at most 4 half units in the last place of the
// sum of their magnitudes, the product of two matrices and a vector by 8, and two ways to compute it differ by 16, which
// is 2^-20 of it. Sixteen times that is left for those that go by more matrices, and for what they make of the rounding of
// gl_Vertex itself (a twist by two radians a metre of a plane that it leaves where it is took more than four).
bool luxoIsMoved() {
  if (luxoHasMoved) return false;
  vec4 own = gL_ModelViewProjectionMatrix * gL_Vertex, q = gL_Position;
  vec4 rounding = 1.5259e-5 * (luxoMagnitudes(gL_ProjectionMatrix) * (luxoMagnitudes(gL_ModelViewMatrix) * abs(gL_Vertex)));
  vec3 allowed = rounding.xyz * abs(q.w) + rounding.w * abs(q.xyz);
  return !(q.w > 0.0 && all(lessThanEqual(abs(q.xyz * own.w - own.xyz * q.w), allowed)));
}

// Those of the front are shown on both sides, unless an application asks for more, as luxo does not.
void luxoHandOver() {
  gL_Color = gL_FrontColor;
  gL_SecondaryColor = gL_FrontSecondaryColor;
}
