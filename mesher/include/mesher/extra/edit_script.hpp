// Edit scripts: text files whose lines edit the input of a mesh.
//
//   # comment
//   +point ID x y        adds a point
//   -point ID            removes a point
//   move ID x y          moves a point
//   +segment ID A B      adds a segment between two points
//   -segment ID          removes a segment
//   +polyline ID P...    adds segments from point to point, under one id; closed if the last point
//                        is the first
//   -polyline ID         removes all of them
//                        +point, +segment, +polyline and +polygon may end with `marker M`, an
//                        integer
//   +hole ID x y         excludes the region around (x, y) that the lines enclose from the domain
//   -hole ID             removes a hole
//   +region ID x y ATTRIBUTE [MAX_AREA]
//                        gives that region this attribute and limit
//   -region ID           removes a region
//   limit area A         no triangle with its centroid in the domain is larger than A
//   limit size H         the same for the area of an equilateral triangle with edges H
//   limit sizes FILE     a background of such H (read_sizes); FILE is beside the script
//   limit none           triangles may be of any size
//   limit ... in XMIN YMIN XMAX YMAX
//                        the same in this box; elsewhere limits stay
//   begin                the edits up to `commit` are one update;
//   commit               outside, each edit is an update of its own
//
// Points, lines (segments and polylines), holes and regions are numbered separately. A block is
// judged by the final positions of its points: it may use a position before it frees it, and remove
// a point before its segments.
//
// In space points have a third coordinate, `+point ID x y z`; there are edits of segments and
// polylines, and
//
//   +polygon ID P P P... [/ P P P...]... [on P...] [along A B [A B]...]
//                        adds a polygon: its outer loop of points, then the loops of holes; points
//                        and edges that it declares to lie inside
//   -polygon ID          removes a polygon, with the edges that no other feature has
//   limit volume V       no tetrahedron with its centroid in the domain is larger than V; or
//                        `size H` (edges of a regular one), `sizes FILE`, `none`;
//                        `in XMIN YMIN ZMIN XMAX YMAX ZMAX`
//
// and no others. Polygons are numbered separately.
//
// Example:
//   mesher::EditScript script("edits.txt");
//   mesher::apply(script, m, [](const mesher::Update<2>& u) { ... u.change ... });
#pragma once

#include <cstdint>
#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesher/domain.hpp"
#include "mesher/error.hpp"
#include "mesher/mesh.hpp"
#include "mesher/mesher.hpp"

namespace mesher {

enum class EditKind : std::uint8_t {
  insert,
  remove,
  move,
  insert_segment,
  remove_segment,
  insert_polyline,
  remove_polyline,
  insert_hole,
  remove_hole,
  insert_region,
  remove_region,
  limit,
  insert_polygon,
  remove_polygon,
};

/// One edit of one point, line, polygon or seed, or of limits.
template <int D>
struct Edit {
  using Kind = EditKind;
  Kind kind = Kind::insert;
  std::int64_t number = 0;              ///< of the feature
  Point<D> point{};                     ///< of insert and move, and of a new seed
  std::vector<PointId> points{};        ///< of a new segment or polyline
  Polygon polygon{};                    ///< a new polygon
  std::int64_t marker = 0;              ///< of a new point, line or polygon; 0: none
  double attribute = 0;                 ///< of a new region
  std::optional<double> max_measure{};  ///< likewise
  SizeLimits<D> limits{};               ///< of limit
  std::optional<Box<D>> box{};          ///< likewise; nothing: everywhere
  std::string text;                     ///< the line without comment and outer blanks
  FileLocation location;

  /// The feature that this edits; none for an edit of limits.
  [[nodiscard]] Feature feature() const;
};

/// The kind of feature that an edit changes; none for an edit of limits.
[[nodiscard]] FeatureKind feature_kind(EditKind kind);

/// Reads a script batch by batch; each batch is one update. D is 2 or 3.
template <int D>
class EditScript {
 public:
  /// Throws: Error(cannot_read).
  explicit EditScript(const std::string& path);
  /// Of a text in memory. `path`: what errors name; FILE of limits is beside it.
  [[nodiscard]] static EditScript of_text(std::string text, std::string path);

  /// The next edit, or the edits of the next block; nothing at the end of the script. Reads no line
  /// before it is needed.
  /// Throws: Error (bad_edit, bad_number, not_finite, magnitude, unbalanced_commit, cannot_read).
  [[nodiscard]] std::optional<std::vector<Edit<D>>> next();

 private:
  EditScript(std::unique_ptr<std::istream> stream, std::string path);
  [[nodiscard]] bool read_line();
  [[nodiscard]] std::vector<Edit<D>> read_block();
  [[nodiscard]] FileLocation here() const { return {path_, number_, 1}; }

  std::string path_;
  std::unique_ptr<std::istream> stream_;
  std::string text_;  // the current line
  long number_ = 0;
};

/// The lines of the edits, joined by "; ".
template <int D>
[[nodiscard]] std::string text_of(const std::vector<Edit<D>>& edits);

/// One update of a script and its result. `Made`: the type that the target's update() returns.
template <int D, class Made = Change<D>>
struct Update {
  std::vector<Edit<D>> edits;
  Made change;
  double seconds = 0;  ///< of wall-clock time: the edits and the update

