// The examples of the engine by name.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app_subject.hpp"

namespace tool {

/// Names as they are written on a command line: list-map.
[[nodiscard]] std::vector<std::string> example_names();

/// Null: there is no such example. Its first input has about `size` elements.
[[nodiscard]] std::unique_ptr<RecordedSubject> make_example(const std::string& name,
                                                            std::uint64_t seed, int size);

}  // namespace tool
