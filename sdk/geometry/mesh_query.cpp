// Closest points, inside tests and rays by Embree's search tree over the triangles.
#include "geometry/mesh_query.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#if VFIT_EMBREE_USES_TBB
#include <tbb/task_arena.h>
#endif

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/error.h"
#include "math/closest_point.h"
#include "math/finite.h"

namespace vfit {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Embree reads vertices 16 bytes at a time: one more vertex keeps the last read inside the buffer.
constexpr size_t kEmbreePadding = 1;

/// The search goes on this far beyond the best triangle, so that all that tie are seen and the choice among
/// them does not depend on the shape of the tree. Well above the rounding of floats (6e-8 of a metre).
constexpr float kTieMargin = 1e-6f, kTieMargin_m = 1e-6f;

void release_device(RTCDevice device) { rtcReleaseDevice(device); }
void release_scene(RTCScene scene) { rtcReleaseScene(scene); }
void release_geometry(RTCGeometry geometry) { rtcReleaseGeometry(geometry); }

template <typename T, void (*Release)(T*)>
struct Releaser {
    void operator()(T* object) const { Release(object); }
};
using DevicePtr = std::unique_ptr<RTCDeviceTy, Releaser<RTCDeviceTy, release_device>>;
using ScenePtr = std::unique_ptr<RTCSceneTy, Releaser<RTCSceneTy, release_scene>>;
using GeometryPtr = std::unique_ptr<RTCGeometryTy, Releaser<RTCGeometryTy, release_geometry>>;

void check_finite(std::span<const Vec3> positions) {
    for (size_t i = 0; i < positions.size(); ++i)
        if (!finite(positions[i])) fail(VFIT_ERROR_DATA, "mesh vertex ", i, " is not finite");
}

void check_mesh(std::span<const Vec3> positions, std::span<const uint32_t> indices) {
    if (positions.empty() || indices.empty()) fail(VFIT_ERROR_DATA, "the mesh is empty");
    if (indices.size() % 3 != 0)
        fail(VFIT_ERROR_DATA, "the mesh has ", indices.size(), " indices, not three a triangle");
    for (size_t i = 0; i < indices.size(); ++i)
        if (indices[i] >= positions.size())
            fail(VFIT_ERROR_DATA, "mesh index ", i, " names vertex ", indices[i], " of ", positions.size());
    check_finite(positions);
}

void check_device(RTCDevice device) {
    if (const RTCError error = rtcGetDeviceError(device); error != RTC_ERROR_NONE)
        fail(error == RTC_ERROR_OUT_OF_MEMORY ? VFIT_ERROR_OUT_OF_MEMORY : VFIT_ERROR_UNKNOWN,
             "Embree failed with error ", static_cast<int>(error));
}

/// Builds on the caller's thread alone. Embree would start threads of TBB, beside those that the host gives
/// vfit to run on, and nothing waits for their end when the process exits.
void commit(RTCScene scene) {
#if VFIT_EMBREE_USES_TBB
    tbb::task_arena caller(1);
    caller.execute([scene] { rtcCommitScene(scene); });
#else
    rtcCommitScene(scene);
#endif
}

/// Embree's own tasks take the number of threads from the device; TBB's would be bounded for the whole
/// process.
constexpr const char* kDeviceSettings = VFIT_EMBREE_USES_TBB ? nullptr : "threads=1";

}  // namespace

struct MeshQuery::Scene {
    std::vector<Vec3> positions;  // with kEmbreePadding more
    std::vector<uint32_t> indices;
    DevicePtr device;
    GeometryPtr geometry;
    ScenePtr scene;

    TriangleCorners corners(uint32_t triangle) const {
        const uint32_t* i = &indices[3 * size_t(triangle)];
        return {positions[i[0]], positions[i[1]], positions[i[2]]};
    }
    Vec3 normal(uint32_t triangle) const {
        const TriangleCorners t = corners(triangle);
        const Vec3 n = glm::cross(t.b - t.a, t.c - t.a);
        const float length = glm::length(n);
        return length > 0.0f ? n / length : Vec3(0.0f);
    }
    size_t vertex_count() const { return positions.size() - kEmbreePadding; }

