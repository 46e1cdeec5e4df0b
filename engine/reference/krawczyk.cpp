// SPDX-License-Identifier: Apache-2.0
#include "reference/krawczyk.h"

namespace luxo::reference {

std::optional<Solutions> krawczyk(const Slopes& j, const Ball& f1, const Ball& f2, double halfU,
                                  double halfV) {
  const double det = j.determinant();
  if (!(std::abs(det) > 0) || !std::isfinite(1 / det)) return std::nullopt;
  const double yuu = j.vv.center / det, yuv = -j.uv.center / det;
  const double yvu = -j.vu.center / det, yvv = j.uu.center / det;
  // K = middle - Y f(middle) + (I - Y J)(rectangle - middle), in balls. I - Y J: what rounding left, and
  // radii.
  const auto product = [](double a, double b, const Ball& x, const Ball& y, double one) {
    const double center = one - (a * x.center + b * y.center);
    return std::abs(center) + std::abs(a) * x.radius + std::abs(b) * y.radius +
           8 * kEpsilon * (one + std::abs(a * x.center) + std::abs(b * y.center));
  };
  const double muu = product(yuu, yuv, j.uu, j.vu, 1), muv = product(yuu, yuv, j.uv, j.vv, 0);
  const double mvu = product(yvu, yvv, j.uu, j.vu, 0), mvv = product(yvu, yvv, j.uv, j.vv, 1);
  Solutions s;
  s.stepU = -(yuu * f1.center + yuv * f2.center);
  s.stepV = -(yvu * f1.center + yvv * f2.center);
  const auto noise = [&](double a, double b) {
    // The two products may cancel in the step: their own rounding stays.
    return std::abs(a) * f1.radius + std::abs(b) * f2.radius +
           8 * kEpsilon * (std::abs(a * f1.center) + std::abs(b * f2.center));
  };
  s.radiusU = (muu * halfU + muv * halfV + noise(yuu, yuv)) * (1 + 8 * kEpsilon);
  s.radiusV = (mvu * halfU + mvv * halfV + noise(yvu, yvv)) * (1 + 8 * kEpsilon);
  if (!(std::isfinite(s.radiusU) && std::isfinite(s.radiusV))) return std::nullopt;
  return s;
}

}  // namespace luxo::reference
