// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/rays/ray_caster.h>

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstring>
#include <glm/geometric.hpp>
#include <vector>

#include <tetralight/bake/rays/detail/closest_point.h>

namespace tetralight {
namespace {

RTCRay embree_ray(const Ray& ray) {
    RTCRay result{};
    result.org_x = ray.origin.x;
    result.org_y = ray.origin.y;
    result.org_z = ray.origin.z;
    result.dir_x = ray.direction.x;
    result.dir_y = ray.direction.y;
    result.dir_z = ray.direction.z;
    result.tnear = ray.min_distance;
    result.tfar = ray.max_distance;
    result.mask = 0xffffffffu;
    return result;
}

RayHit hit_from(const RTCHit& hit, float distance) {
    return {distance, hit.geomID, hit.primID, {hit.u, hit.v}, {hit.Ng_x, hit.Ng_y, hit.Ng_z}};
}

/// What Embree hands to callbacks; its own part comes first.
struct RayContext {
    RTCIntersectContext embree;
    bool ignores_filter = false;
};

RayContext make_context(bool ignores_filter) {
    RayContext context{{}, ignores_filter};
    rtcInitIntersectContext(&context.embree);
    return context;
}

/// Embree's callback for one candidate hit of a single ray.
void filter_hit(const RTCFilterFunctionNArguments* arguments) {
    if (reinterpret_cast<const RayContext*>(arguments->context)->ignores_filter) return;
    const auto& filter = *static_cast<const HitFilter*>(arguments->geometryUserPtr);
    const auto* ray = reinterpret_cast<const RTCRay*>(arguments->ray);
    const auto* hit = reinterpret_cast<const RTCHit*>(arguments->hit);
    const Ray own_ray{{ray->org_x, ray->org_y, ray->org_z}, {ray->dir_x, ray->dir_y, ray->dir_z}};
    if (!filter.accepts(filter.context, own_ray, hit_from(*hit, ray->tfar))) {
        arguments->valid[0] = 0;
    }
}

/// Returns the copy that Embree keeps.
template <class T>
const T* set_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format,
                    std::span<const T> elements, size_t element_size) {
    void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, element_size,
                                           elements.size_bytes() / element_size);
    if (buffer != nullptr) std::memcpy(buffer, elements.data(), elements.size_bytes());
    return static_cast<const T*>(buffer);
}

/// A geometry's triangles; empty for spheres.
struct Triangles {
    const glm::vec3* positions = nullptr;
    const uint32_t* indices = nullptr;
};

/// State of a search for the nearest point.
struct NearestSearch {
    const std::vector<Triangles>& geometries;
    std::optional<glm::vec3> nearest;
};

/// Embree's callback for one triangle within the query radius: reduces the radius to its distance.
bool visit_triangle(RTCPointQueryFunctionArguments* arguments) {
    auto& search = *static_cast<NearestSearch*>(arguments->userPtr);
    const Triangles& triangles = search.geometries[arguments->geomID];
    if (triangles.indices == nullptr) return false;
    const uint32_t* corners = triangles.indices + size_t{3} * arguments->primID;
    RTCPointQuery& query = *arguments->query;
    const glm::vec3 position(query.x, query.y, query.z);
    const glm::vec3 point = detail::closest_point(
        position, {triangles.positions[corners[0]], triangles.positions[corners[1]],
                   triangles.positions[corners[2]]});
    const float distance = glm::distance(position, point);
    if (!(distance < query.radius)) return false;
    query.radius = distance;
    search.nearest = point;
    return true;
}

}  // namespace

struct RayCaster::Handles {
    explicit Handles(HitFilter hit_filter) : filter(hit_filter) {
        device = rtcNewDevice(nullptr);
        scene = rtcNewScene(device);
        rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
    }

    Handles(const Handles&) = delete;
    Handles& operator=(const Handles&) = delete;

