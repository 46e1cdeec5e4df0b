// SPDX-License-Identifier: Apache-2.0
#include "formula/names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/assert.h"
#include "formula/vocabulary.h"

namespace luxo {

// A definition whose uses of other definitions are being followed.
struct FormulaNames::Reading {
  std::string_view name;
  Entry* entry;
  std::vector<Diagnostic> diagnostics;
  std::vector<Token> tokens;
  std::size_t next = 0;

  Reading(std::string_view itsName, Entry& itsEntry)
      : name(itsName), entry(&itsEntry), tokens(tokenize(itsEntry.text, diagnostics)) {
    entry->progress = Progress::Reading;
  }
};

namespace {

std::string chainOf(const std::vector<std::string_view>& names) {
  constexpr std::size_t kShown = 8;
  std::vector<std::string> shown;
  for (const std::string_view name : names) shown.push_back(shortened(name));
  if (shown.size() > kShown) {
    shown.erase(shown.begin() + kShown - 2, shown.end() - 2);
    shown.insert(shown.end() - 2, "...");
  }
  return fmt::format("{}", fmt::join(shown, " -> "));
}

}  // namespace

const FormulaNames::Entry* FormulaNames::find(std::string_view name) const {
  const auto found = entries_.find(name);
  return found == entries_.end() ? nullptr : &found->second;
}

FormulaNames::Entry* FormulaNames::findUnread(const Token& token) {
  if (token.kind != TokenKind::Name || findFunction(token.text) || findConstant(token.text)) return nullptr;
  const auto found = entries_.find(token.text);
  if (found == entries_.end() || found->second.meaning != Meaning::Definition) return nullptr;
  return found->second.progress == Progress::Read ? nullptr : &found->second;
}

void FormulaNames::readDefinitions(const std::vector<Token>& tokens) {
  std::vector<Reading> chain;
  const auto reportCircle = [&](const Token& use) {
    if (chain.back().diagnostics.size() >= kMaxFormulaErrors) return;
    std::vector<std::string_view> circle = {use.text};
    for (std::size_t i = chain.size(); i-- > 0;) {
      circle.push_back(chain[i].name);
      if (chain[i].name == use.text) break;
    }
    std::reverse(circle.begin(), circle.end());
    chain.back().diagnostics.push_back(
        {use.where, fmt::format("'{}' depends on itself: {}", shortened(use.text), chainOf(circle)),
         "one of them needs a formula without the others"});
  };

  for (const Token& root : tokens) {
    if (Entry* entry = findUnread(root)) chain.emplace_back(root.text, *entry);
    while (!chain.empty()) {
      Reading& reading = chain.back();
      if (reading.next == reading.tokens.size()) {
        reading.entry->formula =
            readFormula(reading.entry->text, reading.tokens, std::move(reading.diagnostics), *this);
        reading.entry->progress = Progress::Read;
        chain.pop_back();
        continue;
      }
      const Token use = reading.tokens[reading.next++];
      Entry* used = findUnread(use);
      if (!used) continue;
      if (used->progress == Progress::Reading)
        reportCircle(use);
      else
        chain.emplace_back(use.text, *used);
    }
  }
}

std::vector<std::string> FormulaNames::values() const {
  std::vector<std::string> result;
  for (const auto& [name, entry] : entries_)
    if (entry.meaning != Meaning::Absent) result.push_back(name);
  std::sort(result.begin(), result.end());
  for (const FormulaConstant& constant : formulaConstants()) result.emplace_back(constant.name);
  return result;
}

Scope::Scope() : names_(std::make_unique<FormulaNames>()) {}
Scope::~Scope() = default;
Scope::Scope(Scope&&) noexcept = default;
Scope& Scope::operator=(Scope&&) noexcept = default;

void Scope::bind(std::string name, Expr value) {
  names_->set(std::move(name), {.meaning = FormulaNames::Meaning::Value, .value = value});
}

void Scope::define(std::string name, std::string text) {
  names_->set(std::move(name), {.meaning = FormulaNames::Meaning::Definition, .text = std::move(text)});
}

void Scope::explainAbsence(std::string name, std::string reason) {
  names_->set(std::move(name), {.meaning = FormulaNames::Meaning::Absent, .text = std::move(reason)});
}

std::optional<Diagnostic> Scope::nameProblem(std::string_view name) const {
  const SourceRange all{0, name.size()};
  const std::string shown = shortened(name);
  std::vector<Diagnostic> foreign;
  const std::vector<Token> tokens = tokenize(name, foreign);
  if (tokens.size() != 2 || tokens[0].text != name || tokens[0].kind != TokenKind::Name)
    return Diagnostic{all, fmt::format("'{}' cannot be a name", shown),
                      "names are ASCII letters, digits and _, and do not start with a digit"};
  if (findFunction(name))
    return Diagnostic{all, fmt::format("'{}' is the name of a function", shown), "choose another name"};
  if (findConstant(name))
    return Diagnostic{all, fmt::format("'{}' is the name of a constant", shown), "choose another name"};
  const FormulaNames::Entry* entry = names_->find(name);
  if (entry && entry->meaning != FormulaNames::Meaning::Absent)
    return Diagnostic{all, fmt::format("the name '{}' is taken", shown), "choose another name"};
  return std::nullopt;
}

const Formula& Scope::definition(std::string_view name) {
  const FormulaNames::Entry* entry = names_->find(name);
  LUXO_REQUIRE(entry && entry->meaning == FormulaNames::Meaning::Definition);
  names_->readDefinitions({{.kind = TokenKind::Name, .where = {}, .text = name}});
  return entry->formula;
}

Formula parse(std::string_view text, Scope& scope) {
  std::vector<Diagnostic> diagnostics;
  const std::vector<Token> tokens = tokenize(text, diagnostics);
  scope.names_->readDefinitions(tokens);
  return readFormula(text, tokens, std::move(diagnostics), *scope.names_);
}

}  // namespace luxo
