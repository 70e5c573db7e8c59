// Agenda: a work queue whose order is a function of the labels of its calls alone.
//
// `while Q not empty: w = DeleteMin(Q); ...` written with an agenda is monotone by construction
// [Def 1.4.3], since two runs make their common calls in the same order, and concise by
// construction, since equal posts merge into one call.
//
//   agenda.post<visit>(s, sac::Key{.bucket = level}, node);   // an effect of the posting call
//   agenda.drain(s);                                          // runs everything in key order
//
// (1) A call lives while it is posted. A call that is no longer posted is dying: it waits in the
//     propagation queue and is discarded when its turn comes, unless it is posted again before.
// (2) In a first run calls get their time stamps as they run; a call posted during propagation gets
//     its position between its neighbours at once.
// (3) Posting a call whose turn is over is an error that names the poster and the posted call: a
//     call that comes before the running call of the agenda, or any call posted behind the drain.
// (4) The key is a function of the label: another key for the same call is an error. So is an
//     argument that does not equal itself, such as a NaN, since it has no position in an order.
// (5) Cost of a post: O(1) expected in a first run and when repeated; otherwise O(log of the calls
//     of the agenda).
// (6) One call drains an agenda. If that call leaves the trace, or an earlier call drains the
//     agenda instead, the calls that are still posted wait for the new drain.
#pragma once

#include <compare>
#include <concepts>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sac/engine.hpp"
#include "sac/internal/chain.hpp"
#include "sac/internal/sorted_index.hpp"
#include "sac/key.hpp"
#include "sac/scope.hpp"

namespace sac {

namespace detail {

template <class T>
concept Ordered = std::three_way_comparable<T> || requires(const T& a, const T& b) {
  { a < b } -> std::convertible_to<bool>;
};

template <class T>
inline constexpr bool kIsMod = false;
template <class T, class Same>
inline constexpr bool kIsMod<Mod<T, Same>> = true;

// Whether the order of T is that of addresses, or contains it: that is another one in every run.
template <class T>
struct IsOrderedByAddress : std::bool_constant<[] {
  if constexpr (std::is_pointer_v<T> || kIsMod<T> || SmartPointer<T>) {
    return true;
  } else if constexpr (kContainsOthers<T>) {
    return any_part<IsOrderedByAddress, T>();
  }
  return false;
}()> {};

// What an argument of a posted call must be like, too; the compiler names T.
template <class T>
struct PostedArgument {
  static_assert(Ordered<T>,
                "an argument of a posted call needs <=> or <: calls of one key run in the order of "
                "their arguments");
  static_assert(!IsOrderedByAddress<T>::value,
                "calls of one key run in the order of their arguments, and addresses have another "
                "order in every run: post a number that names the object, or a type of your own "
                "whose <=> compares what the objects are");
  static constexpr bool kFits = true;
};

// A posted call F(scope, args...), and its frame.
template <auto F, class... Args>
struct Posted {
  static_assert((PostedArgument<Args>::kFits && ...));
  static_assert(std::is_void_v<ResultOf<F, Args...>>, "a posted call has nobody to return to");
  static constexpr auto name = &function_name<F>;
  using FrameType = Frame<Slot, Nothing, Args...>;
  static constexpr Function function = [] {
    Function f = describe_frame<FrameType, name>();
    f.identity = &identity<F, std::tuple<Args...>>;
    f.posted = true;
    f.execute = &Called<F, Args...>::template execute_in<FrameType>;
    f.compare = [](const Call& a, const Call& b) {
      return compare_arguments(name(), FrameType::of(a).args, FrameType::of(b).args);
    };
    return f;
  }();
};

template <auto F, class... P>
Posted<F, P...> posted(Types<P...>);
template <auto F, class... Args>
using PostBy = decltype(posted<F>(parameters<F, false, Arrived<Args>...>()));

}  // namespace detail

/// The posts of a call that count are chained; a post that does not count now is its own
/// predecessor.
struct PostEdge : Edge {
  Ref<Call> target;
  Place place;  // of the post; null: from outside; such posts are in no call's list
  Ref<PostEdge> next_post;
  Ref<PostEdge> previous_post;
};
static_assert(sizeof(PostEdge) == 24);
using Posts = detail::Chain<PostEdge, &PostEdge::previous_post, &PostEdge::next_post>;

/// A work queue of calls, run in the order of their keys.
class Agenda final : public WorkQueue {
 public:
  /// Use Engine::make_agenda.
  Agenda(Engine& engine, std::string name, const KeyWidths& widths);
  ~Agenda() override { engine_.remove_structure(id_); }

  /// Posts the call f(scope, args...) at `key`, as an effect of the running call. Throws:
  /// UsageError for the errors of (3) and (4), and for a key that does not fit the widths.
  template <auto F, class... Args>
  void post(Scope& s, const Key& key, Args&&... args) {
    core_.guarded([&] {
      const auto label = label_of<F>(std::forward<Args>(args)...);
      post_call(s, turn_of(key, label), label.asked());
    });
  }

  /// Posts a call from outside: an input, like Engine::set.
  template <auto F, class... Args>
  void post_from_outside(const Key& key, Args&&... args) {
    engine_.begin_edit("post_from_outside");
    const auto label = label_of<F>(std::forward<Args>(args)...);
    const Ref<PostEdge> post = outside_post(turn_of(key, label), label.asked());
    try {
      engine_.on_rollback([this, label] { drop_outside(require_posted(label.asked())); });
    } catch (...) {
      drop_outside(post);
      throw;
    }
  }
  /// Undoes one post_from_outside. Throws: UsageError if there is none.
  template <auto F, class... Args>
  void retract_from_outside(Args&&... args) {
    engine_.begin_edit("retract_from_outside");
    const auto label = label_of<F>(std::forward<Args>(args)...);
    const Ref<PostEdge> post = require_posted(label.asked());
    const Entry turn = entry_of(core_.at(core_.at(post).target));
    engine_.on_rollback([this, turn, label] { outside_post(turn, label.asked()); });
    drop_outside(post);
  }

