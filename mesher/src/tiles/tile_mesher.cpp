// A tile's runs, and what it tells others.
#include "tiles/tile_mesher.hpp"

#include <algorithm>
#include <map>

#include "mesh/canonical.hpp"
#include "program/world_impl.hpp"
#include "tiles/message_bytes.hpp"
#include "tiles/tile_calls.hpp"

namespace mesher::detail {

namespace {

constexpr std::size_t kAnyRecords = ~std::size_t{0};  // all tiles together have a limit

template <int D>
auto own_features(World<sac::Scope, D>& world, sac::Engine& engine, const WholeInput<D>& whole) {
  if constexpr (D == 3) {
    return SpaceFeatures(world, engine, whole.complex);
  } else {
    return std::monostate();
  }
}

// Of those that are counted, `key` is so many more, or fewer. Returns whether it begins to be there
// (true), or ends.
template <class Key>
std::optional<bool> add_to(std::map<Key, std::uint32_t>& counts, const Key& key, int more) {
  if (more == 0) return std::nullopt;
  std::uint32_t& count = counts[key];
  const bool was = count != 0;
  count = static_cast<std::uint32_t>(static_cast<int>(count) + more);
  const bool is = count != 0;
  if (!is) counts.erase(key);
  return was == is ? std::nullopt : std::optional(is);
}

}  // namespace

LineOrders LineOrders::inverse() const {
  LineOrders all;
  for (auto it = segments.rbegin(); it != segments.rend(); ++it) {
    all.segments.push_back({it->name, it->a, it->b, it->is, it->was});
  }
  for (auto it = leaves.rbegin(); it != leaves.rend(); ++it) {
    all.leaves.push_back({it->piece, !it->begins});
  }
  return all;
}

template <int D>
CommonOrders<D> CommonOrders<D>::inverse() const {
  CommonOrders all{lines.inverse(), features_in_space.inverse(), {}, features};
  if (limits) all.limits = LimitsChange{limits->is, limits->was, limits->where};
  return all;
}

template <int D>
TileMesher<D>::TileMesher(const Options<D>& options, const MeshBox<D>& box,
                          const Territories<D>& all, std::size_t self, const WholeInput<D>& whole)
    : all_(all),
      self_(self),
      engine_(std::make_unique<sac::Engine>()),
      border_(std::make_unique<TileBorder<D>>(*engine_, all, self, box.side, whole)),
      world_(std::make_unique<World<sac::Scope, D>>(options, box, *engine_, border_.get())),
      own_features_(own_features(*world_, *engine_, whole)),
      asked_(all.size()),
      askers_(all.size()) {
  border_->attach(world_->vertices.pool(), world_->fills.number(), world_->quadtree.number(),
                  world_->stars.number());
  world_->vertices.set_listener(border_.get());
  world_->most_records = kAnyRecords;
  world_->vertices.pool().for_each(
      [&](const Vertex<D>& v) { own_vertices_ += border_->owns(v.p); });
}

template <int D>
TileMesher<D>::~TileMesher() {
  engine_.reset();  // before what its calls refer to
}

// --- Edits and messages ----------------------------------------------------------------------

template <int D>
sac::Agenda& TileMesher<D>::agenda(const Turn<D>& turn) noexcept {
  if (turn.stage == Stage::fill) return world_->fills;
  if (turn.stage == Stage::quadtree) return world_->quadtree;
  if (turn.stage == Stage::stars) return world_->stars;
  return world_->steiner_at(turn.key(kKeyWidths).bucket);
}

template <int D>
void TileMesher<D>::edit(const std::vector<Edit>& edits) {
  const auto order = [&](const Point<D>& p, const Located& located, bool begins) {
    orders_.push_back(
        {Order::Kind::locate, begins, p, {}, located.level, 0, located.pitch, located.role});
  };
  for (const Edit& e : edits) {
    if (e.was) order(e.p, *e.was, false);
    if (e.is) order(e.p, *e.is, true);
  }
}

template <int D>
void TileMesher<D>::edit_common(std::shared_ptr<const CommonOrders<D>> common) {
  for (const Point<D>& p : common->features) {
    if (world_->surroundings.concerned(p)) features_.push_back(p);
  }
  const bool is_for_all = !common->lines.is_empty() || !common->features_in_space.is_empty();
  if (is_for_all || common->limits) common_.push_back(std::move(common));
}

// What limits change is as much as is in their boxes.
template <int D>
std::uint64_t TileMesher<D>::orders() const noexcept {
  constexpr std::uint64_t kMany = std::uint64_t{1} << 20;
  std::uint64_t all = orders_.size() + features_.size();
  for (const auto& common : common_) {
    if (common->limits && !common->limits->where.empty()) all += kMany;
  }
  return all;
}

template <int D>
void TileMesher<D>::receive(std::size_t from, const std::vector<Message<D>>& messages) {
  using Kind = typename Message<D>::Kind;
  const auto who = static_cast<std::uint32_t>(from);
  for (const Message<D>& m : messages) {
    if (m.to != self_) continue;
    switch (m.kind) {
      case Kind::ask:
        ask(who, m.look);
        break;
      case Kind::end:
        end(who, m.look);
        break;
      case Kind::arrive:
        arrived(who, m.birth);
        break;
      case Kind::depart:
        departed(who, m.birth);
        break;
      case Kind::cut:
      case Kind::uncut:
        note_cut(who, m.cut, m.begins());
        break;
      case Kind::split:
      case Kind::unsplit:
        note_split(who, m.slivers, m.begins());
        break;
    }
  }
}

template <int D>
void TileMesher<D>::ask(std::uint32_t from, const Look<D>& look) {
  ++counts_.questions;
  const std::uint32_t id = next_question_++;
  questions_.emplace(id, Question{from, look});
  askers_[from].questions.emplace(look, id);
  orders_.push_back({Order::Kind::ask, true, look.p, look.turn, 0, id, look.radius});
}

template <int D>
void TileMesher<D>::end(std::uint32_t from, const Look<D>& look) {
  const auto it = askers_[from].questions.find(look);
  SAC_ENSURES(it != askers_[from].questions.end());
  orders_.push_back({Order::Kind::ask, false, look.p, look.turn, 0, it->second, look.radius});
  askers_[from].questions.erase(it);  // the question is kept until its answer has gone
}

template <int D>
void TileMesher<D>::order_arrival(std::uint32_t from, const Birth<D>& birth, bool begins) {
  Order order{Order::Kind::arrive, begins, birth.p, birth.turn, birth.bucket, from, 0, birth.role};
  order.asks_nearest = birth.asks_nearest;
  orders_.push_back(order);
}

template <int D>
void TileMesher<D>::arrived(std::uint32_t from, const Birth<D>& birth) {
  ++(birth.bucket < 0 ? counts_.seen : counts_.born);
  from_.emplace(birth.p, From{{birth.turn, birth.role}, from});
  order_arrival(from, birth, true);
}

template <int D>
void TileMesher<D>::departed(std::uint32_t from, const Birth<D>& birth) {
  const auto [first, last] = from_.equal_range(birth.p);
  const From same{{birth.turn, birth.role}, from};
  const auto it = std::find_if(first, last, [&](const auto& f) { return f.second == same; });
  SAC_ENSURES(it != last);
  from_.erase(it);
  order_arrival(from, birth, false);
}

template <int D>
void TileMesher<D>::note_cut(std::uint32_t from, const CutOfLeaf<D>& cut, bool begins) {
  auto& cuts = askers_[from].cuts;
  const bool is_new = begins ? cuts.insert(cut).second : cuts.erase(cut) != 0;
  SAC_ENSURES(is_new);
  static_cast<void>(is_new);
  counts_.cuts += begins ? 1 : 0;
  orders_.push_back({Order::Kind::cut, begins, {}, cut.turn, cut.bucket, from, 0, {}, cut.piece});
}

template <int D>
void TileMesher<D>::note_split(std::uint32_t from, const SliverCall<D>& slivers, bool begins) {
  auto& all = askers_[from].slivers;
  const bool is_new = begins ? all.insert(slivers).second : all.erase(slivers) != 0;
  SAC_ENSURES(is_new);
  static_cast<void>(is_new);
  counts_.slivers += begins ? 1 : 0;
  orders_.push_back({Order::Kind::split, begins, slivers.p, slivers.turn, slivers.bucket, from, 0});
}

// Of a feature, as all tiles call it, and as this one does.
template <int D>
Role TileMesher<D>::named(Role role) const noexcept {
  if constexpr (D == 2) {
    if (role.on != 0) role.on = world_->segments.name(role.on);
    return role;
  } else {
    return own_features_.named(role);
  }
}
template <int D>
Role TileMesher<D>::own(Role role) const {
  if constexpr (D == 2) {
    if (role.on != 0) role.on = world_->segments.own(role.on);
    return role;
  } else {
    return own_features_.own(role);
  }
}
template <int D>
Birth<D> TileMesher<D>::named(Birth<D> birth) const noexcept {
  birth.role = named(birth.role);
  return birth;
}
template <int D>
bool TileMesher<D>::has_features_in_space() const noexcept {
  if constexpr (D == 3) return own_features_.any();
  return false;
}
template <int D>
Piece TileMesher<D>::named(Piece piece) const noexcept {
  if constexpr (D == 2) piece.segment = world_->segments.name(piece.segment);
  return piece;
}
template <int D>
Piece TileMesher<D>::own(Piece piece) const {
  if constexpr (D == 2) piece.segment = world_->segments.own(piece.segment);
  return piece;
}

template <int D>
void TileMesher<D>::carry_out_lines(const LineOrders& lines) {
  if constexpr (D == 2) {
    for (const GivenSegment& segment : lines.segments) world_->segments.edit(segment);
    for (const auto& leaf : lines.leaves) {
      const PieceRef piece = world_->segments.ref(own(leaf.piece));
      if (leaf.begins) {
        world_->splits.template post_from_outside<begin_leaf>(split_segment_key(world_->box, piece),
                                                              piece);
      } else {
        world_->splits.template retract_from_outside<begin_leaf>(piece);
      }
    }
  }
}

template <int D>
void TileMesher<D>::carry_out_cut(const Order& order) {
  if constexpr (D == 2) {
    const LeafRef leaf = world_->leaves.claim(own(order.piece));
    edit_call<cut>(order.turn, order.begins, leaf, order.number);
  }
}

// The call stays about the vertex's record if that is no vertex (yet).
template <int D>
void TileMesher<D>::carry_out_split(const Order& order) {
  if constexpr (D == 3) {
    const VertexRef<D> v = world_->vertices.claim(order.p);
    hold(*v, order.begins ? 1 : -1);
    edit_call<split_slivers>(order.turn, order.begins, v, order.number);
  }
}

// A call more, or less, that keeps the record.
template <int D>
void TileMesher<D>::hold(Vertex<D>& v, int by) {
  if (v.held == Vertex<D>::kMostHeld) return;
  engine_->begin_edit();
  engine_->on_rollback([&v, was = std::uint8_t{v.held}] { v.held = was & 31; });
  v.held = static_cast<std::uint8_t>(v.held + by) & 31;
}

template <int D>
void TileMesher<D>::locate(const Order& order, VertexRef<D> v) {
  const Role role = own(order.role);
  if (!has_features_in_space()) {  // then this is told of all points
    Vertex<D>* const record = v.v;
    engine_->begin_edit();
    engine_->on_rollback([record, was = bool{v->input}] { record->input = was; });
    v->input = order.begins && role.on == 0;
  }
  if (role.on != 0) {
    const auto [distance, from_b] = std::pair(role.label.distance(), role.label.from_b());
    if (order.begins) {
      world_->quadtree.template post_from_outside<locate_on_segment>(
          locate_key(world_->box.fixed(v->p)), v, order.number, order.radius, role.on, distance,
          from_b);
    } else {
      world_->quadtree.template retract_from_outside<locate_on_segment>(
          v, order.number, order.radius, role.on, distance, from_b);
    }
  } else if (order.begins) {
    world_->quadtree.template post_from_outside<locate_known>(locate_key(world_->box.fixed(v->p)),
                                                              v, order.number, order.radius);
  } else {
    world_->quadtree.template retract_from_outside<locate_known>(v, order.number, order.radius);
  }
}

template <int D>
void TileMesher<D>::carry_out(const Order& order) {
  if (order.kind == Order::Kind::cut) return carry_out_cut(order);
  if (order.kind == Order::Kind::split) return carry_out_split(order);
  const VertexRef<D> v = world_->vertices.claim(order.p);
  if (order.kind == Order::Kind::locate) return locate(order, v);
  const Turn<D>& t = order.turn;
  const sac::Key key = t.key(kKeyWidths);
  const bool is_in_call = key.phase == 1 || (D == 3 && key.phase == 2);
  if (t.stage == Stage::steiner && is_in_call) return carry_out_in_call(order, key);
  sac::Agenda& at = agenda(t);
  const auto stage = static_cast<std::uint32_t>(t.stage);
  if (order.role.on != 0) {
    const Role role = own(order.role);
    const auto [distance, from_b] = std::pair(role.label.distance(), role.label.from_b());
    if (order.begins) {
      at.template post_from_outside<arrive_on_segment>(key, v, role.on, distance, from_b, stage,
                                                       t.rank, t.order, order.name);
    } else {
      at.template retract_from_outside<arrive_on_segment>(v, role.on, distance, from_b, stage,
                                                          t.rank, t.order, order.name);
    }
  } else if (order.kind == Order::Kind::ask) {
    order.begins ? at.template post_from_outside<across>(key, v, order.radius, order.name)
                 : at.template retract_from_outside<across>(v, order.radius, order.name);
  } else {
    order.begins ? at.template post_from_outside<arrive>(key, v, order.number, stage, t.rank,
                                                         t.order, order.name)
                 : at.template retract_from_outside<arrive>(v, order.number, stage, t.rank, t.order,
                                                            order.name);
  }
}

// Calls of one key run in the order of their vertices' places, so what is Complete elsewhere is
// Complete here, and what is SplitSlivers is that.
template <int D>
void TileMesher<D>::carry_out_in_call(const Order& order, const sac::Key& key) {
  const auto edit = [&] {
    const Turn<D>& turn = order.turn;
    if (order.kind == Order::Kind::ask) {
      return order.begins ? border_->begin_question(turn, order.name, order.p, order.radius)
                          : border_->end_question(turn, order.name);
    }
    const Newborn<D> birth{order.p, order.number, own(order.role), order.asks_nearest};
    return order.begins ? border_->begin_birth(turn, birth) : border_->end_birth(turn, birth);
  };
  const bool was_there = edit();
  const bool is_there = border_->has_script(order.turn);
  if (was_there == is_there) return;
  const VertexRef<D> v = world_->vertices.claim(order.turn.p);
  hold(*v, is_there ? 1 : -1);
  if constexpr (D == 3) {
    if (key.phase == 2) return edit_call<split_slivers>(order.turn, is_there, v, key.bucket);
  }
  edit_call<complete>(order.turn, is_there, v, key.bucket);
}

// Posts a call from outside, or takes it back.
template <int D>
template <auto F, class... Args>
void TileMesher<D>::edit_call(const Turn<D>& turn, bool begins, const Args&... args) {
  sac::Agenda& at = agenda(turn);
  if (begins) {
    at.template post_from_outside<F>(turn.key(kKeyWidths), args...);
  } else {
    at.template retract_from_outside<F>(args...);
  }
}

template <int D>
void TileMesher<D>::post_orders() {
  engine_->edit_together([&] {
    for (const auto& common : common_) {
      if (common->limits) {
        edit_limits(*world_, common->limits->is, common->limits->where, *engine_);
      }
      carry_out_lines(common->lines);
      if constexpr (D == 3) own_features_.carry_out(common->features_in_space);
    }
    for (const Point<D>& p : features_) world_->surroundings.feature_changed(p);
    for (const Order& order : orders_) carry_out(order);
  });
}

template <int D>
void TileMesher<D>::forget_orders() noexcept {
  common_.clear();
  features_.clear();
  orders_.clear();
}

template <int D>
void TileMesher<D>::watch(std::function<bool(std::uint64_t)> report) {
  constexpr std::uint64_t kEvery = RunControl::kCallsBetween;
  engine_->set_progress(
      [report = std::move(report)](const sac::Progress&) { return report(kEvery); }, kEvery);
}

// --- Runs ------------------------------------------------------------------------------------

template <int D>
void TileMesher<D>::run_quadtree() {
  post_orders();
  forget_orders();
  world_->most_records = world_->most_vertices;  // all that come here are in the mesh
  counts_.run += engine_->template run<detail::run_quadtree<D>>().executed;
  world_->most_records = kAnyRecords;
}

template <int D>
void TileMesher<D>::begin_questions() {
  world_->vertices.begin_reading();
}

template <int D>
void TileMesher<D>::run_part(int part) {
  counts_.run += engine_->template run<detail::run_part<D>>(part).executed;
}

template <int D>
void TileMesher<D>::run_stars() {
  counts_.run += engine_->template run<detail::run_stars<D>>().executed;
  if (has_features_in_space()) {
    world_->vertices.end_reading();
  } else {
    world_->vertices.keep_triangulation();
  }
}

template <int D>
int TileMesher<D>::next_part(int part) const noexcept {
  while (part < parts() && world_->parts[static_cast<std::size_t>(part)]->waiting_calls() == 0) {
    ++part;
  }
  return part;
}

template <int D>
void TileMesher<D>::propagate() {
  post_orders();
  world_->most_records = records_in_update();
  if (look_bound_) {
    world_->vertices.bound_looks(look_bound_->more + look_bound_->a_call * engine_->live_calls());
  }
  counts_.again += engine_->propagate().executed;
  forget_orders();
  tries_nearer_ = false;
}

template <int D>
void TileMesher<D>::bound_looks(const std::optional<LookBound>& bound) noexcept {
  look_bound_ = bound;
  if (!bound) world_->vertices.bound_looks(~std::uint64_t{0});
}

// Where limits ask for too many vertices, these shall not need all memory before it is known. (What
// comes on the way, too, is not more than there will be, and are here.)
template <int D>
std::size_t TileMesher<D>::records_in_update() const noexcept {
  constexpr std::size_t kOnTheWay = 4096;
  const std::size_t now = world_->vertices.pool().size(), most = world_->most_vertices;
  if (!world_->limits.any() || most > kAnyRecords / 4) return kAnyRecords;
  return now + 2 * most + kOnTheWay;
}

template <int D>
bool TileMesher<D>::try_nearer() {
  if (!border_->has_faults()) return false;
  engine_->edit_together([&] { tries_nearer_ = border_->try_nearer(); });
  return tries_nearer_;
}

// --- What is new -----------------------------------------------------------------------------

template <int D>
std::vector<Message<D>> TileMesher<D>::collect(Changes* changes) {
  std::vector<Message<D>> out;
  const Log log = world_->vertices.log();
  Doubtful doubtful(askers_.size());
  for (const VertexHandle h : log.touched) {
    const auto [begin, end] = told_to_.equal_range(h);
    for (auto it = begin; it != end; ++it) doubtful[it->second].push_back(h);
  }
  collect_looks(out, doubtful);
  collect_births(out);
  collect_cuts(out);
  collect_slivers(out);
  collect_answers(doubtful);
  tell(doubtful, out);
  if (changes != nullptr) collect_changes(log, *changes);
  count_own(log.touched);
  world_->vertices.keep_reading(log.touched);
  if constexpr (D == 2) world_->leaves.commit();
  world_->vertices.commit();
  border_->forget_scripts();
  return out;
}

template <int D>
void TileMesher<D>::commit_lines() noexcept {
  if constexpr (D == 2) {
    world_->segments.commit();
  } else {
    if (own_features_.any()) own_features_.commit();
  }
}

// Who is found for a tile, or bounds what it is asked for.
template <int D>
void TileMesher<D>::note(std::size_t tile, VertexHandle h, Doubtful& doubtful) {
  const Vertex<D>& v = world_->vertices.pool()[h];
  if (v.boundary || !border_->owns(v.p)) return;
  if (!askers_[tile].told.try_emplace(h).second) return;
  told_to_.emplace(h, static_cast<std::uint32_t>(tile));
  doubtful[tile].push_back(h);
}

// Looks that came and went, or went and came, are as they were. Who is asked is told, too, whom the
// look has seen here: it need not look behind these.
template <int D>
void TileMesher<D>::collect_looks(std::vector<Message<D>>& out, Doubtful& doubtful) {
  using Kind = typename Message<D>::Kind;
  std::map<std::pair<std::uint32_t, Look<D>>, int> changed;
  for (const auto& e : border_->take_looks()) {
    const bool is_new = e.sign > 0 && border_->is_there(e);
    all_.for_each_met(e.area, [&](std::size_t tile) {
      if (tile == self_) return;
      changed[{static_cast<std::uint32_t>(tile), e.look}] += e.sign;
      if (!is_new) return;
      for (const std::uint32_t h : world_->vertices.seen_by(*e.seen)) {
        if (h != 0 && h < CellOf<D>::kVirtual) note(tile, h, doubtful);
      }
    });
  }
  for (const auto& [where, sum] : changed) {
    const auto& [to, look] = where;
    if (sum == 0) continue;
    auto& looks = asked_[to].looks;
    std::uint32_t& count = looks[look];
    const bool was = count != 0;
    count = static_cast<std::uint32_t>(static_cast<int>(count) + sum);
    const bool is = count != 0;
    if (!is) looks.erase(look);
    if (was != is) out.push_back({is ? Kind::ask : Kind::end, to, look, {}});
  }
}

template <int D>
void TileMesher<D>::collect_births(std::vector<Message<D>>& out) {
  using Kind = typename Message<D>::Kind;
  std::map<Birth<D>, int> changed;
  for (const auto& e : border_->take_births()) changed[named(e.birth)] += e.sign;
  for (const auto& [birth, sum] : changed) {
    if (sum == 0) continue;
    const auto to = static_cast<std::uint32_t>(all_.owner(birth.p));
    out.push_back({sum > 0 ? Kind::arrive : Kind::depart, to, {}, birth});
  }
}

// All tiles have all leaves: whoever calls for a cut says so to all.
template <int D>
void TileMesher<D>::collect_cuts(std::vector<Message<D>>& out) {
  using Kind = typename Message<D>::Kind;
  std::map<CutOfLeaf<D>, int> changed;
  for (auto e : border_->take_cuts()) {
    e.cut.piece = named(e.cut.piece);
    changed[e.cut] += e.sign;
  }
  for (const auto& [cut, sum] : changed) {
    const auto begins = add_to(cuts_, cut, sum);
    if (!begins) continue;
    for (std::uint32_t t = 0; t < askers_.size(); ++t) {
      if (t != self_) out.push_back({*begins ? Kind::cut : Kind::uncut, t, {}, {}, cut});
    }
  }
}

template <int D>
void TileMesher<D>::collect_slivers(std::vector<Message<D>>& out) {
  using Kind = typename Message<D>::Kind;
  std::map<SliverCall<D>, int> changed;
  for (const auto& e : border_->take_slivers()) changed[e.call] += e.sign;
  for (const auto& [call, sum] : changed) {
    const auto begins = add_to(slivers_, call, sum);
    if (!begins) continue;
    const auto to = static_cast<std::uint32_t>(all_.owner(call.p));
    out.push_back({*begins ? Kind::split : Kind::unsplit, to, {}, {}, {}, call});
  }
}

// When and as what v was born, unless that was in the asking tile, which knows.
template <int D>
auto TileMesher<D>::birth_for(std::uint32_t asker, const Vertex<D>& v) const
    -> std::optional<Born> {
  if (!v.alive || v.boundary) return std::nullopt;
  const Born born{border_->turn_of(engine_->call_at(v.presence.birth())),
                  named(world_->vertices.role(v))};
  const auto [first, last] = from_.equal_range(v.p);
  const bool known = std::any_of(first, last, [&](const auto& f) {
    return f.second == From{born, asker};
  });
  return known ? std::nullopt : std::optional(born);
}

// Points are located before there are other calls.
template <int D>
bool TileMesher<D>::has_heard_of_input(const Vertex<D>& v) const {
  const auto [first, last] = from_.equal_range(v.p);
  return std::any_of(first, last, [](const auto& f) {
    const Born& born = f.second.born;
    return born.turn.stage == Stage::quadtree && born.role.on == 0;
  });
}

template <int D>
void TileMesher<D>::collect_answers(Doubtful& doubtful) {
  for (const std::uint32_t id : border_->take_answered()) {
    const auto it = questions_.find(id);
    if (it == questions_.end()) continue;  // looked at already, and gone
    const Question& q = it->second;
    for (const VertexHandle h : border_->answer_to(id)) note(q.from, h, doubtful);
    const auto still = askers_[q.from].questions.find(q.look);
    const bool is_asked = still != askers_[q.from].questions.end() && still->second == id;
    if (!is_asked) questions_.erase(it);
  }
}

template <int D>
void TileMesher<D>::forget_told(std::size_t tile, VertexHandle h) {
  askers_[tile].told.erase(h);
  const auto [begin, end] = told_to_.equal_range(h);
  told_to_.erase(std::find_if(begin, end, [&](const auto& one) { return one.second == tile; }));
}

template <int D>
void TileMesher<D>::tell(Doubtful& doubtful, std::vector<Message<D>>& out) {
  using Kind = typename Message<D>::Kind;
  const auto& pool = world_->vertices.pool();
  for (std::size_t t = 0; t < askers_.size(); ++t) {
    auto& some = doubtful[t];
    std::sort(some.begin(), some.end(),
              [&](VertexHandle a, VertexHandle b) { return pool[a].p < pool[b].p; });
    some.erase(std::unique(some.begin(), some.end()), some.end());
    for (const VertexHandle h : some) {
      std::optional<Born>& told = askers_[t].told.at(h);
      const auto to = static_cast<std::uint32_t>(t);
      const std::optional<Born> born = birth_for(to, pool[h]);
      const auto say = [&](Kind kind, const Born& what) {
        out.push_back({kind, to, {}, {pool[h].p, -1, what.turn, what.role}, {}});
      };
      if (born != told) {
        if (told) say(Kind::depart, *told);
        if (born) say(Kind::arrive, *born);
        told = born;
      }
      if (!pool[h].alive) forget_told(t, h);
    }
  }
}

template <int D>
void TileMesher<D>::count_own(const std::vector<VertexHandle>& touched) noexcept {
  for (const VertexHandle h : touched) {
    const Vertex<D>& v = world_->vertices.pool()[h];
    if (v.alive == v.committed || !border_->owns(v.p)) continue;
    v.alive ? ++own_vertices_ : --own_vertices_;
  }
}

template <int D>
bool TileMesher<D>::outputs(const Simplex& t) const noexcept {
  const auto& pool = world_->vertices.pool();
  const auto is_before = [&](VertexHandle a, VertexHandle b) { return pool[a].p < pool[b].p; };
  return border_->owns(pool[*std::min_element(t.begin(), t.end(), is_before)].p);
}

template <int D>
std::size_t TileMesher<D>::own_simplices() const {
  std::size_t count = 0;
  for_each_own([&](const Simplex&) { ++count; });
  return count;
}

template <int D>
void TileMesher<D>::collect_changes(const Log& log, Changes& changes) const {
  const auto& pool = world_->vertices.pool();
  for (const VertexHandle h : log.touched) {
    const Vertex<D>& v = pool[h];
    if (!border_->owns(v.p)) continue;
    const bool same = v.alive == v.committed && v.kind() == v.committed_kind;
    if (same && !has_features_in_space()) continue;
    if (v.committed) changes.vertices.push_back({v.p, v.committed_kind, false});
    if (v.alive) changes.vertices.push_back({v.p, v.kind(), true});
  }
  if constexpr (D == 2) {
    world_->leaves.for_each_changed([&](const Leaf& leaf) {
      const bool is = world_->leaves.is_leaf(leaf);
      if (is == leaf.committed || !border_->owns(leaf.lo)) return;
      changes.leaves.push_back({named(leaf.piece), leaf.lo, leaf.hi, is});
    });
  }
  const auto add = [&](const std::vector<Simplex>& simplices, auto& all) {
    for (const Simplex& t : simplices) {
      if (!outputs(t)) continue;
      auto& places = all.emplace_back();
      for (std::size_t k = 0; k < t.size(); ++k) places[k] = pool[t[k]].p;
      places = smallest_first(places);
    }
  };
  add(log.simplices_gone, changes.simplices_gone);
  add(log.simplices_come, changes.simplices_come);
}

// --- Between runs ----------------------------------------------------------------------------

// Looks that are equal are one question.
template <int D>
std::vector<KnownOf> TileMesher<D>::said() const {
  std::vector<KnownOf> all(all_.size());
  std::set<std::pair<std::size_t, Look<D>>> looks;
  border_->for_each_look([&](const Look<D>& look, const Box<D>& area) {
    all_.for_each_met(area, [&](std::size_t tile) {
      if (tile != self_ && looks.emplace(tile, look).second) all[tile].add(look);
    });
  });
  border_->for_each_birth([&](const Birth<D>& birth) {
    all[all_.owner(birth.p)].add(birth.p, birth.turn, of_all(named(birth.role)));
  });
  const auto& pool = world_->vertices.pool();
  for (std::size_t tile = 0; tile < askers_.size(); ++tile) {
    for (const auto& [h, told] : askers_[tile].told) {
      const auto born = birth_for(static_cast<std::uint32_t>(tile), pool[h]);
      if (born) all[tile].add(pool[h].p, born->turn, of_all(born->role));
    }
  }
  for (const auto& [cut, count] : cuts_) {
    const CutOfLeaf<D> is = of_all(cut);
    for (std::size_t tile = 0; tile < all.size(); ++tile) {
      if (tile != self_) all[tile].add(is);
    }
  }
  for (const auto& [call, count] : slivers_) all[all_.owner(call.p)].add(call);
  return all;
}

template <int D>
std::vector<KnownOf> TileMesher<D>::heard() const {
  std::vector<KnownOf> all(all_.size());
  for (std::size_t tile = 0; tile < askers_.size(); ++tile) {
    for (const auto& [look, question] : askers_[tile].questions) all[tile].add(look);
    for (const CutOfLeaf<D>& cut : askers_[tile].cuts) all[tile].add(of_all(cut));
    for (const SliverCall<D>& call : askers_[tile].slivers) all[tile].add(call);
  }
  for (const auto& [p, from] : from_) {
    all[from.tile].add(p, from.born.turn, of_all(from.born.role));
  }
  return all;
}

// Of a feature by its number, if there are several processes.
template <int D>
Role TileMesher<D>::of_all(const Role& role) const {
  return numbered(role, border_->whole());
}
template <int D>
CutOfLeaf<D> TileMesher<D>::of_all(CutOfLeaf<D> cut) const {
  const auto& whole = border_->whole();
  if (whole.lines != nullptr) cut.piece.segment = whole.lines->of(cut.piece.segment);
  return cut;
}

template <int D>
std::string TileMesher<D>::answers_fault(std::size_t asker) const {
  const auto& pool = world_->vertices.pool();
  const auto pair = [&] {
    return " of tile " + std::to_string(self_) + " to tile " + std::to_string(asker);
  };
  for (const auto& [look, question] : askers_[asker].questions) {
    if (!border_->has_answer(question)) return "an answer is missing" + pair();
    for (const VertexHandle h : border_->answer_to(question)) {
      if (pool[h].boundary || !border_->owns(pool[h].p)) continue;
      const auto told = askers_[asker].told.find(h);
      const auto born = birth_for(static_cast<std::uint32_t>(asker), pool[h]);
      if (told == askers_[asker].told.end() || told->second != born) {
        return "an answer was not told" + pair();
      }
    }
  }
  return {};
}

template <int D>
std::string TileMesher<D>::fault_with(const TileMesher& other) const {
  std::string fault = difference(said()[other.self_], other.heard()[self_], self_, other.self_);
  if (fault.empty()) fault = other.answers_fault(self_);
  return fault;
}

template <int D>
std::size_t TileMesher<D>::bytes() const {
  const auto& vertices = world_->vertices;
  return engine_->bytes() + vertices.pool().bytes() + vertices.tree().bytes() +
         vertices.triangulation_bytes();
}

template <int D>
void TileMesher<D>::check_invariants() const {
  engine_->check_invariants();
  world_->vertices.check_invariants();
  if constexpr (D == 2) {
    world_->segments.check_invariants();
    world_->leaves.check_invariants();
  } else {
    world_->plc.check_invariants();
  }
}

template struct CommonOrders<2>;
template class TileMesher<2>;
#ifndef MESHER_PLANE_ONLY
template struct CommonOrders<3>;
template class TileMesher<3>;
#endif

}  // namespace mesher::detail
