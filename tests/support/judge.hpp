// The engine's contract, told by a plain run: which runs must be refused. sac::PlainScope does what
// a program says; the judge sees what a traced run would not have accepted.
//
// (1) An agenda is drained once, and nothing is posted behind its drain.
// (2) While it is drained, what a posted call posts comes behind that call in the agenda's order.
// (3) A label has one key, and equals itself.
// (4) What fails in a call fails the run, whether caught or not; but for what a body throws and
//     catches itself.
// (5) Traced functions do not use the client's side of the engine.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "sac/sac.hpp"

namespace support {

/// What an agenda tells posted calls apart by; functions have ranks of their own.
struct PostedLabel {
  int function;
  int a;
  int b;
  friend auto operator<=>(const PostedLabel&, const PostedLabel&) = default;
};

class Judge {
 public:
  [[nodiscard]] bool refused() const { return refused_; }

  /// Throws: UsageError, as the engine would.
  [[noreturn]] void refuse() {
    refused_ = true;
    throw sac::UsageError("refused");
  }
  /// What was refused was caught: the run fails all the same.
  void resent() { refused_ = true; }

  void post(std::size_t agenda, const PostedLabel& label, const sac::Key& key) {
    Queue& queue = at(agenda);
    const Place place{sac::KeyWidths().rank(key), key.order, label};
    if (queue.drained || (queue.running && !(*queue.running < place))) refuse();
    const auto [known, fresh] = queue.keys.emplace(label, place);
    if (!fresh && known->second != place) refuse();
  }
  void begin_drain(std::size_t agenda) {
    if (at(agenda).draining || at(agenda).drained) refuse();
    at(agenda).draining = true;
  }
  void end_drain(std::size_t agenda) {
    at(agenda).drained = true;
    at(agenda).running.reset();
  }
  /// A posted call starts.
  void run(std::size_t agenda, const PostedLabel& label) {
    at(agenda).running = at(agenda).keys.at(label);
  }

 private:
  struct Place {
    std::uint32_t rank;
    std::uint64_t order;
    PostedLabel label;
    friend auto operator<=>(const Place&, const Place&) = default;
  };
  struct Queue {
    std::map<PostedLabel, Place> keys;
    std::optional<Place> running;
    bool draining = false;
    bool drained = false;
  };

  Queue& at(std::size_t agenda) {
    if (queues_.size() <= agenda) queues_.resize(agenda + 1);
    return queues_[agenda];
  }

  std::vector<Queue> queues_;
  bool refused_ = false;
};

}  // namespace support
