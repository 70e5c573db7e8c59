// Ids in texts.
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>

namespace mesher {

/// The number of a PointId, LineId or PolygonId.
template <class Id>
requires std::is_enum_v<Id>
[[nodiscard]] std::string id_text(Id id) { return std::to_string(static_cast<std::int64_t>(id)); }

}  // namespace mesher
