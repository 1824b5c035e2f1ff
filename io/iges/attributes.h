#pragma once
// Names (406 form 15), colours (directory, 314), levels, line fonts and weights, visibility of entities.

#include "io/iges/context.h"

namespace trimloop::io::iges_import {

// What the entity itself says. Read after its record, whose trailing pointers name the properties.
Attributes own_attributes(Context& context, const DirectoryEntry& entry);

// The entity under an owner: the hierarchy status of the owner decides whose word counts (IGES 5.3 2.2.4.4.9.4).
Attributes under(const Attributes& owner, const DirectoryEntry& owner_entry, Attributes own);

// What the levels of the file are called, from level 1 on.
std::vector<std::string> layer_names(Context& context);

}  // namespace trimloop::io::iges_import
