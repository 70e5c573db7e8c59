// traces stability: the mesher, or an example, under random edits; distance and work of each.
#include "traces/stability.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "example_subject.hpp"
#include "mesh_subject.hpp"
#include "mesher/error.hpp"
#include "mesher/extra/generate.hpp"

namespace tool {
namespace {

struct Arguments {
  std::string example;  // empty: the mesher
  std::vector<std::uint64_t> sizes = {1000};
  std::uint64_t edits = 100;
  std::uint64_t seed = 1;
  std::string kind = "uniform";
  std::string rule = "radius-edge";
  int dimension = 2;
  std::optional<double> rho;  // without it, that of the dimension
  bool trust = false;
  bool json = false;
};

Json to_json(const traces::StabilityRow& row) {
  Json object;
  for (const auto& [name, value] : row.figures) {
    const auto whole = static_cast<std::uint64_t>(value);
    object[name] = static_cast<double>(whole) == value ? Json(whole) : Json(value);
  }
  object["distance"] = row.distance;
  object["executed"] = row.counts.executed;
  object["created"] = row.counts.created;
  object["discarded"] = row.counts.discarded;
  object["work"] = row.work();
  object["ratio"] = row.ratio();
  object["weight_distance"] = row.weight_distance;
  object["weight_work"] = row.weight_work();
  object["weight_ratio"] = row.weight_ratio();
  object["heaviest"] = row.heaviest;
  object["drift"] = row.drift;
  return object;
}

// Lines of cells, aligned to the right.
void print_line(const std::vector<std::string>& cells) {
  for (const std::string& cell : cells) {
    std::cout << std::string(cell.size() < 9 ? 9 - cell.size() : 0, ' ') << cell << ' ';
  }
  std::cout << '\n';
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

void print_row(const traces::StabilityRow& row, bool first) {
  if (first) {
    std::vector<std::string> names;
    for (const traces::Figure& figure : row.figures) names.push_back(figure.name);
    names.insert(names.end(), {"distance", "executed", "created", "discarded", "work", "ratio",
                               "w.dist", "w.work", "w.ratio", "heaviest"});
    print_line(names);
  }
  std::vector<std::string> cells;
  for (const traces::Figure& figure : row.figures) cells.push_back(short_number(figure.value));
  for (const std::uint64_t count :
       {row.distance, row.counts.executed, row.counts.created, row.counts.discarded, row.work()}) {
    cells.push_back(std::to_string(count));
  }
  cells.push_back(short_number(row.ratio()));
  cells.push_back(std::to_string(row.weight_distance));
  cells.push_back(std::to_string(row.weight_work()));
  cells.push_back(short_number(row.weight_ratio()));
  cells.push_back(std::to_string(row.heaviest));
  print_line(cells);
}

// Median and largest, as two cells.
template <class Value>
void add_cells(std::vector<std::string>& cells, const std::vector<traces::StabilityRow>& rows,
               Value&& value) {
  std::vector<double> values;
  for (const traces::StabilityRow& row : rows) values.push_back(static_cast<double>(value(row)));
  std::sort(values.begin(), values.end());
  cells.push_back(short_number(values[values.size() / 2]));
  cells.push_back(short_number(values.back()));
}

void print_summary_line(const std::string& name, const std::vector<traces::StabilityRow>& rows) {
  std::vector<std::string> cells{name, std::to_string(rows.size())};
  add_cells(cells, rows, [](const auto& row) { return row.distance; });
  add_cells(cells, rows, [](const auto& row) { return row.ratio(); });
  add_cells(cells, rows, [](const auto& row) { return row.weight_distance; });
  add_cells(cells, rows, [](const auto& row) { return row.weight_ratio(); });
  add_cells(cells, rows, [](const auto& row) { return row.heaviest; });
  print_line(cells);
}

constexpr const char* kSummary =
    "median and largest of: distance; ratio; distance by weight; ratio by weight; heaviest\n";

// Distance and ratio, of meshes by lg(L/d), and in all.
void print_summary(const std::vector<traces::StabilityRow>& rows, bool of_meshes) {
  if (rows.empty()) return;
  if (!of_meshes) {
    std::cout << "Edits; " << kSummary;
    return print_summary_line("all", rows);
  }
  constexpr int kBand = 4;
  std::map<int, std::vector<traces::StabilityRow>> bands;
  for (const traces::StabilityRow& row : rows) {
    bands[static_cast<int>(std::floor(row.figures.back().value / kBand))].push_back(row);
  }
  std::cout << "By lg(L/d): edits; " << kSummary;
  for (const auto& [band, those] : bands) {
    print_summary_line(std::to_string(band * kBand) + "-" + std::to_string((band + 1) * kBand),
                       those);
  }
  print_summary_line("all", rows);
}

template <int D>
mesher::Options<D> options_of(const Arguments& args, const std::vector<mesher::Point<D>>& points) {
  mesher::Options<D> options;
  if (args.rho) options.rho = *args.rho;
  options.record_weights = true;
  options.rule =
      args.rule == "radius-edge" ? mesher::Rule::radius_edge : mesher::Rule::voronoi_aspect;
  options.domain = mesher::snapped_domain<D>(points);
  return options;
}

template <int D>
std::unique_ptr<traces::Subject> make_mesh(const Arguments& args, std::uint64_t n) {
  auto points = mesher::generate_points<D>(*mesher::point_kind(args.kind), n, args.seed);
  const auto options = options_of<D>(args, points);
  return std::make_unique<MeshSubject<D>>(options, std::move(points), args.seed);
}

std::unique_ptr<traces::Subject> make_subject(const Arguments& args, std::uint64_t n) {
  if (!args.example.empty()) return make_example(args.example, args.seed, static_cast<int>(n));
  return args.dimension == 2 ? make_mesh<2>(args, n) : make_mesh<3>(args, n);
}

// Whether a propagated trace was not that of a fresh run.
bool run_size(const Arguments& args, std::uint64_t n) {
  const auto subject = make_subject(args, n);
  bool first = true, drifted = false;
  traces::StabilityOptions how;
  how.fresh = !args.trust;
  how.each = [&](const traces::StabilityRow& row) {
    args.json ? print_json(to_json(row)) : print_row(row, first);
    first = false;
    drifted = drifted || row.drift != 0;
  };
  const auto rows = traces::stability(*subject, args.edits, how);
  if (!args.json) print_summary(rows, args.example.empty());
  return drifted;
}

bool run(const Arguments& args) {
  bool drifted = false;
  for (const std::uint64_t n : args.sizes) drifted = run_size(args, n) || drifted;
  if (drifted) std::cerr << "stability: a propagated trace is not that of a fresh run\n";
  return drifted;
}

}  // namespace

void add_stability(CLI::App& app, int& exit_code) {
  const auto args = std::make_shared<Arguments>();
  CLI::App* sub = app.add_subcommand(
      "stability", "Edits random inputs, and tabulates the changes and costs of each edit");
  sub->add_option("--example", args->example,
                  "An example of the engine (traces example --help); without it, the mesher")
      ->check(is_example, "")
      ->type_name("NAME");
  sub->add_option("--n", args->sizes, "Input points or elements, 2 to 1000000; may be repeated")
      ->check(CLI::Range(2, 1'000'000), "")
      ->type_name("N")
      ->allow_extra_args(false)
      ->capture_default_str();
  add_random_edits(*sub, args->edits, args->seed, "Edits for each size");
  sub->add_option("--kind", args->kind, "uniform, gaussian, clusters, grid, line-circle or spiral")
      ->check(
          [](const std::string& name) {
            return mesher::point_kind(name) ? "" : "'" + name + "' is no kind of points";
          },
          "")
      ->capture_default_str();
  sub->add_option("--dimension", args->dimension, "The dimension of the points: 2 or 3")
      ->check(CLI::IsMember({2, 3}), "")
      ->type_name("D")
      ->capture_default_str();
  sub->add_option("--rule", args->rule, "radius-edge or voronoi-aspect")
      ->check(CLI::IsMember({"radius-edge", "voronoi-aspect"}), "")
      ->capture_default_str();
  sub->add_option("--rho", args->rho,
                  "Bound of circumradius over shortest edge, above 1.01; by default 1.4142 in\n"
                  "the plane and 2 in space")
      ->check(CLI::Range(1.0101, 1e6), "")
      ->type_name("RHO");
  sub->add_flag("--trust", args->trust,
                "Use propagated traces in place of those of runs from scratch: faster");
  sub->add_flag("--json", args->json, "A JSON object for each edit, one per line");
  sub->footer(
      "An edit of a mesh inserts or removes a point. A line has: points, vertices of the\n"
      "mesh, lg(L/s), lg(L/d), the distance of the traces, and the work of the propagation.\n"
      "L is the side of the domain, s the least distance of two points, d the distance from\n"
      "the edited point to its nearest neighbour. For an example a line has distance and\n"
      "work. By weight (w.dist, w.work, w.ratio) a call counts 1 plus the steps that it\n"
      "reports; heaviest is the greatest weight of a created or discarded call.\n"
      "Exit code 1 if a propagated trace is not that of a run from scratch.\n"
      "Examples:\n"
      "  traces stability --n 1000 --n 10000 --edits 100\n"
      "  traces stability --example mergesort --n 1000\n"
      "  traces stability --kind line-circle --rule voronoi-aspect --json");
  sub->callback([args, &exit_code] {
    if (run(*args)) exit_code = kFound;
  });
}

}  // namespace tool
