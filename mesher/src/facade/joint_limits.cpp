// Limits as bytes, and the order in which those of all processes are made.
#include "facade/joint_limits.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <iterator>

#include "mesher/error.hpp"
#include "sac/label.hpp"
#include "sizes/region_limits.hpp"
#include "sizes/sampled_sizes.hpp"

namespace mesher::detail {

namespace {

enum class FieldKind : std::uint8_t { none, samples, function };

// In the domain, at fractions of its sides that functions are unlikely to be even in.
template <int D, class Visit>
void for_each_probe(const Box<D>& domain, Visit&& visit) {
  constexpr double kParts[] = {0, 0.21, 0.5, 0.83, 1};
  std::array<std::size_t, D> at{};
  while (true) {
    Point<D> p;
    for (std::size_t i = 0; i < D; ++i) {
      p[i] = domain.lo[i] + kParts[at[i]] * (domain.hi[i] - domain.lo[i]);
    }
    visit(p);
    std::size_t i = 0;
    while (i < D && ++at[i] == std::size(kParts)) at[i++] = 0;
    if (i == D) return;
  }
}

// What a function says, in a few places.
template <int D>
std::vector<double> said_by(const SizeField<D>& field, const Box<D>& domain) {
  std::vector<double> said = field.plateaus();
  const SizeRange all = field.range(domain);
  said.insert(said.end(), {all.least, all.most, all.even ? 1.0 : 0.0});
  for_each_probe<D>(domain, [&](const Point<D>& p) { said.push_back(field.at(p)); });
  return said;
}

template <int D>
void pack_field(const SizeField<D>* field, const Box<D>& domain, Packer& to) {
  if (field == nullptr) return to.put(FieldKind::none);
  if (const auto* samples = samples_of<D>(*field)) {
    to.put(FieldKind::samples);
    return to.put_all(*samples);
  }
  to.put(FieldKind::function);
  to.put_all(said_by<D>(*field, domain));
}

template <int D>
void pack_one(const std::optional<Box<D>>& box, const SizeLimits<D>& limits, const Box<D>& domain,
              Packer& to) {
  to.put(std::uint8_t{box.has_value()});
  to.put(box.value_or(Box<D>()));
  to.put(limits.max_measure);
  pack_field<D>(limits.sizes.get(), domain, to);
}

// Whatever the order of simplices.
template <int D>
std::uint64_t digest(const RegionLimits<D>& regions) {
  std::uint64_t all = 0;
  const auto add = [](std::uint64_t& h, double x) {
    h = sac::mix(h) + std::bit_cast<std::uint64_t>(x);
  };
  regions.for_each([&](const auto& corners, const auto& limit) {
    std::uint64_t h = limit.counts ? 1 : 2;
    for (const Point<D>& p : corners) {
      for (const double x : p) add(h, x);
    }
    add(h, limit.measure);
    all += sac::mix(h);
  });
  return all;
}

}  // namespace

template <int D>
void pack_limits(const Options<D>& options, Packer& to) {
  pack_one<D>(std::nullopt, {options.max_measure, options.sizes}, options.domain, to);
  for (const BoxLimits<D>& part : options.box_limits) {
    pack_one<D>(part.box, part.limits, options.domain, to);
  }
  if (options.region_limits == nullptr) return;
  to.put(digest(*options.region_limits));
  to.put_all(options.region_limits->measures());
}

template <int D>
void JointLimits<D>::pack(const Box<D>& domain, Packer& to) const {
  to.put(std::uint64_t{announced_.size()});
  for (const AnnouncedLimits<D>& one : announced_) pack_one<D>(one.box, one.limits, domain, to);
}

// What a process has told of limits.
template <int D>
struct JointLimits<D>::Told {
  AnnouncedLimits<D> limits;  // a function is left out
  std::optional<std::vector<double>> function;

  [[nodiscard]] bool says_as(const Told& other) const {
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
    return limits.box == other.limits.box &&
           limits.limits.max_measure == other.limits.limits.max_measure &&
           std::equal(function->begin(), function->end(), other.function->begin(),
                      other.function->end(),
                      [&](double x, double y) { return bits(x) == bits(y); });
  }
};

template <int D>
auto JointLimits<D>::background(Samples samples) -> Field {
  std::erase_if(backgrounds_, [](const auto& known) { return known.second.expired(); });
  for (const auto& [known, field] : backgrounds_) {
    if (known == samples) return field.lock();
  }
  Field field = sampled_sizes<D>(samples);
  backgrounds_.emplace_back(std::move(samples), field);
  return field;
}

template <int D>
auto JointLimits<D>::unpack(Unpacker& from) -> Told {
  Told told;
  const bool has_box = from.take<std::uint8_t>() != 0;
  const auto box = from.take<Box<D>>();
  if (has_box) told.limits.box = box;
  told.limits.limits.max_measure = from.take<double>();
  const auto kind = from.take<FieldKind>();
  if (kind == FieldKind::samples) {
    told.limits.limits.sizes = background(from.take_all<SizeSample<D>>());
  } else if (kind == FieldKind::function) {
    told.function = from.take_all<double>();
  }
  return told;
}

template <int D>
auto JointLimits<D>::joined(std::vector<Unpacker>& by_process, std::size_t self)
    -> std::vector<AnnouncedLimits<D>> {
  std::vector<std::vector<Told>> told(by_process.size());
  for (std::size_t k = 0; k < told.size(); ++k) {
    const auto count = by_process[k].take<std::uint64_t>();
    for (std::uint64_t i = 0; i < count; ++i) told[k].push_back(unpack(by_process[k]));
  }
  std::vector<AnnouncedLimits<D>> all;
  std::vector<std::size_t> at(told.size());
  while (true) {
    std::size_t ended = 0;
    for (std::size_t k = 0; k < told.size(); ++k) {
      for (; at[k] < told[k].size() && !told[k][at[k]].function; ++at[k]) {
        all.push_back(std::move(told[k][at[k]].limits));
      }
      if (at[k] == told[k].size()) ++ended;
    }
    if (ended == told.size()) return all;
    for (std::size_t k = 0; k < told.size(); ++k) {
      if (ended == 0 && told[k][at[k]].says_as(told[0][at[0]])) continue;
      throw Error(ErrorCode::bad_option,
                  "limits of size with a function are announced by all processes, in one order "
                  "and with one function");
    }
    all.push_back(announced_[at[self]]);
    for (std::size_t& next : at) ++next;
  }
}

template void pack_limits(const Options<2>&, Packer&);
template class JointLimits<2>;
#ifndef MESHER_PLANE_ONLY
template void pack_limits(const Options<3>&, Packer&);
template class JointLimits<3>;
#endif

}  // namespace mesher::detail
