// Cutting the Voronoi cell in any dimension.
#include "cells/voronoi_cell_any.hpp"

#include <bit>
#include <cmath>
#include <limits>

#include "cells/voronoi_cell_any_says.hpp"
#include "sac/check.hpp"

namespace mesher::detail {

namespace {

// Orthogonal, of determinant 1, rational, and aligned with no axis: the directions of the clip.
template <int D>
constexpr double kClipLength = 0;
template <>
constexpr double kClipLength<3> = 7;
template <>
constexpr double kClipLength<4> = 9;
template <int D>
constexpr std::array<Point<D>, D> kClipDirections{};
template <>
constexpr std::array<Point<3>, 3> kClipDirections<3>{{{2, 3, 6}, {3, -6, 2}, {6, 2, -3}}};
template <>  // products of quaternions
constexpr std::array<Point<4>, 4> kClipDirections<4>{
    {{5, -2, -4, -6}, {2, 5, -6, 4}, {4, 6, 5, -2}, {6, -4, 2, 5}}};

}  // namespace

template <int D>
Point<D> VoronoiCellAny<D>::clip_place(const Point<D>& v, double radius, std::size_t i) {
  const double length = (i % 2 == 0 ? 2 : -2) * radius / kClipLength<D>;
  return plus(v, scaled(length, kClipDirections<D>[i / 2]));
}

// --- Columns ---------------------------------------------------------------------------------

template <int D>
int VoronoiCellAny<D>::new_neighbour(Code code, const Point<D>& place) {
  int i = size();
  if (unused_.empty()) {
    neighbours_.emplace_back();
  } else {
    i = unused_.back();
    unused_.pop_back();
  }
  neighbours_[index(i)] = {minus(place, v_->p), place, code, 0};
  return i;
}

template <int D>
int VoronoiCellAny<D>::new_face() {
  faces_.emplace_back();
  const std::size_t n = faces_.size();
  q2_.resize(n), tolerance2_.resize(n), is_open_.resize(n), open_.resize(n);
  return static_cast<int>(n - 1);
}

template <int D>
void VoronoiCellAny<D>::set_face(int t, const Ends& end, bool open) {
  for (const int i : end) ++neighbours_[index(i)].uses;
  const BallCentre<D> c = ball_centre<D>(v_->p, places(end));
  Face& face = faces_[index(t)];
  face.end = end, face.q = c.q, face.taken = false;
  is_open_[index(t)] = open;
  q2_[index(t)] = c.length2;
  tolerance2_[index(t)] = c.tolerance2;
}

// A face for each choice of signs along the directions, a bit each. An odd number of negative ones
// turns the orientation round.
template <int D>
void VoronoiCellAny<D>::reset(const Vertex<D>& v, double radius) {
  SAC_EXPECTS(radius > 0);
  v_ = &v;
  neighbours_.clear(), unused_.clear(), faces_.clear();
  for (std::size_t i = 0; i < kClips; ++i) {
    static_cast<void>(new_neighbour(kVirtual | static_cast<Code>(i), clip_place(v.p, radius, i)));
  }
  for (int t = 0; t < 1 << D; ++t) {
    Ends end, across;
    for (int i = 0; i < D; ++i) end[index(i)] = 2 * i + (t >> i & 1), across[index(i)] = t ^ 1 << i;
    if (std::popcount(static_cast<unsigned>(t)) % 2 == 1) {
      std::swap(end[D - 2], end[D - 1]);
      std::swap(across[D - 2], across[D - 1]);
    }
    set_face(new_face(), end, true);
    faces_.back().across = across;
  }
  update_reach();
}

template <int D>
void VoronoiCellAny<D>::close_known(std::span<const Code> record) {
  using Simplex = std::array<Code, D>;
  const auto sorted = [](Simplex s) { return std::sort(s.begin(), s.end()), s; };
  std::vector<Simplex> known;
  for_each_link_simplex(record, [&](const Simplex& s) { known.push_back(sorted(s)); });
  std::sort(known.begin(), known.end());
  for (int t = 0; t < corners(); ++t) {
    Simplex s;
    for (std::size_t k = 0; k < D; ++k) s[k] = code(ends(t)[k]);
    if (std::binary_search(known.begin(), known.end(), sorted(s))) is_open_[index(t)] = 0;
  }
  update_reach();
}

// --- Cuts ------------------------------------------------------------------------------------

template <int D>
bool VoronoiCellAny<D>::takes(int t) {
  const double value = 2 * dot(aim_, corner(t)) - w2_;
  if (value * value > tolerance2_[index(t)] * w2_) return value > 0;
  for (const int i : ends(t)) {
    if (place(i) != w_) continue;
    replaces_ = i;
    return false;
  }
  return in_ball_perturbed<D>(v_->p, places(ends(t)), w_) > 0;
}

template <int D>
bool VoronoiCellAny<D>::cuts(const Point<D>& w) {
  w_ = w;
  aim_ = minus(w, v_->p);
  w2_ = squared(aim_);
  replaces_ = -1;
  taken_.clear();
  if (w2_ > 4 * reach2_ * (1 + 0x1p-16)) return false;  // and more than corners are off by
  for (int t = 0; t < corners(); ++t) {
    faces_[index(t)].taken = takes(t);
    if (faces_[index(t)].taken) taken_.push_back(t);
  }
  if (taken_.empty()) return replaces_ >= 0 && !real(replaces_);
  replaces_ = -1;
  return true;
}

template <int D>
void VoronoiCellAny<D>::cut(Code w) {
  if (replaces_ >= 0) {
    neighbours_[index(replaces_)].code = w;
    return;
  }
  const std::vector<Rim> rim = find_rim();
  const int number = new_neighbour(w, w_);
  release_ends();
  const std::size_t gone = taken_.size();
  std::vector<int> fresh;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    fresh.push_back(i < gone ? taken_[i] : new_face());
  }
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const Rim& r = rim[i];
    Face& beyond = faces_[index(r.beyond)];
    for (std::size_t k = 0; k < D; ++k) {
      if (std::find(r.end.begin(), r.end.end(), beyond.end[k]) == r.end.end() ||
          beyond.end[k] == r.end[r.k]) {
        beyond.across[k] = fresh[i];
      }
    }
    Ends end = r.end;
    end[r.k] = number;
    set_face(fresh[i], end, r.open);
    faces_[index(fresh[i])].across[r.k] = r.beyond;
  }
  join(fresh, index(number));
  for (std::size_t i = gone; i-- > rim.size();) give_up_number(taken_[i]);
  update_reach();
}

