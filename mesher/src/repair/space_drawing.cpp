// Edges are led; sheets are taken out of the store, and put into it again.
#include "repair/space_drawing.hpp"

#include "mesher/error.hpp"

namespace mesher::detail {

Drawing<3>::Drawing(const MeshBox<3>& box, double tolerance)
    : DrawnPoints(box.lo, tolerance), box_(box), tree_(box_, pool_, scope_), store_(box_, pool_) {}

// --- Points and edges ------------------------------------------------------------------------

VertexHandle Drawing<3>::add_spot(const Point<3>& p, const Ends& on) {
  Vertex<3>& v = pool_.create(p);
  v.input = true;
  on_.push_back(on);
  const Spot s = add_place(p);
  SAC_ENSURES(v.self == s);
  tree_.tree().insert_only(v);
  return s;
}

// Of all sheets and paths, some more than once.
template <class Visit>
void Drawing<3>::visit_edges(Visit&& visit) const {
  for (const Sheet& sheet : sheets_) {
    for (const Loop& loop : sheet.parts.loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) visit(loop[i], loop[(i + 1) % loop.size()]);
    }
    for (const auto& [s, t] : sheet.parts.edges) visit(s, t);
  }
  for (const Path& path : paths_) {
    for (std::size_t i = 1; i < path.size(); ++i) visit(path[i - 1], path[i]);
  }
}

void Drawing<3>::note_drawn(VertexHandle s, VertexHandle t) {
  if (s == t) return;
  const EdgeHandle e = store_.record(s, t).self;
  if (e >= drawn_.size()) drawn_.resize(2 * std::size_t{e} + 1);
  drawn_[e] = true;
}

void Drawing<3>::start() {
  visit_edges([&](VertexHandle s, VertexHandle t) { note_drawn(s, t); });
}

void Drawing<3>::use_edges() {
  std::vector<bool> wanted(used_.size());
  visit_edges([&](VertexHandle s, VertexHandle t) {
    if (s == t) return;
    const EdgeHandle e = store_.record(s, t).self;
    if (e >= wanted.size()) wanted.resize(e + std::size_t{1});
    wanted[e] = true;
  });
  used_.resize(wanted.size());
  for (EdgeHandle h = 0; h < wanted.size(); ++h) {
    if (wanted[h] == used_[h]) continue;
    const Edge& e = store_.edges()[h];
    if (wanted[h]) {
      arrivals_.edges.push_back(h);
      store_.use(store_.record(e.a, e.b));
    } else {
      store_.leave(store_.record(e.a, e.b));
    }
    used_[h] = wanted[h];
  }
}

// --- Changes ---------------------------------------------------------------------------------

// Null if it stays as it is.
const std::vector<VertexHandle>* Drawing<3>::chain_of(VertexHandle s, VertexHandle t,
                                                      const Chains& chains) const {
  if (s == t) return nullptr;
  const Edge* e = store_.find_edge(s, t);
  const auto it = e == nullptr ? chains.end() : chains.find(e->self);
  return it == chains.end() ? nullptr : &it->second;
}

bool Drawing<3>::lead(std::vector<VertexHandle>& line, bool is_closed, const Chains& chains) const {
  std::vector<VertexHandle> led;
  bool is_changed = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    led.push_back(line[i]);
    if (i + 1 == line.size() && !is_closed) break;
    const auto* chain = chain_of(line[i], line[(i + 1) % line.size()], chains);
    if (chain == nullptr) continue;
    is_changed = true;
    if (chain->front() == line[i]) {
      led.insert(led.end(), chain->begin() + 1, chain->end() - 1);
    } else {
      led.insert(led.end(), chain->rbegin() + 1, chain->rend() - 1);
    }
  }
  if (is_changed) line = std::move(led);
  return is_changed;
}

bool Drawing<3>::lead(std::vector<Ends>& edges, const Chains& chains) const {
  std::vector<Ends> led;
  bool is_changed = false;
  for (const auto& [s, t] : edges) {
    const auto* chain = chain_of(s, t, chains);
    if (chain == nullptr) {
      led.emplace_back(s, t);
      continue;
    }
    is_changed = true;
    for (std::size_t i = 1; i < chain->size(); ++i) led.emplace_back((*chain)[i - 1], (*chain)[i]);
  }
  if (is_changed) edges = std::move(led);
  return is_changed;
}

