#pragma once
// Texts that people write by hand or export from other fields, as models: shape descriptions (JSON), drawings (SVG),
// point tables (CSV), control meshes (OBJ), glyphs of a font. Findings carry the JSON path, the line or the offset.

#include "base/limits.h"
#include "base/report.h"
#include "kernel/model/model.h"

namespace trimloop::io::description {

// docs/nurbs-schema.json describes the language. Any wrong member is fatal: the model is empty then.
Model read_json(std::string_view text, const Execution&, Report&);
// One curve a subpath, in mm, y upwards (the drawing's y runs down).
Model read_svg(std::string_view text, const Execution&, Report&);
// Each block of rows is a polyline; one of a single row is a point.
Model read_csv(std::string_view text, const Execution&, Report&);
// The limit surface of Catmull-Clark, caps within `tolerance_mm`; line elements are creases.
Model read_obj(std::string_view text, double tolerance_mm, const Execution&, Report&);
// `text` set in the font, em square of `em_mm`.
Model read_font(std::string_view bytes, std::string_view text, double em_mm, Report&);

}  // namespace trimloop::io::description
