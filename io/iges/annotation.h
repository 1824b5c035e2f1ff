#pragma once
// Drafting entities (106 forms 20-40, 202-230) -> strokes and runs of text; drawings and views (404, 410).

#include "io/iges/context.h"

namespace trimloop::io::iges_import {

bool is_annotation(const DirectoryEntry&);  // 106:20-40, 202 204 206 208 210 212 213 214 216 218 220 222 228 230

// All that one drafting entity shows, its parts included. Empty after a finding.
Annotation read_annotation(Context& context, const DirectoryEntry& entry);

// Fills Model::views and Model::drawings. `attributes` gives those of an entity, in the model's table.
void read_drawings(Context& context, Model& model);

}  // namespace trimloop::io::iges_import
