// The arguments that `mesh`, `edit` and `trace` share.
#include "arguments.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "mesher/meshing.hpp"
#include "mesher/sizes.hpp"

namespace tool {
namespace {

using mesher::Error;
using mesher::ErrorCode;

constexpr double kLeastRho = 1.01, kMostRho = 100;  // Options::rho

template <int D>
constexpr const char* kDomainHint =
    D == 2 ? "; --domain XMIN YMIN XMAX YMAX sets another domain"
           : "; --domain XMIN YMIN ZMIN XMAX YMAX ZMAX sets another "
             "domain";

std::string to_text(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

template <std::size_t N>
std::string to_text(const std::array<double, N>& p) {
  std::string text = "(";
  for (const double x : p) text += (text.size() > 1 ? ", " : "") + to_text(x);
  return text + ")";
}

template <int D>
bool contains(const mesher::Box<D>& box, const mesher::Point<D>& p) {
  for (int i = 0; i < D; ++i) {
    if (p[i] < box.lo[i] || p[i] > box.hi[i]) return false;
  }
  return true;
}

double domain_coordinate(const std::string& text) {
  const double value = option_number("--domain", text);
  const double size = std::abs(value);
  if (value == 0 || (size >= 0x1p-100 && size <= 0x1p100)) return value;
  throw Error(ErrorCode::bad_option,
              "--domain " + text + ": neither 0 nor of magnitude 2^-100 to 2^100");
}

template <int D>
mesher::Box<D> domain_of(const std::vector<std::string>& texts) {
  if (texts.size() != std::size_t{2 * D}) {
    throw Error(ErrorCode::bad_option, "--domain: " + std::to_string(texts.size()) +
                                           " numbers; it has 4 in the plane, and 6 in space");
  }
  mesher::Box<D> box;
  bool ordered = true;
  for (int i = 0; i < D; ++i) {
    box.lo[i] = domain_coordinate(texts[i]);
    box.hi[i] = domain_coordinate(texts[i + D]);
    ordered = ordered && box.lo[i] < box.hi[i];
  }
  if (ordered) return box;
  throw Error(ErrorCode::bad_option, "--domain " + to_text(box.lo) + " to " + to_text(box.hi) +
                                         ": the first corner must be below" +
                                         (D == 2 ? " and left" : ", left and before"));
}

std::size_t option_count(const std::string& option, const std::string& text) {
  std::size_t count = 0;
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, count);
  if (result.ec == std::errc{} && result.ptr == end && count > 0) return count;
  throw Error(ErrorCode::bad_option, option + " '" + text + "': not a whole number above 0");
}

// Areas are for the plane, volumes for space.
template <int D>
void require_own_measure(const MeshArguments& args) {
  if ((D == 2 ? args.max_volume : args.max_area).empty()) return;
  throw Error(ErrorCode::bad_option,
              D == 2 ? "--max-volume is for space; INPUT is in the plane"
                     : "--max-area is for the plane; INPUT is in space",
              {args.input});
}

template <int D>
void add_limits(const MeshArguments& args, mesher::Options<D>& options) {
  const std::string& measure = D == 2 ? args.max_area : args.max_volume;
  const char* const name = D == 2 ? "--max-area" : "--max-volume";
  if (!measure.empty()) options.max_measure = option_positive(name, measure);
  if (!args.max_size.empty()) {
    options.max_measure = mesher::measure_of_size<D>(option_positive("--max-size", args.max_size));
  }
  if (args.sizes.empty()) return;
  options.sizes = mesher::sampled_sizes<D>(mesher::read_sizes<D>(args.sizes).samples);
}

template <int D>
void require_inside(const Input<D>& input, const mesher::Box<D>& domain) {
  const auto& points = input.graph().points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (contains<D>(domain, points[i].at)) continue;
    throw Error(ErrorCode::outside_domain,
                text_of(points[i].id) + " at " + to_text(points[i].at) + " is outside the domain " +
                    to_text(domain.lo) + " to " + to_text(domain.hi) + kDomainHint<D>,
                input.location_of_point(i), {points[i].id}, {mesher::position_of(points[i].at)});
  }
}

mesher::Algorithm algorithm_of(const MeshArguments& args) {
  using mesher::Algorithm;
  for (const Algorithm a : {Algorithm::refine, Algorithm::svr, Algorithm::gap_balls}) {
    if (args.algorithm == name_of(a)) return a;
  }
  return args.is_static ? Algorithm::gap_balls : Algorithm::automatic;
}

template <int D>
void set_min_dihedral(const std::string& text, mesher::Options<D>& options) {
  if constexpr (D == 3) {
    options.min_dihedral = option_positive("--min-dihedral", text);
    if (options.min_dihedral <= mesher::kLargestMinDihedral) return;
    throw Error(ErrorCode::bad_option, "--min-dihedral " + text + ": must be at most " +
                                           to_text(mesher::kLargestMinDihedral));
  }
  throw Error(ErrorCode::bad_option, "--min-dihedral " + text + ": triangles have no such angles");
}

int option_threads(const std::string& text) {
  const std::size_t threads = option_count("--threads", text);
  if (threads <= std::size_t{mesher::kMostThreads}) return static_cast<int>(threads);
  throw Error(ErrorCode::bad_option,
              "--threads " + text + ": must be at most " + std::to_string(mesher::kMostThreads));
}

template <int D>
mesher::Options<D> options_of(const MeshArguments& args, const Input<D>& input) {
  require_own_measure<D>(args);
  mesher::Options<D> options;
  if (!args.rho.empty()) options.rho = option_rho(args.rho, kMostRho);
  if (!args.min_angle.empty()) options.rho = option_min_angle(args.min_angle);
  if (!args.growth.empty()) options.growth = option_positive("--growth", args.growth);
  if (!args.min_dihedral.empty()) set_min_dihedral(args.min_dihedral, options);
  options.rule =
      args.rule == "radius-edge" ? mesher::Rule::radius_edge : mesher::Rule::voronoi_aspect;
  options.domain = args.domain.empty() ? mesher::snapped_domain<D>(places_of(input.graph()))
                                       : domain_of<D>(args.domain);
  options.extent = args.box ? mesher::Extent::box : mesher::Extent::enclosed;
  if (args.region_areas) options.region_areas = mesher::RegionAreas::limits;
  options.algorithm = algorithm_of(args);
  if (!args.max_vertices.empty()) {
    options.max_vertices = option_count("--max-vertices", args.max_vertices);
  }
  if (!args.threads.empty()) options.threads = option_threads(args.threads);
  require_inside<D>(input, options.domain);
  add_limits(args, options);
  return options;
}

// A positional INPUT behind the four numbers of --domain is taken for the fifth.
void settle_input(MeshArguments& args) {
  if (args.input.empty() && args.domain.size() == 5) {
    args.input = args.domain.back();
    args.domain.pop_back();
  }
  if (args.input.empty()) throw CLI::RequiredError("INPUT");
  args.source = args.input;
  args.input = readable(args.source, args.format);
}

// INPUT is not `required` to CLI11, as settle_input() may find it later; to people it is.
class UsageOfInput : public CLI::Formatter {
 public:
  std::string make_option_usage(const CLI::Option* option) const override {
    return make_option_name(option, true);
  }
};

}  // namespace

