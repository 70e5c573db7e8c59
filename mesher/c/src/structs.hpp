// Structs of the caller, of any size: of older headers, or of newer ones if what is new is 0.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>

#include "errors.hpp"

namespace lm {

/// No struct of the interface will be larger: a size above is none.
inline constexpr std::size_t kLargestStruct = 4096;
/// The size of the struct in the first version of the interface: a smaller one cuts a member off.
/// (A struct that grows later gets the size here that it has now.)
template <class T>
inline constexpr std::size_t kFirstSize = sizeof(T);
template <>
inline constexpr std::size_t kFirstSize<lm_options> = offsetof(lm_options, periodic_count);
template <>
inline constexpr std::size_t kFirstSize<lm_change_info> = offsetof(lm_change_info,
                                                                   point_slots_before);

/// A struct of any version ends at a multiple of its alignment; another size would cut a member,
/// perhaps a pointer.
template <class T>
[[nodiscard]] bool is_size_of(std::size_t size) noexcept {
  return kFirstSize<T> <= size && size <= kLargestStruct && size % alignof(T) == 0;
}

/// The struct as this library knows it; 0 where the caller's ends. What is not known must be 0.
/// Throws: Failure (LM_NULL_POINTER, LM_BAD_SIZE).
template <class T>
[[nodiscard]] T read_struct(const T* user, const char* what) {
  require_pointer(user, what);
  const std::size_t size = user->size;
  if (!is_size_of<T>(size)) {
    throw Failure(LM_BAD_SIZE, std::string(what) + "->size is not the size of the struct");
  }
  const auto* bytes = reinterpret_cast<const unsigned char*>(user);
  if (size > sizeof(T) &&
      std::any_of(bytes + sizeof(T), bytes + size, [](unsigned char byte) { return byte != 0; })) {
    throw Failure(LM_BAD_SIZE, std::string(what) + " has members that this library does not know");
  }
  T known{};
  std::memcpy(&known, user, std::min(size, sizeof(T)));
  return known;
}

/// Writes what the caller's struct has room for, except its size; false if that is no size.
template <class T>
[[nodiscard]] bool write_struct(const T& known, T* user) noexcept {
  const std::size_t size = user->size;
  if (!is_size_of<T>(size)) return false;
  auto* bytes = reinterpret_cast<unsigned char*>(user);
  const auto* from = reinterpret_cast<const unsigned char*>(&known);
  std::memcpy(bytes + sizeof(std::size_t), from + sizeof(std::size_t),
              std::min(size, sizeof(T)) - sizeof(std::size_t));
  if (size > sizeof(T)) std::memset(bytes + sizeof(T), 0, size - sizeof(T));
  return true;
}

/// Throws: Failure (LM_NULL_POINTER, LM_BAD_SIZE), before anything is done.
template <class T>
void require_struct(const T* user, const char* what) {
  require_pointer(user, what);
  if (!is_size_of<T>(user->size)) {
    throw Failure(LM_BAD_SIZE, std::string(what) + "->size is not the size of the struct");
  }
}

}  // namespace lm
