// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_problems.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"

namespace luxo {
namespace {

constexpr std::size_t kMaxKeptProblems = 4096;

}  // namespace

SourceRange rangeIn(const Quantity& quantity, SourceRange part) {
  const SourceRange whole = rangeOf(quantity.place());
  if (!quantity.isFormula() || whole.end - whole.begin != quantity.formula().size() + 2) return whole;
  return {whole.begin + 1 + part.begin, whole.begin + 1 + part.end};
}

bool SceneProblems::full() const { return count_ >= kMaxKeptProblems; }

void SceneProblems::add(SourceRange where, std::string message, std::string hint) {
  // A material is built again for what is drawn in another way.
  if (source_.text && isRecent({where, message, hint})) return;
  if (++count_ <= kMaxKeptProblems) problems_.push_back({{where, std::move(message), std::move(hint)}, {}});
}

void SceneProblems::add(const Quantity& quantity, Diagnostic diagnostic) {
  if (source_.text) {
    diagnostic.where = rangeIn(quantity, diagnostic.where);
    add(diagnostic.where, std::move(diagnostic.message), std::move(diagnostic.hint));
    return;
  }
  const std::string formula =
      quantity.isFormula() ? quantity.formula() : fmt::format("{}", quantity.number());
  if (++count_ <= kMaxKeptProblems) problems_.push_back({std::move(diagnostic), formula});
}

bool SceneProblems::isRecent(const Diagnostic& diagnostic) const {
  constexpr std::size_t kFew = 16;  // more than one formula has, but for very long ones
  const std::size_t first = problems_.size() - std::min(problems_.size(), kFew);
  return std::any_of(problems_.begin() + static_cast<std::ptrdiff_t>(first), problems_.end(),
                     [&](const Problem& problem) {
                       return problem.diagnostic.where.begin == diagnostic.where.begin &&
                              problem.diagnostic.where.end == diagnostic.where.end &&
                              problem.diagnostic.message == diagnostic.message;
                     });
}

std::string SceneProblems::text() const {
  std::vector<const Problem*> sorted;
  for (const Problem& problem : problems_) sorted.push_back(&problem);
  std::ranges::stable_sort(sorted, {}, [](const Problem* p) { return p->diagnostic.where.begin; });
  std::string text;
  for (std::size_t i = 0; i < std::min(sorted.size(), kMaxShownProblems); ++i) {
    const auto& [diagnostic, formula] = *sorted[i];
    if (i > 0) text += "\n";
    if (!formula.empty()) {
      text += describe("formula", formula, diagnostic);
    } else if (source_.text) {
      text += describe(source_.name, *source_.text, diagnostic);
    } else {
      text += diagnostic.message;
      if (!diagnostic.hint.empty()) text += "\n  help: " + diagnostic.hint;
    }
  }
  if (count_ > kMaxShownProblems) text += fmt::format("\nand {} more errors", count_ - kMaxShownProblems);
  return text;
}

void SceneProblems::raise() const {
  if (any()) throw Error(ErrorKind::Scene, text());
}

}  // namespace luxo
