// Rounds, and the mesh out of the tiles.
#include "tiles/tiled_mesher.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <map>
#include <mutex>
#include <numeric>

#include "mesh/canonical.hpp"
#include "program/triangulate.hpp"
#include "program/world_impl.hpp"
#include "tiles/message_bytes.hpp"
#include "tiles/on_threads.hpp"

namespace mesher::detail {

template <int D>
TiledMesher<D>::TiledMesher(const Options<D>& options, const MeshBox<D>& box,
                            const std::vector<Point<D>>& places, std::size_t tiles,
                            std::size_t threads, Peers& peers, const WholeInput<D>& whole)
    : options_(options),
      threads_(threads),
      peers_(peers),
      whole_(whole),
      all_(places, tiles),
      process_of_(all_.size()),
      in_(all_.size()),
      to_others_(peers.size()),
      views_(peers.size()) {
  const auto first_of = [&](std::size_t process) { return all_.size() * process / peers.size(); };
  for (std::size_t k = 0; k < peers.size(); ++k) {
    std::fill(process_of_.begin() + static_cast<std::ptrdiff_t>(first_of(k)),
              process_of_.begin() + static_cast<std::ptrdiff_t>(first_of(k + 1)),
              static_cast<std::uint32_t>(k));
  }
  first_ = first_of(peers.self());
  for (std::size_t t = first_; t < first_of(peers.self() + 1); ++t) {
    tiles_.push_back(std::make_unique<TileMesher<D>>(options, box, all_, t, whole));
  }
  out_.resize(tiles_.size());
  waiting_.resize(tiles_.size());
}

// --- Threads ---------------------------------------------------------------------------------

// Calls act(t) for these tiles, on up to threads_ threads; on one if there is little work, in
// calls. Throws: what act() has thrown, that of the first tile; but being stopped only if that is
// all.
template <int D>
template <class Act>
void TiledMesher<D>::run(const std::vector<std::size_t>& which, std::uint64_t work_to_do,
                         Act&& act) {
  std::vector<std::exception_ptr> failures(which.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&](std::size_t) {
    for (std::size_t k; (k = next++) < which.size();) {
      try {
        act(which[k]);
      } catch (...) {
        failures[k] = std::current_exception();
        stops_ = true;
      }
    }
  };
  constexpr std::uint64_t kLittle = 64;  // takes less time than to begin a thread
  on_threads(work_to_do < kLittle ? 1 : std::min(threads_, which.size()), work);
  std::exception_ptr stopped;
  for (const std::exception_ptr& failure : failures) {
    if (!failure) continue;
    try {
      std::rethrow_exception(failure);
    } catch (const sac::Cancelled&) {
      stopped = failure;
    }
  }
  if (stopped) std::rethrow_exception(stopped);
}

template <int D>
template <class Act>
void TiledMesher<D>::for_each_tile(std::uint64_t work, Act&& act) {
  std::vector<std::size_t> all(tiles_.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  run(all, work, act);
}

template <int D>
void TiledMesher<D>::watch(const Ask& ask) {
  ask_ = ask;
  asker_ = std::this_thread::get_id();
  stops_ = gives_up_ = false;
  calls_ = 0;
  for (const auto& tile : tiles_) {
    tile->watch([this](std::uint64_t calls) {
      const std::uint64_t all = calls_ += calls;
      if (phase_ == Phase::update && all > most_calls_) stops_ = gives_up_ = true;
      const bool asks = ask_ && std::this_thread::get_id() == asker_ && !stops_;
      if (asks && !ask_(phase_, all)) stops_ = true;
      return !stops_;
    });
  }
}

template <int D>
void TiledMesher<D>::bound_calls() noexcept {
  constexpr std::uint64_t kFew = 1 << 16;  // more than that, and than
  constexpr std::uint64_t kTimes = 4;      // times those that there are, are too many
  most_calls_ = kFew;
  for (const auto& tile : tiles_) most_calls_ += kTimes * tile->engine().live_calls();
}

template <int D>
void TiledMesher<D>::unwatch() noexcept {
  ask_ = nullptr;
  stops_ = false;
}

// --- Processes -------------------------------------------------------------------------------

// A part of what this process does until all agree; nothing if an earlier part has failed.
template <int D>
template <class Act>
void TiledMesher<D>::attempt(Act&& act) noexcept {
  if (failure_) return;
  try {
    act();
  } catch (...) {
    failure_ = std::current_exception();
  }
}

template <int D>
void TiledMesher<D>::agree(Peers::Values values) {
  detail::agree(peers_, std::exchange(failure_, nullptr), values);
}

template <int D>
std::uint64_t TiledMesher<D>::least_of(std::uint64_t value) {
  peers_.least({&value, 1});
  return value;
}

// --- Rounds ----------------------------------------------------------------------------------

template <int D>
void TiledMesher<D>::sort_messages() {
  is_exact_ = false;
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    for (const Message<D>& m : out_[t]) waiting_[t].add(m);
    out_[t].clear();
  }
  is_exact_ = true;
}

template <int D>
auto TiledMesher<D>::agree_on_next() -> Next {
  constexpr std::uint64_t kNone = ~std::uint64_t{0};
  std::array<std::uint64_t, 3> next{kNone, 1, 1};
  for (const auto& waiting : waiting_) {
    if (waiting.is_empty()) continue;
    const auto [stage, bucket] = waiting.first();
    next[0] = std::min(next[0], static_cast<std::uint64_t>(stage) << 32 | bucket);
  }
  for (const auto& tile : tiles_) {
    if (tile->is_dirty()) next[1] = 0;
    if (tile->border().has_faults()) next[2] = 0;
  }
  agree(next);
  const Time first{static_cast<Stage>(next[0] >> 32), static_cast<std::uint32_t>(next[0])};
  return {next[0] == kNone ? std::nullopt : std::optional(first), next[1] == 0, next[2] == 0};
}

// What a tile says until then, to whom it concerns.
template <int D>
void TiledMesher<D>::post(std::size_t tile, const Time& last) {
  const auto from = static_cast<std::uint32_t>(first_ + tile);
  waiting_[tile].send_until(last, [&](const Message<D>& m) {
    ++exchanges_.messages;
    const std::size_t process = process_of_[m.to];
    if (process == peers_.self()) return in_[from].push_back(m);
    ++exchanges_.messages_out;
    pack(from, m, whole_, to_others_[process]);
  });
}

// What fails on the way loses messages.
template <int D>
void TiledMesher<D>::exchange(const Time& last) {
  ++exchanges_.rounds;
  is_exact_ = false;
  const std::uint64_t before = exchanges_.messages;
  attempt([&] {
    for (std::size_t t = 0; t < tiles_.size(); ++t) post(t, last);
  });
  std::uint64_t messages = exchanges_.messages - before;
  if (!peers_.is_alone()) {
    std::uint64_t bytes = 0;
    for (std::size_t k = 0; k < views_.size(); ++k) {
      if (failure_) to_others_[k].clear();  // the last message may not be whole
      views_[k] = to_others_[k].bytes();
      bytes += views_[k].size();
    }
    exchanges_.bytes_out += bytes;
    exchanges_.most_bytes_out = std::max(exchanges_.most_bytes_out, bytes);
    const std::vector<Bytes> came = peers_.exchange(views_);
    for (Packer& parcel : to_others_) parcel.clear();
    attempt([&] {
      for (const Bytes& parcel : came) {
        for (Unpacker rest(parcel); !rest.is_empty(); ++messages) {
          const auto [from, m] = unpack_message(rest, whole_);
          in_[from].push_back(m);
        }
      }
    });
  }
  attempt([&] {
    for_each_tile(messages / 16, [&](std::size_t t) {
      for (std::size_t from = 0; from < in_.size(); ++from) tiles_[t]->receive(from, in_[from]);
    });
    for (auto& in : in_) in.clear();
    is_exact_ = true;
  });
}

// What would come too near to others, in any process.
template <int D>
bool TiledMesher<D>::try_nearer() {
  bool any = false;
  attempt([&] {
    for (const auto& tile : tiles_) any = tile->try_nearer() || any;
  });
  std::uint64_t is_none = any ? 0 : 1;
  agree({&is_none, 1});
  return is_none == 0;
}

// Messages that wait are sent first.
template <int D>
void TiledMesher<D>::settle(Changes* changes) {
  for (const auto& tile : tiles_) tile->reset_nearness();
  while (true) {
    attempt([&] { sort_messages(); });
    const Next next = agree_on_next();
    const bool is_settled = !next.first && !next.is_dirty;
    if (is_settled && !(next.has_faults && try_nearer())) return;
    if (next.first) exchange(*next.first);
    attempt([&] { run_dirty(changes); });
  }
}

template <int D>
void TiledMesher<D>::run_dirty(Changes* changes) {
  std::vector<std::size_t> dirty;
  std::uint64_t orders = 0;
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    if (!tiles_[t]->is_dirty()) continue;
    dirty.push_back(t);
    orders += tiles_[t]->orders();
  }
  if (dirty.empty()) return;
  if (stops_) throw sac::Cancelled();
  std::vector<Changes> all(changes != nullptr ? tiles_.size() : 0);
  std::atomic<bool> lost = false;
  const auto act = [&](std::size_t t) {
    tiles_[t]->propagate();
    try {
      out_[t] = tiles_[t]->collect(changes != nullptr ? &all[t] : nullptr);
    } catch (...) {
      lost = true;
      throw;
    }
  };
  try {
    run(dirty, orders, act);
  } catch (...) {
    if (lost) is_exact_ = false;
    throw;
  }
  if (changes == nullptr) return;
  for (const std::size_t t : dirty) {
    const auto append = [](auto& to, const auto& from) {
      to.insert(to.end(), from.begin(), from.end());
    };
    append(changes->vertices, all[t].vertices);
    append(changes->leaves, all[t].leaves);
    append(changes->simplices_come, all[t].simplices_come);
    append(changes->simplices_gone, all[t].simplices_gone);
  }
}

