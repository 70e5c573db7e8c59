// Windows. Interrupts come in a thread of their own: to hold them is to have a lock.
#define WIN32_LEAN_AND_MEAN
#define NOMINMAX
#include <windows.h>
// After it:
#include <io.h>
#include <psapi.h>

#include <cerrno>
#include <cstring>
#include <mutex>

#include "process.hpp"

namespace tool::platform {
namespace {

void (*handle)() = nullptr;  // set before there is an event that calls it

// Never destroyed: an event may come while the process ends.
std::recursive_mutex& interrupts() {
  static auto* const mutex = new std::recursive_mutex;
  return *mutex;
}

BOOL WINAPI on_event(DWORD) {
  const std::lock_guard lock(interrupts());
  handle();
  return TRUE;
}

}  // namespace

void catch_interrupts(void (*handler)()) {
  handle = handler;
  interrupts();
  SetConsoleCtrlHandler(on_event, TRUE);
}

unsigned hold_interrupts() noexcept {
  interrupts().lock();
  return 0;
}
void restore_interrupts(unsigned) noexcept { interrupts().unlock(); }

void remove_at_once(const char* path) noexcept { DeleteFileA(path); }

void end_at_once(const char* line, int exit_code) noexcept {
  const HANDLE errors = GetStdHandle(STD_ERROR_HANDLE);
  DWORD written = 0;
  WriteFile(errors, line, static_cast<DWORD>(std::strlen(line)), &written, nullptr);
  WriteFile(errors, "\r\n", 2, &written, nullptr);
  TerminateProcess(GetCurrentProcess(), static_cast<UINT>(exit_code));
  __builtin_unreachable();
}

void return_failures_of_writes() noexcept {}  // they are

bool shows_errors_to_people() noexcept {
  DWORD mode = 0;
  return GetConsoleMode(GetStdHandle(STD_ERROR_HANDLE), &mode) != 0;
}

std::uint64_t peak_memory_bytes() noexcept {
  PROCESS_MEMORY_COUNTERS counters{};
  counters.cb = sizeof counters;
  if (!GetProcessMemoryInfo(GetCurrentProcess(), &counters, sizeof counters)) return 0;
  return counters.PeakWorkingSetSize;
}

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

bool lock(std::FILE* file) noexcept {
  const auto handle_of = reinterpret_cast<HANDLE>(_get_osfhandle(_fileno(file)));
  return LockFile(handle_of, 0, 1U << 30, 1, 0) != 0;  // a byte beyond all: others may read
}

int sync(std::FILE* file) noexcept { return _commit(_fileno(file)) == 0 ? 0 : errno; }

void sync_folder_of(const std::string&) noexcept {}

int shorten(std::FILE* file, const std::string&, std::uint64_t bytes) noexcept {
  return _chsize_s(_fileno(file), static_cast<long long>(bytes));
}

}  // namespace tool::platform