    ~Handles() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }

    uint32_t attach(RTCGeometry geometry, Triangles triangles) {
        geometries.push_back(triangles);
        rtcCommitGeometry(geometry);
        const uint32_t index = rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
        return index;
    }

    void notify(const Ray& ray, RayKind kind, std::optional<float> distance) const {
        if (listener.on_ray == nullptr) [[likely]]
            return;
        listener.on_ray(listener.context, ray, kind,
                        distance.value_or(std::numeric_limits<float>::infinity()));
    }

    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    HitFilter filter;
    RayListener listener;
    std::vector<Triangles> geometries;  // Embree numbers them from 0 as well
};

RayCaster::RayCaster(HitFilter filter) : handles_(std::make_unique<Handles>(filter)) {}

RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;

uint32_t RayCaster::add_triangles(std::span<const glm::vec3> positions,
                                  std::span<const uint32_t> indices, Filtered filtered) {
    RTCGeometry geometry = rtcNewGeometry(handles_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    Triangles triangles;
    triangles.positions = set_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, positions,
                                     sizeof(glm::vec3));
    triangles.indices = set_buffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, indices,
                                   3 * sizeof(uint32_t));
    if (filtered == Filtered::Yes) {
        rtcSetGeometryUserData(geometry, &handles_->filter);
        rtcSetGeometryIntersectFilterFunction(geometry, filter_hit);
        rtcSetGeometryOccludedFilterFunction(geometry, filter_hit);
    }
    return handles_->attach(geometry, triangles);
}

uint32_t RayCaster::add_spheres(std::span<const glm::vec4> spheres) {
    RTCGeometry geometry = rtcNewGeometry(handles_->device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    set_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, spheres, sizeof(glm::vec4));
    return handles_->attach(geometry, {});
}

Status RayCaster::commit() {
    // Build on one thread, so that the BVH, and with it the order of equal hits, is the same on
    // every machine. (The device option "threads=1" would limit all of TBB.)
    tbb::task_arena arena(1);
    arena.execute([&] { rtcJoinCommitScene(handles_->scene); });
    const RTCError error = rtcGetDeviceError(handles_->device);
    if (error == RTC_ERROR_NONE) return Ok{};
    if (error == RTC_ERROR_OUT_OF_MEMORY) {
        return Error{ErrorCode::OutOfResources, "not enough memory for the scene"};
    }
    return Error{ErrorCode::Unsupported,
                 "Embree failed with error " + std::to_string(static_cast<int>(error))};
}

void RayCaster::listen(RayListener listener) {
    handles_->listener = listener;
}

std::optional<RayHit> RayCaster::intersect(const Ray& ray) const {
    return intersect(ray, Filter::Applied);
}

std::optional<RayHit> RayCaster::intersect_unfiltered(const Ray& ray) const {
    return intersect(ray, Filter::Ignored);
}

std::optional<RayHit> RayCaster::intersect(const Ray& ray, Filter filter) const {
    RayContext context = make_context(filter == Filter::Ignored);
    RTCRayHit ray_hit{embree_ray(ray), {}};
    ray_hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(handles_->scene, &context.embree, &ray_hit);
    const bool is_hit = ray_hit.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    handles_->notify(ray, RayKind::Nearest,
                     is_hit ? std::optional(ray_hit.ray.tfar) : std::nullopt);
    if (!is_hit) return std::nullopt;
    return hit_from(ray_hit.hit, ray_hit.ray.tfar);
}

bool RayCaster::occluded(const Ray& ray) const {
    RayContext context = make_context(false);
    RTCRay embree = embree_ray(ray);
    rtcOccluded1(handles_->scene, &context.embree, &embree);
    const bool is_hit = embree.tfar < 0.0f;
    handles_->notify(ray, RayKind::Shadow, is_hit ? std::optional(0.0f) : std::nullopt);
    return is_hit;
}

std::optional<glm::vec3> RayCaster::nearest_point(glm::vec3 position, float max_distance) const {
    RTCPointQuery query{};
    query.x = position.x;
    query.y = position.y;
    query.z = position.z;
    query.radius = max_distance;
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    NearestSearch search{handles_->geometries, std::nullopt};
    rtcPointQuery(handles_->scene, &query, &context, visit_triangle, &search);
    return search.nearest;
}

}  // namespace tetralight
