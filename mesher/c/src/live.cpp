// Live meshes: edits are announced, updates make them, arrays show the result.
#include "live.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "change.hpp"
#include "control.hpp"
#include "graph.hpp"
#include "mesh.hpp"
#include "options.hpp"
#include "sizes.hpp"

namespace lm {

using mesher::DomainUpdate;
using mesher::Error;
using mesher::ErrorCode;
using mesher::Feature;
using mesher::FeatureKind;
using mesher::LineId;
using mesher::Point;
using mesher::PointId;
using mesher::PolygonId;
using mesher::SeedId;
using mesher::Slot;

void SlotsInUse::follow(std::size_t count, const Slots& added, const Slots& removed) noexcept {
  if (!used_) return;
  try {
    used_->resize(count);
  } catch (...) {
    used_.reset();
    return;
  }
  for (const Slot s : removed) (*used_)[s] = 0;
  for (const Slot s : added) (*used_)[s] = 1;
}

// --- Updates -----------------------------------------------------------------------------------

template <int D>
void LiveIn<D>::discard() noexcept {
  mesher.discard_edits();
  undo_.forget_edits();
  pending = false;
}

template <int D>
void LiveIn<D>::follow(const DomainUpdate<D>& update) noexcept {
  const mesher::LiveMesh<D> live = mesher.live();
  const mesher::SlotChange& slots = update.slots;
  points_.follow(live.vertex_slots(), slots.vertices_added, slots.vertices_removed);
  cells_.follow(live.simplex_slots(), slots.simplices_added, slots.simplices_removed);
  kept_.follow(live.simplex_slots(), update.kept.added, update.kept.removed);
  if constexpr (D == 2) {
    facets_.follow(live.edges().size(), slots.edges_added, slots.edges_removed);
  } else {
    facets_.follow(live.faces().size(), slots.faces_added, slots.faces_removed);
  }
}

template <int D>
DomainUpdate<D> LiveIn<D>::run(const mesher::RunControl& control) {
  DomainUpdate<D> update = mesher.update(control);
  pending = false;
  ++updates_;
  notes_.reset();
  follow(update);
  return update;
}

template <int D>
DomainUpdate<D> LiveIn<D>::update(const mesher::RunControl& control) {
  try {
    undo_.prepare(mesher);
    DomainUpdate<D> update = run(control);
    undo_.commit();
    return update;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::cancelled) discard();
    throw;
  } catch (...) {
    discard();
    throw;
  }
}

template <int D>
DomainUpdate<D> LiveIn<D>::undo(const mesher::RunControl& control) {
  if (pending) throw Failure(LM_BAD_ARGUMENT, "edits are announced: update or discard them first");
  if (undo_.size() == 0) throw Failure(LM_NOTHING_TO_UNDO, "there is no update to undo");
  try {
    undo_.announce(mesher);
    DomainUpdate<D> update = run(control);
    undo_.pop();
    return update;
  } catch (...) {
    discard();
    throw;
  }
}

// --- Arrays ------------------------------------------------------------------------------------

namespace {

template <int D>
auto facets_of(const mesher::LiveMesh<D>& live) {
  if constexpr (D == 2) {
    return live.edges();
  } else {
    return live.faces();
  }
}

template <int D>
bool is_facet(const mesher::LiveMesh<D>& live, Slot slot) {
  return D == 2 ? live.is_edge(slot) : live.is_face(slot);
}

lm_array corners_of(std::span<const mesher::Mesh<2>::Edge> edges) {
  using Edge = mesher::Mesh<2>::Edge;
  static_assert(offsetof(Edge, high) == offsetof(Edge, low) + sizeof(std::uint32_t));
  lm_array ends = member_of(
      edges, [](const Edge& e) -> auto& { return e.low; });
  ends.columns = 2;
  return ends;
}
lm_array corners_of(std::span<const mesher::Mesh<3>::Face> faces) {
  return member_of(
      faces, [](const auto& f) -> auto& { return f.corners; });
}

lm_array ids_of(std::span<const mesher::Mesh<2>::Edge> edges) {
  return member_of(
      edges, [](const auto& e) -> auto& { return e.feature.number; });
}
lm_array ids_of(std::span<const mesher::Mesh<3>::Face> faces) {
  return member_of(
      faces, [](const auto& f) -> auto& { return f.polygon; });
}

lm_array kinds_of(std::span<const mesher::Mesh<2>::Edge> edges, std::vector<std::uint8_t>&) {
  return member_of(
      edges, [](const auto& e) -> auto& { return e.feature.kind; });
}
lm_array kinds_of(std::span<const mesher::Mesh<3>::Face> faces, std::vector<std::uint8_t>& all) {
  all.assign(faces.size(), LM_POLYGON);
  return rows_of(all);
}

}  // namespace

