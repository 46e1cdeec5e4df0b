// SPDX-License-Identifier: Apache-2.0
#include "scene/shape_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/assert.h"
#include "base/error.h"
#include "formula/removable.h"
#include "formula/tape.h"
#include "formula/variables.h"
#include "scene/formula_set.h"
#include "scene/isolines_builder.h"
#include "scene/model_files.h"
#include "scene/model_scene.h"
#include "scene/scene_keys.h"
#include "surface/bezier.h"
#include "surface/catalogue.h"
#include "surface/cloth.h"
#include "surface/tube.h"

namespace luxo {
namespace {

constexpr const char* kCellsInWords = "a whole number from 1 to 128";
static_assert(kMaxClothCells == 128);

/// The surface of position formulas, at rest for its topology and then free to move.
Surface assemble(const FormulaSet& formulas, const ExprPoint& position, const Moment& start,
                 SurfaceTraits traits) {
  std::vector<Animated<double>> still;
  for (const Animated<double>& parameter : formulas.parameters()) still.emplace_back(parameter.at(start));
  const Surface surface(cutAtKinks(formulas.graph(), position, formulas.domain()), std::move(still),
                        std::move(traits));
  return surface.withParameters(formulas.parameters());
}

/// Unit, of a formula whose tangents are the same everywhere, whatever its parameters are.
std::optional<Vec3> flatNormalOf(Graph& graph, const ExprPoint& position) {
  std::array<Vec3, 2> tangents{};
  for (std::uint32_t variable = 0; variable < 2; ++variable)
    for (int axis = 0; axis < 3; ++axis) {
      const Expr along = graph.derivative(position[static_cast<std::size_t>(axis)], variable);
      if (!along.isConstant()) return std::nullopt;
      tangents[variable][axis] = along.constant();
    }
  const Vec3 normal = unit(glm::cross(tangents[0], tangents[1]));
  return normal == Vec3(0) ? std::nullopt : std::optional(normal);
}

std::string shown(const Interval& range) {
  const std::string lowest = fmt::format("{:.4g}", range.lo), highest = fmt::format("{:.4g}", range.hi);
  return lowest == highest ? lowest : lowest + ".." + highest;
}

/// Whether a hole leaves nothing of a range that could be seen.
bool covers(const Interval& hole, const Interval& range) { return hole.width() >= 0.999 * range.width(); }

/// The values of the first three formulas, which depend neither on u nor on v; what they give is judged by
/// snapshots.
Animated<Vec3> uniformOf(const FormulaSet& formulas) {
  const auto valueOf = [tape = Tape(formulas.graph(), std::span(formulas.values()).first(3))](
                           std::span<const double> parameters) {
    std::array<double, 3> c{};
    tape.evaluatePoint(0, 0, parameters, c);
    return Vec3(c[0], c[1], c[2]);
  };
  const std::vector<Animated<double>>& parameters = formulas.parameters();
  if (parameters.empty()) return valueOf({});
  const bool moves = std::ranges::any_of(parameters, &Animated<double>::movesWithTime);
  return {[valueOf, parameters](const Moment& moment) {
            std::vector<double> values;
            for (const Animated<double>& parameter : parameters) values.push_back(parameter.at(moment));
            return valueOf(values);
          },
          moves ? DependsOn::Both : DependsOn::Parameters};
}

bool isTiny(const Interval& part, const Interval& whole) { return part.width() <= 1e-6 * whole.width(); }

/// Whether the formula has a value somewhere inside of a rectangle that was found to hold a hole.
bool hasPoints(const Surface& surface, std::span<const double> parameters, const Domain& rectangle) {
  constexpr int kSamples = 33;
  std::vector<double> u, v;
  for (int i = 0; i < kSamples; ++i) {
    const double part = (i + 0.5) / kSamples;
    u.push_back(rectangle.u.lo + part * rectangle.u.width());
    v.push_back(rectangle.v.lo + part * rectangle.v.width());
  }
  const std::uint32_t patch = surface.patchAt(rectangle.u.mid(), rectangle.v.mid());
  const SurfacePoints points = surface.evaluateGrid(patch, u, v, parameters);
  return std::ranges::any_of(points.position, [](const Vec3& p) { return std::isfinite(glm::dot(p, p)); });
}

/// Whether Su and Sv are parallel, up to rounding, wherever they exist: curves, seen from nowhere.
bool lacksArea(const Surface& surface, std::span<const double> parameters) {
  constexpr int kSamples = 9;
  constexpr double kSine = 1e-12;  // rounding is some 1e-15, what is oblique on purpose far above
  bool parallel = false;
  for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
    const Domain& domain = surface.patchDomain(patch);
    std::vector<double> u, v;
    for (int i = 0; i < kSamples; ++i) {
      const double part = (i + 0.5) / kSamples;
      u.push_back(domain.u.lo + part * domain.u.width());
      v.push_back(domain.v.lo + part * domain.v.width());
    }
    const SurfacePoints points = surface.evaluateGrid(patch, u, v, parameters);
    for (std::size_t i = 0; i < points.position.size(); ++i) {
      const Vec3 &du = points.du[i], &dv = points.dv[i];
      const double area = glm::length(glm::cross(du, dv)), most = glm::length(du) * glm::length(dv);
      if (area > kSine * most) return false;
      parallel = parallel || area <= kSine * most;  // not for NaN
    }
  }
  return parallel;
}

}  // namespace

