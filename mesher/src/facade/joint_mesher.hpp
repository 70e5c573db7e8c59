// A mesh that several processes keep together, with the bytes of one.
//
// Each process has a JointMesher with the same options, and its tiles of the mesh: the calls of the
// trace, and the simplices, are divided, and so are points alone (divided_points.hpp). Where there
// are lines, polygons, limits of size or bounds of angles, all hold the input, what is done to it
// before refinement, and the tree that says how crowded it is: the trace is 10 to 20 times larger.
// Where there are lines or polygons in space all hold the mesh, too.
//
// Functions that are said to be of all are called by all processes, in the same order; they throw
// in all, or in none (peers.hpp).
#pragma once

#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "facade/announced_features.hpp"
#include "facade/announced_points.hpp"
#include "facade/joint_limits.hpp"
#include "facade/joint_numbers.hpp"
#include "facade/pending_limits.hpp"
#include "facade/point_directory.hpp"
#include "facade/reentry_guard.hpp"
#include "facade/tiled_state.hpp"
#include "mesher/mesher.hpp"

namespace mesher::detail {

/// Who is told of a change: each process of what is its own, the first of all, or all of all.
enum class Told : std::uint8_t { own, first, all };

/// Sums over all processes, unless said otherwise.
struct JointCounts {
  Exchanges exchanges;  // rounds, horizons: of each; most_bytes_out: the most of one
  std::uint64_t seen = 0;
  std::uint64_t vertices = 0;
  std::uint64_t least_vertices = 0, most_vertices = 0;  // of one
};

template <int D>
class JointMesher {
 public:
  /// Of all, with equal options; options.threads: of each. Throws: Error(bad_option), also for
  /// options that differ, and for those that tiles do not have (may_be_tiled).
  JointMesher(std::unique_ptr<Peers> peers, const Options<D>& options);
  JointMesher(const JointMesher&) = delete;
  JointMesher& operator=(const JointMesher&) = delete;

  /// Announces an edit, in any process. Judged by update(), so it throws std::bad_alloc alone.
  void insert(PointId id, const Point<D>& p) { announce({Kind::insert, id, p}); }
  void remove(PointId id) { announce({Kind::remove, id, {}}); }
  void move(PointId id, const Point<D>& p) { announce({Kind::move, id, p}); }
  void insert_segment(LineId id, PointId from, PointId to) {
    announce(LineEdit{id, LinePoints{from, to}});
  }
  void insert_polyline(LineId id, const LinePoints& points) { announce(LineEdit{id, points}); }
  void remove_line(LineId id) { announce(LineEdit{id, std::nullopt}); }
  void insert_polygon(const mesher::Polygon& polygon) {
    announce(PolygonEdit{polygon.id, polygon});
  }
  void remove_polygon(PolygonId id) { announce(PolygonEdit{id, std::nullopt}); }
  /// Limits of size, everywhere or in a box. Those with a function are announced by all processes
  /// (joint_limits.hpp).
  void limit(const SizeLimits<D>& limits) { announce({std::nullopt, limits}); }
  void limit(const Box<D>& box, const SizeLimits<D>& limits) { announce({box, limits}); }
  /// Of this process.
  void discard_edits() noexcept {
    announced_.clear();
    announced_lines_.clear(), announced_polygons_.clear();
    announced_limits_.clear();
  }

  /// Of all. Makes the edits of all processes, those of the first one first, points before lines
  /// before polygons; places are judged when all are made. Where limits change everywhere, tiles
  /// begin anew, and parts may change hands. What tiles refuse because of limits or lines the first
  /// process meshes alone, to say it as one process would. What is told of angles, and of the
  /// guard, is of the whole mesh. Throws: as Mesher::update and announcing to one; what
  /// control.progress of one process throws is std::runtime_error in others. The mesh is then as
  /// before in all; the edits stay announced if it is Error(cancelled), else they are discarded, in
  /// all.
  Change<D> update(const RunControl& control = {}, Told told = Told::all);

  /// The simplices of this process, each of which no other has, with their vertices, and edges and
  /// faces on features likewise. Empty before the first update.
  [[nodiscard]] Mesh<D> own_mesh() const;
  /// Of all: those of own_mesh(), which is `own`.
  [[nodiscard]] JointNumbers<D> numbers(const Mesh<D>& own) const;
  /// Of all: the mesh, in process `to`; empty in others.
  [[nodiscard]] Mesh<D> gather(std::size_t to = 0) const;
  /// Of all: sums, but of seconds the most.
  [[nodiscard]] MeshStats stats() const;

