# SPDX-License-Identifier: Apache-2.0
# LUXO_SANITIZE = "" | "address,undefined" | "thread": applied to every target of the build.

set(LUXO_SANITIZE "" CACHE STRING "Sanitizers to build with, as -fsanitize takes them")
if(LUXO_SANITIZE)
  add_compile_options(-fsanitize=${LUXO_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${LUXO_SANITIZE})
endif()
# Asked at every access, these take a quarter of the compiler's time (measured on draw and shell). What is null when it is
# read, or outside of all objects, the address sanitizer sees, and most casts to what is aligned otherwise are warnings
# (-Wcast-align). The preset fuzz, which readers are fuzzed in, has them all.
if(LUXO_SANITIZE MATCHES "undefined" AND NOT LUXO_SANITIZE MATCHES "fuzzer")
  add_compile_options(-fno-sanitize=null,object-size,alignment)
endif()
if(LUXO_SANITIZE MATCHES "thread")
  list(PREPEND CMAKE_MODULE_PATH ${PROJECT_SOURCE_DIR}/cmake/tsan) # find_package(TBB)
endif()

# Drivers and layers leak, and race, on their own account. They are excused by name (lsan.supp, tsan.supp), and names are
# known of loaded libraries alone: in these programs libraries stay loaded to the end.
function(luxo_keep_libraries_loaded)
  if(LUXO_SANITIZE)
    foreach(target IN LISTS ARGN)
      target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/keep_libraries_loaded.cpp)
    endforeach()
  endif()
endfunction()
