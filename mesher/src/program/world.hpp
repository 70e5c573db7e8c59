// What the mesher's calls share: the box, the rule, the features, the vertices, the work queues.
//
// The program (S is sac::Scope, or sac::PlainScope for a static run):
//   refine = BuildQT; ChooseSteiners; Triangulate
// Each part drains its agenda; a part posts on its own agenda and on those of later parts.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <type_traits>
#include <vector>

#include "geometry/grid.hpp"
#include "index/feature_tree.hpp"
#include "index/subdivision.hpp"
#include "index/vertex_index.hpp"
#include "mesher/mesher.hpp"
#include "rules/insertion_rule.hpp"
#include "sac/sac.hpp"
#include "segments/exempt.hpp"
#include "segments/leaves.hpp"
#include "segments/stand_in.hpp"

namespace mesher::detail {

/// The input points: for each, the deepest level at which it is crowded.
template <class S>
class Features;

template <>
class Features<sac::PlainScope> {
 public:
  Features(const MeshBox<2>& box, const VertexPool<2>& pool, sac::PlainScope&) : tree_(box, pool) {}

  [[nodiscard]] FeatureTree<2>& tree() noexcept { return tree_; }
  int level(sac::PlainScope&, const Vertex<2>& v) { return v.level; }

 private:
  FeatureTree<2> tree_;
};

/// As a traceable data type: a level has one observer, the call that locates the point. Edits come
/// from the outside, before all calls, so an observation is only invalidated by a changed level.
template <>
class Features<sac::Scope> : public sac::Structure {
 public:
  Features(const MeshBox<2>& box, VertexPool<2>& pool, sac::Engine& engine)
      : engine_(engine), pool_(pool), tree_(box, pool), id_(engine.add_structure(*this)) {}

  [[nodiscard]] FeatureTree<2>& tree() noexcept { return tree_; }
  [[nodiscard]] const FeatureTree<2>& tree() const noexcept { return tree_; }

  /// The deepest level at which v is crowded, -1 if at none; observed by the running call.
  int level(sac::Scope& s, Vertex<2>& v);

  /// An outside edit, with its inverse noted for a roll-back.
  void insert(Vertex<2>& v);
  void erase(Vertex<2>& v);

  void retract(sac::Call& call, sac::Edge& edge) noexcept override;
  void label(const sac::Call& call, const sac::Edge& edge, sac::LabelSink& sink) const override;
  void print(const sac::Call& call, const sac::Edge& edge, std::ostream& out) const override;

 private:
  struct LevelEdge : sac::Edge {
    VertexHandle vertex;
  };
  void put(Vertex<2>& v);
  void take(Vertex<2>& v);
  void changed(Vertex<2>& v);

  sac::Engine& engine_;
  VertexPool<2>& pool_;
  FeatureTree<2> tree_;
  std::uint8_t id_;
};

/// The triangles of a static run, as they are output, and who watches it.
struct PlainOutput {
  std::vector<std::array<VertexHandle, 3>> triangles;
  std::uint64_t calls = 0;  // those that say so by tick()
  std::uint64_t next_report = ~std::uint64_t{0};
  std::function<void(PlainOutput&)> report;  // sets the next report; may throw

  void tick() {
    if (++calls >= next_report) report(*this);
  }
};
struct TracedOutput {};  // the stars' observations are the output

template <class S>
struct World {
  using Agenda = typename S::AgendaType;

  MeshBox<2> box;
  std::unique_ptr<const InsertionRule> rule;
  VertexIndex<S> vertices;
  Subdivision<S> subdivision;
  Features<S> features;
  StandIn stand_in;
  Leaves<S> leaves;
  Agenda& quadtree;
  Agenda& steiner;
  Agenda& stars;
  std::conditional_t<S::kTraced, TracedOutput, PlainOutput> plain;
  std::array<std::chrono::steady_clock::time_point, 4> marks{};

  template <class Host>
  World(const Options<2>& options, const MeshBox<2>& mesh_box, Host& host)
      : box(mesh_box),
        rule(insertion_rule(options, box)),
        vertices(make_vertices(box, host)),
        subdivision(vertices.tree(), host),
        features(box, vertices.pool(), host),
        stand_in(vertices.pool()),
        leaves(vertices, stand_in.segments, host),
        quadtree(host.make_agenda("quadtree")),
        steiner(host.make_agenda("steiner")),
        stars(host.make_agenda("stars")) {
    host.set_environment(this);
    add_boundary();
  }

  [[nodiscard]] const Buckets<2>& buckets() const noexcept { return rule->buckets(); }
  void post_nearest(S& s, VertexRef<2> v, int leaf_level);
  void post_nearest_in(S& s, VertexRef<2> v, int b);
  void post_complete(S& s, VertexRef<2> v, int b);
  /// Whether there are any.
  bool post_cuts(S& s, const std::vector<LeafRef>& leaves, int b);
  void post_star(S& s, VertexRef<2> v);
  void output(S& s, VertexRef<2> v, const VoronoiCell& star);
  /// Whether a poor triangle on the left of p -> q stays.
  [[nodiscard]] bool is_exempt(const Vertex<2>& p, const Vertex<2>& q) const {
    return detail::is_exempt(vertices, stand_in.segments, p, q, [&](VertexHandle v, auto&& visit) {
      stand_in.for_each_at(v, visit);
    });
  }
  struct Halves {
    Point<2> place;
    Role role;
    Piece lower, upper;
  };
  Halves halves(S&, const Piece& piece) {
    const PieceSplit at = stand_in.place(piece);
    const Segment& seg = stand_in.segments[piece.segment];
    return {place_of(seg, at.at), {at.at, piece.segment}, {piece.lo, at.at, piece.segment, at.lo}, {at.at, piece.hi, piece.segment, at.hi}};
  }
  [[noreturn]] void fail_useless(const Vertex<2>& v, const Vertex<2>& x) const;

 private:
  static auto make_vertices(const MeshBox<2>& box, sac::Engine& engine) {
    return VertexIndex<sac::Scope>(box, engine);
  }
  static auto make_vertices(const MeshBox<2>& box, sac::PlainScope&) {
    return VertexIndex<sac::PlainScope>(box);
  }
  void add_boundary();
};

/// The box of a mesh: four times the domain's longest side (rounded up to a power of two), with the
/// boundary grid that [L 4.4.1] asks for. Throws: Error(bad_option).
template <int D>
[[nodiscard]] MeshBox<D> mesh_box(const Options<D>& options);

struct Refine {
  static constexpr std::string_view kName = "refine";
  template <class S>
  void operator()(S& s) const {
    auto& w = s.template environment<World<S>>();
    const auto now = [] { return std::chrono::steady_clock::now(); };
    w.marks[0] = now();
    w.quadtree.drain(s);
    w.marks[1] = now();
    w.steiner.drain(s);
    w.marks[2] = now();
    w.stars.drain(s);
    w.marks[3] = now();
  }
};
inline constexpr Refine refine{};

}  // namespace mesher::detail