Surface ShapeBuilder::build(const SurfaceDesc& desc) {
  try {
    Surface surface =
        std::visit([&](const auto& shape) { return buildShape(desc.name.text, shape); }, desc.shape);
    if (surface.valid() && warnings_ && about_ == WarningsAbout::All)
      warn(desc.name.place, fmt::format("surface '{}'", desc.name.text), surface);
    return surface;
  } catch (const Error& error) {
    problems_.add(desc.name.place, error.what(), error.hint());
    return {};
  }
}

Surface ShapeBuilder::buildShape(const std::string&, const NamedShape& shape) {
  const CatalogueEntry* entry = findCatalogueEntry(shape.type.text);
  if (!entry) {
    problems_.add(shape.type.place, fmt::format("unknown surface type '{}'", shape.type.text));
    return {};
  }
  const std::size_t problemsBefore = problems_.count();
  std::vector<SurfaceArgument> arguments;
  FilePlace suspect = shape.type.place;
  for (const NamedShape::Argument& argument : shape.arguments) {
    SurfaceArgument& made = arguments.emplace_back(SurfaceArgument{argument.name.text, {}});
    for (const Quantity& value : argument.values) made.components.push_back(formulas_.numberAtStart(value));
    const auto known = std::ranges::find(entry->arguments, argument.name.text, &CatalogueArgument::name);
    if (known == entry->arguments.end()) continue;
    for (std::size_t i = 0; i < argument.values.size(); ++i)
      if (made.components[i].isConstant() ? !known->range.contains(made.components[i].at(0))
                                          : !known->mayMove())
        suspect = argument.values[i].place();
  }
  if (problems_.count() > problemsBefore) return {};
  try {
    return makeSurface(*entry, arguments, {0, *variables_.initial()});
  } catch (const Error& error) {
    problems_.add(suspect, error.what(), error.hint());
    return {};
  }
}

Surface ShapeBuilder::buildShape(const std::string& name, const FormulaShape& shape) {
  const FormulaSet formulas({.formulas = {shape.position.begin(), shape.position.end()},
                             .let = shape.let,
                             .u = shape.u,
                             .v = shape.v},
                            variables_);
  formulas.reportTo(problems_);
  if (!formulas.ok()) return {};
  const std::vector<Expr>& p = formulas.values();
  const ExprPoint position{p[0], p[1], p[2]};
  const Surface surface = assemble(formulas, position, {0, *variables_.initial()},
                                   {.name = name, .flatNormal = flatNormalOf(formulas.graph(), position)});
  if (shape.closed) checkClosed(shape, surface);
  return surface;
}

