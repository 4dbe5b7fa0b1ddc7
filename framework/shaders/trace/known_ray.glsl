// SPDX-License-Identifier: MIT
// Rays that aren't traced: of lanes that only keep their subgroup company, and of paths that know what their next ray hits.
#include "base/frame.h"
#include "world/ray.h"

const Ray NO_RAY = Ray(vec3(0.0), 0.0, vec3(1.0), -1.0, 0u);

/// For a path whose next hit is known: has no purpose, so that no ledger counts it.
Ray knownRay(out uint purpose) {
    purpose = RAYS_PURPOSES;
    return NO_RAY;
}
