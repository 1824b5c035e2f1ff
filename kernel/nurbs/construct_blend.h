#pragma once
// Surfaces through curves: skinned, Gordon, Coons, swept. The NURBS Book, 2nd ed., chapter 10.

#include <span>

#include "kernel/nurbs/fit.h"

namespace trimloop {

// Through section curves (along u) in order, v in [0, 1]; section 10.3. Sections are made compatible; homogeneous poles
// are interpolated, so each section is an isocurve exactly, in its own weights. Unsupported when interpolating weights
// gives one that is not positive. Degree at most the number of sections less one.
struct Skin {
  NurbsSurface surface;
  std::vector<double> v;  // parameter of each section
  double error = 0;       // bound on the distance of a section from its isocurve
};
Result<Skin> skinned(std::span<const NurbsCurve> sections, int degree_v = 3, std::span<const double> parameters = {});

// Through two families that meet (section 10.5): curves[k] along u at v[k], curves[l] along v at u[l]. S = skin of the
// one + skin of the other - interpolant of the crossings. Polynomial curves only. Degenerate when they miss one another
// by more than `tolerance`.
struct Gordon {
  NurbsSurface surface;
  double largest_miss = 0;  // between curves at their crossings; half of it shows in the curves
};
Result<Gordon> gordon(std::span<const NurbsCurve> along_u, std::span<const double> v,
                      std::span<const NurbsCurve> along_v, std::span<const double> u, double tolerance);

// Bilinearly blended patch of four sides (section 10.6): S(u, 0), S(u, 1), S(0, v), S(1, v). The Boolean sum of
// homogeneous points, 1 + 1 - 1; rational sides are brought to end weights of one first, which keeps their points but
// not their parameters. Corners that miss by up to `tolerance` are taken as their mean.
struct Coons {
  NurbsSurface surface;
  double largest_miss = 0;
};
Result<Coons> coons(const NurbsCurve& bottom, const NurbsCurve& top, const NurbsCurve& left, const NurbsCurve& right,
                    double tolerance);

enum class Frames : std::uint8_t {
  Parallel,  // the section keeps its directions in space: translational, exact
  Following  // it keeps its angle to the path: exact on lines and circular arcs, else through sections
};
struct Sweep {
  NurbsSurface surface;  // u along the section, v along the path
  double deviation = 0;  // 0: exact; else the largest distance found between the sections where it was checked
  bool exact = true;
};
// The section moved along the path from where it stands at the path's start (section 10.4). Frames that follow are
// rotation-minimizing (W. Wang, B. Juettler, D. Zheng and Y. Liu, "Computation of rotation minimizing frames", ACM
// Transactions on Graphics 27, 2008). NoConvergence when `most_sections` do not bring the deviation within the
// tolerance.
Result<Sweep> swept(const NurbsCurve& section, const NurbsCurve& path, Frames, double tolerance = 1e-6,
                    int most_sections = 513);

}  // namespace trimloop
