// SPDX-License-Identifier: MIT
#include <framework/study/report/images.h>

#include <framework/image/exr.h>
#include <framework/study/error/summary.h>

#include <fmt/format.h>

#include <cctype>

namespace lodestir {
namespace {

/// Letters, digits and some signs; the rest becomes "_".
std::string fileName(std::string text) {
    for (char& c : text)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '.') c = '_';
    return text;
}

}  // namespace

Path shownImageFile(const Study& study, const StudyRun& run, const std::string& hash) {
    const std::string knobs = knobText(run.knobs);
    return Path("images") / fileName(fmt::format("{}.{}{}{}.{}.exr", study.scenes[run.scene].name, study.techniques[run.technique].name,
                                                 knobs.empty() ? "" : ".", knobs, hash.substr(0, 8)));
}

Path shownReferenceFile(const Study& study, std::size_t scene) { return Path("images") / fileName(study.scenes[scene].name + ".reference.exr"); }

Path ensembleImageFile(const Study& study, const EnsembleCell& cell) {
    return Path("images") / fileName(fmt::format("{}.{}.{}.exr", study.scenes[cell.scene].name, labelOf(study, cell), cell.offset));
}

Path ensembleReferenceFile(const Study& study, std::size_t scene, int offset) {
    return Path("images") / fileName(fmt::format("{}.reference.{}.exr", study.scenes[scene].name, offset));
}

bool isShown(const Study& study, const StudyRun& run) {
    const std::vector<Setting> varied(run.knobs.begin(), run.knobs.begin() + std::ptrdiff_t(study.techniques[run.technique].vary.size()));
    return run.seed == drawnSeed(study, run.technique, varied, study.seeds.front());
}

void keepShownImage(const Path& out, const Study& study, const StudyRun& run, const std::string& hash, const ImageData& image) {
    if (isShown(study, run)) writeExr(out / shownImageFile(study, run, hash), image, {.type = ExrOptions::Type::half});
}

void keepShownReference(const Path& out, const Study& study, std::size_t scene, const ImageData& image) {
    writeExr(out / shownReferenceFile(study, scene), image, {.type = ExrOptions::Type::half});
}

}  // namespace lodestir
