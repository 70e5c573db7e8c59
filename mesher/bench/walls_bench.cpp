// Long stories of edits against meshing anew at every step.
//
//   walls_bench [FILE.poly] [STEPS] [--inputs PREFIX]
//                                       default: a generated lake, 1000 steps
//
// With --inputs, what each story ends with is written to PREFIXcrack.poly and PREFIXwall.poly, for
// other meshers to be timed on: `cgal_reference PREFIXcrack.poly`.
// One JSON line per figure, each with the seconds of all updates, those of as many static runs (the
// mean of the first input and the last), and their ratio:
//   crack   a polyline grows through a plate with 10^4 random points, a point and a segment a step
//   wall    a polyline of ten points moves through open water of the file, or of a lake with 4000
//           points on its shore: all points of it move in a step
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "bench_help.hpp"
#include "input.hpp"
#include "mesher/write.hpp"
#include "sample.hpp"

namespace {

using bench::Input;
using bench::Sample;
using mesher::LineId;
using mesher::Point;
using mesher::PointId;

void print(const Sample& updates, const Input& in, const char* figure, double remesh) {
  const auto steps = static_cast<double>(updates.size());
  char more[160];
  std::snprintf(more, sizeof more, ",\"updates_s\":%.3f,\"remesh_s\":%.2f,\"ratio\":%.0f",
                updates.total_seconds(), remesh * steps, remesh * steps / updates.total_seconds());
  updates.print("walls", in.name, figure, more);
}

void write(const Input& in, const std::string& prefix, const char* figure) {
  if (prefix.empty()) return;
  mesher::Graph<2> pslg;
  for (std::size_t i = 0; i < in.points.size(); ++i) {
    pslg.points.push_back({in.ids[i], in.points[i]});
  }
  for (const auto& s : in.segments) pslg.segments.push_back({s.id, s.from, s.to});
  mesher::write_graph(pslg, prefix + figure + ".poly");
}

constexpr std::int64_t kWall = 1'000'000'000;
PointId wall_id(int i) { return PointId{kWall + i}; }
LineId line_id(int i) { return LineId{kWall + i}; }

// --- A crack ---------------------------------------------------------------------------------

Input plate() {
  mesher::Graph<2> pslg;
  std::int64_t id = 1;
  const std::vector<Point<2>> corners{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (const Point<2>& p : corners) pslg.points.push_back({PointId{id++}, p});
  for (std::int64_t i = 1; i <= 4; ++i) {
    pslg.segments.push_back({LineId{i}, PointId{i}, PointId{i % 4 + 1}});
  }
  for (const Point<2>& p : mesher::generate_points<2>(mesher::PointKind::uniform, 10000, 1)) {
    const Point<2> inside{0.01 + 0.98 * p[0], 0.01 + 0.98 * p[1]};
    if (std::abs(inside[1] - 0.5) > 0.02) pslg.points.push_back({PointId{id++}, inside});
  }
  return Input("plate", pslg);
}

void bench_crack(int steps, const std::string& prefix) {
  Input in = plate();
  double remesh = bench::static_seconds(in) / 2;
  mesher::BoxMesher<2> m = bench::first_run(in);
  mesher::SplitMix64 random(7);
  Sample updates;
  for (int i = 0; i <= steps; ++i) {
    const Point<2> tip{0.05 + 0.9 * i / steps, 0.5 + 0.01 * (random.unit() - 0.5) * 40 / steps};
    in.points.push_back(tip), in.ids.push_back(wall_id(i));
    m.insert(wall_id(i), tip);
    if (i > 0) {
      in.segments.push_back({line_id(i), wall_id(i - 1), wall_id(i)});
      m.insert_segment(line_id(i), wall_id(i - 1), wall_id(i));
    }
    updates.update(m);
  }
  remesh += bench::static_seconds(in) / 2;
  print(updates, in, "crack", remesh);
  write(in, prefix, "crack");
}

// --- A wall ----------------------------------------------------------------------------------

Input lake() {
  mesher::Graph<2> pslg;
  constexpr int kShore = 4000;
  for (int i = 0; i < kShore; ++i) {
    const double t = 6.283185307179586 * i / kShore;
    const double r = 0.4 + 0.05 * std::sin(5 * t) + 0.01 * std::sin(67 * t);
    const PointId id{i + 1};
    pslg.points.push_back({id, {r * std::cos(t), r * std::sin(t)}});
    pslg.segments.push_back({LineId{i + 1}, id, PointId{(i + 1) % kShore + 1}});
  }
  return Input("lake", pslg);
}

/// The place of some that is farthest from all points, and how far that is.
std::pair<Point<2>, double> open_water(const Input& in) {
  mesher::SplitMix64 random(3);
  std::pair<Point<2>, double> best{{}, 0};
  const auto& [lo, hi] = in.options.domain;
  for (int k = 0; k < 2000; ++k) {
    const Point<2> p{lo[0] + (hi[0] - lo[0]) * random.unit(),
                     lo[1] + (hi[1] - lo[1]) * random.unit()};
    double clear = std::min({p[0] - lo[0], hi[0] - p[0], p[1] - lo[1], hi[1] - p[1]});
    for (const Point<2>& q : in.points)
      clear = std::min(clear, std::hypot(p[0] - q[0], p[1] - q[1]));
    if (clear > best.second) best = {p, clear};
  }
  return best;
}

void bench_wall(Input in, int steps, const std::string& prefix) {
  constexpr int kPoints = 10;
  const auto [middle, clear] = open_water(in);
  const double step = clear / kPoints;
  const auto place = [&, middle = middle, clear = clear](int i, int time) {
    const double y = -0.6 + 1.2 * time / steps;
    return Point<2>{middle[0] + step * (i - kPoints / 2.0),
                    middle[1] + clear * y + step * (i % 2) * 0.3};
  };
  mesher::BoxMesher<2> m = bench::first_run(in);
  std::vector<PointId> wall;
  for (int i = 0; i < kPoints; ++i) m.insert(wall_id(i), place(i, 0)), wall.push_back(wall_id(i));
  m.insert_polyline(line_id(0), wall);
  m.update();
  Sample updates;
  for (int time = 1; time <= steps; ++time) {
    for (int i = 0; i < kPoints; ++i) m.move(wall_id(i), place(i, time));
    updates.update(m);
  }
  double remesh = bench::static_seconds(in) / 2;
  for (int i = 0; i < kPoints; ++i) in.points.push_back(place(i, steps)), in.ids.push_back(wall[i]);
  for (int i = 1; i < kPoints; ++i) in.segments.push_back({line_id(i), wall[i - 1], wall[i]});
  remesh += bench::static_seconds(in) / 2;
  print(updates, in, "wall", remesh);
  write(in, prefix, "wall");
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  std::string file, prefix;
  int steps = 1000;
  for (int i = 1; i < argc; ++i) {
    if (std::string(argv[i]) == "--inputs" && i + 1 < argc) {
      prefix = argv[++i];
      continue;
    }
    const int number = std::atoi(argv[i]);
    number > 0 ? void(steps = number) : void(file = argv[i]);
  }
  bench_crack(steps, prefix);
  bench_wall(file.empty() ? lake() : bench::file_input(file), steps, prefix);
}
