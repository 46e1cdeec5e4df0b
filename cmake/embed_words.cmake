# SPDX-License-Identifier: Apache-2.0
# cmake -DFILE=<SPIR-V> -DNAME=<array> -DOUT=<header> -P embed_words.cmake
# Writes the words of a module, least byte first, as a C array.

file(READ ${FILE} bytes HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${bytes}")
# So that no line is longer than editors and compilers like.
string(REGEX REPLACE "(...........)(...........)(...........)(...........)(...........)(...........)(...........)(...........)"
       "\\1\\2\\3\\4\\5\\6\\7\\8\n" words "${words}")
file(WRITE ${OUT} "#pragma once\nconst uint32_t ${NAME}[] = {\n${words}};\n")
