// SPDX-License-Identifier: Apache-2.0
#include "draw/material_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>

#include "base/error.h"
#include "base/suggestion.h"
#include "draw/course_style.h"
#include "draw/indexed_arrays.h"
#include "draw/material_errors.h"
#include "draw/material_text.h"
#include "draw/uniform_type.h"
#include "luxo/shaders/sources.h"
#include "math/transform.h"
#include "scene/shader_files.h"
#include "scene/shader_macros.h"
#include "scene/shader_text.h"
#include "shared/scene_data.h"

namespace luxo {
namespace {

constexpr std::string_view kAlone = "lib/material_alone.glsl", kCourseAlone = "lib/course_alone.glsl",
                           kEntry = "material";
// What else luxo's shaders include that is made while it runs.
constexpr std::string_view kPattern = "pattern", kSurface = "surface", kCurvature = "curvature";

// A driver copies functions to where they are called, and its time grows faster than what that makes.
// Measured on llvmpipe: 17,000 instructions take 3 s, 34,000 11 s, 68,000 37 s; those of apps/scenes/gallery
// have at most 656.
constexpr std::uint64_t kMaxShaderInstructions = 32'768, kMaxVariableBytes = 65'536;
// llvmpipe keeps the masks of 80 branches in each other, and draws what is deeper wrong without a word:
// luxo's own around material() are among them.
constexpr std::uint64_t kDeepestBranches = 64;
// It copies the constants of an array to each place that reads one.
constexpr std::uint64_t kLongestTable = 256;

/// 0 of what flattens space.
Mat3 inverseOrZero(const Mat3& linear) {
  const double volume = std::abs(glm::dot(linear[0], glm::cross(linear[1], linear[2])));
  return volume > 0 && std::isfinite(1 / volume) ? glm::transpose(normalMatrix(linear)) / volume : Mat3(0);
}

}  // namespace

MaterialProgram::MaterialProgram(MaterialShaderPtr shader) : shader_(std::move(shader)) {
  for (const MaterialShader::File& file : shader_->files)
    if (file.name == kEntry || file.name == kPattern || file.name == kSurface || file.name == kCurvature ||
        std::ranges::find(kShaderSources, file.name, &gpu::ShaderSource::name) != std::end(kShaderSources))
      throw Error(ErrorKind::Scene,
                  fmt::format("the shader file '{}' has the name of one of luxo's own", file.name),
                  "give it another one");
  requireBounded(*shader_);
  if (shader_->vertex > 0) requireBounded(*shader_, shader_->vertex);
  for (std::size_t i = shader_->wrapped ? 1 : 0; i < shader_->files.size(); ++i)
    refuseDirectives(shader_->files[i]);
  for (const MaterialShader::File& file : shader_->files)
    for (const auto& [name, value] : initialisersIn(file.text)) initialised_.insert(name);
  if (luxo::inCourseStyle(*shader_)) {
    compileCourse();
  } else {
    if (shader_->files.front() == kFixedFragments)
      throw Error(ErrorKind::Scene,
                  fmt::format("{}: it is no vertex program in the course's style",
                              shader_->files[shader_->vertex].name),
                  "write void main() { gl_FrontColor = gl_Color; gl_Position = ftransform(); }");
    if (shader_->vertex > 0)
      throw Error(
          ErrorKind::Scene,
          fmt::format("{}: there is a vertex program beside it, and it is no program in the course's style",
                      shader_->files.front().name),
          "leave \"vertex\" out: material() is given the point itself (shaders/MATERIALS.md)");
    for (const MaterialShader::File& file : shader_->files) texts_.push_back(joinable(file.text));
    interface_ = compileAlone(kAlone, 0, gpu::ShaderStage::Fragment);
    nameTypes();
    requireOwnNames();
  }
  requireSettable();
  addCopiedArrays();
  requireAffordable();
}

/// Whether the first file, luxo's own, renames it in the others.
bool MaterialProgram::isWrapped(const std::string& name) const {
  return shader_->wrapped && placeOf(std::string(kWrappedName) + name, shader_->files.front().text);
}

/// Functions may have them for other arguments.
void MaterialProgram::requireOwnNames() const {
  std::vector<std::string> names;
  for (const auto* some : {&interface_.structures, &interface_.globals})
    names.insert(names.end(), some->begin(), some->end());
  for (const gpu::ShaderBlock& block : interface_.blocks)
    for (const gpu::ShaderVariable& uniform : block.members) names.push_back(uniform.name);
  for (const MaterialShader::File& file : shader_->files)
    for (std::string& name : constantsOf(outsideOfFunctions(file.text)))
      if (!isWrapped(name)) names.push_back(std::move(name));
  for (const std::string& name : names)
    if (isGivenToMaterials(name) && name != "luxoRounds" && name != "Point" && name != "Light" &&
        name != "Hit")
      refuseWord(name, fmt::format("'{}' is a name of luxo's own (shaders/MATERIALS.md)", name),
                 "choose another one");
}

/// What each point has a copy of.
void MaterialProgram::addCopiedArrays() {
  for (const gpu::ShaderVariable& uniform : uniforms_) {
    const std::optional<UniformType> type = typeNamed(uniform.type);
    if (uniform.array.empty() || !type) continue;
    std::vector<std::string> texts = course_ ? course_->texts() : texts_;
    for (const std::string& storage : storagesOf(uniform))
      if (!readElements(texts, storage, uniform.array.size()))
        cost_.variableBytes += std::uint64_t{sizeof(float)} * type->numbers() * uniform.elements();
  }
}

std::vector<std::string> MaterialProgram::storagesOf(const gpu::ShaderVariable& uniform) const {
  return course_ ? course_->storagesOf(uniform.name) : std::vector{uniform.name};
}

/// To the compiler samplers are numbers, and so is truth, where a buffer has it.
void MaterialProgram::nameTypes() {
  TextByName types;
  for (const MaterialShader::File& file : shader_->files) types.merge(typesOfUniforms(file.text));
  for (gpu::ShaderBlock& block : interface_.blocks)
    for (gpu::ShaderVariable& uniform : block.members) {
      const std::string& type = types[uniform.name];
      if (uniform.type.starts_with('u') && type.starts_with('b')) uniform.type = gpu::boolOf(uniform.type);
      if (uniform.type != "int" || type != "sampler2D") continue;
      uniform.type = "sampler2D";
      if (!uniform.array.empty())
        refuseWord(uniform.name, fmt::format("'{}' are several samplers", uniform.name),
                   "declare each by itself: uniform sampler2D first, second;");
    }
}

void MaterialProgram::compileCourse() {
  for (const MaterialShader::File& file : shader_->files) {
    refuseForeign(file);
    texts_.push_back(joinable(withCourseSpelling(file.text)));
  }
  gpu::ShaderInterface fragment = compileAlone(kCourseAlone, 0, gpu::ShaderStage::Fragment);
  std::optional<gpu::ShaderInterface> vertex;
  if (shader_->vertex > 0) vertex = compileAlone(kCourseAlone, shader_->vertex, gpu::ShaderStage::Vertex);
  course_.emplace(*shader_, texts_, std::move(fragment), std::move(vertex),
                  [this](const std::string& word, const std::string& why, const std::string& advice) {
                    refuseWord(word, why, advice);
                  });
}

gpu::ShaderInterface MaterialProgram::compileAlone(std::string_view in, std::size_t index,
                                                   gpu::ShaderStage stage) {
  const std::string& entry = shader_->files[index].name;
  std::vector<gpu::ShaderSource> sources(std::begin(kShaderSources), std::end(kShaderSources));
  const std::string material = fmt::format("#include \"{}\"\n", entry);
  sources.push_back({kEntry, material});
  for (std::size_t i = 0; i < texts_.size(); ++i)
    sources.push_back({shader_->files[i].name, texts_[i], shader_->files[i].text});
  gpu::ShaderCompiler::Result result;
  try {
    result = gpu::ShaderCompiler().compile(
        {.source = *std::ranges::find(kShaderSources, in, &gpu::ShaderSource::name),
         .stage = stage,
         .includes = sources,
         .preamble = stage == gpu::ShaderStage::Vertex ? "#define LUXO_VERTEX\n" : "",
         .forReflection = true,
         .asShown = in == kCourseAlone ? asProgramsSpell : asFilesSpell});
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Scene) throw;
    explainRefusal(*shader_, entry, in == kCourseAlone, error.what());
  }
  compiled_ = compiled_ || result.compiled;
  const gpu::ShaderCost cost = gpu::costOf(result.spirv);
  cost_.instructions += cost.instructions;
  cost_.variableBytes += cost.variableBytes;
  cost_.longestTable = std::max(cost_.longestTable, cost.longestTable);
  cost_.nesting = std::max(cost_.nesting, cost.nesting);
  requireFewInstructions();  // reflection follows every call, too
  gpu::ShaderInterface interface = gpu::reflect(result.spirv);
  requirePure(interface);
  return interface;
}

