// The vertices of the mesh in progress, as a traceable data type over the quadtree.
//
//   insert(s, p)           the running call produces a vertex               (effect)
//   insert(s, p, role)     the same, of a place on a segment                (effect)
//   insert_early(...)      the same, before vertices are located            (effect)
//   insert(s, v)           the running call produces the record v, unless   (effect)
//                          an earlier one has given it a role
//   voronoi_cell(s, v, R)  v's gap balls up to R, among the vertices born   (observation)
//                          before the running call
//   nearest2(s, v)         squared distance to v's nearest neighbour        (observation)
//   trial(s, p, v, R)      what the cell at p would be, were a vertex born  (observation)
//                          there; v is a vertex near it
//   star(s, v)             v's Delaunay star among all vertices             (observation)
//   follow()               makes the triangulation, if one is kept in the place of stars, that of
//                          all vertices
//
// A vertex that comes or goes invalidates exactly the later observations that it concerns: one that
// comes, those with a gap ball around it; one that goes, those whose cell it bounds.
//
// A vertex on a segment has a role, that of its earliest producer. Who sees a vertex sees its role,
// without a further observation: if it changes, the calls that have v's cell, or v beside a cell,
// run again.
//
// The parts: births are presences (sac/presence.hpp); who has looked where is in Observers; cells
// and neighbours are searched by VertexSearch; what an update has changed is in ChangeLog.
//
// Its calls make no child calls, so what a running call has not repeated need not be hidden from
// children. (Births would have to be, should a call insert a vertex and then make children.)
//
// Two implementations: `VertexIndex<sac::Scope>` keeps this history, `VertexIndex<sac::PlainScope>`
// only the vertices.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "index/change_log.hpp"
#include "index/changed_features.hpp"
#include "index/kept_triangulation.hpp"
#include "index/live_triangulation.hpp"
#include "index/look_listener.hpp"
#include "index/observers.hpp"
#include "index/vertex_search.hpp"
#include "sac/sac.hpp"

namespace mesher::detail {

template <class S, int D = 2>
class VertexIndex;

/// What a query throws after more looks than are allowed.
struct TooManyLooks {};

// While it has a triangulation, that answers; the quadtree is filled only where it is searched.
template <int D>
class VertexIndex<sac::PlainScope, D> : public VertexSearch<D> {
  using Base = VertexSearch<D>;

 public:
  using Base::Base;

  /// From here on cells are asked for. `good2`, `step`: as for LiveTriangulation.
  void begin_questions(double good2, const std::function<void()>& step) {
    live_ = LiveTriangulation<D>::of(Base::pool_, good2, step);
    if (live_ == nullptr) fill_tree();
  }
  /// Whether the quadtree is searched.
  [[nodiscard]] bool searches() const noexcept { return live_ == nullptr; }
  /// Puts all vertices into the quadtree, if they are not in it.
  void fill_tree() {
    if (std::exchange(in_tree_, true)) return;
    Base::pool_.for_each([&](Vertex<D>& v) { Base::tree_.insert(v); });
  }

  Vertex<D>& add_input(const Point<D>& p, bool) {
    Vertex<D>& v = create(p);
    v.input = true;
    return v;
  }
  VertexRef<D> add_boundary(const Point<D>& p) {
    Vertex<D>& v = create(p);
    Base::mark_boundary(v);
    return {&v};
  }

