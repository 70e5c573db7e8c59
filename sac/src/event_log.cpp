// Writing events down, and following causes backwards through them.
#include "sac/event_log.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <sstream>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

namespace sac {

namespace {

using Kind = Event::Kind;

// The order is that of Event::Kind.
// clang-format off
constexpr std::array<std::string_view, Event::kKinds> kWords = {
    "run_started", "propagation_started", "roll_back_started", "finished",
    "edited", "changed", "reverted", "invalidated", "returned",
    "executed", "confirmed", "failed", "reused", "created",
    "posted", "unposted", "dying", "detached", "discarded",
};
// clang-format on

bool is_phase(Kind kind) { return kind <= Kind::finished; }
bool is_change(Kind kind) {
  return kind == Kind::edited || kind == Kind::changed || kind == Kind::reverted;
}
bool is_failure(Kind kind) { return kind == Kind::failed || kind == Kind::roll_back_started; }
bool is_deed(Kind kind) { return kind == Kind::executed || kind == Kind::discarded; }

constexpr std::size_t kMostCauses = 3;  // that one line names
constexpr std::size_t kMostLines = 12;  // of an explanation; the middle of a longer one is left out

}  // namespace

std::string_view word(Event::Kind kind) { return kWords[static_cast<std::size_t>(kind)]; }

EventLog::EventLog(Engine& engine) : engine_(engine) {
  clear();
  engine_.set_observer(this);
}

EventLog::~EventLog() {
  if (engine_.observer() == this) engine_.set_observer(nullptr);
}

void EventLog::clear() {
  entries_.clear();
  calls_.assign(1, {});
  texts_.assign(1, {});
  ids_.clear();
  text_ids_.clear();
  counts_.clear();
  lost_ = 0;
}

// --- Writing down ----------------------------------------------------------------------------

void EventLog::on(const Event& event) noexcept {
  try {
    const CallId by = id_of(event.by, false);
    const CallId call = id_of(event.call, event.kind == Kind::created);
    entries_.push_back({event.kind, call, by != call ? by : 0, text_id(text_of(event))});
    ++counts_[calls_[call].function][static_cast<std::size_t>(event.kind)];
  } catch (...) {
    ++lost_;
  }
}

EventLog::CallId EventLog::id_of(const Call* call, bool fresh) {
  if (call == nullptr) return 0;
  if (const auto known = ids_.find(call); known != ids_.end() && !fresh) return known->second;
  calls_.push_back({Engine::describe(*call), call->function().name});
  return ids_[call] = static_cast<CallId>(calls_.size() - 1);
}

EventLog::TextId EventLog::text_id(std::string text) {
  if (text.empty()) return 0;
  const auto [known, fresh] = text_ids_.emplace(text, static_cast<TextId>(texts_.size()));
  if (fresh) texts_.push_back(std::move(text));
  return known->second;
}

std::string EventLog::text_of(const Event& event) const {
  if (event.message != nullptr) return event.message;
  if (event.source != nullptr) return engine_.describe_mod(event.source);
  if (event.seen == nullptr) return "";
  std::ostringstream seen;
  engine_.structure_of(*event.seen).print(*event.call, *event.seen, seen);
  return seen.str().empty() ? "" : "what it saw (" + seen.str() + ")";
}

// --- The log itself --------------------------------------------------------------------------

std::uint64_t EventLog::count(Event::Kind kind) const noexcept {
  std::uint64_t total = 0;
  for (const auto& [function, counts] : counts_) total += counts[static_cast<std::size_t>(kind)];
  return total;
}

std::uint64_t EventLog::count(Event::Kind kind, std::string_view function) const {
  const auto counts = counts_.find(function);
  return counts != counts_.end() ? counts->second[static_cast<std::size_t>(kind)] : 0;
}

void EventLog::print_counts(std::ostream& out) const {
  std::vector<std::string_view> functions;
  for (const auto& [function, counts] : counts_) functions.push_back(function);
  std::sort(functions.begin(), functions.end());
  for (const std::string_view function : functions) {
    out << (function.empty() ? "outside" : function);
    const char* separator = ": ";
    for (std::size_t kind = 0; kind < Event::kKinds; ++kind) {
      const std::uint64_t n = counts_.at(function)[kind];
      if (n == 0) continue;
      out << separator << kWords[kind] << ' ' << n;
      separator = ", ";
    }
    out << '\n';
  }
}

std::string EventLog::line(std::size_t i) const {
  const Entry& e = entries_[i];
  std::string text(word(e.kind));
  if (is_change(e.kind)) {
    text += ' ' + texts_[e.what];
    if (e.call != 0) text += " in " + label(e.call);
  } else {
    if (e.call != 0) text += ' ' + label(e.call);
    if (e.what != 0) text.append(is_failure(e.kind) ? ": " : " at ").append(texts_[e.what]);
  }
  if (e.by != 0) text += " by " + label(e.by);
  return text;
}

void EventLog::print(std::ostream& out) const {
  for (std::size_t i = 0; i < size(); ++i) out << line(i) << '\n';
  if (lost_ != 0) out << lost_ << " events are lost\n";
}

// --- Looking back ----------------------------------------------------------------------------

template <class Matches>
std::size_t EventLog::last_before(std::size_t end, Matches&& matches) const {
  while (end-- > 0) {
    if (matches(entries_[end])) return end;
  }
  return kNone;
}

// Where the events of each call are, and the changes of each modifiable.
class EventLog::Index {
 public:
  explicit Index(const EventLog& log)
      : log_(log), of_call_(log.calls_.size()), changes_(log.texts_.size()) {
    for (std::size_t i = 0; i < log.size(); ++i) {
      const Entry& e = log.entries_[i];
      of_call_[e.call].push_back(i);
      if (is_change(e.kind)) changes_[e.what].push_back(i);
      if (is_phase(e.kind)) phases_.push_back(i);
    }
  }
  // The last event of `call` before event `end` that matches(event).
  template <class Matches>
  [[nodiscard]] std::size_t last_of(CallId call, std::size_t end, Matches&& matches) const {
    const auto& events = of_call_[call];
    auto it = std::lower_bound(events.begin(), events.end(), end);
    while (it != events.begin()) {
      if (matches(log_.entries_[*--it])) return *it;
    }
    return kNone;
  }
  // When `call` last ran or was discarded.
  [[nodiscard]] std::size_t last_deed(CallId call, std::size_t end) const {
    if (call == 0) return kNone;
    return last_of(call, end, [](const Entry& e) { return is_deed(e.kind); });
  }
  // The events of `call` from event `begin` to before event `end`.
  [[nodiscard]] std::span<const std::size_t> between(CallId call, std::size_t begin,
                                                     std::size_t end) const {
    const auto& events = of_call_[call];
    return {std::lower_bound(events.begin(), events.end(), begin),
            std::lower_bound(events.begin(), events.end(), end)};
  }
  // The last change before event `end` of what is called so.
  [[nodiscard]] std::size_t last_change(TextId what, std::size_t end) const {
    return what != 0 ? last(changes_[what], end) : kNone;
  }
  // The start of the run, propagation or roll-back that event i is in; an end if it is in none.
  [[nodiscard]] std::size_t phase_of(std::size_t i) const { return last(phases_, i); }

