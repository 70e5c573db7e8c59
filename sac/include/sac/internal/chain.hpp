// Records of an arena that are chained in both directions, the newest first: the readers of a
// version, the posts of a call, the requests of a query.
//
// The links are members of the records. A record knows whether it is chained from elsewhere.
#pragma once

#include "sac/arena.hpp"

namespace sac::detail {

template <class T, Ref<T> T::*kPrevious, Ref<T> T::*kNext>
struct Chain {
  static void push(const Arena& arena, Ref<T>& first, T& record) noexcept {
    const Ref<T> self = Arena::ref(record);
    record.*kPrevious = nullptr;
    record.*kNext = first;
    if (first != nullptr) arena[first].*kPrevious = self;
    first = self;
  }
  /// Requires: the record is in the chain. Its own links stay as they are.
  static void remove(const Arena& arena, Ref<T>& first, const T& record) noexcept {
    const Ref<T> previous = record.*kPrevious;
    const Ref<T> next = record.*kNext;
    if (next != nullptr) arena[next].*kPrevious = previous;
    (previous != nullptr ? arena[previous].*kNext : first) = next;
  }
  /// Calls visit(record) for all, the newest first; it may remove the one that it is given.
  template <class Visit>
  static void for_each(const Arena& arena, Ref<T> first, Visit&& visit) {
    while (first != nullptr) {
      T& record = arena[first];
      first = record.*kNext;
      visit(record);
    }
  }
};

}  // namespace sac::detail