void MaterialProgram::requireSettable() {
  for (const gpu::ShaderBlock& block : interface().blocks) {
    if (!block.loose)
      throw Error(ErrorKind::Scene,
                  fmt::format("{}: the block '{}' has no values", shader_->files.front().name, block.name),
                  "declare what a scene may set as uniforms outside of blocks: uniform float roughness;");
    uniforms_ = block.members;
  }
  for (const gpu::ShaderVariable& uniform : uniforms_)
    if (!typeNamed(uniform.type))
      refuseWord(uniform.name,
                 fmt::format("the uniform '{}' is of type {}, which scenes do not set", uniform.name,
                             arrayText(uniform)),
                 "numbers, vectors and matrices of float, int, uint and bool, and arrays of them, are set");
  if (!interface().samplers.empty())
    throw Error(ErrorKind::Scene,
                fmt::format("{}: '{}' is a {}, which scenes do not set yet", shader_->files.front().name,
                            interface().samplers.front().name, interface().samplers.front().type),
                "images have two dimensions: uniform sampler2D");
}

void MaterialProgram::refuseWord(const std::string& word, const std::string& why,
                                 const std::string& advice) const {
  for (const MaterialShader::File& file : shader_->files)
    if (const auto place = placeOf(word, file.text))
      throw Error(ErrorKind::Scene, describe(file.name, file.text, {*place, why, advice}));
}