template <int D>
lm_array LiveIn<D>::array(std::int32_t field) {
  const mesher::LiveMesh<D> live = mesher.live();
  const auto facets = facets_of(live);
  switch (field) {
    case LM_LIVE_POINTS:
      return rows_of(live.points());
    case LM_LIVE_POINT_KINDS:
      return member_of(
          live.kinds(), [](const auto& kind) -> auto& { return kind; });
    case LM_LIVE_CELLS:
      return rows_of(live.simplices());
    case LM_LIVE_NEIGHBORS:
      return rows_of(live.neighbours());
    case LM_LIVE_POINT_USED:
      return rows_of(points_.get(live.vertex_slots(), [&](Slot s) { return live.is_vertex(s); }));
    case LM_LIVE_CELL_USED:
      return rows_of(cells_.get(live.simplex_slots(), [&](Slot s) { return live.is_simplex(s); }));
    case LM_LIVE_CELL_KEPT:
      return rows_of(kept_.get(live.simplex_slots(),
                               [&](Slot s) { return live.is_simplex(s) && mesher.keeps(s); }));
    case LM_LIVE_FACETS:
      return corners_of(facets);
    case LM_LIVE_FACET_FEATURES:
      return kinds_of(facets, polygons_);
    case LM_LIVE_FACET_FEATURE_IDS:
      return ids_of(facets);
    case LM_LIVE_FACET_USED:
      return rows_of(facets_.get(facets.size(), [&](Slot s) { return is_facet<D>(live, s); }));
    default:
      fail_unknown_field(field);
  }
}

template <int D>
const std::vector<std::string>& LiveIn<D>::notes() {
  if (!notes_) {
    std::vector<std::string> all;
    for (const auto& fault : mesher.faults()) all.push_back(describe(fault));
    notes_ = std::move(all);
  }
  return *notes_;
}

template <int D>
lm_live_info LiveIn<D>::info() const {
  const mesher::LiveMesh<D> live = mesher.live();
  lm_live_info all{};
  all.dimension = D;
  all.pending = pending;
  all.point_slots = live.vertex_slots();
  all.cell_slots = live.simplex_slots();
  all.points = live.vertices();
  all.cells = live.simplex_count();
  all.updates = updates_;
  all.undoable = undo_.size();
  all.trace_bytes = mesher.stats().trace_bytes;
  const mesher::Box<D>& domain = mesher.options().domain;
  std::copy(domain.lo.begin(), domain.lo.end(), all.domain_lo);
  std::copy(domain.hi.begin(), domain.hi.end(), all.domain_hi);
  return all;
}

template class LiveIn<2>;
template class LiveIn<3>;

const std::vector<std::string>* LiveObject::texts() {
  const std::lock_guard lock(making_);
  return std::visit([](const auto& in) { return &in->notes(); }, live);
}

namespace {

// Calls change(in) for the live mesh of a handle, of its dimension, alone with it.
template <class Change>
void edit(lm_handle handle, Change&& change) {
  const Writing<LiveObject> object(handle);
  std::visit([&](auto& in) { change(*in); }, object->live);
}
template <class Look>
void look(lm_handle handle, Look&& visit) {
  const Reading<LiveObject> object(handle);
  std::visit([&](const auto& in) { visit(*in); }, object->live);
}

// The features with these numbers, that exist, each once. Throws: Failure, Error(unknown_id).
template <class Id, int D>
std::vector<Id> existing(const LiveIn<D>& in, std::size_t n, const std::int64_t* numbers,
                         Id (*make)(std::int64_t)) {
  require_array(numbers, n, "ids");
  std::vector<Id> ids;
  ids.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    ids.push_back(make(numbers[i]));
    if (in.mesher.contains(ids.back())) continue;
    throw Error(ErrorCode::unknown_id, text_of(Feature(ids.back())) + " does not exist", {},
                {Feature(ids.back())});
  }
  std::vector<Id> sorted = ids;
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice == sorted.end()) return ids;
  throw Error(ErrorCode::repeated_id, text_of(Feature(*twice)) + " is named twice", {},
              {Feature(*twice)});
}