  VertexRef<D> insert(sac::PlainScope&, const Point<D>& p) { return insert_apart(p, Role()); }
  VertexRef<D> insert(sac::PlainScope&, const Point<D>& p, const Role& role) {
    return insert_apart(p, role);
  }
  VertexRef<D> insert_early(sac::PlainScope&, const Point<D>& p) { return insert_new(p, Role()); }
  VertexRef<D> insert_early(sac::PlainScope&, const Point<D>& p, const Role& role) {
    return insert_new(p, role);
  }
  void insert(sac::PlainScope&, VertexRef<D> v) { v->alive = true; }
  CellLoan<D> voronoi_cell(sac::PlainScope&, VertexRef<D> v, double radius) {
    if (searches()) {
      fill_tree();
      return Base::cut_around(*v, radius, [](VertexHandle) { return true; });
    }
    CellLoan<D> cell = Base::borrow_cell();
    live_->read(*cell, *v, radius);
    return cell;
  }
  /// Whether v's cell up to R is known to be all of its star, of good simplices.
  [[nodiscard]] bool is_settled(VertexRef<D> v, double radius) {
    return !searches() && live_->is_settled(*v, radius);
  }
  void note_asked(double) noexcept {}
  [[nodiscard]] bool was_clear() const noexcept { return false; }
  void note_clear(bool) noexcept {}
  double nearest2(sac::PlainScope&, VertexRef<D> v) {
    if (!searches()) return live_->nearest(*v).distance2;
    fill_tree();
    return Base::nearest_around(*v, [](VertexHandle) { return true; }).distance2;
  }
  /// The cell is centred at a record that is good until the next trial.
  CellLoan<D> trial(sac::PlainScope&, const Point<D>& p, VertexRef<D> near, double radius) {
    tried_ = Vertex<D>{};
    tried_.p = p;
    if (searches()) return Base::cut_around(tried_, radius, [](VertexHandle) { return true; });
    CellLoan<D> cell = Base::borrow_cell();
    live_->read_as_if(*cell, tried_, near->self, radius);
    return cell;
  }
  /// Of the pool, that are no vertices between calls.
  [[nodiscard]] std::size_t trials() const noexcept { return 0; }
  CellLoan<D> star(sac::PlainScope& s, VertexRef<D> v) { return voronoi_cell(s, v, Base::whole()); }
  /// Of all vertices, from begin_questions() on; null if the quadtree is searched.
  [[nodiscard]] const LiveTriangulation<D>* triangulation() const noexcept { return live_.get(); }

 private:
  Vertex<D>& create(const Point<D>& p) { return in_tree_ ? Base::add(p) : Base::pool_.create(p); }
  VertexRef<D> insert_apart(const Point<D>& p, const Role& role) {
    if (searches()) {
      fill_tree();
      if (Base::tree_.find(p) != nullptr) Base::fail_coincident(p);
      return insert_new(p, role);
    }
    const VertexRef<D> v = insert_new(p, role);
    if (!live_->insert(*v)) Base::fail_coincident(p);
    return v;
  }
  VertexRef<D> insert_new(const Point<D>& p, const Role& role) {
    Vertex<D>& v = create(p);
    v.alive = true;
    if (role.on != 0) Base::roles_.reserve(v.self);
    Base::set_role(v, role);
    return {&v};
  }

  std::unique_ptr<LiveTriangulation<D>> live_;
  bool in_tree_ = false;
  Vertex<D> tried_;
};

template <int D>
class VertexIndex<sac::Scope, D> : public VertexSearch<D>, public sac::Structure {
  using Base = VertexSearch<D>;
  using typename Base::Cell;
  using Observation = detail::Observation<D>;
  using NearestSeen = detail::NearestSeen<D>;
  using CellSeen = detail::CellSeen<D>;

 public:
  using Base::concern;
  using Base::role;

  VertexIndex(const MeshBox<D>& box, sac::Engine& engine)
      : VertexSearch<D>(box),
        engine_(engine),
        presences_(engine),
        observers_(engine, pool_, tree_),
        log_(pool_),
        id_(engine.add_structure(*this)) {}

  /// In a first run: cells are asked for from here on. All records are, or will be, vertices.
  void begin_questions();
  /// Of a tile, before the parts of its first run: the cells of these are read from here on.
  void begin_reading() {
    live_ = LiveTriangulation<D>::of(
        pool_, 0, [] {}, Of::vertices);
  }
  /// Between the parts: these may have come or gone since.
  void keep_reading(const std::vector<VertexHandle>& touched);
  void end_reading() noexcept { live_.reset(); }
  /// From now on queries throw TooManyLooks after so many since the beginning: at what a search
  /// meets, and at what observations have seen.
  void bound_looks(std::uint64_t most) noexcept { most_looks_ = most; }
  /// Whether the quadtree is searched: in updates.
  [[nodiscard]] static constexpr bool searches() noexcept { return true; }

