#pragma once
// The bundled script of viewer/, built into the program; empty when it was built without Node.

#include <string_view>

namespace trimloop::cli {
std::string_view viewer_script();
}
