// The first id in a file that stood before.
#include "graph/distinct_ids.hpp"

#include <algorithm>
#include <utility>

namespace mesher {

void require_distinct(const Named& all) {
  std::vector<std::pair<Feature, std::size_t>> order;
  for (std::size_t i = 0; i < all.features.size(); ++i) order.emplace_back(all.features[i], i);
  std::sort(order.begin(), order.end());
  std::size_t earlier = 0, later = all.features.size();
  for (std::size_t k = 1; k < order.size(); ++k) {
    if (order[k - 1].first != order[k].first || order[k].second >= later) continue;
    earlier = order[k - 1].second;
    later = order[k].second;
  }
  if (later == all.features.size()) return;
  throw Error(ErrorCode::repeated_id,
              text_of(all.features[later]) + " is given twice, first on line " +
                  std::to_string(all.locations[earlier].line),
              all.locations[later], {all.features[later]});
}

}  // namespace mesher
