// mesher-mpi: a mesh of a file by several ranks, which follows a script of edits.
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <initializer_list>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "geometry/box.hpp"
#include "mesher/extra/edit_script.hpp"
#include "mesher/meshing.hpp"
#include "mesher/mpi.hpp"
#include "mesher/read.hpp"
#include "mesher/sizes.hpp"
#include "mesher/write.hpp"
#include "mpi_peers.hpp"
#include "write_msh_pieces.hpp"

namespace {

using mesher::Error;
using mesher::ErrorCode;
using mesher::ExitCode;
using mesher::Graph;
using mesher::LineId;
using mesher::PointId;
using mesher::detail::Bytes;
using mesher::detail::MpiPeers;
using mesher::detail::Packer;
using mesher::detail::together;
using mesher::detail::Unpacker;

struct Arguments {
  std::string input, script;
  std::vector<std::string> outputs;
  double rho = 0;                                     // 0: the default
  double max_area = 0, max_volume = 0, max_size = 0;  // 0: no limit
  std::string sizes;
  std::size_t max_vertices = 0;
  int threads = 1;
  double min_dihedral = 0;
  bool surface = false, pieces = false, partitions = false, stats = false;
};

// What the first rank says, for all.
template <class T>
T of_first(MpiPeers& peers, const T& value) {
  Packer mine;
  together(peers, [&] { mine.put(value); });
  const std::vector<Bytes> all = peers.gather(mine.bytes());
  return Unpacker(all.front()).take<T>();
}

template <int D>
class Program {
 public:
  // Of all ranks, as all that follows. The first rank alone writes what is not in pieces.
  Program(const Arguments& arguments, MpiPeers& peers)
      : arguments_(arguments), peers_(peers), is_first_(peers.self() == 0) {}

  void run() {
    read();
    on_first([&] { require_outputs(); });
    mesher::MpiMesher<D> m(MPI_COMM_WORLD, options());
    together(peers_, [&] { announce(m); });
    on_first([&] { limit(m); });
    mesh(m);
    if (!arguments_.script.empty()) follow(m);
    for (const std::string& path : arguments_.outputs) write(m, path);
    if (arguments_.stats) print(m);
  }

 private:
  template <class Act>
  void on_first(Act&& act) {
    together(peers_, [&] {
      if (is_first_) act();
    });
  }

  // Points alone come to the ranks in shares, if a line of the file is one; else all is the
  // first's.
  void read() {
    const std::string& path = arguments_.input;
    const std::string format = mesher::format_of(path);
    const auto is_any = [&](std::initializer_list<const char*> formats) {
      return std::find(formats.begin(), formats.end(), format) != formats.end();
    };
    if (D == 2) {
      has_features_ = !is_any({".node", ".xyz", ".csv"});
    } else {
      has_features_ = arguments_.surface || is_any({".poly", ".smesh"});
    }
    if (D == 2 && arguments_.surface) {
      throw Error(ErrorCode::bad_option, "--surface is for space; INPUT is in the plane", {path});
    }
    mesher::ReadOptions how;
    how.points_alone = !has_features_;
    file_ = mesher::read<D>(MPI_COMM_WORLD, path, how);
    const Graph<D>& graph = file_.graph;
    on_first([&] {
      const bool has_lines = !graph.segments.empty() || !graph.polylines.empty();
      if (D == 3 && arguments_.surface && !has_lines && has_no_polygons(graph)) {
        throw Error(ErrorCode::bad_option, "--surface: the file has no faces", {path});
      }
      for (const auto& s : graph.segments) line_markers_[s.id] = s.marker;
      for (const auto& l : graph.polylines) line_markers_[l.id] = l.marker;
    });
    together(peers_, [&] {
      for (const auto& p : graph.points) {
        if (p.marker != 0) markers_read_.push_back({p.id, p.marker});
      }
    });
  }

  static bool has_no_polygons(const Graph<D>& graph) {
    if constexpr (D == 3) return graph.polygons.empty();
    return true;
  }

  // Seeds say what is written.
  void announce(mesher::MpiMesher<D>& m) const {
    for (const auto& p : file_.graph.points) m.insert(p.id, p.at);
    for (const auto& s : file_.graph.segments) m.insert_segment(s.id, s.from, s.to);
    for (const auto& l : file_.graph.polylines) m.insert_polyline(l.id, l.points);
    if constexpr (D == 3) {
      for (const auto& f : file_.graph.polygons) m.insert_polygon(f);
    }
  }

