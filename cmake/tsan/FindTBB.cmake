# SPDX-License-Identifier: Apache-2.0
# oneTBB for builds with the thread sanitizer (sanitizers.cmake): TBB::tbb is loops of plain threads, by the names of those
# headers that luxo includes. A header that is missing here is found in the system, and its functions are missed by the linker.

foreach(header parallel_for parallel_invoke task_arena global_control)
  foreach(folder tbb oneapi/tbb)
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/tbb_of_threads/${folder}/${header}.h
         CONTENT "#include \"loops_of_threads.h\"\n" @ONLY)
  endforeach()
endforeach()
if(NOT TARGET TBB::tbb)
  add_library(TBB::tbb INTERFACE IMPORTED)
  target_include_directories(TBB::tbb INTERFACE ${PROJECT_BINARY_DIR}/tbb_of_threads ${CMAKE_CURRENT_LIST_DIR}/include)
endif()
set(TBB_FOUND TRUE)
