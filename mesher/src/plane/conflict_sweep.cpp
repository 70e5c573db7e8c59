// The order of segments along the sweep line, and what happens to it from place to place.
#include "plane/conflict_sweep.hpp"

#include <algorithm>
#include <cstdint>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "mesher/predicates.hpp"
#include "plane/planarity.hpp"

namespace mesher::detail {
namespace {

using predicates::orient2d;

// Of segments that the sweep line meets, from below. Where one begins tells, or if both begin
// there, where they go. Equivalent are a segment and a place on it.
struct Below {
  using is_transparent = void;
  bool operator()(const Segment* s, const Segment* t) const {
    if (s == t) return false;
    if (s->place_a == t->place_a) return orient2d(s->place_a, s->place_b, t->place_b) > 0;
    if (s->place_a < t->place_a) return orient2d(s->place_a, s->place_b, t->place_a) > 0;
    return orient2d(t->place_a, t->place_b, s->place_a) < 0;
  }
  bool operator()(const Segment* s, const Point<2>& p) const {
    return orient2d(s->place_a, s->place_b, p) > 0;
  }
  bool operator()(const Point<2>& p, const Segment* s) const {
    return orient2d(s->place_a, s->place_b, p) < 0;
  }
};

// At one place segments end before its point is looked at, and before others begin.
enum class Turn : std::uint8_t { end, point, begin };
struct Event {
  Point<2> at;
  Turn turn;
  std::uint32_t item;
};

class Sweep {
 public:
  Sweep(const std::vector<const Segment*>& segments, const std::vector<const Vertex<2>*>& points)
      : segments_(segments), stands_(segments.size(), order_.end()) {
    events_.reserve(2 * segments.size() + points.size());
    for (std::uint32_t i = 0; i < segments.size(); ++i) {
      events_.push_back({segments[i]->place_a, Turn::begin, i});
      events_.push_back({segments[i]->place_b, Turn::end, i});
    }
    for (const Vertex<2>* v : points) events_.push_back({v->p, Turn::point, 0});
    std::sort(events_.begin(), events_.end(), [](const Event& a, const Event& b) {
      return std::tie(a.at, a.turn, a.item) < std::tie(b.at, b.turn, b.item);
    });
    for (std::uint32_t i = 0; i < segments.size(); ++i) number_.emplace(segments[i], i);
  }

  std::vector<const Segment*> run(const std::function<void()>& ask) {
    for (std::size_t i = 0; i < events_.size(); ++i) {
      if (i % kBetween == 0) ask();
      const Event& event = events_[i];
      switch (event.turn) {
        case Turn::end:
          end(event.item);
          break;
        case Turn::point:
          look_at(event.at);
          break;
        case Turn::begin:
          begin(event.item);
          break;
      }
    }
    return std::move(suspects_);
  }

 private:
  using Order = std::set<const Segment*, Below>;
  using Place = Order::iterator;
  static constexpr std::size_t kBetween = 1024;  // some tenth of a millisecond

  // Others may become neighbours when one goes.
  void end(std::uint32_t i) {
    if (stands_[i] == order_.end()) return;
    Place after = take(stands_[i]);
    while (after != order_.begin() && after != order_.end() &&
           planarity::conflict_with(**std::prev(after), **after)) {
      suspects_.push_back(*after);
      after = take(after);
    }
  }
  void leave_out(Place place) {
    suspects_.push_back(*place);
    end(number_.at(*place));
  }
  Place take(Place place) {
    stands_[number_.at(*place)] = order_.end();
    return order_.erase(place);
  }
  void look_at(const Point<2>& p) {
    for (auto on = order_.find(p); on != order_.end(); on = order_.find(p)) leave_out(on);
  }
  void begin(std::uint32_t i) {
    const Segment& s = *segments_[i];
    const auto [place, fits] = insert(s);
    if (!fits) return suspects_.push_back(&s);
    stands_[i] = place;
  }
  // Among those at its beginning it is new if none goes on along it.
  std::pair<Place, bool> insert(const Segment& s) {
    const auto [place, is_new] = order_.insert(&s);
    if (!is_new) return {place, false};
    const auto after = std::next(place);
    const bool below = place != order_.begin() && planarity::conflict_with(**std::prev(place), s);
    if (!below && (after == order_.end() || !planarity::conflict_with(s, **after))) {
      return {place, true};
    }
    order_.erase(place);
    return {order_.end(), false};
  }

  const std::vector<const Segment*>& segments_;
  Order order_;
  std::vector<Place> stands_;  // by segment; the end: it is not there
  std::vector<Event> events_;
  std::unordered_map<const Segment*, std::uint32_t> number_;
  std::vector<const Segment*> suspects_;
};

}  // namespace

std::vector<const Segment*> suspects_among(const std::vector<const Segment*>& segments,
                                           const std::vector<const Vertex<2>*>& points,
                                           const std::function<void()>& ask) {
  return Sweep(segments, points).run(ask);
}

}  // namespace mesher::detail
