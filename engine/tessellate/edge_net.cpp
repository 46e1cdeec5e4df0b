// SPDX-License-Identifier: Apache-2.0
#include "tessellate/edge_net.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "base/assert.h"
#include "math/disjoint_sets.h"

namespace luxo {
namespace {

/// One block's share of a line.
struct Share {
  std::uint32_t patch = 0;
  bool alongV = false;  ///< of constant u
  double at = 0;        ///< the constant part
  double from = 0, to = 0;
  std::uint32_t segments = 0;
  std::size_t block = 0;
  Side side = Side::UMin;
};

Share shareOf(const std::vector<Block>& blocks, std::size_t b, Side side) {
  const Block& block = blocks[b];
  const Tile& t = block.tile;
  const bool alongV = side == Side::UMin || side == Side::UMax;
  const double at = side == Side::UMin   ? t.lowU()
                    : side == Side::UMax ? t.highU()
                    : side == Side::VMin ? t.lowV()
                                         : t.highV();
  return {.patch = block.patch,
          .alongV = alongV,
          .at = at,
          .from = alongV ? t.lowV() : t.lowU(),
          .to = alongV ? t.highV() : t.highU(),
          .segments = alongV ? block.segments.v : block.segments.u,
          .block = b,
          .side = side};
}

/// A part of a line without corners inside.
struct Piece {
  double from = 0, to = 0;
  std::uint32_t segments = 0;  ///< 0: no block is beside it
};

/// All shares of one line of one patch.
struct Line {
  std::size_t firstShare = 0, shareEnd = 0;
  std::size_t group = 0;  ///< lines joined with it, itself included, have the same
  bool reversed = false;  ///< against the group's direction
  std::vector<Piece> pieces;
  std::vector<std::uint32_t> vertices;   ///< of all pieces, in a row; neighbours share their end
  std::vector<std::size_t> firstVertex;  ///< of each piece, in `vertices`
};

/// Which edges of patches are one curve, and in which direction they run along it.
class EdgeGroups {
 public:
  explicit EdgeGroups(const Topology& topology) : groups_(4 * topology.edges.size()) {
    for (const Joint& joint : topology.joints)
      groups_.unite(indexOf(joint.a), indexOf(joint.b), joint.reversed);
  }

  static std::uint32_t indexOf(const PatchEdge& edge) {
    return 4 * edge.patch + static_cast<std::uint32_t>(edge.side);
  }

  /// The group, and whether the edge runs against it.
  [[nodiscard]] std::pair<std::size_t, bool> find(const PatchEdge& edge) const {
    const auto [group, reversed] = groups_.find(indexOf(edge));
    return {group, reversed};
  }

 private:
  DisjointSets groups_;
};

/// Builds the lines for the blocks' present segments.
class LineBuilder {
 public:
  LineBuilder(const Topology& topology, const std::vector<Block>& blocks) : topology_(&topology) {
    for (std::size_t b = 0; b < blocks.size(); ++b)
      for (const Side side : kSides) shares_.push_back(shareOf(blocks, b, side));
    const auto key = [](const Share& s) { return std::tuple(s.patch, s.alongV, s.at, s.from, s.block); };
    std::sort(shares_.begin(), shares_.end(),
              [&](const Share& a, const Share& b) { return key(a) < key(b); });
    findLines();
    cutLines();
  }

  std::vector<Share>& shares() { return shares_; }
  std::vector<Line>& lines() { return lines_; }
  [[nodiscard]] const Share& first(const Line& line) const { return shares_[line.firstShare]; }
  /// The line that is an edge of a patch.
  Line& lineAt(const PatchEdge& edge) { return lines_[lineOfEdge_[EdgeGroups::indexOf(edge)]]; }

 private:
  void findLines() {
    const EdgeGroups groups(*topology_);
    lineOfEdge_.resize(4 * topology_->edges.size());
    for (std::size_t i = 0; i < shares_.size(); ++i) {
      const Share& s = shares_[i];
      if (i > 0) {
        const Share& before = shares_[i - 1];
        if (std::tie(before.patch, before.alongV, before.at) == std::tie(s.patch, s.alongV, s.at)) {
          lines_.back().shareEnd = i + 1;
          continue;
        }
      }
      Line line{.firstShare = i, .shareEnd = i + 1, .group = lineOfEdge_.size() + lines_.size()};
      if (s.at == 0 || s.at == 1) {
        const Side side =
            s.alongV ? (s.at == 0 ? Side::UMin : Side::UMax) : (s.at == 0 ? Side::VMin : Side::VMax);
        const PatchEdge edge{s.patch, side};
        lineOfEdge_[EdgeGroups::indexOf(edge)] = lines_.size();
        std::tie(line.group, line.reversed) = groups.find(edge);
      }
      lines_.push_back(std::move(line));
    }
  }

