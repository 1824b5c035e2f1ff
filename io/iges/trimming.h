#pragma once
// Faces of trimmed surfaces: 144 with 142, 143 with 141, bounded planes (108), surfaces on their own.
// Which of two redundant curves is trusted and what is done about missing, open or contradicting loops is written down in
// docs/trim-policy.md; every choice taken becomes a finding.

#include "io/iges/context.h"
#include "kernel/heal/make_face.h"

namespace trimloop::io::iges_import {

// What a face entity asks for; nothing after a finding that says why it cannot be a face. `holes` are the planes
// (108 form -1) that a 402 form 9 cuts out of a bounded plane.
std::optional<heal::FaceInput> face_input(Context& context, const DirectoryEntry& entry,
                                          const std::vector<const DirectoryEntry*>& holes = {});

// Puts the pcurves of `loops` (numbers of the file until now) into the parameters of the surface. Where files differ
// about angles, takes the reading that brings the pcurves nearer to the model curves, and says so when it is the second.
void map_pcurves(Context& context, const DirectoryEntry& face, const PlacedSurface& surface,
                 std::vector<heal::TrimLoop>& loops, const Body* edges = nullptr);

// Adds exactly one face to `body`, a failed one where there is no input, and reports what healing did.
FaceId add_face(Context& context, Body& body, const DirectoryEntry& entry, std::optional<heal::FaceInput> input,
                AttributesId attributes);

}  // namespace trimloop::io::iges_import
