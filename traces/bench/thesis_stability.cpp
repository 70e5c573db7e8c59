// The thesis's programs beside ours: what one inserted point costs, against lg(L/s) and n.
//
//   thesis_stability [--n N]... [--edits K] [--out PATH]
//
// The thesis's are sac/examples/thesis, line by line; ours is the mesher with the paper's rule
// (voronoi_aspect); input and box are equal, rho = 2, gamma = 2 rho. A point comes in one update
// and goes in another; of both: the distance D of the traces before and after, the work W (calls
// made, let go and run), W by weight, and microseconds of the process. Ours triangulates, too.
// Against
//   lg(L/s)  the point is put at a distance s, from L / 10 to L / 10^12, from a point of the input
//            (500 points in the plane; 50 in space, there to L / 10^8 and of a quarter of the
//            edits)
//   n        N points (default: 100 1000 10000; in space a fifth of N up to 1000), the point
//            anywhere; distances where N is at most 1000
// PATH.svg (default: build/thesis_stability.svg) shows medians as lines and 99th percentiles as
// ticks; one JSON line per place on the plot goes to standard output, and one per line on it: a fit
// over lg(L/s). Before them, one line per program and N: its first run.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "../../sac/examples/thesis/mesh.hpp"
#include "bench_help.hpp"
#include "facade/box_mesher.hpp"
#include "facade/mesh_statically.hpp"
#include "mesher/extra/generate.hpp"
#include "plots.hpp"

namespace {

using bench::Against;
using bench::Cost;
using bench::Plot;
using mesher::Point;
namespace thesis = examples::thesis;

constexpr double kRho = 2;
const std::vector<bench::Kind> kKinds{{"the figures", "#c0392b"}, {"ours", "#1b6ca8"}};

template <int D>
mesher::Options<D> options() {
  mesher::Options<D> options;
  options.domain.hi.fill(1);
  options.rho = kRho;
  options.rule = mesher::Rule::voronoi_aspect;
  options.record_weights = true;
  return options;
}

// Points that stay the same when they are moved into the box.
template <int D>
Point<D> rounded(Point<D> p) {
  for (double& x : p) x = std::round(x * 0x1p50) * 0x1p-50;
  return p;
}
template <int D>
std::vector<Point<D>> random_points(std::size_t n) {
  auto points = mesher::generate_points<D>(mesher::PointKind::uniform, n, 5);
  for (auto& p : points) p = rounded<D>(p);
  return points;
}

void print_first_run(const char* program, int d, std::size_t n, double seconds, double plain,
                     const sac::Engine& engine, std::size_t vertices) {
  std::printf(
      "{\"bench\":\"thesis_stability\",\"figure\":\"first_run\",\"program\":\"%s\","
      "\"dimension\":%d,\"n\":%zu,\"seconds\":%.4f,\"plain_seconds\":%.4f,\"calls\":%llu,"
      "\"edges\":%llu,\"bytes\":%zu,\"vertices\":%zu}\n",
      program, d, n, seconds, plain, static_cast<unsigned long long>(engine.live_calls()),
      static_cast<unsigned long long>(engine.live_edges()), engine.bytes(), vertices);
  std::fflush(stdout);
}

// --- The programs, with one interface

template <int D>
class Ours {
 public:
  explicit Ours(const std::vector<Point<D>>& points) : mesher_(options<D>()) {
    std::vector<mesher::PointId> ids;
    for (std::size_t i = 1; i <= points.size(); ++i) ids.push_back(id(i));
    mesher_.insert(ids, points);
    const double seconds = bench::seconds_of([&] { mesher_.update(); });
    const double plain = bench::seconds_of(
        [&] { static_cast<void>(mesher::mesh_statically<D>(points, options<D>())); });
    print_first_run("ours", D, points.size(), seconds, plain, mesher_.engine(),
                    mesher_.stats().vertices);
  }
  [[nodiscard]] const sac::Engine& engine() const { return mesher_.engine(); }
  bool insert(const Point<D>& p) {
    try {
      mesher_.insert(kEdited, p);
    } catch (const mesher::Error&) {
      return false;
    }
    return true;
  }
  void remove(const Point<D>&) { mesher_.remove(kEdited); }
  Cost update() {
    mesher::CallCounts calls;
    Cost cost;
    cost.microseconds = 1e6 * bench::seconds_of([&] { calls = mesher_.update().calls; });
    cost.work = static_cast<double>(calls.created + calls.discarded + calls.executed);
    cost.weight = cost.work + static_cast<double>(calls.weight);
    return cost;
  }

 private:
  static mesher::PointId id(std::size_t i) { return mesher::PointId{static_cast<std::int64_t>(i)}; }
  static constexpr mesher::PointId kEdited{1'000'000'000};
  mesher::BoxMesher<D> mesher_;
};

template <int D>
class Figures {
 public:
  explicit Figures(const std::vector<Point<D>>& points) {
    const mesher::Mesh<D> box = mesher::mesh_statically<D>({}, options<D>());
    lo_ = box.vertices.front();
    const thesis::Settings settings{box.vertices.back()[0] - lo_[0], kRho, 2 * kRho};
    engine_.record_weights();
    mesh_ = std::make_unique<thesis::PointMesh<sac::Engine, D>>(engine_, settings);
    thesis::PointMesh<sac::PlainScope, D> plain(scope_, settings);
    const auto both = [&](const Point<D>& p) { mesh_->insert(moved(p)), plain.insert(moved(p)); };
    for (std::size_t i = 0; i < box.vertices.size(); ++i) {
      if (box.kinds[i] == mesher::VertexKind::boundary) both(box.vertices[i]);
    }
    for (const auto& p : points) both(p);
    const double seconds = bench::seconds_of([&] { mesh_->run(); });
    const double plain_seconds = bench::seconds_of([&] { plain.run(); });
    print_first_run("figures", D, points.size(), seconds, plain_seconds, engine_,
                    mesh_->vertices().size());
  }
  [[nodiscard]] const sac::Engine& engine() const { return engine_; }
  bool insert(const Point<D>& p) {
    mesh_->insert(moved(p));
    return true;
  }
  void remove(const Point<D>& p) { mesh_->remove(moved(p)); }
  Cost update() {
    sac::Counts counts;
    Cost cost;
    cost.microseconds = 1e6 * bench::seconds_of([&] { counts = engine_.propagate(); });
    cost.work = static_cast<double>(counts.created + counts.discarded + counts.executed);
    cost.weight = cost.work + static_cast<double>(counts.weight);
    return cost;
  }

