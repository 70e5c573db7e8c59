// The view of a live mesh.
#include "mesher/live_mesh.hpp"

#include "live/live_arrays.hpp"

namespace mesher {

template <int D>
std::span<const Point<D>> LiveMesh<D>::points() const noexcept {
  return arrays_->vertices().records();
}
template <int D>
std::span<const VertexKind> LiveMesh<D>::kinds() const noexcept {
  return arrays_->kinds();
}
template <int D>
auto LiveMesh<D>::simplices() const noexcept -> std::span<const Simplex> {
  return arrays_->simplices().records();
}
template <int D>
auto LiveMesh<D>::neighbours() const noexcept -> std::span<const Simplex> {
  return arrays_->neighbours();
}
template <int D>
auto LiveMesh<D>::edges() const noexcept -> std::span<const Edge> {
  return arrays_->edges().records();
}
template <int D>
auto LiveMesh<D>::faces() const noexcept -> std::span<const Face> {
  return arrays_->faces().records();
}

template <int D>
bool LiveMesh<D>::is_vertex(Slot slot) const noexcept {
  return arrays_->vertices().is_live(slot);
}
template <int D>
bool LiveMesh<D>::is_simplex(Slot slot) const noexcept {
  return arrays_->simplices().is_live(slot);
}
template <int D>
bool LiveMesh<D>::is_edge(Slot slot) const noexcept {
  return arrays_->edges().is_live(slot);
}
template <int D>
bool LiveMesh<D>::is_face(Slot slot) const noexcept {
  return arrays_->faces().is_live(slot);
}
template <int D>
std::size_t LiveMesh<D>::vertices() const noexcept {
  return arrays_->vertices().size();
}
template <int D>
std::size_t LiveMesh<D>::simplex_count() const noexcept {
  return arrays_->simplices().size();
}

template <int D>
Slot LiveMesh<D>::find(const Point<D>& vertex) const {
  return arrays_->vertices().find(vertex);
}
template <int D>
Slot LiveMesh<D>::find_simplex(const std::array<Point<D>, D + 1>& corners) const {
  return arrays_->find_simplex(corners);
}
template <int D>
Slot LiveMesh<D>::simplex_at(Slot vertex) const {
  SAC_EXPECTS(is_vertex(vertex));
  return arrays_->simplex_at(vertex);
}

template <int D>
auto LiveMesh<D>::compact() const -> Compact {
  return arrays_->compact();
}
template <int D>
std::size_t LiveMesh<D>::bytes() const noexcept {
  return arrays_->bytes();
}

template class LiveMesh<2>;
#ifndef MESHER_PLANE_ONLY
template class LiveMesh<3>;
#endif

}  // namespace mesher
