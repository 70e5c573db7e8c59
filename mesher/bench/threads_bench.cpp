// Several threads beside one: first runs, updates, and what the tiles say to each other.
//
//   threads_bench [[alone:][3d:|lines:]FAMILY:N:THREADS[:MEASURE]]...
//
// Families of points, or of lines in the plane. `alone`: of points that do not fit into memory
// twice; the mesh of one thread has gone before that of several is made. MEASURE: the largest of a
// simplex, where the domain divided by N is 1; without it any. Default: uniform:1000000:2
// clusters:300000:2 3d:uniform:100000:2 lines:segments:100000:2. One JSON line per figure, times in
// seconds by the clock and of the process:
//   first_run  with points announced before: of one thread, of several, the ratio; of the latter
//              the seconds before and after the tiles; calls over those of one, bytes of trace over
//              those of one; seconds of the phases before the mesh and of it, of one and of several
//   exchanges  rounds and messages of the first run, horizons; vertices of others that tiles see,
//              over all; the most calls of a tile over those of all
//   updates    microseconds by the clock, of points that move anywhere, one at a time: median and
//              99th percentile of one and of several threads; a batch of 1000, of both; of lines
//              that go and come again, a batch of 200
//   alone      as first_run and updates, of less
//   limits     the same of a quarter of MEASURE in boxes that 100 points would be in, and MEASURE
//              again; a batch of 20 boxes
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench_help.hpp"
#include "facade/tiled_state.hpp"
#include "mesher/extra/generate.hpp"
#include "rules/mesh_box.hpp"
#include "sample.hpp"

namespace {

using mesher::BoxMesher;
using mesher::Point;
using mesher::PointId;

struct Taken {
  double clock = 0, process = 0;
};
template <class Run>
Taken time_of(Run&& run) {
  const auto start = std::chrono::steady_clock::now();
  const double process = bench::seconds_of(run);
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), process};
}

template <int D>
struct Case {
  std::string family;
  std::size_t n;
  int threads;
  std::vector<Point<D>> points;
  double relative;  // the largest measure
  mesher::Options<D> options;
  mesher::SplitMix64 random{3};

  [[nodiscard]] std::string name() const {
    return "\"family\":\"" + family + "\",\"dimension\":" + std::to_string(D) +
           ",\"n\":" + std::to_string(n) + ",\"threads\":" + std::to_string(threads) +
           ",\"measure\":" + std::to_string(relative);
  }
  [[nodiscard]] BoxMesher<D> mesher(int with_threads) const {
    mesher::Options<D> some = options;
    some.threads = with_threads;
    BoxMesher<D> m(some);
    for (std::size_t i = 0; i < points.size(); ++i) {
      m.insert(PointId{static_cast<std::int64_t>(i)}, points[i]);
    }
    return m;
  }
  template <class... Meshers>
  void move_any(Meshers&... meshers) {
    const PointId id{static_cast<std::int64_t>(random.below(points.size()))};
    Point<D> p;
    for (int i = 0; i < D; ++i) {
      p[i] = options.domain.lo[i] + random.unit() * (options.domain.hi[i] - options.domain.lo[i]);
    }
    (meshers.move(id, p), ...);
  }
};

// The tiles by themselves, to read their counts.
template <int D>
void print_exchanges(const Case<D>& c) {
  mesher::Options<D> options = c.options;
  options.threads = c.threads;
  mesher::detail::TiledState<D> state(options);
  mesher::detail::Pending<D> pending(mesher::detail::mesh_box(options));
  for (std::size_t i = 0; i < c.points.size(); ++i) {
    pending.set(PointId{static_cast<std::int64_t>(i)}, {}, c.points[i]);
  }
  const mesher::detail::StagedLines lines;
  const mesher::detail::StagedPolygons polygons;
  static_cast<void>(state.first_run({pending.sorted(), lines, polygons}, {}, {}));
  std::uint64_t seen = 0, all = 0, most = 0;
  for (std::size_t t = 0; t < state.tiles().size(); ++t) {
    const auto& counts = state.tiles()[t].counts();
    seen += counts.seen;
    all += counts.run + counts.again;
    most = std::max(most, counts.run + counts.again);
  }
  const auto& exchanges = state.tiles().exchanges();
  std::printf(
      "{\"bench\":\"threads\",\"figure\":\"exchanges\",%s,\"rounds\":%llu,\"horizons\":%llu,"
      "\"messages\":%llu,\"seen_over_vertices\":%.4f,\"most_of_a_tile\":%.3f}\n",
      c.name().c_str(), static_cast<unsigned long long>(exchanges.rounds),
      static_cast<unsigned long long>(exchanges.horizons),
      static_cast<unsigned long long>(exchanges.messages),
      static_cast<double>(seen) / static_cast<double>(state.stats().vertices),
      static_cast<double>(most) / static_cast<double>(all));
}