void add_input_options(CLI::App& command, MeshArguments& args) {
  command
      .add_option(
          "INPUT", args.input,
          "Points and lines: .poly, .geojson, .json, .obj or .vtu. Points: .node, .xyz or .csv.\n"
          "In space points, segments and polygons: .poly or .smesh; points: .node, .xyz or\n"
          ".csv, and the vertices of .off, .obj, .ply, .stl, .vtu or .vtk")
      ->option_text("TEXT REQUIRED");
  command.parse_complete_callback([&args] { settle_input(args); });
  command.formatter(std::make_shared<UsageOfInput>());
  command
      .add_option(
          "--format", args.format,
          "The format of INPUT, given as an extension; for pipes and files without extension")
      ->type_name("EXTENSION");
  command.add_flag(
      "--surface", args.surface,
      "In space: mesh the faces of .off, .obj, .ply, .stl, .vtu or .vtk as polygons, and\n"
      "their edges as lines");
  command.add_flag(
      "--merge", args.merge,
      "As --surface, and merge adjacent polygons of one plane that have the same marker; also\n"
      "for .poly and .smesh. 'mesh --surface' merges them unless --no-merge is given");
  command
      .add_option(
          "--dimension,--dim", args.dimension,
          "2: the plane; 3: space (default: 3 if a .node or .poly file says so, or if z is\n"
          "present and not the same everywhere; for .xyz and .csv, not 0 everywhere)")
      ->check(CLI::IsMember({"2", "3"}));
  command
      .add_option("--domain", args.domain,
                  "The box in which points may lie (default: the bounding box of INPUT, moved\n"
                  "outward to a power-of-two grid)")
      ->option_text("XMIN YMIN [ZMIN] XMAX YMAX [ZMAX]")
      ->expected(4, 6)
      ->allow_extra_args(false);
}

