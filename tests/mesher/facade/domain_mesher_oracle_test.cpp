// Random batches of points, lines, moves, seeds and limits: mesh and domain are those from scratch,
// the change is exact, and a batch that fails leaves all as it was.
#include <catch2/catch.hpp>
#include <set>

#include "facade/graph_runs.hpp"
#include "mesher/extra/edit_script.hpp"
#include "mesher/mesher.hpp"
#include "random_lake.hpp"
#include "rules/mesh_box.hpp"

namespace {

using mesher::DomainMesh;
using mesher::Extent;
using mesher::Mesh;
using mesher::Mesher;
using mesher::Point;
using mesher::RegionAreas;
using support::Lake;
using support::LakeEditor;
using Triangles = std::set<std::array<Point<2>, 3>>;

Triangles triangles_of(const Mesh<2>& mesh) {
  Triangles all;
  for (const auto& [a, b, c] : mesh.simplices) {
    all.insert({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
  }
  return all;
}

void require_same(const DomainMesh<2>& a, const DomainMesh<2>& b) {
  REQUIRE(static_cast<const Mesh<2>&>(a.mesh) == static_cast<const Mesh<2>&>(b.mesh));
  REQUIRE(a.mesh.features == b.mesh.features);
  REQUIRE(a.regions == b.regions);
  REQUIRE(a.faults == b.faults);
  REQUIRE(a.keeps_all == b.keeps_all);
}

// Takes the change into `all`; nothing comes twice or goes that is not there.
void apply(const std::vector<std::array<Point<2>, 3>>& added,
           const std::vector<std::array<Point<2>, 3>>& removed, Triangles& all) {
  for (const auto& t : removed) REQUIRE(all.erase(t) == 1);
  for (const auto& t : added) REQUIRE(all.insert(t).second);
}

class Follower {
 public:
  Follower(Extent extent, RegionAreas areas)
      : m_(options(extent, areas)), extent_(extent), areas_(areas) {}

  // Makes the batch, which leads to `lake`; or finds that it fails, if it must.
  void make(std::vector<mesher::Edit<2>> batch, const Lake& lake, bool valid) {
    if (!valid) return refuse(std::move(batch));
    const auto update = mesher::apply(std::move(batch), m_);
    apply(update.change.simplices_added, update.change.simplices_removed, whole_);
    apply(update.change.domain.kept_added, update.change.domain.kept_removed, kept_);
    lake_ = lake;
    check();
  }
  [[nodiscard]] const Lake& lake() const { return lake_; }
  void check_invariants() const { m_.check_invariants(); }
  // How often a batch failed, and how often something was enclosed but not all kept.
  int refused = 0, enclosing = 0, faulty = 0;

 private:
  static mesher::Options<2> options(Extent extent, RegionAreas areas) {
    mesher::Options<2> all = LakeEditor::options();
    all.extent = extent;
    all.region_areas = areas;
    return all;
  }
  void refuse(std::vector<mesher::Edit<2>> batch) {
    CHECK_THROWS_AS(mesher::apply(std::move(batch), m_), mesher::Error);
    ++refused;
    check();
  }

  void check() {
    const mesher::Graph<2> graph = lake_.graph();
    REQUIRE(m_.input() == graph);
    REQUIRE(m_.options().max_measure == lake_.options.max_measure);
    REQUIRE(m_.options().box_limits == lake_.options.box_limits);
    mesher::Options<2> options = lake_.options;
    options.region_limits = mesher::region_limits(graph, options, extent_, areas_);
    const Mesh<2> mesh = mesher::mesh_statically(graph, options);
    const DomainMesh<2> scratch = mesher::domain_mesh(mesh, graph, extent_);
    if (!whole_.empty()) REQUIRE(m_.box_mesh() == mesh);
    if (whole_.empty()) return;
    require_same(m_.domain_mesh(), scratch);
    REQUIRE(whole_ == triangles_of(mesh));
    REQUIRE(kept_ == triangles_of(scratch.mesh));
    check_labels(mesh, graph);
    if (!scratch.keeps_all) ++enclosing;
    if (!scratch.faults.empty()) ++faulty;
  }
  void check_labels(const Mesh<2>& mesh, const mesher::Graph<2>& graph) const {
    const auto whole = mesher::with_features(mesh, graph);
    auto domain = mesher::find_domain(whole, whole.features.edges, graph.seeds, extent_);
    for (std::uint32_t t = 0; t < mesh.simplices.size(); ++t) {
      const auto& [a, b, c] = mesh.simplices[t];
      const std::array corners{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
      REQUIRE(m_.label(corners) == domain.regions[domain.region_of[t]].label);
      REQUIRE(m_.keeps(corners) == domain.keeps(t));
    }
    for (auto& fault : domain.faults) fault.wall = {};
    REQUIRE(m_.faults() == domain.faults);
  }

  Mesher<2> m_;
  Extent extent_;
  RegionAreas areas_;
  Lake lake_;
  Triangles whole_, kept_;
};

// A random history; every fourth wants all of the box.
void follow(std::uint64_t seed, int steps) {
  const Extent extent = seed % 4 == 0 ? Extent::box : Extent::enclosed;
  const RegionAreas areas = seed % 3 == 0 ? RegionAreas::ignored : RegionAreas::limits;
  CAPTURE(seed);
  LakeEditor editor(seed);
  Follower follower(extent, areas);
  const auto box = mesher::detail::mesh_box(LakeEditor::options());
  for (int step = 0; step < steps; ++step) {
    CAPTURE(step);
    Lake next = follower.lake();
    auto batch = editor.batch(next);
    follower.make(std::move(batch), next, next.is_valid(box));
  }
  follower.check_invariants();
  CHECK(follower.refused > steps / 40);
  CHECK(follower.faulty > steps / 20);
  if (extent == Extent::enclosed) CHECK(follower.enclosing > steps / 20);
}

}  // namespace

TEST_CASE("after every batch mesh and domain are those from scratch, and the change is exact") {
  follow(GENERATE(range<std::uint64_t>(1, 13)), 100);
}

TEST_CASE("the same over long histories", "[.soak]") {
  follow(GENERATE(range<std::uint64_t>(1000, 1200)), 400);
}
