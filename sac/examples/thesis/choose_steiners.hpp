// ChooseSteiners [Fig 4.7, 4.10] and Complete, line by line, in any dimension.
//
// The queue is an agenda: bucket, ComputeNN before Complete, colour, then the order of the
// vertices. Two vertices of one colour in different elements of the grid are independent, and those
// in one element come in their order, so 2^D colours are enough ("we only need 2^d shifts"; the
// caption of Fig 4.9 has 3^d).
//
// Where the figures leave something open, or err:
// - Before Complete(v) is added, Fig 4.7 asks for |uv| <= NN^(v), which is defined nowhere.
// Fig 4.10
//   adds it always, and so does this.
// - A key may be too long when its turn comes: another Steiner point has come nearer to v than the
//   vertex that the key of Complete(v), or of ComputeNN(v), was measured from. The figures do not
//   change keys, so v is late, and what it inserts may be nearer to a complete vertex than that
//   one's nearest neighbour: "every vertex with nearby nearest neighbour is complete" (4.3) does
//   not hold. Here NN(v) is exact when v is completed; an event with a key below the bucket that
//   runs is added to that bucket, and what Complete(v) adds to a later one. In the end some 0.1% of
//   the vertices have a gap ball above rho NN(v), up to 1.45 times as large
//   (tests/sac/thesis_test.cpp). With gamma near to rho they are fewer.
// - Elements of the grid are 3 gamma rho l wide (the text), not 3 gamma rho (the figure).
// - Radii are in (rho NN(v), gamma NN(v)]: the figure's interval is open.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "refinement.hpp"

namespace examples::thesis {

/// Asks for the nearest neighbour of an input point.
struct Locate {
  static constexpr std::string_view kName = "locate";
  template <class S, int D>
  void operator()(S& s, Point<D> p) const;
};
struct ComputeNN {
  static constexpr std::string_view kName = "compute_nn";
  template <class S, int D>
  void operator()(S& s, Point<D> v, int b) const;
};
struct Complete {
  static constexpr std::string_view kName = "complete";
  template <class S, int D>
  void operator()(S& s, Point<D> v, int b) const;
};
inline constexpr Locate locate{};
inline constexpr ComputeNN compute_nn{};
inline constexpr Complete complete{};

inline constexpr sac::Key kLocateKey{.bucket = -1};

/// Adds events in bucket b to Q.
template <class S, int D>
void add_compute_nn(S& s, Refinement<S, D>& w, const Point<D>& v, int b) {
  w.events.template post<compute_nn>(s, sac::Key{.bucket = b}, v, b);
}
template <class S, int D>
void add_complete(S& s, Refinement<S, D>& w, const Point<D>& v, int b) {
  w.events.template post<complete>(s, sac::Key{.bucket = b, .phase = 1, .colour = w.colour(v, b)},
                                   v, b);
}

// for each p in P do: let c be the quadtree cell that contains p; add a ComputeNN(p) event, with
// key |c| / 2, to Q
template <class S, int D>
void Locate::operator()(S& s, Point<D> p) const {
  auto& w = environment<S, D>(s);
  const Cell<D> c = w.cells_of.first(s, p).value();
  add_compute_nn(s, w, p, w.bucket(w.side(c) / 2));
}

/// The distance of v to its nearest neighbour; nothing if it has none within `reach`.
template <class S, int D>
[[nodiscard]] std::optional<double> nearest(S& s, Refinement<S, D>& w, const Point<D>& v,
                                            double reach) {
  std::optional<double> nearest;
  w.sweep(
      s, v, reach, [](const Cell<D>&) { return true; },
      [&](const Point<D>&, double apart2) {
        nearest = std::sqrt(apart2);
        return false;
      });
  return nearest;
}

// for each ComputeNN(v) item in W do: compute the exact nearest neighbour u (Steiner or input) to
// v; add a Complete(v) event, with key |uv|, to Q. It is within 6 sqrt(d) |c| [cf. L 4.1.3].
template <class S, int D>
void ComputeNN::operator()(S& s, Point<D> v, int b) const {
  auto& w = environment<S, D>(s);
  const Cell<D> c = w.cells_of.first(s, v).value();
  const auto uv = nearest(s, w, v, 6 * std::sqrt(double{D}) * w.side(c));
  if (uv) add_complete(s, w, v, std::max(b, w.bucket(*uv)));
}

/// v's nearest neighbour and gap balls as far as Complete(v) in bucket b is concerned with them:
/// those of radius gamma NN(v) or less lie within 2 gamma NN(v) [L 4.3.3].
template <int D>
struct Surroundings {
  double nn = 0;
  std::optional<GapBalls<D>> gaps;  // none: v has no neighbour
};
template <class S, int D>
[[nodiscard]] Surroundings<D> surroundings(S& s, Refinement<S, D>& w, const Point<D>& v, int b) {
  const double L = w.settings().L, rho = w.settings().rho, gamma = w.settings().gamma;
  Surroundings<D> found;
  double reach2 = HUGE_VAL;
  const auto enters = [&](const Cell<D>& c) {
    if (!found.gaps) return true;
    return squared_distance(v, c, L) <= reach2 && found.gaps->enter(c);
  };
  w.sweep(s, v, 2 * gamma * rho * w.start(b), enters, [&](const Point<D>& u, double apart2) {
    if (!found.gaps) {
      found.nn = std::sqrt(apart2);
      found.gaps.emplace(v, gamma * found.nn, L);
      reach2 = 4 * gamma * gamma * apart2;
    }
    if (apart2 > reach2) return false;
    found.gaps->cut(u);
    return true;
  });
  return found;
}

// while there is a gap ball b = B(x, r) with r in (rho NN(v), gamma NN(v)] do: let c_x be the cell
// that contains x; add c_x <-> x to P; add Complete(x), with key |xv|, to Q
template <class S, int D>
void Complete::operator()(S& s, Point<D> v, int b) const {
  auto& w = environment<S, D>(s);
  const auto& [L, rho, gamma] = w.settings();
  auto [nn, gaps] = surroundings(s, w, v, b);
  if (!gaps) return;
  while (const auto ball = gaps->largest(rho * nn, gamma * nn)) {
    const auto& [x, r] = *ball;
    const Cell<D> cx = w.leaf_of(s, x, level_of(r, L));
    w.P.put(s, cx, {x, cx});
    add_complete(s, w, x, std::max(b + 1, w.bucket(r)));
    gaps->cut(x);
  }
}

/// The program: completes all vertices, bucket by bucket.
struct ChooseSteiners {
  static constexpr std::string_view kName = "choose_steiners";
  template <class S, int D>
  void operator()(S& s, Cell<D>) const {
    environment<S, D>(s).events.drain(s);  // while Q not empty do
  }
};
inline constexpr ChooseSteiners choose_steiners{};

}  // namespace examples::thesis
