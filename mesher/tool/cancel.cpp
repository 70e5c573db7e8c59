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

// Calls only what is safe in a signal handler.
void stop(int) {
  for (const auto& path : doomed()) ::unlink(path.c_str());
  constexpr char kMessage[] = "error[cancelled]: stopped by a signal, nothing was written\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, kMessage, sizeof kMessage - 1);
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

HoldInterrupts::HoldInterrupts() {
  const sigset_t set = interrupts();
  sigprocmask(SIG_BLOCK, &set, &before_);
}

HoldInterrupts::~HoldInterrupts() { sigprocmask(SIG_SETMASK, &before_, nullptr); }

}  // namespace tool
