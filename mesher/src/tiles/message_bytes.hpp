// What tiles tell each other, as bytes.
#pragma once

#include <cstdint>
#include <utility>

#include "sac/check.hpp"
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

/// A message of the tile `from`. As many bytes as it needs: those of one kind have no other's
/// parts. Requires: it is not about lines, which several processes do not have.
template <int D>
void pack(std::uint32_t from, const Message<D>& m, Packer& to) {
  using Kind = typename Message<D>::Kind;
  to.put(from), to.put(m.to), to.put(m.kind);
  pack(m.turn(), to);
  if (m.kind == Kind::ask || m.kind == Kind::end) {
    to.put(m.look.p), to.put(m.look.radius);
  } else {
    SAC_EXPECTS(m.kind < Kind::cut && m.birth.role.on == 0);
    to.put(m.birth.p), to.put(std::int32_t{m.birth.bucket});
  }
}
template <int D>
[[nodiscard]] std::pair<std::uint32_t, Message<D>> unpack_message(Unpacker& bytes) {
  using Kind = typename Message<D>::Kind;
  const auto from = bytes.take<std::uint32_t>();
  Message<D> m{};
  m.to = bytes.take<std::uint32_t>();
  m.kind = bytes.take<Kind>();
  const auto turn = unpack_turn<D>(bytes);
  const auto p = bytes.take<Point<D>>();
  if (m.kind == Kind::ask || m.kind == Kind::end) {
    m.look = {p, bytes.take<double>(), turn};
  } else {
    m.birth = {p, bytes.take<std::int32_t>(), turn};
  }
  return {from, m};
}

}  // namespace mesher::detail
