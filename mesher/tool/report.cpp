// Figures for programs and for people.
#include "report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "open_surface.hpp"
#include "platform/process.hpp"

namespace tool {
namespace {

// The value below which a share of the sorted values lies. Requires: values not empty.
double quantile(const std::vector<double>& sorted, double share) {
  const auto at = static_cast<std::size_t>(share * static_cast<double>(sorted.size()));
  return sorted[std::min(at, sorted.size() - 1)];
}

void print_row(const char* name, const std::string& value) {
  std::printf("  %-22s%s\n", name, value.c_str());
}

std::string format(const char* form, double value) {
  if (std::isnan(value)) return "-";
  char text[64];
  std::snprintf(text, sizeof text, form, value);
  return text;
}

std::string of_all(std::size_t kept, std::size_t all) {
  if (kept == all) return std::to_string(all);
  return std::to_string(kept) + " of " + std::to_string(all) + " in the box";
}

// Which triangles keep the bound: all, but those that small angles of the input forbid to.
void measure_bound(double rho, const mesher::Mesh<2>& mesh, Run& run) {
  constexpr double kRounding = 1e-9;
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.simplices) {
    const auto &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    if (mesher::radius_edge(a, b, c) <= rho * (1 + kRounding)) {
      smallest = std::min(smallest, mesher::smallest_angle_deg(a, b, c));
    } else {
      ++run.above_rho;
    }
  }
  const bool none = run.above_rho == mesh.simplices.size();
  run.min_angle_within_rho = none ? std::numeric_limits<double>::quiet_NaN() : smallest;
}

std::string smallest_angle(const Run& run) {
  const std::string all = format("%.2f degrees", run.quality.min_angle_deg);
  if (run.above_rho == 0) return all;
  return all + ", " + format("%.2f", run.min_angle_within_rho) + " off " +
         counted(run.above_rho, "triangle") + " at small angles of the input";
}

Json json_of(const std::vector<mesher::SmallAngle>& angles) {
  Json all = Json::array();
  for (const auto& angle : angles) {
    all.push_back({{"at", angle.at},
                   {"lines", angle.lines},
                   {"degrees", angle.degrees},
                   {"forced", angle.forced},
                   {"smallest_deg", angle.smallest_deg}});
  }
  return all;
}

Json json_of(const std::vector<mesher::ShrunkVertex>& vertices) {
  Json all = Json::array();
  for (const auto& v : vertices) {
    all.push_back({{"at", v.at},
                   {"nearest", v.nearest},
                   {"feature_size", v.feature_size},
                   {"lines", v.lines},
                   {"degrees", v.degrees}});
  }
  return all;
}

Json json_of(const std::vector<mesher::PoorBeside>& places) {
  Json all = Json::array();
  for (const auto& place : places) {
    all.push_back({{place.feature.polygon() ? "polygon" : "segment", place.feature.number},
                   {"at", place.at},
                   {"tetrahedra", place.tetrahedra},
                   {"max_radius_edge", place.max_radius_edge}});
  }
  return all;
}

std::string milliseconds(double seconds) { return format("%.3f ms", seconds * 1000); }

}  // namespace

void print_notes(const std::vector<mesher::Note>& notes) {
  for (const auto& note : notes) {
    std::fprintf(stderr, "%s: note: %s\n", text_of(note.location).c_str(), note.text.c_str());
  }
}

template <int D>
void print_repairs(const Input<D>& input) {
  for (const auto& note : input.repairs()) {
    std::fprintf(stderr, "%s\n", note.text("repair: ").c_str());
  }
}
template void print_repairs(const Input<2>&);
template void print_repairs(const Input<3>&);

