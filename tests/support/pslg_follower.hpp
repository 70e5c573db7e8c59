// A mesh of points and segments that follows random edits, against runs from scratch.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pslg_judge.hpp"
#include "random_limits.hpp"
#include "random_pslg.hpp"
#include "traced_world.hpp"

namespace support {

/// Lets a world follow a random graph; what is wrong first, "" if nothing is.
class PslgFollower {
 public:
  PslgFollower(PslgEditor::Family family, std::uint64_t seed,
               const mesher::Options<2>& options = PslgEditor::options())
      : options_(options), family_(family), editor_(family, seed), world_(options) {}

  /// From now on steps edit the limits of size, too.
  void edit_limits(std::uint64_t seed) { limits_.emplace(seed); }

  /// `edits` edits as one update; those of a graph that needs too large a mesh are not made.
  std::string step(int edits) {
    const Input before{pslg_, options_};
    Recorded recorded;
    for (int i = 0; i < edits; ++i) editor_.edit(pslg_, world_.box(), recorded);
    std::vector<mesher::Box<2>> where;
    if (limits_ && limits_->below(2) == 0) {
      for (int i = 0; i < edits && i < 3; ++i) where.push_back(limits_->edit(options_));
    }
    mesher::Mesh<2> expected;
    try {
      expected = static_mesh(pslg_, options_, kMostCalls);
    } catch (const mesher::Error& error) {
      if (error.code() == mesher::ErrorCode::cancelled) return take_back(before), "";
      return refused(before, recorded, where);
    }
    replay(recorded, where);
    world_.update();
    if (!(world_.mesh() == expected)) return "not the mesh of a run from scratch";
    if (family_ == PslgEditor::Family::steiner) editor_.look_at(expected);
    world_.engine().check_invariants();
    world_.world().vertices.check_invariants();
    world_.world().segments.check_invariants();
    return PslgJudge(expected, pslg_).fault(options_);
  }
  /// 25 edits, then one at a time and now and then six; and no two calls with one label, none made
  /// again [Def 1.4.2, 1.4.3].
  std::string follow(int steps) {
    for (int i = 0; i < steps; ++i) {
      const std::string fault = step(i == 0 ? 25 : i % 7 == 0 ? 6 : 1);
      if (!fault.empty()) return "step " + std::to_string(i) + ": " + fault;
    }
    if (limits_) {
      const std::string fault = other_trace();
      if (!fault.empty()) return fault;
    }
    const auto& audit = world_.engine().audit();
    if (audit.duplicates != 0) return "two calls " + audit.first_duplicate;
    if (audit.reordered != 0) return "made anew " + audit.first_reordered;
    return "";
  }

 private:
  static constexpr std::uint64_t kMostCalls = 20000;

  struct Input {
    Pslg pslg;
    mesher::Options<2> options;
  };
  void take_back(const Input& before) { pslg_ = before.pslg, options_ = before.options; }
  void replay(const Recorded& recorded, const std::vector<mesher::Box<2>>& where) {
    if (!where.empty()) world_.limit(options_, where);
    recorded.replay(world_);
  }

  // What a run from scratch refuses, an update does, and leaves what was there.
  std::string refused(const Input& before, const Recorded& recorded,
                      const std::vector<mesher::Box<2>>& where) {
    const mesher::Mesh<2> mesh = world_.mesh();
    try {
      replay(recorded, where);
      take_back(before);
      world_.update();
      return "not refused";
    } catch (const mesher::Error&) {
      return world_.mesh() == mesh ? "" : "a refused update left another mesh";
    }
  }

  // The trace is that of a run from scratch.
  [[nodiscard]] std::string other_trace() const {
    TracedWorld fresh(options_, false);
    for (const auto& [id, p] : pslg_.points) fresh.insert(mesher::PointId{id}, p);
    for (const auto& [ends, id] : pslg_.segments) {
      fresh.insert_segment(mesher::LineId{id}, mesher::PointId{ends.first},
                           mesher::PointId{ends.second});
    }
    fresh.run();
    const auto size = [](const TracedWorld& w) {
      return std::to_string(w.engine().live_calls()) + " calls, " +
             std::to_string(w.engine().live_edges()) + " edges";
    };
    return size(fresh) == size(world_) ? "" : size(world_) + ", from scratch " + size(fresh);
  }

  mesher::Options<2> options_;
  PslgEditor::Family family_;
  PslgEditor editor_;
  TracedWorld world_;
  Pslg pslg_;
  std::optional<RandomLimits> limits_;
};

}  // namespace support
