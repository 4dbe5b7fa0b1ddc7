// SPDX-License-Identifier: MIT
// The yardstick: Embree, single rays, all triangles in one flat scene.
#pragma once
#include <bench/rays_scenes.h>
#include <framework/core/tasks.h>
#include <framework/shaders/world/ray.h>
#include <framework/shaders/world/world.h>

#include <embree3/rtcore.h>

#include <cstring>
#include <span>

namespace lodestir::bench {

class Embree {
public:
    explicit Embree(const Triangles& mesh) : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
        const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        copy(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, std::span(mesh.positions));
        copy(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, std::span(mesh.triangles));
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene_);
    }
    ~Embree() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    Embree(const Embree&) = delete;
    Embree& operator=(const Embree&) = delete;

    /// Traces all rays on all cores. anyHit: only `primitive` counts.
    void trace(std::span<const Ray> rays, std::span<Hit> hits, bool anyHit) const {
        parallelFor(rays.size(), 2048, [&](std::size_t begin, std::size_t end) {
            RTCIntersectContext context;
            rtcInitIntersectContext(&context);
            for (std::size_t i = begin; i < end; ++i) hits[i] = trace(rays[i], anyHit, context);
        });
    }

private:
    template <class T> static void copy(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::span<const T> values) {
        std::memcpy(rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), values.size()), values.data(), values.size_bytes());
    }
    Hit trace(const Ray& ray, bool anyHit, RTCIntersectContext& context) const {
        Hit miss{ray.tMax, {}, NONE, NONE};
        if (ray.tMax < 0) return miss;
        RTCRayHit r{};
        r.ray = {ray.origin.x, ray.origin.y, ray.origin.z, ray.tMin, ray.direction.x, ray.direction.y, ray.direction.z, 0, ray.tMax, ~0u, 0, 0};
        r.hit.geomID = r.hit.primID = RTC_INVALID_GEOMETRY_ID;
        if (anyHit) {
            rtcOccluded1(scene_, &context, &r.ray);
            miss.primitive = r.ray.tfar < 0 ? 0 : NONE;
            return miss;
        }
        rtcIntersect1(scene_, &context, &r);
        return r.hit.geomID == RTC_INVALID_GEOMETRY_ID ? miss : Hit{r.ray.tfar, {r.hit.u, r.hit.v}, r.hit.primID, 0};
    }

    RTCDevice device_;
    RTCScene scene_;
};

}  // namespace lodestir::bench
