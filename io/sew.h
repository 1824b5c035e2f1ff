#pragma once
// Sewing as files meet it: every body of a model, with findings about what was joined and what stays open.

#include "io/io.h"

namespace trimloop::io {

// At `tolerance_mm`. Findings: MD-10 for each body that was looked at; with `measure_gaps` SQ-241 for each of its open edges.
// Stopped, it leaves a model that is not to be used.
void sew(Model& model, Format format, double tolerance_mm, bool measure_gaps, const std::stop_token& stop, Report& report);

}  // namespace trimloop::io
