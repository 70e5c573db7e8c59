// A tile: a mesher that runs the calls of its territory alone.
//
// What it must know of others comes as calls posted from outside, at the turns of theirs: births
// that it sees (arrive), and questions about what is here (across). What has changed for others it
// tells between runs, as messages. Where a neighbour's birth changes, that is an edit of the calls
// posted for it, and change propagation does the rest. When there are no messages left, each call
// has seen what it would have seen in one mesher for all, by induction over the turns:
//   a call that looks beyond the territory asks each tile whose territory it reaches who of its
//   vertices would be around it there, at its turn. Whoever bounds its cell among all vertices
//   bounds that among fewer, too; so all that matter to it arrive.
// In the plane all tiles have all segments and all leaves. Which leaf is cut, and when, is a
// function of who asks for it: a call that does says so to all tiles, and each makes the same cut,
// at the same turn.
// In space all tiles have all edges and polygons: Complete looks at those beside its cell, and what
// it puts on them is born as any vertex is.
// All tiles have all limits of size. Each fills its own territory: what keeps the lattice away is a
// function of the input, of which all tiles look at the same features.
// Slivers are those of one of their corners: whoever sees one hands the call that splits it over to
// the tile that owns this corner.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <variant>
#include <vector>

#include "borders/tile_border.hpp"
#include "borders/turn.hpp"
#include "program/world.hpp"
#include "tiles/known_of.hpp"
#include "tiles/space_features.hpp"

namespace mesher::detail {

/// From one tile to another. A question that ends, and what else does, is named as it began.
template <int D>
struct Message {
  enum class Kind : std::uint8_t { ask, end, arrive, depart, cut, uncut, split, unsplit };
  Kind kind;
  std::uint32_t to;
  Look<D> look{};           // ask, end
  Birth<D> birth{};         // arrive, depart
  CutOfLeaf<D> cut{};       // cut, uncut
  SliverCall<D> slivers{};  // split, unsplit

  [[nodiscard]] const Turn<D>& turn() const noexcept {
    if (kind < Kind::arrive) return look.turn;
    if (kind < Kind::cut) return birth.turn;
    return kind < Kind::split ? cut.turn : slivers.turn;
  }
  [[nodiscard]] bool begins() const noexcept {
    return kind == Kind::ask || kind == Kind::arrive || kind == Kind::cut || kind == Kind::split;
  }
};

/// In the plane: what all tiles are told of the segments of the whole input, and of their pieces
/// that are leaves before anything is refined; segments as all tiles call them.
struct LineOrders {
  struct FirstLeaf {
    Piece piece;
    bool begins;
  };
  std::vector<GivenSegment> segments;
  std::vector<FirstLeaf> leaves;
  [[nodiscard]] bool is_empty() const noexcept { return segments.empty() && leaves.empty(); }
  [[nodiscard]] LineOrders inverse() const;
};

/// What all tiles are told of the whole input.
template <int D>
struct CommonOrders {
  struct LimitsChange {
    Options<D> was, is;           // with the limits before and after,
    std::vector<Box<D>> where{};  // which differ here
  };
  LineOrders lines{};
  FeatureOrders features_in_space{};
  std::optional<LimitsChange> limits{};  // nothing: they stay
  std::vector<Point<D>> features{};      // where features' points have come or gone
  [[nodiscard]] bool is_empty() const noexcept {
    return lines.is_empty() && features_in_space.is_empty() && !limits && features.empty();
  }
  [[nodiscard]] CommonOrders inverse() const;
};

/// What a tile has done so far.
struct TileCounts {
  std::uint64_t run = 0;        // calls of a first run
  std::uint64_t again = 0;      // calls that ran, or ran again, to bring it up to date
  std::uint64_t questions = 0;  // asked by others
  std::uint64_t seen = 0;       // vertices of others that came to be seen
  std::uint64_t born = 0;       // vertices of its own that others gave birth to
  std::uint64_t cuts = 0;       // of leaves that others asked for
  std::uint64_t slivers = 0;    // calls that split its own, for which others asked
};

template <int D>
class TileMesher {
 public:
  /// A point of features. `level`: the deepest one at which it is crowded among those of all tiles;
  /// `pitch`: of the lattice there; `role`: none of a point of the input.
  struct Located {
    explicit Located(int l, double t = Limits<D>::kNone, const Role& r = {})
        : level(l), pitch(t), role(r) {}
    int level;
    double pitch;
    Role role;
    friend bool operator==(const Located&, const Located&) = default;
  };
  struct Edit {
    Point<D> p;
    std::optional<Located> was, is;  // nothing: it is not there
    [[nodiscard]] Edit inverse() const { return {p, is, was}; }
  };

