// What happens across the border of a tile, as a traceable data type:
//
//   hand_over(s, v, ...) the running call gives birth to v beyond the territory;     (effect)
//                        who owns the place completes it, or looks for its nearest
//                        neighbour
//   answer(s, id, found) the running call has looked, for another tile, who is here  (effect)
//   request_cut(s, ...)  the running call needs a leaf cut: all tiles cut it         (effect)
//   hand_over_slivers(s, v, ...)  the running call has slivers of v, which is beyond (effect)
//                        the territory: who owns v splits them
//   fault(s, error)      the running call cannot do what it should                   (effect)
//
// and the observations of the tile's own calls that reach beyond the territory. Between runs it is
// asked what has changed since. While tiles do not agree yet, a call may meet vertices that will
// not be there in the end; so a fault counts only when they do.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "borders/territory.hpp"
#include "borders/turn.hpp"
#include "borders/whole_input.hpp"
#include "index/look_listener.hpp"
#include "mesher/error.hpp"
#include "sac/sac.hpp"

namespace mesher::detail {

/// Thrown where a new vertex would be nearer to others than nearness() allows.
struct TooNear {};

/// What is to become of a vertex that a call of another tile has made, as in a Birth.
template <int D>
struct Newborn {
  Point<D> p{};
  int bucket = -1;
  Role role{};  // as this tile calls the feature
  bool asks_nearest = false;
  friend auto operator<=>(const Newborn&, const Newborn&) = default;
};

template <int D>
class TileBorder final : public sac::Structure, public LookListener<D> {
 public:
  /// `side`: of the meshing box. What `whole` refers to must outlive the tile.
  TileBorder(sac::Engine& engine, const Territories<D>& all, std::size_t self, double side,
             const WholeInput<D>& whole)
      : engine_(engine),
        all_(all),
        self_(self),
        side_(side),
        whole_(whole),
        id_(engine.add_structure(*this)) {}
  TileBorder(const TileBorder&) = delete;
  TileBorder& operator=(const TileBorder&) = delete;

  /// The vertices, and the agendas' numbers; any other is one of ChooseSteiners.
  void attach(const VertexPool<D>& pool, std::uint64_t fills, std::uint64_t quadtree,
              std::uint64_t stars) noexcept {
    pool_ = &pool;
    fills_ = fills;
    quadtree_ = quadtree;
    stars_ = stars;
  }
  [[nodiscard]] const WholeInput<D>& whole() const noexcept { return whole_; }
  [[nodiscard]] bool owns(const Point<D>& p) const noexcept { return all_.owns(self_, p); }
  /// Whether nothing beyond the territory concerns who looks so far around v.
  [[nodiscard]] bool holds(const Vertex<D>& v, const Reach<D>& reach) const noexcept {
    return holds(area_of(v, reach));
  }
  [[nodiscard]] bool holds(const Box<D>& area) const noexcept {
    return all_.owns(self_, area.lo) && all_.owns(self_, area.hi);
  }
  /// Whether the territory meets the closed box; perhaps also if it is just beside it.
  [[nodiscard]] bool meets(const Box<D>& area) const noexcept {
    const Box<D>& own = all_.box(self_);
    const double slack = side_ * 0x1p-46;  // coordinates are rounded
    bool meets = true;
    for (std::size_t i = 0; i < D; ++i) {
      meets = meets && own.lo[i] - slack <= area.hi[i] && area.lo[i] <= own.hi[i] + slack;
    }
    return meets;
  }
  [[nodiscard]] Turn<D> turn_of(const sac::Call& call) const noexcept {
    const Stage stage = call.work_queue == fills_      ? Stage::fill
                        : call.work_queue == quadtree_ ? Stage::quadtree
                        : call.work_queue == stars_    ? Stage::stars
                                                       : Stage::steiner;
    Turn<D> turn{stage, sac::Slot::of(call).rank, sac::Slot::of(call).order, {}};
    const bool is_cut = D == 2 && turn.key(kKeyWidths).phase > 1;
    if (stage == Stage::steiner && !is_cut) {  // of a vertex in a bucket
      using Arguments = std::tuple<VertexRef<D>, int>;
      turn.p = std::get<0>(*static_cast<const Arguments*>(call.function().arguments(call)))->p;
    }
    return turn;
  }

  // --- Complete, and SplitSlivers, of other tiles' vertices: what they have to do here

