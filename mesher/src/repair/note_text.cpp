// What a repair has done, for people.
#include <string>

#include "geometry/input_point.hpp"
#include "mesher/repair.hpp"
#include "text/id_text.hpp"
#include "text/text.hpp"

namespace mesher {

namespace {

template <class Id>
std::string ids_text(const std::vector<Id>& ids) {
  std::string text;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (i > 0) text += i + 1 == ids.size() ? " and " : ", ";
    text += id_text(ids[i]);
  }
  return text;
}

template <class Id>
std::string counted(const std::string& what, const std::vector<Id>& ids) {
  return what + (ids.size() == 1 ? " " : "s ") + ids_text(ids);
}

std::string some(const std::string& what, std::size_t n) {
  return std::to_string(n) + ' ' + what + (n == 1 ? "" : "s");
}

template <int D>
class Words {
 public:
  explicit Words(const RepairNote<D>& note) : n_(note), at_(" at " + place_text(n_.at)) {}

  [[nodiscard]] std::string deed() const {
    switch (n_.kind) {
      case RepairKind::merged_points:
        return "point " + id_text(n_.points[0]) + " is point " + id_text(n_.points[1]) + at_;
      case RepairKind::zero_length:
        return who() + ": a piece without length is dropped, at point " + point();
      case RepairKind::split_at_point:
        if (!n_.polygons.empty()) return who() + " has point " + point() + " on it";
        return who() + " is split at point " + point();
      case RepairKind::split_at_crossing:
        return crossing();
      case RepairKind::overlap:
        return overlap();
      case RepairKind::renamed:
        return renamed();
      case RepairKind::bent_polygon:
        return "polygon " + id_text(n_.polygons[0]) + " is not flat, by " +
               text::to_text(n_.deviation) + at_ + ": " + some("triangle", n_.polygons.size()) +
               " now" + others();
      case RepairKind::cut_polygon:
        return "polygon " + id_text(n_.polygons[0]) + " is cut" + at_ + ": " +
               some("polygon", n_.polygons.size()) + " now" + others();
      case RepairKind::dropped_line:
      case RepairKind::dropped_polygon:
        break;
    }
    return who() + " is dropped: nothing is left of it";
  }

 private:
  static constexpr const char* kLine = D == 2 ? "line" : "segment";
  static std::string place_text(const Point<D>& at) { return detail::place_text(at); }

  [[nodiscard]] std::string who() const {
    if (n_.lines.empty()) return counted("polygon", n_.polygons);
    return counted(kLine, n_.lines) +
           (n_.polygons.empty() ? "" : " and " + counted("polygon", n_.polygons));
  }
  [[nodiscard]] std::string point() const {
    return id_text(n_.points[0]) + ' ' + place_text(n_.at);
  }
  [[nodiscard]] std::string crossing() const {
    const bool itself = n_.lines.size() + n_.polygons.size() == 1;
    return who() + (itself ? " crosses itself" : " cross") + at_ + ", point " +
           id_text(n_.points[0]) + " now";
  }
  [[nodiscard]] std::string overlap() const {
    return n_.polygons.empty() ? overlap(kLine, n_.lines, ", from " + place_text(n_.at) + " on")
                               : overlap("polygon", n_.polygons, at_);
  }
  template <class Id>
  [[nodiscard]] std::string overlap(const std::string& what, const std::vector<Id>& ids,
                                    const std::string& from) const {
    if (ids[0] == ids[1]) {
      return what + ' ' + id_text(ids[0]) + " covers itself" + from.substr(from[0] == ',' ? 1 : 0);
    }
    return what + ' ' + id_text(ids[0]) + " leaves to " + what + ' ' + id_text(ids[1]) +
           " what both cover" + from;
  }
  [[nodiscard]] std::string renamed() const {
    return std::string(kLine) + ' ' + id_text(n_.lines[0]) + (D == 2 ? " has a gap, and" : "") +
           " goes on as " + kLine + ' ' + id_text(n_.lines[1]) + " from " + place_text(n_.at) +
           " on";
  }
  // Of the parts but the first, which are numbered one after the other.
  [[nodiscard]] std::string others() const {
    if (n_.polygons.size() < 2) return {};
    const std::string first = id_text(n_.polygons[1]), last = id_text(n_.polygons.back());
    return n_.polygons.size() == 2 ? ", the new one has id " + first
                                   : ", the new ones have ids " + first + " to " + last;
  }

  const RepairNote<D>& n_;
  std::string at_;
};

}  // namespace

template <int D>
std::string RepairNote<D>::text(const std::string& prefix) const {
  std::string text = location.file;
  for (const long part : {location.line, location.column}) {
    if (!text.empty() && part > 0) text += ':' + std::to_string(part);
  }
  return (text.empty() ? text : text + ": ") + prefix + Words<D>(*this).deed();
}

template struct RepairNote<2>;
template struct RepairNote<3>;

}  // namespace mesher
