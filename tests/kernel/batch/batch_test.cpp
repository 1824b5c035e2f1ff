// Batch evaluation: against the definition in long double, against the single-point evaluators, and against itself:
// every build, every order of the points and every function gives the same bits.
#include "kernel/batch/batch.h"

#include <boost/test/unit_test.hpp>

#include "tests/kernel/nurbs/random_nurbs.h"

using namespace trimloop;
using testing::Random;

namespace {

struct Output {
  std::vector<double> numbers;
  std::size_t n;
  explicit Output(std::size_t points) : numbers(18 * points, -7.0), n(points) {}
  SurfaceColumns columns(int order) {
    SurfaceColumns c;
    std::size_t at = 0;
    for (auto* group : {&c.point, &c.du, &c.dv, &c.duu, &c.duv, &c.dvv})
      for (double*& column : *group)
        if (at++ < (order == 0 ? 3u : order == 1 ? 9u : 18u)) column = numbers.data() + (at - 1) * n;
    return c;
  }
  Vector at(std::size_t group, std::size_t k) const {
    return {numbers[3 * group * n + k], numbers[(3 * group + 1) * n + k], numbers[(3 * group + 2) * n + k]};
  }
};

bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}
bool same(Vector a, Vector b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

struct Points {
  std::vector<double> u, v;
};
Points random_points(Random& random, const NurbsSurface& s, std::size_t n) {
  Points p;
  for (std::size_t i = 0; i < n; ++i) p.u.push_back(random.in(s.range_u())), p.v.push_back(random.in(s.range_v()));
  // Knots and the ends themselves.
  const std::vector<double> at_u = breaks_u(s), at_v = breaks_v(s);
  for (std::size_t i = 0; i < n; i += 7) p.u[i] = at_u[i % at_u.size()], p.v[i / 2] = at_v[i % at_v.size()];
  return p;
}

std::vector<BatchOptions> all_options(Arithmetic arithmetic) {
  std::vector<BatchOptions> out;
  for (InstructionSet set : {InstructionSet::Baseline, InstructionSet::Avx2, InstructionSet::Avx512})
    if (set <= best_instruction_set()) out.push_back({arithmetic, set});
  return out;
}

// |error| of the position in units of eps (max |w P| + |S| max |w|) / |w|, maxima over the poles that act there.
double error_in_units(const NurbsSurface& s, Uv at, Vector value) {
  const auto nu = testing::all_basis_functions(s.knots_u(), s.degree_u(), at.u);
  const auto nv = testing::all_basis_functions(s.knots_v(), s.degree_v(), at.v);
  testing::LongPoint sum;
  double largest = 0, weight = 0;
  for (std::size_t i = 0; i < nu.size(); ++i)
    for (std::size_t j = 0; j < nv.size(); ++j) {
      if (nu[i] == 0 || nv[j] == 0) continue;
      const Hpoint& h = s.pole(i, j);
      sum.add(nu[i] * nv[j], h);
      largest = std::max({largest, std::abs(h.x), std::abs(h.y), std::abs(h.z)});
      weight = std::max(weight, std::abs(h.w));
    }
  const long double x = sum.x / sum.w, y = sum.y / sum.w, z = sum.z / sum.w;
  const long double error = std::max({std::abs(value.x - x), std::abs(value.y - y), std::abs(value.z - z)});
  const double size = static_cast<double>(std::max({std::abs(x), std::abs(y), std::abs(z)}));
  const double unit = std::numeric_limits<double>::epsilon() * (largest + size * weight);
  return static_cast<double>(error * std::abs(sum.w)) / unit;
}

}  // namespace

BOOST_AUTO_TEST_CASE(positions_are_within_their_bound_of_the_definition) {
  Random random(21);
  std::vector<double> worst(14, 0.0);
  for (int round = 0; round < 120; ++round) {
    const int p = random.integer(1, round % 4 == 0 ? 13 : 5), q = random.integer(1, round % 8 == 0 ? 11 : 5);
    const NurbsSurface s = random.surface(p, q, round % 3 != 0, round % 5 != 0);
    const SurfacePieces pieces(s);
    const Points at = random_points(random, s, p + q > 12 ? 20 : 100);
    for (Arithmetic arithmetic : {Arithmetic::SameBits, Arithmetic::Fast}) {
      Output out(at.u.size());
      evaluate(pieces, at.u, at.v, out.columns(0), {arithmetic});
      for (std::size_t k = 0; k < at.u.size(); ++k) {
        const double units = error_in_units(s, {at.u[k], at.v[k]}, out.at(0, k));
        double& of_degree = worst[static_cast<std::size_t>(std::max(p, q))];
        of_degree = std::max(of_degree, units);
      }
    }
  }
  for (std::size_t degree = 1; degree < worst.size(); ++degree) {
    BOOST_TEST_MESSAGE("degree " << degree << ": " << worst[degree] << " units");
    BOOST_CHECK_LE(worst[degree], degree <= 5 ? 4.0 : 2.0 * (static_cast<double>(degree) + 1));
  }
}

