// Limits of size: how many vertices they take, beside the model's [rules A7], and how many an edit
// changes.
//
//   sizes_bench [FILE.poly A]...   default: the square of the rules; else each file with its
//                                  largest area A
//
// One JSON line per figure:
//   static           vertices (inside: in the square, where the model counts), seconds
//   disc             edits of the limit in a disc, half as wide spacings and back: vertices that
//   were or
//                    are in it, and how many change for each of them; calls and microseconds
//   point, segment   an insertion and its removal, inside the square: median and largest number of
//                    vertices changed, median of calls executed and microseconds
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "../../tests/support/sized_square.hpp"
#include "bench_help.hpp"
#include "facade/box_mesher.hpp"
#include "facade/mesh_statically.hpp"
#include "input.hpp"
#include "mesher/error.hpp"
#include "mesher/extra/generate.hpp"

namespace {

using bench::quantile;
using mesher::LineId;
using mesher::Options;
using mesher::Point;
using mesher::PointId;
using support::SizedSquare;
using support::SizesInSquare;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

struct Case {
  const char* name;
  Options<2> options;
  double spacing;  // about
  int model;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  const auto constant = [&](const char* name, double area, int model) {
    Options<2> options{.domain = SizedSquare::domain()};
    options.max_measure = area;
    all.push_back({name, options, SizesInSquare::size(area), model});
  };
  const auto varying = [&](const char* name, double area, const SizesInSquare& sizes, int model) {
    Options<2> options{.domain = SizedSquare::domain()};
    options.sizes = std::make_shared<SizesInSquare>(sizes);
    all.push_back({name, options, SizesInSquare::size(area), model});
  };
  constant("A = 1e-4", 1e-4, 2732);
  constant("A = 1e-4 / 4", 1e-4 / 4, 10352);
  constant("A = 1e-4 / 16", 1e-4 / 16, 40282);
  varying("linear", 1e-5, SizesInSquare::linear(1e-5, 0.05), 3249);
  varying("linear, 16 times finer", 1e-5 / 16, SizesInSquare::linear(1e-5 / 16, 0.05 / 4), 46821);
  varying("step", 1e-5, SizesInSquare::step(1e-5), 4350);
  varying("step, 16 times finer", 1e-5 / 16, SizesInSquare::step(1e-5 / 16), 66404);
  return all;
}

void print_static(const Case& c) {
  const auto start = Clock::now();
  const auto mesh = mesh_statically(SizedSquare::points(), SizedSquare::segments(), c.options, {});
  const double seconds = seconds_since(start);
  const auto inside =
      std::count_if(mesh.vertices.begin(), mesh.vertices.end(), SizedSquare::contains);
  std::printf(
      "{\"bench\":\"sizes\",\"figure\":\"static\",\"limit\":\"%s\",\"vertices\":%zu,\"inside\":%ld,"
      "\"model\":%d,\"over_model\":%.4f,\"seconds\":%.4f}\n",
      c.name, mesh.vertices.size(), static_cast<long>(inside), c.model,
      static_cast<double>(inside) / c.model, seconds);
}

struct Edits {
  std::vector<double> vertices, calls, microseconds;

  void print(const char* figure, const Case& c) const {
    std::printf(
        "{\"bench\":\"sizes\",\"figure\":\"%s\",\"limit\":\"%s\",\"updates\":%zu,"
        "\"vertices_median\":%g,\"vertices_most\":%g,\"calls_median\":%g,\"median_us\":%.1f}\n",
        figure, c.name, vertices.size(), quantile(vertices, 0.5), quantile(vertices, 1),
        quantile(calls, 0.5), quantile(microseconds, 0.5));
  }
};

void update(mesher::BoxMesher<2>& m, Edits& edits) {
  const auto start = Clock::now();
  const auto change = m.update();
  edits.microseconds.push_back(1e6 * seconds_since(start));
  edits.calls.push_back(static_cast<double>(change.calls.executed));
  edits.vertices.push_back(
      static_cast<double>(change.vertices_added.size() + change.vertices_removed.size()));
}

// A point, or a segment three spacings long, at random places; not those that meet the features.
Edits random_edits(mesher::BoxMesher<2>& m, double length) {
  constexpr PointId kFrom{1000}, kTo{1001};
  constexpr LineId kLine{1000};
  mesher::SplitMix64 random(7);
  Edits edits;
  while (edits.vertices.size() < 100) {
    const Point<2> p{random.unit(), random.unit()};
    const double angle = 7 * random.unit();
    const Point<2> q{p[0] + length * std::cos(angle), p[1] + length * std::sin(angle)};
    if (SizedSquare::beyond(p) > -0.01 || SizedSquare::beyond(q) > -0.01) continue;
    try {
      m.insert(kFrom, p);
      if (length > 0) m.insert(kTo, q), m.insert_segment(kLine, kFrom, kTo);
      update(m, edits);
    } catch (const mesher::Error&) {
      continue;
    }
    if (length > 0) m.remove_line(kLine), m.remove(kTo);
    m.remove(kFrom);
    update(m, edits);
  }
  return edits;
}

// Half the size in a disc. What is around it is as it was.
class Disc final : public mesher::SizeField<2> {
 public:
  Disc(const Point<2>& middle, double radius, double h) : at_(middle), radius_(radius), h_(h) {}

