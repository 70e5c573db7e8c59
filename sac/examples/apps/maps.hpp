// The examples on maps (sac/examples), as Apps (app.hpp).
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "../differences.hpp"
#include "../leaders.hpp"
#include "../range_counts.hpp"
#include "../view.hpp"
#include "app.hpp"

namespace apps {

// A table of rows by key, and an edit of it: a row, or none.
template <class Row>
using Table = std::map<int, Row>;
template <class Row>
struct RowEdit {
  int key;
  std::optional<Row> row;
};

template <class Row>
RowEdit<Row> old_row(const Table<Row>& table, int key) {
  const auto at = table.find(key);
  return {key, at != table.end() ? std::optional(at->second) : std::nullopt};
}
template <class Row>
void apply_row(Table<Row>& table, const RowEdit<Row>& edit) {
  table.erase(edit.key);
  if (edit.row) table.emplace(edit.key, *edit.row);
}
// A map of a host, edited alike. `value(row)` is what the map has for it.
template <class Map, class Row, class Value>
void edit_map(Map& map, const RowEdit<Row>& edit, Value&& value) {
  if (edit.row) {
    map.set(edit.key, value(*edit.row));
  } else if (map.find(edit.key) != nullptr) {
    map.erase(edit.key);
  }
}
template <class Map, class Row>
void edit_map(Map& map, const RowEdit<Row>& edit) {
  edit_map(map, edit, [](const Row& row) { return row; });
}
template <class Row, class Make>
Table<Row> random_table(Random& random, int rows, int keys, Make&& make) {
  Table<Row> table;
  for (int i = 0; i < rows; ++i) table.insert_or_assign(random(keys), make(random));
  return table;
}

// --- View ----------------------------------------------------------------------------------------

struct ViewApp {
  static constexpr const char* kName = "view";

  struct Input {
    int size = 0;
    Table<int> regions;
    Table<examples::view::Order> orders;
  };
  struct Edit {
    std::optional<RowEdit<int>> region;
    std::optional<RowEdit<examples::view::Order>> order;
  };

  static int customers(int size) { return size / 3 + 2; }
  static int random_region(Random& random) { return random(12); }
  static examples::view::Order random_order(Random& random, int size) {
    return {random(customers(size)), random(50)};
  }
  static Input random_input(Random& random, int size) {
    return {size, random_table<int>(random, customers(size), customers(size), random_region),
            random_table<examples::view::Order>(random, size, 2 * size + 1,
                                                [&](Random& r) { return random_order(r, size); })};
  }
  static Edit random_edit(Random& random, const Input& input) {
    const bool goes = random(3) == 0;
    if (random(8) == 0) {
      const int key = random(customers(input.size));
      return {RowEdit<int>{key, goes ? std::nullopt : std::optional(random_region(random))}, {}};
    }
    const int key = random(2 * input.size + 1);
    return {{},
            RowEdit<examples::view::Order>{
                key, goes ? std::nullopt : std::optional(random_order(random, input.size))}};
  }
  static Edit inverse(const Input& before, const Edit& edit) {
    if (edit.region) return {old_row(before.regions, edit.region->key), {}};
    return {{}, old_row(before.orders, edit.order->key)};
  }
  static void apply(Input& input, const Edit& edit) {
    if (edit.region) apply_row(input.regions, *edit.region);
    if (edit.order) apply_row(input.orders, *edit.order);
  }
  static std::vector<examples::view::Ranked> oracle(const Input& input) {
    std::map<int, std::int64_t> sums;
    for (const auto& [id, order] : input.orders) {
      const auto region = input.regions.find(order.customer);
      if (region == input.regions.end() || order.amount < examples::view::kLeast) continue;
      sums[region->second] += order.amount;
    }
    std::vector<examples::view::Ranked> best;
    for (const auto& [region, sum] : sums) best.emplace_back(sum, region);
    std::sort(best.rbegin(), best.rend());
    best.resize(std::min(best.size(), examples::view::kBest));
    return best;
  }

  template <class Host>
  class World {
   public:
    World(Host& host, const Input& input)
        : host_(host),
          tables_(host),
          best_(host.template cell<std::vector<examples::view::Ranked>>()) {
      for (const auto& [customer, region] : input.regions) tables_.regions.set(customer, region);
      for (const auto& [id, order] : input.orders) tables_.orders.set(id, order);
      host.template run<examples::view::best_regions>(best_);
    }
    void edit(const Edit& edit) {
      if (edit.region) edit_map(tables_.regions, *edit.region);
      if (edit.order) edit_map(tables_.orders, *edit.order);
    }
    auto result() { return host_.get(best_); }
    template <class Recorder>
    void name(Recorder& recorder) const {
      recorder.name(best_, "best", 0);
    }