template <int D>
auto VoronoiCellAny<D>::find_rim() const -> std::vector<Rim> {
  std::vector<Rim> rim;
  for (const int t : taken_) {
    const Face& face = faces_[index(t)];
    for (std::size_t k = 0; k < D; ++k) {
      const int beyond = face.across[k];
      if (faces_[index(beyond)].taken) continue;
      rim.push_back({face.end, k, beyond, (is_open_[index(t)] | is_open_[index(beyond)]) != 0});
    }
  }
  return rim;
}

template <int D>
void VoronoiCellAny<D>::release_ends() {
  for (const int t : taken_) {
    for (const int i : ends(t)) {
      if (--neighbours_[index(i)].uses > 0) continue;
      neighbours_[index(i)].code = kUnused;
      unused_.push_back(i);
    }
  }
}

// Of the faces of w: tells each who is beyond its ridges that have w.
template <int D>
void VoronoiCellAny<D>::join(const std::vector<int>& fresh, std::size_t w) {
  struct Ridge {
    std::array<int, D - 1> ends;
    int face;
    std::size_t k;
  };
  std::vector<Ridge> ridges;
  for (const int t : fresh) {
    const Ends& end = ends(t);
    for (std::size_t k = 0; k < D; ++k) {
      if (index(end[k]) == w) continue;
      Ridge ridge{{}, t, k};
      std::size_t n = 0;
      for (std::size_t i = 0; i < D; ++i) {
        if (i != k) ridge.ends[n++] = end[i];
      }
      std::sort(ridge.ends.begin(), ridge.ends.end());
      ridges.push_back(ridge);
    }
  }
  std::sort(ridges.begin(), ridges.end(), [](const Ridge& a, const Ridge& b) {
    return a.ends != b.ends ? a.ends < b.ends : a.face < b.face;
  });
  SAC_ENSURES(ridges.size() % 2 == 0);
  for (std::size_t i = 0; i + 1 < ridges.size(); i += 2) {
    const Ridge &a = ridges[i], &b = ridges[i + 1];
    SAC_ENSURES(a.ends == b.ends);
    faces_[index(a.face)].across[a.k] = b.face;
    faces_[index(b.face)].across[b.k] = a.face;
  }
}

// The last face takes the number t. (Numbers are given up from the greatest on.)
template <int D>
void VoronoiCellAny<D>::give_up_number(int t) {
  const int last = corners() - 1;
  if (t != last) {
    const std::size_t to = index(t), from = index(last);
    faces_[to] = faces_[from];
    q2_[to] = q2_[from], tolerance2_[to] = tolerance2_[from], is_open_[to] = is_open_[from];
    for (const int other : faces_[to].across) {
      for (int& back : faces_[index(other)].across) back = back == last ? t : back;
    }
  }
  faces_.pop_back();
}

template class VoronoiCellAny<3>;
template class VoronoiCellAny<4>;

}  // namespace mesher::detail
