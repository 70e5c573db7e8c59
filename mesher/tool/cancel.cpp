// Stopping by signal without leaving files behind.
#include "cancel.hpp"

#include <unistd.h>

#include "mesher/error.hpp"

namespace tool {
namespace {

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};

// Changed only while the signals wait, so that the handler finds it whole; never destroyed, so that
// it does while the process ends as well.
std::vector<std::string>& doomed() {
  static auto* const paths = new std::vector<std::string>;
  return *paths;
}

volatile std::sig_atomic_t polite = 0;     // interrupts are noted
volatile std::sig_atomic_t was_asked = 0;  // one was

// Calls only what is safe in a signal handler.
void stop(int) {
  if (polite != 0 && was_asked == 0) {
    was_asked = 1;
    return;
  }
  for (const auto& path : doomed()) ::unlink(path.c_str());
  [[maybe_unused]] auto written = ::write(STDERR_FILENO, kStopped, sizeof kStopped - 1);
  written = ::write(STDERR_FILENO, "\n", 1);
  ::_exit(static_cast<int>(mesher::ExitCode::cancelled));
}

sigset_t interrupts() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : kSignals) sigaddset(&set, signal);
  return set;
}

}  // namespace

void catch_interrupts() {
  doomed();  // made before a handler can ask for it
  struct sigaction action {};
  action.sa_handler = stop;
  action.sa_mask = interrupts();
  action.sa_flags = SA_RESTART;  // what is being written when it returns is written on
  for (const int signal : kSignals) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
}

void set_doomed(std::vector<std::string> paths) {
  const HoldInterrupts hold;
  doomed() = std::move(paths);
}

bool interrupted() noexcept { return was_asked != 0; }

void require_uninterrupted() {
  if (interrupted()) throw mesher::Error(mesher::ErrorCode::cancelled, kStopped);
}

StopPolitely::StopPolitely() { polite = 1; }
StopPolitely::~StopPolitely() { polite = 0; }

HoldInterrupts::HoldInterrupts() {
  const sigset_t set = interrupts();
  sigprocmask(SIG_BLOCK, &set, &before_);
}

HoldInterrupts::~HoldInterrupts() { sigprocmask(SIG_SETMASK, &before_, nullptr); }

}  // namespace tool