 private:
  [[nodiscard]] static std::size_t last(const std::vector<std::size_t>& events, std::size_t end) {
    const auto it = std::lower_bound(events.begin(), events.end(), end);
    return it != events.begin() ? *std::prev(it) : kNone;
  }

  const EventLog& log_;
  std::vector<std::vector<std::size_t>> of_call_;
  std::vector<std::vector<std::size_t>> changes_;
  std::vector<std::size_t> phases_;
};

// What threw, for what happens in a roll-back. Exceptions pass through calls from the inside out;
// what a call has caught said something else, mostly.
std::string EventLog::failure_before(std::size_t i) const {
  const std::size_t end =
      last_before(i, [](const Entry& e) { return e.kind == Kind::roll_back_started; });
  const std::size_t from = last_before(end == kNone ? i : end, [](const Entry& e) {
    return e.kind == Kind::run_started || e.kind == Kind::propagation_started;
  });
  if (end == kNone || from == kNone) return "the propagation failed";
  const TextId what = entries_[end].what;
  std::size_t first = from;
  while (first < end && !(entries_[first].kind == Kind::failed && entries_[first].what == what)) {
    ++first;
  }
  std::string text = entries_[from].kind == Kind::run_started ? "the run" : "the propagation";
  if (first < end) text = label(entries_[first].call);
  text += " failed";
  if (what != 0) text.append(" (").append(texts_[what]).append(")");
  return text;
}

// --- Explaining ------------------------------------------------------------------------------

// Why something was done: `text`, and where to ask on: `lead` says what call `who` has to do with
// it, `next` is what that call did then.
struct EventLog::Reason {
  std::string text;
  std::string lead = {};
  CallId who = 0;
  std::size_t next = kNone;
};

std::string EventLog::explain(std::string_view wanted) const {
  enum Match : char { none, contains, is_of_function, is_it };
  std::vector<Match> match(calls_.size());
  std::array<std::size_t, is_it + 1> counts{};
  for (CallId c = 1; c < calls_.size(); ++c) {
    const std::string& text = label(c);
    if (text == wanted) {
      match[c] = is_it;
    } else if (text.starts_with(wanted) && text[wanted.size()] == '(') {
      match[c] = is_of_function;
    } else if (text.find(wanted) != std::string::npos) {
      match[c] = contains;
    }
    ++counts[match[c]];
  }
  const Match best = counts[is_it] != 0            ? is_it
                     : counts[is_of_function] != 0 ? is_of_function
                                                   : contains;
  const std::size_t last =
      last_before(size(), [&](const Entry& e) { return match[e.call] == best; });
  if (last == kNone) return "No call '" + std::string(wanted) + "' is in the log.\n";
  std::string text = explain_last(entries_[last].call);
  if (const std::size_t n = counts[best]; n > 1) {
    text += "(The last of " + std::to_string(n) + " calls '" + std::string(wanted) + "'.)\n";
  }
  return text;
}

std::string EventLog::explain(const Call& call) const {
  const auto known = ids_.find(&call);
  if (known != ids_.end()) return explain_last(known->second);
  return "No call '" + Engine::describe(call) + "' is in the log.\n";
}

std::string EventLog::explain_last(CallId call) const {
  const Index index(*this);
  const std::size_t deed = index.last_of(call, size(), [](const Entry& e) {
    return is_deed(e.kind) || e.kind == Kind::confirmed || e.kind == Kind::reused ||
           e.kind == Kind::created;
  });
  if (deed == kNone) return label(call) + " has not run since the log began.\n";
  return explain_deed(index, deed);
}

std::string EventLog::explain_deed(const Index& index, std::size_t deed) const {
  std::vector<std::string> lines{label(entries_[deed].call) + ' '};
  while (deed != kNone) {
    const Reason reason = reason_of(index, deed);
    lines.back() += reason.text;
    if (reason.who != 0) {
      std::string next = "  " + reason.lead + label(reason.who);
      if (reason.next != kNone) next += reason.lead.empty() ? " " : ", which ";
      lines.push_back(std::move(next));
    }
    deed = reason.next;
  }
  std::string text;
  const std::size_t left_out = lines.size() > kMostLines ? lines.size() - kMostLines : 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (left_out != 0 && i == kMostLines / 2) {
      text += "  (" + std::to_string(left_out) + " more)\n";
      i += left_out;
    }
    text += lines[i] + (i + 1 < lines.size() ? ",\n" : ".\n");
  }
  return text;
}

