// Vertices and edges of a forest, with the values of those that were contracted into them.
//
// Nothing in here is traced; tree_contraction.hpp is the program.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

#include "sac/label.hpp"

namespace examples::tree_contraction {

inline constexpr int kDegree = 3;  ///< most edges at a vertex

/// The inputs of a vertex: its weight, and its edges by ascending neighbour.
struct Vertex {
  struct Edge {
    int to;
    std::int64_t length;
    friend bool operator==(const Edge&, const Edge&) = default;
    friend void label_bytes(sac::LabelSink& sink, const Edge& e) {
      sac::label_arguments(sink, std::tie(e.to, e.length));
    }
  };
  std::int64_t weight = 0;
  std::vector<Edge> edges;
  friend bool operator==(const Vertex&, const Vertex&) = default;
  friend void label_bytes(sac::LabelSink& sink, const Vertex& v) {
    sac::label_arguments(sink, std::tie(v.weight, v.edges));
  }
};

/// The neighbours of a vertex in the contracted forest: to[0], .. to[degree - 1].
struct Shape {
  int degree = 0;
  std::array<int, kDegree> to{};
  friend bool operator==(const Shape&, const Shape&) = default;
  friend void label_bytes(sac::LabelSink& sink, const Shape& s) {
    sac::label_arguments(sink, std::tie(s.degree, s.to));
  }
};

/// What an edge of the contracted forest stands for, seen from its near end: a path of the forest
/// with all that hangs on its inner vertices.
struct Path {
  std::int64_t length = 0;
  std::int64_t sum = 0;       // weights of the inner vertices
  std::int64_t near = 0;      // greatest distance of an inner vertex from the near end
  std::int64_t far = 0;       // and from the far end
  std::int64_t diameter = 0;  // greatest distance of two inner vertices
  friend bool operator==(const Path&, const Path&) = default;
  friend void label_bytes(sac::LabelSink& sink, const Path& p) {
    sac::label_arguments(sink, std::tie(p.length, p.sum, p.near, p.far, p.diameter));
  }
};

/// What a vertex carries: all that has been raked into it, and the paths to its neighbours.
struct Load {
  std::int64_t sum = 0;
  std::int64_t reach = 0;     // greatest distance from the vertex
  std::int64_t diameter = 0;  // greatest distance of two vertices
  std::array<Path, kDegree> paths;
  friend bool operator==(const Load&, const Load&) = default;
  friend void label_bytes(sac::LabelSink& sink, const Load& l) {
    sac::label_arguments(sink, std::tie(l.sum, l.reach, l.diameter, l.paths));
  }
};

enum class Fate { stays, raked, compressed, last };

/// What has become of a vertex, and into which neighbour it went.
struct Outcome {
  Fate fate = Fate::stays;
  int into = -1;
  friend bool operator==(const Outcome&, const Outcome&) = default;
  friend void label_bytes(sac::LabelSink& sink, const Outcome& o) {
    sac::label_arguments(sink, std::tie(o.fate, o.into));
  }
};

// The leaf at the far end of `path` goes into a vertex.
inline void rake(Load& load, const Path& path, const Load& leaf) {
  load.diameter = std::max({load.diameter, leaf.diameter, path.diameter, load.reach + path.near,
                            leaf.reach + path.far, load.reach + path.length + leaf.reach});
  load.reach = std::max({load.reach, path.near, path.length + leaf.reach});
  load.sum += path.sum + leaf.sum;
}

// `first` to the vertex `middle` and `second` from there on, as one path.
inline Path join(const Path& first, const Load& middle, const Path& second) {
  return {.length = first.length + second.length,
          .sum = first.sum + middle.sum + second.sum,
          .near = std::max({first.near, first.length + middle.reach, first.length + second.near}),
          .far = std::max({second.far, second.length + middle.reach, second.length + first.far}),
          .diameter =
              std::max({first.diameter, middle.diameter, second.diameter, first.far + middle.reach,
                        middle.reach + second.near, first.far + second.near})};
}

}  // namespace examples::tree_contraction
