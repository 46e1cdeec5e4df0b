// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "base/assert.h"
#include "base/error.h"
#include "formula/parse.h"
#include "formula/tape.h"
#include "fuzz/target.h"

namespace luxo {
namespace {

constexpr std::array<double, 4> kGridU = {-1.5, 0, 0.75, 2}, kGridV = {-3, -0.5, 0, 1};
constexpr std::array<double, 1> kParameters = {3};

void checkDiagnostics(std::string_view text, const Formula& formula) {
  LUXO_REQUIRE_COMPARE(formula.diagnostics.size(), <=, kMaxFormulaErrors);
  for (const Diagnostic& d : formula.diagnostics) {
    LUXO_REQUIRE_COMPARE(d.where.begin, <=, d.where.end);
    LUXO_REQUIRE_COMPARE(d.where.end, <=, text.size());
    LUXO_REQUIRE(!d.message.empty());
    LUXO_REQUIRE_COMPARE(describe("fuzz", text, d).size(), <, 4096u);
  }
  if (formula.ok)
    LUXO_REQUIRE(formula.diagnostics.empty());
  else
    LUXO_REQUIRE(formula.value.isConstant() && std::isnan(formula.value.constant()));
}

bool sameNumber(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
         (std::isnan(a) && std::isnan(b));
}

// A grid is its points, and every value lies in the bound of a box that holds its point.
void checkValues(const Tape& tape) {
  std::vector<double> u, v;
  for (const double y : kGridV)
    for (const double x : kGridU) {
      u.push_back(x);
      v.push_back(y);
    }
  const auto points = tape.evaluate(u, v, kParameters);
  const auto grid = tape.evaluateGrid(kGridU, kGridV, kParameters);
  std::vector<Interval> whole(tape.outputCount()), one(tape.outputCount());
  tape.bound({kGridU.front(), kGridU.back()}, {kGridV.front(), kGridV.back()}, kParameters, whole);
  for (std::size_t i = 0; i < u.size(); ++i) {
    tape.bound(u[i], v[i], kParameters, one);
    for (std::size_t k = 0; k < tape.outputCount(); ++k) {
      const double value = points[k][i];
      LUXO_REQUIRE(sameNumber(value, grid[k][i]));
      for (const Interval& bound : {whole[k], one[k]}) {
        LUXO_REQUIRE_COMPARE(bound.lo, <=, bound.hi);
        // A bounded interval says that the formula is defined there.
        if (std::isnan(value))
          LUXO_REQUIRE(!std::isfinite(bound.lo) || !std::isfinite(bound.hi));
        else
          LUXO_REQUIRE(bound.contains(value));
      }
    }
  }
}

}  // namespace

void fuzzFormula(std::string_view input) {
  Graph graph;
  Scope scope;
  scope.bind("u", graph.variable(0));
  scope.bind("v", graph.variable(1));
  scope.bind("k", graph.variable(2));
  scope.explainAbsence("w", "there is none");

  const std::size_t firstEnd = std::min(input.find('\n'), input.size());
  const std::string_view text = input.substr(0, firstEnd);
  std::vector<std::pair<std::string, std::string>> definitions;
  for (std::size_t begin = firstEnd + 1; begin < input.size();) {
    const std::size_t end = std::min(input.find('\n', begin), input.size());
    const std::string_view line = input.substr(begin, end - begin);
    const std::size_t equals = std::min(line.find('='), line.size());
    definitions.emplace_back(line.substr(0, equals), line.substr(std::min(equals + 1, line.size())));
    if (const auto problem = scope.nameProblem(definitions.back().first)) {
      LUXO_REQUIRE(!problem->message.empty());
      definitions.pop_back();
    } else {
      scope.define(definitions.back().first, definitions.back().second);
    }
    begin = end + 1;
  }

  try {
    const Formula formula = parse(text, scope);
    checkDiagnostics(text, formula);
    for (const auto& [name, definition] : definitions) checkDiagnostics(definition, scope.definition(name));
    if (!formula.ok) return;
    const Expr f = formula.value, fu = graph.derivative(f, 0), fv = graph.derivative(f, 1);
    const std::vector<Expr> outputs = {
        f, fu, fv, graph.derivative(fu, 0), graph.derivative(fu, 1), graph.derivative(fv, 1)};
    for (const Kink& kink : graph.kinks(outputs)) LUXO_REQUIRE(!kink.guard.isConstant());
    checkValues(Tape(graph, outputs));
  } catch (const Error& error) {
    LUXO_REQUIRE(error.kind() == ErrorKind::Scene);  // a graph that is full
  }
}

}  // namespace luxo
