// SPDX-License-Identifier: Apache-2.0
#include "scene/shader_macros.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/glsl_tokens.h"
#include "scene/shader_declarations.h"
#include "scene/shader_nesting.h"

namespace luxo {
namespace {

using Tokens = std::span<const GlslToken>;
using File = MaterialShader::File;

/// Of a file: what stands there, or the macro that what stands there comes from.
struct Place {
  const File* file = nullptr;
  SourceRange where = {};
};

[[noreturn]] void refuse(const Place& place, const std::string& why, const std::string& advice) {
  throw Error(ErrorKind::Scene, describe(place.file->name, place.file->text, {place.where, why, advice}));
}

struct Word {
  std::string_view text;
  bool isName = false;
  bool isFinal = false;  ///< met within its own macro: no macro any more
  Place place = {};
};
using Words = std::vector<Word>;

struct Definition {
  struct Part {
    std::string_view text;
    bool isName = false;
    bool isJoined = false;  ///< with the one before, by ##
    std::optional<std::size_t> parameter = {};

    friend bool operator==(const Part&, const Part&) = default;
  };
  bool takesArguments = false;
  std::vector<Part> parts = {};

  friend bool operator==(const Definition&, const Definition&) = default;
};

struct Macro {
  std::vector<Definition> alternatives = {};
  bool isOpen = false;  ///< it is being expanded

  [[nodiscard]] bool hasAny(bool takesArguments) const {
    return std::ranges::find(alternatives, takesArguments, &Definition::takesArguments) != alternatives.end();
  }
};

/// Of `NAME(PARAMETERS) PARTS`.
Definition definitionOf(Tokens tokens) {
  Definition definition;
  std::map<std::string_view, std::size_t> parameters;
  std::size_t i = 1;
  if (i < tokens.size() && tokens[i].text == "(" && !tokens[i].afterBlank) {
    definition.takesArguments = true;
    for (++i; i < tokens.size() && tokens[i].text != ")"; ++i)
      if (tokens[i].isWord()) parameters.try_emplace(tokens[i].text, parameters.size());
    ++i;
  }
  bool isJoined = false;
  for (; i < tokens.size(); ++i) {
    const GlslToken& token = tokens[i];
    if (token.text == "##") {
      isJoined = !definition.parts.empty();
      continue;
    }
    Definition::Part part{token.text, token.isWord(), std::exchange(isJoined, false)};
    if (const auto known = parameters.find(token.text); known != parameters.end())
      part.parameter = known->second;
    definition.parts.push_back(part);
  }
  return definition;
}

/// glslTokens(), and behind a number what its suffix and a name right behind it may be together: some
/// suffixes are none to some compilers, of some numbers.
std::vector<GlslToken> tokensOf(std::string_view glsl) {
  constexpr std::size_t kLongestSuffix = 2;
  std::vector<GlslToken> tokens;
  for (const std::vector<GlslToken> all = glslTokens(glsl); const GlslToken& token : all) {
    tokens.push_back(token);
    if (token.kind != GlslToken::Kind::Number) continue;
    const bool isHexadecimal = token.text.starts_with("0x") || token.text.starts_with("0X");
    const std::size_t digits =
        token.text.find_last_of(isHexadecimal ? "0123456789abcdefABCDEFxX" : "0123456789.") + 1;
    std::size_t end = token.end();
    while (end < glsl.size() && isGlslLetter(glsl[end])) ++end;
    const std::string_view suffix = token.text.substr(digits);
    if (end == token.end() &&
        (suffix.empty() || suffix == "f" || suffix == "F" || suffix == "u" || suffix == "U"))
      continue;
    for (std::size_t i = 0; i < std::min(suffix.size(), kLongestSuffix); ++i) {
      GlslToken name = token;
      name.kind = GlslToken::Kind::Word;
      name.begin += digits + i;
      name.text = glsl.substr(name.begin, end - name.begin);
      name.afterBlank = false;
      tokens.push_back(name);
    }
  }
  return tokens;
}

/// Words with macros in them, as a preprocessor expands these: each where it stands, its arguments first.
class Expansion {
 public:
  /// `isSure`: whatever conditions are.
  void define(Tokens tokens, bool isSure, const File& file) {
    constexpr std::size_t kMaxAlternatives = 64;
    const GlslToken& name = tokens.front();
    std::vector<Definition>& alternatives = macros_[name.text].alternatives;
    if (isSure) alternatives.clear();
    Definition definition = definitionOf(tokens);
    if (std::ranges::find(alternatives, definition) != alternatives.end()) return;
    alternatives.push_back(std::move(definition));
    if (alternatives.size() > kMaxAlternatives)
      refuse({&file, {name.begin, name.end()}},
             fmt::format("the macro '{}' has more than {} definitions", name.text, kMaxAlternatives),
             "give them names of their own");
  }
  void undefine(std::string_view name) { macros_.erase(name); }

