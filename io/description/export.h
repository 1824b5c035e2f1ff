#pragma once
// Models as texts of their Bézier pieces: a description (JSON) that reads back to the same pieces, or a drawing (SVG).

#include "io/io.h"

namespace trimloop::io::description {

struct Exported {
  std::string bytes;
  std::vector<std::string> losses;
  NurbsStatement nurbs;
};

// Every free curve and every face's surface (over its own rectangle: trimming loops are listed as losses) in its Bézier
// pieces, homogeneous weights included; numbers in shortest form, so that reading gives the same bits. In mm.
Result<Exported> write_json(const Model&, const SourceInfo&, const WriteOptions&);

// Free curves as paths, one user unit a millimetre, seen along z; y runs down. Exact for polynomial pieces up to degree 3
// and for arcs, other pieces within 1e-3 mm (stated).
Result<Exported> write_svg(const Model&, const SourceInfo&, const WriteOptions&);

}  // namespace trimloop::io::description