  VertexRef<D> insert(sac::Scope& s, const Point<D>& p);
  VertexRef<D> insert(sac::Scope& s, const Point<D>& p, const Role& role);
  /// In a first run without a look for a vertex at p: the quadtree is one leaf then. Features are
  /// asked for two in one place.
  VertexRef<D> insert_early(sac::Scope& s, const Point<D>& p, const Role& role);
  /// The same for a place on no segment. Requires: no feature is there.
  VertexRef<D> insert_early(sac::Scope& s, const Point<D>& p);
  void insert(sac::Scope& s, VertexRef<D> v);
  void insert(sac::Scope& s, VertexRef<D> v, const Role& role);
  CellLoan<D> voronoi_cell(sac::Scope& s, VertexRef<D> v, double radius);
  CellLoan<D> trial(sac::Scope& s, const Point<D>& p, VertexRef<D> near, double radius);
  /// Who would be around v, a record that need not be a vertex, or be nearest to it if `radius` is
  /// negative, of the vertices born before the running call. (Of others: v may be one.)
  void look_across(sac::Scope& s, VertexRef<D> v, double radius, std::vector<VertexHandle>& found);
  /// Who is told of all observations but those of look_across().
  void set_listener(LookListener<D>* listener) noexcept { listener_ = listener; }
  /// The record at p, perhaps made for this: it is freed at the end of an update if nobody has made
  /// it a vertex, or looked from it.
  [[nodiscard]] VertexRef<D> claim(const Point<D>& p) {
    Vertex<D>* v = tree_.find(p);
    if (v == nullptr) v = &add(p);
    touch(*v);
    return {v};
  }
  /// Where no call looks at vertices, and it is known otherwise which there are: v, of the pool, is
  /// one, with a role unless calls that insert it say which; or it is none. Throws: std::bad_alloc,
  /// and then changes nothing.
  void set_vertex(Vertex<D>& v, bool is_there, const Role& role) {
    if (role.on != 0) roles_.reserve(v.self);
    is_given_ = true;
    touch(v);
    v.alive = is_there;
    if (is_there && !v.presence.there()) set_role(v, role);
  }
  /// Those that may have come, gone, or become another kind since the last commit.
  [[nodiscard]] std::vector<VertexHandle> touched() const { return log_.touched(); }
  /// Records that have only been tried.
  [[nodiscard]] std::size_t trials() const noexcept { return trials_; }
  /// In space: who has seen the last cell has asked for the features that meet its star, and for
  /// those within this of its vertex, but not beyond VertexSearch::beside.
  void note_asked(double distance) noexcept {
    if constexpr (D == 3) {
      last_cell_->features_within = std::max(last_cell_->features_within, in_sides(distance));
    }
  }
  /// In space: whether the running call saw the last cell as it is before this update, and no
  /// feature that was there then crosses its star.
  [[nodiscard]] bool was_clear() const noexcept { return !last_is_new_ && last_cell_->is_clear; }
  /// Whether no feature crosses the star of the last cell. (An observation from before this update
  /// does not become clear by it: the update may fail.)
  void note_clear(bool clear) noexcept {
    last_cell_->is_clear = clear && (last_is_new_ || last_cell_->is_clear) ? 1 : 0;
  }
  double nearest2(sac::Scope& s, VertexRef<D> v);
  CellLoan<D> star(sac::Scope& s, VertexRef<D> v);
  /// In space: who knows which features have changed.
  void set_changed_features(ChangedFeatures* changed) noexcept { changed_ = changed; }
  void retract(sac::Call& call, sac::Edge& edge) noexcept override;
  [[nodiscard]] bool unchanged(sac::Call& call, sac::Edge& edge) override;
  void label(const sac::Call& call, const sac::Edge& edge, sac::LabelSink& sink) const override;
  void print(const sac::Call& call, const sac::Edge& edge, std::ostream& out) const override;

