# SPDX-License-Identifier: Apache-2.0
# One warning set for every target of the project; errors when LUXO_WERROR is on (all presets).

function(luxo_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
    -Woverloaded-virtual -Wcast-align -Wno-missing-field-initializers $<$<BOOL:${LUXO_WERROR}>:-Werror>)
endfunction()
