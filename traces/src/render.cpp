// Panels one below the other: what the picture shows, colours of functions, icicles, labels.
#include "traces/render.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <string_view>
#include <vector>

#include "icicle.hpp"
#include "sac/check.hpp"
#include "svg.hpp"
#include "traces/trace.hpp"

namespace traces {
namespace {

constexpr double kMargin = 12;
constexpr double kRow = 20;          // height of a row of bars
constexpr double kGap = 1;           // between rows
constexpr double kHanging = 230;     // pixels for a label below a bar that is too narrow for it
constexpr double kNarrowest = 11;    // a bar with a label below it
constexpr std::size_t kListed = 40;  // labels listed of a trace

// Okabe and Ito's colours, told apart by the colour-blind; and each mixed with white.
struct Colour {
  const char* full;
  const char* pale;
  const char* text_on_full;
};
constexpr std::array<Colour, 7> kColours{{{"#0072b2", "#b3d5e8", "white"},
                                          {"#e69f00", "#f8e2b3", "black"},
                                          {"#009e73", "#b3e2d5", "white"},
                                          {"#cc79a7", "#f0d7e5", "black"},
                                          {"#56b4e9", "#d0eafa", "black"},
                                          {"#d55e00", "#f2cfb3", "white"},
                                          {"#f0e442", "#fbf7c6", "black"}}};
constexpr Colour kOther{"#888888", "#dddddd", "white"};  // functions with fewer calls
constexpr const char* kFoldFill = "#eeeeee";

std::string file_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

std::string calls_text(std::uint64_t calls) {
  return grouped(calls) + (calls == 1 ? " call" : " calls");
}

struct Subject {
  std::string path;
  Trace trace;
  std::vector<std::uint32_t> changed;  // calls that the other trace has not
};

// Colours by name: the functions with most calls, in this order.
class Palette {
 public:
  explicit Palette(const std::vector<Subject>& subjects) {
    for (std::size_t i = 0; i < subjects.size(); ++i) {
      std::vector<std::vector<std::uint64_t>*> counts;  // by function of this trace
      for (const std::string& name : subjects[i].trace.functions) {
        counts.push_back(&calls_[name]);
        counts.back()->resize(subjects.size());
      }
      for (const Trace::Call& call : subjects[i].trace.calls) ++(*counts[call.function])[i];
    }
    for (const auto& [name, calls] : calls_) names_.push_back(name);
    const auto total = [&](const std::string& name) {
      return std::accumulate(calls_.at(name).begin(), calls_.at(name).end(), std::uint64_t{0});
    };
    std::stable_sort(names_.begin(), names_.end(),
                     [&](const auto& a, const auto& b) { return total(a) > total(b); });
  }
  [[nodiscard]] Colour operator[](const std::string& name) const {
    const auto place = std::find(names_.begin(), names_.end(), name) - names_.begin();
    return static_cast<std::size_t>(place) < kColours.size()
               ? kColours[static_cast<std::size_t>(place)]
               : kOther;
  }
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  /// Calls of the function, by trace.
  [[nodiscard]] const std::vector<std::uint64_t>& calls(const std::string& name) const {
    return calls_.at(name);
  }

 private:
  std::map<std::string, std::vector<std::uint64_t>> calls_;
  std::vector<std::string> names_;
};

class Picture {
 public:
  Picture(std::vector<Subject> subjects, const RenderOptions& options)
      : subjects_(std::move(subjects)),
        palette_(subjects_),
        svg_(options.width),
        layout_{options.width - 2 * kMargin, options.rows} {}

  std::string draw_one() {
    const Subject& subject = subjects_[0];
    const std::string title =
        file_name(subject.path) + ": " + calls_text(subject.trace.calls.size());
    heading(title);
    legend();
    icicle(subject, lay_out_whole(subject.trace, {}, layout_), Style::plain);
    return svg_.finish(y_ + kMargin, title);
  }

  std::string draw_difference() {
    const std::size_t only_a = subjects_[0].changed.size(), only_b = subjects_[1].changed.size();
    const std::string title = file_name(subjects_[0].path) + " and " +
                              file_name(subjects_[1].path) + ": distance " +
                              grouped(only_a + only_b);
    heading(title);
    legend();
    for (const Subject& subject : subjects_) {
      caption(file_name(subject.path) + ": " + calls_text(subject.trace.calls.size()) +
              "; black: the " + grouped(subject.changed.size()) + " that only this trace has");
      icicle(subject, lay_out_whole(subject.trace, subject.changed, layout_), Style::marked);
    }
    for (const Subject& subject : subjects_) {
      if (subject.changed.empty()) continue;
      caption("Only in " + file_name(subject.path) +
              ": full colour; pale: calls above them; grey: calls that both have, folded");
      icicle(subject, lay_out_changed(subject.trace, subject.changed, layout_), Style::blame);
    }
    labels();
    return svg_.finish(y_ + kMargin, title);
  }

