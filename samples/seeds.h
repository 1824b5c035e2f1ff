#pragma once

#include <trimloop/trimloop.h>

namespace samples {

// Prints each worked example of the notes with the difference from what the notes say; 1 when one is off by more than
// rounding.
int work_examples();

}  // namespace samples