namespace {

template <int D>
void count_kept(const Kept<D>& mesh, AnyRun& run) {
  run.vertices = mesh.mesh.vertices.size();
  run.simplices = mesh.mesh.simplices.size();
  run.faults = mesh.faults.size();
  const auto& kinds = mesh.mesh.kinds;
  run.points =
      static_cast<std::size_t>(std::count(kinds.begin(), kinds.end(), mesher::VertexKind::input));
  for (const auto& region : mesh.regions) {
    if (mesh.keeps_all || region.label.zone == mesher::Zone::inside) ++run.regions;
    if (region.label.zone == mesher::Zone::hole) ++run.holes;
  }
}

}  // namespace

void measure(const Kept<2>& mesh, double rho, Run& run) {
  run.quality = mesher::quality(mesh.mesh);
  measure_bound(rho, mesh.mesh, run);
  count_kept(mesh, run);
}

namespace {

// How long a run took, and what it keeps.
void add_costs(const mesher::MeshStats& stats, double seconds_total, Json& json) {
  json["seconds"] = {{"quadtree", stats.seconds_quadtree},
                     {"steiner", stats.seconds_steiner},
                     {"triangulate", stats.seconds_triangulate},
                     {"total", seconds_total}};
  json["calls"] = stats.calls;
  json["edges"] = stats.edges;
  json["trace_bytes"] = stats.trace_bytes;
  json["peak_rss_bytes"] = platform::peak_memory_bytes();
}

Json json_of(const mesher::OutOfCoreReport& tiles) {
  return {{"tiles", tiles.tiles},
          {"tiles_found", tiles.tiles_found},
          {"runs", tiles.runs},
          {"rounds", tiles.rounds},
          {"most_points", tiles.most_points},
          {"all_points", tiles.all_points},
          {"calls", tiles.calls}};
}

// By which algorithm, and what happened in it.
void add_algorithm(const AnyRun& run, Json& json) {
  if (!run.algorithm.empty()) json["algorithm"] = run.algorithm;
  if (run.rounds > 0) json["periodic_rounds"] = run.rounds;
  if (run.tiles) json["out_of_core"] = json_of(*run.tiles);
  if (!run.refinement) return;
  const mesher::SvrStats& s = *run.refinement;
  Json& events = json["refinement"];
  events["simplices_made"] = s.made;
  events["most_simplices"] = s.most_simplices;
  events["worst_radius_edge"] = s.worst_radius_edge;
  events["largest_degree"] = s.largest_degree;
  events["on_sides"] = s.on_sides;
  events["slivers_split"] = s.slivers_split;
  events["slivers_left"] = s.slivers_left;
  if (run.algorithm != "svr") return;
  events["warped"] = s.warped;
  events["crowded"] = s.crowded;
}

// What an update did to what is kept.
template <class Step>
void add_kept(const Step& update, Json& json) {
  json["kept"] = {{"added", update.change.domain.kept_added.size()},
                  {"removed", update.change.domain.kept_removed.size()}};
}

// What an update did to the mesh of the box.
template <class Step>
Json json_of_change(const Step& update) {
  const auto& change = update.change;
  Json json;
  json["edit"] = update.text();
  json["seconds"] = update.seconds;
  json["calls"] = {{"executed", change.calls.executed},
                   {"reused", change.calls.reused},
                   {"created", change.calls.created},
                   {"discarded", change.calls.discarded}};
  json["vertices"] = {{"added", change.vertices_added.size()},
                      {"removed", change.vertices_removed.size()}};
  json["simplices"] = {{"added", change.simplices_added.size()},
                       {"removed", change.simplices_removed.size()}};
  return json;
}

}  // namespace

void measure(const Kept<3>& mesh, double rho, SpaceRun& run) {
  run.quality = mesher::quality(mesh.mesh);
  if (run.quality.max_radius_edge > rho) run.above_rho = mesher::count_above(mesh.mesh, rho);
  count_kept(mesh, run);
}

