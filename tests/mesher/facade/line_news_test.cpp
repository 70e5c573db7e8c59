// What a large update has brought leaves nothing behind that later updates would pay for.
#include "facade/line_news.hpp"

#include <catch2/catch.hpp>

using mesher::LineId;
using mesher::PointId;

TEST_CASE("after a large update of lines its names are forgotten at the cost of a small one") {
  mesher::detail::LineNews news;
  const std::size_t none = news.buckets();
  for (std::uint32_t i = 1; i <= 1000; ++i) {
    news.points[i] = PointId{i};
    news.lines[i] = LineId{i};
    news.line_points[LineId{i}] = {PointId{1}, PointId{2}};
    news.segments.push_back(i);
    news.taken.insert(i);
  }
  CHECK(news.buckets() > 4000);
  news.clear();
  CHECK(news.buckets() == none);
  CHECK(news.points.size() + news.lines.size() + news.line_points.size() == 0);
  CHECK(news.segments.size() + news.taken.size() == 0);
}
