// Graphs: made by parts, read, repaired, shown in arrays.
#include "graph.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <unordered_map>

#include "arrays.hpp"
#include "mesher/read.hpp"
#include "mesher/repair.hpp"
#include "mesher/write.hpp"

namespace lm {
namespace {

using mesher::FilePosition;
using mesher::Graph;
using mesher::GraphFile;
using mesher::GraphPoint;
using mesher::Point;
using mesher::PointId;
using mesher::Polygon;
using mesher::Polyline;
using mesher::Seed;
using mesher::SeedKind;
using mesher::Segment;

constexpr std::int64_t number(PointId id) noexcept { return static_cast<std::int64_t>(id); }

// --- Ids ---------------------------------------------------------------------------------------

void pass(std::int64_t& next, std::int64_t id) noexcept {
  if (id >= next) next = id == std::numeric_limits<std::int64_t>::max() ? id : id + 1;
}

template <int D>
NextIds ids_behind(const Graph<D>& graph) {
  NextIds next;
  for (const auto& p : graph.points) pass(next.point, number(p.id));
  for (const auto& s : graph.segments) pass(next.line, static_cast<std::int64_t>(s.id));
  for (const auto& l : graph.polylines) pass(next.line, static_cast<std::int64_t>(l.id));
  for (const auto& s : graph.seeds) {
    pass(s.id.kind == SeedKind::hole ? next.hole : next.region, s.id.number);
  }
  if constexpr (D == 3) {
    for (const auto& f : graph.polygons) pass(next.polygon, static_cast<std::int64_t>(f.id));
  }
  return next;
}

// --- Parts -------------------------------------------------------------------------------------

// Appends all or nothing. `positions`: those of the file that the graph is from, if it is from one.
template <class Part>
void append(std::vector<Part>& all, std::vector<Part>&& more, bool has_file,
            std::vector<FilePosition>& positions) {
  if (has_file) positions.resize(all.size() + more.size());
  try {
    all.insert(all.end(), std::make_move_iterator(more.begin()),
               std::make_move_iterator(more.end()));
  } catch (...) {
    if (has_file) positions.resize(all.size());
    throw;
  }
}

// Calls add(file) for the graph of a handle, of its dimension.
template <class Add>
void edit(lm_handle handle, Add&& add) {
  const Writing<GraphObject> graph(handle);
  std::visit([&](auto& file) { add(*graph, file); }, graph->file);
  graph->change();
}

template <int D>
auto& polygons_of(GraphFile<D>& file) {
  if constexpr (D == 3) {
    return file.graph.polygons;
  } else {
    static std::vector<Polygon> none;
    require_space(D);
    return none;
  }
}

// --- Triangles without common points -----------------------------------------------------------

template <int D>
struct PlaceHash {
  std::size_t operator()(const Point<D>& p) const noexcept {
    std::uint64_t h = 0;
    for (const double x : p) {
      h = (h ^ std::bit_cast<std::uint64_t>(x + 0.0)) * 0x9e3779b97f4a7c15;
      h ^= h >> 29;
    }
    return h;
  }
};

// Points by their places, and new ones where there is none.
class Corners {
 public:
  Corners(const Graph<3>& graph, std::int64_t next) : next_(next) {
    for (const auto& p : graph.points) ids_.emplace(p.at, p.id);
  }
  PointId at(const Point<3>& p) {
    const auto [it, is_new] = ids_.emplace(p, PointId{next_});
    if (!is_new) return it->second;
    if (next_ == std::numeric_limits<std::int64_t>::max()) {
      throw Failure(LM_BAD_ARGUMENT, "no ids are left for points");
    }
    require_coordinates<3>(p, it->second);
    come.push_back({PointId{next_++}, p});
    return come.back().id;
  }
  [[nodiscard]] std::int64_t next() const noexcept { return next_; }

  std::vector<GraphPoint<3>> come;

