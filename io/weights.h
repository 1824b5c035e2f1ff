#pragma once
// Exchange formats want weights above zero; a model may hold any.

#include <optional>
#include <string>
#include <vector>

#include "kernel/model/model.h"

namespace trimloop::io {

// The model with every NURBS over positive weights, same shapes and parameters; nothing when it already is so. A free
// curve that runs to infinity is left out and listed; such a surface or edge stays as it is and is listed.
std::optional<Model> with_positive_weights(const Model&, std::vector<std::string>& losses);

}  // namespace trimloop::io
