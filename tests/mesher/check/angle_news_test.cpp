// What a Change says of small angles, against the whole mesh.
#include <catch2/catch.hpp>
#include <map>

#include "any_id.hpp"
#include "facade/box_mesher.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/reports.hpp"
#include "random_pslg.hpp"
#include "rules/mesh_box.hpp"

namespace {

using mesher::BoxMesher;
using mesher::Change;
using mesher::LineId;
using mesher::Point;
using mesher::PointId;
using support::Pslg;
using support::PslgEditor;

AnyId id(std::int64_t i) { return AnyId{i}; }

// A mesher as a target of an editor, which knows segments by their ends.
struct Target {
  BoxMesher<2>& m;
  std::map<std::pair<PointId, PointId>, LineId> lines{};
  void insert(PointId point, const Point<2>& p) { m.insert(point, p); }
  void remove(PointId point) { m.remove(point); }
  void insert_segment(LineId line, PointId a, PointId b) {
    m.insert_segment(lines[{a, b}] = line, b, a);
  }
  void remove_segment(PointId a, PointId b) { m.remove_line(lines.at({a, b})); }
};

struct Seen {
  std::size_t forced = 0, shrunk = 0;
};

// Compares the news of random edits with those that the whole mesh has of the new triangles.
void follow(PslgEditor::Family family, std::uint64_t seed, Seen& seen) {
  const mesher::Options<2> options = PslgEditor::options();
  const mesher::detail::MeshBox<2> box = mesher::detail::mesh_box(options);
  PslgEditor editor(family, seed);
  Pslg pslg;
  BoxMesher<2> m(options);
  Target target{m};
  for (int step = 0; step < 40; ++step) {
    editor.edit(pslg, box, target);
    const Change<2> change = m.update();
    REQUIRE(change.angles == mesher::angle_news(m.mesh(), options, change.simplices_added));
    seen.forced += change.angles.forced.size();
    seen.shrunk += change.angles.shrunk.size();
  }
}

}  // namespace

TEST_CASE("A change says which small angles forced its triangles, as the whole mesh does") {
  Seen seen;
  for (const auto family :
       {PslgEditor::Family::uniform, PslgEditor::Family::lattice, PslgEditor::Family::beside,
        PslgEditor::Family::fan, PslgEditor::Family::wedge, PslgEditor::Family::steiner}) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      INFO("family " << static_cast<int>(family) << " seed " << seed);
      follow(family, seed, seen);
    }
  }
  CHECK(seen.forced > 10);
}

// Trees meet at any angle; some of their ends make lengths shrink.
TEST_CASE("A change reports the vertices at which lengths have shrunk, as the whole mesh does") {
  const mesher::Graph<2> trees =
      mesher::generate_pslg({.kind = mesher::PslgKind::trees, .n = 1000, .seed = 1});
  const mesher::Graph<2> g = without_polylines(trees);
  std::vector<Point<2>> points;
  for (const auto& p : g.points) points.push_back(p.at);
  BoxMesher<2> m({.domain = mesher::snapped_domain<2>(points)});
  for (const auto& p : g.points) m.insert(p.id, p.at);
  for (const auto& s : g.segments) m.insert_segment(s.id, s.from, s.to);
  const Change<2> first = m.update();
  const mesher::AngleReport report = mesher::angle_report(m.mesh(), m.options());
  REQUIRE(!report.shrunk.empty());
  CHECK(first.angles.shrunk == report.shrunk);
  std::size_t forced = 0;
  for (const auto& angle : first.angles.forced) forced += angle.forced;
  CHECK(forced >= report.forced);
  std::size_t shrunk = 0;
  const auto line = [&](LineId wanted) {
    return *std::find_if(g.segments.begin(), g.segments.end(),
                         [&](const auto& s) { return s.id == wanted; });
  };
  for (std::size_t i = 0; i < std::min<std::size_t>(report.shrunk.size(), 8); ++i) {
    const auto s = line(report.shrunk[i].lines.front());
    const auto check = [&] {
      const Change<2> change = m.update();
      CHECK(change.angles == mesher::angle_news(m.mesh(), m.options(), change.simplices_added));
      shrunk += change.angles.shrunk.size();
    };
    m.remove_line(s.id);
    check();
    m.insert_segment(s.id, s.from, s.to);
    check();
  }
  CHECK(shrunk > 0);
}

TEST_CASE("Of points alone there are no news") {
  BoxMesher<2> m({.domain = {{0, 0}, {1, 1}}});
  m.insert(id(1), {0.3, 0.3});
  m.insert(id(2), {0.3, 0.300001});
  CHECK(m.update().angles == mesher::AngleNews());
}
