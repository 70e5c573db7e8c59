// The modifiables whose changes the client wants to know.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "sac/internal/mod_structure.hpp"
#include "sac/internal/same.hpp"

namespace sac::detail {

class Watch {
 public:
  virtual ~Watch() = default;
  /// Looks at the value at the end of the trace; null: there is none. Returns whether it is another
  /// one than before.
  virtual bool update(const Version* last) = 0;
  virtual void call() const = 0;
  bool touched = false;  // a call or the client has changed it
};

template <class T, class Same>
class TypedWatch final : public Watch {
 public:
  bool update(const Version* last) override {
    if (last == nullptr) return std::exchange(known_, std::nullopt).has_value();
    const T& now = value_of<T>(*last);
    if (known_.has_value() && same<Same>(*known_, now)) return false;
    known_.reset();
    known_.emplace(now);
    return true;
  }
  void call() const override {
    if (!known_.has_value()) return;
    for (const auto& f : functions_) f(*known_);
  }
  void add(std::function<void(const T&)> f) { functions_.push_back(std::move(f)); }

 private:
  std::optional<T> known_;
  std::vector<std::function<void(const T&)>> functions_;
};

class Watches {
 public:
  explicit Watches(ModStructure& mods) noexcept : mods_(mods) {}

  /// The watch of a modifiable. Throws: std::bad_alloc, and what copying its value throws.
  template <class T, class Same>
  TypedWatch<T, Same>& at(Handle head) {
    if (const auto known = all_.find(head); known != all_.end()) {
      return static_cast<TypedWatch<T, Same>&>(*known->second);
    }
    auto fresh = std::make_shared<TypedWatch<T, Same>>();
    static_cast<void>(fresh->update(mods_.newest(head)));
    touched_.reserve(all_.size() + 1);
    all_.emplace(head, fresh);
    mods_.set_watched(head, true);
    return *fresh;
  }
  void touch(Handle head) noexcept;
  /// The modifiables in the `bytes` from `from` are gone, or no longer watched.
  void forget(Handle from, std::size_t bytes) noexcept;
  /// After a run or propagation: finds out which have another value, and calls.
  void report();
  /// After one that failed.
  void report_nothing() noexcept { changed_.clear(); }
  [[nodiscard]] const std::vector<Handle>& changed() const noexcept { return changed_; }

 private:
  ModStructure& mods_;
  std::map<Handle, std::shared_ptr<Watch>> all_;
  std::vector<Handle> touched_;
  std::vector<Handle> changed_;
};

}  // namespace sac::detail
