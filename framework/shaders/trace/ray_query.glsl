// SPDX-License-Identifier: MIT
// Rays traced by the driver (VK_KHR_ray_query). World.tlas was built over the levels that World.levels says.
// Drivers don't tell their steps, so traceSteps stays 0, and their structures don't move: motion blur is refused before anything is traced.
#extension GL_EXT_ray_query : require
#include "trace/reference.glsl"

// An entry of that structure (trace/instance_list.comp).
struct QueriedInstance {
    uint instance;
    bool coarser;  // of its two levels
};
QueriedInstance queriedInstance(World w, uint entry) {
    bool coarser = RAY_LEVELS != 0 && entry >= w.instanceCount;
    return QueriedInstance(coarser ? entry - w.instanceCount : entry, coarser);
}

// World.primitives index of a triangle of an entry's level.
uint queriedPrimitive(World w, QueriedInstance q, uint triangle) {
    uint level = w.levels.at[q.instance] + (q.coarser ? 1u : 0u);
    return w.meshLevels.at[w.instances.at[q.instance].mesh * LEVELS + level].firstPrimitive + triangle;
}

Hit traceRay(World w, Ray ray, bool anyHit) {
    Hit hit = Hit(ray.tMax, vec2(0.0), NONE, NONE);
    Passage passage = passageStart();
    if (!(ray.tMax > 0.0) || w.tlas == 0ul) return anyHit ? arrivedHit(hit, passage) : hit;
    // The driver's structure is over all instances: where one is to be seen alone (onlyInstance), each triangle is asked whose it is.
    bool alone = w.topRoot >= REF_INSTANCE && w.instanceCount > 1u;
    uint flags = (anyHit ? gl_RayFlagsTerminateOnFirstHitEXT : gl_RayFlagsNoneEXT) | (alone ? gl_RayFlagsNoOpaqueEXT : gl_RayFlagsNoneEXT);
    uint mask = RAY_LEVELS == 0 ? 0xffu : 1u << (ray.flags >> 29);
    rayQueryEXT query;
    rayQueryInitializeEXT(query, accelerationStructureEXT(w.tlas), flags, mask, ray.origin, max(ray.tMin, 0.0), ray.direction, ray.tMax);
    while (rayQueryProceedEXT(query)) {  // else it stops at triangles of levels where some have an alpha mask or are panes
        QueriedInstance q = queriedInstance(w, rayQueryGetIntersectionInstanceIdEXT(query, false));
        Hit met = Hit(rayQueryGetIntersectionTEXT(query, false), rayQueryGetIntersectionBarycentricsEXT(query, false),
                      queriedPrimitive(w, q, rayQueryGetIntersectionPrimitiveIndexEXT(query, false)), q.instance);
        bool accepted = !alone || (REF_INSTANCE | met.instance) == w.topRoot;
        if (RAY_LEVELS != 0 && accepted) accepted = seesCoarser(w, q.instance, ray.flags) == q.coarser;
        if (accepted) accepted = alphaAccepts(w, met.primitive, met.barycentrics);
        if (anyHit && accepted) accepted = endsLight(w, ray, met, passage);
        if (accepted) rayQueryConfirmIntersectionEXT(query);
    }
    if (rayQueryGetIntersectionTypeEXT(query, true) != gl_RayQueryCommittedIntersectionTriangleEXT) return anyHit ? arrivedHit(hit, passage) : hit;
    QueriedInstance q = queriedInstance(w, rayQueryGetIntersectionInstanceIdEXT(query, true));
    hit.instance = q.instance;
    hit.primitive = queriedPrimitive(w, q, rayQueryGetIntersectionPrimitiveIndexEXT(query, true));
    hit.t = rayQueryGetIntersectionTEXT(query, true);
    hit.barycentrics = rayQueryGetIntersectionBarycentricsEXT(query, true);
    return hit;
}