  /// Gives all that the words come to, in their order.
  template <class Give>
  void expand(Words words, const Give& give) {
    const std::size_t below = stack_.size();
    stack_.push_back({std::move(words)});
    while (std::optional<Word> word = next(below)) {
      const auto known = word->isName && !word->isFinal ? macros_.find(word->text) : macros_.end();
      if (known == macros_.end()) {
        give(*word);
      } else if (known->second.isOpen) {
        word->isFinal = true;
        give(*word);
      } else if (!enter(known->second, *word, below)) {
        give(*word);
      }
    }
  }

 private:
  struct Open {
    Words words;
    std::size_t at = 0;
    Macro* macro = nullptr;
  };

  std::optional<Word> next(std::size_t below) {
    while (stack_.size() > below && stack_.back().at == stack_.back().words.size()) {
      if (Macro* macro = stack_.back().macro) macro->isOpen = false;
      stack_.pop_back();
    }
    if (stack_.size() == below) return std::nullopt;
    Open& open = stack_.back();
    return open.words[open.at++];
  }

  [[nodiscard]] bool comesNext(std::string_view text, std::size_t below) const {
    for (std::size_t i = stack_.size(); i-- > below;)
      if (const Open& open = stack_[i]; open.at < open.words.size()) return open.words[open.at].text == text;
    return false;
  }

  void spend(std::size_t words, const Place& place) {
    spent_ += words;
    if (spent_ > kMaxExpandedWords)
      refuse(place, fmt::format("macros come to more than {} words here", kMaxExpandedWords),
             "write functions and loops instead: a macro is copied to each place where it is named");
  }

  /// Puts what the macro stands for on the stack; false where it stands for itself, without arguments.
  bool enter(Macro& macro, const Word& name, std::size_t below) {
    const bool isCall = macro.hasAny(true) && comesNext("(", below);
    if (!isCall && !macro.hasAny(false)) return false;
    const Words call = isCall ? takeCall(name, below) : Words{};
    Arguments arguments(call);
    // A compiler expands them all, whatever becomes of them.
    for (std::size_t i = 0; i < arguments.plain.size(); ++i)
      static_cast<void>(expandedArgument(arguments, i, name.place));
    Words words;
    for (const Definition& definition : macro.alternatives) {
      if (definition.takesArguments && !isCall) continue;
      substitute(definition, arguments, name.place, words);
      if (definition.takesArguments) continue;
      spend(call.size(), name.place);
      words.insert(words.end(), call.begin(), call.end());
    }
    stack_.push_back({std::move(words), 0, &macro});
    macro.isOpen = true;
    return true;
  }

  /// With its brackets.
  Words takeCall(const Word& name, std::size_t below) {
    Words call;
    std::size_t depth = 0;
    do {
      const std::optional<Word> word = next(below);
      if (!word)
        refuse(name.place, fmt::format("the arguments of the macro '{}' have no ')'", name.text),
               "let it follow, before the next #define, #undef or #if");
      spend(1, name.place);
      depth += word->text == "(" ? 1 : 0;
      depth -= word->text == ")" ? 1 : 0;
      call.push_back(*word);
    } while (depth > 0);
    return call;
  }

