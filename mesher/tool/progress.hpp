// A line on standard error that shows the progress of a command: only on a terminal, and only after
// two seconds. It is erased at the end.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "cancel.hpp"
#include "mesher/domain.hpp"
#include "mesher/mesher.hpp"

namespace tool {

class Progress {
 public:
  /// `dimension`: 2 or 3, for words.
  explicit Progress(bool quiet, int dimension = 2);
  ~Progress() { erase(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// For runs and updates: shows how far they are, and stops them when the user interrupts.
  [[nodiscard]] mesher::RunControl control();

  /// What the runs are part of, in front of how far they are: "update 7, " say.
  void set_task(std::string task) { task_ = std::move(task); }
  /// Asked by all runs from now on, which it stops by false.
  void set_meanwhile(std::function<bool(const mesher::Progress&)> meanwhile) {
    meanwhile_ = std::move(meanwhile);
  }
  /// Makes room for other output.
  void erase();

 private:
  void tick(const mesher::Progress& progress);

  bool enabled_;
  int dimension_;
  bool shown_ = false;
  double next_;  // when to show a line
  std::string task_;
  std::function<bool(const mesher::Progress&)> meanwhile_;
};

/// Whether a mesher takes holes and regions.
template <class Target>
concept TakesSeeds = requires(Target& t, const mesher::SeedId& name) {
  t.remove_seed(name);
};

/// Whether it takes polygons.
template <class Target>
concept TakesPolygons = requires(Target& t, mesher::PolygonId id) {
  t.remove_polygon(id);
};

/// A mesher whose updates are watched; the rest of its interface as it is.
template <class Target>
class Watched {
 public:
  Watched(Target& target, Progress& progress) : target_(target), progress_(progress) {}

  // With a marker, if the mesher takes one.
  void insert(mesher::PointId id, const auto& p, auto... marker) requires requires(Target& t) {
    t.insert(id, p, marker...);
  }
  { target_.insert(id, p, marker...); }
  void remove(mesher::PointId id) { target_.remove(id); }
  void move(mesher::PointId id, const auto& p) { target_.move(id, p); }
  void insert_segment(mesher::LineId id, mesher::PointId from, mesher::PointId to,
                      auto... marker) requires requires(Target& t) {
    t.insert_segment(id, from, to, marker...);
  }
  { target_.insert_segment(id, from, to, marker...); }
  void insert_polyline(mesher::LineId id, const std::vector<mesher::PointId>& points,
                       auto... marker) requires requires(Target& t) {
    t.insert_polyline(id, points, marker...);
  }
  { target_.insert_polyline(id, points, marker...); }
  void remove_line(mesher::LineId id) requires requires(Target& t) { t.remove_line(id); }
  { target_.remove_line(id); }
  void insert_polygon(const mesher::Polygon& polygon) requires TakesPolygons<Target> {
    target_.insert_polygon(polygon);
  }
  void remove_polygon(mesher::PolygonId id) requires TakesPolygons<Target> {
    target_.remove_polygon(id);
  }
  template <int D>
  void insert_seed(const mesher::Seed<D>& seed) requires TakesSeeds<Target> {
    target_.insert_seed(seed);
  }
  void remove_seed(const mesher::SeedId& name) requires TakesSeeds<Target> {
    target_.remove_seed(name);
  }
  void limit(const auto& limits) { target_.limit(limits); }
  void limit(const auto& box, const auto& limits) { target_.limit(box, limits); }
  void discard_edits() { target_.discard_edits(); }
  auto update() {
    const StopPolitely stop;
    return target_.update(progress_.control());
  }

 private:
  Target& target_;
  Progress& progress_;
};

}  // namespace tool
