// Events: an engine reports its actions to an observer while they happen.
#pragma once

#include <cstdint>

#include "sac/trace.hpp"

namespace sac {

/// An action of an engine.
struct Event {
  enum class Kind : std::uint8_t {
    run_started,
    propagation_started,
    roll_back_started,  // client code threw: the run or propagation is undone
    finished,           // the run or propagation ended, failed or not
    edited,             // the input `source` was set to another value from outside
    changed,            // `call` gave `source` another value
    reverted,           // a value that `call` gave `source` was undone
    invalidated,        // an observation of `call` may have changed: if so, it runs again
    returned,           // the result of `by` changed, on which `call` depends
    executed,           // the body of `call` runs
    confirmed,          // `call` would read the same values as before: it does not run again
    failed,             // the body of `call` threw, or client code that compares its values
    reused,             // `by` requested `call`, which already existed
    created,            // `call` is new in the trace
    posted,             // `by` posts `call` on an agenda
    unposted,           // `by` no longer posts it
    dying,              // no call posts `call`: it is discarded now, its children before it
    detached,           // the drain that ran `call` left the trace: it waits for another
    discarded,          // `call` leaves the trace
  };
  static constexpr std::size_t kKinds = static_cast<std::size_t>(Kind::discarded) + 1;

  Kind kind;
  const Call* call = nullptr;
  ModRef source{};                // a modifiable; null: none, or another structure
  const Edge* seen = nullptr;     // of invalidated: the observation, if the structure named it
  const char* message = nullptr;  // of failed and roll_back_started: the exception's message
  const Call* by = nullptr;       // the running call, or the poster; null: the outside
};

/// Receives the events of an engine (Engine::set_observer). Calls and edges are valid during on().
class Observer {
 public:
  virtual void on(const Event& event) noexcept = 0;

 protected:
  ~Observer() = default;
};

}  // namespace sac