  // What the first rank announces all have.
  void limit(mesher::MpiMesher<D>& m) const {
    const double other = D == 2 ? arguments_.max_volume : arguments_.max_area;
    if (other != 0) {
      throw Error(ErrorCode::bad_option,
                  D == 2 ? "--max-volume is for space; INPUT is in the plane"
                         : "--max-area is for the plane; INPUT is in space",
                  {arguments_.input});
    }
    mesher::SizeLimits<D> limits;
    limits.max_measure = D == 2 ? arguments_.max_area : arguments_.max_volume;
    if (arguments_.max_size != 0) {
      limits.max_measure = mesher::measure_of_size<D>(arguments_.max_size);
    }
    if (!arguments_.sizes.empty()) {
      limits.sizes = mesher::sampled_sizes<D>(mesher::read_sizes<D>(arguments_.sizes).samples);
    }
    if (limits != mesher::SizeLimits<D>()) m.limit(limits);
  }

  // A bad path is found before the work begins.
  void require_outputs() const {
    const auto is_msh = [](const std::string& path) { return mesher::format_of(path) == ".msh"; };
    const auto& outputs = arguments_.outputs;
    if ((arguments_.pieces || arguments_.partitions) &&
        std::none_of(outputs.begin(), outputs.end(), is_msh)) {
      throw Error(ErrorCode::bad_option,
                  "--pieces and --partitions are for .msh: no OUTPUT is one");
    }
    for (const std::string& path : arguments_.outputs) {
      mesher::OutputFiles files;
      files.protect(arguments_.input);
      if (!arguments_.sizes.empty()) files.protect(arguments_.sizes);
      if (!arguments_.script.empty()) files.protect(arguments_.script);
      if (mesher::format_of(path) == ".pvtu") {
        files.open(path);
      } else if (is_in_pieces(path)) {
        files.open(mesher::detail::msh_piece_name(path, 0));
      } else if (has_partitions(path)) {
        files.open(path);
      } else {
        static_cast<void>(mesher::open_mesh<D>(files, path, content()));
      }
    }
  }

  mesher::Options<D> options() {
    mesher::Options<D> options;
    options.domain = domain();
    if (arguments_.rho != 0) options.rho = arguments_.rho;
    if (D == 2 && arguments_.min_dihedral != 0) {
      throw Error(ErrorCode::bad_option, "--min-dihedral is for space; INPUT is in the plane",
                  {arguments_.input});
    }
    if constexpr (D == 3) options.min_dihedral = arguments_.min_dihedral;
    options.max_vertices = arguments_.max_vertices;
    options.threads = arguments_.threads;
    return options;
  }

  // Of the points of all ranks: what is around theirs says it.
  mesher::Box<D> domain() {
    Packer mine;
    together(peers_, [&] {
      if (file_.graph.points.empty()) return;
      const auto around = mesher::detail::bounding_box<D>(places_of(file_.graph));
      mine.put(around.lo), mine.put(around.hi);
    });
    const std::vector<Bytes> told = peers_.gather(mine.bytes());
    mesher::Box<D> domain;
    together(peers_, [&] {
      std::vector<mesher::Point<D>> corners;
      for (const Bytes& one : told) {
        for (Unpacker rest(one); !rest.is_empty();) {
          corners.push_back(rest.take<mesher::Point<D>>());
        }
      }
      domain = mesher::snapped_domain<D>(corners);
    });
    return domain;
  }

  void mesh(mesher::MpiMesher<D>& m) {
    try {
      m.update({}, mesher::Told::own);
    } catch (const Error& error) {
      const Error found = mesher::located(MPI_COMM_WORLD, error, file_);
      throw found.location().file.empty() ? found.at({arguments_.input}) : found;
    }
    // The mesher has them.
    file_.graph.points = std::vector<mesher::GraphPoint<D>>();
    file_.points = std::vector<mesher::FilePosition>();
  }

  // Batch by batch; the edits of a batch are announced by the first rank.
  void follow(mesher::MpiMesher<D>& m) {
    std::optional<mesher::EditScript<D>> script;
    on_first([&] { script.emplace(arguments_.script); });
    while (true) {
      std::optional<std::vector<mesher::Edit<D>>> edits;
      on_first([&] {
        edits = script->next();
        if (!edits) return;
        edits = mesher::announcing_order(*edits);
        for (const auto& edit : *edits) mesher::announce(edit, m);
      });
      if (!of_first(peers_, edits.has_value())) return;
      try {
        m.update({}, mesher::Told::own);
      } catch (const Error& error) {
        if (!edits) throw;
        throw error.at(mesher::location_to_blame(*edits, error));
      }
      on_first([&] {
        for (const auto& edit : *edits) note_marker(edit);
      });
    }
  }

