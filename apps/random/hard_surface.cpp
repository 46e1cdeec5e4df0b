// SPDX-License-Identifier: Apache-2.0
#include "random/hard_surface.h"

#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "surface/catalogue.h"

namespace luxo::random {
namespace {

using Text = std::string;
using Point = std::array<Text, 3>;

/// fmt::format, but written with braces: what stands in them is evaluated from left to right by every
/// compiler, so that random numbers are drawn in one order. Calls with parentheses draw at most one.
struct Written : Text {
  template <class... Values>
  explicit Written(fmt::string_view form, const Values&... values)
      : Text(fmt::vformat(form, fmt::make_format_args(values...))) {}
};

/// A number as formulas have it: in brackets where it is negative.
Text number(double value) {
  const double r = rounded(value);
  return r < 0 ? fmt::format("({})", r) : fmt::format("{}", r);
}

Json formula(const Json& u, const Json& v, const Point& position, Json let = Json()) {
  Json surface = {{"type", "formula"}, {"u", u}, {"v", v}, {"position", position}};
  if (!let.empty()) surface["let"] = std::move(let);
  return surface;
}

Json range(double low, double high) { return Json::array({rounded(low), rounded(high)}); }
Json wholeTurn() { return Json::array({0, "tau"}); }

/// From -x to y, each of low..high.
Json aroundZero(Numbers& n, double low, double high) {
  const double x = n.between(low, high);
  return range(-x, n.between(low, high));
}

/// An interval of about one unit somewhere around 0.
Json someRange(Numbers& n) {
  const double low = n.between(-1.5, 0);
  return range(low, low + n.between(0.7, 2.5));
}

/// a * sin(argument + phase), or cos.
struct Wave : Text {
  Wave(Numbers& n, const Text& amplitude, const Text& argument)
      : Text(Written{"{}*{}({}+{})", amplitude, n.chance(0.5) ? "sin" : "cos", argument,
                     number(n.between(0, 6.28))}) {}
};

/// `terms` waves over the torus of (u, v): whole frequencies up to `most`.
Text closedSines(Numbers& n, int terms, int most) {
  Text sum;
  for (int k = 0; k < terms; ++k) {
    int alongU = n.whole(0, most);
    const int alongV = n.whole(0, most);
    if (alongU == 0 && alongV == 0) alongU = 1;  // no wave: of three that are none the surface is a point
    const Text argument = Written{"{}*u+{}*v", alongU, alongV};
    sum += (k == 0 ? "" : "+") + Wave{n, number(n.between(0.08, 0.5)), argument};
  }
  return sum;
}

Text openSines(Numbers& n, int terms, double most) {
  Text sum;
  for (int k = 0; k < terms; ++k) {
    const double fu = n.between(-most, most), fv = n.between(-most, most);
    const double amplitude = n.between(0.2, 1) / (1 + 0.5 * (std::abs(fu) + std::abs(fv)));
    sum += (k == 0 ? "" : "+") + Wave{n, number(amplitude), Written{"{}*u+{}*v", number(fu), number(fv)}};
  }
  return sum;
}

Json sinesClosed(Numbers& n) {
  const int terms = n.whole(1, 4), most = n.whole(2, 6);
  Point p;
  for (Text& x : p) x = closedSines(n, terms, most);
  return formula(wholeTurn(), wholeTurn(), p);
}

Json sinesOpen(Numbers& n) {
  const int terms = n.whole(1, 3);
  const double most = n.between(2, 9);
  Point p;
  for (Text& x : p) x = openSines(n, terms, most);
  if (n.chance(0.5)) p[0] = "u+" + p[0];
  if (n.chance(0.5)) p[2] = "v+" + p[2];
  const Json u = someRange(n);
  return formula(u, someRange(n), p);
}

Json roll(Numbers& n) {
  const double turns = n.chance(0.5) ? n.between(2, 7) : n.magnitude(0.6, 40),
               first = n.chance(0.3) ? n.between(-20, 20) : 0;
  const double inner = n.between(0, 0.4), pitch = n.signedBetween(0.2, 1) / turns / 6.283;
  const double flat = n.chance(0.2) ? n.between(0.3, 1) : 1,
               skew = n.chance(0.2) ? n.between(-0.05, 0.05) : 0;
  Json let = {
      {"r", Written{"{}+{}*(u-{})", number(inner + (pitch < 0 ? 1 : 0.05)), number(pitch), number(first)}}};
  if (n.chance(0.15))
    let["r"] = Written{"exp({}*(u-{}))", number(n.between(0.5, 2) / turns / 6.283), number(first)};
  const Point p = {"r*cos(u)", skew == 0 ? Text("v") : Written{"v+{}*u", number(skew)},
                   Written{"{}*r*sin(u)", number(flat)}};
  return formula(range(first, first + turns * 6.283), aroundZero(n, 0.1, 2), p, let);
}

/// A sheet that turns back over itself in waves, straight along v or nearly.
Json fold(Numbers& n) {
  const double k = n.between(3, 25), overhang = n.between(0.5, 3) / k, height = n.magnitude(0.005, 0.5);
  Point p = {Written{"u+{}*sin({}*u)", number(overhang), number(k)},
             Written{"{}*cos({}*u+{})", number(height), number(n.chance(0.6) ? k : 2 * k),
                     number(n.between(0, 6.28))},
             "v"};
  if (n.chance(0.4)) p[1] += "+" + Wave{n, number(n.magnitude(0.001, 0.3)), number(n.between(1, 12)) + "*v"};
  if (n.chance(0.3)) p[0] += "+" + Wave{n, number(n.magnitude(0.001, 0.1)), number(n.between(1, 12)) + "*v"};
  const Json u = someRange(n);
  return formula(u, someRange(n), p);
}

/// Corrugated board: waves straight along v, or nearly, up to a thousand of them, as steep as one looks down
/// on them.
Json corrugated(Numbers& n) {
  const double waves = n.magnitude(4, 1200), slope = n.magnitude(0.35, 3), k = 6.2832 * waves;
  Text height = Written{"{}*cos({}*u)", number(slope / k), number(k)};
  if (n.chance(0.25)) height += "+" + Written{"{}*cos({}*u)", number(0.3 * slope / k), number(3 * k)};
  if (n.chance(0.25))
    height += "+" + Wave{n, number(n.magnitude(0.001, 0.1)), number(n.between(1, 6)) + "*v"};
  const Json v = aroundZero(n, 0.1, 1);
  if (n.chance(0.2))
    return formula(range(0, 1), v, {"r*cos(6.2832*u)", "v", "r*sin(6.2832*u)"}, {{"r", "0.5+" + height}});
  return formula(range(0, 1), v, {"u-0.5", height, n.chance(0.5) ? "v" : "-v"});
}

/// Small things made of large numbers: phases of hundreds, as time makes them, and differences of radii.
Json cancelling(Numbers& n) {
  const double radius = n.magnitude(5, 300), half = n.between(0.1, 1);
  const Json u = aroundZero(n, half, half), v = aroundZero(n, 0.1, 1);
  if (n.chance(0.3))
    return formula(
        u, v,
        {Written{"{0}*cos(u/{0})-{0}", number(radius)}, "v", Written{"{0}*sin(u/{0})", number(radius)}});
  if (n.chance(0.4)) return formula(u, v, {"u", Written{"{0}-sqrt({0}^2-u^2-v^2)", number(radius)}, "v"});
  Text wave = Written{"{}*sin({}*u+{})", number(n.magnitude(0.02, 0.3)), number(n.between(2, 20)),
                      number(n.magnitude(30, 3000))};
  if (n.chance(0.4)) wave += Written{"*cos({}*v-{})", number(n.between(1, 6)), number(n.magnitude(30, 3000))};
  return formula(u, v, {"u", wave, "v"});
}

/// A sheet with displacements of all sizes, smaller where they are finer.
Json crumple(Numbers& n) {
  Point p = {"u", "0", "v"};
  const int octaves = n.whole(2, 4);
  const double strength = n.between(0.3, 1.6);
  for (Text& x : p)
    for (int k = 0; k < octaves; ++k) {
      const double f = n.between(1.5, 2.5) * std::exp2(k), turn = n.between(0, 6.28);
      x += "+" + Wave{n, number(strength * n.between(0.3, 1) / f),
                      Written{"{}*u+{}*v", number(f * std::cos(turn)), number(f * std::sin(turn))}};
    }
  const Json u = someRange(n);
  return formula(u, someRange(n), p);
}

/// The stable singularities of fronts and of maps, and a few that are not stable; by their normal forms.
Json singular(Numbers& n) {
  const Point kForms[] = {
      {"3*v^4+u*v^2", "-4*v^3-2*u*v", "u"},       // swallowtail
      {"u", "v^2", "v^3"},                        // cuspidal edge
      {"u", "v^2", "u*v^3"},                      // cuspidal cross-cap
      {"u", "v^3-u*v", "v^4-u*v^2/2"},            // swallowtail, another section
      {"u", "v^3+u^2*v", "v^2"},                  // lips over a fold
      {"u", "v^3-u^2*v", "v^2"},                  // beaks
      {"u^2-v^2+u", "2*u*v-v", "u^3/3-u*v^2"},    // purse
      {"u*v", "v^2", "u"},                        // Whitney's umbrella
      {"u^3-3*u*v^2", "3*u^2*v-v^3", "u^2+v^2"},  // a branch point
      {"5*v^4+2*u*v", "4*v^5+u*v^2", "u"},        // butterfly
  };
  Point p = n.oneOf(kForms);
  const double reach = n.between(0.5, 1.2);
  const Text strength = number(n.magnitude(0.01, 0.3));
  if (n.chance(0.4)) p[1] += "+" + Wave{n, strength, Written{"{}*u", number(n.between(1, 6))}};
  const Json u = range(-reach, n.between(0.5, 1.2));
  return formula(u, range(-reach, n.between(0.5, 1.2)), p);
}

Json power(Numbers& n) {
  const int high = n.whole(4, 11);
  Point p = {"u",
             Written{"{}*u^{}+{}*v^{}", number(n.signedBetween(0.3, 3)), high, number(n.signedBetween(0, 2)),
                     n.whole(2, 9)},
             "v"};
  if (n.chance(0.4)) p[0] = Written{"u^{}", n.whole(2, 9)};
  if (n.chance(0.3)) p[2] = Written{"v^3-{}*v", number(n.between(0, 0.6))};
  if (n.chance(0.3)) p[1] += Written{"-u^{}*v^{}", n.whole(1, 5), n.whole(1, 5)};
  const Json u = aroundZero(n, 0.6, 1.3);
  return formula(u, aroundZero(n, 0.6, 1.3), p);
}

/// A tube about a closed curve that winds p times around Y and q times through the ring: thick enough, often,
/// to touch or pass through itself. Its sections are not perpendicular to the curve. Every other one is a
/// figure of eight, half of which is inside out: who looks from outside sees inner sides. No number is drawn
/// for it, so that all other scenes stay what they were.
Json knot(Numbers& n) {
  const int p = n.whole(1, 4), q = n.whole(1, 7);
  const double minor = n.between(0.2, 0.9), tube = n.between(0.05, 0.5);
  const bool isEight = (p + q) % 2 == 0;
  const Json let = {{"b", Written{"{}+{}*cos({}*u)", number(n.between(0.9, 1.3)), number(minor), q}},
                    {"r", Written{"b+{}*cos(v)", number(tube)}}};
  const Text y = Written{"{}*sin({}*u)+{}*sin({})", number(minor), q, number(tube), isEight ? "2*v" : "v"};
  return formula(wholeTurn(), wholeTurn(), {Written{"r*cos({}*u)", p}, y, Written{"r*sin({}*u)", p}}, let);
}

/// Coils that touch: the rise of a turn is the thickness of the wire, or nearly.
Json coil(Numbers& n) {
  const double tube = n.between(0.05, 0.3), turns = n.between(1.5, 9);
  const double slack = n.oneOf({1.0, 1.0, 1.001, 0.999, 1.02, 0.9});
  const Json let = {{"r", Written{"1+{}*cos(v)", number(tube)}}};
  const Text y = Written{"{}*sin(v)+{}*u", number(tube), number(2 * tube * slack / kTau)};
  return formula(range(0, turns * 6.283), wholeTurn(), {"r*cos(u)", y, "r*sin(u)"}, let);
}

/// (1 - v) a(u) + v b(u)
Json ruled(Numbers& n) {
  Json let;
  Point p;
  const bool helix = n.chance(0.3);
  const Text frequency = number(n.between(1, 12));
  for (int i = 0; i < 3; ++i) {
    const auto along = [&] {  // curves: waves in u alone
      Text sum = number(n.between(-0.6, 0.6));
      for (int k = n.whole(1, 2); k > 0; --k)
        sum += "+" + Wave{n, number(n.between(0.1, 0.7)), Written{"{}*u", number(n.between(0.5, 7))}};
      return sum;
    };
    const Text a = Written{"a{}", i}, b = Written{"b{}", i};
    let[a] = along();
    let[b] = along();
    p[static_cast<std::size_t>(i)] = Written{"(1-v)*{}+v*{}", a, b};
  }
  if (helix) {
    let = Json{{"a", Written{"{}*u", frequency}}};
    p = {"v*cos(a)", Written{"u+{}*v", number(n.between(-0.5, 0.5))}, "v*sin(a)"};
  }
  const Json u = someRange(n);
  const double low = n.between(0, 0.6);
  return formula(u, range(-low, n.between(0.4, 1.4)), p, let);
}

/// A surface of the catalogue with some of its arguments moved; with its own where these do not go together.
Json named(Numbers& n) {
  const CatalogueEntry& entry = n.oneOf(catalogue());
  const Json plain = {{"type", entry.name}};
  Json changed = plain;
  std::vector<SurfaceArgument> arguments;
  for (const CatalogueArgument& argument : entry.arguments) {
    if (n.chance(0.5)) continue;
    std::vector<double> values;
    for (const double initial : argument.initial) {
      double value = argument.kind == ArgumentKind::Count ? initial + n.whole(-1, 2)
                                                          : rounded(initial * n.magnitude(0.5, 2));
      values.push_back(std::min(std::max(value, argument.range.lo), argument.range.hi));
    }
    arguments.push_back({std::string(argument.name), {values.begin(), values.end()}});
    changed[std::string(argument.name)] = values.size() == 1 ? Json(values[0]) : Json(values);
  }
  try {
    static_cast<void>(makeSurface(entry, arguments));
    return changed;
  } catch (const Error&) {
    return plain;
  }
}

struct Base {
  Json u, v;
  Point position;
};

/// What is deformed: textbook surfaces about one metre across.
Base base(Numbers& n) {
  const Json turn = wholeTurn();
  const Base kBases[] = {
      {turn, Json::array({"-pi/2", "pi/2"}), {"cos(v)*cos(u)", "sin(v)", "-cos(v)*sin(u)"}},
      {turn, turn, {"(1+0.4*cos(v))*cos(u)", "0.4*sin(v)", "-(1+0.4*cos(v))*sin(u)"}},
      {turn, Json::array({-1, 1}), {"0.7*cos(u)", "v", "-0.7*sin(u)"}},
      {turn, Json::array({-0.4, 0.4}), {"(1+v*cos(u/2))*cos(u)", "v*sin(u/2)", "-(1+v*cos(u/2))*sin(u)"}},
      {turn,
       turn,
       {"(1.2+0.5*(cos(u/2)*sin(v)-sin(u/2)*sin(2*v)))*cos(u)", "0.5*(sin(u/2)*sin(v)+cos(u/2)*sin(2*v))",
        "-(1.2+0.5*(cos(u/2)*sin(v)-sin(u/2)*sin(2*v)))*sin(u)"}},
      {Json::array({-1.2, 1.2}),
       Json::array({-1.2, 1.2}),
       {"0.6*(u-u^3/3+u*v^2)", "0.6*(u^2-v^2)", "0.6*(v-v^3/3+v*u^2)"}},
      {Json::array({-3, 3}), Json::array({-1, 1}), {"v*cos(2*u)", "0.3*u", "v*sin(2*u)"}},
      {turn, Json::array({-1, 1}), {"0.5*cosh(v)*cos(u)", "0.6*v", "-0.5*cosh(v)*sin(u)"}},
      {turn, Json::array({0, 2.5}), {"cos(u)/cosh(v)", "v-tanh(v)", "-sin(u)/cosh(v)"}},
      {turn,
       Json::array({0, "pi/2"}),
       {"sin(v)*cos(v)*sin(u)", "sin(v)^2*sin(2*u)/2", "sin(v)*cos(v)*cos(u)"}},
      {Json::array({0, "2*tau"}),
       turn,
       {"exp(0.12*u)*(0.3+0.25*cos(v))*cos(u)", "exp(0.12*u)*(0.25*sin(v)+0.5)",
        "exp(0.12*u)*(0.3+0.25*cos(v))*sin(u)"}},
  };
  return n.oneOf(kBases);
}

/// A base, then up to three of: waves across, a twist, a taper, a bend.
Json deformed(Numbers& n) {
  const Base b = base(n);
  Json let;
  for (int i = 0; i < 3; ++i) let[Written{"p{}", i}] = b.position[static_cast<std::size_t>(i)];
  Point p = {"p0", "p1", "p2"};
  for (int step = n.whole(1, 3), k = 1; k <= step; ++k) {
    const Point from = p;
    for (int i = 0; i < 3; ++i) p[static_cast<std::size_t>(i)] = Written{"p{}", 3 * k + i};
    Point next = from;
    const Text strength = number(n.signedBetween(0.1, 1.5)), phase = number(n.between(0, 6.28));
    switch (n.whole(0, 3)) {
      case 0: {  // waves
        const auto i = static_cast<std::size_t>(n.whole(0, 2)), j = (i + 1) % 3;
        next[i] = Written{"{}+{}*sin({}*{}+{})",    from[i], number(n.magnitude(0.02, 0.4)),
                          number(n.between(2, 14)), from[j], phase};
        break;
      }
      case 1:  // twist about Y
        next[0] =
            Written{"{}*cos({}*{})-{}*sin({}*{})", from[0], strength, from[1], from[2], strength, from[1]};
        next[2] =
            Written{"{}*sin({}*{})+{}*cos({}*{})", from[0], strength, from[1], from[2], strength, from[1]};
        break;
      case 2:  // taper along Y
        next[0] = Written{"{}*(1+{}*{})", from[0], strength, from[1]};
        next[2] = Written{"{}*(1+{}*{})", from[2], strength, from[1]};
        break;
      default:  // bend in the X-Y plane
        next[0] = Written{"(1.5+{})*sin({}*{})", from[1], strength, from[0]};
        next[1] = Written{"(1.5+{})*cos({}*{})", from[1], strength, from[0]};
    }
    for (std::size_t i = 0; i < 3; ++i) let[p[i]] = next[i];
  }
  return formula(b.u, b.v, p, let);
}

Json kinked(Numbers& n) {
  const auto line = [&] {
    return Written{"{}*u+{}*v+{}", number(n.between(-2, 2)), number(n.between(-2, 2)),
                   number(n.between(-0.5, 0.5))};
  };
  const auto bent = [&]() -> Text {
    switch (n.whole(0, 7)) {
      case 0:
        return Written{"{}*max(abs(u),abs(v))", number(n.signedBetween(0.2, 1.2))};
      case 1:
        return Written{"{}*(abs(u)+abs(v))", number(n.signedBetween(0.2, 1.2))};
      case 2:
        return Written{"{}*abs(sin({}*u))", number(n.signedBetween(0.1, 0.6)), number(n.between(1, 9))};
      case 3:
        return Written{"min({},{})", line(), line()};
      case 4:
        return Written{"max(sin({}*u),cos({}*v))/3", number(n.between(1, 6)), number(n.between(1, 6))};
      case 5:
        return Written{"abs(u^2+v^2-{})", number(n.between(0.1, 0.9))};
      case 6:
        return Written{"abs(sin({}*u)*cos({}*v))/2", number(n.between(1, 7)), number(n.between(1, 7))};
      default:
        return Written{"max({},{})-abs({})", line(), line(), line()};
    }
  };
  Point p = {"u", bent(), "v"};
  if (n.chance(0.25)) p[0] = "u+" + bent();
  const Json u = range(-1, n.between(0.5, 1.2));
  return formula(u, range(-n.between(0.5, 1.2), 1), p);
}

}  // namespace

std::span<const SurfaceKind> surfaceKinds() {
  static constexpr std::array kKinds = {
      SurfaceKind{"sines_closed", "sums of sines over a torus, that pass through themselves", sinesClosed},
      SurfaceKind{"roll", "a sheet rolled up, to 40 turns", roll},
      SurfaceKind{"kinked", "max, abs, min", kinked},
      SurfaceKind{"named", "the catalogue with other arguments", named},
      SurfaceKind{"sines_open", "sums of sines with borders", sinesOpen},
      SurfaceKind{"fold", "a sheet in folds that hang over", fold},
      SurfaceKind{"deformed", "textbook surfaces twisted, bent, tapered, waved", deformed},
      SurfaceKind{"crumple", "a sheet with folds of all sizes", crumple},
      SurfaceKind{"singular", "swallowtails, cusps, umbrellas", singular},
      SurfaceKind{"power", "u^9 and the like", power},
      SurfaceKind{"knot", "tubes about knots, that touch and pass through themselves", knot},
      SurfaceKind{"coil", "turns of a wire that touch", coil},
      SurfaceKind{"ruled", "straight lines between two curves", ruled},
      SurfaceKind{"corrugated", "waves straight along one parameter, down to parts of a pixel", corrugated},
      SurfaceKind{"cancelling", "small things made of large numbers", cancelling},
  };
  return kKinds;
}

}  // namespace luxo::random
