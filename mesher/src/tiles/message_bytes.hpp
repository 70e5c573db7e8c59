// What tiles tell each other, as bytes.
#pragma once

#include <cstdint>
#include <utility>

#include "borders/whole_input.hpp"
#include "space/placed.hpp"
#include "tiles/feature_numbers.hpp"
#include "tiles/parcel.hpp"
#include "tiles/tile_mesher.hpp"

namespace mesher::detail {

template <int D>
void pack(const Turn<D>& turn, Packer& to) {
  to.put(turn.stage), to.put(turn.rank), to.put(turn.order), to.put(turn.p);
}
template <int D>
[[nodiscard]] Turn<D> unpack_turn(Unpacker& bytes) {
  Turn<D> turn;
  turn.stage = bytes.take<Stage>();
  turn.rank = bytes.take<std::uint32_t>();
  turn.order = bytes.take<std::uint64_t>();
  turn.p = bytes.take<Point<D>>();
  return turn;
}

/// A role by other names of features: by rename(numbers, name), of lines and of polygons, if there
/// are several processes.
template <int D, class Rename>
[[nodiscard]] Role renamed(Role role, const WholeInput<D>& whole, Rename&& rename) {
  if (role.on == 0 || whole.lines == nullptr) return role;
  if (D == 3 && polygon_of(role) != 0) {
    role.on = rename(*whole.polygons, polygon_of(role)) | kOnPolygon;
  } else {
    role.on = rename(*whole.lines, role.on);
  }
  return role;
}
/// By the numbers of features; by this process's handles.
template <int D>
[[nodiscard]] Role numbered(const Role& role, const WholeInput<D>& whole) {
  return renamed(role, whole, [](const FeatureNumbers& n, std::uint32_t h) { return n.of(h); });
}
template <int D>
[[nodiscard]] Role with_handle(const Role& role, const WholeInput<D>& whole) {
  return renamed(role, whole,
                 [](const FeatureNumbers& n, std::uint32_t number) { return n.handle(number); });
}

/// A place on a feature, which is named by its number among all processes', not by a handle.
template <int D>
void pack(const Role& role, const WholeInput<D>& whole, Packer& to) {
  to.put(numbered(role, whole).on);
  if (role.on != 0) to.put(role.label);
}
template <int D>
[[nodiscard]] Role unpack_role(Unpacker& bytes, const WholeInput<D>& whole) {
  Role role;
  role.on = bytes.take<SegmentHandle>();
  if (role.on == 0) return role;
  role.label = bytes.take<Label>();
  return with_handle(role, whole);
}

/// A message of the tile `from`. As many bytes as it needs: those of one kind have no other's
/// parts.
template <int D>
void pack(std::uint32_t from, const Message<D>& m, const WholeInput<D>& whole, Packer& to) {
  using Kind = typename Message<D>::Kind;
  to.put(from), to.put(m.to), to.put(m.kind);
  pack(m.turn(), to);
  switch (m.kind) {
    case Kind::ask:
    case Kind::end:
      to.put(m.look.p), to.put(m.look.radius);
      break;
    case Kind::arrive:
    case Kind::depart:
      to.put(m.birth.p), to.put(std::int32_t{m.birth.bucket});
      if (whole.lines == nullptr) break;
      to.put(m.birth.asks_nearest);
      pack(m.birth.role, whole, to);
      break;
    case Kind::cut:
    case Kind::uncut:
      to.put(whole.lines->of(m.cut.piece.segment));
      to.put(m.cut.piece.lo), to.put(m.cut.piece.hi), to.put(m.cut.piece.kind);
      to.put(std::int32_t{m.cut.bucket});
      break;
    case Kind::split:
    case Kind::unsplit:
      to.put(m.slivers.p), to.put(std::int32_t{m.slivers.bucket});
      break;
  }
}
template <int D>
[[nodiscard]] std::pair<std::uint32_t, Message<D>> unpack_message(Unpacker& bytes,
                                                                  const WholeInput<D>& whole) {
  using Kind = typename Message<D>::Kind;
  const auto from = bytes.take<std::uint32_t>();
  Message<D> m{};
  m.to = bytes.take<std::uint32_t>();
  m.kind = bytes.take<Kind>();
  const auto turn = unpack_turn<D>(bytes);
  switch (m.kind) {
    case Kind::ask:
    case Kind::end:
      m.look.p = bytes.take<Point<D>>(), m.look.radius = bytes.take<double>();
      m.look.turn = turn;
      break;
    case Kind::arrive:
    case Kind::depart:
      m.birth.p = bytes.take<Point<D>>(), m.birth.bucket = bytes.take<std::int32_t>();
      m.birth.turn = turn;
      if (whole.lines == nullptr) break;
      m.birth.asks_nearest = bytes.take<bool>();
      m.birth.role = unpack_role(bytes, whole);
      break;
    case Kind::cut:
    case Kind::uncut:
      m.cut.piece.segment = whole.lines->handle(bytes.take<SegmentHandle>());
      m.cut.piece.lo = bytes.take<Label>(), m.cut.piece.hi = bytes.take<Label>();
      m.cut.piece.kind = bytes.take<PieceKind>();
      m.cut.bucket = bytes.take<std::int32_t>();
      m.cut.turn = turn;
      break;
    case Kind::split:
    case Kind::unsplit:
      m.slivers.p = bytes.take<Point<D>>(), m.slivers.bucket = bytes.take<std::int32_t>();
      m.slivers.turn = turn;
      break;
  }
  return {from, m};
}

}  // namespace mesher::detail