void ShapeBuilder::checkClosed(const FormulaShape& shape, const Surface& surface) {
  const Domain& whole = surface.domain();
  // Patches are also joined to each other, inside the whole.
  const auto isOuter = [&](const PatchEdge& edge) {
    const EdgePoint inner = edgePoint(surface.patchDomain(edge.patch), edge.side, 0.5);
    const EdgePoint outer = edgePoint(whole, edge.side, 0.5);
    return edge.side == Side::UMin || edge.side == Side::UMax ? inner.u == outer.u : inner.v == outer.v;
  };
  const auto joined = [&](Side lower, Side upper) {
    return std::ranges::any_of(surface.topology().joints, [&](const Joint& joint) {
      const auto [a, b] = std::minmax(joint.a.side, joint.b.side);
      return a == lower && b == upper && isOuter(joint.a) && isOuter(joint.b);
    });
  };
  const bool found[] = {joined(Side::UMin, Side::UMax), joined(Side::VMin, Side::VMax)};
  for (std::size_t i = 0; i < 2; ++i) {
    const char name = i == 0 ? 'u' : 'v';
    const Interval& range = i == 0 ? surface.domain().u : surface.domain().v;
    if ((*shape.closed)[i] && !found[i])
      problems_.add(
          shape.closedPlace,
          fmt::format("the surface is not closed in {}: its edges at {} = {:.9g} and {} = {:.9g} differ",
                      name, name, range.lo, name, range.hi),
          "leave \"closed\" out: luxo finds what closes");
    if (!(*shape.closed)[i] && found[i] && warnings_ && about_ == WarningsAbout::All)
      warnings_->push_back({rangeOf(shape.closedPlace), fmt::format("the surface is closed in {}", name),
                            "leave \"closed\" out: luxo finds what closes"});
  }
}

Surface ShapeBuilder::buildShape(const std::string& name, const RevolveShape& shape) {
  const FormulaSet formulas({.formulas = {shape.radius, shape.height},
                             .let = shape.let,
                             .u = shape.u,
                             .v = shape.v,
                             .whyNoU = "a profile depends on v alone"},
                            variables_);
  formulas.reportTo(problems_);
  if (!formulas.ok()) return {};
  const Expr radius = formulas.values()[0], height = formulas.values()[1], phi = kTau * formulas.u();
  return assemble(formulas, {radius * cos(phi), height, -(radius * sin(phi))}, {0, *variables_.initial()},
                  {.name = name, .revolution = shape.u == QuantityPair{0, 1}});
}

Surface ShapeBuilder::buildShape(const std::string& name, const TubeShape& shape) {
  const FormulaSet formulas({.formulas = {shape.curve[0], shape.curve[1], shape.curve[2], shape.radius},
                             .let = shape.let,
                             .u = shape.u},
                            variables_);
  formulas.reportTo(problems_);
  if (!formulas.ok()) return {};
  const std::vector<Expr>& p = formulas.values();
  for (std::size_t i = 0; i < 3; ++i)
    if (std::ranges::count(variablesOf(formulas.graph(), std::span(&p[i], 1)), kVariableV) > 0) {
      problems_.add(shape.curve[i].place(), "the curve of a tube cannot depend on v", "only its radius can");
      return {};
    }
  return tube(formulas.graph(), {p[0], p[1], p[2]}, p[3], formulas.domain().u, formulas.parameters(),
              {.name = name});
}

Surface ShapeBuilder::buildShape(const std::string& name, const BezierShape& shape) {
  const std::size_t problemsBefore = problems_.count();
  std::vector<Vec3> points;
  for (const Quantity3& point : shape.points) {
    Vec3& p = points.emplace_back(0);
    for (int i = 0; i < 3; ++i) p[i] = formulas_.once(point[static_cast<std::size_t>(i)]).value_or(0);
  }
  if (problems_.count() > problemsBefore) return {};
  std::vector<BezierPatch> patches;
  for (const auto& indices : shape.patches) {
    BezierPatch& patch = patches.emplace_back();
    for (std::size_t i = 0; i < patch.size(); ++i) {
      LUXO_REQUIRE_COMPARE(indices[i], <, points.size());
      patch[i] = points[indices[i]];
    }
  }
  return bezier(patches, {.name = name});
}

