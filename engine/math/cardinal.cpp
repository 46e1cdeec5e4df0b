// SPDX-License-Identifier: Apache-2.0
#include "math/cardinal.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace luxo {
namespace {

constexpr double kMaxWrong = 1e-13;
/// The first zero of j_1 is at 4.4934, those of higher orders beyond: up to its square no order is negative.
constexpr double kNoneNegative = 20;

/// The power series: w^k / (2^k k! (2n+1)(2n+3)...(2n+2k+1)) with alternating signs, from its last term on.
/// Past 32 terms nothing is left of it where it is used.
double series(double w, int order) {
  constexpr int kTerms = 32;
  double sum = 1;
  for (int k = kTerms; k >= 1; --k) sum = 1 - sum * w / (2 * k * (2 * order + 2 * k + 1));
  return cardinalAtZero(order) * sum;
}

/// Upwards from -1, where it is cos(x), and 0: (2n+1) f_n = f_(n-1) + w f_(n+1) (10.1.19).
double recurrence(double w, int order) {
  const double x = std::sqrt(std::abs(w));
  double below = w > 0 ? std::cos(x) : std::cosh(x), here = (w > 0 ? std::sin(x) : std::sinh(x)) / x;
  for (int n = 0; n < order; ++n) {
    const double above = ((2 * n + 1) * here - below) / w;
    below = here;
    here = above;
  }
  return here;
}

double factorial(int n) { return n < 2 ? 1 : n * factorial(n - 1); }

/// No cardinal(w', order) of a w' >= w >= 1 is larger.
double envelope(double w, int order) {
  const double x = std::sqrt(w);
  double sum = 0;
  for (int k = 0; k <= order; ++k) {
    const double f = factorial(order - k);
    sum += factorial(2 * order - k) * factorial(2 * order - 2 * k) / (factorial(k) * f * f) *
           std::pow(2 * x, 2.0 * (k - order));
  }
  return (1 + 1e-12) * std::sqrt(sum) / std::pow(x, order + 1);  // far more than its roundings
}

double most(double w, int order) {
  const double atZero = cardinalAtZero(order);
  return w > 1 ? std::min(atZero, envelope(w, order)) : atZero;
}

double doubt(double value, int order) {
  return kMaxWrong * std::max(cardinalAtZero(order), std::abs(value));
}

}  // namespace

double cardinalAtZero(int order) {
  double product = 1;
  for (int n = 1; n <= order; ++n) product *= 2 * n + 1;
  return 1 / product;
}

double cardinal(double w, int order) {
  // The series loses digits where its terms grow above 1 and change their signs, the recurrence where x is
  // not well above the order.
  if (w > -100 && w < 9 + 4 * order) return series(w, order);
  if (w == kInfinity) return std::numeric_limits<double>::quiet_NaN();
  return recurrence(w, order);
}

Interval cardinal(const Interval& w, int order) {
  if (!(w.lo > -kInfinity && w.hi < kInfinity)) return Interval::everything();
  const double low = cardinal(w.lo, order), high = cardinal(w.hi, order);
  if (!std::isfinite(low)) return Interval::everything();
  if (w.hi <= kNoneNegative) return {high - doubt(high, order), low + doubt(low, order)};
  const double bound = w.lo < 0 ? low : most(w.lo, order);
  const Interval all(-most(std::max(w.lo, 0.0), order), bound);
  // From the middle on, at most so steep.
  const double steepest = 0.5 * (w.lo < 0 ? cardinal(w.lo, order + 1) : most(w.lo, order + 1));
  const double middle = cardinal(w.mid(), order);
  const double away = steepest * std::max(w.hi - w.mid(), w.mid() - w.lo) * (1 + 1e-12);
  const double wrong = doubt(bound, order);
  return {std::max(all.lo, middle - away) - wrong, std::min(all.hi, middle + away) + wrong};
}

PartialInterval cardinal(const PartialInterval& w, int order) {
  return {cardinal(w.range, order), w.defined};
}

}  // namespace luxo
