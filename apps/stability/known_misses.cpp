// SPDX-License-Identifier: Apache-2.0
#include "stability/known_misses.h"

namespace luxo {
namespace {

struct KnownMiss {
  std::string_view id;
  std::string_view what;  // how the measurement's name begins
  std::string_view reason;
};

constexpr std::string_view kAngles =
    "angles of several turns are rounded to float, 2e-6 at five turns, and a float's 2 pi is off by 1.7e-7: "
    "sines of turns instead of radians would keep both exact";
constexpr std::string_view kPolynomials =
    "the terms of the polynomials cancel, each rounded to float: parameters local to a cell would keep them "
    "small";
constexpr std::string_view kZoom =
    "S(u, v) and (u, v) are floats with 2^-24 of the object's size, which a zoom magnifies: parameters local "
    "to a cell and points relative to the eye would not be";

constexpr KnownMiss kMisses[] = {
    {"ST-05", "error on the device: teapot", kPolynomials},
    {"ST-05", "error on the device: monkey_saddle", kPolynomials},
    {"ST-05", "error on the device: dini", kAngles},
    {"ST-05", "error on the device: enneper", kPolynomials},
    {"ST-05", "error on the device: scherk",
     "the tangent grows without limit toward its poles, where the "
     "rounding of an angle counts most"},
    {"ST-05", "error on the device: mobius", kAngles},
    {"ST-05", "error on the device: klein_figure8", kAngles},
    {"ST-05", "error on the device: boy", kAngles},  // both of that name
    {"ST-05", "error on the device: steiner_roman", kAngles},
    {"ST-05", "error on the device: cross_cap", kAngles},
    {"ST-05", "error on the device: spring", kAngles},
    {"ST-05", "error on the device: twisted_torus", kAngles},
    {"ST-05", "error on the device: torus_knot", kAngles},
    {"ST-05", "error on the device: seashell", kAngles},
    {"ST-09", "zoom 1e+01: position", kZoom},
    {"ST-09", "zoom 1e+01: residual", kZoom},
    {"ST-09", "zoom 1e+02: position", kZoom},
    {"ST-09", "zoom 1e+02: residual", kZoom},
    {"ST-09", "zoom 1e+03: position", kZoom},
    {"ST-09", "zoom 1e+03: residual", kZoom},
    {"ST-09", "zoom 1e+04: position", kZoom},
    {"ST-09", "zoom 1e+04: residual", kZoom},
    {"ST-09", "zoom 1e+04: outline", kZoom},
    {"ST-09", "zoom 1e+05: position", kZoom},
    {"ST-09", "zoom 1e+05: residual", kZoom},
    {"ST-09", "zoom 1e+05: outline", kZoom},
    {"ST-09", "zoom 1e+06: position", kZoom},
    {"ST-09", "zoom 1e+06: residual", kZoom},
    {"ST-09", "zoom 1e+06: outline", kZoom},
    {"ST-19", "in a torus' tube: depth",
     "S(u, v) is rounded to 2^-24 of the torus, 1.4 m, and the wall is 0.3 m before the eye"},
    {"ST-21", "flat, slanted, vertices to 2^20 px",
     "a float vertex a million pixels away is rounded to 1/16 pixel: clipping in double would not be"},
    {"ST-21", "exact, upright, vertices to 2^20 px",
     "a point counts as on the patch up to a millionth of its size beyond its edge: two pixels here"},
    {"ST-21", "exact, slanted, vertices to 2^20 px",
     "a point counts as on the patch up to a millionth of its size beyond its edge: two pixels here"},
};

}  // namespace

std::optional<std::string_view> reasonForMiss(std::string_view id, std::string_view what) {
  for (const KnownMiss& miss : kMisses)
    if (miss.id == id && what.starts_with(miss.what)) return miss.reason;
  return std::nullopt;
}

}  // namespace luxo