/// Points in, a colour out.
void MaterialProgram::requirePure(const gpu::ShaderInterface& interface) const {
  const std::string& file = shader_->files.front().name;
  const bool isProgram = luxo::inCourseStyle(*shader_);
  if (interface.discards)
    refuseWord(
        "discard", "'discard': a material is a function of its point, and a picture of its pixels",
        "return an opacity of 0, in a shader that has the line '#pragma luxo opacity'; in mainImage give the "
        "colour of what is behind");
  for (const std::string& global : interface.computedGlobals) {
    const std::string name = isProgram ? withoutCourseSpelling(global) : global;
    refuseWord(name,
               fmt::format("'{}' is computed before any uniform has its value: outside of functions only "
                           "constants are",
                           name),
               "compute it in a function, or make it a constant");
  }
  // Wherever it stands: what is left out here may be there once joined with all else, where nobody gives it a
  // value.
  refuseWord("constant_id", "'constant_id' makes a specialization constant, which scenes do not set",
             "make it a constant, or a uniform, which scenes set");
  for (const char* own : {"luxoStops", "luxoRounds", "kLuxoMaxRounds", "LUXO_ASKS"})
    refuseWord(own, fmt::format("'{}' is a name of luxo's own", own), "choose another one");
  if (std::ranges::count(interface.calls, "luxoStops") < std::int64_t{interface.loops})
    throw Error(ErrorKind::Scene, fmt::format("{}: a macro spells a loop, which may have no end", file),
                "write for, while and do where the loop is");
  for (const auto* variables : {&interface.inputs, &interface.outputs})
    for (const gpu::ShaderVariable& variable : *variables)
      if (isProgram
              ? variable.name.starts_with("gl_") && variable.name != "gl_FrontFacing"
              : variable.name != "inAny" && variable.name != "outColor" && variable.name != "gl_FragCoord")
        throw Error(ErrorKind::Scene,
                    fmt::format("{}: '{}' is an input or output of a program, which a material is not", file,
                                variable.name),
                    "the point is the argument of material(), and the colour its result");
  if (!interface.beyond.empty())
    throw Error(ErrorKind::Scene,
                fmt::format("{}: it asks for {}, which only some devices have", file, interface.beyond),
                "write plain GLSL, of numbers and of what a material is given (shaders/MATERIALS.md)");
}

