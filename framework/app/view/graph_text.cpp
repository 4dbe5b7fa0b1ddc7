// SPDX-License-Identifier: MIT
#include <framework/app/view/graph_text.h>

#include <framework/core/merge_patch.h>

#include <nlohmann/json.hpp>

namespace lodestir {

std::string textWithChanges(const std::string& text, const Path& file, const GraphOptions& changes) {
    const Json source = Json::parse(text, file.string());
    const GraphOptions asWritten{.variant = changes.variant};
    const GraphOptions wanted{.set = changes.set, .variant = changes.variant, .patches = changes.patches};
    const Json now = readDescription(source, file, wanted).source;
    Json patch = mergePatch(readDescription(source, file, asWritten).source, now);
    if (patch.members().empty()) return text;
    if (changes.variant) {
        const Json* variants = source.find("variants");
        if (!variants->find(*changes.variant)) throw Error(variants->where(), "\"" + *changes.variant + "\" are several variants", "choose one to save into");
        Json inside = Json::object();
        inside["variants"][*changes.variant] = std::move(patch);
        patch = std::move(inside);
    }
    const std::string written = mergedText(text, patch, changes.variant ? Nulls::keep : Nulls::remove);

    // A merge patch can't take back what the variant's own patch has replaced as a whole.
    const Json after = readDescription(Json::parse(written, file.string()), file, asWritten).source;
    if (nlohmann::json(after.plain()) != nlohmann::json(now.plain()))
        throw Error(Where{file.string()}, "variant \"" + changes.variant.value_or("") + "\" can't hold these edits", "save the graph into a file of its own");
    return written;
}

}  // namespace lodestir
