// Places computed by + - * / and square roots, and by on_circle.
#include "generate/plc_parts.hpp"

#include <algorithm>
#include <cmath>

#include "generate/on_circle.hpp"
#include "geometry/space_distances.hpp"

namespace mesher::plc_parts {

namespace {

using detail::plus;
using detail::scaled;

Point<2> circle_at(double degrees) {
  const double turns = degrees / 360;
  return on_circle(turns - std::floor(turns));
}

}  // namespace

Places rectangle(int axis, double x, const Point<2>& lo, const Point<2>& hi) {
  Places loop;
  for (const auto& [u, v] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
    Point<3> p{};
    p[axis] = x;
    p[(axis + 1) % 3] = u == 0 ? lo[0] : hi[0];
    p[(axis + 2) % 3] = v == 0 ? lo[1] : hi[1];
    loop.push_back(p);
  }
  return loop;
}
Places square(double z, double middle, double side) {
  const double lo = middle - side / 2, hi = middle + side / 2;
  return rectangle(2, z, {lo, lo}, {hi, hi});
}

void add_box(Builder& b, const Box<3>& box, const std::map<Side, Places>& holes,
             const std::vector<Side>& left_out) {
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const bool upper : {false, true}) {
      if (std::count(left_out.begin(), left_out.end(), Side(axis, upper)) > 0) continue;
      const double x = upper ? box.hi[axis] : box.lo[axis];
      std::vector<Places> loops{rectangle(axis, x, {box.lo[u], box.lo[v]}, {box.hi[u], box.hi[v]})};
      if (const auto hole = holes.find({axis, upper}); hole != holes.end()) {
        loops.push_back(hole->second);
      }
      b.polygon(loops);
    }
  }
}

void add_dumbbell(Builder& b, double width) {
  const double lo = 0.5 - width / 2, hi = 0.5 + width / 2;
  const auto mouth = [&](double x) { return rectangle(0, x, {lo, lo}, {hi, hi}); };
  add_box(b, kUnit, {{{0, true}, mouth(1)}});
  add_box(b, {{2, 0, 0}, {3, 1, 1}}, {{{0, false}, mouth(2)}});
  add_box(b, {{1, lo, lo}, {2, hi, hi}}, {}, {{0, false}, {0, true}});
}

Places page(double degrees) {
  const auto [x, z] = circle_at(degrees);
  return {{0, -0.5, 0}, {0, 0.5, 0}, {x, 0.5, z}, {x, -0.5, z}};
}

void add_spike(Builder& b, double degrees) {
  const auto [cosine, sine] = circle_at(degrees / 2);
  Places base = square(0, 0, 2 * sine / cosine);
  for (Point<3>& p : base) p = plus(p, {0.1, 0.2, 0});
  b.polygon({base});
  for (int i = 0; i < 4; ++i) b.polygon({{{0.1, 0.2, 1}, base[i], base[(i + 1) % 4]}});
}

void add_vee(Builder& b, double degrees) {
  const auto [x, y] = circle_at(degrees);
  b.segment({0, 0, 0}, {1, 0.1, 0.05});
  b.segment({0, 0, 0}, {x, 0.1 + y, 0.05});
}

void add_leaning(Builder& b, double degrees) {
  const auto [x, z] = circle_at(degrees);
  b.polygon({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}});
  b.segment({0, 0, 0}, {0.6 * x, 0.5 * x, 0.78 * z});
}

void add_tetrahedron(Builder& b, double height) {
  const Places all{{0, 0, 0}, {1, 0, 0}, {0.3, 0.9, 0}, {0.4, 0.3, height}};
  for (int i = 0; i < 4; ++i) b.polygon({{all[i], all[(i + 1) % 4], all[(i + 2) % 4]}});
}

void add_cloud(Builder& b, std::size_t n, SplitMix64 random) {
  const auto inside = [&] { return 0.05 + 0.9 * random.unit(); };
  for (std::size_t i = 0; i < n; ++i) {
    const double x = inside(), y = inside();
    b.point({x, y, inside()});
  }
}

