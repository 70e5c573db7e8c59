// The facade of a mesh with its domain.
#include "mesher/domain_mesher.hpp"

#include "facade/domain_state.hpp"

namespace mesher {

template <int D>
struct DomainMesherOf<D>::Impl : detail::DomainState<D> {
  using detail::DomainState<D>::DomainState;
};

template <int D>
DomainMesherOf<D>::DomainMesherOf(const Options<D>& options, Extent extent, RegionAreas areas)
    : impl_(std::make_unique<Impl>(options, extent, areas)) {}
template <int D>
DomainMesherOf<D>::DomainMesherOf(DomainMesherOf&&) noexcept = default;
template <int D>
DomainMesherOf<D>& DomainMesherOf<D>::operator=(DomainMesherOf&&) noexcept = default;
template <int D>
DomainMesherOf<D>::~DomainMesherOf() = default;

template <int D>
void DomainMesherOf<D>::insert(FeatureId id, const Point<D>& point, std::int64_t marker) {
  impl_->insert(id, point, marker);
}
template <int D>
void DomainMesherOf<D>::remove(FeatureId id) { impl_->remove(id); }
template <int D>
void DomainMesherOf<D>::move(FeatureId id, const Point<D>& point) { impl_->move(id, point); }

template <int D>
void DomainMesherOf<D>::insert_segment(FeatureId id, FeatureId from, FeatureId to, std::int64_t marker) {
  impl_->insert_line(id, {from, to}, marker);
}
template <int D>
void DomainMesherOf<D>::insert_polyline(FeatureId id, const std::vector<FeatureId>& points,
                                   std::int64_t marker) {
  impl_->insert_line(id, points, marker);
}
template <int D>
void DomainMesherOf<D>::remove_segment(FeatureId id) { impl_->remove_line(id); }

template <int D>
void DomainMesherOf<D>::insert_polygon(const Polygon& polygon, std::int64_t marker)
requires(D == 3)
{
  impl_->insert_polygon(polygon, marker);
}
template <int D>
void DomainMesherOf<D>::remove_polygon(FeatureId id)
requires(D == 3)
{
  impl_->remove_polygon(id);
}

template <int D>
void DomainMesherOf<D>::insert_seed(const SeedOf<D>& seed) { impl_->insert_seed(seed); }
template <int D>
void DomainMesherOf<D>::insert_hole(FeatureId id, const Point<D>& at) {
  impl_->insert_seed({{SeedKind::hole, id}, at, 0, {}});
}
template <int D>
void DomainMesherOf<D>::insert_region(FeatureId id, const Point<D>& at, double attribute,
                                 std::optional<double> max_measure) {
  impl_->insert_seed({{SeedKind::region, id}, at, attribute, max_measure});
}
template <int D>
void DomainMesherOf<D>::remove_seed(const SeedName& name) { impl_->remove_seed(name); }

template <int D>
void DomainMesherOf<D>::limit(const SizeLimits<D>& limits) {
  impl_->limit(limits);
}
template <int D>
void DomainMesherOf<D>::limit(const Box<D>& box, const SizeLimits<D>& limits) {
  impl_->limit(box, limits);
}

template <int D>
void DomainMesherOf<D>::discard_edits() noexcept {
  if (impl_->is_idle()) impl_->discard_edits();
}
template <int D>
DomainUpdateOf<D> DomainMesherOf<D>::update(const RunControl& control) { return impl_->update(control); }

template <int D>
Mesh<D> DomainMesherOf<D>::mesh() const { return impl_->mesher().mesh(); }
template <int D>
LiveMesh<D> DomainMesherOf<D>::live() const { return impl_->mesher().live(); }
template <int D>
void DomainMesherOf<D>::keep_slots(bool keep) { impl_->keep_slots(keep); }
template <int D>
bool DomainMesherOf<D>::keeps_slots() const noexcept { return impl_->mesher().keeps_slots(); }
template <int D>
DomainMeshOf<D> DomainMesherOf<D>::domain_mesh() const {
  return mesher::domain_mesh(mesh(), input(), impl_->extent());
}
template <int D>
GraphOf<D> DomainMesherOf<D>::input() const { return impl_->input(); }

template <int D>
RegionLabel DomainMesherOf<D>::label(const typename DomainChangeOf<D>::Corners& triangle) const {
  return impl_->follower() ? impl_->follower()->label(triangle) : RegionLabel();
}
template <int D>
bool DomainMesherOf<D>::keeps(const typename DomainChangeOf<D>::Corners& triangle) const {
  return !impl_->follower() || impl_->follower()->keeps(triangle);
}
template <int D>
RegionLabel DomainMesherOf<D>::label(Slot simplex) const {
  return label(impl_->corners(simplex));
}
template <int D>
bool DomainMesherOf<D>::keeps(Slot simplex) const {
  return keeps(impl_->corners(simplex));
}
template <int D>
std::vector<SeedFaultOf<D>> DomainMesherOf<D>::faults() const {
  return impl_->follower() ? impl_->follower()->faults() : std::vector<SeedFaultOf<D>>();
}

template <int D>
bool DomainMesherOf<D>::contains(FeatureId id) const { return impl_->mesher().contains(id); }
template <int D>
bool DomainMesherOf<D>::contains_line(FeatureId id) const { return impl_->mesher().contains_line(id); }
template <int D>
bool DomainMesherOf<D>::contains_polygon(FeatureId id) const {
  return impl_->mesher().contains_polygon(id);
}
template <int D>
bool DomainMesherOf<D>::contains_seed(const SeedName& name) const { return impl_->contains_seed(name); }

template <int D>
MeshStats DomainMesherOf<D>::stats() const {
  MeshStats stats = impl_->mesher().stats();
  if (impl_->unlimited()) impl_->unlimited()->add_to(stats);
  return stats;
}
template <int D>
const Options<D>& DomainMesherOf<D>::options() const { return impl_->mesher().options(); }
template <int D>
Extent DomainMesherOf<D>::extent() const { return impl_->extent(); }

template <int D>
void DomainMesherOf<D>::check_invariants() const {
  impl_->mesher().check_invariants();
  if (impl_->follower()) impl_->follower()->check_invariants();
  if (impl_->unlimited()) impl_->unlimited()->check_invariants();
}

template class DomainMesherOf<2>;
template class DomainMesherOf<3>;

}  // namespace mesher
