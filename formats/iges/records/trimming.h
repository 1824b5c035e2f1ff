#pragma once
// Trimming and boundary-representation records.

#include "formats/iges/records/curves.h"

namespace trimloop::iges {

struct Boundary {  // 141
  static constexpr int type = 141;
  struct Item {
    Ref curve;
    int sense = 1;  // 1 as is, 2 reversed
    std::vector<Ref> pcurves;
  };
  int boundary_type = 0;  // 0 model curves only, 1 both
  int preference = 0;     // 0 unspecified, 1 model, 2 parameter, 3 equal
  Ref surface;
  std::vector<Item> items;
  static Boundary read(TokenReader&);
  void write(TokenWriter&) const;
};
struct CurveOnSurface {  // 142
  static constexpr int type = 142;
  int creation = 0;  // 0 unspecified, 1 projection, 2 intersection, 3 isoparametric
  Ref surface, pcurve, curve;
  int preference = 0;  // 0 unspecified, 1 S o B, 2 C, 3 equal
  static CurveOnSurface read(TokenReader&);
  void write(TokenWriter&) const;
};
struct BoundedSurface {  // 143
  static constexpr int type = 143;
  int representation = 0;
  Ref surface;
  std::vector<Ref> boundaries;
  static BoundedSurface read(TokenReader&);
  void write(TokenWriter&) const;
};
struct TrimmedSurface {  // 144
  static constexpr int type = 144;
  Ref surface;
  bool outer_given = false;  // N1
  Ref outer;
  std::vector<Ref> inner;
  static TrimmedSurface read(TokenReader&);
  void write(TokenWriter&) const;
};
struct ManifoldSolid {  // 186
  static constexpr int type = 186;
  struct Void {
    Ref shell;
    bool agrees = true;
  };
  Ref shell;
  bool agrees = true;
  std::vector<Void> voids;
  static ManifoldSolid read(TokenReader&);
  void write(TokenWriter&) const;
};
struct VertexList {  // 502
  static constexpr int type = 502;
  std::vector<Xyz> points;
  static VertexList read(TokenReader&);
  void write(TokenWriter&) const;
};
struct EdgeList {  // 504
  static constexpr int type = 504;
  struct Item {
    Ref curve, start_list;
    std::int64_t start_index = 0;
    Ref end_list;
    std::int64_t end_index = 0;
  };
  std::vector<Item> edges;
  static EdgeList read(TokenReader&);
  void write(TokenWriter&) const;
};
struct LoopRecord {  // 508
  static constexpr int type = 508;
  struct Pcurve {
    bool isoparametric = false;
    Ref curve;
  };
  struct Item {
    bool is_vertex = false;
    Ref list;
    std::int64_t index = 0;
    bool agrees = true;
    std::vector<Pcurve> pcurves;
  };
  std::vector<Item> items;
  static LoopRecord read(TokenReader&);
  void write(TokenWriter&) const;
};
struct FaceRecord {  // 510
  static constexpr int type = 510;
  Ref surface;
  bool outer_first = true;
  std::vector<Ref> loops;
  static FaceRecord read(TokenReader&);
  void write(TokenWriter&) const;
};
struct ShellRecord {  // 514: form 1 closed, 2 open
  static constexpr int type = 514;
  struct Item {
    Ref face;
    bool agrees = true;
  };
  std::vector<Item> faces;
  static ShellRecord read(TokenReader&);
  void write(TokenWriter&) const;
};

}  // namespace trimloop::iges