    /// Nearest hit beyond `near`; direction of unit length.
    std::optional<Hit> cast(const Vec3& origin, const Vec3& direction, float near, float far) const;
    int winding(const Vec3& p, const Vec3& direction) const;
};

MeshQuery::MeshQuery(std::span<const Vec3> positions, std::span<const uint32_t> indices)
    : scene_(std::make_unique<Scene>()) {
    check_mesh(positions, indices);
    Scene& s = *scene_;
    s.positions.reserve(positions.size() + kEmbreePadding);
    s.positions.assign(positions.begin(), positions.end());
    s.positions.resize(positions.size() + kEmbreePadding, Vec3(0.0f));
    s.indices.assign(indices.begin(), indices.end());

    s.device.reset(rtcNewDevice(kDeviceSettings));
    if (!s.device) fail(VFIT_ERROR_UNKNOWN, "Embree failed to start");
    s.geometry.reset(rtcNewGeometry(s.device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    s.scene.reset(rtcNewScene(s.device.get()));
    check_device(s.device.get());
    rtcSetSharedGeometryBuffer(s.geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               s.positions.data(), 0, sizeof(Vec3), positions.size());
    rtcSetSharedGeometryBuffer(s.geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, s.indices.data(),
                               0, 3 * sizeof(uint32_t), indices.size() / 3);
    rtcSetGeometryBuildQuality(s.geometry.get(), RTC_BUILD_QUALITY_REFIT);
    rtcCommitGeometry(s.geometry.get());
    // LOW: the kind of tree that Embree can refit. ROBUST: no ray slips through the edge that two triangles
    // share.
    rtcSetSceneBuildQuality(s.scene.get(), RTC_BUILD_QUALITY_LOW);
    rtcSetSceneFlags(s.scene.get(),
                     static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC));
    rtcAttachGeometry(s.scene.get(), s.geometry.get());
    commit(s.scene.get());
    check_device(s.device.get());
}

MeshQuery::~MeshQuery() = default;
MeshQuery::MeshQuery(MeshQuery&&) noexcept = default;
MeshQuery& MeshQuery::operator=(MeshQuery&&) noexcept = default;

void MeshQuery::update(std::span<const Vec3> positions) {
    Scene& s = *scene_;
    if (positions.size() != s.vertex_count())
        fail(VFIT_ERROR_ARGUMENT, "the mesh has ", s.vertex_count(), " vertices, not ", positions.size());
    check_finite(positions);
    std::copy(positions.begin(), positions.end(), s.positions.begin());
    rtcUpdateGeometryBuffer(s.geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0);
    rtcCommitGeometry(s.geometry.get());
    commit(s.scene.get());
    check_device(s.device.get());
}

std::span<const Vec3> MeshQuery::positions() const {
    return {scene_->positions.data(), scene_->vertex_count()};
}
std::span<const uint32_t> MeshQuery::indices() const { return scene_->indices; }

MeshQuery::Closest MeshQuery::closest(const Vec3& p) const {
    struct Search {
        const Scene& scene;
        Vec3 p;
        TrianglePoint best{};
        float distance2 = kInfinity;
        uint32_t triangle = 0;
    } search{*scene_, p};

    RTCPointQuery query{};
    query.x = p.x;
    query.y = p.y;
    query.z = p.z;
    query.radius = kInfinity;
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    const auto visit = [](RTCPointQueryFunctionArguments* arguments) {
        Search& found = *static_cast<Search*>(arguments->userPtr);
        const TriangleCorners corners = found.scene.corners(arguments->primID);
        if (box_distance2(corners, found.p) > found.distance2 * (1.0f + kTieMargin)) return false;
        const TrianglePoint point = closest_point(corners, found.p);
        const Vec3 offset = point.position - found.p;
        const float distance2 = glm::dot(offset, offset);
        const bool nearer = distance2 < found.distance2;
        if (!nearer && !(distance2 == found.distance2 && arguments->primID < found.triangle)) return false;
        found.best = point;
        found.distance2 = distance2;
        found.triangle = arguments->primID;
        if (!nearer) return false;
        arguments->query->radius = std::sqrt(distance2) * (1.0f + kTieMargin) + kTieMargin_m;
        return true;
    };
    rtcPointQuery(scene_->scene.get(), &query, &context, visit, &search);
    return {search.best.position, scene_->normal(search.triangle), std::sqrt(search.distance2),
            search.triangle, search.best.uv};
}

std::optional<MeshQuery::Hit> MeshQuery::Scene::cast(const Vec3& origin, const Vec3& direction, float near,
                                                     float far) const {
    RTCRayHit rayhit{};
    rayhit.ray.org_x = origin.x;
    rayhit.ray.org_y = origin.y;
    rayhit.ray.org_z = origin.z;
    rayhit.ray.dir_x = direction.x;
    rayhit.ray.dir_y = direction.y;
    rayhit.ray.dir_z = direction.z;
    rayhit.ray.tnear = near;
    rayhit.ray.tfar = far;
    rayhit.ray.mask = ~0u;
    rayhit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rayhit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(scene.get(), &rayhit);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene.get(), &context, &rayhit);
#endif
    if (rayhit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return Hit{rayhit.ray.tfar, rayhit.hit.primID, normal(rayhit.hit.primID)};
}

std::optional<MeshQuery::Hit> MeshQuery::cast(const Vec3& origin, const Vec3& direction, float far) const {
    const float length = glm::length(direction);
    if (!(length > 0.0f)) return std::nullopt;
    return scene_->cast(origin, direction / length, 0.0f, far);
}

/// How many times the surface winds about p, as this ray counts it: leaving adds one, entering takes one.
int MeshQuery::Scene::winding(const Vec3& p, const Vec3& direction) const {
    // A step past each hit; two skins nearer to each other than this count as one.
    constexpr float kStep_m = 1e-6f, kRelativeStep = 1e-6f;
    int count = 0;
    float near = 0.0f;
    while (const std::optional<Hit> hit = cast(p, direction, near, kInfinity)) {
        const float leaving = glm::dot(hit->normal, direction);
        count += leaving > 0.0f ? 1 : leaving < 0.0f ? -1 : 0;
        near = hit->distance * (1.0f + kRelativeStep) + kStep_m;
    }
    return count;
}

bool MeshQuery::inside(const Vec3& p) const {
    // Three directions along no axis and in no common plane with one: bodies are full of axis-aligned edges.
    static const std::array<Vec3, 3> kDirections = {glm::normalize(Vec3(0.831f, 0.274f, 0.487f)),
                                                    glm::normalize(Vec3(-0.388f, 0.541f, -0.746f)),
                                                    glm::normalize(Vec3(-0.197f, -0.863f, 0.465f))};
    const bool first = scene_->winding(p, kDirections[0]) > 0;
    const bool second = scene_->winding(p, kDirections[1]) > 0;
    return first == second ? first : scene_->winding(p, kDirections[2]) > 0;
}

float MeshQuery::signed_distance(const Vec3& p) const {
    const float distance = closest(p).distance;
    return inside(p) ? -distance : distance;
}

float largest_inner_sphere(const MeshQuery& skin, const Vec3& center) {
    return skin.inside(center) ? skin.closest(center).distance : 0.0f;
}

void push_out(const MeshQuery& mesh, float clearance_m, std::span<Vec3> points) {
    for (Vec3& p : points) {
        constexpr int kTries = 4;
        for (int i = 0; i < kTries; ++i) {
            constexpr float kUpright = 0.7f;  // cosine: before its nearest place, a point is outside
            const MeshQuery::Closest closest = mesh.closest(p);
            if (closest.distance >= clearance_m &&
                glm::dot(p - closest.point, closest.normal) > kUpright * closest.distance)
                break;
            const float distance = mesh.inside(p) ? -closest.distance : closest.distance;
            if (distance >= clearance_m) break;
            const Vec3 outward = closest.distance > 1e-6f ? (p - closest.point) / distance : closest.normal;
            p = closest.point + outward * clearance_m;
        }
    }
}

}  // namespace vfit