EventLog::Reason EventLog::reason_of(const Index& index, std::size_t deed) const {
  const Entry& e = entries_[deed];
  switch (e.kind) {
    case Kind::executed:
      return why_executed(index, deed);
    case Kind::created:
      return why_created(index, deed);
    case Kind::confirmed:
      return {"did not run again: it would have read the same values"};
    case Kind::reused:
      return {"was kept", "asked for again by ", e.by, index.last_deed(e.by, deed)};
    default:
      return why_discarded(index, deed);
  }
}

// All that has happened to the call since it ran before, or found that it need not.
EventLog::Reason EventLog::why_executed(const Index& index, std::size_t deed) const {
  const CallId call = entries_[deed].call;
  const std::size_t before = index.last_of(call, deed, [](const Entry& e) {
    return e.kind == Kind::executed || e.kind == Kind::confirmed;
  });
  Reason reason;
  std::vector<std::string> causes;
  std::unordered_set<std::string> known;
  for (const std::size_t i : index.between(call, before == kNone ? 0 : before + 1, deed)) {
    if (is(i, call, Kind::created)) return why_created(index, i);
    if (is(i, call, Kind::detached)) return {"ran again because the drain that ran it is gone"};
    if (!is(i, call, Kind::invalidated)) continue;
    Reason cause = why_invalidated(index, i);
    if (causes.empty()) reason = cause;
    if (known.insert(cause.text).second) causes.push_back(std::move(cause.text));
  }
  if (causes.empty()) return {"ran; why, was before the log began"};
  reason.text = "ran again because ";
  for (std::size_t i = 0; i < std::min(causes.size(), kMostCauses); ++i) {
    reason.text += (i > 0 ? " and " : "") + causes[i];
  }
  if (causes.size() > kMostCauses) {
    reason.text += " and for " + std::to_string(causes.size() - kMostCauses) + " causes more";
  }
  if (causes.size() > 1 && !reason.lead.empty()) reason.lead = "the first " + reason.lead;
  return reason;
}

