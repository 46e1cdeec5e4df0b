// SPDX-License-Identifier: Apache-2.0
#include "stability/known_misses.h"

namespace luxo {
namespace {

struct KnownMiss {
  std::string_view id;
  std::string_view what;  // how the measurement's name begins
  std::string_view reason;
};

constexpr std::string_view kProducts =
    "sums of products of sines cancel, each rounded to float: where the error is largest the tangent is "
    "short";
constexpr std::string_view kPolynomials =
    "the terms of the polynomials cancel, each rounded to float: parameters local to a cell would keep them "
    "small";

constexpr KnownMiss kMisses[] = {
    {"ST-05", "error on the device: teapot", kPolynomials},
    {"ST-05", "error on the device: scherk",
     "the tangent grows without limit toward its poles, where the rounding of an angle counts most"},
    {"ST-05", "error on the device: boy", kProducts},  // both of that name
};

}  // namespace

std::optional<std::string_view> reasonForMiss(std::string_view id, std::string_view what) {
  for (const KnownMiss& miss : kMisses)
    if (miss.id == id && what.starts_with(miss.what)) return miss.reason;
  return std::nullopt;
}

}  // namespace luxo