void MaterialProgram::requireFewInstructions() const {
  if (cost_.instructions > kMaxShaderInstructions)
    throw Error(
        ErrorKind::Scene,
        fmt::format("{}: with a copy of each function at each of its calls it has {} instructions; at "
                    "most {} are compiled",
                    shader_->files.front().name, cost_.instructions, kMaxShaderInstructions),
        "call functions in a loop instead of one by one");
}

void MaterialProgram::requireAffordable() const {
  const gpu::ShaderCost& cost = cost_;
  const std::string& file = shader_->files.front().name;
  if (cost.nesting > kDeepestBranches)
    throw Error(ErrorKind::Scene,
                fmt::format("{}: its branches are nested {} deep, counting those of the functions that are "
                            "called in them, and each return, break and continue in a branch as one around "
                            "what follows; at most {} are drawn right by every driver",
                            file, cost.nesting, kDeepestBranches),
                "use an array and a loop, or a switch");
  if (cost.longestTable > kLongestTable) refuseTable();
  if (cost.variableBytes > kMaxVariableBytes)
    throw Error(ErrorKind::Scene,
                fmt::format("{}: its variables take {} bytes in every pixel; at most {} are there", file,
                            cost.variableBytes, kMaxVariableBytes),
                "keep less in arrays");
}

void MaterialProgram::refuseTable() const {
  const std::string why = fmt::format("an array of constants has {} elements; at most {} are compiled",
                                      cost_.longestTable, kLongestTable),
                    advice = "make it a uniform, which is read where it lies, or compute each from its index";
  for (const MaterialShader::File& file : shader_->files)
    if (const auto place = placeOfList(kLongestTable, file.text))
      throw Error(ErrorKind::Scene, describe(file.name, file.text, {*place, why, advice}));
  throw Error(ErrorKind::Scene, fmt::format("{}: {}", shader_->files.front().name, why), advice);
}

const gpu::ShaderVariable* MaterialProgram::find(const std::string& name) const {
  const auto found = std::ranges::find(uniforms_, name, &gpu::ShaderVariable::name);
  return found == uniforms_.end() ? nullptr : &*found;
}

void MaterialProgram::check(const Material& material) const {
  const std::string& file = shader_->files.front().name;
  for (const UniformValue& value : material.uniforms) {
    const auto refuse = [&](const std::string& message, const std::string& hint) {
      throw Error(ErrorKind::Scene, value.place.describe(message, hint));
    };
    const gpu::ShaderVariable* uniform = find(value.name);
    if (!uniform) {
      std::vector<std::string> names;
      for (const gpu::ShaderVariable& known : uniforms_) names.push_back(known.name);
      refuse(fmt::format("the shader '{}' has no uniform '{}'", file, value.name),
             didYouMean(value.name, names,
                        names.empty() ? "it has none" : fmt::format("it has {}", listed(names))));
    }
    const bool isSampler = uniform->type.starts_with("sampler");
    if (value.map.valid() && isSampler) continue;
    if (value.map.valid())
      refuse(fmt::format("the uniform '{}' of '{}' is of type {}, not a texture", value.name, file,
                         arrayText(*uniform)),
             {});
    if (isSampler && value.values.empty())
      refuse(fmt::format("the texture of the uniform '{}' of '{}' has no image: there is no such file",
                         value.name, file),
             "put it into the folder of the scene, or into one below");
    if (isSampler && !course_)
      refuse(fmt::format("the uniform '{}' of '{}' is a texture, not a number", value.name, file),
             "give it the name of one of the scene's textures");
    const std::optional<UniformType> type = typeNamed(uniform->type);
    if (!type)
      refuse(fmt::format("the uniform '{}' of '{}' is of type {}, which scenes do not set", value.name, file,
                         arrayText(*uniform)),
             "numbers, vectors and matrices of float, int, uint and bool, and arrays of them, are set");
    const std::size_t wanted = std::size_t{type->numbers()} * uniform->elements();
    if (value.values.size() != wanted)
      refuse(fmt::format("the uniform '{}' of '{}' is of type {}: {} number{}, not {}", value.name, file,
                         arrayText(*uniform), wanted, wanted == 1 ? "" : "s", value.values.size()),
             {});
    if (value.truth && type->scalar != "bool")
      refuse(fmt::format("the uniform '{}' of '{}' is of type {}, not true or false", value.name, file,
                         arrayText(*uniform)),
             wanted == 1 ? "give a number" : "give numbers");
    for (const double number : value.values) {
      if (isSampler && number > 2)
        refuse(fmt::format("the uniform '{}' of '{}' is a {}, and there is no map {}", value.name, file,
                           arrayText(*uniform), number),
               "0 is the material's \"map\", 1 its \"specular_map\", 2 its \"glow_map\"");
      constexpr double kMaxWhole = 16777216;  // what floats count to
      if (type->scalar != "float" && !(number == std::floor(number) && std::abs(number) <= kMaxWhole &&
                                       (type->scalar == "int" || number >= 0)))
        refuse(fmt::format("the uniform '{}' of '{}' is of type {}, and this is {}", value.name, file,
                           arrayText(*uniform), number),
               "give a whole number, up to 16777216");
      if (type->scalar == "bool" && number > 1)
        refuse(fmt::format("the uniform '{}' of '{}' is true or false, and this is {}", value.name, file,
                           number),
               {});
    }
  }
  if (!course_) requireTextures(material);
}