  /// What `whole` refers to must outlive it.
  TileMesher(const Options<D>& options, const MeshBox<D>& box, const Territories<D>& all,
             std::size_t self, const WholeInput<D>& whole = {});
  TileMesher(const TileMesher&) = delete;
  TileMesher& operator=(const TileMesher&) = delete;
  ~TileMesher();

  /// Notes edits of points of the territory, and the messages of tile `from`, for the next run.
  /// What throws leaves the tile good for nothing.
  void edit(const std::vector<Edit>& edits);
  /// Likewise, of what all are told.
  void edit_common(std::shared_ptr<const CommonOrders<D>> common);
  void receive(std::size_t from, const std::vector<Message<D>>& messages);
  /// Tells report(calls) of calls that have run since, some thousand times a second; if it returns
  /// false the run ends with sac::Cancelled.
  void watch(std::function<bool(std::uint64_t)> report);
  /// Whether something waits to be run.
  [[nodiscard]] bool is_dirty() const noexcept {
    return !orders_.empty() || !common_.empty() || !features_.empty() || tries_nearer_;
  }
  /// When all tiles agree: what would come too near to others is tried again (TileBorder). Returns
  /// whether there is any.
  bool try_nearer();
  void reset_nearness() noexcept { border_->reset_nearness(); }
  /// How much that is, of the least of it.
  [[nodiscard]] std::uint64_t orders() const noexcept;

  /// The parts of a first run: points are located; parts 0 to parts() - 1, by buckets; stars. What
  /// throws leaves the tile good for nothing.
  void run_quadtree();
  void begin_questions();
  void run_part(int part);
  void run_stars();
  [[nodiscard]] int parts() const noexcept { return static_cast<int>(world_->parts.size()); }
  [[nodiscard]] std::uint64_t waiting_in(int part) const noexcept {
    return world_->parts[static_cast<std::size_t>(part)]->waiting_calls();
  }
  /// The first part from `part` on in which calls wait.
  [[nodiscard]] int next_part(int part) const noexcept;
  /// Brings what has run up to date with what was noted. What throws leaves everything as it was;
  /// what was noted waits for another try.
  void propagate();
  /// How many looks are too many, from now on: propagate() then throws TooManyLooks. They are what
  /// searches meet, and what the observations have seen that are asked whether they are concerned.
  struct LookBound {
    std::uint64_t a_call = 1024;  // that there is, and
    std::uint64_t more = std::uint64_t{1} << 24;
  };
  void bound_looks(const std::optional<LookBound>& bound) noexcept;

  /// What is new for others since the last call; adds to `changes` what is new in the mesh. What
  /// throws leaves the tile good for nothing.
  struct Changes {
    struct Event {
      Point<D> p;
      VertexKind kind;
      bool came;
    };
    // In their order. Where there are features in space, those of which the role may be another,
    // too.
    std::vector<Event> vertices;
    // Of a leaf.
    struct LeafEvent {
      Piece piece;
      Point<D> lo, hi;
      bool came;
    };
    std::vector<LeafEvent> leaves;  // in their order
    std::vector<std::array<Point<D>, D + 1>> simplices_come, simplices_gone;
  };
  [[nodiscard]] std::vector<Message<D>> collect(Changes* changes);
  /// When all tiles agree: forgets segments that have gone.
  void commit_lines() noexcept;

