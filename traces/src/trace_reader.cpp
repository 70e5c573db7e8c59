// Reading trace files: every number is checked before use, and the whole against its checksum.
#include <fstream>
#include <limits>

#include "format.hpp"
#include "traces/trace_file.hpp"

namespace traces {

struct TraceReader::Input {
  explicit Input(std::string p) : path(std::move(p)), file(path, std::ios::binary) {
    if (!file) throw FileError(path, 0, "io", "cannot be opened");
  }

  [[noreturn]] void fail(const char* code, const std::string& what) const {
    throw FileError(path, offset, code, what);
  }
  [[nodiscard]] bool at_end() {
    if (next == end) refill();
    return next == end;
  }
  void refill() {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    if (file.bad() || (file.fail() && !file.eof())) fail("io", "reading failed");
    next = block.data();
    end = next + file.gcount();
  }

  char byte() {
    if (at_end()) fail("truncated", "the file ends within a trace");
    checksum.add(*next);
    ++offset;
    return *next++;
  }
  std::uint64_t fixed() {
    std::uint64_t value = 0;
    for (int i = 0; i < 8; ++i) {
      value |= std::uint64_t{static_cast<unsigned char>(byte())} << (8 * i);
    }
    return value;
  }
  LabelHash hash() {
    LabelHash value;
    value.high = fixed();
    value.low = fixed();
    return value;
  }
  // Whether the next byte is `c`, which is then read.
  bool follows(char c) { return !at_end() && *next == c && (byte(), true); }
  std::uint64_t number(std::uint64_t limit) {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      const auto c = static_cast<unsigned char>(byte());
      value |= std::uint64_t{c & 0x7fu} << shift;
      if (c < 0x80) return value <= limit ? value : (fail("corrupt", "a number is too large"), 0);
    }
    fail("corrupt", "a number is too long");
  }
  // Replaces `text`, keeping its memory.
  void text(std::string& text) {
    text.clear();
    for (auto left = number(kLongestText); left > 0; --left) text.push_back(byte());
  }

  std::string path;
  std::ifstream file;
  std::vector<char> block = std::vector<char>(format::kBlock);
  const char* next = nullptr;  // the part of the block that is not yet read
  const char* end = nullptr;
  format::Checksum checksum;
  std::uint64_t offset = 0;
};

namespace {
constexpr std::uint64_t kAny = std::numeric_limits<std::uint64_t>::max();
constexpr std::uint64_t kLargest = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint64_t kDeepest = kLargest >> 1;  // Trace::Call::depth
}  // namespace

TraceReader::TraceReader(std::string path) : in_(std::make_unique<Input>(std::move(path))) {
  read_header();
}
TraceReader::TraceReader(TraceReader&&) noexcept = default;
TraceReader::~TraceReader() = default;

void TraceReader::read_header() {
  for (const char expected : format::kMagic) {
    if (in_->at_end() && in_->offset > 0) in_->byte();  // says that the file is truncated
    if (in_->at_end() || in_->byte() != expected) in_->fail("not_a_trace", "this is no trace file");
  }
  if (const int version = static_cast<unsigned char>(in_->byte()); version != kVersion) {
    in_->fail("version", "version " + std::to_string(version) +
                             " of the format; this program reads " + std::to_string(kVersion));
  }
  if (static_cast<unsigned char>(in_->byte()) != kParts) {
    in_->fail("version", "its labels do not have the parts that this program compares");
  }
}

const CallRecord* TraceReader::next() {
  while (!at_end_) {
    switch (in_->byte()) {
      case format::kFunction:
        in_->text(functions_.emplace_back());
        break;
      case format::kCall:
        read_call();
        read_edges();
        return &call_;
      case format::kEnd:
        read_end();
        break;
      default:
        in_->fail("corrupt", "an unknown kind of record");
    }
  }
  return nullptr;
}

void TraceReader::read_call() {
  const auto flags = static_cast<unsigned char>(in_->byte());
  constexpr unsigned kKnown = format::kUnnamed | format::kTail | format::kWeighs;
  if ((flags & ~kKnown) != 0) in_->fail("corrupt", "unknown flags");
  call_.named = (flags & format::kUnnamed) == 0;
  call_.tail = (flags & format::kTail) != 0;
  call_.depth = static_cast<std::uint32_t>(in_->number(kDeepest));
  if (call_.depth > depth_ + 1) in_->fail("corrupt", "a call without a parent");
  call_.function = static_cast<std::uint32_t>(in_->number(kLargest));
  if (call_.function >= functions_.size()) in_->fail("corrupt", "a call of an unknown function");
  call_.hash = in_->hash();
  in_->text(call_.arguments);
  call_.weight = (flags & format::kWeighs) != 0 ? in_->number(kAny) : 0;
  depth_ = call_.depth;
  if (++calls_ > kLargest) in_->fail("corrupt", "more calls than an engine can hold");
}

void TraceReader::read_edges() {
  call_.edges.clear();
  while (in_->follows(format::kEdge)) {
    EdgeRecord& edge = call_.edges.emplace_back();
    edge.hash = in_->hash();
    in_->text(edge.text);
  }
}

void TraceReader::read_end() {
  if (in_->number(kAny) != calls_) {
    in_->fail("corrupt", "the number of calls is another");
  }
  const std::uint64_t expected = in_->checksum.value();
  if (in_->fixed() != expected) in_->fail("corrupt", "the checksum is another");
  if (!in_->at_end()) in_->fail("corrupt", "bytes behind the end of the trace");
  at_end_ = true;
}

}  // namespace traces
