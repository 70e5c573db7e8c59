// Points of the input that are divided among processes: each has those in its territories.
//
// How crowded a point is depends on points of others only beside the border. What crowds it there
// is asked for, and known from then on: a *ghost*. All functions are of all processes (peers.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "facade/edits.hpp"
#include "index/feature_tree.hpp"
#include "sets/make_set.hpp"
#include "tiles/tiled_mesher.hpp"

namespace mesher::detail {

template <int D>
struct NamedPlace {
  PointId id{};
  Point<D> p{};
  friend auto operator<=>(const NamedPlace&, const NamedPlace&) = default;
};

/// Some of the places where points shall be, for cuts between so many tiles: of equal shares
/// together a sample.
template <int D>
[[nodiscard]] std::vector<Point<D>> sample_of_all(const PointEdits<D>& share, std::size_t tiles,
                                                  Peers& peers);

/// Of the edits of all processes those of points that come to territories of this one, in order.
template <int D>
[[nodiscard]] PointEdits<D> arrivals_here(const PointEdits<D>& share, const MeshBox<D>& box,
                                          const TiledMesher<D>& tiles, Peers& peers);

/// The edits of all processes. Each is of one.
template <int D>
[[nodiscard]] Pending<D> edits_of_all(const PointEdits<D>& share, const MeshBox<D>& box,
                                      Peers& peers);

/// Points that come where others are.
template <int D>
class Clashes {
 public:
  explicit Clashes(const MeshBox<D>& box) : box_(box) {}
  void add(const NamedPlace<D>& comes, const NamedPlace<D>& other, bool other_stays);
  /// Throws: Error (duplicate_point, too_close), of the first in the order of edits; in all.
  void require_none(Peers& peers) const;

 private:
  struct Member {  // of one finest cell
    Fixed<D> cell;
    bool stays;
    NamedPlace<D> point;
  };
  [[nodiscard]] static bool is_before(const Member& a, const Member& b);

  const MeshBox<D>& box_;
  std::vector<Member> members_;
};

/// The points of other processes that crowd points of this one more than its own do: of each of
/// `whom`, with levels by those that are known here, one at its deepest level. `named(v)`: the
/// NamedPlace of a vertex.
template <int D, class Named>
[[nodiscard]] std::vector<NamedPlace<D>> crowders_elsewhere(const std::vector<VertexHandle>& whom,
                                                            const VertexPool<D>& points,
                                                            const FeatureTree<D>& features,
                                                            const MeshBox<D>& box,
                                                            const TiledMesher<D>& tiles,
                                                            Peers& peers, Named&& named);

// --- In detail -------------------------------------------------------------------------------

/// What is packed for each process comes to it.
[[nodiscard]] std::vector<Bytes> told_each(const std::vector<Packer>& out, Peers& peers);

/// The 3^D cells of a level around a place.
template <int D>
class BlockAround {
 public:
  BlockAround(const Point<D>& p, int level, const MeshBox<D>& box);
  [[nodiscard]] bool contains(const Point<D>& q) const;
  /// And a bit more.
  [[nodiscard]] Box<D> box() const;

 private:
  const MeshBox<D>& mesh_box_;
  int level_;
  std::array<std::int64_t, D> cell_;  // in the middle, in cells of the level
};

template <int D, class Named>
std::vector<NamedPlace<D>> crowders_elsewhere(const std::vector<VertexHandle>& whom,
                                              const VertexPool<D>& points,
                                              const FeatureTree<D>& features, const MeshBox<D>& box,
                                              const TiledMesher<D>& tiles, Peers& peers,
                                              Named&& named) {
  struct Question {
    Point<D> p;
    std::int64_t level;  // who is in the block there?
  };
  std::vector<Packer> questions, answers;
  together(peers, [&] {
    questions.resize(peers.size()), answers.resize(peers.size());
    for (const VertexHandle h : whom) {
      const Vertex<D>& v = points[h];
      const int level = std::min(v.level + 1, kLevels);
      const Question question{v.p, level};
      tiles.for_each_other_met(BlockAround<D>(v.p, level, box).box(),
                               [&](std::size_t process) { questions[process].put(question); });
    }
  });
  const std::vector<Bytes> asked = told_each(questions, peers);
  together(peers, [&] {
    for (std::size_t k = 0; k < asked.size(); ++k) {
      for (Unpacker rest(asked[k]); !rest.is_empty();) {
        const auto q = rest.template take<Question>();
        const Vertex<D>* there = features.crowder(q.p);
        if (there == nullptr) continue;
        const BlockAround<D> block(q.p, static_cast<int>(q.level), box);
        if (block.contains(there->p)) answers[k].put(named(*there));
      }
    }
  });
  const std::vector<Bytes> told = told_each(answers, peers);
  std::vector<NamedPlace<D>> found;
  together(peers, [&] {
    for (const Bytes& some : told) {
      for (Unpacker rest(some); !rest.is_empty();) {
        found.push_back(rest.template take<NamedPlace<D>>());
      }
    }
    make_set(found);
  });
  return found;
}

}  // namespace mesher::detail
