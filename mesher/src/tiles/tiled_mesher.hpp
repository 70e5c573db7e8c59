// The tiles of a mesh, on threads and in processes: they run at once, exchange messages, and run
// again until there are none.
//
// A process has some of the tiles, one after the other. Between the steps of a round all processes
// agree (peers.hpp) on what comes next: which messages, whether a tile has anything to run, which
// bucket, and whether one of them has failed. So each of them calls the same functions, in the same
// order, with the same options and the same places.
//
// A first run settles bucket after bucket: births without what surrounds them would have others
// that nobody needs.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "borders/territory.hpp"
#include "mesher/meshing.hpp"
#include "sets/make_set.hpp"
#include "tiles/peers.hpp"
#include "tiles/tile_mesher.hpp"

namespace mesher::detail {

/// How tiles came to agree.
struct Exchanges {
  std::uint64_t rounds = 0;
  std::uint64_t messages = 0;
  std::uint64_t horizons = 0;  // of a first run
  // From this process to others.
  std::uint64_t messages_out = 0;
  std::uint64_t bytes_out = 0;
  std::uint64_t most_bytes_out = 0;  // in a round
};

/// The messages of a tile that wait: those of early turns are sent first, since what a tile says of
/// later ones may change when it knows of the earlier ones. What has been said and taken back is
/// never sent.
template <int D>
class Outbox {
 public:
  void add(const Message<D>& m) {
    const auto [it, is_new] = waiting_.try_emplace(key(m), m.begins() ? 1 : -1);
    if (!is_new) waiting_.erase(it);  // the opposite
  }
  [[nodiscard]] bool is_empty() const noexcept { return waiting_.empty(); }
  /// Of the first that waits; equal for those of one bucket.
  using Time = std::pair<Stage, std::uint32_t>;
  [[nodiscard]] Time first() const noexcept { return time(waiting_.begin()->first.turn); }
  /// Calls send(message) for those until then, and forgets them.
  template <class Send>
  void send_until(const Time& last, Send&& send) {
    auto it = waiting_.begin();
    for (; it != waiting_.end() && time(it->first.turn) <= last; ++it) send(message(*it));
    waiting_.erase(waiting_.begin(), it);
  }

 private:
  using Kind = typename Message<D>::Kind;
  struct Key {
    Turn<D> turn;
    std::uint32_t to;
    Kind begins;
    Look<D> look;
    Birth<D> birth;
    CutOfLeaf<D> cut;
    SliverCall<D> slivers;
    friend auto operator<=>(const Key&, const Key&) = default;
  };
  static Kind opposite(Kind kind) noexcept {
    return static_cast<Kind>(static_cast<std::uint8_t>(kind) ^ 1);
  }
  static Key key(const Message<D>& m) {
    return {m.turn(), m.to,     m.begins() ? m.kind : opposite(m.kind), m.look, m.birth,
            m.cut,    m.slivers};
  }
  static Message<D> message(const std::pair<const Key, int>& waiting) {
    const auto& [k, sign] = waiting;
    return {sign > 0 ? k.begins : opposite(k.begins), k.to, k.look, k.birth, k.cut, k.slivers};
  }
  static Time time(const Turn<D>& turn) noexcept {
    return {turn.stage, turn.rank >> (kKeyWidths.phase + kKeyWidths.colour)};
  }

  std::map<Key, int> waiting_;  // 1: begins, -1: ends
};

template <int D>
class TiledMesher {
 public:
  using Edits = std::vector<std::vector<typename TileMesher<D>::Edit>>;  // by tile of this process
  using Changes = typename TileMesher<D>::Changes;

  /// `places`: of the input's points, which say where the cuts are. `tiles`: of all processes, as
  /// many or fewer; a process may have none. `peers` must outlive it, and so must what `whole`
  /// refers to.
  TiledMesher(const Options<D>& options, const MeshBox<D>& box, const std::vector<Point<D>>& places,
              std::size_t tiles, std::size_t threads, Peers& peers,
              const WholeInput<D>& whole = {});

  /// `control` is asked, on the thread of the caller, while something runs. `ask(phase, calls)`:
  /// false if the run shall stop.
  using Ask = std::function<bool(Phase, std::uint64_t)>;
  /// Throws: Error, sac::Cancelled, std::bad_alloc, what `ask` throws: good for nothing then. What
  /// is thrown in one process is thrown in all, as by agree().
  /// `common`: null where there is nothing to be told.
  using Common = std::shared_ptr<const CommonOrders<D>>;
  void first_run(const Edits& edits, const Ask& ask, const Common& common = nullptr);
  /// Before that: it throws TooManyLooks, too, if tiles look so often at what changes that one tile
  /// is sooner done. (First runs of points have up to 150 looks a call; a surface whose stars were
  /// as large as the box had 20000 when it was a tenth done.) Requires: one process.
  using LookBound = typename TileMesher<D>::LookBound;
  void bound_looks(const LookBound& bound = {}) noexcept;
  /// Makes the edits; last(changes) is called, with those of this process, when all agree; it
  /// throws in all processes or in none. Throws: likewise, and what `last` throws: then the whole
  /// input must be put back, and the edits taken back.
  void update(const Edits& edits, const Ask& ask, const std::function<void(Changes&)>& last,
              const Common& common = nullptr);
  /// Those of the last update, which has thrown: by a run of their inverses. If that fails, too,
  /// or is not done, every further update throws sac::UsageError.
  void take_back(const Edits& edits, const Common& common = nullptr) noexcept;
  /// Whether the last update has been given up, in some process: it ends as if `ask` had stopped it
  /// where it takes several times the calls that there are. What does not settle is sooner done
  /// anew, since a first run goes bucket by bucket. Of all.
  [[nodiscard]] bool has_given_up() { return least_of(gives_up_ ? 0 : 1) == 0; }

