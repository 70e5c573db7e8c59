// Meshes: made from graphs, read and written, shown in arrays.
#include "mesh.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>

#include "cell_quality.hpp"
#include "control.hpp"
#include "graph.hpp"
#include "mesher/domain.hpp"
#include "mesher/improve.hpp"
#include "mesher/out_of_core.hpp"
#include "mesher/periodic.hpp"
#include "mesher/read.hpp"
#include "mesher/write.hpp"
#include "options.hpp"

namespace lm {
namespace {

using mesher::Feature;
using mesher::FeatureKind;
using mesher::GraphFile;
using mesher::GraphPoint;
using mesher::MeshData;

// A side of a cell, by its corners but the smallest.
template <int D>
struct Side {
  std::array<std::uint32_t, D - 1> others{};
  std::uint32_t cell = 0, across = 0;
  friend auto operator<=>(const Side&, const Side&) = default;
};

// Sides by their smallest corner: those of one corner are few, and are sorted.
template <int D>
class Sides {
  using Simplex = typename mesher::Mesh<D>::Simplex;

 public:
  explicit Sides(const mesher::Mesh<D>& mesh)
      : begin_(mesh.vertices.size() + 1), sides_(mesh.simplices.size() * (D + 1)) {
    for_each_side(mesh, [&](std::uint32_t least, const Side<D>&) { ++begin_[least + 1]; });
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    std::vector<std::size_t> end(begin_.begin(), begin_.end() - 1);
    for_each_side(mesh,
                  [&](std::uint32_t least, const Side<D>& side) { sides_[end[least]++] = side; });
  }

  // Calls visit(a, b) for each pair of sides with the same corners.
  template <class Visit>
  void for_each_pair(Visit&& visit) {
    for (std::size_t v = 0; v + 1 < begin_.size(); ++v) {
      const auto first = sides_.begin() + static_cast<std::ptrdiff_t>(begin_[v]);
      const auto last = sides_.begin() + static_cast<std::ptrdiff_t>(begin_[v + 1]);
      std::sort(first, last);
      for (auto it = first; it != last && it + 1 != last; ++it) {
        if (it->others == (it + 1)->others) visit(*it, *(it + 1));
      }
    }
  }

 private:
  template <class Visit>
  static void for_each_side(const mesher::Mesh<D>& mesh, Visit&& visit) {
    for (std::uint32_t t = 0; t < mesh.simplices.size(); ++t) {
      for (std::uint32_t i = 0; i <= D; ++i) {
        std::array<std::uint32_t, D> corners;
        for (std::uint32_t j = 0, k = 0; j <= D; ++j) {
          if (j != i) corners[k++] = mesh.simplices[t][j];
        }
        std::sort(corners.begin(), corners.end());
        Side<D> side{{}, t, i};
        std::copy(corners.begin() + 1, corners.end(), side.others.begin());
        visit(corners[0], side);
      }
    }
  }

