// Pairs of things that may be near each other, found by halving a box until few are left in it.
//
// A rod is in each half that it comes close to; so long rods are in many boxes, about as many as
// they will have pieces in a mesh. Boxes in which nothing is new are left out. A box is not halved
// if that does not help:
//   if it is as small as the tolerance;
//   if all but few of its rods have one end in common, as the spokes of a wheel around its hub, or
//   pass one place, as in a knot;
//   if its rods go on together, as the wires of a cable: then they are compared with those beside
//   them alone, in the order in which they lie across the cable.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "geometry/box.hpp"
#include "repair/drawing.hpp"

namespace mesher::detail {

/// What may be new: numbers from these on.
struct News {
  Spot spot = 0;
  std::uint32_t rod = 0;
};

class BoxSearch {
 public:
  explicit BoxSearch(const Drawing<2>& drawing)
      : drawing_(drawing), slack_(2 * drawing.tolerance()) {}

  /// Calls visit(rod, spot) for each rod that is whole and each point that may be as close to it as
  /// the tolerance, one of them new; and for others.
  template <class Visit>
  void rods_and_spots(const News& news, Visit&& visit) const;
  /// Calls visit(rod, rod, box), which says whether they cross, for pairs of whole rods, one of
  /// them new: of all that cross in the closed box, or of many in one place one for each rod; and
  /// others. Of rods that cross, one is among the pairs that do in any case.
  template <class Visit>
  void rods_and_rods(const News& news, Visit&& visit) const;

 private:
  static constexpr std::size_t kFew = 12;
  static constexpr std::size_t kFewBeside = 16;
  // The part of a rod in a box: from lo to hi, 0 at its end a and 1 at b.
  struct Part {
    std::uint32_t rod = 0;
    double lo = 0, hi = 1;
  };
  struct Content {
    Box<2> box;
    std::vector<Part> rods;
    std::vector<Spot> spots;

    [[nodiscard]] int longer_axis() const {
      return box.hi[0] - box.lo[0] >= box.hi[1] - box.lo[1] ? 0 : 1;
    }
    [[nodiscard]] double side() const {
      const int i = longer_axis();
      return box.hi[i] - box.lo[i];
    }
  };
  [[nodiscard]] Content all(bool with_spots) const;
  [[nodiscard]] Box<2> widened(const Box<2>& box) const {
    return {{box.lo[0] - slack_, box.lo[1] - slack_}, {box.hi[0] + slack_, box.hi[1] + slack_}};
  }
  [[nodiscard]] bool clip(Part& part, double axis_a, double along, double bound, int sign) const;
  [[nodiscard]] std::array<Content, 2> halves(const Content& c) const;
  [[nodiscard]] bool has_new_rod(const Content& c, const News& news) const;
  [[nodiscard]] bool has_new(const Content& c, const News& news) const;
  // Where a part lies across a cable.
  struct Breadth {
    double lo = 0, hi = 0;
    std::uint32_t rod = 0;
  };
  // Whether most rods lead through most of the box.
  [[nodiscard]] bool may_be_cable(const Content& c) const;
  // Sorted by lo; nothing unless they are a cable in which each has few beside it.
  [[nodiscard]] std::vector<Breadth> cable(const Content& c) const;
  // The rods that have the end in common that most of some have, first; and how many these are.
  std::size_t gather_spokes(std::vector<Part>& rods) const;
  // Two rods that cross at no small angle, and where; others that pass this place by less than a
  // quarter of the tolerance, and cross that of the two which they meet at the larger angle, are of
  // the knot, too. They all cross one of the two near there (kNear), at no angle under 2^-9.
  struct Knot {
    Point<2> at{};
    std::array<std::uint32_t, 2> rods{};
  };
  [[nodiscard]] std::optional<Knot> find_knot(const std::vector<Part>& rods) const;
  [[nodiscard]] std::optional<Knot> knot_of(const std::vector<Part>& rods, std::uint32_t rod) const;
  [[nodiscard]] double sine2(std::uint32_t r, std::uint32_t t) const;
  [[nodiscard]] std::uint32_t partner(const Knot& knot, std::uint32_t rod) const;
  [[nodiscard]] bool is_in(const Knot& knot, std::uint32_t rod) const;
  // The knot's rods first; how many these are.
  std::size_t gather(const Knot& knot, std::vector<Part>& rods) const;
  // Whether a knot is to be looked at beside this box, if it is the box of some crossing in it.
  [[nodiscard]] bool is_near(const Knot& knot, const Box<2>& box) const {
    constexpr double kNear = 0x1p10;  // times the tolerance: a quarter, on both sides, over 2^-9
    const double r = kNear * drawing_.tolerance();
    return contains({{box.lo[0] - r, box.lo[1] - r}, {box.hi[0] + r, box.hi[1] + r}}, knot.at);
  }

