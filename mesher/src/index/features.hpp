// The features' points: input points, and the vertices at which long segments are split. For each
// point, the deepest level at which it is crowded; and the input points near a place.
//
// During an update two points may temporarily be in one finest cell, for example a new point beside
// a vertex that it will replace. One of them represents all; a query for the level of one that
// should be apart throws too_close.
#pragma once

#include <cstdint>
#include <functional>
#include <unordered_map>
#include <utility>

#include "index/feature_tree.hpp"
#include "sac/sac.hpp"

namespace mesher::detail {

/// Refuses two points of features in one finest cell. Throws: Error(too_close).
template <int D>
using RefuseClose = std::function<void(const Vertex<D>&, const Vertex<D>&)>;
/// The same, naming their places.
template <int D>
[[noreturn]] void refuse_close(const Vertex<D>& v, const Vertex<D>& w);

template <class S, int D = 2>
class Features;

template <int D>
class Features<sac::PlainScope, D> {
 public:
  Features(const MeshBox<D>& box, const VertexPool<D>& pool, sac::PlainScope&) : tree_(box, pool) {}

  /// Who says what is too close.
  void set_refusal(RefuseClose<D> refuse) { refuse_ = std::move(refuse); }

  [[nodiscard]] FeatureTree<D>& tree() noexcept { return tree_; }
  int level(sac::PlainScope&, const Vertex<D>& v) { return tree_.crowded_level(v); }
  /// A vertex at which a segment is split. Throws: Error(too_close).
  void insert(sac::PlainScope&, VertexRef<D> v);
  /// How much visit_points_in has looked at so far.
  [[nodiscard]] std::uint64_t looked_at() const noexcept { return tree_.looked_at(); }

  /// Calls visit(point) for the input points in the box, and others just outside, until it returns
  /// true; returns whether it did.
  template <class Visit>
  bool visit_points_in(const Box<D>& area, Visit&& visit) const {
    return tree_.visit_in(area, [&](const Vertex<D>& v) { return v.input && visit(v); });
  }
  /// The same for all features' points.
  template <class Visit>
  bool visit_features_in(const Box<D>& area, Visit&& visit) const {
    return tree_.visit_in(area, visit);
  }

 private:
  FeatureTree<D> tree_;
  RefuseClose<D> refuse_ = refuse_close<D>;
};

/// Who wants to know of points that come and go.
template <int D>
class PointListener {
 public:
  virtual void point_came(const Vertex<D>& v) noexcept = 0;
  virtual void point_went(const Vertex<D>& v) noexcept = 0;
  /// Of a feature's point that no call has located.
  virtual void level_changed(Vertex<D>&) noexcept {}

 protected:
  ~PointListener() = default;
};

/// Who wants to know of all features' points that come and go.
template <int D>
class FeatureListener {
 public:
  virtual void feature_changed(const Point<D>& p) noexcept = 0;

 protected:
  ~FeatureListener() = default;
};

/// As a traceable data type: a level has one observer, the call that locates the point. Points come
/// and go before all calls, and segments are split before all points are located; so an observation
/// is only invalidated by a changed level.
template <int D>
class Features<sac::Scope, D> : public sac::Structure {
 public:
  Features(const MeshBox<D>& box, VertexPool<D>& pool, sac::Engine& engine)
      : engine_(engine),
        box_(box),
        pool_(pool),
        tree_(box, pool),
        id_(engine.add_structure(*this)) {}

  void set_listener(PointListener<D>* listener) noexcept { listener_ = listener; }
  void set_feature_listener(FeatureListener<D>* listener) noexcept { feature_listener_ = listener; }
  /// Who says what is too close.
  void set_refusal(RefuseClose<D> refuse) { refuse_ = std::move(refuse); }

  /// The deepest level at which v is crowded, -1 if at none; observed by the running call.
  /// Throws: Error(too_close) if another is in v's finest cell.
  int level(sac::Scope& s, Vertex<D>& v);
  /// The running call splits a segment at v: an effect.
  void insert(sac::Scope& s, VertexRef<D> v);