void add_pump(Builder& b, std::size_t n) {
  const auto ring = [&](double radius, double z) {
    Places loop;
    for (std::size_t i = 0; i < n; ++i) {
      const auto [x, y] = on_circle((static_cast<double>(i) + 0.5) / static_cast<double>(n));
      loop.push_back({radius * x, radius * y, z});
    }
    return loop;
  };
  const Places low = ring(1, -0.5), high = ring(1, 0.5);
  const Places bore_low = ring(0.6, -0.5), bore_high = ring(0.6, 0.5);
  b.polygon({low, bore_low});
  b.polygon({high, bore_high});
  const auto wall = [&](const Places& bottom, const Places& top, std::size_t i) -> Places {
    const std::size_t next = (i + 1) % n;
    return {bottom[i], bottom[next], top[next], top[i]};
  };
  // The last side goes from the last corner to the first: x is the same on all of it.
  const double x = low[0][0], half = 0.4 * low[0][1];
  const Places mouth = rectangle(0, x, {-half, -0.25}, {half, 0.25});
  for (std::size_t i = 0; i < n; ++i) {
    b.polygon({wall(bore_low, bore_high, i)});
    std::vector<Places> loops{wall(low, high, i)};
    if (i + 1 == n) {
      for (Point<3>& p : loops[0]) p[0] = x;
      loops.push_back(mouth);
    }
    b.polygon(loops);
  }
  add_box(b, {{x, -half, -0.25}, {1.5, half, 0.25}}, {}, {{0, false}});
}

void add_faults(Builder& b, std::size_t n, SplitMix64 random) {
  const double reach = 0.25 / std::cbrt(static_cast<double>(std::max<std::size_t>(n, 1)));
  std::vector<Point<3>> middles;
  const auto free = [&](const Point<3>& m) {
    return std::none_of(middles.begin(), middles.end(), [&](const Point<3>& other) {
      return detail::squared_distance(m, other) < 4.1 * reach * reach;
    });
  };
  for (std::size_t tries = 50 * n; tries > 0 && middles.size() < n; --tries) {
    Point<3> m;
    for (double& x : m) x = 1.1 * reach + (1 - 2.2 * reach) * random.unit();
    const auto [u, v] = on_circle(random.unit());
    const auto [w, t] = on_circle(random.unit());
    if (!free(m)) continue;
    middles.push_back(m);
    const Point<3> across{reach * u, reach * v, 0}, up{-reach * v * w, reach * u * w, reach * t};
    b.polygon(
        {{plus(m, across), plus(m, up), plus(m, scaled(-1, across)), plus(m, scaled(-1, up))}});
  }
}

void add_bricks(Builder& b, double joint) {
  for (int course = 0; course < 5; ++course) {
    for (int i = 0; i < 4; ++i) {
      const double x = 0.4 * i + (course % 2 == 1 ? 0.2 : 0), z = 0.2 * course;
      add_box(b, {{x, 0, z}, {x + 0.4 - joint, 0.2, z + 0.2 - joint}});
    }
  }
}

void add_tee(Builder& b, double height) {
  const Point<3> p{0.25, 0.5, 0.25}, q{0.75, 0.5, 0.25};
  const Point<3> up{0, 0, height};
  b.polygon({square(0.25, 0.5, 0.8)}, {{p, q}});
  b.polygon({{p, q, plus(q, up), plus(p, up)}});
}

// The corners are those of three golden rectangles.
void add_icosahedron(Builder& b, double radius) {
  const double g = (1 + std::sqrt(5.0)) / 2, s = radius / std::sqrt(1 + g * g);
  Places all;
  for (int axis = 0; axis < 3; ++axis) {
    for (const auto& [u, v] : {std::pair(s, s * g), {s, -s * g}, {-s, s * g}, {-s, -s * g}}) {
      Point<3> p{};
      p[(axis + 1) % 3] = u;
      p[(axis + 2) % 3] = v;
      all.push_back(p);
    }
  }
  const auto joined = [&](std::size_t i, std::size_t j) {
    return detail::squared_distance(all[i], all[j]) < 5 * s * s;  // edges are 2 s, others more
  };
  for (std::size_t i = 0; i < 12; ++i) {
    for (std::size_t j = i + 1; j < 12; ++j) {
      for (std::size_t k = j + 1; k < 12; ++k) {
        if (joined(i, j) && joined(j, k) && joined(i, k)) b.polygon({{all[i], all[j], all[k]}});
      }
    }
  }
}

}  // namespace mesher::plc_parts
