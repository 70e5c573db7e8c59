// Families of complexes: boxes with things in them.
#include <algorithm>
#include <cmath>

#include "generate/plc_parts.hpp"
#include "mesher/extra/generate.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

using namespace plc_parts;

constexpr Box<3> kWide{{-2, -2, -2}, {2, 2, 2}};

[[noreturn]] void fail_size(PlcKind kind, const std::string& what) {
  throw Error(
      ErrorCode::bad_option,
      "the size of " + plc_kind_names()[static_cast<std::size_t>(kind)] + " must be " + what);
}

std::size_t count_of(PlcKind kind, double size, double least, double most) {
  if (!(size >= least && size <= most) || size != std::floor(size)) {
    fail_size(kind, "a whole number from " + std::to_string(static_cast<long>(least)) + " to " +
                        std::to_string(static_cast<long>(most)));
  }
  return static_cast<std::size_t>(size);
}

// Less is lost beside coordinates of 1: corners would coincide.
constexpr double kLeastSize = 1e-12;

void require_below(PlcKind kind, double size, double limit) {
  if (size >= kLeastSize && size < limit) return;
  fail_size(kind, "at least " + text::to_text(kLeastSize) + " and below " + text::to_text(limit));
}

}  // namespace

const std::vector<std::string>& plc_kind_names() {
  static const std::vector<std::string> names{
      "cube",  "cube-square", "skew",   "dumbbell", "nested", "l-hole",  "plates",
      "cloud", "wedge",       "pages",  "spike",    "vee",    "leaning", "tetrahedron",
      "pump",  "faults",      "bricks", "tee",      "shells", "island"};
  return names;
}

std::optional<PlcKind> plc_kind(std::string_view name) {
  const auto& names = plc_kind_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<PlcKind>(found - names.begin());
}

Graph<3> generate_plc(const PlcFamily& family) {
  Builder b;
  const PlcKind kind = family.kind;
  const auto below = [&](double limit, double preset) {
    const double size = family.size.value_or(preset);
    require_below(kind, size, limit);
    return size;
  };
  const auto count = [&](double preset, double least, double most) {
    return count_of(kind, family.size.value_or(preset), least, most);
  };
  switch (kind) {
    case PlcKind::cube:
      add_box(b, kUnit);
      break;
    case PlcKind::cube_square:
      add_box(b, kUnit);
      b.polygon({square(0.5, 0.5, below(1, 0.5))});
      break;
    case PlcKind::skew: {
      const double gap = below(0.5, 0.001);
      add_box(b, kUnit);
      b.segment({0.25, 0.5, 0.5}, {0.75, 0.5, 0.5});
      b.segment({0.5, 0.25, 0.5 + gap}, {0.5, 0.75, 0.5 + gap});
      break;
    }
    case PlcKind::dumbbell:
      add_dumbbell(b, below(1, 0.2));
      break;
    case PlcKind::nested: {
      const double gap = below(0.5, 0.1);
      add_box(b, kUnit);
      add_box(b, {{gap, gap, gap}, {1 - gap, 1 - gap, 1 - gap}});
      break;
    }
    case PlcKind::l_hole:
      add_box(b, kUnit);
      b.polygon(
          {{{.2, .2, .5}, {.8, .2, .5}, {.8, .5, .5}, {.5, .5, .5}, {.5, .8, .5}, {.2, .8, .5}},
           square(.5, .35, below(.3, .1))});
      break;
    case PlcKind::plates: {
      const double gap = below(0.5, 0.02);
      add_box(b, kUnit);
      b.polygon({square(0.5, 0.5, 0.6)});
      b.polygon({square(0.5 + gap, 0.5, 0.4)});
      break;
    }
    case PlcKind::cloud:
      add_box(b, kUnit);
      add_cloud(b, count(1000, 0, 1e7), SplitMix64(family.seed));
      break;
    case PlcKind::wedge: {
      const double angle = below(180, 20);
      add_box(b, {{-1, -2, -1}, {2, 2, 2}});
      b.polygon({page(0)});
      b.polygon({page(angle)});
      break;
    }
    case PlcKind::pages: {
      const double angle = below(60, 8);
      add_box(b, kWide);
      for (int i = 0; i < 6; ++i) b.polygon({page(17 + i * angle)});
      break;
    }
    case PlcKind::spike:
      add_box(b, kWide);
      add_spike(b, below(90, 20));
      break;
    case PlcKind::vee:
      add_box(b, kWide);
      add_vee(b, below(90, 5));
      break;
    case PlcKind::leaning:
      add_box(b, kWide);
      add_leaning(b, below(90, 5));
      break;
    case PlcKind::tetrahedron:
      add_box(b, kWide);
      add_tetrahedron(b, below(1.5, 0.1));
      break;
    case PlcKind::pump:
      add_pump(b, count(16, 4, 100));
      break;
    case PlcKind::faults:
      add_box(b, kUnit);
      add_faults(b, count(20, 0, 1e6), SplitMix64(family.seed));
      break;
    case PlcKind::bricks:
      add_bricks(b, below(0.1, 0.02));
      break;
    case PlcKind::tee:
      add_box(b, kUnit);
      add_tee(b, below(0.7, 0.5));
      break;
    case PlcKind::shells:
      for (std::size_t i = 0, n = count(4, 1, 100); i < n; ++i) {
        add_icosahedron(b, 1 - 0.8 * static_cast<double>(i) / static_cast<double>(n));
      }
      break;
    case PlcKind::island: {
      const double side = below(0.4, 0.2);
      add_box(b, kUnit);
      b.polygon({square(0.5, 0.5, 0.8), square(0.5, 0.5, 0.4), square(0.5, 0.5, side)});
      break;
    }
  }
  return b.finish();
}

}  // namespace mesher
