// The vertices of the mesh in progress, as a traceable data type over the quadtree.
//
//   insert(s, p)           the running call produces a vertex               (effect)
//   insert(s, v)           the running call produces the record v           (effect)
//   voronoi_cell(s, v, R)  v's gap balls up to R, among the vertices born   (observation)
//                          before the running call
//   nearest2(s, v)         squared distance to v's nearest neighbour        (observation)
//   star(s, v)             v's Delaunay star among all vertices             (observation)
//   split(s, cell)         marks a quadtree cell as split                   (effect)
//
// A vertex that comes or goes invalidates exactly the later observations that it concerns: one that
// comes, those with a gap ball around it; one that goes, those whose cell it bounds.
//
// Two implementations: `VertexIndex<sac::Scope>` keeps this history, `VertexIndex<sac::PlainScope>`
// only the vertices.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "mesher/error.hpp"
#include "index/quadtree.hpp"
#include "sac/sac.hpp"
#include "index/vertex.hpp"
#include "geometry/voronoi_cell.hpp"

namespace mesher::detail {

template <class S>
class VertexIndex;

/// What both implementations share: records, the tree, and searching it.
class VertexSearch {
 public:
  explicit VertexSearch(const MeshBox<2>& box) : box_(box), tree_(box, pool_) {}
  VertexSearch(const VertexSearch&) = delete;
  VertexSearch& operator=(const VertexSearch&) = delete;

  [[nodiscard]] VertexPool<2>& pool() noexcept { return pool_; }
  [[nodiscard]] const VertexPool<2>& pool() const noexcept { return pool_; }
  [[nodiscard]] Quadtree<2>& tree() noexcept { return tree_; }
  [[nodiscard]] const Quadtree<2>& tree() const noexcept { return tree_; }
  [[nodiscard]] const MeshBox<2>& box() const noexcept { return box_; }
  /// Lengths are kept as floats in units of the box's side, a power of two. `x` must be >= 0.
  [[nodiscard]] float packed(double x) const noexcept;
  [[nodiscard]] double unpacked(float x) const noexcept { return double{x} * box_.side; }

  /// Clip radius at which no corner of a star is hidden: circumcentres lie in the box.
  [[nodiscard]] double whole() const noexcept { return 2 * box_.side; }

  /// The record of an input point, not alive yet. `first`: no vertex but the boundary's and inputs
  /// at other places is there.
  Vertex<2>& add_input(const Point<2>& p, bool first) {
    Vertex<2>* v = first ? nullptr : tree_.find(p);
    if (v == nullptr) {
      v = &pool_.create(p);
      tree_.insert(*v);
    }
    v->input = true;
    return *v;
  }

  /// A vertex of the boundary grid: there from the start, for good.
  VertexRef<2> add_boundary(const Point<2>& p) {
    Vertex<2>& v = pool_.create(p);
    v.alive = v.boundary = true;
    tree_.insert(v);
    return {&v};
  }

 protected:
  // Cuts `cell_` by all vertices u for which seen(u); u is a handle.
  template <class Seen>
  VoronoiCell& cut_around(const Vertex<2>& v, double radius, Seen&& seen) {
    cell_.reset(v, radius);
    return fill_open(v, seen);
  }
  template <class Seen>
  VoronoiCell& fill_open(const Vertex<2>& v, Seen&& seen) {
    const auto reach = [&] { return 2 * std::sqrt(cell_.open2()); };
    const auto enters = [&](const Point<2>& corner, double side) {
      return cell_.enters(corner, side, tree_.margin());
    };
    tree_.visit_around(v.p, reach, enters, [&](VertexHandle u, const Point<2>& p) {
      if (u == v.self || !cell_.in_reach(distance2(p, v.p)) || !cell_.cuts(p) || !seen(u)) {
        return false;
      }
      cell_.cut(u);
      return true;
    });
    return cell_;
  }

  struct Nearest {
    VertexHandle handle;
    double distance2;
  };
  template <class Seen>
  Nearest nearest_around(const Vertex<2>& v, Seen&& seen) const {
    Nearest best{0, 4 * box_.side * box_.side};
    const auto reach = [&] { return std::sqrt(best.distance2); };
    const auto enters = [](const Point<2>&, double) { return true; };
    tree_.visit_around(v.p, reach, enters, [&](VertexHandle u, const Point<2>& p) {
      const double d2 = distance2(p, v.p);
      if (u == v.self || d2 > best.distance2 || !seen(u)) return false;
      if (d2 == best.distance2 && best.handle != 0 && pool_[best.handle].p < p) return false;
      best = {u, d2};
      return true;
    });
    return best;
  }

  static double distance2(const Point<2>& u, const Point<2>& v) {
    const double x = u[0] - v[0];
    const double y = u[1] - v[1];
    return x * x + y * y;
  }

  [[noreturn]] static void fail_coincident(const Point<2>& p);

  const MeshBox<2>& box_;
  VertexPool<2> pool_;
  Quadtree<2> tree_;
  VoronoiCell cell_;
};

template <>
class VertexIndex<sac::PlainScope> : public VertexSearch {
 public:
  using VertexSearch::VertexSearch;

