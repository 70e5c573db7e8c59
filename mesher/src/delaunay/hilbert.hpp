// The Hilbert curve through the cells of a grid of 2^levels cells along each axis.
//
// Source: C. Hamilton, "Compact Hilbert Indices", Dalhousie University, CS-2006-07. On its way
// through a cube of 2 x 2 (x 2) cells the curve visits them in the order of a Gray code; where it
// enters a cell (a corner) and along which axis it leaves tell how it goes on inside. Tables of
// that, made by the compiler, take one look-up a level.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace mesher::detail {

/// How the curve goes through a cube, by state (the corner `entry` where it enters, the axis `exit`
/// along which it leaves) and child cell.
template <int D>
class HilbertTable {
 public:
  static constexpr std::uint32_t kChildren = 1u << D;

  constexpr HilbertTable() {
    for (std::uint32_t entry = 0; entry < kChildren; ++entry) {
      for (std::uint32_t exit = 0; exit < D; ++exit) {
        for (std::uint32_t child = 0; child < kChildren; ++child) set(entry, exit, child);
      }
    }
  }

  /// Appends a level to an index: `child` has bit i set in the upper half along axis i.
  template <class Index>
  constexpr void descend(Index& index, std::uint32_t& state, std::uint32_t child) const {
    const Step step = steps_[state * kChildren + child];
    index = index << D | step.rank;
    state = step.state;
  }

 private:
  struct Step {
    std::uint8_t rank = 0, state = 0;
  };

  static constexpr std::uint32_t kMask = kChildren - 1;
  static constexpr std::uint32_t rotated_left(std::uint32_t x, std::uint32_t by) {
    return (x << by % D | x >> (D - by % D)) & kMask;
  }
  static constexpr std::uint32_t gray(std::uint32_t i) { return i ^ i >> 1; }
  static constexpr std::uint32_t gray_inverse(std::uint32_t code) {
    std::uint32_t i = code;
    for (std::uint32_t shift = 1; shift < D; ++shift) i ^= code >> shift;
    return i;
  }
  // Hamilton's e(w) and d(w): where the w-th child is entered, along which axis it is left.
  static constexpr std::uint32_t entry_of(std::uint32_t w) {
    return w == 0 ? 0 : gray((w - 1) / 2 * 2);
  }
  static constexpr std::uint32_t exit_of(std::uint32_t w) {
    if (w == 0) return 0;
    return static_cast<std::uint32_t>(std::countr_one(w % 2 == 0 ? w - 1 : w)) % D;
  }
  constexpr void set(std::uint32_t entry, std::uint32_t exit, std::uint32_t child) {
    const std::uint32_t rank = gray_inverse(rotated_left(child ^ entry, D - (exit + 1) % D));
    const std::uint32_t inner_entry = entry ^ rotated_left(entry_of(rank), exit + 1);
    const std::uint32_t inner_exit = (exit + exit_of(rank) + 1) % D;
    steps_[(entry * D + exit) * kChildren + child] = {
        static_cast<std::uint8_t>(rank), static_cast<std::uint8_t>(inner_entry * D + inner_exit)};
  }

  std::array<Step, kChildren * D * kChildren> steps_{};
};

template <int D>
inline constexpr HilbertTable<D> kHilbert{};

/// The place of a cell on the curve through 2^(D levels) cells.
template <int D>
[[nodiscard]] constexpr std::uint64_t hilbert_index(const std::array<std::uint32_t, D>& cell,
                                                    int levels) {
  std::uint64_t index = 0;
  std::uint32_t state = 0;
  for (int level = levels; level-- > 0;) {
    std::uint32_t child = 0;
    for (std::uint32_t i = 0; i < D; ++i) child |= (cell[i] >> level & 1) << i;
    kHilbert<D>.descend(index, state, child);
  }
  return index;
}

}  // namespace mesher::detail