BOOST_AUTO_TEST_CASE(very_uneven_knots_cost_no_digits) {
  Random random(5);
  for (int round = 0; round < 50; ++round) {
    const int p = random.integer(2, 5);
    std::vector<double> knots(static_cast<std::size_t>(p) + 1, 0.0);
    for (double t : {1e-9, 2e-9, 0.25, 0.25 + 1e-12, 0.5, 1 - 1e-12}) knots.push_back(t);
    knots.insert(knots.end(), static_cast<std::size_t>(p) + 1, 1.0);
    const std::size_t n = knots.size() - static_cast<std::size_t>(p) - 1;
    const NurbsSurface s =
        NurbsSurface::from_homogeneous(p, 1, knots, {0, 0, 1, 1}, random.poles(2 * n, round % 2 == 0)).value();
    const SurfacePieces pieces(s);
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
      const Uv at{random.in({knots[i], knots[i + 1]}), random.real(0, 1)};
      BOOST_CHECK_LE(error_in_units(s, at, to_vector(evaluate(pieces, at))), 4);
    }
  }
}

BOOST_AUTO_TEST_CASE(derivatives_agree_with_those_of_the_book) {
  Random random(22);
  for (int round = 0; round < 150; ++round) {
    const NurbsSurface s = random.surface(random.integer(1, 9), random.integer(1, 9), round % 3 != 0, round % 5 != 0);
    const SurfacePieces pieces(s);
    for (int k = 0; k < 20; ++k) {
      const Uv at{random.in(s.range_u()), random.in(s.range_v())};
      const SurfaceJet a = jet(pieces, at), b = jet(s, at);
      const auto close = [&](Vector x, Vector y, double unit) {
        return norm(x - y) <= 1e-10 * (unit + norm(x) + norm(y));
      };
      const Interval u = pieces.spans_u()[pieces.spans_u().locate(at.u)],
                     v = pieces.spans_v()[pieces.spans_v().locate(at.v)];
      const double hu = 100 * s.degree_u() / u.length(), hv = 100 * s.degree_v() / v.length();
      BOOST_CHECK(close(a.point - Point{}, b.point - Point{}, 1));
      BOOST_CHECK(close(a.du, b.du, hu) && close(a.dv, b.dv, hv));
      BOOST_CHECK(close(a.duu, b.duu, hu * hu) && close(a.duv, b.duv, hu * hv) && close(a.dvv, b.dvv, hv * hv));
    }
  }
}

