// By the chords between corners, the shorter runs of the loop first.
#include "repair/least_surface.hpp"

#include <cmath>
#include <tuple>
#include <utility>

#include "geometry/space_vectors.hpp"

namespace mesher::detail {

namespace {

// What is best between two corners.
struct Chord {
  std::size_t faults = 0;
  double area = 0;
  std::size_t apex = 0;

  [[nodiscard]] bool operator<(const Chord& o) const {
    return std::tie(faults, area) < std::tie(o.faults, o.area);
  }
};

}  // namespace

LeastSurface least_surface(
    const std::vector<Point<3>>& loop,
    const std::function<std::size_t(std::size_t, std::size_t, std::size_t)>& fault) {
  const std::size_t n = loop.size();
  const auto area = [&](std::size_t i, std::size_t k, std::size_t j) {
    return std::sqrt(squared(cross(minus(loop[k], loop[i]), minus(loop[j], loop[i]))));
  };
  std::vector<std::vector<Chord>> chords(n, std::vector<Chord>(n));
  for (std::size_t span = 2; span < n; ++span) {
    for (std::size_t i = 0; i + span < n; ++i) {
      const std::size_t j = i + span;
      for (std::size_t k = i + 1; k < j; ++k) {
        const Chord &left = chords[i][k], &right = chords[k][j];
        const Chord all{left.faults + right.faults + fault(i, k, j),
                        left.area + right.area + area(i, k, j), k};
        if (k == i + 1 || all < chords[i][j]) chords[i][j] = all;
      }
    }
  }
  LeastSurface least{{}, chords[0][n - 1].faults};
  std::vector<std::pair<std::size_t, std::size_t>> ahead{{0, n - 1}};
  while (!ahead.empty()) {
    const auto [i, j] = ahead.back();
    ahead.pop_back();
    if (j - i < 2) continue;
    const std::size_t k = chords[i][j].apex;
    least.triangles.push_back({i, k, j});
    ahead.insert(ahead.end(), {{k, j}, {i, k}});
  }
  return least;
}

}  // namespace mesher::detail
