#pragma once
// The rules of STEP files: syntax, records, geometry, assemblies, validation properties. What `trimloop explain` prints.
// Ids are never reused.

#include <span>

#include "base/report.h"

namespace trimloop::step::rules {

// clang-format off (one text a line reads like the table it is)

// Every rule below, in this order.
std::span<const Rule* const> all();

// ---- File syntax: SP-F..

inline constexpr Rule not_part21{
    "SP-F01", "not-part21", Severity::Fatal,
    "the file begins with ISO-10303-21 or with a section of a Part 21 file",
    "without that frame nothing says where instances begin",
    "check that this is the right file; export it again as a STEP physical file (Part 21)",
    "", "ISO 10303-21 7"};

inline constexpr Rule end_missing{
    "SP-F02", "end-missing", Severity::Error,
    "the file ends with END-ISO-10303-21",
    "the file may have been cut on its way: what stood behind is lost",
    "fetch or export the file again and compare the sizes",
    "", "ISO 10303-21 7"};

inline constexpr Rule after_end{
    "SP-F03", "after-end", Severity::Warning,
    "nothing but signatures follows END-ISO-10303-21",
    "it is not part of the file and no reader looks at it",
    "remove what follows the end",
    "", "ISO 10303-21 7"};

inline constexpr Rule section_order{
    "SP-F04", "section-order", Severity::Error,
    "sections come in the order HEADER, ANCHOR, REFERENCE, DATA, SIGNATURE and end with ENDSEC",
    "many readers refuse the file or stop at the wrong section",
    "export again; the sections are read here in whatever order they come",
    "", "ISO 10303-21 5.3"};

inline constexpr Rule header_entities{
    "SP-F05", "header-entities", Severity::Error,
    "FILE_DESCRIPTION, FILE_NAME and FILE_SCHEMA stand in the header once, in this order",
    "receivers decide by them how to read the rest",
    "write the missing header entity by hand or export again",
    "", "ISO 10303-21 8.2"};

inline constexpr Rule header_arity{
    "SP-F06", "header-arity", Severity::Error,
    "the header entities have 2, 7 and 1 fields",
    "a receiver that counts fields takes one for another",
    "export again, or supply the missing fields as ''",
    "fields", "ISO 10303-21 8.2"};

inline constexpr Rule header_types{
    "SP-F07", "header-types", Severity::Warning,
    "header fields that are lists are written as lists, strings as strings",
    "strict readers refuse the file",
    "put parentheses round the value",
    "", "ISO 10303-21 8.2"};

inline constexpr Rule implementation_level{
    "SP-F10", "implementation-level", Severity::Warning,
    "the implementation level is one of 1;1 to 4;3 and allows what the file uses",
    "a receiver of an older edition stops at what it does not know",
    "export for the edition that the file really uses",
    "", "ISO 10303-21 8.2.2"};

inline constexpr Rule schema_name{
    "SP-F11", "schema-name", Severity::Warning,
    "the schema is one of the application protocols for shapes",
    "the same keyword can mean something else in another schema",
    "nothing, if the shapes are right; else ask the sender for AP203, AP214 or AP242",
    "", "ISO 10303-21 8.2.4"};

inline constexpr Rule instance_zero{
    "SP-F13", "instance-zero", Severity::Error,
    "an instance name is a number from 1 to 64 bits",
    "the instance cannot be pointed at",
    "export again; the instance is left out",
    "", "ISO 10303-21 6.4.4"};

inline constexpr Rule instance_malformed{
    "SP-F14", "instance-malformed", Severity::Error,
    "an instance is #digits=KEYWORD(...);",
    "what it means cannot be told, it is left out",
    "look at the place named; something was written over the file or cut out of it",
    "", "ISO 10303-21 7.3"};

inline constexpr Rule instance_duplicate{
    "SP-F15", "instance-duplicate", Severity::Error,
    "each instance name is defined once",
    "who refers to it may get either; the first is taken here",
    "find out which of the two is meant and number the other anew",
    "", "ISO 10303-21 7.3"};

inline constexpr Rule reference_unresolved{
    "SP-F16", "reference-unresolved", Severity::Error,
    "each reference leads to an instance of the file",
    "a piece of the shape is missing",
    "export again; the file was cut or edited",
    "", "ISO 10303-21 7.3"};

inline constexpr Rule reference_self{
    "SP-F17", "reference-self", Severity::Error,
    "no instance is part of itself",
    "readers that follow the reference never end",
    "export again; the reference is not followed here",
    "", "ISO 10303-21 7.3"};

inline constexpr Rule terminator{
    "SP-F18", "terminator", Severity::Error,
    "each instance ends with one semicolon",
    "readers run on into the next instance and lose both",
    "put the semicolon where it belongs; here the next #n= begins a new instance",
    "", "ISO 10303-21 7"};

inline constexpr Rule separators{
    "SP-F19", "separators", Severity::Error,
    "parameters are separated by one comma each",
    "parameters are counted: one comma too many shifts the rest",
    "look at the place named",
    "", "ISO 10303-21 7.3"};

inline constexpr Rule string_open{
    "SP-F20", "string-open", Severity::Error,
    "each string ends with an apostrophe",
    "everything up to the next apostrophe is taken for text",
    "put the apostrophe in; an apostrophe inside a string is written twice",
    "", "ISO 10303-21 6.4.3"};

inline constexpr Rule string_escape{
    "SP-F21", "string-escape", Severity::Warning,
    "the escapes of strings are those of the standard and complete",
    "the text is not what the sender meant",
    "export again; the characters are kept as they stand",
    "", "ISO 10303-21 6.4.3"};

inline constexpr Rule string_raw_byte{
    "SP-F22", "string-raw-byte", Severity::Warning,
    "strings of editions 1 and 2 hold only the basic alphabet",
    "every receiver reads other bytes in a code page of its own",
    "set the sender to write escapes, or edition 3; UTF-8 is taken where it is valid, else ISO 8859-1",
    "", "ISO 10303-21 6.4.3"};

inline constexpr Rule comment_open{
    "SP-F24", "comment-open", Severity::Error,
    "each comment ends, and comments do not nest",
    "what stands in an open comment is lost",
    "close the comment",
    "", "ISO 10303-21 6.5"};

inline constexpr Rule real_form{
    "SP-F25", "real-form", Severity::Warning,
    "a real has a digit, a point and the exponent letter E",
    "strict readers refuse the value",
    "export again; the value is taken where it is clear",
    "", "ISO 10303-21 6.4.2"};

inline constexpr Rule real_overflow{
    "SP-F26", "real-overflow", Severity::Error,
    "each real fits a double",
    "the value is lost",
    "look at the value; it is absurd in any unit",
    "", "ISO 10303-21 6.4.2"};

inline constexpr Rule integer_overflow{
    "SP-F27", "integer-overflow", Severity::Error,
    "each integer fits 64 bits",
    "the value is lost",
    "look at the value",
    "", "ISO 10303-21 6.4.1"};

inline constexpr Rule enum_form{
    "SP-F28", "enum-form", Severity::Error,
    "an enumeration is a word in capitals between points",
    "strict readers refuse the value",
    "write .T. or .F. in capitals with both points",
    "", "ISO 10303-21 6.4.6"};

inline constexpr Rule binary_form{
    "SP-F29", "binary-form", Severity::Error,
    "a binary begins with a digit from 0 to 3, followed by hexadecimal digits",
    "the value is lost",
    "export again",
    "", "ISO 10303-21 6.4.5"};

inline constexpr Rule complex_order{
    "SP-F30", "complex-order", Severity::Warning,
    "the parts of a complex instance come in alphabetical order, each once",
    "strict readers refuse the instance",
    "export again; the order does not matter here",
    "", "ISO 10303-21 10.2.5"};

inline constexpr Rule depth{
    "SP-F31", "depth", Severity::Error,
    "lists are not nested deeper than the ceiling",
    "no schema nests so deep; it is an attack or an accident",
    "look at the instance; it is left out",
    "", ""};

inline constexpr Rule encoding{
    "SP-F32", "encoding", Severity::Warning,
    "the file begins without a byte-order mark and is not UTF-16",
    "some readers refuse the first line",
    "save the file as plain ASCII or UTF-8 without a mark",
    "", "ISO 10303-21 6.2"};

inline constexpr Rule edition3{
    "SP-F33", "edition3", Severity::Info,
    "anchors and references of edition 3 are unambiguous; nothing outside the file is fetched",
    "parts of the product may be in other files",
    "read the other files too, or ask for one file that holds everything",
    "", "ISO 10303-21 ed. 3, 9 and 10"};

inline constexpr Rule signature{
    "SP-F34", "signature", Severity::Info,
    "a signature section is told, and is not verified",
    "a receiver may rely on a signature that edits have broken",
    "verify it with the program of the sender",
    "", "ISO 10303-21 ed. 3, 13"};

inline constexpr Rule container{
    "SP-F35", "container", Severity::Error,
    "a compressed file holds one Part 21 file that unpacks within the ceilings",
    "an archive can be made to fill any memory",
    "unpack it by hand and look at what it holds",
    "", "ISO 10303-21 ed. 3, annex"};

inline constexpr Rule user_defined{
    "SP-F36", "user-defined", Severity::Warning,
    "instances are of entities of the schema, not user-defined (!NAME)",
    "only the sender knows what it means",
    "nothing; it is kept as it stands",
    "", "ISO 10303-21 10.3"};

inline constexpr Rule multi_data{
    "SP-F37", "multi-data", Severity::Warning,
    "several DATA sections have names and schemas",
    "which schema governs which instances is not told",
    "nothing; one name space is taken for all",
    "", "ISO 10303-21 ed. 2, 10"};

inline constexpr Rule keyword_case{
    "SP-F38", "keyword-case", Severity::Warning,
    "keywords are in capitals",
    "strict readers refuse the file",
    "export again; case is ignored here",
    "", "ISO 10303-21 6.4"};

inline constexpr Rule header_missing{
    "SP-F39", "header-missing", Severity::Error,
    "a HEADER section comes first",
    "receivers cannot tell the schema",
    "export again; shapes are read here without it",
    "", "ISO 10303-21 8"};

// ---- What the schema asks of a record: SP-X..

inline constexpr Rule attribute_count{
    "SP-X04", "attribute-count", Severity::Error,
    "a record has as many attributes as its entity",
    "attributes are told by their place: with one missing the rest is misread",
    "export again; the record is left out where it matters",
    "", ""};

inline constexpr Rule attribute_type{
    "SP-X05", "attribute-type", Severity::Error,
    "an attribute holds a value or an instance of the kind its entity asks for",
    "the record cannot be used",
    "look at the record with `trimloop dump`; export again",
    "", ""};

inline constexpr Rule required_null{
    "SP-X06", "required-null", Severity::Error,
    "an attribute that must have a value has one",
    "the record cannot be used",
    "export again",
    "", ""};

inline constexpr Rule enum_value{
    "SP-X08", "enum-value", Severity::Error,
    "an enumeration has one of the values of its type",
    "what is meant cannot be told; the usual value is taken",
    "export again",
    "", ""};

inline constexpr Rule select_type{
    "SP-X09", "select-type", Severity::Error,
    "a value of a choice of types is written with its type, others without",
    "readers guess, and guess differently",
    "export again; the plain value is taken",
    "", ""};

inline constexpr Rule aggregate_bounds{
    "SP-X10", "aggregate-bounds", Severity::Error,
    "a list has as many members as its type allows",
    "the record cannot be used",
    "export again",
    "", ""};

inline constexpr Rule reference_cycle{
    "SP-X18", "reference-cycle", Severity::Error,
    "curves, surfaces and units are not built on themselves",
    "readers that follow the references never end",
    "export again; the instance is left out",
    "", ""};

// ---- Geometry and topology: SP-G..

inline constexpr Rule curve_sums{
    "SP-G01", "bspline-curve-sums", Severity::Error,
    "the multiplicities of a spline curve sum to degree + poles + 1, one for each knot",
    "the curve is not defined",
    "export again",
    "", "ISO 10303-42 4.5.40"};

inline constexpr Rule surface_sums{
    "SP-G02", "bspline-surface-sums", Severity::Error,
    "the multiplicities of a spline surface sum to degree + poles + 1 in each direction; its grid is rectangular",
    "the surface is not defined",
    "export again",
    "", "ISO 10303-42 4.5.80"};

inline constexpr Rule knots_order{
    "SP-G03", "knots-order", Severity::Error,
    "knots ascend",
    "the curve or surface is not defined",
    "export again",
    "", "ISO 10303-42"};

inline constexpr Rule weights{
    "SP-G04", "weights", Severity::Error,
    "there is a positive finite weight for each pole",
    "the shape has places at infinity, or none at all",
    "export again",
    "", "ISO 10303-42"};

inline constexpr Rule direction_zero{
    "SP-G07", "direction-zero", Severity::Error,
    "a direction has a length",
    "no axis can be made of it; a usual one is taken",
    "export again",
    "", "ISO 10303-42"};

inline constexpr Rule vector_magnitude{
    "SP-G08", "vector-magnitude", Severity::Error,
    "the magnitude of a vector is positive",
    "a line without speed has no points but one",
    "export again",
    "", "ISO 10303-42"};

inline constexpr Rule axis_parallel{
    "SP-G09", "axis-parallel", Severity::Error,
    "axis and reference direction of a placement are not parallel",
    "the placement is not defined about its axis; any direction is taken",
    "export again",
    "", "ISO 10303-42"};

inline constexpr Rule dimension_mix{
    "SP-G10", "dimension-mix", Severity::Error,
    "points and directions have the number of coordinates that their place asks for",
    "the shape cannot be placed",
    "export again",
    "", "ISO 10303-42"};

inline constexpr Rule conic_size{
    "SP-G11", "conic-size", Severity::Error,
    "radii, semi-axes and focal distances are positive",
    "the curve or surface is not defined",
    "export again",
    "mm", "ISO 10303-42"};

inline constexpr Rule cone_angle{
    "SP-G12", "cone-angle", Severity::Error,
    "the half angle of a cone lies between 0 and 90 degrees, its radius is not negative",
    "the surface is not defined",
    "export again",
    "", "ISO 10303-42"};

inline constexpr Rule torus_size{
    "SP-G13", "torus-size", Severity::Error,
    "the minor radius of a torus is below the major one, unless it is said to be degenerate",
    "the surface goes through itself",
    "export as a degenerate torus",
    "mm", "ISO 10303-42"};

inline constexpr Rule trimmed_curve{
    "SP-G14", "trimmed-curve", Severity::Error,
    "a trimmed curve has two different trims; point and parameter name one place",
    "which part of the curve is meant cannot be told",
    "export again",
    "mm", "ISO 10303-42"};

inline constexpr Rule composite_transition{
    "SP-G15", "composite-transition", Severity::Warning,
    "the segments of a composite curve meet",
    "the curve has gaps",
    "export again",
    "mm", "ISO 10303-42"};

inline constexpr Rule pcurve{
    "SP-G16", "pcurve", Severity::Error,
    "a parameter curve is a curve of two dimensions on a surface",
    "it cannot be used; the curve in space is",
    "export again",
    "", "ISO 10303-42"};

inline constexpr Rule surface_curve{
    "SP-G17", "surface-curve", Severity::Warning,
    "the parameter curve lies where the curve in space does",
    "receivers that trust the parameter curve get another border",
    "nothing; the curve in space is used here",
    "mm", "ISO 10303-42"};

inline constexpr Rule rectangular_trim{
    "SP-G18", "rectangular-trim", Severity::Error,
    "a rectangular trimmed surface has an extent in both directions",
    "the surface is empty",
    "export again",
    "", "ISO 10303-42"};

inline constexpr Rule swept_degenerate{
    "SP-G20", "swept-degenerate", Severity::Error,
    "a swept surface has an axis or direction and a curve to sweep",
    "the surface is not defined",
    "export again",
    "", "ISO 10303-42"};

inline constexpr Rule oriented_nesting{
    "SP-G21", "oriented-nesting", Severity::Error,
    "an oriented edge, face or shell refers to one that is not oriented itself",
    "readers give up, or follow a chain without end",
    "export again; the chain is followed to its end",
    "", "ISO 10303-42"};

inline constexpr Rule edge_vertices{
    "SP-G22", "edge-vertices", Severity::Warning,
    "the curve of an edge begins and ends at its vertices",
    "neighbouring faces do not meet there",
    "export with a tighter tolerance; the gap is measured and kept",
    "mm", "ISO 10303-42"};

inline constexpr Rule path_chain{
    "SP-G23", "path-chain", Severity::Error,
    "the edges of a loop go head to tail",
    "the loop does not close",
    "export again",
    "mm", "ISO 10303-42"};

inline constexpr Rule face_bounds{
    "SP-G24", "face-bounds", Severity::Error,
    "a face has at least one bound, and at most one outer bound",
    "what is inside cannot be told",
    "export again; the natural border of the surface is taken, or the largest loop",
    "", "ISO 10303-42"};

inline constexpr Rule shell_faces{
    "SP-G26", "shell-faces", Severity::Error,
    "a shell has faces, each once",
    "the shell is empty or goes twice over a face",
    "export again; repeats are left out",
    "", "ISO 10303-42"};

inline constexpr Rule closed_shell_edges{
    "SP-G27", "closed-shell-edges", Severity::Warning,
    "each edge of a closed shell is used twice, in opposite directions",
    "the solid is not closed: its volume and inside are not defined",
    "sew the shell, or export again",
    "", "ISO 10303-42"};

inline constexpr Rule void_orientation{
    "SP-G28", "void-orientation", Severity::Error,
    "the voids of a solid are not its outer shell and are oriented against it",
    "the void is filled or the solid is empty",
    "export again",
    "", "ISO 10303-42"};

inline constexpr Rule representation_context{
    "SP-G29", "representation-context", Severity::Warning,
    "a shape representation has a geometric context with units",
    "lengths have no unit; those of the rest of the file are taken",
    "export again",
    "", "ISO 10303-43"};

inline constexpr Rule units{
    "SP-G30", "units", Severity::Error,
    "length and angle units lead to a known one by factors that are finite and positive",
    "a wrong unit is a part of the wrong size",
    "give the unit with --assume-unit; millimetres and radians are taken",
    "", "ISO 10303-41"};

inline constexpr Rule uncertainty{
    "SP-G31", "uncertainty", Severity::Warning,
    "the stated uncertainty is positive and below a thousandth of the shape",
    "receivers that believe it close gaps that are not there, or none",
    "nothing; gaps are measured here",
    "mm", "ISO 10303-43"};

inline constexpr Rule tessellated{
    "SP-G32", "tessellated", Severity::Error,
    "tessellated items have coordinates, indices within them and 0, 1 or as many normals",
    "triangles are missing or fly through the model",
    "export again; what cannot be used is left out",
    "", "ISO 10303-42"};

// ---- Assembly and product: SP-A..

inline constexpr Rule assembly_cycle{
    "SP-A02", "assembly-cycle", Severity::Error,
    "no product contains itself",
    "the assembly never ends",
    "export again; the occurrence is left out",
    "", "ISO 10303-44"};

inline constexpr Rule occurrence_transform{
    "SP-A03", "occurrence-transform", Severity::Warning,
    "each occurrence of a product in an assembly has a placement",
    "where it sits is not told; it is put at the origin",
    "export again",
    "", "ISO 10303-44"};

inline constexpr Rule transform_quality{
    "SP-A04", "transform-quality", Severity::Warning,
    "a placement moves, turns, mirrors or scales evenly",
    "the part is deformed",
    "export again",
    "", ""};

inline constexpr Rule mapped_cycle{
    "SP-A05", "mapped-cycle", Severity::Error,
    "no mapped item maps a representation into itself",
    "the assembly never ends",
    "export again; the item is left out",
    "", "ISO 10303-43"};

inline constexpr Rule expansion{
    "SP-A06", "expansion", Severity::Error,
    "the assembly unfolds to fewer occurrences than the ceiling",
    "a small file can unfold to more than any machine holds",
    "raise the ceiling if the assembly is meant; what is beyond is left out",
    "occurrences", ""};

inline constexpr Rule shape_link{
    "SP-A08", "shape-link", Severity::Warning,
    "each shape belongs to a product or to another representation",
    "readers that start at products do not find it",
    "nothing; it is put at the top here",
    "", ""};

inline constexpr Rule context_mismatch{
    "SP-A09", "context-mismatch", Severity::Info,
    "representations of one file use one length unit",
    "receivers that read one unit for all scale a part wrongly",
    "nothing; each is read in its own",
    "", ""};

inline constexpr Rule placement_swapped{
    "SP-A10", "placement-swapped", Severity::Info,
    "the relationship of an occurrence names the child first and the parent second",
    "receivers that go by the order place the parent in the child",
    "nothing; the product structure and the owner of each placement decide here",
    "", "ISO 10303-43"};

inline constexpr Rule other_file{
    "SP-A11", "other-file", Severity::Warning,
    "the shapes of all products are in this file",
    "the part is empty here: its shape is in a file that is named and not opened",
    "read that file too, or ask for one file that holds everything",
    "", "MBx-IF external references"};

// ---- Validation properties: SP-V..

inline constexpr Rule property_unit{
    "SP-V03", "property-unit", Severity::Warning,
    "a validation property has a unit of the kind it needs",
    "it cannot be compared",
    "export again",
    "", "MBx-IF validation properties"};

inline constexpr Rule property_positive{
    "SP-V04", "non-positive", Severity::Warning,
    "stated volumes and areas are positive numbers",
    "they cannot be compared",
    "export again",
    "", "MBx-IF validation properties"};

inline constexpr Rule property_volume{
    "SP-V05", "volume", Severity::Warning,
    "the stated volume is the volume of the shape",
    "the shape is not what its sender had",
    "compare the shapes; something was lost or filled on the way",
    "mm3", "MBx-IF validation properties"};

inline constexpr Rule property_area{
    "SP-V06", "area", Severity::Warning,
    "the stated area is the area of the shape",
    "the shape is not what its sender had",
    "compare the shapes; a face may be missing or filled",
    "mm2", "MBx-IF validation properties"};

inline constexpr Rule property_centroid{
    "SP-V07", "centroid", Severity::Warning,
    "the stated centroid is the centroid of the shape",
    "the shape is not what its sender had, or sits elsewhere",
    "compare the shapes",
    "mm", "MBx-IF validation properties"};

// clang-format on

}  // namespace trimloop::step::rules
