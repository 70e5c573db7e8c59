// A recursive reader of XML.
#include "io/xml.hpp"

#include <algorithm>

namespace mesher {
namespace {

constexpr std::string_view kXmlBlanks = " \t\r\n";
constexpr std::string_view kEndOfName = " \t\r\n/>=<\"'";
constexpr int kDeepest = 64;

class XmlReader {
 public:
  explicit XmlReader(const text::Source& source) : source_(source), rest_(source.content()) {}

  XmlElement read() {
    skip("\xEF\xBB\xBF");
    skip_between();
    XmlElement root = read_element(1);
    skip_between();
    if (!rest_.empty()) fail("text behind the root element");
    return root;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw source_.error(rest_.empty() ? ErrorCode::truncated : ErrorCode::bad_syntax,
                        rest_.empty() ? "the file ends too early: " + what : what, rest_);
  }

  bool skip(std::string_view token) {
    if (rest_.substr(0, token.size()) != token) return false;
    rest_.remove_prefix(token.size());
    return true;
  }
  void skip_space() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kXmlBlanks), rest_.size()));
  }
  void expect(std::string_view token, const std::string& what) {
    if (!skip(token)) fail(what);
  }
  // What comes before `end`, which is skipped.
  std::string_view until(std::string_view end, const std::string& what) {
    const auto at = rest_.find(end);
    if (at == std::string_view::npos) fail("no end of " + what);
    const std::string_view before = rest_.substr(0, at);
    rest_.remove_prefix(at + end.size());
    return before;
  }

  // Blanks, comments and declarations between elements.
  void skip_between() {
    for (;;) {
      skip_space();
      if (skip("<!--")) {
        until("-->", "a comment");
      } else if (skip("<?")) {
        until("?>", "a declaration");
      } else if (skip("<!DOCTYPE")) {
        until(">", "a declaration");
      } else {
        return;
      }
    }
  }

  std::string_view read_name() {
    const auto end = std::min(rest_.find_first_of(kEndOfName), rest_.size());
    if (end == 0) fail("expected a name");
    const std::string_view name = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return name;
  }

  XmlAttribute read_attribute() {
    XmlAttribute attribute{read_name(), {}};
    skip_space();
    expect("=", "expected '=' behind the attribute's name");
    skip_space();
    const std::string_view quote = rest_.substr(0, 1);
    if (quote != "\"" && quote != "'") fail("expected a value in quotes");
    rest_.remove_prefix(1);
    attribute.value = until(quote, "a value");
    return attribute;
  }

  XmlElement read_element(int depth) {
    expect("<", "expected an element");
    if (depth > kDeepest) fail("too many elements within each other");
    XmlElement element;
    element.name = read_name();
    for (skip_space(); rest_.substr(0, 1) != ">" && rest_.substr(0, 2) != "/>"; skip_space()) {
      element.attributes.push_back(read_attribute());
    }
    if (skip("/>")) return element;
    rest_.remove_prefix(1);
    if (!read_raw(element)) read_content(element, depth);
    read_end(element);
    return element;
  }

  void read_content(XmlElement& element, int depth) {
    const std::string_view content = rest_;
    for (skip_between(); rest_.substr(0, 2) != "</"; skip_between()) {
      if (rest_.substr(0, 1) == "<") {
        element.children.push_back(read_element(depth + 1));
      } else {
        rest_.remove_prefix(std::min(rest_.find('<'), rest_.size()));
        if (rest_.empty()) fail("no end of the element " + text::quoted(element.name));
      }
    }
    element.text = content.substr(0, content.size() - rest_.size());
  }

  bool read_raw(XmlElement& element) {
    const std::string_view* const encoding = element.find("encoding");
    if (element.name != "AppendedData" || encoding == nullptr || *encoding != "raw") return false;
    const auto end = rest_.rfind("</AppendedData");
    if (end == std::string_view::npos) fail("no end of the appended data");
    element.text = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return true;
  }

  void read_end(const XmlElement& element) {
    expect("</", "expected an end tag");
    if (rest_.substr(0, element.name.size()) != element.name) {
      fail("expected the end of " + text::quoted(element.name));
    }
    rest_.remove_prefix(element.name.size());
    skip_space();
    expect(">", "expected '>'");
  }

  const text::Source& source_;
  std::string_view rest_;
};

}  // namespace

const std::string_view* XmlElement::find(std::string_view attribute) const {
  for (const XmlAttribute& a : attributes) {
    if (a.name == attribute) return &a.value;
  }
  return nullptr;
}

const XmlElement* XmlElement::child(std::string_view child_name) const {
  for (const XmlElement& c : children) {
    if (c.name == child_name) return &c;
  }
  return nullptr;
}

XmlElement read_xml(const text::Source& source) { return XmlReader(source).read(); }

}  // namespace mesher