 private:
  std::unordered_map<Point<3>, PointId, PlaceHash<3>> ids_;
  std::int64_t next_;
};

void add_soup(GraphObject& object, GraphFile<3>& file, std::size_t n, const double* at,
              const std::int64_t* markers, std::int64_t* first) {
  require_array(at, n, "at");
  const NewIds ids(n, nullptr, object.next.polygon);
  Corners corners(file.graph, object.next.point);
  std::vector<Polygon> faces;
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<PointId> loop;
    for (std::size_t k = 0; k < 3; ++k) loop.push_back(corners.at(point_at<3>(at, 3 * i + k)));
    if (loop[0] == loop[1] || loop[1] == loop[2] || loop[2] == loop[0]) continue;
    faces.push_back({.id = mesher::PolygonId{ids[faces.size()]},
                     .loops = {std::move(loop)},
                     .marker = marker_at(markers, i)});
  }
  const bool has_file = !file.file.empty();
  const std::size_t old = file.graph.points.size();
  append(file.graph.points, std::move(corners.come), has_file, file.points);
  try {
    append(file.graph.polygons, std::move(faces), has_file, file.polygons);
  } catch (...) {
    file.graph.points.resize(old);
    if (has_file) file.points.resize(old);
    throw;
  }
  object.next.point = corners.next();
  ids.settle(object.next.polygon, first);
}

// --- Arrays ------------------------------------------------------------------------------------

template <int D>
FlatGraph flattened(const Graph<D>& graph) {
  FlatGraph flat;
  flat.line_offsets.push_back(0);
  for (const Polyline& line : graph.polylines) {
    for (const PointId p : line.points) flat.line_points.push_back(number(p));
    flat.line_offsets.push_back(static_cast<std::int64_t>(flat.line_points.size()));
  }
  flat.polygon_offsets.push_back(0);
  flat.loop_offsets.push_back(0);
  flat.edge_offsets.push_back(0);
  flat.inner_offsets.push_back(0);
  if constexpr (D == 3) {
    for (const Polygon& polygon : graph.polygons) {
      for (const auto& loop : polygon.loops) {
        for (const PointId p : loop) flat.loop_points.push_back(number(p));
        flat.loop_offsets.push_back(static_cast<std::int64_t>(flat.loop_points.size()));
      }
      flat.polygon_offsets.push_back(static_cast<std::int64_t>(flat.loop_offsets.size()) - 1);
      for (const auto& [from, to] : polygon.edges) {
        flat.inner_edges.push_back(number(from));
        flat.inner_edges.push_back(number(to));
      }
      flat.edge_offsets.push_back(static_cast<std::int64_t>(flat.inner_edges.size() / 2));
      for (const PointId p : polygon.points) flat.inner_points.push_back(number(p));
      flat.inner_offsets.push_back(static_cast<std::int64_t>(flat.inner_points.size()));
    }
  }
  for (const Seed<D>& seed : graph.seeds) {
    const bool is_hole = seed.id.kind == SeedKind::hole;
    auto& at = is_hole ? flat.holes : flat.regions;
    at.insert(at.end(), seed.at.begin(), seed.at.end());
    (is_hole ? flat.hole_ids : flat.region_ids).push_back(seed.id.number);
    if (is_hole) continue;
    flat.attributes.push_back(seed.attribute);
    flat.limits.push_back(seed.max_measure.value_or(0));
  }
  return flat;
}

// Ids are numbers to the outside.
template <class Record, class Member>
lm_array ids_of(const std::vector<Record>& all, Member member) {
  return member_of(std::span<const Record>(all), member);
}

template <int D>
lm_array polygon_array(const Graph<D>& graph, std::int32_t field) {
  if constexpr (D == 3) {
    if (field == LM_GRAPH_POLYGON_IDS) {
      return ids_of(
          graph.polygons, [](const Polygon& f) -> auto& { return f.id; });
    }
    return ids_of(
        graph.polygons, [](const Polygon& f) -> auto& { return f.marker; });
  } else {
    return rows_of(std::vector<std::int64_t>());
  }
}

template <int D>
lm_array array_of(const Graph<D>& graph, GraphObject& object, std::int32_t field) {
  switch (field) {
    case LM_GRAPH_POINTS:
      return ids_of(
          graph.points, [](const GraphPoint<D>& p) -> auto& { return p.at; });
    case LM_GRAPH_POINT_IDS:
      return ids_of(
          graph.points, [](const GraphPoint<D>& p) -> auto& { return p.id; });
    case LM_GRAPH_POINT_MARKERS:
      return ids_of(
          graph.points, [](const GraphPoint<D>& p) -> auto& { return p.marker; });
    case LM_GRAPH_SEGMENTS: {
      static_assert(offsetof(Segment, to) == offsetof(Segment, from) + sizeof(PointId));
      lm_array ends = ids_of(
          graph.segments, [](const Segment& s) -> auto& { return s.from; });
      ends.columns = 2;
      return ends;
    }
    case LM_GRAPH_SEGMENT_IDS:
      return ids_of(
          graph.segments, [](const Segment& s) -> auto& { return s.id; });
    case LM_GRAPH_SEGMENT_MARKERS:
      return ids_of(
          graph.segments, [](const Segment& s) -> auto& { return s.marker; });
    case LM_GRAPH_POLYLINE_OFFSETS:
      return rows_of(object.flat().line_offsets);
    case LM_GRAPH_POLYLINE_POINTS:
      return rows_of(object.flat().line_points);
    case LM_GRAPH_POLYLINE_IDS:
      return ids_of(
          graph.polylines, [](const Polyline& l) -> auto& { return l.id; });
    case LM_GRAPH_POLYLINE_MARKERS:
      return ids_of(
          graph.polylines, [](const Polyline& l) -> auto& { return l.marker; });
    case LM_GRAPH_POLYGON_OFFSETS:
      return rows_of(object.flat().polygon_offsets);
    case LM_GRAPH_LOOP_OFFSETS:
      return rows_of(object.flat().loop_offsets);
    case LM_GRAPH_LOOP_POINTS:
      return rows_of(object.flat().loop_points);
    case LM_GRAPH_POLYGON_IDS:
    case LM_GRAPH_POLYGON_MARKERS:
      return polygon_array(graph, field);
    case LM_GRAPH_HOLES:
      return rows_of(object.flat().holes, D);
    case LM_GRAPH_HOLE_IDS:
      return rows_of(object.flat().hole_ids);
    case LM_GRAPH_REGIONS:
      return rows_of(object.flat().regions, D);
    case LM_GRAPH_REGION_IDS:
      return rows_of(object.flat().region_ids);
    case LM_GRAPH_REGION_ATTRIBUTES:
      return rows_of(object.flat().attributes);
    case LM_GRAPH_REGION_LIMITS:
      return rows_of(object.flat().limits);
    case LM_GRAPH_INNER_EDGE_OFFSETS:
      return rows_of(object.flat().edge_offsets);
    case LM_GRAPH_INNER_EDGES:
      return rows_of(object.flat().inner_edges, 2);
    case LM_GRAPH_INNER_POINT_OFFSETS:
      return rows_of(object.flat().inner_offsets);
    case LM_GRAPH_INNER_POINTS:
      return rows_of(object.flat().inner_points);
    default:
      fail_unknown_field(field);
  }
}

// --- Files and repairs -------------------------------------------------------------------------

template <int D>
std::vector<std::string> notes_of(const GraphFile<D>& file) {
  std::vector<std::string> notes;
  for (const auto& note : file.notes) notes.push_back(text_of(note.location) + ": " + note.text);
  return notes;
}

template <int D>
std::optional<mesher::Box<D>> box_at(const double* domain) {
  if (domain == nullptr) return {};
  return mesher::Box<D>{point_at<D>(domain, 0), point_at<D>(domain, 1)};
}

template <int D>
void repair(const GraphFile<D>& file, const double* domain, const double* tolerance,
            lm_handle* handle) {
  mesher::RepairOptions<D> options;
  options.domain = box_at<D>(domain);
  if (tolerance != nullptr) options.tolerance = *tolerance;
  auto repaired = with_locations(file, [&] { return mesher::repair(file, options); });
  std::vector<std::string> notes;
  for (const auto& note : repaired.notes) notes.push_back(note.text());
  make_object<GraphObject>(handle, std::move(repaired.file), std::move(notes));
}

// A merged polygon is where the one was whose id it has.
GraphFile<3> merged(const GraphFile<3>& all) {
  GraphFile<3> file = all;
  file.graph = mesher::with_merged_polygons(all.graph);
  if (file.file.empty()) return file;
  std::map<mesher::PolygonId, FilePosition> places;
  for (std::size_t i = 0; i < all.polygons.size(); ++i) {
    places.emplace(all.graph.polygons[i].id, all.polygons[i]);
  }
  file.polygons.clear();
  for (const Polygon& f : file.graph.polygons) file.polygons.push_back(places.at(f.id));
  return file;
}

}  // namespace

