// Rounds, and the mesh out of the tiles.
#include "tiles/tiled_mesher.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <numeric>

#include "mesh/canonical.hpp"
#include "program/triangulate.hpp"
#include "program/world_impl.hpp"
#include "tiles/on_threads.hpp"

namespace mesher::detail {

template <int D>
TiledMesher<D>::TiledMesher(const Options<D>& options, const MeshBox<D>& box,
                            const std::vector<Point<D>>& places, std::size_t tiles,
                            std::size_t threads)
    : options_(options),
      threads_(threads),
      all_(places, tiles),
      out_(all_.size()),
      waiting_(all_.size()) {
  for (std::size_t t = 0; t < all_.size(); ++t) {
    tiles_.push_back(std::make_unique<TileMesher<D>>(options, box, all_, t));
  }
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
  stops_ = false;
  calls_ = 0;
  for (const auto& tile : tiles_) {
    tile->watch([this](std::uint64_t calls) {
      const std::uint64_t all = calls_ += calls;
      if (!ask_) return true;
      if (std::this_thread::get_id() == asker_ && !stops_ && !ask_(phase_, all)) stops_ = true;
      return !stops_;
    });
  }
}

template <int D>
void TiledMesher<D>::unwatch() noexcept {
  ask_ = nullptr;
  stops_ = false;
}

// --- Rounds ----------------------------------------------------------------------------------

template <int D>
void TiledMesher<D>::exchange() {
  is_exact_ = false;
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    for (const Message<D>& m : out_[t]) waiting_[t].add(m);
    out_[t].clear();
  }
  std::optional<typename Outbox<D>::Time> first;
  for (const auto& waiting : waiting_) {
    if (!waiting.is_empty() && (!first || waiting.first() < *first)) first = waiting.first();
  }
  if (first) {
    ++exchanges_.rounds;
    std::uint64_t messages = 0;
    for (std::size_t t = 0; t < tiles_.size(); ++t) {
      waiting_[t].send_until(*first, [&](const Message<D>& m) { out_[t].push_back(m); });
      messages += out_[t].size();
    }
    exchanges_.messages += messages;
    for_each_tile(messages / 16, [&](std::size_t t) {
      for (std::size_t from = 0; from < tiles_.size(); ++from) tiles_[t]->receive(from, out_[from]);
    });
    for (auto& out : out_) out.clear();
  }
  is_exact_ = true;
}

// Messages that wait are sent first.
template <int D>
void TiledMesher<D>::settle(Changes* changes) {
  std::vector<std::size_t> dirty;
  std::uint64_t orders = 0;
  std::vector<Changes> all(changes != nullptr ? tiles_.size() : 0);
  while (true) {
    exchange();
    dirty.clear();
    orders = 0;
    for (std::size_t t = 0; t < tiles_.size(); ++t) {
      if (!tiles_[t]->is_dirty()) continue;
      dirty.push_back(t);
      orders += tiles_[t]->orders();
    }
    if (dirty.empty()) return;
    if (stops_) throw sac::Cancelled();
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
    if (changes == nullptr) continue;
    for (const std::size_t t : dirty) {
      const auto append = [](auto& to, auto& from) {
        to.insert(to.end(), from.begin(), from.end());
        from.clear();
      };
      append(changes->vertices, all[t].vertices);
      append(changes->simplices_come, all[t].simplices_come);
      append(changes->simplices_gone, all[t].simplices_gone);
    }
  }
}

// What one mesher for all would have refused.
template <int D>
void TiledMesher<D>::require_all() const {
  std::optional<std::pair<Turn<D>, Error>> first;
  for (const auto& tile : tiles_) {
    auto fault = tile->border().first_fault();
    if (fault && (!first || fault->first < first->first)) first = std::move(fault);
  }
  if (first) throw first->second;
  if (options_.max_vertices != 0 && vertices() > options_.max_vertices) {
    throw tiles_.front()->world().too_many();
  }
}

// --- Runs ------------------------------------------------------------------------------------