Surface ShapeBuilder::buildShape(const std::string&, const MeshShape& shape) {
  const std::optional<double> crease =
      formulas_.once(shape.crease, {{0, kPi}, "from 0 to pi, which is 180 degrees", true});
  if (!crease) return {};
  try {
    const std::shared_ptr<ModelFiles>& ofScene = problems_.source().models;
    const auto files = ofScene ? ofScene : std::make_shared<ModelFiles>();
    const std::shared_ptr<const Model> model =
        files->get(shape.file.text, {.normals = shape.normals, .crease = *crease, .tangents = tangents_});
    if (warnings_)
      for (const std::string& warning : model->warnings)
        warnings_->push_back({rangeOf(shape.file.place), warning, ""});
    return surfaceOf(*model);
  } catch (const Error& error) {
    problems_.add(shape.file.place, error.what(), error.hint());
    return {};
  }
}

Surface ShapeBuilder::buildShape(const std::string&, const ClothShape& shape) {
  const std::size_t problemsBefore = problems_.count();
  Cloth cloth;
  cloth.columns = cellsOf(shape.cells[0]);
  cloth.rows = cellsOf(shape.cells[1]);
  for (const ClothPinDesc& pin : shape.pins) addPins(pin, cloth);

  const ClothBallDesc ball = shape.ball.value_or(ClothBallDesc{.radius = 0});
  const Quantity* quantities[kClothNumbers] = {
      &shape.size[0],  &shape.size[1],    &shape.density,    &shape.stretch,    &shape.shear, &shape.bend,
      &shape.damping,  &shape.gravity[0], &shape.gravity[1], &shape.gravity[2], &shape.step,  &ball.center[0],
      &ball.center[1], &ball.center[2],   &ball.radius,      &ball.friction};
  std::vector<Animated<double>> numbers;
  std::array<double, kClothNumbers> atStart{};
  for (std::size_t i = 0; i < kClothNumbers; ++i) {
    const ClothNumber& known = clothNumbers()[i];
    const Quantity& quantity = *quantities[i];
    numbers.push_back(formulas_.numberAtStart(quantity, {known.range, known.words}));
    if (numbers.back().movesWithTime())
      problems_.add(quantity, {{0, quantity.formula().size()},
                               "a cloth's numbers cannot depend on t: its steps all have the same",
                               {}});
    else
      atStart[i] = numbers.back().at({0, *variables_.initial()});
  }
  if (problems_.count() > problemsBefore) return {};
  try {
    return Surface(withNumbers(cloth, atStart)).withParameters(std::move(numbers));
  } catch (const Error& error) {  // of numbers that do not go together
    const FilePlace step = shape.step.place();
    if (step.begin == step.end) throw;
    problems_.add(step, error.what(), error.hint());
    return {};
  }
}

std::uint32_t ShapeBuilder::cellsOf(const Quantity& quantity) {
  const Allowed allowed{{1, kMaxClothCells}, kCellsInWords};
  const double cells = formulas_.fixed(quantity, allowed).value_or(1);
  if (cells != std::floor(cells))
    problems_.add(quantity.place(), fmt::format("this is {}; it must be {}", cells, kCellsInWords));
  return static_cast<std::uint32_t>(cells);
}

