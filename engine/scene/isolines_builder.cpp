// SPDX-License-Identifier: Apache-2.0
#include "scene/isolines_builder.h"

#include <algorithm>
#include <initializer_list>

namespace luxo {
namespace {

constexpr Allowed kWidth{{0, 1000}, "from 0 to 1000 pixels"};
constexpr Allowed kCount{{1, 1e5}, "from 1 to 100000"};

/// Takes values in the order of appendQuantities().
class Values {
 public:
  Values(std::span<const Expr> values, MomentFormulas& formulas) : values_(values), formulas_(formulas) {}

  Expr next(const Quantity& written, const Allowed& allowed) {
    const Expr value = values_.front();
    values_ = values_.subspan(1);
    if (value.isConstant()) formulas_.accept(written, value.constant(), allowed);
    return value;
  }
  /// Of what may not be written.
  std::optional<Expr> next(const std::optional<Quantity>& written, const Allowed& allowed) {
    return written ? std::optional(next(*written, allowed)) : std::nullopt;
  }

 private:
  std::span<const Expr> values_;
  MomentFormulas& formulas_;
};

Isolines built(const IsolinesDesc& desc, Values& values, Expr u, Expr v, const Domain& domain) {
  Isolines lines;
  const std::optional<Expr> of = values.next(desc.of, kAny), step = values.next(desc.step, kLength),
                            countU = values.next(desc.u, kCount), countV = values.next(desc.v, kCount);
  const Expr at = values.next(desc.at, kFinite);
  if (of) lines.families.push_back({*of, at, step});
  if (countU) lines.families.push_back({u, domain.u.lo, domain.u.width() / *countU});
  if (countV) lines.families.push_back({v, domain.v.lo, domain.v.width() / *countV});
  lines.width = values.next(desc.width, kWidth);
  lines.opacity = values.next(desc.opacity, kFraction);
  for (std::size_t i = 0; i < 3; ++i) lines.color[i] = values.next(desc.color[i], kLight);
  return lines;
}

}  // namespace

void appendQuantities(std::span<const IsolinesDesc> isolines, std::vector<Quantity>& quantities) {
  for (const IsolinesDesc& desc : isolines) {
    for (const auto* quantity : {&desc.of, &desc.step, &desc.u, &desc.v})
      if (*quantity) quantities.push_back(**quantity);
    quantities.insert(quantities.end(), {desc.at, desc.width, desc.opacity});
    quantities.insert(quantities.end(), desc.color.begin(), desc.color.end());
  }
}

bool needDomain(std::span<const IsolinesDesc> isolines) {
  return std::ranges::any_of(isolines, [](const IsolinesDesc& desc) { return desc.u || desc.v; });
}

std::vector<Isolines> isolinesOf(std::span<const IsolinesDesc> isolines, std::span<const Expr> values, Expr u,
                                 Expr v, const Domain& domain, MomentFormulas& formulas) {
  std::vector<Isolines> all;
  Values taken(values, formulas);
  for (const IsolinesDesc& desc : isolines) all.push_back(built(desc, taken, u, v, domain));
  return all;
}

}  // namespace luxo
