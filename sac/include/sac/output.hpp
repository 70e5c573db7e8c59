// What a program puts out, as differences: the elements that calls emit.
//
//   sac::Output<Triangle> out(engine);
//   out.emit(s, triangle);  // in a traced function; it is there as long as the call does so
//
//   e.propagate();
//   for (const Triangle& t : out.removed()) ...
//   for (const Triangle& t : out.added()) ...
//
// (1) The output is a multiset; its order is that of <=> or <, of floating-point numbers
//     std::strong_order. An element that is emitted twice is there twice.
// (2) added() and removed() are the difference between before and after the last run or
//     propagation: an element that goes and comes again is in neither. One that fails has none.
// (3) Calls cannot read an output: that is a UsageError.
// (4) Cost: O(log of the elements) an emission that comes or goes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <ostream>
#include <set>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "sac/engine.hpp"
#include "sac/list/list.hpp"
#include "sac/plain.hpp"
#include "sac/scope.hpp"

namespace sac {

/// An element of a list that is put out, and its place.
template <class T>
struct Placed {
  ElementId id;
  ElementId before;  ///< the element before it; 0: it is the first
  T value;
  friend auto operator<=>(const Placed&, const Placed&) = default;
  friend bool operator==(const Placed&, const Placed&) = default;
};

namespace detail {

// The order of outputs, in which only what is the same is equal.
struct OutputOrder {
  template <class T>
  bool operator()(const T& a, const T& b) const {
    return compare_argument(a, b) < 0;
  }
  template <class T>
  bool operator()(const Placed<T>& a, const Placed<T>& b) const {
    if (a.id != b.id) return a.id < b.id;
    if (a.before != b.before) return a.before < b.before;
    return (*this)(a.value, b.value);
  }
};

}  // namespace detail

/// The elements that calls emit. T has <=> or <, which does not throw. An object of this type
/// outlives the calls that emit to it.
template <class T>
class Output final : public Structure {
 public:
  /// Throws: UsageError if the engine runs, or has too many structures.
  explicit Output(Engine& engine) : engine_(engine) {
    engine.begin_edit("a new output");
    id_ = engine.add_structure(*this);
  }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  ~Output() override {
    if (emissions_ == 0) engine_.remove_structure(id_);
  }

  /// Puts a value out, as an effect of the running call. Throws: std::bad_alloc, and what copying
  /// the value throws.
  void emit(Scope& s, const T& value) {
    s.guarded([&] {
      const auto same = [&](const Emission& e) {
        return e.at != nullptr && !Order()(e.at->first, value) && !Order()(value, e.at->first);
      };
      if (s.recall<Emission>(id_, kEmission, same, Scope::kMostRecalled) != nullptr) return;
      auto& edge = s.effect<Emission>(id_, kEmission);
      edge.at = nullptr;
      ++emissions_;
      begin();
      auto& at = *elements_.try_emplace(value).first;
      touch(at);
      ++at.second.count;
      edge.at = &at;
    });
  }

  /// All elements, in order.
  [[nodiscard]] std::vector<T> values() const {
    require_idle();
    std::vector<T> all;
    for (const auto& [value, element] : elements_) all.insert(all.end(), element.count, value);
    return all;
  }
  /// What the last run or propagation has added, and what it has removed, in order. Cost: O(k log
  /// k) for k changes.
  [[nodiscard]] std::vector<T> added() const {
    return difference([](const Element& e) { return e.count > e.before ? e.count - e.before : 0; });
  }
  [[nodiscard]] std::vector<T> removed() const {
    return difference([](const Element& e) { return e.before > e.count ? e.before - e.count : 0; });
  }

