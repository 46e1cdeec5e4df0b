# SPDX-License-Identifier: Apache-2.0
# cmake -DROOT=<folder> -DFILES=<paths below it> -DOUT=<header> -P embed_sources.cmake
# Writes texts as C++ strings, each with the path by which shaders include it.

set(entries)
foreach(file IN LISTS FILES)
  file(READ ${ROOT}/${file} text)
  # With its size: compilers count the characters of so many texts only so far (clang in 1,048,576 steps).
  string(LENGTH "${text}" size)
  string(APPEND entries "    {\"${file}\", {R\"luxo(${text})luxo\", ${size}}},\n")
endforeach()
file(WRITE ${OUT} "#pragma once\n#include \"gpu/shader_compiler.h\"\n\nnamespace luxo {\n\n"
  "inline constexpr gpu::ShaderSource kShaderSources[] = {\n${entries}};\n\n}  // namespace luxo\n")
