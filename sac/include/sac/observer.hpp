// What an engine does, told while it does it.
#pragma once

#include <cstdint>

#include "sac/trace.hpp"

namespace sac {

struct Event {
  enum class Kind : std::uint8_t {
    edited,       // the outside changed modifiable `source`
    changed,      // call `by` gave `source` another value, or took one back
    invalidated,  // `call` saw something that changed: it will run again
    executed,     // the body of `call` runs
    reused,       // `by` asked for `call`, which was there
    created,      // `call` is new in the trace
    discarded,    // `call` leaves the trace
    returned,     // the result of `by` changed, which `call` depends on
  };
  Kind kind;
  const Call* call = nullptr;
  Handle source = 0;         // modifiable; 0: none, or something else than a modifiable
  const Call* by = nullptr;  // the running call; null: the outside
};

/// Gets an engine's events (Engine::set_observer). Calls are good while it is told.
class Observer {
 public:
  virtual void on(const Event& event) noexcept = 0;

 protected:
  ~Observer() = default;
};

}  // namespace sac
