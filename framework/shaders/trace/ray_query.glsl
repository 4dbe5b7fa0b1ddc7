// SPDX-License-Identifier: MIT
// Rays traced by the driver (VK_KHR_ray_query). World.tlas was built over the levels that World.levels says.
#extension GL_EXT_ray_query : require
#include "texture/alpha.glsl"
#include "trace/ray.h"

#ifdef COUNT_STEPS
uint traceSteps = 0u;  // drivers don't tell
#endif

// World.primitives index of a triangle of an instance's level.
uint queriedPrimitive(World w, uint instance, uint triangle) {
    return w.meshLevels.at[w.instances.at[instance].mesh * LEVELS + w.levels.at[instance]].firstPrimitive + triangle;
}

Hit traceRay(World w, Ray ray, bool anyHit) {
    Hit hit = Hit(ray.tMax, vec2(0.0), NONE, NONE);
    if (!(ray.tMax > 0.0) || w.tlas == 0ul) return hit;
    rayQueryEXT query;
    rayQueryInitializeEXT(query, accelerationStructureEXT(w.tlas), anyHit ? gl_RayFlagsTerminateOnFirstHitEXT : gl_RayFlagsNoneEXT, 0xffu,
                          ray.origin, max(ray.tMin, 0.0), ray.direction, ray.tMax);
    while (rayQueryProceedEXT(query)) {  // stops at triangles of levels where some have an alpha mask
        uint instance = rayQueryGetIntersectionInstanceIdEXT(query, false);
        uint primitive = queriedPrimitive(w, instance, rayQueryGetIntersectionPrimitiveIndexEXT(query, false));
        if (alphaAccepts(w, primitive, rayQueryGetIntersectionBarycentricsEXT(query, false))) rayQueryConfirmIntersectionEXT(query);
    }
    if (rayQueryGetIntersectionTypeEXT(query, true) != gl_RayQueryCommittedIntersectionTriangleEXT) return hit;
    hit.instance = rayQueryGetIntersectionInstanceIdEXT(query, true);
    hit.primitive = queriedPrimitive(w, hit.instance, rayQueryGetIntersectionPrimitiveIndexEXT(query, true));
    hit.t = rayQueryGetIntersectionTEXT(query, true);
    hit.barycentrics = rayQueryGetIntersectionBarycentricsEXT(query, true);
    return hit;
}