  /// Of all. Requires: an update.
  [[nodiscard]] JointCounts counts() const;

  /// Of all: what does not fit between what tiles know of each other (TileMesher::said); empty:
  /// nothing, and the mesh is certain to be that of one process.
  [[nodiscard]] std::string certificate() const;

  /// Points of the last update, in all processes.
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// Of all: the points, ascending by id, in process `to`; none in others.
  [[nodiscard]] std::vector<GraphPoint<D>> gather_points(std::size_t to = 0) const;
  /// Ascending by id.
  [[nodiscard]] std::vector<Polyline> lines() const;
  [[nodiscard]] std::vector<mesher::Polygon> polygons() const;
  /// With the limits of the last update.
  [[nodiscard]] const Options<D>& options() const noexcept { return options_; }
  [[nodiscard]] Peers& peers() const noexcept { return *peers_; }
  /// Requires: an update.
  [[nodiscard]] const TiledMesher<D>& tiles() const noexcept { return part_->tiles(); }
  /// Of all.
  void check_invariants() const;

 private:
  using Announcement = typename PointDirectory<D>::Announcement;
  using Kind = typename PointDirectory<D>::Kind;
  struct LineEdit {
    LineId id;
    std::optional<LinePoints> to;  // nothing: it goes
  };
  struct PolygonEdit {
    PolygonId id;
    std::optional<mesher::Polygon> to;
  };
  struct Joint {  // a state, and what it says as a part
    std::unique_ptr<AnyState<D>> state;
    const PartOfMesh<D>* part = nullptr;
  };

  // Of this process, and what kind the vertices removed were, if these may be added in another.
  struct Part {
    Change<D> change;
    std::vector<VertexKind> kinds_removed;
  };

  void announce(const Announcement& edit);
  void announce(AnnouncedLimits<D> limits);
  void announce(LineEdit edit);
  void announce(PolygonEdit edit);
  void collect_features(std::vector<Unpacker>& rest);
  [[nodiscard]] Joint state_for(const Options<D>& options, bool has_features, std::size_t tiles,
                                PointsOf which);
  void require_equal_options();
  void require_equal(const Packer& mine, const char* what);
  void collect(const RunControl& control);
  void collect_all(const RunControl& control);
  [[nodiscard]] const KnownPoints<D>& known() const noexcept;
  [[nodiscard]] bool shares_points() const noexcept {
    return directory_ != nullptr && all_points_ == nullptr;
  }
  [[nodiscard]] std::vector<GraphPoint<D>> told_points(std::size_t to) const;
  void know_all_points();
  [[nodiscard]] PointEdits<D> points_to_be() const;
  void limit_all(const std::vector<AnnouncedLimits<D>>& limits);
  Change<D> run(const RunControl& control, Told told);
  Change<D> run_or_alone(const RunControl& control, Told told);
  Change<D> run_anew(const RunControl& control, Told told, std::size_t tiles);
  void refuse_alone(const RunControl& control);
  void require_none(const std::exception_ptr& other);
  [[nodiscard]] Part part_from_last(Change<D>& whole) const;
  [[nodiscard]] Change<D> told_of(Part part, Told told) const;
  [[nodiscard]] Change<D> told_of_all(Change<D> change, Told told) const;
  [[nodiscard]] Change<D> told_anew(Change<D> whole, const Joint& fresh, Told told) const;
  static void pack_part(const Part& part, Packer& to);
  static Change<D> joined(const std::vector<Bytes>& parts);
  void clear_collected() noexcept;

  std::unique_ptr<Peers> peers_;
  Options<D> options_;
  MeshBox<D> box_;
  std::unique_ptr<AnyState<D>> state_;
  const PartOfMesh<D>* part_ = nullptr;           // of state_
  std::unique_ptr<PointDirectory<D>> directory_;  // null: each process has all points
  std::unique_ptr<AllPoints<D>> all_points_;      // while it is not to have its own alone any more
  std::size_t size_ = 0;
  std::vector<Announcement> announced_;  // in this process
  std::vector<LineEdit> announced_lines_;
  std::vector<PolygonEdit> announced_polygons_;
  JointLimits<D> announced_limits_;  // likewise
  AnnouncedPoints<D> edits_;         // in all; where points are divided, of those of directory_
  AnnouncedFeatures<D> features_;    // likewise
  PendingLimits<D> limits_;          // likewise
  ReentryGuard busy_;
};

}  // namespace mesher::detail
