// The features' points: input points, and the vertices at which long segments are split. For each
// point, the deepest level at which it is crowded; and the input points near a place.
//
// What is not to be in one finest cell may be there for a while, as an update goes on: a point
// comes beside a vertex that its coming will take away. One of them stands for all; whoever asks
// for the level of one when they should be apart is told that they are too close.
#pragma once

#include <cstdint>
#include <functional>
#include <unordered_map>
#include <utility>

#include "index/feature_tree.hpp"
#include "sac/sac.hpp"

namespace mesher::detail {

/// Refuses two points of features in one finest cell. Throws: Error(too_close).
using RefuseClose = std::function<void(const Vertex<2>&, const Vertex<2>&)>;
/// The same, naming their places.
[[noreturn]] void refuse_close(const Vertex<2>& v, const Vertex<2>& w);

template <class S>
class Features;

template <>
class Features<sac::PlainScope> {
 public:
  Features(const MeshBox<2>& box, const VertexPool<2>& pool, sac::PlainScope&) : tree_(box, pool) {}

  /// Who says what is too close.
  void set_refusal(RefuseClose refuse) { refuse_ = std::move(refuse); }

  [[nodiscard]] FeatureTree<2>& tree() noexcept { return tree_; }
  int level(sac::PlainScope&, const Vertex<2>& v) { return tree_.crowded_level(v); }
  /// A vertex at which a segment is split. Throws: Error(too_close).
  void insert(sac::PlainScope&, VertexRef<2> v);
  /// How much visit_points_in has looked at so far.
  [[nodiscard]] std::uint64_t looked_at() const noexcept { return tree_.looked_at(); }

  /// Calls visit(point) for the input points in the box, and others just outside, until it returns
  /// true; returns whether it did.
  template <class Visit>
  bool visit_points_in(const Box<2>& area, Visit&& visit) const {
    return tree_.visit_in(area, [&](const Vertex<2>& v) { return v.input && visit(v); });
  }
  /// The same for all features' points.
  template <class Visit>
  bool visit_features_in(const Box<2>& area, Visit&& visit) const {
    return tree_.visit_in(area, visit);
  }

 private:
  FeatureTree<2> tree_;
  RefuseClose refuse_ = refuse_close;
};

/// Who wants to know of points that come and go.
class PointListener {
 public:
  virtual void point_came(const Vertex<2>& v) noexcept = 0;
  virtual void point_went(const Vertex<2>& v) noexcept = 0;

 protected:
  ~PointListener() = default;
};

/// Who wants to know of all features' points that come and go.
class FeatureListener {
 public:
  virtual void feature_changed(const Point<2>& p) noexcept = 0;

 protected:
  ~FeatureListener() = default;
};

/// As a traceable data type: a level has one observer, the call that locates the point. Points come
/// and go before all calls, and segments are split before all points are located; so an observation
/// is only invalidated by a changed level.
template <>
class Features<sac::Scope> : public sac::Structure {
 public:
  Features(const MeshBox<2>& box, VertexPool<2>& pool, sac::Engine& engine)
      : engine_(engine),
        box_(box),
        pool_(pool),
        tree_(box, pool),
        id_(engine.add_structure(*this)) {}

  void set_listener(PointListener* listener) noexcept { listener_ = listener; }
  void set_feature_listener(FeatureListener* listener) noexcept { feature_listener_ = listener; }
  /// Who says what is too close.
  void set_refusal(RefuseClose refuse) { refuse_ = std::move(refuse); }

  /// The deepest level at which v is crowded, -1 if at none; observed by the running call.
  /// Throws: Error(too_close) if another is in v's finest cell.
  int level(sac::Scope& s, Vertex<2>& v);
  /// The running call splits a segment at v: an effect.
  void insert(sac::Scope& s, VertexRef<2> v);

  /// The input point in the finest cell of p; null if there is none.
  [[nodiscard]] const Vertex<2>* point_at(const Point<2>& p) const;
  /// Calls visit(point) for the input points in the box, and others just outside, until it returns
  /// true; returns whether it did.
  template <class Visit>
  bool visit_points_in(const Box<2>& area, Visit&& visit) const;
  /// The same for all features' points.
  template <class Visit>
  bool visit_features_in(const Box<2>& area, Visit&& visit) const;

  /// A point of the first run. Requires: point_at(v.p) == nullptr.
  void insert_first(Vertex<2>& v) {
    tree_.insert_only(v);
    v.feature = true;
  }
  /// An outside edit, with its inverse noted for a roll-back.
  void insert(Vertex<2>& v);
  void erase(Vertex<2>& v);

  /// Called by who edits the limits of size in `where`: who locates a feature asks about them.
  void limits_changed(const Box<2>& where) noexcept;

  void retract(sac::Call& call, sac::Edge& edge) noexcept override;
  void label(const sac::Call& call, const sac::Edge& edge, sac::LabelSink& sink) const override;
  void print(const sac::Call& call, const sac::Edge& edge, std::ostream& out) const override;

  /// How much visit_points_in has looked at so far.
  [[nodiscard]] std::uint64_t looked_at() const noexcept { return tree_.looked_at(); }

  [[nodiscard]] std::size_t bytes() const noexcept { return tree_.bytes(); }
  void check_invariants() const override;

 private:
  static constexpr std::uint8_t kLevel = 0;
  static constexpr std::uint8_t kSplit = 1;
  struct LevelEdge : sac::Edge {
    VertexHandle vertex;
  };
  struct SplitEdge : sac::Edge {
    VertexHandle vertex;  // 0: nothing to take back
  };
  struct CellHash {
    std::size_t operator()(const Fixed<2>& cell) const noexcept {
      return sac::mix(sac::mix(cell[0]) + cell[1]);
    }
  };
  void put_point(Vertex<2>& v);
  void take_point(Vertex<2>& v) noexcept;
  void put_split(Vertex<2>& v);
  void take_split(Vertex<2>& v) noexcept;
  void put(Vertex<2>& v);
  void take(Vertex<2>& v) noexcept;
  void put_in_tree(Vertex<2>& v);
  void take_from_tree(Vertex<2>& v) noexcept;
  void changed(Vertex<2>& v) noexcept;
  void cell_changed(const Point<2>& p) noexcept;
  [[nodiscard]] const Vertex<2>* companion(const Vertex<2>& v) const;

  sac::Engine& engine_;
  const MeshBox<2>& box_;
  VertexPool<2>& pool_;
  FeatureTree<2> tree_;
  std::unordered_map<VertexHandle, std::uint32_t> splits_;            // by how many calls
  std::unordered_multimap<Fixed<2>, VertexHandle, CellHash> hidden_;  // behind one in the tree
  PointListener* listener_ = nullptr;
  FeatureListener* feature_listener_ = nullptr;
  RefuseClose refuse_ = refuse_close;
  std::uint8_t id_;
};

template <class Visit>
bool Features<sac::Scope>::visit_features_in(const Box<2>& area, Visit&& visit) const {
  if (tree_.visit_in(area, visit)) return true;
  for (const auto& [cell, h] : hidden_) {
    if (visit(pool_[h])) return true;
  }
  return false;
}

template <class Visit>
bool Features<sac::Scope>::visit_points_in(const Box<2>& area, Visit&& visit) const {
  return visit_features_in(area, [&](const Vertex<2>& v) { return v.feature && visit(v); });
}

}  // namespace mesher::detail
