// Naive twins of the thesis's programs: Fig 4.3 word for word, and Fig 4.7 in the order of
// Fig 4.10, with every question asked of all cells or all vertices. Of the programs' own text they
// use names of cells and the gap balls of one vertex.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include "thesis/mesh.hpp"

namespace support {

namespace thesis = examples::thesis;

/// BuildQT [Fig 4.3]; comments are its lines.
template <int D>
class NaiveBuildQT {
 public:
  using Cell = thesis::Cell<D>;
  using Point = thesis::Point<D>;

  NaiveBuildQT(const std::vector<Point>& points, double L) : L_(L) {
    P_[Cell{}] = points;                         // 3
    if (points.size() >= 2) enqueue(Cell{});     // 4-6; the figure has > 2
    while (!Q_.empty()) {                        // 7
      const Cell c = delete_min();               // 8
      if (!P_.contains(c)) continue;             // pushed twice
      split(c);                                  // 9-14
      for (const Cell& n : neighbours(c)) {      // 15
        if (n.level == c.level - 1) enqueue(n);  // 16, 17
        if (n.level < c.level - 1) throw std::logic_error("a neighbour four times as large");
      }
      for (const Cell& part : children(c)) {                 // 19
        for (const Cell& n : neighbours(part)) {             // 20
          if (P_[part].size() + P_[n].size() < 2) continue;  // 21
          enqueue(part);                                     // 22
          break;                                             // 23
        }
      }
    }
  }

  [[nodiscard]] const std::set<Cell>& split_cells() const { return split_; }
  /// The leaves, and the points in each.
  [[nodiscard]] const std::map<Cell, std::vector<Point>>& leaves() const { return P_; }
  [[nodiscard]] double side(const Cell& c) const { return std::ldexp(L_, -c.level); }
  [[nodiscard]] double low(const Cell& c, std::size_t i) const {
    return static_cast<double>(c.at[i]) * side(c);
  }
  [[nodiscard]] double high(const Cell& c, std::size_t i) const { return low(c, i) + side(c); }

 private:
  static std::vector<Cell> children(const Cell& c) {
    std::vector<Cell> all;
    for (unsigned i = 0; i < 1u << D; ++i) all.push_back(thesis::child_of(c, i));
    return all;
  }
  [[nodiscard]] bool contains(const Cell& c, const Point& p) const {
    for (std::size_t i = 0; i < D; ++i) {
      if (p[i] < low(c, i)) return false;
      if (p[i] >= high(c, i) && !(p[i] == L_ && high(c, i) == L_)) return false;
    }
    return true;
  }
  // Leaves that share a point with c and are no part of it.
  [[nodiscard]] std::vector<Cell> neighbours(const Cell& c) const {
    std::vector<Cell> all;
    for (const auto& [n, points] : P_) {
      bool touches = true, inside = true;
      for (std::size_t i = 0; i < D; ++i) {
        touches = touches && low(n, i) <= high(c, i) && high(n, i) >= low(c, i);
        inside = inside && low(n, i) >= low(c, i) && high(n, i) <= high(c, i);
      }
      if (touches && !inside) all.push_back(n);
    }
    return all;
  }
  void split(const Cell& c) {
    const std::vector<Point> points = P_.at(c);
    for (const Cell& part : children(c)) {  // 9
      auto& held = P_[part];
      for (const Point& p : points) {              // 10
        if (contains(part, p)) held.push_back(p);  // 11, 12
      }
    }
    P_.erase(c);  // 14
    split_.insert(c);
  }
  void enqueue(const Cell& c) { Q_[c.level].push_back(c); }
  Cell delete_min() {
    const auto largest = Q_.begin();
    const Cell c = largest->second.front();
    largest->second.pop_front();
    if (largest->second.empty()) Q_.erase(largest);
    return c;
  }

  double L_;
  std::map<Cell, std::vector<Point>> P_;  // of the leaves
  std::map<int, std::deque<Cell>> Q_;     // by level; each FIFO
  std::set<Cell> split_;
};

/// ChooseSteiners [Fig 4.7], the events of a bucket in the order of [Fig 4.10].
template <int D>
class NaiveChooseSteiners {
 public:
  using Point = thesis::Point<D>;

  NaiveChooseSteiners(const std::vector<Point>& points, const thesis::Settings& settings)
      : settings_(settings), vertices_(points.begin(), points.end()) {
    const NaiveBuildQT<D> qt(points, settings.L);
    for (const auto& [c, held] : qt.leaves()) {
      for (const Point& p : held) add(false, p, bucket(qt.side(c) / 2));
    }
    while (!Q_.empty()) {
      const auto [b, is_complete, colour, v] = *Q_.begin();
      Q_.erase(Q_.begin());
      is_complete ? complete(v, b) : compute_nn(v, b);
    }
  }

  [[nodiscard]] std::vector<Point> vertices() const { return {vertices_.begin(), vertices_.end()}; }

 private:
  // Bucket b begins at rho^b times the shortest length there can be.
  [[nodiscard]] double start(int b) {
    if (starts_.empty()) starts_ = {std::ldexp(settings_.L, -thesis::kDeepest - 2)};
    while (static_cast<int>(starts_.size()) <= b) starts_.push_back(starts_.back() * settings_.rho);
    return starts_[static_cast<std::size_t>(b)];
  }
  [[nodiscard]] int bucket(double length) {
    int b = 0;
    while (start(b + 1) <= length) ++b;
    return b;
  }
  void add(bool is_complete, const Point& v, int b) {
    unsigned colour = 0;
    for (unsigned i = 0; i < D && is_complete; ++i) {
      const double element = 3 * settings_.gamma * settings_.rho * start(b);
      if (std::fmod(std::floor(v[i] / element), 2) != 0) colour += 1u << i;
    }
    Q_.insert({b, is_complete, colour, v});
  }
  // All others, the nearest first.
  [[nodiscard]] std::vector<std::pair<double, Point>> others(const Point& v) const {
    std::vector<std::pair<double, Point>> all;
    for (const Point& u : vertices_) {
      if (u != v) all.emplace_back(thesis::squared_distance(u, v), u);
    }
    std::sort(all.begin(), all.end());
    return all;
  }
  void compute_nn(const Point& v, int b) {
    const auto all = others(v);
    if (!all.empty()) add(true, v, std::max(b, bucket(std::sqrt(all.front().first))));
  }
  void complete(const Point& v, int b) {
    const auto all = others(v);
    const double nn2 = all.front().first, nn = std::sqrt(nn2);
    thesis::GapBalls<D> gaps(v, settings_.gamma * nn, settings_.L);
    for (const auto& [apart2, u] : all) {
      if (apart2 <= 4 * settings_.gamma * settings_.gamma * nn2) gaps.cut(u);
    }
    while (const auto ball = gaps.largest(settings_.rho * nn, settings_.gamma * nn)) {
      vertices_.insert(ball->centre);
      add(true, ball->centre, std::max(b + 1, bucket(ball->radius)));
      gaps.cut(ball->centre);
    }
  }

  thesis::Settings settings_;
  std::vector<double> starts_;
  std::set<Point> vertices_;
  std::set<std::tuple<int, bool, unsigned, Point>> Q_;
};

}  // namespace support
