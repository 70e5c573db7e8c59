// The limits of size in Options, and their change in a box.
#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "geometry/box.hpp"
#include "mesher/mesh.hpp"

namespace mesher::detail {

template <int D>
struct AllLimits {
  SizeLimits<D> everywhere;
  AllBoxLimits<D> boxes;
  std::shared_ptr<const RegionLimits<D>> regions{};
  friend bool operator==(const AllLimits&, const AllLimits&) = default;

  [[nodiscard]] static AllLimits of(const Options<D>& options) {
    return {{options.max_measure, options.sizes}, options.box_limits, options.region_limits};
  }
  void apply_to(Options<D>& options) && noexcept {
    options.max_measure = everywhere.max_measure;
    options.sizes = std::move(everywhere.sizes);
    options.box_limits = std::move(boxes);
    options.region_limits = std::move(regions);
  }
  /// Whether something is limited, but for regions.
  [[nodiscard]] bool any() const {
    const SizeLimits<D> none;
    return everywhere != none ||
           std::any_of(boxes.begin(), boxes.end(), [&](const auto& b) { return b.limits != none; });
  }
  /// What limits a box, if it is one thing: null if there are several.
  [[nodiscard]] const SizeLimits<D>* within(const Box<D>& box) const {
    const auto meets = [&](const BoxLimits<D>& b) { return !is_empty(common(b.box, box)); };
    const auto last = std::find_if(boxes.rbegin(), boxes.rend(), meets);
    if (last == boxes.rend()) return &everywhere;
    return contains(last->box, box) ? &last->limits : nullptr;
  }
  /// These but in the box. What they are behind it is forgotten.
  void set_within(const Box<D>& box, const SizeLimits<D>& limits) {
    std::erase_if(boxes, [&](const BoxLimits<D>& b) { return contains(box, b.box); });
    const SizeLimits<D>* there = within(box);
    if (there == nullptr || *there != limits) boxes.push_back({box, limits});
  }
};

}  // namespace mesher::detail
