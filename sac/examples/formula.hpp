// Formulas of a spreadsheet: text to value.
//
//   text   = nothing | number | -number | =sum
//   sum    = product {+ product | - product};   product = factor {* factor | / factor}
//   factor = -factor | (sum) | number | cell | SUM(cell:cell) | MIN(cell:cell) | MAX(cell:cell)
//
// without blanks; a cell is a letter A-Z and a row from 1; the corners of a rectangle are the upper
// left and the lower right. Nothing in here is traced; spreadsheet.hpp is the program.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "sac/label.hpp"

namespace examples::spreadsheet {

/// A cell by number: 26 to a row, A1 is 0, B1 is 1, A2 is 26.
inline constexpr int kColumns = 26;

enum class Fault : std::uint8_t { none, cycle, syntax, number };

struct Value {
  double number = 0;  ///< finite; 0 if there is a fault
  Fault fault = Fault::none;
  friend bool operator==(const Value&, const Value&) = default;
  friend void label_bytes(sac::LabelSink& sink, const Value& v) {
    sac::label_arguments(sink, std::tie(v.number, v.fault));
  }
};

inline std::string name_of(int cell) {
  return static_cast<char>('A' + cell % kColumns) + std::to_string(cell / kColumns + 1);
}

inline std::string to_text(const Value& value) {
  switch (value.fault) {
    case Fault::cycle:
      return "#CYCLE!";
    case Fault::syntax:
      return "#SYNTAX!";
    case Fault::number:
      return "#NUMBER!";
    case Fault::none:
      break;
  }
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value.number).ptr};
}

/// Evaluates while it reads; after an error in the text nothing is left to read.
template <class Read>
class Evaluator {
 public:
  Evaluator(std::string_view text, int rows, Read& read) : rest_(text), rows_(rows), read_(read) {}

  Value value() {
    double x = 0;
    if (take("=")) {
      x = sum();
    } else if (!rest_.empty()) {
      x = take("-") ? -number() : number();
    }
    if (!rest_.empty()) fail();
    if (fault_ == Fault::none && !std::isfinite(x)) fault_ = Fault::number;
    return {fault_ == Fault::none ? x + 0.0 : 0, fault_};  // + 0.0: no -0
  }

 private:
  double sum() {
    double x = product();
    for (;;) {
      if (take("+")) {
        x += product();
      } else if (take("-")) {
        x -= product();
      } else {
        return x;
      }
    }
  }
  double product() {
    double x = nested_factor();
    for (;;) {
      if (take("*")) {
        x *= nested_factor();
      } else if (take("/")) {
        x /= nested_factor();
      } else {
        return x;
      }
    }
  }
  double nested_factor() {
    constexpr int kMostDepth = 1000;  // of native recursion
    ++depth_;
    const double x = depth_ <= kMostDepth ? factor() : fail();
    --depth_;
    return x;
  }
  double factor() {
    if (take("-")) return -nested_factor();
    if (take("(")) {
      const double x = sum();
      return take(")") ? x : fail();
    }
    if (take("SUM(")) return fold(std::plus());
    if (take("MIN(")) return fold([](double a, double b) { return std::min(a, b); });
    if (take("MAX(")) return fold([](double a, double b) { return std::max(a, b); });
    const bool names_cell = !rest_.empty() && rest_[0] >= 'A' && rest_[0] <= 'Z';
    return names_cell ? number_in(cell()) : number();
  }
  // Of the numbers in a rectangle, by rows.
  template <class Combine>
  double fold(Combine combine) {
    const int first = cell();
    const bool two = take(":");
    const int last = cell();
    const bool empty = first % kColumns > last % kColumns || first > last;
    if (!two || !take(")") || empty) return fail();
    double x = number_in(first);
    for (int row = first / kColumns; row <= last / kColumns; ++row) {
      for (int column = first % kColumns; column <= last % kColumns; ++column) {
        const int at = row * kColumns + column;
        if (at != first) x = combine(x, number_in(at));
      }
    }
    return x;
  }
  int cell() {
    const int column = rest_.empty() ? -1 : rest_[0] - 'A';
    rest_.remove_prefix(rest_.empty() ? 0 : 1);
    const int row = scan<int>() - 1;
    if (column < 0 || column >= kColumns || row < 0 || row >= rows_) fail();
    return fault_ == Fault::syntax ? 0 : row * kColumns + column;
  }
  double number() {
    const double x = scan<double>();
    return x >= 0 && std::isfinite(x) ? x : fail();
  }
  template <class Number>
  Number scan() {
    Number x = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), x);
    if (error != std::errc()) fail();
    if (!rest_.empty()) rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return x;
  }
  // The first fault counts; a formula with one needs no further cells.
  double number_in(int cell) {
    if (fault_ != Fault::none) return 0;
    const Value value = read_(cell);
    fault_ = value.fault;
    return value.number;
  }
  bool take(std::string_view what) {
    if (!rest_.starts_with(what)) return false;
    rest_.remove_prefix(what.size());
    return true;
  }
  double fail() {
    fault_ = Fault::syntax;
    rest_ = {};
    return 0;
  }

  std::string_view rest_;
  int rows_;
  Read& read_;
  int depth_ = 0;
  Fault fault_ = Fault::none;
};

/// The value of a text in a sheet with that many rows, where other cells have the values
/// read(cell). A fault of a cell is a fault of the formula; one in the text goes before; a result
/// that is not finite is Fault::number.
template <class Read>
Value value_of(std::string_view text, int rows, Read&& read) {
  return Evaluator(text, rows, read).value();
}

}  // namespace examples::spreadsheet
