# SPDX-License-Identifier: Apache-2.0
# LUXO_SANITIZE = "" | "address,undefined" | "thread": applied to every target of the build.

set(LUXO_SANITIZE "" CACHE STRING "Sanitizers to build with, as -fsanitize takes them")
if(LUXO_SANITIZE)
  add_compile_options(-fsanitize=${LUXO_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${LUXO_SANITIZE})
endif()
