// Changes: lists of slots, and fields that are carried through them.
#include "change.hpp"

#include <string>

namespace lm {

template <int D>
ChangeIn<D>::ChangeIn(mesher::DomainUpdate<D> update, const mesher::LiveMesh<D>& live,
                      std::size_t point_slots_before)
    : calls_(update.calls),
      point_slots_before_(point_slots_before),
      point_slots_(live.vertex_slots()),
      cell_slots_(live.simplex_slots()),
      transfer_(update, live) {
  slots_ = std::move(update.slots);
  kept_ = std::move(update.kept);
  added_at_ = std::move(update.vertices_added);
  removed_at_ = std::move(update.vertices_removed);
}

template <int D>
auto ChangeIn<D>::interpolation() -> const All& {
  const std::lock_guard lock(making_);
  if (!interpolation_) interpolation_.emplace(transfer_.interpolation());
  return *interpolation_;
}

template <int D>
lm_array ChangeIn<D>::array(std::int32_t field) {
  using One = mesher::Interpolated<D>;
  switch (field) {
    case LM_CHANGE_POINTS_ADDED:
      return rows_of(slots_.vertices_added);
    case LM_CHANGE_POINTS_REMOVED:
      return rows_of(slots_.vertices_removed);
    case LM_CHANGE_CELLS_ADDED:
      return rows_of(slots_.simplices_added);
    case LM_CHANGE_CELLS_REMOVED:
      return rows_of(slots_.simplices_removed);
    case LM_CHANGE_KEPT_ADDED:
      return rows_of(kept_.added);
    case LM_CHANGE_KEPT_REMOVED:
      return rows_of(kept_.removed);
    case LM_CHANGE_FACETS_ADDED:
      return rows_of(D == 2 ? slots_.edges_added : slots_.faces_added);
    case LM_CHANGE_FACETS_REMOVED:
      return rows_of(D == 2 ? slots_.edges_removed : slots_.faces_removed);
    case LM_CHANGE_FROM:
      return member_of(
          std::span(interpolation()), [](const One& v) -> auto& { return v.from; });
    case LM_CHANGE_WEIGHTS:
      return member_of(
          std::span(interpolation()), [](const One& v) -> auto& { return v.weights; });
    case LM_CHANGE_POINTS_ADDED_AT:
      return rows_of(added_at_);
    case LM_CHANGE_POINTS_REMOVED_AT:
      return rows_of(removed_at_);
    case LM_CHANGE_KINDS_CHANGED:
      return member_of(
          std::span<const mesher::SlotChange::Kind>(slots_.kinds_changed),
          [](const auto& kind) -> auto& { return kind.vertex; });
    default:
      fail_unknown_field(field);
  }
}

template <int D>
lm_change_info ChangeIn<D>::info() const noexcept {
  lm_change_info all{};
  all.dimension = D;
  all.point_slots = point_slots_;
  all.cell_slots = cell_slots_;
  all.executed = calls_.executed;
  all.reused = calls_.reused;
  all.point_slots_before = point_slots_before_;
  return all;
}

namespace {

void require_rows(std::size_t rows, std::uint64_t slots, const char* when) {
  if (rows >= slots) return;
  throw Failure(LM_BAD_ARGUMENT, "the field has " + std::to_string(rows) + " rows for " +
                                     std::to_string(slots) + " point slots " + when);
}

}  // namespace

template <int D>
void ChangeIn<D>::transfer(std::size_t columns, const double* before, std::size_t rows_before,
                           double* after, std::size_t rows_after) {
  require_rows(rows_before, point_slots_before_, "before the update");
  require_rows(rows_after, point_slots_, "after the update");
  for (const auto& v : interpolation()) {
    for (std::size_t k = 0; k < columns; ++k) {
      double value = 0;
      for (std::size_t i = 0; i <= D; ++i) {
        if (v.weights[i] > 0) value += v.weights[i] * before[v.from[i] * columns + k];
      }
      after[v.vertex * columns + k] = value;
    }
  }
}

template class ChangeIn<2>;
template class ChangeIn<3>;

namespace {

template <class Visit>
void look(lm_handle handle, Visit&& visit) {
  const Reading<ChangeObject> object(handle);
  std::visit([&](const auto& change) { visit(*change); }, object->change);
}

}  // namespace
}  // namespace lm

using namespace lm;

lm_status lm_change_describe(lm_handle change, lm_change_info* info) {
  return guarded([&] {
    require_struct(info, "info");
    look(change, [&](const auto& in) { give_struct(in.info(), info); });
  });
}

lm_status lm_change_array(lm_handle change, int32_t field, lm_array* array) {
  return guarded([&] {
    require_struct(array, "array");
    look(change, [&](auto& in) { give_struct(in.array(field), array); });
  });
}

lm_status lm_change_transfer(lm_handle change, size_t columns, const double* before,
                             size_t rows_before, double* after, size_t rows_after) {
  return guarded([&] {
    require_array(before, rows_before, "before");
    require_array(after, rows_after, "after");
    if (columns == 0) throw Failure(LM_BAD_ARGUMENT, "columns is 0");
    look(change, [&](auto& in) { in.transfer(columns, before, rows_before, after, rows_after); });
  });
}