// Updates of one thread and of several, by the clock: one at a time, and of much at once.
template <int D>
struct Updates {
  BoxMesher<D>&one, &many;
  std::vector<double> us_one{}, us_many{};
  double batch_one = 0, batch_many = 0;

  void update() {
    us_one.push_back(1e6 * time_of([&] { one.update(); }).clock);
    us_many.push_back(1e6 * time_of([&] { many.update(); }).clock);
  }
  void update_together() {
    batch_one = time_of([&] { one.update(); }).clock;
    batch_many = time_of([&] { many.update(); }).clock;
  }
  void print(const std::string& name, const char* figure = "updates") {
    std::printf(
        "{\"bench\":\"threads\",\"figure\":\"%s\",%s,\"one_median_us\":%.1f,"
        "\"many_median_us\":%.1f,\"one_p99_us\":%.1f,\"many_p99_us\":%.1f,\"one_batch_ms\":%.1f,"
        "\"many_batch_ms\":%.1f}\n",
        figure, name.c_str(), bench::quantile(us_one, 0.5), bench::quantile(us_many, 0.5),
        bench::quantile(us_one, 0.99), bench::quantile(us_many, 0.99), 1e3 * batch_one,
        1e3 * batch_many);
  }
};

// Limits that change in boxes.
template <int D>
void bench_limits(Case<D>& c, BoxMesher<D>& one, BoxMesher<D>& many) {
  Updates<D> updates{one, many};
  const auto limit = [&](double relative) {
    const double measure = c.options.max_measure * relative;
    const double part = std::pow(100.0 / static_cast<double>(c.n), 1.0 / D);
    mesher::Box<D> box;
    for (int i = 0; i < D; ++i) {
      const double extent = c.options.domain.hi[i] - c.options.domain.lo[i];
      box.lo[i] = c.options.domain.lo[i] + c.random.unit() * extent * (1 - part);
      box.hi[i] = box.lo[i] + extent * part;
    }
    one.limit(box, {.max_measure = measure}), many.limit(box, {.max_measure = measure});
    return box;
  };
  for (int k = 0; k < 20; ++k) {
    const mesher::Box<D> box = limit(0.25);
    updates.update();
    for (auto* m : {&one, &many}) m->limit(box, {.max_measure = c.options.max_measure});
    updates.update();
  }
  for (int k = 0; k < 20; ++k) static_cast<void>(limit(0.25));
  updates.update_together();
  updates.print(c.name(), "limits");
}

// One mesher after the other.
template <int D>
void bench_alone(const Case<D>& c) {
  struct Figures {
    Taken first;
    mesher::MeshStats stats;
    std::vector<double> us;
    double batch = 0;
  };
  const auto figures_of = [&](int threads) {
    Case<D> same = c;  // with the same random numbers
    same.options.threads = threads;
    BoxMesher<D> m = same.mesher(threads);
    Figures f;
    f.first = time_of([&] { m.update(); });
    f.stats = m.stats();
    for (int k = 0; k < 1000; ++k) {
      same.move_any(m);
      f.us.push_back(1e6 * time_of([&] { m.update(); }).clock);
    }
    for (int k = 0; k < 1000; ++k) same.move_any(m);
    f.batch = time_of([&] { m.update(); }).clock;
    return f;
  };
  const Figures one = figures_of(1), many = figures_of(c.threads);
  std::printf(
      "{\"bench\":\"threads\",\"figure\":\"alone\",%s,\"vertices\":[%zu,%zu],\"first_s\":[%.2f,%."
      "2f],"
      "\"speedup\":%.2f,\"process_s\":[%.2f,%.2f],\"trace_bytes\":[%llu,%llu],"
      "\"median_us\":[%.1f,%.1f],\"p99_us\":[%.1f,%.1f],\"batch_ms\":[%.1f,%.1f]}\n",
      c.name().c_str(), one.stats.vertices, many.stats.vertices, one.first.clock, many.first.clock,
      one.first.clock / many.first.clock, one.first.process, many.first.process,
      static_cast<unsigned long long>(one.stats.trace_bytes),
      static_cast<unsigned long long>(many.stats.trace_bytes), bench::quantile(one.us, 0.5),
      bench::quantile(many.us, 0.5), bench::quantile(one.us, 0.99), bench::quantile(many.us, 0.99),
      1e3 * one.batch, 1e3 * many.batch);
}