  /// Tiles of this process.
  [[nodiscard]] std::size_t size() const noexcept { return tiles_.size(); }
  [[nodiscard]] const TileMesher<D>& operator[](std::size_t t) const noexcept { return *tiles_[t]; }
  /// Which of them has the place; nothing: another process.
  [[nodiscard]] std::optional<std::size_t> own_tile(const Point<D>& p) const noexcept {
    return own_index(all_.owner(p));
  }
  [[nodiscard]] std::size_t process_of(const Point<D>& p) const noexcept {
    return process_of_[all_.owner(p)];
  }
  /// Calls visit(process) once for each other process of which the closed box meets a territory.
  template <class Visit>
  void for_each_other_met(const Box<D>& area, Visit&& visit) const {
    std::vector<std::size_t> met;
    all_.for_each_met(area, [&](std::size_t tile) {
      if (process_of_[tile] != peers_.self()) met.push_back(process_of_[tile]);
    });
    make_set(met);
    std::for_each(met.begin(), met.end(), visit);
  }
  [[nodiscard]] const Exchanges& exchanges() const noexcept { return exchanges_; }
  /// What line a segment is of, by what all tiles call it.
  using LineOf = std::function<LineId(SegmentHandle)>;
  /// The simplices of the tiles of this process, and their vertices.
  [[nodiscard]] Mesh<D> mesh(const LineOf& line_of = {}) const;
  /// In the territories of this process.
  [[nodiscard]] std::size_t vertices() const noexcept;
  /// Of the phases of the first run.
  [[nodiscard]] const std::array<double, 3>& seconds() const noexcept { return seconds_; }
  /// Calls that have run.
  [[nodiscard]] std::uint64_t calls() const noexcept;
  /// TileMesher::fault_with of all pairs in this process: empty if, of one process, the mesh is
  /// certain to be that of one mesher.
  [[nodiscard]] std::string certificate_fault() const;
  /// The same of all pairs of all processes, to all. Requires: all tiles agree.
  [[nodiscard]] std::string certificate() const;
  /// Whether an update could not be taken back: then only the end is left.
  [[nodiscard]] bool is_broken() const noexcept { return broken_; }
  void check_invariants() const;

 private:
  // Of a tile of all, among those of this process.
  [[nodiscard]] std::optional<std::size_t> own_index(std::size_t tile) const noexcept {
    const std::size_t own = tile - first_;  // huge, if it is below
    return own < tiles_.size() ? std::optional(own) : std::nullopt;
  }
  template <class Act>
  void for_each_tile(std::uint64_t work, Act&& act);
  template <class Act>
  void run(const std::vector<std::size_t>& which, std::uint64_t work, Act&& act);
  void watch(const Ask& ask);
  void unwatch() noexcept;
  template <class Act>
  void attempt(Act&& act) noexcept;
  void agree(Peers::Values values = {});
  [[nodiscard]] std::uint64_t least_of(std::uint64_t value);
  using Time = typename Outbox<D>::Time;
  struct Next {                 // of all processes
    std::optional<Time> first;  // of the messages that wait
    bool is_dirty;
    bool has_faults;
  };
  [[nodiscard]] Next agree_on_next();
  void sort_messages();
  void post(std::size_t tile, const Time& last);
  void exchange(const Time& last);
  void settle(Changes* changes);
  void run_dirty(Changes* changes);
  [[nodiscard]] bool try_nearer();
  void require_no_fault();
  void require_all();
  static constexpr std::uint32_t kUnnumbered = ~std::uint32_t{0};
  struct Part;
  struct Others;
  void pack_said(std::vector<Packer>& to) const;
  [[nodiscard]] std::string fault_of_heard(const std::vector<Bytes>& said) const;
  void number_vertices(std::size_t t, Part& part) const;
  void list_simplices(std::size_t t, std::vector<Part>& parts, Others& others) const;
  void require_sound() const;
  void bound_calls() noexcept;
  void edit_all(const Edits& edits, const Common& common);
  void commit_lines() noexcept;

  Options<D> options_;
  std::size_t threads_;
  Peers& peers_;
  WholeInput<D> whole_;
  Territories<D> all_;
  std::size_t first_ = 0;                              // tile of this process
  std::vector<std::uint32_t> process_of_;              // by tile of all
  std::vector<std::unique_ptr<TileMesher<D>>> tiles_;  // of this process
  std::vector<std::vector<Message<D>>> out_;           // by its tile: what it has said last
  std::vector<Outbox<D>> waiting_;                     // by its tile: what it has said before
  std::vector<std::vector<Message<D>>> in_;  // by tile of all: what it says to this process
  std::vector<Packer> to_others_;            // by process
  Peers::Views views_;                       // of these
  Exchanges exchanges_;
  std::exception_ptr failure_;  // of this process, since all agreed last
  std::array<double, 3> seconds_{};
  bool broken_ = false;
  bool is_edited_ = false;  // by an update that has failed, and has not been taken back
  bool is_exact_ = true;    // what tiles know of each other is what they have said

  // While `ask_` is asked.
  Ask ask_;
  Phase phase_ = Phase::update;
  std::thread::id asker_;
  std::atomic<bool> stops_ = false;
  std::atomic<std::uint64_t> calls_ = 0;
  std::uint64_t most_calls_ = ~std::uint64_t{0};
  std::atomic<bool> gives_up_ = false;
};

}  // namespace mesher::detail