  [[nodiscard]] std::string text() const { return text_of(edits); }
};

/// Announces an edit of a line to a mesher, or to any target with the same functions for lines
/// (with or without a marker).
/// Throws: Error as those functions; Error(bad_edit) if the target has points only.
template <int D, class Target>
void announce_line(const Edit<D>& edit, Target& target) {
  if constexpr (requires { target.remove_line(LineId()); }) {
    const LineId id{edit.number};
    switch (edit.kind) {
      case EditKind::insert_segment:
        if constexpr (requires { target.insert_segment(id, PointId(), PointId(), edit.marker); }) {
          return target.insert_segment(id, edit.points[0], edit.points[1], edit.marker);
        } else {
          return target.insert_segment(id, edit.points[0], edit.points[1]);
        }
      case EditKind::insert_polyline:
        if constexpr (requires { target.insert_polyline(id, edit.points, edit.marker); }) {
          return target.insert_polyline(id, edit.points, edit.marker);
        } else {
          return target.insert_polyline(id, edit.points);
        }
      default:
        return target.remove_line(id);
    }
  } else {
    throw Error(ErrorCode::bad_edit, "only points can be edited here");
  }
}

/// Announces an edit of a polygon in the same way.
template <int D, class Target>
void announce_polygon(const Edit<D>& edit, Target& target) {
  if constexpr (requires { target.insert_polygon(edit.polygon); }) {
    if (edit.kind == EditKind::remove_polygon) return target.remove_polygon(PolygonId{edit.number});
    target.insert_polygon(edit.polygon);
  } else {
    throw Error(ErrorCode::bad_edit, "polygons cannot be edited here");
  }
}

/// Announces an edit of a seed in the same way.
template <int D, class Target>
void announce_seed(const Edit<D>& edit, Target& target) {
  if constexpr (requires { target.insert_seed(Seed<D>()); }) {
    const SeedKind kind =
        feature_kind(edit.kind) == FeatureKind::hole ? SeedKind::hole : SeedKind::region;
    const SeedId name{kind, edit.number};
    if (edit.kind == EditKind::remove_hole || edit.kind == EditKind::remove_region) {
      return target.remove_seed(name);
    }
    target.insert_seed(Seed<D>{name, edit.point, edit.attribute, edit.max_measure});
  } else {
    throw Error(ErrorCode::bad_edit, "holes and regions cannot be edited here");
  }
}

/// Announces an edit of limits of size in the same way.
template <int D, class Target>
void announce_limit(const Edit<D>& edit, Target& target) {
  if constexpr (requires { target.limit(edit.limits); }) {
    return edit.box ? target.limit(*edit.box, edit.limits) : target.limit(edit.limits);
  } else {
    throw Error(ErrorCode::bad_edit, "limits cannot be edited here");
  }
}

/// Announces an edit to a mesher, or to any target with the same functions insert, remove and move,
/// and possibly those for lines, seeds and limits. Throws: Error as those functions, with the
/// location of the edit.
template <int D, class Target>
void announce(const Edit<D>& edit, Target& target) {
  try {
    if (edit.kind == EditKind::limit) return announce_limit(edit, target);
    if (feature_kind(edit.kind) == FeatureKind::line) return announce_line(edit, target);
    if (feature_kind(edit.kind) == FeatureKind::polygon) return announce_polygon(edit, target);
    if (feature_kind(edit.kind) != FeatureKind::point) return announce_seed(edit, target);
    switch (edit.kind) {
      case EditKind::insert:
        if constexpr (requires { target.insert(PointId{edit.number}, edit.point, edit.marker); }) {
          return target.insert(PointId{edit.number}, edit.point, edit.marker);
        } else {
          return target.insert(PointId{edit.number}, edit.point);
        }
      case EditKind::remove:
        return target.remove(PointId{edit.number});
      default:
        return target.move(PointId{edit.number}, edit.point);
    }
  } catch (const Error& error) {
    throw error.at(edit.location);
  }
}

/// Seconds of wall-clock time since some fixed moment.
[[nodiscard]] double now();

/// The edits of a batch in the order in which they are announced: first removals of lines and
/// polygons; then edits of points, with those of existing points before insertions, so that
/// positions are free before they are used; then insertions of lines and polygons; then seeds and
/// limits. Otherwise the order stays.
template <int D>
[[nodiscard]] std::vector<Edit<D>> announcing_order(std::vector<Edit<D>> edits);

/// The location of the edit that caused an error of update(): the last edit of the error's first
/// feature, or else the last edit. Requires: edits not empty.
template <int D>
[[nodiscard]] FileLocation location_to_blame(const std::vector<Edit<D>>& edits, const Error& error);

/// Applies one batch to `target` as one update.
/// Throws: Error, with the location of the edit that caused it; `target` is then as before the
/// batch.
template <int D, class Target>
auto apply(std::vector<Edit<D>> edits, Target& target) {
  using Made = decltype(target.update());
  const double start = now();
  try {
    for (const auto& edit : announcing_order(edits)) announce(edit, target);
    Made change = target.update();
    return Update<D, Made>{std::move(edits), std::move(change), now() - start};
  } catch (const Error& error) {
    target.discard_edits();
    if (error.location().line > 0 || error.code() == ErrorCode::cancelled || edits.empty()) throw;
    throw error.at(location_to_blame(edits, error));
  } catch (...) {
    target.discard_edits();
    throw;
  }
}

/// Applies a whole script, calling `each(update)` after every update.
/// Throws: Error at the first bad line; earlier updates stay applied, and nothing of the block with
/// the bad line is applied.
template <int D, class Target, class Each>
void apply(EditScript<D>& script, Target& target, Each each) {
  while (auto edits = script.next()) each(apply(std::move(*edits), target));
}

}  // namespace mesher
