// The position at which a piece of a segment is split [rules A1].
//
// At the roundest number, a multiple of the largest power of two, in the middle third of the piece,
// measured along the segment from the end that is its *origin*. Beside the origin these are powers
// of two, on all segments there, so that vertices of segments that meet at a small angle come in
// pairs at equal distances; elsewhere a piece is nearly always halved.
//
// How far from an end b the distances from b matter is the zone Z(b), the largest over the other
// segments t at b of
//     min(|s|, |t|)      if the angle there is under 20 degrees,
//     min(R(b), |t|)     if it is under 60; R(b) is the distance of the nearest feature not at b,
//     at
//                        most the length of the shortest segment at b,
//     0                  else.
// The origin is a, unless only b's zone reaches the middle; if both do, the middle is where each
// half begins to have its own. The last piece of length <= Z at the other end is measured from
// there.
//
//   place(s, piece)   (observation of the zones, where they matter)
//
// In a tile, which does not have all features, zones are given from outside.
#pragma once

#include <limits>
#include <unordered_map>
#include <vector>

#include "geometry/box.hpp"
#include "index/features.hpp"
#include "plane/leg_fan.hpp"
#include "plane/segment_store.hpp"

namespace mesher::detail {

/// Where a piece is split, and the kinds of its halves.
struct PieceSplit {
  Label at;
  PieceKind lo = PieceKind::whole, hi = PieceKind::whole;
  friend bool operator==(const PieceSplit&, const PieceSplit&) = default;
};

/// The zones at a segment's ends.
struct Zones {
  double a = 0, b = 0;
  friend bool operator==(const Zones&, const Zones&) = default;
};

/// How a piece is split, given the zones. Only some kinds look at them: looks_at_zones(kind).
[[nodiscard]] PieceSplit split_place(const PieceRef& piece, const Zones& zones);
[[nodiscard]] inline bool looks_at_zones(PieceKind kind) noexcept {
  return kind != PieceKind::from_a && kind != PieceKind::from_b;
}

/// The zone of s at an end, where R is reach().
template <class Reach>
[[nodiscard]] double zone(const Segment& s, const LongestBeside& others, Reach&& reach) {
  const double near = std::min(s.length, others.within_20);
  return others.within_60 > 0 ? std::max(near, std::min(reach(), others.within_60)) : near;
}

/// R(end).
template <class S>
[[nodiscard]] double apex_reach(SegmentStore& segments, const Features<S>& points,
                                const Vertex<2>& end);

/// R of the points that have been asked for.
class ApexReaches {
 public:
  explicit ApexReaches(const MeshBox<2>& box) : discs_(box) {}

  /// What compute() says, kept until forget(). Throws: std::bad_alloc.
  template <class Compute>
  double of(const Vertex<2>& v, Compute&& compute);
  [[nodiscard]] bool knows(VertexHandle v) const { return reaches_.find(v) != reaches_.end(); }
  /// Some point whose disc meets the segment pq; 0: none.
  [[nodiscard]] VertexHandle meeting(const Point<2>& p, const Point<2>& q) const;
  /// Requires: knows(v.self).
  void forget(const Vertex<2>& v) noexcept;
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (const auto& [v, reach] : reaches_) visit(v, reach);
  }
  [[nodiscard]] std::size_t bytes() const noexcept { return discs_.bytes(); }

 private:
  std::unordered_map<VertexHandle, double> reaches_;
  ReachTree<VertexHandle> discs_;
};

template <class S>
class Shells;

template <>
class Shells<sac::PlainScope> {
 public:
  Shells(const MeshBox<2>& box, const VertexPool<2>& pool, SegmentStore& segments,
         const Features<sac::PlainScope>& points, sac::PlainScope&)
      : pool_(pool), segments_(segments), points_(points), reaches_(box) {}

  [[nodiscard]] PieceSplit place(sac::PlainScope&, const PieceRef& piece);

