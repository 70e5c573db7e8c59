// Limits of size that several processes announce, and have in common.
//
// Limits that are numbers, and backgrounds (sampled_sizes), are announced by any process, which
// tells the others. Any other field is a function, which cannot be told: limits with one are
// announced by all processes, each with a field of its own that says the same. They are steps that
// all take together: what a process announces before one of them is made before it.
//
// Whether functions say the same is looked at in a few places.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "mesher/sizes.hpp"
#include "tiles/parcel.hpp"

namespace mesher::detail {

template <int D>
struct AnnouncedLimits {
  std::optional<Box<D>> box;  // nothing: everywhere
  SizeLimits<D> limits;
};

/// What limits of options say, in bytes that are equal if they say the same.
template <int D>
void pack_limits(const Options<D>& options, Packer& to);

template <int D>
class JointLimits {
 public:
  void announce(AnnouncedLimits<D> limits) { announced_.push_back(std::move(limits)); }
  void clear() noexcept { announced_.clear(); }
  [[nodiscard]] bool is_empty() const noexcept { return announced_.empty(); }

  /// What this process announces. `domain`: where functions are looked at. Throws: what these do.
  void pack(const Box<D>& domain, Packer& to) const;
  /// Those of all processes, by what each has packed: up to the next that all announce those of the
  /// first process, then of the second, and so on. Equal backgrounds are one object.
  /// Throws: Error(bad_option) if functions are not announced by all.
  [[nodiscard]] std::vector<AnnouncedLimits<D>> joined(std::vector<Unpacker>& by_process,
                                                       std::size_t self);

 private:
  using Field = std::shared_ptr<const SizeField<D>>;
  using Samples = std::vector<SizeSample<D>>;
  struct Told;
  [[nodiscard]] Told unpack(Unpacker& from);
  [[nodiscard]] Field background(Samples samples);

  std::vector<AnnouncedLimits<D>> announced_;
  std::vector<std::pair<Samples, std::weak_ptr<const SizeField<D>>>> backgrounds_;
};

}  // namespace mesher::detail
