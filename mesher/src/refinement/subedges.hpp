// The pieces of the input's edges between vertices that lie on them: M_f of an edge [2.3].
#pragma once

#include <tsl/robin_map.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "delaunay/simplex_store.hpp"
#include "space/feature.hpp"

namespace mesher::detail {

class Subedges {
 public:
  /// Between vertices a and b; `lo` is a's label.
  struct Piece {
    std::uint32_t a, b;
    Label lo, hi;
    EdgeHandle edge;
    PieceKind kind = PieceKind::whole;  // in the plane: how it is split
    bool encroached = false;            // it is to be split
    bool by_centre = false;             // even if it is an edge
    std::uint32_t by = kNone;           // a vertex in its ball, if it is known
    std::uint32_t next = kNone;         // of the same edge
  };

  [[nodiscard]] const Piece& operator[](std::uint32_t i) const noexcept { return all_[i]; }
  /// The piece between two vertices, in either order; kNone: there is none.
  [[nodiscard]] std::uint32_t find(std::uint32_t a, std::uint32_t b) const {
    const auto it = by_ends_.find(key(a, b));
    return it == by_ends_.end() ? kNone : it->second;
  }
  /// A piece of an edge, from its a on: at first, or after the one that was added before.
  /// Throws: std::bad_alloc, and then changes nothing that matters.
  std::uint32_t add(const Piece& piece) {
    if (!all_.empty() && all_.back().edge == piece.edge) {
      all_.back().next = size();
    } else {
      first_.insert_or_assign(piece.edge, size());
    }
    return push(piece);
  }
  /// Splits a piece at vertex m: it is the part at a afterwards. Returns the other part. `kinds`:
  /// of both.
  std::uint32_t split(std::uint32_t i, std::uint32_t m, const Label& at,
                      const std::array<PieceKind, 2>& kinds = {}) {
    Piece rest = all_[i];
    rest.a = m, rest.lo = at, rest.kind = kinds[1], rest.encroached = rest.by_centre = false;
    by_ends_.erase(key(all_[i].a, all_[i].b));
    all_[i].next = size();
    all_[i].b = m, all_[i].hi = at, all_[i].kind = kinds[0];
    all_[i].encroached = all_[i].by_centre = false;
    by_ends_.insert_or_assign(key(all_[i].a, m), i);
    return push(rest);
  }
  /// The first piece of an edge of which ends_behind(piece). Requires: there is one. Cost: the
  /// pieces before it.
  template <class EndsBehind>
  [[nodiscard]] std::uint32_t find_on(EdgeHandle e, EndsBehind&& ends_behind) const {
    std::uint32_t i = first_.at(e);
    while (!ends_behind(all_[i])) i = all_[i].next;
    return i;
  }
  /// By a vertex, or kNone. Returns: whether it was not.
  bool set_encroached(std::uint32_t i, std::uint32_t by, bool by_centre = false) noexcept {
    all_[i].by_centre = all_[i].by_centre || by_centre;
    if (all_[i].encroached) return false;
    all_[i].encroached = true;
    all_[i].by = by;
    return true;
  }
  void set_fine(std::uint32_t i) noexcept { all_[i].encroached = all_[i].by_centre = false; }

  [[nodiscard]] std::uint32_t size() const noexcept {
    return static_cast<std::uint32_t>(all_.size());
  }

 private:
  std::uint32_t push(const Piece& piece) {
    all_.push_back(piece);
    by_ends_.insert_or_assign(key(piece.a, piece.b), size() - 1);
    return size() - 1;
  }
  [[nodiscard]] static std::uint64_t key(std::uint32_t a, std::uint32_t b) noexcept {
    return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
  }
  struct Hash {
    std::size_t operator()(std::uint64_t k) const noexcept { return sac::mix(k); }
  };

  std::vector<Piece> all_;
  tsl::robin_map<EdgeHandle, std::uint32_t> first_;
  tsl::robin_map<std::uint64_t, std::uint32_t, Hash> by_ends_;
};

}  // namespace mesher::detail