 private:
  const VertexPool<2>& pool_;
  SegmentStore& segments_;
  const Features<sac::PlainScope>& points_;
  ApexReaches reaches_;
  LegFans fans_;
};

template <>
class Shells<sac::Scope> : public sac::Structure {
 public:
  Shells(const MeshBox<2>& box, const VertexPool<2>& pool, SegmentStore& segments,
         const Features<sac::Scope>& points, sac::Engine& engine)
      : engine_(engine),
        pool_(pool),
        segments_(segments),
        points_(points),
        reaches_(box),
        id_(engine.add_structure(*this)) {}

  [[nodiscard]] PieceSplit place(sac::Scope& s, const PieceRef& piece);
  /// Of now. Where they may have changed, the store says that the segment has.
  [[nodiscard]] Zones zones(const Segment& s);

  /// An outside edit: from here on zones are as they are given.
  void give(const Segment& s, const Zones& zones);
  /// Outside edits: a feature on pq has come or gone; t, at both of its ends.
  void feature_changed(const Point<2>& p, const Point<2>& q) noexcept;
  void segment_changed(const Segment& t) noexcept;

  void retract(sac::Call& call, sac::Edge& edge) noexcept override;
  [[nodiscard]] bool unchanged(sac::Call& call, sac::Edge& edge) override;
  void label(const sac::Call& call, const sac::Edge& edge, sac::LabelSink& sink) const override;
  void print(const sac::Call& call, const sac::Edge& edge, std::ostream& out) const override;

  [[nodiscard]] std::size_t bytes() const noexcept { return reaches_.bytes() + fans_.bytes(); }
  /// Throws InvariantError; among others if an answer is not what the zones of now give.
  void check_invariants() const override;

 private:
  static constexpr std::uint8_t kPlace = 0;
  struct PlaceEdge : sac::Edge {
    sac::Ref<sac::Call> call;
    sac::Handle next;  // about the same segment
    PieceRef piece;
    PieceSplit seen;
  };
  [[nodiscard]] PlaceEdge& at(sac::Handle h) const noexcept {
    return *engine_.arena().at<PlaceEdge>(h);
  }
  [[nodiscard]] PieceSplit answer(const PieceRef& piece);
  void forget(VertexHandle apex) noexcept;
  void doubt_at(VertexHandle end) noexcept;
  void doubt(const Segment& s) noexcept;

  sac::Engine& engine_;
  const VertexPool<2>& pool_;
  SegmentStore& segments_;
  const Features<sac::Scope>& points_;
  ApexReaches reaches_;
  LegFans fans_;
  std::vector<Zones> given_;  // by segment; empty: they are found
  std::uint8_t id_;
};

template <class Compute>
double ApexReaches::of(const Vertex<2>& v, Compute&& compute) {
  const auto it = reaches_.find(v.self);
  if (it != reaches_.end()) return it->second;
  const double reach = compute();
  const auto fresh = reaches_.emplace(v.self, reach).first;
  try {
    discs_.insert(v.p, reach, v.self);
  } catch (...) {
    reaches_.erase(fresh);
    throw;
  }
  return reach;
}

template <class S>
double apex_reach(SegmentStore& segments, const Features<S>& points, const Vertex<2>& end) {
  double reach = std::numeric_limits<double>::infinity();
  segments.visit_at(end.self, [&](const Segment& t) { reach = std::min(reach, t.length); });
  double nearest2 = reach * reach;
  segments.visit_near(end.p, end.p, reach, [&](const Segment& t) {
    if (!t.has_end(end.self)) {
      nearest2 = std::min(nearest2, distance2(end.p, t.place_a, t.place_b));
    }
    return false;
  });
  points.visit_points_in(around(end.p, reach), [&](const Vertex<2>& v) {
    if (v.self != end.self) nearest2 = std::min(nearest2, distance2(end.p, v.p, v.p));
    return false;
  });
  return std::min(reach, std::sqrt(nearest2));
}

}  // namespace mesher::detail
