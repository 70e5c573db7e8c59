// Whether two triangles with integer corners fit together: have nothing in common but what is
// spanned by their common corners. Exact, by the corners of their intersection.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace support {

class TrianglePair {
 public:
  using Corner = std::array<std::int64_t, 3>;
  using Triangle = std::array<Corner, 3>;

  TrianglePair(const Triangle& t, const Triangle& u) : t_(t), u_(u) {
    for (const Corner& c : t) {
      if (std::find(u.begin(), u.end(), c) != u.end()) common_.push_back(c);
    }
  }

  [[nodiscard]] bool fit() const {
    for (int i = 0; i < 3; ++i) {
      if (!fits(t_[i], t_[(i + 1) % 3], u_) || !fits(u_[i], u_[(i + 1) % 3], t_)) return false;
    }
    return true;
  }
  [[nodiscard]] static bool has_area(const Triangle& t) { return normal(t) != Corner{}; }

 private:
  // A place: a corner over a denominator > 0.
  struct Place {
    Corner x{};
    std::int64_t w = 1;
  };

  static Corner minus(const Corner& a, const Corner& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  }
  static Corner cross(const Corner& a, const Corner& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  static std::int64_t dot(const Corner& a, const Corner& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }
  static Corner normal(const Triangle& t) { return cross(minus(t[1], t[0]), minus(t[2], t[0])); }

  // a + (b - a) n / d, d != 0.
  static Place between(const Corner& a, const Corner& b, std::int64_t n, std::int64_t d) {
    if (d < 0) n = -n, d = -d;
    Place p{{}, d};
    for (int i = 0; i < 3; ++i) p.x[i] = a[i] * d + (b[i] - a[i]) * n;
    return p;
  }
  // x - a, times the denominator.
  static Corner from(const Place& p, const Corner& a) {
    return {p.x[0] - a[0] * p.w, p.x[1] - a[1] * p.w, p.x[2] - a[2] * p.w};
  }
  // Of a place in the triangle's plane.
  static bool contains(const Triangle& t, const Place& p) {
    for (int i = 0; i < 3; ++i) {
      const Corner along = minus(t[(i + 1) % 3], t[i]);
      if (dot(cross(along, from(p, t[i])), normal(t)) < 0) return false;
    }
    return true;
  }
  [[nodiscard]] bool is_common(const Place& p) const {
    if (common_.empty()) return false;
    const Corner d = from(p, common_[0]);
    if (common_.size() == 1) return d == Corner{};
    if (common_.size() == 3) return true;
    const Corner along = minus(common_[1], common_[0]);
    return cross(d, along) == Corner{} && dot(d, along) >= 0 &&
           dot(d, along) <= p.w * dot(along, along);
  }

  // What ab has in common with u is common to both triangles.
  [[nodiscard]] bool fits(const Corner& a, const Corner& b, const Triangle& u) const {
    const auto clear = [&](const Place& p) { return !contains(u, p) || is_common(p); };
    const std::int64_t ha = dot(normal(u), minus(a, u[0])), hb = dot(normal(u), minus(b, u[0]));
    if ((ha > 0 && hb > 0) || (ha < 0 && hb < 0)) return true;
    if (ha != hb) return clear(between(a, b, ha, ha - hb));
    if (!clear({a}) || !clear({b})) return false;
    for (int i = 0; i < 3; ++i) {  // in the plane
      const Corner n = cross(normal(u), minus(u[(i + 1) % 3], u[i]));
      const std::int64_t sa = dot(n, minus(a, u[i])), sb = dot(n, minus(b, u[i]));
      if (sa == sb || (sa > 0 && sb > 0) || (sa < 0 && sb < 0)) continue;
      if (!clear(between(a, b, sa, sa - sb))) return false;
    }
    return fits_in_plane(a, b, u);
  }
  // An edge between two common corners: whether both triangles have the same side of it.
  [[nodiscard]] bool fits_in_plane(const Corner& a, const Corner& b, const Triangle& u) const {
    const auto is_in = [&](const Corner& c) {
      return std::find(common_.begin(), common_.end(), c) != common_.end();
    };
    if (common_.size() == 3) return false;
    if (!is_in(a) || !is_in(b)) return true;
    const Triangle& mine = &u == &u_ ? t_ : u_;
    const auto apex = [&](const Triangle& t) {
      for (const Corner& c : t) {
        if (!is_in(c)) return c;
      }
      return a;
    };
    const Corner along = minus(b, a), n = cross(normal(u), along);
    const std::int64_t in = dot(n, minus(apex(mine), a)), out = dot(n, minus(apex(u), a));
    const bool coplanar = dot(normal(u), minus(apex(mine), a)) == 0;
    return !coplanar || (in > 0) != (out > 0);
  }

  Triangle t_, u_;
  std::vector<Corner> common_;
};

}  // namespace support
