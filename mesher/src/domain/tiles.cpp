// Changes of a triangulation: what goes is cut out, what comes is sewn in along the rim.
#include "domain/tiles.hpp"

#include <algorithm>
#include <iterator>

#include "mesh/canonical.hpp"
#include "sac/check.hpp"
#include "sets/make_set.hpp"
#include "sets/union_find.hpp"

namespace mesher::detail {
namespace {

template <std::size_t N>
std::array<std::uint32_t, N> sorted(std::array<std::uint32_t, N> side) {
  std::sort(side.begin(), side.end());
  return side;
}

// The corners of a side, as they are in its simplex.
template <std::size_t N>
std::array<std::uint32_t, N - 1> corners_across(const std::array<std::uint32_t, N>& t, int side) {
  std::array<std::uint32_t, N - 1> corners;
  std::size_t n = 0;
  for (std::size_t i = 0; i < N; ++i) {
    if (i != static_cast<std::size_t>(side)) corners[n++] = t[i];
  }
  return corners;
}

template <std::size_t N>
std::array<std::uint32_t, N - 1> ends_of(const std::array<std::uint32_t, N>& t, int side) {
  return sorted(corners_across(t, side));
}

// Which of the two ways around a side has, seen from its simplex: not that seen from the other.
template <std::size_t N>
bool way_around(const std::array<std::uint32_t, N>& t, int side) {
  const auto corners = corners_across(t, side);
  bool way = side % 2 != 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t k = i + 1; k < corners.size(); ++k) way ^= corners[k] < corners[i];
  }
  return way;
}

// The edges of `a` that are not in `b`, ascending.
template <class Edge>
std::vector<Edge> difference(std::span<const Edge> a, std::span<const Edge> b) {
  const auto ascending = [](std::span<const Edge> edges) {
    std::vector<Edge> all;
    for (const Edge& e : edges) all.push_back(sorted(e));
    std::sort(all.begin(), all.end());
    return all;
  };
  const auto left = ascending(a), right = ascending(b);
  std::vector<Edge> only;
  std::set_difference(left.begin(), left.end(), right.begin(), right.end(),
                      std::back_inserter(only));
  SAC_EXPECTS(std::adjacent_find(only.begin(), only.end()) == only.end());
  return only;
}

}  // namespace

// --- Reading ---------------------------------------------------------------------------------

template <int D>
TilesOf<D>::TilesOf(const std::vector<Corners>& triangles, const std::vector<Wall>& walls) {
  std::vector<Wall> ascending;
  for (const Wall& wall : walls) ascending.push_back(sorted(wall));
  const AdjacencyOf<D> all = adjacency(triangles, ascending);
  tiles_.reserve(triangles.size());
  std::uint32_t vertices = 0;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    Tile tile;
    tile.corners = triangles[t];
    tile.neighbours = all.neighbours[t];
    tile.walls = all.walls[t] & Tile::kAllWalls;
    tiles_.add(tile);
    for (const std::uint32_t v : tile.corners) vertices = std::max(vertices, v + 1);
  }
  at_vertex_.reserve(vertices);
  for (std::uint32_t v = 0; v < vertices; ++v) at_vertex_.add(kNone);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (const std::uint32_t v : triangles[t]) at_vertex_.edit(v) = t;
  }
  heads_.add({kNone, static_cast<std::uint32_t>(triangles.size())});
}

template <int D>
Slot TilesOf<D>::find(const Corners& t) const {
  Slot found = kNone;
  for_each_around(t[0], [&](Slot s) {
    if (smallest_first(tiles_[s].corners) == smallest_first(t)) found = s;
    return found == kNone;
  });
  return found;
}

template <int D>
TileSide TilesOf<D>::side_on(const Wall& ends) const {
  TileSide found;
  for_each_around(ends[0], [&](Slot s) {
    const Tile& t = tiles_[s];
    if (!std::all_of(ends.begin(), ends.end(), [&](std::uint32_t v) { return t.has(v); })) {
      return true;
    }
    found.slot = s;
    while (ends_of(t.corners, found.side) != sorted(ends)) ++found.side;
    return false;
  });
  return found;
}

template <int D>
void TilesOf<D>::keep() noexcept {
  tiles_.keep();
  at_vertex_.keep();
  heads_.keep();
}

template <int D>
void TilesOf<D>::take_back() noexcept {
  tiles_.take_back();
  at_vertex_.take_back();
  heads_.take_back();
}

