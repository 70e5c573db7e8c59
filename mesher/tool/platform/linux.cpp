// Linux, on any processor. That freed memory stays is a matter of the C library: glibc can be told.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "process.hpp"

namespace tool::platform {
namespace {

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};

void (*handle)() = nullptr;  // set before there is a signal that calls it

sigset_t interrupts() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : kSignals) sigaddset(&set, signal);
  return set;
}

}  // namespace

void catch_interrupts(void (*handler)()) {
  handle = handler;
  struct sigaction action {};
  action.sa_handler = [](int) { handle(); };
  action.sa_mask = interrupts();
  action.sa_flags = SA_RESTART;  // what is being written when it returns is written on
  for (const int signal : kSignals) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
}

// A bit for each signal.
unsigned hold_interrupts() noexcept {
  const sigset_t set = interrupts();
  sigset_t before;
  sigprocmask(SIG_BLOCK, &set, &before);
  unsigned held = 0;
  for (const int signal : kSignals) {
    if (sigismember(&before, signal) == 1) held |= 1U << signal;
  }
  return held;
}

void restore_interrupts(unsigned before) noexcept {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : kSignals) {
    if ((before >> signal & 1U) == 0) sigaddset(&set, signal);
  }
  sigprocmask(SIG_UNBLOCK, &set, nullptr);
}

void remove_at_once(const char* path) noexcept { ::unlink(path); }

void end_at_once(const char* line, int exit_code) noexcept {
  [[maybe_unused]] auto written = ::write(STDERR_FILENO, line, std::strlen(line));
  written = ::write(STDERR_FILENO, "\n", 1);
  ::_exit(exit_code);
}

void return_failures_of_writes() noexcept {
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
}

bool shows_errors_to_people() noexcept { return isatty(STDERR_FILENO) != 0; }

std::uint64_t peak_memory_bytes() noexcept {
  constexpr std::uint64_t kBytesPerUnit = 1024;  // Linux counts in kB
  struct rusage usage {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * kBytesPerUnit;
}

void keep_freed_memory() noexcept {
#ifdef __GLIBC__
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
}

std::FILE* open_to_append(const std::string& path) noexcept {
  std::FILE* const file = std::fopen(path.c_str(), "a+be");
  if (file != nullptr) std::setvbuf(file, nullptr, _IONBF, 0);
  return file;
}

std::FILE* create_private(const std::string& path) noexcept {
  const int descriptor =
      ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, S_IRUSR | S_IWUSR);
  if (descriptor < 0) return nullptr;
  std::FILE* const file = ::fdopen(descriptor, "wb");
  if (file == nullptr) ::close(descriptor);
  return file;
}

std::uint64_t parent_number() noexcept { return static_cast<std::uint64_t>(::getppid()); }

bool lock(std::FILE* file) noexcept { return ::flock(::fileno(file), LOCK_EX | LOCK_NB) == 0; }

int sync(std::FILE* file) noexcept { return ::fdatasync(::fileno(file)) == 0 ? 0 : errno; }

void sync_folder_of(const std::string& path) noexcept {
  try {
    const std::string folder = std::filesystem::absolute(path).parent_path().string();
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return;
    ::fsync(descriptor);
    ::close(descriptor);
  } catch (...) {  // then the name may be lost with the power
  }
}

int shorten(std::FILE* file, const std::string&, std::uint64_t bytes) noexcept {
  return ::ftruncate(::fileno(file), static_cast<off_t>(bytes)) == 0 ? 0 : errno;
}

}  // namespace tool::platform
