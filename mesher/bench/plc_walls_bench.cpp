// Long stories of edits of polygons in space against meshing anew with TetGen at every step.
//
//   plc_walls_bench [STORY]...    crack, valve; default: both
//
// One JSON line a story: updates, with the seconds of all of them, and how often a vertex came or
// went; the seconds of a static run of ours on the first and the last input, times the steps; and
// where the Debian package tetgen (1.5) is installed, the seconds that it says it ran on kSamples
// inputs, evenly over the story, scaled to all steps, and what that is over the updates'. The last
// mesh is compared with that of a static run, bit for bit; where they differ the bench fails.
//   crack   triangle by triangle, in 300 steps, a rough crack grows through a block with 2000
//           points; the block's are the only points that are there before
//   valve   in 100 steps the plate in a pipe turns by 81 degrees: a disc of 16 corners, 0.06 thick,
//           all corners of which move in every step
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench_help.hpp"
#include "facade/graph_runs.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/meshing.hpp"
#include "sample.hpp"
#include "tetgen.hpp"

namespace {

using mesher::BoxMesher;
using mesher::Graph;
using mesher::Point;
using mesher::PointId;
using mesher::PolygonId;

constexpr int kSamples = 10;

/// A complex, and a mesher that follows it.
class Story {
 public:
  Story(std::string name, int steps, const mesher::Box<3>& domain)
      : name_(std::move(name)), steps_(steps), options_{.domain = domain}, m_(options_) {}

  PointId point(const Point<3>& at) {
    plc_.points.push_back({PointId{static_cast<std::int64_t>(plc_.points.size()) + 1}, at});
    m_.insert(plc_.points.back().id, at);
    return plc_.points.back().id;
  }
  void move(PointId id, const Point<3>& to) {
    plc_.points[static_cast<std::size_t>(id) - 1].at = to;
    m_.move(id, to);
  }
  void polygon(const std::vector<PointId>& corners) {
    auto& f = plc_.polygons.emplace_back();
    f.id = PolygonId{static_cast<std::int64_t>(plc_.polygons.size())};
    f.loops = {corners};
    m_.insert_polygon(f);
  }
  void begin() {
    first_s_ = bench::seconds_of([&] { m_.update(); });
    remesh_s_ = static_seconds();
  }
  void step() {
    updates_.update(m_);
    if (static_cast<int>(updates_.size()) % (steps_ / kSamples) == 0) ask_tetgen();
  }
  void finish() {
    remesh_s_ = (remesh_s_ + static_seconds()) / 2 * steps_;
    require_fresh();
    char more[400];
    int length = std::snprintf(
        more, sizeof more,
        ",\"updates_s\":%.3f,\"first_run_s\":%.3f,\"all_vertices\":%zu,\"static_s\":%.2f",
        updates_.total_seconds(), first_s_, m_.stats().vertices, remesh_s_);
    if (!theirs_.empty()) {
      double mean = 0;
      for (const double s : theirs_) mean += s / static_cast<double>(theirs_.size());
      std::snprintf(more + length, sizeof more - static_cast<std::size_t>(length),
                    ",\"tetgen_steps_measured\":%zu,\"tetgen_mean_s\":%.4f,"
                    "\"tetgen_scaled_to_all_s\":%.2f,\"tetgen_vertices_at_end\":%zu,"
                    "\"tetgen_over_updates\":%.2f",
                    theirs_.size(), mean, mean * steps_, their_vertices_,
                    mean * steps_ / updates_.total_seconds());
    }
    updates_.print("plc_walls", name_, name_, more);
  }

 private:
  [[nodiscard]] double static_seconds() const {
    return bench::seconds_of([&] { static_cast<void>(mesher::mesh_statically(plc_, options_)); });
  }
  void ask_tetgen() {
    const auto tetgen = bench::run_tetgen(plc_);
    if (!tetgen) return;
    theirs_.push_back(tetgen->seconds);
    their_vertices_ = tetgen->vertices;
  }
  void require_fresh() const {
    if (m_.mesh() == mesher::mesh_statically(plc_, options_)) return;
    std::fprintf(stderr, "plc_walls_bench: the last mesh of %s is not that of a fresh run\n",
                 name_.c_str());
    std::exit(1);
  }

