// What is meshed, and where each part of it stands: in INPUT, or in the script that brought it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mesher/domain.hpp"
#include "mesher/edit_script.hpp"
#include "mesher/pslg.hpp"
#include "mesher/repair.hpp"

namespace tool {

/// FILE:LINE, or FILE where the line is not known.
[[nodiscard]] std::string text_of(const mesher::Place& place);

class Input {
 public:
  /// Throws: Error, as read_pslg.
  explicit Input(const std::string& path) : file_(mesher::read_pslg(path)) {}

  [[nodiscard]] const std::string& path() const noexcept { return file_.file; }
  [[nodiscard]] const mesher::Pslg& graph() const noexcept { return file_.pslg; }
  [[nodiscard]] const mesher::PslgFile& file() const noexcept { return file_; }

  /// Lines that cross, touch or overlap become a graph that can be meshed; repairs() says how.
  /// Throws: Error, as mesher::repair.
  void repair(const std::optional<mesher::Box<2>>& domain);
  [[nodiscard]] const std::vector<mesher::RepairNote>& repairs() const noexcept { return repairs_; }

  /// From now on, errors that repair() would mend say so.
  void offer_repair() noexcept { offers_repair_ = true; }

  /// Whether a region of the file, or one that edits have brought, has a largest area.
  [[nodiscard]] bool has_region_areas() const;

  /// From now on, what `edits` bring stands where they do.
  void follow(const std::vector<mesher::Edit>& edits);

  /// Where a feature stands; without a line if it is not there. Cost: O(n), for errors.
  [[nodiscard]] mesher::Place place(mesher::Featured kind, mesher::FeatureId id) const;

  /// The error with the place of the feature to blame, unless it has a line already, and those of
  /// the others in its message, and whether --repair would help. What is said of nothing that
  /// stands somewhere is said of the file.
  [[nodiscard]] mesher::Error located(const mesher::Error& error) const;

  /// `PLACE: warning: WHAT` for a seed that has no region of its own.
  [[nodiscard]] std::string warning(const mesher::SeedFault& fault) const;

 private:
  mesher::PslgFile file_;
  std::vector<mesher::RepairNote> repairs_;
  bool offers_repair_ = false;
  bool edits_areas_ = false;
  std::map<std::pair<mesher::Featured, mesher::FeatureId>, mesher::Place> edited_;
};

}  // namespace tool