void MaterialProgram::requireTextures(const Material& material) const {
  for (const gpu::ShaderVariable& uniform : uniforms_)
    if (uniform.type == "sampler2D" && uniform.active &&
        std::ranges::find(material.uniforms, uniform.name, &UniformValue::name) == material.uniforms.end())
      refuseWord(
          uniform.name,
          fmt::format("the sampler '{}' has no texture, in material '{}'", uniform.name, material.name),
          fmt::format("name one of the scene's: \"uniforms\": {{ \"{}\": \"wood\" }}", uniform.name));
}

std::vector<std::string> MaterialProgram::unused(const Material& material) const {
  std::vector<std::string> messages;
  for (const UniformValue& value : material.uniforms)
    if (const gpu::ShaderVariable* uniform = find(value.name); uniform && !uniform->active)
      messages.push_back(value.place.describe(fmt::format("nothing in the shader '{}' uses the uniform '{}'",
                                                          shader_->files.front().name, value.name),
                                              {}));
  return messages;
}

std::optional<std::string> MaterialProgram::valueOf(const gpu::ShaderVariable& uniform,
                                                    const Paint& paint) const {
  std::uint32_t first = shared::kShaderNumbers, texture = paint.firstOfUniforms();
  for (const auto& [name, count] : paint.given()) {
    if (name == uniform.name && count == 0) return fmt::format("{}", texture);
    if (name == uniform.name) {
      const UniformType type = *typeNamed(uniform.type);
      return valueAt(uniform, type, fmt::format("{}u + {}u * uint(element)", first, type.numbers()));
    }
    if (count == 0)
      texture += shared::kTextureNumbers;
    else
      first += count;
  }
  if (initialised_.contains(uniform.name)) return std::nullopt;
  return fmt::format("{}(0)", typeOfElement(uniform));
}

MaterialProgram::Loads MaterialProgram::loads(const Paint& paint, std::vector<std::string>& texts) const {
  Loads loads;
  for (const gpu::ShaderVariable& uniform : uniforms_) {
    const std::optional<std::string> value = valueOf(uniform, paint);
    if (!value) {
      if (course_) loads.statements += course_->initialiserShared(uniform.name);
      continue;
    }
    for (const std::string& storage : storagesOf(uniform)) {
      loads.functions += readerOf(uniform, storage, *value);
      if (uniform.array.empty() || !readElements(texts, storage, uniform.array.size()))
        loads.statements += copyOfAll(uniform, storage);
    }
  }
  return loads;
}

/// In all of the texts, or in none.
bool MaterialProgram::readElements(std::vector<std::string>& texts, const std::string& name,
                                   std::size_t dimensions) {
  std::vector<std::string> reading;
  for (const std::string& text : texts) {
    std::optional<std::string> one = withElementsRead(text, name, dimensions);
    if (!one) return false;
    reading.push_back(std::move(*one));
  }
  texts = std::move(reading);
  return true;
}

MaterialProgram::Joined MaterialProgram::joinedCourse(const Paint& paint, CourseText text) const {
  Joined joined;
  joined.texts = course_->texts();
  const Loads load = loads(paint, joined.texts);
  joined.material = ((*course_).*text)(load.functions, load.statements);
  joined.names = course_->paths();
  joined.shown.resize(joined.names.size());
  return joined;
}

