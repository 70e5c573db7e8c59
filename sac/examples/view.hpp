// A view of two tables: orders joined with their customers, small ones left out, summed by region,
// and the regions with the greatest sums. The tables are edited; the view follows.
//
// An order that comes, goes or changes: O(1) calls run again, and O(log n) inside of them. A
// customer that changes: those of the customer's orders, too.
#pragma once

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <utility>
#include <vector>

#include "sac/sac.hpp"

namespace examples::view {

struct Order {
  int customer = 0;
  int amount = 0;
  friend bool operator==(const Order&, const Order&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Order& o) {
    return out << o.customer << '/' << o.amount;
  }
};
using Ranked = std::pair<std::int64_t, int>;  // sum, region

template <class S>
struct Tables {
  template <class Host>
  explicit Tables(Host& host)
      : regions(host, "regions"), orders(host, "orders"), sums(host, "sums"), ranks(host, "ranks") {
    host.set_environment(this);
  }
  sac::Map<int, int, S> regions;  // by customer
  sac::Map<int, Order, S> orders;
  sac::Map<int, std::int64_t, sac::Sum, S> sums;  // by region
  sac::Map<Ranked, int, S> ranks;
};

inline constexpr int kLeast = 10;  // of an amount
inline constexpr std::size_t kBest = 3;

struct AddOrder {
  template <class S>
  void operator()(S& s, int, const Order& order) const {
    auto& t = s.template environment<Tables<S>>();
    const auto region = t.regions.find(s, order.customer);
    if (region && order.amount >= kLeast) t.sums.add(s, *region, order.amount);
  }
};

struct RankRegion {
  template <class S>
  void operator()(S& s, int region, std::int64_t sum) const {
    s.template environment<Tables<S>>().ranks.put(s, {sum, region}, region);
  }
};

struct BestRegions {
  static constexpr std::string_view kName = "best_regions";
  template <class S, class Result>
  void operator()(S& s, Result best) const {
    auto& t = s.template environment<Tables<S>>();
    t.orders.template for_each<AddOrder{}>(s);
    t.sums.template for_each<RankRegion{}>(s);
    std::vector<Ranked> regions;
    for (const auto& [ranked, region] : t.ranks.top(s, kBest)) regions.push_back(ranked);
    s.write(best, regions);
  }
};
inline constexpr BestRegions best_regions{};

}  // namespace examples::view
