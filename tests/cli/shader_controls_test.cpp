// SPDX-License-Identifier: Apache-2.0
// What the comments beside uniforms mean.
#include "shader_controls.h"

#include <gmock/gmock.h>

#include "base/error.h"
#include "shader_values.h"

namespace luxo::test {
namespace {

using Kind = UniformControl::Kind;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

UniformControl controlOf(const std::string& text, const std::string& name, const std::string& type,
                         std::vector<std::string>* warnings = nullptr) {
  const MaterialShader shader{{{"m.frag", text}}};
  const gpu::ShaderVariable uniform{.name = name, .type = type};
  return uniformControls(shader, std::span(&uniform, 1), warnings).front();
}

void expectError(const std::string& text, const std::string& type, const std::string& said) {
  try {
    static_cast<void>(controlOf(text, "a", type));
    FAIL() << text << " is taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Scene);
    EXPECT_THAT(error.what(), StartsWith("m.frag:" + said)) << text;
  }
}

TEST(ShaderControls, SlidersHaveARangeAndSteps) {
  const UniformControl plain = controlOf("uniform float a = 1.; // @slider 0.1 2.2", "a", "float");
  EXPECT_EQ(plain.kind, Kind::Slider);
  EXPECT_EQ(plain.range->lo, 0.1);
  EXPECT_EQ(plain.range->hi, 2.2);
  EXPECT_FALSE(plain.step);
  EXPECT_THAT(plain.initial, ElementsAre(1.0));
  const UniformControl stepped = controlOf("uniform float a;  // how wide @slider -1, 4 10", "a", "float");
  EXPECT_EQ(*stepped.step, 0.5);
  EXPECT_THAT(stepped.initial, ElementsAre(-1.0)) << "without an initial value it begins at its lower end";
  EXPECT_EQ(*controlOf("uniform int a = 3; // @slider 0 8", "a", "int").step, 1);
  const UniformControl vector = controlOf("uniform vec2 b, a = vec2(0.5, .25f); // @slider 0 1", "a", "vec2");
  EXPECT_THAT(vector.initial, ElementsAre(0.5, 0.25));
}

TEST(ShaderControls, ColorsChoicesAndSwitches) {
  const UniformControl color = controlOf("\tuniform highp vec3 a = vec3(0.5); //@color", "a", "vec3");
  EXPECT_EQ(color.kind, Kind::Color);
  EXPECT_THAT(color.initial, ElementsAre(0.5, 0.5, 0.5));
  const UniformControl choice = controlOf("uniform int a = 2; // @select plain | brushed|a b", "a", "int");
  EXPECT_EQ(choice.kind, Kind::Choice);
  EXPECT_THAT(choice.choices, ElementsAre("plain", "brushed", "a b"));
  EXPECT_THAT(choice.initial, ElementsAre(2.0));
  EXPECT_EQ(controlOf("uniform bool a = true;", "a", "bool").kind, Kind::Switch);
}

TEST(ShaderControls, WhatIsNoNumberIsNotTurned) {
  EXPECT_EQ(controlOf("const float k = 2.0; uniform float a = 2.0 * k;", "a", "float").kind, Kind::None);
  EXPECT_EQ(controlOf("#define U uniform\nU float a;", "a", "float").kind, Kind::None);
  EXPECT_EQ(controlOf("/* uniform float a; */ uniform float b;", "a", "float").kind, Kind::None);
  EXPECT_EQ(controlOf("// uniform float a = 1.0;\nuniform float a = 2.0;", "a", "float").initial.front(),
            2.0);
  EXPECT_EQ(controlOf("uniform mat2 a;", "a", "mat2").kind, Kind::None);
}

TEST(ShaderControls, MalformedOnesAreErrorsAtTheirPlace) {
  expectError("uniform float a; // @slider a b", "float", "1:29: 'a' is no number");
  expectError("uniform float a; // @slider 1", "float", "1:22: a slider has 2 or 3 numbers, not 1");
  expectError("uniform float a; // @slider", "float", "1:22: a slider has 2 or 3 numbers, not 0");
  expectError("\nuniform float a; // @slider 2 1", "float", "2:29: the slider from 2 to 1 is empty");
  expectError("uniform float a; // @slider 0 nan", "float", "1:31: 'nan' is no number");
  expectError("uniform float a; // @slider 0 1 1.5", "float", "1:29: 1.5 is no number of steps");
  expectError("uniform int a; // @slider 0 3 2", "int", "1:27: steps of 1.5 lead between whole numbers");
  expectError("uniform bool a; // @slider 0 1", "bool", "1:21: 'a' is of type bool, which has no slider");
  expectError("uniform float a = 3.0; // @slider 0 1", "float", "1:19: the initial value 3 is not in 0..1");
  expectError("uniform float a = 3.0 * k; // @slider 0 1", "float",
              "1:19: the initial value of 'a' is not made");
  expectError("uniform float a; // @color", "float", "1:22: 'a' is of type float, and a colour of vec3");
  expectError("uniform int a; // @select", "int", "1:26: a choice has no name");
  expectError("uniform int a; // @select x", "int", "1:27: there is one choice only");
  expectError("uniform int a; // @select x|x", "int", "1:27: there are two choices 'x'");
  expectError("uniform float a; // @select x|y", "float", "1:22: 'a' is of type float, and a choice of int");
}

TEST(ShaderControls, UnknownOnesAreToldOf) {
  std::vector<std::string> warnings;
  EXPECT_EQ(controlOf("uniform float a; // @sldier 0 1", "a", "float", &warnings).kind, Kind::Plain);
  ASSERT_EQ(warnings.size(), 1);
  EXPECT_THAT(warnings[0], StartsWith("m.frag:1:22: '@sldier' is not known"));
  EXPECT_THAT(warnings[0], HasSubstr("did you mean 'slider'?"));
  EXPECT_EQ(controlOf("uniform float a; // me@home.org: 2 @ 3", "a", "float").kind, Kind::Plain);
}

TEST(ShaderControls, ValuesAreOfTheirType) {
  const UniformControl color = controlOf("uniform vec3 a; // @color", "a", "vec3");
  EXPECT_THAT(componentTexts(color, "#ff0000", false), ElementsAre("1", "0", "0"));
  EXPECT_THAT(componentTexts(color, "#f80", true), ElementsAre("1", "0.5333333333333333", "0"));
  EXPECT_THAT(componentTexts(color, "max(0,1),t,2", true), ElementsAre("max(0,1)", "t", "2"));
  EXPECT_THROW(static_cast<void>(componentTexts(color, "#ff00", true)), Error);
  EXPECT_THROW(static_cast<void>(componentTexts(color, "1,,2", true)), Error);
  const UniformControl choice = controlOf("uniform int a; // @select x|y", "a", "int");
  EXPECT_THAT(componentTexts(choice, "y", true), ElementsAre("1"));
  EXPECT_THROW(static_cast<void>(componentTexts(choice, "2", true)), Error);
  EXPECT_THAT(componentTexts(controlOf("uniform bool a;", "a", "bool"), "true", true), ElementsAre("1"));
  EXPECT_THROW(static_cast<void>(componentTexts(controlOf("uniform uint a;", "a", "uint"), "-1", true)),
               Error);
  EXPECT_THROW(static_cast<void>(componentTexts(controlOf("uniform int a;", "a", "int"), "0.5", true)),
               Error);
}

}  // namespace
}  // namespace luxo::test