EventLog::Reason EventLog::why_created(const Index& index, std::size_t created) const {
  const Entry& e = entries_[created];
  bool posted = false;
  for (std::size_t i = created + 1; i < size() && !posted && !is_deed(entries_[i].kind); ++i) {
    posted = is(i, e.call, Kind::posted);
  }
  if (e.by == 0) return {posted ? "is new: posted from outside" : "is new: run from outside"};
  return {"is new", posted ? "posted by " : "asked for by ", e.by, index.last_deed(e.by, created)};
}

EventLog::Reason EventLog::why_invalidated(const Index& index, std::size_t invalidated) const {
  const Entry& e = entries_[invalidated];
  const std::size_t previous = invalidated > 0 ? invalidated - 1 : 0;
  if (is(previous, e.call, Kind::failed)) return {"it had failed"};
  if (is(previous, e.call, Kind::returned)) {
    const CallId by = entries_[previous].by;
    return {"the result of " + label(by) + " changed", "", by, index.last_deed(by, invalidated)};
  }
  const std::string text = e.what != 0 ? texts_[e.what] : "what it saw";
  const std::size_t change = index.last_change(e.what, invalidated);
  if (change == kNone) {
    return {text + " changed", "because of ", e.by, index.last_deed(e.by, invalidated)};
  }
  const Entry& c = entries_[change];
  if (c.kind == Kind::edited) {
    const std::size_t phase = index.phase_of(change);
    const bool back = phase != kNone && entries_[phase].kind == Kind::roll_back_started;
    return {text +
            (back ? " was set back when " + failure_before(change) : " was set from outside")};
  }
  return {text + " changed", c.kind == Kind::changed ? "written by " : "no longer written by ",
          c.call, index.last_deed(c.call, change)};
}

EventLog::Reason EventLog::why_discarded(const Index& index, std::size_t deed) const {
  const Entry& e = entries_[deed];
  const std::size_t dying = last_before(deed, [](const Entry& d) { return d.kind == Kind::dying; });
  const CallId dead = dying != kNone ? entries_[dying].call : 0;
  const std::size_t gone = last_before(
      deed, [&](const Entry& d) { return d.kind == Kind::discarded && d.call == dead; });
  if (dead != 0 && (gone == kNone || gone < dying)) {
    const std::size_t last = last_before(
        dying, [&](const Entry& u) { return u.kind == Kind::unposted && u.call == dead; });
    const CallId poster = last != kNone ? entries_[last].by : 0;
    const std::string text = e.call == dead
                                 ? ": nobody posts it any more"
                                 : " with " + label(dead) + ", which nobody posts any more";
    return {"was discarded" + text, "last posted by ", poster, index.last_deed(poster, dying)};
  }
  if (e.by == 0) return {"was discarded because " + failure_before(deed)};
  return {"was discarded", "not asked for again by ", e.by, index.last_deed(e.by, deed)};
}

}  // namespace sac
