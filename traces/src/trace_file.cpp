// What writing and reading share: errors and the text of a label.
#include "traces/trace_file.hpp"

namespace traces {

FileError::FileError(const std::string& path, std::uint64_t offset, std::string code,
                     const std::string& what)
    : std::runtime_error(path + ":byte " + std::to_string(offset) + ": error[" + code +
                         "]: " + what),
      code_(std::move(code)),
      offset_(offset) {}

namespace {

std::string on_one_line(std::string text) {
  for (char& c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 32 || byte == 127) c = '?';  // bytes above are parts of UTF-8
  }
  return text;
}

}  // namespace

std::string label_text(std::string_view name, std::string_view arguments) {
  std::string text;
  text.append(name).append("(").append(arguments).append(")");
  return on_one_line(std::move(text));
}

std::string edge_text(const EdgeRecord& edge) { return on_one_line(edge.text); }

}  // namespace traces
