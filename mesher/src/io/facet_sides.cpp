// Sides of all simplices, sorted, among which facets are found.
#include "io/facet_sides.hpp"

#include <algorithm>
#include <string>

#include "mesh/half_faces.hpp"
#include "mesher/domain.hpp"

namespace mesher {
namespace {

template <int D>
struct SideOfSimplex {
  std::array<std::uint32_t, D> key{};  // corners, ascending
  std::uint32_t simplex = 0, opposite = 0;
  friend auto operator<=>(const SideOfSimplex&, const SideOfSimplex&) = default;
};

// Of both dimensions, of which a library may have one alone.
std::array<std::array<std::uint32_t, 2>, 3> sides_seen_from_outside(const Mesh<2>::Simplex& s) {
  return {{{s[1], s[2]}, {s[2], s[0]}, {s[0], s[1]}}};
}
[[maybe_unused]] std::array<std::array<std::uint32_t, 3>, 4> sides_seen_from_outside(
    const Mesh<3>::Simplex& s) {
  return detail::faces_of(s);
}

template <int D>
std::vector<SideOfSimplex<D>> sides_of(const Mesh<D>& mesh) {
  std::vector<SideOfSimplex<D>> sides;
  sides.reserve(mesh.simplices.size() * (D + 1));
  for (std::uint32_t t = 0; t < mesh.simplices.size(); ++t) {
    const auto all = sides_seen_from_outside(mesh.simplices[t]);
    for (std::uint32_t i = 0; i <= D; ++i) {
      SideOfSimplex<D> side{all[i], t, i};
      std::sort(side.key.begin(), side.key.end());
      sides.push_back(side);
    }
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

template <int D>
FacetSide<D> facet_at(const Mesh<D>& mesh, const SideOfSimplex<D>& side, std::int64_t marker,
                      bool is_boundary) {
  const auto corners = sides_seen_from_outside(mesh.simplices[side.simplex])[side.opposite];
  return {corners, marker, side.simplex, side.opposite, is_boundary};
}

std::array<std::uint32_t, 2> key_of(const MeshEdge& e) { return {e.low, e.high}; }
[[maybe_unused]] std::array<std::uint32_t, 3> key_of(const MeshFace& f) { return f.key(); }

template <int D>
const auto& facets_of(const MeshFeatures& features) {
  if constexpr (D == 2) {
    return features.edges;
  } else {
    return features.faces;
  }
}

template <int D>
[[noreturn]] void fail_no_side(const std::array<std::uint32_t, D>& corners) {
  std::string text =
      D == 2 ? "no triangle has the edge of vertices" : "no tetrahedron has the face of vertices";
  for (const std::uint32_t v : corners) text += ' ' + std::to_string(v + std::size_t{1});
  throw Error(ErrorCode::bad_mesh, text + " (counted from 1)");
}

}  // namespace

template <int D>
std::vector<FacetSide<D>> facet_sides(const Mesh<D>& mesh, const MeshFeatures& features) {
  const std::vector<SideOfSimplex<D>> sides = sides_of(mesh);
  const auto is_alone = [&](std::size_t i) {  // the first of its key
    return i + 1 == sides.size() || sides[i + 1].key != sides[i].key;
  };
  std::vector<FacetSide<D>> facets;
  for (const auto& part : facets_of<D>(features)) {
    const SideOfSimplex<D> wanted{key_of(part), 0, 0};
    const auto found = std::lower_bound(sides.begin(), sides.end(), wanted);
    if (found == sides.end() || found->key != wanted.key) fail_no_side<D>(wanted.key);
    const auto i = static_cast<std::size_t>(found - sides.begin());
    facets.push_back(facet_at(mesh, sides[i], part.marker, is_alone(i)));
  }
  if (!features.empty()) return facets;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool is_first = i == 0 || sides[i - 1].key != sides[i].key;
    if (is_first && is_alone(i)) {
      facets.push_back(facet_at(mesh, sides[i], kBoundaryMarker, true));
    }
  }
  return facets;
}

template std::vector<FacetSide<2>> facet_sides(const Mesh<2>&, const MeshFeatures&);
#ifndef MESHER_PLANE_ONLY
template std::vector<FacetSide<3>> facet_sides(const Mesh<3>&, const MeshFeatures&);
#endif

}  // namespace mesher
