// Arrays as the interface shows them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "livemesh.h"
#include "structs.hpp"

namespace lm {

template <class T>
[[nodiscard]] constexpr std::uint32_t type_number() noexcept {
  if constexpr (std::is_same_v<T, double>) {
    return LM_F64;
  } else if constexpr (std::is_same_v<T, std::int64_t>) {
    return LM_I64;
  } else if constexpr (std::is_same_v<T, std::uint32_t>) {
    return LM_U32;
  } else if constexpr (std::is_enum_v<T>) {
    return type_number<std::underlying_type_t<T>>();
  } else {
    static_assert(std::is_same_v<T, std::uint8_t>);
    return LM_U8;
  }
}

/// The array of `columns` elements at `first`, and at every `stride` bytes from there.
template <class T>
[[nodiscard]] lm_array strided(const T* first, std::size_t rows, std::uint32_t columns,
                               std::size_t stride) noexcept {
  return {0, rows == 0 ? nullptr : first, rows, stride, columns, type_number<T>()};
}

/// Numbers in rows.
template <class T>
[[nodiscard]] lm_array rows_of(const std::vector<T>& all, std::uint32_t columns = 1) noexcept {
  return strided(all.data(), all.size() / columns, columns, columns * sizeof(T));
}
template <class T, std::size_t N>
[[nodiscard]] lm_array rows_of(std::span<const std::array<T, N>> all) noexcept {
  return strided(all.empty() ? nullptr : all[0].data(), all.size(), N, sizeof(all[0]));
}
template <class T, std::size_t N>
[[nodiscard]] lm_array rows_of(const std::vector<std::array<T, N>>& all) noexcept {
  return rows_of(std::span(all));
}

/// A member of each of some records. Requires: the member's type is in type_number().
template <class Record, class Member>
[[nodiscard]] lm_array member_of(std::span<const Record> all, Member member) noexcept {
  using T = std::remove_cvref_t<decltype(member(all[0]))>;
  if constexpr (requires { std::tuple_size<T>::value; }) {
    const auto* first = all.empty() ? nullptr : member(all[0]).data();
    return strided(first, all.size(), std::tuple_size_v<T>, sizeof(Record));
  } else {
    const T* first = all.empty() ? nullptr : &member(all[0]);
    return strided(first, all.size(), 1, sizeof(Record));
  }
}

/// Throws: Failure(LM_BAD_ARGUMENT).
[[noreturn]] inline void fail_unknown_field(std::int32_t field) {
  throw Failure(LM_BAD_ARGUMENT, "field " + std::to_string(field) + " does not exist here");
}

/// Writes to the caller's struct. Throws: Failure(LM_BAD_SIZE).
template <class T>
void give_struct(const T& known, T* user) {
  if (!write_struct(known, user)) throw Failure(LM_BAD_SIZE, "the size of a struct is not known");
}

}  // namespace lm
