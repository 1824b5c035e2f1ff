#pragma once
// The public face: read, check, convert, mesh. `#include <trimloop/trimloop.h>`, link `trimloop::io`.

#include "base/report.h"
#include "io/io.h"
#include "kernel/batch/batch.h"
#include "kernel/bounds/bounds.h"
#include "kernel/check/measure.h"
#include "kernel/closest/closest.h"
#include "kernel/heal/make_face.h"
#include "kernel/intersect/intersect.h"
#include "kernel/mesh/tessellate.h"
#include "kernel/model/model.h"
#include "kernel/pcurve/project.h"