 private:
  [[nodiscard]] thesis::Point<D> moved(const Point<D>& p) const {
    thesis::Point<D> q;
    for (std::size_t i = 0; i < D; ++i) q.x[i] = p[i] - lo_[i];
    return q;
  }

  Point<D> lo_{};
  sac::Engine engine_;
  sac::PlainScope scope_;
  std::unique_ptr<thesis::PointMesh<sac::Engine, D>> mesh_;
};

// --- Edits

template <class Program>
traces::Trace trace_of(const Program& program) {
  return traces::Recorder(program.engine()).trace();
}

// `base`: the trace without the point, if the distance is asked for; that is of the same edit made
// once more, since recording leaves nothing in cache. False: the input does not take the point.
template <class Program, class Place>
bool edit(Program& program, const Place& p, const traces::Trace* base, double x, Plot& plot) {
  if (!program.insert(p)) return false;
  Cost come = program.update();
  program.remove(p);
  Cost go = program.update();
  if (base != nullptr) {
    program.insert(p);
    program.update();
    const auto apart = traces::distance(*base, trace_of(program)).all.distance();
    come.distance = go.distance = static_cast<double>(apart);
    program.remove(p);
    program.update();
  }
  plot[x].push_back(come);
  plot[x].push_back(go);
  return true;
}

template <class Program, int D>
Plot over_spread(const std::vector<Point<D>>& points, int tenths, int edits) {
  Program program(points);
  const traces::Trace base = trace_of(program);
  Plot plot;
  mesher::SplitMix64 random(11);
  for (int tenth = 1; tenth <= tenths; ++tenth) {
    for (int done = 0, tries = 0; done < edits && tries < 100 * edits; ++tries) {
      Point<D> p = points[random.below(points.size())];
      const double s = std::pow(10, -tenth) * std::sqrt(2.0 / D);
      for (double& x : p) x += (random.below(2) == 0 ? s : -s) * (0.5 + random.unit() / 5);
      const bool inside = std::all_of(p.begin(), p.end(), [](double x) { return x >= 0 && x < 1; });
      if (inside && edit(program, rounded<D>(p), &base, std::log2(std::pow(10, tenth)), plot))
        ++done;
    }
  }
  return plot;
}

template <class Program, int D>
void over_size(std::size_t n, int edits, Plot& plot) {
  const auto points = random_points<D>(n);
  Program program(points);
  std::optional<traces::Trace> base;
  if (n <= 1000) base = trace_of(program);
  mesher::SplitMix64 random(17);
  for (int done = 0; done < 4 * edits;) {
    Point<D> p;
    for (double& x : p) x = random.unit();
    const bool records = base && done < edits;
    if (edit(program, rounded<D>(p), records ? &*base : nullptr, static_cast<double>(n), plot))
      ++done;
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  std::vector<std::size_t> sizes;
  int edits = 20;
  std::string out = "build/thesis_stability";
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--n") == 0) sizes.push_back(std::strtoull(argv[i + 1], nullptr, 10));
    if (std::strcmp(argv[i], "--edits") == 0) edits = std::max(2, std::atoi(argv[i + 1]));
    if (std::strcmp(argv[i], "--out") == 0) out = argv[i + 1];
  }
  if (sizes.empty()) sizes = {100, 1000, 10000};
  const int few = std::max(2, edits / 4);
  Against spread{"lg(L/s)", "lg(L/s), plane", false, {}};
  spread.plots.push_back(over_spread<Figures<2>, 2>(random_points<2>(500), 12, edits));
  spread.plots.push_back(over_spread<Ours<2>, 2>(random_points<2>(500), 12, edits));
  Against space_spread{"lg(L/s), space", "lg(L/s), space", false, {}};
  space_spread.plots.push_back(over_spread<Figures<3>, 3>(random_points<3>(50), 8, few));
  space_spread.plots.push_back(over_spread<Ours<3>, 3>(random_points<3>(50), 8, few));
  Against size{"n", "points, plane", true, std::vector<Plot>(2)};
  Against space_size{"n, space", "points, space", true, std::vector<Plot>(2)};
  for (const std::size_t n : sizes) {
    over_size<Figures<2>, 2>(n, edits, size.plots[0]);
    over_size<Ours<2>, 2>(n, edits, size.plots[1]);
    if (n > 1000) continue;
    over_size<Figures<3>, 3>(n / 5, few, space_size.plots[0]);
    over_size<Ours<3>, 3>(n / 5, few, space_size.plots[1]);
  }
  const std::vector<Against> all{spread, space_spread, size, space_size};
  return bench::draw("thesis_stability", kKinds, all, out + ".svg");
}
