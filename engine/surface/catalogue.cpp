// SPDX-License-Identifier: Apache-2.0
#include "surface/catalogue.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>

#include "base/assert.h"
#include "base/error.h"
#include "base/suggestion.h"
#include "surface/catalogue_inputs.h"

namespace luxo {
namespace {

[[noreturn]] void refuse(const CatalogueEntry& entry, const std::string& what, const std::string& hint) {
  throw Error(ErrorKind::Scene, fmt::format("{}: {}", entry.name, what), hint);
}

std::string componentName(const CatalogueArgument& argument, std::size_t component) {
  return argument.initial.size() == 1 ? std::string(argument.name)
                                      : fmt::format("{}[{}]", argument.name, component);
}

std::string allowed(const CatalogueArgument& argument) {
  const auto [lo, hi] = argument.range;
  switch (argument.kind) {
    case ArgumentKind::Length:
      return fmt::format("a length from {} to {} metres", lo, hi);
    case ArgumentKind::Angle:
      return fmt::format("an angle from {} to {} radians", lo, hi);
    case ArgumentKind::Count:
      return fmt::format("a whole number from {} to {}", lo, hi);
    case ArgumentKind::Number:
      break;
  }
  return fmt::format("a number from {} to {}", lo, hi);
}

std::vector<std::string> argumentNames(const CatalogueEntry& entry) {
  std::vector<std::string> names;
  for (const CatalogueArgument& a : entry.arguments) names.emplace_back(a.name);
  return names;
}

/// The argument that component `index` belongs to, and which of its components it is.
std::pair<const CatalogueArgument*, std::size_t> argumentAt(const CatalogueEntry& entry, std::size_t index) {
  for (const CatalogueArgument& argument : entry.arguments) {
    if (index < argument.initial.size()) return {&argument, index};
    index -= argument.initial.size();
  }
  LUXO_REQUIRE(false && "a component of an argument");
  return {};
}

}  // namespace

CatalogueValues::CatalogueValues(const CatalogueEntry& entry, std::span<const SurfaceArgument> arguments)
    : entry_(&entry) {
  for (const CatalogueArgument& argument : entry.arguments)
    components_.insert(components_.end(), argument.initial.begin(), argument.initial.end());
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    take(arguments[i]);
    for (std::size_t j = 0; j < i; ++j)
      if (arguments[j].name == arguments[i].name)
        refuse(entry, fmt::format("{} is given twice", arguments[i].name), "give it once");
  }
  if (std::all_of(components_.begin(), components_.end(), [](const auto& c) { return c.isConstant(); }))
    checkRequirement(Moment());
}

std::size_t CatalogueValues::indexOf(std::string_view argument, std::size_t component) const {
  std::size_t index = 0;
  for (const CatalogueArgument& a : entry_->arguments) {
    if (a.name == argument) return index + component;
    index += a.initial.size();
  }
  LUXO_REQUIRE(false && "an argument of the entry");
  return 0;
}

void CatalogueValues::take(const SurfaceArgument& given) {
  const auto argument = std::find_if(entry_->arguments.begin(), entry_->arguments.end(),
                                     [&](const CatalogueArgument& a) { return a.name == given.name; });
  if (argument == entry_->arguments.end()) {
    const std::vector<std::string> names = argumentNames(*entry_);
    refuse(*entry_, fmt::format("there is no argument '{}'", given.name),
           didYouMean(given.name, names, fmt::format("its arguments are {}", listed(names))));
  }
  if (given.components.size() != argument->initial.size())
    refuse(*entry_,
           fmt::format("{} takes {} numbers, not {}", given.name, argument->initial.size(),
                       given.components.size()),
           fmt::format("{}: {}", given.name, argument->meaning));
  const std::size_t first = indexOf(given.name, 0);
  for (std::size_t i = 0; i < given.components.size(); ++i) {
    if (given.components[i].isConstant())
      checkRange(first + i, given.components[i].at(Moment()));
    else if (!argument->mayMove())
      refuse(*entry_, fmt::format("{} must be a constant", given.name),
             fmt::format("{} decides the formula itself; give {}", given.name, allowed(*argument)));
    components_[first + i] = given.components[i];
  }
}

