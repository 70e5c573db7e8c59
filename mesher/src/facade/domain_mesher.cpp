// The facade of a mesh with its domain.
#include "mesher/domain_mesher.hpp"

#include "facade/domain_state.hpp"

namespace mesher {

struct DomainMesher::Impl : detail::DomainState {
  using DomainState::DomainState;
};

DomainMesher::DomainMesher(const Options<2>& options, Extent extent, RegionAreas areas)
    : impl_(std::make_unique<Impl>(options, extent, areas)) {}
DomainMesher::DomainMesher(DomainMesher&&) noexcept = default;
DomainMesher& DomainMesher::operator=(DomainMesher&&) noexcept = default;
DomainMesher::~DomainMesher() = default;

void DomainMesher::insert(FeatureId id, const Point<2>& point, std::int64_t marker) {
  impl_->insert(id, point, marker);
}
void DomainMesher::remove(FeatureId id) { impl_->remove(id); }
void DomainMesher::move(FeatureId id, const Point<2>& point) { impl_->move(id, point); }

void DomainMesher::insert_segment(FeatureId id, FeatureId from, FeatureId to, std::int64_t marker) {
  impl_->insert_line(id, {from, to}, marker);
}
void DomainMesher::insert_polyline(FeatureId id, const std::vector<FeatureId>& points,
                                   std::int64_t marker) {
  impl_->insert_line(id, points, marker);
}
void DomainMesher::remove_segment(FeatureId id) { impl_->remove_line(id); }

void DomainMesher::insert_seed(const Seed& seed) { impl_->insert_seed(seed); }
void DomainMesher::insert_hole(FeatureId id, const Point<2>& at) {
  impl_->insert_seed({{SeedKind::hole, id}, at, 0, {}});
}
void DomainMesher::insert_region(FeatureId id, const Point<2>& at, double attribute,
                                 std::optional<double> max_area) {
  impl_->insert_seed({{SeedKind::region, id}, at, attribute, max_area});
}
void DomainMesher::remove_seed(const SeedName& name) { impl_->remove_seed(name); }

void DomainMesher::limit(const SizeLimits<2>& limits) { impl_->limit(limits); }
void DomainMesher::limit(const Box<2>& box, const SizeLimits<2>& limits) {
  impl_->limit(box, limits);
}

void DomainMesher::discard_edits() noexcept {
  if (impl_->is_idle()) impl_->discard_edits();
}
DomainUpdate DomainMesher::update(const RunControl& control) { return impl_->update(control); }

Mesh<2> DomainMesher::mesh() const { return impl_->mesher().mesh(); }
DomainMesh DomainMesher::domain_mesh() const {
  return mesher::domain_mesh(mesh(), input(), impl_->extent());
}
Pslg DomainMesher::input() const { return impl_->input(); }

RegionLabel DomainMesher::label(const DomainChange::Corners& triangle) const {
  return impl_->follower() ? impl_->follower()->label(triangle) : RegionLabel();
}
bool DomainMesher::keeps(const DomainChange::Corners& triangle) const {
  return !impl_->follower() || impl_->follower()->keeps(triangle);
}
std::vector<SeedFault> DomainMesher::faults() const {
  return impl_->follower() ? impl_->follower()->faults() : std::vector<SeedFault>();
}

bool DomainMesher::contains(FeatureId id) const { return impl_->mesher().contains(id); }
bool DomainMesher::contains_line(FeatureId id) const { return impl_->mesher().contains_line(id); }
bool DomainMesher::contains_seed(const SeedName& name) const { return impl_->contains_seed(name); }

MeshStats DomainMesher::stats() const {
  MeshStats stats = impl_->mesher().stats();
  if (impl_->unlimited()) impl_->unlimited()->add_to(stats);
  return stats;
}
const Options<2>& DomainMesher::options() const { return impl_->mesher().options(); }
Extent DomainMesher::extent() const { return impl_->extent(); }

void DomainMesher::check_invariants() const {
  impl_->mesher().check_invariants();
  if (impl_->follower()) impl_->follower()->check_invariants();
  if (impl_->unlimited()) impl_->unlimited()->check_invariants();
}

}  // namespace mesher
