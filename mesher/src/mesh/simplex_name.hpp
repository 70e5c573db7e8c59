// Names of simplices, for people.
#pragma once

namespace mesher {

/// D is 2 or 3.
template <int D>
inline constexpr const char* kSimplexName = D == 2 ? "triangle" : "tetrahedron";
template <int D>
inline constexpr const char* kSimplicesName = D == 2 ? "triangles" : "tetrahedra";

}  // namespace mesher
