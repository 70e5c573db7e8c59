// The plans for filling cells, as a traceable data type: the limits of size are edited from
// outside.
//
//   plan(s, c)   what is to be done about the cell c                       (observation)
//
// It notes where the limits matter for the answer; limits that change there run the call again.
// Others who ask about limits leave no record for it: the calls that have looked at a vertex's
// cell, at a piece of a segment or at a feature's place are known to others, and are taken to have
// asked about the limits beside it (World::limits_changed).
#pragma once

#include <cstdint>

#include "records/reach_tree.hpp"
#include "sac/sac.hpp"
#include "sizes/candidates.hpp"

namespace mesher::detail {

template <class S, int D>
class FillPlans;

template <int D>
class FillPlans<sac::PlainScope, D> {
 public:
  FillPlans(const MeshBox<D>& box, const Limits<D>& limits, sac::PlainScope&)
      : box_(box), limits_(limits) {}

  [[nodiscard]] CellPlan<D> plan(sac::PlainScope&, const Cell<D>& c) const {
    return plan_of(limits_, box_, c);
  }

 private:
  const MeshBox<D>& box_;
  const Limits<D>& limits_;
};

template <int D>
class FillPlans<sac::Scope, D> final : public sac::Structure {
 public:
  FillPlans(const MeshBox<D>& box, const Limits<D>& limits, sac::Engine& engine)
      : engine_(engine),
        box_(box),
        limits_(limits),
        looks_(box),
        id_(engine.add_structure(*this)) {}

  [[nodiscard]] CellPlan<D> plan(sac::Scope& s, const Cell<D>& c);

  /// Called by who edits the limits in `where`.
  void limits_changed(const Box<D>& where) noexcept;

  void retract(sac::Call& call, sac::Edge& edge) noexcept override;
  void label(const sac::Call& call, const sac::Edge& edge, sac::LabelSink& sink) const override;
  void print(const sac::Call& call, const sac::Edge& edge, std::ostream& out) const override;

  [[nodiscard]] std::size_t bytes() const noexcept { return looks_.bytes(); }
  /// Requires: between updates. Throws InvariantError; among others if an answer is not what a look
  /// at the limits finds. Cost: O(answers) looks.
  void check_invariants() const override;

 private:
  static constexpr std::uint8_t kPlan = 0;
  struct PlanEdge : sac::Edge {
    Cell<D> cell;
    Point<D> middle;       // of where the limits matter,
    double reach;          // which lies within this of it
    std::uint64_t answer;  // digest of the plan
    sac::Ref<sac::Call> call;
    bool listed;  // in looks_
  };
  [[nodiscard]] PlanEdge& at(sac::Handle h) const noexcept {
    return *engine_.arena().at<PlanEdge>(h);
  }

  sac::Engine& engine_;
  const MeshBox<D>& box_;
  const Limits<D>& limits_;
  ReachTree<sac::Handle, D> looks_;  // PlanEdges
  std::uint8_t id_;
};

}  // namespace mesher::detail
