// Random graphs with rings, holes and regions, and batches of edits of them, valid or not.
//
// A batch is made as a script has it. Whether the graph that it leads to is valid is decided by
// exact tests of all pairs.
#pragma once

#include <map>
#include <random>
#include <string>
#include <vector>

#include "mesher/extra/edit_script.hpp"
#include "mesher/meshing.hpp"
#include "mesher/sizes.hpp"
#include "random_pslg.hpp"

namespace support {

/// The naive twin of a Mesher's input.
struct Lake {
  std::map<std::int64_t, mesher::Point<2>> points;
  std::map<std::int64_t, std::vector<std::int64_t>> lines;
  std::map<mesher::SeedId, mesher::Seed<2>> seeds;
  mesher::Options<2> options{.domain = {{0, 0}, {16, 16}}};  // the limits of size

  /// As Mesher::input().
  [[nodiscard]] mesher::Graph<2> graph() const {
    mesher::Graph<2> graph;
    for (const auto& [id, p] : points) graph.points.push_back({mesher::PointId{id}, p, 0});
    for (const auto& [id, along] : lines) {
      std::vector<mesher::PointId> ids;
      for (const std::int64_t i : along) ids.push_back(mesher::PointId{i});
      if (ids.size() == 2) {
        graph.segments.push_back({mesher::LineId{id}, ids[0], ids[1], 0});
      } else {
        graph.polylines.push_back({mesher::LineId{id}, ids, 0});
      }
    }
    for (const auto& [name, s] : seeds) graph.seeds.push_back(s);
    return graph;
  }

  [[nodiscard]] bool is_valid(const mesher::detail::MeshBox<2>& box) const {
    Pslg naive;
    for (const auto& [id, p] : points) {
      if (!naive.accepts(p, box)) return false;
      naive.points[id] = p;
    }
    for (const auto& [id, along] : lines) {
      for (std::size_t i = 1; i < along.size(); ++i) {
        const Pslg::Ends ends = std::minmax(along[i - 1], along[i]);
        if (!points.contains(ends.first) || !points.contains(ends.second)) return false;
        if (!naive.accepts(ends)) return false;
        naive.segments[ends] = id;
      }
    }
    return true;
  }
};

/// Makes batches of edits, and the lakes that they lead to.
class LakeEditor {
 public:
  explicit LakeEditor(std::uint64_t seed) : random_(seed) {}

  static mesher::Options<2> options() { return Lake().options; }

  /// Edits that turn `lake` into what it is afterwards, valid or not.
  std::vector<mesher::Edit<2>> batch(Lake& lake) {
    edits_.clear();
    first_new_ = next_;
    const std::uint64_t count = below(3) == 0 ? 2 + below(4) : 1;
    for (std::uint64_t i = 0; i < count; ++i) edit(lake);
    return std::move(edits_);
  }

 private:
  using Kind = mesher::Edit<2>::Kind;
  using Id = std::int64_t;

  void edit(Lake& lake) {
    switch (below(13)) {
      case 12:
        return edit_limits(lake);
      case 0:
        return add_point(lake, place());
      case 1:
        return remove_point(lake);
      case 2:
      case 3:
        return move_point(lake);
      case 4:
      case 5:
        return add_line(lake);
      case 6:
        return add_ring(lake);
      case 7:
        return remove_line(lake);
      case 8:
        return remove_seed(lake);
      default:
        return add_seed(lake);
    }
  }