  /// Runs the posted calls, in order, as children of the running call. Once per agenda.
  void drain(Scope& s);

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  /// The number of the agenda, equal for agendas that two engines make in the same order.
  [[nodiscard]] std::uint64_t number() const noexcept { return id_; }
  [[nodiscard]] std::size_t bytes() const noexcept;
  /// The number of posted calls that are not in the trace.
  [[nodiscard]] std::uint64_t waiting_calls() const noexcept { return waiting_calls_; }
  /// Throws: UsageError if a call drains the agenda, or a call is posted on it.
  void require_unused() const;

  void retract(Call& call, Edge& edge) noexcept override;
  void left(Call& call, bool asked_for) noexcept override;
  void finished() noexcept override { drop_unposted(); }
  void check_invariants() const override;

 private:
  enum class State : std::uint8_t {
    open,      // posted calls wait
    draining,  // drain_call_ runs the posted calls
    drained    // a posted call gets its position among those that drain_call_ has run
  };
  struct Entry {
    std::uint64_t order = 0;
    std::uint32_t rank = 0;
    Ref<Call> call{};  // null: a turn that no call has yet
  };
  struct Drain;
  static constexpr std::uint8_t kPost = 0;
  static constexpr std::uint8_t kDrain = 1;

  // Edits from outside and their inverses use labels: a call discarded in a failed propagation is
  // a different object after the roll-back.
  template <auto F, class... Args>
  auto label_of(Args&&... args) const {
    auto label = detail::make_label<detail::PostBy<F, Args...>>(std::forward<Args>(args)...);
    if (!detail::reflexive(label.args)) fail_irreflexive(label.describe(&core_.arena().header()));
    return label;
  }
  [[noreturn]] static void fail_irreflexive(const std::string& call);
  template <class Label>
  [[nodiscard]] Entry turn_of(const Key& key, const Label& label) const {
    if (!widths_.fits(key)) [[unlikely]]
      widths_.fail(key, label.describe(&core_.arena().header()), name_);
    return {key.order, widths_.rank(key)};
  }

  // post.cpp
  void post_call(Scope& s, const Entry& turn, const Asked& asked);
  template <class Check>
  Ref<Call> posted_call(Ref<Call> known, const Entry& turn, const Asked& asked, Check&& check);
  [[nodiscard]] Ref<Call> find_posted(const Entry& turn, const Asked& asked);
  [[nodiscard]] static bool has_turn(const Call& call, const Entry& turn) noexcept;
  Ref<Call> create(const Entry& turn, const Asked& asked);
  void add_waiting(Ref<Call> call);
  Ref<PostEdge> outside_post(const Entry& turn, const Asked& asked);
  void drop_outside(Ref<PostEdge> post) noexcept;
  [[nodiscard]] Ref<PostEdge> require_posted(const Asked& asked) const;
  void require_turn(const Call& call, const Entry& turn) const;
  [[nodiscard]] bool in_future(const Call& posted) const;
  void require_future(const Call& poster, const Call& posted) const;
  [[nodiscard]] static bool counts(const PostEdge& post) noexcept {
    return post.previous_post != Arena::ref(post);
  }
  void add_post(PostEdge& post, Ref<Call> target) noexcept;
  void drop_post(PostEdge& post) noexcept;
  void chain_unposted(Call& call) noexcept;
  void unchain(Call& call) noexcept;
  void drop_waiting(Ref<Call> call) noexcept;
  void drop_unposted() noexcept;
  bool take_from_class(Call& call) noexcept;

  // drain.cpp
  [[nodiscard]] bool before(const Call& a, const Call& b) const;
  [[nodiscard]] auto order() const noexcept {
    return [this](const Entry& a, const Entry& b) {
      if (a.rank != b.rank) return a.rank < b.rank;
      if (a.order != b.order) return a.order < b.order;
      return a.call != b.call && before(core_.at(a.call), core_.at(b.call));
    };
  }
  [[nodiscard]] Entry entry_of(const Call& call) const noexcept {
    return {Slot::of(call).order, Slot::of(call).rank, engine_.handle_of(call)};
  }
  [[nodiscard]] Place stamp_before(const Call& call) const;
  void place(Ref<Call> call);
  void put(const Entry& entry);
  void take_from_index(const Call& call) noexcept;
  template <class Visit>
  void for_each_waiting(Visit&& visit) const;
  void discard_placed();
  void set_later_posts_aside(const Call& drain);
  [[noreturn]] void fail_drained_twice(const Call& caller) const;
  void begin_drain(Scope& s);
  void run_waiting(Scope& s);
  [[nodiscard]] bool find_next();
  [[nodiscard]] std::span<const Entry> entries_ahead() const;
  void sort_first_class();
  void run_next();

  Engine& engine_;
  Core& core_;
  std::string name_;
  KeyWidths widths_;
  std::uint8_t id_;
  State state_ = State::open;
  // Calls in order: first those that have a place in the trace, then those that wait.
  SortedIndex<Entry> calls_;
  std::span<const Entry> ahead_;  // in calls_, behind running_; empty: not known
  // Other calls that wait, by rank, in the order of their posts: they come into calls_ when the
  // drain has come to their rank.
  std::map<std::uint32_t, std::vector<Entry>> classes_;
  Place unposted_;  // calls that wait and that nobody posts now, chained
  std::uint64_t waiting_calls_ = 0;
  Ref<Call> drain_call_;
  Ref<Call> running_;  // the posted call that the drain runs
};

}  // namespace sac
