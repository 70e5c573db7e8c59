// The data that the mesher's calls share: the box, the rule, the features, the vertices, the work
// queues.
//
// The program (S is sac::Scope, or sac::PlainScope for a static run; D is the dimension):
//   refine = SplitSegments; Fill; BuildQT; ChooseSteiners; Triangulate
// Each part drains its agenda; a part posts on its own agenda and on those of later parts.
//
// PointWorld has the data for points. World adds the other features of a dimension: segments in the
// plane, edges and polygons in space, and in both limits of size; in higher dimensions nothing.
// program/lines.hpp answers the queries of the program about them.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "plane/exempt.hpp"
#include "plane/input_segments.hpp"
#include "plane/leaves.hpp"
#include "program/filling.hpp"
#include "program/point_world.hpp"
#include "program/space_world.hpp"

namespace mesher::detail {

template <class S, int D>
struct World : PointWorld<S, D> {
  template <class Host>
  World(const Options<D>& options, const MeshBox<D>& mesh_box, Host& host)
      : PointWorld<S, D>(options, mesh_box, host) {
    host.set_environment(this);
  }

  /// What is said where there are too many vertices.
  [[nodiscard]] Error too_many() const;
  [[noreturn]] void fail_useless(const Vertex<D>& v, const Vertex<D>& x) const;
};

template <class S>
struct World<S, 2> : PointWorld<S, 2> {
  using Base = PointWorld<S, 2>;
  using Base::box;
  using Base::features;
  using Base::limits;
  using Base::names;
  using Base::vertices;
  using typename Base::Agenda;

  InputSegments<S> segments;
  Leaves<S> leaves;
  FillPlans<S, 2> plans;
  Surroundings<S, 2> surroundings;
  Agenda& splits;
  Agenda& fills;

  template <class Host>
  World(const Options<2>& options, const MeshBox<2>& mesh_box, Host& host,
        TileBorder<2>* tile_border = nullptr)
      : Base(options, mesh_box, host, tile_border),
        segments(make_segments(*this, host)),
        leaves(vertices, segments.pool(), host),
        plans(box, limits, host),
        surroundings(box, limits, Obstacles<S, 2>(features, this->whole_features()), host),
        splits(host.make_agenda("segments", kKeyWidths)),
        fills(host.make_agenda("fill", kKeyWidths)) {
    host.set_environment(this);
    features.set_refusal([this](const Vertex<2>& v, const Vertex<2>& x) { fail_too_close(v, x); });
    vertices.set_refusal(
        [this](const Point<2>& p) { fail_near(p, 0, "a new vertex would coincide with another"); });
    if constexpr (S::kTraced) features.set_feature_listener(&surroundings);
    if (limits.any()) post_cells(*this);
  }

  /// Calls that may have asked about the limits there run again.
  void limits_changed(const Box<2>& where) noexcept;
  void post_edges() const noexcept {}  // segments are always split
  void retract_edges() const noexcept {}
  void post_split(S& s, const PieceRef& piece);
  /// fill() of what a cell consists of, which is split, too.
  void post_parts(S& s, const Cell<2>& c) { detail::post_parts(s, *this, c); }
  /// Whether there are any.
  bool post_cuts(S& s, const std::vector<LeafRef>& leaves, int b);
  /// Whether a poor triangle on the left of p -> q, its shortest edge, stays.
  [[nodiscard]] bool is_exempt(const Vertex<2>& p, const Vertex<2>& q) const {
    if constexpr (S::kTraced) {
      if (this->border != nullptr) [[unlikely]] {
        return detail::is_exempt(segments.store(), on_lines_in_tile(p), on_lines_in_tile(q));
      }
    }
    return detail::is_exempt(vertices, segments.store(), p, q);
  }
  /// In a tile: a leaf cannot be cut, or not yet.
  void refuse_cut(S& s, const Error& error);
  /// Throws: Error(too_close), with the ids of the piece's segment and of what crowds it.
  [[noreturn]] void fail_too_short(const PieceRef& piece);
  /// Throws: Error(too_close), with the ids of the features that v and x are on.
  [[noreturn]] void fail_too_close(const Vertex<2>& v, const Vertex<2>& x) const;
  /// What is said where there are too many vertices.
  [[nodiscard]] Error too_many() const;
  [[noreturn]] void fail_useless(const Vertex<2>& v, const Vertex<2>& x);
  /// Throws: Error(too_close), with the ids of the features nearest to p, within `radius` or not.
  [[noreturn]] void fail_near(const Point<2>& p, double radius, const std::string& why);

 private:
  static auto make_segments(Base& w, sac::Engine& engine) {
    return InputSegments<sac::Scope>(w.box, w.vertices, w.features, engine,
                                     w.border != nullptr ? w.border->whole().ends : nullptr);
  }
  static auto make_segments(Base& w, sac::PlainScope& s) {
    return InputSegments<sac::PlainScope>(w.box, w.vertices, w.features, s);
  }
  [[nodiscard]] VertexOnLines on_lines_in_tile(const Vertex<2>& v) const {
    if (v.on_segment || v.boundary) return {v.p, vertices.role(v), 0};
    return {v.p, {}, segments.end_at(v.p)};
  }
};

/// Splits segments and fills what must not be large, or is near others.
template <class S>
void drain_lines(S& s, World<S, 2>& w) {
  w.splits.drain(s);
  w.fills.drain(s);
}
template <class S>
void drain_lines(S& s, World<S, 3>& w) {
  w.splits.drain(s);
  w.fills.drain(s);
}

template <class S, int D>
void drain_lines(S&, World<S, D>&) {}

template <int D>
struct Refine {
  static constexpr std::string_view kName = "refine";
  template <class S>
  void operator()(S& s) const {
    auto& w = s.template environment<World<S, D>>();
    const auto now = [] { return std::chrono::steady_clock::now(); };
    w.marks[0] = now();
    drain_lines(s, w);
    w.begin_questions(s);
    w.quadtree.drain(s);
    w.marks[1] = now();
    w.steiner.drain(s);
    w.marks[2] = now();
    w.triangulate(s);
    w.marks[3] = now();
  }
};
template <int D>
inline constexpr Refine<D> refine{};

}  // namespace mesher::detail