  struct Question {  // the cell at a place, up to where
    Point<D> p;
    double radius;
  };
  struct Script {
    using Questions = std::map<std::uint32_t, Question>;  // what is looked at for others
    using Births = std::map<Newborn<D>, int>;             // by how many messages
    Questions questions;
    Births births;
    sac::Ref<sac::Call> reader;
    [[nodiscard]] bool is_empty() const noexcept { return questions.empty() && births.empty(); }
  };
  // Edits, which are undone in a roll-back: what that puts back is kept, so it allocates nothing.
  // They return whether there was anything to do before.
  bool begin_question(const Turn<D>& turn, std::uint32_t id, const Point<D>& p, double radius) {
    const Question question{p, radius};
    return edit_script(
        turn, [=](Script& script, Kept&) { script.questions.emplace(id, question); },
        [=](Script& script, Kept&) { script.questions.erase(id); });
  }
  bool end_question(const Turn<D>& turn, std::uint32_t id) {
    return edit_script(
        turn, [=](Script& script, Kept& kept) { kept.question = script.questions.extract(id); },
        [](Script& script, Kept& kept) { script.questions.insert(std::move(kept.question)); });
  }
  bool begin_birth(const Turn<D>& turn, const Newborn<D>& key) {
    return edit_script(
        turn, [=](Script& script, Kept&) { ++script.births[key]; },
        [=](Script& script, Kept& kept) { take_birth(script, key, kept); });
  }
  bool end_birth(const Turn<D>& turn, const Newborn<D>& key) {
    return edit_script(
        turn, [=](Script& script, Kept& kept) { take_birth(script, key, kept); },
        [=](Script& script, Kept& kept) {
          if (kept.birth) {
            script.births.insert(std::move(kept.birth)).position->second = 1;
          } else {
            ++script.births.at(key);
          }
        });
  }
  [[nodiscard]] bool has_script(const Turn<D>& turn) const {
    const auto it = scripts_.find(turn);
    return it != scripts_.end() && !it->second.is_empty();
  }
  /// What the running call, about a vertex of another tile, has to do.
  [[nodiscard]] const Script& read_script(sac::Scope& s) {
    static constexpr auto kAny = [](const sac::Edge&) { return true; };
    if (s.recall<sac::Edge>(id_, kScript, kAny) == nullptr) {
      static_cast<void>(s.observe<sac::Edge>(id_, kScript));
    }
    Script& script = scripts_[turn_of(s.self())];
    script.reader = engine_.handle_of(s.self());
    return script;
  }
  /// Forgets scripts with nothing to do. Requires: no run is under way, and none can be undone.
  void forget_scripts() noexcept {
    for (const Turn<D>& turn : edited_) {
      const auto it = scripts_.find(turn);
      if (it == scripts_.end() || !it->second.is_empty() || it->second.reader != nullptr) continue;
      scripts_.erase(it);
    }
    edited_.clear();
  }