  /// v's star, as its cell was written down by the call that looked at it; nothing if none did.
  [[nodiscard]] std::span<const std::uint32_t> ring(const Vertex<D>& v) const;

  /// Ends a first run: from here on the triangulation is kept, but not beyond space. Requires:
  /// all vertices are there.
  void keep_triangulation();
  /// In an update: makes it that of the vertices that there are now, if it is kept.
  /// Cost: O(simplices that come and go). Throws: std::bad_alloc.
  void follow() { follow(log_.touched()); }
  /// Calls visit(simplex) for each simplex: corners positively oriented. (Where an update has
  /// failed, and memory has run out when the triangulation was put back, another one is made.)
  template <class Visit>
  void for_each_simplex(Visit&& visit) const {
    if (kept_ != nullptr) return kept_->for_each_simplex(visit);
    KeptTriangulation<D>(pool_, live_vertices()).for_each_simplex(visit);
  }
  /// The same of those with corner v, which comes first. Requires: follow() was called.
  template <class Visit>
  void for_each_simplex_at(const Vertex<D>& v, Visit&& visit) const {
    kept_->for_each_simplex_at(v.self, visit);
  }
  [[nodiscard]] std::vector<VertexHandle> live_vertices() const {
    return vertices_that([](const Vertex<D>& v) { return v.alive; });
  }
  /// Of the triangulation that is kept.
  [[nodiscard]] std::size_t triangulation_bytes() const noexcept {
    if constexpr (D <= 3) {
      return kept_ == nullptr ? 0 : kept_->bytes();
    } else {
      return 0;
    }
  }

  /// Who an observation saw.
  [[nodiscard]] std::span<const std::uint32_t> seen_by(const Observation& o) const noexcept {
    return observers_.neighbours(o);
  }

  /// Since the last commit: vertices that may have come or gone; and simplices that went and came,
  /// if the triangulation is kept.
  struct Log {
    std::vector<VertexHandle> touched;
    std::vector<std::array<VertexHandle, D + 1>> simplices_gone, simplices_come;
  };
  /// Follows, too. Cost: O(what has changed). Throws: std::bad_alloc.
  [[nodiscard]] Log log();
  /// Ends an update: frees the records of vertices that nobody produces.
  void commit() noexcept;
  /// Ends an update whose edits were taken back before they were propagated. The engine still holds
  /// calls about records that were made for it: these stay until the next commit().
  void give_up() noexcept;

  /// Calls visit(call, edge) for the calls that have looked at v's cell, as Complete does.
  template <class Visit>
  void for_each_cell_seen(const Vertex<D>& v, Visit&& visit) const {
    observers_.find_at(v, [&](const Observation& o) {
      if (o.kind == kCell) visit(engine_.call(o.call), static_cast<const sac::Edge&>(o));
      return false;
    });
  }

  /// Called by what changes the set of segments at an input point: who sees v sees them, too.
  void legs_changed(const Vertex<D>& v) noexcept;

  /// Called by who edits the limits of size in `where`: who has looked at a cell has asked about
  /// the triangles of its star.
  void limits_changed(const Box<D>& where) noexcept;

  /// Called by what makes a feature come or go: who has looked at a cell has asked which features
  /// meet its star, or are beside it. Of the feature: `distance(x)` from x; `beyond(x, r)` only if
  /// it is farther than r from x, which is quicker to tell. None throws.
  template <class Beyond, class Distance>
  void feature_changed(Beyond&& beyond, Distance&& distance) noexcept {
    if (!observers_.any()) return;
    tree_.visit_within(Base::kBeside, beyond, [&](const Vertex<D>& center) {
      double away = -1;  // not known
      const auto is_within = [&](double r) {
        if (beyond(center.p, r)) return false;
        if (away < 0) away = std::max(distance(center.p), 0.0);
        return away <= r;
      };
      observers_.find_at(center, [&](const Observation& o) {
        if (!Observers<D>::is_cell(o)) return false;
        const auto& cell = static_cast<const CellSeen&>(o);
        const double asked = std::min(cell.features_within * box_.side, Base::beside(o.reach));
        if (is_within(asked)) {
          engine_.invalidate(engine_.call(o.call), &o);
        } else if (is_within(o.reach.farthest() * box_.side)) {
          engine_.doubt(engine_.call(o.call));  // its star may have it: unchanged()
        }
        return false;
      });
    });
  }

