#pragma once
// The rules of single entity types, one namespace per type: rules::e126::knots_not_ascending.

#include "base/report.h"

namespace trimloop::iges::rules {

// clang-format off (one text a line reads like the table it is)

namespace e100 {  // Circular arc (100)

inline constexpr Rule radius_zero{
    "IG-E100-01", "radius-zero", Severity::Error,
    "start and end of an arc differ from its centre",
    "an arc without radius has no direction and no length",
    "delete it, or export again",
    "mm", "IGES 5.3 4.3"};

inline constexpr Rule radius_mismatch{
    "IG-E100-02", "radius-mismatch", Severity::Error,
    "start and end of an arc have the same distance from its centre",
    "the arc misses its end by the difference",
    "ask for an export with more digits",
    "mm", "IGES 5.3 4.3"};

inline constexpr Rule full_or_tiny{
    "IG-E100-03", "full-or-tiny", Severity::Warning,
    "start and end of an arc are equal or clearly apart",
    "readers take it for a full circle or for a sliver",
    "make the ends equal for a circle",
    "mm", "IGES 5.3 4.3"};

}  // namespace e100

namespace e102 {  // Composite curve (102)

inline constexpr Rule count{
    "IG-E102-01", "count", Severity::Error,
    "a composite curve has members",
    "it is no curve",
    "export again",
    "", "IGES 5.3 4.4"};

inline constexpr Rule member_type{
    "IG-E102-02", "member-type", Severity::Error,
    "members are curves or points, and no composite curves",
    "readers skip the member and the curve breaks",
    "export again with simple members",
    "", "IGES 5.3 4.4"};

inline constexpr Rule gap{
    "IG-E102-03", "gap", Severity::Error,
    "each member starts where the one before ends",
    "the boundary has a hole",
    "heal the curve at the sender; the gap is measured here",
    "mm", "IGES 5.3 4.4"};

inline constexpr Rule reversed_member{
    "IG-E102-04", "reversed-member", Severity::Warning,
    "members run in the direction of the composite",
    "strict readers find a gap",
    "it is turned in the import; export again for others",
    "mm", "IGES 5.3 4.4"};

inline constexpr Rule repeated_member{
    "IG-E102-05", "repeated-member", Severity::Warning,
    "no member follows itself",
    "the curve turns back on itself",
    "it is read once; export again for others",
    "", "IGES 5.3 4.4"};

}  // namespace e102

namespace e104 {  // Conic arc (104)

inline constexpr Rule form_vs_coeffs{
    "IG-E104-01", "form-vs-coeffs", Severity::Warning,
    "the form names the conic that the coefficients describe",
    "readers that follow the form draw another curve",
    "`trimloop fix` sets the form from the coefficients",
    "", "IGES 5.3 4.5"};

inline constexpr Rule degenerate{
    "IG-E104-02", "degenerate", Severity::Error,
    "the coefficients describe an ellipse, hyperbola or parabola",
    "it is a point, a line or nothing",
    "export as line or spline",
    "", "IGES 5.3 4.5"};

inline constexpr Rule end_off_curve{
    "IG-E104-03", "end-off-curve", Severity::Error,
    "both ends lie on the conic",
    "the curve misses its neighbours",
    "ask for an export with more digits",
    "mm", "IGES 5.3 4.5"};

inline constexpr Rule not_canonical{
    "IG-E104-04", "not-canonical", Severity::Warning,
    "the conic stands in the position that its form asks for",
    "some readers ignore the rotated terms",
    "export with the axis-aligned form and a matrix",
    "", "IGES 5.3 4.5"};

inline constexpr Rule two_branches{
    "IG-E104-05", "two-branches", Severity::Error,
    "both ends lie on one branch of the hyperbola",
    "there is no arc between them",
    "export again",
    "", "IGES 5.3 4.5"};

}  // namespace e104

namespace e106 {  // Copious data (106)

inline constexpr Rule form_vs_ip{
    "IG-E106-01", "form-vs-ip", Severity::Error,
    "the interpretation flag fits the form",
    "numbers are grouped wrongly into points",
    "set the flag that fits the numbers",
    "", "IGES 5.3 4.6"};

inline constexpr Rule count{
    "IG-E106-02", "count", Severity::Error,
    "there are enough points for the form",
    "there is nothing to draw",
    "export again",
    "points", "IGES 5.3 4.6"};

inline constexpr Rule not_closed{
    "IG-E106-03", "not-closed", Severity::Error,
    "a closed path (form 63) ends where it starts",
    "the area is not bounded",
    "close it at the sender",
    "mm", "IGES 5.3 4.11"};

inline constexpr Rule parity{
    "IG-E106-04", "parity", Severity::Error,
    "witness and section lines have the number of points that their form asks for",
    "the last line has no end",
    "export again",
    "points", "IGES 5.3 4.6"};

inline constexpr Rule repeated_points{
    "IG-E106-05", "repeated-points", Severity::Warning,
    "consecutive points differ",
    "segments without length have no direction",
    "harmless for points; remove the copy at the sender",
    "mm", "IGES 5.3 4.6"};

inline constexpr Rule zero_vector{
    "IG-E106-06", "zero-vector", Severity::Warning,
    "vectors given with points are not zero",
    "there is no direction at that point",
    "export without vectors",
    "", "IGES 5.3 4.6"};

}  // namespace e106

namespace e108 {  // Plane (108)

inline constexpr Rule zero_normal{
    "IG-E108-01", "zero-normal", Severity::Error,
    "A, B and C are not all zero",
    "the plane has no direction",
    "export again",
    "", "IGES 5.3 4.7"};

inline constexpr Rule form_vs_bound{
    "IG-E108-02", "form-vs-bound", Severity::Error,
    "bounded planes name their boundary, unbounded ones none",
    "the face is infinite, or missing",
    "`trimloop fix` sets the form from the pointer",
    "", "IGES 5.3 4.7"};

inline constexpr Rule bound_off_plane{
    "IG-E108-03", "bound-off-plane", Severity::Error,
    "the boundary is closed and lies in the plane",
    "the face is open or warped",
    "heal it at the sender",
    "mm", "IGES 5.3 4.7"};

}  // namespace e108

namespace e110 {  // Line (110)

inline constexpr Rule zero_length{
    "IG-E110-01", "zero-length", Severity::Error,
    "a line's end points differ",
    "it has no direction",
    "delete it",
    "mm", "IGES 5.3 4.13"};

}  // namespace e110

namespace e112 {  // Parametric spline curve (112)

inline constexpr Rule spline_type{
    "IG-E112-01", "spline-type", Severity::Warning,
    "spline type is 1-6 and continuity 0-2",
    "the values are for information only",
    "`trimloop fix --set` writes them",
    "", "IGES 5.3 4.14"};

inline constexpr Rule dimensions{
    "IG-E112-02", "dimensions", Severity::Error,
    "the dimension is 2 or 3, and planar curves have no z terms",
    "readers drop or keep z at will",
    "`trimloop fix --set` writes it",
    "", "IGES 5.3 4.14"};

inline constexpr Rule segments{
    "IG-E112-03", "segments", Severity::Error,
    "a spline has at least one segment",
    "it is no curve",
    "export again",
    "segments", "IGES 5.3 4.14"};

inline constexpr Rule breakpoints{
    "IG-E112-04", "breakpoints", Severity::Error,
    "break points ascend",
    "a segment without length cannot be evaluated",
    "export again",
    "", "IGES 5.3 4.14"};

inline constexpr Rule continuity_claim{
    "IG-E112-05", "continuity-claim", Severity::Warning,
    "the declared continuity is met at break points",
    "receivers that trust it smooth over a corner, or fail",
    "lower the claim",
    "mm", "IGES 5.3 4.14"};

inline constexpr Rule terminal_block{
    "IG-E112-06", "terminal-block", Severity::Warning,
    "the terminal values agree with the last segment",
    "harmless unless a receiver uses them",
    "the segments are believed; export again for others",
    "", "IGES 5.3 4.14"};

}  // namespace e112

namespace e114 {  // Parametric spline surface (114)

inline constexpr Rule flags{
    "IG-E114-01", "flags", Severity::Warning,
    "type flags are in range",
    "the values are for information only",
    "`trimloop fix --set` writes them",
    "", "IGES 5.3 4.15"};

inline constexpr Rule patches{
    "IG-E114-02", "patches", Severity::Error,
    "there are patches, between ascending break points",
    "it is no surface",
    "export again",
    "", "IGES 5.3 4.15"};

inline constexpr Rule patch_gap{
    "IG-E114-03", "patch-gap", Severity::Error,
    "neighbouring patches join",
    "the surface has cracks",
    "export again with more digits",
    "mm", "IGES 5.3 4.15"};

inline constexpr Rule dummy_rows{
    "IG-E114-04", "dummy-rows", Severity::Warning,
    "the place-holder row and column are there",
    "readers that expect them run past the end",
    "the surface is read without them; export again for others",
    "", "IGES 5.3 4.15"};

}  // namespace e114

namespace e116 {  // Point (116)

inline constexpr Rule symbol{
    "IG-E116-01", "symbol", Severity::Warning,
    "the display symbol is a subfigure definition (308)",
    "the symbol is not drawn",
    "set the pointer to 0",
    "", "IGES 5.3 4.16"};

}  // namespace e116

namespace e118 {  // Ruled surface (118)

inline constexpr Rule flags{
    "IG-E118-01", "flags", Severity::Error,
    "direction and developable flags are 0 or 1, the form 0 or 1",
    "the surface may twist",
    "correct the flags",
    "", "IGES 5.3 4.17"};

inline constexpr Rule rails{
    "IG-E118-02", "rails", Severity::Error,
    "the two rails are curves with length, apart from each other",
    "the surface collapses",
    "export again",
    "mm", "IGES 5.3 4.17"};

}  // namespace e118

namespace e120 {  // Surface of revolution (120)

inline constexpr Rule axis{
    "IG-E120-01", "axis", Severity::Error,
    "the axis is a line (110) with a length",
    "there is nothing to turn around",
    "export again",
    "mm", "IGES 5.3 4.18"};

inline constexpr Rule sweep{
    "IG-E120-02", "sweep", Severity::Error,
    "the end angle exceeds the start angle by no more than a full turn",
    "the surface is empty, or covers itself",
    "correct the angles",
    "rad", "IGES 5.3 4.18"};

inline constexpr Rule degrees{
    "IG-E120-03", "degrees", Severity::Warning,
    "angles are in radians",
    "read as radians, degrees give another part of the surface",
    "divide by 57.29578",
    "rad", "IGES 5.3 4.18"};

inline constexpr Rule crosses_axis{
    "IG-E120-04", "crosses-axis", Severity::Warning,
    "the generatrix does not cross the axis",
    "the surface cuts itself",
    "split the generatrix at the axis",
    "mm", "IGES 5.3 4.18"};

}  // namespace e120

namespace e122 {  // Tabulated cylinder (122)

inline constexpr Rule vector{
    "IG-E122-01", "vector", Severity::Error,
    "the sweep vector is not zero and not along the directrix",
    "the surface has no area",
    "export again",
    "mm", "IGES 5.3 4.19"};

}  // namespace e122

namespace e123 {  // Direction (123)

inline constexpr Rule zero{
    "IG-E123-01", "zero", Severity::Error,
    "a direction is not zero",
    "what is oriented by it cannot be placed",
    "export again",
    "", "IGES 5.3 4.20"};

}  // namespace e123

namespace e124 {  // Transformation matrix (124)

inline constexpr Rule form{
    "IG-E124-01", "form", Severity::Error,
    "the form is 0, 1, 10, 11 or 12",
    "readers ignore the matrix",
    "set it to 0, or 1 for a mirror",
    "", "IGES 5.3 4.21"};

inline constexpr Rule orthonormal{
    "IG-E124-02", "orthonormal", Severity::Warning,
    "the rotation part is orthonormal",
    "radii, angles and areas change when it is applied",
    "ask for an export with more digits",
    "", "IGES 5.3 4.21"};

inline constexpr Rule handedness{
    "IG-E124-03", "handedness", Severity::Warning,
    "form 0 turns and form 1 mirrors",
    "readers that trust the form turn faces inside out",
    "`trimloop fix` sets the form",
    "", "IGES 5.3 4.21"};

inline constexpr Rule singular{
    "IG-E124-04", "singular", Severity::Error,
    "the matrix can be inverted and all its values are finite",
    "whatever it places collapses",
    "export again",
    "", "IGES 5.3 4.21"};

inline constexpr Rule scale{
    "IG-E124-05", "scale", Severity::Warning,
    "no scale is hidden in the rotation",
    "strict readers drop it, and sizes differ",
    "scale the geometry at the sender",
    "", "IGES 5.3 4.21"};

}  // namespace e124

namespace e126 {  // Rational B-spline curve (126)

inline constexpr Rule order{
    "IG-E126-01", "order", Severity::Error,
    "degree is at least 1 and does not exceed the upper index",
    "it is no curve",
    "export again",
    "", "IGES 5.3 4.23"};

inline constexpr Rule knot_count{
    "IG-E126-02", "knot-count", Severity::Error,
    "there are K + M + 2 knots",
    "all later values are read from the wrong place",
    "export again",
    "knots", "IGES 5.3 4.23"};

inline constexpr Rule degenerate_span{
    "IG-E126-03", "degenerate-span", Severity::Error,
    "the knots span an interval",
    "the curve has no extent in its parameter",
    "export again",
    "", "IGES 5.3 4.23"};

inline constexpr Rule knots_not_ascending{
    "IG-E126-04", "knots-not-ascending", Severity::Error,
    "no knot is smaller than the one before",
    "the curve cannot be evaluated there",
    "export again",
    "", "IGES 5.3 4.23"};

inline constexpr Rule multiplicity{
    "IG-E126-05", "multiplicity", Severity::Error,
    "interior knots repeat at most M times, end knots M + 1",
    "the curve falls apart at that knot",
    "split the curve there",
    "", "IGES 5.3 4.23"};

inline constexpr Rule range{
    "IG-E126-06", "range", Severity::Error,
    "V(0) < V(1), both inside the knots",
    "the used part of the curve is undefined",
    "correct the range",
    "", "IGES 5.3 4.23"};

inline constexpr Rule weight{
    "IG-E126-07", "weight", Severity::Error,
    "all weights are positive and finite",
    "the curve runs through infinity",
    "export as polynomial",
    "", "IGES 5.3 4.23"};

inline constexpr Rule weight_ratio{
    "IG-E126-08", "weight-ratio", Severity::Warning,
    "weights do not differ by more than a million",
    "digits are lost in evaluation",
    "export again with normal weights",
    "", "IGES 5.3 4.23"};

inline constexpr Rule planar_flag{
    "IG-E126-09", "planar-flag", Severity::Warning,
    "the planar flag tells the truth",
    "receivers that trust it flatten the curve",
    "`trimloop fix` sets it",
    "mm", "IGES 5.3 4.23"};

inline constexpr Rule normal{
    "IG-E126-10", "normal", Severity::Warning,
    "planar curves give their unit normal",
    "receivers cannot place the plane",
    "`trimloop fix --set` writes it",
    "", "IGES 5.3 4.23"};

inline constexpr Rule closed_flag{
    "IG-E126-11", "closed-flag", Severity::Warning,
    "the closed flag tells the truth",
    "receivers that trust it close a gap, or leave one",
    "`trimloop fix` sets it",
    "mm", "IGES 5.3 4.23"};

inline constexpr Rule polynomial_flag{
    "IG-E126-12", "polynomial-flag", Severity::Warning,
    "the polynomial flag is set when all weights are equal, and only then",
    "receivers that trust it drop the weights",
    "`trimloop fix` sets it",
    "", "IGES 5.3 4.23"};

inline constexpr Rule periodic_flag{
    "IG-E126-13", "periodic-flag", Severity::Warning,
    "periodic curves have periodic knots",
    "receivers that trust it wrap the curve wrongly",
    "`trimloop fix` clears it",
    "", "IGES 5.3 4.23"};

inline constexpr Rule form_shape{
    "IG-E126-14", "form-shape", Severity::Warning,
    "forms 1 to 5 are the line or conic they name",
    "receivers that trust it replace the curve",
    "harmless here; other readers may follow the form",
    "mm", "IGES 5.3 4.23"};

inline constexpr Rule all_coincident{
    "IG-E126-15", "all-coincident", Severity::Error,
    "control points differ",
    "the curve is a point",
    "delete it",
    "mm", "IGES 5.3 4.23"};

}  // namespace e126

namespace e128 {  // Rational B-spline surface (128)

inline constexpr Rule order{
    "IG-E128-01", "order", Severity::Error,
    "degrees are at least 1 and do not exceed the upper indices",
    "it is no surface",
    "export again",
    "", "IGES 5.3 4.24"};

inline constexpr Rule knot_count{
    "IG-E128-02", "knot-count", Severity::Error,
    "there are K + M + 2 knots in each direction",
    "all later values are read from the wrong place",
    "export again",
    "knots", "IGES 5.3 4.24"};

inline constexpr Rule knots_not_ascending{
    "IG-E128-03", "knots-not-ascending", Severity::Error,
    "no knot is smaller than the one before",
    "the surface cannot be evaluated there",
    "export again",
    "", "IGES 5.3 4.24"};

inline constexpr Rule multiplicity{
    "IG-E128-04", "multiplicity", Severity::Error,
    "interior knots repeat at most M times, end knots M + 1",
    "the surface falls apart at that knot",
    "split the surface there",
    "", "IGES 5.3 4.24"};

inline constexpr Rule range{
    "IG-E128-05", "range", Severity::Error,
    "U(0) < U(1) and V(0) < V(1), inside the knots",
    "the used part of the surface is undefined",
    "correct the range",
    "", "IGES 5.3 4.24"};

inline constexpr Rule weight{
    "IG-E128-06", "weight", Severity::Error,
    "all weights are positive and finite",
    "the surface runs through infinity",
    "export as polynomial",
    "", "IGES 5.3 4.24"};

inline constexpr Rule flags{
    "IG-E128-07", "flags", Severity::Warning,
    "closed, polynomial and periodic flags tell the truth",
    "receivers that trust them close, flatten or wrap the surface wrongly",
    "`trimloop fix` sets them",
    "", "IGES 5.3 4.24"};

inline constexpr Rule form_shape{
    "IG-E128-08", "form-shape", Severity::Warning,
    "forms 1 to 9 are the surface they name",
    "receivers that trust it replace the surface",
    "harmless here; other readers may follow the form",
    "mm", "IGES 5.3 4.24"};

inline constexpr Rule collapsed{
    "IG-E128-09", "collapsed", Severity::Info,
    "the control points span a surface",
    "one collapsed side is a pole; a wholly collapsed surface has no area",
    "nothing to do for a pole; delete a surface without area",
    "mm", "IGES 5.3 4.24"};

}  // namespace e128

namespace e130 {  // Offset curve (130)

inline constexpr Rule flag{
    "IG-E130-01", "flag", Severity::Error,
    "offset flag is 1-3 and taper type 1 or 2",
    "the distance law is unknown",
    "correct the flags",
    "", "IGES 5.3 4.25"};

inline constexpr Rule normal{
    "IG-E130-02", "normal", Severity::Warning,
    "the normal is a unit vector across a planar base curve",
    "the side and size of the offset are wrong",
    "normalise it",
    "", "IGES 5.3 4.25"};

inline constexpr Rule range{
    "IG-E130-03", "range", Severity::Error,
    "TT1 < TT2 inside the base curve's range",
    "the used part is undefined",
    "correct the range",
    "", "IGES 5.3 4.25"};

inline constexpr Rule self_offset{
    "IG-E130-04", "self-offset", Severity::Warning,
    "the distance stays below the radius of curvature",
    "the offset cuts itself",
    "export the offset as a spline",
    "mm", "IGES 5.3 4.25"};

}  // namespace e130

namespace e140 {  // Offset surface (140)

inline constexpr Rule indicator{
    "IG-E140-01", "indicator", Severity::Error,
    "the indicator is the surface normal or its opposite",
    "the side of the offset is unknown",
    "export again",
    "", "IGES 5.3 4.30"};

inline constexpr Rule self_offset{
    "IG-E140-02", "self-offset", Severity::Warning,
    "the distance stays below the radius of curvature",
    "the offset cuts itself",
    "export the offset as a spline",
    "mm", "IGES 5.3 4.30"};

}  // namespace e140

namespace e141 {  // Boundary (141)

inline constexpr Rule flags{
    "IG-E141-01", "flags", Severity::Error,
    "type is 0 or 1, preference 0-3, sense 1 or 2",
    "the direction of an edge is unknown",
    "correct the flags",
    "", "IGES 5.3 4.31"};

inline constexpr Rule pcurve_rule{
    "IG-E141-02", "pcurve-rule", Severity::Error,
    "type 1 has parameter curves, type 0 has none",
    "readers look for curves that are not there",
    "`trimloop fix --set` writes the type that the curves have",
    "", "IGES 5.3 4.31"};

inline constexpr Rule chain{
    "IG-E141-03", "chain", Severity::Error,
    "boundary curves chain head to tail",
    "the boundary has a hole",
    "heal it at the sender",
    "mm", "IGES 5.3 4.31"};

inline constexpr Rule pcurve_deviation{
    "IG-E141-04", "pcurve-deviation", Severity::Error,
    "parameter curve and model curve describe the same edge",
    "receivers trim in different places",
    "export again, with both curves from one source",
    "mm", "IGES 5.3 4.31"};

}  // namespace e141

namespace e142 {  // Curve on a surface (142)

inline constexpr Rule flags{
    "IG-E142-01", "flags", Severity::Warning,
    "creation and preference flags are 0 to 3",
    "readers choose a curve at will",
    "`trimloop fix` writes 0",
    "", "IGES 5.3 4.32"};

inline constexpr Rule both_null{
    "IG-E142-02", "both-null", Severity::Error,
    "the parameter-space or the model-space curve is given",
    "there is no curve",
    "export again",
    "", "IGES 5.3 4.32"};

inline constexpr Rule outside_domain{
    "IG-E142-03", "outside-domain", Severity::Error,
    "the parameter-space curve stays on the surface's domain",
    "the face reaches beyond its surface",
    "extend the surface, or trim again, at the sender",
    "parameter", "IGES 5.3 4.32"};

inline constexpr Rule deviation{
    "IG-E142-04", "deviation", Severity::Error,
    "parameter-space and model-space curve describe the same curve",
    "receivers trim in different places, and edges do not meet",
    "export again, with both curves from one source",
    "mm", "IGES 5.3 4.32"};

inline constexpr Rule use_flag{
    "IG-E142-05", "use-flag", Severity::Warning,
    "parameter-space curves carry use flag 05",
    "receivers show them as geometry near the origin",
    "`trimloop fix` sets the flag",
    "", "IGES 5.3 4.32"};

inline constexpr Rule surface_mismatch{
    "IG-E142-06", "surface-mismatch", Severity::Error,
    "a trimming curve lies on the surface it trims",
    "the face is cut by another surface's curve",
    "export again",
    "", "IGES 5.3 4.32"};

inline constexpr Rule direction{
    "IG-E142-07", "direction", Severity::Warning,
    "both curves run the same way",
    "receivers that mix them turn the loop",
    "it is turned in the import; export again for others",
    "", "IGES 5.3 4.32"};

inline constexpr Rule not_2d{
    "IG-E142-08", "not-2d", Severity::Warning,
    "parameter-space curves have z = 0",
    "the z value has no meaning",
    "z is ignored here; export again for others",
    "", "IGES 5.3 4.32"};

}  // namespace e142

namespace e143 {  // Bounded surface (143)

inline constexpr Rule type{
    "IG-E143-01", "type", Severity::Error,
    "there are boundaries, all of the type that the surface states",
    "readers look for curves that are not there",
    "`trimloop fix --set` writes the type that the boundaries have",
    "", "IGES 5.3 4.33"};

inline constexpr Rule surface{
    "IG-E143-02", "surface", Severity::Error,
    "boundaries lie on the surface they bound",
    "the face is cut by another surface's curve",
    "export again",
    "", "IGES 5.3 4.33"};

}  // namespace e143

namespace e144 {  // Trimmed surface (144)

inline constexpr Rule flags{
    "IG-E144-01", "flags", Severity::Error,
    "N1 is 1 when an outer boundary is given, 0 when not",
    "readers take the whole surface, or fail",
    "`trimloop fix` sets N1",
    "", "IGES 5.3 4.34"};

inline constexpr Rule loop_open{
    "IG-E144-02", "loop-open", Severity::Error,
    "boundaries are closed",
    "there is no inside",
    "heal the loop at the sender",
    "mm", "IGES 5.3 4.34"};

inline constexpr Rule nesting{
    "IG-E144-03", "nesting", Severity::Error,
    "holes lie inside the outer boundary and outside each other",
    "faces have parts that should not be there",
    "heal the loops at the sender",
    "", "IGES 5.3 4.34"};

inline constexpr Rule loops_cross{
    "IG-E144-04", "loops-cross", Severity::Error,
    "boundaries do not cross",
    "inside and outside are confused",
    "heal the loops at the sender",
    "mm", "IGES 5.3 4.34"};

inline constexpr Rule orientation{
    "IG-E144-05", "orientation", Severity::Warning,
    "outer boundaries run counter-clockwise, holes clockwise",
    "receivers that trust the direction take the complement",
    "loops are turned in the import; export again for others",
    "", "IGES 5.3 4.34"};

inline constexpr Rule infinite_base{
    "IG-E144-06", "infinite-base", Severity::Error,
    "an unbounded surface has an outer boundary",
    "the face is infinite",
    "give it an outer boundary",
    "", "IGES 5.3 4.34"};

inline constexpr Rule seam{
    "IG-E144-07", "seam", Severity::Warning,
    "boundaries do not run across a seam or pole without an edge there",
    "many receivers cannot split the face themselves",
    "split closed faces in the export options",
    "", "IGES 5.3 4.34"};

}  // namespace e144

namespace e150 {  // Primitive solids (150-168)

inline constexpr Rule size{
    "IG-E150-01", "primitive-size", Severity::Error,
    "sizes of a primitive are positive and in their order",
    "the solid has no inside",
    "export again",
    "", "IGES 5.3 4.23"};

inline constexpr Rule axes{
    "IG-E150-02", "primitive-axes", Severity::Error,
    "the local axes of a primitive are at right angles",
    "the solid is skewed in some readers",
    "export again with axes at right angles",
    "", "IGES 5.3 4.23"};

}  // namespace e150

namespace e162 {  // Swept solids (162, 164)

inline constexpr Rule fraction{
    "IG-E162-01", "fraction", Severity::Error,
    "the fraction of a turn is above 0 and at most 1, a length above 0",
    "the solid has no inside",
    "export again",
    "", "IGES 5.3 4.29"};

}  // namespace e162

namespace e180 {  // Boolean tree (180)

inline constexpr Rule postfix{
    "IG-E180-01", "postfix", Severity::Error,
    "a Boolean tree is an expression in postfix order",
    "readers build different solids or none",
    "export again",
    "", "IGES 5.3 4.32"};

}  // namespace e180

namespace e184 {  // Solid assembly (184)

inline constexpr Rule assembly{
    "IG-E184-01", "assembly", Severity::Error,
    "an assembly names solids and as many matrices",
    "parts are missing or misplaced",
    "export again",
    "", "IGES 5.3 4.34"};

}  // namespace e184

namespace e186 {  // Manifold solid (186)

inline constexpr Rule outer_shell{
    "IG-E186-01", "outer-shell", Severity::Error,
    "the outer shell is closed (514 form 1)",
    "it encloses nothing",
    "sew the shell at the sender",
    "", "IGES 5.3 4.49"};

inline constexpr Rule orientation_flag{
    "IG-E186-02", "orientation-flag", Severity::Warning,
    "orientation flags fit outward normals",
    "the solid is inside out",
    "`trimloop fix --set` writes the flag",
    "", "IGES 5.3 4.49"};

inline constexpr Rule void_shell{
    "IG-E186-03", "void", Severity::Error,
    "voids lie inside the outer shell",
    "the volume is wrong",
    "turn the shells at the sender",
    "", "IGES 5.3 4.49"};

}  // namespace e186

namespace e190 {  // Analytic surfaces (190-198)

inline constexpr Rule form_vs_ref{
    "IG-E190-01", "form-vs-ref", Severity::Error,
    "form 1 gives a reference direction, form 0 does not",
    "the start of the parameter is unknown, and pcurves are turned",
    "`trimloop fix` sets the form",
    "", "IGES 5.3 4.50"};

inline constexpr Rule size{
    "IG-E190-02", "size", Severity::Error,
    "radii are positive, cone angles between 0 and 90 degrees, a torus has a hole",
    "it is no such surface",
    "export again",
    "", "IGES 5.3 4.50"};

inline constexpr Rule axes{
    "IG-E190-03", "axes", Severity::Error,
    "the reference direction is not along the axis",
    "the start of the parameter is unknown",
    "export again",
    "rad", "IGES 5.3 4.50"};

}  // namespace e190

namespace e212 {  // General note (212, 213)

inline constexpr Rule text_length{
    "IG-E212-01", "text-length", Severity::Warning,
    "a text has as many characters as are declared",
    "text is cut or padded",
    "`trimloop fix` writes the right count",
    "characters", "IGES 5.3 4.60"};

inline constexpr Rule text_codes{
    "IG-E212-02", "text-codes", Severity::Warning,
    "mirror and rotate codes of a text are in range",
    "text is drawn mirrored or upright",
    "export again",
    "", "IGES 5.3 4.60"};

}  // namespace e212

namespace e304 {  // Line font definition (304)

inline constexpr Rule pattern{
    "IG-E304-01", "line-font", Severity::Warning,
    "a line font has segments of positive length",
    "lines are drawn solid",
    "export again",
    "", "IGES 5.3 4.72"};

}  // namespace e304

namespace e306 {  // Macro definition (306)

inline constexpr Rule macro{
    "IG-E306-01", "macro", Severity::Info,
    "no macro is defined",
    "macros are programs: they are kept and reported, never run",
    "export without macros",
    "", "IGES 5.3 4.73"};

}  // namespace e306

namespace e308 {  // Subfigure definition (308)

inline constexpr Rule definition{
    "IG-E308-01", "definition", Severity::Warning,
    "a subfigure has a name and members",
    "instances of it show nothing",
    "export again",
    "", "IGES 5.3 4.74"};

}  // namespace e308

namespace e314 {  // Colour definition (314)

inline constexpr Rule rgb{
    "IG-E314-01", "rgb", Severity::Warning,
    "colour components are 0 to 100",
    "senders that write 0 to 255 come out white",
    "`trimloop fix --set` writes them from 0 to 100",
    "", "IGES 5.3 4.76"};

}  // namespace e314

namespace e322 {  // Attribute tables (322, 422)

inline constexpr Rule attribute{
    "IG-E322-01", "attribute", Severity::Error,
    "an attribute table has a definition that says what its values are",
    "the values have no meaning",
    "export again",
    "", "IGES 5.3 4.79"};

}  // namespace e322

namespace e402 {  // Associativity (402)

inline constexpr Rule associativity{
    "IG-E402-01", "associativity", Severity::Error,
    "counts fit the form (a single parent in form 9, ...)",
    "the group is misread",
    "export again; members cannot be guessed",
    "", "IGES 5.3 4.79"};

}  // namespace e402

namespace e404 {  // Drawing (404)

inline constexpr Rule drawing{
    "IG-E404-01", "drawing", Severity::Warning,
    "a drawing has views",
    "the sheet is empty",
    "export again",
    "", "IGES 5.3 4.96"};

}  // namespace e404

namespace e406 {  // Property (406)

inline constexpr Rule property_count{
    "IG-E406-01", "property-count", Severity::Warning,
    "a property has as many values as its form says",
    "names and attributes may be misread",
    "export again; values cannot be guessed",
    "values", "IGES 5.3 4.98"};

inline constexpr Rule property_range{
    "IG-E406-02", "property-range", Severity::Warning,
    "enumerated values are in range",
    "the attribute is ignored",
    "correct the value",
    "", "IGES 5.3 4.98"};

}  // namespace e406

namespace e408 {  // Subfigure instance (408)

inline constexpr Rule scale{
    "IG-E408-01", "scale", Severity::Error,
    "the scale of an instance is not zero",
    "the part vanishes; a negative scale mirrors it",
    "export again",
    "", "IGES 5.3 4.135"};

}  // namespace e408

namespace e410 {  // View (410)

inline constexpr Rule view{
    "IG-E410-01", "view", Severity::Error,
    "the scale of a view is positive",
    "the view shows nothing",
    "export again",
    "", "IGES 5.3 4.137"};

}  // namespace e410

namespace e412 {  // Arrays of instances (412, 414)

inline constexpr Rule array{
    "IG-E412-01", "array", Severity::Error,
    "an array has at least one row and column, its list names positions that exist",
    "copies are missing or too many",
    "export again",
    "", "IGES 5.3 4.138"};

}  // namespace e412

namespace e416 {  // External reference (416)

inline constexpr Rule external{
    "IG-E416-01", "external", Severity::Warning,
    "an external reference names what it refers to",
    "nothing can be found by it",
    "export again",
    "", "IGES 5.3 4.140"};

}  // namespace e416

namespace e502 {  // Vertex list (502)

inline constexpr Rule vertex_list{
    "IG-E502-01", "vertex-list", Severity::Error,
    "a vertex list has vertices",
    "edges have no ends",
    "export again",
    "vertices", "IGES 5.3 4.143"};

inline constexpr Rule vertex_twin{
    "IG-E502-02", "vertex-twin", Severity::Warning,
    "vertices are apart",
    "edges that should meet are listed as apart",
    "harmless here; join them at the sender",
    "mm", "IGES 5.3 4.143"};

}  // namespace e502

namespace e504 {  // Edge list (504)

inline constexpr Rule indices{
    "IG-E504-01", "indices", Severity::Error,
    "edges name vertices that exist",
    "the edge has no ends",
    "export again",
    "", "IGES 5.3 4.144"};

inline constexpr Rule end_gap{
    "IG-E504-02", "end-gap", Severity::Error,
    "curves end at their vertices",
    "the shell has cracks",
    "heal it at the sender",
    "mm", "IGES 5.3 4.144"};

}  // namespace e504

namespace e508 {  // Loop (508)

inline constexpr Rule use{
    "IG-E508-01", "use", Severity::Error,
    "edge uses have a known type, a logical orientation and an index in the list",
    "the loop is broken",
    "export again",
    "", "IGES 5.3 4.145"};

inline constexpr Rule head_to_tail{
    "IG-E508-02", "head-to-tail", Severity::Error,
    "edges of a loop chain head to tail",
    "the face is open",
    "heal it at the sender",
    "mm", "IGES 5.3 4.145"};

inline constexpr Rule pcurves{
    "IG-E508-03", "pcurves", Severity::Error,
    "parameter curves lie on their edges",
    "receivers trim in different places",
    "export again, with both curves from one source",
    "mm", "IGES 5.3 4.145"};

}  // namespace e508

namespace e510 {  // Face (510)

inline constexpr Rule face{
    "IG-E510-01", "face", Severity::Error,
    "a face has loops, a valid outer-loop flag and a surface",
    "the face cannot be built",
    "export again",
    "", "IGES 5.3 4.146"};

}  // namespace e510

namespace e514 {  // Shell (514)

inline constexpr Rule shell{
    "IG-E514-01", "shell", Severity::Error,
    "a shell has faces, each listed once",
    "area and volume are wrong",
    "export again",
    "", "IGES 5.3 4.147"};

inline constexpr Rule closure{
    "IG-E514-02", "closure", Severity::Error,
    "in a closed shell every edge is used twice, in opposite directions",
    "the solid leaks",
    "sew it at the sender",
    "", "IGES 5.3 4.147"};

}  // namespace e514

}  // namespace trimloop::iges::rules
