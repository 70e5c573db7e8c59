// The calls of a tile that one mesher for all has not.
#pragma once

#include <algorithm>
#include <vector>

#include "program/build_qt.hpp"
#include "program/choose_steiners.hpp"
#include "program/triangulate.hpp"

namespace mesher::detail {

/// As Locate, of a point whose deepest crowded level is known, since all tiles' points crowd it;
/// and the pitch of the lattice there.
template <int D>
void locate_at(sac::Scope& s, VertexRef<D> p, int level, double pitch, const Role& role) {
  auto& w = s.template environment<World<sac::Scope, D>>();
  w.vertices.insert(s, p, role);
  if (level >= kCoarser) {
    const Cell<D> c = MeshBox<D>::cell(w.box.fixed(p->p), level - kCoarser);
    w.quadtree.template post<split>(s, split_key(c), c);
  }
  w.post_nearest_from(s, p, std::min(w.box.cell_side(level + 1) / 2, kClear * pitch));
  w.post_star(s, p);
}

struct LocateKnown {
  static constexpr std::string_view kName = "locate";
  template <int D>
  void operator()(sac::Scope& s, VertexRef<D> p, int level, double pitch) const {
    locate_at(s, p, level, pitch, Role());
  }
};
inline constexpr LocateKnown locate_known{};

/// A place on a segment, at a distance from one of its ends.
struct LocateOnSegment {
  static constexpr std::string_view kName = "locate_on_segment";
  template <int D>
  void operator()(sac::Scope& s, VertexRef<D> p, int level, double pitch, std::uint32_t segment,
                  double distance, bool from_b) const {
    locate_at(s, p, level, pitch, Role{Label(distance, from_b), segment});
  }
};
inline constexpr LocateOnSegment locate_on_segment{};

/// A piece is a leaf before anything is refined.
struct BeginLeaf {
  static constexpr std::string_view kName = "leaf";
  void operator()(sac::Scope& s, PieceRef piece) const {
    s.environment<World<sac::Scope, 2>>().leaves.begin(s, piece.piece);
  }
};
inline constexpr BeginLeaf begin_leaf{};

// Calls with the turn of a call of another tile. Questions come before births, as that call looks
// before it inserts: their names say so, since calls of one turn run in the order of names.

/// A look of another tile: who of this one's vertices would be around v.
struct Across {
  static constexpr std::string_view kName = "across";
  template <int D>
  void operator()(sac::Scope& s, VertexRef<D> v, double radius, std::uint32_t question) const {
    auto& w = s.template environment<World<sac::Scope, D>>();
    std::vector<VertexHandle> found;
    w.vertices.look_across(s, v, radius, found);
    w.border->answer(s, question, found);
  }
};
inline constexpr Across across{};

/// A vertex born at this turn (stage, rank, order) by a call of another tile, `from`. If its place
/// is this tile's, it is completed here, in a bucket that is not negative.
struct Arrive {
  static constexpr std::string_view kName = "arrive";
  template <int D>
  void operator()(sac::Scope& s, VertexRef<D> v, int bucket, std::uint32_t stage,
                  std::uint32_t rank, std::uint64_t order, std::uint32_t from) const {
    static_cast<void>(stage), static_cast<void>(rank);
    static_cast<void>(order), static_cast<void>(from);
    auto& w = s.template environment<World<sac::Scope, D>>();
    w.vertices.insert(s, v);
    if (bucket < 0) return;
    w.post_complete(s, v, bucket);
    w.post_star(s, v);
  }
};
inline constexpr Arrive arrive{};

/// The same on a segment: another tile has cut it, or it was split before anything is refined.
struct ArriveOnSegment {
  static constexpr std::string_view kName = "arrive_on_segment";
  template <int D>
  void operator()(sac::Scope& s, VertexRef<D> v, std::uint32_t segment, double distance,
                  bool from_b, std::uint32_t stage, std::uint32_t rank, std::uint64_t order,
                  std::uint32_t from) const {
    static_cast<void>(stage), static_cast<void>(rank);
    static_cast<void>(order), static_cast<void>(from);
    auto& w = s.template environment<World<sac::Scope, D>>();
    w.vertices.insert(s, v, Role{Label(distance, from_b), segment});
  }
};
inline constexpr ArriveOnSegment arrive_on_segment{};

// --- The parts of a first run

template <int D>
struct RunQuadtree {
  static constexpr std::string_view kName = "quadtree";
  void operator()(sac::Scope& s) const {
    auto& w = s.template environment<World<sac::Scope, D>>();
    if constexpr (D == 2) w.splits.drain(s);
    w.fills.drain(s);
    w.quadtree.drain(s);
  }
};
template <int D>
inline constexpr RunQuadtree<D> run_quadtree{};

template <int D>
struct RunPart {
  static constexpr std::string_view kName = "steiner";
  void operator()(sac::Scope& s, int part) const {
    auto& w = s.template environment<World<sac::Scope, D>>();
    w.parts[static_cast<std::size_t>(part)]->drain(s);
  }
};
template <int D>
inline constexpr RunPart<D> run_part{};

template <int D>
struct RunStars {
  static constexpr std::string_view kName = "stars";
  void operator()(sac::Scope& s) const {
    s.template environment<World<sac::Scope, D>>().stars.drain(s);
  }
};
template <int D>
inline constexpr RunStars<D> run_stars{};

}  // namespace mesher::detail
