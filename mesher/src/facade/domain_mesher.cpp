// A mesher and a follower of its domain, brought up to date together: the follower has its say on a
// change while the mesher can still take it back.
#include "mesher/domain_mesher.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "domain/labels.hpp"
#include "facade/edited_table.hpp"

namespace mesher {
namespace {

using Markers = detail::EditedTable<FeatureId, std::int64_t>;

std::string words(const SeedName& seed) {
  return (seed.kind == SeedKind::hole ? "hole " : "region ") +
         std::to_string(static_cast<std::int64_t>(seed.id));
}

// Sets a marker, 0 for none, and makes the edit; or does neither.
template <class Make>
void mark(Markers& markers, FeatureId id, std::int64_t marker, Make make) {
  if (marker == 0 && markers.find(id) == nullptr) return make();
  const auto before = markers.edit_of(id);
  markers.set(id, marker == 0 ? std::nullopt : std::optional(marker));
  try {
    make();
  } catch (...) {
    markers.restore(id, before);
    throw;
  }
}

std::int64_t marker_of(const Markers& markers, FeatureId id) {
  const auto it = markers.committed().find(id);
  return it == markers.committed().end() ? 0 : it->second;
}

std::uint32_t index_of(const std::vector<Point<2>>& sorted, const Point<2>& p) {
  return static_cast<std::uint32_t>(std::lower_bound(sorted.begin(), sorted.end(), p) -
                                    sorted.begin());
}

// The mesh that a first run brings.
Mesh<2> mesh_of(const Change<2>& change) {
  Mesh<2> mesh;
  mesh.vertices = change.vertices_added;
  mesh.simplices.reserve(change.simplices_added.size());
  for (const auto& [a, b, c] : change.simplices_added) {
    const auto& all = mesh.vertices;
    mesh.simplices.push_back({index_of(all, a), index_of(all, b), index_of(all, c)});
  }
  return mesh;
}

std::vector<MeshEdge> walls_of(const Change<2>& change) {
  std::vector<MeshEdge> walls;
  for (const auto& e : change.edges_added) {
    const auto& all = change.vertices_added;
    walls.push_back({index_of(all, e.low), index_of(all, e.high), e.line, 0});
  }
  return walls;
}

std::vector<DomainEdits::Wall> ends_of(const std::vector<LineEdge<2>>& edges) {
  std::vector<DomainEdits::Wall> walls;
  for (const auto& e : edges) walls.push_back({e.low, e.high});
  return walls;
}

}  // namespace

struct DomainMesher::Impl {
  Impl(const Options<2>& options, Extent wanted) : mesher(options), extent(wanted) {}

  void insert_line(FeatureId id, const std::vector<FeatureId>& points, std::int64_t marker);
  void insert_seed(const Seed& seed);
  void remove_seed(const SeedName& name);
  void discard_edits() noexcept;

  void prepare();
  void commit() noexcept;
  DomainUpdate update(const RunControl& control);
  [[nodiscard]] DomainChange follow(const Change<2>& change);
  [[nodiscard]] DomainChange begin(const Change<2>& change);

  [[nodiscard]] Pslg input() const;