  /// `role`: as the running call says; `asks_nearest`: see Birth.
  void hand_over(sac::Scope& s, VertexRef<D> v, int bucket, const Role& role = {},
                 bool asks_nearest = false) {
    const auto same = [&](const HandOver& e) {
      return e.vertex == v->self && e.bucket == bucket && e.role == role &&
             e.asks_nearest == asks_nearest;
    };
    if (s.recall<HandOver>(id_, kHandOver, same) != nullptr) return;
    const Birth<D> birth{v->p, bucket, turn_of(s.self()), role, asks_nearest};
    const auto live = born_.insert(birth);
    try {
      make_room(births_, born_.size());
      auto& edge = s.effect<HandOver>(id_, kHandOver);
      edge.vertex = v->self;
      edge.bucket = bucket;
      edge.role = role;
      edge.asks_nearest = asks_nearest;
    } catch (...) {
      born_.erase(live);
      throw;
    }
    births_.push_back({birth, 1});
  }
  void answer(sac::Scope& s, std::uint32_t id, std::span<const VertexHandle> found) {
    const auto same = [&](const Answer& e) {
      return e.id == id && std::equal(found.begin(), found.end(), e.found(), e.found() + e.count);
    };
    if (s.recall<Answer>(id_, kAnswer, same) != nullptr) return;
    answers_.try_emplace(id);
    make_room(answered_, answers_.size());
    auto& edge = s.effect<Answer>(id_, kAnswer, found.size_bytes());
    edge.id = id;
    edge.count = static_cast<std::uint32_t>(found.size());
    std::copy(found.begin(), found.end(), edge.found());
    answers_[id] = sac::Arena::ref(edge);
    answered_.push_back(id);
  }
  /// `piece`: of a leaf that is cut in bucket b, `key`: when.
  void request_cut(sac::Scope& s, const Piece& piece, int b, const sac::Key& key) {
    const auto same = [&](const CutEdge& e) { return e.piece == piece && e.bucket == b; };
    if (s.recall<CutEdge>(id_, kCut, same) != nullptr) return;
    make_room(cuts_, live_cuts_ + 1);
    auto& edge = s.effect<CutEdge>(id_, kCut);
    ++live_cuts_;
    edge.piece = piece;
    edge.bucket = b;
    edge.rank = kKeyWidths.rank(key);
    edge.order = key.order;
    cuts_.push_back({edge.cut(), 1});
  }
  /// SplitSlivers(v, b) is to run, at `key`.
  void hand_over_slivers(sac::Scope& s, VertexRef<D> v, int b, const sac::Key& key) {
    const auto same = [&](const SliversEdge& e) { return e.vertex == v->self && e.bucket == b; };
    if (s.recall<SliversEdge>(id_, kSlivers, same) != nullptr) return;
    make_room(slivers_, live_slivers_ + 1);
    auto& edge = s.effect<SliversEdge>(id_, kSlivers);
    ++live_slivers_;
    edge.vertex = v->self;
    edge.bucket = b;
    edge.rank = kKeyWidths.rank(key);
    edge.order = key.order;
    slivers_.push_back({sliver_call(edge), 1});
  }
  /// Errors are kept for good: there are few. `is_near`: a vertex would come too near to others; it
  /// may when nearness() is less.
  void fault(sac::Scope& s, const Error& error, bool is_near = false) {
    faults_.push_back(error);
    auto& edge = s.effect<Fault>(id_, kFault);
    edge.error = static_cast<std::uint32_t>(faults_.size() - 1);
    live_faults_.emplace(edge.error,
                         LiveFault{turn_of(s.self()), engine_.handle_of(s.self()), is_near});
  }
  [[nodiscard]] bool has_faults() const noexcept { return !live_faults_.empty(); }
  /// How near to others the running call may make a vertex: to begin with 1.
  [[nodiscard]] double nearness(sac::Scope& s) const {
    if (nearness_.empty()) return 1;
    const auto it = nearness_.find(turn_of(s.self()));
    return it == nearness_.end() ? 1 : it->second;
  }
  void reset_nearness() noexcept { nearness_.clear(); }
  /// An edit: calls that would have come too near to others are tried again, and may come nearer;
  /// no others may, which may meet what will not be there. Returns whether there are any, and have
  /// not been tried often enough.
  bool try_nearer() {
    constexpr double kStep = 0x1p-4, kLeast = 0x1p-48;
    bool any = false;
    for (const auto& [error, fault] : live_faults_) {
      if (!fault.is_near) continue;
      double& nearness = nearness_.try_emplace(fault.turn, 1).first->second;
      if (nearness <= kLeast) continue;
      nearness *= kStep;
      if (!any) engine_.begin_edit();
      any = true;
      engine_.invalidate(engine_.call(fault.call));
    }
    return any;
  }

  void looked(const Vertex<D>& center, const Observation<D>& o, double radius) override {
    const Box<D> area = area_of(center, o.reach);
    if (holds(area)) return;
    Look<D> look{center.p, radius, turn_of(engine_.call(o.call))};
    make_room(looks_, crossing_.size() + 1);
    crossing_.emplace(engine_.arena().handle_of(&o), std::pair{look, area});
    looks_.push_back({look, area, &o, 1});
  }
  void forgot(const Vertex<D>& center, const Observation<D>& o) noexcept override {
    if (crossing_.empty() || holds(center, o.reach)) return;
    const auto it = crossing_.find(engine_.arena().handle_of(&o));
    if (it == crossing_.end()) return;
    looks_.push_back({it->second.first, it->second.second, &o, -1});
    crossing_.erase(it);
  }

  // --- What has changed since it was asked last; in the order of events, each with 1 or -1

