// Vertices: their records, references to them, and the pool they live in.
//
// A record's identity is its coordinates: whoever inserts a point with these coordinates gets this
// record, so calls about it are recognised again. A record is alive while somebody produces it.
#pragma once

#include <bit>
#include <compare>
#include <cstdint>
#include <memory>
#include <ostream>
#include <vector>

#include "mesher/mesh.hpp"
#include "sac/internal/arena.hpp"
#include "sac/label.hpp"

namespace mesher::detail {

using VertexHandle = std::uint32_t;  // 0: none

template <int D>
struct Vertex {
  Point<D> p{};
  VertexHandle self = 0;
  sac::Handle producers = 0;    // edges of the calls that insert it
  sac::Handle birth = 0;        // the earliest of these calls; 0: the outside
  sac::Handle queries = 0;      // observations centred at it
  float reach = 0;              // no query of it looks farther; in units of the box's side
  sac::Handle locator = 0;      // the call that observes `level`
  std::int16_t level = -1;      // input points: deepest crowded level
  bool alive = false;
  bool boundary = false;
  bool input = false;
  bool committed = false;       // part of the mesh at the end of the last update
  bool touched = false;         // listed as changed since then

  [[nodiscard]] VertexKind kind() const noexcept {
    return boundary ? VertexKind::boundary : input ? VertexKind::input : VertexKind::steiner;
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
  [[nodiscard]] Vertex<D>& create(const Point<D>& p) {
    VertexHandle h;
    if (free_.empty()) {
      if (next_ % kChunk == 0) chunks_.push_back(std::make_unique<Vertex<D>[]>(kChunk));
      h = next_++;
    } else {
      h = free_.back();
      free_.pop_back();
    }
    Vertex<D>& v = (*this)[h] = Vertex<D>{};
    for (int i = 0; i < D; ++i) v.p[i] = p[i] + 0.0;  // no negative zero: equal places, equal bits
    v.self = h;
    return v;
  }
  void release(Vertex<D>& v) {
    const VertexHandle h = v.self;
    v = Vertex<D>{};
    free_.push_back(h);
  }
  /// Calls visit(vertex) for every record in use, in the order of handles.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (VertexHandle h = 1; h < next_; ++h) {
      if ((*this)[h].self == h) visit((*this)[h]);
    }
  }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return chunks_.size() * kChunk * sizeof(Vertex<D>) + free_.capacity() * sizeof(VertexHandle);
  }

 private:
  static constexpr VertexHandle kChunk = 4096;
  std::vector<std::unique_ptr<Vertex<D>[]>> chunks_;
  std::vector<VertexHandle> free_;
  VertexHandle next_ = 1;
};

}  // namespace mesher::detail