  std::vector<std::size_t> begin_;
  std::vector<Side<D>> sides_;
};

void add(FlatFacets& all, const mesher::MeshEdge& edge) {
  all.corners.insert(all.corners.end(), {edge.low, edge.high});
  all.markers.push_back(edge.marker);
  all.features.push_back(edge.line ? LM_LINE : LM_NO_FEATURE);
  all.ids.push_back(edge.line ? static_cast<std::int64_t>(*edge.line) : 0);
}
void add(FlatFacets& all, const mesher::MeshFace& face) {
  all.corners.insert(all.corners.end(), face.corners.begin(), face.corners.end());
  all.markers.push_back(face.marker);
  all.features.push_back(face.polygon ? LM_POLYGON : LM_NO_FEATURE);
  all.ids.push_back(face.polygon ? static_cast<std::int64_t>(*face.polygon) : 0);
}

template <class Part>
FlatFacets flattened(const std::vector<Part>& parts) {
  FlatFacets all;
  for (const Part& part : parts) add(all, part);
  return all;
}

// The corners of a positively oriented cell but the i-th, counterclockwise seen from outside.
template <int D>
std::array<std::uint32_t, D> seen_from_outside(const typename mesher::Mesh<D>::Simplex& t,
                                               std::size_t i) {
  if constexpr (D == 2) {
    return {t[(i + 1) % 3], t[(i + 2) % 3]};
  } else {
    constexpr std::array<std::array<std::size_t, 3>, 4> kFaces{
        {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
    const auto& [a, b, c] = kFaces[i];
    return {t[a], t[b], t[c]};
  }
}

// The sides without a neighbour, where the mesh tells of no facets.
template <int D>
FlatFacets boundary(const MeshData<D>& mesh,
                    const std::vector<typename mesher::Mesh<D>::Simplex>& neighbours) {
  FlatFacets all;
  for (std::size_t t = 0; t < neighbours.size(); ++t) {
    for (std::size_t i = 0; i <= D; ++i) {
      if (neighbours[t][i] != LM_NONE) continue;
      const auto corners = seen_from_outside<D>(mesh.simplices[t], i);
      all.corners.insert(all.corners.end(), corners.begin(), corners.end());
    }
  }
  const std::size_t count = all.corners.size() / D;
  all.markers.assign(count, mesher::kBoundaryMarker);
  all.features.assign(count, LM_NO_FEATURE);
  all.ids.assign(count, 0);
  return all;
}

// The points of an input among vertices in lexicographic order.
template <int D>
std::vector<Feature> origins_of(const std::vector<mesher::Point<D>>& vertices,
                                std::vector<GraphPoint<D>> points) {
  std::vector<Feature> origins(vertices.size());
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.at < b.at; });
  std::size_t v = 0;
  for (const GraphPoint<D>& p : points) {
    while (v < vertices.size() && vertices[v] < p.at) ++v;
    if (v < vertices.size() && vertices[v] == p.at) origins[v] = p.id;
  }
  return origins;
}

// --- Making and reading ------------------------------------------------------------------------

template <int D>
bool has_limits(const mesher::Graph<D>& graph) {
  return std::any_of(graph.seeds.begin(), graph.seeds.end(),
                     [](const auto& seed) { return seed.max_measure.has_value(); });
}

std::vector<mesher::PeriodicMarkers> periodic_of(const lm_options* user, int dimension) {
  std::vector<mesher::PeriodicMarkers> pairs;
  if (user == nullptr) return pairs;
  const lm_options given = read_struct(user, "options");
  if (given.periodic_count > 0 && dimension == 3) {
    throw Failure(LM_BAD_ARGUMENT, "options->periodic is for the plane alone");
  }
  require_array(given.periodic, given.periodic_count, "options->periodic");
  for (std::size_t i = 0; i < given.periodic_count; ++i) {
    pairs.push_back({given.periodic[2 * i], given.periodic[2 * i + 1]});
  }
  return pairs;
}

// Nothing if it is not wanted.
std::optional<mesher::OutOfCore> out_of_core_of(const lm_options* user) {
  if (user == nullptr) return std::nullopt;
  const lm_options given = read_struct(user, "options");
  if (given.out_of_core == nullptr) {
    if (given.tiles == 0) return std::nullopt;
    throw Failure(LM_BAD_ARGUMENT, "options->tiles is for options->out_of_core");
  }
  if (*given.out_of_core == '\0') {
    throw Failure(LM_BAD_ARGUMENT, "options->out_of_core names no folder");
  }
  if (given.periodic_count > 0) {
    throw Failure(LM_BAD_ARGUMENT, "options->periodic is not for options->out_of_core");
  }
  mesher::OutOfCore how{.folder = given.out_of_core};
  how.tiles = static_cast<std::size_t>(given.tiles);
  if (given.threads != 0) how.threads = given.threads;
  return how;
}

template <int D>
mesher::Mesh<D> box_out_of_core(const mesher::Graph<D>& graph, mesher::Options<D> options,
                                const mesher::OutOfCore& how, const mesher::RunControl& control) {
  bool has_more = !graph.segments.empty() || !graph.polylines.empty();
  if constexpr (D == 3) has_more = has_more || !graph.polygons.empty();
  if (has_more) {
    throw mesher::Error(mesher::ErrorCode::unsupported,
                        "out of core points alone are meshed, without lines and polygons");
  }
  std::vector<mesher::PointId> ids;
  ids.reserve(graph.points.size());
  for (const auto& p : graph.points) ids.push_back(p.id);
  options.threads = 1;  // `how` has them
  return mesher::box_mesh_out_of_core<D>(mesher::places_of(graph), options, how, ids, nullptr,
                                         control);
}

// As mesher::mesh(), with periodic sides, and without flat tetrahedra, if that is wanted.
template <int D>
mesher::Meshed<D> meshed(const mesher::Graph<D>& graph, const mesher::Options<D>& options,
                         const std::vector<mesher::PeriodicMarkers>& periodic,
                         const std::optional<mesher::OutOfCore>& how, bool no_flat,
                         const mesher::RunControl& control) {
  if constexpr (D == 2) {
    if (!periodic.empty()) return mesher::periodic_mesh(graph, periodic, options, control);
  }
  if (!how && (D == 2 || !no_flat)) return mesher::mesh(graph, options, control);
  mesher::Meshed<D> made;
  mesher::Mesh<D> all = how ? box_out_of_core(graph, options, *how, control)
                            : mesher::box_mesh(graph, options, &made.report, control);
  if (how) made.report.algorithm = mesher::Algorithm::gap_balls;
  if constexpr (D == 3) {
    if (no_flat) {
      all = mesher::without_flat_tetrahedra(std::move(all), radius_edge_bound(options)).mesh;
    }
  }
  static_cast<mesher::DomainMesh<D>&>(made) =
      mesher::domain_mesh(std::move(all), graph, options.extent);
  return made;
}

template <int D>
lm_handle make(const GraphFile<D>& file, const lm_options* options, const lm_control* control) {
  mesher::Options<D> all = options_of<D>(options);
  if (!has_limits(file.graph)) all.region_areas = mesher::RegionAreas::ignored;  // a faster way
  const bool no_flat = options != nullptr && read_struct(options, "options").no_flat != 0;
  const auto periodic = periodic_of(options, D);
  const auto how = out_of_core_of(options);
  mesher::Meshed<D> made = with_locations(
      file, [&] { return meshed(file.graph, all, periodic, how, no_flat, control_of(control)); });
  const mesher::Algorithm algorithm = made.report.algorithm;
  const bool tells = !made.mesh.features.origins.empty();
  auto object =
      mesh_object<D>(std::move(made), tells ? std::vector<GraphPoint<D>>() : file.graph.points);
  object->algorithm = algorithm;
  return add_object(std::move(object));
}

template <int D>
lm_handle read(MeshData<D> data) {
  std::vector<std::string> notes;
  for (const auto& note : data.notes) notes.push_back(text_of(note.location) + ": " + note.text);
  auto object = std::make_shared<MeshObject>(std::in_place_index<D - 2>, std::move(data),
                                             std::vector<GraphPoint<D>>());
  object->notes = std::move(notes);
  return add_object(std::move(object));
}

// --- Names and second order ----------------------------------------------------------------------

mesher::GroupNames names_of(const lm_write_options& options) {
  mesher::GroupNames names;
  require_array(options.names, options.names_count, "options->names");
  const auto* bytes = reinterpret_cast<const unsigned char*>(options.names);
  for (std::size_t i = 0; i < options.names_count; ++i) {
    // The caller's structs are as far apart as the first says they are large.
    const auto* user = reinterpret_cast<const lm_name*>(bytes + i * options.names->size);
    const lm_name name = read_struct(user, "options->names");
    require_pointer(name.name, "options->names->name");
    if (name.kind == LM_NAME_FACETS) {
      names.facets[name.marker] = name.name;
    } else if (name.kind == LM_NAME_EDGES) {
      names.lines[name.marker] = name.name;
    } else if (name.kind == LM_NAME_CELLS && std::isfinite(name.region)) {
      names.regions[name.region + 0.0] = name.name;
    } else {
      throw Failure(LM_BAD_ARGUMENT, "no group has names of kind " + std::to_string(name.kind));
    }
  }
  return names;
}

mesher::MshVersion msh_version_of(const lm_write_options& options) {
  if (options.msh_version == 0 || options.msh_version == 41) return mesher::MshVersion::v4_1;
  if (options.msh_version == 22) return mesher::MshVersion::v2_2;
  throw Failure(LM_BAD_ARGUMENT,
                "msh_version is " + std::to_string(options.msh_version) + ", not 41 or 22");
}

// The i-th of facets, then edges, then cells.
lm_name name_at(const mesher::GroupNames& names, std::size_t i) {
  lm_name found{};
  const auto look_in = [&](const auto& map, std::int32_t kind, auto set) {
    if (found.name == nullptr && i < map.size()) {
      const auto at = std::next(map.begin(), static_cast<std::ptrdiff_t>(i));
      found.kind = kind;
      found.name = at->second.c_str();
      set(at->first);
    }
    i -= std::min(i, map.size());
  };
  const auto set_marker = [&](std::int64_t marker) { found.marker = marker; };
  look_in(names.facets, LM_NAME_FACETS, set_marker);
  if (found.name == nullptr) look_in(names.lines, LM_NAME_EDGES, set_marker);
  if (found.name == nullptr) {
    look_in(names.regions, LM_NAME_CELLS, [&](double region) { found.region = region; });
  }
  if (found.name == nullptr) throw Failure(LM_BAD_ARGUMENT, "there is no such name");
  return found;
}

template <int D>
lm_handle second_order(const MeshObject& object, const std::shared_ptr<MeshIn<D>>& in) {
  auto made = std::make_shared<MeshObject>(in->order() == 2 ? in : std::make_shared<MeshIn<D>>(in));
  made->notes = object.notes;
  made->algorithm = object.algorithm;
  made->keeps_all = object.keeps_all;
  return add_object(std::move(made));
}

// Calls visit(mesh) for the mesh of a handle, of its dimension.
template <class Visit>
void look(lm_handle handle, Visit&& visit) {
  const Reading<MeshObject> object(handle);
  std::visit([&](const auto& mesh) { visit(*object, *mesh); }, object->mesh);
}

}  // namespace

// --- What is made when it is asked for -----------------------------------------------------------

// What a mesh of second order has more than that of first order.
template <int D>
MeshIn<D>::MeshIn(std::shared_ptr<MeshIn> first)
    : MeshIn(first, mesher::SecondOrder<D>(first->data)) {}

template <int D>
MeshIn<D>::MeshIn(std::shared_ptr<MeshIn> first, const mesher::SecondOrder<D>& second)
    : data(with_midpoints(first->data, first->data.features, second)),
      cell_slots(first->cell_slots),
      first_(std::move(first)),
      second_(second) {
  nodes_.reserve(data.simplices.size());
  for (const Simplex& t : data.simplices) nodes_.push_back(second.nodes_of(t));
  if (first_->point_slots.empty()) return;
  point_slots = first_->point_slots;
  point_slots.resize(data.vertices.size(), LM_NONE);
}

// `columns`: corners of each, 2 or 3.
template <int D>
FlatFacets MeshIn<D>::with_nodes(const FlatFacets& corners, std::size_t columns) const {
  FlatFacets all = corners;
  all.corners.clear();
  for (std::size_t i = 0; i < corners.corners.size(); i += columns) {
    const std::uint32_t* const c = corners.corners.data() + i;
    if (columns == 2) {
      all.corners.insert(all.corners.end(), {c[0], c[1], second_->between(c[0], c[1])});
    } else {
      const auto nodes = second_->nodes_of(mesher::MeshFace{{c[0], c[1], c[2]}, {}, 0});
      all.corners.insert(all.corners.end(), nodes.begin(), nodes.end());
    }
  }
  return all;
}

template <int D>
auto MeshIn<D>::neighbours() -> const std::vector<Simplex>& {
  if (neighbours_) return *neighbours_;
  Simplex none;
  none.fill(LM_NONE);
  std::vector<Simplex> all(data.simplices.size(), none);
  Sides<D>(data).for_each_pair([&](const Side<D>& a, const Side<D>& b) {
    all[a.cell][a.across] = b.cell;
    all[b.cell][b.across] = a.cell;
  });
  return neighbours_.emplace(std::move(all));
}

template <int D>
const FlatFacets& MeshIn<D>::facets_made() {
  const std::lock_guard lock(making_);
  if (facets_) return *facets_;
  if (first_ != nullptr) return facets_.emplace(with_nodes(first_->facets_made(), D));
  if constexpr (D == 2) {
    if (!data.features.edges.empty()) return facets_.emplace(flattened(data.features.edges));
  } else {
    if (!data.features.faces.empty()) return facets_.emplace(flattened(data.features.faces));
  }
  return facets_.emplace(boundary<D>(data, neighbours()));
}

template <int D>
const FlatFacets& MeshIn<D>::edges_made() {
  if (D == 2) return facets_made();
  const std::lock_guard lock(making_);
  if (edges_) return *edges_;
  if (first_ != nullptr) return edges_.emplace(with_nodes(first_->edges_made(), 2));
  return edges_.emplace(flattened(data.features.edges));
}

template <int D>
const std::vector<Feature>& MeshIn<D>::origins() {
  if (!data.features.origins.empty()) return data.features.origins;
  if (!origins_ && first_ != nullptr) {
    const std::lock_guard lock(first_->making_);
    origins_.emplace(first_->origins());
    origins_->resize(data.vertices.size());
  }
  if (!origins_) {
    origins_.emplace(origins_of<D>(data.vertices, std::exchange(points_, {})));
  }
  return *origins_;
}

// In second order, of the vertices alone.
template <int D>
auto MeshIn<D>::periodic_made() -> const FlatSides& {
  if (periodic_) return *periodic_;
  FlatSides all;
  for (const mesher::PeriodicSides& sides : corners().features.periodic) {
    all.markers.push_back({sides.from, sides.to});
    all.translations.push_back(sides.translation);
    all.points.insert(all.points.end(), sides.vertices.begin(), sides.vertices.end());
    all.offsets.push_back(static_cast<std::int64_t>(all.points.size()));
  }
  return periodic_.emplace(std::move(all));
}

template <int D>
lm_array MeshIn<D>::array(std::int32_t field) {
  const std::lock_guard lock(making_);
  switch (field) {
    case LM_MESH_POINTS:
      return rows_of(data.vertices);
    case LM_MESH_CELLS:
      return first_ == nullptr ? rows_of(data.simplices) : rows_of(nodes_);
    case LM_MESH_NEIGHBORS:
      return rows_of(neighbours());
    case LM_MESH_POINT_KINDS:
      return member_of(
          std::span(data.kinds), [](const auto& kind) -> auto& { return kind; });
    case LM_MESH_POINT_MARKERS:
      if (!data.features.markers.empty()) return rows_of(data.features.markers);
      if (!no_markers_) no_markers_.emplace(data.vertices.size());
      return rows_of(*no_markers_);
    case LM_MESH_POINT_FEATURES:
      return member_of(
          std::span(origins()), [](const Feature& f) -> auto& { return f.kind; });
    case LM_MESH_POINT_FEATURE_IDS:
      return member_of(
          std::span(origins()), [](const Feature& f) -> auto& { return f.number; });
    case LM_MESH_CELL_REGIONS:
      if (!data.features.regions.empty()) return rows_of(data.features.regions);
      if (!no_regions_) no_regions_.emplace(data.simplices.size());
      return rows_of(*no_regions_);
    case LM_MESH_FACETS:
      return rows_of(facets_made().corners, first_ == nullptr ? D : D * (D + 1) / 2);
    case LM_MESH_FACET_MARKERS:
      return rows_of(facets_made().markers);
    case LM_MESH_FACET_FEATURES:
      return rows_of(facets_made().features);
    case LM_MESH_FACET_FEATURE_IDS:
      return rows_of(facets_made().ids);
    case LM_MESH_EDGES:
      return rows_of(edges_made().corners, first_ == nullptr ? 2 : 3);
    case LM_MESH_EDGE_MARKERS:
      return rows_of(edges_made().markers);
    case LM_MESH_EDGE_FEATURES:
      return rows_of(edges_made().features);
    case LM_MESH_EDGE_FEATURE_IDS:
      return rows_of(edges_made().ids);
    case LM_MESH_POINT_SLOTS:
      return rows_of(point_slots);
    case LM_MESH_CELL_SLOTS:
      return rows_of(cell_slots);
    case LM_MESH_PERIODIC_MARKERS:
      return rows_of(periodic_made().markers);
    case LM_MESH_PERIODIC_TRANSLATIONS:
      return rows_of(periodic_made().translations);
    case LM_MESH_PERIODIC_OFFSETS:
      return rows_of(periodic_made().offsets);
    case LM_MESH_PERIODIC_POINTS:
      return rows_of(periodic_made().points);
    default:
      fail_unknown_field(field);
  }
}

template <int D>
lm_array MeshIn<D>::quality(std::int32_t measure) {
  if (measure < 0 || measure > (D == 2 ? LM_MAX_ANGLE : LM_MAX_DIHEDRAL)) {
    throw Failure(LM_BAD_ARGUMENT, "measure " + std::to_string(measure) + " does not exist in " +
                                       std::to_string(D) + " dimensions");
  }
  const std::lock_guard lock(making_);
  auto& made = qualities_[static_cast<std::size_t>(measure)];
  if (made) return rows_of(*made);
  std::vector<double> all;
  all.reserve(data.simplices.size());
  for (const Simplex& t : data.simplices) {
    Corners<D> corners;
    for (std::size_t i = 0; i <= D; ++i) corners[i] = data.vertices[t[i]];
    all.push_back(quality_of<D>(corners, measure));
  }
  return rows_of(made.emplace(std::move(all)));
}

template class MeshIn<2>;
template class MeshIn<3>;

}  // namespace lm