  /// The pieces of all lines of a group are the same.
  void cutLines() {
    std::vector<std::size_t> order(lines_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return lines_[a].group < lines_[b].group; });
    for (std::size_t first = 0; first < order.size();) {
      std::size_t end = first;
      while (end < order.size() && lines_[order[end]].group == lines_[order[first]].group) ++end;
      cutGroup({order.begin() + static_cast<std::ptrdiff_t>(first),
                order.begin() + static_cast<std::ptrdiff_t>(end)});
      first = end;
    }
  }

  void cutGroup(const std::vector<std::size_t>& members) {
    const auto inGroup = [](const Line& line, const Share& s) {
      return line.reversed ? std::pair(1 - s.to, 1 - s.from) : std::pair(s.from, s.to);
    };
    const auto forEachShare = [&](const auto& action) {
      for (const std::size_t m : members)
        for (std::size_t i = lines_[m].firstShare; i < lines_[m].shareEnd; ++i)
          action(inGroup(lines_[m], shares_[i]), shares_[i].segments);
    };
    std::vector<double> corners;
    forEachShare([&](const std::pair<double, double>& ends, std::uint32_t) {
      corners.push_back(ends.first);
      corners.push_back(ends.second);
    });
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());

    std::vector<Piece> pieces(corners.size() - 1);
    for (std::size_t i = 0; i < pieces.size(); ++i) pieces[i] = {corners[i], corners[i + 1], 0};
    forEachShare([&](const std::pair<double, double>& ends, std::uint32_t segments) {
      const double perPart = segments / (ends.second - ends.first);
      auto i = static_cast<std::size_t>(std::lower_bound(corners.begin(), corners.end(), ends.first) -
                                        corners.begin());
      for (; i < pieces.size() && pieces[i].to <= ends.second; ++i) {
        // A number a rounding error above an integer counts as that.
        const double wanted = std::ceil((pieces[i].to - pieces[i].from) * perPart * (1 - 1e-12));
        pieces[i].segments = std::max(pieces[i].segments, static_cast<std::uint32_t>(wanted));
      }
    });
    std::erase_if(pieces, [](const Piece& piece) { return piece.segments == 0; });
    for (const std::size_t m : members) {
      lines_[m].pieces = pieces;
      if (!lines_[m].reversed) continue;
      std::reverse(lines_[m].pieces.begin(), lines_[m].pieces.end());
      for (Piece& piece : lines_[m].pieces) piece = {1 - piece.to, 1 - piece.from, piece.segments};
    }
  }

  const Topology* topology_;
  std::vector<Share> shares_;
  std::vector<Line> lines_;
  std::vector<std::size_t> lineOfEdge_;
};

/// The pieces of a line that a share covers.
std::pair<std::size_t, std::size_t> piecesOf(const Line& line, const Share& share) {
  const auto byFrom = [](const Piece& piece, double from) { return piece.from < from; };
  const auto first = std::lower_bound(line.pieces.begin(), line.pieces.end(), share.from, byFrom);
  const auto end = std::lower_bound(first, line.pieces.end(), share.to, byFrom);
  return {static_cast<std::size_t>(first - line.pieces.begin()),
          static_cast<std::size_t>(end - line.pieces.begin())};
}

/// Whether equal cells are what the line has beside the block. Two halves of as many segments each are.
bool isPlain(const Line& line, const Share& share) {
  const auto [first, end] = piecesOf(line, share);
  const double cell = (share.to - share.from) / share.segments;
  std::uint32_t count = 0;
  for (std::size_t i = first; i < end; ++i) {
    const Piece& piece = line.pieces[i];
    count += piece.segments;
    if (std::abs((piece.to - piece.from) / piece.segments - cell) > 1e-10 * cell) return false;
  }
  return count == share.segments;
}

