// SPDX-License-Identifier: MIT
// Rays traced by the driver (VK_KHR_ray_query). World.tlas was built over the levels that World.levels says.
// Drivers don't tell their steps, so traceSteps stays 0.
#extension GL_EXT_ray_query : require
#include "trace/reference.glsl"

// World.primitives index of a triangle of an instance's level.
uint queriedPrimitive(World w, uint instance, uint triangle) {
    return w.meshLevels.at[w.instances.at[instance].mesh * LEVELS + w.levels.at[instance]].firstPrimitive + triangle;
}

Hit traceRay(World w, Ray ray, bool anyHit) {
    Hit hit = Hit(ray.tMax, vec2(0.0), NONE, NONE);
    Passage passage = passageStart();
    if (!(ray.tMax > 0.0) || w.tlas == 0ul) return anyHit ? arrivedHit(hit, passage) : hit;
    // The driver's structure is over all instances: where one is to be seen alone (onlyInstance), each triangle is asked whose it is.
    bool alone = w.topRoot >= REF_INSTANCE && w.instanceCount > 1u;
    uint flags = (anyHit ? gl_RayFlagsTerminateOnFirstHitEXT : gl_RayFlagsNoneEXT) | (alone ? gl_RayFlagsNoOpaqueEXT : gl_RayFlagsNoneEXT);
    rayQueryEXT query;
    rayQueryInitializeEXT(query, accelerationStructureEXT(w.tlas), flags, 0xffu, ray.origin, max(ray.tMin, 0.0), ray.direction, ray.tMax);
    while (rayQueryProceedEXT(query)) {  // else it stops at triangles of levels where some have an alpha mask or are panes
        Hit met = Hit(rayQueryGetIntersectionTEXT(query, false), rayQueryGetIntersectionBarycentricsEXT(query, false), 0u,
                      rayQueryGetIntersectionInstanceIdEXT(query, false));
        met.primitive = queriedPrimitive(w, met.instance, rayQueryGetIntersectionPrimitiveIndexEXT(query, false));
        bool accepted = !alone || (REF_INSTANCE | uint(met.instance)) == w.topRoot;
        if (accepted) accepted = alphaAccepts(w, met.primitive, met.barycentrics);
        if (anyHit && accepted) accepted = endsLight(w, ray, met, passage);
        if (accepted) rayQueryConfirmIntersectionEXT(query);
    }
    if (rayQueryGetIntersectionTypeEXT(query, true) != gl_RayQueryCommittedIntersectionTriangleEXT) return anyHit ? arrivedHit(hit, passage) : hit;
    hit.instance = rayQueryGetIntersectionInstanceIdEXT(query, true);
    hit.primitive = queriedPrimitive(w, hit.instance, rayQueryGetIntersectionPrimitiveIndexEXT(query, true));
    hit.t = rayQueryGetIntersectionTEXT(query, true);
    hit.barycentrics = rayQueryGetIntersectionBarycentricsEXT(query, true);
    return hit;
}