  struct Arguments {
    explicit Arguments(const Words& call) {
      std::size_t depth = 0, begin = 1;
      for (std::size_t i = 0; i < call.size(); ++i) {
        depth -= call[i].text == ")" ? 1 : 0;
        if ((depth == 1 && call[i].text == ",") || (depth == 0 && i > 0)) {
          plain.push_back(std::span(call).subspan(begin, i - begin));
          begin = i + 1;
        }
        depth += call[i].text == "(" ? 1 : 0;
      }
      expanded.resize(plain.size());
    }
    std::vector<std::span<const Word>> plain;
    std::vector<std::optional<Words>> expanded;
  };

  std::span<const Word> expandedArgument(Arguments& arguments, std::size_t index, const Place& place) {
    std::optional<Words>& words = arguments.expanded[index];
    if (!words) {
      if (++depth_ > kDeepestArguments)
        refuse(place,
               fmt::format("macros are in arguments of macros more than {} deep here", kDeepestArguments),
               "write functions instead");
      words.emplace();
      expand(Words(arguments.plain[index].begin(), arguments.plain[index].end()),
             [&](const Word& word) { words->push_back(word); });
      --depth_;
    }
    return *words;
  }

  void substitute(const Definition& definition, Arguments& arguments, const Place& place, Words& words) {
    const std::vector<Definition::Part>& parts = definition.parts;
    const std::size_t before = words.size();
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Definition::Part& part = parts[i];
      const bool isJoined = part.isJoined || (i + 1 < parts.size() && parts[i + 1].isJoined);
      Words one{{part.text, part.isName, false, place}};
      std::span<const Word> added = one;
      if (part.parameter)
        added = *part.parameter >= arguments.plain.size() ? std::span<const Word>()
                : isJoined                                ? arguments.plain[*part.parameter]
                           : expandedArgument(arguments, *part.parameter, place);
      spend(added.size(), place);
      if (part.isJoined && words.size() > before && !added.empty()) {
        words.back() = joined(words.back(), added.front());
        added = added.subspan(1);
      }
      for (Word word : added) {
        word.place = place;
        words.push_back(word);
      }
    }
  }

  Word joined(const Word& left, const Word& right) {
    constexpr std::size_t kLongestName = 1024;  // of the compiler
    if (left.text.size() + right.text.size() > kLongestName)
      refuse(left.place, fmt::format("## makes a name of more than {} letters here", kLongestName), {});
    const std::string& text = made_.emplace_back(fmt::format("{}{}", left.text, right.text));
    return {text, left.isName, false, left.place};
  }

  std::map<std::string_view, Macro> macros_;
  std::vector<Open> stack_;
  std::deque<std::string> made_;
  std::size_t spent_ = 0, depth_ = 0;
};

/// A shader's text, file by file, as a compiler reads it.
class Reader {
 public:
  explicit Reader(const MaterialShader& shader) : shader_(shader) {
    for (const File& file : shader.files) {
      const std::vector<GlslToken> tokens = tokensOf(file.text);
      for (const GlslDirective& directive : directivesIn(tokens)) {
        if (directive.rest.empty()) continue;
        if (directive.name == "undef") undefined_.insert(directive.rest.front().text);
        if (directive.name == "define") ++definitions_[directive.rest.front().text];
      }
    }
  }

