// The rounds of tiles, and the mesh out of them.
#include "tiles/tiled_mesh.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>

#include "program/triangulate.hpp"
#include "program/world_impl.hpp"
#include "rules/mesh_box.hpp"

namespace mesher::detail {

template <int D>
TiledMesh<D>::TiledMesh(const Options<D>& options, std::size_t tiles, std::size_t threads)
    : options_(options),
      box_(mesh_box(options)),
      wanted_(tiles),
      threads_(threads),
      features_(box_, points_) {}

template <int D>
TiledMesh<D>::~TiledMesh() = default;

// Throws: what act() has thrown, of the first tile that it has.
template <int D>
template <class Act>
void TiledMesh<D>::for_each_tile(Act&& act) {
  std::vector<std::exception_ptr> failures(tiles_.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t t; (t = next++) < tiles_.size();) {
      try {
        act(t);
      } catch (...) {
        failures[t] = std::current_exception();
      }
    }
  };
  std::vector<std::thread> others;
  for (std::size_t i = 1; i < std::min(threads_, tiles_.size()); ++i) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

template <int D>
bool TiledMesh<D>::exchange() {
  std::size_t messages = 0;
  for (const auto& out : out_) messages += out.size();
  if (messages == 0) return false;
  ++counts_.rounds;
  if (std::getenv("TRACE_TILES") && counts_.rounds > (unsigned)std::atoi(std::getenv("TRACE_TILES"))) {
    std::printf("round %d\n", (int)counts_.rounds);
    for (std::size_t f = 0; f < out_.size(); ++f) for (auto& m : out_[f]) { const Turn& t = int(m.kind) < 2 ? m.look.turn : m.birth.turn; const auto& p = int(m.kind) < 2 ? m.look.p : m.birth.p; auto k = t.key(kKeyWidths);
      std::printf(" %zu->%u %s (%.6g %.6g) %g b %d turn %d: %d %u %u %lx\n", f, m.to, (const char*[]){"ask","end","arrive","depart"}[int(m.kind)], p[0], p[1], m.look.radius, m.birth.bucket, int(t.stage), k.bucket, k.phase, k.colour, k.order); }
  }
  counts_.messages += messages;
  for_each_tile([&](std::size_t t) {
    for (std::size_t from = 0; from < tiles_.size(); ++from) tiles_[t]->receive(from, out_[from]);
  });
  return true;
}

template <int D>
void TiledMesh<D>::settle() {
  while (exchange()) {
    for_each_tile([&](std::size_t t) {
      out_[t].clear();
    });
    for_each_tile([&](std::size_t t) {
      if (!tiles_[t]->is_dirty()) return;
      tiles_[t]->propagate();
      out_[t] = tiles_[t]->collect(nullptr);
    });
  }
}

template <int D>
VertexHandle TiledMesh<D>::add_point(const Point<D>& p) {
  Vertex<D>& v = points_.create(p);
  v.input = true;
  handles_.emplace(v.p, v.self);
  if (v.self >= levels_.size()) levels_.resize(v.self + std::size_t{1});
  return v.self;
}

template <int D>
void TiledMesh<D>::first_run(const std::vector<Point<D>>& points) {
  all_ = std::make_unique<Territories<D>>(points, wanted_);
  for (const Point<D>& p : points) features_.insert_only(points_[add_point(p)]);
  std::vector<std::vector<typename Tile<D>::Edit>> edits(all_->size());
  points_.for_each([&](Vertex<D>& v) {
    v.level = static_cast<std::int16_t>(features_.crowded_level(v));
    levels_[v.self] = v.level;
    edits[all_->owner(v.p)].push_back({v.p, std::nullopt, v.level});
  });
  tiles_.resize(all_->size());
  out_.resize(all_->size());
  for_each_tile([&](std::size_t t) {
    tiles_[t] = std::make_unique<Tile<D>>(options_, box_, *all_, t);
    tiles_[t]->edit(edits[t]);
    tiles_[t]->run_quadtree();
    out_[t] = tiles_[t]->collect(nullptr);
  });
  settle();
  const auto next_part = [&](int part) {
    int next = tiles_[0]->parts();
    for (const auto& tile : tiles_) next = std::min(next, tile->next_part(part));
    return next;
  };
  for_each_tile([&](std::size_t t) { tiles_[t]->begin_questions(); });
  const int parts = tiles_[0]->parts();
  for (int done = 0; done < parts;) {  // those in which nothing waits run with the next one
    const int first = done;
    done = std::min(next_part(first) + 1, parts);
    ++counts_.horizons;
    for_each_tile([&](std::size_t t) {
      for (int part = first; part < done; ++part) tiles_[t]->run_part(part);
      out_[t] = tiles_[t]->collect(nullptr);
    });
    settle();
  }
  for_each_tile([&](std::size_t t) {
    tiles_[t]->run_stars();
    out_[t] = tiles_[t]->collect(nullptr);
  });
  settle();
}

template <int D>
void TiledMesh<D>::update(const std::vector<Point<D>>& gone, const std::vector<Point<D>>& come) {
  std::vector<VertexHandle> changed;
  const auto note = [&](const Vertex<D>& f) { changed.push_back(f.self); };
  std::vector<std::vector<typename Tile<D>::Edit>> edits(tiles_.size());
  std::vector<VertexHandle> removed;
  for (const Point<D>& p : gone) {
    const auto it = handles_.find(p);
    features_.erase(points_[it->second], note);
    edits[all_->owner(p)].push_back({p, levels_[it->second], std::nullopt});
    removed.push_back(it->second);
    handles_.erase(it);
  }
  for (const Point<D>& p : come) {
    const VertexHandle h = add_point(p);
    features_.insert(points_[h], note);
    changed.push_back(h);
  }
  for (const VertexHandle h : removed) {
    levels_[h] = std::nullopt;
    points_.release(points_[h]);
  }
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  for (const VertexHandle h : changed) {
    const Vertex<D>& v = points_[h];
    if (v.self != h || levels_[h] == v.level) continue;
    edits[all_->owner(v.p)].push_back({v.p, levels_[h], v.level});
    levels_[h] = v.level;
  }
  for_each_tile([&](std::size_t t) {
    out_[t].clear();
    if (edits[t].empty()) return;
    tiles_[t]->edit(edits[t]);
    tiles_[t]->propagate();
    out_[t] = tiles_[t]->collect(nullptr);
  });
  settle();
}

template <int D>
Mesh<D> TiledMesh<D>::mesh() const {
  std::vector<Point<D>> places;
  std::vector<VertexKind> kinds;
  std::vector<std::vector<std::uint32_t>> number(tiles_.size());  // by tile and handle
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    const auto& pool = tiles_[t]->world().vertices.pool();
    pool.for_each([&](const Vertex<D>& v) {
      if (!v.alive || !all_->owns(t, v.p)) return;
      if (v.self >= number[t].size()) number[t].resize(v.self + std::size_t{1});
      number[t][v.self] = static_cast<std::uint32_t>(places.size());
      places.push_back(v.p);
      kinds.push_back(v.kind());
    });
  }
  std::vector<std::array<std::uint32_t, D + 1>> simplices;
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    const auto& vertices = tiles_[t]->world().vertices;
    const auto& pool = vertices.pool();
    const auto number_of = [&](VertexHandle h) {
      const Vertex<D>& v = pool[h];
      const std::size_t owner = all_->owner(v.p);
      if (owner == t) return number[t][h];
      return number[owner][tiles_[owner]->world().vertices.tree().find(v.p)->self];
    };
    pool.for_each([&](const Vertex<D>& v) {
      if (!v.alive || !all_->owns(t, v.p)) return;
      for_each_own_simplex(pool, v, vertices.ring(v), [&](const auto& simplex) {
        auto& corners = simplices.emplace_back();
        for (std::size_t k = 0; k < simplex.size(); ++k) corners[k] = number_of(simplex[k]);
      });
    });
  }
  return canonical<D>(places, kinds, 0, {}, [&](auto&& visit) {
    for (const auto& simplex : simplices) visit(simplex);
  });
}

template <int D>
void TiledMesh<D>::check_invariants() const {
  for (const auto& tile : tiles_) tile->check_invariants();
}

template class TiledMesh<2>;
#ifndef MESHER_PLANE_ONLY
template class TiledMesh<3>;
#endif

}  // namespace mesher::detail
