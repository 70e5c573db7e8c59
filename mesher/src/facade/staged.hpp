// Values by key as the last update left them, with the edits announced since.
//
//   staged.set(key, value);  ... staged.prepare(); ... staged.commit();  // or discard()
#pragma once

#include <map>
#include <optional>
#include <utility>

namespace mesher::detail {

template <class Key, class Value>
class Staged {
 public:
  using Entry = std::optional<Value>;  // nothing: it is not there

  /// As announced; null if it is not there. Valid until the next change.
  [[nodiscard]] const Value* find(const Key& key) const {
    const auto edit = edits_.find(key);
    if (edit != edits_.end()) return edit->second ? &*edit->second : nullptr;
    return find_committed(key);
  }
  /// As of the last update.
  [[nodiscard]] const std::map<Key, Value>& committed() const noexcept { return committed_; }

  /// Whether something has been announced since.
  [[nodiscard]] bool has_edits() const noexcept { return !edits_.empty(); }

  /// Throws: std::bad_alloc, and then changes nothing.
  void set(const Key& key, Entry to) { edits_.insert_or_assign(key, std::move(to)); }

  /// What set() said of a key last, to go back to.
  [[nodiscard]] std::optional<Entry> edit_of(const Key& key) const {
    const auto edit = edits_.find(key);
    return edit == edits_.end() ? std::optional<Entry>() : edit->second;
  }
  /// Takes one set() back. `before`: edit_of(key) before it.
  void restore(const Key& key, const std::optional<Entry>& before) noexcept {
    if (before) {
      edits_.find(key)->second = *before;
    } else {
      edits_.erase(key);
    }
  }

  /// Calls visit(key, was, is) for each difference, ascending; null: it is not there.
  template <class Visit>
  void for_each_edit(Visit&& visit) const {
    for (const auto& [key, to] : edits_) {
      const Value* was = find_committed(key);
      if (was == nullptr ? !to : to && *to == *was) continue;
      visit(key, was, to ? &*to : nullptr);
    }
  }

  /// So that commit() needs no memory.
  void prepare() {
    fresh_.clear();
    for (const auto& [key, to] : edits_) {
      if (to) fresh_.emplace_hint(fresh_.end(), key, *to);
    }
  }
  /// Requires: prepare(), and no change since.
  void commit() noexcept {
    for (const auto& [key, to] : edits_) committed_.erase(key);
    committed_.merge(fresh_);
    discard();
  }
  void discard() noexcept {
    edits_.clear();
    fresh_.clear();
  }

 private:
  [[nodiscard]] const Value* find_committed(const Key& key) const {
    const auto it = committed_.find(key);
    return it == committed_.end() ? nullptr : &it->second;
  }

  std::map<Key, Value> committed_, fresh_;
  std::map<Key, Entry> edits_;
};

}  // namespace mesher::detail
