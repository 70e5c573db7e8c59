// Temporary: static shells and crowding by brute force.
#pragma once
#include <map>
#include "segments/segment.hpp"
#include "segments/exempt.hpp"
namespace mesher::detail {
struct PieceSplit { Label at; PieceKind lo, hi; };
struct StandIn {
  VertexPool<2>& pool; SegmentPool segments; std::map<VertexHandle, std::vector<SegmentHandle>> at; std::vector<VertexHandle> inputs; std::map<VertexHandle, double> zr;
  explicit StandIn(VertexPool<2>& p) : pool(p) {}
  void add(VertexHandle a, VertexHandle b) { if (pool[b].p < pool[a].p) std::swap(a, b); Segment& s = segments.create(pool[a], pool[b]); s.alive = true; at[a].push_back(s.self); at[b].push_back(s.self); }
  template <class V> void for_each_at(VertexHandle v, V&& visit) const { auto it = at.find(v); if (it != at.end()) for (auto h : it->second) visit(h); }
  static double pt_seg(Point<2> p, Point<2> a, Point<2> b) { double vx = b[0]-a[0], vy = b[1]-a[1], wx = p[0]-a[0], wy = p[1]-a[1], l = vx*vx+vy*vy; double t = l > 0 ? std::clamp((wx*vx+wy*vy)/l, 0.0, 1.0) : 0; return std::hypot(wx-t*vx, wy-t*vy); }
  static bool cross_(Point<2> a, Point<2> b, Point<2> c, Point<2> d) { using predicates::orient2d; return orient2d(a,b,c)*orient2d(a,b,d) <= 0 && orient2d(c,d,a)*orient2d(c,d,b) <= 0 && !(std::max(a[0],b[0]) < std::min(c[0],d[0]) || std::max(c[0],d[0]) < std::min(a[0],b[0]) || std::max(a[1],b[1]) < std::min(c[1],d[1]) || std::max(c[1],d[1]) < std::min(a[1],b[1])); }
  static double seg_seg(Point<2> a, Point<2> b, Point<2> c, Point<2> d) { if (cross_(a,b,c,d)) return 0; return std::min(std::min(pt_seg(a,c,d), pt_seg(b,c,d)), std::min(pt_seg(c,a,b), pt_seg(d,a,b))); }
  double angle(const Segment& s, const Segment& t, VertexHandle q) const { auto dir = [&](const Segment& l) { auto& p = pool[l.other(q)].p; return Point<2>{p[0]-pool[q].p[0], p[1]-pool[q].p[1]}; }; auto u = dir(s), w = dir(t); return std::abs(std::atan2(u[0]*w[1]-u[1]*w[0], u[0]*w[0]+u[1]*w[1]))*180/M_PI; }
  double R(VertexHandle q) { if (auto it = zr.find(q); it != zr.end()) return it->second; double best = 1e300; for (auto h : at[q]) best = std::min(best, segments[h].length); Point<2> p = pool[q].p; segments.for_each([&](const Segment& t) { if (!t.has_end(q)) best = std::min(best, pt_seg(p, t.place_a, t.place_b)); }); for (auto v : inputs) if (v != q) best = std::min(best, std::hypot(pool[v].p[0]-p[0], pool[v].p[1]-p[1])); return zr[q] = best; }
  double zone(const Segment& s, VertexHandle q) { double z = 0; for (auto h : at[q]) if (h != s.self) { auto& t = segments[h]; double an = angle(s, t, q); if (an < 20) z = std::max(z, std::min(s.length, t.length)); else if (an < 60) z = std::max(z, std::min(R(q), t.length)); } return z; }
  static double pow2(double x) { int e; double m = std::frexp(x, &e); return std::ldexp(1.0, m == 0.5 ? e - 1 : e); }
  static double roundest(double lo, double hi) { double g = pow2(hi); for (;;) { double m = std::ceil(lo / g) * g; if (m <= hi) return m; g /= 2; } }
  PieceSplit place(const Piece& f) {
    const Segment& s = segments[f.segment]; double L = s.length; PieceKind k = f.kind;
    if (k == PieceKind::whole) { double Za = zone(s, s.a), Zb = zone(s, s.b); bool x = Za >= L/2, y = Zb >= L/2; if (x && y) return {{L/2, false}, PieceKind::from_a, PieceKind::from_b}; if (y) k = Za > 0 ? PieceKind::from_b_to_a : PieceKind::from_b; else k = Zb > 0 ? PieceKind::from_a_to_b : PieceKind::from_a; }
    bool fb = k == PieceKind::from_b || k == PieceKind::from_b_to_a; bool to = k == PieceKind::from_a_to_b || k == PieceKind::from_b_to_a;
    double u = fb ? f.hi.from(true, L) : f.lo.from(false, L), w = fb ? f.lo.from(true, L) : f.hi.from(false, L); if (to) w = L;
    double r = roundest(u + (w-u)/3, w - (w-u)/3);
    if (!to) return {{r, fb}, k, k};
    bool last = L - r <= zone(s, fb ? s.a : s.b);
    if (!fb) return {{r, false}, PieceKind::from_a, last ? PieceKind::from_b : k};
    return {{r, true}, last ? PieceKind::from_a : k, PieceKind::from_b};
  }
  bool crowded(const Piece& f) {
    const Segment& s = segments[f.segment]; Point<2> a = place_of(s, f.lo), b = place_of(s, f.hi); double l = std::hypot(a[0]-b[0], a[1]-b[1]); Point<2> m{(a[0]+b[0])/2, (a[1]+b[1])/2}; bool c = false; double rr = 0.64 * l;
    segments.for_each([&](const Segment& t) { if (c || t.has_end(s.a) || t.has_end(s.b)) return; if (std::min(t.place_a[0], t.place_b[0]) > m[0]+rr || std::max(t.place_a[0], t.place_b[0]) < m[0]-rr || std::min(t.place_a[1], t.place_b[1]) > m[1]+rr || std::max(t.place_a[1], t.place_b[1]) < m[1]-rr) return; if (pt_seg(m, t.place_a, t.place_b) < l/2) c = true; else if (seg_seg(a, b, t.place_a, t.place_b) < l/8) c = true; });
    if (!c) for (auto v : inputs) { if (v == s.a || v == s.b) continue; auto& p = pool[v].p; if (std::abs(p[0]-m[0]) > rr || std::abs(p[1]-m[1]) > rr) continue; if (in_diametral_ball(p, a, b) || pt_seg(p, a, b) < l/8) { c = true; break; } }
    return c;
  }
};
}  // namespace mesher::detail
