// The input, and the location of each part: in INPUT, or in the script that added it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesher/domain.hpp"
#include "mesher/extra/edit_script.hpp"
#include "mesher/graph.hpp"
#include "mesher/read.hpp"
#include "mesher/repair.hpp"
#include "pipe.hpp"

namespace tool {

/// Where features stand that have come from a file or from a script since.
class Standing {
 public:
  explicit Standing(const std::string& path) : path_(with_own_paths(path)) {}
  virtual ~Standing() = default;

  [[nodiscard]] const std::string& path() const noexcept { return path_; }

  /// From now on, errors that repair() would mend say so.
  void offer_repair() noexcept { offers_repair_ = true; }

  /// From now on, what `edits` bring stands where they do.
  template <int D>
  void follow(const std::vector<mesher::Edit<D>>& edits) {
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
  [[nodiscard]] std::string warning_text(const mesher::SeedId& seed, const std::string& what) const;
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

/// Whether it is of a format of complexes, whose polygons are always meshed.
[[nodiscard]] bool is_complex(const std::string& path);

/// What faces of a file in space are.
enum class Faces : std::uint8_t {
  unless_points,  ///< polygons of formats of complexes (.poly, .smesh); of others nothing
  polygons,
  merged,  ///< polygons; those of one plane that are side by side are one
};

/// What is read of points at one position: a repair makes them one.
[[nodiscard]] inline mesher::CoincidingPoints coinciding(bool is_repaired) {
  return is_repaired ? mesher::CoincidingPoints::kept : mesher::CoincidingPoints::refused;
}

/// Those of one plane that are side by side are one; those that are left keep their positions.
[[nodiscard]] mesher::GraphFile<3> with_merged_polygons(const mesher::GraphFile<3>& all);

/// A graph of a file. D is 2 or 3.
template <int D>
class Input final : public Standing {
 public:
  /// Throws: Error, as mesher::read; Error(bad_option) if faces are to be polygons, but the format
  /// has none. In the plane there are no faces.
  explicit Input(const std::string& path, Faces faces = Faces::unless_points,
                 mesher::CoincidingPoints coinciding = {});

  /// As the file has it.
  [[nodiscard]] const mesher::Graph<D>& graph() const noexcept { return file_.graph; }
  [[nodiscard]] const mesher::GraphFile<D>& file() const noexcept { return file_; }
  [[nodiscard]] const std::vector<mesher::Note>& notes() const noexcept { return file_.notes; }
  /// Whether lines and polygons are meshed, if there are any.
  [[nodiscard]] bool has_features() const noexcept { return has_features_; }
  /// Whether the file may have faces that are not meshed.
  [[nodiscard]] bool leaves_faces() const noexcept;

  /// What was read beside path().
  [[nodiscard]] const std::string& point_file() const noexcept { return file_.point_file; }
  [[nodiscard]] mesher::FileLocation location_of_point(std::size_t i) const {
    return file_.location_of_point(i);
  }

  /// What crosses, touches or overlaps becomes a graph that can be meshed; repairs() says how.
  /// Throws: Error, as mesher::repair.
  void repair(const mesher::RepairOptions<D>& options);
  [[nodiscard]] const std::vector<mesher::RepairNote<D>>& repairs() const noexcept {
    return repairs_;
  }
  /// How far features are from where they were, at most.
  [[nodiscard]] double deviation() const noexcept { return deviation_; }

  /// Whether a region of the file, or one that edits have brought, has a largest area, or volume.
  [[nodiscard]] bool has_region_limits() const;

  /// `PLACE: warning: WHAT` for a seed that has no region of its own.
  [[nodiscard]] std::string warning(const mesher::SeedFault<D>& fault) const {
    return warning_text(fault.seed, describe(fault));
  }

 private:
  [[nodiscard]] mesher::FileLocation location_in_file(
      const mesher::Feature& feature) const override {
    return mesher::location_of(feature, file_);
  }
  [[nodiscard]] bool meet(const std::vector<mesher::Feature>& features) const override;
  [[nodiscard]] std::string repair_reach() const override { return D == 2 ? "2^-44" : "2^-20"; }

  mesher::GraphFile<D> file_;
  bool has_features_ = true;
  std::vector<mesher::RepairNote<D>> repairs_;
  double deviation_ = 0;
};

}  // namespace tool