  std::string name_;
  int steps_;
  mesher::Options<3> options_;
  BoxMesher<3> m_;
  Graph<3> plc_;
  bench::Sample updates_;
  double first_s_ = 0, remesh_s_ = 0;
  std::vector<double> theirs_;
  std::size_t their_vertices_ = 0;
};

// --- A crack ---------------------------------------------------------------------------------

void add_block(Story& story) {
  std::vector<PointId> at;
  for (int i = 0; i < 8; ++i) {
    at.push_back(story.point({double(i & 1), double(i >> 1 & 1), double(i >> 2 & 1)}));
  }
  for (const auto& side : std::vector<std::vector<std::size_t>>{
           {0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}) {
    story.polygon({at[side[0]], at[side[1]], at[side[2]], at[side[3]]});
  }
}

// Triangles of a lattice in the middle of the block, column by column; its places are up to a
// quarter of its step off a plane.
void bench_crack() {
  constexpr int kSteps = 300, kRows = 10;
  constexpr double kStep = 0.05;
  Story story("crack", kSteps, {{0, 0, 0}, {1, 1, 1}});
  add_block(story);
  for (const Point<3>& p : mesher::generate_points<3>(mesher::PointKind::uniform, 2000, 1)) {
    if (std::abs(p[2] - 0.5) > kStep) story.point({0.02 + 0.96 * p[0], 0.02 + 0.96 * p[1], p[2]});
  }
  mesher::SplitMix64 random(3);
  std::map<std::pair<int, int>, PointId> corners;
  const auto corner = [&](int column, int row) {
    const auto [it, fresh] = corners.try_emplace({column, row}, PointId{});
    if (fresh) {
      it->second = story.point({0.1 + kStep * (column + 0.5 * (row & 1)), 0.25 + kStep * row,
                                0.5 + kStep / 2 * (random.unit() - 0.5)});
    }
    return it->second;
  };
  story.begin();
  for (int i = 0; i < kSteps; ++i) {
    const int column = i / 2 / kRows, row = i / 2 % kRows, side = i % 2, odd = row & 1;
    const PointId a = corner(column, row), b = corner(column + 1, row);
    const PointId c = corner(column, row + 1), d = corner(column + 1, row + 1);
    if (odd == 0) {
      story.polygon(side == 0 ? std::vector{a, b, c} : std::vector{b, d, c});
    } else {
      story.polygon(side == 0 ? std::vector{a, d, c} : std::vector{a, b, d});
    }
    story.step();
  }
  story.finish();
}

// --- A valve ---------------------------------------------------------------------------------

constexpr int kCorners = 16;
double angle_at(int i) { return 6.283185307179586 * i / kCorners; }

// Two round ends with sides between them; ends.first and ends.second have the corners of each.
void add_prism(Story& story, const std::pair<std::vector<PointId>, std::vector<PointId>>& ends) {
  story.polygon(ends.first);
  story.polygon(ends.second);
  for (std::size_t i = 0; i < kCorners; ++i) {
    const std::size_t k = (i + 1) % kCorners;
    story.polygon({ends.first[i], ends.first[k], ends.second[k], ends.second[i]});
  }
}

// Across the pipe when it is shut; turned about y.
Point<3> on_plate(int i, bool upper, double turned) {
  const double x = upper ? 0.03 : -0.03, y = 0.4 * std::cos(angle_at(i));
  const double z = 0.4 * std::sin(angle_at(i)), c = std::cos(turned), s = std::sin(turned);
  return {c * x + s * z, y, c * z - s * x};
}

void bench_valve() {
  constexpr int kSteps = 100;
  Story story("valve", kSteps, {{-1, -1, -1}, {1, 1, 1}});
  std::pair<std::vector<PointId>, std::vector<PointId>> pipe, plate;
  for (int i = 0; i < kCorners; ++i) {
    const double y = 0.5 * std::cos(angle_at(i)), z = 0.5 * std::sin(angle_at(i));
    pipe.first.push_back(story.point({-1, y, z}));
    pipe.second.push_back(story.point({1, y, z}));
    plate.first.push_back(story.point(on_plate(i, false, 0)));
    plate.second.push_back(story.point(on_plate(i, true, 0)));
  }
  add_prism(story, pipe);
  add_prism(story, plate);
  story.begin();
  for (int step = 1; step <= kSteps; ++step) {
    const double turned = 81.0 / 180 * 3.141592653589793 * step / kSteps;
    for (int i = 0; i < kCorners; ++i) {
      story.move(plate.first[static_cast<std::size_t>(i)], on_plate(i, false, turned));
      story.move(plate.second[static_cast<std::size_t>(i)], on_plate(i, true, turned));
    }
    story.step();
  }
  story.finish();
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  if (!bench::has_tetgen()) {
    std::fprintf(stderr, "plc_walls_bench: tetgen is not installed: without it\n");
  }
  const auto wanted = [&](const std::string& name) {
    bool found = argc == 1;
    for (int i = 1; i < argc; ++i) found = found || argv[i] == name;
    return found;
  };
  if (wanted("crack")) bench_crack();
  if (wanted("valve")) bench_valve();
}
