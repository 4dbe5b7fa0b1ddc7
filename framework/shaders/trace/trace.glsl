// SPDX-License-Identifier: MIT
// Rays: one call, answered alike by every body. The compiler's defines choose the body; the ray's World must be subgroup-uniform.
//
//   Hit traceRay(World w, Ray ray, bool anyHit)
//
// gives the nearest hit, or any one where only `primitive != NONE` counts (then t, barycentrics and instance mean nothing), and without one
// the share of light that came through (transmittance); anyHit must be subgroup-uniform. 0 <= tMin; the direction's length
// should be between 1e-6 and 1e6. In onlyInstance(w, i) (trace/reference.glsl) rays see instance i alone. Every call is compiled in full at its
// place: have one call site in a loop (trace/driver.glsl), and have all lanes of the subgroup reach it, those without a ray with tMax < 0.
#include "texture/alpha.glsl"
#include "trace/pane.glsl"
#include "world/ray.h"
#include "world/world.h"
#if defined(TRACE_PACKET)
#include "trace/packet.glsl"
#elif defined(TRACE_LANE)
#include "trace/lane.glsl"
#elif defined(TRACE_RAY_QUERY)
#include "trace/ray_query.glsl"
#else
#error "the compiler's defines choose a body: TRACE_PACKET, TRACE_LANE or TRACE_RAY_QUERY"
#endif

Hit trace(World w, Ray ray) { return traceRay(w, ray, false); }
bool occluded(World w, Ray ray) { return traceRay(w, ray, true).primitive != NONE; }
