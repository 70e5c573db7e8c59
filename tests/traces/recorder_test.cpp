#include "traces/recorder.hpp"

#include <catch2/catch.hpp>
#include <memory>
#include <vector>

#include "programs.hpp"
#include "scratch_file.hpp"
#include "traces/distance.hpp"
#include "traces/trace.hpp"
#include "traces/trace_file.hpp"

namespace {

using support::ScratchFolder;

struct Line {
  std::uint32_t depth;
  std::string label;
  bool named;
  traces::LabelHash hash;
};

std::vector<Line> lines_of(const std::string& path) {
  std::vector<Line> lines;
  traces::TraceReader reader(path);
  while (const auto* call = reader.next()) {
    lines.push_back({call->depth,
                     traces::label_text(reader.functions()[call->function], call->arguments),
                     call->named, call->hash});
  }
  return lines;
}

// Records f(args...) in an engine of its own; its lines.
template <auto F, class... Args>
std::vector<Line> recorded(Args... args) {
  ScratchFolder folder;
  sac::Engine engine;
  engine.run<F>(args...);
  traces::Recorder(engine).record(folder.path("t"));
  return lines_of(folder.path("t"));
}

template <auto F, class... Args>
traces::LabelHash hash_of(Args... args) {
  const auto lines = recorded<F>(args...);
  REQUIRE(lines.front().named);
  return lines.front().hash;
}

void leaf(sac::Scope&, int) {}
void tree(sac::Scope& s, int height) {
  if (height == 0) return;
  s.call<tree>(height - 1);
  s.call<leaf>(height);
}

void take_real(sac::Scope&, double) {}
void take_text(sac::Scope&, std::string) {}
struct TakeAny {
  void operator()(sac::Scope&, const auto&) const {}
};

// Prints its address, like a handle, and names itself by its id.
struct Named {
  int id;
  const void* place;
  friend bool operator==(const Named&, const Named&) = default;
  friend std::uint64_t hash_value(const Named& n) {
    return reinterpret_cast<std::uintptr_t>(n.place);
  }
  friend std::ostream& operator<<(std::ostream& out, const Named& n) { return out << n.place; }
  friend void label_bytes(sac::LabelSink& sink, const Named& n) {
    sink.number(static_cast<std::uint64_t>(n.id));
  }
};
void take_named(sac::Scope&, Named) {}

// Only printed; full digits matter.
struct Printed {
  double x;
  friend bool operator==(const Printed&, const Printed&) = default;
  friend std::uint64_t hash_value(const Printed&) { return 0; }
  friend std::ostream& operator<<(std::ostream& out, const Printed& p) { return out << '<' << p.x; }
};
void take_printed(sac::Scope&, Printed) {}

struct Opaque {
  int id;
  friend bool operator==(const Opaque&, const Opaque&) = default;
  friend std::uint64_t hash_value(const Opaque& o) { return static_cast<std::uint64_t>(o.id); }
};
void take_opaque(sac::Scope&, Opaque) {}
void take_pointer(sac::Scope&, const int*) {}
void take_mod(sac::Scope&, sac::Mod<int>) {}

void copy_int(sac::Scope& s, sac::Mod<int> in, sac::Mod<int> out) { s.write(out, s.read(in)); }
void read_pointer(sac::Scope& s, sac::Mod<const int*> mod) { static_cast<void>(s.read(mod)); }

void read_and_write(sac::Scope& s, sac::Mod<int> in, sac::Mod<int> out) {
  static_cast<void>(s.read(in));
  s.write(out, s.environment<int>());
}
// The label of a call that reads `value` and writes `written`.
traces::LabelHash read_and_written(int value, int written) {
  sac::Engine engine;
  engine.set_environment(&written);
  const auto in = engine.input(value), out = engine.cell<int>();
  engine.run<read_and_write>(in, out);
  traces::Recorder recorder(engine);
  recorder.name(in, "in");
  recorder.name(out, "out");
  return recorder.trace().calls.at(0).hash;
}

int value_of(sac::Scope& s, sac::Mod<int> in) { return s.read(in); }
int sum(sac::Scope& s, sac::Mod<int> a, sac::Mod<int> b) {
  const int first = s.call<value_of>(a);
  return first + s.call<value_of>(b);
}
void sum_twice(sac::Scope& s, sac::Mod<int> a, sac::Mod<int> b) {
  static_cast<void>(2 * s.call<sum>(a, b));
}
// The labels of sum_twice(a, b) and its descendants.
std::vector<traces::LabelHash> sum_labels(int a, int b) {
  sac::Engine engine;
  const auto first = engine.input(a), second = engine.input(b);
  engine.run<sum_twice>(first, second);
  traces::Recorder recorder(engine);
  recorder.name(first, "first");
  recorder.name(second, "second");
  std::vector<traces::LabelHash> labels;
  for (const auto& call : recorder.trace().calls) labels.push_back(call.hash);
  return labels;
}

void post_and_drain(sac::Scope& s) {
  auto& agenda = s.environment<sac::Agenda>();
  agenda.post<leaf>(s, sac::Key{.bucket = 1}, 5);
  agenda.drain(s);
}

}  // namespace

