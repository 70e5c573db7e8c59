// The data that the calls of the program share for points alone: the box, the rule, the features,
// the vertices, the work queues. World (program/world.hpp) adds the other features of a dimension.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "borders/halo_border.hpp"
#include "borders/tile_border.hpp"
#include "geometry/grid.hpp"
#include "index/features.hpp"
#include "index/subdivision.hpp"
#include "index/vertex_index.hpp"
#include "mesher/mesher.hpp"
#include "plane/planarity.hpp"
#include "rules/insertion_rule.hpp"
#include "sac/sac.hpp"
#include "sizes/limits_of.hpp"

namespace mesher::detail {

/// The simplices of a static run without a triangulation of its own, and who watches it.
template <int D>
struct PlainOutput {
  std::vector<std::array<VertexHandle, D + 1>> simplices;
  std::uint64_t calls = 0;  // those that say so by tick()
  std::uint64_t next_report = ~std::uint64_t{0};
  std::function<void(PlainOutput&)> report;  // sets the next report; may throw

  void tick() {
    if (++calls >= next_report) report(*this);
  }
};
struct TracedOutput {};  // it is the triangulation that is kept, beyond space the stars

template <class S, int D>
struct PointWorld {
  using Agenda = typename S::AgendaType;

  MeshBox<D> box;
  using AnyCell = Cell<D>;

  LimitsOf<D> limits;
  std::unique_ptr<const InsertionRule<D>> rule;
  VertexIndex<S, D> vertices;
  Subdivision<S, D> subdivision;
  Features<S, D> features;
  Agenda& quadtree;
  Agenda& steiner;
  Agenda& stars;
  std::size_t most_vertices;
  std::size_t most_records;  // while an update is under way, of vertices that come and that go
  TileBorder<D>* border = nullptr;  // of a tile; null: this is all
  std::vector<Agenda*> parts;       // of a tile: `steiner` by buckets, from the first on
  HaloBorder<D>* halo = nullptr;    // of a static run for a tile; null: this is all
  const Names* names = nullptr;     // for messages; null: features have none
  bool locates = true;              // false: segments are split, and nothing else is done
  std::conditional_t<S::kTraced, TracedOutput, PlainOutput<D>> plain;
  std::array<std::chrono::steady_clock::time_point, 4> marks{};

  template <class Host>
  PointWorld(const Options<D>& options, const MeshBox<D>& mesh_box, Host& host,
             TileBorder<D>* tile_border = nullptr)
      : box(mesh_box),
        limits(options, box),
        rule(insertion_rule<D>(options, box, limits)),
        vertices(make_vertices(box, host)),
        subdivision(vertices.tree(), host),
        features(box, vertices.pool(), host),
        quadtree(host.make_agenda("quadtree", kKeyWidths)),
        steiner(host.make_agenda("steiner", kKeyWidths)),
        stars(host.make_agenda("stars", kKeyWidths)),
        most_vertices(options.max_vertices != 0 ? options.max_vertices : ~std::size_t{0}),
        most_records(most_vertices),
        border(tile_border) {
    if (border != nullptr) make_parts(host);
    add_boundary();
  }
  PointWorld(const PointWorld&) = delete;
  PointWorld& operator=(const PointWorld&) = delete;

  [[nodiscard]] const Buckets<D>& buckets() const noexcept { return rule->buckets(); }
  void post_nearest(S& s, VertexRef<D> v, int leaf_level);
  /// Requires: no vertex is nearer than `distance` when Complete begins.
  void post_nearest_from(S& s, VertexRef<D> v, double distance);
  void post_nearest_in(S& s, VertexRef<D> v, int b);
  void post_complete(S& s, VertexRef<D> v, int b);
  /// Beyond space: v's star is looked at when all vertices are there.
  void post_star(S& s, VertexRef<D> v);
  /// `cell`: of v, which has been completed. In a tile: v's star is looked at then if it may have
  /// vertices beyond the territory, which are learnt of so. (Cells shrink: in any other star is no
  /// vertex that has not been met.) Where the mesh is put together elsewhere nobody needs that.
  void post_border_star(S& s, VertexRef<D> v, const CellOf<D>& cell);
  /// The same of v that is not completed: nobody farther than `reach` will be around it.
  void post_border_star(S& s, VertexRef<D> v, double reach);
  /// Where the events of bucket b wait.
  [[nodiscard]] Agenda& steiner_at(int b) noexcept {
    if (parts.empty()) return steiner;
    const std::size_t part = part_of(b);
    return *parts[part];
  }
  /// Which of `parts` has the events of bucket b.
  [[nodiscard]] std::size_t part_of(int b) const noexcept {
    const auto at = static_cast<std::size_t>(std::clamp(b, 0, buckets().count() - 1));
    return at * parts.size() / static_cast<std::size_t>(buckets().count());
  }
  /// Whether calls about what is at p are this world's: not if it is another tile's.
  [[nodiscard]] bool owns(const Point<D>& p) const noexcept {
    return border == nullptr || border->owns(p);
  }
  /// Whether there may be places in the box that it owns.
  [[nodiscard]] bool meets(const Box<D>& area) const noexcept {
    return border == nullptr || border->meets(area);
  }
  /// In a tile: see WholeInput; null: what is here is all.
  [[nodiscard]] const FeatureTree<D>* whole_features() const noexcept {
    return border == nullptr ? nullptr : border->whole().features;
  }
  /// Whether it is for a part of the mesh, where a call may meet what will not be there in the end.
  [[nodiscard]] bool is_part() const noexcept { return border != nullptr || halo != nullptr; }
  /// From here on vertices' neighbours are asked for. All that are not inserted by ChooseSteiners
  /// have records; in an update that does not matter.
  void begin_questions(S& s);
  /// The triangulation of all vertices, beyond space their stars; in a static run all simplices.
  void triangulate(S& s);
  /// In a static run: calls visit(corners) for each simplex. Requires: triangulated.
  template <class Visit>
  requires(!S::kTraced) void for_each_simplex(Visit&& visit) const {
    if (const auto* all = vertices.triangulation()) return all->for_each_simplex(visit);
    for (const auto& simplex : plain.simplices) visit(simplex);
  }
  /// Throws: Error(too_many) if there are more vertices than there may be.
  void require_room(S& s) const {
    if (vertices.pool().size() - vertices.trials() > most_records) fail_too_many(s);
  }
  void fail_too_many(S& s) const;

 private:
  static auto make_vertices(const MeshBox<D>& box, sac::Engine& engine) {
    return VertexIndex<sac::Scope, D>(box, engine);
  }
  static auto make_vertices(const MeshBox<D>& box, sac::PlainScope&) {
    return VertexIndex<sac::PlainScope, D>(box);
  }
  void add_boundary();
  template <class Host>
  void make_parts(Host& host) {
    constexpr int kMost = 128;  // an engine has 255 structures
    for (int i = 0; i < std::min(kMost, buckets().count()); ++i) {
      parts.push_back(&host.make_agenda("steiner " + std::to_string(i), kKeyWidths));
    }
  }
};

/// PointWorld with what else there is in a dimension.
template <class S, int D = 2>
struct World;

}  // namespace mesher::detail
