// Updates of a domain with limits of size that are stopped anywhere: the mesh of the last one
// stays, and a later update makes the edits, or they are taken back, as if nothing had been
// stopped.
#include <catch2/catch.hpp>

#include "facade/graph_runs.hpp"
#include "mesher/extra/edit_script.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/mesher.hpp"
#include "random_lake.hpp"
#include "rules/mesh_box.hpp"

namespace {

using mesher::DomainMesh;
using mesher::Mesher;
using mesher::RegionAreas;
using support::Lake;
using support::LakeEditor;

class Stopped {
 public:
  explicit Stopped(std::uint64_t seed) : editor_(seed), random_(seed) {}

  void step() {
    Lake next = lake_;
    auto batch = editor_.batch(next);
    if (!next.is_valid(mesher::detail::mesh_box(LakeEditor::options()))) return;
    for (const auto& edit : mesher::announcing_order(batch)) announce(edit, m_);
    for (auto tries = random_.below(3); tries > 0; --tries) stop();
    if (stopped_ && random_.below(3) == 0) {
      m_.discard_edits();
      ++taken_back;
      next = lake_;
    }
    lake_ = next;
    m_.update();
    check();
  }
  void check_invariants() const { m_.check_invariants(); }
  int stops = 0, late = 0, taken_back = 0;

 private:
  static mesher::Options<2> options() {
    mesher::Options<2> all = LakeEditor::options();
    all.region_areas = RegionAreas::limits;
    return all;
  }
  // An update that is stopped when it has told how far it is for a while, if it is that long.
  void stop() {
    const std::uint64_t most = 1 + random_.below(4);
    std::uint64_t told = 0;
    const mesher::RunControl control{
        .progress = [&](const mesher::Progress&) { return ++told < most; }, .stop = {}};
    const auto before = m_.box_mesh();
    const std::size_t lines = m_.input().segments.size();
    try {
      m_.update(control);
      stopped_ = false;
    } catch (const mesher::Error& error) {
      REQUIRE(error.code() == mesher::ErrorCode::cancelled);
      REQUIRE(m_.box_mesh() == before);
      REQUIRE(m_.input().segments.size() == lines);
      stopped_ = true;
      ++stops;
      if (told > 2) ++late;
    }
  }

  void check() {
    stopped_ = false;
    const mesher::Graph<2> graph = lake_.graph();
    REQUIRE(m_.input() == graph);
    mesher::Options<2> options = lake_.options;
    options.region_limits =
        mesher::region_limits(graph, options, mesher::Extent::enclosed, RegionAreas::limits);
    const mesher::Mesh<2> mesh = mesher::mesh_statically(graph, options);
    REQUIRE(m_.box_mesh() == mesh);
    const DomainMesh<2> scratch = mesher::domain_mesh(mesh, graph, mesher::Extent::enclosed);
    const DomainMesh<2> followed = m_.domain_mesh();
    REQUIRE(followed.mesh.features == scratch.mesh.features);
    REQUIRE(followed.regions == scratch.regions);
  }

  LakeEditor editor_;
  mesher::SplitMix64 random_;
  Mesher<2> m_{options()};
  Lake lake_;
  bool stopped_ = false;
};

void follow(std::uint64_t seed, int steps) {
  CAPTURE(seed);
  Stopped domain(seed);
  for (int step = 0; step < steps; ++step) {
    CAPTURE(step);
    domain.step();
  }
  domain.check_invariants();
  CHECK(domain.stops > steps / 40);
  CHECK(domain.taken_back > 0);
  CHECK(domain.late > 0);
}

}  // namespace

TEST_CASE("updates of a limited domain that are stopped anywhere leave no trace") {
  follow(GENERATE(range<std::uint64_t>(1, 7)), 200);
}

TEST_CASE("the same of more updates that are stopped", "[.soak]") {
  follow(GENERATE(range<std::uint64_t>(1000, 1100)), 300);
}