  void read(std::size_t index) {
    const File& file = shader_.files[index];
    const std::vector<GlslToken> all = tokensOf(file.text);
    const Tokens tokens = all;
    const std::string_view guard = guardOf(tokens);
    if (!guard.empty() && !undefined_.contains(guard) && !read_.insert(index).second) return;
    refuseHiddenWords(file, tokens);
    if (const std::size_t comment = unendedComment(file.text); comment != std::string::npos)
      refuse({&file, {comment, comment + 2}}, "this comment has no end", "close it with */");
    // The condition around all of it is true the first time, unless something else defines what it asks for:
    // a compiler, or luxo's own text, whose macros have small letters.
    const bool isSure = !guard.empty() && !undefined_.contains(guard) && definitions_[guard] == 1 &&
                        std::ranges::none_of(guard, [](char c) { return c >= 'a' && c <= 'z'; }) &&
                        !guard.starts_with("GL_") && !guard.starts_with("__") && guard != "VULKAN";
    for (std::size_t i = 0; i < tokens.size();) {
      if (tokens[i].directive == 0) {
        pending_.push_back(
            {tokens[i].text, tokens[i].isWord(), false, {&file, {tokens[i].begin, tokens[i].end()}}});
        ++i;
        continue;
      }
      const GlslDirective directive = directiveAt(tokens.subspan(i));
      const bool isGuard = tokens[i].directive == 1 || tokens[i].directive == tokens.back().directive;
      if (!isSure || !isGuard) obey(directive, {&file, {tokens[i].begin, tokens[i].end()}});
      i += directive.name.empty() ? 1 : 2 + directive.rest.size();
    }
    if (depth_ == 0) give();
  }

 private:
  /// Of a file that is what it is once: the name that its first two lines and its last one are about.
  static std::string_view guardOf(Tokens tokens) {
    const std::vector<GlslDirective> all = directivesIn(tokens);
    if (all.size() < 3 || tokens.front().directive != 1 || all[0].name != "ifndef" ||
        all[1].name != "define" || all[0].rest.empty() || all[1].rest.empty() ||
        all[0].rest.front().text != all[1].rest.front().text || all.back().name != "endif" ||
        tokens.back().directive != all.size())
      return {};
    std::size_t depth = 0;
    for (const GlslDirective& directive : all) {
      depth += directive.name.starts_with("if") ? 1 : 0;
      if (depth == 1 && directive.name.starts_with("el")) return {};
      depth -= directive.name == "endif" && depth > 0 ? 1 : 0;
      if (depth == 0 && &directive != &all.back()) return {};
    }
    return all[0].rest.front().text;
  }

  /// A line that goes on within a word, or within what begins a comment, reads as something else.
  static void refuseHiddenWords(const File& file, Tokens tokens) {
    for (const GlslToken& token : tokens)
      if (token.text.front() == '"' && (token.text.size() == 1 || token.text.find('\\') != token.text.npos))
        refuse({&file, {token.begin, token.end()}}, "a text in quotes has a backslash, or no end on its line",
               "write a plain one");
    const std::string_view text = file.text;
    for (std::size_t at = text.find('\\'); at != text.npos; at = text.find('\\', at + 1)) {
      std::size_t next = at;
      while (const std::size_t joined = continuationAt(text, next)) next += joined;
      if (at == 0 || next == at || next == text.size()) continue;
      constexpr std::string_view kApart = " \t\v\f\r\n(){};,";  // none of which is a part of something longer
      if (kApart.find(text[at - 1]) == kApart.npos && kApart.find(text[next]) == kApart.npos)
        refuse({&file, {at, at + 1}}, "a word goes on in the next line", "begin that with a blank");
      at = next - 1;
    }
  }

  void obey(const GlslDirective& directive, const Place& place) {
    const std::string_view name = directive.name;
    const Tokens rest = directive.rest;
    const File& file = *place.file;
    if (name == "line") refuse(place, "'#line' would move the places of errors", "leave it out");
    if (name == "define" && !rest.empty()) {
      give();
      expansion_.define(rest, conditions_ == 0, file);
    } else if (name == "undef" && !rest.empty()) {
      give();
      if (conditions_ == 0) expansion_.undefine(rest.front().text);
    } else if (name == "include" && !rest.empty() && rest.front().kind == GlslToken::Kind::Quoted) {
      include(file, rest.front());
    } else if (name == "if" || name == "ifdef" || name == "ifndef") {
      openAlternative();
      ++conditions_;
    } else if ((name == "elif" || name == "else") && conditions_ > 0) {
      closeAlternative(place);
      openAlternative();
    } else if (name == "endif" && conditions_ > 0) {
      closeAlternative(place);
      --conditions_;
    }
    if (name != "if" && name != "elif") return;
    Words words;
    for (const GlslToken& token : rest)
      words.push_back({token.text, token.isWord(), false, {&file, {token.begin, token.end()}}});
    ShaderNesting nesting;
    expansion_.expand(std::move(words), [&](const Word& word) { requireShallow(word, nesting); });
  }

