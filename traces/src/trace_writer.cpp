// Writing trace files: to FILE.part, which takes the place of FILE when it is whole.
#include <filesystem>
#include <fstream>

#include "format.hpp"
#include "sac/check.hpp"
#include "traces/trace_file.hpp"

namespace traces {

struct TraceWriter::Output {
  explicit Output(std::string p)
      : path(std::move(p)),
        part(temporary_of(path)),
        file(part, std::ios::binary | std::ios::trunc) {
    require_good("cannot be written");
    buffer.reserve(format::kBlock);
  }
  ~Output() {
    if (!open) return;
    file.close();
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
  }

  void require_good(const char* what) const {
    if (!file) throw FileError(path, offset, "io", what);
  }
  void byte(char c) {
    checksum.add(c);
    buffer.push_back(c);
    if (buffer.size() == format::kBlock) flush();
  }
  void flush() {
    file.write(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    offset += buffer.size();
    buffer.clear();
    require_good("writing failed");
  }
  void fixed(std::uint64_t value) {
    for (int i = 0; i < 8; ++i, value >>= 8) byte(static_cast<char>(value & 0xff));
  }
  void hash(const LabelHash& value) {
    fixed(value.high);
    fixed(value.low);
  }
  void number(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) byte(static_cast<char>(0x80 | (value & 0x7f)));
    byte(static_cast<char>(value));
  }
  void bytes(std::string_view text) {
    for (const char c : text) byte(c);
  }
  void text(std::string_view text) {
    constexpr std::string_view kCut = "...";
    const bool cut = text.size() > kLongestText;
    if (cut) text = text.substr(0, kLongestText - kCut.size());
    number(text.size() + (cut ? kCut.size() : 0));
    bytes(text);
    if (cut) bytes(kCut);
  }

  std::string path;
  std::string part;
  std::ofstream file;
  std::string buffer;  // not yet given to the file
  format::Checksum checksum;
  std::uint64_t offset = 0;  // bytes given to the file
  bool open = true;
};

std::string temporary_of(const std::string& path) { return path + ".part"; }

TraceWriter::TraceWriter(std::string path) : out_(std::make_unique<Output>(std::move(path))) {
  out_->bytes(format::kMagic);
  out_->byte(static_cast<char>(kVersion));
  out_->byte(static_cast<char>(kParts));
}
TraceWriter::TraceWriter(TraceWriter&&) noexcept = default;
TraceWriter::~TraceWriter() = default;

std::uint32_t TraceWriter::add_function(std::string_view name) {
  out_->byte(format::kFunction);
  out_->text(name);
  return functions_++;
}

void TraceWriter::add_call(const CallRecord& call) {
  SAC_EXPECTS(call.function < functions_);
  SAC_EXPECTS(call.depth <= depth_ + 1);
  out_->byte(format::kCall);
  out_->byte(static_cast<char>((call.named ? 0 : format::kUnnamed) |
                               (call.tail ? format::kTail : 0) |
                               (call.weight != 0 ? format::kWeighs : 0)));
  out_->number(call.depth);
  out_->number(call.function);
  out_->hash(call.hash);
  out_->text(call.arguments);
  if (call.weight != 0) out_->number(call.weight);
  for (const EdgeRecord& edge : call.edges) {
    out_->byte(format::kEdge);
    out_->hash(edge.hash);
    out_->text(edge.text);
  }
  depth_ = call.depth;
  ++calls_;
}

void TraceWriter::finish() {
  out_->byte(format::kEnd);
  out_->number(calls_);
  out_->fixed(out_->checksum.value());
  out_->flush();
  out_->file.close();
  out_->require_good("writing failed");
  std::error_code error;
  std::filesystem::rename(out_->part, out_->path, error);
  if (error) throw FileError(out_->path, 0, "io", "cannot be replaced: " + error.message());
  out_->open = false;
}

}  // namespace traces
