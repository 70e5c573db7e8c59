// Whether triangles overlap, from the edges that have one triangle alone.
//
// A vertical line sweeps over the border from left to right (along it, upward). The border edges
// that it meets, from bottom to top, must have their triangles above and below in turn, the lowest
// above: then it is inside no triangle, inside one, ... and nowhere inside two. That is looked at
// where it can change, at vertices, and edges are compared with those that become their neighbours
// (Shamos, Hoey 1976), so that a first crossing or touching is found before the order is wrong.
#include <set>

#include "check/checked_mesh.hpp"
#include "mesher/predicates.hpp"

namespace mesher::detail {
namespace {

using predicates::orient2d;

// A border edge from its lesser to its greater end, in the order of the sweep.
struct SweptEdge {
  std::uint32_t left, right;
  bool opens;  // its triangle is above
};

class Sweep {
 public:
  explicit Sweep(const CheckedMesh<2>& mesh) : mesh_(mesh), status_(Below{this}) {
    for (const HalfEdge& e : mesh.sides().border()) {
      const bool forward = at(e.from) < at(e.to);
      edges_.push_back({forward ? e.from : e.to, forward ? e.to : e.from, forward});
    }
    place_.resize(edges_.size());
  }

  Verdict run() {
    struct Event {
      std::uint32_t vertex;
      std::size_t edge;
      bool begins;
    };
    std::vector<Event> events;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      events.push_back({edges_[i].left, i, true});
      events.push_back({edges_[i].right, i, false});
    }
    std::sort(events.begin(), events.end(), [&](const Event& a, const Event& b) {
      if (a.vertex != b.vertex) return at(a.vertex) < at(b.vertex);
      return a.begins != b.begins ? b.begins : a.edge < b.edge;  // ends come first
    });
    for (std::size_t i = 0; i < events.size() && fault_.empty(); ++i) {
      events[i].begins ? begin(events[i].edge) : end(events[i].edge);
      const bool last = i + 1 == events.size() || events[i + 1].vertex != events[i].vertex;
      if (last && fault_.empty()) check_turns(events[i].vertex);
    }
    if (!fault_.empty()) return Verdict::bad(fault_);
    return Verdict::good(std::to_string(edges_.size()) + " edges of the boundary, none crossing");
  }

 private:
  struct Below {
    const Sweep* sweep;
    bool operator()(std::size_t a, std::size_t b) const { return sweep->is_below(a, b); }
  };
  using Status = std::set<std::size_t, Below>;

  [[nodiscard]] const Point<2>& at(std::uint32_t v) const { return mesh_.at(v); }

  // Requires: a and b do not cross, and some vertical line meets both.
  [[nodiscard]] bool is_below(std::size_t a, std::size_t b) const {
    const SweptEdge &e = edges_[a], &f = edges_[b];
    if (e.left == f.left) {
      const int turn = orient2d(at(e.left), at(e.right), at(f.right));
      return turn != 0 ? turn > 0 : a < b;
    }
    if (at(e.left) < at(f.left)) {
      const int turn = orient2d(at(e.left), at(e.right), at(f.left));
      return turn != 0 ? turn > 0 : a < b;
    }
    const int turn = orient2d(at(f.left), at(f.right), at(e.left));
    return turn != 0 ? turn < 0 : a < b;
  }

  // Whether two edges share more than an end.
  [[nodiscard]] bool meet(const SweptEdge& e, const SweptEdge& f) const {
    if (e.left == f.left) return orient2d(at(e.left), at(e.right), at(f.right)) == 0;
    if (e.right == f.right) return orient2d(at(e.right), at(e.left), at(f.left)) == 0;
    if (e.right == f.left || e.left == f.right) return false;
    const int f_left = orient2d(at(e.left), at(e.right), at(f.left));
    const int f_right = orient2d(at(e.left), at(e.right), at(f.right));
    const int e_left = orient2d(at(f.left), at(f.right), at(e.left));
    const int e_right = orient2d(at(f.left), at(f.right), at(e.right));
    if (f_left == 0 && f_right == 0) return at(e.left) < at(f.right) && at(f.left) < at(e.right);
    return f_left * f_right <= 0 && e_left * e_right <= 0;
  }

  void compare(std::size_t a, std::size_t b) {
    if (!fault_.empty() || !meet(edges_[a], edges_[b])) return;
    fault_ = mesh_.edge(edges_[a].left, edges_[a].right) + " and " +
             mesh_.edge(edges_[b].left, edges_[b].right) + " of the boundary meet";
  }

  void begin(std::size_t edge) {
    const auto place = status_.insert(edge).first;
    place_[edge] = place;
    begun_.push_back(place);
    if (place != status_.begin()) compare(*std::prev(place), edge);
    if (std::next(place) != status_.end()) compare(edge, *std::next(place));
  }

  void end(std::size_t edge) {
    const auto next = status_.erase(place_[edge]);
    gap_ = next;
    if (next != status_.begin() && next != status_.end()) compare(*std::prev(next), *next);
  }

  // The edges around what has changed at v have their triangles above and below in turn.
  void check_turns(std::uint32_t v) {
    bool good = begun_.empty() ? in_turn(gap_) : true;
    for (const auto place : begun_) good = good && in_turn(place) && in_turn(std::next(place));
    begun_.clear();
    if (!good) fault_ = "triangles overlap at the boundary's " + mesh_.vertex(v);
  }

  // Whether the edge at `place`, or the top, may come above the one below it.
  [[nodiscard]] bool in_turn(Status::const_iterator place) const {
    const bool inside = place != status_.begin() && edges_[*std::prev(place)].opens;
    const bool opens = place != status_.end() && edges_[*place].opens;
    if (place == status_.end()) return !inside;
    return opens != inside;
  }

  const CheckedMesh<2>& mesh_;
  std::vector<SweptEdge> edges_;
  Status status_;
  std::vector<Status::iterator> place_;  // of the edges in status_
  std::vector<Status::iterator> begun_;  // at the current vertex
  Status::iterator gap_;                 // above what ended last
  std::string fault_;
};

}  // namespace

Verdict check_overlap(const CheckedMesh<2>& mesh) {
  if (mesh.mesh().simplices.empty()) return Verdict::bad("no triangles");
  return Sweep(mesh).run();
}

}  // namespace mesher::detail
