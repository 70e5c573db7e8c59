// Updates of an input with segments, against static and first runs.
//
//   segments_bench [FILE.poly | N[:EDITS]]...   default: 10000 100000
//
// Input: a file, or N random segments and as many points (family `segments` of `mesher gen`). One
// JSON line per figure:
//   static          vertices and seconds of a static run
//   first_run       the same with the engine, its ratio to static, bytes of trace per vertex
//   +point ...      median and p99 of single updates in microseconds, and per update the calls that
//                   ran, and the vertices that came and went. A segment comes and goes with its
//                   ends, a polyline of ten points with these, each in one update; places are even
//                   in the domain, lengths those between the segments of the input.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "bench_help.hpp"
#include "input.hpp"
#include "random_line.hpp"
#include "sample.hpp"

namespace {

using bench::Input;
using bench::Sample;
using mesher::LineId;
using mesher::Point;
using mesher::PointId;

double print_static(const Input& in) {
  mesher::MeshStats stats;
  const double seconds = bench::seconds_of([&] {
    static_cast<void>(mesher::mesh_statically(in.points, in.segments, in.options, in.ids, &stats));
  });
  const double run = stats.seconds_quadtree + stats.seconds_steiner + stats.seconds_triangulate;
  std::printf(
      "{\"bench\":\"segments\",\"input\":\"%s\",\"figure\":\"static\",\"points\":%zu,"
      "\"segments\":%zu,\"vertices\":%zu,\"run_s\":%.4f,\"total_s\":%.4f}\n",
      in.name.c_str(), in.points.size(), in.segments.size(), stats.vertices, run, seconds);
  return run;
}

void print_first_run(const Input& in, const mesher::BoxMesher<2>& m, double static_seconds) {
  const mesher::MeshStats s = m.stats();
  const double run = s.seconds_quadtree + s.seconds_steiner + s.seconds_triangulate;
  std::printf(
      "{\"bench\":\"segments\",\"input\":\"%s\",\"figure\":\"first_run\",\"run_s\":%.4f,"
      "\"over_static\":%.3f,\"calls\":%llu,\"edges\":%llu,\"bytes_per_vertex\":%.1f}\n",
      in.name.c_str(), run, run / static_seconds, static_cast<unsigned long long>(s.calls),
      static_cast<unsigned long long>(s.edges),
      static_cast<double>(s.trace_bytes) / static_cast<double>(s.vertices));
  std::fflush(stdout);
}

/// Random lines that come and go.
class Editor {
 public:
  Editor(const Input& in, mesher::BoxMesher<2>& m) : in_(in), m_(m), random_(in.points.size()) {}

  /// A line of `points` points (1: the point alone) comes in one update and goes in another.
  void edit(int points, Sample& come, Sample& go) {
    const std::vector<PointId> line = insert(points, come);
    if (points > 1) m_.remove_line(line_of(line));
    for (const PointId id : line) m_.remove(id);
    go.update(m_);
  }

 private:
  /// It has the number of its first point.
  static LineId line_of(const std::vector<PointId>& points) {
    return LineId{static_cast<std::int64_t>(points.front())};
  }
  Point<2> somewhere() {
    Point<2> p;
    const auto& [lo, hi] = in_.options.domain;
    for (int i = 0; i < 2; ++i) p[i] = lo[i] + (hi[i] - lo[i]) * random_.unit();
    return p;
  }
  std::vector<Point<2>> line(int points) {
    const Point<2> from = somewhere();
    const double at = 4 * random_.unit();
    const double length = in_.length * (points == 2 ? 0.2 + 0.8 * random_.unit() : 0.4);
    return bench::random_line(from, at, points - 1, length, random_);
  }
  // Where the mesher refuses it (it crosses something, or leaves the domain), another is tried.
  std::vector<PointId> insert(int points, Sample& come) {
    for (;;) {
      std::vector<PointId> ids;
      Sample tried = come;
      try {
        for (const Point<2>& p : line(points)) {
          ids.push_back(PointId{next_id_++});
          m_.insert(ids.back(), p);
        }
        if (points > 1) m_.insert_polyline(line_of(ids), ids);
        tried.update(m_);
      } catch (const mesher::Error&) {
        m_.discard_edits();
        continue;
      }
      come = std::move(tried);
      return ids;
    }
  }

  const Input& in_;
  mesher::BoxMesher<2>& m_;
  mesher::SplitMix64 random_;
  std::int64_t next_id_ = 1'000'000'000;
};

void bench_input(const Input& in, int edits) {
  const double static_seconds = print_static(in);
  mesher::BoxMesher<2> m = bench::first_run(in);
  print_first_run(in, m, static_seconds);
  Editor editor(in, m);
  struct Kind {
    const char* name;
    int points;
  };
  for (const Kind& kind : {Kind{"point", 1}, Kind{"segment", 2}, Kind{"polyline", 10}}) {
    Sample come, go;
    for (int i = 0; i < edits; ++i) editor.edit(kind.points, come, go);
    come.print("segments", in.name, std::string("+") + kind.name);
    go.print("segments", in.name, std::string("-") + kind.name);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  constexpr int kEdits = 500;
  std::vector<std::string> inputs(argv + 1, argv + argc);
  if (inputs.empty()) inputs = {"10000", "100000"};
  for (const std::string& input : inputs) {
    char* rest = nullptr;
    const std::size_t n = std::strtoull(input.c_str(), &rest, 10);
    if (rest != input.c_str()) {
      bench_input(bench::random_segments(n), *rest == ':' ? std::atoi(rest + 1) : kEdits);
    } else {
      bench_input(bench::file_input(input), kEdits);
    }
  }
}