  const Drawing<2>& drawing_;
  double slack_;
};

template <class Visit>
void BoxSearch::rods_and_spots(const News& news, Visit&& visit) const {
  std::vector<Content> stack{all(true)};
  while (!stack.empty()) {
    const Content c = std::move(stack.back());
    stack.pop_back();
    if (c.rods.empty() || c.spots.empty() || !has_new(c, news)) continue;
    const bool few = c.spots.size() == 1 || c.rods.size() * c.spots.size() <= kFew * kFew;
    if (!few && c.side() > drawing_.tolerance()) {
      for (Content& half : halves(c)) stack.push_back(std::move(half));
      continue;
    }
    for (const Part& part : c.rods) {
      for (const Spot s : c.spots) {
        if (part.rod >= news.rod || s >= news.spot) visit(part.rod, s);
      }
    }
  }
}

// Rods that come near a box as small as the tolerance, and have no end in common, cross: the
// nearest points of others are ends, which are apart. So a pair for each that is not a spoke will
// do there; where that finds nothing, all are looked at.
//
// Of two rods of a knot no crossing is looked for but those with the knot's own. Each rod of it is
// in one that is found: let it and its partner cross in the box b. They are looked at there, or
// both are of a knot of b; that is near b, so both are found with partners.
template <class Visit>
void BoxSearch::rods_and_rods(const News& news, Visit&& visit) const {
  constexpr double kAll = std::numeric_limits<double>::infinity();
  constexpr Box<2> everywhere{{-kAll, -kAll}, {kAll, kAll}};
  std::vector<Content> stack{all(false)};
  while (!stack.empty()) {
    Content c = std::move(stack.back());
    stack.pop_back();
    if (c.rods.size() < 2 || !has_new_rod(c, news)) continue;
    std::size_t spokes = c.rods.size() <= kFew ? 0 : gather_spokes(c.rods);
    const bool tiny = c.side() <= drawing_.tolerance() / 2;
    const Box<2> near = tiny ? everywhere : widened(c.box);
    const auto look_at = [&](std::uint32_t r, std::uint32_t t) {
      return (r >= news.rod || t >= news.rod) && visit(std::min(r, t), std::max(r, t), near);
    };
    if (c.rods.size() - spokes > kFew) {
      if (const auto knot = find_knot(c.rods)) {
        spokes = gather(*knot, c.rods);
        for (std::size_t i = 0; is_near(*knot, c.box) && i < spokes; ++i) {
          const std::uint32_t r = c.rods[i].rod, t = partner(*knot, r);
          if (r >= news.rod || t >= news.rod) visit(std::min(r, t), std::max(r, t), everywhere);
        }
      }
    }
    const std::size_t others = c.rods.size() - spokes;
    const auto all_pairs = [&](std::size_t most) {
      bool found = false;
      for (std::size_t i = spokes; i < spokes + most; ++i) {
        for (std::size_t j = 0; j < i; ++j) found |= look_at(c.rods[i].rod, c.rods[j].rod);
      }
      return found;
    };
    if (others <= kFew) {
      all_pairs(others);
    } else if (tiny) {
      if (!all_pairs(1)) all_pairs(others);
    } else if (const auto wires = cable(c); !wires.empty()) {
      for (std::size_t i = 0; i < wires.size(); ++i) {
        for (std::size_t j = i + 1; j < wires.size() && wires[j].lo <= wires[i].hi; ++j) {
          look_at(wires[i].rod, wires[j].rod);
        }
      }
    } else {
      for (Content& half : halves(c)) stack.push_back(std::move(half));
    }
  }
}

}  // namespace mesher::detail
