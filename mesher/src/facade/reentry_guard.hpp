// Whether an update runs: what its callbacks ask of the same mesher is refused then.
#pragma once

#include "sac/check.hpp"

namespace mesher::detail {

class ReentryGuard {
 public:
  /// Throws: sac::UsageError while an update runs.
  void require_idle() const {
    if (busy_) throw sac::UsageError("the mesher runs: a callback must not use it");
  }

  [[nodiscard]] bool is_idle() const noexcept { return !busy_; }

  /// From its construction to its end an update runs. Requires: none does.
  class Run {
   public:
    explicit Run(ReentryGuard& busy) : busy_(busy) {
      busy.require_idle();
      busy.busy_ = true;
    }
    ~Run() { busy_.busy_ = false; }
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;

   private:
    ReentryGuard& busy_;
  };

 private:
  bool busy_ = false;
};

}  // namespace mesher::detail
