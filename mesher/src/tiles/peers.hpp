// The processes that have the tiles of one mesh, and how they agree.
//
// All of them do the same steps. In a step each does its own work, together() or with a Vote, and
// what fails in one of them is thrown in all, when all have come to the end of the step: so they
// take an update back together, and none waits for one that has left.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "tiles/parcel.hpp"

namespace mesher::detail {

/// What is asked of a means of communication. Each function is called by all processes, in the same
/// order, on the thread that runs the update.
class Peers {
 public:
  using Values = std::span<std::uint64_t>;
  using Views = std::vector<std::span<const std::byte>>;

  virtual ~Peers() = default;
  [[nodiscard]] virtual std::size_t size() const noexcept = 0;
  [[nodiscard]] virtual std::size_t self() const noexcept = 0;
  [[nodiscard]] bool is_alone() const noexcept { return size() == 1; }

  /// Each of the values becomes the least that a process has there, or their sum.
  virtual void least(Values values) noexcept = 0;
  virtual void sum(Values values) noexcept = 0;
  /// out[k] goes to process k. Returns: what has come, by process. Requires: out.size() == size().
  /// Throws: std::bad_alloc, in all processes or in none.
  [[nodiscard]] virtual std::vector<Bytes> exchange(const Views& out) = 0;

  /// The same bytes go to all. Throws: likewise.
  [[nodiscard]] std::vector<Bytes> gather(std::span<const std::byte> mine) {
    same_.assign(size(), mine);
    return exchange(same_);
  }

 protected:
  /// The room that gather() needs, so that failures can be told where there is no memory.
  void make_room(std::size_t processes) { same_.reserve(processes); }
  void swap(Peers& other) noexcept { same_.swap(other.same_); }

 private:
  Views same_;
};

/// The only process.
class Alone final : public Peers {
 public:
  Alone() { make_room(1); }
  [[nodiscard]] std::size_t size() const noexcept override { return 1; }
  [[nodiscard]] std::size_t self() const noexcept override { return 0; }
  void least(Values) noexcept override {}
  void sum(Values) noexcept override {}
  [[nodiscard]] std::vector<Bytes> exchange(const Views& out) override {
    return {Bytes(out[0].begin(), out[0].end())};
  }
};

/// Throws in all processes, if it is something in one of them: there itself; in the others an equal
/// Error, sac::Cancelled or std::bad_alloc, or std::runtime_error with its message. Of several,
/// that of the first process; but sac::Cancelled only if that is all. Each of `values` becomes the
/// least, if nothing is thrown.
void agree(Peers& peers, const std::exception_ptr& failure, Peers::Values values = {});

/// Calls act() in each process. Throws: in all what is thrown in one.
template <class Act>
void together(Peers& peers, Act&& act) {
  if (peers.is_alone()) return act();
  std::exception_ptr failure;
  try {
    act();
  } catch (...) {
    failure = std::current_exception();
  }
  agree(peers, failure);
}

/// Of all: throws the error with the least key, in all processes, if there is one in any; or
/// `failure`, as agree(). No key is that of two processes.
template <class Key>
void require_none(Peers& peers, const std::optional<std::pair<Key, Error>>& mine,
                  const std::exception_ptr& failure = nullptr) {
  std::uint64_t is_none = mine ? 0 : 1;
  agree(peers, failure, {&is_none, 1});
  if (is_none != 0) return;
  if (peers.is_alone()) throw Error(mine->second);
  Packer packed;
  together(peers, [&] {
    if (!mine) return;
    packed.put(mine->first);
    pack(mine->second, packed);
  });
  const std::vector<Bytes> told = peers.gather(packed.bytes());
  together(peers, [&] {
    std::optional<std::pair<Key, Error>> first;
    for (const Bytes& one : told) {
      if (one.empty()) continue;
      Unpacker rest(one);
      const auto key = rest.take<Key>();
      if (!first || key < first->first) first.emplace(key, unpack_error(rest));
    }
    throw Error(first->second);
  });
}

}  // namespace mesher::detail