template <int D>
void bench_case(Case<D> c) {
  BoxMesher<D> one = c.mesher(1), many = c.mesher(c.threads);
  std::uint64_t calls_of_one = 0, calls = 0;
  const Taken by_one = time_of([&] { calls_of_one = one.update().calls.executed; });
  const Taken by_many = time_of([&] { calls = many.update().calls.executed; });
  const mesher::MeshStats s = many.stats(), of_one = one.stats();
  const double in_tiles = s.seconds_quadtree + s.seconds_steiner + s.seconds_triangulate;
  std::printf(
      "{\"bench\":\"threads\",\"figure\":\"first_run\",%s,\"vertices\":%zu,\"one_s\":%.3f,"
      "\"many_s\":%.3f,\"speedup\":%.2f,\"around_tiles_s\":%.3f,\"one_process_s\":%.3f,"
      "\"many_process_s\":%.3f,\"calls_over_one\":%.3f,\"bytes_over_one\":%.3f,"
      "\"quadtree_s\":[%.3f,%.3f],\"steiner_s\":[%.3f,%.3f]}\n",
      c.name().c_str(), s.vertices, by_one.clock, by_many.clock, by_one.clock / by_many.clock,
      by_many.clock - in_tiles, by_one.process, by_many.process,
      static_cast<double>(calls) / static_cast<double>(calls_of_one),
      static_cast<double>(s.trace_bytes) / static_cast<double>(of_one.trace_bytes),
      of_one.seconds_quadtree, s.seconds_quadtree, of_one.seconds_steiner, s.seconds_steiner);
  Updates<D> updates{one, many};
  for (int k = 0; k < 1000; ++k) {
    c.move_any(one, many);
    updates.update();
  }
  for (int k = 0; k < 1000; ++k) c.move_any(one, many);
  updates.update_together();
  updates.print(c.name());
  if (c.relative != 0) bench_limits(c, one, many);
  print_exchanges(c);
}

// --- Lines

struct Lines {
  std::string family;
  int threads;
  mesher::Graph<2> graph;
  double relative;  // the largest measure
  mesher::SplitMix64 random{3};

  [[nodiscard]] std::string name() const {
    return "\"family\":\"lines:" + family + "\",\"n\":" + std::to_string(size()) +
           ",\"threads\":" + std::to_string(threads) + ",\"measure\":" + std::to_string(relative);
  }
  [[nodiscard]] std::size_t size() const { return graph.segments.size() + graph.polylines.size(); }
  static void insert_line(BoxMesher<2>& m, const mesher::Segment& s) {
    m.insert_segment(s.id, s.from, s.to);
  }
  static void insert_line(BoxMesher<2>& m, const mesher::Polyline& l) {
    m.insert_polyline(l.id, l.points);
  }
  // Calls act(line) for one of all.
  template <class Act>
  void with(std::size_t i, Act&& act) const {
    i < graph.segments.size() ? act(graph.segments[i])
                              : act(graph.polylines[i - graph.segments.size()]);
  }
  [[nodiscard]] BoxMesher<2> mesher(int with_threads) const {
    mesher::Options<2> options{.domain = {{0, 0}, {1, 1}}, .threads = with_threads};
    options.max_measure = relative / static_cast<double>(size());
    BoxMesher<2> m(options);
    for (const auto& p : graph.points) m.insert(p.id, p.at);
    for (std::size_t i = 0; i < size(); ++i) with(i, [&](const auto& l) { insert_line(m, l); });
    return m;
  }
};