  void note_marker(const mesher::Edit<D>& edit) {
    using Kind = mesher::EditKind;
    if (edit.kind == Kind::insert) markers_edited_[PointId{edit.number}] = edit.marker;
    if (edit.kind == Kind::insert_segment || edit.kind == Kind::insert_polyline) {
      line_markers_[LineId{edit.number}] = edit.marker;
    }
  }

  mesher::MeshFiles content() const {
    return has_features_ ? mesher::MeshFiles::features : mesher::MeshFiles::plain;
  }
  bool is_in_pieces(const std::string& path) const {
    return arguments_.pieces && mesher::format_of(path) == ".msh";
  }
  bool has_partitions(const std::string& path) const {
    return arguments_.partitions && mesher::format_of(path) == ".msh";
  }

  void write(const mesher::MpiMesher<D>& m, const std::string& path) {
    if (mesher::format_of(path) == ".pvtu") return mesher::write_mesh(m, path);
    if (is_in_pieces(path)) return mesher::write_pieces(m, path);
    if (has_partitions(path)) return mesher::write_partitions(m, path);
    mesher::Mesh<D> whole = m.gather();
    std::vector<mesher::GraphPoint<D>> points = m.gather_points();
    const std::vector<Bytes> markers = gather_markers();
    on_first([&] {
      mark(points, markers);
      mesher::WriteOptions how;
      const auto made = mesher::domain_mesh(std::move(whole), graph_of(m, std::move(points)),
                                            mesher::Extent::enclosed);
      mesher::OutputFiles files;
      mesher::open_mesh<D>(files, path, content(), how)(made.mesh, made.mesh.features);
      files.commit();
    });
  }

  // On the first rank.
  std::vector<Bytes> gather_markers() {
    Packer mine;
    mesher::detail::Peers::Views out;
    together(peers_, [&] {
      mine.put_all(markers_read_);
      out.resize(peers_.size());
      out[0] = mine.bytes();
    });
    return peers_.exchange(out);
  }
  void mark(std::vector<mesher::GraphPoint<D>>& points, const std::vector<Bytes>& read) const {
    std::unordered_map<PointId, std::int64_t> markers;
    for (const Bytes& one : read) {
      for (const Marked& p : Unpacker(one).take_all<Marked>()) markers[p.id] = p.marker;
    }
    for (const auto& [id, marker] : markers_edited_) markers[id] = marker;
    for (auto& p : points) {
      const auto at = markers.find(p.id);
      p.marker = at != markers.end() ? at->second : 0;
    }
  }

  // The input, as it is now; `points`: marked.
  Graph<D> graph_of(const mesher::MpiMesher<D>& m,
                    std::vector<mesher::GraphPoint<D>> points) const {
    Graph<D> now = file_.graph;
    now.points = std::move(points);
    now.segments.clear();
    now.polylines = m.lines();
    for (auto& l : now.polylines) l.marker = line_markers_.at(l.id);
    if constexpr (D == 3) now.polygons = m.polygons();
    return now;
  }

  void print(const mesher::MpiMesher<D>& m) const {
    const mesher::MpiCounts c = m.counts();
    const mesher::MeshStats s = m.stats();
    if (!is_first_) return;
    const auto number = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
    std::printf(
        "{\"ranks\":%d,\"points\":%zu,\"vertices\":%llu,\"simplices\":%llu,"
        "\"least_vertices\":%llu,\"most_vertices\":%llu,\"rounds\":%llu,\"horizons\":%llu,"
        "\"messages\":%llu,\"bytes\":%llu,\"most_bytes\":%llu,\"seen\":%llu,\"calls\":%llu,"
        "\"trace_bytes\":%llu}\n",
        m.ranks(), m.size(), number(c.vertices), number(s.simplices), number(c.least_vertices),
        number(c.most_vertices), number(c.rounds), number(c.horizons), number(c.messages),
        number(c.bytes), number(c.most_bytes), number(c.seen), number(s.calls),
        number(s.trace_bytes));
  }

