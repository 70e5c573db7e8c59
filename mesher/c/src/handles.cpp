// The table of objects, one for the process: handles of all threads are in it.
#include "handles.hpp"

namespace lm {
namespace {

class Table {
 public:
  lm_handle add(std::shared_ptr<Object> object) {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) {
      // So that remove() needs no memory.
      if (free_.capacity() <= entries_.size()) free_.reserve(2 * entries_.size() + 16);
      entries_.emplace_back();
      free_.push_back(static_cast<std::uint32_t>(entries_.size() - 1));
    }
    const std::uint32_t i = free_.back();
    free_.pop_back();
    entries_[i].object = std::move(object);
    ++count_;
    return handle(i);
  }

  // The object is destroyed by the caller, not while the table is locked.
  std::shared_ptr<Object> remove(lm_handle h) {
    const std::lock_guard lock(mutex_);
    Entry& entry = at(h);
    std::shared_ptr<Object> object = std::move(entry.object);
    entry.object.reset();
    ++entry.generation;
    free_.push_back(static_cast<std::uint32_t>(h));
    --count_;
    return object;
  }

  std::shared_ptr<Object> find(lm_handle h) {
    const std::lock_guard lock(mutex_);
    return at(h).object;
  }

  std::uint64_t count() {
    const std::lock_guard lock(mutex_);
    return count_;
  }

 private:
  struct Entry {
    std::shared_ptr<Object> object;
    std::uint32_t generation = 1;  // so that 0 is no handle
  };

  [[nodiscard]] lm_handle handle(std::uint32_t i) const noexcept {
    return lm_handle{entries_[i].generation} << 32 | i;
  }
  Entry& at(lm_handle h) {
    const auto i = static_cast<std::uint32_t>(h);
    if (i >= entries_.size() || handle(i) != h || !entries_[i].object) {
      throw Failure(LM_BAD_HANDLE, "the handle is that of no object; was it freed?");
    }
    return entries_[i];
  }

  std::mutex mutex_;
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> free_;
  std::uint64_t count_ = 0;
};

// Never destroyed: threads may still use handles while a process ends.
Table& table() {
  static Table* const all = new Table;
  return *all;
}

}  // namespace

lm_handle add_object(std::shared_ptr<Object> object) { return table().add(std::move(object)); }
void remove_object(lm_handle handle) { static_cast<void>(table().remove(handle)); }
std::shared_ptr<Object> find_object(lm_handle handle) { return table().find(handle); }
std::uint64_t count_objects() noexcept { return table().count(); }

}  // namespace lm
