// Objects behind handles: numbers that are checked, so that a freed or an invented one is an error.
//
// A handle is the number of an entry in a table, and the generation of that entry, which grows when
// its object is freed. A call holds the object that it uses, so another thread may free it; and it
// enters the object for reading or for writing, without waiting: if that cannot be, it is Busy.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "errors.hpp"
#include "livemesh.h"

namespace lm {

/// Who is inside an object: any number that read, or one that writes.
class Gate {
 public:
  [[nodiscard]] bool enter_to_read() noexcept {
    std::int64_t inside = inside_.load(std::memory_order_relaxed);
    while (inside >= 0) {
      if (inside_.compare_exchange_weak(inside, inside + 1, std::memory_order_acquire)) return true;
    }
    return false;
  }
  [[nodiscard]] bool enter_to_write() noexcept {
    std::int64_t nobody = 0;
    return inside_.compare_exchange_strong(nobody, -1, std::memory_order_acquire);
  }
  void leave_from_reading() noexcept { inside_.fetch_sub(1, std::memory_order_release); }
  void leave_from_writing() noexcept { inside_.store(0, std::memory_order_release); }

 private:
  std::atomic<std::int64_t> inside_ = 0;
};

/// What a handle stands for.
class Object {
 public:
  Object() = default;
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;
  virtual ~Object() = default;
  /// Sentences for people, see lm_text_get(); null: this kind of object has none.
  [[nodiscard]] virtual const std::vector<std::string>* texts() { return nullptr; }

  Gate gate;
};

/// Adds an object; its handle. Throws: std::bad_alloc.
[[nodiscard]] lm_handle add_object(std::shared_ptr<Object> object);
/// Throws: Failure(LM_BAD_HANDLE).
void remove_object(lm_handle handle);
[[nodiscard]] std::shared_ptr<Object> find_object(lm_handle handle);
[[nodiscard]] std::uint64_t count_objects() noexcept;

enum class Use : std::uint8_t { read, write };

/// The object of a handle while a call uses it. T: a class derived from Object, or Object.
template <class T, Use kUse>
class Using {
 public:
  /// Throws: Failure (LM_BAD_HANDLE, LM_BUSY).
  explicit Using(lm_handle handle) : object_(std::dynamic_pointer_cast<T>(find_object(handle))) {
    if (!object_) throw Failure(LM_BAD_HANDLE, "the handle is that of another kind of object");
    const bool entered =
        kUse == Use::read ? object_->gate.enter_to_read() : object_->gate.enter_to_write();
    if (!entered) throw Failure(LM_BUSY, "the object is in use, by another thread or by a caller");
  }
  Using(const Using&) = delete;
  Using& operator=(const Using&) = delete;
  ~Using() {
    if constexpr (kUse == Use::read) {
      object_->gate.leave_from_reading();
    } else {
      object_->gate.leave_from_writing();
    }
  }

  T& operator*() const noexcept { return *object_; }
  T* operator->() const noexcept { return object_.get(); }

 private:
  std::shared_ptr<T> object_;
};

template <class T>
using Reading = Using<T, Use::read>;
template <class T>
using Writing = Using<T, Use::write>;

/// Makes an object, and puts its handle where the caller wants it.
template <class T, class... Args>
void make_object(lm_handle* handle, Args&&... args) {
  *handle = add_object(std::make_shared<T>(std::forward<Args>(args)...));
}

}  // namespace lm
