// SPDX-License-Identifier: Apache-2.0
#include "draw/secondary_rays.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "tessellate/parallel.h"

namespace luxo {
namespace {

/// A point asks for one ray more in each round. Searches and rays may each have found it, one after the
/// other.
constexpr std::uint32_t kMaxTraceRounds = 2 * shared::kMaxTraces;

/// How far a point that is shown may be from where its pixel's ray meets the surface. Exact ones are within
/// single precision; those of meshes within a pixel or so, seen at 75 degrees or steeper.
constexpr double kStoredRounding = 0x1p-18, kPixels = 4;

}  // namespace

void SecondaryRays::begin(const Snapshot& snapshot, const Vec3& origin, std::function<bool()> goesOn) {
  caster_.reset();
  snapshot_ = snapshot;
  snapshot_.ambientOcclusion = {};
  origin_ = origin;
  goesOn_ = std::move(goesOn);
  caster_.emplace(snapshot_, shapes_, reference::Cells::WhereRaysGo);
  opaque_.clear();
  all_.resize(snapshot_.nodes.size());
  std::iota(all_.begin(), all_.end(), 0U);
  for (const std::uint32_t node : all_)
    if (!snapshot_.materials[snapshot_.nodes[node].material.index].transparent()) opaque_.push_back(node);
  casts_.clear();
  answers_.clear();
  const std::size_t pixels = static_cast<std::size_t>(snapshot_.view.size.width) *
                             static_cast<std::size_t>(snapshot_.view.size.height);
  starts_.assign(pixels + 1, 0);
  rounds_ = 0;
  undecided_ = open_ = 0;
}

bool SecondaryRays::answer(std::span<const shared::TraceQuestion> questions) {
  std::vector<Cast> asked;
  for (std::uint32_t pixel = 0; pixel < questions.size(); ++pixel)
    if (questions[pixel].ray.from != shared::kNoQuestion) asked.push_back({pixel, questions[pixel].ray});
  open_ = asked.size();
  if (asked.empty() || rounds_++ > kMaxTraceRounds) return false;
  forget(questions);
  std::vector<reference::Ray> fromEye;
  for (const Cast& one : asked)
    if (one.ray.from == shared::kFromPoint) fromEye.push_back(rayOf(one.pixel));
  caster_->prepareFor(fromEye, opaque_);
  std::vector<Start> starts(asked.size());
  forEachIndex(asked.size(), asked.size() >= reference::kRaysForAllCores, [&](std::size_t i) {
    if (goesOn_()) starts[i] = startOf(asked[i].pixel, questions[asked[i].pixel]);
  });
  std::vector<reference::Ray> rays;
  const auto prepare = [&](std::span<const std::size_t> chosen, std::size_t worth) {
    rays.clear();
    for (const std::size_t i : chosen) rays.push_back({starts[i].hit.position, Vec3(asked[i].ray.direction)});
    caster_->prepareFor(rays, all_, worth);
  };
  std::vector<std::size_t> chosen(asked.size());
  std::iota(chosen.begin(), chosen.end(), std::size_t{0});
  prepare(chosen, 1);
  cast(starts, asked, chosen);
  // What few cells leave undecided many may not.
  std::erase_if(chosen, [&](std::size_t i) { return asked[i].certified; });
  if (!chosen.empty()) {
    prepare(chosen, reference::kRaysForFinestCells);
    cast(starts, asked, chosen);
  }
  keep(std::move(asked));
  return true;
}

reference::Ray SecondaryRays::rayOf(std::uint32_t pixel) const {
  const View& view = snapshot_.view;
  const auto width = static_cast<std::uint32_t>(view.size.width);
  const Vec2 at = Vec2(pixel % width + 0.5, pixel / width + 0.5) + view.sampleOffsetPx;
  return caster_->rayThrough(at.x, at.y);
}

SecondaryRays::Start SecondaryRays::startOf(std::uint32_t pixel,
                                            const shared::TraceQuestion& question) const {
  if (question.ray.from >= shared::kFromFirstHit) {
    const std::uint32_t index = starts_[pixel] + (question.ray.from - shared::kFromFirstHit);
    if (index < starts_[pixel + 1] && casts_[index].hit) return {*casts_[index].hit, casts_[index].travelled};
  }
  const View& view = snapshot_.view;
  const Vec3 shown = Vec3(question.position) + origin_;
  const double distance = glm::distance(shown, view.eye);
  const double pixelSize = (view.perspective() ? distance : 1) / view.pixelsPerUnit;
  reference::Caster::First seen = caster_->firstOf(opaque_, rayOf(pixel));
  if (seen.hit &&
      glm::distance(seen.hit->position, shown) <= kStoredRounding * distance + kPixels * pixelSize)
    return {*seen.hit, distance, seen.certified};
  // A mesh shows something else there. Its points are rounded: those of the surface around it are not met.
  return {{.position = shown}, distance};
}

void SecondaryRays::cast(std::span<const Start> starts, std::span<Cast> asked,
                         std::span<const std::size_t> chosen) const {
  forEachIndex(chosen.size(), chosen.size() >= reference::kRaysForAllCores, [&](std::size_t k) {
    if (!goesOn_()) return;
    Cast& one = asked[chosen[k]];
    const Start& start = starts[chosen[k]];
    const reference::Ray ray{start.hit.position, unit(Vec3(one.ray.direction))};
    const reference::Caster::Sight sight = caster_->lookFrom(start.hit, ray.direction, start.travelled);
    one.certified = start.certified && sight.certified;
    one.color = caster_->color(ray, sight, one.certified);
    one.hit.reset();
    if (sight.hits.empty()) return;
    one.hit = sight.hits.front();
    one.travelled = start.travelled + one.hit->t;
  });
}

void SecondaryRays::forget(std::span<const shared::TraceQuestion> questions) {
  std::uint32_t index = 0;
  const std::size_t forgotten = std::erase_if(casts_, [&](const Cast& one) {
    const shared::TraceQuestion& question = questions[one.pixel];
    const std::uint32_t number = index++ - starts_[one.pixel];
    return question.ray.from != shared::kNoQuestion && number >= question.number;
  });
  if (forgotten > 0) findStarts();
}

void SecondaryRays::keep(std::vector<Cast> asked) {
  std::vector<Cast> both;
  both.reserve(casts_.size() + asked.size());
  std::merge(std::move_iterator(casts_.begin()), std::move_iterator(casts_.end()),
             std::move_iterator(asked.begin()), std::move_iterator(asked.end()), std::back_inserter(both),
             [](const Cast& a, const Cast& b) { return a.pixel < b.pixel; });
  casts_ = std::move(both);
  answers_.clear();
  undecided_ = 0;
  std::optional<std::uint32_t> counted;
  for (const Cast& one : casts_) {
    answers_.push_back(answerOf(one));
    if (one.certified || counted == one.pixel) continue;
    counted = one.pixel;
    ++undecided_;
  }
  findStarts();
}

void SecondaryRays::findStarts() {
  std::ranges::fill(starts_, 0U);
  for (const Cast& one : casts_) ++starts_[one.pixel + 1];
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
}

shared::TraceAnswer SecondaryRays::answerOf(const Cast& cast) const {
  shared::TraceAnswer answer{.ray = cast.ray, .distance = -1, .color = Vec3f(cast.color)};
  if (!cast.hit) return answer;
  const reference::Hit& hit = *cast.hit;
  const bool turned = glm::dot(hit.normal, Vec3(cast.ray.direction)) > 0;
  answer.distance = static_cast<float>(hit.t);
  answer.position = Vec3f(hit.position - origin_);
  answer.normal = Vec3f(turned ? -hit.normal : hit.normal);
  answer.parameters = Vec2f(hit.u, hit.v);
  answer.inside = hit.back;
  return answer;
}

}  // namespace luxo
