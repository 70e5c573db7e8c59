// Stopping by signal without leaving files behind.
#include "cancel.hpp"

#include <csignal>

#include "mesher/error.hpp"
#include "platform/process.hpp"

namespace tool {
namespace {

// Changed only while the signals wait, so that the handler finds it whole; never destroyed, so that
// it does while the process ends as well.
std::vector<std::string>& doomed() {
  static auto* const paths = new std::vector<std::string>;
  return *paths;
}

volatile std::sig_atomic_t polite = 0;     // above 0: interrupts are noted
volatile std::sig_atomic_t was_asked = 0;  // one was

// Calls only what is safe in a signal handler.
void stop() {
  if (polite != 0 && was_asked == 0) {
    was_asked = 1;
    return;
  }
  for (const auto& path : doomed()) platform::remove_at_once(path.c_str());
  platform::end_at_once(kStopped, static_cast<int>(mesher::ExitCode::cancelled));
}

}  // namespace

void catch_interrupts() {
  doomed();  // made before a handler can ask for it
  platform::catch_interrupts(stop);
}

void set_doomed(std::vector<std::string> paths) {
  const HoldInterrupts hold;
  doomed() = std::move(paths);
}

bool interrupted() noexcept { return was_asked != 0; }

void require_uninterrupted() {
  if (interrupted()) throw mesher::Error(mesher::ErrorCode::cancelled, kStopped);
}

StopPolitely::StopPolitely() { polite = polite + 1; }
StopPolitely::~StopPolitely() { polite = polite - 1; }

HoldInterrupts::HoldInterrupts() : before_(platform::hold_interrupts()) {}
HoldInterrupts::~HoldInterrupts() { platform::restore_interrupts(before_); }

}  // namespace tool
