// The change of an update, behind a handle.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <variant>
#include <vector>

#include "arrays.hpp"
#include "handles.hpp"
#include "mesher/mesher.hpp"
#include "mesher/transfer.hpp"

namespace lm {

/// What the arrays of the interface show of a DomainUpdate; its other lists are dropped.
template <int D>
class ChangeIn {
 public:
  /// `live`: after the update; point_slots_before: how many it had before.
  ChangeIn(mesher::DomainUpdate<D> update, const mesher::LiveMesh<D>& live,
           std::size_t point_slots_before);

  /// Throws: Failure(LM_BAD_ARGUMENT).
  [[nodiscard]] lm_array array(std::int32_t field);
  [[nodiscard]] lm_change_info info() const noexcept;
  /// See lm_change_transfer(). Throws: Failure(LM_BAD_ARGUMENT).
  void transfer(std::size_t columns, const double* before, std::size_t rows_before, double* after,
                std::size_t rows_after);

 private:
  using All = std::vector<mesher::Interpolated<D>>;
  [[nodiscard]] const All& interpolation();

  mesher::SlotChange slots_;
  mesher::KeptSlots kept_;
  std::vector<mesher::Point<D>> added_at_, removed_at_;
  mesher::CallCounts calls_;
  std::uint64_t point_slots_before_, point_slots_, cell_slots_;
  mesher::Transfer<D> transfer_;
  std::mutex making_;
  std::optional<All> interpolation_;
};

struct ChangeObject final : Object {
  template <int D>
  ChangeObject(mesher::DomainUpdate<D> update, const mesher::LiveMesh<D>& live,
               std::size_t point_slots_before)
      : change(std::make_unique<ChangeIn<D>>(std::move(update), live, point_slots_before)) {}
  std::variant<std::unique_ptr<ChangeIn<2>>, std::unique_ptr<ChangeIn<3>>> change;
};

}  // namespace lm