void add_program_options(CLI::App& command, MeshArguments& args) {
  add_input_options(command, args);
  CLI::Option* const rho =
      command.add_option("--rho", args.rho,
                         "Bound of circumradius over shortest edge, above 1.01 and at most 100\n"
                         "(default: 1.4142; in space 2)");
  command
      .add_option(
          "--min-angle", args.min_angle,
          "Instead of --rho, in degrees, at most 29.6: no angle is smaller (in space, of faces);\n"
          "sets rho = 1 / (2 sin(D)). 28 works for most inputs in the plane")
      ->excludes(rho);
  command
      .add_option(
          "--min-dihedral", args.min_dihedral,
          "In space, in degrees, at most 20: tetrahedra with smaller dihedral angles are\n"
          "split where that makes these larger; 10 to 12 is what solvers want. Few remain,\n"
          "but where features meet at small angles; there svr and refine leave fewer")
      ->type_name("D");
  command
      .add_option("--rule", args.rule, "The rule for new vertices: radius-edge or voronoi-aspect")
      ->check(CLI::IsMember({"radius-edge", "voronoi-aspect"}))
      ->capture_default_str();
  command
      .add_option("--max-area", args.max_area,
                  "No kept triangle with its centroid in the domain is larger (default: no limit)")
      ->type_name("A");
  command.add_option("--max-volume", args.max_volume, "The same for tetrahedra, in space")
      ->type_name("V");
  command
      .add_option(
          "--max-size", args.max_size,
          "The same limit, given as the edge H of a regular triangle, or tetrahedron, of that size")
      ->type_name("H")
      ->excludes("--max-area")
      ->excludes("--max-volume");
  command
      .add_option(
          "--sizes", args.sizes,
          "A background of such H: .node with one value per point, or .csv with x,y,h (in space\n"
          "x,y,z,h); linear between its points")
      ->type_name("FILE");
  command
      .add_option(
          "--max-vertices", args.max_vertices,
          "More vertices are an error, which names the lines that need most (default: no limit)")
      ->type_name("N");
}

namespace {

void add_file_options(CLI::App& command, MeshArguments& args) {
  command
      .add_option(
          "-o", args.outputs,
          "Output: .node (with .ele, in space also .face, and .edge for segments and polygons),\n"
          ".vtu, .vtk, .msh, .inp, .su2, .mesh, .off, .obj or .svg; in space .off, .obj and .stl "
          "hold the\n"
          "boundary; may be repeated")
      ->type_name("OUT")
      ->allow_extra_args(false);
  command.add_flag("--static", args.is_static,
                   "Run gap-balls without the engine; the mesh is the same");
  command.add_option("--stats", args.stats, "Figures as JSON")->type_name("FILE");
}

}  // namespace

