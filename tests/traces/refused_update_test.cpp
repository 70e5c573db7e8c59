// A batch that is refused leaves nothing in the trace of a mesh.
#include <catch2/catch.hpp>
#include <functional>

#include "any_id.hpp"
#include "facade/box_mesher.hpp"
#include "traces/distance.hpp"
#include "traces/recorder.hpp"

namespace {

using mesher::ErrorCode;

AnyId id(std::int64_t i) { return AnyId{i}; }

// A square with a point in it.
mesher::BoxMesher<2> square() {
  mesher::BoxMesher<2> m({.domain = {{0, 0}, {1, 1}}});
  m.insert({id(1), id(2), id(3), id(4), id(5)},
           {{0.125, 0.125}, {0.875, 0.125}, {0.875, 0.875}, {0.125, 0.875}, {0.5, 0.375}});
  m.insert_polyline(id(1), {id(1), id(2), id(3), id(4), id(1)});
  m.update();
  return m;
}

struct Footprint {
  std::uint64_t calls, edges;
  friend bool operator==(const Footprint&, const Footprint&) = default;
};
Footprint footprint(const mesher::BoxMesher<2>& m) {
  return {m.engine().live_calls(), m.engine().live_edges()};
}

// Twice, since the engine may keep some room for edits.
void refuse(mesher::BoxMesher<2>& m, ErrorCode code, const std::function<void()>& announce) {
  const Footprint before = footprint(m);
  const traces::Trace trace = traces::Recorder(m.engine()).trace();
  std::size_t bytes = 0;
  for (int round = 0; round < 2; ++round) {
    announce();
    try {
      m.update();
      FAIL("not refused");
    } catch (const mesher::Error& error) {
      CHECK(error.code() == code);
    }
    CHECK(footprint(m) == before);
    CHECK(traces::distance(trace, traces::Recorder(m.engine()).trace()).all.distance() == 0);
    if (round == 1) CHECK(m.engine().bytes() == bytes);
    bytes = m.engine().bytes();
    m.check_invariants();
  }
}

}  // namespace

TEST_CASE("A refused batch leaves the calls, the memory and the trace that there were") {
  mesher::BoxMesher<2> m = square();
  const std::size_t bytes = m.engine().bytes();
  refuse(m, ErrorCode::crossing_segments, [&] {
    m.insert(id(6), {0.25, 0.25});
    m.insert(id(7), {0.96875, 0.25});
    m.move(id(5), {0.5, 0.625});
    m.insert_segment(id(2), id(6), id(7));
  });
  refuse(m, ErrorCode::point_on_segment, [&] {
    m.insert(id(6), {0.25, 0.125});
    m.remove(id(5));
  });
  refuse(m, ErrorCode::overlapping_segments, [&] {
    m.insert(id(6), {0.0625, 0.125});
    m.insert_segment(id(2), id(6), id(2));
  });
  refuse(m, ErrorCode::unknown_id, [&] {
    m.remove_line(id(1));
    m.insert_segment(id(2), id(1), id(9));
  });
  refuse(m, ErrorCode::too_close, [&] { m.insert(id(6), {0.5, 0.125 + 0x1p-50}); });
  CHECK(m.engine().bytes() <= bytes + 8192);
}
