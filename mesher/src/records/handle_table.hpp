// Finds handles of records by the content of the records, which alone hold the keys.
#pragma once

#include <tsl/robin_set.h>

#include <cstddef>
#include <cstdint>

namespace mesher::detail {

/// Records: `Records::Key`, equality comparable; `key(handle)`, of a record that is in the table;
/// `hash(key)`. Some 13 bytes a handle. No order is asked of it.
template <class Records>
class HandleTable {
 public:
  using Handle = std::uint32_t;
  using Key = typename Records::Key;

  explicit HandleTable(const Records& records) : set_(0, Hash{&records}, Equal{&records}) {
    set_.max_load_factor(0.8f);
  }

  /// 0: there is none.
  [[nodiscard]] Handle find(const Key& key) const {
    const auto it = set_.find(key);
    return it == set_.end() ? 0 : *it;
  }
  /// Requires: find(its key) == 0. Throws: std::bad_alloc, and then changes nothing.
  void insert(Handle h) { set_.insert(h); }
  /// Requires: insert(h) before, and its key is as it was then.
  void erase(Handle h) noexcept { set_.erase(h); }

  [[nodiscard]] std::size_t size() const noexcept { return set_.size(); }
  [[nodiscard]] std::size_t bytes() const noexcept { return 8 * set_.bucket_count(); }

 private:
  struct Hash {
    const Records* records;
    std::size_t operator()(Handle h) const noexcept { return records->hash(records->key(h)); }
    std::size_t operator()(const Key& key) const noexcept { return records->hash(key); }
  };
  struct Equal {
    using is_transparent = void;
    const Records* records;
    bool operator()(Handle a, Handle b) const noexcept { return a == b; }
    bool operator()(const Key& key, Handle h) const noexcept { return key == records->key(h); }
    bool operator()(Handle h, const Key& key) const noexcept { return key == records->key(h); }
  };
  tsl::robin_set<Handle, Hash, Equal> set_;
};

}  // namespace mesher::detail