void bench_lines(Lines c) {
  BoxMesher<2> one = c.mesher(1), many = c.mesher(c.threads);
  std::uint64_t calls_of_one = 0, calls = 0;
  const Taken by_one = time_of([&] { calls_of_one = one.update().calls.executed; });
  const Taken by_many = time_of([&] { calls = many.update().calls.executed; });
  const mesher::MeshStats s = many.stats(), of_one = one.stats();
  const double in_tiles = s.seconds_quadtree + s.seconds_steiner + s.seconds_triangulate;
  const double steps_of_one =
      of_one.seconds_quadtree + of_one.seconds_steiner + of_one.seconds_triangulate;
  std::printf(
      "{\"bench\":\"threads\",\"figure\":\"first_run\",%s,\"vertices\":%zu,\"one_s\":%.3f,"
      "\"many_s\":%.3f,\"speedup\":%.2f,\"around_tiles_s\":%.3f,\"around_one_s\":%.3f,"
      "\"one_process_s\":%.3f,\"many_process_s\":%.3f,\"calls_over_one\":%.3f,"
      "\"bytes_over_one\":%.3f,\"quadtree_s\":[%.3f,%.3f],\"steiner_s\":[%.3f,%.3f]}\n",
      c.name().c_str(), s.vertices, by_one.clock, by_many.clock, by_one.clock / by_many.clock,
      by_many.clock - in_tiles, by_one.clock - steps_of_one, by_one.process, by_many.process,
      static_cast<double>(calls) / static_cast<double>(calls_of_one),
      static_cast<double>(s.trace_bytes) / static_cast<double>(of_one.trace_bytes),
      of_one.seconds_quadtree, s.seconds_quadtree, of_one.seconds_steiner, s.seconds_steiner);
  Updates<2> updates{one, many};
  const auto both = [&](auto&& edit) { edit(one), edit(many); };
  for (int k = 0; k < 200; ++k) {
    c.with(c.random.below(c.size()), [&](const auto& l) {
      both([&](BoxMesher<2>& m) { m.remove_line(l.id); });
      updates.update();
      both([&](BoxMesher<2>& m) { Lines::insert_line(m, l); });
      updates.update();
    });
  }
  for (std::size_t i = 0; i < std::min<std::size_t>(200, c.size()); ++i) {
    c.with(i * (c.size() / 200 + 1) % c.size(), [&](const auto& l) {
      if (one.contains_line(l.id)) both([&](BoxMesher<2>& m) { m.remove_line(l.id); });
    });
  }
  updates.update_together();
  updates.print(c.name());
}

bool bench_lines(const std::string& family, std::size_t n, int threads, double measure) {
  const auto kind = mesher::pslg_kind(family);
  if (!kind || n == 0 || threads < 1) return false;
  bench_lines({family, threads, mesher::generate_pslg({*kind, n}), measure});
  return true;
}

template <int D>
bool bench_points(const std::string& family, std::size_t n, int threads, double measure,
                  bool alone) {
  const auto kind = mesher::point_kind(family);
  if (!kind || n == 0 || threads < 1) return false;
  Case<D> c{family, n, threads, mesher::generate_points<D>(*kind, n, 1), measure, {}};
  c.options.domain = mesher::snapped_domain<D>(c.points);
  c.options.max_measure = measure / static_cast<double>(n);
  for (int i = 0; i < D; ++i) {
    c.options.max_measure *= c.options.domain.hi[i] - c.options.domain.lo[i];
  }
  alone ? bench_alone(c) : bench_case(std::move(c));
  return true;
}

bool bench_argument(std::string_view text) {
  const bool alone = text.substr(0, 6) == "alone:";
  if (alone) text.remove_prefix(6);
  const bool in_space = text.substr(0, 3) == "3d:", of_lines = text.substr(0, 6) == "lines:";
  if (in_space) text.remove_prefix(3);
  if (of_lines) text.remove_prefix(6);
  const std::size_t colon = text.find(':'), second = text.find(':', colon + 1);
  if (colon == text.npos || second == text.npos) return false;
  const std::string family(text.substr(0, colon));
  const std::size_t n = std::strtoull(text.data() + colon + 1, nullptr, 10);
  const int threads = std::atoi(text.data() + second + 1);
  const std::size_t third = text.find(':', second + 1);
  const double measure = third == text.npos ? 0 : std::atof(text.data() + third + 1);
  if (of_lines) return !alone && bench_lines(family, n, threads, measure);
  return in_space ? bench_points<3>(family, n, threads, measure, alone)
                  : bench_points<2>(family, n, threads, measure, alone);
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  std::vector<std::string_view> cases(argv + 1, argv + argc);
  if (cases.empty())
    cases = {"uniform:1000000:2", "clusters:300000:2", "3d:uniform:100000:2",
             "lines:segments:100000:2"};
  for (const std::string_view text : cases) {
    if (bench_argument(text)) continue;
    std::fprintf(stderr, "%s: not [alone:][3d:|lines:]FAMILY:N:THREADS[:MEASURE]\n",
                 std::string(text).c_str());
    return 2;
  }
}
