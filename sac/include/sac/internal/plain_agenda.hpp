// The work queue of plain runs: posts in memory, one block of records a class.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <new>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "sac/agenda.hpp"
#include "sac/check.hpp"
#include "sac/internal/due_calls.hpp"

namespace sac {

class PlainScope;

/// A work queue with the order of sac::Agenda; equal posts merge. It refuses what that refuses, but
/// for one call posted at two keys, which runs twice.
class PlainAgenda {
 public:
  PlainAgenda() = default;
  PlainAgenda(const PlainAgenda&) = delete;
  PlainAgenda& operator=(const PlainAgenda&) = delete;

  template <auto F, class... Args>
  void post(PlainScope&, const Key& key, Args&&... args) {
    add<F, detail::Kept<std::decay_t<Args>>...>(key, std::forward<Args>(args)...);
  }
  template <auto F, class... Args>
  void post_from_outside(const Key& key, Args&&... args) {
    add<F, detail::Kept<std::decay_t<Args>>...>(key, std::forward<Args>(args)...);
  }
  void drain(PlainScope& s);

 private:
  // A call that waits; its arguments lie behind.
  struct Record;
  // What there is to do with it: described as a traced function is, for the order.
  struct Kind : Function {
    void (*run)(PlainScope&, const Record&);
    std::strong_ordering (*order)(const Record&, const Record&);
    void (*destroy_arguments)(Record&);
  };
  struct Record {
    const Kind* kind;
  };
  struct Destroy {
    void operator()(Record* record) const { record->kind->destroy_arguments(*record); }
  };
  template <class Arguments>
  struct TypedRecord : Record {
    Arguments args;
  };
  struct Entry {
    std::uint64_t order;
    Record* record;
  };
  // The posts of one (bucket, phase, colour), with the memory they lie in.
  struct Class {
    std::vector<Entry> posts;
    std::vector<std::unique_ptr<std::byte[]>> blocks;
    std::size_t used = kBlock;                             // of the last one
    std::vector<std::unique_ptr<Record, Destroy>> owners;  // of arguments that need destroying

    void* allocate(std::size_t bytes);
  };
  static constexpr std::size_t kBlock = 16384;

  template <class Arguments>
  static Arguments& arguments_of(Record& r) {
    return static_cast<TypedRecord<Arguments>&>(r).args;
  }
  template <class Arguments>
  static const Arguments& arguments_of(const Record& r) {
    return static_cast<const TypedRecord<Arguments>&>(r).args;
  }
  template <auto F, class Arguments>
  static constexpr Kind kKind{
      {.name = function_name<F>(), .identity = &identity<F, Arguments>, .posted = true},
      [](PlainScope& s, const Record& r) {
        std::apply([&](const auto&... a) { F(s, a...); }, arguments_of<Arguments>(r));
      },
      [](const Record& a, const Record& b) {
        return detail::compare_arguments(a.kind->name, arguments_of<Arguments>(a),
                                         arguments_of<Arguments>(b));
      },
      [](Record& r) { std::destroy_at(&arguments_of<Arguments>(r)); }};

  static std::strong_ordering order(const Entry& a, const Entry& b);

  template <auto F, class... Kept, class... Args>
  void add(const Key& key, Args&&... args) {
    using Arguments = std::tuple<Kept...>;
    using Typed = TypedRecord<Arguments>;
    static_assert(sizeof(Typed) <= kBlock && alignof(Typed) <= alignof(std::max_align_t));
    constexpr bool kOwned = !std::is_trivially_destructible_v<Arguments>;
    if (!widths_.fits(key)) {
      const Arguments arguments(std::forward<Args>(args)...);
      widths_.fail(key, describe_call(function_name<F>(), arguments), name_);
    }
    Class& posted = class_of(widths_.rank(key));
    void* const memory = posted.allocate(sizeof(Typed));
    if constexpr (kOwned) posted.owners.emplace_back();
    auto* const record =
        ::new (memory) Typed{{&kKind<F, Arguments>}, Arguments(std::forward<Args>(args)...)};
    if constexpr (kOwned) posted.owners.back().reset(record);
    posted.posts.push_back({key.order, record});
  }
  Class& class_of(std::uint32_t rank) {
    if (drained_) throw UsageError("posting behind the drain");
    if (running_ && rank < rank_) throw UsageError("posting into the past");
    if (cached_ == nullptr || cached_rank_ != rank) cached_ = &classes_[rank];
    cached_rank_ = rank;
    return *cached_;
  }

  void run_class(PlainScope& s, Class& c);

  friend class PlainScope;
  std::string name_;
  KeyWidths widths_;
  std::map<std::uint32_t, Class> classes_;
  Class* cached_ = nullptr;
  std::uint32_t cached_rank_ = 0;
  std::uint32_t rank_ = 0;
  bool running_ = false;
  bool drained_ = false;
};

}  // namespace sac
