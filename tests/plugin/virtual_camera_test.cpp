// The virtual depth camera against closed-form scenes.
#include <cmath>

#include <gtest/gtest.h>

#include "depth_camera.h"

namespace vfit::virtual_person {
namespace {

const SensorModel& kIdeal = *find_sensor_model("ideal");

struct Mesh {
    std::vector<float> positions;
    std::vector<uint32_t> triangles;
    uint32_t vertex_count() const { return static_cast<uint32_t>(positions.size() / 3); }
};

Mesh sphere(const Vec3& centre, float radius, uint32_t rings) {
    Mesh mesh;
    const uint32_t columns = 2 * rings;
    for (uint32_t i = 0; i <= rings; ++i) {
        for (uint32_t j = 0; j <= columns; ++j) {
            const float a = kPi * float(i) / float(rings), b = 2 * kPi * float(j) / float(columns);
            const Vec3 p =
                centre + radius * Vec3(std::sin(a) * std::cos(b), std::cos(a), std::sin(a) * std::sin(b));
            mesh.positions.insert(mesh.positions.end(), {p.x, p.y, p.z});
        }
    }
    for (uint32_t i = 0; i < rings; ++i) {
        for (uint32_t j = 0; j < columns; ++j) {
            const uint32_t a = i * (columns + 1) + j, b = a + columns + 1;
            mesh.triangles.insert(mesh.triangles.end(), {a, b, a + 1, a + 1, b, b + 1});
        }
    }
    return mesh;
}

Mesh quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    Mesh mesh;
    for (const Vec3& p : {a, b, c, d}) mesh.positions.insert(mesh.positions.end(), {p.x, p.y, p.z});
    mesh.triangles = {0, 1, 2, 0, 2, 3};
    return mesh;
}

Vec3 unproject(uint32_t x, uint32_t y, float z) {
    return {(float(x) - kIdeal.cx) / kIdeal.fx * z, (float(y) - kIdeal.cy) / kIdeal.fy * z, z};
}

CleanImage render(const CameraPlace& place, const Room& room, const Mesh& mesh) {
    DepthCamera camera(kIdeal, place, room);
    camera.set_triangles(mesh.triangles, mesh.vertex_count());
    CleanImage image;
    camera.render(mesh.positions.data(), image);
    return image;
}

TEST(DepthCamera, FloorPixelsLieAtHeightZeroWhateverTheTilt) {
    for (const float tilt_deg : {-10.0f, 0.0f, 15.0f, 30.0f}) {
        const CameraPlace place{1.2f, glm::radians(tilt_deg)};
        DepthCamera camera(kIdeal, place, {});
        CleanImage image;
        camera.render(nullptr, image);
        size_t floor = 0;
        for (uint32_t y = 0; y < kIdeal.height; ++y) {
            for (uint32_t x = 0; x < kIdeal.width; ++x) {
                const float z = image.depth_m[size_t{y} * kIdeal.width + x];
                if (z <= 0.0f || z > 10.0f) continue;
                const Vec3 p = camera.world_from_camera() * unproject(x, y, z) + Vec3(0, place.height_m, 0);
                ASSERT_NEAR(p.y, 0.0f, 1e-4f) << x << ", " << y << " at " << tilt_deg;
                ++floor;
            }
        }
        EXPECT_GT(floor, 30000u) << tilt_deg;
    }
}

TEST(DepthCamera, WallsStandWhereTheyAreSaidToStand) {
    DepthCamera camera(kIdeal, {1.0f, 0}, {3.0f, 1.0f});
    CleanImage image;
    camera.render(nullptr, image);
    EXPECT_FLOAT_EQ(image.depth_m[100 * 640 + 340], 3.0f) << "back wall, by its distance along the axis";
    const Vec3 side = unproject(20, 240, image.depth_m[240 * 640 + 20]);
    EXPECT_NEAR(side.x, -1.0f, 1e-5f);
    EXPECT_NEAR(image.cosine[243 * 640 + 339], 1.0f, 1e-4f) << "the back wall is seen at a right angle";
}

TEST(DepthCamera, DepthOfAPlaneIsExact) {
    // A board at z = -2, slanted by 45 degrees about the vertical: its depth is 2 - x in world coordinates.
    const Mesh mesh =
        quad({-0.5f, 0.2f, -2.5f}, {0.5f, 0.2f, -1.5f}, {0.5f, 1.8f, -1.5f}, {-0.5f, 1.8f, -2.5f});
    const CleanImage image = render({1.0f, 0}, {5.0f, 0}, mesh);
    size_t seen = 0;
    for (uint32_t y = 0; y < kIdeal.height; ++y) {
        for (uint32_t x = 0; x < kIdeal.width; ++x) {
            const size_t i = size_t{y} * kIdeal.width + x;
            if (!image.user[i]) continue;
            const Vec3 p = unproject(x, y, image.depth_m[i]);
            ASSERT_NEAR(p.z, 2.0f - p.x, 1e-4f);
            const float expected = std::abs(glm::dot(glm::normalize(p), glm::normalize(Vec3(1, 0, 1))));
            ASSERT_NEAR(image.cosine[i], expected, 1e-3f);
            ++seen;
        }
    }
    EXPECT_GT(seen, 60000u);
}

TEST(DepthCamera, DepthOfASphereIsExactToAMillimetre) {
    const Vec3 centre(0.1f, 1.2f, -2.0f);
    const float radius = 0.4f;
    const CleanImage image = render({1.0f, glm::radians(5.0f)}, {5.0f, 0}, sphere(centre, radius, 180));
    const DepthCamera camera(kIdeal, {1.0f, glm::radians(5.0f)}, {});
    const Vec3 c = camera.to_camera(centre);
    size_t inside = 0;
    for (uint32_t y = 0; y < kIdeal.height; ++y) {
        for (uint32_t x = 0; x < kIdeal.width; ++x) {
            const size_t i = size_t{y} * kIdeal.width + x;
            const Vec3 d = glm::normalize(unproject(x, y, 1.0f));
            const float along = glm::dot(d, c), off2 = glm::dot(c, c) - along * along;
            if (off2 < 0.98f * radius * radius) {
                ASSERT_EQ(image.user[i], 1) << "hole at " << x << ", " << y;
                const float t = along - std::sqrt(radius * radius - off2);
                if (off2 < 0.8f * radius * radius) {
                    ASSERT_NEAR(image.depth_m[i], t * d.z, 1e-3f);
                }
                ++inside;
            } else if (off2 > radius * radius) {
                ASSERT_EQ(image.user[i], 0) << x << ", " << y;
            }
        }
    }
    EXPECT_GT(inside, 30000u);
}

TEST(DepthCamera, WhatTheMeshLeavesIsForgottenInTheNextFrame) {
    Mesh mesh = sphere({-0.5f, 1.0f, -2.0f}, 0.2f, 40);
    DepthCamera camera(kIdeal, {1.0f, 0}, {4.0f, 0});
    camera.set_triangles(mesh.triangles, mesh.vertex_count());
    CleanImage moved, fresh;
    camera.render(mesh.positions.data(), moved);
    const Mesh right = sphere({0.5f, 1.0f, -2.0f}, 0.2f, 40);
    camera.render(right.positions.data(), moved);
    fresh = render({1.0f, 0}, {4.0f, 0}, right);
    EXPECT_EQ(moved.user, fresh.user);
    EXPECT_EQ(moved.depth_m, fresh.depth_m);
}

TEST(DepthCamera, AMeshThatPassesBehindTheCameraIsStillSeenInFront) {
    const Mesh mesh = quad({-1, 0.9f, 1}, {1, 0.9f, 1}, {1, 0.9f, -3}, {-1, 0.9f, -3});
    const CleanImage image = render({1.0f, 0}, {5.0f, 0}, mesh);
    const size_t i = size_t{400} * kIdeal.width + 320;
    ASSERT_EQ(image.user[i], 1);
    EXPECT_NEAR(image.depth_m[i], 0.1f * kIdeal.fy / (400 - kIdeal.cy), 1e-4f);
}

}  // namespace
}  // namespace vfit::virtual_person
