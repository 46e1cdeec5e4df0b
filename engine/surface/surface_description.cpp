// SPDX-License-Identifier: Apache-2.0
#include "surface/surface_description.h"

#include <algorithm>
#include <array>
#include <functional>
#include <string>

#include "math/bits.h"

namespace luxo {
namespace {

std::array<double, 4> numbersOf(const Domain& domain) {
  return {domain.u.lo, domain.u.hi, domain.v.lo, domain.v.hi};
}

/// In their order, with what is not there as 0.
std::array<double, 6> numbersOf(const SurfaceTraits& traits) {
  const Paraboloid paraboloid = traits.paraboloid.value_or(Paraboloid());
  const Vec3 normal = traits.flatNormal.value_or(Vec3(0));
  return {traits.orientation, paraboloid.focalLength, paraboloid.height, normal.x, normal.y, normal.z};
}

bool hasOwnBounds(const SurfaceFunction& function) {
  return function.bounder.position || function.bounder.tangents || function.bounder.second;
}

/// Bounds of a family's own are functions: nobody can tell whether two of them are the same.
bool same(const SurfaceFunction& a, const SurfaceFunction& b) {
  if (&a == &b) return true;
  return !hasOwnBounds(a) && !hasOwnBounds(b) && a.originOfU == b.originOfU && a.position == b.position &&
         a.tangents == b.tangents && a.second == b.second && a.guards == b.guards &&
         a.guardAtIntegers == b.guardAtIntegers;
}

bool same(const GeneralForm::Argument& a, const GeneralForm::Argument& b) {
  return sameBits(a.value, b.value) && a.parameter == b.parameter;
}

bool same(const std::shared_ptr<const GeneralForm>& a, const std::shared_ptr<const GeneralForm>& b) {
  if (!a || !b) return a == b;
  const auto sameArgument = [](const auto& x, const auto& y) { return same(x, y); };
  return a->position == b->position && std::ranges::equal(a->arguments, b->arguments, sameArgument);
}

bool same(const Patch& a, const Patch& b) {
  return sameBits(numbersOf(a.domain), numbersOf(b.domain)) && sameBits(a.constants, b.constants) &&
         same(*a.function, *b.function) && same(a.general, b.general);
}

bool same(const SurfaceTraits& a, const SurfaceTraits& b) {
  return a.name == b.name && a.paraboloid.has_value() == b.paraboloid.has_value() &&
         a.flatNormal.has_value() == b.flatNormal.has_value() && a.revolution == b.revolution &&
         a.borders == b.borders && sameBits(numbersOf(a), numbersOf(b));
}

/// Which patches share a function: of each the number of its own, in the order in which they come.
std::vector<std::size_t> functionNumbers(const std::vector<Patch>& patches) {
  std::unordered_map<const SurfaceFunction*, std::size_t> numbers;
  std::vector<std::size_t> all;
  for (const Patch& patch : patches)
    all.push_back(numbers.try_emplace(patch.function.get(), numbers.size()).first->second);
  return all;
}

std::uint64_t hashOf(const SurfaceDescription& description) {
  std::uint64_t hash = mixed(std::hash<std::string>()(description.traits.name), description.initial);
  hash = mixed(hash, numbersOf(description.traits));
  for (const Patch& patch : description.patches)
    hash =
        mixed(mixed(mixed(hash, numbersOf(patch.domain)), patch.constants), patch.function->position.hash());
  return hash;
}

}  // namespace

bool madeAlike(const SurfaceDescription& a, const SurfaceDescription& b) {
  const auto samePatch = [](const Patch& x, const Patch& y) { return same(x, y); };
  return same(a.traits, b.traits) && sameBits(a.initial, b.initial) &&
         std::ranges::equal(a.patches, b.patches, samePatch) &&
         functionNumbers(a.patches) == functionNumbers(b.patches);
}

SurfaceDescriptions& SurfaceDescriptions::all() {
  static SurfaceDescriptions descriptions;
  return descriptions;
}

std::shared_ptr<const SurfaceDescription> SurfaceDescriptions::find(const SurfaceDescription& like) {
  const std::uint64_t hash = hashOf(like);
  const std::lock_guard lock(mutex_);
  return findLocked(hash, like);
}

std::shared_ptr<const SurfaceDescription> SurfaceDescriptions::add(
    const std::shared_ptr<const SurfaceDescription>& description) {
  const std::uint64_t hash = hashOf(*description);
  const std::lock_guard lock(mutex_);
  if (auto known = findLocked(hash, *description)) return known;
  if (byHash_.size() >= mostBeforeLook_) forgetTheGone();
  byHash_.emplace(hash, description);
  return description;
}

std::shared_ptr<const SurfaceDescription> SurfaceDescriptions::findLocked(std::uint64_t hash,
                                                                          const SurfaceDescription& like) {
  const auto [first, last] = byHash_.equal_range(hash);
  for (auto entry = first; entry != last; ++entry)
    if (auto known = entry->second.lock(); known && madeAlike(*known, like)) return known;
  return nullptr;
}

void SurfaceDescriptions::forgetTheGone() {
  std::erase_if(byHash_, [](const auto& entry) { return entry.second.expired(); });
  mostBeforeLook_ = std::max<std::size_t>(64, 2 * byHash_.size());
}

}  // namespace luxo
