// Groups of a surface's faces that have names in its file: several become markers, with these
// names.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/names_read.hpp"
#include "io/read_points.hpp"

namespace mesher {

class FaceGroups {
 public:
  /// The faces that follow are of the group of this name; "" is a name like others.
  void begin(std::string_view name, const FileLocation& place) {
    const auto first = std::min(name.find_first_not_of(" \t"), name.size());
    name.remove_prefix(first);
    const auto [found, is_new] = numbers_.try_emplace(std::string(name), groups_.size());
    current_ = found->second;
    if (is_new) groups_.push_back({std::string(name), place, 0});
  }
  /// One more face.
  void add_face() {
    if (groups_.empty()) begin("", {});
    of_.push_back(current_);
    ++groups_[current_].faces;
  }

  /// Whether there are several with faces.
  [[nodiscard]] bool several() const {
    const auto has_faces = [](const Group& group) { return group.faces > 0; };
    return std::count_if(groups_.begin(), groups_.end(), has_faces) > 1;
  }
  /// Marks the faces, which are as many as were added, by the order in which groups began, from 1,
  /// if there are several.
  void mark(Surface& surface, NoteCounter& notes) const {
    if (!several()) return;
    std::vector<std::int64_t> markers(groups_.size());
    std::int64_t last = 0;
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      if (groups_[i].faces == 0) continue;
      markers[i] = ++last;
      add_name(surface.names, surface.names.facets, last, groups_[i].name, groups_[i].place, notes);
    }
    for (std::size_t i = 0; i < of_.size(); ++i) surface.faces[i].marker = markers[of_[i]];
  }

 private:
  struct Group {
    std::string name;
    FileLocation place;
    std::size_t faces;
  };
  std::vector<Group> groups_;
  std::map<std::string, std::size_t> numbers_;
  std::vector<std::size_t> of_;  // of each face
  std::size_t current_ = 0;
};

}  // namespace mesher
