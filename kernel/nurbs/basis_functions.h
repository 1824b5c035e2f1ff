#pragma once
// B-spline basis functions as a public question. The knot vector must be one that NurbsCurve accepts.
// The NURBS Book, 2nd ed., chapter 2.

#include <span>
#include <vector>

namespace trimloop {

// The degree + 1 functions that do not vanish on the span of t (find_span), which lies in the domain. A2.2, O(p^2).
std::vector<double> basis_functions(int degree, std::span<const double> knots, double t);
// Row m: their m-th derivatives, m = 0 .. order; zero above the degree. A2.3.
std::vector<std::vector<double>> basis_derivatives(int degree, std::span<const double> knots, double t, int order);

// Function i alone, for any t: zero outside its support, and inside from its own degree + 2 knots only. At the last
// knot the value is the limit from the left. A2.4.
double basis_function(int degree, std::span<const double> knots, std::size_t i, double t);
// Its derivatives 0 .. order, from the right (from the left at the last knot). A2.5.
std::vector<double> basis_function_derivatives(int degree, std::span<const double> knots, std::size_t i, double t,
                                               int order);

}  // namespace trimloop
