// Options: what is 0 is the default.
#include "options.hpp"

#include <algorithm>
#include <string>

#include "mesher/sizes.hpp"
#include "sizes.hpp"
#include "structs.hpp"

namespace lm {
namespace {

// The value of an enumeration that begins with 0. Throws: Failure(LM_BAD_ARGUMENT).
template <class Enum>
Enum checked(std::int32_t value, Enum last, const char* what) {
  if (value < 0 || value > static_cast<std::int32_t>(last)) {
    throw Failure(LM_BAD_ARGUMENT, std::string(what) + " is " + std::to_string(value));
  }
  return static_cast<Enum>(value);
}

template <int D>
mesher::Box<D> box_of(const double* lo, const double* hi) {
  mesher::Box<D> box;
  std::copy_n(lo, D, box.lo.begin());
  std::copy_n(hi, D, box.hi.begin());
  return box;
}

template <int D>
void add_box_limits(const lm_options& given, mesher::Options<D>& options) {
  require_array(given.box_limits, given.box_limits_count, "options->box_limits");
  const auto* bytes = reinterpret_cast<const unsigned char*>(given.box_limits);
  for (std::size_t i = 0; i < given.box_limits_count; ++i) {
    // The caller's structs are as far apart as the first says they are large.
    const auto* user = reinterpret_cast<const lm_box_limits*>(bytes + i * given.box_limits->size);
    const lm_box_limits limits = read_struct(user, "options->box_limits");
    mesher::set_limits<D>(options, box_of<D>(limits.lo, limits.hi),
                          {limits.max_measure, sizes_of<D>(limits.sizes)});
  }
}

}  // namespace

template <int D>
mesher::Options<D> options_of(const lm_options* user) {
  mesher::Options<D> options;
  if (user == nullptr) return options;
  const lm_options given = read_struct(user, "options");
  options.domain = box_of<D>(given.domain_lo, given.domain_hi);
  if (given.rho != 0) options.rho = given.rho;
  options.min_angle = given.min_angle;
  if constexpr (D == 3) {
    options.min_dihedral = given.min_dihedral;
  } else if (given.min_dihedral != 0) {
    throw Failure(LM_BAD_ARGUMENT, "options->min_dihedral is for space alone");
  }
  options.growth = given.growth;
  options.max_measure = given.max_measure;
  options.sizes = sizes_of<D>(given.sizes);
  options.max_vertices = given.max_vertices;
  if (given.threads != 0) options.threads = given.threads;
  options.extent = checked(given.extent, mesher::Extent::box, "options->extent");
  options.algorithm = checked(given.algorithm, mesher::Algorithm::gap_balls, "options->algorithm");
  options.rule = checked(given.rule, mesher::Rule::voronoi_aspect, "options->rule");
  options.region_areas =
      given.region_limits != 0 ? mesher::RegionAreas::limits : mesher::RegionAreas::ignored;
  add_box_limits(given, options);
  return options;
}
template mesher::Options<2> options_of<2>(const lm_options*);
template mesher::Options<3> options_of<3>(const lm_options*);

}  // namespace lm
