// The modifiables whose changes the client wants to know.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "sac/internal/mod_structure.hpp"
#include "sac/internal/same.hpp"

namespace sac::detail {

class Watch {
 public:
  virtual ~Watch() = default;
  /// Looks at the value at the end of the trace; null: there is none. Returns whether it is another
  /// one than the value known; commit() makes it that. Throws: exceptions of the client's values.
  virtual bool prepare(const Version* last) = 0;
  virtual void commit() noexcept = 0;
  /// Calls the functions, unless one of them changes the value again, or ends the watch.
  virtual void call() = 0;

  bool touched = false;  // a call or the client has changed it
  bool gone = false;     // nobody watches any more
};

template <class T, class Same>
class TypedWatch final : public Watch {
 public:
  bool prepare(const Version* last) override {
    if (last == nullptr) {
      next_ = nullptr;
      return known_ != nullptr;
    }
    const T& now = value_of<T>(*last);
    if (known_ != nullptr && same<Same>(*known_, now)) return false;
    next_ = std::make_shared<const T>(now);
    return true;
  }
  void commit() noexcept override { known_ = std::move(next_); }
  void call() override {
    const std::shared_ptr<const T> told = known_;
    if (told == nullptr) return;
    const std::size_t there_are = functions_.size();
    for (std::size_t i = 0; i < there_are && !gone && known_ == told; ++i) {
      const auto function = functions_[i];
      (*function)(*told);
    }
  }
  void add(std::function<void(const T&)> f) {
    functions_.push_back(std::make_shared<const std::function<void(const T&)>>(std::move(f)));
  }

 private:
  std::shared_ptr<const T> known_;
  std::shared_ptr<const T> next_;
  std::vector<std::shared_ptr<const std::function<void(const T&)>>> functions_;
};

class Watches {
 public:
  explicit Watches(ModStructure& mods) noexcept : mods_(mods) {}

  /// The watch of a modifiable. Throws: std::bad_alloc, and what copying its value throws.
  template <class T, class Same>
  TypedWatch<T, Same>& at(ModRef mod) {
    if (const auto known = all_.find(mod.handle()); known != all_.end()) {
      return static_cast<TypedWatch<T, Same>&>(*known->second);
    }
    auto fresh = std::make_shared<TypedWatch<T, Same>>();
    if (fresh->prepare(mods_.newest(mod))) fresh->commit();
    touched_.reserve(all_.size() + 1);
    all_.emplace(mod.handle(), fresh);
    mods_.set_watched(mod, true);
    return *fresh;
  }
  void touch(ModRef mod) noexcept;
  /// Nobody watches it any more. Does nothing if nobody does.
  void drop(ModRef mod) noexcept;
  /// The modifiables in the `bytes` from `from` are gone.
  void forget(Handle from, std::size_t bytes) noexcept;

  /// At the end of a run or propagation, which can still fail: finds out which have another value.
  /// Throws: std::bad_alloc, and what comparing and copying values throws.
  void prepare();
  /// It has not failed.
  void commit() noexcept;
  /// Calls the functions of those that have changed.
  void call();
  /// It has failed.
  void clear() noexcept { changed_.clear(); }
  [[nodiscard]] bool has_changed(ModRef mod) const noexcept;

 private:
  using Changes = std::vector<std::pair<Handle, std::shared_ptr<Watch>>>;  // by handle

  ModStructure& mods_;
  std::map<Handle, std::shared_ptr<Watch>> all_;
  std::vector<Handle> touched_;
  Changes prepared_;
  Changes changed_;
  Changes to_call_;  // the same
};

}  // namespace sac::detail
