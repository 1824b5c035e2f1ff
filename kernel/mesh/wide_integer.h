#pragma once
// Whole numbers wide enough for a product of four doubles of any size: the last resort of the predicates, where a
// shared power of two turns every coordinate into one of these. Fixed storage, sign and magnitude, nothing clever.

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace trimloop::mesh {

class WideInteger {
 public:
  // x * 2^shift; must be whole, which shift = 1074 is enough for.
  static WideInteger from(double x, int shift) {
    WideInteger out;
    int exponent = 0;
    const double fraction = std::frexp(x, &exponent);
    out.negative_ = x < 0;
    const auto bits = static_cast<std::uint64_t>(std::ldexp(std::abs(fraction), 53));
    const int up = exponent - 53 + shift;
    if (up < 0) {
      out.place(bits >> std::min(-up, 63), 0);  // the bits that go are zeros
    } else {
      out.place(bits, up);
    }
    return out;
  }

  int sign() const { return size_ == 0 ? 0 : negative_ ? -1 : 1; }

  friend WideInteger operator-(WideInteger a) {
    a.negative_ = !a.negative_;
    return a;
  }
  friend WideInteger operator-(const WideInteger& a, const WideInteger& b) { return a + -b; }
  friend WideInteger operator+(const WideInteger& a, const WideInteger& b) {
    if (a.negative_ == b.negative_) return add(a, b);
    return smaller(a, b) ? subtract(b, a) : subtract(a, b);
  }
  friend WideInteger operator*(const WideInteger& a, const WideInteger& b) {
    WideInteger out;
    out.negative_ = a.negative_ != b.negative_;
    out.size_ = a.size_ + b.size_;
    for (int i = 0; i < out.size_; ++i) out.limb_[i] = 0;
    for (int i = 0; i < a.size_; ++i) {
      if (a.limb_[i] == 0) continue;  // most are: a double fills two or three
      std::uint64_t carry = 0;
      for (int j = 0; j < b.size_; ++j) {
        carry += std::uint64_t{a.limb_[i]} * b.limb_[j] + out.limb_[i + j];
        out.limb_[i + j] = static_cast<std::uint32_t>(carry);
        carry >>= 32;
      }
      out.limb_[i + b.size_] = static_cast<std::uint32_t>(carry);
    }
    out.trim();
    return out;
  }

 private:
  static constexpr int capacity = 4 * 67 + 2;  // 67 limbs hold any difference of two doubles

  void place(std::uint64_t bits, int up) {
    const int first = up / 32, rest = up % 32;
    for (int i = 0; i < first; ++i) limb_[i] = 0;
    limb_[first] = static_cast<std::uint32_t>(bits << rest);
    limb_[first + 1] = static_cast<std::uint32_t>((bits >> 1) >> (31 - rest));
    limb_[first + 2] = static_cast<std::uint32_t>((bits >> 33) >> (31 - rest));
    size_ = first + 3;
    trim();
  }
  void trim() {
    while (size_ > 0 && limb_[size_ - 1] == 0) --size_;
  }
  std::uint32_t at(int i) const { return i < size_ ? limb_[i] : 0; }

  static bool smaller(const WideInteger& a, const WideInteger& b) {
    if (a.size_ != b.size_) return a.size_ < b.size_;
    for (int i = a.size_ - 1; i >= 0; --i) {
      if (a.limb_[i] != b.limb_[i]) return a.limb_[i] < b.limb_[i];
    }
    return false;
  }
  static WideInteger add(const WideInteger& a, const WideInteger& b) {
    WideInteger out;
    out.negative_ = a.negative_;
    out.size_ = std::max(a.size_, b.size_) + 1;
    std::uint64_t carry = 0;
    for (int i = 0; i < out.size_; ++i) {
      carry += std::uint64_t{a.at(i)} + b.at(i);
      out.limb_[i] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    out.trim();
    return out;
  }
  static WideInteger subtract(const WideInteger& a, const WideInteger& b) {  // |a| >= |b|; the sign is a's
    WideInteger out;
    out.negative_ = a.negative_;
    out.size_ = a.size_;
    std::int64_t borrow = 0;
    for (int i = 0; i < a.size_; ++i) {
      const std::int64_t d = std::int64_t{a.limb_[i]} - b.at(i) + borrow;
      out.limb_[i] = static_cast<std::uint32_t>(d);
      borrow = d < 0 ? -1 : 0;
    }
    out.trim();
    return out;
  }

  bool negative_ = false;
  int size_ = 0;
  std::uint32_t limb_[capacity];
};

}  // namespace trimloop::mesh