/// Raises to two the segments of blocks that have none of their own cells' lines between two lines with other
/// vertices. Returns whether there were any.
bool raiseSegments(LineBuilder& builder, std::vector<Block>& blocks) {
  std::vector<std::array<bool, 4>> plain(blocks.size());
  for (const Line& line : builder.lines())
    for (std::size_t i = line.firstShare; i < line.shareEnd; ++i) {
      const Share& share = builder.shares()[i];
      plain[share.block][static_cast<std::size_t>(share.side)] = isPlain(line, share);
    }
  bool raised = false;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const auto raise = [&](std::uint32_t& segments, Side low, Side high) {
      if (segments > 1 || plain[b][static_cast<std::size_t>(low)] || plain[b][static_cast<std::size_t>(high)])
        return;
      segments = 2;
      raised = true;
    };
    raise(blocks[b].segments.u, Side::UMin, Side::UMax);
    raise(blocks[b].segments.v, Side::VMin, Side::VMax);
  }
  return raised;
}

/// Numbers the corners: one number per place.
class Corners {
 public:
  explicit Corners(std::vector<EdgeVertex>& vertices) : vertices_(vertices) {}

  std::uint32_t at(std::uint32_t patch, double partU, double partV) {
    // Parts of corners are dyadic fractions of at most kBits bits.
    constexpr int kBits = 16;
    const auto bits = [](double part) { return static_cast<std::uint64_t>(std::ldexp(part, kBits)); };
    const std::uint64_t key =
        (std::uint64_t{patch} << (2 * kBits + 2)) | (bits(partU) << (kBits + 1)) | bits(partV);
    const auto [entry, isNew] = numbers_.try_emplace(key, static_cast<std::uint32_t>(vertices_.size()));
    if (isNew) vertices_.push_back({patch, partU, partV});
    return entry->second;
  }

 private:
  std::vector<EdgeVertex>& vertices_;
  std::unordered_map<std::uint64_t, std::uint32_t> numbers_;
};

}  // namespace

EdgeNet::EdgeNet(const Topology& topology, std::vector<Block>& blocks) {
  LineBuilder builder(topology, blocks);
  while (raiseSegments(builder, blocks)) builder = LineBuilder(topology, blocks);

  Corners corners(vertices_);
  for (Line& line : builder.lines()) {
    const Share& share = builder.first(line);
    const auto place = [&](double part) {
      return share.alongV ? EdgeVertex{share.patch, share.at, part} : EdgeVertex{share.patch, part, share.at};
    };
    const auto corner = [&](double part) {
      const EdgeVertex v = place(part);
      return corners.at(v.patch, v.partU, v.partV);
    };
    for (const Piece& piece : line.pieces) {
      const std::uint32_t first = corner(piece.from);
      if (line.vertices.empty() || line.vertices.back() != first) line.vertices.push_back(first);
      line.firstVertex.push_back(line.vertices.size() - 1);
      for (std::uint32_t k = 1; k < piece.segments; ++k) {
        line.vertices.push_back(static_cast<std::uint32_t>(vertices_.size()));
        vertices_.push_back(
            place(piece.from + (piece.to - piece.from) * (static_cast<double>(k) / piece.segments)));
      }
      line.vertices.push_back(corner(piece.to));
    }
  }

  sides_.resize(blocks.size());
  for (const Line& line : builder.lines())
    for (std::size_t i = line.firstShare; i < line.shareEnd; ++i) {
      const Share& share = builder.shares()[i];
      const auto [first, end] = piecesOf(line, share);
      const std::size_t from = line.firstVertex[first];
      const std::size_t to = line.firstVertex[end - 1] + line.pieces[end - 1].segments;
      sides_[share.block][static_cast<std::size_t>(share.side)] = {sideVertices_.size(), to - from + 1,
                                                                   isPlain(line, share)};
      sideVertices_.insert(sideVertices_.end(), line.vertices.begin() + static_cast<std::ptrdiff_t>(from),
                           line.vertices.begin() + static_cast<std::ptrdiff_t>(to) + 1);
    }

  for (const Joint& joint : topology.joints) {
    const auto& a = builder.lineAt(joint.a).vertices;
    const auto& b = builder.lineAt(joint.b).vertices;
    LUXO_ASSERT(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
      twins_.push_back({a[i], b[joint.reversed ? b.size() - 1 - i : i], joint.smooth, joint.flipped});
  }
  for (std::uint32_t patch = 0; patch < topology.edges.size(); ++patch)
    for (const Side side : kSides) {
      if (!topology.edge(patch, side).collapsed()) continue;
      const auto& v = builder.lineAt({patch, side}).vertices;
      for (std::size_t i = 1; i < v.size(); ++i) twins_.push_back({v[0], v[i], false, false});
    }
}

}  // namespace luxo
