// Agenda: a work queue whose order is a function of the calls' labels alone.
//
// `while Q not empty: w = DeleteMin(Q); ...` written with an agenda is monotone by construction
// [Def 1.4.3]: two runs make their common calls in the same order; and concise by construction:
// equal posts merge into one call.
//
//   agenda.post<visit>(s, sac::Key{.bucket = level}, node);   // an effect of the posting call
//   agenda.drain(s);                                          // runs everything in key order
//
// (1) A call lives while somebody posts it. One that nobody posts any more is dying: it waits in
//     the propagation queue and is discarded when its turn comes, unless posted again before.
// (2) In a first run calls get their time stamps as they run; a call posted during propagation gets
//     its place between its neighbours at once.
// (3) Posting a call that would run before its poster is an error that names both. A child of a
//     posted call posts as that call does.
// (4) Cost of a post: O(1) expected in a first run and when repeated; O(log) of the calls of the
//     same bucket otherwise.
// (5) An agenda is drained by one call. When that call leaves the trace, what is still posted waits
//     for another drain.
#pragma once

#include <compare>
#include <concepts>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "sac/engine.hpp"
#include "sac/internal/ordered_calls.hpp"
#include "sac/scope.hpp"

namespace sac {

/// When a posted call runs: by bucket, phase, colour, then order; ties by the call's arguments.
struct Key {
  int bucket = 0;            ///< -32768 .. 32767, smallest first
  unsigned phase = 0;        ///< 0 .. 15
  unsigned colour = 0;       ///< 0 .. 4095
  std::uint64_t order = 0;   ///< canonical order of the label

  /// (bucket, phase, colour) as one number. Throws: UsageError if out of range.
  [[nodiscard]] std::uint32_t rank() const {
    SAC_EXPECTS(bucket >= -32768 && bucket <= 32767 && phase < 16 && colour < 4096);
    return static_cast<std::uint32_t>(bucket + 32768) << 16 | phase << 12 | colour;
  }
};

/// The bucket of a length [§1.5]: equal for lengths within a factor of two, read off the exponent
/// of the double. Requires: length > 0.
[[nodiscard]] int exponent_bucket(double length);

namespace detail {

// Where a posted call stands, and how many posts ask for it; behind the head of the call.
struct Slot {
  std::uint64_t order = 0;
  std::uint32_t rank = 0;
  std::uint32_t agenda_and_posts = 0;  // agenda's number in the low 8 bits

  static constexpr std::uint32_t kOnePost = 256;
  static constexpr std::uint32_t kMostPosts = 0xffffffu;

  [[nodiscard]] std::uint8_t agenda() const noexcept {
    return static_cast<std::uint8_t>(agenda_and_posts);
  }
  [[nodiscard]] std::uint32_t posts() const noexcept { return agenda_and_posts / kOnePost; }
};
static_assert(sizeof(Slot) == 16);

template <class... Args>
using PostedFrame = Frame<Slot, Nothing, Args...>;

struct PostEdge : Edge {
  Handle target;
};

template <class T>
concept Ordered = std::three_way_comparable<T> || requires(const T& a, const T& b) {
  { a < b } -> std::convertible_to<bool>;
};

template <auto F, class... Args>
constexpr Function describe_posted() {
  static_assert((Ordered<Args> && ...),
                "an argument of a posted call needs <=> or <: calls of one key run in the order of "
                "their arguments");
  static_assert(std::is_void_v<std::invoke_result_t<decltype(F), Scope&, const Args&...>>,
                "a posted call has nobody to return to");
  using Type = PostedFrame<Args...>;
  Function f = describe_frame<Type, &function_name<F>>();
  f.identity = identity<F, std::tuple<Args...>>();
  f.posted = true;
  f.execute = &execute_frame<F, Type>;
  f.compare = &compare_args<Type>;
  return f;
}
template <auto F, class... Args>
inline constexpr Function kPosted = describe_posted<F, Args...>();

}  // namespace detail

class Agenda final : public Structure {
 public:
  /// Use Engine::make_agenda.
  Agenda(Engine& engine, std::string name);

  /// Asks for the call f(scope, args...) at `key`, on behalf of the running call. `key` must be a
  /// function of the label. Throws: UsageError if that is in the past.
  template <auto F, class... Args>
  void post(Scope& s, const Key& key, Args... args) {
    post_labelled<F>(s, key, label_as<F>(std::move(args)...));
  }

  /// Asks for a call on behalf of the outside: an input, as Engine::set is.
  template <auto F, class... Args>
  void post_from_outside(const Key& key, Args... args) {
    engine_.begin_edit("post_from_outside");
    const auto label = label_as<F>(std::move(args)...);
    engine_.on_rollback([this, label] { drop_labelled<F>(label); });
    try {
      add_labelled<F>(key, label);
    } catch (...) {
      engine_.rollback_.pop_back();
      throw;
    }
  }
  /// Takes one post_from_outside back. Throws: UsageError if there is none.
  template <auto F, class... Args>
  void retract_from_outside(Args... args) {
    engine_.begin_edit("retract_from_outside");
    const auto label = label_as<F>(std::move(args)...);
    Call& call = require_labelled<F>(label);
    engine_.on_rollback([this, key = key_of(call), label] { add_labelled<F>(key, label); });
    drop_post(call);
  }

