// Random limits of size in space, for a domain of 2 x 2 x 2.
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "mesher/extra/generate.hpp"
#include "mesher/sizes.hpp"

namespace support {

/// Two sizes in cubes like a chessboard's squares, no limit in one. As plateaus or not.
class Cubes final : public mesher::SizeField<3> {
 public:
  explicit Cubes(bool even) : even_(even) {}
  [[nodiscard]] double at(const mesher::Point<3>& p) const override {
    const double x = std::floor(2 * p[0]), y = std::floor(2 * p[1]), z = std::floor(2 * p[2]);
    if (x == 1 && y == 1 && z == 1) return std::numeric_limits<double>::infinity();
    return std::fmod(x + y + z, 2) == 0 ? 0.25 : 0.6;
  }
  [[nodiscard]] mesher::SizeRange range(const mesher::Box<3>& box) const override {
    mesher::SizeRange all{std::numeric_limits<double>::infinity(), 0, even_};
    const auto next = [](double x) { return std::floor(2 * x + 1) / 2; };
    for (double x = box.lo[0]; x <= box.hi[0]; x = next(x)) {
      for (double y = box.lo[1]; y <= box.hi[1]; y = next(y)) {
        for (double z = box.lo[2]; z <= box.hi[2]; z = next(z)) {
          const double h = at({x, y, z});
          all.least = std::min(all.least, h), all.most = std::max(all.most, h);
        }
      }
    }
    return all;
  }
  [[nodiscard]] std::vector<double> plateaus() const override {
    return even_ ? std::vector<double>{0.25, 0.6} : std::vector<double>{};
  }

 private:
  bool even_;
};

class SpaceLimits {
 public:
  explicit SpaceLimits(std::uint64_t seed) : random_(seed) {
    const auto sloped = [](const mesher::Point<3>& p) {
      return 0.2 + 0.3 * std::hypot(p[0] - 1.2, p[1] - 0.7, p[2] - 1);
    };
    fields_ = {std::make_shared<mesher::SlopedSizes<3>>(sloped, 0.3, 0.2),
               std::make_shared<Cubes>(false), std::make_shared<Cubes>(true)};
  }

  [[nodiscard]] mesher::SizeLimits<3> limits() {
    // The pitches of the first two are 1/4 and 1/2, so that points of the input are on the lattice.
    constexpr double kVolumes[] = {1.0 / 768, 1.0 / 96, 0.004, 0.1};
    mesher::SizeLimits<3> limits;
    if (random_.below(4) != 0) limits.max_measure = kVolumes[random_.below(4)];
    if (random_.below(4) == 0) limits.sizes = fields_[random_.below(fields_.size())];
    return limits;
  }
  /// Its sides are on lattice points now and then, or beyond the domain; it may have no inside.
  [[nodiscard]] mesher::Box<3> box() {
    mesher::Box<3> box;
    for (std::size_t i = 0; i < 3; ++i) {
      box.lo[i] = 2.5 * random_.unit() - 0.5;
      if (random_.below(2) == 0) box.lo[i] = std::floor(8 * box.lo[i]) / 8;
      box.hi[i] = box.lo[i] + static_cast<double>(random_.below(6)) / 4;
    }
    return box;
  }
  /// Announces others, everywhere or in a box. M: a Mesher<3>.
  template <class M>
  void edit(M& m) {
    random_.below(3) == 0 ? m.limit(limits()) : m.limit(box(), limits());
  }

 private:
  mesher::SplitMix64 random_;
  std::vector<std::shared_ptr<const mesher::SizeField<3>>> fields_;
};

}  // namespace support
