#pragma once
// Exact sums of doubles (Shewchuk 1997, chapter 2): an expansion is a list of non-overlapping doubles, smallest first,
// whose exact sum is the value; zeros are left out. Exact as long as nothing over- or underflows, which the caller sees
// to. For sources compiled with -ffp-contract=off only.

#include <cmath>
#include <utility>

namespace trimloop::mesh {

struct Two {  // hi + lo is the exact result, hi the rounded one
  double hi, lo;
};

inline Two fast_two_sum(double a, double b) {  // theorem 6; |a| >= |b| or a == 0
  const double x = a + b;
  return {x, b - (x - a)};
}
inline Two two_sum(double a, double b) {  // theorem 7
  const double x = a + b;
  const double b_part = x - a;
  const double a_part = x - b_part;
  return {x, (a - a_part) + (b - b_part)};
}
inline Two two_diff(double a, double b) { return two_sum(a, -b); }

inline Two split(double a) {  // theorem 17: 26 bits each
  const double c = 134217729.0 * a;
  const double hi = c - (c - a);
  return {hi, a - hi};
}
inline Two two_product(double a, double b) {  // theorem 18
  const double x = a * b;
  const Two p = split(a), q = split(b);
  const double rest = ((x - p.hi * q.hi) - p.lo * q.hi) - p.hi * q.lo;
  return {x, p.lo * q.lo - rest};
}

// Arithmetic on pairs: two words of precision, rounded.
inline Two operator+(Two a, Two b) {
  const Two s = two_sum(a.hi, b.hi);
  return fast_two_sum(s.hi, s.lo + (a.lo + b.lo));
}
inline Two operator-(Two a, Two b) { return a + Two{-b.hi, -b.lo}; }
inline Two operator*(Two a, Two b) {
  const Two p = two_product(a.hi, b.hi);
  return fast_two_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

// At most N terms; which operation yields how many is in the types.
template <int N>
struct Expansion {
  double term[N];
  int size = 0;

  // The largest term has the sign of the value.
  double sign() const { return size == 0 ? 0 : term[size - 1]; }
  double estimate() const {
    double sum = 0;
    for (int i = 0; i < size; ++i) sum += term[i];
    return sum;
  }
};

inline Expansion<1> expand(double x) { return {{x}, x != 0}; }
inline Expansion<2> expand(Two x) {
  if (x.lo == 0) return {{x.hi, 0}, x.hi != 0};
  return {{x.lo, x.hi}, 2};
}

namespace expansion_detail {

// Figure 13 of the paper: merge by magnitude, then carry upwards. `out` may not overlap the inputs. Returns its size.
inline int sum(const double* e, int ne, const double* f, int nf, double f_sign, double* out) {
  int i = 0, j = 0, n = 0;
  const auto next = [&] {
    if (j == nf || (i < ne && std::abs(e[i]) < std::abs(f[j]))) return e[i++];
    return f_sign * f[j++];
  };
  if (ne + nf == 0) return 0;
  double carry = next();
  for (int k = 1; k < ne + nf; ++k) {
    const Two s = two_sum(carry, next());
    if (s.lo != 0) out[n++] = s.lo;
    carry = s.hi;
  }
  if (carry != 0) out[n++] = carry;
  return n;
}

// Theorem 19: e times b.
inline int scale(const double* e, int ne, double b, double* out) {
  if (ne == 0 || b == 0) return 0;
  int n = 0;
  Two q = two_product(e[0], b);
  if (q.lo != 0) out[n++] = q.lo;
  double carry = q.hi;
  for (int i = 1; i < ne; ++i) {
    q = two_product(e[i], b);
    const Two s = two_sum(carry, q.lo);
    if (s.lo != 0) out[n++] = s.lo;
    const Two t = fast_two_sum(q.hi, s.hi);
    if (t.lo != 0) out[n++] = t.lo;
    carry = t.hi;
  }
  if (carry != 0) out[n++] = carry;
  return n;
}

}  // namespace expansion_detail

template <int N, int M>
Expansion<N + M> operator+(const Expansion<N>& e, const Expansion<M>& f) {
  Expansion<N + M> out;
  out.size = expansion_detail::sum(e.term, e.size, f.term, f.size, 1, out.term);
  return out;
}
template <int N, int M>
Expansion<N + M> operator-(const Expansion<N>& e, const Expansion<M>& f) {
  Expansion<N + M> out;
  out.size = expansion_detail::sum(e.term, e.size, f.term, f.size, -1, out.term);
  return out;
}
template <int N, int M>
Expansion<2 * N * M> operator*(const Expansion<N>& e, const Expansion<M>& f) {
  Expansion<2 * N * M> even, odd;
  auto *from = &even, *to = &odd;
  double part[2 * N];
  for (int j = 0; j < f.size; ++j) {
    const int n = expansion_detail::scale(e.term, e.size, f.term[j], part);
    to->size = expansion_detail::sum(from->term, from->size, part, n, 1, to->term);
    std::swap(from, to);
  }
  return *from;
}

}  // namespace trimloop::mesh
