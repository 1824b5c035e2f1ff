#pragma once
// Rules of what a file means: shape quality as the import sees it (SQ), the model as a whole (MD), limits (LM) and our
// own output (WR). The rules of IGES records are in formats/iges/rules.h. Ids are never reused.

#include <span>

#include "base/report.h"

namespace trimloop::io::rules {

// clang-format off (one text a line reads like the table it is)

std::span<const Rule* const> all();

// ---- Shape quality: SQ-... (slugs are the leaf names of ISO 10303-59 where there is one)

inline constexpr Rule erroneous_curve{
    "SQ-101", "erroneous-b-spline-curve-definition", Severity::Error,
    "a spline curve has counts that fit, ascending knots, allowed multiplicities and finite values",
    "the curve has no points, or receivers disagree about them",
    "export the curve again; `trimloop dump` shows the record",
    "", "ISO 10303-59 erroneous_b_spline_curve_definition"};

inline constexpr Rule erroneous_surface{
    "SQ-102", "erroneous-b-spline-surface-definition", Severity::Error,
    "a spline surface has counts that fit, ascending knots, allowed multiplicities and finite values",
    "the surface has no points, or receivers disagree about them",
    "export the surface again; `trimloop dump` shows the record",
    "", "ISO 10303-59 erroneous_b_spline_surface_definition"};

inline constexpr Rule inconsistent_face_normal{
    "SQ-223", "inconsistent-face-and-surface-normals", Severity::Error,
    "the loops of a face run around it in the sense that its surface and its flag ask for",
    "a receiver that trusts the loop fills the outside of the face",
    "the loops are turned here; export again to have the file right",
    "", "ISO 10303-59 inconsistent_face_and_surface_normals"};

inline constexpr Rule intersecting_loops{
    "SQ-224", "intersecting-loops-in-face", Severity::Error,
    "the loops of a face neither touch nor cross each other or themselves",
    "what is inside is not defined; parity decides here",
    "repair the trimming curves at the place named",
    "mm", "ISO 10303-59 intersecting_loops_in_face"};

inline constexpr Rule misplaced_loop{
    "SQ-225", "wrongly-placed-loop", Severity::Warning,
    "each loop of a face bounds something",
    "the loop has no effect on the face",
    "remove the loop, or look for the curve that should have been there",
    "mm", "ISO 10303-59 wrongly_placed_loop"};

inline constexpr Rule gap_in_loop{
    "SQ-251", "gap-between-adjacent-edges-in-loop", Severity::Warning,
    "each edge of a loop ends where the next begins",
    "meshes and offsets leak through the gap",
    "the gap is closed here; export with a tighter tolerance",
    "mm", "ISO 10303-59 gap_between_adjacent_edges_in_loop"};

inline constexpr Rule gap_edge_surface{
    "SQ-252", "gap-between-edge-and-base-surface", Severity::Warning,
    "each edge lies on the surface it trims",
    "the face's border is not where its neighbours' border is",
    "rebuild the trimming curve on the surface",
    "mm", "ISO 10303-59 gap_between_edge_and_base_surface"};

inline constexpr Rule gap_inside{
    "SQ-400", "g0-gap-inside-element", Severity::Error,
    "a curve or surface made of pieces joins without a jump",
    "the pieces are joined here and the shape moves by the gap",
    "export again as one spline",
    "mm", ""};

inline constexpr Rule non_finite{
    "SQ-401", "non-finite-result", Severity::Error,
    "a record's numbers give finite points",
    "the shape cannot be drawn, measured or written",
    "look for absurd coordinates, weights or distances in the record",
    "", ""};

inline constexpr Rule free_edge{
    "SQ-241", "free-edge", Severity::Info,
    "each edge of a shell belongs to two faces",
    "the shell is open there: it has no volume, and a mesh of it leaks",
    "`--sew TOL` joins edges that lie within TOL; else look for the face that is missing",
    "mm", "ISO 10303-59 free_edge"};

inline constexpr Rule seam{
    "SQ-411", "seam-misplaced", Severity::Info,
    "no trimming curve crosses the seam of a closed surface without an edge there",
    "receivers that need the seam as an edge lose the face",
    "an edge is put along the seam here; nothing to do",
    "", ""};

inline constexpr Rule pole{
    "SQ-412", "trim-touches-pole", Severity::Info,
    "where a boundary meets a pole of the surface there is an edge of length zero in parameter space",
    "in parameter space the loop is open there",
    "the edge is supplied here; nothing to do",
    "", ""};

inline constexpr Rule shared_face{
    "SQ-416", "over-used-face", Severity::Warning,
    "each face belongs to one shell",
    "the face is counted and meshed once for each body that uses it",
    "give each body its own face",
    "", ""};

// ---- Model: MD-..

inline constexpr Rule empty_model{
    "MD-01", "empty-model", Severity::Warning,
    "the file holds at least one shape",
    "there is nothing to show, measure or convert",
    "export again with geometry selected",
    "", ""};

inline constexpr Rule nothing_visible{
    "MD-02", "nothing-visible", Severity::Warning,
    "at least one shape is visible",
    "receivers open the file and show nothing",
    "unhide the entities and export again",
    "", ""};

inline constexpr Rule sew_report{
    "MD-10", "sew-report", Severity::Info,
    "faces that lie edge to edge are joined, and what stays open is counted",
    "faces that only lie side by side are no solid to a receiver",
    "`--sew off` leaves faces as the file has them, `--sew TOL` says how far edges may lie apart",
    "mm", ""};

inline constexpr Rule unsupported{
    "MD-12", "unsupported-entity", Severity::Warning,
    "each entity that means geometry becomes part of the model",
    "what is named here is missing from the model, from meshes and from converted files",
    "export it as trimmed surfaces or as a boundary representation",
    "", ""};

inline constexpr Rule approximated{
    "MD-31", "approximated-shape", Severity::Info,
    "each shape is what the file says, to the last digit",
    "a shape that has no exact form here is a spline near it; the distance is measured",
    "nothing to do when the distance is far below the tolerance asked for",
    "mm", ""};

inline constexpr Rule ignored{
    "MD-13", "ignored-data", Severity::Info,
    "each entity has an effect on the model",
    "notes, views and properties named here are not carried over",
    "nothing to do unless you need them; `trimloop fix` keeps them",
    "", ""};

inline constexpr Rule healed_face{
    "MD-30", "healed-face", Severity::Info,
    "each face is made from the file's trimming curves as they are",
    "the face is not quite what the file says; the area before and after tells by how much",
    "look at its loops with `trimloop plot`, and at the findings of its curves",
    "mm2", ""};

// ---- Limits: LM-..

inline constexpr Rule depth{
    "LM-05", "depth", Severity::Error,
    "entities are nested no deeper than --limit-depth",
    "deeper nesting is almost always an error or an attack",
    "raise --limit-depth if the file is meant to be so",
    "levels", ""};

inline constexpr Rule work{
    "LM-06", "work", Severity::Error,
    "one record asks for no more work than --limit-instances",
    "a small file could keep the program busy for hours",
    "raise --limit-instances if the file is meant to be so",
    "", ""};

inline constexpr Rule expansion{
    "LM-07", "expansion", Severity::Error,
    "placing every instance gives no more occurrences than --limit-instances",
    "a small file could unfold to more shapes than memory holds",
    "raise --limit-instances if the file is meant to be so",
    "occurrences", ""};

inline constexpr Rule cancelled{
    "LM-10", "cancelled", Severity::Info,
    "the work ran to its end",
    "what is reported is true but not complete",
    "start again without interruption",
    "", ""};

// clang-format on

}  // namespace trimloop::io::rules