template <int D>
void TilesOf<D>::check_invariants() const {
  std::uint32_t live = 0, free = 0;
  for (Slot s = 0; s < slots(); ++s) {
    const Tile& t = tiles_[s];
    if (t.is_free()) continue;
    ++live;
    for (int i = 0; i <= D; ++i) {
      SAC_INVARIANT(at_vertex(t.corners[static_cast<std::size_t>(i)]) != kNone);
      const Slot n = t.neighbours[static_cast<std::size_t>(i)];
      if (n == kNone) continue;
      const Tile& other = tiles_[n];
      const int back = other.side_to(s);
      SAC_INVARIANT(!other.is_free() && other.neighbours[static_cast<std::size_t>(back)] == s);
      SAC_INVARIANT(ends_of(other.corners, back) == ends_of(t.corners, i));
      SAC_INVARIANT(other.is_wall(back) == t.is_wall(i));
    }
  }
  for (Slot s = heads_[0].free; s != kNone; s = tiles_[s].neighbours[0]) {
    SAC_INVARIANT(tiles_[s].is_free());
    ++free;
  }
  SAC_INVARIANT(live == heads_[0].live && live + free == slots());
  for (std::uint32_t v = 0; v < at_vertex_.size(); ++v) {
    const Slot s = at_vertex_[v];
    SAC_INVARIANT(s == kNone || tiles_[s].has(v));
  }
}

// --- Changing --------------------------------------------------------------------------------

template <int D>
class TilesOf<D>::Changer {
 public:
  explicit Changer(TilesOf& tiles) : t_(tiles) {}

  Seams run(std::span<const Corners> out, std::span<const Corners> in, std::span<const Wall> lost,
            std::span<const Wall> gained) {
    find_all(out);
    find_cuts();
    take_out();
    put_in(in);
    sew();
    open(difference<Wall>(lost, gained));
    close(difference<Wall>(gained, lost));
    make_set(seams_.frontier);
    make_set(seams_.bonds);
    return std::move(seams_);
  }

 private:
  [[nodiscard]] bool goes(Slot s) const { return std::binary_search(out_.begin(), out_.end(), s); }
  [[nodiscard]] std::uint32_t index_of(Slot s) const {
    return static_cast<std::uint32_t>(std::lower_bound(out_.begin(), out_.end(), s) - out_.begin());
  }

  void find_all(std::span<const Corners> out) {
    for (const Corners& corners : out) {
      out_.push_back(t_.find(corners));
      SAC_EXPECTS(out_.back() != kNone);
    }
    std::sort(out_.begin(), out_.end());
    SAC_EXPECTS(std::adjacent_find(out_.begin(), out_.end()) == out_.end());
    for (const Slot s : out_) seams_.removed.push_back(t_[s]);
    cuts_ = static_cast<std::uint32_t>(out_.size());
  }

  // Survivors around connected triangles that go have one cut; walls between those are kept apart.
  void find_cuts() {
    UnionFind sets(out_.size());
    for (std::uint32_t k = 0; k < out_.size(); ++k) {
      for (int i = 0; i <= D; ++i) {
        const Slot n = seams_.removed[k].open_neighbour(i);
        if (n != kNone && goes(n)) sets.unite(k, index_of(n));
      }
    }
    for (std::uint32_t k = 0; k < out_.size(); ++k) {
      for (int i = 0; i <= D; ++i) add_rim(k, i, sets.find(k));
    }
    make_set(loose_);
  }

  void add_rim(std::uint32_t k, int i, std::uint32_t cut) {
    const Tile& tile = seams_.removed[k];
    const Slot n = tile.neighbours[static_cast<std::size_t>(i)];
    const bool wall = tile.is_wall(i);
    if (n == kNone || goes(n)) {
      if (wall) loose_.push_back(ends_of(tile.corners, i));
      return;
    }
    seams_.frontier.push_back(n);
    sides_.push_back({ends_of(tile.corners, i), n, t_[n].side_to(out_[k]), true});
    if (!wall) seams_.bonds.push_back({cut, n});
  }

  void take_out() {
    Heads heads = t_.heads_[0];
    for (std::size_t k = out_.size(); k-- > 0;) {
      const Slot s = out_[k];
      for (const std::uint32_t v : seams_.removed[k].corners) {
        if (t_.at_vertex_[v] == s) t_.at_vertex_.edit(v) = kNone;
      }
      Tile empty;
      empty.neighbours[0] = heads.free;
      t_.tiles_.edit(s) = empty;
      heads.free = s;
    }
    heads.live -= static_cast<std::uint32_t>(out_.size());
    t_.heads_.edit(0) = heads;
  }

  void put_in(std::span<const Corners> in) {
    Heads heads = t_.heads_[0];
    for (const Corners& corners : in) {
      Tile tile;
      tile.corners = corners;
      Slot s = heads.free;
      if (s == kNone) {
        s = t_.tiles_.add(tile);
      } else {
        heads.free = t_.tiles_[s].neighbours[0];
        t_.tiles_.edit(s) = tile;
      }
      seams_.added.push_back(s);
      for (const std::uint32_t v : corners) remember(v, s);
      for (int i = 0; i <= D; ++i) sides_.push_back({ends_of(corners, i), s, i, false});
    }
    heads.live += static_cast<std::uint32_t>(in.size());
    t_.heads_.edit(0) = heads;
  }

