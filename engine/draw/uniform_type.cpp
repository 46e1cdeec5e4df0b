// SPDX-License-Identifier: Apache-2.0
#include "draw/uniform_type.h"

#include <fmt/format.h>

#include <utility>

namespace luxo {

std::optional<UniformType> typeNamed(std::string_view type) {
  for (const std::string_view scalar : {"float", "int", "uint", "bool"})
    if (type == scalar) return UniformType{1, 1, std::string(scalar)};
  for (const auto& [prefix, scalar] :
       {std::pair{"vec", "float"}, {"ivec", "int"}, {"uvec", "uint"}, {"bvec", "bool"}})
    if (type.size() == std::string_view(prefix).size() + 1 && type.starts_with(prefix))
      return UniformType{1, static_cast<std::uint32_t>(type.back() - '0'), scalar};
  if (type == "sampler1D" || type == "sampler2D") return UniformType{1, 1, "int"};
  const auto isSize = [&](std::size_t at) { return type[at] >= '2' && type[at] <= '4'; };
  const bool isMatrix = type.starts_with("mat") &&
                        (type.size() == 4 || (type.size() == 6 && type[4] == 'x')) && isSize(3) &&
                        isSize(type.size() - 1);
  if (!isMatrix) return std::nullopt;
  const auto columns = static_cast<std::uint32_t>(type[3] - '0');
  return UniformType{columns, type.size() > 5 ? static_cast<std::uint32_t>(type[5] - '0') : columns, "float"};
}

namespace {

std::string numberAt(const UniformType& type, const std::string& first, std::uint32_t index) {
  const std::string number = fmt::format("shaderNumber({} + {}u)", first, index);
  if (type.scalar == "float") return number;
  return type.scalar == "bool" ? number + " != 0.0" : fmt::format("{}({})", type.scalar, number);
}

}  // namespace

std::string valueAt(const gpu::ShaderVariable& uniform, const UniformType& type, const std::string& first) {
  std::string arguments;
  for (std::uint32_t column = 0; column < type.columns; ++column)
    for (std::uint32_t row = 0; row < type.rows; ++row)
      arguments += fmt::format("{}{}", arguments.empty() ? "" : ", ",
                               numberAt(type, first, row * type.columns + column));
  return fmt::format("{}({})", type.numbers() == 1 ? type.scalar : uniform.type, arguments);
}

std::string typeOfElement(const gpu::ShaderVariable& uniform) {
  return uniform.type.starts_with("sampler") ? "int" : uniform.type;
}

std::string arrayText(const gpu::ShaderVariable& uniform) {
  std::string text = uniform.type;
  for (const std::uint32_t size : uniform.array) text += fmt::format("[{}]", size);
  return text;
}

std::string readerOf(const gpu::ShaderVariable& uniform, const std::string& storage,
                     const std::string& value) {
  std::string parameters, index = "0";
  for (std::size_t i = 0; i < uniform.array.size(); ++i) {
    parameters += fmt::format("{}int i{}", i > 0 ? ", " : "", i);
    index = fmt::format("({} * {} + clamp(i{}, 0, {}))", index, uniform.array[i], i, uniform.array[i] - 1);
  }
  return fmt::format("{0} luxoAt_{1}({2}) {{\n  int element = {3};\n  return {4};\n}}\n",
                     typeOfElement(uniform), storage, parameters, index, value);
}

std::string copyOfAll(const gpu::ShaderVariable& uniform, const std::string& storage) {
  std::string loops, element, arguments;
  for (std::size_t i = 0; i < uniform.array.size(); ++i) {
    loops += fmt::format("  for (int i{0} = 0; i{0} < {1}; ++i{0})\n", i, uniform.array[i]);
    element += fmt::format("[i{}]", i);
    arguments += fmt::format("{}i{}", i > 0 ? ", " : "", i);
  }
  return fmt::format("{0}    {1}{2} = luxoAt_{1}({3});\n", loops, storage, element, arguments);
}

}  // namespace luxo
