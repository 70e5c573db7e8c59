// A live mesh behind a handle.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "arrays.hpp"
#include "handles.hpp"
#include "inputs.hpp"
#include "mesher/mesher.hpp"
#include "undo.hpp"

namespace lm {

/// Which slots are in use, by slot. A list is made at the first request, and then follows updates.
class SlotsInUse {
 public:
  using Slots = std::vector<mesher::Slot>;

  /// `is_used(slot)`: whether one of `count` slots is.
  template <class IsUsed>
  [[nodiscard]] const std::vector<std::uint8_t>& get(std::size_t count, IsUsed&& is_used) {
    if (!used_) {
      used_.emplace(count);
      for (mesher::Slot s = 0; s < count; ++s) (*used_)[s] = is_used(s);
    }
    return *used_;
  }
  /// After an update, of an array of `count` slots. What cannot be followed is made anew later.
  void follow(std::size_t count, const Slots& added, const Slots& removed) noexcept;

 private:
  std::optional<std::vector<std::uint8_t>> used_;
};

template <int D>
class LiveIn {
 public:
  explicit LiveIn(const mesher::Options<D>& options) : mesher(options) { mesher.keep_slots(true); }

  /// Makes the announced edits. The change is one of the last update. Throws: as Mesher::update.
  [[nodiscard]] mesher::DomainUpdate<D> update(const mesher::RunControl& control);
  [[nodiscard]] mesher::DomainUpdate<D> undo(const mesher::RunControl& control);
  void discard() noexcept;

  /// Runs announce(), which announces the edits of `features`; if it throws, none is announced:
  /// take_back(i) takes the i-th one back, of those that were announced.
  template <class Ids, class Announce, class TakeBack>
  void add(const Ids& ids, Announce&& announce, TakeBack&& take_back);
  /// Announces edits that cannot fail any more, but for memory.
  template <class Ids, class Announce>
  void edit(const Ids& ids, Announce&& announce);

  /// Throws: Failure(LM_BAD_ARGUMENT).
  [[nodiscard]] lm_array array(std::int32_t field);
  [[nodiscard]] lm_live_info info() const;
  /// Faults of seeds: made at the first request after an update, and valid until the next one.
  /// One thread at a time may ask.
  [[nodiscard]] const std::vector<std::string>& notes();

  mesher::Mesher<D> mesher;
  Undo<D> undo_;
  NextIds next;
  bool pending = false;

 private:
  [[nodiscard]] mesher::DomainUpdate<D> run(const mesher::RunControl& control);
  void follow(const mesher::DomainUpdate<D>& update) noexcept;

  std::uint64_t updates_ = 0;
  SlotsInUse points_, cells_, kept_, facets_;
  std::vector<std::uint8_t> polygons_;  // the kind of each facet in space
  std::optional<std::vector<std::string>> notes_;
};

struct LiveObject final : Object {
  template <int D>
  explicit LiveObject(const mesher::Options<D>& options)
      : live(std::make_unique<LiveIn<D>>(options)) {}
  /// Faults of seeds. Several readers may ask at a time.
  [[nodiscard]] const std::vector<std::string>* texts() override;

  std::variant<std::unique_ptr<LiveIn<2>>, std::unique_ptr<LiveIn<3>>> live;

 private:
  std::mutex making_;
};

template <int D>
template <class Ids, class Announce, class TakeBack>
void LiveIn<D>::add(const Ids& ids, Announce&& announce, TakeBack&& take_back) {
  std::size_t done = 0;
  try {
    for (; done < ids.size(); ++done) {
      announce(done);
      undo_.touch(ids[done]);
    }
  } catch (const std::bad_alloc&) {
    discard();
    throw;
  } catch (...) {
    while (done > 0) take_back(--done);
    throw;
  }
  pending = pending || !ids.empty();
}

template <int D>
template <class Ids, class Announce>
void LiveIn<D>::edit(const Ids& ids, Announce&& announce) {
  try {
    for (const auto& id : ids) undo_.touch(id);
    announce();
  } catch (...) {
    discard();
    throw;
  }
  pending = pending || !ids.empty();
}

}  // namespace lm
