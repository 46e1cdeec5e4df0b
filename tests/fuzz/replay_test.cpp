// SPDX-License-Identifier: Apache-2.0
// The fuzz targets without a fuzzer: every input that is kept, and seeded mutations of them. A target aborts
// when a promise does not hold; the input is printed first.
#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <ostream>
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

std::string running;

// The input that broke a promise, in the words of C++.
void printRunning(int) {
  std::fputs("the input was \"", stderr);
  for (const char c : running) {
    const bool plain = c >= 0x20 && c < 0x7f && c != '"' && c != '\\';
    if (plain)
      std::fputc(c, stderr);
    else
      std::fprintf(stderr, "\\x%02x", static_cast<unsigned>(static_cast<unsigned char>(c)));
  }
  std::fputs("\"\n", stderr);
}

void run(Target target, std::string input) {
  running = std::move(input);
  const auto before = std::signal(SIGABRT, printRunning);
  target(running);
  std::signal(SIGABRT, before);
}

void replay(std::string_view name, Target target) {
  const auto corpus = corpusOf(name);
  ASSERT_GE(corpus.size(), 10u);
  for (const auto& [file, input] : corpus) run(target, input);
}

void mutate(std::string_view name, Target target, std::span<const std::string_view> words, int count) {
  std::vector<std::string> corpus;
  for (auto& [file, input] : corpusOf(name)) corpus.push_back(std::move(input));
  Mutator mutator(corpus, words, 20260731);
  for (int i = 0; i < count; ++i) run(target, mutator.next());
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

constexpr std::string_view kSceneWords[] = {
    "{",
    "}",
    "[",
    "]",
    ",",
    ":",
    "\"",
    "0",
    "-1",
    "1e308",
    "1e999",
    "0.5",
    "null",
    "true",
    "// x\n",
    "\\u0000",
    "\xff",
    "\"t\"",
    "\"1/0\"",
    "\"u\"",
    "\"2k\"",
    "\"luxo\":1",
    "\"nodes\"",
    "\"name\"",
    "\"surface\"",
    "\"type\"",
    "\"sphere\"",
    "\"formula\"",
    "\"revolve\"",
    "\"tube\"",
    "\"bezier\"",
    "\"teapot\"",
    "\"params\"",
    "\"let\"",
    "\"position\"",
    "\"radius\"",
    "\"value\"",
    "\"range\"",
    "\"children\"",
    "\"translate\"",
    "\"rotate\"",
    "\"axis\"",
    "\"angle\"",
    "\"scale\"",
    "\"visible\"",
    "\"light\"",
    "\"camera\"",
    "\"segments\"",
    "[0,1]",
    "[1,2,3]",
    "\"#ff0000\"",
    "\"material\"",
    "\"materials\"",
    "\"diffuse\"",
    "\"opacity\"",
    "\"closed\"",
};

TEST(FuzzScene, KeptInputsKeepThePromises) { replay("scene", fuzzScene); }
TEST(FuzzScene, MutatedInputsKeepThePromises) { mutate("scene", fuzzScene, kSceneWords, 20'000); }

constexpr std::string_view kModelWords[] = {
    "v ",
    "vt ",
    "vn ",
    "f ",
    "s off",
    "s 1",
    "usemtl ",
    "mtllib ",
    "\n",
    "\\\n",
    "0",
    "-1",
    "1",
    "7",
    "1e30",
    "1e999",
    "nan",
    "0.5",
    "4294967295",
    "2147483648",
    "1/1/1",
    "2//2",
    "-3/-2",
    "newmtl ",
    "Kd ",
    "map_Kd ",
    "-o ",
    "-s ",
    "map_Bump ",
    "../",
    "/",
    "a.png",
    "solid ",
    "facet ",
    "vertex ",
    "endloop",
    "property ",
    "list ",
    "uchar ",
    "float ",
    "double ",
    "int ",
    "x",
    "element ",
    "face ",
    "ascii",
    "binary_big_endian",
    "end_header\n",
    "vertex_indices",
    "{",
    "}",
    "[",
    "]",
    ",",
    ":",
    "\"mesh\"",
    "\"nodes\"",
    "\"children\"",
    "\"count\"",
    "5126",
    "5123",
    "\"VEC3\"",
    "\"SCALAR\"",
    "[0,1]",
    "[0]",
    "\"matrix\"",
    "\"camera\"",
    "\"indices\"",
    "\"mode\"",
    "\"byteOffset\"",
    "\"byteStride\"",
    "\"normalized\":true",
};

struct ModelTarget {
  std::string_view name;
  Target target;
  int mutations;  ///< 1 s of each, with assertions

  friend std::ostream& operator<<(std::ostream& out, const ModelTarget& reader) { return out << reader.name; }
};

class FuzzModel : public testing::TestWithParam<ModelTarget> {};

TEST_P(FuzzModel, KeptInputsKeepThePromises) { replay(GetParam().name, GetParam().target); }
TEST_P(FuzzModel, MutatedInputsKeepThePromises) {
  mutate(GetParam().name, GetParam().target, kModelWords, GetParam().mutations);
}

INSTANTIATE_TEST_SUITE_P(
    Readers, FuzzModel,
    testing::Values(ModelTarget{"obj", fuzzObj, 20'000}, ModelTarget{"mtl", fuzzMtl, 20'000},
                    ModelTarget{"ply", fuzzPly, 20'000}, ModelTarget{"stl", fuzzStl, 20'000},
                    ModelTarget{"gltf", fuzzGltf, 5'000}, ModelTarget{"texture", fuzzTexture, 5'000}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace luxo