TEST_CASE("A recording holds the live calls in pre-order with depth and label") {
  const auto lines = recorded<tree>(2);
  std::vector<std::pair<std::uint32_t, std::string>> shown;
  for (const Line& line : lines) shown.emplace_back(line.depth, line.label);
  CHECK(shown ==
        std::vector<std::pair<std::uint32_t, std::string>>{
            {0, "tree(2)"}, {1, "tree(1)"}, {2, "tree(0)"}, {2, "leaf(1)"}, {1, "leaf(2)"}});
}

TEST_CASE("Labels of numbers and strings have a name by value") {
  CHECK(hash_of<leaf>(1) == hash_of<leaf>(1));
  CHECK(hash_of<leaf>(1) != hash_of<leaf>(-1));
  CHECK(hash_of<take_real>(0.0) == hash_of<take_real>(-0.0));
  CHECK(hash_of<take_real>(0.1) != hash_of<take_real>(0.1 + 1e-17 * 4));
  CHECK(hash_of<take_text>(std::string("abc")) != hash_of<take_text>(std::string("abd")));
  const std::string same = "text";
  CHECK(hash_of<take_text>(same.c_str()) == hash_of<take_text>(same));
  CHECK(hash_of<TakeAny{}>(same.c_str()) == hash_of<TakeAny{}>(same));
}

TEST_CASE("A type that says its own name is named by it, not by its print or hash") {
  const int here = 0, there = 0;
  CHECK(hash_of<take_named>(Named{7, &here}) == hash_of<take_named>(Named{7, &there}));
  CHECK(hash_of<take_named>(Named{7, &here}) != hash_of<take_named>(Named{8, &here}));
}

TEST_CASE("A type that only prints is named by its print with all digits") {
  CHECK(hash_of<take_printed>(Printed{1.5}) == hash_of<take_printed>(Printed{1.5}));
  CHECK(hash_of<take_printed>(Printed{1}) != hash_of<take_printed>(Printed{1 + 1e-15}));
}

TEST_CASE("A call with an argument that has no name is marked, and told apart in its run") {
  CHECK_FALSE(recorded<take_opaque>(Opaque{1}).front().named);
  CHECK(recorded<take_opaque>(Opaque{1}).front().hash !=
        recorded<take_opaque>(Opaque{2}).front().hash);
  const int object = 0;
  CHECK_FALSE(recorded<take_pointer, const int*>(&object).front().named);
  CHECK(recorded<take_pointer, const int*>(nullptr).front().named);

  ScratchFolder folder;
  sac::Engine engine;
  engine.run<take_mod>(engine.input(1));
  CHECK(traces::Recorder(engine).record(folder.path("t")).unnamed == 1);
}

