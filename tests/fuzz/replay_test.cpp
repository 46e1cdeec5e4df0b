// SPDX-License-Identifier: Apache-2.0
// The fuzz targets without a fuzzer: every input that is kept, and seeded mutations of them. A target aborts
// when a promise does not hold; the input is printed first.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "fuzz/mutation.h"
#include "fuzz/target.h"

namespace luxo {
namespace {

// By file name: the order of the mutations is that of the names.
std::map<std::string, std::string> corpusOf(std::string_view target) {
  std::map<std::string, std::string> corpus;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(LUXO_FUZZ_CORPUS) / target)) {
    std::ifstream file(entry.path(), std::ios::binary);
    corpus[entry.path().filename()] = std::string(std::istreambuf_iterator<char>(file), {});
  }
  return corpus;
}

using Target = void (*)(std::string_view);

void replay(std::string_view name, Target target) {
  const auto corpus = corpusOf(name);
  ASSERT_GE(corpus.size(), 10u);
  for (const auto& [file, input] : corpus) {
    SCOPED_TRACE(file);
    target(input);
  }
}

void mutate(std::string_view name, Target target, std::span<const std::string_view> words, int count) {
  std::vector<std::string> corpus;
  for (auto& [file, input] : corpusOf(name)) corpus.push_back(std::move(input));
  Mutator mutator(corpus, words, 20260731);
  for (int i = 0; i < count; ++i) target(mutator.next());
}

constexpr std::string_view kFormulaWords[] = {
    "u",       "v",        "k",          "w",          "pi",     "e",
    "deg",     "0",        "1",          "2",          "-1",     "1e308",
    "5e-324",  "1e999",    "0.5",        "2147483648", "+",      "-",
    "*",       "/",        "^",          "(",          ")",      ",",
    "<",       "<=",       "==",         "!=",         "\n",     "\na=",
    "a",       "sin(",     "cos(",       "tan(",       "asin(",  "acos(",
    "atan(",   "atan2(u,", "sinh(",      "cosh(",      "tanh(",  "exp(",
    "log(",    "sqrt(",    "abs(",       "min(u,",     "max(v,", "floor(",
    "sign(",   "mod(u,",   "clamp(u,0,", "mix(u,v,",   "pow(u,", "smoothstep(0,u,",
    "if(u<v,", "\u00d7",   "\u03c0",     "**",
};

TEST(FuzzFormula, KeptInputsKeepThePromises) { replay("formula", fuzzFormula); }
TEST(FuzzFormula, MutatedInputsKeepThePromises) { mutate("formula", fuzzFormula, kFormulaWords, 20'000); }

}  // namespace
}  // namespace luxo
