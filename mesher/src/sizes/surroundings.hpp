// How much room features leave to places that may be filled. Features are input points, and
// vertices at which segments are split.
//
//   rooms(s, c, candidates)   for each candidate in the cell c, see Room   (observation)
//
// Whoever asks comes behind all splits. So an answer changes only before its call's turn: by an
// edit from outside, or by a split of a segment that comes or goes.
#pragma once

#include <cstdint>
#include <vector>

#include "index/features.hpp"
#include "segments/reach_tree.hpp"
#include "sizes/candidates.hpp"

namespace mesher::detail {

/// How near the nearest feature is.
enum class Room : std::uint8_t {
  none,  ///< nearer than kClear
  some,
  ample,  ///< not nearer than kUndisturbed
};
/// A place nearer to a feature than this, in pitches, is not filled.
inline constexpr double kClear = 0.5;
/// If no feature is nearer than this, in pitches, a vertex amid the lattice needs nothing: no
/// leaf's ball has one of the six around it (such a leaf is at most 1.4 spacings long, hence 1.67
/// pitches, and its ends are features), and no feature is in the circumcircles of its six
/// triangles.
inline constexpr double kUndisturbed = 3.2;

template <class S>
class Surroundings;

template <>
class Surroundings<sac::PlainScope> {
 public:
  Surroundings(const MeshBox<2>&, const Limits&, const Features<sac::PlainScope>& features,
               sac::PlainScope&)
      : features_(features) {}

  [[nodiscard]] std::vector<Room> rooms(sac::PlainScope&, const Cell<2>&,
                                        const Candidates& candidates) const;

 private:
  const Features<sac::PlainScope>& features_;
};

template <>
class Surroundings<sac::Scope> final : public sac::Structure, public FeatureListener<2> {
 public:
  Surroundings(const MeshBox<2>& box, const Limits& limits, Features<sac::Scope>& features,
               sac::Engine& engine)
      : engine_(engine),
        box_(box),
        limits_(limits),
        features_(features),
        asks_(box),
        id_(engine.add_structure(*this)) {
    features.set_feature_listener(this);
  }

  std::vector<Room> rooms(sac::Scope& s, const Cell<2>& c, const Candidates& candidates);

  void feature_changed(const Point<2>& p) noexcept override;

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
    Cell<2> cell;
    Box<2> extent;         // what features change the answer lie in it
    std::uint64_t answer;  // digest of the rooms
    sac::Handle call;
    bool listed;  // in asks_
  };
  [[nodiscard]] AskEdge& at(sac::Handle h) const noexcept {
    return *engine_.arena().at<AskEdge>(h);
  }
  [[nodiscard]] std::uint64_t answer_now(const AskEdge& ask) const;

  sac::Engine& engine_;
  const MeshBox<2>& box_;
  const Limits& limits_;
  Features<sac::Scope>& features_;
  ReachTree<sac::Handle> asks_;  // AskEdges, by the discs around their extents
  std::uint8_t id_;
};

}  // namespace mesher::detail