  struct LookEvent {
    Look<D> look;
    Box<D> area;  // beyond which nothing concerns it
    const Observation<D>* seen;
    int sign;
  };
  struct BirthEvent {
    Birth<D> birth;
    int sign;
  };
  [[nodiscard]] std::vector<LookEvent> take_looks() { return taken(looks_); }
  /// Calls visit(look, area) for all looks beyond the territory.
  template <class Visit>
  void for_each_look(Visit&& visit) const {
    for (const auto& [handle, look] : crossing_) visit(look.first, look.second);
  }
  /// Calls visit(birth) for all births beyond it, with roles as this tile calls them.
  template <class Visit>
  void for_each_birth(Visit&& visit) const {
    for (const Birth<D>& birth : born_) visit(birth);
  }
  /// Whether the observation of a look is still there.
  [[nodiscard]] bool is_there(const LookEvent& e) const {
    const auto it = crossing_.find(engine_.arena().handle_of(e.seen));
    return it != crossing_.end() && it->second.first == e.look;
  }
  [[nodiscard]] std::vector<BirthEvent> take_births() { return taken(births_); }
  /// By the tile's own names of segments.
  struct CutEvent {
    CutOfLeaf<D> cut;
    int sign;
  };
  [[nodiscard]] std::vector<CutEvent> take_cuts() { return taken(cuts_); }
  struct SliversEvent {
    SliverCall<D> call;
    int sign;
  };
  [[nodiscard]] std::vector<SliversEvent> take_slivers() { return taken(slivers_); }
  /// The questions whose answers may have changed; some more than once.
  [[nodiscard]] std::vector<std::uint32_t> take_answered() { return taken(answered_); }
  /// Who was found; nobody if the question is no more.
  [[nodiscard]] std::span<const VertexHandle> answer_to(std::uint32_t id) const {
    const auto it = answers_.find(id);
    if (it == answers_.end() || it->second == nullptr) return {};
    const Answer& edge = engine_.arena()[it->second];
    return {edge.found(), edge.count};
  }
  [[nodiscard]] bool has_answer(std::uint32_t id) const {
    const auto it = answers_.find(id);
    return it != answers_.end() && it->second != nullptr;
  }
  /// The first fault that there is, by turn.
  [[nodiscard]] std::optional<std::pair<Turn<D>, Error>> first_fault() const {
    std::optional<std::pair<Turn<D>, std::uint32_t>> first;
    for (const auto& [error, fault] : live_faults_) {
      if (!first || std::pair(fault.turn, error) < *first) first = {fault.turn, error};
    }
    if (!first) return std::nullopt;
    return std::pair(first->first, faults_[first->second]);
  }

  void retract(sac::Call& call, sac::Edge& edge) noexcept override {
    if (edge.kind == kHandOver) {
      const auto& e = static_cast<HandOver&>(edge);
      const Birth<D> birth{(*pool_)[e.vertex].p, e.bucket, turn_of(call), e.role, e.asks_nearest};
      births_.push_back({birth, -1});
      born_.erase(born_.find(birth));
    } else if (edge.kind == kAnswer) {
      const auto it = answers_.find(static_cast<Answer&>(edge).id);
      if (it == answers_.end() || it->second != sac::Arena::ref(static_cast<Answer&>(edge))) return;
      answered_.push_back(it->first);
      answers_.erase(it);
    } else if (edge.kind == kScript) {
      const auto it = scripts_.find(turn_of(call));
      if (it != scripts_.end() && it->second.reader == engine_.handle_of(call)) {
        it->second.reader = nullptr;
      }
    } else if (edge.kind == kCut) {
      cuts_.push_back({static_cast<CutEdge&>(edge).cut(), -1});
      --live_cuts_;
    } else if (edge.kind == kSlivers) {
      slivers_.push_back({sliver_call(static_cast<SliversEdge&>(edge)), -1});
      --live_slivers_;
    } else {
      live_faults_.erase(static_cast<Fault&>(edge).error);
    }
  }

