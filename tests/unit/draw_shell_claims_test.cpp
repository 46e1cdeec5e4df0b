// SPDX-License-Identifier: Apache-2.0
// What shells and skips claim of rays, held against certified rays: of random surfaces that pass through
// themselves, roll up, and are ruled, seen from anywhere outside.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "draw/draw_list.h"
#include "draw/exact_data.h"
#include "reference/caster.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"

namespace luxo {
namespace {

constexpr PixelSize kClaimSize{48, 36};
/// Of a depth: more than rays and triangles round, far less than shells are thick.
constexpr double kAlike = 1e-7;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  int upTo(int most) { return std::uniform_int_distribution<int>(0, most)(engine_); }
  Vec3 direction() {
    const double y = between(-1, 1), angle = between(0, 6.3), around = std::sqrt(1 - y * y);
    return {around * std::cos(angle), y, around * std::sin(angle)};
  }

 private:
  std::mt19937 engine_;
};

// One number in a statement: the order in which arguments are evaluated is the compiler's.
std::string sumOfSines(Random& random, int most) {
  std::string sum;
  for (int k = 0; k < 3; ++k) {
    const double phase = random.between(0, 6.28);
    const int v = random.upTo(most), u = random.upTo(most);
    const char* function = random.upTo(1) ? "sin" : "cos";
    const double size = random.between(0.1, 0.45);
    sum += fmt::format("{}{:.3f}*{}({}*u+{}*v+{:.3f})", k > 0 ? "+" : "", size, function, u, v, phase);
  }
  return sum;
}

std::string formula(const std::array<std::string, 3>& position, const std::string& u, const std::string& v,
                    const std::string& let = "") {
  return fmt::format(R"({{ "type": "formula", "u": {}, "v": {}, "position": ["{}", "{}", "{}"]{} }})", u, v,
                     position[0], position[1], position[2], let.empty() ? "" : ", \"let\": " + let);
}

/// Closed, through itself.
std::string closedSines(Random& random, int most) {
  return formula({sumOfSines(random, most), sumOfSines(random, most), sumOfSines(random, most)},
                 "[0, \"tau\"]", "[0, \"tau\"]");
}

/// The same with borders.
std::string openSines(Random& random, int most) {
  return formula({sumOfSines(random, most), sumOfSines(random, most), sumOfSines(random, most)}, "[0, 4]",
                 "[0.5, 3]");
}

/// A figure of eight with unequal loops, led around an axis: it passes through itself, and from outside its
/// smaller loop shows the inner side. Nowhere a point without a normal, so that slabs stand.
std::string crossing(Random& random, int most, const char* u) {
  const auto wave = [&] {
    const double phase = random.between(0, 6.28);
    return fmt::format("+0.15*sin({}*u+{:.3f})", random.upTo(most), phase);
  };
  const std::string onRadius = wave();
  const std::string radius = fmt::format("(1.5+{:.3f}*sin(v){})", random.between(0.4, 0.7), onRadius);
  const std::string onHeight = wave();
  const std::string height =
      fmt::format("(0.4+{:.3f}*sin(v))*sin(2*v){}", random.between(0.1, 0.3), onHeight);
  return formula({radius + "*cos(u)", height, radius + "*sin(u)"}, u, "[0, \"tau\"]");
}
std::string closedCrossing(Random& random, int most) { return crossing(random, most, "[0, \"tau\"]"); }
std::string openCrossing(Random& random, int most) { return crossing(random, most, "[0, 4]"); }

std::string ruled(Random& random, int most) {
  const auto line = [&] {
    const auto wave = [&] {
      const double phase = random.between(0, 6.28);
      const int u = random.upTo(most);
      return fmt::format("{:.3f}*sin({}*u+{:.3f})", random.between(0.2, 0.7), u, phase);
    };
    const std::string slope = wave();
    return wave() + "+v*" + slope;
  };
  return formula({line(), line(), line()}, "[0, 6]", "[-1, 1]");
}

std::string roll(Random& random, int most) {
  const double turns = 1 + random.upTo(4 * most), last = 6.283 * turns;
  const double pitch = random.between(0.5, 1.1) / last, high = random.between(0.3, 1),
               low = random.between(0.3, 1);
  return formula({"r*cos(u)", "v", "r*sin(u)"}, fmt::format("[0, {:.4f}]", last),
                 fmt::format("[-{:.3f}, {:.3f}]", low, high),
                 fmt::format(R"({{ "r": "0.1 + {:.6f}*u" }})", pitch));
}

struct Family {
  const char* name;
  std::string (*surface)(Random&, int most);
  int most;
  unsigned rounds;
  bool hides;  ///< some of it, behind slabs
};

Snapshot snapshotOf(const Family& family, unsigned seed) {
  Random random(seed);
  const std::string surface = family.surface(random, family.most);
  const Vec3 direction = random.direction();
  const Vec3 eye = random.between(3, 6) * direction;
  const std::string projection = random.upTo(4) == 0
                                     ? R"("type": "orthographic", "height": 3)"
                                     : fmt::format(R"("fov_y": {:.3f})", random.between(0.4, 0.9));
  return takeSnapshot(
      buildScene(
          parseScene(fmt::format(R"({{ "luxo": 1, "materials": {{ "m": {{ "diffuse": [0.5, 0.5, 0.5] }} }},
        "surfaces": {{ "s": {} }}, "nodes": [{{ "surface": "s", "material": "m" }}],
        "camera": {{ "eye": [{:.4f}, {:.4f}, {:.4f}], "look_at": [0, 0, 0], "up": [0.1, 1, 0.05], {} }} }})",
                                 surface, eye.x, eye.y, eye.z, projection),
                     family.name)),
      0, kClaimSize);
}

