// SPDX-License-Identifier: MIT
// Traversal ray by ray: each lane walks the tree alone. For any subgroup size.
#include "trace/reference.glsl"
#include "trace/triangle.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer LaneNodes { uvec4 at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer LaneTriangles { vec4 at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer LaneInstances { TraceInstance at[]; };

const uint LANE_STACK = 2u * 64u;  // scene/bvh/bvh.h, bvhStack, for the top level and a mesh

Hit traceRay(World w, Ray ray, bool anyHit) {
    vec3 origin = ray.origin, direction = ray.direction;
    vec3 slope = inverseOf(direction), offset = (w.gridBase - origin) * slope;
    slope *= w.gridScale;
    float tMin = max(ray.tMin, 0.0);
    Hit hit = Hit(ray.tMax, vec2(0.0), NONE, NONE);
    uint instance = NONE;
    Passage passage = passageStart();

    uint stack[LANE_STACK];
    stack[0] = REF_NONE;
    uint size = 1u;
    uint current = ray.tMax > 0.0 ? w.topRoot : REF_NONE;
    while (current != REF_NONE) {
        if (current < REF_LEAF) {
#ifdef COUNT_STEPS
            ++traceSteps;
#endif
            // uvec4 i: even and odd dwords 2i and 2i + 1; so x and z of children 0-1, 2-3, then y and the references.
            LaneNodes nodes = LaneNodes(w.nodes + uint64_t(current) * 64ul);
            uvec4 a = nodes.at[0], b = nodes.at[1], c = nodes.at[2], d = nodes.at[3];
            uvec4 xs = uvec4(a.xz, b.xz), zs = uvec4(a.yw, b.yw), ys = uvec4(c.xz, d.xz), references = uvec4(c.yw, d.yw);
            vec4 x0 = fma(vec4(xs & 0xffffu), vec4(slope.x), vec4(offset.x)), x1 = fma(vec4(xs >> 16), vec4(slope.x), vec4(offset.x));
            vec4 y0 = fma(vec4(ys & 0xffffu), vec4(slope.y), vec4(offset.y)), y1 = fma(vec4(ys >> 16), vec4(slope.y), vec4(offset.y));
            vec4 z0 = fma(vec4(zs & 0xffffu), vec4(slope.z), vec4(offset.z)), z1 = fma(vec4(zs >> 16), vec4(slope.z), vec4(offset.z));
            vec4 enter = max(max(min(x0, x1), min(y0, y1)), max(min(z0, z1), vec4(tMin)));
            vec4 leave = min(min(max(x0, x1), max(y0, y1)), min(max(z0, z1), vec4(hit.t)));
            // Distances as sortable keys whose last two bits are the child's number.
            const uint miss = 0xffffffffu;
            uvec4 key = (floatBitsToUint(enter) & ~3u) | uvec4(0u, 1u, 2u, 3u);
            key = mix(uvec4(miss), key, lessThanEqual(enter, leave));
            key = mix(key, uvec4(miss), equal(references, uvec4(REF_NONE)));
            key = uvec4(min(key.xz, key.yw), max(key.xz, key.yw)).xzyw;
            key = uvec4(min(key.xy, key.zw), max(key.xy, key.zw));
            key.yz = uvec2(min(key.y, key.z), max(key.y, key.z));
            for (int i = 3; i > 0; --i)
                if (key[i] != miss) stack[size++] = references[key[i] & 3u];
            current = key.x != miss ? references[key.x & 3u] : stack[--size];
        } else if (current < REF_BACK) {
            uint last = lastTriangle(current);
            for (uint primitive = firstTriangle(current); primitive <= last; ++primitive) {
                LaneTriangles triangle = LaneTriangles(w.triangles + uint64_t(primitive) * 48ul);
                vec4 a = triangle.at[0], b = triangle.at[1], c = triangle.at[2];
                vec3 v0 = a.xyz, e1 = vec3(a.w, b.xy), e2 = vec3(b.zw, c.x);
                Meeting m = meet(origin, direction, tMin, hit.t, v0, e1, e2);
                bool accepted = m.t < hit.t;
                Hit met = Hit(m.t, m.barycentrics, primitive, instance);
                bool asked = floatBitsToUint(c.y) != 0u;
                if (accepted && asked) accepted = alphaAccepts(w, primitive, m.barycentrics);
                if (anyHit && accepted && asked) accepted = endsLight(w, ray, met, passage);
                if (accepted) hit = met;
            }
            current = anyHit && hit.primitive != NONE ? REF_NONE : stack[--size];
        } else if (current == REF_BACK) {
            origin = ray.origin;
            direction = ray.direction;
            slope = inverseOf(direction);
            offset = (w.gridBase - origin) * slope;
            slope *= w.gridScale;
            current = stack[--size];
        } else {
            instance = current & REF_INSTANCE_BITS;
            TraceInstance record = LaneInstances(w.traceInstances).at[instance];
            vec3 from = ray.origin, way = ray.direction;
            intoOpening(w, instance, from, way);
            origin = pointToGrid(record.toGrid[0], record.toGrid[1], record.toGrid[2], from);
            direction = directionToGrid(record.toGrid[0], record.toGrid[1], record.toGrid[2], way);
            slope = inverseOf(direction);
            offset = (record.boxes - origin) * slope;
            stack[size++] = REF_BACK;
            current = rootOf(w, record.mesh, levelSeen(w, instance, ray.flags));
        }
    }
    return anyHit ? arrivedHit(hit, passage) : hit;
}
