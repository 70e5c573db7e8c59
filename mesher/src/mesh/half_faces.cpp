// Half-faces, sorted; the faces of a mesh's boundary.
#include "mesh/half_faces.hpp"

#include <algorithm>

#include "mesh/canonical.hpp"
#include "mesher/space_files.hpp"

namespace mesher::detail {

HalfFaces::HalfFaces(const std::vector<Mesh<3>::Simplex>& tetrahedra) {
  all_.reserve(4 * tetrahedra.size());
  for (std::uint32_t t = 0; t < tetrahedra.size(); ++t) {
    const auto faces = faces_of(tetrahedra[t]);
    for (std::size_t k = 0; k < 4; ++k) {
      all_.push_back({smallest_first(faces[k]), tetrahedra[t][k], t});
    }
  }
  std::sort(all_.begin(), all_.end(), [](const HalfFace& a, const HalfFace& b) {
    const Face p = a.key(), q = b.key();
    return p != q ? p < q : a.tetrahedron < b.tetrahedron;
  });
}

std::size_t HalfFaces::partners(std::size_t i) const {
  std::size_t end = i + 1;
  while (end < all_.size() && all_[i].key() == all_[end].key()) ++end;
  return end - i;
}

std::size_t HalfFaces::first_at(std::uint32_t v) const {
  const auto at = std::lower_bound(all_.begin(), all_.end(), v,
                                   [](const HalfFace& f, auto w) { return f.face[0] < w; });
  return static_cast<std::size_t>(at - all_.begin());
}

std::vector<HalfFace> HalfFaces::border() const {
  std::vector<HalfFace> border;
  for (std::size_t i = 0, n = 0; i < all_.size(); i += n) {
    n = partners(i);
    if (n == 1) border.push_back(all_[i]);
  }
  return border;
}

}  // namespace mesher::detail

namespace mesher {

std::vector<detail::Face> boundary_faces(const Mesh<3>& mesh) {
  std::vector<detail::Face> faces;
  for (const auto& half : detail::HalfFaces(mesh.simplices).border()) faces.push_back(half.face);
  std::sort(faces.begin(), faces.end());
  return faces;
}

}  // namespace mesher
