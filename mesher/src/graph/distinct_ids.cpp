// The first id in a file that stood before.
#include "graph/distinct_ids.hpp"

#include <algorithm>
#include <utility>

namespace mesher {

void require_distinct(const Named& all) {
  std::vector<std::pair<FeatureId, std::size_t>> order;
  for (std::size_t i = 0; i < all.ids.size(); ++i) order.emplace_back(all.ids[i], i);
  std::sort(order.begin(), order.end());
  std::size_t earlier = 0, later = all.ids.size();
  for (std::size_t k = 1; k < order.size(); ++k) {
    if (order[k - 1].first != order[k].first || order[k].second >= later) continue;
    earlier = order[k - 1].second;
    later = order[k].second;
  }
  if (later == all.ids.size()) return;
  throw Error(ErrorCode::repeated_id,
              std::string(all.what) + " " +
                  std::to_string(static_cast<std::int64_t>(all.ids[later])) +
                  " is given twice, first on line " + std::to_string(all.places[earlier].line),
              all.places[later], {all.ids[later]});
}

}  // namespace mesher
