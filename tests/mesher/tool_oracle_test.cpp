// The tool as a whole: what `edit` writes of random scripts are the bytes that `mesh` writes of the
// edited input, with the engine and without.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "mesher/extra/generate.hpp"
#include "mesher/graph.hpp"
#include "mesher/write.hpp"
#include "random_lake.hpp"
#include "rules/mesh_box.hpp"
#include "scratch_file.hpp"

namespace {

using mesher::Edit;
using support::Lake;
using support::LakeEditor;
using support::ScratchFolder;

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, " %.17g", x);
  return text;
}
std::string number(mesher::PointId id) {
  return " " + std::to_string(static_cast<std::int64_t>(id));
}

std::string limit_line(const Edit<2>& edit) {
  const double area = edit.limits.max_measure;
  std::string line = area == 0 ? "limit none" : "limit area" + number(area);
  if (!edit.box) return line + "\n";
  const auto& [lo, hi] = *edit.box;
  return line + " in" + number(lo[0]) + number(lo[1]) + number(hi[0]) + number(hi[1]) + "\n";
}

std::string line_of(const Edit<2>& edit) {
  using Kind = Edit<2>::Kind;
  if (edit.kind == Kind::limit) return limit_line(edit);
  static const std::map<Kind, std::string> words{{Kind::insert, "+point"},
                                                 {Kind::remove, "-point"},
                                                 {Kind::move, "move"},
                                                 {Kind::insert_segment, "+segment"},
                                                 {Kind::remove_segment, "-segment"},
                                                 {Kind::insert_polyline, "+polyline"},
                                                 {Kind::insert_hole, "+hole"},
                                                 {Kind::remove_hole, "-hole"},
                                                 {Kind::insert_region, "+region"},
                                                 {Kind::remove_region, "-region"}};
  const std::string& word = words.at(edit.kind);
  std::string line = word + number(edit.number);
  for (const auto id : edit.points) line += number(id);
  const bool placed = word == "+point" || word == "move" || word == "+hole" || word == "+region";
  if (placed) line += number(edit.point[0]) + number(edit.point[1]);
  if (word == "+region") line += number(edit.attribute) + number(edit.max_measure.value_or(0));
  return line + "\n";
}

Edit<2> everywhere(const mesher::Options<2>& options) {
  Edit<2> edit;
  edit.limits = {options.max_measure, options.sizes};
  return edit;
}
Edit<2> within(const mesher::BoxLimits<2>& limits) {
  Edit<2> edit;
  edit.limits = limits.limits;
  edit.box = limits.box;
  return edit;
}

// Batches that are valid, and what they lead to.
struct History {
  std::string script;
  Lake lake;

  History(std::uint64_t seed, int batches) {
    LakeEditor editor(seed);
    const auto box = mesher::detail::mesh_box(LakeEditor::options());
    for (int i = 0; i < batches; ++i) {
      Lake next = lake;
      const auto batch = editor.batch(next);
      if (!next.is_valid(box)) continue;
      script += "begin\n";
      for (const Edit<2>& edit : batch) script += line_of(edit);
      script += "commit\n";
      lake = next;
    }
  }
};

}  // namespace

TEST_CASE("edits of any kind by a script leave the files of the edited input, byte for byte") {
  const std::string tool = test_paths::kMesherTool;
  if (tool.empty()) return;
  const auto seed = GENERATE(range<std::uint64_t>(1, 7), value<std::uint64_t>(54));
  const std::string extent =
      std::string(seed % 3 == 0 ? " --box" : "") + (seed % 2 == 0 ? " --region-areas" : "");
  CAPTURE(seed);
  const History history(seed, 60);
  const ScratchFolder folder;
  folder.write("edits.txt", history.script);
  folder.write("before.poly", "0 2 0 0\n0\n0\n");
  write_graph(history.lake.graph(), folder.path("after.poly"));
  // Pieces of polylines have other ids in after.poly: formats without ids of lines are compared.
  const auto run = [&](const std::string& arguments, const std::string& out) {
    const std::string command = tool + " " + arguments + extent +
                                " --quiet --domain 0 0 16 16 -o " + folder.path(out + ".msh") +
                                " -o " + folder.path(out + ".mesh") + " -o " +
                                folder.path(out + ".off") + " -o " + folder.path(out + ".obj");
    REQUIRE(std::system(command.c_str()) == 0);
  };
  const std::string edits = folder.path("before.poly") + " --script " + folder.path("edits.txt");
  run("edit " + edits, "engine");
  run("edit --static " + edits, "static");
  // No option says limits in boxes: a script says those that are left.
  std::string limits = limit_line(everywhere(history.lake.options));
  for (const auto& box : history.lake.options.box_limits) limits += limit_line(within(box));
  folder.write("limits.txt", limits);
  run("edit --static " + folder.path("after.poly") + " --script " + folder.path("limits.txt"),
      "fresh");
  for (const std::string format : {".msh", ".mesh", ".off", ".obj"}) {
    CAPTURE(format);
    const std::string fresh = folder.read("fresh" + format);
    CHECK(folder.read("engine" + format) == fresh);
    CHECK(folder.read("static" + format) == fresh);
  }
}

