// Decides whether a piece of a segment is crowded [rules A2], i.e. must be split before refinement.
//
// A piece is crowded if
//   (1) a segment without a common end meets the open ball that has the piece as its diameter,
//   (2) an input point that is no end of its segment is in that ball, closed, or
//   (3) such a segment or point is nearer to the piece than an eighth of its length.
// This is a function of the input alone, found near the piece.
//
//   crowded(s, piece)   (observation)
//
// An observation keeps a witness, one of the features that crowd the piece. So an edit that brings
// a feature changes the answers of the pieces nearby that had none, one that takes a feature those
// whose witness it was and that have no other; and only a changed answer runs a call again.
//
// This is the case of the plane; pieces, and the test whether they are crowded, are a parameter.
#pragma once

#include <algorithm>
#include <cmath>

#include "index/features.hpp"
#include "plane/segment_store.hpp"

namespace mesher::detail {

/// Where features crowd a piece.
class CrowdedZone {
 public:
  explicit CrowdedZone(const PieceRef& piece) : segment_(*piece.segment) {
    lo_ = piece.lo(), hi_ = piece.hi();
    middle_ = {(lo_[0] + hi_[0]) / 2, (lo_[1] + hi_[1]) / 2};
    const double x = hi_[0] - lo_[0], y = hi_[1] - lo_[1];
    length2_ = x * x + y * y;
  }
  [[nodiscard]] const Point<2>& middle() const noexcept { return middle_; }
  /// The zone lies within this around the middle: half the length and an eighth, and some rounding.
  [[nodiscard]] double reach() const noexcept {
    return 0.625 * std::sqrt(length2_) * (1 + 0x1p-30);
  }
  [[nodiscard]] Box<2> box() const noexcept {
    const double r = reach();
    return {{middle_[0] - r, middle_[1] - r}, {middle_[0] + r, middle_[1] + r}};
  }

  [[nodiscard]] bool has(const Segment& t) const {
    if (t.has_end(segment_.a) || t.has_end(segment_.b)) return false;
    return distance2(middle_, t.place_a, t.place_b) < length2_ / 4 ||
           distance2(lo_, hi_, t.place_a, t.place_b) < length2_ / 64;
  }
  [[nodiscard]] bool has(const Vertex<2>& v) const {
    if (segment_.has_end(v.self)) return false;
    const double from_right_angle =
        (v.p[0] - lo_[0]) * (v.p[0] - hi_[0]) + (v.p[1] - lo_[1]) * (v.p[1] - hi_[1]);
    return from_right_angle <= kSurplus * length2_ || distance2(v.p, lo_, hi_) < length2_ / 64;
  }

 private:
  // What the rounding of the scalar product beside the ball may be, and a good deal more: what is
  // not crowded here has no input point in its closed ball.
  static constexpr double kSurplus = 1e-12;

  const Segment& segment_;
  Point<2> lo_, hi_, middle_;
  double length2_;
};

/// A feature: an input point, a segment, or nothing.
class Witness {
 public:
  Witness() = default;
  explicit Witness(const Vertex<2>& v) noexcept : code_(v.self) {}
  explicit Witness(const Segment& s) noexcept : code_(s.self | kSegment) {}
  [[nodiscard]] explicit operator bool() const noexcept { return code_ != 0; }
  friend bool operator==(const Witness&, const Witness&) = default;

  [[nodiscard]] SegmentHandle segment() const noexcept {
    return (code_ & kSegment) != 0 ? code_ & ~kSegment : 0;
  }
  [[nodiscard]] VertexHandle point() const noexcept { return (code_ & kSegment) != 0 ? 0 : code_; }

 private:
  static constexpr std::uint32_t kSegment = 0x80000000u;
  std::uint32_t code_ = 0;
};

/// Some feature in the zone.
template <class S>
[[nodiscard]] Witness find_witness(const CrowdedZone& zone, SegmentStore& segments,
                                   const Features<S>& points) {
  Witness witness;
  const auto take = [&](const auto& feature) {
    if (!zone.has(feature)) return false;
    witness = Witness(feature);
    return true;
  };
  if (segments.visit_near(zone.middle(), zone.middle(), zone.reach(), take)) return witness;
  points.visit_points_in(zone.box(), take);
  return witness;
}

/// Where a feature lies: within `slack` of the segment pq.
template <int D>
struct FeatureExtent {
  Point<D> p{}, q{};
  double slack = 0;
};
[[nodiscard]] inline FeatureExtent<2> extent_of(const Segment& s) { return {s.place_a, s.place_b}; }
[[nodiscard]] inline FeatureExtent<2> extent_of(const Vertex<2>& v) { return {v.p, v.p}; }

/// Pieces of segments in the plane.
struct PlanePieces {
  static constexpr int kDimension = 2;
  using Piece = PieceRef;
  using Zone = CrowdedZone;
  using Witness = detail::Witness;
  using Store = SegmentStore;
  [[nodiscard]] static bool alive(const PieceRef& piece) { return piece.segment->alive; }
};

template <class S, class Kind = PlanePieces>
class Crowding;

template <class Kind>
class Crowding<sac::PlainScope, Kind> {
  static constexpr int D = Kind::kDimension;