TEST_CASE("Inputs and outside objects are named by name()") {
  ScratchFolder folder;
  const int objects[2] = {0, 0};
  std::vector<traces::LabelHash> hashes;
  for (const int run : {0, 1}) {
    sac::Engine engine;
    for (int i = 0; i < run; ++i) static_cast<void>(engine.input(i));
    const auto mod = engine.input(5);
    engine.run<take_mod>(mod);
    engine.run<take_pointer, const int*>(&objects[run]);
    traces::Recorder recorder(engine);
    recorder.name(mod, "five");
    recorder.name(&objects[run], "object", 1);
    CHECK(recorder.record(folder.path("t")).unnamed == 0);
    for (const Line& line : lines_of(folder.path("t"))) hashes.push_back(line.hash);
  }
  CHECK(hashes[0] == hashes[2]);
  CHECK(hashes[1] == hashes[3]);
}

TEST_CASE("What lies in an outside object that has a name is named by it and its place") {
  struct Pair {
    int first, second;
  };
  std::vector<traces::LabelHash> hashes;
  for (const int run : {0, 1}) {
    std::vector<Pair> pairs(static_cast<std::size_t>(3 + run));
    sac::Engine engine;
    engine.run<take_pointer, const int*>(&pairs[1].first);
    engine.run<take_pointer, const int*>(&pairs[1].second);
    traces::Recorder recorder(engine);
    recorder.name(&pairs[1], "pair", 1);
    const traces::Trace trace = recorder.trace();
    CHECK(trace.unnamed == 0);
    for (const auto& call : trace.calls) hashes.push_back(call.hash);
  }
  CHECK(hashes[0] == hashes[2]);
  CHECK(hashes[1] == hashes[3]);
  CHECK(hashes[0] != hashes[1]);
}

TEST_CASE("Values read are part of the label [Def 1.4.1]") {
  const auto one = read_and_written(1, 5);
  CHECK(one == read_and_written(1, 5));
  CHECK(one != read_and_written(2, 5));
  CHECK(one == read_and_written(1, 6));  // what is written is not
}

TEST_CASE("A value read that has no name marks the call") {
  const int object = 0;
  sac::Engine engine;
  const auto mod = engine.input(&object);
  engine.run<read_pointer>(mod);
  traces::Recorder recorder(engine);
  recorder.name(mod, "mod");
  CHECK(recorder.trace().unnamed == 1);
  recorder.name(&object, "object");
  CHECK(recorder.trace().unnamed == 0);
}

TEST_CASE("Results of children are part of the label, and of their callers' only [Def 1.4.1]") {
  const auto a = sum_labels(3, 4), same = sum_labels(3, 4), b = sum_labels(3, 5);
  const auto swapped = sum_labels(4, 3);
  REQUIRE(a.size() == 4);  // sum_twice, sum, value_of, value_of
  CHECK(a == same);
  CHECK(a[0] != b[0]);  // sum returns something else
  CHECK(a[1] != b[1]);  // value_of does
  CHECK(a[2] == b[2]);
  CHECK(a[3] != b[3]);        // reads something else
  CHECK(a[0] == swapped[0]);  // the sum is the same
  CHECK(a[1] != swapped[1]);
}

