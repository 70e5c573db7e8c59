// Names of groups: what files call the lines or polygons of one marker, and the cells of one
// region.
//
// A file names each group by the name given here, or else by its kind and number: `marker_7`,
// `line_7`, `region_3`.
//
// Example:
//   mesher::GroupNames names;
//   names.facets[7] = "inlet";
//   names.regions[3] = "rock";
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace mesher {

/// Names of groups, by their numbers. A name
///   (1) has 1 to kLongestName bytes, of UTF-8 or ASCII;
///   (2) has no blanks, control characters or quotes: readers of names stop there;
///   (3) is the name of one group;
///   (4) is not `marker_N`, `line_N` or `region_N` with a number, the name of a group without one.
struct GroupNames {
  static constexpr std::size_t kLongestName = 80;

  std::map<std::int64_t, std::string> facets;  ///< of markers: of lines, in space of polygons
  std::map<std::int64_t, std::string> lines;   ///< in space: of markers of lines
  std::map<double, std::string> regions;       ///< of attributes of regions

  [[nodiscard]] bool empty() const { return facets.empty() && lines.empty() && regions.empty(); }

  /// The name in files: that given, or `marker_M`, `line_M`, `region_A`.
  [[nodiscard]] std::string of_facets(std::int64_t marker) const;
  [[nodiscard]] std::string of_lines(std::int64_t marker) const;
  [[nodiscard]] std::string of_region(double attribute) const;

  /// The names of `other` replace those of the same numbers.
  void add(const GroupNames& other);

  friend bool operator==(const GroupNames&, const GroupNames&) = default;
};

/// Throws: Error(bad_option) unless (1) to (4) hold of all names.
void require_names(const GroupNames& names);

/// What of (1) and (2) does not hold of a name, as a part of a sentence; "" if both do.
[[nodiscard]] std::string fault_of_name(std::string_view name);

}  // namespace mesher
