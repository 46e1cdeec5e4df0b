// SPDX-License-Identifier: Apache-2.0
// Part of sanitized programs (sanitizers.cmake): no library is unloaded before the sanitizers have made their reports.

extern "C" int dlclose(void* /*library*/) noexcept { return 0; }
