// Vertices: their records, references to them, and the pool they live in.
//
// A record is identified by its coordinates: every call that inserts a point with these coordinates
// gets this record, so calls about it are recognised again. A record is alive while some call
// produces it; it is freed at the end of an update, so that handles are valid throughout one.
#pragma once

#include <bit>
#include <compare>
#include <cstdint>
#include <memory>
#include <ostream>
#include <utility>
#include <vector>

#include "mesher/mesh.hpp"
#include "records/reach.hpp"
#include "sac/check.hpp"
#include "sac/label.hpp"
#include "sac/presence.hpp"

namespace mesher::detail {

using VertexHandle = std::uint32_t;  // 0: none

template <int D>
struct Vertex {
  Point<D> p{};
  VertexHandle self = 0;          // in a free record: the next free one
  sac::Presence presence;         // the calls that insert it; the outside is not among them
  sac::Handle queries = 0;        // observations centred at it
  Reach<D> reach;                 // no query of it looks beyond
  sac::Ref<sac::Call> locator;    // the call that observes `level`
  VertexHandle next_changed = 0;  // in the list of what has changed since the last update
  std::int16_t level = -1;        // input points: deepest crowded level
  bool alive : 1 = false;
  bool boundary : 1 = false;
  bool input : 1 = false;
  bool committed : 1 = false;  // part of the mesh at the end of the last update,
  VertexKind committed_kind : 2 = VertexKind::steiner;  // as this
  bool changed : 1 = false;                             // listed by next_changed
  bool on_segment : 1 = false;  // stands for a place on a segment: VertexSearch::role
  bool feature : 1 = false;     // among the features as an input point
  bool trial : 1 = false;       // has been asked about, but never was a vertex
  std::uint8_t held : 5 = 0;    // calls of other tiles that are about it; kMostHeld: too many

  static constexpr std::uint8_t kMostHeld = 31;

  [[nodiscard]] VertexKind kind() const noexcept {
    if (boundary) return VertexKind::boundary;
    if (input) return VertexKind::input;
    return on_segment ? VertexKind::segment : VertexKind::steiner;
  }
};

/// An argument of traced functions: equal by identity, ordered by coordinates.
template <int D>
struct VertexRef {
  Vertex<D>* v = nullptr;

  Vertex<D>& operator*() const noexcept { return *v; }
  Vertex<D>* operator->() const noexcept { return v; }
  friend bool operator==(const VertexRef&, const VertexRef&) = default;
  friend std::partial_ordering operator<=>(const VertexRef& a, const VertexRef& b) {
    return a.v->p <=> b.v->p;
  }
  friend std::uint64_t hash_value(const VertexRef& r) noexcept { return r.v->self; }
  friend std::ostream& operator<<(std::ostream& out, const VertexRef& r) {
    const char* separator = "(";
    for (const double x : r.v->p) out << separator << x, separator = " ";
    return out << ')';
  }
  friend void label_bytes(sac::LabelSink& sink, const VertexRef& r) {
    for (const double x : r.v->p) sink.number(std::bit_cast<std::uint64_t>(x));
  }
};

/// Records at fixed addresses, addressed by handles; freed ones are used again.
template <int D>
class VertexPool {
 public:
  VertexPool() { chunks_.push_back(std::make_unique<Vertex<D>[]>(kChunk)); }

  [[nodiscard]] Vertex<D>& operator[](VertexHandle h) const noexcept {
    return chunks_[h / kChunk][h % kChunk];
  }
  /// Throws: std::bad_alloc, and then changes nothing.
  [[nodiscard]] Vertex<D>& create(const Point<D>& p) {
    const VertexHandle h = free_ != 0 ? free_ : fresh();
    free_ = (*this)[h].self;
    Vertex<D>& v = (*this)[h] = Vertex<D>{};
    for (int i = 0; i < D; ++i) v.p[i] = p[i] + 0.0;  // no negative zero: equal places, equal bits
    v.self = h;
    ++size_;
    return v;
  }
  /// Requires: nobody refers to v any more.
  void release(Vertex<D>& v) noexcept {
    const VertexHandle h = v.self;
    v = Vertex<D>{};
    v.self = std::exchange(free_, h);
    --size_;
  }
  /// Calls visit(vertex) for every record in use, in the order of handles.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for_each_in(0, 1, visit);
  }
  /// The same of one of `parts` equal parts of the records.
  template <class Visit>
  void for_each_in(std::size_t part, std::size_t parts, Visit&& visit) const {
    const std::size_t records = next_ - std::size_t{1};
    const auto last = static_cast<VertexHandle>(records * (part + 1) / parts);
    for (auto h = static_cast<VertexHandle>(records * part / parts + 1); h <= last; ++h) {
      if ((*this)[h].self == h) visit((*this)[h]);
    }
  }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// All handles are below.
  [[nodiscard]] VertexHandle end_of_handles() const noexcept { return next_; }
  /// Whether handles are 1 .. size(), and the next record's is the next one.
  [[nodiscard]] bool is_dense() const noexcept { return size_ + 1 == next_; }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return chunks_.size() * kChunk * sizeof(Vertex<D>);
  }
  void check_invariants() const {
    std::size_t used = 0;
    for_each([&](const Vertex<D>&) { ++used; });
    SAC_INVARIANT(used == size_);
    std::size_t free = 0;
    for (VertexHandle h = free_; h != 0; h = (*this)[h].self) {
      SAC_INVARIANT(h < next_ && (*this)[h].self != h && ++free < next_);
    }
    SAC_INVARIANT(used + free == next_ - 1);
  }

 private:
  static constexpr VertexHandle kChunk = 4096;

  // A record that was never in use; its `self` is 0.
  VertexHandle fresh() {
    if (next_ % kChunk == 0) chunks_.push_back(std::make_unique<Vertex<D>[]>(kChunk));
    return next_++;
  }

  std::vector<std::unique_ptr<Vertex<D>[]>> chunks_;
  VertexHandle free_ = 0;
  VertexHandle next_ = 1;
  std::size_t size_ = 0;
};

}  // namespace mesher::detail