  /// Called by what makes a record an input point, or no longer.
  void touch(Vertex<D>& v) noexcept { log_.touch(v); }

  /// Requires: between updates. Throws InvariantError; among others if an observation is not what a
  /// search from nothing finds. Cost: O(observations) searches.
  void check_invariants() const override;

 private:
  using Base::add;
  using Base::add_candidate;
  using Base::begin_repair;
  using Base::begin_with_ring;
  using Base::borrow_cell;
  using Base::box_;
  using Base::cut_around;
  using Base::cut_by_candidates;
  using Base::fail_coincident;
  using Base::finish;
  using Base::finish_known;
  using Base::nearest_around;
  using Base::packed;
  using Base::pool_;
  using Base::roles_;
  using Base::set_role;
  using Base::take_visited;
  using Base::tree_;
  using Base::unpacked;
  using Base::whole;

  static constexpr std::uint8_t kBirth = 0;
  static constexpr std::uint8_t kCell = Observers<D>::kCell;
  static constexpr std::uint8_t kNearest = Observers<D>::kNearest;
  static constexpr std::uint8_t kStar = Observers<D>::kStar;
  static constexpr std::uint8_t kBirthOnSegment = 4;
  static constexpr std::uint8_t kTrial = Observers<D>::kTrial;

  // A walk over the triangulation takes less than a search up to about this far, in leaves.
  static constexpr double kFewLeaves = 8;

  struct BirthEdge : sac::ProducerEdge {
    VertexHandle vertex;
  };
  struct BirthOnSegmentEdge : BirthEdge {
    Role role;
  };
  static bool is_birth(const sac::Edge& edge) noexcept {
    return edge.kind == kBirth || edge.kind == kBirthOnSegment;
  }

  [[nodiscard]] bool born_before(const Vertex<D>& u, const sac::Call& call) const noexcept {
    return u.boundary || presences_.seen_by(u.presence, call);
  }
  /// Whether a first run need not search. (Where weights are recorded it does: they are those of
  /// searches.)
  [[nodiscard]] bool may_read() const noexcept {
    return engine_.appending() && !engine_.records_weights();
  }
  /// Whether cells are read from the triangulation. A first run that has failed leaves one.
  [[nodiscard]] bool reads() const noexcept { return live_ != nullptr && engine_.appending(); }
  /// The same of v's. (A tile may be told of slivers of what is not there, or not any more.)
  [[nodiscard]] bool reads(const Vertex<D>& v) const noexcept { return reads() && live_->has(v); }
  void join(const Vertex<D>& v);
  [[nodiscard]] Vertex<D>& record_at(sac::Scope& s, const Point<D>& p);
  const BirthOnSegmentEdge* recall_on_segment(sac::Scope& s, const Point<D>& p, const Role& role);
  void produce_on_segment(sac::Scope& s, Vertex<D>& v, const Role& role);
  void produce(sac::Scope& s, Vertex<D>& v);
  void produced(sac::Scope& s, Vertex<D>& v, BirthEdge& edge, const Role& role) noexcept;
  [[nodiscard]] Role role_from(const sac::Call& producer, const Vertex<D>& v) const noexcept;
  void run_again(sac::Ref<sac::Call> call, const sac::Window& window,
                 const sac::Edge* seen) noexcept;
  void take_role(Vertex<D>& v, const Role& role, const sac::Call& producer) noexcept;
  [[nodiscard]] bool concerns(const Vertex<D>& v, const Vertex<D>& center,
                              const Observation& o) noexcept;
  void weigh(sac::Scope& s);
  void appeared(const Vertex<D>& v, const sac::Window& window) noexcept;
  void vanished(const Vertex<D>& v, const sac::Window& window) noexcept;
  void retract_birth(BirthEdge& birth) noexcept;