Json json_of(const Run& run) {
  Json json;
  json["vertices"] = run.stats.vertices;
  json["simplices"] = run.stats.simplices;
  json["min_angle_deg"] = run.quality.min_angle_deg;  // NaN is written as null
  json["max_radius_edge"] = run.quality.max_radius_edge;
  json["above_rho"] = run.above_rho;
  json["min_angle_deg_within_rho"] = run.min_angle_within_rho;
  if (run.angles) {
    json["small_angles"] = run.angles->angles.size();
    json["forced"] = run.angles->forced;
    json["shrunk"] = run.angles->shrunk.size();
  }
  json["kept"] = {{"vertices", run.vertices}, {"simplices", run.simplices}, {"points", run.points}};
  json["regions"] = run.regions;
  json["holes"] = run.holes;
  json["seed_faults"] = run.faults;
  add_algorithm(run, json);
  add_costs(run.stats, run.seconds_total, json);
  return json;
}

Json json_of(const SpaceRun& run) {
  Json json;
  json["vertices"] = run.stats.vertices;
  json["simplices"] = run.stats.simplices;
  json["min_dihedral_deg"] = run.quality.min_dihedral_deg;  // NaN is written as null
  json["max_dihedral_deg"] = run.quality.max_dihedral_deg;
  json["max_radius_edge"] = run.quality.max_radius_edge;
  json["slivers"] = run.quality.slivers;
  json["above_rho"] = run.above_rho;
  if (run.guard && !run.guard->places.empty()) json["gave_in"] = json_of(run.guard->places);
  json["points"] = run.points;
  json["kept"] = {{"vertices", run.vertices}, {"simplices", run.simplices}};
  json["regions"] = run.regions;
  json["holes"] = run.holes;
  json["seed_faults"] = run.faults;
  add_algorithm(run, json);
  add_costs(run.stats, run.seconds_total, json);
  return json;
}

Json json_of(const DomainStep& update) {
  Json json = json_of_change(update);
  const auto& [forced, shrunk] = update.change.angles;
  if (!forced.empty()) json["small_angles"] = json_of(forced);
  if (!shrunk.empty()) json["shrunk"] = json_of(shrunk);
  add_kept(update, json);
  return json;
}

Json json_of(const SpaceStep& update) {
  Json json = json_of_change(update);
  const auto& places = update.change.guard.places;
  if (!places.empty()) json["gave_in"] = json_of(places);
  add_kept(update, json);
  return json;
}

namespace {

// What is written of a mesh in its box. `points`: of the input.
template <class AnyRun>
void print_domain(const AnyRun& run, std::size_t points) {
  if (run.points < points) {
    print_row("points left out", std::to_string(points - run.points) + "; --box keeps all");
  }
  if (run.vertices != run.stats.vertices || run.regions > 1) {
    print_row("regions", std::to_string(run.regions) + ", holes " + std::to_string(run.holes));
  }
}

}  // namespace

namespace {

void print_tiles(const AnyRun& run) {
  if (!run.tiles) return;
  print_row("tiles", std::to_string(run.tiles->tiles) + ", of which " +
                         std::to_string(run.tiles->tiles_found) + " were in the folder; " +
                         counted(run.tiles->runs, "run") + ", " +
                         counted(run.tiles->rounds, "comparison"));
}

}  // namespace

void print_run(const Input<2>& input, const Run& run) {
  const mesher::Graph<2>& graph = input.graph();
  std::printf("%s: %s", input.path().c_str(), counted(graph.points.size(), "point").c_str());
  const std::size_t lines = graph.segments.size() + graph.polylines.size();
  if (lines > 0) std::printf(", %s", counted(lines, "line").c_str());
  std::printf("\n");
  print_row("vertices", of_all(run.vertices, run.stats.vertices));
  print_row("triangles", of_all(run.simplices, run.stats.simplices));
  print_domain(run, graph.points.size());
  print_row("smallest angle", smallest_angle(run));
  print_row("largest radius-edge", format("%.4f", run.quality.max_radius_edge));
  if (!run.algorithm.empty()) print_row("algorithm", run.algorithm);
  if (run.rounds > 0) print_row("periodic sides", "agree after " + counted(run.rounds, "round"));
  print_tiles(run);
  print_row("time", format("%.3f s", run.seconds_total));
}

