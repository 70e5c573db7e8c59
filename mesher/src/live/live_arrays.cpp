// Planning a change of the arrays, keeping it, and the mesh that they hold.
#include "live/live_arrays.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "mesh/adjacency.hpp"
#include "mesh/canonical.hpp"

namespace mesher::detail {
namespace {

template <std::size_t N>
std::array<Slot, N - 1> side_of(const std::array<Slot, N>& simplex, std::size_t side) {
  std::array<Slot, N - 1> corners;
  std::size_t n = 0;
  for (std::size_t i = 0; i < N; ++i) {
    if (i != side) corners[n++] = simplex[i];
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

template <std::size_t N>
std::uint32_t index_of(const std::array<Slot, N>& all, Slot s) {
  return static_cast<std::uint32_t>(std::find(all.begin(), all.end(), s) - all.begin());
}

}  // namespace

// --- Planning --------------------------------------------------------------------------------

template <int D>
class LiveArrays<D>::Planner {
 public:
  Planner(LiveArrays& arrays, const Change<D>& change)
      : a_(arrays), change_(change), plan_(arrays.plan_) {}

  void run() {
    plan_vertices();
    plan_simplices();
    plan_edges();
    plan_faces();
    make_room(a_.kinds_, a_.vertices_.planned_slots());
    make_room(a_.simplex_at_, a_.vertices_.planned_slots());
    make_room(a_.neighbours_, a_.simplices_.planned_slots());
  }

 private:
  void plan_vertices() {
    SAC_EXPECTS(change_.kinds_added.size() == change_.vertices_added.size());
    for (const Point<D>& p : change_.vertices_removed) {
      plan_.vertices_removed.push_back(known(a_.vertices_.find(p)));
    }
    for (const auto& k : change_.kinds_changed) {
      plan_.kinds_changed.push_back({known(a_.vertices_.find(k.vertex)), k.before, k.after});
    }
    a_.kinds_come_ = change_.kinds_added;
    a_.first_ = a_.vertices_.records().empty();
    a_.vertices_.plan(change_.vertices_added, plan_.vertices_removed);
    plan_.vertices_added = a_.vertices_.chosen();
    if (a_.first_) a_.vertices_.keep();  // so that they are found soon; drop() forgets all
  }

  void plan_simplices() {
    for (const auto& corners : change_.simplices_removed) {
      plan_.simplices_removed.push_back(known(a_.find_simplex(corners)));
    }
    std::vector<Simplex> come;
    come.reserve(change_.simplices_added.size());
    for (const auto& corners : change_.simplices_added) come.push_back(slots_of(corners));
    if (a_.first_) {
      a_.neighbours_ = adjacency(come, {}).neighbours;
    } else {
      find_links(come);
    }
    a_.simplices_.plan(std::move(come), plan_.simplices_removed);
    plan_.simplices_added = a_.simplices_.chosen();
    name_links();
  }

  // What comes is called by its number until it has a slot.
  void find_links(const std::vector<Simplex>& come) {
    leave_ = plan_.simplices_removed;
    std::sort(leave_.begin(), leave_.end());
    std::vector<OpenSide> sides;
    sides.reserve((come.size() + leave_.size()) * (D + 1));
    for (std::size_t k = 0; k < come.size(); ++k) {
      for (std::uint32_t i = 0; i <= D; ++i) {
        sides.push_back({side_of(come[k], i), static_cast<Slot>(k), i, true});
      }
    }
    for (const Slot s : leave_) list_sides_beside(s, sides);
    std::sort(sides.begin(), sides.end(),
              [](const OpenSide& a, const OpenSide& b) { return a.corners < b.corners; });
    for (std::size_t i = 0; i < sides.size();) {
      const bool paired = i + 1 < sides.size() && sides[i].corners == sides[i + 1].corners;
      if (paired) {
        links_.push_back({sides[i], sides[i + 1]});
        SAC_EXPECTS(i + 2 == sides.size() || sides[i + 2].corners != sides[i].corners);
      } else {
        links_.push_back({sides[i], {}});
      }
      i += paired ? 2 : 1;
    }
  }

  void list_sides_beside(Slot s, std::vector<OpenSide>& sides) const {
    for (const Slot n : a_.neighbours_[s]) {
      if (n == kNoSlot || std::binary_search(leave_.begin(), leave_.end(), n)) continue;
      const std::uint32_t i = index_of(a_.neighbours_[n], s);
      sides.push_back({side_of(a_.simplices_[n], i), n, i, false});
    }
  }

  void name_links() {
    a_.links_.reserve(2 * links_.size());
    const auto name = [&](const OpenSide& s) {
      return s.comes ? plan_.simplices_added[s.simplex] : s.simplex;
    };
    for (const auto& [a, b] : links_) {
      a_.links_.push_back({name(a), a.side, name(b)});
      if (b.simplex != kNoSlot) a_.links_.push_back({name(b), b.side, name(a)});
    }
  }

  void plan_edges() {
    for (const auto& e : change_.edges_removed) {
      plan_.edges_removed.push_back(known(a_.edges_.find(slots_of(e))));
    }
    std::vector<Edge> come;
    come.reserve(change_.edges_added.size());
    for (const auto& e : change_.edges_added) come.push_back(slots_of(e));
    a_.edges_.plan(std::move(come), plan_.edges_removed);
    plan_.edges_added = a_.edges_.chosen();
  }
  void plan_faces() {
    for (const auto& f : change_.faces_removed) {
      plan_.faces_removed.push_back(known(a_.faces_.find(slots_of(f))));
    }
    std::vector<Face> come;
    come.reserve(change_.faces_added.size());
    for (const auto& f : change_.faces_added) come.push_back(slots_of(f));
    a_.faces_.plan(std::move(come), plan_.faces_removed);
    plan_.faces_added = a_.faces_.chosen();
  }

  static Slot known(Slot s) {
    SAC_EXPECTS(s != kNoSlot);
    return s;
  }
  // Of the mesh before or after.
  [[nodiscard]] Slot slot_of(const Point<D>& p) const {
    const Slot s = a_.vertices_.find(p);
    if (s != kNoSlot) return s;
    const auto& come = change_.vertices_added;
    const auto it = std::lower_bound(come.begin(), come.end(), p);
    SAC_EXPECTS(it != come.end() && *it == p);
    return plan_.vertices_added[static_cast<std::size_t>(it - come.begin())];
  }
  template <std::size_t N>
  [[nodiscard]] std::array<Slot, N> slots_of(const std::array<Point<D>, N>& corners) const {
    std::array<Slot, N> slots;
    for (std::size_t i = 0; i < N; ++i) slots[i] = slot_of(corners[i]);
    return slots;
  }
  [[nodiscard]] Edge slots_of(const mesher::LineEdge<D>& e) const {
    return {slot_of(e.low), slot_of(e.high), e.feature};
  }
  [[nodiscard]] Face slots_of(const mesher::PolygonFace<D>& f) const {
    return {slots_of(f.corners), f.polygon};
  }

  LiveArrays& a_;
  const Change<D>& change_;
  SlotChange& plan_;
  std::vector<Slot> leave_;  // simplices, ascending
  std::vector<std::pair<OpenSide, OpenSide>> links_;
};

template <int D>
SlotChange LiveArrays<D>::plan(const Change<D>& change) {
  try {
    Planner(*this, change).run();
    return plan_;
  } catch (...) {
    drop();
    throw;
  }
}

template <int D>
void LiveArrays<D>::keep() noexcept {
  vertices_.keep();
  simplices_.keep();
  edges_.keep();
  faces_.keep();
  kinds_.resize(vertices_.records().size());
  simplex_at_.resize(vertices_.records().size(), kNoSlot);
  neighbours_.resize(simplices_.records().size());
  for (const auto& k : plan_.kinds_changed) kinds_[k.vertex] = k.after;
  for (const Slot v : plan_.vertices_removed) simplex_at_[v] = kNoSlot;
  for (std::size_t i = 0; i < kinds_come_.size(); ++i) {
    kinds_[plan_.vertices_added[i]] = kinds_come_[i];
  }
  for (const Slot s : plan_.simplices_added) {
    for (const Slot v : simplices_[s]) simplex_at_[v] = s;
  }
  for (const Link& link : links_) neighbours_[link.simplex][link.side] = link.neighbour;
  forget_plan();
}

template <int D>
void LiveArrays<D>::drop() noexcept {
  if (first_) {
    *this = LiveArrays();
    return;
  }
  vertices_.drop();
  simplices_.drop();
  edges_.drop();
  faces_.drop();
  forget_plan();
}

// Memory that was much is given back.
template <int D>
void LiveArrays<D>::forget_plan() noexcept {
  plan_ = SlotChange();
  std::vector<VertexKind>().swap(kinds_come_);
  std::vector<Link>().swap(links_);
  first_ = false;
}

// --- Reading ---------------------------------------------------------------------------------

template <int D>
LiveArrays<D>::LiveArrays(const Mesh<D>& mesh) {
  vertices_.plan(mesh.vertices, {});
  simplices_.plan(mesh.simplices, {});
  edges_.plan(mesh.edges, {});
  faces_.plan(mesh.faces, {});
  plan_.vertices_added = vertices_.chosen();
  plan_.simplices_added = simplices_.chosen();
  kinds_come_ = mesh.kinds;
  neighbours_ = adjacency(mesh.simplices, {}).neighbours;
  kinds_.reserve(mesh.vertices.size());
  simplex_at_.reserve(mesh.vertices.size());
  keep();
}

template <int D>
Slot LiveArrays<D>::find_simplex(const Corners& corners) const noexcept {
  Simplex slots;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    slots[i] = vertices_.find(corners[i]);
    if (slots[i] == kNoSlot) return kNoSlot;
  }
  return simplices_.find(slots);
}

namespace {

// The live slots, ascending.
template <class Table>
std::vector<Slot> live_slots(const Table& table) {
  std::vector<Slot> all;
  all.reserve(table.size());
  for (Slot s = 0; s < table.records().size(); ++s) {
    if (table.is_live(s)) all.push_back(s);
  }
  return all;
}

// Simplices ascending, with their slots: counted by first corners, then each corner's few sorted.
template <class Simplex>
void sort_simplices(std::vector<std::pair<Simplex, Slot>>& all, std::size_t corners) {
  std::vector<std::uint32_t> next(corners + 1, 0);
  for (const auto& [simplex, slot] : all) ++next[simplex[0] + std::size_t{1}];
  std::inclusive_scan(next.begin(), next.end(), next.begin());
  std::vector<std::pair<Simplex, Slot>> sorted(all.size());
  for (const auto& item : all) sorted[next[item.first[0]]++] = item;
  for (std::size_t begin = 0; begin < sorted.size();) {
    const std::size_t end = next[sorted[begin].first[0]];
    std::sort(sorted.data() + begin, sorted.data() + end);
    begin = end;
  }
  all.swap(sorted);
}

}  // namespace

// In canonical order numbers ascend as places do, so that first corners stay first.
template <int D>
auto LiveArrays<D>::compact() const -> typename LiveMesh<D>::Compact {
  const std::vector<Slot> live = live_slots(vertices_);
  std::vector<Point<D>> places;
  std::vector<VertexKind> kinds;
  places.reserve(live.size());
  kinds.reserve(live.size());
  for (const Slot s : live) places.push_back(vertices_[s]), kinds.push_back(kinds_[s]);
  typename LiveMesh<D>::Compact all;
  std::vector<std::uint32_t> order;  // by place among the live
  all.mesh = sorted_vertices<D>(places, kinds, 0, order);
  std::vector<std::uint32_t> number(vertices_.records().size(), kNoSlot);  // by slot
  all.vertices.resize(live.size());
  for (std::size_t i = 0; i < live.size(); ++i) {
    number[live[i]] = order[i];
    all.vertices[order[i]] = live[i];
  }
  std::vector<std::pair<Simplex, Slot>> simplices;
  simplices.reserve(simplices_.size());
  for (const Slot s : live_slots(simplices_)) {
    Simplex t = simplices_[s];
    for (Slot& corner : t) corner = number[corner];
    simplices.emplace_back(t, s);
  }
  sort_simplices(simplices, live.size());
  all.mesh.simplices.reserve(simplices.size());
  all.simplices.reserve(simplices.size());
  for (const auto& [t, s] : simplices) {
    all.mesh.simplices.push_back(t);
    all.simplices.push_back(s);
  }
  for (const Slot s : live_slots(edges_)) {
    Edge& e = all.mesh.edges.emplace_back(edges_[s]);
    e.low = number[e.low];
    e.high = number[e.high];
  }
  for (const Slot s : live_slots(faces_)) {
    Face& f = all.mesh.faces.emplace_back(faces_[s]);
    for (Slot& corner : f.corners) corner = number[corner];
  }
  std::sort(all.mesh.edges.begin(), all.mesh.edges.end());
  std::sort(all.mesh.faces.begin(), all.mesh.faces.end());
  return all;
}

template <int D>
std::size_t LiveArrays<D>::bytes() const noexcept {
  return vertices_.bytes() + simplices_.bytes() + edges_.bytes() + faces_.bytes() +
         kinds_.capacity() * sizeof(VertexKind) + simplex_at_.capacity() * sizeof(Slot) +
         neighbours_.capacity() * sizeof(Simplex);
}

template <int D>
void LiveArrays<D>::check_invariants() const {
  vertices_.check_invariants();
  simplices_.check_invariants();
  edges_.check_invariants();
  faces_.check_invariants();
  SAC_INVARIANT(kinds_.size() == vertices_.records().size());
  SAC_INVARIANT(simplex_at_.size() == vertices_.records().size());
  SAC_INVARIANT(neighbours_.size() == simplices_.records().size());
  for (Slot v = 0; v < simplex_at_.size(); ++v) {
    const Slot s = simplex_at_[v];
    SAC_INVARIANT((s != kNoSlot) == vertices_.is_live(v));
    if (s == kNoSlot) continue;
    SAC_INVARIANT(simplices_.is_live(s));
    SAC_INVARIANT(index_of(simplices_[s], v) <= D);
  }
  const auto all = compact();
  const auto expected = adjacency(all.mesh.simplices, {}).neighbours;
  for (std::size_t t = 0; t < expected.size(); ++t) {
    for (std::size_t i = 0; i <= D; ++i) {
      const std::uint32_t n = expected[t][i];
      const Slot slot = n == kNoSlot ? kNoSlot : all.simplices[n];
      SAC_INVARIANT(neighbours_[all.simplices[t]][i] == slot);
    }
  }
}

template class LiveArrays<2>;
#ifndef MESHER_PLANE_ONLY
template class LiveArrays<3>;
#endif

}  // namespace mesher::detail
