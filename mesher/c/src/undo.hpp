// Undoes updates of a live mesh: what the features that an update edits were before it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <list>
#include <optional>
#include <utility>
#include <vector>

#include "mesher/mesher.hpp"

namespace lm {

template <int D>
class Undo {
 public:
  /// Remembers the last `depth` updates; forgets those beyond.
  void keep(std::size_t depth) {
    depth_ = depth;
    while (before_.size() > depth_) before_.pop_front();
  }
  [[nodiscard]] std::size_t size() const noexcept { return before_.size(); }

  /// An edit of this feature is announced. (Noted at any depth: keep() may come before the update.)
  void touch(const mesher::Feature& feature) { touched_.push_back(feature); }
  void forget_edits() noexcept { touched_.clear(); }

  /// Before an update: what the edited features are. Throws: std::bad_alloc.
  void prepare(const mesher::Mesher<D>& mesher) {
    prepared_.clear();
    if (depth_ == 0 || touched_.empty()) return;
    std::vector<mesher::Feature> all = touched_;
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    prepared_.emplace_back();
    for (const mesher::Feature& f : all) add(mesher, f, prepared_.back());
  }
  /// The update was made.
  void commit() noexcept {
    touched_.clear();
    if (depth_ == 0 || prepared_.empty()) return;
    if (before_.size() == depth_) before_.pop_front();
    before_.splice(before_.end(), prepared_);
  }

  /// Announces the edits that lead back. Requires: size() > 0, and nothing is announced.
  void announce(mesher::Mesher<D>& mesher) const {
    const Before& to = before_.back();
    remove_parts(to, mesher);
    for (const auto& [id, was] : to.points) {
      if (!was && mesher.contains(id)) mesher.remove(id);
    }
    for (const auto& [id, was] : to.points) {
      if (was && mesher.contains(id)) bring_back(*was, mesher);
    }
    for (const auto& [id, was] : to.points) {
      if (was && !mesher.contains(id)) mesher.insert(id, was->at, was->marker);
    }
    add_parts(to, mesher);
  }
  /// They were made.
  void pop() noexcept { before_.pop_back(); }

 private:
  template <class Id, class Value>
  using Entries = std::vector<std::pair<Id, std::optional<Value>>>;
  struct Before {
    Entries<mesher::PointId, mesher::GraphPoint<D>> points;
    Entries<mesher::LineId, mesher::Polyline> lines;
    Entries<mesher::PolygonId, mesher::Polygon> polygons;
    Entries<mesher::SeedId, mesher::Seed<D>> seeds;
  };

  static void add(const mesher::Mesher<D>& mesher, const mesher::Feature& f, Before& before) {
    if (const auto point = f.point()) before.points.emplace_back(*point, mesher.point(*point));
    if (const auto line = f.line()) before.lines.emplace_back(*line, mesher.line(*line));
    if (const auto seed = f.seed()) before.seeds.emplace_back(*seed, mesher.seed(*seed));
    if constexpr (D == 3) {
      if (const auto face = f.polygon()) before.polygons.emplace_back(*face, mesher.polygon(*face));
    }
  }

  // A point that is there: only one that is inserted again can get another marker.
  static void bring_back(const mesher::GraphPoint<D>& was, mesher::Mesher<D>& mesher) {
    if (mesher.point(was.id)->marker == was.marker) return mesher.move(was.id, was.at);
    mesher.remove(was.id);
    mesher.insert(was.id, was.at, was.marker);
  }

  static void remove_parts(const Before& to, mesher::Mesher<D>& mesher) {
    for (const auto& [id, was] : to.seeds) {
      if (mesher.contains(id)) mesher.remove_seed(id);
    }
    if constexpr (D == 3) {
      for (const auto& [id, was] : to.polygons) {
        if (mesher.contains(id)) mesher.remove_polygon(id);
      }
    }
    for (const auto& [id, was] : to.lines) {
      if (mesher.contains(id)) mesher.remove_line(id);
    }
  }
  static void add_parts(const Before& to, mesher::Mesher<D>& mesher) {
    for (const auto& [id, was] : to.lines) {
      if (was) mesher.insert_polyline(id, was->points, was->marker);
    }
    if constexpr (D == 3) {
      for (const auto& [id, was] : to.polygons) {
        if (was) mesher.insert_polygon(*was);
      }
    }
    for (const auto& [id, was] : to.seeds) {
      if (was) mesher.insert_seed(*was);
    }
  }

  std::size_t depth_ = 0;
  std::vector<mesher::Feature> touched_;  // by announced edits; some of them twice
  std::list<Before> before_;              // updates, the last at the end
  std::list<Before> prepared_;            // one, or none
};

}  // namespace lm
