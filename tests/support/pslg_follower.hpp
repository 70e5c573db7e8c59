// A mesh of points and segments that follows random edits, against runs from scratch.
#pragma once

#include <string>

#include "pslg_judge.hpp"
#include "random_pslg.hpp"
#include "traced_world.hpp"

namespace support {

/// Lets a world follow a random graph; what is wrong first, "" if nothing is.
class PslgFollower {
 public:
  PslgFollower(PslgEditor::Family family, std::uint64_t seed,
               const mesher::Options<2>& options = PslgEditor::options())
      : options_(options), family_(family), editor_(family, seed), world_(options) {}

  /// `edits` edits as one update; those of a graph that needs too large a mesh are not made.
  std::string step(int edits) {
    const Pslg before = pslg_;
    Recorded recorded;
    for (int i = 0; i < edits; ++i) editor_.edit(pslg_, world_.box(), recorded);
    mesher::Mesh<2> expected;
    try {
      expected = static_mesh(pslg_, options_, kMostCalls);
    } catch (const mesher::Error& error) {
      if (error.code() == mesher::ErrorCode::cancelled) return pslg_ = before, "";
      return refused(before, recorded);
    }
    recorded.replay(world_);
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
    const auto& audit = world_.engine().audit();
    if (audit.duplicates != 0) return "two calls " + audit.first_duplicate;
    if (audit.reordered != 0) return "made anew " + audit.first_reordered;
    return "";
  }

 private:
  static constexpr std::uint64_t kMostCalls = 20000;

  // What a run from scratch refuses, an update does, and leaves what was there.
  std::string refused(const Pslg& before, const Recorded& recorded) {
    pslg_ = before;
    const mesher::Mesh<2> mesh = world_.mesh();
    try {
      recorded.replay(world_);
      world_.update();
      return "not refused";
    } catch (const mesher::Error&) {
      return world_.mesh() == mesh ? "" : "a refused update left another mesh";
    }
  }

  mesher::Options<2> options_;
  PslgEditor::Family family_;
  PslgEditor editor_;
  TracedWorld world_;
  Pslg pslg_;
};

}  // namespace support