  /// The input point in the finest cell of p; null if there is none.
  [[nodiscard]] const Vertex<D>* point_at(const Point<D>& p) const;
  /// Calls visit(point) for the input points in the box, and others just outside, until it returns
  /// true; returns whether it did.
  template <class Visit>
  bool visit_points_in(const Box<D>& area, Visit&& visit) const;
  /// The same for all features' points.
  template <class Visit>
  bool visit_features_in(const Box<D>& area, Visit&& visit) const;

  /// A point of the first run. Requires: point_at(v.p) == nullptr.
  void insert_first(Vertex<D>& v) {
    tree_.insert_only(v);
    v.feature = true;
  }
  /// Finds v's level after a first run in which nobody has asked for it; for several threads at
  /// once, each with a path of its own.
  void find_level(Vertex<D>& v, typename FeatureTree<D>::Path& path) const {
    v.level = static_cast<std::int16_t>(tree_.crowded_level(v, path));
  }
  /// All features' points. Requires: no two are in one finest cell.
  [[nodiscard]] const FeatureTree<D>& tree() const noexcept { return tree_; }
  /// Whether v is a feature's point.
  [[nodiscard]] bool has(const Vertex<D>& v) const {
    return v.feature || splits_.find(v.self) != splits_.end();
  }
  /// Throws: Error(too_close) if two are in one finest cell.
  void require_apart() const;
  /// An outside edit, with its inverse noted for a roll-back.
  void insert(Vertex<D>& v);
  void erase(Vertex<D>& v);

  /// Called by who edits the limits of size in `where`: who locates a feature asks about them.
  void limits_changed(const Box<D>& where) noexcept;

  void retract(sac::Call& call, sac::Edge& edge) noexcept override;
  void label(const sac::Call& call, const sac::Edge& edge, sac::LabelSink& sink) const override;
  void print(const sac::Call& call, const sac::Edge& edge, std::ostream& out) const override;

  /// How much visit_points_in has looked at so far.
  [[nodiscard]] std::uint64_t looked_at() const noexcept { return tree_.looked_at(); }
  /// While it is held several threads may visit at once, and nothing is counted.
  void hold(bool held) noexcept { tree_.hold(held); }

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
    std::size_t operator()(const Fixed<D>& cell) const noexcept {
      std::uint64_t h = 0;
      for (const std::uint64_t x : cell) h = sac::mix(h) + x;
      return sac::mix(h);
    }
  };
  void put_point(Vertex<D>& v);
  void take_point(Vertex<D>& v) noexcept;
  void put_split(Vertex<D>& v);
  void take_split(Vertex<D>& v) noexcept;
  void put(Vertex<D>& v);
  void take(Vertex<D>& v) noexcept;
  void put_in_tree(Vertex<D>& v);
  void take_from_tree(Vertex<D>& v) noexcept;
  void changed(Vertex<D>& v) noexcept;
  void cell_changed(const Point<D>& p) noexcept;
  [[nodiscard]] const Vertex<D>* companion(const Vertex<D>& v) const;

  sac::Engine& engine_;
  const MeshBox<D>& box_;
  VertexPool<D>& pool_;
  FeatureTree<D> tree_;
  std::unordered_map<VertexHandle, std::uint32_t> splits_;            // by how many calls
  std::unordered_multimap<Fixed<D>, VertexHandle, CellHash> hidden_;  // behind one in the tree
  PointListener<D>* listener_ = nullptr;
  FeatureListener<D>* feature_listener_ = nullptr;
  RefuseClose<D> refuse_ = refuse_close<D>;
  std::uint8_t id_;
};

template <int D>
template <class Visit>
bool Features<sac::Scope, D>::visit_features_in(const Box<D>& area, Visit&& visit) const {
  if (tree_.visit_in(area, visit)) return true;
  for (const auto& [cell, h] : hidden_) {
    if (visit(pool_[h])) return true;
  }
  return false;
}

template <int D>
template <class Visit>
bool Features<sac::Scope, D>::visit_points_in(const Box<D>& area, Visit&& visit) const {
  return visit_features_in(area, [&](const Vertex<D>& v) { return v.feature && visit(v); });
}

}  // namespace mesher::detail
