// Keeps segments in the plane unions of edges of the Delaunay triangulation that a refinement makes
// [Fig 2.1, 2.7, 2.8; rules A].
//
// A segment is cut into pieces, the leaves of a binary tree that depends on the input alone
// (plane/shells.hpp): so vertices on segments that meet at a small angle come in pairs, at equal
// distances from where they meet. A piece with a vertex in its closed diametral ball is
// *encroached*, and is split; one without is an edge of the triangulation. If no piece is
// encroached, no centre of a triangle is behind one. At angles below double precision labels decide
// (plane/leaf.hpp); an edge that this costs is an error (plane/lost_edge.hpp).
//
// Departures from rules A: nothing is split before points are inserted (A2), since no edit is to be
// local here; and while points are left, new vertices yield to places that their segments have
// in their trees, whether the places above are vertices or not.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "delaunay/kernel.hpp"
#include "plane/exempt.hpp"
#include "program/world.hpp"
#include "refinement/enclosed.hpp"
#include "refinement/subedges.hpp"

namespace mesher::detail {

class PlaneConformity {
 public:
  using Kernel = DelaunayKernel<2, BallLayout<2>>;
  /// The points, and the segments between them.
  using Store = World<sac::PlainScope, 2>;
  /// A place, and its role: none off segments.
  struct Placed {
    Point<2> p{};
    Role role;
  };

  PlaneConformity(Store& store, Kernel& kernel);

  /// What the next place of the kernel is: its role, and the input point's handle, or 0.
  void add_vertex(const Role& role, VertexHandle point) { vertices_.push_back(known(role, point)); }
  /// The same of a vertex that is there. Requires: start() was not called.
  void set_vertex(std::uint32_t v, const Role& role, VertexHandle point) {
    vertices_[v] = known(role, point);
  }
  void drop_vertex() noexcept { vertices_.pop_back(); }
  /// Finds the pieces. Requires: all input points are vertices.
  void start();
  /// Finds what segments enclose, less what holes are in that are not within `near` of segments;
  /// whether that is anything. Requires: as is_outside().
  bool find_regions(std::span<const Point<2>> holes, double near);

  /// Where the centre x of an empty ball goes instead, on a segment; nothing: none is near. By the
  /// input alone: before start(). Cost: O(log L/s), and what is near.
  [[nodiscard]] std::optional<Placed> yield(const Point<2>& x, double radius) const;

  /// A vertex that is needed, and a vertex near it.
  struct Wanted {
    Placed place;
    std::uint32_t beside;
  };
  /// Nothing: all conforms. Throws: Error (too_close: a piece is too short to be split).
  [[nodiscard]] std::optional<Wanted> next();
  /// Throws: Error (too_close: another vertex is there).
  [[noreturn]] void fail_occupied(const Placed& place) const;
  /// Throws: Error (too_many: beyond `most`, with the ids of the lines with most vertices).
  [[noreturn]] void fail_too_many(std::size_t most) const;

  /// Whether a triangle on the left of v -> w stays that is poor by this edge: where segments meet
  /// at a small angle.
  [[nodiscard]] bool keeps(std::uint32_t v, std::uint32_t w) const;

  // --- Of a vertex that is dug
  /// Whether it encroaches on pieces: these are wanted then.
  [[nodiscard]] bool yields_to_edges(std::uint32_t v);
  [[nodiscard]] bool yields(std::uint32_t v) { return yields_to_edges(v); }
  /// Before the hole is filled.
  void before_fill(std::uint32_t v);
  /// Afterwards.
  void after_fill(std::uint32_t v);

  /// Whether no segments enclose s, or it is in a hole. Requires: next() has returned nothing, and
  /// nothing was inserted since; find_regions(). Cost: amortized O(1) for each that was made.
  [[nodiscard]] bool is_outside(std::uint32_t s) {
    return enclosed_.is_outside(s, [&](auto t, auto i) { return is_wall(t, i); });
  }

  [[nodiscard]] const Subedges& pieces() const noexcept { return pieces_; }

 private:
  struct Known {
    Role role;
    VertexHandle point;
    bool on_edge;
  };
  // A vertex on a segment that there was at the start.
  struct Between {
    Role role;
    std::uint32_t v;
  };
  static bool is_before(const Between& x, const Role& role) noexcept {
    return x.role.on != role.on ? x.role.on < role.on : x.role.label < role.label;
  }
  // What a vertex is to a piece.
  enum class Relation : std::uint8_t {
    apart,
    in_ball,
    beside,  // outside of the ball by its label, in it by its rounded place
  };

  [[nodiscard]] Known known(const Role& role, VertexHandle point) const;
  [[nodiscard]] Point<2> place(std::uint32_t v) const noexcept { return kernel_.place(v); }
  [[nodiscard]] PieceRef ref(std::uint32_t piece) const noexcept;
  [[nodiscard]] Halves halves(const PieceRef& piece) const;
  [[nodiscard]] std::optional<Placed> place_near(const Segment& s, double from_a,
                                                 double radius) const;
  [[nodiscard]] Relation relation(std::uint32_t piece, std::uint32_t v);
  [[nodiscard]] Relation relation_to(std::uint32_t piece, std::uint32_t v) const;
  /// Then its ball may hold vertices, so that one outside of it may cost its edge.
  [[nodiscard]] bool is_overruled(std::uint32_t piece) const {
    return piece < overruled_.size() && overruled_[piece];
  }
  [[nodiscard]] std::uint32_t vertex_at(const Role& role) const;
  void look_at_piece(std::uint32_t piece);
  [[nodiscard]] Leaf leaf(std::uint32_t piece) const;
  void require_edge(std::uint32_t piece) const;
  void want_piece(std::uint32_t piece, std::uint32_t by);
  void split_piece(std::uint32_t piece, std::uint32_t at);
  template <class Visit>
  void visit_pieces_dug(Visit&& visit) const;
  [[nodiscard]] bool is_wall(std::uint32_t s, std::uint32_t i) const;

  Store& store_;
  Kernel& kernel_;
  std::vector<Known> vertices_;   // by vertex, from infinity on
  std::vector<Between> between_;  // by segment and label
  Subedges pieces_;
  std::vector<std::uint32_t> wanted_;
  std::uint32_t splitting_ = kNone;    // the piece that next() has split
  std::vector<std::uint32_t> beside_;  // pieces that an insertion may have cost their edges
  std::vector<bool> overruled_;        // by piece: of a vertex beside it, or a part of such a one
  std::vector<std::uint32_t> star_;    // scratch
  Enclosed<2> enclosed_;
};

}  // namespace mesher::detail
