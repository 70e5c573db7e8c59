// Stopping by signal: the process ends with exit code 5 and leaves no temporary file. A watched run
// is requested to stop and unwinds; during other work, and at the second signal, the process ends
// at once.
//
// Signal handlers belong to the process, so this is the only global state of the tool.
#pragma once

#include <string>
#include <vector>

namespace tool {

/// What is said of a command that was stopped.
inline constexpr char kStopped[] = "error[cancelled]: stopped by a signal, nothing was written";

/// From now on an interrupt, a termination or a hang-up removes the doomed files and exits with
/// code 5. A signal that the parent process had ignored stays ignored.
void catch_interrupts();

/// Sets the files that an interrupt removes; they replace those of the last call.
void set_doomed(std::vector<std::string> paths);

/// While it lives, a first interrupt does no more than make interrupted() true.
class StopPolitely {
 public:
  StopPolitely();
  ~StopPolitely();
  StopPolitely(const StopPolitely&) = delete;
  StopPolitely& operator=(const StopPolitely&) = delete;
};

/// Whether an interrupt has come while it was only to be noted.
[[nodiscard]] bool interrupted() noexcept;
/// Throws: Error(cancelled) if so.
void require_uninterrupted();

/// While it lives, interrupts wait.
class HoldInterrupts {
 public:
  HoldInterrupts();
  ~HoldInterrupts();
  HoldInterrupts(const HoldInterrupts&) = delete;
  HoldInterrupts& operator=(const HoldInterrupts&) = delete;

 private:
  unsigned before_;
};

}  // namespace tool