PointId point_id(std::int64_t i) { return PointId{i}; }
LineId line_id(std::int64_t i) { return LineId{i}; }
PolygonId polygon_id(std::int64_t i) { return PolygonId{i}; }

template <int D>
void require_inside(const mesher::Box<D>& domain, const Point<D>& p, PointId id) {
  for (std::size_t i = 0; i < D; ++i) {
    if (domain.lo[i] <= p[i] && p[i] <= domain.hi[i]) continue;
    throw Error(ErrorCode::outside_domain, text_of(Feature(id)) + " would be outside the domain",
                {}, {Feature(id)}, {mesher::position_of(p)});
  }
}

template <int D>
void move(LiveIn<D>& in, std::size_t n, const std::int64_t* ids, const double* at) {
  require_array(at, n, "at");
  const auto points = existing<PointId, D>(in, n, ids, point_id);
  for (std::size_t i = 0; i < n; ++i) {
    const Point<D> p = point_at<D>(at, i);
    require_coordinates<D>(p, points[i]);
    require_inside<D>(in.mesher.options().domain, p, points[i]);
  }
  in.edit(points, [&] {
    for (std::size_t i = 0; i < n; ++i) in.mesher.move(points[i], point_at<D>(at, i));
  });
}

// Announces new parts, each by announce(part); take_back(id) takes one back.
template <int D, class Part, class Announce, class TakeBack>
void add(LiveIn<D>& in, const std::vector<Part>& parts, Announce&& announce, TakeBack&& take_back) {
  std::vector<decltype(Part::id)> ids;
  ids.reserve(parts.size());
  for (const Part& part : parts) ids.push_back(part.id);
  in.add(
      ids, [&](std::size_t i) { announce(parts[i]); }, [&](std::size_t i) { take_back(ids[i]); });
}

template <int D>
void add_seeds(LiveIn<D>& in, const std::vector<mesher::Seed<D>>& seeds) {
  add(
      in, seeds, [&](const auto& seed) { in.mesher.insert_seed(seed); },
      [&](const SeedId& id) { in.mesher.remove_seed(id); });
}

template <int D>
void remove_seeds(LiveIn<D>& in, std::size_t n, const std::int64_t* ids,
                  SeedId (*make)(std::int64_t)) {
  const auto seeds = existing<SeedId, D>(in, n, ids, make);
  in.edit(seeds, [&] {
    for (const SeedId& id : seeds) in.mesher.remove_seed(id);
  });
}

template <int D>
void add_graph(LiveIn<D>& in, const GraphObject& object) {
  const mesher::Graph<D>& graph = file_in<D>(object).graph;
  std::vector<Feature> all;
  for (const auto& p : graph.points) all.emplace_back(p.id);
  for (const auto& s : graph.segments) all.emplace_back(s.id);
  for (const auto& l : graph.polylines) all.emplace_back(l.id);
  for (const auto& s : graph.seeds) all.emplace_back(s.id);
  if constexpr (D == 3) {
    for (const auto& f : graph.polygons) all.emplace_back(f.id);
  }
  in.edit(all, [&] { with_locations(file_in<D>(object), [&] { in.mesher.insert(graph); }); });
  in.next.point = std::max(in.next.point, object.next.point);
  in.next.line = std::max(in.next.line, object.next.line);
  in.next.polygon = std::max(in.next.polygon, object.next.polygon);
  in.next.hole = std::max(in.next.hole, object.next.hole);
  in.next.region = std::max(in.next.region, object.next.region);
}

