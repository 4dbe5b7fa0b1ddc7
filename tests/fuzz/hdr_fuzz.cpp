// SPDX-License-Identifier: MIT
// Any bytes as an image file: HDR.
#include "input_file.h"

#include <framework/image/hdr.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const lodestir::fuzz::Folder folder;
    const lodestir::Path file = folder.write("input.hdr", {data, size});
    lodestir::fuzz::expectErrorOrResult([&] { lodestir::readHdr(file); });
    return 0;
}