void CatalogueValues::checkRange(std::size_t index, double value, std::optional<double> time) const {
  const auto [argument, component] = argumentAt(*entry_, index);
  const bool whole = argument->kind != ArgumentKind::Count || value == std::floor(value);
  if (!(argument->range.contains(value) && whole))
    refuse(*entry_,
           fmt::format("{} is {}{}", componentName(*argument, component), value,
                       time ? fmt::format(" at time {}", *time) : ""),
           fmt::format("{} must be {}", argument->name, allowed(*argument)));
}

void CatalogueValues::checkRequirement(const Moment& moment) const {
  if (!entry_->meets) return;
  std::vector<double> values;
  for (const auto& component : components_) values.push_back(component.at(moment));
  if (entry_->meets(values)) return;
  std::string given;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto [argument, component] = argumentAt(*entry_, i);
    given += fmt::format("{}{} {}", i ? ", " : "", componentName(*argument, component), values[i]);
  }
  refuse(*entry_, fmt::format("its arguments do not go together: {}", given),
         fmt::format("{} needs {}", entry_->name, entry_->requirement));
}

double CatalogueValues::at(std::size_t index, const Moment& moment) const {
  const double value = components_[index].at(moment);
  if (!std::isfinite(value)) return value;
  checkRange(index, value, moment.time);
  checkRequirement(moment);
  return value;
}

SurfaceInputs::SurfaceInputs(std::shared_ptr<const CatalogueValues> values, const Moment& start,
                             GeneralForms* made)
    : values_(std::move(values)), start_(start), made_(made), graph_(std::make_unique<Graph>()) {
  u_ = graph_->variable(0);
  v_ = graph_->variable(1);
  std::uint32_t next = 2;
  for (std::uint32_t i = 0; i < values_->entry().patchConstants; ++i)
    patchConstants_.push_back(graph_->variable(next++));
  for (const auto& component : values_->components())
    components_.push_back(component.isConstant() && !made_ ? Expr(component.at(Moment()))
                                                           : graph_->variable(next++));
}

SurfaceInputs::SurfaceInputs(std::shared_ptr<const CatalogueValues> values, const Moment& start,
                             GeneralForms forms)
    : SurfaceInputs(std::move(values), start, nullptr) {
  forms_ = std::move(forms);
}

SurfaceInputs::SurfaceInputs(std::shared_ptr<const CatalogueValues> values, GeneralForms& forms)
    : SurfaceInputs(std::move(values), Moment(), &forms) {}

Expr SurfaceInputs::operator()(std::string_view argument, std::size_t component) const {
  return components_[values_->indexOf(argument, component)];
}

std::optional<double> SurfaceInputs::constant(std::string_view argument, std::size_t component) const {
  const Animated<double>& value = values_->components()[values_->indexOf(argument, component)];
  return value.isConstant() ? std::optional(value.at(Moment())) : std::nullopt;
}

Expr SurfaceInputs::patchConstant(std::uint32_t index) const {
  LUXO_REQUIRE_COMPARE(index, <, patchConstants_.size());
  return patchConstants_[index];
}

GeneralForms SurfaceInputs::generalForms(const std::vector<Piece>& pieces) const {
  std::vector<GeneralForm::Argument> arguments;
  std::uint32_t parameters = 0;
  for (const Animated<double>& component : values_->components())
    if (component.isConstant())
      arguments.push_back({.value = component.at(Moment())});
    else
      arguments.push_back({.parameter = parameters++});
  GeneralForms forms;
  for (const Piece& piece : pieces) {
    const auto form =
        std::make_shared<const GeneralForm>(GeneralForm{Tape(*graph_, piece.position), arguments});
    forms.insert(forms.end(), piece.places.size(), form);
  }
  return forms;
}

