// SPDX-License-Identifier: Apache-2.0
// Shaders of whole pictures, as Shadertoy has them: a file with
//
//     void mainImage(out vec4 fragColor, in vec2 fragCoord)
//
// as a material's shader (shaders/MATERIALS.md), on a plane that fills the picture of kMainImageScene.
#pragma once

#include <string>
#include <string_view>

#include "scene/material_shader.h"

namespace luxo {

/// Whether one of its files defines the function; and whether one defines `material`.
[[nodiscard]] bool hasMainImage(const MaterialShader& shader);
[[nodiscard]] bool hasMaterial(const MaterialShader& shader);

/// The material's shader that calls it for each pixel: y upward, from the bottom left, and pixel centres at
/// halves. It is given iResolution, iTime, iTimeDelta, iFrameRate, iFrame, iMouse and iDate; the colours that
/// it gives are codes of sRGB from 0 to 1, which the picture gets back. Error(Scene), at its line and column:
/// it has no such function, or reads what there is not.
[[nodiscard]] MaterialShaderPtr materialOfMainImage(const MaterialShaderPtr& shader);

/// The material that a file has beside a mainImage, which is given the same; any other shader, and one that
/// reads none of that, is itself.
/// Error(Scene): as above.
[[nodiscard]] MaterialShaderPtr materialBesideMainImage(const MaterialShaderPtr& shader);

/// What the uniforms of that are by themselves: a formula of each component, separated by ';'. Empty: none
/// of them.
[[nodiscard]] std::string_view mainImageFormulas(std::string_view uniform);

/// A picture's plane in a scene description, its material named "shader".
extern const char* const kMainImageScene;

}  // namespace luxo