  void retract(Call&, Edge& edge) noexcept override {
    auto& emission = static_cast<Emission&>(edge);
    --emissions_;
    if (emission.at == nullptr) return;
    begin();
    touch(*emission.at);
    --emission.at->second.count;
  }
  void finished() noexcept override {
    if (!std::exchange(changing_, false)) settle();
  }
  void label(const Call&, const Edge& edge, LabelSink& sink) const override {
    sink.text("emits");
    detail::name_argument(sink, static_cast<const Emission&>(edge).at->first);
  }
  void print(const Call& call, const Edge& edge, std::ostream& out) const override {
    out << "emits ";
    print_argument(out, static_cast<const Emission&>(edge).at->first, &call);
  }
  void check_invariants() const override {
    SAC_INVARIANT(!changing_);
    for (const auto& [value, element] : elements_) {
      SAC_INVARIANT(element.touched || (element.count > 0 && element.count == element.before));
    }
  }

 private:
  using Order = detail::OutputOrder;
  struct Element;
  using Entry = std::pair<const T, Element>;
  struct Element {
    std::size_t count = 0;
    std::size_t before = 0;         // the last run or propagation
    Entry* next_touched = nullptr;  // by that
    bool touched = false;
  };
  struct Emission : Edge {
    Entry* at;  // null: memory ran out
  };
  static constexpr std::uint8_t kEmission = 0;

  void require_idle() const { engine_.core().require_settled("the output"); }
  // A run or propagation changes something.
  void begin() noexcept {
    if (!std::exchange(changing_, true)) settle();
  }
  void touch(Entry& entry) noexcept {
    if (std::exchange(entry.second.touched, true)) return;
    entry.second.next_touched = std::exchange(touched_, &entry);
  }
  // What has changed is no news any more.
  void settle() noexcept {
    while (touched_ != nullptr) {
      Entry& entry = *std::exchange(touched_, touched_->second.next_touched);
      entry.second.touched = false;
      entry.second.before = entry.second.count;
      if (entry.second.count == 0) elements_.erase(entry.first);
    }
  }
  template <class Excess>
  [[nodiscard]] std::vector<T> difference(Excess excess) const {
    require_idle();
    std::vector<const Entry*> entries;
    for (const Entry* e = touched_; e != nullptr; e = e->second.next_touched) {
      if (excess(e->second) > 0) entries.push_back(e);
    }
    std::sort(entries.begin(), entries.end(),
              [](const Entry* a, const Entry* b) { return Order()(a->first, b->first); });
    std::vector<T> all;
    for (const Entry* e : entries) all.insert(all.end(), excess(e->second), e->first);
    return all;
  }

  Engine& engine_;
  std::uint8_t id_ = 0;
  std::size_t emissions_ = 0;
  std::map<T, Element, Order> elements_;
  Entry* touched_ = nullptr;  // those that the last run or propagation has changed
  bool changing_ = false;     // it has changed one, and has not ended
};

/// The output of a plain run.
template <class T>
class PlainOutput {
 public:
  explicit PlainOutput(PlainScope&) {}
  void emit(PlainScope&, const T& value) { elements_.insert(value); }
  [[nodiscard]] std::vector<T> values() const { return {elements_.begin(), elements_.end()}; }

 private:
  std::multiset<T, detail::OutputOrder> elements_;
};

namespace detail {

struct Emit {
  static constexpr std::string_view kName = "emit";
  template <class S, class T, class Out>
  void operator()(S& s, const ListNode<T, S>* at, Out* out) const {
    const auto* const next = s.read(at->next);
    if (next == nullptr) return;
    out->emit(s, {next->id(), at->id(), next->value()});
    s.template tail<Emit{}>(next, out);
  }
};

}  // namespace detail

/// Puts the elements of a list out, each with its place. Cost: as that of for_each
/// (list/operations.hpp); an element that comes or goes also changes the entry behind it.
template <class S, class T, class Out>
void emit(S& s, List<T, S> list, Out& out) {
  s.template call<detail::Emit{}>(list.header(), &out);
}

/// The output of programs on a scope.
template <class T, class S>
using OutputOf = std::conditional_t<S::kTraced, Output<T>, PlainOutput<T>>;

}  // namespace sac
