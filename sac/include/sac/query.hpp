// Queries: calls that are shared wherever they are asked for.
//
//   const std::uint64_t& h = s.query<build>(target);  // computed once, on demand
//
// The first call in trace order that asks for a label (function and arguments) makes the call, as
// its child; every later one gets the value that it returned. So queries run in an order of their
// own, each before its result is needed; what nobody asks for is not computed, and what nobody asks
// for any more is discarded.
//
// (1) A query may do whatever a call may: read, write, call, make objects, ask for queries. It sees
//     what precedes the place where it is first asked for.
// (2) Those who have asked for a query run again only if they get another value.
// (3) If a call comes to ask earlier than the first one, or the first one asks no more, then the
//     query is made anew where it is asked for first now, with the queries that it was the first to
//     ask for. If its value is the same, no other call runs but the former first one.
// (4) A query that needs its own result is a UsageError that names the cycle; so is an argument
//     that does not equal itself, such as a NaN in a vector.
// (5) Cost: a first request that of a call, a modifiable and a table entry; another one that of a
//     read. Nested queries take native stack, as nested calls do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "sac/engine.hpp"
#include "sac/internal/plain_queries.hpp"
#include "sac/mod.hpp"
#include "sac/scope.hpp"

namespace sac {
namespace detail {

struct FirstRequest;

// A label that somebody asks for, with the modifiable that holds its value.
struct Query {
  // What is to be known of the types of its function and arguments.
  struct Type {
    bool (*equal)(const Query&, const void* arguments);
    void (*print)(const Query&, std::ostream&);  // `name(arguments)`
    void (*destroy)(Engine&, Query&) noexcept;
  };

  const Type* type;
  Query* next = nullptr;         // in its bucket
  Query* next_unused = nullptr;  // perhaps: Queries::suspect
  std::uint32_t hash;
  ModRef answer{};
  Ref<FirstRequest> first{};  // requests that have found no value, chained
  bool suspected = false;
};

// A call has asked for the query at `place`, and has found no value.
struct FirstRequest : Edge {
  Place place;
  Ref<Query> query;
  Ref<FirstRequest> next;
  Ref<FirstRequest> previous;
};
static_assert(sizeof(FirstRequest) == 24);

template <auto F, class... P>
using AnswerCell =
    std::conditional_t<std::is_void_v<ResultOf<F, P...>>, Cell<std::monostate>,
                       Cell<std::conditional_t<std::is_void_v<ResultOf<F, P...>>, char,
                                               std::decay_t<ResultOf<F, P...>>>,
                            typename SameResult<F>::type>>;

template <auto F, class... P>
struct TypedQuery : Query {
  TypedQuery(std::uint32_t label_hash, const std::tuple<P...>& arguments)
      : Query{.type = &kType, .hash = label_hash}, args(arguments) {
    Query::answer = ModRef(Arena::handle_of(&value));
  }
  static const TypedQuery& of(const Query& query) noexcept {
    return static_cast<const TypedQuery&>(query);
  }
  static constexpr Type kType{[](const Query& query, const void* arguments) {
                                return identical(of(query).args,
                                                 *static_cast<const std::tuple<P...>*>(arguments));
                              },
                              [](const Query& query, std::ostream& out) {
                                out << function_name<F>() << '(';
                                print_arguments(out, of(query).args, &query);
                                out << ')';
                              },
                              [](Engine& engine, Query& query) noexcept {
                                engine.free_inside(static_cast<TypedQuery&>(query));
                              }};
  std::tuple<P...> args;
  AnswerCell<F, P...> value;
};

// The argument of the call that computes a query: it is labelled and printed as the arguments.
template <auto F, class... P>
struct QueryRef {
  TypedQuery<F, P...>* query;
  friend bool operator==(const QueryRef&, const QueryRef&) = default;
  friend std::uint64_t hash_value(const QueryRef& ref) noexcept { return ref.query->hash; }
  friend std::ostream& operator<<(std::ostream& out, const QueryRef& ref) {
    print_arguments(out, ref.query->args, ref.query);
    return out;
  }
  friend void label_bytes(LabelSink& sink, const QueryRef& ref) {
    label_arguments(sink, ref.query->args);
  }
};

}  // namespace detail

/// The queries of an engine, by label.
class Queries final : public Structure {
 public:
  explicit Queries(Engine& engine);
  ~Queries() override { engine_.remove_structure(id_); }