// The first of all, by turn.
template <int D>
void TiledMesher<D>::require_no_fault() {
  std::optional<std::pair<Turn<D>, Error>> first;
  attempt([&] {
    for (const auto& tile : tiles_) {
      auto fault = tile->border().first_fault();
      if (fault && (!first || fault->first < first->first)) first = std::move(fault);
    }
  });
  require_none(peers_, first, std::exchange(failure_, nullptr));
}

// What one mesher for all would have refused.
template <int D>
void TiledMesher<D>::require_all() {
  require_no_fault();
  if (options_.max_vertices == 0) return;
  std::uint64_t all = vertices();
  peers_.sum({&all, 1});
  if (all <= options_.max_vertices) return;
  attempt([&] {
    if (!tiles_.empty()) throw tiles_.front()->world().too_many();
  });
  agree();
}

// --- Runs ------------------------------------------------------------------------------------

template <int D>
void TiledMesher<D>::first_run(const Edits& edits, const Ask& ask, const Common& common) {
  attempt([&] { watch(ask); });
  auto mark = std::chrono::steady_clock::now();
  const auto begin = [&](Phase phase) {
    phase_ = phase;
    calls_ = 0;
  };
  const auto end = [&] {
    const auto now = std::chrono::steady_clock::now();
    seconds_[static_cast<std::size_t>(phase_)] = std::chrono::duration<double>(now - mark).count();
    mark = now;
  };
  const auto run_all = [&](std::uint64_t calls, auto&& part) {
    attempt([&] {
      for_each_tile(calls, [&](std::size_t t) {
        part(*tiles_[t], t);
        out_[t] = tiles_[t]->collect(nullptr);
      });
    });
    settle(nullptr);
    require_all();
  };
  constexpr std::uint64_t kMany = ~std::uint64_t{0};
  begin(Phase::quadtree);
  run_all(kMany, [&](TileMesher<D>& tile, std::size_t t) {
    if (common) tile.edit_common(common);
    tile.edit(edits[t]);
    tile.run_quadtree();
  });
  end();
  begin(Phase::steiner);
  attempt([&] { for_each_tile(kMany, [&](std::size_t t) { tiles_[t]->begin_questions(); }); });
  const auto least = [&](auto&& of_tile) {
    std::uint64_t least = ~std::uint64_t{0};  // of no tile
    for (const auto& tile : tiles_) least = std::min<std::uint64_t>(least, of_tile(*tile));
    return static_cast<int>(least_of(least));
  };
  const int parts = least([](const TileMesher<D>& tile) { return tile.parts(); });
  for (int done = 0; done < parts;) {  // those in which nothing waits run with the next one
    const int first = done;
    done = std::min(least([&](const TileMesher<D>& tile) { return tile.next_part(first); }) + 1,
                    parts);
    ++exchanges_.horizons;
    std::uint64_t calls = 0;
    for (const auto& tile : tiles_) calls += tile->waiting_in(done - 1);
    run_all(calls, [&](TileMesher<D>& tile, std::size_t) {
      for (int part = first; part < done; ++part) tile.run_part(part);
    });
  }
  end();
  begin(Phase::triangulate);
  run_all(kMany, [&](TileMesher<D>& tile, std::size_t) { tile.run_stars(); });
  end();
  for (const auto& tile : tiles_) tile->bound_looks(std::nullopt);
  unwatch();
}

