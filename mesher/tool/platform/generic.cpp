// Any system, in standard C++. What removes and writes at an interrupt is not promised to be safe
// there, but is on the systems that we know.
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "process.hpp"

namespace tool::platform {
namespace {

constexpr int kSignals[] = {SIGINT, SIGTERM};

void (*handle)() = nullptr;  // set before there is a signal that calls it
volatile std::sig_atomic_t held = 0;
volatile std::sig_atomic_t waits = 0;  // one has come meanwhile

// Some systems forget a handler when they call it.
void on_signal(int signal) {
  std::signal(signal, on_signal);
  if (held != 0) {
    waits = 1;
  } else {
    handle();
  }
}

}  // namespace

void catch_interrupts(void (*handler)()) {
  handle = handler;
  for (const int signal : kSignals) {
    if (std::signal(signal, on_signal) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

unsigned hold_interrupts() noexcept {
  const unsigned before = held != 0 ? 1 : 0;
  held = 1;
  return before;
}

void restore_interrupts(unsigned before) noexcept {
  held = static_cast<std::sig_atomic_t>(before);
  if (held != 0 || waits == 0) return;
  waits = 0;
  handle();
}

void remove_at_once(const char* path) noexcept { std::remove(path); }

void end_at_once(const char* line, int exit_code) noexcept {
  std::fprintf(stderr, "%s\n", line);
  std::_Exit(exit_code);
}

void return_failures_of_writes() noexcept {}

bool shows_errors_to_people() noexcept { return false; }

std::uint64_t peak_memory_bytes() noexcept { return 0; }

std::uint64_t free_memory_bytes() noexcept { return 0; }

void bound_memory(std::uint64_t) noexcept {}

void keep_freed_memory() noexcept {}

std::FILE* open_to_append(const std::string& path) noexcept {
  std::FILE* const file = std::fopen(path.c_str(), "a+b");
  if (file != nullptr) std::setvbuf(file, nullptr, _IONBF, 0);
  return file;
}

std::FILE* create_private(const std::string& path) noexcept {
  return std::fopen(path.c_str(), "wxb");
}

std::uint64_t parent_number() noexcept { return 0; }

bool lock(std::FILE*) noexcept { return true; }

int sync(std::FILE* file) noexcept { return std::fflush(file) == 0 ? 0 : errno; }

void sync_folder_of(const std::string&) noexcept {}

int shorten(std::FILE*, const std::string& path, std::uint64_t bytes) noexcept {
  std::error_code error;
  std::filesystem::resize_file(path, bytes, error);
  return error.value();
}

}  // namespace tool::platform