// Updates by run(). The handle of the change, if it is wanted, and 0 if there is no memory for it:
// the update is made.
template <int D, class Run>
void give_change(LiveIn<D>& in, lm_handle* change, Run&& run) {
  const std::size_t point_slots_before = in.mesher.live().vertex_slots();
  DomainUpdate<D> update = run();
  if (change == nullptr) return;
  *change = 0;
  try {
    make_object<ChangeObject>(change, std::move(update), in.mesher.live(), point_slots_before);
  } catch (const std::bad_alloc&) {
  }
}

template <int D>
lm_handle whole_mesh(const LiveIn<D>& in) {
  auto object = mesh_object<D>(in.mesher.domain_mesh(), in.mesher.input().points);
  object->algorithm = mesher::Algorithm::gap_balls;
  MeshIn<D>& mesh = *std::get<std::shared_ptr<MeshIn<D>>>(object->mesh);
  const mesher::LiveMesh<D> live = in.mesher.live();
  for (const Point<D>& p : mesh.data.vertices) mesh.point_slots.push_back(live.find(p));
  for (const auto& t : mesh.data.simplices) {
    std::array<Point<D>, D + 1> corners;
    for (std::size_t i = 0; i <= D; ++i) corners[i] = mesh.data.vertices[t[i]];
    mesh.cell_slots.push_back(live.find_simplex(corners));
  }
  return add_object(std::move(object));
}

template <int D>
bool contains(const mesher::Mesher<D>& mesher, std::int32_t kind, std::int64_t id) {
  switch (kind) {
    case LM_POINT:
      return mesher.contains(PointId{id});
    case LM_LINE:
      return mesher.contains(LineId{id});
    case LM_POLYGON:
      if constexpr (D == 3) return mesher.contains(PolygonId{id});
      return false;
    case LM_HOLE:
      return mesher.contains(mesher::hole_id(id));
    case LM_REGION:
      return mesher.contains(mesher::region_id(id));
    default:
      throw Failure(LM_BAD_ARGUMENT, "kind is " + std::to_string(kind));
  }
}

template <int D>
double region_at(const mesher::Mesher<D>& mesher, const mesher::LiveMesh<D>& live, Slot cell) {
  if (!live.is_simplex(cell)) {
    throw Failure(LM_BAD_ARGUMENT, "cell slot " + std::to_string(cell) + " is not in use");
  }
  const auto name = mesher.label(cell).seed;
  if (!name || name->kind == mesher::SeedKind::hole) return 0;
  const auto seed = mesher.seed(*name);
  return seed ? seed->attribute : 0;
}

}  // namespace
}  // namespace lm

using namespace lm;

lm_status lm_live_new(int32_t dimension, const lm_options* options, lm_handle* live) {
  return guarded([&] {
    require_pointer(live, "live");
    if (dimension == 2) {
      make_object<LiveObject>(live, options_of<2>(options));
    } else if (dimension == 3) {
      make_object<LiveObject>(live, options_of<3>(options));
    } else {
      fail_dimension(dimension);
    }
  });
}

lm_status lm_live_add_points(lm_handle live, size_t n, const double* at, const int64_t* ids,
                             const int64_t* markers, int64_t* first) {
  return guarded([&] {
    edit(live, [&]<int D>(LiveIn<D>& in) {
      const NewIds all(n, ids, in.next.point);
      add(
          in, read_points<D>(n, at, all, markers),
          [&](const auto& p) { in.mesher.insert(p.id, p.at, p.marker); },
          [&](PointId id) { in.mesher.remove(id); });
      all.settle(in.next.point, first);
    });
  });
}

lm_status lm_live_move_points(lm_handle live, size_t n, const int64_t* ids, const double* at) {
  return guarded([&] { edit(live, [&](auto& in) { move(in, n, ids, at); }); });
}

lm_status lm_live_remove_points(lm_handle live, size_t n, const int64_t* ids) {
  return guarded([&] {
    edit(live, [&]<int D>(LiveIn<D>& in) {
      const auto points = existing<PointId, D>(in, n, ids, point_id);
      in.edit(points, [&] {
        for (const PointId id : points) in.mesher.remove(id);
      });
    });
  });
}

