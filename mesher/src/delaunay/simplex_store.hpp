// The simplices of a triangulation in flat memory (simplex_layout.hpp), and a list of free places.
//
// A simplex is its place in the arrays. Across its corner i lies the neighbour across[s][i] >> 2,
// whose corner across[s][i] & 3 is across from s. A free place has the corner kNone first, and the
// next free one in across[s][0].
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "delaunay/simplex_layout.hpp"
#include "mesher/error.hpp"

namespace mesher::detail {

/// No simplex, or no vertex.
inline constexpr std::uint32_t kNone = UINT32_MAX;

template <int D, class Layout = ArrayLayout<D>>
class SimplexStore {
 public:
  using Ids = typename Layout::Ids;
  /// A neighbour's number leaves two bits for its corner.
  static constexpr std::size_t kMost = std::size_t{1} << 30;

  SimplexStore() = default;
  /// The same simplices in another layout, without their balls.
  template <class Other>
  explicit SimplexStore(const SimplexStore<D, Other>& other)
      : free_(other.free_), free_count_(other.free_count_) {
    all_.resize(other.places());
    for (std::uint32_t s = 0; s < places(); ++s) {
      corners(s) = other.corners(s);
      across(s) = other.across(s);
    }
  }

  [[nodiscard]] std::size_t places() const noexcept { return all_.size(); }
  [[nodiscard]] std::size_t size() const noexcept { return all_.size() - free_count_; }
  [[nodiscard]] bool alive(std::uint32_t s) const noexcept { return corners(s)[0] != kNone; }
  [[nodiscard]] const Ids& corners(std::uint32_t s) const noexcept { return all_.corners(s); }
  [[nodiscard]] const Ids& across(std::uint32_t s) const noexcept { return all_.across(s); }
  [[nodiscard]] Ids& corners(std::uint32_t s) noexcept { return all_.corners(s); }
  [[nodiscard]] Ids& across(std::uint32_t s) noexcept { return all_.across(s); }
  /// If the layout has balls.
  [[nodiscard]] const SimplexBall<D>& ball(std::uint32_t s) const noexcept { return all_.ball(s); }
  [[nodiscard]] SimplexBall<D>& ball(std::uint32_t s) noexcept { return all_.ball(s); }

  void reserve(std::size_t n) { all_.reserve(n); }
  [[nodiscard]] std::size_t bytes() const noexcept { return all_.bytes(); }
  /// The next n calls of take() will find a place. Strong guarantee.
  /// Throws: Error(too_many) beyond kMost simplices.
  void make_room(std::size_t n) {
    if (free_count_ < n) grow(n - free_count_);
  }
  /// Requires: make_room was called for it.
  [[nodiscard]] std::uint32_t take() noexcept {
    const std::uint32_t s = free_;
    free_ = across(s)[0];
    --free_count_;
    return s;
  }
  void give(std::uint32_t s) noexcept {
    corners(s)[0] = kNone;
    across(s)[0] = free_;
    free_ = s;
    ++free_count_;
  }
  void clear() noexcept {
    all_.clear();
    free_ = kNone;
    free_count_ = 0;
  }
  /// Makes simplex s and its neighbour across corner i meet.
  void join(std::uint32_t s, std::uint32_t i, std::uint32_t other, std::uint32_t k) noexcept {
    across(s)[i] = other << 2 | k;
    across(other)[k] = s << 2 | i;
  }

  /// Takes out the simplices of which remove(corners) is true, and closes all gaps by simplices
  /// from the end. Neighbours that went are kNone afterwards.
  template <class Remove>
  void remove_if(Remove&& remove) noexcept;

  /// Takes the arrays out; nothing is left.
  [[nodiscard]] std::vector<Ids> release_corners() noexcept { return all_.release_corners(); }
  [[nodiscard]] std::vector<Ids> release_across() noexcept { return all_.release_across(); }

 private:
  template <int, class>
  friend class SimplexStore;

  void move(std::uint32_t from, std::uint32_t to) noexcept;
  void grow(std::size_t more) {
    const std::size_t size = all_.size();
    if (size + more > kMost) throw Error(ErrorCode::too_many, "more than 2^30 simplices");
    all_.resize(size + more);
    for (std::size_t s = size + more; s-- > size;) give(static_cast<std::uint32_t>(s));
  }

  Layout all_;
  std::uint32_t free_ = kNone;
  std::size_t free_count_ = 0;
};

template <int D, class Layout>
template <class Remove>
void SimplexStore<D, Layout>::remove_if(Remove&& remove) noexcept {
  const auto unlink = [&](std::uint32_t s) {
    for (const std::uint32_t code : across(s)) {
      if (code != kNone) across(code >> 2)[code & 3] = kNone;
    }
    corners(s)[0] = kNone;
  };
  for (std::uint32_t s = 0; s < places(); ++s) {
    if (alive(s) && remove(corners(s))) unlink(s);
  }
  std::size_t end = places();
  for (std::uint32_t s = 0; s < end; ++s) {
    while (s < end && !alive(static_cast<std::uint32_t>(end - 1))) --end;
    if (s < end && !alive(s)) move(static_cast<std::uint32_t>(--end), s);
  }
  all_.resize(end);
  free_ = kNone;
  free_count_ = 0;
}

template <int D, class Layout>
void SimplexStore<D, Layout>::move(std::uint32_t from, std::uint32_t to) noexcept {
  corners(to) = corners(from);
  across(to) = across(from);
  for (std::uint32_t i = 0; i <= D; ++i) {
    const std::uint32_t code = across(to)[i];
    if (code != kNone) across(code >> 2)[code & 3] = to << 2 | i;
  }
}

}  // namespace mesher::detail