   private:
    using S = ScopeOf<Host>;
    Host& host_;
    examples::view::Tables<S> tables_;
    typename S::template ModType<std::vector<examples::view::Ranked>> best_;
  };
};

// --- Range counts --------------------------------------------------------------------------------

struct RangesApp {
  static constexpr const char* kName = "range counts";
  using Point = std::pair<int, int>;
  using Rectangle = examples::range_counts::Rectangle;

  struct Input {
    int size = 0;
    Table<Point> points;
    Table<Rectangle> rectangles;
  };
  struct Edit {
    std::optional<RowEdit<Point>> point;
    std::optional<RowEdit<Rectangle>> rectangle;
  };

  // The plane grows with the input: a rectangle has a constant number of points.
  static constexpr int kWidth = 80;
  static int height(int size) { return size / 2 + 20; }
  static Point random_point(Random& random, int size) {
    return {random(kWidth), random(height(size))};
  }
  static Rectangle random_rectangle(Random& random, int size) {
    const int x = random(kWidth), y = random(height(size));
    return {x, x + random(50), y, y + random(12)};
  }
  static int rectangles(int size) { return size / 2 + 1; }
  static Input random_input(Random& random, int size) {
    const auto point = [&](Random& r) { return random_point(r, size); };
    const auto rectangle = [&](Random& r) { return random_rectangle(r, size); };
    return {size, random_table<Point>(random, size, 2 * size + 1, point),
            random_table<Rectangle>(random, rectangles(size), rectangles(size), rectangle)};
  }
  static Edit random_edit(Random& random, const Input& input) {
    const bool goes = random(3) == 0;
    Edit edit;
    if (random(4) == 0) {
      edit.rectangle = RowEdit<Rectangle>{random(rectangles(input.size)), {}};
      if (!goes) edit.rectangle->row = random_rectangle(random, input.size);
    } else {
      edit.point = RowEdit<Point>{random(2 * input.size + 1), {}};
      if (!goes) edit.point->row = random_point(random, input.size);
    }
    return edit;
  }
  static Edit inverse(const Input& before, const Edit& edit) {
    if (edit.point) return {old_row(before.points, edit.point->key), {}};
    return {{}, old_row(before.rectangles, edit.rectangle->key)};
  }
  static void apply(Input& input, const Edit& edit) {
    if (edit.point) apply_row(input.points, *edit.point);
    if (edit.rectangle) apply_row(input.rectangles, *edit.rectangle);
  }
  static std::vector<std::pair<int, std::int64_t>> oracle(const Input& input) {
    std::vector<std::pair<int, std::int64_t>> counts;
    for (const auto& [key, r] : input.rectangles) {
      std::int64_t count = 0;
      for (const auto& [id, p] : input.points) {
        count += p.first >= r.left && p.first < r.right && p.second >= r.low && p.second < r.high;
      }
      counts.emplace_back(key, count);
    }
    return counts;
  }

  template <class Host>
  class World {
   public:
    World(Host& host, const Input& input) : plane_(host), points_(input.points) {
      for (const auto& [id, p] : input.points) set(id, p);
      for (const auto& [id, r] : input.rectangles) plane_.rectangles.set(id, r);
      host.template run<examples::range_counts::count_all>();
    }
    void edit(const Edit& edit) {
      if (edit.rectangle) edit_map(plane_.rectangles, *edit.rectangle);
      if (!edit.point) return;
      const int id = edit.point->key;
      if (const auto old = points_.find(id); old != points_.end()) {
        plane_.points.erase(plane_.place_of(old->second.first, old->second.second, id));
      }
      apply_row(points_, *edit.point);
      if (edit.point->row) set(id, *edit.point->row);
    }
    auto result() { return plane_.counts.entries(); }
    template <class Recorder>
    void name(Recorder&) const {}

   private:
    void set(int id, const Point& p) {
      plane_.points.set(plane_.place_of(p.first, p.second, id), p.first);
    }
    examples::range_counts::Plane<ScopeOf<Host>> plane_;
    Table<Point> points_;
  };
};

// --- Differences ---------------------------------------------------------------------------------

struct DifferencesApp {
  static constexpr const char* kName = "differences";

