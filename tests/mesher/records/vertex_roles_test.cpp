// Who sees a vertex sees its role.
#include <algorithm>
#include <catch2/catch.hpp>
#include <memory>
#include <stdexcept>

#include "index/vertex_index.hpp"
#include "mesher/error.hpp"
#include "sac/sac.hpp"

namespace {

using mesher::Point;
using mesher::detail::Label;
using mesher::detail::MeshBox;
using mesher::detail::Role;
using mesher::detail::VertexIndex;
using mesher::detail::VertexRef;

const Point<2> kPlace{0.25, 0.5};

// Three calls in a row: two that may insert a vertex at kPlace, and one that looks at the cell of
// another vertex and at that of kPlace's.
struct Program {
  sac::Engine engine;
  MeshBox<2> box{.lo = {-1.5, -1.5}, .side = 4};
  VertexIndex<sac::Scope> index{box, engine};
  sac::Mod<int> first = engine.input(0), second = engine.input(0);  // 0 nothing, 1 free, n on n - 1
  sac::Mod<int> refuses = engine.input(0);  // whether to throw at the role of segment 1
  sac::Mod<int> seen = engine.cell<int>();
  VertexRef<2> beside;

  Program() {
    engine.set_environment(this);
    box.for_each_boundary_point([&](const Point<2>& p) { index.add_boundary(p); });
    beside = index.add_boundary({0.5, 0.5});
  }
};

void insert(sac::Scope& s, int what) {
  auto& index = s.environment<Program>().index;
  if (what == 1) index.insert(s, kPlace);
  if (what > 1) {
    const auto segment = static_cast<mesher::detail::SegmentHandle>(what - 1);
    index.insert(s, kPlace, Role{Label{0.5, false}, segment});
  }
}
void insert_first(sac::Scope& s) { insert(s, s.read(s.environment<Program>().first)); }
void insert_second(sac::Scope& s) { insert(s, s.read(s.environment<Program>().second)); }

void look(sac::Scope& s) {
  auto& program = s.environment<Program>();
  const auto cell = program.index.voronoi_cell(s, program.beside, 0.5);
  int seen = 0;
  for (int i = 0; i < cell->size(); ++i) {
    if (!cell->real(i) || cell->place(i) != kPlace) continue;
    seen = 1 + static_cast<int>(program.index.role(program.index.pool()[cell->handle(i)]).on);
  }
  if (seen == 2 && s.read(program.refuses) != 0) throw std::runtime_error("refused");
  s.write(program.seen, seen);
}

void all(sac::Scope& s) {
  s.call<insert_first>();
  s.call<insert_second>();
  s.call<look>();
}

}  // namespace

TEST_CASE(
    "A vertex that gets another role, earlier or later, is seen with it by those who saw it") {
  auto program = std::make_unique<Program>();
  program->engine.run<all>();
  program->index.commit();
  const auto becomes = [&](int first, int second) {
    program->engine.set(program->first, first);
    program->engine.set(program->second, second);
    program->engine.propagate();
    program->index.commit();
    CHECK(program->engine.get(program->seen) == std::max(first, second));
  };
  for (int round = 0; round < 2; ++round) {
    becomes(0, 1);
    becomes(2, 0);
    becomes(0, 3);
    becomes(3, 0);
    becomes(0, 1);
    becomes(0, 3);
    becomes(0, 2);
    becomes(1, 0);
    becomes(0, 2);
    becomes(0, 0);
  }
}

TEST_CASE("A role that an update has given and takes back is the one before") {
  auto program = std::make_unique<Program>();
  program->engine.run<all>();
  program->engine.set(program->refuses, 1);
  for (const int before : {1, 3}) {
    program->engine.set(program->second, before);
    program->engine.propagate();
    program->engine.set(program->first, 2);
    CHECK_THROWS_AS(program->engine.propagate(), std::runtime_error);
    CHECK(program->engine.get(program->seen) == before);
  }
}

TEST_CASE("Two vertices for one place are refused, whatever their roles") {
  for (const int second : {1, 2, 3}) {
    auto program = std::make_unique<Program>();
    program->engine.run<all>();
    program->engine.set(program->first, 2);
    program->engine.propagate();
    program->engine.set(program->second, second);
    CHECK_THROWS_AS(program->engine.propagate(), mesher::Error);
    CHECK(program->engine.get(program->seen) == 2);
  }
}