void print_run(const Input<3>& input, const SpaceRun& run) {
  const mesher::Graph<3>& graph = input.graph();
  std::printf("%s: %s in space", input.path().c_str(),
              counted(graph.points.size(), "point").c_str());
  if (!graph.segments.empty()) {
    std::printf(", %s", counted(graph.segments.size(), "segment").c_str());
  }
  if (!graph.polygons.empty())
    std::printf(", %s", counted(graph.polygons.size(), "polygon").c_str());
  std::printf("\n");
  print_row("vertices", of_all(run.vertices, run.stats.vertices));
  print_row("tetrahedra", of_all(run.simplices, run.stats.simplices));
  print_domain(run, graph.points.size());
  print_row("dihedral angles", format("%.2f", run.quality.min_dihedral_deg) + " to " +
                                   format("%.2f degrees", run.quality.max_dihedral_deg));
  print_row("slivers", std::to_string(run.quality.slivers) + ", of dihedral angles below " +
                           format("%g degrees", mesher::kSliverDegrees));
  print_row("largest radius-edge", format("%.4f", run.quality.max_radius_edge));
  if (run.above_rho > 0) {
    print_row("above rho",
              std::to_string(run.above_rho) + ", at small angles of the input" +
                  (run.guard && run.guard->tetrahedra > 0 ? ", or left poor beside features" : ""));
  }
  if (!run.algorithm.empty()) print_row("algorithm", run.algorithm);
  print_tiles(run);
  print_row("time", format("%.3f s", run.seconds_total));
}

namespace {

void warn_of_no_mesh(const Standing& input, const char* features) {
  std::fprintf(stderr, "%s: warning: the mesh is empty: all that %s enclose is in holes\n",
               input.path().c_str(), features);
}

}  // namespace

namespace {

std::string place_of(const mesher::Point<3>& p) {
  return "(" + format("%.10g", p[0]) + format(", %.10g", p[1]) + format(", %.10g", p[2]) + ")";
}

// What people take for a solid, and is none.
void warn_of_open_surface(const Input<3>& input, const mesher::Graph<3>& graph,
                          const Kept<3>& mesh) {
  const auto open = open_surface(graph, mesh.mesh, mesh.keeps_all);
  if (!open) return;
  const std::string edges =
      open->edges == 1 ? "an edge has" : std::to_string(open->edges) + " edges have";
  std::fprintf(stderr,
               "%s: warning: the surface is open: %s a polygon on one side only, %s %s to %s; %s\n",
               text_of(input.location(open->polygon)).c_str(), edges.c_str(),
               open->edges == 1 ? "from" : "as from", place_of(open->from).c_str(),
               place_of(open->to).c_str(),
               mesh.keeps_all ? "it encloses nothing, and the whole box is kept"
                              : "what it does not enclose is left out; --box keeps all");
}

// Names that are given to what the mesh does not have.
template <int D>
void print_useless_names(const MeshArguments& args, const mesher::MeshFeatures& features) {
  const auto print = [&](const char* option, const std::string& text) {
    std::fprintf(stderr, "%s: note: %s %s is not used: the mesh has nothing of that number\n",
                 args.source.c_str(), option, text.c_str());
  };
  // Of one option, as it was given: is_used(number of names_of).
  const auto look_at = [&](const char* option, const std::vector<std::string>& texts,
                           const auto& names, const auto& is_used) {
    for (const auto& [number, name] : names) {
      if (is_used(number)) continue;
      for (const std::string& text : texts) {
        if (text.substr(text.find('=') + 1) == name) print(option, text);
      }
    }
  };
  const auto is_marker_of = [](const auto& parts) {
    return [&parts](std::int64_t marker) {
      return std::any_of(parts.begin(), parts.end(),
                         [&](const auto& part) { return part.marker == marker; });
    };
  };
  const auto is_region = [&](double region) {
    const auto& all = features.regions;
    return all.empty() ? region == 0 : std::find(all.begin(), all.end(), region) != all.end();
  };
  const mesher::GroupNames names = names_of(args, D);
  if constexpr (D == 2) {
    look_at("--name-marker", args.marker_names, names.facets, is_marker_of(features.edges));
  } else {
    look_at("--name-marker", args.marker_names, names.facets, is_marker_of(features.faces));
    look_at("--name-line", args.line_names, names.lines, is_marker_of(features.edges));
  }
  look_at("--name-region", args.region_names, names.regions, is_region);
}

}  // namespace

