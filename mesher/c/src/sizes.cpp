// Sizes: samples, functions and files.
#include "sizes.hpp"

#include <cmath>
#include <string>

#include "inputs.hpp"
#include "mesher/read.hpp"

namespace lm {
namespace {

using mesher::Error;
using mesher::ErrorCode;
using mesher::Point;

template <int D>
SizesObject::Field sampled(std::size_t n, const double* at, const double* h) {
  std::vector<mesher::SizeSample<D>> samples(n);
  for (std::size_t i = 0; i < n; ++i) {
    samples[i] = {point_at<D>(at, i), h[i]};
    require_coordinates<D>(samples[i].at, mesher::Feature());
  }
  return mesher::sampled_sizes<D>(samples);
}

template <int D>
SizesObject::Field called(lm_size_callback size, void* user, double slope, double least) {
  const auto at = [=](const Point<D>& p) {
    const double h = size(p.data(), user);
    if (h > 0) return h;
    throw Error(ErrorCode::bad_option, "the size callback returned a size that is not above 0", {},
                {}, {mesher::position_of(p)});
  };
  return std::make_shared<const mesher::SlopedSizes<D>>(at, slope, least);
}

template <int D>
SizesObject::Field read(const char* path) {
  return mesher::sampled_sizes<D>(mesher::read_sizes<D>(path).samples);
}

}  // namespace

template <int D>
std::shared_ptr<const mesher::SizeField<D>> sizes_of(lm_handle handle) {
  if (handle == 0) return nullptr;
  const Reading<SizesObject> sizes(handle);
  const auto* field = std::get_if<std::shared_ptr<const mesher::SizeField<D>>>(&sizes->field);
  if (field == nullptr) throw Failure(LM_BAD_ARGUMENT, "the sizes are of the other dimension");
  return *field;
}
template std::shared_ptr<const mesher::SizeField<2>> sizes_of<2>(lm_handle);
template std::shared_ptr<const mesher::SizeField<3>> sizes_of<3>(lm_handle);

}  // namespace lm

using namespace lm;

lm_status lm_sizes_samples(int32_t dimension, size_t n, const double* at, const double* h,
                           lm_handle* sizes) {
  return guarded([&] {
    require_pointer(sizes, "sizes");
    require_array(at, n, "at");
    require_array(h, n, "h");
    if (dimension != 2 && dimension != 3) fail_dimension(dimension);
    make_object<SizesObject>(sizes, dimension == 2 ? sampled<2>(n, at, h) : sampled<3>(n, at, h));
  });
}

lm_status lm_sizes_function(int32_t dimension, lm_size_callback size, void* user, double slope,
                            double least, lm_handle* sizes) {
  return guarded([&] {
    require_pointer(sizes, "sizes");
    if (size == nullptr) throw Failure(LM_NULL_POINTER, "size is NULL");
    if (!(slope >= 0) || !std::isfinite(slope) || !(least > 0) || !std::isfinite(least)) {
      throw Failure(LM_BAD_ARGUMENT, "slope must be 0 or above, least above 0, both finite");
    }
    if (dimension != 2 && dimension != 3) fail_dimension(dimension);
    make_object<SizesObject>(sizes, dimension == 2 ? called<2>(size, user, slope, least)
                                                   : called<3>(size, user, slope, least));
  });
}

lm_status lm_sizes_read(const char* path, int32_t dimension, lm_handle* sizes) {
  return guarded([&] {
    require_pointer(path, "path");
    require_pointer(sizes, "sizes");
    if (dimension != 2 && dimension != 3) fail_dimension(dimension);
    make_object<SizesObject>(sizes, dimension == 2 ? read<2>(path) : read<3>(path));
  });
}

double lm_measure_of_size(int32_t dimension, double h) {
  return dimension == 2 ? mesher::measure_of_size<2>(h) : mesher::measure_of_size<3>(h);
}
