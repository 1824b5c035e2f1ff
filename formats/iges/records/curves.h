#pragma once
// Curve and point records, in file units, exactly as the file states them. `read` beside `write` on purpose.

#include <array>
#include <vector>

#include "formats/iges/records/record.h"

namespace trimloop::iges {

struct CircularArc {  // 100: counter-clockwise in the plane z = zt; start == end is the full circle
  static constexpr int type = 100;
  double zt = 0, xc = 0, yc = 0, xs = 0, ys = 0, xe = 0, ye = 0;
  static CircularArc read(TokenReader&);
  void write(TokenWriter&) const;
};
struct CompositeCurve {  // 102
  static constexpr int type = 102;
  std::vector<Ref> members;
  static CompositeCurve read(TokenReader&);
  void write(TokenWriter&) const;
};
struct ConicArc {  // 104: A x^2 + B xy + C y^2 + D x + E y + F = 0 at z = zt
  static constexpr int type = 104;
  double a = 0, b = 0, c = 0, d = 0, e = 0, f = 0, zt = 0, xs = 0, ys = 0, xe = 0, ye = 0;
  static ConicArc read(TokenReader&);
  void write(TokenWriter&) const;
};
struct CopiousData {  // 106, every form
  static constexpr int type = 106;
  int interpretation = 2;      // 1: pairs with common z, 2: triples, 3: sextuples
  double common_z = 0;         // of interpretation 1
  std::vector<double> values;  // 2, 3 or 6 a point
  std::size_t stride() const { return interpretation == 1 ? 2 : interpretation == 2 ? 3 : 6; }
  static CopiousData read(TokenReader&);
  void write(TokenWriter&) const;
};
struct Line {  // 110: form 0 segment, 1 ray, 2 unbounded
  static constexpr int type = 110;
  Xyz start, end;
  static Line read(TokenReader&);
  void write(TokenWriter&) const;
};
struct ParametricSplineCurve {  // 112
  static constexpr int type = 112;
  int ctype = 3, continuity = 0, dimension = 3;
  std::vector<double> breaks;                        // segments + 1
  std::vector<std::array<double, 12>> coefficients;  // AX BX CX DX AY .. DZ, one per segment
  std::array<double, 12> terminal{};                 // TPX0..3 TPY0..3 TPZ0..3 as stored
  static ParametricSplineCurve read(TokenReader&);
  void write(TokenWriter&) const;
};
struct PointRecord {  // 116
  static constexpr int type = 116;
  Xyz point;
  Ref symbol;
  static PointRecord read(TokenReader&);
  void write(TokenWriter&) const;
};
struct Direction {  // 123
  static constexpr int type = 123;
  Xyz vector;
  static Direction read(TokenReader&);
  void write(TokenWriter&) const;
};
struct TransformationMatrix {  // 124: rows R11 R12 R13 T1 ...
  static constexpr int type = 124;
  std::array<double, 12> m{};
  static TransformationMatrix read(TokenReader&);
  void write(TokenWriter&) const;
};
struct RationalBSplineCurve {  // 126
  static constexpr int type = 126;
  int upper_index = 1, degree = 1;  // K, M
  bool planar = false, closed = false, polynomial = false, periodic = false;
  std::vector<double> knots, weights;  // K + M + 2, K + 1
  std::vector<Xyz> points;             // K + 1
  double v0 = 0, v1 = 1;
  Xyz normal;
  static RationalBSplineCurve read(TokenReader&);
  void write(TokenWriter&) const;
};

}  // namespace trimloop::iges