  /// Vertices of the territory, and simplices that one of them outputs.
  [[nodiscard]] std::size_t own_vertices() const noexcept { return own_vertices_; }
  [[nodiscard]] std::size_t own_simplices() const;
  /// By handles, positively oriented. It outputs those whose corner of the least coordinates is its
  /// own.
  using Simplex = std::array<VertexHandle, D + 1>;
  /// Calls visit(simplex) for those.
  template <class Visit>
  void for_each_own(Visit&& visit) const {
    world_->vertices.for_each_simplex([&](const Simplex& t) {
      if (outputs(t)) visit(t);
    });
  }
  /// Calls visit(v) for the vertices of the territory, without those on the sides of the box.
  template <class Visit>
  void for_each_own_vertex(Visit&& visit) const {
    world_->vertices.pool().for_each([&](const Vertex<D>& v) {
      if (v.alive && !v.boundary && border_->owns(v.p)) visit(v);
    });
  }
  /// Calls visit(piece, lo, hi) for the leaves that it outputs: those that begin in the territory.
  template <class Visit>
  void for_each_own_leaf(Visit&& visit) const {
    if constexpr (D == 2) {
      world_->leaves.for_each([&](const Leaf& leaf) {
        if (border_->owns(leaf.lo)) visit(named(leaf.piece), leaf.lo, leaf.hi);
      });
    }
  }
  /// Whether a leaf may be no edge of the mesh.
  [[nodiscard]] bool may_lose_leaves() const noexcept {
    if constexpr (D == 2) return world_->leaves.may_lose();
    return false;
  }
  /// Of a vertex of another tile: whether it is a point of the input.
  [[nodiscard]] bool has_heard_of_input(const Vertex<D>& v) const;
  /// By what all tiles call its segment.
  [[nodiscard]] Role named(Role role) const noexcept;
  [[nodiscard]] const World<sac::Scope, D>& world() const noexcept { return *world_; }
  [[nodiscard]] const TileBorder<D>& border() const noexcept { return *border_; }
  [[nodiscard]] const TileCounts& counts() const noexcept { return counts_; }
  [[nodiscard]] const sac::Engine& engine() const noexcept { return *engine_; }
  [[nodiscard]] std::size_t bytes() const;
  /// The certificate of what tiles know of each other: for each pair A, B
  ///   (1) what A has said to B, as A's state is now, B has heard, and nothing else: the looks of A
  ///       that reach B's territory, A's births there, the births in A of whom B was told, leaves
  ///       that A needs cut, and B's vertices of which A sees slivers;
  ///   (2) B has answered each of A's looks, and has told A of all who were found.
  /// If that holds for all pairs, the mesh is that of one mesher for all. By tile. Cost: O(looks
  /// and births across borders).
  [[nodiscard]] std::vector<KnownOf> said() const;
  [[nodiscard]] std::vector<KnownOf> heard() const;
  /// (2), of this tile's answers to another. Returns: what is wrong; empty: nothing.
  [[nodiscard]] std::string answers_fault(std::size_t asker) const;
  /// All of it, of what this tile has said to another.
  [[nodiscard]] std::string fault_with(const TileMesher& other) const;
  void check_invariants() const;

 private:
  // Who has asked, and what it was told.
  struct Question {
    std::uint32_t from;
    Look<D> look;
  };
  struct Order {  // what is to be posted, or taken back
    enum class Kind : std::uint8_t { locate, ask, arrive, cut, split };
    Kind kind;
    bool begins;
    Point<D> p;
    Turn<D> turn;
    int number;                 // locate: the level; arrive, cut, split: the bucket
    std::uint32_t name;         // ask: the question; arrive: from which tile
    double radius;              // locate: the pitch
    Role role{};                // locate, arrive
    Piece piece{};              // cut
    bool asks_nearest = false;  // arrive: see Birth
  };
  struct Asked {                                                    // of another tile
    std::unordered_map<Look<D>, std::uint32_t, TurnHash<D>> looks;  // how often
  };
  struct Born {  // as all tiles say it
    Turn<D> turn;
    Role role;
    friend bool operator==(const Born&, const Born&) = default;
  };
  struct Asker {  // another tile
    std::unordered_map<Look<D>, std::uint32_t, TurnHash<D>> questions;
    // Who was found for it, and the turns of their births; nothing: it knows. What it was told it
    // knows for good: if it forgot what is hidden from it, two tiles could hide things from each
    // other by what they were about to forget.
    std::unordered_map<VertexHandle, std::optional<Born>> told;
    std::set<CutOfLeaf<D>> cuts;  // that it has asked for
    std::set<SliverCall<D>> slivers;
  };
  struct From {
    Born born;
    std::uint32_t tile;
    friend bool operator==(const From&, const From&) = default;
  };