  void add_point(Lake& lake, const mesher::Point<2>& p) {
    lake.points[next_] = p;
    push(Kind::insert, next_++).point = p;
  }
  void remove_point(Lake& lake) {
    if (lake.points.empty()) return;
    const Id id = some(lake.points);
    if (id >= first_new_) return;  // its place is looked at before it goes
    lake.points.erase(id);
    push(Kind::remove, id);
  }
  void move_point(Lake& lake) {
    if (lake.points.empty()) return;
    const Id id = some(lake.points);
    if (id >= first_new_) return;
    mesher::Point<2> p = place();
    if (below(2) == 0) p = {lake.points[id][0], p[1]};
    lake.points[id] = p;
    push(Kind::move, id).point = p;
  }
  void add_line(Lake& lake) {
    if (lake.points.size() < 2) return;
    std::vector<Id> along{some(lake.points)};
    for (std::uint64_t n = 1 + (below(3) == 0 ? below(3) : 0); n > 0; --n) {
      const Id next = some(lake.points);
      if (next != along.back()) along.push_back(next);
    }
    if (along.size() > 1) add_line(lake, along);
  }
  // A rectangle, of points that are there and others.
  void add_ring(Lake& lake) {
    const double x = whole(), y = whole(), w = 1 + static_cast<double>(below(8)),
                 h = 1 + static_cast<double>(below(8));
    if (x + w > 16 || y + h > 16) return;
    std::vector<Id> along;
    for (const auto& p : {mesher::Point<2>{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}}) {
      along.push_back(point_at(lake, p));
    }
    along.push_back(along.front());
    add_line(lake, along);
  }
  void add_line(Lake& lake, const std::vector<Id>& along) {
    lake.lines[next_line_] = along;
    const bool segment = along.size() == 2 && below(2) == 0;
    auto& edit = push(segment ? Kind::insert_segment : Kind::insert_polyline, next_line_++);
    for (const Id id : along) edit.points.push_back(mesher::PointId{id});
  }
  void remove_line(Lake& lake) {
    if (lake.lines.empty()) return;
    const Id id = some(lake.lines);
    lake.lines.erase(id);
    push(Kind::remove_segment, id);
  }
  void add_seed(Lake& lake) {
    const bool hole = below(2) == 0;
    const mesher::SeedId name{hole ? mesher::SeedKind::hole : mesher::SeedKind::region,
                              static_cast<Id>(below(4))};
    if (lake.seeds.contains(name)) remove_seed(lake, name);
    mesher::Seed<2> seed{name, place(), 0, {}};
    if (!hole) seed.attribute = static_cast<double>(below(5));
    if (!hole && below(2) == 0) seed.max_measure = 0.5;
    lake.seeds[name] = seed;
    auto& edit = push(hole ? Kind::insert_hole : Kind::insert_region, name.number);
    edit.point = seed.at;
    edit.attribute = seed.attribute;
    edit.max_measure = seed.max_measure;
  }
  void remove_seed(Lake& lake) {
    if (lake.seeds.empty()) return;
    remove_seed(lake, some(lake.seeds));
  }
  void remove_seed(Lake& lake, const mesher::SeedId& name) {
    lake.seeds.erase(name);
    const bool hole = name.kind == mesher::SeedKind::hole;
    push(hole ? Kind::remove_hole : Kind::remove_region, name.number);
  }

  // Coarse, that meshes from scratch take no time.
  void edit_limits(Lake& lake) {
    auto& edit = push(Kind::limit, 0);
    if (below(3) != 0) edit.limits.max_measure = below(2) == 0 ? 0.4375 : 4;
    if (below(4) == 0) return set_limits(lake.options, edit.limits);
    const mesher::Point<2> lo = place();
    edit.box = {lo, {lo[0] + static_cast<double>(below(5)), lo[1] + 5 * unit()}};
    set_limits(lake.options, *edit.box, edit.limits);
  }

  mesher::Edit<2>& push(Kind kind, Id id) {
    mesher::Edit<2> edit;
    edit.kind = kind;
    edit.number = id;
    edit.location = {"batch", static_cast<long>(edits_.size()) + 1, 1};
    return edits_.emplace_back(std::move(edit));
  }
  Id point_at(Lake& lake, const mesher::Point<2>& p) {
    for (const auto& [id, q] : lake.points) {
      if (p == q) return id;
    }
    add_point(lake, p);
    return next_ - 1;
  }
  template <class Map>
  typename Map::key_type some(const Map& map) {
    return std::next(map.begin(), static_cast<std::ptrdiff_t>(below(map.size())))->first;
  }
  mesher::Point<2> place() {
    if (below(2) == 0) return {whole(), whole()};
    return {16 * unit(), 16 * unit()};
  }
  double whole() { return static_cast<double>(below(17)); }
  std::uint64_t below(std::uint64_t n) { return random_() % n; }
  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

  std::mt19937_64 random_;
  std::vector<mesher::Edit<2>> edits_;
  Id next_ = 1, next_line_ = 1, first_new_ = 1;
};

}  // namespace support
