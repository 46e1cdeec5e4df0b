// SPDX-License-Identifier: Apache-2.0
#include "surface/library.h"

#include "surface/catalogue.h"

namespace luxo {

Surface rectangle(double sizeX, double sizeZ) { return makeSurface("rectangle", {{"size", {sizeX, sizeZ}}}); }

Surface disk(double radius) { return makeSurface("disk", {{"radius", {radius}}}); }

Surface cylinder(double radius, double height) {
  return makeSurface("cylinder", {{"radius", {radius}}, {"height", {height}}});
}

Surface cone(double radius, double topRadius, double height) {
  return makeSurface("cone", {{"radius", {radius}}, {"top_radius", {topRadius}}, {"height", {height}}});
}

Surface sphere(double radius) { return makeSurface("sphere", {{"radius", {radius}}}); }

Surface paraboloid(double focalLength, double height) {
  return makeSurface("paraboloid", {{"focal_length", {focalLength}}, {"height", {height}}});
}

Surface torus(double major, double minor) {
  return makeSurface("torus", {{"major", {major}}, {"minor", {minor}}});
}

Surface flag(const FlagDesc& desc) {
  return makeSurface("flag", {{"width", {desc.width}},
                              {"height", {desc.height}},
                              {"depth", {desc.depth}},
                              {"waves", {desc.waves}},
                              {"phase", {desc.phase}}});
}

}  // namespace luxo
