// The arguments that `mesh`, `edit` and `trace` share.
#include "arguments.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>

#include "mesher/domain_mesh.hpp"
#include "mesher/sizes.hpp"

namespace tool {
namespace {

using mesher::Error;
using mesher::ErrorCode;

constexpr double kLeastRho = 1.01;  // Options::rho
constexpr const char* kDomainHint = "; --domain XMIN YMIN XMAX YMAX sets another domain";

std::string to_text(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

std::string to_text(const mesher::Point<2>& p) {
  return "(" + to_text(p[0]) + ", " + to_text(p[1]) + ")";
}

bool contains(const mesher::Box<2>& box, const mesher::Point<2>& p) {
  return box.lo[0] <= p[0] && p[0] <= box.hi[0] && box.lo[1] <= p[1] && p[1] <= box.hi[1];
}

double domain_coordinate(const std::string& text) {
  const double value = option_number("--domain", text);
  const double size = std::abs(value);
  if (value == 0 || (size >= 0x1p-100 && size <= 0x1p100)) return value;
  throw Error(ErrorCode::bad_option,
              "--domain " + text + ": neither 0 nor of magnitude 2^-100 to 2^100");
}

mesher::Box<2> domain_of(const std::vector<std::string>& texts) {
  const mesher::Box<2> box{{domain_coordinate(texts[0]), domain_coordinate(texts[1])},
                           {domain_coordinate(texts[2]), domain_coordinate(texts[3])}};
  if (box.lo[0] < box.hi[0] && box.lo[1] < box.hi[1]) return box;
  throw Error(ErrorCode::bad_option, "--domain " + to_text(box.lo) + " to " + to_text(box.hi) +
                                         ": the first corner must be below and left");
}

std::size_t option_count(const std::string& option, const std::string& text) {
  std::size_t count = 0;
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, count);
  if (result.ec == std::errc{} && result.ptr == end && count > 0) return count;
  throw Error(ErrorCode::bad_option, option + " '" + text + "': not a whole number above 0");
}

void add_limits(const MeshArguments& args, mesher::Options<2>& options) {
  if (!args.max_area.empty()) options.max_area = option_positive("--max-area", args.max_area);
  if (!args.max_size.empty()) {
    const double h = option_positive("--max-size", args.max_size);
    options.max_area = mesher::kAreaOfSize * h * h;
  }
  if (args.sizes.empty()) return;
  options.sizes = mesher::sampled_sizes(mesher::read_sizes(args.sizes).samples);
}

void require_inside(const Input& input, const mesher::Box<2>& domain) {
  const auto& points = input.graph().points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (contains(domain, points[i].at)) continue;
    throw Error(ErrorCode::outside_domain,
                "point " + std::to_string(static_cast<std::int64_t>(points[i].id)) + " at " +
                    to_text(points[i].at) + " is outside the domain " + to_text(domain.lo) +
                    " to " + to_text(domain.hi) + kDomainHint,
                input.file().place_of_point(i));
  }
}

bool has_points_alone(const std::string& path) {
  const std::string extension = mesher::format_of(path);
  return extension == ".node" || extension == ".xyz" || extension == ".csv";
}

}  // namespace

void add_program_options(CLI::App& command, MeshArguments& args) {
  command
      .add_option(
          "INPUT", args.input,
          "Points and lines: .poly, .geojson, .json, .obj or .vtu; points: .node, .xyz or .csv")
      ->required();
  command.add_option("--rho", args.rho, "Bound of circumradius over shortest edge, above 1.01")
      ->capture_default_str();
  command.add_option("--rule", args.rule, "Where to insert: radius-edge or voronoi-aspect")
      ->check(CLI::IsMember({"radius-edge", "voronoi-aspect"}))
      ->capture_default_str();
  command
      .add_option("--domain", args.domain,
                  "Where points may lie (default: the box of INPUT, moved outward to a\n"
                  "power-of-two grid)")
      ->type_name("XMIN YMIN XMAX YMAX")
      ->expected(4)
      ->allow_extra_args(false);
  command
      .add_option(
          "--max-area", args.max_area,
          "No triangle with its centroid in the domain is larger, of those that are wanted\n"
          "(default: no limit)")
      ->type_name("A");
  command
      .add_option("--max-size", args.max_size,
                  "The same by the edges H of an equilateral triangle of that area")
      ->type_name("H")
      ->excludes("--max-area");
  command
      .add_option("--sizes", args.sizes,
                  "A background of such H: .node with one value a point, or .csv with x,y,h;\n"
                  "linear between its points")
      ->type_name("FILE");
  command
      .add_option("--max-vertices", args.max_vertices,
                  "More are an error, which names the lines that need most (default: no limit)")
      ->type_name("N");
}