using namespace lm;

lm_status lm_mesh_make(lm_handle graph, const lm_options* options, const lm_control* control,
                       lm_handle* mesh) {
  return guarded([&] {
    require_pointer(mesh, "mesh");
    const Reading<GraphObject> object(graph);
    *mesh =
        std::visit([&](const auto& file) { return make(file, options, control); }, object->file);
  });
}

lm_status lm_mesh_describe(lm_handle mesh, lm_mesh_info* info) {
  return guarded([&] {
    require_struct(info, "info");
    look(mesh, [&]<int D>(const MeshObject& object, MeshIn<D>& in) {
      lm_mesh_info all{};
      all.dimension = D;
      all.algorithm = static_cast<std::int32_t>(object.algorithm);
      all.points = in.data.vertices.size();
      all.cells = in.data.simplices.size();
      all.keeps_all = object.keeps_all;
      all.order = in.order();
      give_struct(all, info);
    });
  });
}

lm_status lm_mesh_array(lm_handle mesh, int32_t field, lm_array* array) {
  return guarded([&] {
    require_struct(array, "array");
    look(mesh, [&](const MeshObject&, auto& in) { give_struct(in.array(field), array); });
  });
}

lm_status lm_mesh_quality(lm_handle mesh, int32_t measure, lm_array* array) {
  return guarded([&] {
    require_struct(array, "array");
    look(mesh, [&](const MeshObject&, auto& in) { give_struct(in.quality(measure), array); });
  });
}

