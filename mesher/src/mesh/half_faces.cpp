// Half-faces, sorted; the faces of a mesh's boundary.
#include "mesh/half_faces.hpp"

#include <algorithm>
#include <numeric>

#include "mesh/canonical.hpp"
#include "mesher/space_files.hpp"

namespace mesher::detail {

namespace {

// Of two with the same first corner.
bool is_before(const HalfFace& a, const HalfFace& b) {
  const auto others = [](const HalfFace& f) {
    const auto [low, high] = std::minmax(f.face[1], f.face[2]);
    return std::uint64_t{low} << 32 | high;
  };
  const std::uint64_t of_a = others(a), of_b = others(b);
  return of_a != of_b ? of_a < of_b : a.tetrahedron < b.tetrahedron;
}

// By vertex: how many faces have it, or one before, as their smallest corner.
std::vector<std::size_t> first_corner_ends(const std::vector<Mesh<3>::Simplex>& tetrahedra) {
  std::vector<std::size_t> end;
  for (const auto& s : tetrahedra) {
    const std::uint32_t most = *std::max_element(s.begin(), s.end());
    if (end.size() <= most) end.resize(most + std::size_t{1});
    for (const Face& f : faces_of(s)) ++end[*std::min_element(f.begin(), f.end())];
  }
  std::inclusive_scan(end.begin(), end.end(), end.begin());
  return end;
}

}  // namespace

// By their first corners in linear time, then those of one corner, which are few.
HalfFaces::HalfFaces(const std::vector<Mesh<3>::Simplex>& tetrahedra) {
  const std::vector<std::size_t> end = first_corner_ends(tetrahedra);
  std::vector<std::size_t> at(end.size());
  if (!at.empty()) std::copy(end.begin(), end.end() - 1, at.begin() + 1);
  all_.resize(4 * tetrahedra.size());
  for (std::uint32_t t = 0; t < tetrahedra.size(); ++t) {
    const auto faces = faces_of(tetrahedra[t]);
    for (std::size_t k = 0; k < 4; ++k) {
      const Face face = smallest_first(faces[k]);
      all_[at[face[0]]++] = {face, tetrahedra[t][k], t};
    }
  }
  auto from = all_.begin();
  for (const std::size_t to : end) {
    const auto last = all_.begin() + static_cast<std::ptrdiff_t>(to);
    std::sort(from, last, is_before);
    from = last;
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

namespace mesher {

namespace {

// The corners of faces but for their first corner, which is the smallest, by that.
class OtherCorners {
 public:
  explicit OtherCorners(const std::vector<Mesh<3>::Simplex>& tetrahedra)
      : end_(detail::first_corner_ends(tetrahedra)), all_(4 * tetrahedra.size()) {
    std::vector<std::size_t> at(end_.size());
    if (!at.empty()) std::copy(end_.begin(), end_.end() - 1, at.begin() + 1);
    for (const auto& s : tetrahedra) {
      for (const detail::Face& f : detail::faces_of(s)) {
        const auto [first, pair] = split(f);
        all_[at[first]++] = pair;
      }
    }
  }

  /// Leaves those that there are once.
  void drop_pairs() {
    std::size_t from = 0, kept = 0;
    for (std::size_t& end : end_) {
      std::sort(all_.data() + from, all_.data() + end);
      for (std::size_t i = from, n = 0; i < end; i += n) {
        n = 1;
        while (i + n < end && all_[i + n] == all_[i]) ++n;
        if (n == 1) all_[kept++] = all_[i];
      }
      from = std::exchange(end, kept);
    }
    all_.resize(kept);
  }

  [[nodiscard]] bool has(const detail::Face& face) const {
    const auto [first, pair] = split(face);
    const std::size_t begin = first == 0 ? 0 : end_[first - 1];
    return std::binary_search(all_.data() + begin, all_.data() + end_[first], pair);
  }

 private:
  static std::pair<std::uint32_t, std::uint64_t> split(const detail::Face& face) {
    const auto [first, b, c] = detail::smallest_first(face);
    const auto [low, high] = std::minmax(b, c);
    return {first, std::uint64_t{low} << 32 | high};
  }

  std::vector<std::size_t> end_;  // by first corner
  std::vector<std::uint64_t> all_;
};

}  // namespace

// Half the time of HalfFaces, and less than half of its memory.
std::vector<detail::Face> boundary_faces(const Mesh<3>& mesh) {
  OtherCorners once(mesh.simplices);
  once.drop_pairs();
  std::vector<detail::Face> faces;
  for (const auto& s : mesh.simplices) {
    for (const detail::Face& f : detail::faces_of(s)) {
      if (once.has(f)) faces.push_back(detail::smallest_first(f));
    }
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

}  // namespace mesher