  /// The query of this label. Throws: std::bad_alloc, what copying arguments throws, and UsageError
  /// if one does not equal itself.
  template <auto F, class... P>
  detail::TypedQuery<F, P...>& query(const std::tuple<P...>& args) {
    using Typed = detail::TypedQuery<F, P...>;
    const std::uint32_t hash = detail::label_hash<&function_name<F>>(args);
    detail::require_equal_to_itself<F>(args);
    if (detail::Query* known = find(Typed::kType, hash, &args)) return static_cast<Typed&>(*known);
    reserve();
    auto& made = engine_.make_inside<Typed>(hash, args);
    enter(made);
    return made;
  }
  /// Whether a call before the running one's place has given the query a value.
  [[nodiscard]] bool is_answered(Scope& s, const detail::Query& query) const {
    return engine_.mods().is_written_before(s.place(), query.answer);
  }
  /// Records that the running call has found no value. Throws: std::bad_alloc; UsageError if an
  /// earlier call has found none either: the query needs its own result.
  void ask_first(Scope& s, detail::Query& query);
  /// The running call has given the query a value: who has found none behind it asks again.
  void answered(Scope& s, const detail::Query& query);

  [[nodiscard]] std::size_t bytes() const noexcept { return table_.capacity() * sizeof(table_[0]); }
  /// The number of labels that are asked for.
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

  void retract(Call& call, Edge& edge) noexcept override;
  [[nodiscard]] bool unchanged(Call& call, Edge& edge) override;
  void finished() noexcept override;
  void label(const Call& call, const Edge& edge, LabelSink& sink) const override;
  void print(const Call& call, const Edge& edge, std::ostream& out) const override;
  void check_invariants() const override;

 private:
  static constexpr std::uint8_t kFirst = 0;

  template <class T>
  [[nodiscard]] T& at(Ref<T> ref) const noexcept {
    return engine_.arena()[ref];
  }
  [[nodiscard]] detail::Query*& bucket(std::uint32_t hash) noexcept {
    return table_[hash & (table_.size() - 1)];
  }
  [[nodiscard]] detail::Query* find(const detail::Query::Type& type, std::uint32_t hash,
                                    const void* args);
  void reserve();
  void enter(detail::Query& query) noexcept;
  void leave(detail::Query& query) noexcept;
  void suspect(detail::Query& query) noexcept;
  [[nodiscard]] bool is_unused(const detail::Query& query) const noexcept;
  void require_no_cycle(const Call& running, const detail::Query& query) const;

  Engine& engine_;
  std::uint8_t id_;
  std::vector<detail::Query*> table_;  // buckets; a power of two
  std::size_t size_ = 0;
  detail::Query* unused_ = nullptr;  // those that may have nobody any more
};

namespace detail {

// Computes a query: its call.
template <auto F, class... P>
struct Answering {
  static constexpr std::string_view kName = function_name<F>();
  static constexpr bool kAnswersQuery = true;
  void operator()(Scope& s, QueryRef<F, P...> ref) const {
    TypedQuery<F, P...>& query = *ref.query;
    const auto body = [&](const P&... args) -> decltype(auto) { return F(s, args...); };
    if constexpr (std::is_void_v<ResultOf<F, P...>>) {
      std::apply(body, query.args);
      s.write(query.value, std::monostate());
    } else {
      s.write(query.value, std::apply(body, query.args));
    }
    s.engine().queries().answered(s, query);
  }
};
template <auto F, class... P>
inline constexpr Answering<F, P...> kAnswering{};

}  // namespace detail

template <auto F, class... P, class... Args>
decltype(auto) Scope::query_as(detail::Types<P...>, Args&&... args) {
  return core_.guarded([&]() -> decltype(auto) {
    static_cast<void>(self());
    Queries& queries = engine().queries();
    auto& query =
        queries.query<F, P...>(std::tuple<P...>(static_cast<P>(std::forward<Args>(args))...));
    if (!queries.is_answered(*this, query)) {
      queries.ask_first(*this, query);
      call<detail::kAnswering<F, P...>>(detail::QueryRef<F, P...>{&query});
    }
    if constexpr (std::is_void_v<detail::ResultOf<F, P...>>) {
      static_cast<void>(read(query.value));
    } else {
      return read(query.value);
    }
  });
}

}  // namespace sac
