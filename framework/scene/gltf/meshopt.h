// SPDX-License-Identifier: MIT
// EXT_meshopt_compression and KHR_meshopt_compression: buffer views whose data is compressed.
#pragma once
#include <framework/scene/gltf/file.h>

namespace lodestir {

/// Decodes every compressed buffer view into a buffer of its own behind the file's, and turns the view to it. What cannot be decoded is
/// gathered as a problem.
void decodeMeshopt(GltfFile& file, Problems& problems);

}  // namespace lodestir