lm_status lm_live_add_segments(lm_handle live, size_t n, const int64_t* ends, const int64_t* ids,
                               const int64_t* markers, int64_t* first) {
  return guarded([&] {
    edit(live, [&](auto& in) {
      const NewIds all(n, ids, in.next.line);
      add(
          in, read_segments(n, ends, all, markers),
          [&](const auto& s) { in.mesher.insert_segment(s.id, s.from, s.to, s.marker); },
          [&](LineId id) { in.mesher.remove_line(id); });
      all.settle(in.next.line, first);
    });
  });
}

lm_status lm_live_add_polyline(lm_handle live, size_t n, const int64_t* points, const int64_t* id,
                               int64_t marker, int64_t* added) {
  return guarded([&] {
    edit(live, [&](auto& in) {
      if (n < 2) throw Failure(LM_BAD_ARGUMENT, "a polyline has fewer than 2 points");
      const NewIds all(1, id, in.next.line);
      const std::vector<mesher::Polyline> lines{{LineId{all[0]}, read_ids(n, points), marker}};
      add(
          in, lines, [&](const auto& l) { in.mesher.insert_polyline(l.id, l.points, l.marker); },
          [&](LineId of) { in.mesher.remove_line(of); });
      all.settle(in.next.line, added);
    });
  });
}

lm_status lm_live_remove_lines(lm_handle live, size_t n, const int64_t* ids) {
  return guarded([&] {
    edit(live, [&]<int D>(LiveIn<D>& in) {
      const auto lines = existing<LineId, D>(in, n, ids, line_id);
      in.edit(lines, [&] {
        for (const LineId id : lines) in.mesher.remove_line(id);
      });
    });
  });
}

lm_status lm_live_add_polygon(lm_handle live, const lm_polygon* polygon, const int64_t* id,
                              int64_t* added) {
  return guarded([&] {
    edit(live, [&]<int D>(LiveIn<D>& in) {
      require_space(D);
      if constexpr (D == 3) {
        const NewIds all(1, id, in.next.polygon);
        const std::vector<mesher::Polygon> polygons{read_polygon(polygon, all[0])};
        add(
            in, polygons, [&](const auto& f) { in.mesher.insert_polygon(f); },
            [&](PolygonId of) { in.mesher.remove_polygon(of); });
        all.settle(in.next.polygon, added);
      }
    });
  });
}

lm_status lm_live_remove_polygons(lm_handle live, size_t n, const int64_t* ids) {
  return guarded([&] {
    edit(live, [&]<int D>(LiveIn<D>& in) {
      require_space(D);
      if constexpr (D == 3) {
        const auto polygons = existing<PolygonId, D>(in, n, ids, polygon_id);
        in.edit(polygons, [&] {
          for (const PolygonId id : polygons) in.mesher.remove_polygon(id);
        });
      }
    });
  });
}

lm_status lm_live_add_holes(lm_handle live, size_t n, const double* at, const int64_t* ids,
                            int64_t* first) {
  return guarded([&] {
    edit(live, [&]<int D>(LiveIn<D>& in) {
      const NewIds all(n, ids, in.next.hole);
      add_seeds(in, read_holes<D>(n, at, all));
      all.settle(in.next.hole, first);
    });
  });
}

lm_status lm_live_remove_holes(lm_handle live, size_t n, const int64_t* ids) {
  return guarded([&] { edit(live, [&](auto& in) { remove_seeds(in, n, ids, mesher::hole_id); }); });
}

lm_status lm_live_add_regions(lm_handle live, size_t n, const double* at, const double* attributes,
                              const double* limits, const int64_t* ids, int64_t* first) {
  return guarded([&] {
    edit(live, [&]<int D>(LiveIn<D>& in) {
      const NewIds all(n, ids, in.next.region);
      add_seeds(in, read_regions<D>(n, at, attributes, limits, all));
      all.settle(in.next.region, first);
    });
  });
}

lm_status lm_live_remove_regions(lm_handle live, size_t n, const int64_t* ids) {
  return guarded(
      [&] { edit(live, [&](auto& in) { remove_seeds(in, n, ids, mesher::region_id); }); });
}

