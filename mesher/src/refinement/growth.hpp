// How fast sizes grow in a refined mesh [Borouchaki, Hecht, Frey 1998]: each vertex has a size, and
// a vertex w at an edge vw has at most growth - 1 times the length of vw more than v.
//
// Sizes begin with those of the smallest simplices at vertices, by their longest edges, when no
// simplex is poor, and with limits of size. (With those of later meshes they would go to 0:
// vertices are a little nearer to each other than their sizes say. With shortest edges there are
// three times as many vertices on surfaces.)
#pragma once

#include <cstdint>
#include <queue>
#include <vector>

#include "delaunay/kernel.hpp"

namespace mesher::detail {

template <int D>
class Growth {
 public:
  using Kernel = DelaunayKernel<D, BallLayout<D>>;

  /// `growth`: above 1, or 0: any.
  explicit Growth(double growth) : slope_(growth - 1), any_(growth != 0) {}

  [[nodiscard]] bool any() const noexcept { return any_; }
  /// The size at a place in simplex s, by its corners.
  [[nodiscard]] double at(const Kernel& kernel, std::uint32_t s, const Point<D>& p) const;
  /// The least at a corner.
  [[nodiscard]] double least(const Kernel& kernel, std::uint32_t s) const;

  /// From the edges of all simplices.
  void start(const Kernel& kernel);
  /// No corner of s has more than `size`.
  void bound(const Kernel& kernel, std::uint32_t s, double size);
  /// Of a vertex that is dug: it has at most `size`, and what follows from its neighbours.
  void add_dug(const Kernel& kernel, std::uint32_t v, double size);
  /// Lowers sizes until all grow slowly, and calls visit(simplex) for those around vertices that
  /// have less now.
  template <class Visit>
  void spread(Kernel& kernel, Visit&& visit);

 private:
  struct Lowered {
    double size;
    std::uint32_t v;
    friend bool operator<(const Lowered& a, const Lowered& b) {  // the least goes first
      return a.size != b.size ? a.size > b.size : a.v > b.v;
    }
  };
  void lower(std::uint32_t v, double size);

  double slope_;
  bool any_;
  std::vector<double> size_;  // by vertex
  std::priority_queue<Lowered> lowered_;
  std::vector<std::uint32_t> star_;  // scratch
};

template <int D>
template <class Visit>
void Growth<D>::spread(Kernel& kernel, Visit&& visit) {
  while (!lowered_.empty()) {
    const auto [size, v] = lowered_.top();
    lowered_.pop();
    if (size != size_[v]) continue;
    static_cast<void>(kernel.find_in_star(v, star_, [](std::uint32_t) { return false; }));
    for (const std::uint32_t s : star_) {
      for (const std::uint32_t w : kernel.simplices().corners(s)) {
        if (w == kInfinite || w == v) continue;
        lower(w, size + slope_ * std::sqrt(squared_distance(kernel.place(v), kernel.place(w))));
      }
      if (!kernel.is_ghost(s)) visit(s);
    }
  }
}

}  // namespace mesher::detail
