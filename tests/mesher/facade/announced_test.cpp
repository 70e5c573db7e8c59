// Announced edits leave nothing behind that later updates would pay for.
#include "facade/announced.hpp"

#include <catch2/catch.hpp>

#include "mesher/generate.hpp"

using mesher::FeatureId;

TEST_CASE("after a large batch was announced and forgotten, forgetting costs what it did before") {
  const mesher::detail::MeshBox<2> box{.lo = {0, 0}, .side = 4};
  mesher::detail::Announced<2> announced(box);
  const std::size_t none = announced.buckets();
  std::int64_t id = 0;
  for (const auto& p : mesher::generate_points<2>(mesher::PointKind::uniform, 1000, 3)) {
    announced.set(FeatureId{++id}, {}, p);
  }
  CHECK(announced.buckets() > 1000);
  announced.clear();
  CHECK(announced.buckets() == none);
  CHECK(announced.growth() == 0);
}
