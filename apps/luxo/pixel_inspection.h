// SPDX-License-Identifier: Apache-2.0
// One pixel of a scene, or one vertex on its way to the screen, explained. All numbers are the reference's,
// in double precision, but colours that shaders of materials give: those are the picture's, with one sample.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "viewer.h"

namespace luxo {

/// What the ray of a pixel meets (reference/explained_pixel.h), the stations of the first point that is seen,
/// and the state of the pipeline that draws it, in words. x, y: from the top left, within the picture; all at
/// the settings' moment and size. Vectors are lists; matrices are lists of their rows, to be multiplied by
/// columns. Throws Error(Scene) where the scene has no picture of that moment. Cost: where a shader lights
/// what is seen, the whole picture, drawn by `device`.
[[nodiscard]] nlohmann::ordered_json inspectPixel(const std::string& name, const ViewedScene& viewed,
                                                  const std::string& device, int x, int y);

/// The same of a point of a surface, `NODE:U,V`, or of a vertex of a model's triangles, `NODE:INDEX`. NODE is
/// a name, or the number that the view `id` shows. Throws Error(Usage): it is written otherwise, there is no
/// such node that is shown, or no such point of it.
[[nodiscard]] nlohmann::ordered_json inspectVertex(const std::string& name, const ViewedScene& viewed,
                                                   const std::string& vertex);

/// As people read them.
[[nodiscard]] std::string pixelText(const nlohmann::ordered_json& inspection);
[[nodiscard]] std::string vertexText(const nlohmann::ordered_json& inspection);

}  // namespace luxo
