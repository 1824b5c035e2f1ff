#pragma once
// Surface records, in file units.

#include "formats/iges/records/curves.h"

namespace trimloop::iges {

struct PlaneRecord {  // 108: a x + b y + c z = d; form 1 bounded, -1 hole, 0 unbounded
  static constexpr int type = 108;
  double a = 0, b = 0, c = 1, d = 0;
  Ref boundary;
  Xyz symbol;
  double symbol_size = 0;
  static PlaneRecord read(TokenReader&);
  void write(TokenWriter&) const;
};
struct ParametricSplineSurface {  // 114
  static constexpr int type = 114;
  int ctype = 3, ptype = 1;
  std::vector<double> breaks_u, breaks_v;            // M + 1, N + 1
  std::vector<std::array<double, 48>> coefficients;  // (M + 1)(N + 1) patches, placeholders kept; i * (N + 1) + j
  static ParametricSplineSurface read(TokenReader&);
  void write(TokenWriter&) const;
};
struct RuledSurface {  // 118
  static constexpr int type = 118;
  Ref first, second;
  bool reverse_second = false, developable = false;
  static RuledSurface read(TokenReader&);
  void write(TokenWriter&) const;
};
struct SurfaceOfRevolution {  // 120
  static constexpr int type = 120;
  Ref axis, generatrix;
  double start_angle = 0, end_angle = 0;
  static SurfaceOfRevolution read(TokenReader&);
  void write(TokenWriter&) const;
};
struct TabulatedCylinder {  // 122
  static constexpr int type = 122;
  Ref directrix;
  Xyz terminate_point;
  static TabulatedCylinder read(TokenReader&);
  void write(TokenWriter&) const;
};
struct RationalBSplineSurface {  // 128
  static constexpr int type = 128;
  int upper_u = 1, upper_v = 1, degree_u = 1, degree_v = 1;
  bool closed_u = false, closed_v = false, polynomial = false, periodic_u = false, periodic_v = false;
  std::vector<double> knots_u, knots_v, weights;  // u index fastest in weights and points
  std::vector<Xyz> points;
  double u0 = 0, u1 = 1, v0 = 0, v1 = 1;
  static RationalBSplineSurface read(TokenReader&);
  void write(TokenWriter&) const;
};
struct OffsetCurve {  // 130
  static constexpr int type = 130;
  Ref basis;
  int flag = 1;
  Ref function;
  int coordinate = 0, taper_type = 0;
  double d1 = 0, td1 = 0, d2 = 0, td2 = 0;
  Xyz normal;
  double tt1 = 0, tt2 = 0;
  static OffsetCurve read(TokenReader&);
  void write(TokenWriter&) const;
};
struct OffsetSurface {  // 140
  static constexpr int type = 140;
  Xyz indicator;
  double distance = 0;
  Ref basis;
  static OffsetSurface read(TokenReader&);
  void write(TokenWriter&) const;
};
struct PlaneSurface {  // 190
  static constexpr int type = 190;
  Ref location, normal, reference;  // reference: form 1 only
  bool reference_given = false;     // the field is there, as in form 1; null all the same perhaps
  static PlaneSurface read(TokenReader&);
  void write(TokenWriter&) const;
};
struct CylindricalSurface {  // 192
  static constexpr int type = 192;
  Ref location, axis;
  double radius = 1;
  Ref reference;
  bool reference_given = false;  // as in PlaneSurface
  static CylindricalSurface read(TokenReader&);
  void write(TokenWriter&) const;
};
struct ConicalSurface {  // 194
  static constexpr int type = 194;
  Ref location, axis;
  double radius = 0, half_angle_deg = 45;
  Ref reference;
  bool reference_given = false;  // as in PlaneSurface
  static ConicalSurface read(TokenReader&);
  void write(TokenWriter&) const;
};
struct SphericalSurface {  // 196
  static constexpr int type = 196;
  Ref centre;
  double radius = 1;
  Ref axis, reference;           // form 1 only
  bool reference_given = false;  // as in PlaneSurface, of both
  static SphericalSurface read(TokenReader&);
  void write(TokenWriter&) const;
};
struct ToroidalSurface {  // 198
  static constexpr int type = 198;
  Ref centre, axis;
  double major_radius = 2, minor_radius = 1;
  Ref reference;
  bool reference_given = false;  // as in PlaneSurface
  static ToroidalSurface read(TokenReader&);
  void write(TokenWriter&) const;
};

}  // namespace trimloop::iges
