#pragma once
// Surface entities -> kernel surfaces with the map from the file's parameters to ours.
//
//   type  the file's parameters                      ours
//   114   breakpoints                                the same
//   118   u, v in [0,1]                              the same
//   120   u generatrix, v angle                      u angle, v generatrix: swapped, so the normal turns
//   122   u, v in [0,1]                              u of the directrix' own range
//   128   knots                                      the same
//   140   those of the basis                         the same
//   190   lengths from the location                  mm
//   192   u degrees (or radians), v length           radians, mm
//   194   u degrees (or radians), v length           radians, mm
//   196   u, v degrees (or radians)                  radians
//   198   u, v degrees (or radians)                  radians
//   108   not fixed by the standard                  mm in a frame of our choice; pcurves on it are not used

#include "io/iges/context.h"

namespace trimloop::io::iges_import {

// Null after a finding. Read once, then shared.
const PlacedSurface* model_surface(Context& context, const DirectoryEntry& entry);

// A copy moved by `t`, parameters mapped accordingly; nothing after a finding.
std::optional<PlacedSurface> moved(Context& context, const PlacedSurface& surface, const Transform& t);

// A parameter-space curve of the file in the parameters of the surface.
Result<Curve2> mapped(const UvMap& map, Curve curve);

}  // namespace trimloop::io::iges_import
