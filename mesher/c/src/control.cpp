// Progress callbacks, timeouts, and stops by other threads.
#include "control.hpp"

#include <chrono>
#include <cmath>
#include <stop_token>

#include "handles.hpp"
#include "structs.hpp"

namespace lm {
namespace {

using Clock = std::chrono::steady_clock;

struct StopObject final : Object {
  std::stop_source source;
};

Clock::time_point after(Clock::time_point start, double seconds) {
  constexpr double kLongest = 1e9;  // seconds, 30 years: what is longer does not fit into the clock
  return start + std::chrono::duration_cast<Clock::duration>(
                     std::chrono::duration<double>(std::min(seconds, kLongest)));
}

// Whether a run may go on.
class Watch {
 public:
  Watch(const lm_control& control, std::stop_token stop)
      : control_(control),
        stop_(std::move(stop)),
        next_(Clock::now()),
        end_(after(next_, control.timeout)) {}

  bool operator()(const mesher::Progress& progress) {
    if (stop_.stop_requested()) return false;  // and calls nobody back
    const Clock::time_point now = Clock::now();
    if (control_.timeout > 0 && now >= end_) return false;
    if (control_.progress == nullptr || now < next_) return true;
    next_ = after(now, control_.interval);
    const lm_progress seen{sizeof(lm_progress), static_cast<std::int32_t>(progress.phase), 0,
                           progress.done, progress.of};
    return control_.progress(&seen, control_.user) == 0;
  }

 private:
  lm_control control_;
  std::stop_token stop_;
  Clock::time_point next_, end_;
};

}  // namespace

mesher::RunControl control_of(const lm_control* user) {
  if (user == nullptr) return {};
  const lm_control control = read_struct(user, "control");
  if (!(control.timeout >= 0) || !(control.interval >= 0)) {
    throw Failure(LM_BAD_ARGUMENT, "control->timeout and control->interval must be 0 or above");
  }
  mesher::RunControl run;
  if (control.stop != 0) {
    run.stop = Reading<StopObject>(control.stop)->source.get_token();
    if (run.stop.stop_requested()) {
      throw mesher::Error(mesher::ErrorCode::cancelled, "stopped before it began");
    }
  }
  if (control.progress != nullptr || control.timeout > 0) run.progress = Watch(control, run.stop);
  return run;
}

}  // namespace lm

using namespace lm;

lm_status lm_stop_new(lm_handle* stop) {
  return guarded([&] {
    require_pointer(stop, "stop");
    make_object<StopObject>(stop);
  });
}

lm_status lm_stop_request(lm_handle stop) {
  return guarded([&] { Reading<StopObject>(stop)->source.request_stop(); });
}
