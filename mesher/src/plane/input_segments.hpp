// The segments of the input, the queries of calls about them, and edits from outside.
//
//   crowded(s, piece)   whether a piece has to be split before anything is refined  (observation)
//   halves(s, piece)    what it is split into, and where                            (observation)
#pragma once

#include <bit>
#include <optional>
#include <unordered_map>
#include <vector>

#include "index/vertex_index.hpp"
#include "plane/crowding.hpp"
#include "plane/segment_store.hpp"
#include "plane/shells.hpp"
#include "records/roles.hpp"

namespace mesher::detail {

/// All of a segment.
[[nodiscard]] inline PieceRef whole(const Segment& s) {
  return {&s, {Label::start(), Label::end(), s.self, PieceKind::whole}};
}

/// What a split makes: a vertex and two pieces.
struct Halves {
  Point<2> place;
  Role role;
  PieceRef lower, upper;
};
[[nodiscard]] inline Halves halves(const PieceRef& whole, const PieceSplit& split) {
  const auto& [segment, piece] = whole;
  return {place_of(*segment, split.at),
          {split.at, piece.segment},
          {segment, {piece.lo, split.at, piece.segment, split.lo}},
          {segment, {split.at, piece.hi, piece.segment, split.hi}}};
}

/// What a tile is told of a segment of the whole input, between two of its points. `name`: what all
/// tiles call it; another one has it only when all have forgotten this one.
struct GivenSegment {
  SegmentHandle name = 0;
  VertexHandle a = 0, b = 0;
  std::optional<Zones> was, is;  // nothing: it is not there
};

template <class S>
class InputSegments;

template <>
class InputSegments<sac::PlainScope> {
 public:
  InputSegments(const MeshBox<2>& box, const VertexIndex<sac::PlainScope>& vertices,
                Features<sac::PlainScope>& points, sac::PlainScope& s)
      : store_(box, vertices.pool()),
        crowding_(box, store_, points, s),
        shells_(box, vertices.pool(), store_, points, s) {}

  [[nodiscard]] const SegmentPool& pool() const noexcept { return store_.pool(); }
  [[nodiscard]] SegmentStore& store() noexcept { return store_; }
  [[nodiscard]] const SegmentStore& store() const noexcept { return store_; }

  [[nodiscard]] bool crowded(sac::PlainScope& s, const PieceRef& piece) {
    return crowding_.crowded(s, piece);
  }
  [[nodiscard]] Witness witness(const PieceRef& piece) { return crowding_.witness(piece); }
  [[nodiscard]] Halves halves(sac::PlainScope& s, const PieceRef& piece) {
    return detail::halves(piece, shells_.place(s, piece));
  }
  [[nodiscard]] PieceRef ref(const Piece& piece) const { return {&pool()[piece.segment], piece}; }

  /// Requires: a and b are different input points, and there is no such segment.
  [[nodiscard]] PieceRef insert(VertexHandle a, VertexHandle b);

 private:
  SegmentStore store_;
  Crowding<sac::PlainScope> crowding_;
  Shells<sac::PlainScope> shells_;
};

template <>
class InputSegments<sac::Scope> final : public PointListener<2> {
 public:
  /// `ends`: the points at which segments end, which are not the world's own in a tile; null: they
  /// are.
  InputSegments(const MeshBox<2>& box, VertexIndex<sac::Scope>& vertices,
                Features<sac::Scope>& points, sac::Engine& engine, const VertexPool<2>* ends)
      : engine_(engine),
        vertices_(vertices),
        is_given_(ends != nullptr),
        store_(box, is_given_ ? *ends : vertices.pool()),
        crowding_(box, store_, points, engine),
        shells_(box, vertices.pool(), store_, points, engine) {
    points.set_listener(this);
  }

  [[nodiscard]] const SegmentPool& pool() const noexcept { return store_.pool(); }
  [[nodiscard]] SegmentStore& store() noexcept { return store_; }
  [[nodiscard]] const SegmentStore& store() const noexcept { return store_; }

  [[nodiscard]] bool crowded(sac::Scope& s, const PieceRef& piece) {
    return crowding_.crowded(s, piece);
  }
  [[nodiscard]] Witness witness(const PieceRef& piece) { return crowding_.witness(piece); }
  [[nodiscard]] Halves halves(sac::Scope& s, const PieceRef& piece) {
    return detail::halves(piece, shells_.place(s, piece));
  }
  [[nodiscard]] PieceRef ref(const Piece& piece) const { return {&pool()[piece.segment], piece}; }

  /// Outside edits, with their inverses noted for a roll-back. Returns the whole segment.
  /// Requires: a and b are different input points, and there is no such segment (to insert), or
  /// there is (to erase). Throws: std::bad_alloc.
  PieceRef insert(VertexHandle a, VertexHandle b);
  PieceRef erase(VertexHandle a, VertexHandle b);
  /// The same, in a tile.
  void edit(const GivenSegment& given);
  /// In a tile: by what all tiles call it, and the reverse. A segment that has gone is known until
  /// commit().
  [[nodiscard]] SegmentHandle own(SegmentHandle name) const { return own_.at(name); }
  [[nodiscard]] SegmentHandle name(SegmentHandle own) const noexcept { return names_[own]; }
  /// In a tile: the point of the input there, if segments end at it; else 0.
  [[nodiscard]] VertexHandle end_at(const Point<2>& p) const {
    const auto it = ends_.find(p);
    return it == ends_.end() ? 0 : it->second;
  }
  /// How pieces of a segment are split, of now.
  [[nodiscard]] Zones zones(const Segment& s) { return shells_.zones(s); }

  void point_came(const Vertex<2>& v) noexcept override;
  void point_went(const Vertex<2>& v) noexcept override;
  void level_changed(Vertex<2>& v) noexcept override { vertices_.touch(v); }
  void limits_changed(const Box<2>& where) noexcept { crowding_.limits_changed(where); }

  /// Ends an update: frees the records of segments that have gone.
  void commit() noexcept;

  [[nodiscard]] std::size_t bytes() const noexcept {
    return store_.bytes() + crowding_.bytes() + shells_.bytes();
  }
  /// Requires: between updates. Throws InvariantError.
  void check_invariants() const {
    store_.check_invariants();
    crowding_.check_invariants();
    shells_.check_invariants();
  }

 private:
  void put(Segment& s);
  void take(Segment& s) noexcept;
  void legs_changed(const Segment& s) noexcept;
  void know(const GivenSegment& given, const Segment& s);
  void forget(const Segment& s) noexcept;

  struct PlaceHash {
    std::size_t operator()(const Point<2>& p) const noexcept {
      std::uint64_t h = 0;
      for (const double x : p) h = sac::mix(h) + std::bit_cast<std::uint64_t>(x + 0.0);
      return sac::mix(h);
    }
  };

  sac::Engine& engine_;
  VertexIndex<sac::Scope>& vertices_;
  bool is_given_;
  SegmentStore store_;
  Crowding<sac::Scope> crowding_;
  Shells<sac::Scope> shells_;
  // Of a tile.
  std::unordered_map<SegmentHandle, SegmentHandle> own_;        // by name
  std::vector<SegmentHandle> names_;                            // by handle
  std::unordered_map<Point<2>, VertexHandle, PlaceHash> ends_;  // of segments that are known
};

}  // namespace mesher::detail
