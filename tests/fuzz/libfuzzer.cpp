// SPDX-License-Identifier: Apache-2.0
// The entry point libFuzzer calls. LUXO_FUZZ_TARGET names the function of fuzz/target.h.
#include <cstddef>
#include <cstdint>

#include "fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  luxo::LUXO_FUZZ_TARGET({reinterpret_cast<const char*>(data), size});
  return 0;
}
