// Two walks over the trace: one names the keyed objects, the next writes the calls.
#include "traces/recorder.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <locale>
#include <optional>
#include <ostream>
#include <streambuf>
#include <vector>

#include "sac/check.hpp"
#include "traces/trace_file.hpp"

namespace traces {
namespace {

class TextBuffer final : public std::streambuf {
 public:
  std::string text;

 private:
  int_type overflow(int_type c) override {
    if (c != traits_type::eof()) text.push_back(traits_type::to_char_type(c));
    return traits_type::not_eof(c);
  }
  std::streamsize xsputn(const char* bytes, std::streamsize count) override {
    text.append(bytes, static_cast<std::size_t>(count));
    return count;
  }
};

// A stream into a string that keeps its memory.
class TextStream final : public std::ostream {
 public:
  TextStream() : std::ostream(nullptr) {
    rdbuf(&buffer_);
    imbue(std::locale::classic());
  }
  /// Empties the stream; formats that the last printer left behind are forgotten.
  TextStream& start(std::streamsize digits) {
    buffer_.text.clear();
    clear();
    flags(std::ios::dec | std::ios::skipws);
    precision(digits);
    fill(' ');
    return *this;
  }
  [[nodiscard]] const std::string& text() const noexcept { return buffer_.text; }

 private:
  TextBuffer buffer_;
};

// The keyed allocations of the trace: which one a handle lies in, and its label.
class KeyedObjects {
 public:
  explicit KeyedObjects(const sac::Engine& engine) {
    engine.walk([&](const sac::Call& call, std::size_t) {
      if (is_keyed(call)) starts_.push_back(engine.handle_of(call).handle());
    });
    std::sort(starts_.begin(), starts_.end());
    labels_.resize(starts_.size());
  }

  static bool is_keyed(const sac::Call& call) { return call.function().object_offset != 0; }

  void set_label(sac::Ref<sac::Call> call, const LabelHash& label) {
    labels_[index_of(call.handle())] = label;
  }

  /// Label and offset of what lies at `handle`; nothing if that is in no object named so far.
  [[nodiscard]] std::optional<LabelHash> name(const sac::Engine& engine, sac::Handle handle) const {
    if (starts_.empty() || handle < starts_.front()) return {};
    const std::size_t i = index_of(handle);
    const std::size_t offset = std::size_t{handle - starts_[i]} * sac::Arena::kGranule;
    if (offset >= engine.call(sac::Ref<sac::Call>(starts_[i])).function().frame_bytes ||
        labels_[i] == LabelHash{})
      return {};
    LabelHasher hasher;
    hasher.hash(labels_[i]);
    hasher.word(offset);
    return hasher.result();
  }

 private:
  // The last object that starts at or before `handle`.
  [[nodiscard]] std::size_t index_of(sac::Handle handle) const {
    const auto behind = std::upper_bound(starts_.begin(), starts_.end(), handle);
    return static_cast<std::size_t>(behind - starts_.begin()) - 1;
  }

  std::vector<sac::Handle> starts_;
  std::vector<LabelHash> labels_;  // of the call at starts_[i]; zero: not yet named
};

}  // namespace

// Hashes labels. A keyed object is named by function and key alone, which refer to objects made
// earlier in the trace: one walk names them all. What calls read and return may refer to any.
class Labeller final : public sac::LabelSink {
 public:
  explicit Labeller(const Recorder& recorder)
      : recorder_(recorder), engine_(recorder.engine_), objects_(engine_) {
    bool results = false;
    engine_.walk([&](const sac::Call& call, std::size_t) {
      results = results || call.function().has_result;
      if (!KeyedObjects::is_keyed(call)) return;
      start(call);
      if (named_) objects_.set_label(engine_.handle_of(call), hasher_.result());
    });
    if (results) collect_results();
  }

  /// The label of call `number` in pre-order.
  LabelHash hash(const sac::Call& call, std::size_t number) {
    start(call);
    engine_.for_each_edge(
        call, [&](const sac::Edge& edge) { engine_.structure_of(edge).label(call, edge, *this); });
    if (!results_.empty() && results_[number].any) {
      hasher_.hash(results_[number].names);
      named_ = named_ && results_[number].named;
    }
    return hasher_.result();
  }
  /// What the edge saw; 0: it is no observation.
  LabelHash hash(const sac::Call& call, const sac::Edge& edge) {
    hasher_ = {};
    engine_.structure_of(edge).label(call, edge, *this);
    const LabelHash saw = hasher_.result();
    return saw == LabelHasher().result() ? LabelHash{} : saw;
  }
  /// Whether all in the last label had a name.
  [[nodiscard]] bool named() const noexcept { return named_; }

  void number(std::uint64_t value) override { hasher_.word(value); }
  void text(std::string_view value) override { hasher_.text(value); }
  void handle(sac::Handle handle) override {
    if (handle == 0) return hasher_.word(0);
    if (const auto it = recorder_.handles_.find(handle); it != recorder_.handles_.end()) {
      return hasher_.hash(it->second);
    }
    if (const auto name = objects_.name(engine_, handle)) return hasher_.hash(*name);
    if (!name_outside(engine_.arena().at<std::byte>(handle))) nameless(handle);
  }
  void address(const void* object) override {
    if (object == nullptr) return hasher_.word(0);
    if (name_outside(static_cast<const std::byte*>(object))) return;
    const auto number = reinterpret_cast<std::uintptr_t>(object);
    if (!engine_.arena().contains(object)) return nameless(number);
    handle(engine_.arena().handle_of(object));
    hasher_.word(number % sac::Arena::kGranule);
  }
  std::ostream& print_begin() override { return printed_.start(kAllDigits); }
  void print_end() override { hasher_.text(printed_.text()); }
  void nameless(std::uint64_t hash) override {
    named_ = false;
    hasher_.word(hash);
  }

