#include "kernel/math/gauss.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trimloop {
namespace {

struct Legendre {
  double value, derivative;
};
Legendre legendre(int n, double x) {
  double before = 1, here = x;
  for (int k = 2; k <= n; ++k) {
    const double next = ((2 * k - 1) * x * here - (k - 1) * before) / k;
    before = here;
    here = next;
  }
  return {here, n * (x * here - before) / (x * x - 1)};
}

constexpr std::size_t first_of(int n) { return static_cast<std::size_t>(n * (n - 1) / 2); }
using Table = std::array<GaussNode, first_of(largest_gauss_rule + 1)>;

// Roots of the Legendre polynomials by Newton's method from the classical cosine guess.
Table make_table() {
  Table table{};
  table[0] = {0, 2};
  for (int n = 2; n <= largest_gauss_rule; ++n)
    for (int i = 0; i < n; ++i) {
      double x = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
      for (int k = 0; k < 8; ++k) {
        const Legendre p = legendre(n, x);
        x -= p.value / p.derivative;
      }
      const double d = legendre(n, x).derivative;
      table[first_of(n) + static_cast<std::size_t>(i)] = {x, 2 / ((1 - x * x) * d * d)};
    }
  return table;
}

}  // namespace

std::span<const GaussNode> gauss_rule(int n) {
  static const Table table = make_table();
  n = std::clamp(n, 1, largest_gauss_rule);
  return {table.data() + first_of(n), static_cast<std::size_t>(n)};
}

std::span<const KronrodNode> kronrod_7() {
  static constexpr std::array<KronrodNode, 7> rule{{
      {-0.960491268708020283423507092629080, 0.104656226026467265193823857192073, 0},
      {-0.774596669241483377035853079956480, 0.268488089868333440728569280666710, 5.0 / 9},
      {-0.434243749346802558002071502844628, 0.401397414775962222905051818618432, 0},
      {0, 0.450916538658474142345110087045571, 8.0 / 9},
      {0.434243749346802558002071502844628, 0.401397414775962222905051818618432, 0},
      {0.774596669241483377035853079956480, 0.268488089868333440728569280666710, 5.0 / 9},
      {0.960491268708020283423507092629080, 0.104656226026467265193823857192073, 0},
  }};
  return rule;
}

std::span<const KronrodNode> kronrod_15() {
  // Nodes and weights as tabulated for QUADPACK's 15-point rule (Piessens et al., 1983).
  static constexpr std::array<KronrodNode, 15> rule{{
      {-0.991455371120812639206854697526329, 0.022935322010529224963732008058970, 0},
      {-0.949107912342758524526189684047851, 0.063092092629978553290700663189204, 0.129484966168869693270611432679082},
      {-0.864864423359769072789712788640926, 0.104790010322250183839876322541518, 0},
      {-0.741531185599394439863864773280788, 0.140653259715525918745189590510238, 0.279705391489276667901467771423780},
      {-0.586087235467691130294144691693013, 0.169004726639267902826583426598550, 0},
      {-0.405845151377397166906606412076961, 0.190350578064785409913256402421014, 0.381830050505118944950369775488975},
      {-0.207784955007898467600689403773245, 0.204432940075298892414161999234649, 0},
      {0, 0.209482141084727828012999174891714, 0.417959183673469387755102040816327},
      {0.207784955007898467600689403773245, 0.204432940075298892414161999234649, 0},
      {0.405845151377397166906606412076961, 0.190350578064785409913256402421014, 0.381830050505118944950369775488975},
      {0.586087235467691130294144691693013, 0.169004726639267902826583426598550, 0},
      {0.741531185599394439863864773280788, 0.140653259715525918745189590510238, 0.279705391489276667901467771423780},
      {0.864864423359769072789712788640926, 0.104790010322250183839876322541518, 0},
      {0.949107912342758524526189684047851, 0.063092092629978553290700663189204, 0.129484966168869693270611432679082},
      {0.991455371120812639206854697526329, 0.022935322010529224963732008058970, 0},
  }};
  return rule;
}

}  // namespace trimloop