template <int D>
void require_points(const Graph<D>& graph) {
  std::vector<PointId> ids;
  for (const auto& p : graph.points) ids.push_back(p.id);
  std::sort(ids.begin(), ids.end());
  const auto require = [&](PointId id, const mesher::Feature& of) {
    if (std::binary_search(ids.begin(), ids.end(), id)) return;
    throw mesher::Error(
        mesher::ErrorCode::unknown_id,
        text_of(of) + " names " + text_of(mesher::Feature(id)) + ", which does not exist", {},
        {of, id});
  };
  for (const Segment& s : graph.segments) require(s.from, s.id), require(s.to, s.id);
  for (const Polyline& l : graph.polylines) {
    for (const PointId id : l.points) require(id, l.id);
  }
  if constexpr (D == 3) {
    for (const Polygon& f : graph.polygons) {
      for (const auto& loop : f.loops) {
        for (const PointId id : loop) require(id, f.id);
      }
      for (const auto& [from, to] : f.edges) require(from, f.id), require(to, f.id);
      for (const PointId id : f.points) require(id, f.id);
    }
  }
}
template void require_points(const Graph<2>&);
template void require_points(const Graph<3>&);

GraphObject::GraphObject(File all, std::vector<std::string> of_it)
    : file(std::move(all)), notes(std::move(of_it)) {
  next = std::visit([](const auto& of) { return ids_behind(of.graph); }, file);
}

