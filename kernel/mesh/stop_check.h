#pragma once
// Looks at a stop token every so much work. Long loops say what they have done, in units of some microseconds at most;
// between two looks lie `interval` units and what one loop says at a time, so that a request is heeded within milliseconds.

#include <cstddef>
#include <functional>
#include <stop_token>

namespace trimloop::mesh {

class StopCheck {
 public:
  static constexpr std::size_t interval = 2000;
  // Told at each look how many units have passed since the one before.
  using OnLook = std::function<void(std::size_t units)>;

  // `on_look`: may be null or empty, else it outlives this.
  explicit StopCheck(std::stop_token stop = {}, const OnLook* on_look = nullptr)
      : stop_(std::move(stop)), on_look_(on_look && *on_look ? on_look : nullptr) {}

  // True when the work is to end.
  bool spend(std::size_t units = 1) {
    spent_ += units;
    return spent_ < interval ? stopped_ : look();
  }
  bool stopped() const { return stopped_; }

 private:
  bool look() {
    if (on_look_) (*on_look_)(spent_);
    spent_ = 0;
    return stopped_ = stopped_ || stop_.stop_requested();
  }

  std::stop_token stop_;
  const OnLook* on_look_;
  std::size_t spent_ = interval;  // the first call looks
  bool stopped_ = false;
};

}  // namespace trimloop::mesh
