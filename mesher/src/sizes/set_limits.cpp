// The least of several fields, and limits of options.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mesher/sizes.hpp"
#include "sizes/all_limits.hpp"

namespace mesher {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

class LeastSizes final : public SizeField<2> {
 public:
  explicit LeastSizes(std::vector<std::shared_ptr<const SizeField<2>>> fields)
      : fields_(std::move(fields)) {}

  [[nodiscard]] double at(const Point<2>& p) const override {
    double least = kInfinite;
    for (const auto& f : fields_) least = std::min(least, f->at(p));
    return least;
  }
  [[nodiscard]] SizeRange range(const Box<2>& box) const override {
    SizeRange least{kInfinite, kInfinite};
    for (const auto& f : fields_) {
      const SizeRange r = f->range(box);
      least = {std::min(least.least, r.least), std::min(least.most, r.most)};
    }
    return least;
  }

 private:
  std::vector<std::shared_ptr<const SizeField<2>>> fields_;
};

}  // namespace

void set_limits(Options<2>& options, const SizeLimits<2>& limits) {
  detail::AllLimits{limits, {}, options.region_limits}.apply_to(options);
}
void set_limits(Options<2>& options, const Box<2>& box, const SizeLimits<2>& limits) {
  auto all = detail::AllLimits::of(options);
  all.set_within(box, limits);
  std::move(all).apply_to(options);
}

double size_of_area(double area) { return std::sqrt(area / kAreaOfSize); }

std::shared_ptr<const SizeField<2>> least_sizes(
    std::vector<std::shared_ptr<const SizeField<2>>> fields) {
  std::erase(fields, nullptr);
  if (fields.size() < 2) return fields.empty() ? nullptr : fields.front();
  return std::make_shared<LeastSizes>(std::move(fields));
}

}  // namespace mesher