namespace {

// Batches of edits of points in space, and the points that they lead to. Coordinates are of a
// coarse grid, so that spheres through many points, points that move onto places just freed, and
// ids that come back are common.
struct SpaceHistory {
  std::string script, after;

  SpaceHistory(std::uint64_t seed, int batches) {
    mesher::SplitMix64 random(seed);
    std::map<std::uint64_t, mesher::Point<3>> points;
    for (int i = 0; i < batches; ++i) {
      const bool one = random.below(3) == 0;
      if (!one) script += "begin\n";
      for (auto left = one ? 1 : 1 + random.below(6); left > 0; --left) edit(random, points);
      if (!one) script += "commit\n";
    }
    after = std::to_string(points.size()) + " 3 0 0\n";
    for (const auto& [id, p] : points) after += std::to_string(id) + place(p) + "\n";
  }

 private:
  static std::string place(const mesher::Point<3>& p) {
    return number(p[0]) + number(p[1]) + number(p[2]);
  }
  static mesher::Point<3> free_place(mesher::SplitMix64& random,
                                     const std::map<std::uint64_t, mesher::Point<3>>& points) {
    mesher::Point<3> p;
    const auto is_taken = [&](const auto& entry) { return entry.second == p; };
    const double steps = random.below(2) == 0 ? 8 : 1024;
    do {
      for (double& x : p) {
        x = static_cast<double>(random.below(static_cast<std::uint64_t>(steps) + 1)) / steps;
      }
    } while (std::any_of(points.begin(), points.end(), is_taken));
    return p;
  }
  void edit(mesher::SplitMix64& random, std::map<std::uint64_t, mesher::Point<3>>& points) {
    const std::uint64_t id = random.below(40);
    const auto known = points.find(id);
    if (known == points.end()) {
      const auto p = free_place(random, points);
      points.emplace(id, p);
      script += "+point " + std::to_string(id) + place(p) + "\n";
    } else if (random.below(3) > 0) {
      known->second = free_place(random, points);
      script += "move " + std::to_string(id) + place(known->second) + "\n";
    } else {
      points.erase(known);
      script += "-point " + std::to_string(id) + "\n";
    }
  }
};

}  // namespace

TEST_CASE("edits in space by a script leave the files of the edited input, byte for byte") {
  const std::string tool = test_paths::kMesherTool;
  if (tool.empty()) return;
  const auto seed = GENERATE(range<std::uint64_t>(1, 6));
  const std::string rule = seed % 3 == 0 ? " --rule voronoi-aspect --rho 4" : "";
  CAPTURE(seed);
  const SpaceHistory history(seed, 40);
  const ScratchFolder folder;
  folder.write("edits.txt", history.script);
  folder.write("before.node", "0 3 0 0\n");
  folder.write("after.node", history.after);
  const std::vector<std::string> formats{".vtu", ".vtk", ".msh", ".mesh", ".off", ".obj", ".stl"};
  const auto run = [&](const std::string& arguments, const std::string& out) {
    std::string command = tool + " " + arguments + rule + " --quiet --domain 0 0 0 1 1 1 -o " +
                          folder.path(out + ".node");
    for (const std::string& format : formats) command += " -o " + folder.path(out + format);
    REQUIRE(std::system(command.c_str()) == 0);
  };
  const std::string edits = folder.path("before.node") + " --script " + folder.path("edits.txt");
  run("edit " + edits, "engine");
  run("edit --static " + edits, "static");
  run("mesh --algorithm gap-balls " + folder.path("after.node"), "fresh");
  std::vector<std::string> all{".node", ".ele", ".face"};
  all.insert(all.end(), formats.begin(), formats.end());
  for (const std::string& format : all) {
    CAPTURE(format);
    const std::string fresh = folder.read("fresh" + format);
    CHECK(folder.read("engine" + format) == fresh);
    CHECK(folder.read("static" + format) == fresh);
  }
}