const FlatGraph& GraphObject::flat() {
  const std::lock_guard lock(making_);
  if (!flat_) flat_ = std::visit([](const auto& of) { return flattened(of.graph); }, file);
  return *flat_;
}

}  // namespace lm

using namespace lm;

lm_status lm_graph_new(int32_t dimension, lm_handle* graph) {
  return guarded([&] {
    require_pointer(graph, "graph");
    if (dimension == 2) {
      make_object<GraphObject>(graph, GraphFile<2>());
    } else if (dimension == 3) {
      make_object<GraphObject>(graph, GraphFile<3>());
    } else {
      fail_dimension(dimension);
    }
  });
}

lm_status lm_graph_add_points(lm_handle graph, size_t n, const double* at, const int64_t* ids,
                              const int64_t* markers, int64_t* first) {
  return guarded([&] {
    edit(graph, [&]<int D>(GraphObject& object, GraphFile<D>& file) {
      const NewIds all(n, ids, object.next.point);
      append(file.graph.points, read_points<D>(n, at, all, markers), !file.file.empty(),
             file.points);
      all.settle(object.next.point, first);
    });
  });
}

lm_status lm_graph_add_segments(lm_handle graph, size_t n, const int64_t* ends, const int64_t* ids,
                                const int64_t* markers, int64_t* first) {
  return guarded([&] {
    edit(graph, [&](GraphObject& object, auto& file) {
      const NewIds all(n, ids, object.next.line);
      append(file.graph.segments, read_segments(n, ends, all, markers), !file.file.empty(),
             file.segments);
      all.settle(object.next.line, first);
    });
  });
}

lm_status lm_graph_add_polyline(lm_handle graph, size_t n, const int64_t* points, const int64_t* id,
                                int64_t marker, int64_t* added) {
  return guarded([&] {
    edit(graph, [&](GraphObject& object, auto& file) {
      if (n < 2) throw Failure(LM_BAD_ARGUMENT, "a polyline has fewer than 2 points");
      const NewIds all(1, id, object.next.line);
      append(file.graph.polylines, {Polyline{mesher::LineId{all[0]}, read_ids(n, points), marker}},
             !file.file.empty(), file.polylines);
      all.settle(object.next.line, added);
    });
  });
}

lm_status lm_graph_add_polygon(lm_handle graph, const lm_polygon* polygon, const int64_t* id,
                               int64_t* added) {
  return guarded([&] {
    edit(graph, [&](GraphObject& object, auto& file) {
      auto& polygons = polygons_of(file);
      const NewIds all(1, id, object.next.polygon);
      append(polygons, {read_polygon(polygon, all[0])}, !file.file.empty(), file.polygons);
      all.settle(object.next.polygon, added);
    });
  });
}

