// What is meshed, and where each part of it stands: in INPUT, or in the script that brought it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "mesher/domain.hpp"
#include "mesher/edit_script.hpp"
#include "mesher/io.hpp"
#include "mesher/plc.hpp"
#include "mesher/pslg.hpp"
#include "mesher/repair.hpp"
#include "mesher/space_repair.hpp"

namespace tool {

/// Where features stand that have come from a file or from a script since.
class Standing {
 public:
  explicit Standing(std::string path) : path_(std::move(path)) {}
  virtual ~Standing() = default;

  [[nodiscard]] const std::string& path() const noexcept { return path_; }

  /// From now on, errors that repair() would mend say so.
  void offer_repair() noexcept { offers_repair_ = true; }

  /// From now on, what `edits` bring stands where they do.
  template <int D>
  void follow(const std::vector<mesher::EditOf<D>>& edits) {
    for (const auto& edit : edits) {
      edited_.insert_or_assign(edit.feature(), edit.location);
      edits_limits_ = edits_limits_ || edit.max_measure.has_value();
    }
  }

  /// Where a feature stands; without a line if it is not there. Cost: O(n), for errors.
  [[nodiscard]] mesher::FileLocation location(const mesher::Feature& feature) const;

  /// The error with the place of the feature to blame, unless it has a line already, and those of
  /// the others in its message, and whether --repair would help. What is said of nothing that
  /// stands somewhere is said of the file.
  [[nodiscard]] mesher::Error located(const mesher::Error& error) const;

 protected:
  Standing(const Standing&) = default;
  Standing(Standing&&) = default;

  /// `PLACE: warning: WHAT` of a seed.
  [[nodiscard]] std::string warning_text(const mesher::SeedName& seed,
                                         const std::string& what) const;
  /// Whether edits have brought a region with a largest area, or volume.
  [[nodiscard]] bool edits_limits() const noexcept { return edits_limits_; }

 private:
  /// In the file; without a line if it is not there.
  [[nodiscard]] virtual mesher::FileLocation location_in_file(
      const mesher::Feature& feature) const = 0;
  /// Whether these are lines of which the first two have a point in common, or one line.
  [[nodiscard]] virtual bool meet(const std::vector<mesher::Feature>&) const { return false; }
  /// What repair() joins: closer than this.
  [[nodiscard]] virtual std::string repair_reach() const = 0;

  std::string path_;
  bool offers_repair_ = false;
  bool edits_limits_ = false;
  std::map<mesher::Feature, mesher::FileLocation> edited_;
};

/// The result of `make`, whose errors are said of where `input` has what they are about.
/// Throws: as `make`, located.
template <class Make>
decltype(auto) locating(const Standing& input, Make&& make) {
  try {
    return make();
  } catch (const mesher::Error& error) {
    throw input.located(error);
  }
}

/// Points and lines in the plane.
class Input final : public Standing {
 public:
  /// Throws: Error, as read_pslg.
  explicit Input(const std::string& path);

  [[nodiscard]] const mesher::Pslg& graph() const noexcept { return file_.pslg; }
  [[nodiscard]] const mesher::PslgFile& file() const noexcept { return file_; }
  [[nodiscard]] const std::vector<mesher::Note>& notes() const noexcept { return file_.notes; }

  /// What was read beside path().
  [[nodiscard]] const std::string& point_file() const noexcept { return file_.point_file; }
  [[nodiscard]] std::vector<mesher::InputPoint<2>> points() const;
  [[nodiscard]] mesher::FileLocation location_of_point(std::size_t i) const {
    return file_.location_of_point(i);
  }

  /// Lines that cross, touch or overlap become a graph that can be meshed; repairs() says how.
  /// Throws: Error, as mesher::repair.
  void repair(const std::optional<mesher::Box<2>>& domain);
  [[nodiscard]] const std::vector<mesher::RepairNote>& repairs() const noexcept { return repairs_; }

  /// Whether a region of the file, or one that edits have brought, has a largest area.
  [[nodiscard]] bool has_region_limits() const;

  /// `PLACE: warning: WHAT` for a seed that has no region of its own.
  [[nodiscard]] std::string warning(const mesher::SeedFault& fault) const;

 private:
  [[nodiscard]] mesher::FileLocation location_in_file(
      const mesher::Feature& feature) const override {
    return mesher::location_of(feature, file_);
  }
  [[nodiscard]] bool meet(const std::vector<mesher::Feature>& features) const override;
  [[nodiscard]] std::string repair_reach() const override { return "2^-44"; }

  mesher::PslgFile file_;
  std::vector<mesher::RepairNote> repairs_;
};

/// What faces of a file in space are.
enum class Faces : std::uint8_t {
  unless_points,  ///< polygons of formats of complexes (.poly, .smesh); of others nothing
  polygons,
  merged,  ///< polygons; those of one plane that are side by side are one
};

/// Points, segments and polygons in space.
class SpaceInput final : public Standing {
 public:
  /// Throws: Error, as read_points, or as read_plc where faces are polygons; Error(bad_option) if
  /// they are to be, but the format has none.
  explicit SpaceInput(const std::string& path, Faces faces = Faces::unless_points);

  /// As the file has it.
  [[nodiscard]] const mesher::Plc& graph() const noexcept { return file_.plc; }
  [[nodiscard]] const mesher::PlcFile& file() const noexcept { return file_; }
  [[nodiscard]] const std::vector<mesher::Note>& notes() const noexcept { return file_.notes; }
  /// Whether segments and polygons are meshed, if there are any.
  [[nodiscard]] bool is_complex() const noexcept { return is_complex_; }
  /// Whether the file may have faces that are not meshed.
  [[nodiscard]] bool leaves_faces() const noexcept;

  [[nodiscard]] const std::string& point_file() const noexcept { return file_.point_file; }
  [[nodiscard]] std::vector<mesher::InputPoint<3>> points() const;
  [[nodiscard]] mesher::FileLocation location_of_point(std::size_t i) const {
    return file_.location_of_point(i);
  }

  /// Segments and polygons that do not fit together become a complex that can be meshed; repairs()
  /// says how. Throws: Error, as mesher::repair.
  void repair(const std::optional<mesher::Box<3>>& domain);
  [[nodiscard]] const std::vector<mesher::RepairNoteOf<3>>& repairs() const noexcept {
    return repairs_;
  }

  /// Whether a region of the file, or one that edits have brought, has a largest volume.
  [[nodiscard]] bool has_region_limits() const;

  /// `PLACE: warning: WHAT` for a seed that has no region of its own.
  [[nodiscard]] std::string warning(const mesher::SeedFaultOf<3>& fault) const;

 private:
  [[nodiscard]] mesher::FileLocation location_in_file(
      const mesher::Feature& feature) const override {
    return mesher::location_of(feature, file_);
  }
  [[nodiscard]] std::string repair_reach() const override { return "2^-42"; }

  mesher::PlcFile file_;
  bool is_complex_ = false;
  std::vector<mesher::RepairNoteOf<3>> repairs_;
};

/// The points of a complex, as of a file of points: what checks of points take.
[[nodiscard]] mesher::PointFile<3> points_of(const mesher::PlcFile& file);

/// The input of a dimension.
template <int D>
using InputOf = std::conditional_t<D == 2, Input, SpaceInput>;

}  // namespace tool
