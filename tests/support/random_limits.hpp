// Random edits of limits of size, everywhere and in boxes.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "facade/pending_limits.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/sizes.hpp"

namespace support {

/// Two sizes, in squares like those of a chessboard; no limit in some. As plateaus or not.
class Chessboard final : public mesher::SizeField<2> {
 public:
  explicit Chessboard(bool even = false) : even_(even) {}
  [[nodiscard]] double at(const mesher::Point<2>& p) const override {
    const double x = std::floor(p[0] / 3), y = std::floor(p[1] / 3);
    if (x == 1 && y == 1) return std::numeric_limits<double>::infinity();
    return std::fmod(x + y, 2) == 0 ? 0.8 : 4;
  }
  [[nodiscard]] mesher::SizeRange range(const mesher::Box<2>& box) const override {
    mesher::SizeRange all{std::numeric_limits<double>::infinity(), 0, even_};
    for (double x = std::floor(box.lo[0] / 3); 3 * x <= box.hi[0]; ++x) {
      for (double y = std::floor(box.lo[1] / 3); 3 * y <= box.hi[1]; ++y) {
        const double h = at({3 * x + 1, 3 * y + 1});
        all.least = std::min(all.least, h), all.most = std::max(all.most, h);
      }
    }
    return all;
  }
  [[nodiscard]] std::vector<double> plateaus() const override {
    return even_ ? std::vector<double>{0.8, 4} : std::vector<double>{};
  }

 private:
  bool even_;
};

/// Limits for a domain of 16 x 16.
class RandomLimits {
 public:
  explicit RandomLimits(std::uint64_t seed) : random_(seed) {
    const auto sloped = [](const mesher::Point<2>& p) {
      return 0.7 + 0.3 * std::hypot(p[0] - 7, p[1] - 9);
    };
    std::vector<mesher::SizeSample<2>> samples;
    for (int i = 0; i < 30; ++i) {
      samples.push_back({{16 * random_.unit(), 16 * random_.unit()}, 0.8 + 3 * random_.unit()});
    }
    fields_ = {std::make_shared<mesher::SlopedSizes<2>>(sloped, 0.3, 0.7),
               std::make_shared<Chessboard>(false), std::make_shared<Chessboard>(true),
               mesher::sampled_sizes(samples)};
  }

  /// Edits the limits of `options`; returns where.
  mesher::Box<2> edit(mesher::Options<2>& options) {
    auto all = mesher::detail::AllLimits<2>::of(options);
    mesher::Box<2> where = options.domain;
    if (below(4) == 0) {
      all = {limits(), {}};
    } else {
      where = box();
      all.set_within(where, limits());
    }
    std::move(all).apply_to(options);
    return where;
  }
  mesher::SizeLimits<2> limits() {
    // The pitch of the lattice is 1 for the first.
    constexpr double kAreas[] = {0.4375, 0.2, 3, 0.4375 * (1 + 0x1p-40)};
    mesher::SizeLimits<2> limits;
    if (below(3) != 0) limits.max_measure = kAreas[below(4)];
    if (below(3) == 0) limits.sizes = fields_[below(fields_.size())];
    return limits;
  }
  /// Its sides are on lattice points and cells' sides now and then, or beyond the domain; it may
  /// have no inside.
  mesher::Box<2> box() {
    mesher::Box<2> box;
    for (std::size_t i = 0; i < 2; ++i) {
      const double extent = std::exp2(5 * random_.unit()) / 2;
      box.lo[i] = 18 * random_.unit() - 1;
      if (below(2) == 0) box.lo[i] = std::floor(box.lo[i]);
      if (below(4) == 0) box.lo[i] = 0.875 * std::floor(box.lo[i]);
      box.hi[i] = box.lo[i] + (below(2) == 0 ? std::floor(extent) : extent);
    }
    return box;
  }
  std::uint64_t below(std::uint64_t n) { return random_.below(n); }

 private:
  mesher::SplitMix64 random_;
  std::vector<std::shared_ptr<const mesher::SizeField<2>>> fields_;
};

}  // namespace support
