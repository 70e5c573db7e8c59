// What an engine does, told while it does it.
#pragma once

#include <cstdint>

#include "sac/trace.hpp"

namespace sac {

struct Event {
  enum class Kind : std::uint8_t {
    run_started,
    propagation_started,
    roll_back_started,  // client code threw: what was done is taken back
    finished,           // the run or propagation, failed or not
    edited,             // the outside gave the input `source` another value
    changed,            // `call` gave `source` another value
    reverted,           // a value that `call` gave `source` was taken back
    invalidated,        // what `call` saw may have changed: it will run again if so
    returned,           // the result of `by` changed, which `call` depends on
    executed,           // the body of `call` runs
    confirmed,          // what `call` would read is what it has read: it does not run again
    failed,             // the body of `call` threw, or client code that compares what it read
    reused,             // `by` asked for `call`, which was there
    created,            // `call` is new in the trace
    posted,             // `by` asks an agenda for `call`
    unposted,           // `by` does so no longer
    dying,              // nobody posts `call`: it is discarded now, its children before it
    detached,           // the drain that ran `call` is gone: it waits for another
    discarded,          // `call` leaves the trace
  };
  static constexpr std::size_t kKinds = static_cast<std::size_t>(Kind::discarded) + 1;

  Kind kind;
  const Call* call = nullptr;
  Handle source = 0;              // modifiable; 0: none, or something else than a modifiable
  const Edge* seen = nullptr;     // of invalidated: the observation, if the structure said which
  const char* message = nullptr;  // of failed and roll_back_started: what the exception says
  const Call* by = nullptr;       // the running call, or the poster; null: the outside
};

/// Gets an engine's events (Engine::set_observer). Calls and edges are good while it is told.
class Observer {
 public:
  virtual void on(const Event& event) noexcept = 0;

 protected:
  ~Observer() = default;
};

}  // namespace sac
