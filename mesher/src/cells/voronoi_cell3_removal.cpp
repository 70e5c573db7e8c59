// A neighbour of a cell in space that goes.
//
// Its side of the cell is lost; who bounds the cell there instead are some of those whose sides
// were next to it: the side of any other would have to cross the lost one's plane, and then was
// next to it. So its triangles are taken from the link, and the hole is filled by ears: three in a
// row whose ball no other of the rim is in.
#include <algorithm>
#include <cstddef>

#include "cells/voronoi_cell3.hpp"
#include "geometry/circumcentre.hpp"
#include "geometry/space_vectors.hpp"
#include "mesher/predicates.hpp"

namespace mesher::detail {

// Returns false, and then leaves no cell, if the others do not surround v, or if it would take
// long.
bool VoronoiCell3::remove(int i) {
  constexpr int kMost = 32;  // ears are looked for in the cube of this
  if (uses_[index(i)] > kMost) return false;
  taken_.clear();
  for (int t = 0; t < corners_; ++t) {
    const auto& [a, b, c] = ends(t);
    is_taken_[index(t)] = a == i || b == i || c == i;
    if (is_taken_[index(t)] != 0) taken_.push_back(t);
  }
  find_rim();
  walk_rim();
  release_ends();
  const std::size_t gone = taken_.size();
  for (std::size_t k = 0; k + 2 < gone; ++k) {
    std::size_t at = 0;
    while (at < hole_.size() && !is_ear(at)) ++at;
    if (at == hole_.size()) return false;
    cut_ear(at, taken_[k]);
  }
  give_up_number(taken_[gone - 1]);
  give_up_number(taken_[gone - 2]);
  return true;
}

void VoronoiCell3::walk_rim() {
  hole_.clear();
  int at = 0;
  do {
    const Rim& edge = rim_[index(at)];
    hole_.push_back({edge.from, edge.beyond});
    at = rim_at_[index(edge.to)];
  } while (at != 0);
}

// Whether hole_[at] and the two behind are a triangle of the cell.
bool VoronoiCell3::is_ear(std::size_t at) {
  const std::size_t n = hole_.size();
  const int a = hole_[at].from, b = hole_[(at + 1) % n].from, c = hole_[(at + 2) % n].from;
  if (predicates::orient3d(v_->p, place(a), place(b), place(c)) <= 0) return false;
  const Circumcentre corner = circumcentre(v_->p, place(a), place(b), place(c));
  return std::none_of(rim_.begin(), rim_.end(), [&](const Rim& edge) {
    const int i = edge.from;
    if (i == a || i == b || i == c) return false;
    const Point<3>& u = u_[index(i)];
    const double u2 = squared(u), value = 2 * dot(u, corner.q) - u2;
    if (value * value > corner.tolerance2 * u2) return value > 0;
    return predicates::insphere_perturbed(v_->p, place(a), place(b), place(c), place(i)) > 0;
  });
}

// The ear's triangle takes the number t. The last one, of the three that are left, has no new edge.
void VoronoiCell3::cut_ear(std::size_t at, int t) {
  const std::size_t n = hole_.size();
  Side& first = hole_[at];
  const Side second = hole_[(at + 1) % n], third = hole_[(at + 2) % n];
  const int beyond = n == 3 ? third.beyond : -1;
  set_face(t, {{first.from, second.from, third.from}, {second.beyond, beyond, first.beyond}}, true);
  link_across(first.beyond, first.from, second.from, t);
  link_across(second.beyond, second.from, third.from, t);
  if (n == 3) return link_across(third.beyond, third.from, first.from, t);
  first.beyond = t;
  hole_.erase(hole_.begin() + static_cast<std::ptrdiff_t>((at + 1) % n));
}

}  // namespace mesher::detail