void Drawing<3>::apply(const Change& change) {
  for (const auto& [f, declared] : change.declared) {
    const std::size_t i = sheet_of_.at(f);
    PolygonParts& parts = sheets_[i].parts;
    take(i);
    for (const auto& [s, t] : declared.edges) {
      if (store_.find_edge(s, t) == nullptr) note_drawn(s, t);  // where polygons cross
    }
    parts.edges.insert(parts.edges.end(), declared.edges.begin(), declared.edges.end());
    parts.points.insert(parts.points.end(), declared.points.begin(), declared.points.end());
  }
  if (change.leads.empty()) return;
  Chains chains;
  for (const auto& [h, through] : change.leads) {
    const Edge& e = store_.edges()[h];
    const auto& led = chains.emplace(h, chain(e.a, e.b, through)).first->second;
    if (!is_drawn(h)) continue;
    drawn_[h] = false;  // if it comes again, then by a cut
    for (std::size_t i = 1; i < led.size(); ++i) note_drawn(led[i - 1], led[i]);
  }
  std::vector<std::size_t> changed;
  for (std::size_t i = 0; i < sheets_.size(); ++i) {
    Sheet& sheet = sheets_[i];
    bool is_changed = false;
    for (Loop& loop : sheet.parts.loops) is_changed |= lead(loop, true, chains);
    sheet.is_redrawn |= is_changed;
    is_changed |= lead(sheet.parts.edges, chains);
    if (is_changed) changed.push_back(i);
  }
  for (Path& path : paths_) lead(path, false, chains);
  for (const std::size_t i : changed) take(i);  // edges go with them
}

bool Drawing<3>::can_settle(PolygonHandle f, std::vector<Loop> loops) {
  Sheet rest = sheet_of(f);
  rest.parts.loops = std::move(loops);
  rest.is_redrawn = true;
  try {
    static_cast<void>(settled(rest, {}, tolerance(), store_, [](PolygonParts&) {}));
  } catch (const Error&) {
    return false;
  }
  return true;
}

void Drawing<3>::take_away(PolygonHandle f, std::vector<Loop> loops,
                           const std::vector<std::size_t>& to) {
  const std::size_t i = sheet_of_.at(f);
  for (const std::size_t facet : to) losses_.emplace_back(sheets_[i].facet, facet);
  take(i);
  sheets_[i].parts.loops = std::move(loops);
  sheets_[i].is_redrawn = true;
}

void Drawing<3>::cut_up(PolygonHandle f) {
  const std::size_t i = sheet_of_.at(f);
  take(i);
  sheets_[i].is_cut_up = true;
}

// --- Sheets ----------------------------------------------------------------------------------

void Drawing<3>::take(std::size_t i) {
  Sheet& sheet = sheets_[i];
  if (sheet.record == 0) return;
  sheet_of_.erase(sheet.record);
  Polygon& f = store_.polygons()[sheet.record];
  store_.take(f);
  sheet.record = 0;
}

// Of equal ones that of the first facet stays.
void Drawing<3>::put(std::size_t i) {
  Polygon& f = store_.record(sheets_[i].parts);
  if (f.alive) {
    const std::size_t other = sheet_of_.at(f.self);
    const bool other_goes = sheets_[i].facet < sheets_[other].facet;
    const std::size_t goes = other_goes ? other : i, stays = other_goes ? i : other;
    losses_.emplace_back(sheets_[goes].facet, sheets_[stays].facet);
    sheets_[goes].parts = {};
    sheets_[goes].record = 0;
    sheets_[stays].record = f.self;
    sheet_of_[f.self] = stays;
    return;
  }
  store_.put(f);
  arrivals_.polygons.push_back(f.self);
  sheets_[i].record = f.self;
  sheet_of_.emplace(f.self, i);
}

bool Drawing<3>::settle(const std::vector<PolygonId>& names, const AddInside& add_inside) {
  bool any = false;
  const std::size_t count = sheets_.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (sheets_[i].record != 0 || sheets_[i].is_gone()) continue;
    any = true;
    const std::size_t facet = sheets_[i].facet;
    std::vector<PolygonParts> pieces =
        settled(sheets_[i], names[facet], tolerance(), store_, add_inside);
    const bool is_cut_up = sheets_[i].is_cut_up;
    sheets_[i].parts = {};
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const std::size_t at = k == 0 ? i : sheets_.size();
      if (k > 0) sheets_.push_back({facet, {}, 0, true, is_cut_up});
      sheets_[at].parts = std::move(pieces[k]);
      put(at);
    }
  }
  if (any) use_edges();
  return any;
}

}  // namespace mesher::detail