lm_status lm_mesh_write(lm_handle mesh, const char* path) {
  return guarded([&] {
    require_pointer(path, "path");
    look(mesh, [&](const MeshObject&, auto& in) {
      mesher::write_mesh(in.corners(), path, {.order = in.order()});
    });
  });
}

lm_status lm_mesh_write_as(lm_handle mesh, const char* path, const lm_write_options* options) {
  return guarded([&] {
    require_pointer(path, "path");
    const lm_write_options given =
        options == nullptr ? lm_write_options{} : read_struct(options, "options");
    const mesher::GroupNames names = names_of(given);
    const mesher::MshVersion msh = msh_version_of(given);
    look(mesh, [&](const MeshObject&, auto& in) {
      auto named = in.corners();
      if (given.only_these != 0) named.features.names = {};
      named.features.names.add(names);
      mesher::write_mesh(named, path, {.order = in.order(), .msh = msh});
    });
  });
}

lm_status lm_mesh_name_count(lm_handle mesh, size_t* count) {
  return guarded([&] {
    require_pointer(count, "count");
    look(mesh, [&](const MeshObject&, auto& in) {
      const mesher::GroupNames& names = in.corners().features.names;
      *count = names.facets.size() + names.lines.size() + names.regions.size();
    });
  });
}

lm_status lm_mesh_name_get(lm_handle mesh, size_t i, lm_name* name) {
  return guarded([&] {
    require_struct(name, "name");
    look(mesh, [&](const MeshObject&, auto& in) {
      give_struct(name_at(in.corners().features.names, i), name);
    });
  });
}

lm_status lm_mesh_second_order(lm_handle mesh, lm_handle* second) {
  return guarded([&] {
    require_pointer(second, "second");
    const Reading<MeshObject> object(mesh);
    *second = std::visit([&](const auto& in) { return second_order(*object, in); }, object->mesh);
  });
}

lm_status lm_mesh_read(const char* path, int32_t dimension, lm_handle* mesh) {
  return guarded([&] {
    require_pointer(path, "path");
    require_pointer(mesh, "mesh");
    if (dimension == 2) {
      *mesh = read(mesher::read_mesh<2>(path));
    } else if (dimension == 3) {
      *mesh = read(mesher::read_mesh<3>(path));
    } else if (dimension == 0) {
      *mesh = std::visit([](auto&& data) { return read(std::move(data)); },
                         mesher::read_any_mesh(path));
    } else {
      fail_dimension(dimension);
    }
  });
}