 private:
  // Function and arguments.
  void start(const sac::Call& call) {
    hasher_ = {};
    named_ = true;
    hasher_.text(call.function().name);
    call.function().label(call, *this);
  }

  void collect_results() {
    results_.resize(engine_.live_calls());
    std::vector<std::size_t> open;  // numbers of the current call and those around it
    std::size_t number = 0;
    engine_.walk([&](const sac::Call& call, std::size_t depth) {
      open.resize(depth);
      open.push_back(number++);
      if (depth == 0 || !call.function().has_result) return;
      Results& results = results_[open[depth - 1]];
      hasher_ = {};
      named_ = results.named;
      hasher_.hash(results.names);
      call.function().label_result(call, *this);
      results = {hasher_.result(), named_, true};
    });
  }

  // Names what lies in an object that name() was called for; false if it lies in none.
  bool name_outside(const std::byte* place) {
    auto it = recorder_.addresses_.upper_bound(place);
    if (it == recorder_.addresses_.begin()) return false;
    const auto& [start, object] = *--it;
    const auto offset = static_cast<std::size_t>(place - start);
    if (offset >= object.bytes) return false;
    hasher_.hash(object.name);
    if (offset != 0) hasher_.word(offset);
    return true;
  }

  // Of a call's children, in order.
  struct Results {
    LabelHash names;
    bool named = true;
    bool any = false;
  };

  static constexpr std::streamsize kAllDigits = 21;  // of a long double, in decimal

  const Recorder& recorder_;
  const sac::Engine& engine_;
  KeyedObjects objects_;
  TextStream printed_;
  LabelHasher hasher_;
  bool named_ = true;
  std::vector<Results> results_;  // by number of call; empty: no call has a result
};

namespace {

// A call as the walk meets it.
struct Visit {
  const sac::Call& call;
  std::size_t number;
  std::uint32_t depth;
  bool tail;
  std::uint32_t function;  // index, in the order of first calls
  bool new_function;
};

// Calls each(Visit) for every live call in pre-order. A tail call shares the end stamp of the call
// that it continues.
template <class Each>
void walk_calls(const sac::Engine& engine, Each&& each) {
  std::map<const sac::Function*, std::uint32_t> functions;
  std::vector<sac::Place> ends;  // of the calls around the current one
  std::size_t number = 0;
  engine.walk([&](const sac::Call& call, std::size_t depth) {
    const auto next = static_cast<std::uint32_t>(functions.size());
    const auto [function, is_new] = functions.try_emplace(&call.function(), next);
    ends.resize(depth);
    const bool tail = depth > 0 && call.end != nullptr && call.end == ends.back();
    ends.push_back(call.end);
    each(Visit{call, number++, static_cast<std::uint32_t>(depth), tail, function->second, is_new});
  });
}

void require_idle(const sac::Engine& engine) {
  if (!engine.idle()) throw sac::UsageError("record: the engine is running");
}

// What a call read, did and returned.
void print_edges(const sac::Engine& engine, const sac::Call& call, Labeller& labeller,
                 TextStream& printed, std::vector<EdgeRecord>& edges) {
  edges.clear();
  engine.for_each_edge(call, [&](const sac::Edge& edge) {
    engine.structure_of(edge).print(call, edge, printed.start(6));
    const LabelHash hash = labeller.hash(call, edge);
    if (!printed.text().empty() || hash != LabelHash{}) edges.push_back({hash, printed.text()});
  });
  if (!call.function().has_result) return;
  printed.start(6) << "returns ";
  call.function().print_result(call, printed);
  edges.push_back({{}, printed.text()});
}

}  // namespace

Recording Recorder::record(const std::string& path, Edges edges) const {
  require_idle(engine_);
  TraceWriter writer(path);
  Labeller labeller(*this);
  TextStream printed;
  Recording result;
  CallRecord record;
  walk_calls(engine_, [&](const Visit& visit) {
    const sac::Function& function = visit.call.function();
    if (visit.new_function) writer.add_function(function.name);
    record.depth = visit.depth;
    record.tail = visit.tail;
    record.function = visit.function;
    record.hash = labeller.hash(visit.call, visit.number);
    record.named = labeller.named();
    function.print(visit.call, printed.start(6));
    record.arguments = printed.text();
    record.weight = engine_.weight_of(visit.call);
    if (edges == Edges::yes) {
      print_edges(engine_, visit.call, labeller, printed, record.edges);
    }
    writer.add_call(record);
    ++result.calls;
    result.unnamed += record.named ? 0 : 1;
  });
  writer.finish();
  return result;
}

Trace Recorder::trace() const {
  require_idle(engine_);
  Labeller labeller(*this);
  Trace trace;
  trace.calls.reserve(engine_.live_calls());
  walk_calls(engine_, [&](const Visit& visit) {
    if (visit.new_function) trace.functions.emplace_back(visit.call.function().name);
    trace.add({labeller.hash(visit.call, visit.number), visit.function, visit.depth, visit.tail},
              engine_.weight_of(visit.call));
    trace.unnamed += labeller.named() ? 0 : 1;
  });
  return trace;
}

}  // namespace traces