void add_mesh_options(CLI::App& command, MeshArguments& args, MeshGoes goes) {
  add_program_options(command, args);
  if (goes == MeshGoes::to_files) add_file_options(command, args);
  command
      .add_option("--order", args.order,
                  "2: second order, with nodes at the midpoints of edges, which stay straight, in\n"
                  ".msh, .vtu, .vtk, .inp and .node")
      ->check(CLI::IsMember({"1", "2"}))
      ->capture_default_str();
  command.add_option("--msh-version", args.msh_version, "The version of .msh outputs: 4.1 or 2.2")
      ->check(CLI::IsMember({"4.1", "2.2"}))
      ->capture_default_str();
  const auto add_names = [&](const char* option, std::vector<std::string>& names,
                             const char* help) {
    command.add_option(option, names, help)->type_name("N=NAME")->allow_extra_args(false);
  };
  add_names("--name-marker", args.marker_names,
            "In .msh, .inp and .su2, in space also .stl and .obj: the name of the lines (in space\n"
            "polygons) of marker N, as 7=inlet; without one marker_7. May be repeated");
  add_names("--name-line", args.line_names, "In space: of the lines of marker N, else line_N");
  add_names("--name-region", args.region_names,
            "Of the regions of attribute N, as 3=rock, else region_3");
  command.add_flag(
      "--repair", args.repair,
      "Repair INPUT: lines (in space also polygons) that cross or touch get common points\n"
      "there, points at one position become one, what several cover belongs to the smallest\n"
      "id, polygons that are not flat become triangles; each change is reported");
  add_tolerance_option(command, args.repair_tolerance)->needs("--repair");
  command.add_flag("--region-areas,--region-volumes", args.region_areas,
                   "Apply the largest areas, or volumes, of regions as limits of size");
  command.add_flag(
      "--box", args.box,
      "Output the whole box, not only what lines (in space polygons) enclose without holes");
  command.add_flag(
      "--no-flat", args.no_flat,
      "In space: remove flat tetrahedra; the tetrahedra that replace them are Delaunay up to\n"
      "rounding ('check --near')");
  command.add_flag("--quiet", args.quiet, "Print nothing but errors");
}

void add_threads_option(CLI::App& command, MeshArguments& args) {
  command
      .add_option("--threads", args.threads,
                  "Mesh, and follow the edits, on N threads; the mesh is that of one (default: 1)")
      ->type_name("N");
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

std::optional<double> option_tolerance(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const double x = option_number("--repair-tolerance", text);
  if (x >= 0) return x;
  throw Error(ErrorCode::bad_option, "--repair-tolerance " + text + ": must be 0 or more");
}

CLI::Option* add_tolerance_option(CLI::App& command, std::string& text) {
  return command
      .add_option(
          "--repair-tolerance", text,
          "Of a repair: what is closer, in the units of INPUT, is made to touch. In space\n"
          "larger ones lead to fewer vertices where surfaces nearly touch; 0: what rounding\n"
          "does not tell apart (default: 0, in space 2^-20 of the box's side)")
      ->type_name("T");
}

double option_rho(const std::string& text, double most) {
  const double rho = option_number("--rho", text);
  if (rho > kLeastRho && rho <= most) return rho;
  throw Error(ErrorCode::bad_option, "--rho " + text + ": must be above " + to_text(kLeastRho) +
                                         (most < INFINITY ? " and at most " + to_text(most) : ""));
}

double option_min_angle(const std::string& text) {
  const double angle = option_number("--min-angle", text);
  const double rho = mesher::radius_edge_bound(mesher::Options<2>{.min_angle = angle});
  if (angle > 0 && angle <= mesher::kLargestMinAngle && rho <= kMostRho) return rho;
  throw Error(ErrorCode::bad_option, "--min-angle " + text + ": must be above 0.29 and at most " +
                                         to_text(mesher::kLargestMinAngle));
}

int dimension_of(const MeshArguments& args) {
  if (args.dimension.empty() && faces(args) != Faces::unless_points) return 3;
  if (args.dimension.empty()) return mesher::dimension_of(args.input);
  return args.dimension == "3" ? 3 : 2;
}

namespace {

template <int D>
Input<D> as_meshed(Input<D> input, const MeshArguments& args) {
  if (!args.repair) {
    input.offer_repair();
    return input;
  }
  mesher::RepairOptions<D> options;
  if (!args.domain.empty()) options.domain = domain_of<D>(args.domain);
  options.tolerance = option_tolerance(args.repair_tolerance);
  try {
    locating(input, [&] { input.repair(options); });
  } catch (const Error& error) {
    throw with_domain_hint<D>(error);
  }
  return input;
}

}  // namespace

template <int D>
Input<D> read_input(const MeshArguments& args) {
  if (D == 2 && faces(args) != Faces::unless_points) {
    throw Error(ErrorCode::bad_option, "--surface and --merge are for space", {args.input});
  }
  if (D == 2 && args.no_flat) {
    throw Error(ErrorCode::bad_option, "--no-flat is for space", {args.input});
  }
  Input<D> input(args.input, faces(args), coinciding(args.repair));
  drop_copies();
  return as_meshed<D>(std::move(input), args);
}
template Input<2> read_input<2>(const MeshArguments&);
template Input<3> read_input<3>(const MeshArguments&);

template <int D>
mesher::Options<D> mesh_options(const MeshArguments& args, const Input<D>& input) {
  return options_of<D>(args, input);
}
template mesher::Options<2> mesh_options(const MeshArguments&, const Input<2>&);
template mesher::Options<3> mesh_options(const MeshArguments&, const Input<3>&);

template <int D>
Error with_domain_hint(const Error& error) {
  if (error.code() != ErrorCode::outside_domain) return error;
  return error.with_message(error.message() + kDomainHint<D>);
}
template Error with_domain_hint<2>(const Error&);
template Error with_domain_hint<3>(const Error&);

namespace {

// N=NAME: calls add(N, NAME).
template <class Add>
void read_names(const std::vector<std::string>& texts, const char* option, Add&& add) {
  for (const std::string& text : texts) {
    const auto equals = text.find('=');
    if (equals == std::string::npos) {
      throw Error(ErrorCode::bad_option,
                  std::string(option) + " '" + text + "': expected NUMBER=NAME");
    }
    add(text.substr(0, equals), text.substr(equals + 1));
  }
}

std::int64_t marker_number(const char* option, const std::string& text) {
  std::int64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, number);
  if (result.ec == std::errc{} && result.ptr == end) return number;
  throw Error(ErrorCode::bad_option, std::string(option) + " '" + text + "': not a whole number");
}

}  // namespace