BOOST_AUTO_TEST_CASE(bits_do_not_depend_on_processor_order_count_or_function) {
  Random random(23);
  for (int round = 0; round < 60; ++round) {
    const int p = random.integer(1, 7), q = random.integer(1, 7);
    const NurbsSurface s = random.surface(p, q, round % 3 != 0);
    const SurfacePieces pieces(s);
    const Points at = random_points(random, s, 500);
    const std::size_t n = at.u.size();
    for (int order = 0; order <= 2; ++order) {
      Output first(n);
      evaluate(pieces, at.u, at.v, first.columns(order), {Arithmetic::SameBits, InstructionSet::Baseline});
      for (Arithmetic arithmetic : {Arithmetic::SameBits, Arithmetic::Fast})
        for (const BatchOptions& options : all_options(arithmetic)) {
          Output scattered(n);
          evaluate(pieces, at.u, at.v, scattered.columns(order), options);
          if (arithmetic == Arithmetic::SameBits) BOOST_CHECK(same(scattered.numbers, first.numbers));
          // A few at a time, and as 1 x 1 grids.
          Output few(n), grid(n);
          for (std::size_t k = 0, step = 1; k < n; k += step, step = step % 17 + 1) {
            step = std::min(step, n - k);
            SurfaceColumns to = few.columns(order), cell = grid.columns(order);
            for (auto* c : {&to, &cell})
              for (auto* group : {&c->point, &c->du, &c->dv, &c->duu, &c->duv, &c->dvv})
                for (double*& column : *group) column = column ? column + k : nullptr;
            evaluate(pieces, std::span(at.u).subspan(k, step), std::span(at.v).subspan(k, step), to, options);
            for (std::size_t i = 0; i < step; ++i) {
              evaluate_grid(pieces, {&at.u[k + i], 1}, {&at.v[k + i], 1}, cell, options);
              for (auto* group : {&cell.point, &cell.du, &cell.dv, &cell.duu, &cell.duv, &cell.dvv})
                for (double*& column : *group) column = column ? column + 1 : nullptr;
            }
          }
          BOOST_CHECK(same(few.numbers, scattered.numbers));
          BOOST_CHECK(same(grid.numbers, scattered.numbers));
        }
      for (std::size_t k = 0; k < n; k += 5) {
        const SurfaceJet j = jet(pieces, {at.u[k], at.v[k]});
        BOOST_CHECK(same(to_vector(evaluate(pieces, {at.u[k], at.v[k]})), first.at(0, k)));
        if (order == 2)
          BOOST_CHECK(same(j.du, first.at(1, k)) && same(j.duv, first.at(4, k)) && same(j.dvv, first.at(5, k)));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(grids_are_all_pairs_and_tiles_of_them_the_same) {
  Random random(24);
  for (int round = 0; round < 30; ++round) {
    const NurbsSurface s = random.surface(random.integer(1, 6), random.integer(1, 6), round % 2 == 0);
    const SurfacePieces pieces(s);
    std::vector<double> u, v;
    for (int i = 0; i <= 40; ++i) u.push_back(s.range_u().at(i / 40.0));
    for (int i = 0; i <= 11; ++i) v.push_back(s.range_v().at(i / 11.0));
    Output all(u.size() * v.size()), row(u.size());
    evaluate_grid(pieces, u, v, all.columns(1));
    const SurfaceGrid grid(pieces, u, v);
    for (std::size_t j = 0; j < v.size(); ++j) {
      grid.rows(j, 1, row.columns(1));
      for (std::size_t i = 0; i < u.size(); ++i) {
        Point p;
        Vector du, dv;
        jet1(pieces, {u[i], v[j]}, p, du, dv);
        const std::size_t k = j * u.size() + i;
        BOOST_CHECK(same(to_vector(p), all.at(0, k)) && same(du, all.at(1, k)) && same(dv, all.at(2, k)));
        BOOST_CHECK(same(row.at(0, i), all.at(0, k)) && same(row.at(2, i), all.at(2, k)));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(curves_agree_with_the_single_point_evaluator) {
  Random random(25);
  for (int round = 0; round < 100; ++round) {
    const NurbsCurve c = random.curve(random.integer(1, 9), round % 3 != 0, round % 4 != 0);
    const CurvePieces pieces(c);
    std::vector<double> t(333), x(9 * t.size()), y(x.size());
    for (double& at : t) at = random.in(c.range());
    for (std::size_t i = 0; i < t.size(); i += 11) t[i] = breaks(c)[i % breaks(c).size()];
    const auto columns = [&](std::vector<double>& to) {
      CurveColumns out;
      std::size_t at = 0;
      for (auto* group : {&out.point, &out.d1, &out.d2})
        for (double*& column : *group) column = to.data() + at++ * t.size();
      return out;
    };
    evaluate(pieces, t, columns(x), {Arithmetic::SameBits, InstructionSet::Baseline});
    for (const BatchOptions& options : all_options(Arithmetic::SameBits)) {
      evaluate(pieces, t, columns(y), options);
      BOOST_CHECK(same(x, y));
    }
    for (std::size_t k = 0; k < t.size(); ++k) {
      const CurveJet a = jet(pieces, t[k]), b = jet(c, t[k]);
      const double h = 100 * c.degree() / pieces.spans()[pieces.spans().locate(t[k])].length();
      BOOST_CHECK_LE(distance(a.point, b.point), 1e-12 * 20);
      BOOST_CHECK_LE(norm(a.d1 - b.d1), 1e-11 * (h + norm(b.d1)));
      BOOST_CHECK_LE(norm(a.d2 - b.d2), 1e-10 * (h * h + norm(b.d2)));
      BOOST_CHECK(a.point.x == x[k] && a.d2.z == x[8 * t.size() + k]);
    }
  }
}

BOOST_AUTO_TEST_CASE(parameters_outside_are_clamped_and_nan_gives_nan) {
  Random random(26);
  const NurbsSurface s = random.surface(3, 4, true);
  const SurfacePieces pieces(s);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Interval du = s.domain_u(), dv = s.domain_v();
  std::vector<double> u{du.lo - 5, du.hi + 1, infinity, -infinity, nan, du.mid()},
      v{dv.mid(), dv.hi + 7, -infinity, dv.mid(), dv.mid(), nan};
  for (int i = 0; i < 100; ++i)
    u.push_back(u[static_cast<std::size_t>(i % 6)]), v.push_back(v[static_cast<std::size_t>(i % 6)]);
  for (const BatchOptions& options : all_options(Arithmetic::Fast)) {
    Output out(u.size());
    evaluate(pieces, u, v, out.columns(1), options);
    for (std::size_t k = 0; k < u.size(); ++k) {
      const bool bad = std::isnan(u[k]) || std::isnan(v[k]);
      BOOST_CHECK_EQUAL(std::isnan(out.at(0, k).x), bad);
      const Uv in{du.clamp(u[k]), dv.clamp(v[k])};
      if (!bad) BOOST_CHECK_SMALL(norm(out.at(0, k) - to_vector(evaluate(s, in))), 1e-12);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_part_of_the_domain_is_cut_at_its_ends) {
  Random random(27);
  const NurbsSurface whole = random.surface(3, 3, true);
  const Interval u{whole.domain_u().at(0.21), whole.domain_u().at(0.83)},
      v{whole.domain_v().at(0.4), whole.domain_v().hi};
  const SurfacePieces pieces(whole.with_range(u, v));
  BOOST_CHECK(pieces.spans_u().lo() == u.lo && pieces.spans_u().hi() == u.hi && pieces.spans_v().hi() == v.hi);
  for (int k = 0; k < 100; ++k) {
    const Uv at{random.in(u), random.in(v)};
    BOOST_CHECK_SMALL(distance(evaluate(pieces, at), evaluate(whole, at)), 1e-12);
  }
}