/// A triangle that is drawn, and of which side of the surface its searches are for.
struct Drawn {
  Half half;
  FaceCulling culling;
  std::array<std::uint32_t, 3> corners;

  friend auto operator<=>(const Drawn&, const Drawn&) = default;
};

/// Sorted.
std::vector<Drawn> trianglesOf(const DrawList& list) {
  std::vector<Drawn> all;
  for (const DrawBatch& batch : list.opaque)
    for (std::size_t i = batch.firstIndex; i < batch.firstIndex + batch.indexCount; i += 3)
      all.push_back({batch.half,
                     batch.culling,
                     {list.shellIndices[i], list.shellIndices[i + 1], list.shellIndices[i + 2]}});
  std::ranges::sort(all);
  return all;
}

/// What a ray meets first.
struct Seen {
  double depth;
  bool outside;  ///< the outer side of the surface
};

class ShellClaims : public testing::TestWithParam<Family> {
 protected:
  /// Of the pixels' centres; nothing where a ray meets nothing, or what it meets is not proven.
  static std::vector<std::optional<Seen>> look(const Snapshot& snapshot) {
    const reference::Caster caster(snapshot);
    const double orientation = snapshot.nodes[0].surface.topology().orientation();
    std::vector<std::optional<Seen>> seen;
    for (int y = 0; y < kClaimSize.height; ++y)
      for (int x = 0; x < kClaimSize.width; ++x) {
        const reference::Ray ray = caster.rayThrough(x + 0.5, y + 0.5);
        const auto sight = caster.look(ray);
        seen.emplace_back();
        if (sight.hits.empty() || !sight.certified) continue;
        const reference::Hit& hit = sight.hits[0];
        const SurfacePoints at = snapshot.nodes[0].surface.evaluate(0, std::array{hit.u}, std::array{hit.v},
                                                                    snapshot.nodes[0].parameters);
        const double facing = orientation * glm::dot(glm::cross(at.du[0], at.dv[0]), ray.direction);
        const View& view = snapshot.view;
        seen.back() = {glm::dot(hit.position - view.eye, view.forward()), facing < 0};
      }
    return seen;
  }

  /// Calls action(pixel, depth) for the pixels' centres inside a triangle on the screen.
  template <typename Action>
  static void forEachPixel(const Snapshot& snapshot, const std::array<Vec3, 3>& t, const Action& action) {
    const Vec3 a = t[1] - t[0], b = t[2] - t[0];
    const double area = a.x * b.y - a.y * b.x;
    const auto inverse = [&](double z) { return snapshot.view.perspective() ? 1 / z : z; };
    const auto range = [&](auto axis, int size) {
      const double low = std::min({t[0][axis], t[1][axis], t[2][axis]}),
                   high = std::max({t[0][axis], t[1][axis], t[2][axis]});
      return std::pair(std::max(0, static_cast<int>(std::floor(std::max(low, 0.0)))),
                       std::min(size - 1, static_cast<int>(std::floor(std::min(high, 1e6)))));
    };
    const auto [firstX, lastX] = range(0, kClaimSize.width);
    const auto [firstY, lastY] = range(1, kClaimSize.height);
    for (int y = firstY; y <= lastY; ++y)
      for (int x = firstX; x <= lastX; ++x) {
        const double right = x + 0.5 - t[0].x, down = y + 0.5 - t[0].y;
        const double u = (right * b.y - down * b.x) / area, v = (down * a.x - right * a.y) / area;
        if (!(u >= 0 && v >= 0 && u + v <= 1)) continue;
        const double z = (1 - u - v) * inverse(t[0].z) + u * inverse(t[1].z) + v * inverse(t[2].z);
        action(static_cast<std::size_t>(y * kClaimSize.width + x), inverse(z));
      }
  }

  static bool facesViewer(const std::array<Vec3, 3>& t) {
    const Vec3 a = t[1] - t[0], b = t[2] - t[0];
    return a.y * b.x - a.x * b.y > 0;
  }
};