 private:
  enum class Style { plain, marked, blame };

  void heading(const std::string& title) {
    svg_.text(kMargin, y_ + 18, title, "class=\"h\"");
    y_ += 26;
  }
  void caption(const std::string& text) {
    svg_.text(kMargin, y_ + 16, text, "class=\"s\"");
    y_ += 22;
  }
  void legend() {
    double x = kMargin;
    const auto entry = [&](const std::string& text, const char* fill) {
      const double width = 18 + Svg::kLetter * static_cast<double>(text.size()) + 14;
      if (x > kMargin && x + width > svg_.width() - kMargin) x = kMargin, y_ += Svg::kLine;
      svg_.rect({x, y_ + 3, 12, 11}, "fill=\"" + std::string(fill) + "\"");
      svg_.text(x + 16, y_ + 12, text);
      x += width;
    };
    const auto& names = palette_.names();
    for (std::size_t i = 0; i < std::min(names.size(), kColours.size()); ++i) {
      entry(legend_text(names[i]), kColours[i].full);
    }
    if (names.size() > kColours.size()) entry("other functions", kOther.full);
    y_ += Svg::kLine + 8;
  }
  // The name, with its calls in each trace.
  [[nodiscard]] std::string legend_text(const std::string& name) const {
    std::string text = fitted(name, 40 * Svg::kLetter);
    const char* separator = " ";
    for (const std::uint64_t calls : palette_.calls(name)) {
      text += separator + grouped(calls);
      separator = " / ";
    }
    return text;
  }

  void icicle(const Subject& subject, const std::vector<Bar>& bars, Style style) {
    const auto labels = labels_of(subject, bars);
    std::uint32_t rows = 0;
    double hanging = 0;
    for (std::size_t i = 0; i < bars.size(); ++i) {
      rows = std::max(rows, bars[i].row + 1);
      draw(subject, bars[i], labels[i], style);
      if (style == Style::blame && hangs(bars[i], labels[i])) {
        hanging = std::max(hanging, hang(bars[i], labels[i]));
      }
    }
    if (bars.empty()) svg_.text(kMargin, y_ + 14, "no calls");
    y_ += kRow * std::max(1u, rows) + hanging + 6;
  }

  // Of the bars that are one call.
  [[nodiscard]] static std::vector<std::string> labels_of(const Subject& subject,
                                                          const std::vector<Bar>& bars) {
    std::vector<std::uint32_t> calls;
    for (const Bar& bar : bars) {
      if (bar.kind == Bar::Kind::call) calls.push_back(bar.first);
    }
    auto texts = labels_at(subject.path, calls);
    std::vector<std::string> labels(bars.size());
    for (std::size_t i = 0, k = 0; i < bars.size(); ++i) {
      if (bars[i].kind == Bar::Kind::call) labels[i] = std::move(texts[k++]);
    }
    return labels;
  }

  void draw(const Subject& subject, const Bar& bar, const std::string& label, Style style) {
    switch (bar.kind) {
      case Bar::Kind::call:
        return draw_call(subject, bar, label, style);
      case Bar::Kind::fold:
        return draw_fold(bar);
      case Bar::Kind::column:
        return draw_column(subject, bar, style);
    }
  }
  [[nodiscard]] Svg::Box box(const Bar& bar) const {
    return {kMargin + bar.begin, y_ + kRow * bar.row, bar.end - bar.begin, kRow - kGap};
  }
  [[nodiscard]] const char* fill_of(const Subject& subject, std::uint32_t function,
                                    bool full) const {
    if (function == Bar::kFolded) return kFoldFill;
    const Colour colour = palette_[subject.trace.functions[function]];
    return full ? colour.full : colour.pale;
  }
  [[nodiscard]] static std::string tooltip(const Bar& bar, const std::string& label) {
    const std::string call = label + "\ncall " + grouped(bar.first);
    return bar.calls == 1 ? call : call + "; " + grouped(bar.calls) + " calls with those below";
  }