  struct Input {
    int size = 0;
    Table<int> versions[2];
  };
  struct Edit {
    int version;
    RowEdit<int> row;
  };

  static int random_value(Random& random) { return random(3); }
  static Input random_input(Random& random, int size) {
    Input input{size, {}};
    for (auto& v : input.versions) v = random_table<int>(random, size, size + 1, random_value);
    return input;
  }
  static Edit random_edit(Random& random, const Input& input) {
    const bool goes = random(3) == 0;
    return {random(2),
            {random(input.size + 1), goes ? std::nullopt : std::optional(random_value(random))}};
  }
  static Edit inverse(const Input& before, const Edit& edit) {
    return {edit.version, old_row(before.versions[edit.version], edit.row.key)};
  }
  static void apply(Input& input, const Edit& edit) {
    apply_row(input.versions[edit.version], edit.row);
  }
  static std::pair<std::size_t, std::uint64_t> oracle(const Input& input) {
    std::pair<std::size_t, std::uint64_t> result;
    for (int key = 0; key <= input.size; ++key) {
      if (old_row(input.versions[0], key).row == old_row(input.versions[1], key).row) continue;
      ++result.first;
      result.second = 31 * result.second + static_cast<std::uint64_t>(key);
    }
    return result;
  }

  template <class Host>
  class World {
   public:
    World(Host& host, const Input& input)
        : host_(host),
          versions_(host),
          size_(host.template cell<std::size_t>()),
          checksum_(host.template cell<std::uint64_t>()) {
      for (const auto& [key, value] : input.versions[0]) versions_.left.set(key, value);
      for (const auto& [key, value] : input.versions[1]) versions_.right.set(key, value);
      host.template run<examples::differences::compare_all>(size_, checksum_);
    }
    void edit(const Edit& edit) {
      edit_map(edit.version == 0 ? versions_.left : versions_.right, edit.row);
    }
    auto result() { return std::pair(host_.get(size_), host_.get(checksum_)); }
    template <class Recorder>
    void name(Recorder& recorder) const {
      recorder.name(size_, "size", 0);
      recorder.name(checksum_, "checksum", 0);
    }

   private:
    using S = ScopeOf<Host>;
    Host& host_;
    examples::differences::Versions<S> versions_;
    typename S::template ModType<std::size_t> size_;
    typename S::template ModType<std::uint64_t> checksum_;
  };
};

// --- Leaders -------------------------------------------------------------------------------------

struct LeadersApp {
  static constexpr const char* kName = "leaders";
  using Player = examples::leaders::Player;

  struct Input {
    int size = 0;
    Table<Player> players;
  };
  using Edit = RowEdit<Player>;

  static Player random_player(Random& random) { return {random(9), random(30)}; }
  static Input random_input(Random& random, int size) {
    return {size, random_table<Player>(random, size, 2 * size + 1, random_player)};
  }
  static Edit random_edit(Random& random, const Input& input) {
    const bool goes = random(3) == 0;
    return {random(2 * input.size + 1), goes ? std::nullopt : std::optional(random_player(random))};
  }
  static Edit inverse(const Input& before, const Edit& edit) {
    return old_row(before.players, edit.key);
  }
  static void apply(Input& input, const Edit& edit) { apply_row(input.players, edit); }
  static std::vector<std::pair<int, int>> oracle(const Input& input) {
    std::map<int, std::pair<int, int>> best;  // by team: points, number
    for (const auto& [number, player] : input.players) {
      const std::pair own(player.points, number);
      const auto [at, fresh] = best.try_emplace(player.team, own);
      if (!fresh) at->second = std::max(at->second, own);
    }
    std::vector<std::pair<int, int>> leaders;
    for (const auto& [team, leader] : best) leaders.emplace_back(team, leader.second);
    return leaders;
  }

  template <class Host>
  class World {
   public:
    World(Host& host, const Input& input) : league_(host) {
      for (const auto& [number, player] : input.players) league_.players.set(number, player);
      host.template run<examples::leaders::lead_all>();
    }
    void edit(const Edit& edit) { edit_map(league_.players, edit); }
    auto result() { return league_.leaders.entries(); }
    template <class Recorder>
    void name(Recorder&) const {}

   private:
    examples::leaders::League<ScopeOf<Host>> league_;
  };
};

}  // namespace apps