template <int D>
void TiledMesher<D>::bound_looks(const LookBound& bound) noexcept {
  SAC_EXPECTS(peers_.is_alone());
  if (tiles_.size() == 1) return;
  for (const auto& tile : tiles_) tile->bound_looks(bound);
}

template <int D>
void TiledMesher<D>::require_sound() const {
  if (broken_) throw sac::UsageError("an update failed, and could not be taken back");
}

template <int D>
void TiledMesher<D>::edit_all(const Edits& edits, const Common& common) {
  is_exact_ = false;
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    if (common) tiles_[t]->edit_common(common);
    tiles_[t]->edit(edits[t]);
  }
  is_exact_ = true;
}

template <int D>
void TiledMesher<D>::commit_lines() noexcept {
  for (const auto& tile : tiles_) tile->commit_lines();
}

template <int D>
void TiledMesher<D>::update(const Edits& edits, const Ask& ask,
                            const std::function<void(Changes&)>& last, const Common& common) {
  require_sound();
  phase_ = Phase::update;
  bound_calls();
  attempt([&] { watch(ask); });
  agree();
  is_exact_ = false;
  Changes changes;
  try {
    attempt([&] { edit_all(edits, common); });
    settle(&changes);
    require_all();
    last(changes);
  } catch (...) {
    broken_ = is_edited_ = true;
    failure_ = nullptr;
    throw;
  }
  commit_lines();
  unwatch();
}

