// Leaves: pieces of segments that are edges of the mesh for some time, until they are cut.
//
// A leaf's record is found by its piece, so calls about it are recognised again. Its ball is the
// closed one that has it as diameter; the ends are not in it.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <ostream>
#include <tuple>
#include <utility>
#include <vector>

#include "geometry/diametral_ball.hpp"
#include "records/handle_table.hpp"
#include "records/reach_tree.hpp"
#include "records/roles.hpp"
#include "sac/sac.hpp"

namespace mesher::detail {

using LeafHandle = std::uint32_t;  // 0: none

struct Leaf {
  Piece piece;
  const Segment* segment = nullptr;  // that of the piece
  Point<2> lo{}, hi{};               // its ends
  LeafHandle self = 0;               // in a free record: the next free one
  LeafHandle next_changed = 0;
  sac::Presence begun, ended;  // the calls that make it a leaf, and those that cut it
  bool changed = false;        // listed by next_changed
  bool committed = false;      // a leaf at the end of the last update

  [[nodiscard]] Point<2> middle() const noexcept {
    return {lo[0] + (hi[0] - lo[0]) / 2, lo[1] + (hi[1] - lo[1]) / 2};
  }
  [[nodiscard]] bool has_in_ball(const Point<2>& x) const {
    return x != lo && x != hi && in_diametral_ball(x, lo, hi);
  }
  /// Whether an end of it and a place on `own`, another segment, are equally far from a common end
  /// of the two: corners of an isosceles triangle, whose base is at an acute angle to the leaf or,
  /// at the leaf's end, at an obtuse one. So that place is outside of the ball. In rounded
  /// coordinates the angle may be right.
  [[nodiscard]] bool ends_as_far(const Segment& own, const Label& label) const noexcept;
};

/// By coordinates. Of two pieces between the same places an update may know both: those of a
/// segment that goes and of one that comes, and those whose places are labelled in two ways.
[[nodiscard]] inline std::partial_ordering order(const Leaf& a, const Leaf& b) {
  const auto by_lo = a.lo <=> b.lo;
  if (by_lo != 0) return by_lo;
  const auto by_hi = a.hi <=> b.hi;
  if (by_hi != 0) return by_hi;
  const auto by_a = a.segment->place_a <=> b.segment->place_a;
  if (by_a != 0) return by_a;
  const auto by_b = a.segment->place_b <=> b.segment->place_b;
  if (by_b != 0) return by_b;
  const auto labels = [](const Piece& p) { return std::tuple(p.lo, p.hi, p.kind); };
  return labels(a.piece) <=> labels(b.piece);
}

/// An argument of traced functions: equal by identity, ordered as said.
struct LeafRef {
  Leaf* leaf = nullptr;

  Leaf& operator*() const noexcept { return *leaf; }
  Leaf* operator->() const noexcept { return leaf; }
  friend bool operator==(const LeafRef&, const LeafRef&) = default;
  friend std::partial_ordering operator<=>(const LeafRef& a, const LeafRef& b) {
    return order(*a.leaf, *b.leaf);
  }
  friend std::uint64_t hash_value(const LeafRef& r) noexcept { return r.leaf->self; }
  friend std::ostream& operator<<(std::ostream& out, const LeafRef& r) {
    const auto& [lo, hi] = std::pair(r.leaf->lo, r.leaf->hi);
    return out << '(' << lo[0] << ' ' << lo[1] << " - " << hi[0] << ' ' << hi[1] << ')';
  }
  friend void label_bytes(sac::LabelSink& sink, const LeafRef& r) {
    for (const Point<2>& p : {r.leaf->lo, r.leaf->hi}) {
      for (const double x : p) sink.number(std::bit_cast<std::uint64_t>(x));
    }
    for (const Label& l : {r.leaf->piece.lo, r.leaf->piece.hi}) {
      sink.number(l.bits());
    }
    sink.number(static_cast<std::uint64_t>(r.leaf->piece.kind));
  }
};

/// The records, found by piece and by what their balls hold.
class LeafRecords {
 public:
  LeafRecords(const MeshBox<2>& box, const SegmentPool& segments)
      : segments_(segments), by_piece_(*this), tree_(box) {}
  LeafRecords(const LeafRecords&) = delete;
  LeafRecords& operator=(const LeafRecords&) = delete;

  [[nodiscard]] Leaf& operator[](LeafHandle h) const noexcept {
    return (*chunks_[h / kChunk])[h % kChunk];
  }
  /// The record of a piece, made if there is none. Throws: std::bad_alloc, and then changes
  /// nothing.
  Leaf& record(const Piece& piece);
  /// Requires: nobody refers to the record any more.
  void release(Leaf& leaf) noexcept;
  /// The record is found by its piece alone from now on.
  void hide(const Leaf& leaf) noexcept { tree_.erase(leaf.middle(), leaf.self); }

  /// Whether the leaf has in its ball a place, or (unless the role is none) a vertex on another
  /// segment. By labels where coordinates may not tell.
  [[nodiscard]] bool has_in_ball(const Leaf& leaf, const Point<2>& x, const Role& role) const {
    if (role.on == leaf.piece.segment || !leaf.has_in_ball(x)) return false;
    if (role.on == 0 || !leaf.ends_as_far(segments_[role.on], role.label)) return true;
    overrules_ = true;
    return false;
  }
  /// Whether a label has ever overruled coordinates.
  [[nodiscard]] bool overrules() const noexcept { return overrules_; }
  /// Calls visit(leaf) for those of which that is true, in no particular order.
  template <class Visit>
  void for_each_with(const Point<2>& x, const Role& role, Visit&& visit) const {
    tree_.visit_at(x, [&](LeafHandle h) {
      if (has_in_ball((*this)[h], x, role)) visit((*this)[h]);
    });
  }
  /// Calls visit(leaf) for the records with an end at p, in no particular order.
  template <class Visit>
  void for_each_ending_at(const Point<2>& p, Visit&& visit) const {
    tree_.visit_at(p, [&](LeafHandle h) {
      if ((*this)[h].lo == p || (*this)[h].hi == p) visit((*this)[h]);
    });
  }
  /// Calls visit(leaf) for every record in use, in the order of handles.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (LeafHandle h = 1; h < next_; ++h) {
      if ((*this)[h].self == h) visit((*this)[h]);
    }
  }
  /// How much searches have looked at so far.
  [[nodiscard]] std::uint64_t looked_at() const noexcept { return tree_.looked_at(); }
  [[nodiscard]] std::size_t size() const noexcept { return by_piece_.size(); }
  [[nodiscard]] std::size_t bytes() const noexcept;
  /// Throws InvariantError if a record is not found by its piece, or lost.
  void check_invariants() const;

 private:
  static constexpr LeafHandle kChunk = 1024;
  using Chunk = std::array<Leaf, kChunk>;

  friend class HandleTable<LeafRecords>;
  using Key = Piece;
  [[nodiscard]] const Piece& key(LeafHandle h) const noexcept { return (*this)[h].piece; }
  [[nodiscard]] static std::size_t hash(const Piece& p) noexcept { return hash_value(p); }

  Leaf& create(const Piece& piece);
  LeafHandle fresh();

  const SegmentPool& segments_;
  std::vector<std::unique_ptr<Chunk>> chunks_;
  HandleTable<LeafRecords> by_piece_;
  ReachTree<LeafHandle> tree_;
  mutable bool overrules_ = false;
  LeafHandle free_ = 0;
  LeafHandle next_ = 1;
};

}  // namespace mesher::detail
