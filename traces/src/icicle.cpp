// One pass in pre-order places the bars: a bar ends where the next one of its row or above begins.
#include "icicle.hpp"

#include <algorithm>
#include <utility>

namespace traces {
namespace {

constexpr double kThinnest = 2;  // pixels: thinner bars are drawn together
constexpr double kFold = 0.35;   // width of a fold, in changed calls

// What a view shows, in pre-order.
struct Item {
  Bar::Kind kind;
  bool changed;
  std::uint32_t row;
  std::uint32_t first;
  std::uint64_t calls;  // of a fold
  double weight;        // width without that of what is below
};

// Turns items into bars.
class Placer {
 public:
  Placer(const Trace& trace, const Layout& layout, double total_weight)
      : trace_(trace),
        scale_(total_weight > 0 ? layout.width / total_weight : 0),
        deepest_(layout.rows),
        columns_(layout.rows + 1) {}

  void add(Item item) {
    item.row = std::min(item.row, deepest_);
    close(item.row, item.first);
    if (!open_.empty()) open_.back().leaf = false;
    Bar bar{item.kind, item.changed,         true, item.row, item.first, item.calls,
            at_,       item.weight * scale_, at_,  {}};
    open_.push_back(std::move(bar));
    at_ += item.weight * scale_;
  }
  std::vector<Bar> finish() {
    close(0, static_cast<std::uint32_t>(trace_.calls.size()));
    for (std::uint32_t row = 0; row < columns_.size(); ++row) flush(row);
    return std::move(bars_);
  }

 private:
  // Ends the open bars of `row` and deeper, before the call `next`.
  void close(std::uint32_t row, std::uint32_t next) {
    for (; !open_.empty() && open_.back().row >= row; open_.pop_back()) {
      Bar& bar = open_.back();
      bar.end = at_;
      if (bar.kind == Bar::Kind::call) bar.calls = next - bar.first;
      bar.end - bar.begin < kThinnest ? add_to_column(bar) : add_bar(std::move(bar));
    }
  }
  void add_bar(Bar bar) {
    flush(bar.row);
    bars_.push_back(std::move(bar));
  }

  // What begins within kThinnest pixels is one column; those that show one function alone, without
  // a gap, grow to the right. So there are at most two columns for every kThinnest pixels.
  void add_to_column(const Bar& bar) {
    Bar& column = columns_[bar.row];
    const auto place = [](double x) { return static_cast<long>(x / kThinnest); };
    const std::uint32_t function =
        bar.kind == Bar::Kind::fold ? Bar::kFolded : trace_.calls[bar.first].function;
    const std::uint64_t calls = bar.kind == Bar::Kind::fold ? bar.calls : 1;
    const bool grows = column.shares.size() == 1 && column.shares[0].function == function &&
                       column.changed == bar.changed && column.end >= bar.begin;
    if (column.shares.empty() || (place(column.begin) != place(bar.begin) && !grows)) {
      flush(bar.row);
      column = {Bar::Kind::column, false, bar.leaf, bar.row, bar.first, 0,
                bar.begin,         0,     bar.end,  {}};
    }
    column.end = bar.end;
    column.calls += calls;
    column.changed |= bar.changed;
    const auto share = std::find_if(column.shares.begin(), column.shares.end(),
                                    [&](const auto& s) { return s.function == function; });
    share == column.shares.end() ? column.shares.push_back({function, calls})
                                 : void(share->calls += calls);
  }
  void flush(std::uint32_t row) {
    if (!columns_[row].shares.empty()) bars_.push_back(std::exchange(columns_[row], {}));
  }

  const Trace& trace_;
  double scale_;
  std::uint32_t deepest_;
  double at_ = 0;
  std::vector<Bar> open_;     // the last item and those around it
  std::vector<Bar> columns_;  // by row; without shares: none
  std::vector<Bar> bars_;
};

// Marks the calls of the list and those that they are below of.
std::vector<bool> with_ancestors(const std::vector<std::uint32_t>& rows,
                                 const std::vector<std::uint32_t>& changed) {
  std::vector<bool> kept(rows.size());
  std::vector<std::uint32_t> open;  // the current call's ancestors and itself, by row
  auto next = changed.begin();
  for (std::uint32_t i = 0; i < rows.size() && next != changed.end(); ++i) {
    open.resize(rows[i]);
    open.push_back(i);
    if (i != *next) continue;
    ++next;
    for (auto it = open.rbegin(); it != open.rend() && !kept[*it]; ++it) kept[*it] = true;
  }
  return kept;
}

// Calls each(item) for what the view `changed` shows.
template <class Each>
void for_each_changed(const std::vector<std::uint32_t>& rows, const std::vector<bool>& kept,
                      const std::vector<std::uint32_t>& changed, Each&& each) {
  Item fold{Bar::Kind::fold, false, 0, 0, 0, kFold};
  const auto end_fold = [&] {
    if (fold.calls != 0) each(fold);
    fold.calls = 0;
  };
  auto next = changed.begin();
  for (std::uint32_t i = 0; i < rows.size(); ++i) {
    if (kept[i]) {
      end_fold();
      const bool is_changed = next != changed.end() && *next == i;
      if (is_changed) ++next;
      each(Item{Bar::Kind::call, is_changed, rows[i], i, 1, is_changed ? 1.0 : 0.0});
      continue;
    }
    if (fold.calls != 0 && rows[i] < fold.row) end_fold();
    if (fold.calls == 0) fold.row = rows[i], fold.first = i;
    ++fold.calls;
  }
  end_fold();
}

}  // namespace

std::vector<std::uint32_t> rows_of(const Trace& trace) {
  std::vector<std::uint32_t> rows, open;  // open: rows of the current call and its ancestors
  rows.reserve(trace.calls.size());
  for (const Trace::Call& call : trace.calls) {
    open.resize(call.depth);
    open.push_back(open.empty() ? 0 : open.back() + (call.tail ? 0 : 1));
    rows.push_back(open.back());
  }
  return rows;
}

std::vector<Bar> lay_out_whole(const Trace& trace, const std::vector<std::uint32_t>& changed,
                               const Layout& layout) {
  const auto rows = rows_of(trace);
  Placer placer(trace, layout, static_cast<double>(rows.size()));
  auto next = changed.begin();
  for (std::uint32_t i = 0; i < rows.size(); ++i) {
    const bool is_changed = next != changed.end() && *next == i;
    if (is_changed) ++next;
    placer.add({Bar::Kind::call, is_changed, rows[i], i, 1, 1});
  }
  return placer.finish();
}

std::vector<Bar> lay_out_changed(const Trace& trace, const std::vector<std::uint32_t>& changed,
                                 const Layout& layout) {
  const auto rows = rows_of(trace);
  const auto kept = with_ancestors(rows, changed);
  double weight = 0;
  for_each_changed(rows, kept, changed, [&](const Item& item) { weight += item.weight; });
  Placer placer(trace, layout, weight);
  for_each_changed(rows, kept, changed, [&](const Item& item) { placer.add(item); });
  return placer.finish();
}

}  // namespace traces
