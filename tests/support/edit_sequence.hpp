// Random sequences of edits of a point set, and what must hold after each of them.
//
//   Sequence s = random_sequence(Family::lattice, options, 40, 200, seed);
//   INFO(describe(s));  REQUIRE(first_failure(s, checks) == "");
//
// A sequence stays meaningful when steps are taken out: an edit whose point is missing, there
// already or too near to another is passed over. So a failing one can be halved to a short one.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "mesher/extra/generate.hpp"
#include "mesher/mesher.hpp"

namespace support {

using mesher::Point;

/// Ids to places: the naive twin of a mesher's input.
using PointSet = std::map<std::int64_t, Point<2>>;

struct Edit {
  enum class Kind : std::uint8_t { insert, remove, move };
  Kind kind = Kind::insert;
  std::int64_t id = 0;
  Point<2> point{};
};

/// Edits that are one update.
using Step = std::vector<Edit>;

struct Sequence {
  mesher::Options<2> options;
  std::vector<Step> steps;
  std::uint64_t seed = 0;
};

/// Where points come from. All but `far` lie in the unit box or in [0, 16]^2.
enum class Family : std::uint8_t {
  uniform,
  gaussian,
  clustered,
  lattice,    ///< an integer lattice: cocircular everywhere
  collinear,  ///< on a level, an upright and a slanting line
  spiral,
  spread,   ///< beside another point, at distances down to 1e-12 of the domain
  borders,  ///< on the domain's sides and corners, on cells' borders and next to them
  steiner,  ///< on vertices of the mesh of the moment
  far,      ///< far from the origin for the domain's size
};
inline constexpr Family kFamilies[] = {
    Family::uniform, Family::gaussian, Family::clustered, Family::lattice, Family::collinear,
    Family::spiral,  Family::spread,   Family::borders,   Family::steiner, Family::far};

[[nodiscard]] const char* name(Family family);
[[nodiscard]] mesher::Box<2> domain(Family family);

/// A first step of `n` insertions, then `edits` steps: insertions, removals, moves, batches with
/// points removed and inserted again, and once everything removed.
[[nodiscard]] Sequence random_sequence(Family family, mesher::Options<2> options, int n, int edits,
                                       std::uint64_t seed);

/// The sequence as text, a step a line, coordinates bit for bit.
[[nodiscard]] std::string describe(const Sequence& sequence);

struct Checks {
  int fresh_every = 10;  ///< compare with a new BoxMesher after so many steps; 0: never
  /// Called with the mesh after every step.
  std::function<void(const mesher::Mesh<2>&, const PointSet&)> each;
};

/// What fails first when the sequence is applied to a BoxMesher, "" if nothing does. After every
/// step: the mesh is that of a static run and, at times, of a new BoxMesher; the change turns the
/// old mesh into the new one, and says nothing twice; the mesher's invariants hold; each input
/// point is a vertex, bit for bit.
[[nodiscard]] std::string first_failure(const Sequence& sequence, const Checks& checks = {});

/// A sequence with fewer steps for which `fails` holds still.
[[nodiscard]] Sequence shrunk(Sequence sequence, const std::function<bool(const Sequence&)>& fails);

/// "" or the failure, with the shortest sequence found that shows it.
[[nodiscard]] std::string verdict(const Sequence& sequence, const Checks& checks = {});

/// `point` as the mesher keeps it: zero has no sign.
[[nodiscard]] inline Point<2> unsigned_zero(const Point<2>& p) { return {p[0] + 0.0, p[1] + 0.0}; }

/// Applies an edit to the twin; false if it makes no sense there.
bool perform(const Edit& edit, PointSet& points);

/// Applies an edit to `target` (with insert, remove, move) and to the twin. An edit that makes no
/// sense, or is refused because of another point nearby, changes neither.
template <class Target>
void perform(const Edit& edit, Target& target, PointSet& points) {
  PointSet next = points;
  if (!perform(edit, next)) return;
  const mesher::PointId id{edit.id};
  try {
    switch (edit.kind) {
      case Edit::Kind::insert:
        target.insert(id, edit.point);
        break;
      case Edit::Kind::remove:
        target.remove(id);
        break;
      case Edit::Kind::move:
        target.move(id, edit.point);
        break;
    }
  } catch (const mesher::Error& error) {
    using mesher::ErrorCode;
    if (error.code() != ErrorCode::duplicate_point && error.code() != ErrorCode::too_close) throw;
    return;
  }
  points = std::move(next);
}

[[nodiscard]] mesher::Mesh<2> static_mesh(const PointSet& points,
                                          const mesher::Options<2>& options);

}  // namespace support