  const Arguments& arguments_;
  MpiPeers& peers_;
  bool is_first_;
  struct Marked {
    PointId id;
    std::int64_t marker;
  };
  mesher::GraphFile<D> file_;         // the share of this rank
  std::vector<Marked> markers_read_;  // likewise, but for those that are 0
  bool has_features_ = false;
  // Of the first rank: of all points that edits have brought, and of all lines that there were.
  std::map<PointId, std::int64_t> markers_edited_;
  std::map<LineId, std::int64_t> line_markers_;
};

int run(int argc, char** argv, MpiPeers& peers) {
  const bool is_first = peers.self() == 0;
  Arguments arguments;
  CLI::App app{
      "Makes a quality Delaunay mesh of a file of points, lines or polygons by all ranks, and\n"
      "updates it under edits: "
      "the mesh of 'mesher edit', to the last byte, whatever the number of ranks.",
      "mesher-mpi"};
  app.footer(
      "Example: mpirun -n 4 mesher-mpi points.node -o mesh.pvtu -o mesh.node --script edits.txt\n"
      "Exit codes, on all ranks: 0 ok, 1 geometry, 2 usage, 3 format, 4 limit, 70 a bug.");
  app.add_option("INPUT", arguments.input, "A file as 'mesher mesh' reads it")->required();
  app.add_flag("--surface", arguments.surface,
               "In space: the faces of INPUT are polygons; else its points are meshed alone");
  app.add_option(
         "-o,--output", arguments.outputs,
         "The mesh: .pvtu and a .vtu file beside it for each rank, of all of the box; or one\n"
         "file, in any format of 'mesher mesh', of what the input encloses, which the first\n"
         "rank gathers and writes")
      ->allow_extra_args(false);
  app.add_flag("--pieces", arguments.pieces,
               "NAME.msh is NAME_1.msh, NAME_2.msh, ..., one for each rank, as 'gmsh -part_split'\n"
               "writes them")
      ->excludes(app.add_flag(
          "--partitions", arguments.partitions,
          "NAME.msh is one file with a partition for each rank, as 'gmsh -part' writes\n"
          "it, which the first rank writes without having all of it; of all of the box"));
  app.add_option("--script", arguments.script, "Edits that are made one batch after the other");
  app.add_option("--rho", arguments.rho, "The bound on circumradius over shortest edge");
  app.add_option("--min-dihedral", arguments.min_dihedral,
                 "In space: tetrahedra with smaller dihedral angles are split, in degrees");
  CLI::Option* area =
      app.add_option("--max-area", arguments.max_area, "No triangle is larger: see 'mesher mesh'");
  CLI::Option* volume =
      app.add_option("--max-volume", arguments.max_volume, "The same for tetrahedra, in space");
  app.add_option("--max-size", arguments.max_size,
                 "The same, as the edge of a regular triangle, or tetrahedron")
      ->excludes(area)
      ->excludes(volume);
  for (const char* name : {"--max-area", "--max-volume", "--max-size"}) {
    app.get_option(name)->check(CLI::PositiveNumber);
  }
  app.add_option("--sizes", arguments.sizes, "A background of such sizes, as of 'mesher mesh'");
  app.add_option("--max-vertices", arguments.max_vertices, "More are an error");
  app.add_option("--threads", arguments.threads, "Of each rank")->capture_default_str();
  app.add_flag("--stats", arguments.stats, "Print counts as a line of JSON");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return is_first ? app.exit(help) : 0;
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorCode::bad_option, std::string(error.what()) + "; see 'mesher-mpi --help'");
  }
  const int dimension = mesher::dimension_of(MPI_COMM_WORLD, arguments.input);
  dimension == 3 ? Program<3>(arguments, peers).run() : Program<2>(arguments, peers).run();
  return 0;
}

}  // namespace

// What is thrown is thrown on all ranks: they come to the end together, and one of them says why.
int main(int argc, char** argv) {
  int level = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &level);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const auto fail = [&](ExitCode code, const std::string& message) {
    if (rank == 0) std::fprintf(stderr, "%s\n", message.c_str());
    return static_cast<int>(code);
  };
  int code = 0;
  try {
    MpiPeers peers(MPI_COMM_WORLD);
    code = run(argc, argv, peers);
  } catch (const Error& error) {
    code = fail(mesher::exit_code(error.code()), error.what());
  } catch (const std::bad_alloc&) {
    code = fail(ExitCode::limit, "error[too_many]: out of memory");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "rank %d: error[bug]: %s; this is our mistake\n", rank, error.what());
    MPI_Abort(MPI_COMM_WORLD, static_cast<int>(ExitCode::bug));
  }
  MPI_Finalize();
  return code;
}
