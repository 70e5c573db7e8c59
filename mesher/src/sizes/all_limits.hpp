// All that Options say of limits of size, and how that changes in a box.
#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "geometry/box.hpp"
#include "mesher/mesh.hpp"

namespace mesher::detail {

struct AllLimits {
  SizeLimits<2> everywhere;
  AllBoxLimits<2> boxes;
  std::shared_ptr<const RegionLimits> regions{};
  friend bool operator==(const AllLimits&, const AllLimits&) = default;

  [[nodiscard]] static AllLimits of(const Options<2>& options) {
    return {{options.max_area, options.sizes}, options.box_limits, options.region_limits};
  }
  void apply_to(Options<2>& options) && noexcept {
    options.max_area = everywhere.max_area;
    options.sizes = std::move(everywhere.sizes);
    options.box_limits = std::move(boxes);
    options.region_limits = std::move(regions);
  }
  /// Whether something is limited, but for regions.
  [[nodiscard]] bool any() const {
    const SizeLimits<2> none;
    return everywhere != none ||
           std::any_of(boxes.begin(), boxes.end(), [&](const auto& b) { return b.limits != none; });
  }
  /// What limits a box, if it is one thing: null if there are several.
  [[nodiscard]] const SizeLimits<2>* within(const Box<2>& box) const {
    const auto meets = [&](const BoxLimits<2>& b) { return !is_empty(common(b.box, box)); };
    const auto last = std::find_if(boxes.rbegin(), boxes.rend(), meets);
    if (last == boxes.rend()) return &everywhere;
    return contains(last->box, box) ? &last->limits : nullptr;
  }
  /// These but in the box. What they are behind it is forgotten.
  void set_within(const Box<2>& box, const SizeLimits<2>& limits) {
    std::erase_if(boxes, [&](const BoxLimits<2>& b) { return contains(box, b.box); });
    const SizeLimits<2>* there = within(box);
    if (there == nullptr || *there != limits) boxes.push_back({box, limits});
  }
};

}  // namespace mesher::detail
