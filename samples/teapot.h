#pragma once
// The Utah teapot, cut where its parts meet: the spout and the handle end at the body, and the body is open where the
// spout begins.

#include <trimloop/trimloop.h>

namespace samples {

trimloop::Model utah_teapot();

}  // namespace samples
