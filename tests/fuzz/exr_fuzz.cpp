// SPDX-License-Identifier: MIT
// Any bytes as an image file: EXR.
#include "input_file.h"

#include <framework/image/exr.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const lodestir::fuzz::Folder folder;
    const lodestir::Path file = folder.write("input.exr", {data, size});
    lodestir::fuzz::expectErrorOrResult([&] { lodestir::readExrFile(file); });
    return 0;
}
