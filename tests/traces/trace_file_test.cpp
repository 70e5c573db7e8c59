#include "traces/trace_file.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "scratch_file.hpp"

namespace {

using support::ScratchFolder;
using traces::CallRecord;

const std::vector<CallRecord> kCalls = {
    {0, 0, {1, 2}, true, "7"},
    {1, 1, {~0ull, 0x8000000000000000u}, false, "@12, \"a b\""},
    {2, 1, {3, 4}, true, ""},
    {1, 0, {0, 0}, true, std::string("\0\n\xff", 3), true},
    {2, 0, {5, 6}, false, "tail", true, {{{7, 8}, "reads 5"}, {{}, "writes\n\"6\""}}, 300},
    {0, 1, {9, 9}, true, "X", false, {{{1, 1}, ""}}},
    {1, 0, {7, 8}, false, "", false, {}, ~0ull},
};

void write_calls(const std::string& path) {
  traces::TraceWriter writer(path);
  writer.add_function("split");
  writer.add_function("nearest<2>");
  for (const CallRecord& call : kCalls) writer.add_call(call);
  writer.finish();
}

// Reads all; the code of the error, or "" if there is none.
std::string failure_of(const std::string& path) {
  try {
    traces::TraceReader reader(path);
    while (reader.next() != nullptr) continue;
    return "";
  } catch (const traces::FileError& error) {
    CHECK(std::string(error.what()).find(path + ":byte ") == 0);
    return error.code();
  }
}

}  // namespace

TEST_CASE("A trace file reads back as it was written") {
  ScratchFolder folder;
  write_calls(folder.path("t"));
  CHECK(folder.count() == 1);
  traces::TraceReader reader(folder.path("t"));
  for (const CallRecord& expected : kCalls) {
    const CallRecord* call = reader.next();
    REQUIRE(call != nullptr);
    CHECK(call->depth == expected.depth);
    CHECK(call->function == expected.function);
    CHECK(call->hash == expected.hash);
    CHECK(call->named == expected.named);
    CHECK(call->arguments == expected.arguments);
    CHECK(call->tail == expected.tail);
    CHECK(call->weight == expected.weight);
    REQUIRE(call->edges.size() == expected.edges.size());
    for (std::size_t i = 0; i < call->edges.size(); ++i) {
      CHECK(call->edges[i].hash == expected.edges[i].hash);
      CHECK(call->edges[i].text == expected.edges[i].text);
    }
  }
  CHECK(reader.next() == nullptr);
  CHECK(reader.next() == nullptr);
  CHECK(reader.functions() == std::vector<std::string>{"split", "nearest<2>"});
}

TEST_CASE("A file that ends anywhere within a trace is an error") {
  ScratchFolder folder;
  write_calls(folder.path("t"));
  const std::string whole = folder.read("t");
  CHECK(failure_of(folder.write("cut", "")) == "not_a_trace");
  for (std::size_t size = 1; size < whole.size(); ++size) {
    INFO("cut to " << size << " bytes");
    CHECK(failure_of(folder.write("cut", whole.substr(0, size))) == "truncated");
  }
}

TEST_CASE("A file with any byte changed is an error") {
  ScratchFolder folder;
  write_calls(folder.path("t"));
  const std::string whole = folder.read("t");
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (const int change : {1, 0x20, 0x80}) {
      INFO("byte " << i << " changed by " << change);
      std::string bad = whole;
      bad[i] = static_cast<char>(bad[i] ^ change);
      const std::string code = failure_of(folder.write("bad", bad));
      CHECK(!code.empty());
      if (i < 8) CHECK(code == "not_a_trace");
      if (i == 8 || i == 9) CHECK(code == "version");
    }
  }
  CHECK(failure_of(folder.write("bad", whole + "x")) == "corrupt");
}

TEST_CASE("Counts in a file are refused, never believed") {
  ScratchFolder folder;
  const std::string header = "\x89traces\n\x04\x0f",
                    name =
                        "F\x01"
                        "f",
                    zero(1, '\0');
  const std::string huge = "\xff\xff\xff\xff\xff\xff\xff\xff\x7f", hash(16, '\0');
  const auto code = [&](const std::string& rest) {
    return failure_of(folder.write("t", header + rest));
  };
  CHECK(code("F" + huge) == "corrupt");                                     // length of a name
  CHECK(code("F\xff" + huge + huge) == "corrupt");                          // no number
  CHECK(code(name + "C\x08") == "corrupt");                                 // flags
  CHECK(code(name + "C" + zero + huge) == "corrupt");                       // depth
  CHECK(code(name + "C" + zero + "\x01") == "corrupt");                     // no parent
  CHECK(code(name + "C" + zero + zero + "\x01") == "corrupt");              // no such function
  CHECK(code(name + "C" + zero + zero + zero + hash + huge) == "corrupt");  // length of text
  CHECK(code(name + "C\x04" + zero + zero + hash + zero + huge + "\x02") == "corrupt");  // weight
  CHECK(code(name + "X" + hash + zero) == "corrupt");  // an edge of no call
  CHECK(code("E\x05") == "corrupt");                   // number of calls
  CHECK(code("?") == "corrupt");
}

TEST_CASE("Other files and missing files are errors") {
  ScratchFolder folder;
  CHECK(failure_of(folder.write("t", "# points\n1 2 0 0\n")) == "not_a_trace");
  CHECK(failure_of(folder.path("missing")) == "io");
  CHECK(failure_of(folder.path(".")) == "io");
  CHECK_THROWS_AS(traces::TraceWriter(folder.path("no/such/folder")), traces::FileError);
}

TEST_CASE("A writer that has not finished leaves no file, and an older one as it was") {
  ScratchFolder folder;
  write_calls(folder.path("t"));
  const std::string before = folder.read("t");
  { traces::TraceWriter(folder.path("t")).add_function("f"); }
  { traces::TraceWriter(folder.path("new")).add_function("f"); }
  CHECK(folder.read("t") == before);
  CHECK(folder.count() == 1);
}

TEST_CASE("Long texts are cut, and all are shown on one line") {
  ScratchFolder folder;
  {
    traces::TraceWriter writer(folder.path("t"));
    writer.add_function("f");
    writer.add_call({0, 0, {}, true, std::string(10000, 'x')});
    writer.finish();
  }
  traces::TraceReader reader(folder.path("t"));
  const CallRecord* call = reader.next();
  REQUIRE(call != nullptr);
  CHECK(call->arguments == std::string(traces::kLongestText - 3, 'x') + "...");
  CHECK(traces::label_text("f", "a\nb\t\x7f\xc3\xa9") == "f(a?b??\xc3\xa9)");
}
