// Points in one place are an error of a file, unless they are kept for a repair, which joins them.
#include <catch2/catch.hpp>
#include <string>
#include <utility>

#include "io/point_file.hpp"
#include "mesher/graph.hpp"
#include "mesher/read.hpp"
#include "mesher/repair.hpp"
#include "scratch_file.hpp"

using mesher::CoincidingPoints;

TEST_CASE("points in one place are kept for a repair, of every format of points") {
  const std::pair<const char*, const char*> files[] = {{"a.node", "3 2 0 0\n1 0 0\n2 1 1\n3 0 0\n"},
                                                       {"a.xyz", "0 0\n1 1\n0 0\n"},
                                                       {"a.csv", "x,y\n0,0\n1,1\n0,0\n"}};
  for (const auto& [name, content] : files) {
    CAPTURE(name);
    const support::ScratchFolder folder;
    const std::string file = folder.write(name, content);
    CHECK_THROWS_AS(mesher::read<2>(file), mesher::Error);
    const auto kept = mesher::read<2>(file, {.coinciding = CoincidingPoints::kept});
    REQUIRE(kept.graph.points.size() == 3);
    const auto repaired = mesher::repair(kept);
    CHECK(repaired.file.graph.points.size() == 2);
    CHECK(repaired.notes.size() == 1);
    CHECK(mesher::read_points<2>(file, CoincidingPoints::kept).points.size() == 3);
  }
  const support::ScratchFolder folder;
  const std::string ply =
      folder.write("a.ply",
                   "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\n"
                   "property float y\nproperty float z\nend_header\n0 0 1\n0 0 1\n");
  CHECK_THROWS_AS(mesher::read_points<3>(ply), mesher::Error);
  CHECK(mesher::read_points<3>(ply, CoincidingPoints::kept).points.size() == 2);
}
