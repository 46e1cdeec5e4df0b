// SPDX-License-Identifier: Apache-2.0
#include "scene/isolines_reader.h"

#include <fmt/format.h>

#include <charconv>
#include <string>

#include "scene/isolines.h"
#include "scene/scene_keys.h"
#include "scene/scene_members.h"

namespace luxo {
namespace {

/// "1.2px" is 1.2: widths are in pixels.
bool readPixels(const JsonValue& value, Quantity& target) {
  if (!value.exists() || value.kind() != JsonKind::String) return false;
  const std::string text = value.string();
  if (!text.ends_with("px")) return false;
  const char* const end = text.data() + text.size() - 2;
  double number = 0;
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || rest != end) return false;
  target = Quantity(number, placeOf(value.where()));
  return true;
}

void readOne(const JsonValue& value, SceneProblems& problems, IsolinesDesc& isolines) {
  SceneValues values(problems);
  const SceneMembers members(value, keys::kIsolines, problems);
  isolines.place = placeOf(value.where());
  if (!members.complete()) return;
  values.read(members["of"], isolines.of);
  values.read(members["step"], isolines.step);
  values.read(members["at"], isolines.at);
  values.read(members["u"], isolines.u);
  values.read(members["v"], isolines.v);
  if (!readPixels(members["width"], isolines.width)) values.read(members["width"], isolines.width);
  if (members["color"].exists()) values.readColor(members["color"], isolines.color, isolines.opacity);
  values.read(members["opacity"], isolines.opacity);
  if (!isolines.of && !isolines.u && !isolines.v)
    problems.add(isolines.place, "nothing says where these isolines are",
                 R"(write "of": "z", "step": 0.1 for those of a formula, or "u": 28, "v": 14 for a grid)");
  for (const char* key : {"step", "at"})
    if (members[key].exists() && !isolines.of)
      problems.add(members[key].where(), "this is of the lines of a formula, and there is none",
                   R"(give it as "of")");
}

}  // namespace

void readIsolines(const JsonValue& value, SceneProblems& problems, std::vector<IsolinesDesc>& isolines) {
  std::size_t families = 0;
  const auto read = [&](const JsonValue& one) {
    IsolinesDesc& desc = isolines.emplace_back();
    readOne(one, problems, desc);
    const std::size_t before = families;
    families += std::size_t{desc.of.has_value()} + desc.u.has_value() + desc.v.has_value();
    if (before <= kMaxLineFamilies && families > kMaxLineFamilies)
      problems.add(
          desc.place,
          fmt::format("with these the material has more than {} families of lines", kMaxLineFamilies),
          "leave some out; \"step\" repeats those of one formula");
  };
  if (value.kind() != JsonKind::Array) {
    read(value);
    return;
  }
  for (JsonValue one = value.first(); one.exists(); one = one.next()) read(one);
}

}  // namespace luxo