void add_mesh_options(CLI::App& command, MeshArguments& args) {
  add_program_options(command, args);
  command
      .add_option("-o", args.outputs,
                  "A mesh: .node (with .ele), .vtu, .vtk, .msh, .mesh, .off, .obj or .svg; may be\n"
                  "repeated")
      ->type_name("OUT")
      ->allow_extra_args(false);
  command.add_flag("--repair", args.repair,
                   "Lines that cross or touch get a common point there, points in one place are\n"
                   "one, what lines share is that of the smallest id; each is reported");
  command.add_flag("--region-areas", args.region_areas,
                   "The largest areas of regions are limits of size");
  command.add_flag("--box", args.box, "All of the box, not only what lines enclose less the holes");
  command.add_flag("--static", args.is_static, "Without the engine; the mesh is the same");
  command.add_option("--stats", args.stats, "Figures as JSON")->type_name("FILE");
  command.add_flag("--quiet", args.quiet, "Print nothing but errors");
}

double option_number(const std::string& option, const std::string& text) {
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  const char* const end = text.data() + text.size();
  double value = 0;
  const auto result = std::from_chars(text.data() + (plus ? 1 : 0), end, value);
  if (result.ec == std::errc{} && result.ptr == end && std::isfinite(value)) return value + 0.0;
  throw Error(ErrorCode::bad_option, option + " '" + text + "': not a finite number");
}

double option_positive(const std::string& option, const std::string& text) {
  const double x = option_number(option, text);
  if (x > 0) return x;
  throw Error(ErrorCode::bad_option, option + " " + text + ": must be above 0");
}

double option_rho(const std::string& text) {
  const double rho = option_number("--rho", text);
  if (rho > kLeastRho) return rho;
  throw Error(ErrorCode::bad_option, "--rho " + text + ": must be above " + to_text(kLeastRho));
}

Input read_input(const MeshArguments& args) {
  Input input(args.input);
  if (!args.repair) {
    input.offer_repair();
    return input;
  }
  std::optional<mesher::Box<2>> domain;
  if (!args.domain.empty()) domain = domain_of(args.domain);
  try {
    input.repair(domain);
  } catch (const Error& error) {
    throw with_domain_hint(error);
  }
  return input;
}

mesher::Options<2> mesh_options(const MeshArguments& args, const Input& input) {
  mesher::Options<2> options;
  options.rho = option_rho(args.rho);
  options.rule =
      args.rule == "radius-edge" ? mesher::Rule::radius_edge : mesher::Rule::voronoi_aspect;
  options.domain = args.domain.empty() ? mesher::snapped_domain<2>(places_of(input.graph()))
                                       : domain_of(args.domain);
  add_limits(args, options);
  if (!args.max_vertices.empty()) {
    options.max_vertices = option_count("--max-vertices", args.max_vertices);
  }
  require_inside(input, options.domain);
  return options;
}

Error with_domain_hint(const Error& error) {
  if (error.code() != ErrorCode::outside_domain) return error;
  return Error(error.code(), error.message() + kDomainHint, error.place(), error.ids());
}

void open_outputs(const MeshArguments& args, const Input& input, Outputs& outputs) {
  protect_inputs(args, input, outputs);
  const auto content =
      has_points_alone(args.input) ? mesher::MeshFiles::plain : mesher::MeshFiles::features;
  for (const auto& path : args.outputs) outputs.open_mesh(path, content);
}

}  // namespace tool