  VertexRef<2> insert(sac::PlainScope&, const Point<2>& p) {
    if (tree_.find(p) != nullptr) fail_coincident(p);
    Vertex<2>& v = pool_.create(p);
    v.alive = true;
    tree_.insert(v);
    return {&v};
  }
  void insert(sac::PlainScope&, VertexRef<2> v) { v->alive = true; }
  VoronoiCell& voronoi_cell(sac::PlainScope&, VertexRef<2> v, double radius) {
    return cut_around(*v, radius, [](VertexHandle) { return true; });
  }
  double nearest2(sac::PlainScope&, VertexRef<2> v) {
    return nearest_around(*v, [](VertexHandle) { return true; }).distance2;
  }
  VoronoiCell& star(sac::PlainScope& s, VertexRef<2> v) { return voronoi_cell(s, v, whole()); }
  void split(sac::PlainScope&, const Cell<2>& cell) { tree_.mark(cell); }
};

template <>
class VertexIndex<sac::Scope> : public VertexSearch, public sac::Structure {
 public:
  VertexIndex(const MeshBox<2>& box, sac::Engine& engine)
      : VertexSearch(box), engine_(engine), id_(engine.add_structure(*this)) {}

  VertexRef<2> insert(sac::Scope& s, const Point<2>& p);
  void insert(sac::Scope& s, VertexRef<2> v);
  VoronoiCell& voronoi_cell(sac::Scope& s, VertexRef<2> v, double radius);
  double nearest2(sac::Scope& s, VertexRef<2> v);
  VoronoiCell& star(sac::Scope& s, VertexRef<2> v);
  void split(sac::Scope& s, const Cell<2>& cell);

  void retract(sac::Call& call, sac::Edge& edge) noexcept override;
  void label(const sac::Call& call, const sac::Edge& edge, sac::LabelSink& sink) const override;
  void print(const sac::Call& call, const sac::Edge& edge, std::ostream& out) const override;

  /// The neighbours in v's star, counterclockwise, as recorded by the call that computed it.
  struct Ring {
    const std::uint32_t* handles = nullptr;
    int size = 0;
  };
  [[nodiscard]] Ring ring(const Vertex<2>& v) const;

  /// Since the last commit: vertices that may have come or gone, and stars that went and came,
  /// each as the vertex and its neighbours. Kept while `logging`.
  struct StarRecord {
    VertexHandle center;
    std::vector<VertexHandle> ring;
  };
  struct Log {
    std::vector<VertexHandle> touched;
    std::vector<StarRecord> stars_gone;
    std::vector<StarRecord> stars_come;
  };
  [[nodiscard]] const Log& log() const noexcept { return log_; }
  void set_logging(bool on) noexcept { logging_ = on; }
  /// Ends an update: frees the records of vertices that nobody produces.
  void commit();

  /// Called by what makes a record an input point, or no longer.
  void touch(Vertex<2>& v);

  void check_invariants() const;

 private:
  static constexpr std::uint8_t kBirth = 0;
  static constexpr std::uint8_t kCell = 1;
  static constexpr std::uint8_t kNearest = 2;
  static constexpr std::uint8_t kStar = 3;
  static constexpr std::uint8_t kSplit = 4;

  struct BirthEdge : sac::Edge {
    VertexHandle vertex;
    sac::Handle call;
    sac::Handle next_producer;
  };
  // An observation centred at a vertex; its neighbours' codes lie behind it.
  struct QueryEdge : sac::Edge {
    VertexHandle center;
    sac::Handle call;
    sac::Handle next_query;
    float reach;     // no farther vertex concerns it
    std::uint32_t news;
    float radius;    // the clip
    std::uint32_t count;

    [[nodiscard]] std::uint32_t* codes() noexcept {
      return reinterpret_cast<std::uint32_t*>(this + 1);
    }
    [[nodiscard]] const std::uint32_t* codes() const noexcept {
      return reinterpret_cast<const std::uint32_t*>(this + 1);
    }
  };
  struct SplitEdge : sac::Edge {
    Quadtree<2>::NodeIndex node;
  };

  [[nodiscard]] QueryEdge& query(sac::Handle h) const {
    return *engine_.arena().at<QueryEdge>(h);
  }
  [[nodiscard]] BirthEdge& producer(sac::Handle h) const {
    return *engine_.arena().at<BirthEdge>(h);
  }
  [[nodiscard]] bool born_before(const Vertex<2>& u, const sac::Call& call) const;
  void produce(sac::Scope& s, Vertex<2>& v);
  void choose_birth(Vertex<2>& v);
  void appeared(const Vertex<2>& v, const sac::Call* before);
  void vanished(const Vertex<2>& v, const sac::Call& from, const sac::Call* before);
  void record(sac::Scope& s, std::uint8_t kind, Vertex<2>& v, float reach, float radius);
  void unlink(QueryEdge& q);
  void retract_birth(BirthEdge& birth);
  [[nodiscard]] StarRecord star_record(const QueryEdge& q) const;
  [[nodiscard]] std::vector<std::uint32_t> canonical_codes(const QueryEdge& q) const;

  sac::Engine& engine_;
  std::uint8_t id_;
  bool logging_ = false;
  struct News {
    VertexHandle vertex;
    std::uint32_t next;
  };
  std::vector<News> news_{1};
  template <class Seen>
  VoronoiCell& cell_around(sac::Scope& s, std::uint8_t kind, const Vertex<2>& v, double radius,
                           Seen&& seen);
  double concern(const VoronoiCell& cell) const;
  std::vector<std::uint32_t> codes_;  // neighbours of the observation being recorded
  Log log_;
};

}  // namespace mesher::detail
