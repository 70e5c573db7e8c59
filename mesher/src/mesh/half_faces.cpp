// Half-faces, sorted.
#include "mesh/half_faces.hpp"

#include <algorithm>
#include <numeric>

#include "mesh/canonical.hpp"

namespace mesher::detail {

namespace {

// By vertex: how many faces have a vertex before it as their smallest corner; at the end, all.
std::vector<std::size_t> begins(const std::vector<Mesh<3>::Simplex>& tetrahedra) {
  std::vector<std::size_t> begin(1);
  for (const auto& s : tetrahedra) {
    const std::uint32_t most = *std::max_element(s.begin(), s.end());
    if (begin.size() <= most + std::size_t{1}) begin.resize(most + std::size_t{2});
    for (const Face& f : faces_of(s))
      ++begin[*std::min_element(f.begin(), f.end()) + std::size_t{1}];
  }
  std::inclusive_scan(begin.begin(), begin.end(), begin.begin());
  return begin;
}

}  // namespace

// By their first corners in linear time, then those of one corner, which are few.
HalfFaces::HalfFaces(const std::vector<Mesh<3>::Simplex>& tetrahedra) {
  const std::vector<std::size_t> begin = begins(tetrahedra);
  std::vector<std::size_t> at = begin;
  all_.resize(4 * tetrahedra.size());
  for (std::uint32_t t = 0; t < tetrahedra.size(); ++t) {
    const auto faces = faces_of(tetrahedra[t]);
    for (std::size_t k = 0; k < 4; ++k) {
      const Face face = smallest_first(faces[k]);
      all_[at[face[0]]++] = {face, tetrahedra[t][k], t};
    }
  }
  for (std::size_t v = 1; v < begin.size(); ++v) {
    std::sort(all_.data() + begin[v - 1], all_.data() + begin[v],
              [](const HalfFace& a, const HalfFace& b) {
                return std::pair(a.key(), a.tetrahedron) < std::pair(b.key(), b.tetrahedron);
              });
  }
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