void ShapeBuilder::addPins(const ClothPinDesc& pin, Cloth& cloth) {
  if (pin.name.empty()) {
    const double u = formulas_.fixed(pin.point[0], kFraction).value_or(0);
    const double v = formulas_.fixed(pin.point[1], kFraction).value_or(0);
    cloth.pins.emplace_back(u, v);
    return;
  }
  // Corners are the ends of edges, and edges all points of them.
  constexpr std::array<Domain, keys::kClothPins.size()> kHeld{{{{0, 0}, {0, 0}},
                                                               {{1, 1}, {0, 0}},
                                                               {{0, 0}, {1, 1}},
                                                               {{1, 1}, {1, 1}},
                                                               {{0, 1}, {0, 0}},
                                                               {{0, 1}, {1, 1}},
                                                               {{0, 0}, {0, 1}},
                                                               {{1, 1}, {0, 1}}}};
  const auto name = std::ranges::find(keys::kClothPins, pin.name.text);
  if (name == keys::kClothPins.end())
    throw Error(ErrorKind::Scene, fmt::format("a cloth has no corner or edge '{}'", pin.name.text));
  const Domain& held = kHeld[static_cast<std::size_t>(name - keys::kClothPins.begin())];
  const auto points = [](const Interval& range, std::uint32_t cells) {
    return range.width() > 0 ? cells : 0;
  };
  const std::uint32_t alongU = points(held.u, cloth.columns), alongV = points(held.v, cloth.rows);
  for (std::uint32_t j = 0; j <= alongV; ++j)
    for (std::uint32_t i = 0; i <= alongU; ++i)
      cloth.pins.emplace_back(alongU > 0 ? static_cast<double>(i) / alongU : held.u.lo,
                              alongV > 0 ? static_cast<double>(j) / alongV : held.v.lo);
}

ShapeBuilder::MovingPaint ShapeBuilder::buildPaint(const MaterialDesc& material, const Surface& surface) {
  const Quantity3& color = material.diffuse;
  const Quantity& opacity = material.opacity;
  MovingPaint paint;
  const bool opacityVaries = opacity.isFormula() && readOpacity(material, surface, paint.opacity);
  if (!opacity.isFormula()) paint.opacity = formulas_.number(opacity, kFraction);
  if (!opacityVaries && material.isolines.empty() && std::ranges::none_of(color, &Quantity::isFormula)) {
    paint.uniform = formulas_.vector(color, kLight);
    return paint;
  }
  std::vector<Quantity> written(color.begin(), color.end());
  if (opacityVaries) written.push_back(opacity);
  const std::size_t ofPaint = written.size();
  appendQuantities(material.isolines, written);
  const FormulaSet formulas({.formulas = written, .let = material.let, .onSurface = true, .surface = surface},
                            variables_);
  formulas.reportTo(problems_);
  if (!formulas.ok()) return {};
  if ((formulas.readsSurface() || needDomain(material.isolines)) && !surface.valid())
    return {.readsSurface = true, .readsNames = formulas.readsSurface()};
  const std::vector<Expr> c = continued(formulas.graph(), formulas.values());
  for (std::size_t i = 0; i < ofPaint; ++i)
    if (c[i].isConstant() && !formulas_.accept(written[i], c[i].constant(), i < 3 ? kLight : kFraction))
      return {};
  const std::size_t problemsBefore = problems_.count();
  const std::vector<Isolines> lines =
      isolinesOf(material.isolines, std::span(c).subspan(ofPaint), formulas.u(), formulas.v(),
                 surface.isParametric() ? surface.domain() : Domain{{0, 1}, {0, 1}}, formulas_);
  if (problems_.count() > problemsBefore) return {};
  const std::size_t parameters = formulas.parameters().size();
  if (!lines.empty()) {
    paint.isolines = IsolineSet(formulas.graph(), lines, parameters);
    paint.isolineParameters = formulas.parameters();
  }
  // What u and v are in is not always what depends on them: 0.5 + 0 * v.
  if (!formulas.varies(ofPaint)) {
    const Animated<Vec3> uniform = uniformOf(formulas);
    paint.uniform = uniform.isConstant() ? uniform : formulas_.guarded(color, kLight, uniform);
    return paint;
  }
  const std::array<Expr, 3> colors{c[0], c[1], c[2]};
  paint.pattern = opacityVaries ? Pattern(formulas.graph(), std::array{c[0], c[1], c[2], c[3]}, parameters)
                                : Pattern(formulas.graph(), colors, parameters);
  paint.parameters = formulas.parameters();
  return paint;
}

