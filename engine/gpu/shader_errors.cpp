// SPDX-License-Identifier: Apache-2.0
#include "gpu/shader_errors.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>
#include <set>
#include <span>

#include <fmt/format.h>

#include "base/glsl_tokens.h"

namespace luxo::gpu {
namespace {

namespace fs = std::filesystem;

using Tokens = std::span<const GlslToken>;

const ShaderSource* find(std::span<const ShaderSource> sources, std::string_view name) {
  const auto found = std::ranges::find(sources, name, &ShaderSource::name);
  return found == sources.end() ? nullptr : &*found;
}

/// The names in `#include "..."` of a text. Those in comments count, too, which is more than enough.
std::vector<std::string_view> includedBy(std::string_view text) {
  constexpr std::string_view kBlank = " \t", kDirective = "include";
  std::vector<std::string_view> names;
  for (std::size_t at = text.find('#'); at != text.npos; at = text.find('#', at + 1)) {
    std::size_t name = text.find_first_not_of(kBlank, at + 1);
    if (name == text.npos || !text.substr(name).starts_with(kDirective)) continue;
    name = text.find_first_not_of(kBlank, name + kDirective.size());
    if (name == text.npos || text[name] != '"') continue;
    ++name;
    names.push_back(text.substr(name, std::min(text.find('"', name), text.find('\n', name)) - name));
  }
  return names;
}

std::string_view writtenText(const ShaderSource& source) {
  return source.shown.empty() ? source.text : source.shown;
}

/// Those that begin in the range.
Tokens tokensIn(Tokens tokens, const SourceRange& where) {
  const auto begin = std::ranges::lower_bound(tokens, where.begin, {}, &GlslToken::begin),
             end = std::ranges::lower_bound(tokens, where.end, {}, &GlslToken::begin);
  return {begin, end};
}

SourceRange rangeOf(const GlslToken& token) { return {token.begin, token.end()}; }

/// What is between the first two quotes of a message.
std::string_view quotedIn(std::string_view message) {
  if (!message.starts_with('\'')) return {};
  const std::size_t end = message.find('\'', 1);
  return end == message.npos ? std::string_view() : message.substr(1, end - 1);
}

/// Of the `)` at an index, where its `(` is.
std::optional<std::size_t> opening(Tokens tokens, std::size_t close) {
  if (tokens[close].text != ")") return std::nullopt;
  std::size_t depth = 0;
  for (std::size_t i = close + 1; i-- > 0;) {
    depth += tokens[i].text == ")" ? 1 : 0;
    depth -= tokens[i].text == "(" ? 1 : 0;
    if (depth == 0) return i;
  }
  return std::nullopt;
}

/// What is called by the `(` there: of an array's type its name; null: nothing.
const GlslToken* nameBefore(Tokens tokens, std::size_t open) {
  std::size_t i = open - 1;
  for (int depth = 0; i > 0; --i) {
    depth += tokens[i].text == "]" ? 1 : tokens[i].text == "[" ? -1 : 0;
    if (depth == 0 && tokens[i].text != "[") break;
  }
  return tokens[i].isWord() ? &tokens[i] : nullptr;
}

/// Of the line that holds a byte, without its end.
SourceRange lineAround(std::string_view text, std::size_t at) {
  const std::size_t before = at == 0 ? text.npos : text.rfind('\n', at - 1);
  return {before == text.npos ? 0 : before + 1, std::min(text.find('\n', at), text.size())};
}

std::string_view trimmed(std::string_view text) {
  text = text.substr(std::min(text.find_first_not_of(' '), text.size()));
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

}  // namespace

const ShaderSource* includedSource(std::span<const ShaderSource> sources, std::string_view name,
                                   std::string_view includer) {
  const fs::path beside = (fs::path(includer).parent_path() / name).lexically_normal();
  const ShaderSource* source = find(sources, beside.string());
  return source ? source : find(sources, name);
}

std::vector<const ShaderSource*> reachedSources(const ShaderDesc& desc) {
  std::vector<const ShaderSource*> reached{&desc.source};
  std::set<std::string_view> seen;
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (const std::string_view name : includedBy(reached[i]->text))
      if (const ShaderSource* source = includedSource(desc.includes, name, reached[i]->name);
          source && seen.insert(source->name).second)
        reached.push_back(source);
  return reached;
}

WordLines::WordLines(const ShaderDesc& desc) : of_(desc), split_(desc) {
  for (const ShaderSource* source : reachedSources(desc)) files_.push_back(split(*source));
  for (const File& file : files_) includes_.push_back({file.source->name, file.text});
  split_.source.text = files_.front().text;
  split_.includes = includes_;
  const bool isJoined =
      std::ranges::any_of(desc.includes, [](const auto& one) { return !one.shown.empty(); });
  for (const File& file : files_) {
    if (isJoined && file.source->shown.empty()) continue;  // luxo's own
    const std::vector<GlslToken> tokens = glslTokens(writtenText(*file.source));
    for (const GlslDirective& directive : directivesIn(tokens))
      if (directive.name == "define" && !directive.rest.empty()) macros_.insert(directive.rest.front().text);
  }
}

WordLines::File WordLines::split(const ShaderSource& source) {
  File file{.source = &source};
  const GlslToken* last = nullptr;
  for (const std::vector<GlslToken> tokens = glslTokens(source.text); const GlslToken& token : tokens) {
    // A name right behind a number may be a part of it.
    const bool goesOn = last && (token.directive > 0 ? token.directive == last->directive
                                                     : last->directive == 0 && !token.afterBlank &&
                                                           last->kind == GlslToken::Kind::Number);
    if (goesOn) {
      if (token.afterBlank) file.text += ' ';
      file.places.back().end = token.end();
    } else {
      if (last) file.text += '\n';
      file.places.push_back(rangeOf(token));
    }
    file.text += token.text;
    last = &token;
  }
  file.text += '\n';
  return file;
}

std::string WordLines::asShown(std::string_view text) const {
  return of_.asShown ? of_.asShown(text) : std::string(text);
}

WordLines::Place WordLines::placeOf(const File& file, std::size_t line, std::string_view quoted) const {
  if (file.places.empty()) return {};
  // A condition is computed once its line is read.
  if (quoted == "preprocessor evaluation" && line > 1) --line;
  const SourceRange& where = file.places[std::clamp<std::size_t>(line, 1, file.places.size()) - 1];
  const std::vector<GlslToken> all = glslTokens(file.source->text);
  const Tokens here = tokensIn(all, where);
  const auto find = [&](Tokens tokens) -> const GlslToken* {
    const auto found = std::ranges::find_if(tokens, [&](const GlslToken& token) {
      return token.text == quoted || asShown(token.text) == quoted;
    });
    return found == tokens.end() ? nullptr : &*found;
  };
  if (const GlslToken* token = find(here)) return {rangeOf(*token)};
  if (here.empty()) return {where};
  if (here.front().directive > 0) {
    // The name of a directive is said with its mark.
    const bool isNamed = here.size() > 1 && quoted.starts_with('#') && here[1].text == quoted.substr(1);
    return {isNamed ? SourceRange{here[0].begin, here[1].end()} : rangeOf(here.front())};
  }
  if (here.size() != 1 || quoted.empty()) return {rangeOf(here.front())};
  if (macros_.contains(asShown(here.front().text))) return {where, here.front().text};
  const auto at = static_cast<std::size_t>(here.data() - all.data());
  // An initialiser is told at the name that it is for.
  if (at + 1 < all.size() && all[at + 1].text == quoted) return {rangeOf(all[at + 1])};
  // What is called, a macro among it, is told where its arguments end.
  const std::optional<std::size_t> open = opening(all, at);
  const GlslToken* const called = open && *open > 0 ? nameBefore(all, *open) : nullptr;
  if (!called) return {where};
  if (asShown(called->text) == quoted) return {rangeOf(*called)};
  if (!macros_.contains(called->text)) return {quoted == "constructor" ? rangeOf(*called) : where};
  const GlslToken* const argument = find(Tokens(all).subspan(*open + 1, at - *open - 1));
  if (argument) return {rangeOf(*argument)};
  return {rangeOf(*called), called->text};
}

SourceRange WordLines::shown(const ShaderSource& source, const SourceRange& where) const {
  const std::string_view written = writtenText(source);
  if (written.data() == source.text.data()) return where;
  // Lines are the same.
  const auto line =
      std::count(source.text.begin(), source.text.begin() + static_cast<std::ptrdiff_t>(where.begin), '\n');
  std::size_t begin = 0;
  for (std::ptrdiff_t i = 0; i < line; ++i) {
    const std::size_t end = written.find('\n', begin);
    if (end == written.npos) break;
    begin = end + 1;
  }
  const std::vector<GlslToken> allInText = glslTokens(source.text), allWritten = glslTokens(written);
  const Tokens inText = tokensIn(allInText, lineAround(source.text, where.begin)),
               inWritten = tokensIn(allWritten, lineAround(written, begin));
  constexpr std::size_t kMaxDropped = 64;  // words one after the other that are gone: a layout(...)
  std::size_t next = 0;
  for (const GlslToken& token : inText) {
    const std::string word = asShown(token.text);
    const Tokens ahead = inWritten.subspan(next, std::min(kMaxDropped, inWritten.size() - next));
    const auto same = std::ranges::find(ahead, word, &GlslToken::text);
    const bool isFound = same != ahead.end();  // else it was added
    if (isFound) next += static_cast<std::size_t>(same - ahead.begin());
    if (token.begin >= where.begin && next < inWritten.size()) return rangeOf(inWritten[next]);
    if (isFound) ++next;
  }
  return lineAround(written, begin);
}

std::string WordLines::explain(std::string_view message) const {
  constexpr std::string_view kPrefix = "ERROR: ", kNoToken = "'' : ";
  if (!message.starts_with(kPrefix)) return std::string(message);
  const std::string_view rest = message.substr(kPrefix.size());
  const auto file = std::ranges::find_if(files_, [&](const File& one) {
    return rest.starts_with(one.source->name) && rest.substr(one.source->name.size()).starts_with(':');
  });
  if (file == files_.end()) return std::string(rest);
  const ShaderSource& source = *file->source;
  const std::size_t nameEnd = source.name.size(), numberEnd = rest.find(": ", nameEnd + 1);
  if (numberEnd == rest.npos) return std::string(rest);
  std::size_t line = 0;
  std::from_chars(rest.data() + nameEnd + 1, rest.data() + numberEnd, line);
  if (line == 0) return std::string(rest);
  const std::string spelled = asShown(rest.substr(numberEnd + 2));
  const std::string_view said = trimmed(spelled);
  const Place place = placeOf(*file, line, quotedIn(said));
  std::string told(said.starts_with(kNoToken) ? trimmed(said.substr(kNoToken.size())) : said);
  if (told == "compilation terminated") return {};
  if (told == "memory exhausted") told = "this is nested too deep";  // of the compiler's parser
  if (!place.macro.empty()) told += fmt::format(", in what the macro '{}' stands for", place.macro);
  return describe(source.name, writtenText(source), {shown(source, place.where), told, {}});
}

}  // namespace luxo::gpu
