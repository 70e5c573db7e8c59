// Reserving, committing and the free lists of large blocks.
#include "sac/arena.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <new>

#include "sac/check.hpp"

namespace sac {

namespace {

// 2^32 handles of 8 bytes.
constexpr std::size_t kReserve = (std::size_t{1} << 32) * Arena::kGranule;
// Commit in steps of 2 MiB (one huge page) at least, growing by a 16th.
constexpr std::size_t kStep = std::size_t{2} << 20;

}  // namespace

Arena::Arena() {
  void* range =
      mmap(nullptr, kReserve, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (range == MAP_FAILED) throw std::bad_alloc();
  base_ = static_cast<std::byte*>(range);
}

Arena::~Arena() { munmap(base_, kReserve); }

void Arena::commit(std::size_t bytes) {
  if (bytes <= committed_) return;
  if (bytes > kReserve) throw std::bad_alloc();
  const std::size_t wanted = std::max(bytes, committed_ + committed_ / 16);
  const std::size_t target = std::min(kReserve, (wanted + kStep - 1) / kStep * kStep);
  if (mprotect(base_ + committed_, target - committed_, PROT_READ | PROT_WRITE) != 0) {
    throw std::bad_alloc();
  }
  madvise(base_ + committed_, target - committed_, MADV_HUGEPAGE);  // a hint: failure is harmless
  committed_ = target;
}

Handle Arena::allocate_slowly(std::size_t granules) {
  SAC_EXPECTS(granules > 0);
  if (granules >= kSmall) {
    if (auto it = free_large_.find(granules); it != free_large_.end() && it->second != 0) {
      const Handle head = it->second;
      it->second = *at<Handle>(head);
      used_ += granules;
      return head;
    }
    free_large_.try_emplace(granules, 0);  // so that release_large cannot fail
  }
  commit((next_ + granules) * kGranule);
  const Handle handle = static_cast<Handle>(next_);
  next_ += granules;
  used_ += granules;
  return handle;
}

void Arena::release_large(Handle handle, std::size_t granules) noexcept {
  Handle& head = free_large_.find(granules)->second;
  *at<Handle>(handle) = head;
  head = handle;
}

void Arena::check_invariants() const {
  std::size_t free_granules = 0;
  const auto walk = [&](std::size_t granules, Handle head) {
    for (; head != 0; head = *at<Handle>(head)) {
      SAC_INVARIANT(head + granules <= next_);
      free_granules += granules;
    }
  };
  for (std::size_t granules = 1; granules < kSmall; ++granules) walk(granules, free_[granules]);
  for (const auto& [granules, head] : free_large_) walk(granules, head);
  SAC_INVARIANT(free_granules + used_ + 1 == next_);
  SAC_INVARIANT(next_ * kGranule <= committed_ || next_ == 1);
}

}  // namespace sac
