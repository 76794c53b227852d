// The drawn body against rays cast by Embree, pixel by pixel.
#include <cmath>
#include <limits>
#include <optional>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <gtest/gtest.h>

#include "depth_camera.h"
#include "motion.h"
#include "person.h"

namespace vfit::virtual_person {
namespace {

class RayCaster {
public:
    RayCaster(const float* positions, uint32_t vertex_count, const std::vector<uint32_t>& indices) {
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        RTCGeometry mesh = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
            mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertex_count));
        std::copy(positions, positions + size_t{vertex_count} * 3, vertices);
        auto* corners = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
            mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), indices.size() / 3));
        std::copy(indices.begin(), indices.end(), corners);
        rtcCommitGeometry(mesh);
        rtcAttachGeometry(scene_, mesh);
        rtcReleaseGeometry(mesh);
        rtcCommitScene(scene_);
    }
    ~RayCaster() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    RayCaster(const RayCaster&) = delete;
    RayCaster& operator=(const RayCaster&) = delete;

    struct Hit {
        float depth, cosine;
    };
    /// direction: of z = 1 along the optical axis, so that the ray's parameter is the depth.
    std::optional<Hit> cast(const Vec3& origin, const Vec3& direction, float farthest) const {
        RTCRayHit query{};
        query.ray.org_x = origin.x, query.ray.org_y = origin.y, query.ray.org_z = origin.z;
        query.ray.dir_x = direction.x, query.ray.dir_y = direction.y, query.ray.dir_z = direction.z;
        query.ray.tfar = farthest;
        query.ray.mask = ~0u;
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
        rtcIntersect1(scene_, &query);
#else
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(scene_, &context, &query);
#endif
        if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
        const Vec3 normal(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
        return Hit{query.ray.tfar,
                   std::abs(glm::dot(normal, direction)) / (glm::length(normal) * glm::length(direction))};
    }

private:
    RTCDevice device_ = rtcNewDevice("threads=1");
    RTCScene scene_ = rtcNewScene(device_);
};

// A ray that passes within rounding of the outline may be told apart either way, and one that goes through an
// edge between two triangles has the slant of either.
TEST(DepthCamera, SeesOfABodyWhatRaysMeet) {
    constexpr int kRoundedPixels = 2, kEdgePixels = 40;  // a frame, of more than 20,000 of the person
    const SensorModel& model = *find_sensor_model("kinect_v1");
    const OwnContext context;
    for (const uint32_t detail : {0u, 1u}) {
        Person person(context.get(), VFIT_SEX_FEMALE, detail, {});
        const auto motion = make_scripted_motion("demo", person.proportions(), 1);
        const CameraPlace place{1.0f, glm::radians(5.0f)};
        DepthCamera camera(model, place, {3.9f, 1.7f});
        CleanImage room, image;
        camera.render(nullptr, room);
        camera.set_triangles(person.triangles(), person.vertex_count());
        for (const double time_s : {0.0, 4.0, 9.0, 17.0, 24.0}) {
            person.pose(motion->at(time_s), Vec3(0.0f, 0.0f, -2.7f));
            camera.render(person.positions(), image);
            const RayCaster rays(person.positions(), person.vertex_count(), person.triangles());
            int of_person = 0, other_surface = 0, other_slant = 0;
            for (uint32_t y = 0; y < model.height; ++y) {
                for (uint32_t x = 0; x < model.width; ++x) {
                    const size_t i = size_t{y} * model.width + x;
                    const Vec3 direction =
                        camera.world_from_camera() *
                        Vec3((float(x) - model.cx) / model.fx, (float(y) - model.cy) / model.fy, 1.0f);
                    const float wall =
                        room.depth_m[i] > 0 ? room.depth_m[i] : std::numeric_limits<float>::infinity();
                    const auto hit = rays.cast({0, place.height_m, 0}, direction, wall);
                    const float depth = hit ? hit->depth : room.depth_m[i],
                                cosine = hit ? hit->cosine : room.cosine[i];
                    of_person += hit.has_value();
                    if (hit.has_value() != (image.user[i] != 0) || std::abs(image.depth_m[i] - depth) > 2e-5f)
                        ++other_surface;
                    else
                        other_slant += std::abs(image.cosine[i] - cosine) > 1e-3f;
                }
            }
            EXPECT_GT(of_person, 20'000) << time_s << " s, detail " << detail;
            EXPECT_LE(other_surface, kRoundedPixels) << time_s << " s, detail " << detail;
            EXPECT_LE(other_slant, kEdgePixels) << time_s << " s, detail " << detail;
        }
    }
}

}  // namespace
}  // namespace vfit::virtual_person
