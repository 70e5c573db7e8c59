// The facade of a mesh that follows edits, with its regions.
#include "mesher/mesher.hpp"

#include "facade/domain_state.hpp"
#include "facade/graph_runs.hpp"
#include "facade/settled.hpp"

namespace mesher {

namespace {

template <int D>
Options<D> kept_by_mesher(const Options<D>& options) {
  Options<D> all = detail::settled(options);
  if (all.algorithm != Algorithm::automatic && all.algorithm != Algorithm::gap_balls) {
    throw Error(ErrorCode::bad_option, "a mesh that follows edits is that of gap-balls, not of " +
                                           std::string(name_of(all.algorithm)));
  }
  all.algorithm = Algorithm::gap_balls;
  return all;
}

}  // namespace

template <int D>
struct Mesher<D>::Impl : detail::DomainState<D> {
  using detail::DomainState<D>::DomainState;
};

template <int D>
Mesher<D>::Mesher(const Options<D>& options)
    : impl_(std::make_unique<Impl>(kept_by_mesher(options))) {}
template <int D>
Mesher<D>::Mesher(Mesher&&) noexcept = default;
template <int D>
Mesher<D>& Mesher<D>::operator=(Mesher&&) noexcept = default;
template <int D>
Mesher<D>::~Mesher() = default;

template <int D>
void Mesher<D>::insert(PointId id, const Point<D>& point, std::int64_t marker) {
  impl_->insert(id, point, marker);
}
template <int D>
void Mesher<D>::insert(const Graph<D>& graph) {
  if (!impl_->is_idle()) throw sac::UsageError("a mesher is edited while it updates");
  try {
    announce(graph, *this);
  } catch (...) {
    impl_->discard_edits();
    throw;
  }
}
template <int D>
void Mesher<D>::remove(PointId id) {
  impl_->remove(id);
}
template <int D>
void Mesher<D>::move(PointId id, const Point<D>& point) {
  impl_->move(id, point);
}

template <int D>
void Mesher<D>::insert_segment(LineId id, PointId from, PointId to, std::int64_t marker) {
  impl_->insert_line(id, {from, to}, marker);
}
template <int D>
void Mesher<D>::insert_polyline(LineId id, const std::vector<PointId>& points,
                                std::int64_t marker) {
  impl_->insert_line(id, points, marker);
}
template <int D>
void Mesher<D>::remove_line(LineId id) {
  impl_->remove_line(id);
}

template <int D>
void Mesher<D>::insert_polygon(const Polygon& polygon) requires(D == 3) {
  impl_->insert_polygon(polygon);
}
template <int D>
void Mesher<D>::remove_polygon(PolygonId id) requires(D == 3) {
  impl_->remove_polygon(id);
}

template <int D>
void Mesher<D>::insert_seed(const Seed<D>& seed) {
  impl_->insert_seed(seed);
}
template <int D>
void Mesher<D>::remove_seed(const SeedId& name) {
  impl_->remove_seed(name);
}

template <int D>
void Mesher<D>::limit(const SizeLimits<D>& limits) {
  impl_->limit(limits);
}
template <int D>
void Mesher<D>::limit(const Box<D>& box, const SizeLimits<D>& limits) {
  impl_->limit(box, limits);
}

template <int D>
void Mesher<D>::discard_edits() noexcept {
  if (impl_->is_idle()) impl_->discard_edits();
}
template <int D>
DomainUpdate<D> Mesher<D>::update(const RunControl& control) {
  return impl_->update(control);
}

template <int D>
Mesh<D> Mesher<D>::box_mesh() const {
  return impl_->mesher().mesh();
}
template <int D>
LiveMesh<D> Mesher<D>::live() const {
  return impl_->mesher().live();
}
template <int D>
void Mesher<D>::keep_slots(bool keep) {
  impl_->keep_slots(keep);
}
template <int D>
bool Mesher<D>::keeps_slots() const noexcept {
  return impl_->mesher().keeps_slots();
}
template <int D>
DomainMesh<D> Mesher<D>::domain_mesh() const {
  return mesher::domain_mesh(box_mesh(), input(), impl_->extent());
}
template <int D>
Graph<D> Mesher<D>::input() const {
  return impl_->input();
}
template <int D>
std::optional<GraphPoint<D>> Mesher<D>::point(PointId id) const {
  return impl_->point(id);
}
template <int D>
std::optional<Polyline> Mesher<D>::line(LineId id) const {
  return impl_->line(id);
}
template <int D>
std::optional<Polygon> Mesher<D>::polygon(PolygonId id) const requires(D == 3) {
  return impl_->polygon(id);
}
template <int D>
std::optional<Seed<D>> Mesher<D>::seed(const SeedId& id) const {
  return impl_->seed(id);
}

template <int D>
RegionLabel Mesher<D>::label(const typename DomainChange<D>::Corners& triangle) const {
  return impl_->follower() ? impl_->follower()->label(triangle) : RegionLabel();
}
template <int D>
bool Mesher<D>::keeps(const typename DomainChange<D>::Corners& triangle) const {
  return !impl_->follower() || impl_->follower()->keeps(triangle);
}
template <int D>
RegionLabel Mesher<D>::label(Slot simplex) const {
  return label(impl_->corners(simplex));
}
template <int D>
bool Mesher<D>::keeps(Slot simplex) const {
  return keeps(impl_->corners(simplex));
}
template <int D>
std::vector<SeedFault<D>> Mesher<D>::faults() const {
  return impl_->follower() ? impl_->follower()->faults() : std::vector<SeedFault<D>>();
}

template <int D>
bool Mesher<D>::contains(PointId id) const {
  return impl_->mesher().contains(id);
}
template <int D>
bool Mesher<D>::contains(LineId id) const {
  return impl_->mesher().contains_line(id);
}
template <int D>
bool Mesher<D>::contains(PolygonId id) const requires(D == 3) {
  return impl_->mesher().contains_polygon(id);
}
template <int D>
bool Mesher<D>::contains(const SeedId& id) const {
  return impl_->contains_seed(id);
}

template <int D>
MeshStats Mesher<D>::stats() const {
  MeshStats stats = impl_->mesher().stats();
  if (impl_->unlimited()) impl_->unlimited()->add_to(stats);
  return stats;
}
template <int D>
const Options<D>& Mesher<D>::options() const {
  return impl_->mesher().options();
}

template <int D>
const sac::Engine& Mesher<D>::engine() const {
  return impl_->mesher().engine();
}

template <int D>
void Mesher<D>::check_invariants() const {
  impl_->mesher().check_invariants();
  if (impl_->follower()) impl_->follower()->check_invariants();
  if (impl_->unlimited()) impl_->unlimited()->check_invariants();
}

template class Mesher<2>;
#ifndef MESHER_PLANE_ONLY
template class Mesher<3>;
#endif

}  // namespace mesher