  Mesher<2> mesher;
  Extent extent;
  Markers point_markers, line_markers;
  detail::EditedTable<SeedName, Seed> seeds;
  std::optional<DomainFollower> follower;  // from the first line or seed on
  bool needs_follower = false;             // there are edits to follow
  bool ran = false;
};

// --- Edits -----------------------------------------------------------------------------------

void DomainMesher::Impl::insert_line(FeatureId id, const std::vector<FeatureId>& points,
                                     std::int64_t marker) {
  mark(line_markers, id, marker, [&] { mesher.insert_polyline(id, points); });
  needs_follower = true;
}

void DomainMesher::Impl::insert_seed(const Seed& seed) {
  detail::check_seed(seed);
  if (seeds.find(seed.name) != nullptr) {
    throw Error(ErrorCode::repeated_id, words(seed.name) + " is there already", {}, {seed.name.id});
  }
  seeds.set(seed.name, seed);
  needs_follower = true;
}

void DomainMesher::Impl::remove_seed(const SeedName& name) {
  if (seeds.find(name) == nullptr) {
    throw Error(ErrorCode::unknown_id, words(name) + " is not there", {}, {name.id});
  }
  seeds.set(name, std::nullopt);
}

void DomainMesher::Impl::discard_edits() noexcept {
  mesher.discard_edits();
  point_markers.discard();
  line_markers.discard();
  seeds.discard();
  needs_follower = false;
}

// --- Updates ---------------------------------------------------------------------------------

// So that commit() needs no memory, and follow() has somebody to follow.
void DomainMesher::Impl::prepare() {
  point_markers.prepare();
  line_markers.prepare();
  seeds.prepare();
  if (needs_follower && ran && !follower) {
    follower.emplace(mesher.mesh(), std::vector<MeshEdge>(), std::vector<Seed>(), extent);
  }
}

void DomainMesher::Impl::commit() noexcept {
  point_markers.commit();
  line_markers.commit();
  seeds.commit();
  needs_follower = false;
  ran = true;
}

// The first run. The follower is there only if the run is accepted: nothing throws after it.
DomainChange DomainMesher::Impl::begin(const Change<2>& change) {
  std::vector<Seed> all;
  seeds.for_each_edit([&](const SeedName&, const Seed*, const Seed* to) { all.push_back(*to); });
  DomainFollower first(mesh_of(change), walls_of(change), all, extent);
  DomainChange domain;
  for (const auto& triangle : change.simplices_added) {
    if (first.keeps(triangle)) domain.kept_added.push_back(triangle);
  }
  follower.emplace(std::move(first));
  return domain;
}

DomainChange DomainMesher::Impl::follow(const Change<2>& change) {
  if (!follower && needs_follower) return begin(change);
  if (!follower) return {change.simplices_added, change.simplices_removed, {}, 0};
  DomainEdits edits;
  edits.walls_out = ends_of(change.edges_removed);
  edits.walls_in = ends_of(change.edges_added);
  seeds.for_each_edit([&](const SeedName& name, const Seed* was, const Seed* is) {
    if (was != nullptr) edits.seeds_out.push_back(name);
    if (is != nullptr) edits.seeds_in.push_back(*is);
  });
  return follower->update(change, edits);
}

DomainUpdate DomainMesher::Impl::update(const RunControl& control) {
  DomainUpdate update;
  try {
    prepare();
    static_cast<Change<2>&>(update) =
        mesher.update(control, [&](const Change<2>& change) { update.domain = follow(change); });
  } catch (const Error& error) {
    if (error.code() != ErrorCode::cancelled) discard_edits();
    throw;
  } catch (...) {
    discard_edits();
    throw;
  }
  commit();
  return update;
}

Pslg DomainMesher::Impl::input() const {
  Pslg graph;
  for (const auto& p : mesher.points()) {
    graph.points.push_back({p.id, p.at, marker_of(point_markers, p.id)});
  }
  for (auto& line : mesher.lines()) {
    const std::int64_t marker = marker_of(line_markers, line.id);
    if (line.points.size() == 2) {
      graph.segments.push_back({line.id, line.points[0], line.points[1], marker});
    } else {
      graph.polylines.push_back({line.id, std::move(line.points), marker});
    }
  }
  for (const auto& [name, seed] : seeds.committed()) {
    if (name.kind == SeedKind::hole) {
      graph.holes.push_back({name.id, seed.at});
    } else {
      graph.regions.push_back({name.id, seed.at, seed.attribute, seed.max_area});
    }
  }
  return graph;
}

// --- The facade ------------------------------------------------------------------------------

DomainMesher::DomainMesher(const Options<2>& options, Extent extent)
    : impl_(std::make_unique<Impl>(options, extent)) {}
DomainMesher::DomainMesher(DomainMesher&&) noexcept = default;
DomainMesher& DomainMesher::operator=(DomainMesher&&) noexcept = default;
DomainMesher::~DomainMesher() = default;

void DomainMesher::insert(FeatureId id, const Point<2>& point, std::int64_t marker) {
  mark(impl_->point_markers, id, marker, [&] { impl_->mesher.insert(id, point); });
}
void DomainMesher::remove(FeatureId id) {
  mark(impl_->point_markers, id, 0, [&] { impl_->mesher.remove(id); });
}
void DomainMesher::move(FeatureId id, const Point<2>& point) { impl_->mesher.move(id, point); }

void DomainMesher::insert_segment(FeatureId id, FeatureId from, FeatureId to, std::int64_t marker) {
  impl_->insert_line(id, {from, to}, marker);
}
void DomainMesher::insert_polyline(FeatureId id, const std::vector<FeatureId>& points,
                                   std::int64_t marker) {
  impl_->insert_line(id, points, marker);
}
void DomainMesher::remove_segment(FeatureId id) {
  mark(impl_->line_markers, id, 0, [&] { impl_->mesher.remove_segment(id); });
}

void DomainMesher::insert_seed(const Seed& seed) { impl_->insert_seed(seed); }
void DomainMesher::insert_hole(FeatureId id, const Point<2>& at) {
  impl_->insert_seed({{SeedKind::hole, id}, at, 0, {}});
}
void DomainMesher::insert_region(FeatureId id, const Point<2>& at, double attribute,
                                 std::optional<double> max_area) {
  impl_->insert_seed({{SeedKind::region, id}, at, attribute, max_area});
}
void DomainMesher::remove_seed(const SeedName& name) { impl_->remove_seed(name); }

void DomainMesher::discard_edits() noexcept { impl_->discard_edits(); }
DomainUpdate DomainMesher::update(const RunControl& control) { return impl_->update(control); }

Mesh<2> DomainMesher::mesh() const { return impl_->mesher.mesh(); }
DomainMesh DomainMesher::domain_mesh() const {
  return mesher::domain_mesh(mesh(), input(), impl_->extent);
}
Pslg DomainMesher::input() const { return impl_->input(); }

RegionLabel DomainMesher::label(const DomainChange::Corners& triangle) const {
  return impl_->follower ? impl_->follower->label(triangle) : RegionLabel();
}
bool DomainMesher::keeps(const DomainChange::Corners& triangle) const {
  return !impl_->follower || impl_->follower->keeps(triangle);
}
std::vector<SeedFault> DomainMesher::faults() const {
  return impl_->follower ? impl_->follower->faults() : std::vector<SeedFault>();
}

bool DomainMesher::contains(FeatureId id) const { return impl_->mesher.contains(id); }
bool DomainMesher::contains_line(FeatureId id) const { return impl_->mesher.contains_line(id); }
bool DomainMesher::contains_seed(const SeedName& name) const {
  return impl_->seeds.find(name) != nullptr;
}

MeshStats DomainMesher::stats() const { return impl_->mesher.stats(); }
const Options<2>& DomainMesher::options() const { return impl_->mesher.options(); }
Extent DomainMesher::extent() const { return impl_->extent; }

void DomainMesher::check_invariants() const {
  impl_->mesher.check_invariants();
  if (impl_->follower) impl_->follower->check_invariants();
}

}  // namespace mesher
