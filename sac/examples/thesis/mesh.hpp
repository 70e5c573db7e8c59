// The thesis's mesh of a point cloud, under edits: BuildQT, then ChooseSteiners [Ch 4].
//
// Example:
//   sac::Engine engine;
//   thesis::PointMesh<sac::Engine, 2> mesh(engine, {.rho = 2, .gamma = 4});
//   for (const auto& p : thesis::boundary_points<2>(1, 9)) mesh.insert(p);
//   mesh.insert({0.5, 0.5});
//   mesh.run();
//   mesh.insert({0.5, 0.51});
//   engine.propagate();
//   mesh.vertices();
//
// It is for reading, and to compare with: geometry is in doubles (gap_balls.hpp), and a call
// depends on all quadtree cells that its search visits, as in the thesis. The mesher of this
// project does more, and less work.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>
#include <type_traits>
#include <vector>

#include "build_qt.hpp"
#include "choose_steiners.hpp"

namespace examples::thesis {

/// BuildQT, then ChooseSteiners.
struct MeshPoints {
  static constexpr std::string_view kName = "mesh_points";
  template <class S, int D>
  void operator()(S& s, Cell<D> root) const {
    s.template call<build_qt>(root);
    s.template tail<choose_steiners>(root);
  }
};
inline constexpr MeshPoints mesh_points{};

/// Host: sac::Engine or sac::PlainScope, which outlives the mesh's last use. D: 1 to 4, or more.
template <class Host, int D>
class PointMesh {
 public:
  using S = std::conditional_t<std::is_same_v<Host, sac::PlainScope>, sac::PlainScope, sac::Scope>;

  PointMesh(Host& host, const Settings& settings) : host_(host), w_(host, settings) {}

  /// Edits. Requires: p in [0, L]^D, not there yet; there.
  void insert(const Point<D>& p) {
    w_.cells.template post_from_outside<associate>(kAssociateKey, p);
    w_.events.template post_from_outside<locate>(kLocateKey, p);
  }
  void remove(const Point<D>& p) {
    w_.cells.template retract_from_outside<associate>(p);
    w_.events.template retract_from_outside<locate>(p);
  }
  /// The first run; with `tree_only` of BuildQT alone.
  void run(bool tree_only = false) {
    if (tree_only) return void(host_.template run<build_qt>(Cell<D>{}));
    host_.template run<mesh_points>(Cell<D>{});
  }

  /// Input points and Steiner points, in lexicographic order.
  [[nodiscard]] std::vector<Point<D>> vertices() const {
    std::vector<Point<D>> all;
    w_.for_each_vertex([&](const Point<D>& x) { all.push_back(x); });
    std::sort(all.begin(), all.end());
    return all;
  }
  /// The cells that are split, in their order.
  [[nodiscard]] std::vector<Cell<D>> split_cells() const {
    std::vector<Cell<D>> all;
    w_.for_each_split_cell([&](const Cell<D>& c) { all.push_back(c); });
    std::sort(all.begin(), all.end());
    return all;
  }
  [[nodiscard]] const Settings& settings() const noexcept { return w_.settings(); }

 private:
  Host& host_;
  Refinement<S, D> w_;
};

/// The vertices of a grid of `steps` cells a side, on the sides of [0, L]^D [§4.4]: with them the
/// mesh has good quality up to the boundary, if all input is as far from the sides as L 4.4.1 says.
/// Requires: steps >= 1.
template <int D>
[[nodiscard]] std::vector<Point<D>> boundary_points(double L, int steps) {
  std::vector<Point<D>> all;
  std::array<int, D> at{};
  for (;;) {
    if (std::any_of(at.begin(), at.end(), [&](int i) { return i == 0 || i == steps; })) {
      Point<D> p;
      for (std::size_t i = 0; i < D; ++i) p.x[i] = L * at[i] / steps;
      all.push_back(p);
    }
    std::size_t i = 0;
    while (i < D && at[i] == steps) at[i++] = 0;
    if (i == D) return all;
    ++at[i];
  }
}

}  // namespace examples::thesis