 public:
  using Piece = typename Kind::Piece;
  using Witness = typename Kind::Witness;
  using Store = typename Kind::Store;

  Crowding(const MeshBox<D>&, Store& segments, Features<sac::PlainScope, D>& points,
           sac::PlainScope&)
      : segments_(segments), points_(points) {}

  [[nodiscard]] bool crowded(sac::PlainScope&, const Piece& piece) {
    return static_cast<bool>(witness(piece));
  }
  /// Some feature that crowds the piece.
  [[nodiscard]] Witness witness(const Piece& piece) {
    return find_witness(typename Kind::Zone(piece), segments_, points_);
  }

 private:
  Store& segments_;
  Features<sac::PlainScope, D>& points_;
};

template <class Kind>
class Crowding<sac::Scope, Kind> : public sac::Structure {
  static constexpr int D = Kind::kDimension;
  using Zone = typename Kind::Zone;

 public:
  using Piece = typename Kind::Piece;
  using Witness = typename Kind::Witness;
  using Store = typename Kind::Store;

  Crowding(const MeshBox<D>& box, Store& segments, Features<sac::Scope, D>& points,
           sac::Engine& engine)
      : engine_(engine),
        segments_(segments),
        points_(points),
        tree_(box),
        id_(engine.add_structure(*this)) {}

  [[nodiscard]] bool crowded(sac::Scope& s, const Piece& piece);
  /// Some feature that crowds the piece.
  [[nodiscard]] Witness witness(const Piece& piece) {
    return find_witness(Zone(piece), segments_, points_);
  }

  /// Outside edits: what has come is there already, what has gone is no longer.
  /// Cost: O(log L/s), and that of a look for each piece whose witness has gone.
  template <class Feature>
  void came(const Feature& f) noexcept;
  template <class Feature>
  void went(const Feature& f) noexcept;
  /// Called by who edits the limits of size in `where`: who asks whether a piece is crowded asks
  /// about the limits in the box around its ball, too.
  void limits_changed(const Box<D>& where) noexcept;

  void retract(sac::Call& call, sac::Edge& edge) noexcept override;
  [[nodiscard]] bool unchanged(sac::Call& call, sac::Edge& edge) override;
  void label(const sac::Call& call, const sac::Edge& edge, sac::LabelSink& sink) const override;
  void print(const sac::Call& call, const sac::Edge& edge, std::ostream& out) const override;

  [[nodiscard]] std::size_t bytes() const noexcept { return tree_.bytes(); }
  /// Throws InvariantError; among others if an answer is not what a look at the input finds, or a
  /// witness is none. Cost: O(observations) looks.
  void check_invariants() const override;

 private:
  static constexpr std::uint8_t kCrowded = 0;
  struct CrowdedEdge : sac::Edge {
    sac::Ref<sac::Call> call;
    Witness witness;  // of now
    Piece piece;
    bool seen;    // the answer that the call had
    bool listed;  // in tree_
  };
  [[nodiscard]] CrowdedEdge& at(sac::Handle h) const noexcept {
    return *engine_.arena().at<CrowdedEdge>(h);
  }
  [[nodiscard]] Witness find_weighed(sac::Scope& s, const Zone& zone);
  void turn(CrowdedEdge& edge, Witness witness) noexcept;

  sac::Engine& engine_;
  Store& segments_;
  Features<sac::Scope, D>& points_;
  ReachTree<sac::Handle, D> tree_;  // of the observations, by the zones
  std::uint8_t id_;
};

template <class Kind>
template <class Feature>
void Crowding<sac::Scope, Kind>::came(const Feature& f) noexcept {
  if (tree_.size() == 0) return;
  const FeatureExtent<D> where = extent_of(f);
  tree_.visit_near(where.p, where.q, where.slack, [&](sac::Handle h) {
    CrowdedEdge& edge = at(h);
    if (!edge.witness && Zone(edge.piece).has(f)) turn(edge, Witness(f));
  });
}

template <class Kind>
template <class Feature>
void Crowding<sac::Scope, Kind>::went(const Feature& f) noexcept {
  if (tree_.size() == 0) return;
  const FeatureExtent<D> where = extent_of(f);
  tree_.visit_near(where.p, where.q, where.slack, [&](sac::Handle h) {
    CrowdedEdge& edge = at(h);
    if (edge.witness == Witness(f)) turn(edge, witness(edge.piece));
  });
}

}  // namespace mesher::detail