MaterialProgram::Joined MaterialProgram::movement(const Paint& paint) const {
  return joinedCourse(paint, &CourseProgram::movement);
}

MaterialProgram::Joined MaterialProgram::joined(const Paint& paint) const {
  Joined joined;
  if (paint.curvature().valid()) joined.curvature = paint.curvature().glsl();
  if (course_) {
    Joined ofCourse = joinedCourse(paint, &CourseProgram::material);
    ofCourse.curvature = std::move(joined.curvature);
    return ofCourse;
  }
  // What the shader names is its own, whatever luxo's own shaders call theirs.
  std::vector<std::string> names;
  for (const auto* some : {&interface_.functions, &interface_.structures, &interface_.globals})
    names.insert(names.end(), some->begin(), some->end());
  for (const gpu::ShaderVariable& uniform : uniforms_) names.push_back(uniform.name);
  // Constants leave no name behind: those of functions are renamed, too, which changes nothing.
  for (const MaterialShader::File& file : shader_->files)
    for (std::string& name : constantsOf(glslTokens(file.text))) names.push_back(std::move(name));
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  std::erase_if(names, [&](const std::string& name) {
    return isGivenToMaterials(name) || name == "main" || name.starts_with("gl_") || isFieldOfMaterials(name);
  });
  joined.texts = texts_;
  const Loads load = loads(paint, joined.texts);
  std::string& material = joined.material;
  material = load.functions + "#define uniform\n#define sampler2D int\n";
  for (const std::string& name : names) material += fmt::format("#define {} luxoOwn_{}\n", name, name);
  material += fmt::format("#include \"{}\"\nvoid loadUniforms() {{\n{}}}\n", shader_->files.front().name,
                          load.statements);
  for (const std::string& name : names) material += fmt::format("#undef {}\n", name);
  material += "#undef sampler2D\n#undef uniform\n";
  for (const MaterialShader::File& file : shader_->files) {
    joined.names.push_back(file.name);
    joined.shown.push_back(file.text);
  }
  return joined;
}

std::vector<gpu::ShaderSource> MaterialProgram::Joined::sources() const {
  std::vector<gpu::ShaderSource> sources;
  if (!curvature.empty()) sources.push_back({kCurvature, curvature});
  for (std::size_t i = 0; i < names.size(); ++i) sources.push_back({names[i], texts[i], shown[i]});
  sources.push_back({kEntry, material});
  return sources;
}

void appendUniforms(const Material& material, std::vector<float>& numbers) {
  for (const UniformValue& uniform : material.uniforms)
    for (const double value : uniform.values) numbers.push_back(static_cast<float>(value));
}

void appendShader(const Material& material, const SnapshotNode& node, const Vec3& origin, const Vec3& ambient,
                  std::vector<float>& numbers) {
  std::array<float, shared::kShaderNumbers> own{};
  const auto put = [&](std::size_t first, const Vec3& v) {
    for (int i = 0; i < 3; ++i) own[first++] = static_cast<float>(v[i]);
  };
  const auto putMatrix = [&](std::size_t first, const Mat3& m) {
    for (int column = 0; column < 3; ++column, first += 3) put(first, m[column]);
  };
  Mat3 objectFromWorld = inverseOrZero(node.worldFromObject.linear);
  Mat3 worldFromObject = node.worldFromObject.linear;
  for (int column = 0; column < 3; ++column) {
    objectFromWorld[column] /= node.evened;
    worldFromObject[column] *= node.evened[column];
  }
  put(shared::kShaderOrigin, origin);
  putMatrix(shared::kShaderObjectFromRelative, objectFromWorld);
  put(shared::kShaderObjectOrigin, objectFromWorld * (origin - node.worldFromObject.translation));
  put(shared::kShaderAmbient, ambient);
  putMatrix(shared::kShaderRelativeFromObject, worldFromObject);
  numbers.insert(numbers.end(), own.begin(), own.end());
  appendUniforms(material, numbers);
  for (const double parameter : material.curvatureParameters)
    numbers.push_back(static_cast<float>(parameter));
}

}  // namespace luxo
