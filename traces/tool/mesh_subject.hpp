// The mesher under random edits of points, as a subject for stability.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "mesher/extra/generate.hpp"
#include "mesher/mesher.hpp"
#include "traces/stability.hpp"

namespace tool {

/// Every edit inserts or removes one point, evenly often. Half of the insertions are anywhere in
/// the domain; the other half next to a point, at a distance that is as likely to lie between 2^-k
/// and 2^-k-1 of the domain's side for each k from 3 to 42, so that the spread varies. D is 2 or 3.
///
/// Figures, of the larger of the inputs before and after the edit:
///   n        points
///   m        vertices of the mesh
///   lg_L_s   binary logarithm of L/s: the domain's side over the least distance of two points
///   lg_L_d   the same for d, the distance from the edited point to its nearest neighbour; last
/// A point is one vertex of the mesh: m_f is 1.
template <int D>
class MeshSubject final : public traces::Subject {
 public:
  /// Requires: at least two points, in the domain.
  MeshSubject(const mesher::Options<D>& options, std::vector<mesher::Point<D>> points,
              std::uint64_t seed);

  Edit edit() override;
  [[nodiscard]] traces::Trace trace() const override;
  [[nodiscard]] traces::Trace fresh_trace() const override;

 private:
  [[nodiscard]] static mesher::Mesher<D> meshed(const mesher::Options<D>& options,
                                                const std::vector<mesher::Point<D>>& points,
                                                const std::vector<mesher::PointId>& ids);
  [[nodiscard]] mesher::Point<D> somewhere();
  [[nodiscard]] double side() const;
  mesher::Point<D> insert();
  mesher::Point<D> remove();

  mesher::Options<D> options_;
  std::vector<mesher::Point<D>> points_;
  std::vector<mesher::PointId> ids_;
  std::int64_t next_id_;
  mesher::SplitMix64 random_;
  mesher::Mesher<D> mesher_;
};

}  // namespace tool