  void draw_call(const Subject& subject, const Bar& bar, const std::string& label, Style style) {
    const std::uint32_t function = subject.trace.calls[bar.first].function;
    const bool full = style == Style::plain || (style == Style::blame && bar.changed);
    svg_.rect(box(bar),
              "fill=\"" + std::string(fill_of(subject, function, full)) +
                  "\" stroke=\"white\" stroke-width=\"0.5\"",
              tooltip(bar, label));
    if (style == Style::marked && bar.changed) mark(bar, std::min(bar.own, bar.end - bar.begin));
    const std::string text = fitted(label, bar.end - bar.begin - 6);
    if (text.empty()) return;
    svg_.text(kMargin + bar.begin + 3, y_ + kRow * bar.row + 13, text,
              std::string("style=\"fill:") +
                  (full ? palette_[subject.trace.functions[function]].text_on_full : "black") +
                  "\"");
  }
  void draw_fold(const Bar& bar) {
    const std::string calls = grouped(bar.calls);
    svg_.rect(box(bar), std::string("fill=\"") + kFoldFill + "\" stroke=\"white\"",
              calls_text(bar.calls) + " that both traces have");
    if (!bar.leaf || fitted(calls, bar.end - bar.begin) != calls) return;
    svg_.text(kMargin + bar.begin + 1, y_ + kRow * bar.row + 13, calls, "style=\"fill:#888\"");
  }
  void draw_column(const Subject& subject, const Bar& bar, Style style) {
    const bool full = style == Style::plain || (style == Style::blame && bar.changed);
    std::vector<Svg::Slice> slices;
    for (const Bar::Share& share : bar.shares) {
      const double part = static_cast<double>(share.calls) / static_cast<double>(bar.calls);
      slices.push_back({fill_of(subject, share.function, full), part});
    }
    svg_.stack(box(bar), slices, column_tooltip(subject, bar));
    if (style == Style::marked && bar.changed) mark(bar, bar.end - bar.begin);
  }
  [[nodiscard]] static std::string column_tooltip(const Subject& subject, const Bar& bar) {
    std::string text = calls_text(bar.calls) + " from call " + grouped(bar.first) + " on";
    for (const Bar::Share& share : bar.shares) {
      text.append("\n").append(grouped(share.calls)).append(" ");
      text += share.function == Bar::kFolded ? "that both traces have"
                                             : subject.trace.functions[share.function];
    }
    return text;
  }
  // Wide enough to be seen in a trace of any size.
  void mark(const Bar& bar, double width) {
    svg_.rect({kMargin + bar.begin, y_ + kRow * bar.row - 2, std::max(1.5, width), kRow + 2},
              "fill=\"black\" style=\"pointer-events:none\"");
  }

  static bool hangs(const Bar& bar, const std::string& label) {
    const double width = bar.end - bar.begin;
    return bar.leaf && bar.changed && bar.kind == Bar::Kind::call && width >= kNarrowest &&
           fitted(label, width - 6) != label;
  }
  // The height that it takes.
  double hang(const Bar& bar, const std::string& label) {
    const std::string text = fitted(label, kHanging);
    svg_.text_down(kMargin + (bar.begin + bar.end) / 2 - 3, y_ + kRow * (bar.row + 1) + 2, text);
    return Svg::kLetter * static_cast<double>(text.size()) + 10;
  }

  // The labels of changed calls, a trace beside the other.
  void labels() {
    const double half = layout_.width / 2;
    std::size_t lines = 0;
    for (std::size_t i = 0; i < subjects_.size(); ++i) {
      const Subject& subject = subjects_[i];
      const double x = kMargin + half * static_cast<double>(i);
      svg_.text(x, y_ + 16, "Only in " + file_name(subject.path), "class=\"s\"");
      const std::size_t shown = std::min(kListed, subject.changed.size());
      auto texts = labels_at(
          subject.path,
          {subject.changed.begin(), subject.changed.begin() + static_cast<std::ptrdiff_t>(shown)});
      if (texts.empty()) texts.push_back("no calls");
      if (shown < subject.changed.size()) {
        texts.push_back("and " + grouped(subject.changed.size() - shown) + " more");
      }
      for (std::size_t k = 0; k < texts.size(); ++k) {
        svg_.text(x, y_ + 22 + Svg::kLine * static_cast<double>(k + 1) - 4,
                  fitted(texts[k], half - 10));
      }
      lines = std::max(lines, texts.size());
    }
    y_ += 22 + Svg::kLine * static_cast<double>(lines);
  }

  std::vector<Subject> subjects_;
  Palette palette_;
  Svg svg_;
  Layout layout_;
  double y_ = kMargin;
};

std::vector<Subject> loaded(const std::vector<std::string>& paths) {
  std::vector<Subject> subjects;
  for (const std::string& path : paths) subjects.push_back({path, load_trace(path), {}});
  return subjects;
}

void require(const RenderOptions& options) {
  SAC_EXPECTS(options.width >= 200 && options.rows >= 1);
}

}  // namespace

std::string render(const std::string& path, const RenderOptions& options) {
  require(options);
  return Picture(loaded({path}), options).draw_one();
}

std::string render_difference(const std::string& a, const std::string& b,
                              const RenderOptions& options) {
  require(options);
  auto subjects = loaded({a, b});
  auto [only_a, only_b] = difference(subjects[0].trace, subjects[1].trace);
  subjects[0].changed = std::move(only_a);
  subjects[1].changed = std::move(only_b);
  return Picture(std::move(subjects), options).draw_difference();
}

}  // namespace traces
