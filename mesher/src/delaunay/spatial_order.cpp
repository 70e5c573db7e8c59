// Keys of (round, place on the curve), sorted by their digits.
#include "delaunay/spatial_order.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include "delaunay/hilbert.hpp"
#include "geometry/box.hpp"
#include "geometry/place_hash.hpp"
#include "sets/counting_sort.hpp"

namespace mesher::detail {

namespace {

// The first round has at least this many points, if there are as many.
constexpr std::size_t kFirstRound = 64;
constexpr int kRoundBits = 3;  // of the hash: 1 in 8 points belongs to an earlier round
// Points of one cell are ordered by a finer grid of their own from so many on.
constexpr std::size_t kCrowd = 8;

struct Keyed {
  std::uint32_t key, index;
};

// A grid on a box: 2^levels cells along its longest side, some 64 for each of n points in a square.
// Keys have 28 bits at most, above them is room for the round.
template <int D>
class Grid {
 public:
  Grid(const Box<D>& box, std::size_t n)
      : lo_(box.lo),
        levels_(std::min(28 / D, (static_cast<int>(std::bit_width(n)) + 6) / D + 1)),
        cells_(static_cast<double>(1u << levels_)) {
    const double side = longest_side(box);
    scale_ = side > 0 ? cells_ / side : 0;
  }
  [[nodiscard]] std::uint32_t key_of(const Point<D>& p) const {
    std::array<std::uint32_t, D> cell;
    for (std::size_t i = 0; i < D; ++i) {
      cell[i] = static_cast<std::uint32_t>(std::min((p[i] - lo_[i]) * scale_, cells_ - 1));
    }
    return static_cast<std::uint32_t>(hilbert_index<D>(cell, levels_));
  }
  [[nodiscard]] int bits() const { return D * levels_; }

 private:
  Point<D> lo_;
  int levels_;
  double cells_, scale_;
};

std::uint32_t rounds_of(std::size_t n) {
  std::uint32_t rounds = 1;
  for (; n > kFirstRound << kRoundBits && rounds < 16; n >>= kRoundBits) ++rounds;
  return rounds;
}

// A stable sort: of many items 11 bits at a time.
void sort_by_key(std::vector<Keyed>& items, int bits) {
  if (items.size() < 512) {
    std::stable_sort(items.begin(), items.end(),
                     [](const Keyed& a, const Keyed& b) { return a.key < b.key; });
    return;
  }
  constexpr int kDigit = 11;
  std::vector<Keyed> other(items.size());
  for (int shift = 0; shift < bits; shift += kDigit) {
    sort_by_part<Keyed>(items, other, std::size_t{1} << kDigit,
                        [&](const Keyed& k) { return k.key >> shift & ((1u << kDigit) - 1); });
    items.swap(other);
  }
}

template <int D>
class Sorter {
 public:
  explicit Sorter(std::span<const Point<D>> points) : points_(points) {}

  // `same_round`: whether these are of one round.
  void sort(std::span<std::uint32_t> some, bool same_round) const {
    const Grid<D> grid(box_of(some), some.size());
    const std::uint32_t rounds = same_round ? 1 : rounds_of(some.size());
    std::vector<Keyed> items(some.size());
    for (std::size_t i = 0; i < some.size(); ++i) {
      const Point<D>& p = points_[some[i]];
      items[i] = {round_of(p, rounds) << grid.bits() | grid.key_of(p), some[i]};
    }
    sort_by_key(items, grid.bits() + static_cast<int>(std::bit_width(rounds - 1)));
    for (std::size_t i = 0; i < items.size(); ++i) some[i] = items[i].index;
    for (std::size_t i = 0, end; i < items.size(); i = end) {
      for (end = i + 1; end < items.size() && items[end].key == items[i].key;) ++end;
      if (end - i > 1) sort_cell(some.subspan(i, end - i));
    }
  }

 private:
  // Points of one cell and round.
  void sort_cell(std::span<std::uint32_t> cell) const {
    if (cell.size() < kCrowd) {
      std::sort(cell.begin(), cell.end(), [&](std::uint32_t a, std::uint32_t b) {
        return points_[a] != points_[b] ? points_[a] < points_[b] : a < b;
      });
      return;
    }
    const Point<D>& first = points_[cell.front()];
    const bool differ =
        std::any_of(cell.begin(), cell.end(), [&](std::uint32_t i) { return points_[i] != first; });
    if (differ) sort(cell, true);
  }
  [[nodiscard]] Box<D> box_of(std::span<const std::uint32_t> some) const {
    Box<D> box{points_[some.front()], points_[some.front()]};
    for (const std::uint32_t i : some) grow(box, points_[i]);
    return box;
  }
  // Early rounds have small numbers.
  static std::uint32_t round_of(const Point<D>& p, std::uint32_t rounds) {
    const int early = std::countr_zero(place_hash(p)) / kRoundBits;
    return rounds - 1 - std::min(rounds - 1, static_cast<std::uint32_t>(early));
  }

  std::span<const Point<D>> points_;
};

}  // namespace

template <int D>
std::vector<std::uint32_t> spatial_order(std::span<const Point<D>> points) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  if (!order.empty()) Sorter<D>(points).sort(order, false);
  return order;
}

template std::vector<std::uint32_t> spatial_order<2>(std::span<const Point<2>>);
#ifndef MESHER_PLANE_ONLY
template std::vector<std::uint32_t> spatial_order<3>(std::span<const Point<3>>);
#endif

}  // namespace mesher::detail