INSTANTIATE_TEST_SUITE_P(Random, ShellClaims,
                         testing::Values(Family{"closedSines", closedSines, 2, 2, false},
                                         Family{"openSines", openSines, 2, 3, false},
                                         Family{"closedCrossing", closedCrossing, 3, 4, true},
                                         Family{"openCrossing", openCrossing, 3, 4, true},
                                         Family{"ruled", ruled, 2, 12, true},
                                         Family{"roll", roll, 2, 12, true}),
                         [](const auto& family) { return std::string(family.param.name); });

// Of what is drawn a triangle is entered before every point that is seen, and leads to the side that is seen
// there; and where a triangle is left out that a device would have drawn, something nearer is seen.
TEST_P(ShellClaims, HoldForCertifiedRays) {
  std::size_t pixels = 0, hidden = 0, withoutShell = 0;
  for (unsigned seed = 0; seed < GetParam().rounds; ++seed) {
    const Snapshot snapshot = snapshotOf(GetParam(), seed);
    Geometry geometry;
    const VisibleList visible = cull(snapshot);
    DrawOptions options;
    options.sharedPixels = 0;  // small as it is, as if it were large
    const DrawList list = listDraws(snapshot, visible, options, geometry);
    DrawOptions showing = options;
    showing.skips.hidden = false;
    const DrawList whole = listDraws(snapshot, visible, showing, geometry);
    std::vector<std::optional<Seen>> seen = look(snapshot);
    for (const PixelRect& rect : whole.byRays)  // there the shell claims nothing
      for (int y = rect.low.y; y < rect.high.y; ++y)
        for (int x = rect.low.x; x < rect.high.x; ++x)
          seen[static_cast<std::size_t>(y * kClaimSize.width + x)].reset();
    if (whole.opaque.empty()) {
      ++withoutShell;
      continue;
    }
    const std::vector<Vec3> points =
        inPicture(snapshot.view, snapshot.nodes[0], whole.opaque[0].shell->positions);
    const bool inFront = std::ranges::all_of(points, [&](const Vec3& p) { return p.z > snapshot.view.near; });
    ASSERT_TRUE(inFront) << "camera " << seed;
    const auto onScreen = [&](const Drawn& drawn) {
      return std::array{points[drawn.corners[0]], points[drawn.corners[1]], points[drawn.corners[2]]};
    };

    std::vector<char> entered(seen.size());
    const std::vector<Drawn> kept = trianglesOf(list);
    for (const Drawn& drawn : kept) {
      if (!facesViewer(onScreen(drawn))) continue;
      forEachPixel(snapshot, onScreen(drawn), [&](std::size_t pixel, double depth) {
        if (seen[pixel] && seen[pixel]->outside == (drawn.half == Half::Near) &&
            depth <= seen[pixel]->depth * (1 + kAlike))
          entered[pixel] = true;
      });
    }
    std::size_t missed = 0;
    for (std::size_t pixel = 0; pixel < seen.size(); ++pixel) {
      pixels += seen[pixel].has_value();
      missed += seen[pixel] && !entered[pixel];
    }
    EXPECT_EQ(missed, 0U) << "camera " << seed;

    std::vector<Drawn> dropped;
    std::ranges::set_difference(trianglesOf(whole), kept, std::back_inserter(dropped));
    std::size_t wrong = 0;
    for (const Drawn& drawn : dropped) {
      if (drawn.culling == FaceCulling::Back && !facesViewer(onScreen(drawn))) continue;
      forEachPixel(snapshot, onScreen(drawn), [&](std::size_t pixel, double depth) {
        ++hidden;
        wrong += seen[pixel] && depth < seen[pixel]->depth * (1 - kAlike);
      });
    }
    EXPECT_EQ(wrong, 0U) << "camera " << seed;
  }
  EXPECT_TRUE(pixels > 300 || withoutShell == GetParam().rounds);
  EXPECT_TRUE(hidden > 0 || !GetParam().hides);
}

// At a moment a formula may be a single point; it has a shell, or none, and no more is asked of it.
TEST(Shells, OfWhatHasCollapsed) {
  const Scene scene = buildScene(
      parseScene(R"json({ "luxo": 1, "surfaces": { "s": { "type": "formula", "u": [0, 1], "v": [0, 1],
        "position": ["(1-t)*u", "(1-t)*v", "(1-t)*sin(u)"] } }, "nodes": [{ "surface": "s" }],
        "camera": { "eye": [3, 2, 4], "look_at": [0, 0, 0] } })json",
                 "collapsed"));
  const Snapshot snapshot = takeSnapshot(scene, 1, kClaimSize);
  ASSERT_EQ(snapshot.nodes[0].boundsObject.extent(), Vec3(0));
  Geometry geometry;
  EXPECT_LE(listDraws(snapshot, cull(snapshot, {.small = false}), {}, geometry).opaque.size(), 4U);
}

}  // namespace
}  // namespace luxo
