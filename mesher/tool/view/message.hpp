// Messages from the server to its pages: a head in JSON, then arrays of numbers, which a page reads
// without copying. Little endian.
//
// Form: the length of the head (4 bytes), the head, blanks up to a multiple of 8 bytes, the arrays.
// The head's `arrays` has for each `{name, type, at, length}`: `type` is f64, u32 or u8, `at`
// counts bytes from the first array and is a multiple of 8.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <vector>

namespace tool::view {

class Message {
 public:
  nlohmann::json head = nlohmann::json::object();

  template <class T>
  void add(const char* name, const std::vector<T>& items) {
    static_assert(std::is_same_v<T, double> || std::is_same_v<T, std::uint32_t> ||
                  std::is_same_v<T, std::uint8_t>);
    data_.resize((data_.size() + 7) / 8 * 8);
    head["arrays"].push_back({{"name", name},
                              {"type", sizeof(T) == 8   ? "f64"
                                       : sizeof(T) == 4 ? "u32"
                                                        : "u8"},
                              {"at", data_.size()},
                              {"length", items.size()}});
    const auto* const bytes = reinterpret_cast<const char*>(items.data());
    data_.append(bytes, items.size() * sizeof(T));
  }

  [[nodiscard]] std::string bytes() const {
    std::string text = head.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    text.resize((text.size() + 4 + 7) / 8 * 8 - 4, ' ');
    std::string all;
    all.reserve(4 + text.size() + data_.size());
    for (int i = 0; i < 4; ++i) all += static_cast<char>(text.size() >> (8 * i) & 0xff);
    return all.append(text).append(data_);
  }

 private:
  std::string data_;
};

}  // namespace tool::view
