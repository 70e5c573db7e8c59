// The room that features leave for candidates.
//
//   rooms(s, c, candidates)   for each candidate in the cell c, see Room   (observation)
//
// All calls that query it come after all splits. So an answer changes only before its call's turn:
// by an edit from outside, or in the plane by an added or removed split of a segment.
#pragma once

#include <cstdint>
#include <vector>

#include "program/obstacles.hpp"
#include "records/reach_tree.hpp"
#include "sizes/candidates.hpp"

namespace mesher::detail {

template <class S, int D>
class Surroundings;

template <int D>
class Surroundings<sac::PlainScope, D> {
 public:
  Surroundings(const MeshBox<D>&, const Limits<D>&, const Obstacles<sac::PlainScope, D>& obstacles,
               sac::PlainScope&)
      : obstacles_(obstacles) {}

  [[nodiscard]] std::vector<Room> rooms(sac::PlainScope&, const Cell<D>&,
                                        const Candidates<D>& candidates) const;

 private:
  Obstacles<sac::PlainScope, D> obstacles_;
};

template <int D>
class Surroundings<sac::Scope, D> final : public sac::Structure, public FeatureListener<D> {
 public:
  Surroundings(const MeshBox<D>& box, const Limits<D>& limits,
               const Obstacles<sac::Scope, D>& obstacles, sac::Engine& engine)
      : engine_(engine),
        box_(box),
        limits_(limits),
        obstacles_(obstacles),
        asks_(box),
        id_(engine.add_structure(*this)) {}

  std::vector<Room> rooms(sac::Scope& s, const Cell<D>& c, const Candidates<D>& candidates);

  /// A feature has come, or gone.
  void feature_changed(const Point<D>& p) noexcept override { changed({p, p}); }
  void changed(const FeatureExtent<D>& where) noexcept;
  /// Whether an answer may be another one if there is a feature at p, or none any more.
  [[nodiscard]] bool concerned(const Point<D>& p) const noexcept;

  void retract(sac::Call& call, sac::Edge& edge) noexcept override;
  [[nodiscard]] bool unchanged(sac::Call& call, sac::Edge& edge) override;
  void label(const sac::Call& call, const sac::Edge& edge, sac::LabelSink& sink) const override;
  void print(const sac::Call& call, const sac::Edge& edge, std::ostream& out) const override;

  [[nodiscard]] std::size_t bytes() const noexcept { return asks_.bytes(); }
  /// Requires: between updates. Throws InvariantError; among others if an answer is not what a look
  /// at the features finds. Cost: O(answers) looks.
  void check_invariants() const override;

 private:
  static constexpr std::uint8_t kAsk = 0;
  struct AskEdge : sac::Edge {
    Cell<D> cell;
    Box<D> extent;         // what features change the answer lie in it
    std::uint64_t answer;  // digest of the rooms
    sac::Ref<sac::Call> call;
    bool listed;  // in asks_
  };
  [[nodiscard]] AskEdge& at(sac::Handle h) const noexcept {
    return *engine_.arena().at<AskEdge>(h);
  }
  template <class Visit>
  void visit_near(const FeatureExtent<D>& where, Visit&& visit) const noexcept;
  [[nodiscard]] std::uint64_t answer_now(const AskEdge& ask) const;

  sac::Engine& engine_;
  const MeshBox<D>& box_;
  const Limits<D>& limits_;
  Obstacles<sac::Scope, D> obstacles_;
  ReachTree<sac::Handle, D> asks_;  // AskEdges, by the balls around their extents
  std::uint8_t id_;
};

}  // namespace mesher::detail
