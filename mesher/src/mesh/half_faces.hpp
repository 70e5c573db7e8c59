// The faces of tetrahedra grouped by triangle, which gives the neighbours.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesher/mesh.hpp"

namespace mesher::detail {

using Face = std::array<std::uint32_t, 3>;

/// The faces of a tetrahedron, across from its corners a, b, c, d, seen from outside
/// counterclockwise. (abc is counterclockwise seen from d, which is inside.)
[[nodiscard]] constexpr std::array<Face, 4> faces_of(const Mesh<3>::Simplex& s) {
  const auto [a, b, c, d] = s;
  return {Face{b, c, d}, Face{a, d, c}, Face{a, b, d}, Face{a, c, b}};
}

/// A face of a tetrahedron.
struct HalfFace {
  Face face;               ///< the smallest first, counterclockwise seen from outside
  std::uint32_t opposite;  ///< the tetrahedron's other corner
  std::uint32_t tetrahedron;

  /// The same for both sides of a face.
  [[nodiscard]] Face key() const {
    const auto [a, b, c] = face;
    return b < c ? face : Face{a, c, b};
  }
  /// Of two half-faces of one face: whether their tetrahedra are on different sides of it.
  [[nodiscard]] bool faces_away_from(const HalfFace& other) const { return face != other.face; }
};

/// All faces of all tetrahedra, those of one triangle next to each other.
/// Requires: fewer than 2^32 tetrahedra. Cost: O(m log d), where d is the most at a vertex.
class HalfFaces {
 public:
  explicit HalfFaces(const std::vector<Mesh<3>::Simplex>& tetrahedra);

  [[nodiscard]] std::size_t size() const { return all_.size(); }
  [[nodiscard]] const HalfFace& operator[](std::size_t i) const { return all_[i]; }
  /// How many half-faces from i on are of i's triangle.
  [[nodiscard]] std::size_t partners(std::size_t i) const;
  /// Where the half-faces begin that have v, or else a later vertex, as their first corner.
  [[nodiscard]] std::size_t first_at(std::uint32_t v) const;
  /// The half-faces that have no partner.
  [[nodiscard]] std::vector<HalfFace> border() const;

 private:
  std::vector<HalfFace> all_;  // ascending by key
};

}  // namespace mesher::detail
