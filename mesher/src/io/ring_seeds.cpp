// One horizontal line for each question, half-way in the widest gap between the heights of its
// rings' corners. It is cut by all lines of the file; of the pieces beside one of the rings, the
// widest that is inside has the seed in its middle. Cuts are rounded, the verdict on the middle is
// exact: by parity, with exact orientation.
#include "io/ring_seeds.hpp"

#include <algorithm>

#include "mesher/predicates.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

using Line = std::array<Point<2>, 2>;

// Half-open, so that a corner counts for one of its two edges, or for both or none at a peak.
bool spans(const Line& line, double y) { return (line[0][1] <= y) != (line[1][1] <= y); }

// The same for both directions of the line.
double crossing(const Line& line, double y) {
  const auto& [a, b] = std::minmax(line[0], line[1]);
  return a[0] + (b[0] - a[0]) * ((y - a[1]) / (b[1] - a[1]));
}

// Whether an odd number of the ring's edges pass left of p. Exact.
bool is_inside(const Ring& ring, const Point<2>& p) {
  bool inside = false;
  for (std::size_t i = 1; i < ring.size(); ++i) {
    const Point<2>&a = ring[i - 1], &b = ring[i];
    if (!spans({a, b}, p[1])) continue;
    const int side = predicates::orient2d(a, b, p);
    if (side == (a[1] < b[1] ? -1 : 1)) inside = !inside;
  }
  return inside;
}

bool answers(const SeedQuestion& question, const Point<2>& p) {
  const auto holds = [&](const Ring* ring) { return is_inside(*ring, p); };
  return holds(question.outer) && std::none_of(question.inner.begin(), question.inner.end(), holds);
}

// Half-way in the widest gap between the heights of the outer ring's corners.
std::optional<double> height_of(const SeedQuestion& question) {
  std::vector<double> heights;
  for (const Point<2>& p : *question.outer) heights.push_back(p[1]);
  for (const Ring* ring : question.inner) {
    for (const Point<2>& p : *ring) heights.push_back(p[1]);
  }
  std::sort(heights.begin(), heights.end());
  std::optional<double> middle;
  double widest = 0;
  for (std::size_t i = 1; i < heights.size(); ++i) {
    const double gap = heights[i] - heights[i - 1];
    const double y = heights[i - 1] / 2 + heights[i] / 2;
    if (!text::is_coordinate(y) || gap <= widest || y <= heights[i - 1] || y >= heights[i]) {
      continue;
    }
    widest = gap;
    middle = y;
  }
  return middle;
}

void add_cuts(const Ring& ring, double y, std::vector<double>& cuts) {
  for (std::size_t i = 1; i < ring.size(); ++i) {
    const Line edge{ring[i - 1], ring[i]};
    if (spans(edge, y)) cuts.push_back(crossing(edge, y));
  }
}

std::optional<Point<2>> widest_piece(const SeedQuestion& question, double y,
                                     std::vector<double> cuts) {
  std::vector<double> own;
  add_cuts(*question.outer, y, own);
  for (const Ring* ring : question.inner) add_cuts(*ring, y, own);
  std::sort(own.begin(), own.end());
  std::sort(cuts.begin(), cuts.end());
  const auto is_own = [&](double x) { return std::binary_search(own.begin(), own.end(), x); };
  std::optional<Point<2>> best;
  double widest = 0;
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    const double left = cuts[i - 1], right = cuts[i];
    const Point<2> middle{left / 2 + right / 2, y};
    if (!text::is_coordinate(middle[0]) || right - left <= widest) continue;
    if (middle[0] <= left || middle[0] >= right) continue;
    if (!(is_own(left) || is_own(right)) || !answers(question, middle)) continue;
    widest = right - left;
    best = middle;
  }
  return best;
}

}  // namespace

std::vector<std::optional<Point<2>>> find_seeds(const std::vector<SeedQuestion>& questions,
                                                const std::vector<Line>& lines) {
  struct Height {
    double y;
    std::size_t question;
    std::vector<double> cuts;
  };
  std::vector<Height> heights;
  for (std::size_t q = 0; q < questions.size(); ++q) {
    if (const auto y = height_of(questions[q])) heights.push_back({*y, q, {}});
  }
  std::sort(heights.begin(), heights.end(), [](const Height& a, const Height& b) {
    return a.y != b.y ? a.y < b.y : a.question < b.question;
  });
  for (const Line& line : lines) {
    const double low = std::min(line[0][1], line[1][1]);
    auto h = std::lower_bound(heights.begin(), heights.end(), low,
                              [](const Height& a, double y) { return a.y < y; });
    for (; h != heights.end() && h->y <= std::max(line[0][1], line[1][1]); ++h) {
      if (spans(line, h->y)) h->cuts.push_back(crossing(line, h->y));
    }
  }
  std::vector<std::optional<Point<2>>> seeds(questions.size());
  for (Height& h : heights) {
    seeds[h.question] = widest_piece(questions[h.question], h.y, std::move(h.cuts));
  }
  return seeds;
}

}  // namespace mesher
