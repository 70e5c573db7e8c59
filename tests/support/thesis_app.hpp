// The thesis's mesh of a point cloud as an App (sac/examples/apps/app.hpp), in D dimensions: points
// come and go, the result are the split cells of the quadtree and the vertices of the mesh.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "apps/app.hpp"
#include "naive_thesis.hpp"

namespace support {

template <int D>
struct ThesisApp {
  static constexpr const char* kName = "point mesh of the thesis";
  using Point = thesis::Point<D>;
  using Input = std::vector<Point>;
  using Edit = Point;  // comes if it is not there, else goes
  using Result = std::pair<std::vector<thesis::Cell<D>>, std::vector<Point>>;
  static constexpr thesis::Settings kSettings{.L = 1, .rho = D < 4 ? 2.0 : 3.0, .gamma = D + 2};

  // Anywhere; on a coarse grid, sides of the box included; or near another.
  static Point random_point(apps::Random& random, const Input& input) {
    const auto unit = [&] { return std::ldexp(random(1 << 30) + 0.5, -30); };
    const int kind = random(3);
    Point p;
    for (double& x : p.x) x = kind == 1 ? random(9) / 8.0 : unit();
    if (kind < 2 || input.empty()) return p;
    const Point& near = input[static_cast<std::size_t>(random(static_cast<int>(input.size())))];
    const double apart = std::ldexp(1, -2 - random(D == 1 ? 20 : D == 2 ? 12 : 5));
    for (std::size_t i = 0; i < D; ++i) {
      p.x[i] = std::clamp(near[i] + apart * (p[i] - 0.5), 0.0, 1.0);
    }
    return p;
  }
  static Input random_input(apps::Random& random, int size) {
    Input input;
    while (static_cast<int>(input.size()) < size) {
      const Point p = random_point(random, input);
      if (std::find(input.begin(), input.end(), p) == input.end()) input.push_back(p);
    }
    return input;
  }
  static Edit random_edit(apps::Random& random, const Input& input) {
    if (input.empty() || random(2) == 0) return random_point(random, input);
    return input[static_cast<std::size_t>(random(static_cast<int>(input.size())))];
  }
  static Edit inverse(const Input&, const Edit& edit) { return edit; }
  static void apply(Input& input, const Edit& p) {
    const auto at = std::find(input.begin(), input.end(), p);
    at == input.end() ? input.push_back(p) : static_cast<void>(input.erase(at));
  }
  static Result oracle(const Input& input) {
    const NaiveBuildQT<D> qt(input, kSettings.L);
    return {{qt.split_cells().begin(), qt.split_cells().end()},
            NaiveChooseSteiners<D>(input, kSettings).vertices()};
  }

  template <class Host>
  class World {
   public:
    World(Host& host, const Input& input) : mesh_(host, kSettings), points_(input) {
      for (const Point& p : input) mesh_.insert(p);
      mesh_.run();
    }
    void edit(const Edit& p) {
      const bool goes = std::find(points_.begin(), points_.end(), p) != points_.end();
      goes ? mesh_.remove(p) : mesh_.insert(p);
      apply(points_, p);
    }
    [[nodiscard]] Result result() const { return {mesh_.split_cells(), mesh_.vertices()}; }
    template <class Recorder>
    void name(Recorder&) const {}  // cells and points name themselves

   private:
    thesis::PointMesh<Host, D> mesh_;
    Input points_;
  };
};

}  // namespace support
