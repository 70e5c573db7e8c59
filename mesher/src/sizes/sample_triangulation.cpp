// Locating, digging and filling the hole of a point.
#include "sizes/sample_triangulation.hpp"

#include <algorithm>
#include <string>

#include "input.hpp"
#include "mesher/error.hpp"
#include "mesher/predicates.hpp"

namespace mesher::detail {

SampleTriangulation::SampleTriangulation(const std::vector<Point<2>>& points) : points_(points) {
  triangles_ = {{{0, 1, 2}, {kNone, 1, kNone}}, {{0, 2, 3}, {kNone, kNone, 0}}};
  for (Index p = 4; p < points.size(); ++p) insert(p);
}

// Walks towards p, across the first edge that p lies behind.
SampleTriangulation::Index SampleTriangulation::locate(const Point<2>& p) const {
  Index t = last_;
  for (std::size_t turn = 0;; ++turn) {
    const Triangle& now = triangles_[t];
    Index next = kNone;
    for (std::size_t n = 0; n < 3 && next == kNone; ++n) {
      const std::size_t i = (n + turn) % 3;  // not the same one first: a walk could go in circles
      const Point<2>& a = points_[now.at[(i + 1) % 3]];
      const Point<2>& b = points_[now.at[(i + 2) % 3]];
      if (predicates::orient2d(a, b, p) < 0) next = now.beside[i];
    }
    if (next == kNone) return t;
    t = next;
  }
}

bool SampleTriangulation::gives_way(const Triangle& t, const Point<2>& p) const {
  const Point<2>&a = points_[t.at[0]], &b = points_[t.at[1]], &c = points_[t.at[2]];
  return predicates::incircle_perturbed(a, b, c, p) > 0;
}

// Takes out the triangles with p in their circumcircle, from one of them on.
void SampleTriangulation::dig(Index first, const Point<2>& p) {
  hole_.assign(1, first);
  rim_.clear();
  triangles_[first].dead = true;
  for (std::size_t n = 0; n < hole_.size(); ++n) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Triangle& t = triangles_[hole_[n]];
      const Index beside = t.beside[i];
      if (beside != kNone && triangles_[beside].dead) continue;
      if (beside != kNone && gives_way(triangles_[beside], p)) {
        triangles_[beside].dead = true;
        hole_.push_back(beside);
      } else {
        rim_.push_back({t.at[(i + 1) % 3], t.at[(i + 2) % 3], beside});
      }
    }
  }
}

// `other` is what t has across its edge ab.
void SampleTriangulation::join(Index t, Index a, Index b, Index other) {
  if (t == kNone) return;
  for (std::size_t i = 0; i < 3; ++i) {
    const Index x = triangles_[t].at[(i + 1) % 3], y = triangles_[t].at[(i + 2) % 3];
    if ((x == a && y == b) || (x == b && y == a)) triangles_[t].beside[i] = other;
  }
}

// A triangle at p on each edge of the rim, the edges in order around p.
void SampleTriangulation::close(Index p) {
  for (std::size_t i = 0; i + 1 < rim_.size(); ++i) {
    const auto next = std::find_if(rim_.begin() + static_cast<std::ptrdiff_t>(i) + 1, rim_.end(),
                                   [&](const Rim& r) { return r.a == rim_[i].b; });
    std::iter_swap(rim_.begin() + static_cast<std::ptrdiff_t>(i) + 1, next);
  }
  std::vector<Index> fan = hole_;
  while (fan.size() < rim_.size()) {
    fan.push_back(static_cast<Index>(triangles_.size()));
    triangles_.emplace_back();
  }
  for (std::size_t i = 0; i < rim_.size(); ++i) {
    const Rim& r = rim_[i];
    const Index before = fan[i == 0 ? rim_.size() - 1 : i - 1];
    const Index behind = fan[i + 1 == rim_.size() ? 0 : i + 1];
    triangles_[fan[i]] = {{p, r.a, r.b}, {r.behind, behind, before}};
    join(r.behind, r.a, r.b, fan[i]);
  }
  last_ = fan.front();
}

// A hole of h triangles has a rim of h + 2 edges.
void SampleTriangulation::insert(Index p) {
  const Point<2>& place = points_[p];
  const Index there = locate(place);
  for (const Index corner : triangles_[there].at) {
    if (points_[corner] != place) continue;
    throw Error(ErrorCode::duplicate_point, "two sizes at " + place_text(place));
  }
  dig(there, place);
  close(p);
}

std::vector<SampleTriangulation::Corners> SampleTriangulation::triangles() const {
  std::vector<Corners> all;
  const auto before = [&](Index a, Index b) { return points_[a] < points_[b]; };
  for (Triangle t : triangles_) {
    std::rotate(t.at.begin(), std::min_element(t.at.begin(), t.at.end(), before), t.at.end());
    all.push_back(t.at);
  }
  std::sort(all.begin(), all.end(), [&](const Corners& s, const Corners& t) {
    return std::lexicographical_compare(s.begin(), s.end(), t.begin(), t.end(), before);
  });
  return all;
}

}  // namespace mesher::detail