template <int D>
void TiledMesher<D>::first_run(const Edits& edits, const Ask& ask) {
  watch(ask);
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
    for_each_tile(calls, [&](std::size_t t) {
      part(*tiles_[t], t);
      out_[t] = tiles_[t]->collect(nullptr);
    });
    settle(nullptr);
    require_all();
  };
  constexpr std::uint64_t kMany = ~std::uint64_t{0};
  begin(Phase::quadtree);
  run_all(kMany, [&](TileMesher<D>& tile, std::size_t t) {
    tile.edit(edits[t]);
    tile.run_quadtree();
  });
  end();
  begin(Phase::steiner);
  for_each_tile(kMany, [&](std::size_t t) { tiles_[t]->begin_questions(); });
  const auto next_part = [&](int part) {
    int next = tiles_[0]->parts();
    for (const auto& tile : tiles_) next = std::min(next, tile->next_part(part));
    return next;
  };
  const int parts = tiles_[0]->parts();
  for (int done = 0; done < parts;) {  // those in which nothing waits run with the next one
    const int first = done;
    done = std::min(next_part(first) + 1, parts);
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
  unwatch();
}

template <int D>
void TiledMesher<D>::require_sound() const {
  if (broken_) throw sac::UsageError("an update failed, and could not be taken back");
}

template <int D>
void TiledMesher<D>::update(const Edits& edits, const Ask& ask,
                            const std::function<void(Changes&)>& last) {
  require_sound();
  phase_ = Phase::update;
  watch(ask);
  is_exact_ = false;
  Changes changes;
  try {
    for (std::size_t t = 0; t < tiles_.size(); ++t) tiles_[t]->edit(edits[t]);
    is_exact_ = true;
    settle(&changes);
    require_all();
    last(changes);
  } catch (...) {
    take_back(edits);
    throw;
  }
  unwatch();
}

// The edits have been made, or wait to be. What is told of the mesh is forgotten: at the end it is
// as it was.
template <int D>
void TiledMesher<D>::take_back(const Edits& edits) noexcept {
  broken_ = true;
  if (!is_exact_) return;
  unwatch();
  try {
    for (std::size_t t = 0; t < tiles_.size(); ++t) {
      std::vector<typename TileMesher<D>::Edit> inverse;
      for (auto it = edits[t].rbegin(); it != edits[t].rend(); ++it) {
        inverse.push_back(it->inverse());
      }
      tiles_[t]->edit(inverse);
    }
    settle(nullptr);
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

template <int D>
void TiledMesher<D>::number_vertices(std::size_t t, Part& part) const {
  const auto& pool = tiles_[t]->world().vertices.pool();
  part.number.assign(pool.end_of_handles(), kUnnumbered);
  part.places.reserve(tiles_[t]->own_vertices());
  part.kinds.reserve(tiles_[t]->own_vertices());
  pool.for_each([&](const Vertex<D>& v) {
    if (!v.alive || !all_.owns(t, v.p)) return;
    part.number[v.self] = static_cast<std::uint32_t>(part.places.size());
    part.places.push_back(v.p);
    part.kinds.push_back(v.kind());
  });
}

// Requires: the numbers of all tiles' own vertices, which stay as they are.
template <int D>
void TiledMesher<D>::list_simplices(std::size_t t, std::vector<Part>& parts) const {
  const auto& vertices = tiles_[t]->world().vertices;
  const auto& pool = vertices.pool();
  Part& part = parts[t];
  std::vector<std::uint32_t> foreign(part.number.size(), kUnnumbered);
  const auto number_of = [&](VertexHandle h) {
    if (part.number[h] != kUnnumbered) return part.first + part.number[h];
    if (foreign[h] == kUnnumbered) {
      const std::size_t owner = all_.owner(pool[h].p);
      const VertexHandle there = tiles_[owner]->world().vertices.tree().find(pool[h].p)->self;
      foreign[h] = parts[owner].first + parts[owner].number[there];
    }
    return foreign[h];
  };
  pool.for_each([&](const Vertex<D>& v) {
    if (part.number[v.self] == kUnnumbered) return;
    for_each_own_simplex(pool, v, vertices.ring(v), [&](const auto& simplex) {
      auto& corners = part.simplices.emplace_back();
      for (std::size_t k = 0; k < simplex.size(); ++k) corners[k] = number_of(simplex[k]);
    });
  });
}

template <int D>
Mesh<D> TiledMesher<D>::mesh() const {
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
  on_threads(tiles_.size(), [&](std::size_t t) { list_simplices(t, parts); });
  return canonical<D>(places, kinds, 0, {}, [&](auto&& visit) {
    for (const Part& part : parts)
      std::for_each(part.simplices.begin(), part.simplices.end(), visit);
  });
}

template <int D>
std::string TiledMesher<D>::certificate_fault() const {
  for (const auto& one : tiles_) {
    for (const auto& other : tiles_) {
      if (one == other) continue;
      if (std::string fault = one->fault_with(*other); !fault.empty()) return fault;
    }
  }
  return {};
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