  void remember(std::uint32_t v, Slot s) {
    while (t_.at_vertex_.size() <= v) t_.at_vertex_.add(kNone);
    if (t_.at_vertex_[v] == kNone) t_.at_vertex_.edit(v) = s;
  }

  // Sides with equal ends belong together. A survivor's side knows whether it is a wall; that of
  // two which both came is a wall if it was one of `loose_`.
  void sew() {
    std::sort(sides_.begin(), sides_.end(), [](const Side& a, const Side& b) {
      return std::pair(a.ends, a.slot) < std::pair(b.ends, b.slot);
    });
    for (std::size_t i = 0; i < sides_.size();) {
      const bool pair = i + 1 < sides_.size() && sides_[i].ends == sides_[i + 1].ends;
      if (pair) {
        join(sides_[i], sides_[i + 1]);
      } else {
        leave_at_boundary(sides_[i]);
      }
      i += pair ? 2 : 1;
    }
  }

  void join(const Side& a, const Side& b) {
    SAC_EXPECTS(!(a.survivor && b.survivor));
    SAC_EXPECTS(way_around(a) != way_around(b));  // on opposite sides
    bool wall = !a.survivor && !b.survivor && was_loose(a.ends);
    for (const Side& s : {a, b}) wall = wall || (s.survivor && t_[s.slot].is_wall(s.side));
    const Slot slots[2] = {a.slot, b.slot};
    for (const Side& s : {a, b}) {
      Tile& tile = t_.tiles_.edit(s.slot);
      tile.neighbours[static_cast<std::size_t>(s.side)] = slots[s.slot == slots[0] ? 1 : 0];
      tile.walls |= wall ? 1u << s.side & Tile::kAllWalls : 0u;
    }
  }

  void leave_at_boundary(const Side& s) {
    SAC_EXPECTS(!s.survivor);
    if (was_loose(s.ends)) t_.tiles_.edit(s.slot).walls |= 1u << s.side & Tile::kAllWalls;
  }

  [[nodiscard]] bool way_around(const Side& s) const {
    return detail::way_around(t_[s.slot].corners, s.side);
  }
  bool was_loose(const Wall& ends) {
    const auto it = std::lower_bound(loose_.begin(), loose_.end(), ends);
    if (it == loose_.end() || *it != ends) return false;
    placed_.push_back(ends);
    return true;
  }

  void open(const std::vector<Wall>& lost) {
    make_set(placed_);
    std::vector<Wall> vanished;
    std::set_difference(loose_.begin(), loose_.end(), placed_.begin(), placed_.end(),
                        std::back_inserter(vanished));
    for (const Wall& e : lost) {
      seams_.toggled.push_back(e);
      if (std::binary_search(vanished.begin(), vanished.end(), e)) continue;
      toggle(e, false);
    }
    SAC_EXPECTS(std::includes(lost.begin(), lost.end(), vanished.begin(), vanished.end()));
  }
  void close(const std::vector<Wall>& gained) {
    for (const Wall& e : gained) {
      seams_.toggled.push_back(e);
      toggle(e, true);
    }
  }

  void toggle(const Wall& e, bool wall) {
    const TileSide side = t_.side_on(e);
    SAC_EXPECTS(side.slot != kNone && t_[side.slot].is_wall(side.side) != wall);
    const Slot other = t_[side.slot].neighbours[static_cast<std::size_t>(side.side)];
    const std::uint32_t cut = cuts_++;
    flip(side, wall, other == kNone, cut);
    if (other != kNone) flip({other, t_[other].side_to(side.slot)}, wall, false, cut);
  }

  void flip(const TileSide& side, bool wall, bool boundary, std::uint32_t cut) {
    t_.tiles_.edit(side.slot).walls ^= 1u << side.side & Tile::kAllWalls;
    if (came(side.slot)) return;
    seams_.frontier.push_back(side.slot);
    if (boundary) seams_.exits.push_back({side.slot, wall ? -1 : 1});
    if (wall) seams_.bonds.push_back({cut, side.slot});
  }
  [[nodiscard]] bool came(Slot s) const { return t_[s].component == kNone; }

  TilesOf& t_;
  Seams seams_;
  std::vector<Slot> out_;  // ascending, as seams_.removed
  std::uint32_t cuts_ = 0;
  std::vector<Side> sides_;   // to be sewn
  std::vector<Wall> loose_;   // walls with no survivor beside them, ascending
  std::vector<Wall> placed_;  // those of them that are edges again
};

template <int D>
auto TilesOf<D>::change(std::span<const Corners> out, std::span<const Corners> in,
                        std::span<const Wall> lost, std::span<const Wall> gained) -> Seams {
  return Changer(*this).run(out, in, lost, gained);
}

template class TilesOf<2>;
#ifndef MESHER_PLANE_ONLY
template class TilesOf<3>;
#endif

}  // namespace mesher::detail