 private:
  static constexpr std::uint8_t kHandOver = 0;
  static constexpr std::uint8_t kAnswer = 1;
  static constexpr std::uint8_t kFault = 2;
  static constexpr std::uint8_t kScript = 3;
  static constexpr std::uint8_t kCut = 4;
  static constexpr std::uint8_t kSlivers = 5;
  struct HandOver : sac::Edge {
    VertexHandle vertex;
    std::int32_t bucket;
    Role role;
    bool asks_nearest;
  };
  struct Answer : sac::Edge {
    std::uint32_t id;
    std::uint32_t count;
    [[nodiscard]] VertexHandle* found() noexcept {
      return reinterpret_cast<VertexHandle*>(this + 1);
    }
    [[nodiscard]] const VertexHandle* found() const noexcept {
      return reinterpret_cast<const VertexHandle*>(this + 1);
    }
  };
  struct Fault : sac::Edge {
    std::uint32_t error;
  };
  struct CutEdge : sac::Edge {
    Piece piece;
    std::int32_t bucket;
    std::uint32_t rank;
    std::uint64_t order;
    [[nodiscard]] CutOfLeaf<D> cut() const noexcept {
      return {piece, bucket, {Stage::steiner, rank, order, {}}};
    }
  };
  struct SliversEdge : sac::Edge {
    VertexHandle vertex;
    std::int32_t bucket;
    std::uint32_t rank;
    std::uint64_t order;
  };
  [[nodiscard]] SliverCall<D> sliver_call(const SliversEdge& e) const noexcept {
    const Point<D>& p = (*pool_)[e.vertex].p;
    return {p, e.bucket, {Stage::steiner, e.rank, e.order, p}};
  }

  struct Kept {
    bool is_done = false;
    typename Script::Questions::node_type question;
    typename Script::Births::node_type birth;
  };
  static void take_birth(Script& script, const Newborn<D>& key, Kept& kept) noexcept {
    const auto it = script.births.find(key);
    if (--it->second == 0) kept.birth = script.births.extract(it);
  }
  template <class Edit, class Undo>
  bool edit_script(const Turn<D>& turn, Edit edit, Undo undo) {
    edited_.push_back(turn);
    Script& script = scripts_[turn];  // stays where it is until it can no longer be undone
    const bool was_empty = script.is_empty();
    engine_.begin_edit();
    const auto memory = std::make_shared<Kept>();
    engine_.on_rollback([this, &script, memory, undo] {
      if (!memory->is_done) return;
      undo(script, *memory);
      changed(script);
    });
    edit(script, *memory);
    memory->is_done = true;
    changed(script);
    return !was_empty;
  }
  void changed(const Script& script) noexcept {
    if (script.reader != nullptr) engine_.invalidate(engine_.call(script.reader));
  }
  // The room stays.
  template <class Event>
  static std::vector<Event> taken(std::vector<Event>& events) {
    std::vector<Event> all = events;
    events.clear();
    return all;
  }
  // For one event more, and for each of `live` to be taken back, which must not allocate.
  template <class Event>
  static void make_room(std::vector<Event>& events, std::size_t live) {
    const std::size_t needed = events.size() + live + 1;
    if (events.capacity() < needed) events.reserve(2 * needed);
  }
  [[nodiscard]] Box<D> area_of(const Vertex<D>& center, const Reach<D>& within) const noexcept {
    const Box<D> reach = within.box();
    const double slack = side_ * 0x1p-46;  // sums are rounded
    Box<D> area;
    for (int i = 0; i < D; ++i) {
      area.lo[i] = center.p[i] + reach.lo[i] * side_ - slack;
      area.hi[i] = center.p[i] + reach.hi[i] * side_ + slack;
    }
    return area;
  }

  sac::Engine& engine_;
  const Territories<D>& all_;
  std::size_t self_;
  double side_;
  WholeInput<D> whole_;
  std::uint8_t id_;
  const VertexPool<D>* pool_ = nullptr;
  std::uint64_t fills_ = 0, quadtree_ = 0, stars_ = 0;
  std::unordered_map<sac::Handle, std::pair<Look<D>, Box<D>>> crossing_;
  std::vector<LookEvent> looks_;
  std::multiset<Birth<D>> born_;  // beyond the territory
  std::vector<BirthEvent> births_;
  std::vector<CutEvent> cuts_;
  std::size_t live_cuts_ = 0;
  std::vector<SliversEvent> slivers_;
  std::size_t live_slivers_ = 0;
  std::unordered_map<std::uint32_t, sac::Ref<Answer>> answers_;
  std::vector<std::uint32_t> answered_;
  std::map<Turn<D>, Script> scripts_;
  std::vector<Turn<D>> edited_;  // since some were forgotten last
  std::vector<Error> faults_;
  struct LiveFault {
    Turn<D> turn;
    sac::Ref<sac::Call> call;
    bool is_near;
  };
  std::unordered_map<std::uint32_t, LiveFault> live_faults_;
  std::map<Turn<D>, double> nearness_;  // of calls that are tried again
};

}  // namespace mesher::detail