  [[nodiscard]] sac::Agenda& agenda(const Turn<D>& turn) noexcept;
  void post_orders();
  void carry_out(const Order& order);
  void carry_out_in_call(const Order& order, const sac::Key& key);
  void carry_out_lines(const LineOrders& lines);
  void forget_orders() noexcept;
  [[nodiscard]] std::size_t records_in_update() const noexcept;
  void carry_out_cut(const Order& order);
  void carry_out_split(const Order& order);
  template <auto F, class... Args>
  void edit_call(const Turn<D>& turn, bool begins, const Args&... args);
  void hold(Vertex<D>& v, int by);
  void locate(const Order& order, VertexRef<D> v);
  [[nodiscard]] Role own(Role role) const;
  [[nodiscard]] Role of_all(const Role& role) const;
  [[nodiscard]] CutOfLeaf<D> of_all(CutOfLeaf<D> cut) const;
  [[nodiscard]] bool has_features_in_space() const noexcept;
  [[nodiscard]] Birth<D> named(Birth<D> birth) const noexcept;
  [[nodiscard]] Piece named(Piece piece) const noexcept;
  [[nodiscard]] Piece own(Piece piece) const;
  void ask(std::uint32_t from, const Look<D>& look);
  void end(std::uint32_t from, const Look<D>& look);
  void arrived(std::uint32_t from, const Birth<D>& birth);
  void order_arrival(std::uint32_t from, const Birth<D>& birth, bool begins);
  void departed(std::uint32_t from, const Birth<D>& birth);
  void note_cut(std::uint32_t from, const CutOfLeaf<D>& cut, bool begins);
  void note_split(std::uint32_t from, const SliverCall<D>& slivers, bool begins);
  using Doubtful = std::vector<std::vector<VertexHandle>>;  // what a tile may have to be told
  void collect_looks(std::vector<Message<D>>& out, Doubtful& doubtful);
  void collect_births(std::vector<Message<D>>& out);
  void collect_cuts(std::vector<Message<D>>& out);
  void collect_slivers(std::vector<Message<D>>& out);
  void collect_answers(Doubtful& doubtful);
  void note(std::size_t tile, VertexHandle h, Doubtful& doubtful);
  void tell(Doubtful& doubtful, std::vector<Message<D>>& out);
  void forget_told(std::size_t tile, VertexHandle h);
  [[nodiscard]] std::optional<Born> birth_for(std::uint32_t asker, const Vertex<D>& v) const;
  void count_own(const std::vector<VertexHandle>& touched) noexcept;
  using Log = typename VertexIndex<sac::Scope, D>::Log;
  void collect_changes(const Log& log, Changes& changes) const;
  [[nodiscard]] bool outputs(const Simplex& t) const noexcept;

  const Territories<D>& all_;
  std::size_t self_;
  std::unique_ptr<sac::Engine> engine_;
  std::unique_ptr<TileBorder<D>> border_;
  std::unique_ptr<World<sac::Scope, D>> world_;
  using OwnFeatures = std::conditional_t<D == 3, SpaceFeatures, std::monostate>;
  OwnFeatures own_features_;
  std::vector<std::shared_ptr<const CommonOrders<D>>> common_;
  std::vector<Point<D>> features_;  // that concern this tile
  std::vector<Order> orders_;
  bool tries_nearer_ = false;
  std::optional<LookBound> look_bound_;
  std::size_t own_vertices_ = 0;
  TileCounts counts_;
  std::vector<Asked> asked_;                                      // by tile
  std::map<CutOfLeaf<D>, std::uint32_t> cuts_;                    // how many calls ask for each
  std::map<SliverCall<D>, std::uint32_t> slivers_;                // likewise
  std::vector<Asker> askers_;                                     // by tile
  std::unordered_multimap<VertexHandle, std::uint32_t> told_to_;  // whose Asker::told has a vertex
  std::unordered_map<std::uint32_t, Question> questions_;
  std::uint32_t next_question_ = 0;
  std::unordered_multimap<Point<D>, From, TurnHash<D>> from_;  // whose births have arrived
};

}  // namespace mesher::detail