  /// Runs what was posted, in order, as children of the running call. Once per agenda.
  void drain(Scope& s);

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  /// The same for the agenda that was made as the same one of another engine.
  [[nodiscard]] std::uint64_t number() const noexcept { return id_; }
  [[nodiscard]] std::size_t bytes() const noexcept;
  [[nodiscard]] std::uint64_t pending_calls() const noexcept { return pending_calls_; }
  void check_invariants() const;

  void retract(Call& call, Edge& edge) noexcept override;

 private:
  friend class Engine;
  using Entry = OrderedCalls::Entry;
  using Construct = void (*)(void*, const void*);

  static detail::Slot& slot(Call& call) noexcept {
    return *reinterpret_cast<detail::Slot*>(&call + 1);
  }
  static const detail::Slot& slot(const Call& call) noexcept {
    return *reinterpret_cast<const detail::Slot*>(&call + 1);
  }
  static Key key_of(const Call& call) noexcept;
  void shrink() noexcept;
  static void forget(Engine& engine, Call& call) noexcept;
  static void detach(Engine& engine, Call& call) noexcept;

  // Outside edits and their inverses go by label: a call discarded in a propagation that fails is
  // another one after the roll-back.
  template <auto F, class... Args>
  static auto label_as(Args... args) {
    return detail::make_label<&function_name<F>>(detail::parameters<F, false, Args...>(),
                                                 std::move(args)...);
  }
  template <auto F, class... Args>
  void post_labelled(Scope& s, const Key& key, const detail::Label<Args...>& label) {
    post_call(s, detail::kPosted<F, Args...>, key, label.hash, &label,
              detail::constructor_of<detail::PostedFrame<Args...>>());
  }
  template <auto F, class... Args>
  Call& require_labelled(const detail::Label<Args...>& label) const {
    return require_posted(detail::kPosted<F, Args...>, label.hash, &label);
  }
  template <auto F, class... Args>
  void add_labelled(const Key& key, const detail::Label<Args...>& label) {
    outside_post(detail::kPosted<F, Args...>, key, label.hash, &label,
                 detail::constructor_of<detail::PostedFrame<Args...>>());
  }
  template <auto F, class... Args>
  void drop_labelled(const detail::Label<Args...>& label) {
    const auto& function = detail::kPosted<F, Args...>;
    if (const Handle h = find(function, label.hash, &label); h != 0) drop_post(engine_.call(h));
  }

  void post_call(Scope& s, const Function& function, const Key& key, std::uint32_t hash,
                 const void* args, Construct construct);
  void outside_post(const Function& function, const Key& key, std::uint32_t hash, const void* args,
                    Construct construct);
  [[nodiscard]] Call& require_posted(const Function& function, std::uint32_t hash,
                                     const void* args) const;
  [[nodiscard]] Handle find(const Function& function, std::uint32_t hash, const void* args) const;
  Handle create(const Function& function, const Key& key, std::uint32_t hash, const void* args,
                Construct construct);
  [[nodiscard]] bool in_future(const Call& poster, const Call& posted) const;
  void require_future(const Call& poster, const Call& posted) const;
  void add_pending(Handle call);
  void drop_pending(Handle call) noexcept;
  void drop_unposted() noexcept;
  void chain(Call& call) noexcept;
  void adopt_detached();
  void place(Handle call);
  [[nodiscard]] Handle predecessor(const Call& call) const;
  void add_post(Call& call) noexcept;
  void require_room(const Call& call) const;
  void drop_post(Call& call, const Call* poster = nullptr) noexcept;
  [[nodiscard]] bool before(const Call& a, const Call& b) const;

  [[noreturn]] void fail_drained_twice(const Call& caller) const;
  void begin_drain(Scope& s);
  void run_pending(Scope& s);
  void run_class(std::uint32_t rank);
  void run_one(const Entry& entry, OrderedCalls& done);
  struct Drain;
  static constexpr std::uint8_t kPost = 0;
  static constexpr std::uint8_t kDrain = 1;

  Engine& engine_;
  std::string name_;
  std::uint8_t id_;
  std::map<std::uint32_t, std::vector<Entry>> pending_;
  std::map<std::uint32_t, OrderedCalls> classes_;
  std::uint64_t pending_calls_ = 0;
  bool unposted_ = false;  // a pending call lost a post
  Handle detached_ = 0;  // pending calls of a drain that is gone, chained by Call::edges
  Handle drain_call_ = 0;
  Handle running_ = 0;  // the posted call that the drain runs
  bool draining_ = false;
  bool drained_ = false;
};

}  // namespace sac
