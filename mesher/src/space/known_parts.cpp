#include "space/known_parts.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

#include "sets/make_set.hpp"

namespace mesher::detail {

namespace {

constexpr PolygonId kLeast{std::numeric_limits<std::int64_t>::min()};

LineEdge turned(LineEdge e) {
  std::swap(e.from, e.to);
  return e;
}

template <class T>
std::vector<T> without(const std::vector<T>& all, const std::vector<T>& others) {
  std::vector<T> rest;
  std::set_difference(all.begin(), all.end(), others.begin(), others.end(),
                      std::back_inserter(rest));
  return rest;
}

bool is_among(VertexHandle v, const std::vector<VertexHandle>& all) {
  return std::binary_search(all.begin(), all.end(), v);
}

}  // namespace

KnownParts::KnownParts(const OnFeatures& parts) {
  for (const LineEdge& e : parts.edges) {
    edges_.insert(e);
    edges_.insert(turned(e));
  }
  faces_.insert(parts.faces.begin(), parts.faces.end());
}

template <class Visit>
void KnownParts::visit_edges_at(VertexHandle v, Visit&& visit) const {
  auto it = edges_.lower_bound({v, 0, {}, 0});
  for (; it != edges_.end() && it->from == v; ++it) visit(*it);
}

void KnownParts::list_ends(std::uint32_t edge, VertexHandle start,
                           std::vector<VertexHandle>& all) const {
  std::set<VertexHandle> seen{start};
  std::vector<VertexHandle> reached{start};
  while (!reached.empty()) {
    const VertexHandle v = reached.back();
    reached.pop_back();
    all.push_back(v);
    visit_edges_at(v, [&](const LineEdge& e) {
      if (e.record == edge && seen.insert(e.to).second) reached.push_back(e.to);
    });
  }
}

KnownParts::News KnownParts::news(const std::vector<VertexHandle>& at,
                                  const OnFeatures& now) const {
  std::vector<LineEdge> edges_then, edges_now;
  std::vector<PolygonFace> faces_then, faces_now;
  for (const VertexHandle v : at) {
    visit_edges_at(v,
                   [&](const LineEdge& e) { edges_then.push_back(e.from < e.to ? e : turned(e)); });
    auto it = faces_.lower_bound({{v, 0, 0}, kLeast});
    for (; it != faces_.end() && it->corners[0] == v; ++it) faces_then.push_back(*it);
  }
  for (const LineEdge& e : now.edges) {
    if (is_among(e.from, at) || is_among(e.to, at)) edges_now.push_back(e);
  }
  for (const PolygonFace& f : now.faces) {
    if (is_among(f.corners[0], at)) faces_now.push_back(f);
  }
  for (auto* edges : {&edges_then, &edges_now}) make_set(*edges);
  for (auto* faces : {&faces_then, &faces_now}) make_set(*faces);
  News news;
  news.edges_in = without(edges_now, edges_then), news.edges_out = without(edges_then, edges_now);
  news.faces_in = without(faces_now, faces_then), news.faces_out = without(faces_then, faces_now);
  for (const LineEdge& e : news.edges_in) news.edges_.insert({e, turned(e)});
  news.faces_.insert(news.faces_in.begin(), news.faces_in.end());
  return news;
}

void KnownParts::apply(News& news) noexcept {
  for (const LineEdge& e : news.edges_out) {
    edges_.erase(e);
    edges_.erase(turned(e));
  }
  for (const PolygonFace& f : news.faces_out) faces_.erase(f);
  edges_.merge(news.edges_);
  faces_.merge(news.faces_);
}

std::size_t KnownParts::bytes() const noexcept {
  const auto of = [](const auto& all) {  // links, and what the allocator takes
    return all.size() * (sizeof(*all.begin()) + 48);
  };
  return of(edges_) + of(faces_);
}

}  // namespace mesher::detail
