// Keeps what the JSON library tells about a text. The library reads through an iterator that is
// watched, so that each value is told with the place that reading has reached.
#include "io/json.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <nlohmann/json.hpp>

namespace mesher {
namespace {

// Reads characters and writes down how many.
class Watched {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  Watched(const char* at, std::size_t* read) : at_(at), read_(read) {}
  reference operator*() const { return *at_; }
  Watched& operator++() {
    ++at_;
    ++*read_;
    return *this;
  }
  Watched operator++(int) {
    Watched before = *this;
    ++*this;
    return before;
  }
  friend bool operator==(const Watched& a, const Watched& b) { return a.at_ == b.at_; }

 private:
  const char* at_;
  std::size_t* read_;
};

// The events of reading, as the library calls them.
class Builder {
 public:
  using Json = nlohmann::json;
  using Kind = JsonValue::Kind;

  Builder(const text::Source& source, const std::size_t* read) : source_(source), read_(read) {}

  bool null() { return add(Kind::null, token(4)); }
  bool boolean(bool value) { return add(Kind::boolean, token(value ? 4 : 5)); }
  bool number_integer(Json::number_integer_t) { return add(Kind::number, number()); }
  bool number_unsigned(Json::number_unsigned_t) { return add(Kind::number, number()); }
  bool number_float(Json::number_float_t, const std::string&) {
    return add(Kind::number, number());
  }
  bool string(std::string& text) {
    add(Kind::string, token(1));
    last().text = std::move(text);
    return true;
  }
  bool binary(Json::binary_t&) { return false; }  // not in texts
  bool start_object(std::size_t) { return start(Kind::object); }
  bool key(std::string& name) {
    name_ = std::move(name);
    return true;
  }
  bool end_object() {
    require_distinct_names(open());
    return end();
  }
  bool start_array(std::size_t) { return start(Kind::array); }
  bool end_array() { return end(); }
  bool parse_error(std::size_t position, const std::string&, const Json::exception& error) {
    const auto at = std::min(std::max<std::size_t>(position, 1) - 1, source_.content().size());
    const std::string said = error.what();
    const auto reason = said.find("syntax error");
    fail(
        reason == std::string::npos ? "a number beyond the range of a double" : said.substr(reason),
        source_.content().substr(at));
  }

  JsonValue take() { return std::move(root_.values.front()); }

 private:
  static constexpr std::size_t kDeepest = 64;

  void require_distinct_names(const JsonValue& object) const {
    std::vector<std::string_view> names;
    for (const JsonValue& value : object.values) names.push_back(value.name);
    std::sort(names.begin(), names.end());
    const auto twice = std::adjacent_find(names.begin(), names.end());
    if (twice != names.end()) fail("two members " + text::quoted(*twice), object.at);
  }

  [[noreturn]] void fail(const std::string& what, std::string_view at) const {
    throw source_.error(ErrorCode::bad_syntax, what, at);
  }

  JsonValue& open() { return stack_.empty() ? root_ : *stack_.back(); }
  JsonValue& last() { return open().values.back(); }

  bool add(Kind kind, std::string_view at) {
    JsonValue value;
    value.kind = kind;
    value.at = at;
    value.name = std::move(name_);
    name_.clear();
    open().values.push_back(std::move(value));
    return true;
  }
  // The stack stays valid: a value's siblings come after it is closed.
  bool start(Kind kind) {
    add(kind, token(1));
    if (stack_.size() == kDeepest) fail("too many values within each other", last().at);
    stack_.push_back(&last());
    return true;
  }
  bool end() {
    stack_.pop_back();
    return true;
  }

  // The last `size` characters that were read.
  [[nodiscard]] std::string_view token(std::size_t size) const {
    return source_.content().substr(*read_ - size, size);
  }
  // The number that was read, and perhaps a character behind it.
  [[nodiscard]] std::string_view number() const {
    constexpr std::string_view kCharacters = "+-.0123456789eE";
    const std::string_view read = source_.content().substr(0, *read_);
    const auto last = read.find_last_of(kCharacters);
    const auto before = read.find_last_not_of(kCharacters, last);
    const auto first = before == std::string_view::npos ? 0 : before + 1;
    return read.substr(first, last - first + 1);
  }

  const text::Source& source_;
  const std::size_t* read_;
  JsonValue root_;  // an array around all
  std::vector<JsonValue*> stack_;
  std::string name_;  // of the next value
};

}  // namespace

const JsonValue* JsonValue::find(std::string_view member) const {
  const auto found = std::find_if(values.begin(), values.end(),
                                  [&](const JsonValue& v) { return v.name == member; });
  return found == values.end() ? nullptr : &*found;
}

JsonValue read_json(const text::Source& source) {
  std::size_t read = 0;
  Builder builder(source, &read);
  const char* const begin = source.content().data();
  nlohmann::json::sax_parse(Watched(begin, &read), Watched(begin + source.content().size(), &read),
                            &builder);
  return builder.take();
}

}  // namespace mesher
