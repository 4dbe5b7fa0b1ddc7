// SPDX-License-Identifier: MIT
// The attributes in the header of an OpenEXR file, as they lie there.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace lodestir {

/// What is wrong with the sizes of a file's attributes ("OpenEXR File Layout": name, type, size, value; one header for each part), if
/// anything. OpenEXR takes the memory that an attribute claims before it looks for its bytes, and believes sizes inside of values.
std::optional<std::string> attributeFlaw(std::span<const std::byte> file);

}  // namespace lodestir