void print_remarks(const MeshArguments& args, const Input<2>& input, const mesher::Graph<2>&,
                   const Kept<2>& mesh) {
  print_notes(input.notes());
  print_useless_names<2>(args, mesh.mesh.features);
  if (args.region_areas && !input.has_region_limits()) {
    std::fprintf(stderr, "%s: note: --region-areas is not used: no region has a largest area\n",
                 input.path().c_str());
  }
  print_repairs(input);
  for (const auto& fault : mesh.faults) {
    std::fprintf(stderr, "%s\n", input.warning(fault).c_str());
  }
  if (mesh.mesh.simplices.empty()) warn_of_no_mesh(input, "lines");
}

void print_remarks(const MeshArguments& args, const Input<3>& input, const mesher::Graph<3>& graph,
                   const Kept<3>& mesh) {
  print_notes(input.notes());
  print_useless_names<3>(args, mesh.mesh.features);
  if (args.region_areas && !input.has_region_limits()) {
    std::fprintf(stderr, "%s: note: --region-volumes is not used: no region has a largest volume\n",
                 input.path().c_str());
  }
  if (input.leaves_faces()) {
    std::fprintf(stderr, "%s: note: its vertices are meshed; --surface meshes its faces, too\n",
                 input.path().c_str());
  }
  print_repairs(input);
  for (const auto& fault : mesh.faults) {
    std::fprintf(stderr, "%s\n", input.warning(fault).c_str());
  }
  if (mesh.mesh.simplices.empty()) warn_of_no_mesh(input, "polygons");
  if (!args.box) warn_of_open_surface(input, graph, mesh);
}

namespace {

void print_lines(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    std::printf("  %s\n", text.substr(at, end - at).c_str());
    at = end + 1;
  }
}

}  // namespace

void print_angles(const Run& run) {
  if (run.angles) print_lines(run.angles->text());
}

void print_angles(const SpaceRun& run) {
  if (run.guard) print_lines(run.guard->text());
}

void print_updates(std::vector<double> seconds) {
  print_row("updates", std::to_string(seconds.size()));
  if (seconds.empty()) return;
  std::sort(seconds.begin(), seconds.end());
  print_row("  median", milliseconds(quantile(seconds, 0.5)));
  print_row("  99 of 100 below", milliseconds(quantile(seconds, 0.99)));
  print_row("  longest", milliseconds(seconds.back()));
}

void print_after(const Kept<2>& mesh) {
  print_row("after them", std::to_string(mesh.mesh.vertices.size()) + " vertices, " +
                              std::to_string(mesh.mesh.simplices.size()) + " triangles");
}

void print_after(const Kept<3>& mesh) {
  print_row("after them", std::to_string(mesh.mesh.vertices.size()) + " vertices, " +
                              std::to_string(mesh.mesh.simplices.size()) + " tetrahedra");
}

void print_outputs(const std::vector<std::string>& paths) {
  std::string all;
  for (const auto& path : paths) all += (all.empty() ? "" : ", ") + path;
  if (!all.empty()) print_row("written", all);
}

}  // namespace tool