Surface SurfaceInputs::assemble(const std::vector<Piece>& pieces, SurfaceTraits traits) const {
  if (made_) {
    *made_ = generalForms(pieces);
    return {};
  }
  std::vector<Patch> patches;
  for (const Piece& piece : pieces) {
    const auto function = compileSurface(*graph_, piece.position);
    for (const PatchPlace& place : piece.places) patches.push_back({function, place.domain, place.constants});
  }
  for (std::size_t i = 0; i < forms_.size(); ++i) patches[i].general = forms_[i];

  traits.name = std::string(values_->entry().name);
  std::vector<Animated<double>> initial, moving;
  for (std::size_t i = 0; i < components_.size(); ++i) {
    const Animated<double>& component = values_->components()[i];
    if (component.isConstant()) continue;
    initial.emplace_back(values_->at(i, start_));
    moving.emplace_back([values = values_, i](const Moment& moment) { return values->at(i, moment); },
                        component.movesWithTime() ? DependsOn::Both : DependsOn::Parameters);
  }
  const Surface surface(std::move(patches), std::move(initial), std::move(traits));
  return moving.empty() ? surface : surface.withParameters(std::move(moving));
}

Surface SurfaceInputs::surface(const ExprPoint& position, SurfaceTraits traits) const {
  return assemble({{position, {PatchPlace{}}}}, std::move(traits));
}

Surface SurfaceInputs::revolve(Expr radius, Expr height, SurfaceTraits traits) const {
  traits.revolution = true;
  return surface(point(radius * cos(phi()), height, -(radius * sin(phi()))), std::move(traits));
}

Surface SurfaceInputs::patchwork(const ExprPoint& position, const std::vector<PatchPlace>& places) const {
  return assemble({{position, places}}, {});
}

Surface SurfaceInputs::patchwork(const std::vector<PatchFormula>& formulas) const {
  std::vector<Piece> pieces;
  for (const PatchFormula& formula : formulas) pieces.push_back({formula.position, {{formula.domain}}});
  return assemble(pieces, {});
}

std::span<const CatalogueEntry> catalogue() {
  static const std::vector<CatalogueEntry> entries = [] {
    std::vector<CatalogueEntry> all;
    for (const auto family : {elementarySurfaces, algebraicSurfaces, curvatureSurfaces, oneSidedSurfaces,
                              superquadrics, tubeSurfaces})
      std::ranges::move(family(), std::back_inserter(all));
    return all;
  }();
  return entries;
}

const CatalogueEntry* findCatalogueEntry(std::string_view name) {
  const auto found = std::ranges::find(catalogue(), name, &CatalogueEntry::name);
  return found == catalogue().end() ? nullptr : &*found;
}

namespace {

Surface makeAnew(const CatalogueEntry& entry, std::span<const SurfaceArgument> arguments,
                 const Moment& start) {
  const auto values = std::make_shared<const CatalogueValues>(entry, arguments);
  GeneralForms forms;
  static_cast<void>(entry.make(SurfaceInputs(values, forms)));
  return entry.make(SurfaceInputs(values, start, std::move(forms)));
}

/// Made once, and kept: no scene compiles it again.
Surface asListed(const CatalogueEntry& entry) {
  static std::mutex mutex;
  static std::map<const CatalogueEntry*, Surface> made;
  const std::lock_guard lock(mutex);
  const auto known = made.find(&entry);
  return known != made.end() ? known->second : made.emplace(&entry, makeAnew(entry, {}, {})).first->second;
}

}  // namespace

Surface makeSurface(const CatalogueEntry& entry, std::span<const SurfaceArgument> arguments,
                    const Moment& start) {
  const auto all = catalogue();
  const bool listed = &entry >= all.data() && &entry < all.data() + all.size();
  return arguments.empty() && listed ? asListed(entry) : makeAnew(entry, arguments, start);
}

Surface makeSurface(std::string_view name, const std::vector<SurfaceArgument>& arguments,
                    const Moment& start) {
  if (const CatalogueEntry* entry = findCatalogueEntry(name)) return makeSurface(*entry, arguments, start);
  std::vector<std::string> names;
  for (const CatalogueEntry& entry : catalogue()) names.emplace_back(entry.name);
  throw Error(ErrorKind::Scene, fmt::format("there is no surface '{}'", name),
              didYouMean(name, names, fmt::format("the surfaces are {}", listed(names))));
}

}  // namespace luxo