mesher::GroupNames names_of(const MeshArguments& args, int dimension) {
  mesher::GroupNames names;
  if (dimension == 2 && !args.line_names.empty()) {
    throw Error(ErrorCode::bad_option,
                "--name-line is for space: in the plane --name-marker names lines", {args.input});
  }
  read_names(args.marker_names, "--name-marker", [&](const std::string& n, std::string name) {
    names.facets[marker_number("--name-marker", n)] = std::move(name);
  });
  read_names(args.line_names, "--name-line", [&](const std::string& n, std::string name) {
    names.lines[marker_number("--name-line", n)] = std::move(name);
  });
  read_names(args.region_names, "--name-region", [&](const std::string& n, std::string name) {
    names.regions[option_number("--name-region", n)] = std::move(name);
  });
  mesher::require_names(names);
  return names;
}

std::vector<mesher::PeriodicMarkers> periodic_of(const MeshArguments& args, int dimension) {
  std::vector<mesher::PeriodicMarkers> pairs;
  if (dimension == 3 && !args.periodic.empty()) {
    throw Error(ErrorCode::bad_option, "--periodic is for the plane; INPUT is in space",
                {args.input});
  }
  for (const std::string& text : args.periodic) {
    const auto equals = text.find('=');
    if (equals == std::string::npos) {
      throw Error(ErrorCode::bad_option, "--periodic '" + text + "': expected FROM=TO");
    }
    pairs.push_back({marker_number("--periodic", text.substr(0, equals)),
                     marker_number("--periodic", text.substr(equals + 1))});
  }
  return pairs;
}

mesher::OutOfCore out_of_core_of(const MeshArguments& args) {
  mesher::OutOfCore how{.folder = args.out_of_core};
  if (!args.tiles.empty()) how.tiles = option_count("--tiles", args.tiles);
  if (!args.threads.empty()) how.threads = option_threads(args.threads);
  return how;
}

template <int D>
void open_outputs(const MeshArguments& args, const Input<D>& input, Outputs<D>& outputs) {
  protect_inputs(args, input, outputs);
  mesher::GroupNames names = input.graph().names;
  names.add(names_of(args, D));
  mesher::require_names(names);
  outputs.set_names(std::move(names));
  mesher::WriteOptions options;
  if (args.order == "2") options.order = 2;
  if (args.msh_version == "2.2") options.msh = mesher::MshVersion::v2_2;
  const auto content =
      input.has_features() ? mesher::MeshFiles::features : mesher::MeshFiles::plain;
  for (const auto& path : args.outputs) outputs.open_mesh(path, content, options);
}
template void open_outputs(const MeshArguments&, const Input<2>&, Outputs<2>&);
template void open_outputs(const MeshArguments&, const Input<3>&, Outputs<3>&);

}  // namespace tool
