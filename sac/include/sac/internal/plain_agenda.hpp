// The work queue of plain runs: posts in memory, one block of records a class.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <new>
#include <tuple>
#include <utility>
#include <vector>

#include "sac/agenda.hpp"
#include "sac/check.hpp"

namespace sac {

class PlainScope;

/// A work queue with the order of sac::Agenda; equal posts merge.
class PlainAgenda {
 public:
  PlainAgenda() = default;
  PlainAgenda(const PlainAgenda&) = delete;
  PlainAgenda& operator=(const PlainAgenda&) = delete;

  template <auto F, class... Args>
  void post(PlainScope&, const Key& key, Args... args) {
    add<F>(key, std::tuple<Args...>(std::move(args)...));
  }
  template <auto F, class... Args>
  void post_from_outside(const Key& key, Args... args) {
    add<F>(key, std::tuple<Args...>(std::move(args)...));
  }
  void drain(PlainScope& s);

 private:
  struct Record {
    const Function* function;
  };
  struct Entry {
    std::uint64_t order;
    Record* record;
  };
  template <class Tuple>
  struct TypedRecord : Record {
    Tuple args;
  };
  // The posts of one (bucket, phase, colour), with the memory they lie in.
  struct Class {
    std::vector<Entry> records;
    std::vector<std::unique_ptr<std::byte[]>> blocks;
    std::size_t used = kBlock;
  };
  static constexpr std::size_t kBlock = 16384;

  // The operations of a record go by the same descriptor as those of a call.
  struct Operations : Function {
    void (*run)(PlainScope&, const Record&);
    bool (*same)(const Record&, const Record&);
    std::strong_ordering (*order)(const Record&, const Record&);
  };

  template <auto F, class Tuple>
  static void run_record(PlainScope& s, const Record& r) {
    std::apply([&](const auto&... a) { F(s, a...); },
               static_cast<const TypedRecord<Tuple>&>(r).args);
  }
  template <class Tuple>
  static bool same_record(const Record& a, const Record& b) {
    return static_cast<const TypedRecord<Tuple>&>(a).args ==
           static_cast<const TypedRecord<Tuple>&>(b).args;
  }
  template <class Tuple>
  static std::strong_ordering order_record(const Record& a, const Record& b) {
    const auto order = static_cast<const TypedRecord<Tuple>&>(a).args <=>
                       static_cast<const TypedRecord<Tuple>&>(b).args;
    return order < 0 ? std::strong_ordering::less
                     : order > 0 ? std::strong_ordering::greater : std::strong_ordering::equal;
  }
  template <auto F, class Tuple>
  static constexpr Operations kOperations{
      {.name = function_name<F>(), .identity = identity<F, Tuple>(), .frame_bytes = 0,
       .posted = true, .execute = nullptr, .destroy = nullptr, .equal = nullptr, .compare = nullptr,
       .hash = nullptr, .print = nullptr},
      &run_record<F, Tuple>, &same_record<Tuple>, &order_record<Tuple>};

  static const Operations& operations(const Record& r) {
    return static_cast<const Operations&>(*r.function);
  }
  static bool before(const Entry& a, const Entry& b) {
    return a.order != b.order ? a.order < b.order : before_in_tie(*a.record, *b.record);
  }
  static bool before_in_tie(const Record& a, const Record& b);
  static bool same(const Entry& a, const Entry& b);

  template <auto F, class Tuple>
  void add(const Key& key, Tuple&& args) {
    using Typed = TypedRecord<std::decay_t<Tuple>>;
    static_assert(std::is_trivially_destructible_v<Typed>, "agenda arguments must be trivial");
    static_assert(sizeof(Typed) <= kBlock);
    const std::uint32_t rank = key.rank();
    if (running_ && rank < rank_) throw UsageError("posting into the past");
    Class& c = cached_ != nullptr && cached_rank_ == rank ? *cached_ : classes_[rank];
    cached_ = &c;
    cached_rank_ = rank;
    constexpr std::size_t bytes = (sizeof(Typed) + 15) / 16 * 16;
    if (c.used + bytes > kBlock) {
      c.blocks.push_back(std::make_unique<std::byte[]>(kBlock));
      c.used = 0;
    }
    void* memory = c.blocks.back().get() + c.used;
    c.used += bytes;
    c.records.push_back({key.order, ::new (memory) Typed{{&kOperations<F, std::decay_t<Tuple>>},
                                                          std::forward<Tuple>(args)}});
  }

  void run_class(PlainScope& s, Class& c);

  std::map<std::uint32_t, Class> classes_;
  Class* cached_ = nullptr;
  std::uint32_t cached_rank_ = 0;
  std::uint32_t rank_ = 0;
  bool running_ = false;
};

}  // namespace sac
