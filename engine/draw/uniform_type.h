// SPDX-License-Identifier: Apache-2.0
// Uniforms of a material's shader as GLSL reads them from the material's numbers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "gpu/shader_reflection.h"

namespace luxo {

/// How a uniform's value is made of numbers.
struct UniformType {
  std::uint32_t columns = 1, rows = 1;
  std::string scalar;  ///< "float", "int", "uint", "bool"

  [[nodiscard]] std::uint32_t numbers() const { return columns * rows; }
};

/// Nothing: no value of a scene file is of this type.
[[nodiscard]] std::optional<UniformType> typeNamed(std::string_view type);
/// To the compiler samplers are numbers.
[[nodiscard]] std::string typeOfElement(const gpu::ShaderVariable& uniform);
/// With its sizes, as people write it.
[[nodiscard]] std::string arrayText(const gpu::ShaderVariable& uniform);

/// An expression: one element, whose numbers begin at `first`, an expression, too. Numbers of a matrix are
/// row after row, its constructor's are column after column.
[[nodiscard]] std::string valueAt(const gpu::ShaderVariable& uniform, const UniformType& type,
                                  const std::string& first);
/// A function luxoAt_STORAGE() that gives `value`, an expression of `element`; of an array by indices: one
/// beyond its ends is that of the end.
[[nodiscard]] std::string readerOf(const gpu::ShaderVariable& uniform, const std::string& storage,
                                   const std::string& value);
/// Statements that give the variable all that readerOf() gives.
[[nodiscard]] std::string copyOfAll(const gpu::ShaderVariable& uniform, const std::string& storage);

}  // namespace luxo