// The edits have been made, or wait to be. What is told of the mesh is forgotten: at the end it is
// as it was.
template <int D>
void TiledMesher<D>::take_back(const Edits& edits, const Common& common) noexcept {
  gives_up_ = false;
  if (!std::exchange(is_edited_, false)) return;
  if (least_of(is_exact_ ? 1 : 0) == 0) return;
  unwatch();
  calls_ = 0;
  attempt([&] {
    is_exact_ = false;
    Edits inverse(edits.size());
    for (std::size_t t = 0; t < tiles_.size(); ++t) {
      for (auto it = edits[t].rbegin(); it != edits[t].rend(); ++it) {
        inverse[t].push_back(it->inverse());
      }
    }
    edit_all(inverse, common ? std::make_shared<CommonOrders<D>>(common->inverse()) : nullptr);
  });
  try {
    settle(nullptr);
    commit_lines();
    broken_ = false;
  } catch (...) {  // it stays broken
  }
}

// --- Reading ---------------------------------------------------------------------------------

template <int D>
std::size_t TiledMesher<D>::vertices() const noexcept {
  std::size_t all = 0;
  for (const auto& tile : tiles_) all += tile->own_vertices();
  return all;
}

template <int D>
std::uint64_t TiledMesher<D>::calls() const noexcept {
  std::uint64_t all = 0;
  for (const auto& tile : tiles_) all += tile->counts().run + tile->counts().again;
  return all;
}

