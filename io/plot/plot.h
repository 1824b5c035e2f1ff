#pragma once
// Pictures of what is in a model, as SVG: what a teacher would put on a slide, and what an engineer needs to see of a
// face that went wrong.

#include <optional>

#include "io/io.h"
#include "kernel/subdivision/schemes.h"

namespace trimloop::io::plot {

enum class What : std::uint8_t {
  Curve,      // free curves with control polygons and knots
  Hodograph,  // derivative curve and its polygon, speed
  Comb,       // curvature comb
  Basis,      // basis functions over the parameter
  Blossom,    // de Boor's scheme at one parameter, every point named by its polar form
  Knots,      // knot vectors with multiplicities
  Net,        // surfaces with control nets
  Isocurves,  // surfaces as isoparametric curves
  Trims,      // parameter space of faces: domain, loops with direction, gaps
  Annotation, // dimensions, notes and symbols: strokes and texts
  Gaussian,   // Gaussian curvature in colours
  Zebra,      // reflection stripes
  Shaded      // in the body's colour, lit from above
};
std::optional<What> what_from_name(std::string_view);

struct Options {
  std::optional<What> what;          // nothing: trims of healed and failed faces, or all of them; curves when there is no face, annotation when there is no curve either
  std::string entity;                // "D171", "#42": only what comes from it
  std::optional<double> at;          // parameter of the blossom; the middle when not given
  std::size_t most_drawings = 24;    // more are counted, not drawn
  Execution execution;
};

struct Picture {
  std::string svg;
  std::size_t drawn = 0, left_out = 0;
};
// NotFound when nothing in the model has such a picture.
Result<Picture> draw(const Model&, const SourceInfo&, const Options&);

// The control mesh and its rounds of a scheme, side by side on one sheet.
Result<Picture> draw_subdivision(const subdivision::ControlMesh&, subdivision::Scheme, int rounds);

}  // namespace trimloop::io::plot
