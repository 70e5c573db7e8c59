// A mesh on which edits are measured: each comes in one update and goes in another.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "../../mesher/bench/sample.hpp"
#include "mesher/mesher.hpp"
#include "mesher/pslg.hpp"
#include "traces/distance.hpp"
#include "traces/recorder.hpp"

namespace bench {

/// What one edit has cost, coming or going.
struct Cost {
  std::optional<double> distance;
  double work = 0, weight = 0, microseconds = 0;
  [[nodiscard]] std::optional<double> quantity(int i) const {
    if (i == 0) return distance;
    return i == 1 ? work : i == 2 ? weight : microseconds;
  }
};

/// A mesh in the unit square, and edits of it that are taken back at once.
class Ground {
 public:
  explicit Ground(const mesher::Pslg& pslg)
      : mesher_({.domain = {{0, 0}, {1, 1}}, .record_weights = true}) {
    for (const auto& v : pslg.points) mesher_.insert(v.id, v.at), points_.push_back(v.at);
    for (const auto& s : pslg.segments) mesher_.insert_segment(s.id, s.from, s.to);
    mesher_.update();
  }
  [[nodiscard]] const std::vector<mesher::Point<2>>& points() const { return points_; }

  struct Costs {
    Cost come, go;
    std::size_t on_line = 1;  // vertices that stand on the edit
  };
  /// Nothing if the input does not take the line. `record`: the distance is asked for, too: that is
  /// of the same edit made once more, since recording a trace leaves nothing of the mesh in cache.
  std::optional<Costs> edit(const std::vector<mesher::Point<2>>& line, bool record) {
    Costs costs;
    if (!come(line, costs)) return {};
    go(line.size(), costs.go);
    if (!record) return costs;
    if (!base_) base_ = trace();
    Costs again;
    come(line, again);
    const auto apart = traces::distance(*base_, trace()).all.distance();
    costs.come.distance = costs.go.distance = static_cast<double>(apart);
    go(line.size(), again.go);
    return costs;
  }

 private:
  static constexpr std::int64_t kFirst = 1'000'000'000;
  static mesher::FeatureId id(std::size_t i) {
    return mesher::FeatureId{kFirst + static_cast<std::int64_t>(i)};
  }

  bool come(const std::vector<mesher::Point<2>>& line, Costs& costs) {
    std::vector<mesher::FeatureId> ids;
    try {
      for (std::size_t i = 0; i < line.size(); ++i) {
        ids.push_back(id(i));
        mesher_.insert(ids.back(), line[i]);
      }
      if (line.size() > 1) mesher_.insert_polyline(ids.front(), ids);
      costs.on_line = 1 + update(costs.come).edges_added.size();
      return true;
    } catch (const mesher::Error&) {
      mesher_.discard_edits();
      mesher_.update();  // calls that were asked for go
      return false;
    }
  }
  void go(std::size_t points, Cost& cost) {
    if (points > 1) mesher_.remove_segment(id(0));
    for (std::size_t i = 0; i < points; ++i) mesher_.remove(id(i));
    update(cost);
  }
  [[nodiscard]] traces::Trace trace() const { return traces::Recorder(mesher_.engine()).trace(); }
  mesher::Change<2> update(Cost& cost) {
    mesher::Change<2> change;
    cost.microseconds = 1e6 * seconds_of([&] { change = mesher_.update(); });
    const auto& calls = change.calls;
    cost.work = static_cast<double>(calls.created + calls.discarded + calls.executed);
    cost.weight = cost.work + static_cast<double>(calls.weight);
    return change;
  }

  mesher::Mesher<2> mesher_;
  std::vector<mesher::Point<2>> points_;
  std::optional<traces::Trace> base_;  // without an edit
};

}  // namespace bench
