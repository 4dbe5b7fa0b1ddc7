// SPDX-License-Identifier: MIT
// Merge patches (RFC 7396): what leads from one value to another, and one applied to text, whose other bytes stay as they were written.
#pragma once
#include <framework/core/json.h>

namespace lodestir {

/// The smallest patch that makes `to` of `from` (the order of members apart); both are objects, `to` without a null in it.
LODESTIR_API Json mergePatch(const Json& from, const Json& to);

/// What becomes of a null in a patch that is written into text.
enum class Nulls {
    remove,  ///< it takes the member away, as the RFC has it
    keep     ///< it is written: what the patch is merged into is a patch itself
};

/// `text`, an object as JSON that Json::parse accepts, with the patch merged into it. What the patch doesn't name keeps its bytes; new members follow the
/// last one and are parted as those before them are.
LODESTIR_API std::string mergedText(std::string_view text, const Json& patch, Nulls nulls = Nulls::remove);

}  // namespace lodestir
