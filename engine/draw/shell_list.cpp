// SPDX-License-Identifier: Apache-2.0
#include "draw/shell_list.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "cull/raster_slack.h"
#include "draw/drawn_facing.h"
#include "draw/exact_data.h"
#include "draw/near_section.h"
#include "math/transform.h"
#include "surface/spread.h"

namespace luxo {
namespace {

// No shell is nearer to its surface than this part of its size, unless a search was lost.
constexpr double kFinestShell = 2e-4;
// Nor farther than this part, however small it is seen: a shell of a few triangles is blind to spikes and
// rims, and searches from it have lost them (the lecture's pseudospheres, 12 pixels large).
constexpr double kCoarsestShell = 1.0 / 64;
// A quadric has neither. That it is one was seen in a shell that is no coarser than the above.
constexpr double kCoarsestQuadric = 1.0 / 4;

/// Of the surface's size: a slab that has to be thicker tells little of where its surface is.
constexpr double kMaxMargin = 1.0 / 16;

/// How far slabs have to reach beyond their surface so that no device draws them beside it: half axes of an
/// ellipsoid, object units, that holds what is a ball in the world. As the corners move from where they are
/// to where they are drawn, all in parallel to the picture, none of the slab's faces passes through a point
/// of the surface that has such a ball inside the slab: so before and after, every path from the eye to that
/// point goes in through the slab's faces once more often than out (the degree of a map is invariant under
/// homotopy), and the ray through the centre of a pixel on the surface enters by a face that is drawn there.
/// Where the surface bends more sharply than with that radius its slab's faces pass through each other, and
/// no more is known than that the surface is inside.
Vec3 marginOf(const View& view, const SnapshotNode& node, const VisibleNode& v) {
  // What is at most r in the world reaches r |M^-T n| along n in the object. M^-1 = D U, D its rows' lengths
  // and U their directions: |M^-T n| = |U^T D n| is at most the stretch of U, 1 to sqrt(3), times |D n|.
  const double radius = kMovedPx * (view.perspective() ? v.farthestDepth : 1) / view.pixelsPerUnit;
  const Mat3 rows = glm::transpose(glm::inverse(node.worldFromObject.linear / v.stretch));
  const Vec3 lengths(glm::length(rows[0]), glm::length(rows[1]), glm::length(rows[2]));
  const double stretch = largestStretch(Mat3(rows[0] / lengths.x, rows[1] / lengths.y, rows[2] / lengths.z));
  return stretch * radius / v.stretch * lengths;
}

/// Whether a search has to hide the back. The back of what is flat has nothing to do with its front, and
/// culling hides it, but not where its triangles may turn over. Equations hide it themselves.
bool hidesTurned(const DrawBatch& batch) {
  return batch.frontOnly || (batch.flat && !batch.bothSides && !batch.state.equation);
}

/// Whether a device draws nothing of what faces so.
bool isCulled(DrawnFacing::Side drawn, FaceCulling culling) {
  return (culling == FaceCulling::Back && drawn == DrawnFacing::Side::Back) ||
         (culling == FaceCulling::Front && drawn == DrawnFacing::Side::Front);
}

/// Whether some of the shell may not be in the picture.
bool mayClip(const View& view, const SnapshotNode& node, const VisibleNode& v, const Shell& shell) {
  const Vec3 reach(2 * shell.offset * v.stretch);
  const PixelRect pixels = pixelsOf(view, {node.boundsWorld.min - reach, node.boundsWorld.max + reach});
  return pixels.low.x == 0 || pixels.low.y == 0 || pixels.high.x == view.size.width ||
         pixels.high.y == view.size.height;
}

/// Whether its search is a quadratic equation, which finds the same root from wherever it begins.
bool isQuadric(const Shell& shell) {
  return std::ranges::all_of(shell.patchData, [](const ShellPatch& patch) {
    return patch.equation && patch.equation->form() == Equation::Form::Quadric;
  });
}

/// Homogeneous; not finite where the object is flattened.
Vec4 eyeInObject(const View& view, const Transform& worldFromObject) {
  const Mat3 objectFromWorld = glm::inverse(worldFromObject.linear);
  return view.perspective() ? Vec4(objectFromWorld * (view.eye - worldFromObject.translation), 1)
                            : Vec4(objectFromWorld * -view.forward(), 0);
}

/// Parts of shells that are seen where rays graze: every so many of the picture's triangles.
constexpr std::size_t kMaxOutlines = 64;

/// Shells of more triangles than pixels, and than this, are not made: rays in all of those pixels take no
/// longer. (Some 10 us a triangle, measured from the teapot to sums of sines; a ray 1 to 5.)
constexpr std::uint64_t kWorthRays = 20'000;

}  // namespace

std::optional<ShellList::Draws> ShellList::add(DrawBatch batch, const SnapshotNode& node,
                                               const VisibleNode& v) {
  const PixelRect pixels = pixelsOf(snapshot_.view, node.boundsWorld);
  // No shell holds what has no end.
  if (!isFinite(node.boundsObject)) {
    list_.byRays.push_back(pixels);
    return std::nullopt;
  }
  batch.shell = shellOf(node, v, pixels);
  const bool leavesOut = !batch.shell || (!batch.shell->proven && batch.shell->pinches.empty());
  if (leavesOut || (!options_.doubles && losesEdges(snapshot_.view, node, v, *batch.shell))) {
    list_.byRays.push_back(pixels);
    return std::nullopt;
  }
  for (const Box& pinch : batch.shell->pinches)
    list_.byRays.push_back(
        overlap(pixels, pixelsOf(snapshot_.view, transformBounds(node.worldFromObject, pinch))));
  const auto plane = options_.doubles ? planeIn(snapshot_.view, node, *batch.shell) : std::nullopt;
  const bool wantsDouble =
      !plane && (options_.finerShells || needsDouble(snapshot_.view, node, v, *batch.shell));
  const bool inDouble = wantsDouble && options_.doubles;
  const GlslNumber number = inDouble ? GlslNumber::Double : GlslNumber::Float;
  if (isTooLarge(geometry_.codes, node.surface, *batch.shell, node.parameters.size(), number)) {
    ++list_.tooLarge;
    list_.byRays.push_back(pixels);
    return std::nullopt;
  }
  Draws draws{.batches = {}, .exact = {}, .origin = batch.shell->origin};
  const bool inside = mayHoldEye(snapshot_.view, node, v, *batch.shell);
  draws.exact = plane ? exactInstance(snapshot_.view, list_.origin, node, v, *batch.shell, *plane)
                      : exactInstance(snapshot_.view, list_.origin, node, v, *batch.shell, number);
  if (wantsDouble && !inDouble) addFormulaRounding(snapshot_.view, node, *batch.shell, draws.exact);
  draws.exact.firstPatch = patchesOf(node, *batch.shell);
  batch.shared = !inside && !options_.finerShells && sharesDraws(pixels);
  if (!batch.shared) ++drawnApart_;
  const ShellView view(eyeInObject(snapshot_.view, node.worldFromObject), !inside && !options_.finerShells);
  // Of what shares its draws nothing is told apart.
  const bool turns = batch.shared && mayClip(snapshot_.view, node, v, *batch.shell);
  std::optional<DrawnFacing> facing;
  if (!batch.shared) facing.emplace(snapshot_.view, node, *batch.shell);
  batch.state.frontOnly = batch.frontOnly;
  for (const Shell::Part& part : batch.shell->parts) {
    batch.state.surface = plane ? geometry_.codes.plane(shared::kEquationNumbers)
                                : codeOf(geometry_.codes, node.surface, *batch.shell, part.patch,
                                         node.parameters.size(), number);
    batch.state.equation = batch.shell->patchData[part.patch].equation.has_value();
    const FaceCulling fromOutside =
        (inside && batch.bothSides) || turns ? FaceCulling::None : FaceCulling::Back;
    batch.culling = fromOutside;
    // A quadric's roots are all known at once.
    const std::optional<Equation>& equation = batch.shell->patchData[part.patch].equation;
    if (inside && !(equation && equation->form() == Equation::Form::Quadric))
      addNearSection(node, *batch.shell, part);
    batch.half = Half::Near;
    addDraws(draws.batches, batch, view, facing, part.firstIndex, part.frontCount);
    batch.half = Half::Far;
    const bool fromInside = inside && snapshot_.view.perspective();
    if (fromInside) {
      // From inside the slab its faces are seen from behind. A ray leaves it by the bottom behind the outer
      // side, or, having dipped into that, by the top.
      if (!batch.bothSides) batch.culling = FaceCulling::Front;
      addDraws(draws.batches, batch, view, facing, part.firstIndex, part.count);
    }
    // Beside an eye that is in the slab rays come in by the bottom, too, and go on through the back.
    if (batch.frontOnly || (batch.bothSides && !fromInside)) {
      batch.culling = fromOutside;
      addDraws(draws.batches, batch, view, facing, part.wallIndex(), part.frontCount);
    }
  }
  return draws;
}

/// What is small, and what comes after the nearest ones that are drawn by themselves.
bool ShellList::sharesDraws(const PixelRect& pixels) const {
  return pixels.count() <= options_.sharedPixels || drawnApart_ >= options_.maxDrawnApart;
}

/// What is seen where rays begin inside the shell is found by rays.
void ShellList::addNearSection(const SnapshotNode& node, const Shell& shell, const Shell::Part& part) {
  const auto before = static_cast<std::ptrdiff_t>(list_.byRays.size());
  appendNearSection(snapshot_.view, node, shell, part, list_.byRays);
  const auto added = list_.byRays.begin() + before;
  const PixelRect all{{0, 0}, {snapshot_.view.size.width, snapshot_.view.size.height}};
  const auto pixels =
      std::accumulate(added, list_.byRays.end(), std::uint64_t{0},
                      [](std::uint64_t sum, const PixelRect& rect) { return sum + rect.count(); });
  // Of prisms that all are across the picture one is enough.
  if (pixels <= 4 * all.count()) return;
  list_.byRays.erase(added, list_.byRays.end());
  list_.byRays.push_back(all);
}

/// Adds the draws of some of a shell's triangles: of the transversal ones, of those that a ray may graze, and
/// of those that may turn over where they are clipped.
void ShellList::addDraws(std::vector<DrawBatch>& batches, DrawBatch batch, const ShellView& view,
                         const std::optional<DrawnFacing>& facing, std::uint32_t firstIndex,
                         std::uint32_t count) {
  if (batch.shared) {
    addSharedDraws(batches, std::move(batch), firstIndex, count);
    return;
  }
  const Shell& shell = *batch.shell;
  using Seen = ShellView::Seen;
  std::vector<std::uint32_t> certain, transversal;
  using ByPoles = std::array<std::vector<std::uint32_t>, 2>;  // where no edge is a point, and where one is
  ByPoles grazing, turning;
  for (std::uint32_t i = firstIndex; i < firstIndex + count; i += 3) {
    const DrawnFacing::Side drawn = facing->side(i);
    const bool turns = drawn == DrawnFacing::Side::Either;
    if (isCulled(drawn, batch.culling)) continue;
    // By its equation a surface is found where it is grazed as it is elsewhere. Whether a ray that goes on
    // through the back comes back to the front, the cone does not prove.
    const bool near = batch.half == Half::Near;
    const Seen seen = batch.state.equation || turns || (!near && batch.frontOnly)
                          ? Seen::Grazing
                          : view.seen(shell, i, near ? 1 : -1);
    const ShellPatch& patch = shell.patchData[shell.patches[shell.indices[i]]];
    std::vector<std::uint32_t>& indices =
        seen == Seen::Certain ? certain
        : seen == Seen::Transversal
            ? transversal
            : (turns && facing->clips() ? turning : grazing)[!batch.state.equation && patch.hasPole()];
    indices.insert(indices.end(), shell.indices.begin() + i, shell.indices.begin() + i + 3);
  }
  const auto add = [&](const std::vector<std::uint32_t>& indices) {
    if (indices.empty()) return;
    batch.firstIndex = static_cast<std::uint32_t>(list_.shellIndices.size());
    batch.indexCount = static_cast<std::uint32_t>(indices.size());
    list_.shellIndices.insert(list_.shellIndices.end(), indices.begin(), indices.end());
    batches.push_back(batch);
  };
  add(certain);
  batch.state.walks = true;
  add(transversal);
  batch.state.grazing = true;
  batch.state.frontOnly = hidesTurned(batch);
  for (const ByPoles* triangles : {&grazing, &turning}) {
    for (const bool poles : {false, true}) {
      batch.state.poles = poles;
      add((*triangles)[poles]);
    }
    batch.culling = FaceCulling::None;
  }
}

/// Adds the draws of all of these triangles, as if a ray may graze each of them.
void ShellList::addSharedDraws(std::vector<DrawBatch>& batches, DrawBatch batch, std::uint32_t firstIndex,
                               std::uint32_t count) {
  const auto key = std::pair(batch.shell.get(), firstIndex);
  auto known = sharedRanges_.find(key);
  if (known == sharedRanges_.end() || !options_.shareShells)
    known = sharedRanges_.insert_or_assign(key, sharedRanges(*batch.shell, firstIndex, count)).first;
  batch.state.walks = batch.state.grazing = true;
  batch.state.frontOnly = hidesTurned(batch);
  for (const bool poles : {false, true}) {
    const auto& [first, end] = known->second[poles];
    if (first == end) continue;
    batch.state.poles = poles;
    batch.firstIndex = first;
    batch.indexCount = end - first;
    batches.push_back(batch);
  }
}

ShellList::Ranges ShellList::sharedRanges(const Shell& shell, std::uint32_t firstIndex, std::uint32_t count) {
  Ranges ranges;
  const auto size = [&] { return static_cast<std::uint32_t>(sharedIndices_.size()); };
  for (const bool poles : {false, true}) {
    ranges[poles].first = size();
    for (std::uint32_t i = firstIndex; i < firstIndex + count; i += 3) {
      const ShellPatch& patch = shell.patchData[shell.patches[shell.indices[i]]];
      if ((!patch.equation && patch.hasPole()) != poles) continue;
      sharedIndices_.insert(sharedIndices_.end(), shell.indices.begin() + i, shell.indices.begin() + i + 3);
    }
    ranges[poles].second = size();
  }
  return ranges;
}

void ShellList::placeSharedIndices() {
  const auto before = static_cast<std::uint32_t>(list_.shellIndices.size());
  for (DrawBatch& batch : list_.opaque)
    if (batch.shared) batch.firstIndex += before;
  list_.shellIndices.insert(list_.shellIndices.end(), sharedIndices_.begin(), sharedIndices_.end());
}

/// Evenly chosen of all grazing triangles, so that where outlines are dense many are.
void ShellList::listOutlines() {
  const auto trianglesOf = [](const DrawBatch& batch) -> std::size_t {
    return batch.shell && batch.state.grazing ? batch.indexCount / 3 : 0;
  };
  std::size_t grazing = 0;
  for (const DrawBatch& batch : list_.opaque) grazing += trianglesOf(batch) * batch.instanceCount;
  const std::size_t stride = std::max<std::size_t>(grazing / kMaxOutlines, 1);
  std::size_t passed = 0, next = 0;
  for (const DrawBatch& batch : list_.opaque) {
    const std::size_t triangles = trianglesOf(batch), end = passed + triangles * batch.instanceCount;
    for (; next < end; next += stride)
      listOutline(batch, batch.firstInstance + static_cast<std::uint32_t>((next - passed) / triangles),
                  batch.firstIndex + 3 * static_cast<std::uint32_t>((next - passed) % triangles));
    passed = end;
  }
}

/// The pixel that the middle of a triangle is in.
void ShellList::listOutline(const DrawBatch& batch, std::uint32_t instance, std::uint32_t index) {
  const SnapshotNode& node = snapshot_.nodes[list_.instanceNodes[instance]];
  const std::vector<std::uint32_t>& indices = batch.shared ? sharedIndices_ : list_.shellIndices;
  Vec3 middle(0);
  for (std::uint32_t k = 0; k < 3; ++k) middle += batch.shell->positions[indices[index + k]] / 3.0;
  const Vec3 eye = eyeFromWorldPoint(snapshot_.view, transformPoint(node.worldFromObject, middle));
  if (snapshot_.view.perspective() && !(-eye.z > snapshot_.view.near)) return;
  const Vec2 pixel = glm::floor(pixelFromEye(snapshot_.view, eye));
  const PixelSize& size = snapshot_.view.size;
  if (pixel.x >= 0 && pixel.y >= 0 && pixel.x < size.width && pixel.y < size.height)
    list_.outlines.push_back({static_cast<std::int32_t>(pixel.x), static_cast<std::int32_t>(pixel.y)});
}

/// Where the patches of a surface start; nodes with the same surface and parameters share them.
std::uint32_t ShellList::patchesOf(const SnapshotNode& node, const Shell& shell) {
  const auto [entry, isNew] =
      firstPatchOf_.try_emplace(std::pair{node.surface.identity(), node.parameters},
                                static_cast<std::uint32_t>(list_.exactPatches.size()));
  if (isNew)
    appendPatches(geometry_.codes, node.surface, node.parameters, shell, list_.exactPatches,
                  list_.exactParameters);
  return entry->second;
}

/// The shell of the node's level of detail, where it is worth one.
std::shared_ptr<const Shell> ShellList::shellOf(const SnapshotNode& node, const VisibleNode& v,
                                                const PixelRect& pixels) {
  // A look at a small part of a large surface needs no finer shell than one at all of it: only its cells
  // must be small enough for a search that begins in them.
  const double size = glm::length(node.boundsObject.extent());
  // What has collapsed into a point at this moment has no size to go by.
  const double coarsest =
      kCoarsestShell * size > kLeastSpacing ? kCoarsestShell * size : std::numeric_limits<double>::infinity();
  // The node's bounds may be nearer beside the picture than in it.
  const double nearer = snapshot_.view.perspective() ? nearestSeen(snapshot_.view, node) / v.nearestDepth : 1;
  const double wanted =
      std::max(1.0, nearer) * v.toleranceObject / options_.tolerancePx * options_.shellTolerancePx;
  const double tolerance = std::min(std::max(wanted, kFinestShell * size), coarsest);
  const auto most = static_cast<double>(std::max(pixels.count(), kWorthRays));
  const double refined = options_.finerShells ? tolerance / 4 : tolerance;
  const Vec3 margin = marginOf(snapshot_.view, node, v);
  if (!glm::all(glm::lessThanEqual(margin, Vec3(kMaxMargin * size)))) return nullptr;
  std::shared_ptr<const Shell> shell =
      geometry_.shells.get(node.surface, node.parameters, refined, margin, most);
  if (shell && pixels.count() <= options_.sharedPixels && isQuadric(*shell))
    shell = geometry_.shells.get(node.surface, node.parameters,
                                 std::max(refined, std::min(2 * wanted, kCoarsestQuadric * size)), margin, most);
  return shell;
}

}  // namespace luxo