lm_status lm_live_add_graph(lm_handle live, lm_handle graph) {
  return guarded([&] {
    const Reading<GraphObject> object(graph);
    edit(live, [&](auto& in) { add_graph(in, *object); });
  });
}

lm_status lm_live_limit(lm_handle live, double max_measure, lm_handle sizes, const double* box) {
  return guarded([&] {
    edit(live, [&]<int D>(LiveIn<D>& in) {
      const mesher::SizeLimits<D> limits{max_measure, sizes_of<D>(sizes)};
      if (box == nullptr) {
        in.mesher.limit(limits);
      } else {
        in.mesher.limit({point_at<D>(box, 0), point_at<D>(box, 1)}, limits);
      }
      in.pending = true;
    });
  });
}

lm_status lm_live_discard(lm_handle live) {
  return guarded([&] { edit(live, [](auto& in) { in.discard(); }); });
}

lm_status lm_live_update(lm_handle live, const lm_control* control, lm_handle* change) {
  return guarded([&] {
    edit(live, [&](auto& in) {
      give_change(in, change, [&] { return in.update(control_of(control)); });
    });
  });
}

lm_status lm_live_keep_undo(lm_handle live, size_t depth) {
  return guarded([&] { edit(live, [&](auto& in) { in.undo_.keep(depth); }); });
}

lm_status lm_live_undo(lm_handle live, const lm_control* control, lm_handle* change) {
  return guarded([&] {
    edit(live,
         [&](auto& in) { give_change(in, change, [&] { return in.undo(control_of(control)); }); });
  });
}

lm_status lm_live_describe(lm_handle live, lm_live_info* info) {
  return guarded([&] {
    require_struct(info, "info");
    look(live, [&](const auto& in) { give_struct(in.info(), info); });
  });
}

lm_status lm_live_array(lm_handle live, int32_t field, lm_array* array) {
  return guarded([&] {
    require_struct(array, "array");
    edit(live, [&](auto& in) { give_struct(in.array(field), array); });
  });
}

lm_status lm_live_regions(lm_handle live, size_t n, const uint32_t* cells, double* attributes) {
  return guarded([&] {
    require_array(cells, n, "cells");
    require_array(attributes, n, "attributes");
    look(live, [&](const auto& in) {
      const auto view = in.mesher.live();
      std::vector<double> found(n);  // all, before any is written
      for (std::size_t i = 0; i < n; ++i) found[i] = region_at(in.mesher, view, cells[i]);
      std::copy(found.begin(), found.end(), attributes);
    });
  });
}

lm_status lm_live_find(lm_handle live, size_t n, const double* at, uint32_t* slots) {
  return guarded([&] {
    require_array(at, n, "at");
    require_array(slots, n, "slots");
    look(live, [&]<int D>(const LiveIn<D>& in) {
      const auto view = in.mesher.live();
      for (std::size_t i = 0; i < n * D; ++i) {
        if (!std::isfinite(at[i])) throw Error(ErrorCode::not_finite, "a position is not finite");
      }
      for (std::size_t i = 0; i < n; ++i) slots[i] = view.find(point_at<D>(at, i));
    });
  });
}

lm_status lm_live_contains(lm_handle live, int32_t kind, size_t n, const int64_t* ids,
                           uint8_t* exist) {
  return guarded([&] {
    require_array(ids, n, "ids");
    require_array(exist, n, "exist");
    look(live, [&](const auto& in) {
      for (std::size_t i = 0; i < n; ++i) exist[i] = contains(in.mesher, kind, ids[i]);
    });
  });
}

lm_status lm_live_mesh(lm_handle live, lm_handle* mesh) {
  return guarded([&] {
    require_pointer(mesh, "mesh");
    look(live, [&](const auto& in) { *mesh = whole_mesh(in); });
  });
}

lm_status lm_live_graph(lm_handle live, lm_handle* graph) {
  return guarded([&] {
    require_pointer(graph, "graph");
    look(live, [&]<int D>(const LiveIn<D>& in) {
      mesher::GraphFile<D> file;
      file.graph = in.mesher.input();
      make_object<GraphObject>(graph, std::move(file));
    });
  });
}
