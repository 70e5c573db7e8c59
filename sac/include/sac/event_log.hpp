// A log of the events of an engine, which explains why a call ran again.
//
//   sac::EventLog log(engine);
//   engine.set(price, 12);
//   engine.propagate();
//   std::cout << log.explain("copy");
//
//   copy(@3, @4) ran again because modifiable @3 changed,
//     written by add(@1, @2, @3), which ran again because modifiable 'price' (@1) was set from
//     outside.
//
// The log is the observer of the engine while it exists. It stores labels and names when events
// happen, because discarded calls are freed. An event takes 16 bytes, and the label of a call is
// stored once. The log does not change the behaviour of the engine, only its speed.
#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "sac/engine.hpp"
#include "sac/observer.hpp"

namespace sac {

/// The word for a kind of event: "executed".
[[nodiscard]] std::string_view word(Event::Kind kind);

/// An observer that logs events and explains them.
class EventLog final : public Observer {
 public:
  /// Becomes the observer of `engine`. Requires: the engine outlives the log.
  explicit EventLog(Engine& engine);
  ~EventLog();
  EventLog(const EventLog&) = delete;
  EventLog& operator=(const EventLog&) = delete;

  /// Explains the last event of the call with this label (it ran, was kept, or was discarded), back
  /// to an edit from outside or to the run that made it. If no call has this label, it explains the
  /// most recently logged call of the function with this name, or else with this text in its label.
  /// Returns lines that end with a newline. Cost: O(size()).
  [[nodiscard]] std::string explain(std::string_view label) const;
  [[nodiscard]] std::string explain(const Call& call) const;

  /// The number of events of this kind, in total and for the calls of one function.
  [[nodiscard]] std::uint64_t count(Event::Kind kind) const noexcept;
  [[nodiscard]] std::uint64_t count(Event::Kind kind, std::string_view function) const;
  /// Prints a line for each function, by name: `leaf: created 3, executed 5`. Events without a call
  /// are counted under `outside`.
  void print_counts(std::ostream& out) const;

  /// Prints every event on a line, oldest first: `created leaf(@3, @5) by grow(@1)`.
  void print(std::ostream& out) const;
  /// The line of one event, without a newline. Requires: i < size().
  [[nodiscard]] std::string line(std::size_t i) const;
  [[nodiscard]] std::size_t size() const noexcept { return entries_.size(); }
  /// The number of events that could not be logged: memory was short, or printing an argument
  /// threw.
  [[nodiscard]] std::uint64_t lost() const noexcept { return lost_; }
  /// Removes all events.
  void clear();

  void on(const Event& event) noexcept override;

 private:
  using CallId = std::uint32_t;  // 0: the outside
  using TextId = std::uint32_t;  // 0: none
  static constexpr std::size_t kNone = ~std::size_t{0};

  struct Entry {
    Event::Kind kind;
    CallId call;
    CallId by;
    TextId what;  // the modifiable, the observation, or the failure
  };
  struct KnownCall {
    std::string label;
    std::string_view function;
  };
  using Counts = std::array<std::uint64_t, Event::kKinds>;
  struct Reason;

  [[nodiscard]] CallId id_of(const Call* call, bool fresh);
  [[nodiscard]] TextId text_id(std::string text);
  [[nodiscard]] std::string text_of(const Event& event) const;

  [[nodiscard]] const std::string& label(CallId call) const { return calls_[call].label; }
  [[nodiscard]] bool is(std::size_t i, CallId call, Event::Kind kind) const {
    return entries_[i].call == call && entries_[i].kind == kind;
  }
  template <class Matches>
  [[nodiscard]] std::size_t last_before(std::size_t end, Matches&& matches) const;
  [[nodiscard]] std::string failure_before(std::size_t i) const;

  // An explanation goes from cause to cause. The index finds the events of one call, and of one
  // modifiable, so that all steps together read the log only a few times.
  class Index;
  [[nodiscard]] std::string explain_last(CallId call) const;
  [[nodiscard]] std::string explain_deed(const Index& index, std::size_t deed) const;
  [[nodiscard]] Reason reason_of(const Index& index, std::size_t deed) const;
  [[nodiscard]] Reason why_executed(const Index& index, std::size_t deed) const;
  [[nodiscard]] Reason why_created(const Index& index, std::size_t created) const;
  [[nodiscard]] Reason why_invalidated(const Index& index, std::size_t invalidated) const;
  [[nodiscard]] Reason why_discarded(const Index& index, std::size_t deed) const;

  Engine& engine_;
  std::vector<Entry> entries_;
  std::vector<KnownCall> calls_;  // by id
  std::vector<std::string> texts_;
  std::unordered_map<const Call*, CallId> ids_;  // an address may later be that of another call
  std::unordered_map<std::string, TextId> text_ids_;
  std::unordered_map<std::string_view, Counts> counts_;  // by function; "": no call
  std::uint64_t lost_ = 0;
};

}  // namespace sac
