// The mesher under edits of complexes in space, by its traces: a propagated trace is that of a
// fresh run, the work is within twice the distance, and the audits have nothing to say.
#include <catch2/catch.hpp>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "any_id.hpp"
#include "facade/box_mesher.hpp"
#include "mesher/error.hpp"
#include "random_complex.hpp"
#include "traces/audit.hpp"
#include "traces/distance.hpp"
#include "traces/recorder.hpp"

namespace {

using mesher::BoxMesher;
using mesher::Point;
using support::Complex;

constexpr int kAcross = 2;           // parts; each in a unit cube
constexpr std::int64_t kIds = 1000;  // of a part

// Parts, by the cubes that they are in, and a mesher that follows them.
class Followed {
 public:
  Followed() : mesher_(options()) { mesher_.update(); }

  [[nodiscard]] bool has(int cube) const { return parts_.count(cube) != 0; }
  [[nodiscard]] traces::Trace trace() const { return traces::Recorder(mesher_.engine()).trace(); }
  [[nodiscard]] traces::Trace fresh_trace() const {
    BoxMesher<3> fresh(options());
    for (const auto& [cube, part] : parts_) put(fresh, cube, part);
    fresh.update();
    return traces::Recorder(fresh.engine()).trace();
  }
  // Nothing if it has no mesh: one in a thousand has angles at which vertices come ever closer.
  std::optional<mesher::CallCounts> put(int cube, const Complex& part) {
    put(mesher_, cube, part);
    try {
      const mesher::CallCounts calls = mesher_.update().calls;
      parts_[cube] = part;
      return calls;
    } catch (const mesher::Error& error) {
      REQUIRE(error.code() == mesher::ErrorCode::too_close);
      BoxMesher<3> fresh(options());
      for (const auto& [other, known] : parts_) put(fresh, other, known);
      put(fresh, cube, part);
      REQUIRE_THROWS_WITH(fresh.update(), error.what());
      mesher_.discard_edits();
      return std::nullopt;
    }
  }
  std::optional<mesher::CallCounts> take(int cube) {
    const Complex& part = parts_.at(cube);
    for (std::size_t i = 0; i < part.faces.size(); ++i) mesher_.remove_polygon(id(cube, i));
    for (std::size_t i = 0; i < part.segments.size(); ++i) {
      mesher_.remove_line(id(cube, kIds / 2 + i));
    }
    for (std::size_t i = 0; i < part.points.size(); ++i) mesher_.remove(id(cube, i));
    parts_.erase(cube);
    return mesher_.update().calls;
  }
  static Point<3> corner(int cube) {
    return {double(cube % kAcross), double(cube / kAcross % kAcross),
            double(cube / kAcross / kAcross)};
  }

 private:
  static mesher::Options<3> options() {
    return {.domain = {{0, 0, 0}, {kAcross, kAcross, kAcross}}};
  }
  static AnyId id(int cube, std::size_t i) {
    return AnyId{cube * kIds + static_cast<std::int64_t>(i) + 1};
  }
  static void put(BoxMesher<3>& m, int cube, const Complex& part) {
    for (std::size_t i = 0; i < part.points.size(); ++i) m.insert(id(cube, i), part.points[i]);
    for (std::size_t i = 0; i < part.segments.size(); ++i) {
      const auto& [a, b] = part.segments[i];
      m.insert_segment(id(cube, kIds / 2 + i), id(cube, a), id(cube, b));
    }
    for (std::size_t i = 0; i < part.faces.size(); ++i) {
      mesher::Polygon polygon;
      polygon.id = id(cube, i);
      for (const auto& loop : part.faces[i].loops) {
        polygon.loops.emplace_back();
        for (const std::size_t corner : loop) polygon.loops.back().push_back(id(cube, corner));
      }
      m.insert_polygon(polygon);
    }
  }

  BoxMesher<3> mesher_;
  std::map<int, Complex> parts_;
};

// The functions of which the traces have different calls.
std::string drift(const traces::Trace& after, const traces::Trace& fresh) {
  std::string text;
  for (const auto& [name, counts] : traces::distance(after, fresh).by_function) {
    if (counts.distance() != 0) text += name + ' ' + std::to_string(counts.distance()) + "; ";
  }
  return text;
}

}  // namespace

TEST_CASE("edits of complexes leave the trace of a fresh run, at twice its distance at most",
          "[Theorem 1.4.4]") {
  int refused = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    support::RandomComplex random(seed);
    Followed f;
    std::uint64_t work = 0, distance = 0;
    traces::Trace before = f.trace();
    for (int edit = 0; edit < 24; ++edit) {
      const int cube = static_cast<int>(random.below(kAcross * kAcross * kAcross));
      const bool goes = f.has(cube);
      const auto calls = goes ? f.take(cube) : f.put(cube, random.part(Followed::corner(cube)));
      refused += calls ? 0 : 1;
      if (!calls) continue;
      const traces::Trace after = f.trace();
      INFO("seed " << seed << ", edit " << edit << (goes ? " goes" : " comes"));
      REQUIRE(drift(after, f.fresh_trace()) == "");
      REQUIRE(traces::check_concise(after).surplus == 0);
      REQUIRE(traces::check_monotone(before, after).moved == 0);
      const std::uint64_t apart = traces::distance(before, after).all.distance();
      const std::uint64_t done = calls->created + calls->discarded + calls->executed;
      CHECK(done <= 4 * apart);
      work += done, distance += apart;
      before = after;
    }
    INFO("seed " << seed << ": work " << work << ", distance " << distance);
    CHECK(distance > 10000);
    CHECK(work <= 2 * distance);
  }
  CHECK(refused <= 1);
}