// What a tile has of the mesh. Vertices are numbered by tile, in the order of handles.
template <int D>
struct TiledMesher<D>::Part {
  std::vector<Point<D>> places;
  std::vector<VertexKind> kinds;
  std::vector<std::uint32_t> number;  // of its own vertices, by handle
  std::vector<std::array<std::uint32_t, D + 1>> simplices;
  std::uint32_t first = 0;  // the number of its first vertex
};

// Vertices of other processes, numbered behind all of this one as they are met; for all threads.
template <int D>
struct TiledMesher<D>::Others {
  std::uint32_t first;
  std::mutex mutex{};
  std::map<Point<D>, std::uint32_t> numbers{};
  std::vector<Point<D>> places{};
  std::vector<VertexKind> kinds{};

  std::uint32_t number_of(const TileMesher<D>& tile, const Vertex<D>& v) {
    const std::scoped_lock lock(mutex);
    const auto [it, is_new] =
        numbers.try_emplace(v.p, first + static_cast<std::uint32_t>(places.size()));
    if (is_new) {
      places.push_back(v.p);
      kinds.push_back(tile.has_heard_of_input(v) ? VertexKind::input : v.kind());
    }
    return it->second;
  }
};

template <int D>
void TiledMesher<D>::number_vertices(std::size_t t, Part& part) const {
  const auto& pool = tiles_[t]->world().vertices.pool();
  part.number.assign(pool.end_of_handles(), kUnnumbered);
  part.places.reserve(tiles_[t]->own_vertices());
  part.kinds.reserve(tiles_[t]->own_vertices());
  pool.for_each([&](const Vertex<D>& v) {
    if (!v.alive || !all_.owns(first_ + t, v.p)) return;
    part.number[v.self] = static_cast<std::uint32_t>(part.places.size());
    part.places.push_back(v.p);
    part.kinds.push_back(v.kind());
  });
}

// Requires: the numbers of all tiles' own vertices, which stay as they are.
template <int D>
void TiledMesher<D>::list_simplices(std::size_t t, std::vector<Part>& parts, Others& others) const {
  const auto& vertices = tiles_[t]->world().vertices;
  const auto& pool = vertices.pool();
  Part& part = parts[t];
  std::vector<std::uint32_t> foreign(part.number.size(), kUnnumbered);
  const auto number_in = [&](std::size_t tile, const Point<D>& p) {
    const VertexHandle there = tiles_[tile]->world().vertices.tree().find(p)->self;
    return parts[tile].first + parts[tile].number[there];
  };
  const auto number_of = [&](VertexHandle h) {
    if (part.number[h] != kUnnumbered) return part.first + part.number[h];
    if (foreign[h] == kUnnumbered) {
      const auto owner = own_tile(pool[h].p);
      foreign[h] = owner ? number_in(*owner, pool[h].p) : others.number_of(*tiles_[t], pool[h]);
    }
    return foreign[h];
  };
  tiles_[t]->for_each_own([&](const auto& simplex) {
    auto& corners = part.simplices.emplace_back();
    for (std::size_t k = 0; k < simplex.size(); ++k) corners[k] = number_of(simplex[k]);
  });
}

template <int D>
Mesh<D> TiledMesher<D>::mesh(const LineOf& line_of) const {
  require_sound();
  std::vector<Part> parts(tiles_.size());
  on_threads(tiles_.size(), [&](std::size_t t) { number_vertices(t, parts[t]); });
  std::vector<Point<D>> places;
  std::vector<VertexKind> kinds;
  places.reserve(vertices());
  kinds.reserve(vertices());
  for (Part& part : parts) {
    part.first = static_cast<std::uint32_t>(places.size());
    places.insert(places.end(), part.places.begin(), part.places.end());
    kinds.insert(kinds.end(), part.kinds.begin(), part.kinds.end());
  }
  Others others{static_cast<std::uint32_t>(places.size())};
  on_threads(tiles_.size(), [&](std::size_t t) { list_simplices(t, parts, others); });
  OnFeatures on;
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    const auto& tree = tiles_[t]->world().vertices.tree();
    const auto number_of = [&](const Point<D>& p) {
      const auto owner = own_tile(p);
      if (!owner) return others.number_of(*tiles_[t], *tree.find(p));
      const VertexHandle there = tiles_[*owner]->world().vertices.tree().find(p)->self;
      return parts[*owner].first + parts[*owner].number[there];
    };
    tiles_[t]->for_each_own_leaf([&](const Piece& piece, const Point<D>& lo, const Point<D>& hi) {
      on.edges.push_back({number_of(lo), number_of(hi), line_of(piece.segment)});
    });
  }
  places.insert(places.end(), others.places.begin(), others.places.end());
  kinds.insert(kinds.end(), others.kinds.begin(), others.kinds.end());
  return canonical<D>(places, kinds, 0, on, [&](auto&& visit) {
    for (const Part& part : parts)
      std::for_each(part.simplices.begin(), part.simplices.end(), visit);
  });
}