lm_status lm_graph_add_faces(lm_handle graph, size_t n, const size_t* sizes, const int64_t* corners,
                             const int64_t* ids, const int64_t* markers, int64_t* first) {
  return guarded([&] {
    edit(graph, [&](GraphObject& object, auto& file) {
      auto& polygons = polygons_of(file);
      require_array(corners, n, "corners");
      const NewIds all(n, ids, object.next.polygon);
      std::vector<Polygon> faces;
      faces.reserve(n);
      std::size_t done = 0;
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t size = sizes == nullptr ? 3 : sizes[i];
        if (size < 3) throw Failure(LM_BAD_ARGUMENT, "a face has fewer than 3 corners");
        faces.push_back({.id = mesher::PolygonId{all[i]},
                         .loops = {read_ids(size, corners + done)},
                         .marker = marker_at(markers, i)});
        done += size;
      }
      append(polygons, std::move(faces), !file.file.empty(), file.polygons);
      all.settle(object.next.polygon, first);
    });
  });
}

lm_status lm_graph_add_soup(lm_handle graph, size_t n, const double* at, const int64_t* markers,
                            int64_t* first) {
  return guarded([&] {
    edit(graph, [&]<int D>(GraphObject& object, GraphFile<D>& file) {
      require_space(D);
      if constexpr (D == 3) add_soup(object, file, n, at, markers, first);
    });
  });
}

lm_status lm_graph_add_holes(lm_handle graph, size_t n, const double* at, const int64_t* ids,
                             int64_t* first) {
  return guarded([&] {
    edit(graph, [&]<int D>(GraphObject& object, GraphFile<D>& file) {
      const NewIds all(n, ids, object.next.hole);
      append(file.graph.seeds, read_holes<D>(n, at, all), !file.file.empty(), file.seeds);
      all.settle(object.next.hole, first);
    });
  });
}

lm_status lm_graph_add_regions(lm_handle graph, size_t n, const double* at,
                               const double* attributes, const double* limits, const int64_t* ids,
                               int64_t* first) {
  return guarded([&] {
    edit(graph, [&]<int D>(GraphObject& object, GraphFile<D>& file) {
      const NewIds all(n, ids, object.next.region);
      append(file.graph.seeds, read_regions<D>(n, at, attributes, limits, all), !file.file.empty(),
             file.seeds);
      all.settle(object.next.region, first);
    });
  });
}

lm_status lm_graph_dimension(lm_handle graph, int32_t* dimension) {
  return guarded([&] {
    require_pointer(dimension, "dimension");
    *dimension = Reading<GraphObject>(graph)->dimension();
  });
}

lm_status lm_graph_array(lm_handle graph, int32_t field, lm_array* array) {
  return guarded([&] {
    require_struct(array, "array");
    const Reading<GraphObject> object(graph);
    const lm_array found = std::visit(
        [&](const auto& file) { return array_of(file.graph, *object, field); }, object->file);
    give_struct(found, array);
  });
}

lm_status lm_graph_read(const char* path, int32_t dimension, int32_t points_alone,
                        lm_handle* graph) {
  return guarded([&] {
    require_pointer(path, "path");
    require_pointer(graph, "graph");
    mesher::ReadOptions options;
    options.points_alone = points_alone != 0;
    if (dimension == 0) dimension = mesher::dimension_of(path);
    if (dimension != 2 && dimension != 3) fail_dimension(dimension);
    GraphObject::File file;
    if (dimension == 2) {
      file = mesher::read<2>(path, options);
    } else {
      file = mesher::read<3>(path, options);
    }
    auto notes = std::visit([](const auto& of) { return notes_of(of); }, file);
    make_object<GraphObject>(graph, std::move(file), std::move(notes));
  });
}

lm_status lm_graph_write(lm_handle graph, const char* path) {
  return guarded([&] {
    require_pointer(path, "path");
    const Reading<GraphObject> object(graph);
    std::visit(
        [&](const auto& file) {
          lm::require_points(file.graph);
          mesher::write_graph(file.graph, path);
        },
        object->file);
  });
}

lm_status lm_graph_repair(lm_handle graph, const double* domain, const double* tolerance,
                          lm_handle* repaired) {
  return guarded([&] {
    require_pointer(repaired, "repaired");
    const Reading<GraphObject> object(graph);
    std::visit([&](const auto& file) { repair(file, domain, tolerance, repaired); }, object->file);
  });
}

lm_status lm_graph_merge(lm_handle graph, lm_handle* all) {
  return guarded([&] {
    require_pointer(all, "merged");
    const Reading<GraphObject> object(graph);
    require_space(object->dimension());
    const auto& file = file_in<3>(*object);
    require_points(file.graph);
    make_object<GraphObject>(all, merged(file));
  });
}