  [[nodiscard]] bool contains(const Point<2>& p) const {
    return std::hypot(p[0] - at_[0], p[1] - at_[1]) < radius_;
  }
  [[nodiscard]] mesher::Box<2> box() const {
    return {{at_[0] - radius_, at_[1] - radius_}, {at_[0] + radius_, at_[1] + radius_}};
  }
  [[nodiscard]] double at(const Point<2>& p) const override { return contains(p) ? h_ / 2 : h_; }
  [[nodiscard]] mesher::SizeRange range(const mesher::Box<2>& box) const override {
    const Point<2> nearest{std::clamp(at_[0], box.lo[0], box.hi[0]),
                           std::clamp(at_[1], box.lo[1], box.hi[1])};
    const bool all = contains(box.lo) && contains(box.hi) && contains({box.lo[0], box.hi[1]}) &&
                     contains({box.hi[0], box.lo[1]});
    return {contains(nearest) ? h_ / 2 : h_, all ? h_ / 2 : h_, true};
  }
  [[nodiscard]] std::vector<double> plateaus() const override { return {h_ / 2, h_}; }

 private:
  Point<2> at_;
  double radius_, h_;
};

void print_discs(const Case& c, mesher::BoxMesher<2>& m, double radius) {
  mesher::SplitMix64 random(11);
  Edits edits;
  std::vector<double> inside;
  while (edits.vertices.size() < 20) {
    const Point<2> p{random.unit(), random.unit()};
    if (SizedSquare::beyond(p) > -radius) continue;
    const double size = std::sqrt(c.options.max_measure / mesher::kAreaOfSize);
    const auto disc = std::make_shared<Disc>(p, radius, size);
    const auto count = [&] {
      const auto mesh = m.mesh();
      return static_cast<double>(
          std::count_if(mesh.vertices.begin(), mesh.vertices.end(),
                        [&](const Point<2>& v) { return disc->contains(v); }));
    };
    const double before = count();
    m.limit(disc->box(), {.max_measure = 0, .sizes = disc});
    update(m, edits);
    inside.push_back(before + count());
    m.limit(disc->box(), {.max_measure = c.options.max_measure});
    update(m, edits);
    inside.push_back(inside.back());
  }
  std::vector<double> ratios;
  for (std::size_t i = 0; i < inside.size(); ++i) ratios.push_back(edits.vertices[i] / inside[i]);
  std::printf(
      "{\"bench\":\"sizes\",\"figure\":\"disc\",\"limit\":\"%s\",\"radius\":%g,\"updates\":%zu,"
      "\"in_disc_median\":%g,\"changed_over_in_disc_median\":%.3f,\"changed_over_in_disc_most\":%."
      "3f,"
      "\"calls_median\":%g,\"median_us\":%.1f}\n",
      c.name, radius, inside.size(), quantile(inside, 0.5), quantile(ratios, 0.5),
      quantile(ratios, 1), quantile(edits.calls, 0.5), quantile(edits.microseconds, 0.5));
}

void print_edits(const Case& c) {
  mesher::BoxMesher<2> m(c.options);
  std::int64_t next = 1;
  for (const Point<2>& p : SizedSquare::points()) m.insert(PointId{next++}, p);
  for (const auto& s : SizedSquare::segments()) m.insert_segment(s.id, s.from, s.to);
  m.update();
  random_edits(m, 0).print("point", c);
  random_edits(m, 3 * c.spacing).print("segment", c);
  if (c.options.max_measure == 0) return;
  for (const double spacings : {3.0, 10.0}) print_discs(c, m, spacings * c.spacing);
}

void print_file(const char* path, double area) {
  bench::Input in = bench::file_input(path);
  in.options.max_measure = area;
  const auto start = Clock::now();
  const auto mesh = mesh_statically(in.points, in.segments, in.options, in.ids);
  std::printf(
      "{\"bench\":\"sizes\",\"figure\":\"static\",\"file\":\"%s\",\"max_measure\":%g,\"vertices\":%"
      "zu,"
      "\"seconds\":%.4f}\n",
      path, area, mesh.vertices.size(), seconds_since(start));
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  for (int i = 1; i + 1 < argc; i += 2) print_file(argv[i], std::strtod(argv[i + 1], nullptr));
  if (argc > 1) return 0;
  for (const Case& c : cases()) {
    print_static(c);
    print_edits(c);
  }
}
