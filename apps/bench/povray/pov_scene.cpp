// SPDX-License-Identifier: Apache-2.0
#include "povray/pov_scene.h"

#include <fmt/format.h>

#include "base/error.h"

namespace luxo::povray {
namespace {

std::string text(const Vec3& v) { return fmt::format("<{:.17g}, {:.17g}, {:.17g}>", v.x, v.y, v.z); }

[[noreturn]] void refuse(const std::string& what) {
  throw Error(ErrorKind::Scene, fmt::format("cannot say {} in POV-Ray's analytic primitives", what));
}

/// With the parameters that the surface has itself; the box is as tight as can be.
std::string parametricTorus(double major, double minor) {
  const double reach = major + minor;
  return fmt::format(
      "parametric {{ function {{ ({0:.17g} + {1:.17g} * cos(v)) * cos(u) }} function {{ {1:.17g} * sin(v) }} "
      "function {{ -({0:.17g} + {1:.17g} * cos(v)) * sin(u) }} <0,0>, <2*pi,2*pi> "
      "contained_by {{ box {{ <-{2:.17g},-{1:.17g},-{2:.17g}>, <{2:.17g},{1:.17g},{2:.17g}> }} }}",
      major, minor, reach);
}

/// With its sizes read off the surface's own points.
std::string shape(const SnapshotNode& node, TorusAs torusAs) {
  const auto at = [&](double u, double v) { return node.surface.position(u, v, node.parameters); };
  const std::string& name = node.surface.name();
  if (name == "sphere") return fmt::format("sphere {{ <0,0,0>, {:.17g}", at(0, 1).y);
  if (name == "cylinder")
    return fmt::format("cylinder {{ <0,0,0>, {}, {:.17g} open", text({0, at(0, 1).y, 0}), at(0, 0).x);
  if (name == "disk") return fmt::format("disc {{ <0,0,0>, <0,1,0>, {:.17g}", at(0, 1).x);
  if (name == "rectangle")
    return fmt::format("polygon {{ 5, {}, {}, {}, {}, {}", text(at(0, 0)), text(at(1, 0)), text(at(1, 1)),
                       text(at(0, 1)), text(at(0, 0)));
  if (name == "paraboloid") {
    const Vec3 rim = at(0, 1);
    return fmt::format(
        "quadric {{ <1,0,1>, <0,0,0>, <0,{:.17g},0>, 0 clipped_by {{ plane {{ y, {:.17g} }} }}",
        -rim.x * rim.x / rim.y, rim.y);
  }
  if (name == "torus") {
    const double outer = at(0, 0).x, inner = at(0, 0.5).x;
    const double major = 0.5 * (outer + inner), minor = 0.5 * (outer - inner);
    return torusAs == TorusAs::Parametric ? parametricTorus(major, minor)
                                          : fmt::format("torus {{ {:.17g}, {:.17g} sturm", major, minor);
  }
  refuse(fmt::format("the surface '{}'", name));
}

std::string placement(const Transform& t) {
  std::string numbers;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) numbers += fmt::format("{:.17g}, ", t.linear[column][row]);
  return fmt::format("matrix <{}{:.17g}, {:.17g}, {:.17g}>", numbers, t.translation.x, t.translation.y,
                     t.translation.z);
}

std::string finish(const Material& m, const Vec3& ambientLight) {
  if (m.opacity != 1 || m.diffusePattern.valid() || m.isolines.valid() || m.hasMaps() ||
      m.twoSided == TwoSided::No || m.lectureSpecular || m.specular != Vec3(m.specular.x) ||
      !(glm::min(m.diffuse.x, glm::min(m.diffuse.y, m.diffuse.z)) > 0))
    refuse(fmt::format("the material '{}'", m.name));
  return fmt::format(
      "pigment {{ rgb {} }} finish {{ ambient rgb {} diffuse 1 specular {:.17g} roughness {:.17g} }}",
      text(m.diffuse), text(m.ambientOrDiffuse() * ambientLight / m.diffuse), m.specular.x, 1 / m.shininess);
}

std::string light(const SnapshotLight& light, double far) {
  if (light.hasShadow() || light.cone ||
      (light.attenuation != Light::Attenuation::None && !light.directional()))
    refuse("lights that fade, cast shadows or have a cone");
  const Vec3 position(light.positionWorld);
  return fmt::format("light_source {{ {} rgb {}{} }}\n",
                     text(light.directional() ? far * position : position), text(light.radiance),
                     light.directional() ? " parallel point_at <0,0,0>" : "");
}

}  // namespace

std::string sceneText(const Snapshot& snapshot, TorusAs torusAs) {
  constexpr double kFarAway = 1e4;  // of a parallel light, whose direction alone counts
  const View& view = snapshot.view;
  if (!view.perspective()) refuse("orthographic cameras");
  std::string scene = fmt::format(
      "#version 3.7;\nglobal_settings {{ assumed_gamma 1 ambient_light rgb 1 max_trace_level 1 }}\n"
      "background {{ rgb {} }}\n"
      "camera {{ perspective location {} direction {} right {} up {} }}\n",
      text(snapshot.background), text(view.eye), text(view.forward()),
      text(2 * view.halfExtent.x * view.right()), text(2 * view.halfExtent.y * view.up()));
  for (const SnapshotLight& l : snapshot.lights) scene += light(l, kFarAway);
  for (const SnapshotNode& node : snapshot.nodes)
    scene += fmt::format("{} {} {} no_shadow }}\n", shape(node, torusAs),
                         finish(snapshot.materials[node.material.index], snapshot.ambient),
                         placement(node.worldFromObject));
  return scene;
}

Snapshot comparable(Snapshot snapshot, double radiance) {
  for (Material& m : snapshot.materials) m.twoSided = TwoSided::Yes;
  for (SnapshotLight& light : snapshot.lights) {
    light.attenuation = Light::Attenuation::None;
    light.shade.reset();
    light.casters.clear();
    light.radiance = Vec3(radiance);
  }
  return snapshot;
}

}  // namespace luxo::povray
