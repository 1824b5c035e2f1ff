#pragma once
// Annotation, views and drawings -> 212, 228, 410 and 404.

#include "io/iges/entity_writer.h"

namespace trimloop::io::iges_export {

// Strokes as linear paths (106 form 12) of a general symbol (228), texts as general notes (212); texts alone are a note. A
// 212 lies in one plane: runs in other planes go into entities of their own. What it was besides (a dimension of
// something) is a loss, told by `kinds_lost`. Empty when there is nothing to write.
std::vector<iges::Ref> write_annotation(EntityWriter&, const Annotation&, Role role, std::map<std::string, std::size_t>& kinds_lost);

// Views and the sheets that they lie on.
void write_drawings(EntityWriter&, std::map<std::string, std::size_t>& kinds_lost);

// The names of layers: 406 form 3 on each level.
void write_layer_names(EntityWriter&);

}  // namespace trimloop::io::iges_export
