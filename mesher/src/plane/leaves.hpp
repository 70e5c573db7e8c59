// The pieces of segments that are leaves, as a traceable data type.
//
//   begin(s, piece)    from the running call on the piece is a leaf                  (effect)
//   end(s, leaf)       from the running call on it is none: it has been cut          (effect)
//   around(s, x)       the leaves with x in their ball, where x is the place of      (observation)
//                      a vertex to be; in the order of LeafRef
//   around(s, v)       the same for a vertex v on a segment, without that segment's  (observation)
//
// A piece is a leaf for a call that sees its beginning and not its end: two presences. When one
// changes, the answer changes for the calls that see the change, if the other presence does not
// hide it and they queried a position in the ball.
//
// Few answers are recorded, since most queries leave another record (this saves an edge for every
// vertex):
//   - x is inserted iff no leaf's ball has it: its birth is the observation of the empty answer;
//   - the calls that look at the cell of a vertex on a segment are those that ask about it;
//   - x whose answer is not empty is not inserted: such asks are kept in a tree of their own.
// So around(s, v) requires that the running call looks at v's cell, and around(s, x), if the answer
// is empty, that it inserts x.
//
// Two implementations: `Leaves<sac::Scope>` keeps this history, `Leaves<sac::PlainScope>` only the
// leaves.
#pragma once

#include <vector>

#include "index/vertex_index.hpp"
#include "plane/leaf.hpp"
#include "sac/sac.hpp"

namespace mesher::detail {

template <class S>
class Leaves;

template <>
class Leaves<sac::PlainScope> {
 public:
  Leaves(VertexIndex<sac::PlainScope>& vertices, const SegmentPool& segments, sac::PlainScope&)
      : vertices_(vertices), records_(vertices.box(), segments) {}

  /// Whether there has been a leaf.
  [[nodiscard]] bool any() const noexcept { return records_.size() != 0; }
  /// Whether a leaf may be no edge of the mesh (lost_edge.hpp).
  [[nodiscard]] bool may_lose() const noexcept { return records_.overrules(); }

  void begin(sac::PlainScope&, const Piece& piece) { records_.record(piece); }
  void end(sac::PlainScope&, LeafRef leaf) {
    records_.hide(*leaf);
    leaf->changed = true;
  }
  std::vector<LeafRef> around(sac::PlainScope&, const Point<2>& x);
  std::vector<LeafRef> around(sac::PlainScope&, VertexRef<2> v);

  /// Calls visit(leaf) for every leaf.
  template <class Visit>
  void for_each(Visit&& visit) const {
    records_.for_each([&](const Leaf& leaf) {
      if (!leaf.changed) visit(leaf);
    });
  }

 private:
  [[nodiscard]] std::vector<LeafRef> around(const Point<2>& x, const Role& role) const;

  VertexIndex<sac::PlainScope>& vertices_;
  LeafRecords records_;  // of those that were cut: marked as changed
};

template <>
class Leaves<sac::Scope> : public sac::Structure {
 public:
  Leaves(VertexIndex<sac::Scope>& vertices, const SegmentPool& segments, sac::Engine& engine)
      : engine_(engine),
        presences_(engine),
        vertices_(vertices),
        records_(vertices.box(), segments),
        asks_(vertices.box()),
        id_(engine.add_structure(*this)) {}

  [[nodiscard]] bool any() const noexcept { return records_.size() != 0; }
  /// Whether a leaf may be no edge of the mesh (lost_edge.hpp).
  [[nodiscard]] bool may_lose() const noexcept { return records_.overrules(); }

  void begin(sac::Scope& s, const Piece& piece);
  void end(sac::Scope& s, LeafRef leaf);
  std::vector<LeafRef> around(sac::Scope& s, const Point<2>& x);
  std::vector<LeafRef> around(sac::Scope& s, VertexRef<2> v);

  void retract(sac::Call& call, sac::Edge& edge) noexcept override;
  void label(const sac::Call& call, const sac::Edge& edge, sac::LabelSink& sink) const override;
  void print(const sac::Call& call, const sac::Edge& edge, std::ostream& out) const override;

  /// Calls visit(leaf) for every leaf at the end of the trace. Requires: between updates.
  template <class Visit>
  void for_each(Visit&& visit) const {
    records_.for_each([&](const Leaf& leaf) {
      if (is_leaf(leaf)) visit(leaf);
    });
  }
  [[nodiscard]] static bool is_leaf(const Leaf& leaf) noexcept {
    return leaf.begun.there() && !leaf.ended.there();
  }
  /// Calls visit(leaf) for every leaf at the end of the trace with an end at p.
  template <class Visit>
  void for_each_ending_at(const Point<2>& p, Visit&& visit) const {
    records_.for_each_ending_at(p, [&](const Leaf& leaf) {
      if (is_leaf(leaf)) visit(leaf);
    });
  }
  /// Calls visit(leaf) for the records that have changed since the last commit.
  template <class Visit>
  void for_each_changed(Visit&& visit) const {
    for (LeafHandle h = changed_; h != 0; h = records_[h].next_changed) visit(records_[h]);
  }
  /// The record of a piece, to be cut from outside. It is freed at the end of an update if nobody
  /// has made it a leaf, or cut it.
  [[nodiscard]] LeafRef claim(const Piece& piece) {
    Leaf& leaf = records_.record(piece);
    touch(leaf);
    return {&leaf};
  }
  /// Ends an update: frees the records of pieces that nobody makes leaves.
  void commit() noexcept;

  [[nodiscard]] std::size_t bytes() const noexcept { return records_.bytes() + asks_.bytes(); }
  /// Requires: between updates. Throws InvariantError; among others if an answer is not what a
  /// look at all leaves finds. Cost: O(answers x leaves).
  void check_invariants() const override;

 private:
  static constexpr std::uint8_t kBegin = 0;
  static constexpr std::uint8_t kEnd = 1;
  static constexpr std::uint8_t kAsk = 2;

  struct LeafEdge : sac::ProducerEdge {
    LeafHandle leaf;
  };
  struct AskEdge : sac::Edge {
    Point<2> x;
    sac::Ref<sac::Call> call;
    std::uint32_t count : 31;  // of leaves in the answer
    std::uint32_t listed : 1;  // in asks_
  };

  [[nodiscard]] bool is_leaf_for(const Leaf& leaf, const sac::Call& call) const noexcept {
    return presences_.seen_by(leaf.begun, call) && !presences_.seen_by(leaf.ended, call);
  }
  [[nodiscard]] std::vector<LeafRef> answer(sac::Scope& s, const Point<2>& x,
                                            const Role& role) const;
  void touch(Leaf& leaf) noexcept;
  void produce(sac::Scope& s, Leaf& leaf, std::uint8_t kind);
  void record_ask(sac::Scope& s, const Point<2>& x, std::size_t count);
  void changed(const Leaf& leaf, std::uint8_t kind, const sac::Window& window) noexcept;
  template <class Concerned>
  void tell_vertices(const Leaf& leaf, Concerned&& concerned) noexcept;
  template <class Concerned>
  void tell_asks(const Leaf& leaf, Concerned&& concerned) noexcept;
  void check_births() const;

  sac::Engine& engine_;
  sac::Presences presences_;
  VertexIndex<sac::Scope>& vertices_;
  LeafRecords records_;
  ReachTree<sac::Handle> asks_;  // AskEdges
  LeafHandle changed_ = 0;
  std::uint8_t id_;
};

}  // namespace mesher::detail
