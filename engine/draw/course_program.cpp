// SPDX-License-Identifier: Apache-2.0
#include "draw/course_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/suggestion.h"
#include "draw/course_style.h"
#include "scene/shader_text.h"

namespace luxo {
namespace {

using gpu::ShaderVariable;

/// What a vertex has beside what the language gives it, on the axes of its object.
struct Attribute {
  std::string_view name, type, value;
  std::string_view ofVertices = "vec3(luxoOther)";  // vertices of a mesh that moves have none
};
constexpr Attribute kAttributes[] = {{"tangent", "vec3", "luxoOnAxesOfObject(p.tangent)"},
                                     {"bitangent", "vec3", "luxoOnAxesOfObject(p.bitangent)"},
                                     {"binormal", "vec3", "luxoOnAxesOfObject(p.bitangent)"},
                                     {"Su", "vec3", "luxoObjectFromRelative * p.Su"},
                                     {"Sv", "vec3", "luxoObjectFromRelative * p.Sv"},
                                     {"uv", "vec2", "p.uv", "uv"}};

constexpr std::string_view kState = "gL_State";

/// Names of lib/course.glsl, in luxo's spelling.
bool isOfTheLanguage(std::string_view name) {
  return name.starts_with("gL_") || name.starts_with("luxo") || name.starts_with("tExture") ||
         name == "fTransform";
}

const ShaderVariable* find(const std::vector<ShaderVariable>& variables, std::string_view name) {
  const auto found = std::ranges::find(variables, name, &ShaderVariable::name);
  return found == variables.end() ? nullptr : &*found;
}

const std::vector<ShaderVariable>& uniformsOf(const gpu::ShaderInterface& interface) {
  static const std::vector<ShaderVariable> kNone;
  const auto loose = std::ranges::find_if(interface.blocks, &gpu::ShaderBlock::loose);
  return loose == interface.blocks.end() ? kNone : loose->members;
}

std::string typeText(const ShaderVariable& variable) {
  std::string text = variable.type;
  for (const std::uint32_t size : variable.array) text += fmt::format("[{}]", size);
  return text;
}

}  // namespace

CourseProgram::CourseProgram(const MaterialShader& shader, const std::vector<std::string>& texts,
                             gpu::ShaderInterface fragment, std::optional<gpu::ShaderInterface> vertex,
                             const Refuse& refuse)
    : shader_(&shader), fragment_{"luxoFragment_", std::move(fragment)} {
  if (vertex) vertex_ = Stage{"luxoVertex_", *std::move(vertex)};
  for (const MaterialShader::File& file : shader.files) {
    initialisers_.push_back(initialisersIn(file.text));
    for (const GlslToken& token : glslTokens(file.text))
      if (token.isWord()) words_.emplace(token.text);
  }
  link(refuse);
  name(fragment_, texts);
  if (vertex_) name(*vertex_, texts);
  for (const std::string& text : texts) {
    const std::vector<GlslToken> tokens = glslTokens(text);
    for (const GlslDirective& directive : directivesIn(tokens))
      if (directive.name == "define" && !directive.rest.empty())
        macros_ += fmt::format("#undef {}\n", directive.rest.front().text);
  }
  describe(refuse);
}

/// Finds the names that a program declares, and has them begin with its prefix.
void CourseProgram::name(Stage& stage, const std::vector<std::string>& texts) const {
  const gpu::ShaderInterface& interface = stage.interface;
  std::set<std::string, std::less<>>& names = stage.names;
  for (const auto* some : {&interface.functions, &interface.structures, &interface.globals})
    names.insert(some->begin(), some->end());
  for (const auto* some : {&interface.inputs, &interface.outputs, &uniformsOf(interface)})
    for (const ShaderVariable& variable : *some) names.insert(variable.name);
  for (const std::size_t i : includedBy(&stage == &fragment_ ? 0 : shader_->vertex)) {
    const std::string& text = texts[i];
    for (std::string& constant : constantsOf(outsideOfFunctions(text))) names.insert(std::move(constant));
    const std::vector<GlslToken> tokens = glslTokens(text);
    for (std::size_t k = 1; k < tokens.size(); ++k)
      if (tokens[k - 1].text == "struct" && tokens[k].isWord()) names.emplace(tokens[k].text);
  }
  std::erase_if(names, [](const std::string& one) {
    return one == "main" || one.starts_with("gl_") || isOfTheLanguage(one);
  });
  for (std::size_t i = 0; i < texts.size(); ++i) {
    // Below a folder of its own, so that both may include the same file.
    stage.paths.push_back(
        (std::filesystem::path(stage.prefix) / shader_->files[i].name).lexically_normal().string());
    if (shader_->files[i].name.starts_with('/'))
      stage.paths.back() = std::string(stage.prefix) + shader_->files[i].name;
    stage.texts.push_back(renamed(texts[i], names, stage.prefix));
  }
}

/// The files of a program, which begins with that one: those that it includes have the name of a directive.
std::vector<std::size_t> CourseProgram::includedBy(std::size_t program) const {
  std::vector<std::size_t> own{program};
  for (std::size_t k = 0; k < own.size(); ++k) {
    const std::vector<GlslToken> tokens = glslTokens(shader_->files[own[k]].text);
    for (const GlslDirective& directive : directivesIn(tokens)) {
      if (directive.name != "include" || directive.rest.empty()) continue;
      const std::string_view quoted = directive.rest.front().text;
      if (directive.rest.front().kind != GlslToken::Kind::Quoted) continue;
      const auto last = std::filesystem::path(quoted.substr(1, quoted.size() - 2)).filename();
      for (std::size_t i = 0; i < shader_->files.size(); ++i)
        if (std::filesystem::path(shader_->files[i].name).filename() == last &&
            std::ranges::find(own, i) == own.end())
          own.push_back(i);
    }
  }
  return own;
}

bool CourseProgram::isInitialised(const Stage& stage, const std::string& uniform) const {
  return std::ranges::any_of(includedBy(&stage == &fragment_ ? 0 : shader_->vertex),
                             [&](std::size_t i) { return initialisers_[i].contains(uniform); });
}

void CourseProgram::link(const Refuse& refuse) {
  const std::string& file = shader_->files.front().name;
  if (!words_.contains("gl_FragColor"))
    throw Error(ErrorKind::Scene, fmt::format("{}: the program does not write gl_FragColor", file),
                "it is the colour: gl_FragColor = vec4(0.0, 0.0, 1.0, 1.0);");
  if (vertex_ && !words_.contains("gl_Position"))
    throw Error(
        ErrorKind::Scene,
        fmt::format("{}: the program does not write gl_Position", shader_->files[shader_->vertex].name),
        "write gl_Position = ftransform();");
  for (const ShaderVariable& varying : fragment_.interface.inputs) {
    if (!varying.active || isOfTheLanguage(varying.name) || varying.name.starts_with("gl_")) continue;
    const std::string spelled = withoutCourseSpelling(varying.name);
    if (!vertex_)
      refuse(spelled,
             fmt::format("'{}' is a varying, and there is no vertex program that writes it", spelled),
             fmt::format("name one as \"vertex\" of the material, or put it beside the file as {}",
                         std::filesystem::path(file).stem().string() + ".vert"));
    const ShaderVariable* written = find(vertex_->interface.outputs, varying.name);
    if (!written)
      refuse(spelled,
             fmt::format("the vertex program '{}' has no varying '{}'", shader_->files[shader_->vertex].name,
                         spelled),
             "declare it in both");
    else if (typeText(*written) != typeText(varying))
      refuse(spelled,
             fmt::format("the varying '{}' is of type {} here, and of type {} in the vertex program", spelled,
                         typeText(varying), typeText(*written)),
             "declare it alike in both");
  }
  if (!vertex_) return;
  for (const ShaderVariable& attribute : vertex_->interface.inputs) {
    if (isOfTheLanguage(attribute.name) || attribute.name.starts_with("gl_")) continue;
    const std::string spelled = withoutCourseSpelling(attribute.name);
    const auto* const known = std::ranges::find(kAttributes, spelled, &Attribute::name);
    if (known == std::end(kAttributes)) {
      std::vector<std::string> names;
      for (const Attribute& one : kAttributes) names.emplace_back(one.name);
      refuse(
          spelled, fmt::format("'{}' is no attribute that points of surfaces have", spelled),
          didYouMean(spelled, names, fmt::format("they have {}, and gl_Vertex and its like", listed(names))));
    } else if (typeText(attribute) != known->type) {
      refuse(
          spelled,
          fmt::format("the attribute '{}' is of type {}, not {}", spelled, known->type, typeText(attribute)),
          {});
    }
  }
  for (const ShaderVariable& uniform : uniformsOf(fragment_.interface)) {
    const ShaderVariable* other = find(uniformsOf(vertex_->interface), uniform.name);
    if (!other) continue;
    const std::string spelled = withoutCourseSpelling(uniform.name);
    if (typeText(*other) != typeText(uniform))
      refuse(spelled,
             fmt::format("the uniform '{}' is of type {} here, and of type {} in the vertex program", spelled,
                         typeText(uniform), typeText(*other)),
             "declare it alike in both");
    std::string first;
    for (const TextByName& initialisers : initialisers_) {
      const auto own = initialisers.find(spelled);
      if (own == initialisers.end()) continue;
      if (!first.empty() && own->second != first)
        refuse(spelled,
               fmt::format("the uniform '{}' begins at {} here, and at {} in the vertex program", spelled,
                           first, own->second),
               "let one of them say it");
      first = own->second;
    }
  }
}

void CourseProgram::describe(const Refuse& refuse) {
  interface_ = fragment_.interface;
  interface_.blocks.clear();
  gpu::ShaderBlock uniforms{.name = "uniforms", .loose = true};
  std::vector<const Stage*> stages{&fragment_};
  if (vertex_) stages.push_back(&*vertex_);
  for (const Stage* stage : stages)
    for (const gpu::ShaderBlock& block : stage->interface.blocks) {
      if (block.name == kState) {
        for (const ShaderVariable& member : block.members)
          readsLights_ =
              readsLights_ ||
              (member.active && (member.name == "gL_LightSource" || member.name.ends_with("LightProduct")));
      } else if (block.loose) {
        for (const ShaderVariable& uniform : block.members) {
          const auto known = std::ranges::find(uniforms.members, uniform.name, &ShaderVariable::name);
          if (known == uniforms.members.end()) {
            uniforms.members.push_back(uniform);
            uniforms.members.back().stages = {stage->interface.stage};
          } else {
            known->active = known->active || uniform.active;
            known->stages.insert(known->stages.begin(), stage->interface.stage);
          }
        }
      } else {
        refuse(block.name, fmt::format("the block '{}' has no values", block.name),
               "declare what a scene may set as uniforms outside of blocks: uniform float roughness;");
      }
    }
  TextByName types;
  for (const MaterialShader::File& file : shader_->files) types.merge(typesOfUniforms(file.text));
  for (ShaderVariable& uniform : uniforms.members) {
    uniform.name = withoutCourseSpelling(uniform.name);
    const std::string& type = types[uniform.name];
    if (type == "sampler1D" || type == "sampler2D") uniform.type = type;
    if (uniform.type.starts_with('u') && type.starts_with('b')) uniform.type = gpu::boolOf(uniform.type);
  }
  if (!uniforms.members.empty()) interface_.blocks.push_back(std::move(uniforms));
  // All outputs count as active.
  const auto taken = [this](const Stage& stage, const std::vector<ShaderVariable>& variables,
                            const auto& isUsed) {
    std::vector<ShaderVariable> own;
    for (ShaderVariable variable : variables) {
      const bool isOwn = !isOfTheLanguage(variable.name);
      variable.stages = {stage.interface.stage};
      if (&stage != &fragment_)
        if (const ShaderVariable* read = find(fragment_.interface.inputs, variable.name);
            read && read->active && &variables == &vertex_->interface.outputs)
          variable.stages.push_back(fragment_.interface.stage);
      variable.name = withoutCourseSpelling(variable.name);
      if (!isOwn && !isUsed(variable)) continue;
      variable.location.reset();
      own.push_back(std::move(variable));
    }
    return own;
  };
  const auto isActive = [](const ShaderVariable& variable) { return variable.active; };
  interface_.outputs =
      vertex_ ? taken(*vertex_, vertex_->interface.outputs,
                      [this](const ShaderVariable& variable) { return words_.contains(variable.name); })
              : taken(fragment_, fragment_.interface.inputs, isActive);
  interface_.inputs =
      vertex_ ? taken(*vertex_, vertex_->interface.inputs, isActive) : std::vector<ShaderVariable>{};
}

std::vector<std::string> CourseProgram::storagesOf(const std::string& uniform) const {
  const std::string name = withCourseSpelling(uniform);
  std::vector<std::string> storages;
  for (const Stage* stage : {&fragment_, vertex_ ? &*vertex_ : nullptr})
    if (stage && find(uniformsOf(stage->interface), name))
      storages.push_back(fmt::format("{}{}", stage->prefix, name));
  return storages;
}

std::string CourseProgram::initialiserShared(const std::string& uniform) const {
  const std::vector<std::string> storages = storagesOf(uniform);
  if (storages.size() < 2) return {};
  const bool ofFragment = isInitialised(fragment_, uniform), ofVertex = isInitialised(*vertex_, uniform);
  if (ofFragment == ofVertex) return {};
  return fmt::format("  {} = {};\n", storages[ofFragment ? 1 : 0], storages[ofFragment ? 0 : 1]);
}

std::string CourseProgram::programs(const std::string& functions, const std::string& loads) const {
  std::string text = "#define uniform\n#include \"lib/course.glsl\"\n" + functions;
  if (vertex_) text += fmt::format("#include \"{}\"\n{}", vertex_->paths[shader_->vertex], macros_);
  text += fmt::format("#include \"{}\"\n{}", fragment_.paths.front(), macros_);
  return text + fmt::format("void loadUniforms() {{\n{}}}\n", loads);
}

/// Statements that give the vertex program what a vertex has beside what the language gives it.
std::string CourseProgram::attributes(bool inPixels) const {
  std::string text;
  for (const ShaderVariable& attribute : vertex_->interface.inputs)
    if (const auto* const known = std::ranges::find(kAttributes, attribute.name, &Attribute::name);
        known != std::end(kAttributes))
      text += fmt::format("  {}{} = {};\n", vertex_->prefix, attribute.name,
                          inPixels ? known->value : known->ofVertices);
  return text;
}

std::string CourseProgram::movement(const std::string& functions, const std::string& loads) const {
  return programs(functions, loads) +
         fmt::format("void luxoMoveVertex(vec2 uv) {{\n{}  {}mAin();\n}}\n#undef uniform\n",
                     attributes(false), vertex_->prefix);
}

std::string CourseProgram::material(const std::string& functions, const std::string& loads) const {
  std::string text = readsLights_ ? "#define LUXO_READS_LIGHTS\n" : "";
  text += programs(functions, loads) +
          "#include \"lib/course_point.glsl\"\nvec4 material(Point p) {\n  luxoLoadPoint(p);\n";
  if (vertex_) {
    text += attributes(true) + fmt::format("  {}mAin();\n  luxoMoved = luxoIsMoved();\n", vertex_->prefix);
    for (const ShaderVariable& varying : fragment_.interface.inputs)
      if (!isOfTheLanguage(varying.name) && find(vertex_->interface.outputs, varying.name))
        text +=
            fmt::format("  {}{} = {}{};\n", fragment_.prefix, varying.name, vertex_->prefix, varying.name);
    text += "  luxoHandOver();\n";
  } else if (const ShaderVariable* color = find(fragment_.interface.inputs, "gL_Color");
             color && color->active) {
    text += "  gL_Color = luxoFixedColor();\n";
  }
  return text + fmt::format(
                    "  {}mAin();\n  return luxoDiscarded ? vec4(0.0) : vec4(gL_FragColor.rgb, {});\n}}\n"
                    "#undef uniform\n",
                    fragment_.prefix, shader_->saysOpacity() ? "gL_FragColor.a" : "1.0");
}

std::vector<std::string> CourseProgram::ofStages(std::vector<std::string> Stage::*what) const {
  std::vector<std::string> all = fragment_.*what;
  if (vertex_) all.insert(all.end(), ((*vertex_).*what).begin(), ((*vertex_).*what).end());
  return all;
}

}  // namespace luxo