  static void no_longer_clear(Observation& o) noexcept {
    if (Observers<D>::is_cell(o)) static_cast<CellSeen&>(o).is_clear = 0;
  }
  // The cells of v, and those that v bounds.
  template <class Visit>
  void for_each_cell_with(const Vertex<D>& v, Visit&& visit) noexcept {
    observers_.for_each_reaching(v.p, [&](const Vertex<D>& center, Observation& o) {
      if (!Observers<D>::is_cell(o)) return;
      const auto seen = observers_.neighbours(o);
      const bool bounds = std::find(seen.begin(), seen.end(), v.self) != seen.end();
      if (bounds || center.self == v.self) visit(o);
    });
  }
  template <class Seen>
  CellLoan<D> look(const Vertex<D>& v, double radius, const Observation* last, Seen&& seen);
  [[nodiscard]] VertexRef<D> trial_record(sac::Scope& s, const Point<D>& p);
  void set_trial(Vertex<D>& v, bool trial) noexcept {
    if (v.trial != trial) trial ? ++trials_ : --trials_;
    v.trial = trial;
  }
  void add_neighbours(const Cell& cell, const CellSeen& seen) const;
  void fill(sac::Scope& s, Observation& o, Vertex<D>& v, Reach<D> reach) noexcept;
  void record_cell(sac::Scope& s, Vertex<D>& v, const CellOf<D>& cell, float radius,
                   std::uint8_t kind);
  /// In units of the box's side, rounded up.
  [[nodiscard]] float in_sides(double distance) const noexcept {
    return static_cast<float>(distance / box_.side * (1 + 0x1p-20));
  }
  void record_nearest(sac::Scope& s, Vertex<D>& v, Reach<D> reach, VertexHandle nearest);
  void tell(const Vertex<D>& v, const Observation& o, double radius) {
    if (listener_ != nullptr && !looks_across_) [[unlikely]]
      listener_->looked(v, o, radius);
  }
  [[nodiscard]] bool star_has_changed_feature(const CellSeen& cell);
  template <class Seen>
  bool begin(Cell& cell, const Vertex<D>& v, double radius, Seen& seen);
  [[nodiscard]] const CellSeen* cell_of_producer(const Vertex<D>& v) const noexcept;
  void forget(Observation& o) noexcept;

  template <class IsWanted>
  [[nodiscard]] std::vector<VertexHandle> vertices_that(IsWanted&& is_wanted) const {
    std::vector<VertexHandle> all;
    pool_.for_each([&](const Vertex<D>& v) {
      if (is_wanted(v)) all.push_back(v.self);
    });
    return all;
  }
  void follow(const std::vector<VertexHandle>& touched);
  void put_triangulation_back() noexcept;

  [[nodiscard]] std::vector<std::uint32_t> canonical_codes(const Observation& o) const;
  void check_vertex(const Vertex<D>& v) const;
  void check_observation(const Vertex<D>& v, const Observation& o) const;

  sac::Engine& engine_;
  sac::Presences presences_;
  Observers<D> observers_;
  ChangeLog<D> log_;
  std::uint8_t id_;
  std::vector<std::uint32_t> codes_;            // the cell being recorded, written down
  std::vector<VertexHandle> near_;              // who is likely to be near
  CellSeen* last_cell_ = nullptr;               // the last one recorded
  bool last_is_new_ = false;                    // it is not from before this update
  std::unique_ptr<LiveTriangulation<D>> live_;  // in a first run
  bool keeps_ = false;                          // the triangulation, if there is memory for it
  std::unique_ptr<KeptTriangulation<D>> kept_;  // null: not yet, or it had to be given up
  std::size_t trials_ = 0;
  ChangedFeatures* changed_ = nullptr;
  std::vector<PlaceBall> balls_;  // scratch
  LookListener<D>* listener_ = nullptr;
  std::uint64_t looks_ = 0, most_looks_ = ~std::uint64_t{0};
  bool looks_across_ = false;  // while look_across() runs
  bool is_given_ = false;      // some are vertices by set_vertex() alone
};

}  // namespace mesher::detail