TEST_CASE("Edges that were asked for are recorded as text, with what observations saw") {
  ScratchFolder folder;
  sac::Engine engine;
  const auto in = engine.input(1), out = engine.cell<int>();
  engine.run<copy_int>(in, out);
  engine.run<sum_twice>(in, in);
  traces::Recorder recorder(engine);
  recorder.name(in, "in");
  recorder.name(out, "out");
  recorder.record(folder.path("t"), traces::Edges::yes);
  traces::TraceReader reader(folder.path("t"));
  const auto* call = reader.next();
  REQUIRE(call->edges.size() == 2);
  CHECK(call->edges[0].text == "reads 1");
  CHECK(call->edges[0].hash != traces::LabelHash{});
  CHECK(call->edges[1].text.starts_with("writes "));
  CHECK(call->edges[1].text.ends_with(": 1"));
  CHECK(call->edges[1].hash == traces::LabelHash{});
  call = reader.next();
  CHECK(call->edges.empty());
  call = reader.next();
  REQUIRE(call->edges.size() == 1);
  CHECK(call->edges[0].text == "returns 2");
  call = reader.next();
  REQUIRE(call->edges.size() == 2);
  CHECK(call->edges[0].text == "reads 1");
  CHECK(call->edges[1].text == "returns 1");
  recorder.record(folder.path("plain"));
  CHECK(traces::distance(traces::load_trace(folder.path("t")),
                         traces::load_trace(folder.path("plain")))
            .all.distance() == 0);
}

TEST_CASE("The drain of an agenda is named by the agenda") {
  const auto run = [](const std::string& name) {
    ScratchFolder folder;
    sac::Engine engine;
    sac::Agenda& agenda = engine.make_agenda(name);
    engine.set_environment(&agenda);
    engine.run<post_and_drain>();
    CHECK(traces::Recorder(engine).record(folder.path("t")).unnamed == 0);
    return lines_of(folder.path("t"));
  };
  const auto one = run("queue"), same = run("queue"), other = run("stack");
  REQUIRE(one.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) CHECK(one[i].hash == same[i].hash);
  CHECK(one[1].hash != other[1].hash);
}

TEST_CASE("What keyed allocation made is named by its key, whatever its handle is") {
  ScratchFolder folder;
  const programs::ListMap one({1, 2, 3}), other({1, 2, 3}, 1000);
  CHECK(one.record(folder.path("one")).unnamed == 0);
  CHECK(other.record(folder.path("other")).unnamed == 0);
  const auto a = lines_of(folder.path("one")), b = lines_of(folder.path("other"));
  REQUIRE(a.size() == 4 + 2 * 3);
  REQUIRE(b.size() == a.size());
  for (std::size_t i = 0; i < a.size(); ++i) CHECK(a[i].hash == b[i].hash);
  CHECK(a[0].label != b[0].label);  // handles print differently: the runs do differ in them
}

TEST_CASE("A trace in memory is the one that a file holds") {
  ScratchFolder folder;
  const programs::ListMap list({1, 2, 3});
  const auto recording = list.record(folder.path("t"));
  const traces::Trace loaded = traces::load_trace(folder.path("t")), trace = list.trace();
  CHECK(trace.functions == loaded.functions);
  CHECK(trace.unnamed == recording.unnamed);
  REQUIRE(trace.calls.size() == loaded.calls.size());
  REQUIRE(trace.calls.size() == recording.calls);
  for (std::size_t i = 0; i < trace.calls.size(); ++i) {
    const auto &a = trace.calls[i], &b = loaded.calls[i];
    CHECK(a.hash == b.hash);
    CHECK(a.function == b.function);
    CHECK(a.depth == b.depth);
    CHECK(a.tail == b.tail);
  }
}

TEST_CASE("Tail calls are told from other children") {
  std::vector<std::pair<int, bool>> calls;
  for (const auto& call : programs::ListMap({1, 2}).trace().calls) {
    calls.emplace_back(call.depth, call.tail);
  }
  CHECK(calls ==
        std::vector<std::pair<int, bool>>{
            {0, false}, {1, false}, {1, false}, {1, true}, {2, false}, {2, false}, {2, true}});
}

TEST_CASE("A trace after propagation is the trace of a fresh run") {
  ScratchFolder folder;
  programs::ListMap edited({1, 2, 4, 5});
  edited.insert(3, 2);
  edited.record(folder.path("edited"));
  programs::ListMap({1, 2, 3, 4, 5}).record(folder.path("fresh"));
  const auto a = lines_of(folder.path("edited")), b = lines_of(folder.path("fresh"));
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) CHECK(a[i].hash == b[i].hash);
}
