// A domain that follows a mesher by its changes is the one found in the mesh of the moment.
#include "domain/domain_follower.hpp"

#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "facade/box_mesher.hpp"
#include "failing_new.hpp"
#include "mesher/extra/generate.hpp"
#include "walled_mesh.hpp"

namespace {

using mesher::BoxMesher;
using mesher::Domain;
using mesher::DomainChange;
using mesher::DomainEdits;
using mesher::DomainFollower;
using mesher::Extent;
using mesher::Mesh;
using mesher::MeshEdge;
using mesher::Point;
using mesher::PointId;
using mesher::Seed;
using mesher::SplitMix64;
using support::Places2;
using support::Places3;
using support::WalledMesh;

// A mesher with walls along some of its edges, and all that a follower should say.
class Twin {
 public:
  explicit Twin(std::uint64_t seed) : random_(seed) {
    for (int i = 0; i < 30; ++i) m_.insert(PointId{i}, {random_.unit(), random_.unit()});
    m_.update();
    triangles_ = WalledMesh::triangles_of(m_.mesh());
    seeds_ = {support::region(1, 0.5, 0.5, 3), support::hole(2, 0.52, 0.41)};
  }

  [[nodiscard]] std::vector<MeshEdge> walls() const {
    const Mesh<2> mesh = m_.mesh();
    std::vector<MeshEdge> edges;
    for (const auto& e : walls_) edges.push_back({index(mesh, e[0]), index(mesh, e[1]), {}, 0});
    return edges;
  }
  [[nodiscard]] DomainFollower<2> follower(Extent extent) const {
    return {m_.mesh(), walls(), seeds_, extent};
  }

  // Points come and go; rings of walls too, as far as they are edges.
  std::pair<mesher::Change<2>, DomainEdits<2>> edit() {
    for (int i = 0; i < 3; ++i) {
      const PointId id{static_cast<std::int64_t>(random_.below(40))};
      if (m_.contains(id))
        m_.remove(id);
      else
        m_.insert(id, {random_.unit(), random_.unit()});
    }
    const auto change = m_.update();
    triangles_ = WalledMesh::triangles_of(m_.mesh());
    const WalledMesh::Walls next = ring();
    DomainEdits<2> edits;
    for (const auto& e : walls_) {
      if (!next.contains(e)) edits.walls_out.push_back(e);
    }
    for (const auto& e : next) {
      if (!walls_.contains(e)) edits.walls_in.push_back(e);
    }
    walls_ = next;
    return {change, edits};
  }

  [[nodiscard]] Domain<2> domain(Extent extent) const {
    return find_domain(m_.mesh(), walls(), seeds_, extent);
  }
  [[nodiscard]] const BoxMesher<2>& mesher() const { return m_; }

 private:
  static std::uint32_t index(const Mesh<2>& mesh, const Point<2>& p) {
    return static_cast<std::uint32_t>(
        std::lower_bound(mesh.vertices.begin(), mesh.vertices.end(), p) - mesh.vertices.begin());
  }

  // The old walls that are still edges, or a new ring, or none.
  WalledMesh::Walls ring() {
    const WalledMesh::Walls edges = WalledMesh::edges_of(triangles_);
    WalledMesh::Walls next;
    if (random_.below(3) > 0) {
      for (const auto& e : walls_) {
        if (edges.contains(e)) next.insert(e);
      }
      if (random_.below(2) > 0) return next;
    }
    const double x = random_.unit(), y = random_.unit(), r = 0.4 * random_.unit();
    std::map<Places2, int> sides;
    for (const auto& t : triangles_) {
      const double dx = (t[0][0] + t[1][0] + t[2][0]) / 3 - x;
      const double dy = (t[0][1] + t[1][1] + t[2][1]) / 3 - y;
      if (dx * dx + dy * dy > r * r) continue;
      for (const auto& e : WalledMesh::edges_of({t})) ++sides[e];
    }
    for (const auto& [edge, count] : sides) {
      if (count == 1) next.insert(edge);
    }
    return next;
  }

  SplitMix64 random_;
  BoxMesher<2> m_{mesher::Options<2>{.domain = {{0, 0}, {1, 1}}}};
  std::set<Places3> triangles_;
  WalledMesh::Walls walls_;
  std::vector<Seed<2>> seeds_;
};

// The kept triangles of the mesh of the moment.
std::set<Places3> kept(const Twin& twin, Extent extent) {
  return WalledMesh::triangles_of(
      extract(mesher::MeshData<2>(twin.mesher().mesh()), twin.domain(extent)).mesh);
}

void require_equal(const DomainFollower<2>& follower, const Twin& twin, Extent extent) {
  const Domain<2> domain = twin.domain(extent);
  const Mesh<2> mesh = twin.mesher().mesh();
  REQUIRE(follower.faults() == domain.faults);
  for (std::uint32_t t = 0; t < mesh.simplices.size(); ++t) {
    const auto& c = mesh.simplices[t];
    const Places3 corners{mesh.vertices[c[1]], mesh.vertices[c[2]], mesh.vertices[c[0]]};
    REQUIRE(follower.label(corners) == domain.regions[domain.region_of[t]].label);
    REQUIRE(follower.keeps(corners) == domain.keeps(t));
  }
  follower.check_invariants();
}

}  // namespace

TEST_CASE("a domain follows the changes of a mesher, and says what they do to what is kept") {
  for (const Extent extent : {Extent::enclosed, Extent::box}) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      INFO("seed " << seed);
      Twin twin(seed);
      DomainFollower<2> follower = twin.follower(extent);
      std::set<Places3> mine = kept(twin, extent);
      for (int step = 0; step < 25; ++step) {
        const auto [change, edits] = twin.edit();
        const DomainChange<2> domain_change = follower.update(change, edits);
        for (const auto& t : domain_change.kept_removed) REQUIRE(mine.erase(t) == 1);
        for (const auto& t : domain_change.kept_added) REQUIRE(mine.insert(t).second);
        REQUIRE(mine == kept(twin, extent));
        REQUIRE(std::is_sorted(domain_change.kept_added.begin(), domain_change.kept_added.end()));
        require_equal(follower, twin, extent);
      }
    }
  }
}

TEST_CASE("a domain that finds no memory to follow stays as it was, and follows the next time") {
  std::uint64_t failures = 0;
  for (std::uint64_t k = 1;; k += 1 + k / 40) {
    INFO("allocation " << k);
    Twin twin(3);
    DomainFollower<2> follower = twin.follower(Extent::enclosed);
    for (int step = 0; step < 4; ++step) {
      const auto [change, edits] = twin.edit();
      follower.update(change, edits);
    }
    const auto [change, edits] = twin.edit();
    bool failed = false;
    support::allocation_fuse.left = k;
    try {
      follower.update(change, edits);
    } catch (const std::bad_alloc&) {
      failed = true;
    }
    support::allocation_fuse.left = 0;
    if (failed) follower.update(change, edits);
    require_equal(follower, twin, Extent::enclosed);
    failures += failed;
    if (!failed) break;
  }
  CHECK(failures > 30);
}
