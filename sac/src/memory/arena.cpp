// Reserving, committing, the free lists of large blocks, and giving pages back.
#include "sac/arena.hpp"

#include <algorithm>
#include <new>

#include "sac/check.hpp"
#include "sac/huge_pages.hpp"
#include "sac/internal/platform.hpp"

namespace sac {

namespace {

// Commit in steps of 2 MiB (one huge page) at least, growing by a 16th. The first steps do without
// huge pages: a small engine touches a few small ones.
constexpr std::size_t kStep = std::size_t{2} << 20;
constexpr std::size_t kHugeFrom = 4 * kStep;
constexpr std::size_t kHeaderGranules =
    (sizeof(Arena::Header) + Arena::kGranule - 1) / Arena::kGranule;

}  // namespace

void advise_huge_pages(void* block, std::size_t bytes) noexcept {
  platform::advise_huge_pages(block, bytes);
}

Arena::Arena() : next_(kHeaderGranules) {
  reserve();
  try {
    commit(sizeof(Header));
  } catch (...) {
    platform::release(base_, reserved_, kReserve);
    throw;
  }
  ::new (static_cast<void*>(base_)) Header;
}

void Arena::reserve() {
  constexpr std::size_t kLeast = std::size_t{64} << 20;
  for (reserved_ = kReserve; reserved_ >= kLeast; reserved_ /= 2) {
    base_ = static_cast<std::byte*>(platform::reserve(reserved_, kReserve));
    if (base_ != nullptr) return;
  }
  throw std::bad_alloc();
}

Arena::~Arena() { platform::release(base_, reserved_, kReserve); }

void Arena::commit(std::size_t bytes) {
  if (bytes > std::min(limit_, reserved_)) throw std::bad_alloc();
  if (bytes <= committed_) return;
  const std::size_t wanted = std::max(bytes, committed_ + committed_ / 16);
  const std::size_t target = std::min(reserved_, (wanted + kStep - 1) / kStep * kStep);
  if (!platform::commit(base_ + committed_, target - committed_)) throw std::bad_alloc();
  if (committed_ >= kHugeFrom) platform::advise_huge_pages(base_ + committed_, target - committed_);
  committed_ = target;
  open_fresh();
}

void Arena::fail() { throw std::bad_alloc(); }

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
  Handle handle;
  if (!spares_.empty() && spares_.back().granules >= granules) {
    Run& run = spares_.back();
    handle = run.first;
    run.first += static_cast<Handle>(granules);
    run.granules -= granules;
    spare_ -= granules;
    if (run.granules == 0) {
      spares_.pop_back();
      open_fresh();
    }
  } else {
    commit((next_ + granules) * kGranule);
    handle = static_cast<Handle>(next_);
    next_ += granules;
  }
  used_ += granules;
  return handle;
}

void Arena::release_large(Handle handle, std::size_t granules) noexcept {
  Handle& head = free_large_.find(granules)->second;
  *at<Handle>(handle) = head;
  head = handle;
}

// --- Giving pages back -----------------------------------------------------------------------

std::vector<Arena::Run> Arena::free_blocks() const {
  std::vector<Run> blocks;
  const auto collect = [&](std::size_t granules, Handle head) {
    for (; head != 0; head = *at<Handle>(head)) blocks.push_back({head, granules});
  };
  for (std::size_t granules = 1; granules < kSmall; ++granules) collect(granules, free_[granules]);
  for (const auto& [granules, head] : free_large_) collect(granules, head);
  return blocks;
}

// Puts a run of free granules on the free lists, in blocks of the largest small size.
void Arena::keep_free(Run run) noexcept {
  while (run.granules > 0) {
    const std::size_t size = std::min(run.granules, kSmall - 1);
    *at<Handle>(run.first) = free_[size];
    free_[size] = run.first;
    run.first += static_cast<Handle>(size);
    run.granules -= size;
  }
}

// Free blocks that touch are joined; of a run, whole pages go back to the system and their
// granules are spare, and what is left keeps waiting on the free lists.
void Arena::shrink() {
  if (!platform::kReturnsPages) return;
  std::vector<Run> runs = free_blocks();
  runs.insert(runs.end(), spares_.begin(), spares_.end());
  std::sort(runs.begin(), runs.end(), [](Run a, Run b) { return a.first > b.first; });
  std::vector<Run> joined;  // from the last to the first, so that low ones are used first
  joined.reserve(runs.size());
  for (const Run& run : runs) {
    if (!joined.empty() && run.first + run.granules == joined.back().first) {
      joined.back() = {run.first, run.granules + joined.back().granules};
    } else {
      joined.push_back(run);
    }
  }
  std::vector<Run> spares;
  spares.reserve(joined.size());
  for (auto& [granules, head] : free_large_) head = 0;
  free_.fill(0);
  spare_ = 0;
  const std::size_t page = platform::page_bytes(), page_granules = page / kGranule;
  for (const Run& run : joined) {
    const std::size_t end = run.first + run.granules;
    if (end == next_) {
      next_ = run.first;
      continue;
    }
    const std::size_t first_page = (run.first + page_granules - 1) / page_granules;
    const std::size_t end_page = end / page_granules;
    if (first_page >= end_page) {
      keep_free(run);
      continue;
    }
    const std::size_t from = first_page * page_granules;
    const std::size_t granules = (end_page - first_page) * page_granules;
    keep_free({run.first, from - run.first});
    keep_free({static_cast<Handle>(from + granules), end - from - granules});
    platform::discard(base_ + from * kGranule, granules * kGranule);
    spares.push_back({static_cast<Handle>(from), granules});
    spare_ += granules;
  }
  spares.shrink_to_fit();  // there are fewer of them than free runs
  spares_.swap(spares);
  open_fresh();
  const std::size_t behind = (next_ * kGranule + page - 1) / page * page;
  if (behind < committed_) platform::discard(base_ + behind, committed_ - behind);
}

void Arena::check_invariants() const {
  std::size_t free_granules = spare_;
  for (const Run& block : free_blocks()) {
    SAC_INVARIANT(block.first + block.granules <= next_);
    free_granules += block.granules;
  }
  std::size_t spare = 0;
  for (const Run& run : spares_) spare += run.granules;
  SAC_INVARIANT(spare == spare_);
  SAC_INVARIANT(free_granules + used_ + kHeaderGranules == next_);
  SAC_INVARIANT(next_ * kGranule <= committed_);
}

}  // namespace sac
