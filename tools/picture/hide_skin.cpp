#include "picture/hide_skin.h"

#include <embree3/rtcore.h>

namespace vfit::tools {

namespace {

constexpr float kAbove = 0.08f;  // m: cloth that far over the skin covers it
constexpr float kBelow = 0.09f;  // m: skin that sticks out of the cloth by that much is covered too

}  // namespace

std::vector<uint32_t> visible_triangles(const RenderMesh& body, const RenderMesh& cloth,
                                        const std::vector<uint8_t>& coverable) {
    RTCDevice device = rtcNewDevice("threads=1");
    RTCScene scene = rtcNewScene(device);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), cloth.positions.size()));
    std::copy(cloth.positions.begin(), cloth.positions.end(), vertices);
    auto* indices = static_cast<uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t),
                                cloth.indices.size() / 3));
    std::copy(cloth.indices.begin(), cloth.indices.end(), indices);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);

    std::vector<uint8_t> covered(body.positions.size(), 0);
    for (size_t i = 0; i < covered.size(); ++i) {
        if (!coverable[i]) continue;
        const glm::vec3 n = body.normals[i], start = body.positions[i] - n * kBelow;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRay ray{};
        ray.org_x = start.x;
        ray.org_y = start.y;
        ray.org_z = start.z;
        ray.dir_x = n.x;
        ray.dir_y = n.y;
        ray.dir_z = n.z;
        ray.tfar = kBelow + kAbove;
        ray.mask = ~0u;
        rtcOccluded1(scene, &context, &ray);
        covered[i] = ray.tfar < 0.0f;
    }
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);

    std::vector<uint32_t> out;
    out.reserve(body.indices.size());
    for (size_t t = 0; t + 2 < body.indices.size(); t += 3) {
        const uint32_t* v = &body.indices[t];
        if (!(covered[v[0]] && covered[v[1]] && covered[v[2]])) out.insert(out.end(), v, v + 3);
    }
    return out;
}

}  // namespace vfit::tools
