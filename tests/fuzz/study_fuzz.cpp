// SPDX-License-Identifier: MIT
// Any JSON as a study file. The scenes and graphs that it may name are there.
#include "input_file.h"
#include "json_mutator.h"

#include <framework/study/run_list.h>
#include <framework/study/study_file.h>

LODESTIR_MUTATE_JSON

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const lodestir::fuzz::Folder folder;
    static const bool isSetUp = [] {
        for (const char* name : {"scenes", "graphs"})
            std::filesystem::create_directory_symlink(lodestir::Path(LODESTIR_SOURCE_DIR) / name, folder.path() / name);
        std::filesystem::create_directories(folder.path() / "studies/fuzz");
        return true;
    }();
    const lodestir::Path file = folder.write(isSetUp ? "studies/fuzz/input.json" : "", {data, size});
    lodestir::fuzz::expectErrorOrResult([&] {
        const lodestir::Study study = lodestir::loadStudy(file);
        lodestir::measuresOf(study);
        lodestir::expandRuns(study);
    });
    return 0;
}
