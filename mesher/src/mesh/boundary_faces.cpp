// The faces of one tetrahedron alone, found at their smallest corners.
//
// Three faces of a tetrahedron have its smallest corner, and the tetrahedra with the same one
// follow each other in a mesh; only the fourth face is kept for where its own smallest corner
// comes. At one vertex few faces meet, so a table of bits tells which of them come once.
#include "mesh/boundary_faces.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "mesh/canonical.hpp"
#include "mesh/half_faces.hpp"

namespace mesher {

namespace {

using detail::Face;
using Simplex = Mesh<3>::Simplex;

// What a face has beside its smallest corner, counterclockwise after it.
struct Others {
  std::uint32_t first, second;
  friend auto operator<=>(const Others&, const Others&) = default;
};

// Which pairs of some vertices come once, either way around.
class Singles {
 public:
  /// Vertices are below `vertices`.
  explicit Singles(std::size_t vertices) : number_(vertices, kNone), numbered_(vertices) {}

  void add(const Others& pair) {
    const auto [low, high] = std::minmax({number(pair.first), number(pair.second)});
    if (count_ > kMost) return;  // there is no room
    const std::uint64_t bit = std::uint64_t{1} << high;
    more_[low] |= once_[low] & bit;
    once_[low] |= bit;
  }
  /// Whether all that were added come more than once.
  [[nodiscard]] bool is_empty() const {
    if (count_ > kMost) return false;  // it is not known
    std::uint64_t any = 0;
    for (std::size_t i = 0; i < count_; ++i) any |= once_[i] & ~more_[i];
    return any == 0;
  }
  /// Leaves of `pairs`, which are all that were added, those that come once, in order.
  void leave(std::vector<Others>& pairs) const {
    if (count_ > kMost) {
      leave_many(pairs);
    } else {
      std::erase_if(pairs, [&](const Others& pair) {
        const auto [low, high] = std::minmax(number_[pair.first], number_[pair.second]);
        return ((once_[low] & ~more_[low]) >> high & 1) == 0;
      });
    }
    std::sort(pairs.begin(), pairs.end());
  }
  void clear() {
    for (std::size_t i = 0; i < count_; ++i) number_[numbered_[i]] = kNone;
    count_ = 0;
  }

 private:
  static constexpr std::uint32_t kMost = 64, kNone = UINT32_MAX;

  // From 0 in the order of coming.
  std::uint32_t number(std::uint32_t v) {
    if (number_[v] != kNone) return number_[v];
    if (count_ < kMost) once_[count_] = more_[count_] = 0;
    numbered_[count_] = v;
    return number_[v] = count_++;
  }
  static void leave_many(std::vector<Others>& pairs) {
    const auto key = [](const Others& pair) { return std::minmax({pair.first, pair.second}); };
    std::sort(pairs.begin(), pairs.end(),
              [&](const Others& a, const Others& b) { return key(a) < key(b); });
    std::size_t kept = 0;
    for (std::size_t i = 0, n = 0; i < pairs.size(); i += n) {
      n = 1;
      while (i + n < pairs.size() && key(pairs[i + n]) == key(pairs[i])) ++n;
      if (n == 1) pairs[kept++] = pairs[i];
    }
    pairs.resize(kept);
  }

  std::vector<std::uint32_t> number_;    // by vertex
  std::vector<std::uint32_t> numbered_;  // the first count_: vertices
  std::uint32_t count_ = 0;
  // By the lesser number of two a bit for the other: there was a pair, there were more.
  std::array<std::uint64_t, kMost> once_{}, more_{};
};

// The faces across from the smallest corners, by their own smallest corners.
class AcrossFaces {
 public:
  /// Requires: tetrahedra have vertices below `vertices`, the smallest first, then the second.
  AcrossFaces(const std::vector<Simplex>& tetrahedra, std::size_t vertices)
      : begin_(vertices + 1), all_(tetrahedra.size()) {
    for (const auto& [a, b, c, d] : tetrahedra) ++begin_[b + std::size_t{1}];
    std::inclusive_scan(begin_.begin(), begin_.end(), begin_.begin());
    std::vector<std::uint32_t> at = begin_;
    for (const auto& [a, b, c, d] : tetrahedra) all_[at[b]++] = {c, d};
  }

  template <class Visit>
  void for_each(std::uint32_t v, Visit&& visit) const {
    std::for_each(all_.begin() + begin_[v], all_.begin() + begin_[v + 1], visit);
  }

 private:
  std::vector<std::uint32_t> begin_;  // by vertex
  std::vector<Others> all_;
};

// Requires: smallest corners are first, then the second ones, and the first ascend.
std::vector<Face> faces_that_come_once(const std::vector<Simplex>& tetrahedra,
                                       std::uint32_t vertices) {
  const AcrossFaces across(tetrahedra, vertices);
  Singles singles(vertices);
  std::vector<Face> faces;
  std::vector<Others> pairs;
  auto from = tetrahedra.begin();
  for (std::uint32_t v = 0; v < vertices; ++v) {
    const auto to = std::find_if(from, tetrahedra.end(), [&](const auto& s) { return s[0] != v; });
    const auto for_each = [&](auto&& visit) {
      for (auto s = from; s != to; ++s) {
        const auto& [a, b, c, d] = *s;
        visit(Others{d, c}), visit(Others{b, d}), visit(Others{c, b});
      }
      across.for_each(v, visit);
    };
    for_each([&](const Others& pair) { singles.add(pair); });
    if (!singles.is_empty()) {
      pairs.clear();
      for_each([&](const Others& pair) { pairs.push_back(pair); });
      singles.leave(pairs);
      for (const auto& [b, c] : pairs) faces.push_back({v, b, c});
    }
    singles.clear();
    from = to;
  }
  return faces;
}

}  // namespace

std::vector<Face> boundary_faces(const Mesh<3>& mesh) {
  std::uint32_t most = 0, last = 0;
  bool in_order = true;
  for (const auto& [a, b, c, d] : mesh.simplices) {
    in_order &= last <= a && a < b && b < c && b < d;
    last = a;
    most = std::max({most, a, b, c, d});
  }
  if (in_order) return faces_that_come_once(mesh.simplices, most + 1);
  std::vector<Simplex> sorted;
  sorted.reserve(mesh.simplices.size());
  for (const Simplex& s : mesh.simplices) sorted.push_back(detail::smallest_first(s));
  std::sort(sorted.begin(), sorted.end());
  return faces_that_come_once(sorted, most + 1);
}

}  // namespace mesher
