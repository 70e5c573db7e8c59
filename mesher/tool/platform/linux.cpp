// Linux, on any processor. That freed memory stays is a matter of the C library: glibc can be told.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string_view>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "process.hpp"

namespace tool::platform {
namespace {

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};

void (*handle)() = nullptr;  // set before there is a signal that calls it

constexpr std::uint64_t kBytesPerUnit = 1024;  // Linux counts in kB

// The number behind a name at the beginning of a line; without a name, the first one. 0: none.
std::uint64_t value_in(const std::string& path, std::string_view name) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line.compare(0, name.size(), name) != 0) continue;
    return std::strtoull(line.c_str() + name.size(), nullptr, 10);
  }
  return 0;
}

// One of the two ways in which Linux bounds the memory of groups of processes.
struct GroupFiles {
  std::string_view folder, limit, used;  // of `used` a name in memory.stat
};
constexpr GroupFiles kGroups{"/sys/fs/cgroup", "/memory.max", "anon "};
constexpr GroupFiles kFirstGroups{"/sys/fs/cgroup/memory", "/memory.limit_in_bytes", "total_rss "};
constexpr std::uint64_t kNoBound = ~std::uint64_t{0};

// What is left to a group, without what the system can drop.
std::uint64_t free_in_group(const std::string& folder, const GroupFiles& files) {
  const std::uint64_t most = value_in(folder + std::string(files.limit), "");  // "max": 0
  if (most == 0) return kNoBound;
  const std::uint64_t used = value_in(folder + "/memory.stat", files.used);
  return most > used ? most - used : 1;
}

// The least of a group and those that it is in.
std::uint64_t free_in_groups(std::string group, const GroupFiles& files) {
  std::uint64_t least = kNoBound;
  while (true) {
    least = std::min(least, free_in_group(std::string(files.folder) + group, files));
    const std::size_t end = group.rfind('/');
    if (end == std::string::npos) return least;
    group.erase(end);
  }
}

// Of all groups that this process is in: lines NUMBER:WHAT IS BOUNDED:GROUP.
std::uint64_t free_in_groups() {
  std::uint64_t least = kNoBound;
  std::ifstream file("/proc/self/cgroup");
  for (std::string line; std::getline(file, line);) {
    const std::size_t what = line.find(':') + 1, group = line.find(':', what) + 1;
    if (what == 0 || group == 0) continue;
    const std::string bounded = "," + line.substr(what, group - 1 - what) + ",";
    const bool is_first = bounded.find(",memory,") != std::string::npos;
    if (!is_first && bounded != ",,") continue;
    least = std::min(least, free_in_groups(line.substr(group), is_first ? kFirstGroups : kGroups));
  }
  return least;
}

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
  struct rusage usage {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * kBytesPerUnit;
}

std::uint64_t free_memory_bytes() noexcept {
  try {
    const std::uint64_t all =
        value_in("/proc/meminfo", "MemAvailable:") + value_in("/proc/meminfo", "SwapFree:");
    return std::min(all * kBytesPerUnit, free_in_groups());
  } catch (...) {
    return 0;
  }
}

// A sanitizer's tables are larger than any memory.
void bound_memory([[maybe_unused]] std::uint64_t bytes) noexcept {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  struct rlimit limit {};
  if (getrlimit(RLIMIT_DATA, &limit) != 0 || limit.rlim_cur <= bytes) return;
  limit.rlim_cur = bytes;
  setrlimit(RLIMIT_DATA, &limit);
#endif
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