// What each has said, and heard, is looked up once.
template <int D>
std::string TiledMesher<D>::certificate_fault() const {
  std::vector<std::vector<KnownOf>> said, heard;
  for (const auto& tile : tiles_) said.push_back(tile->said()), heard.push_back(tile->heard());
  for (std::size_t a = 0; a < tiles_.size(); ++a) {
    for (std::size_t b = 0; b < tiles_.size(); ++b) {
      if (a == b) continue;
      const std::size_t from = first_ + a, to = first_ + b;
      std::string fault = difference(said[a][to], heard[b][from], from, to);
      if (fault.empty()) fault = tiles_[b]->answers_fault(from);
      if (!fault.empty()) return fault;
    }
  }
  return {};
}

// What the tiles of this process have said to those of others.
template <int D>
void TiledMesher<D>::pack_said(std::vector<Packer>& to) const {
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    const std::vector<KnownOf> said = tiles_[t]->said();
    for (std::size_t other = 0; other < said.size(); ++other) {
      if (own_index(other)) continue;
      Packer& bytes = to[process_of_[other]];
      bytes.put(std::uint64_t{first_ + t}), bytes.put(std::uint64_t{other}), bytes.put(said[other]);
    }
  }
}

// And what others' tiles have said, beside what those of this process have heard.
template <int D>
std::string TiledMesher<D>::fault_of_heard(const std::vector<Bytes>& said) const {
  std::vector<std::vector<KnownOf>> heard;
  for (const auto& tile : tiles_) heard.push_back(tile->heard());
  std::size_t pairs = 0;
  for (const Bytes& some : said) {
    for (Unpacker rest(some); !rest.is_empty(); ++pairs) {
      const auto from = static_cast<std::size_t>(rest.take<std::uint64_t>());
      const auto to = static_cast<std::size_t>(rest.take<std::uint64_t>());
      const std::size_t own = *own_index(to);
      std::string fault = difference(rest.take<KnownOf>(), heard[own][from], from, to);
      if (fault.empty()) fault = tiles_[own]->answers_fault(from);
      if (!fault.empty()) return fault;
    }
  }
  SAC_ENSURES(pairs == tiles_.size() * (all_.size() - tiles_.size()));
  return {};
}

template <int D>
std::string TiledMesher<D>::certificate() const {
  std::string fault;
  std::vector<Packer> said(peers_.size());
  Peers::Views views(peers_.size());
  together(peers_, [&] {
    fault = certificate_fault();
    pack_said(said);
    for (std::size_t k = 0; k < said.size(); ++k) views[k] = said[k].bytes();
  });
  const std::vector<Bytes> came = peers_.exchange(views);
  Packer mine;
  together(peers_, [&] {
    if (fault.empty()) fault = fault_of_heard(came);
    mine.put_all(std::string_view(fault));
  });
  const std::vector<Bytes> all = peers_.gather(mine.bytes());
  together(peers_, [&] {
    fault.clear();
    for (const Bytes& one : all) {
      if (fault.empty()) fault = Unpacker(one).take_text();
    }
  });
  return fault;
}

template <int D>
void TiledMesher<D>::check_invariants() const {
  SAC_INVARIANT(!broken_);
  for (const auto& tile : tiles_) tile->check_invariants();
  SAC_INVARIANT(certificate_fault().empty());
}

template class TiledMesher<2>;
#ifndef MESHER_PLANE_ONLY
template class TiledMesher<3>;
#endif

}  // namespace mesher::detail
