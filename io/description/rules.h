#pragma once
// Rules of descriptions (JSON), drawings (SVG), point tables (CSV), control meshes (OBJ) and fonts. Ids are never reused.

#include <array>

#include "base/report.h"

namespace trimloop::io::description_rules {

inline constexpr Rule text{
    "DS-01", "description-not-readable", Severity::Fatal, "the text is JSON",
    "nothing in it can be trusted", "check the place named with any JSON editor", "", "RFC 8259"};
inline constexpr Rule field{
    "DS-02", "description-field-wrong", Severity::Fatal, "each member is there, of the right kind, finite and of the right length",
    "the shape is not defined without it", "compare with docs/nurbs-schema.json, or `trimloop nurbs --schema`", "", ""};
inline constexpr Rule unknown{
    "DS-03", "description-field-unknown", Severity::Fatal, "each member has a meaning in its shape",
    "a misspelt word would be passed over and another shape made than was meant", "compare the word with docs/nurbs-schema.json", "", ""};
inline constexpr Rule shape{
    "DS-04", "description-shape-impossible", Severity::Fatal, "the numbers describe a shape",
    "there is no such curve or surface", "the message says what was measured and what is allowed", "", ""};
inline constexpr Rule drawing{
    "DS-11", "drawing-not-readable", Severity::Fatal, "the text is XML with an <svg> root",
    "no outline can be found in it", "open it in a browser; export plain SVG", "", "SVG 1.1"};
inline constexpr Rule drawing_element{
    "DS-12", "drawing-element-not-understood", Severity::Error, "each outline element has data and a transform that can be read",
    "this outline is missing in the model; the others are there", "convert the element to a plain path in the drawing program", "", "SVG 1.1 8, 9"};
inline constexpr Rule drawing_left_out{
    "DS-13", "drawing-element-not-an-outline", Severity::Info, "the drawing holds outlines only",
    "text, pictures, styles and references have no shape here", "convert text to paths in the drawing program", "", ""};
inline constexpr Rule table{
    "DS-21", "table-not-readable", Severity::Fatal, "each row holds the same number of finite numbers, two or three",
    "the rows are no points", "check the line named", "", ""};
inline constexpr Rule mesh{
    "DS-31", "control-mesh-not-usable", Severity::Fatal, "points are finite, faces name them, edges have at most two faces",
    "no subdivision scheme is defined on it", "the message names face, point or edge", "", ""};
inline constexpr Rule font{
    "DS-41", "font-not-usable", Severity::Fatal, "the bytes are a font with outlines", "there are no glyphs to take",
    "use a TrueType or OpenType font", "", ""};
inline constexpr Rule glyph{
    "DS-42", "glyph-missing", Severity::Warning, "the font has a glyph for each character",
    "its place in the line is left empty", "use a font that covers the text", "", ""};
inline constexpr Rule bound{
    "DS-51", "shape-approximated", Severity::Info, "what is not exact says by how much",
    "receivers see a shape that is off by at most the bound", "ask for a smaller tolerance", "mm", ""};

inline constexpr Rule joints{
    "DS-52", "joints-of-patches", Severity::Info, "patches that fill a hole say how smoothly they meet",
    "a fill that is continuous in position only shows its spokes in reflections", "ask for \"continuity\": \"tangent\"", "rad", ""};

inline constexpr std::array<const Rule*, 13> all{&text, &field, &unknown, &shape, &drawing, &drawing_element,
                                                 &drawing_left_out, &table, &mesh, &font, &glyph, &bound, &joints};

}  // namespace trimloop::io::description_rules