/// Whether it depends on u, v or a surface that is not known yet; else its value is known.
bool ShapeBuilder::readOpacity(const MaterialDesc& material, const Surface& surface,
                               Animated<double>& value) {
  const Quantity& opacity = material.opacity;
  const FormulaSet formula(
      {.formulas = {opacity, opacity, opacity}, .let = material.let, .onSurface = true, .surface = surface},
      variables_);
  if (!formula.ok()) {
    formula.reportTo(problems_);
    return false;
  }
  if (formula.varies(1) || (formula.readsSurface() && !surface.valid())) return true;
  const Expr one = formula.values()[0];
  const Animated<Vec3> uniform = uniformOf(formula);
  if (one.isConstant())
    value = formulas_.accept(opacity, one.constant(), kFraction) ? one.constant() : 1.0;
  else
    value = formulas_.guarded(opacity, kFraction,
                              {[uniform](const Moment& moment) { return uniform.at(moment).x; },
                               uniform.movesWithTime() ? DependsOn::Both : DependsOn::Parameters});
  return false;
}

std::optional<Displacement> ShapeBuilder::buildDisplacement(const MaterialDesc& material) {
  const Quantity& written = material.displacement;
  const FormulaSet formulas({.formulas = {written}, .let = material.let, .onSurface = true}, variables_);
  formulas.reportTo(problems_);
  if (!formulas.ok()) return std::nullopt;
  if (formulas.readsSurface()) {
    problems_.add(written.place(),
                  "a displacement cannot use the place, normal or curvature of the surface that it moves",
                  "write it with u and v");
    return std::nullopt;
  }
  const std::vector<Expr> height = continued(formulas.graph(), formulas.values());
  if (height[0].isConstant() &&
      (!formulas_.accept(written, height[0].constant(), kPlace) || height[0].constant() == 0))
    return std::nullopt;
  return Displacement{Tape(formulas.graph(), height), formulas.parameters()};
}

Surface ShapeBuilder::displace(const SurfaceDesc& desc, const Surface& surface, const MaterialDesc& material,
                               const Displacement& displacement, FilePlace place) {
  try {
    Surface moved = displaced(surface, displacement, {0, *variables_.initial()});
    if (warnings_ && about_ == WarningsAbout::All)
      warn(material.displacement.place(),
           fmt::format("surface '{}', displaced by material '{}',", desc.name.text, material.name.text),
           moved);
    return moved;
  } catch (const Error& error) {
    problems_.add(place, error.what(), error.hint());
    return {};
  }
}

void ShapeBuilder::warn(FilePlace place, const std::string& what, const Surface& surface) {
  const SourceRange where = rangeOf(place);
  std::vector<double> parameters;
  for (const Animated<double>& parameter : surface.parameters())
    parameters.push_back(parameter.at({0, *variables_.initial()}));
  const Domain& whole = surface.domain();
  for (const Domain& hole : surface.holes(parameters)) {
    const bool all = covers(hole.u, whole.u) && covers(hole.v, whole.v);
    const bool inParts = hasPoints(surface, parameters, hole);
    const char* lacks = isTiny(hole.u, whole.u) && isTiny(hole.v, whole.v) ? "lacks a point"
                        : !all                                             ? "has a hole"
                        : inParts                                          ? "ends inside of its rectangle"
                                                                           : "has no points";
    warnings_->push_back({where,
                          fmt::format("{} {}: its formula has no value in {}u {}, v {}", what, lacks,
                                      inParts ? "parts of " : "", shown(hole.u), shown(hole.v)),
                          all && !inParts ? "check the formula and its ranges" : "the rest of it is drawn"});
  }
  if (lacksArea(surface, parameters))
    warnings_->push_back({where,
                          fmt::format("{} has no area{}", what, parameters.empty() ? "" : " at time 0"),
                          "let its position depend on u and on v, in two directions"});
  if (std::ranges::any_of(surface.patches(),
                          [](const Patch& p) { return !p.function->guardAtIntegers.empty(); }))
    warnings_->push_back({where, fmt::format("{} has kinks or jumps", what),
                          "abs, min, max, floor, sign, mod, clamp, if and comparisons make them"});
}

}  // namespace luxo
