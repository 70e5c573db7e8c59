// Parts of the families of complexes, added to a complex under construction.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "graph/plc_builder.hpp"
#include "mesher/extra/generate.hpp"

namespace mesher::plc_parts {

using Builder = detail::PlcBuilder;
using Places = Builder::Places;

inline constexpr Box<3> kUnit{{0, 0, 0}, {1, 1, 1}};

/// A rectangle across an axis at `x`: of the two axes behind it, cyclically.
[[nodiscard]] Places rectangle(int axis, double x, const Point<2>& lo, const Point<2>& hi);
/// Across z.
[[nodiscard]] Places square(double z, double middle, double side);
/// A unit square that stands on the y axis, turned about it.
[[nodiscard]] Places page(double degrees);

/// A side of a box: across an axis, the upper one or not.
using Side = std::pair<int, bool>;
/// The sides of a box, some with holes, without those `left_out`.
void add_box(Builder& b, const Box<3>& box, const std::map<Side, Places>& holes = {},
             const std::vector<Side>& left_out = {});

/// Two cubes with a tube between them.
void add_dumbbell(Builder& b, double width);
void add_spike(Builder& b, double degrees);
void add_vee(Builder& b, double degrees);
void add_leaning(Builder& b, double degrees);
void add_tetrahedron(Builder& b, double height);
void add_cloud(Builder& b, std::size_t n, SplitMix64 random);
/// A prism of n sides with a bore, and a stub on one side, which is across x. Closed.
void add_pump(Builder& b, std::size_t n);
/// Squares in random planes, each well apart from those that are there, by the balls around them;
/// fewer than n where there is no room.
void add_faults(Builder& b, std::size_t n, SplitMix64 random);
/// Five courses of four bricks, every other one shifted by half a brick.
void add_bricks(Builder& b, double joint);
/// A floor that declares the line on which a wall stands.
void add_tee(Builder& b, double height);
/// Around 0.
void add_icosahedron(Builder& b, double radius);

}  // namespace mesher::plc_parts
