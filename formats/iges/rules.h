#pragma once
// The rules of IGES files: cards, Global section, Directory, parameter text, references. What `trimloop explain` prints.
// The rules of each entity type are in rules_entities.h. Ids are never reused.

#include <span>

#include "base/report.h"

namespace trimloop::iges::rules {

// clang-format off (one text a line reads like the table it is)

// Every rule of both headers, in the order of this file and then of rules_entities.h.
std::span<const Rule* const> all();

// ---- Cards and sections: IG-F.. (2.2)

inline constexpr Rule not_iges{
    "IG-F01", "not-iges", Severity::Fatal,
    "the file has cards whose column 73 names a section (S, G, D, P, T)",
    "without sections there is nothing an IGES reader can hold on to",
    "check that this is the right file; export it again as IGES 5.3, fixed ASCII",
    "", "IGES 5.3 2.2"};

inline constexpr Rule representation{
    "IG-F02", "representation", Severity::Fatal,
    "the file is in the fixed ASCII form, not compressed ASCII or binary",
    "both other forms are obsolete and this version does not read them",
    "convert it with the program that wrote it, or export again as fixed ASCII",
    "", "IGES 5.3 2.2"};

inline constexpr Rule card_length{
    "IG-F03", "card-length", Severity::Warning,
    "every card has 80 columns",
    "readers that count columns take data from the wrong place",
    "`trimloop fix` pads short cards; look at what stands beyond column 80",
    "columns", "IGES 5.3 2.2"};

inline constexpr Rule section_letter{
    "IG-F04", "section-letter", Severity::Error,
    "column 73 of every card before Terminate is S, G, D, P or T",
    "the card belongs to no section and most readers skip it or stop",
    "look at the named card; it may be shifted or come from another file",
    "", "IGES 5.3 2.2"};

inline constexpr Rule section_order{
    "IG-F05", "section-order", Severity::Error,
    "sections come in the order Start, Global, Directory, Parameter, Terminate",
    "many readers stop at the first card of an earlier section",
    "put the sections in order, or export again",
    "", "IGES 5.3 2.2"};

inline constexpr Rule sequence_number{
    "IG-F06", "sequence-number", Severity::Warning,
    "columns 74-80 count the cards of each section from 1 without a gap",
    "pointers are sequence numbers: with wrong ones an entity finds somebody else's data",
    "`trimloop fix` numbers the cards anew; check the entities named in other findings",
    "", "IGES 5.3 2.2"};

inline constexpr Rule sequence_justify{
    "IG-F07", "sequence-justify", Severity::Info,
    "sequence numbers stand at the right of columns 74-80, padded with blanks",
    "a few old readers take a left-justified number for another one",
    "`trimloop fix` aligns them",
    "", "IGES 5.3 2.2"};

inline constexpr Rule line_ending_mix{
    "IG-F08", "line-ending-mix", Severity::Info,
    "all lines end in the same way, and there are line ends",
    "other programs may see one long line, or empty lines",
    "`trimloop fix` writes one kind of line end",
    "", "IGES 5.3 2.2"};

inline constexpr Rule non_ascii{
    "IG-F09", "non-ascii", Severity::Warning,
    "all bytes are printing ASCII characters",
    "names come out garbled, and multi-byte characters shift columns",
    "write names in ASCII, or accept the loss of these characters",
    "", "IGES 5.3 2.2.2.3"};

inline constexpr Rule tab{
    "IG-F10", "tab", Severity::Warning,
    "columns are filled with blanks, not with tabs",
    "a tab counts as one column for one reader and as eight for another",
    "replace tabs by blanks at the width the sender meant",
    "", "IGES 5.3 2.2"};

inline constexpr Rule leading_junk{
    "IG-F11", "leading-junk", Severity::Warning,
    "the first card is the first thing in the file",
    "readers that take the first line for a card refuse the whole file",
    "`trimloop fix` removes what stands before the first card",
    "", "IGES 5.3 2.2"};

inline constexpr Rule after_terminate{
    "IG-F12", "after-terminate", Severity::Warning,
    "nothing follows the Terminate card",
    "it may be a second file glued on, whose content is not read",
    "`trimloop fix` removes it; split the file first if it holds two",
    "", "IGES 5.3 2.2.4.6"};

inline constexpr Rule terminate_missing{
    "IG-F13", "terminate-missing", Severity::Error,
    "the file ends with a Terminate card",
    "the file may have been cut off, and strict readers refuse it",
    "check that the transfer was complete; `trimloop fix` adds the card",
    "", "IGES 5.3 2.2.4.6"};

inline constexpr Rule terminate_counts{
    "IG-F14", "terminate-counts", Severity::Warning,
    "the counts on the Terminate card are the numbers of cards of each section",
    "the difference often means that cards were lost or added after export",
    "check that the file is complete; `trimloop fix` corrects the counts",
    "cards", "IGES 5.3 2.2.4.6"};

inline constexpr Rule terminate_repeat{
    "IG-F15", "terminate-repeat", Severity::Error,
    "there is one Terminate card",
    "two files were probably joined; only the first is read",
    "split the file at the first Terminate card",
    "", "IGES 5.3 2.2.4.6"};

inline constexpr Rule empty_section{
    "IG-F16", "empty-section", Severity::Error,
    "Directory and Parameter sections have cards",
    "the file carries no model",
    "export again with geometry selected",
    "", "IGES 5.3 2.2"};

inline constexpr Rule directory_odd{
    "IG-F17", "directory-odd", Severity::Error,
    "the Directory has two cards for each entity",
    "the last entity is incomplete and pointers after a lost card are off by one",
    "export again; a card is missing or was added",
    "", "IGES 5.3 2.2.4.4"};

inline constexpr Rule truncated{
    "IG-F18", "truncated", Severity::Error,
    "the file does not end inside a card or a record",
    "what came after the cut is lost",
    "transfer the file again in binary mode and compare sizes",
    "", "IGES 5.3 2.2"};

inline constexpr Rule start_missing{
    "IG-F19", "start-missing", Severity::Warning,
    "there is a Start section",
    "strict readers refuse the file",
    "`trimloop fix` adds an empty Start card",
    "", "IGES 5.3 2.2.4.2"};

inline constexpr Rule column_shift{
    "IG-F20", "column-shift", Severity::Warning,
    "Directory fields stand in their own 8 columns",
    "readers disagree about the value of a field that straddles two",
    "export again; the sender misplaced this card",
    "", "IGES 5.3 2.2.4.4"};

inline constexpr Rule merged_cards{
    "IG-F21", "merged-cards", Severity::Warning,
    "each card stands on its own line",
    "line-based readers lose all but the first card",
    "`trimloop fix` gives every card its line",
    "", "IGES 5.3 2.2"};

inline constexpr Rule pd_column65{
    "IG-F22", "pd-column65", Severity::Info,
    "column 65 of Parameter cards is blank",
    "some readers take the character for data, others for part of the back pointer",
    "`trimloop fix` moves it",
    "", "IGES 5.3 2.2.4.5"};

// ---- Global section: IG-G.. (2.2.4.3)

inline constexpr Rule global_missing{
    "IG-G01", "global-missing", Severity::Fatal,
    "there is a Global section with readable fields",
    "delimiters, units and scale are unknown, so nothing can be read safely",
    "export again; the file has lost its Global section",
    "", "IGES 5.3 2.2.4.3"};

inline constexpr Rule param_delimiter{
    "IG-G02", "param-delimiter", Severity::Error,
    "the parameter delimiter is a character that cannot be part of a value",
    "no parameter can be told from the next",
    "export with the usual comma",
    "", "IGES 5.3 2.2.4.3.1"};

inline constexpr Rule record_delimiter{
    "IG-G03", "record-delimiter", Severity::Error,
    "the record delimiter is a character that cannot be part of a value",
    "no record can be told from the next",
    "export with the usual semicolon",
    "", "IGES 5.3 2.2.4.3.2"};

inline constexpr Rule delimiters_equal{
    "IG-G04", "delimiters-equal", Severity::Fatal,
    "parameter and record delimiter differ",
    "the end of a record cannot be found",
    "export with comma and semicolon",
    "", "IGES 5.3 2.2.4.3"};

inline constexpr Rule global_field_count{
    "IG-G05", "field-count", Severity::Warning,
    "the Global section has 24 to 26 fields",
    "missing fields take their defaults, which may not be what the sender meant",
    "check units and scale; `trimloop fix` completes the section",
    "fields", "IGES 5.3 2.2.4.3"};

inline constexpr Rule global_not_terminated{
    "IG-G06", "not-terminated", Severity::Fatal,
    "the Global record ends with the record delimiter",
    "fields are missing or misread, so that units cannot be trusted",
    "export again; part of the Global section is lost",
    "", "IGES 5.3 2.2.4.3"};

inline constexpr Rule global_hollerith{
    "IG-G07", "hollerith", Severity::Fatal,
    "the character counts of Global strings agree with their text",
    "all fields after a wrong count are read from the wrong place",
    "correct the count before H, or export again",
    "characters", "IGES 5.3 2.2.2.3"};

inline constexpr Rule global_field_type{
    "IG-G08", "field-type", Severity::Error,
    "every Global field has the type its place asks for",
    "the default is used instead, which may not be what the sender meant",
    "correct the field, or export again",
    "", "IGES 5.3 2.2.4.3"};

inline constexpr Rule integer_bits{
    "IG-G09", "integer-bits", Severity::Warning,
    "field 7 gives a believable integer size, 8 to 128 bits",
    "it says how large pointers and counts may be",
    "harmless if no integer finding follows",
    "bits", "IGES 5.3 2.2.4.3.7"};

inline constexpr Rule single_precision{
    "IG-G10", "single-precision", Severity::Warning,
    "fields 8 and 9 (single precision) are positive",
    "receivers use them to judge how many digits count",
    "`trimloop fix` writes 38 and 6",
    "", "IGES 5.3 2.2.4.3.8"};

inline constexpr Rule double_precision{
    "IG-G11", "double-precision", Severity::Warning,
    "fields 10 and 11 (double precision) are positive",
    "receivers use them to judge how many digits count",
    "`trimloop fix` writes 308 and 15",
    "", "IGES 5.3 2.2.4.3.10"};

inline constexpr Rule significance{
    "IG-G12", "significance", Severity::Info,
    "literals carry no more digits than fields 9 and 11 declare",
    "a receiver may round the surplus digits away",
    "raise the declared digits",
    "", "IGES 5.3 2.2.4.3.11"};

inline constexpr Rule magnitude{
    "IG-G13", "magnitude", Severity::Warning,
    "literals stay below the declared power of ten",
    "a receiver may overflow",
    "raise fields 8 and 10",
    "", "IGES 5.3 2.2.4.3.10"};

inline constexpr Rule model_scale{
    "IG-G14", "model-scale", Severity::Error,
    "field 13 (model scale) is positive and finite",
    "lengths are divided by it: a wrong value makes the model huge, tiny or nothing",
    "set it to 1.0, or export again",
    "", "IGES 5.3 2.2.4.3.13"};

inline constexpr Rule units_flag{
    "IG-G15", "units-flag", Severity::Error,
    "field 14 (unit flag) is 1 to 11",
    "the size of the model is unknown",
    "say the unit with --assume-unit, and tell the sender",
    "", "IGES 5.3 2.2.4.3.14"};

inline constexpr Rule units_name{
    "IG-G16", "units-name", Severity::Warning,
    "field 15 (unit name) agrees with the unit flag",
    "readers disagree: most follow the flag, some the name, and the model is 25.4 times off",
    "`trimloop fix` corrects it; check one known length; the flag is followed here",
    "", "IGES 5.3 2.2.4.3.15"};

inline constexpr Rule units_custom{
    "IG-G17", "units-custom", Severity::Error,
    "unit flag 3 comes with a known unit name",
    "the size of the model is unknown",
    "say the unit with --assume-unit",
    "", "IGES 5.3 2.2.4.3.15"};

inline constexpr Rule weight_gradations{
    "IG-G18", "weight-gradations", Severity::Warning,
    "field 16 (line weight steps) is at least 1",
    "line widths cannot be computed",
    "`trimloop fix` writes 1",
    "", "IGES 5.3 2.2.4.3.16"};

inline constexpr Rule max_line_width{
    "IG-G19", "max-line-width", Severity::Warning,
    "field 17 (thickest line) is positive",
    "line widths cannot be computed; the geometry is not touched",
    "harmless for geometry",
    "", "IGES 5.3 2.2.4.3.17"};

inline constexpr Rule date_format{
    "IG-G20", "date-format", Severity::Warning,
    "dates read YYYYMMDD.HHNNSS or YYMMDD.HHNNSS and exist in the calendar",
    "strict readers stop here, and the age of the file is unknown",
    "write it as YYYYMMDD.HHNNSS",
    "", "IGES 5.3 2.2.4.3.18"};

inline constexpr Rule date_order{
    "IG-G21", "date-order", Severity::Info,
    "the model was not changed after the file was written",
    "one of the dates is wrong, or the file was edited",
    "check that this is the version you expect",
    "", "IGES 5.3 2.2.4.3.25"};

inline constexpr Rule resolution_missing{
    "IG-G22", "resolution-missing", Severity::Warning,
    "field 19 (resolution) is positive",
    "nothing says how large a gap the sender takes for none",
    "0.001 mm is used; ask the sender for the resolution",
    "model units", "IGES 5.3 2.2.4.3.19"};

inline constexpr Rule resolution_implausible{
    "IG-G23", "resolution-implausible", Severity::Warning,
    "field 19 (resolution) lies between 1e-9 and 0.1 mm",
    "too coarse: separate points count as one; too fine: nothing joins",
    "0.001 mm is used instead; ask the sender for the modelling tolerance",
    "mm", "IGES 5.3 2.2.4.3.19"};

inline constexpr Rule max_coordinate_low{
    "IG-G24", "max-coordinate-low", Severity::Warning,
    "no coordinate is larger than field 20 says",
    "receivers that size their space by it cut the model",
    "set it to the real extent",
    "model units", "IGES 5.3 2.2.4.3.20"};

inline constexpr Rule max_coordinate_high{
    "IG-G25", "max-coordinate-high", Severity::Info,
    "field 20 is not a thousand times the real extent",
    "receivers that derive a tolerance from it work too coarsely",
    "set it to the real extent",
    "model units", "IGES 5.3 2.2.4.3.20"};

inline constexpr Rule version_flag{
    "IG-G26", "version-flag", Severity::Warning,
    "field 23 (version) is 1 to 11",
    "strict readers refuse unknown versions",
    "`trimloop fix` writes the version in effect",
    "", "IGES 5.3 2.2.4.3.23"};

inline constexpr Rule version_content{
    "IG-G27", "version-content", Severity::Info,
    "no entity is younger than the declared version",
    "old readers skip what their version does not know",
    "declare version 11 (5.3)",
    "", "IGES 5.3 2.2.4.3.23"};

inline constexpr Rule drafting_flag{
    "IG-G28", "drafting-flag", Severity::Warning,
    "field 24 (drafting standard) is 0 to 7",
    "annotation may be read by another standard",
    "`trimloop fix` writes 0",
    "", "IGES 5.3 2.2.4.3.24"};

inline constexpr Rule provenance_empty{
    "IG-G29", "provenance-empty", Severity::Hint,
    "sender, file name, system, author and organisation are filled in",
    "nobody can tell later where the file came from",
    "fill in the export options",
    "", "IGES 5.3 2.2.4.3"};

inline constexpr Rule subset_claim{
    "IG-G30", "subset-claim", Severity::Warning,
    "the content stays within the subset that the file claims",
    "a receiver built for the subset skips the rest",
    "remove the claim, or the entities outside it",
    "", "IGES 5.3 2.2.4.3.26"};

// ---- Directory entries: IG-D.. (2.2.4.4)

inline constexpr Rule type_twice{
    "IG-D01", "type-twice", Severity::Error,
    "both cards of a Directory entry name the same type",
    "readers differ in which one they believe",
    "`trimloop fix` corrects it; export again; the cards may be out of step",
    "", "IGES 5.3 2.2.4.4.1"};

inline constexpr Rule type_unknown{
    "IG-D02", "type-unknown", Severity::Warning,
    "the entity type is in the standard or in the implementor range",
    "the entity is kept as it is but cannot be shown",
    "ask the sender what it is, or export without it",
    "", "IGES 5.3 2.2.4.4.1"};

inline constexpr Rule type_obsolete{
    "IG-D03", "type-obsolete", Severity::Info,
    "the entity type is current",
    "few receivers still read it",
    "export its successor if the sender can",
    "", "IGES 5.3 2.2.4.4.1"};

inline constexpr Rule form_number{
    "IG-D04", "form-number", Severity::Error,
    "the form number exists for the entity type",
    "readers guess another meaning, or skip the entity",
    "correct field 15",
    "", "IGES 5.3 2.2.4.4.15"};

inline constexpr Rule pd_pointer{
    "IG-D05", "pd-pointer", Severity::Error,
    "field 2 points at the entity's first Parameter card",
    "the entity's data cannot be found, or are somebody else's",
    "export again; sequence numbers may have been damaged",
    "", "IGES 5.3 2.2.4.4.2"};

inline constexpr Rule pd_line_count{
    "IG-D06", "pd-line-count", Severity::Warning,
    "field 14 counts the entity's Parameter cards",
    "readers that trust it cut the record or run into the next one",
    "`trimloop fix` corrects it",
    "cards", "IGES 5.3 2.2.4.4.14"};

inline constexpr Rule pd_back_pointer{
    "IG-D07", "pd-back-pointer", Severity::Warning,
    "columns 66-72 of Parameter cards name their Directory entry",
    "readers that start from the cards give the data to another entity",
    "`trimloop fix` corrects them",
    "", "IGES 5.3 2.2.4.5"};

inline constexpr Rule pd_shared{
    "IG-D08", "pd-shared", Severity::Error,
    "no two entries own the same Parameter cards",
    "one of them shows the other's geometry",
    "export again; Directory pointers are damaged",
    "", "IGES 5.3 2.2.4.4.2"};

inline constexpr Rule pd_orphan{
    "IG-D09", "pd-orphan", Severity::Warning,
    "every Parameter card belongs to an entry",
    "data are in the file that no entity uses: something may have been lost",
    "compare with the sender's model",
    "", "IGES 5.3 2.2.4.5"};

inline constexpr Rule pd_first_token{
    "IG-D10", "pd-first-token", Severity::Error,
    "the first parameter repeats the entity type",
    "the record is probably another entity's",
    "export again; pointers are damaged",
    "", "IGES 5.3 2.2.4.5"};

inline constexpr Rule structure{
    "IG-D11", "structure", Severity::Warning,
    "field 3 is set only where the type has a use for it",
    "some readers refuse the entity",
    "`trimloop fix` writes 0",
    "", "IGES 5.3 2.2.4.4.3"};

inline constexpr Rule line_font{
    "IG-D12", "line-font", Severity::Warning,
    "field 4 is 0 to 5 or points to a line font (304)",
    "lines are drawn solid",
    "`trimloop fix` writes 0",
    "", "IGES 5.3 2.2.4.4.4"};

inline constexpr Rule level{
    "IG-D13", "level", Severity::Warning,
    "a negative field 5 points to a level list (406 form 1)",
    "the entity shows up on the wrong layer",
    "correct field 5",
    "", "IGES 5.3 2.2.4.4.5"};

inline constexpr Rule view{
    "IG-D14", "view", Severity::Error,
    "field 6 points to a view (410) or a view list (402)",
    "the entity may be shown where it should not be",
    "set it to 0 for all views",
    "", "IGES 5.3 2.2.4.4.6"};

inline constexpr Rule transform{
    "IG-D15", "transform", Severity::Error,
    "field 7 points to a transformation matrix (124)",
    "the entity's place in space is unknown",
    "export again; the matrix is missing",
    "", "IGES 5.3 2.2.4.4.7"};

inline constexpr Rule label_display{
    "IG-D16", "label-display", Severity::Error,
    "field 8 points to a label display associativity (402 form 5)",
    "labels are misplaced; geometry is not touched",
    "set it to 0",
    "", "IGES 5.3 2.2.4.4.8"};

inline constexpr Rule status_format{
    "IG-D17", "status-format", Severity::Warning,
    "field 9 holds four two-digit numbers",
    "visibility and dependence are guessed",
    "`trimloop fix` writes the digits as understood",
    "", "IGES 5.3 2.2.4.4.9"};

inline constexpr Rule blank_status{
    "IG-D18", "blank-status", Severity::Warning,
    "the blank status is 00 or 01",
    "the entity is shown though it may be hidden",
    "set it to 00 (visible) or 01 (hidden)",
    "", "IGES 5.3 2.2.4.4.9.1"};

inline constexpr Rule subordinate{
    "IG-D19", "subordinate", Severity::Warning,
    "the subordinate switch is 00 to 03",
    "a part of another entity may appear as one of its own",
    "set it to the value that fits",
    "", "IGES 5.3 2.2.4.4.9.2"};

inline constexpr Rule use_flag{
    "IG-D20", "use-flag", Severity::Warning,
    "the use flag is 00 to 06",
    "construction or annotation may be taken for geometry",
    "set it to 00 for geometry",
    "", "IGES 5.3 2.2.4.4.9.3"};

inline constexpr Rule hierarchy{
    "IG-D21", "hierarchy", Severity::Warning,
    "the hierarchy flag is 00 to 02",
    "colours and layers of parts may be wrong",
    "set it to 00, 01 or 02",
    "", "IGES 5.3 2.2.4.4.9.4"};

inline constexpr Rule status_required{
    "IG-D22", "status-required", Severity::Warning,
    "the status fits the entity type (05 for parameter-space curves, 02 for definitions, ...)",
    "a receiver may show helper curves as geometry",
    "export again; readers may take the entity for another kind",
    "", "IGES 5.3 2.2.4.4.9"};

inline constexpr Rule dependence{
    "IG-D23", "dependence", Severity::Warning,
    "entities that others own are marked dependent, and only those",
    "parts appear twice, or not at all",
    "export again, or set the switch with an editor of the Directory",
    "", "IGES 5.3 2.2.4.4.9.2"};

inline constexpr Rule line_weight{
    "IG-D24", "line-weight", Severity::Warning,
    "field 12 does not exceed the number of line weights",
    "the line is drawn with another width",
    "raise Global field 16",
    "", "IGES 5.3 2.2.4.4.12"};

inline constexpr Rule colour{
    "IG-D25", "colour", Severity::Warning,
    "field 13 is 0 to 8 or points to a colour definition (314)",
    "the entity is drawn in a default colour",
    "`trimloop fix` corrects it; correct field 13",
    "", "IGES 5.3 2.2.4.4.13"};

inline constexpr Rule reserved{
    "IG-D26", "reserved", Severity::Info,
    "fields 16 and 17 are blank",
    "they have no meaning and are ignored",
    "`trimloop fix` corrects it; harmless",
    "", "IGES 5.3 2.2.4.4.16"};

inline constexpr Rule label{
    "IG-D27", "label", Severity::Hint,
    "labels have at most 8 characters and stand at the right of field 18",
    "some readers cut them",
    "harmless",
    "", "IGES 5.3 2.2.4.4.18"};

inline constexpr Rule subscript{
    "IG-D28", "subscript", Severity::Warning,
    "field 19 is an integer",
    "two entities with one label cannot be told apart",
    "correct field 19",
    "", "IGES 5.3 2.2.4.4.19"};

inline constexpr Rule label_duplicate{
    "IG-D29", "label-duplicate", Severity::Hint,
    "label and subscript are unique",
    "names of parts are ambiguous",
    "number them",
    "", "IGES 5.3 2.2.4.4.18"};

inline constexpr Rule field_syntax{
    "IG-D30", "field-syntax", Severity::Error,
    "numeric Directory fields hold numbers only",
    "readers take different values from the same characters",
    "correct the field, or export again",
    "", "IGES 5.3 2.2.4.4"};

inline constexpr Rule pairing{
    "IG-D31", "pairing", Severity::Error,
    "an entry's first card has an odd sequence number and the next one follows it",
    "pointers reach the wrong entity",
    "export again; a Directory card is missing or doubled",
    "", "IGES 5.3 2.2.4.4"};

inline constexpr Rule pointer_sign{
    "IG-D32", "pointer-sign", Severity::Error,
    "Directory pointers have the sign that their field asks for",
    "readers take it for a number, or reject the entity",
    "`trimloop fix` turns the sign where the target proves it",
    "", "IGES 5.3 2.2.4.4"};

inline constexpr Rule null_entity{
    "IG-D33", "null-entity", Severity::Info,
    "the entity has a type other than 0",
    "a null entity is a place holder, often something that was deleted",
    "harmless",
    "", "IGES 5.3 4.1"};

inline constexpr Rule ignored_attribute{
    "IG-D34", "ignored-attribute", Severity::Hint,
    "graphic attributes are given only where the type uses them",
    "they have no effect",
    "harmless",
    "", "IGES 5.3 2.2.4.4"};

// ---- Parameter text: IG-P.. (2.2.4.5)

inline constexpr Rule unterminated{
    "IG-P01", "unterminated", Severity::Error,
    "every record ends with the record delimiter",
    "the record may be cut, or run into the next one",
    "export again; check that the transfer was complete",
    "", "IGES 5.3 2.2.4.5"};

inline constexpr Rule too_few{
    "IG-P02", "too-few", Severity::Error,
    "required parameters are present",
    "the entity cannot be built",
    "export again; the record is cut or of another form",
    "", "IGES 5.3 2.2.3"};

inline constexpr Rule too_many{
    "IG-P03", "too-many", Severity::Warning,
    "nothing is left after an entity's parameters and its two pointer groups",
    "the record may be of another form, or misread",
    "check the entity in the result",
    "", "IGES 5.3 2.2.4.5.2"};

inline constexpr Rule integer_expected{
    "IG-P04", "integer", Severity::Error,
    "an integer stands where one is due",
    "counts, flags and pointers cannot be guessed",
    "correct the value, or export again",
    "", "IGES 5.3 2.2.2.1"};

inline constexpr Rule real_expected{
    "IG-P05", "real", Severity::Error,
    "a real number stands where one is due",
    "the geometry is unknown",
    "correct the value, or export again",
    "", "IGES 5.3 2.2.2.2"};

inline constexpr Rule real_syntax{
    "IG-P06", "real-syntax", Severity::Error,
    "real numbers are spelt as the standard has it",
    "readers stop at different characters and see different values",
    "correct the number; a comma as decimal mark needs a new export",
    "", "IGES 5.3 2.2.2.2"};

inline constexpr Rule real_range{
    "IG-P07", "real-range", Severity::Error,
    "real numbers fit in double precision",
    "the value becomes infinite, or zero",
    "correct the number; it is probably a fault of the sender",
    "", "IGES 5.3 2.2.2.2"};

inline constexpr Rule nan_inf{
    "IG-P08", "nan-inf", Severity::Error,
    "real numbers are numbers, not NAN, INF or asterisks",
    "the sender's own computation had failed there",
    "repair the model at the sender",
    "", "IGES 5.3 2.2.2.2"};

inline constexpr Rule integer_range{
    "IG-P09", "integer-range", Severity::Error,
    "integers fit in the declared bits",
    "counts and pointers wrap around to something else",
    "correct the number",
    "", "IGES 5.3 2.2.2.1"};

inline constexpr Rule logical_expected{
    "IG-P10", "logical", Severity::Error,
    "logical values are 0 or 1",
    "orientation or closure is unknown",
    "correct the value",
    "", "IGES 5.3 2.2.2.6"};

inline constexpr Rule hollerith{
    "IG-P11", "hollerith", Severity::Error,
    "the character count of a string agrees with its text",
    "everything after it is read from the wrong place",
    "correct the count before H",
    "characters", "IGES 5.3 2.2.2.3"};

inline constexpr Rule string_bytes{
    "IG-P12", "string-bytes", Severity::Warning,
    "strings hold printing ASCII characters",
    "names come out garbled",
    "write names in ASCII",
    "", "IGES 5.3 2.2.2.3"};

inline constexpr Rule token_split{
    "IG-P13", "token-split", Severity::Warning,
    "no number runs over the end of a card",
    "readers that work card by card see two numbers",
    "`trimloop fix --set` of the same value moves it to one card",
    "", "IGES 5.3 2.2.3"};

inline constexpr Rule comment_after_record{
    "IG-P14", "comment-ok", Severity::Info,
    "text after the record delimiter is a comment and is kept",
    "none: it is legal; some readers reject it",
    "nothing to do",
    "", "IGES 5.3 2.2.4.5.3"};

inline constexpr Rule group_counts{
    "IG-P15", "group-counts", Severity::Error,
    "the counts of associativity and property pointers agree with the pointers",
    "names, colours and groups are lost or misread",
    "correct the counts",
    "", "IGES 5.3 2.2.4.5.2"};

inline constexpr Rule group_targets{
    "IG-P16", "group-targets", Severity::Warning,
    "the pointer groups reach associativities, notes and properties",
    "names and groups may be attached to the wrong thing",
    "export again",
    "", "IGES 5.3 2.2.4.5.2"};

inline constexpr Rule count_over{
    "IG-P17", "count-over", Severity::Error,
    "a list count does not exceed the parameters present",
    "the list is incomplete, or the count damaged; nothing is allocated for it",
    "export again; the record is cut or damaged",
    "entries", "IGES 5.3 2.2.3"};

inline constexpr Rule count_negative{
    "IG-P18", "count-negative", Severity::Error,
    "a list count is not below its minimum",
    "the list cannot be read",
    "correct the count",
    "entries", "IGES 5.3 2.2.3"};

inline constexpr Rule delimiter_drift{
    "IG-P19", "delimiter-drift", Severity::Error,
    "records use the delimiters that the Global section declares",
    "the whole record reads as one value",
    "export again with one set of delimiters",
    "", "IGES 5.3 2.2.4.3.1"};

inline constexpr Rule letter_case{
    "IG-P20", "letter-case", Severity::Info,
    "H, D and E are capital letters",
    "a few readers know only capitals",
    "`trimloop fix` writes capitals",
    "", "IGES 5.3 2.2.2"};

inline constexpr Rule boundary_ambiguous{
    "IG-P21", "boundary-ambiguous", Severity::Warning,
    "there is one place only where the pointer groups can start",
    "pointers may be taken for parameters, or the other way round",
    "tell us about the file: the type needs a table",
    "", "IGES 5.3 2.2.4.5.2"};

// ---- References: IG-R.. (2.2.2.4)

inline constexpr Rule dangling{
    "IG-R01", "dangling", Severity::Error,
    "pointers reach an entry of the Directory",
    "the part it stands for is missing",
    "export again; the entity was not written",
    "", "IGES 5.3 2.2.2.4"};

inline constexpr Rule even_pointer{
    "IG-R02", "even-pointer", Severity::Error,
    "pointers name the first (odd) card of an entry",
    "readers differ: some take the entry, some the next, some none",
    "correct the pointer",
    "", "IGES 5.3 2.2.2.4"};

inline constexpr Rule target_type{
    "IG-R03", "target-type", Severity::Error,
    "a pointer reaches a type that its field admits",
    "the entity cannot be built",
    "export again; pointers are damaged or the sender is at fault",
    "", "IGES 5.3 2.2.2.4"};

inline constexpr Rule cycle{
    "IG-R04", "cycle", Severity::Error,
    "no entity is part of itself",
    "a careless reader never ends",
    "break the circle named here; export again",
    "", "IGES 5.3 2.2.2.4"};

inline constexpr Rule transform_cycle{
    "IG-R05", "transform-cycle", Severity::Error,
    "a chain of matrices ends, within the depth limit",
    "the entity's place in space is undefined",
    "export again",
    "depth", "IGES 5.3 4.21"};

inline constexpr Rule subfigure_depth{
    "IG-R06", "subfigure-depth", Severity::Warning,
    "the stated nesting depth of a subfigure is the real one",
    "readers that reserve by it fail",
    "`trimloop fix --set` writes the real depth",
    "levels", "IGES 5.3 4.74"};

inline constexpr Rule subfigure_self{
    "IG-R07", "subfigure-self", Severity::Error,
    "no subfigure contains itself",
    "it would be infinite",
    "break the circle; export again",
    "", "IGES 5.3 4.74"};

inline constexpr Rule expansion_bomb{
    "IG-R08", "expansion-bomb", Severity::Error,
    "instances multiply to no more than the limit",
    "the model would fill all memory",
    "raise --limit-instances if it is meant",
    "instances", "IGES 5.3 4.74"};

inline constexpr Rule orphan_dependent{
    "IG-R09", "orphan-dependent", Severity::Warning,
    "every dependent entity is used by another",
    "geometry is in the file that no receiver shows",
    "compare with the sender's model",
    "", "IGES 5.3 2.2.4.4.9.2"};

inline constexpr Rule shared_child{
    "IG-R10", "shared-child", Severity::Warning,
    "a physically dependent entity has one owner",
    "moving or deleting one owner damages the other",
    "copy it at the sender, one for each owner",
    "", "IGES 5.3 2.2.4.4.9.2"};

inline constexpr Rule back_pointer{
    "IG-R11", "back-pointer", Severity::Warning,
    "members point back to associativities that ask for it",
    "the group is found from one side only",
    "export again with the pointers back",
    "", "IGES 5.3 2.2.4.5.2"};

inline constexpr Rule external_ref{
    "IG-R12", "external-ref", Severity::Warning,
    "external references name a plain file that is there",
    "parts of the model are missing; a path could reach private files and is never opened",
    "put the file beside this one and name it without a path",
    "", "IGES 5.3 4.138"};

inline constexpr Rule duplicate_entity{
    "IG-R13", "duplicate-entity", Severity::Warning,
    "no entity is in the file twice",
    "faces lie on each other, and area and volume count double",
    "remove the copy at the sender",
    "", ""};

inline constexpr Rule group_null{
    "IG-R14", "group-null", Severity::Warning,
    "groups have no empty members",
    "a careless reader crashes",
    "export again without them",
    "", "IGES 5.3 4.79"};

inline constexpr Rule drawing_view{
    "IG-R15", "drawing-view", Severity::Warning,
    "drawings, views and the entities' view fields agree",
    "entities appear in the wrong view",
    "correct the drawing",
    "", "IGES 5.3 4.97"};

}  // namespace trimloop::iges::rules

#include "formats/iges/rules_entities.h"  // IWYU pragma: export