  void openAlternative() {
    give();
    nesting_.openAlternative();
    declarations_.openAlternative();
  }

  void closeAlternative(const Place& end) {
    give();
    nesting_.closeAlternative();
    if (!declarations_.closeAlternative())
      refuse(end, "a structure begins or ends under a condition, and not all of it is under that",
             "put all of it there, or its members");
  }

  void include(const File& by, const GlslToken& quoted) {
    const std::string name(quoted.text.substr(1, quoted.text.size() - 2));
    const std::string beside =
        (std::filesystem::path(by.name).parent_path() / name).lexically_normal().string();
    auto file = std::ranges::find(shader_.files, beside, &File::name);
    if (file == shader_.files.end()) file = std::ranges::find(shader_.files, name, &File::name);
    constexpr std::size_t kDeepest = 32;  // the compiler refuses more
    if (file == shader_.files.end() || depth_ > kDeepest) return;
    const Place place{&by, {quoted.begin, quoted.end()}};
    constexpr const char* kAdvice =
        "put #ifndef, #define and #endif around what a file has: it is there once then";
    if (++includes_ > kMaxIncludes)
      refuse(place, fmt::format("files are included more than {} times", kMaxIncludes), kAdvice);
    bytes_ += file->text.size();
    if (bytes_ > kMaxIncludedBytes)
      refuse(place, fmt::format("included files come to more than {} MiB", kMaxIncludedBytes >> 20),
             kAdvice);
    ++depth_;
    read(static_cast<std::size_t>(file - shader_.files.begin()));
    --depth_;
  }

  /// What has gathered, between directives that may change what it comes to.
  void give() {
    expansion_.expand(std::exchange(pending_, {}), [&](const Word& word) {
      requireShallow(word, nesting_);
      requireFew(word);
    });
  }

  static void requireShallow(const Word& word, ShaderNesting& nesting) {
    if (nesting.heightWith(word.text) > kDeepestNesting)
      refuse(word.place,
             fmt::format("brackets and operators are nested more than {} deep here", kDeepestNesting),
             "split it up: into several statements, or into functions");
    if (nesting.statements() > kDeepestStatements)
      refuse(word.place, fmt::format("branches are nested more than {} deep here", kDeepestStatements),
             "split it up: into several functions, or use an array and a loop");
  }

  void requireFew(const Word& word) {
    declarations_.take(word.text);
    if (declarations_.members() > kMaxMembers)
      refuse(word.place,
             fmt::format("this structure has more than {} members and structures in it", kMaxMembers),
             "use arrays");
    if (declarations_.calls() > kMaxCalls)
      refuse(word.place,
             fmt::format("functions call others more than {} times, not counting repetitions", kMaxCalls),
             "write fewer functions");
  }

  const MaterialShader& shader_;
  std::set<std::string_view> undefined_;
  std::map<std::string_view, std::size_t> definitions_;
  std::set<std::size_t> read_;
  Words pending_;
  Expansion expansion_;
  ShaderNesting nesting_;
  ShaderDeclarations declarations_;
  std::size_t conditions_ = 0, includes_ = 0, bytes_ = 0, depth_ = 0;
};

}  // namespace

void requireBounded(const MaterialShader& shader, std::size_t first) { Reader(shader).read(first); }

}  // namespace luxo
