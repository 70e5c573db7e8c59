// Processes of which one loses a message of a tile to another process, or says something else.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "tiles/message_bytes.hpp"
#include "tiles/peers.hpp"

namespace support {

enum class Wrong : std::uint8_t { lost, another };

/// D: of the mesh. Tiles' messages follow an agreement on four numbers: whether a process has
/// failed, and what comes next (TiledMesher::agree_on_next).
template <int D>
class LossyPeers final : public mesher::detail::Peers {
 public:
  using Bytes = mesher::detail::Bytes;

  /// `which`: the number of the message, among those to other processes.
  LossyPeers(std::unique_ptr<Peers> peers, std::size_t which, Wrong wrong)
      : peers_(std::move(peers)), which_(which), wrong_(wrong) {
    make_room(peers_->size());
  }
  void set_lossy(bool is_lossy) noexcept { is_lossy_ = is_lossy; }
  [[nodiscard]] std::size_t messages() const noexcept { return messages_; }

  [[nodiscard]] std::size_t size() const noexcept override { return peers_->size(); }
  [[nodiscard]] std::size_t self() const noexcept override { return peers_->self(); }
  void least(Values values) noexcept override {
    is_of_tiles_ = values.size() == 4;
    peers_->least(values);
  }
  void sum(Values values) noexcept override { peers_->sum(values); }
  [[nodiscard]] std::vector<Bytes> exchange(const Views& out) override {
    if (!is_lossy_ || !is_of_tiles_ || out[0].data() == out[1].data()) return peers_->exchange(out);
    std::vector<mesher::detail::Packer> packed(out.size());
    Views views;
    for (std::size_t k = 0; k < out.size(); ++k) views.push_back(changed(out[k], packed[k]));
    return peers_->exchange(views);
  }

 private:
  using Message = mesher::detail::Message<D>;

  std::span<const std::byte> changed(std::span<const std::byte> bytes, mesher::detail::Packer& to) {
    for (mesher::detail::Unpacker rest(bytes); !rest.is_empty();) {
      auto [from, m] = mesher::detail::unpack_message<D>(rest, {});
      const bool is_it = messages_++ == which_;
      if (is_it && wrong_ == Wrong::lost) continue;
      if (is_it) make_another(m);
      mesher::detail::pack<D>(from, m, {}, to);
    }
    return to.bytes();
  }
  static void make_another(Message& m) {
    const bool is_look = m.kind == Message::Kind::ask || m.kind == Message::Kind::end;
    if (is_look && m.look.radius > 0) {
      m.look.radius /= 2;
    } else {
      ++(is_look ? m.look.turn : m.birth.turn).order;
    }
  }

  std::unique_ptr<Peers> peers_;
  std::size_t which_;
  Wrong wrong_;
  std::size_t messages_ = 0;
  bool is_lossy_ = false;
  bool is_of_tiles_ = false;  // the next exchange
};

}  // namespace support
