# SPDX-License-Identifier: Apache-2.0
# The code in README.md is the code that is compiled and tested: fails when they differ.
# Usage: cmake -DSOURCE_DIR=... -P check_readme.cmake

file(READ ${SOURCE_DIR}/README.md readme)
file(READ ${SOURCE_DIR}/apps/examples/first_image.cpp example)
string(FIND "${example}" "#include" start)
string(SUBSTRING "${example}" ${start} -1 example)
string(STRIP "${example}" example)
string(FIND "${readme}" "${example}" found)
if(found EQUAL -1)
  message(FATAL_ERROR "README.md does not show apps/examples/first_image.cpp as it is: copy it there")
endif()
