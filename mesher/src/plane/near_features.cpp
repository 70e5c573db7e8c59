// Insertion into three places, and words.
#include "plane/near_features.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace mesher::detail {

void NearFeatures::show(const Point<2>& a, const Point<2>& b, SegmentHandle s,
                        VertexHandle v) noexcept {
  const auto is_shown = [&](const Feature& f) { return f.segment == s && f.point == v; };
  if (std::any_of(all().begin(), all().end(), is_shown)) return;
  nearest_[count_] = {distance2(place_, a, b), s, a, b, v};
  const auto key = [](const Feature& f) {
    return std::tuple(f.distance2, f.segment != 0, f.a, f.b);
  };
  for (std::size_t i = count_; i > 0 && key(nearest_[i]) < key(nearest_[i - 1]); --i) {
    std::swap(nearest_[i], nearest_[i - 1]);
  }
  count_ = std::min(count_ + 1, nearest_.size() - 1);
}

std::size_t NearFeatures::count_within(double radius) const noexcept {
  const auto is_within = [&](const Feature& f) { return f.distance2 <= radius * radius; };
  return static_cast<std::size_t>(std::count_if(all().begin(), all().end(), is_within));
}

NamedFeatures NearFeatures::named(const Names& names) const {
  NamedFeatures named;
  auto& features = named.features;  // segments of a polyline have one id
  for (const Feature& f : all()) {
    const mesher::Feature feature = f.segment != 0 ? mesher::Feature(names.line(f.segment))
                                                   : mesher::Feature(names.point(f.point));
    if (std::find(features.begin(), features.end(), feature) != features.end()) continue;
    named.text += (features.empty() ? "" : ", ") + text_of(feature);
    features.push_back(feature);
  }
  if (named.text.empty()) named.text = "features";
  return named;
}

}  // namespace mesher::detail
