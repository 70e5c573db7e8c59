// Keeps something held, so that several threads may look at it.
#pragma once

namespace mesher::detail {

/// `T` has hold(bool).
template <class T>
class Held {
 public:
  explicit Held(T& held) noexcept : held_(held) { held_.hold(true); }
  ~Held() { held_.hold(false); }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;

 private:
  T& held_;
};

}  // namespace mesher::detail
