// Numbers have two decimals; texts are made safe for XML, whatever bytes a trace holds.
#include "svg.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace traces {
namespace {

std::string number(double value) {
  char digits[32];
  const double rounded = std::round(value * 100) / 100 + 0.0;
  const auto end = std::to_chars(digits, digits + sizeof digits, rounded).ptr;
  return {digits, end};
}

// Length of the UTF-8 letter that `text` begins with, 0 if it begins with none.
std::size_t letter_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  const std::size_t length = first < 0x80                    ? 1
                             : first >= 0xc2 && first < 0xe0 ? 2
                             : first >= 0xe0 && first < 0xf0 ? 3
                             : first >= 0xf0 && first < 0xf5 ? 4
                                                             : 0;
  if (length == 0 || length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  if (first == 0xe0 && byte(1) < 0xa0) return 0;                      // longer than needed
  if (first == 0xed && byte(1) >= 0xa0) return 0;                     // half of a pair
  if (first == 0xef && byte(1) == 0xbf && byte(2) >= 0xbe) return 0;  // no character of XML
  if (first == 0xf0 && byte(1) < 0x90) return 0;
  if (first == 0xf4 && byte(1) >= 0x90) return 0;
  return length;
}

std::string escaped(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = letter_length(text);
    const auto letter = text.substr(0, std::max<std::size_t>(1, length));
    text.remove_prefix(letter.size());
    const auto c = static_cast<unsigned char>(letter[0]);
    if (length == 0 || (c < 32 && c != '\n')) {
      out += '?';
    } else if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else {
      out += letter;
    }
  }
  return out;
}

}  // namespace

void Svg::rect(const Box& box, std::string_view attributes, std::string_view tooltip) {
  body_ += "<rect x=\"" + number(box.x) + "\" y=\"" + number(box.y) + "\" width=\"" +
           number(box.width) + "\" height=\"" + number(box.height) + "\" ";
  body_ += attributes;
  body_ += tooltip.empty() ? "/>\n" : "><title>" + escaped(tooltip) + "</title></rect>\n";
}

void Svg::stack(const Box& box, const std::vector<Slice>& slices, std::string_view tooltip) {
  body_ += "<g><title>" + escaped(tooltip) + "</title>";
  double y = box.y;
  for (const Slice& slice : slices) {
    const double height = box.height * slice.share;
    body_ += "<path d=\"M" + number(box.x) + " " + number(y) + "h" + number(box.width) + "v" +
             number(height) + "h-" + number(box.width) + "z\" fill=\"";
    body_.append(slice.fill).append("\"/>");
    y += height;
  }
  body_ += "</g>\n";
}

void Svg::text(double x, double y, std::string_view text, std::string_view attributes) {
  body_ += "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\"";
  if (!attributes.empty()) body_.append(" ").append(attributes);
  body_.append(">").append(escaped(text)).append("</text>\n");
}

void Svg::text_down(double x, double y, std::string_view text) {
  body_ += "<text transform=\"translate(" + number(x) + " " + number(y) + ") rotate(90)\">" +
           escaped(text) + "</text>\n";
}

std::string Svg::finish(double height, std::string_view title) const {
  const std::string w = number(width_), h = number(height);
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + w + "\" height=\"" + h +
         "\" viewBox=\"0 0 " + w + " " + h + "\">\n<title>" + escaped(title) +
         "</title>\n<style>text { font: 11px monospace; fill: #222; pointer-events: none; }\n"
         ".h { font: bold 13px sans-serif; } .s { font: 12px sans-serif; }</style>\n"
         "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n" +
         body_ + "</svg>\n";
}

std::string fitted(std::string_view text, double width) {
  const auto letters = [](std::string_view t) {
    return std::count_if(t.begin(), t.end(), [](char c) { return (c & 0xc0) != 0x80; });
  };
  const auto room = static_cast<long>(width / Svg::kLetter);
  if (letters(text) <= room) return std::string(text);
  if (room < 3) return "";
  std::size_t end = 0;
  for (long left = room - 2; left > 0; --left) {
    end += std::max<std::size_t>(1, letter_length(text.substr(end)));
  }
  return std::string(text.substr(0, end)) + "..";
}

std::string grouped(unsigned long long number) {
  const std::string digits = std::to_string(number);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ' ';
    text += digits[i];
  }
  return text;
}

}  // namespace traces
