// What a garment can meet of a body: which skin, spheres and capsules that fill it, triangles that nobody
// sees.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "cloth/contact/contact.h"
#include "geometry/mesh_query.h"
#include "outfit/hidden_skin.h"
#include "outfit/skin_below.h"
#include "outfit/skin_cover.h"
#include "unit/cloth/cloth_support.h"
#include "unit/cloth/post.h"
#include "unit/outfit/people.h"

namespace vfit {
namespace {

using namespace test;

std::vector<Collider> shapes_of(const SkinCover& cover, std::span<const Mat4> matrices) {
    std::vector<Collider> out;
    std::vector<Vec3> places;
    Skin::Scratch scratch;
    cover.append(matrices, out, scratch, places, *Jobs::own(0));
    return out;
}
float outside_of(std::span<const Collider> shapes, const Vec3& p) {
    float least = INFINITY;
    for (const Collider& c : shapes)
        least = std::min(least, nearest_ball(CapsuleShape(capsule_of(c, 0.0f)), p).distance);
    return least;
}

TEST(SkinCover, CoversTheSkinAndSticksOutOfItNoFurther) {
    const Post post(0.1f);
    const DressBody body = post.body();
    const std::vector<uint8_t> below(post.positions.size(), 1);
    const MeshQuery skin(post.positions, post.indices);
    size_t last = 0;
    for (const float tolerance : {0.03f, 0.01f}) {
        const SkinCover cover(body, below, {}, tolerance);
        const std::vector<Collider> shapes = shapes_of(cover, std::vector<Mat4>(2, Mat4(1.0f)));
        ASSERT_EQ(shapes.size(), cover.size());
        EXPECT_GT(shapes.size(), last);
        last = shapes.size();
        for (const Vec3& p : post.positions) EXPECT_LT(outside_of(shapes, p), tolerance + 1e-4f);
        for (const Collider& c : shapes)
            for (const float share : {0.0f, 0.25f, 0.5f, 1.0f}) {
                if (!c.is_capsule() && share > 0.0f) continue;
                const Vec3 center = c.is_capsule() ? glm::mix(c.center, c.center_b, share) : c.center;
                const float radius = c.is_capsule() ? glm::mix(c.radius, c.radius_b, share) : c.radius;
                EXPECT_LT(skin.signed_distance(center) + radius, tolerance + 1e-4f);
            }
    }
    EXPECT_LT(last, post.positions.size() / 8);
}

TEST(SkinBelow, HandsMayPassWhileForearmsAreMet) {
    const Post post(0.1f);
    DressBody body = post.body();
    std::vector<BodyPart> parts(post.positions.size(), BodyPart::kTorso);
    parts[0] = BodyPart::kLeftForearm, parts[1] = BodyPart::kLeftHand;
    parts[2] = BodyPart::kRightForearm, parts[3] = BodyPart::kRightHand;
    body.parts = parts;
    const auto counted = [&](ArmsMet arms) {
        const std::vector<uint8_t> below = below_garment(body, post.positions, arms);
        return std::vector<uint8_t>(below.begin(), below.begin() + 4);
    };
    EXPECT_EQ(counted({true, true}), (std::vector<uint8_t>{1, 1, 1, 1}));
    EXPECT_EQ(counted({true, false}), (std::vector<uint8_t>{1, 0, 1, 0}));
    EXPECT_EQ(counted({false, false}), (std::vector<uint8_t>{0, 0, 0, 0}));
}

TEST(SkinBelow, HandsAreMittens) {
    const Person man(VFIT_SEX_MALE);
    const DressBody body = man.wearer.body();
    const std::vector<uint8_t> all(body.positions.size(), 1);
    const SkinBelow skin = skin_below(body, man.wearer.contact_skin(), all, man.avatar.creases());
    size_t hand = 0, own = 0;
    for (const BodyPart part : body.parts) hand += part == BodyPart::kLeftHand;
    std::vector<Vec3> places;
    Skin::Scratch scratch;
    skin.skin.carry(std::vector<Mat4>(man.avatar.skinning_matrices().size(), Mat4(1.0f)), places, scratch,
                    *Jobs::own(0));
    for (const uint32_t v : skin.vertices) own += body.parts[v] == BodyPart::kLeftHand;
    EXPECT_LT(own, hand / 2) << "fewer vertices";
    for (size_t v = 0; v < skin.vertices.size(); ++v)
        EXPECT_TRUE(body.parts[skin.vertices[v]] != BodyPart::kLeftHand || places[v].x > 0.3f);
    // Cloth that keeps its thickness from the mitten keeps off the hand.
    const MeshQuery surface(places, skin.indices);
    float most_m = 0.0f;
    for (size_t v = 0; v < body.positions.size(); ++v)
        if (body.parts[v] == BodyPart::kLeftHand || body.parts[v] == BodyPart::kRightHand)
            most_m = std::max(most_m, surface.signed_distance(body.positions[v]));
    EXPECT_LT(most_m, 0.004f);
}

TEST(SkinCover, ItIsTheBodysOwnCollidersThatComeFirst) {
    const Post post(0.1f);
    Collider pole;
    pole.center = {0, 0, 0}, pole.center_b = {0, 1, 0};
    pole.radius = pole.radius_b = 0.1f;
    pole.joint_b = 1;
    EXPECT_EQ(
        SkinCover(post.body(), std::vector<uint8_t>(post.positions.size(), 1), {&pole, 1}, 0.01f).size(), 0u);
    EXPECT_EQ(SkinCover(post.body(), std::vector<uint8_t>(post.positions.size(), 0), {}, 0.01f).size(), 0u)
        << "nothing is below";
}

TEST(SkinCover, GoesWithTheBones) {
    const Post post(0.1f);
    const SkinCover cover(post.body(), std::vector<uint8_t>(post.positions.size(), 1), {}, 0.02f);
    const std::vector<Mat4> moved(
        2, glm::rotate(glm::translate(Mat4(1.0f), Vec3(0.3f, 0.1f, -0.2f)), 1.0f, Vec3(0, 0, 1)));
    const std::vector<Collider> shapes = shapes_of(cover, moved);
    for (const Vec3& p : post.positions)
        EXPECT_LT(outside_of(shapes, Vec3(moved[0] * Vec4(p, 1.0f))), 0.0201f);
}

TEST(HiddenSkin, IsWhatNobodySeesUnderASleeve) {
    const Post post(0.1f);
    const Garment g = sleeve(0.11f);  // from 0.3 to 0.7 m
    const auto jobs = Jobs::own(1);
    const auto levels = [&](float margin) {
        const std::vector<uint8_t> hidden =
            hidden_triangles({post.positions, post.indices, g.mesh.positions, g.mesh.indices}, margin, *jobs);
        Vec2 range(1.0f, 0.0f);
        for (size_t t = 0; t < hidden.size(); ++t)
            for (size_t k = 0; hidden[t] && k < 3; ++k) {
                const float y = post.positions[post.indices[3 * t + k]].y;
                range = {std::min(range.x, y), std::max(range.y, y)};
            }
        return range;
    };
    // From above one sees in 1 cm of gap below the edge at a slope of 1 in 20, from below at 45 degrees at
    // most.
    const Vec2 wide = levels(0.0f), narrow = levels(0.06f);
    EXPECT_NEAR(wide.x, 0.35f, 0.051f);
    EXPECT_LT(wide.y, 0.66f);
    EXPECT_GT(wide.y, 0.4f);
    EXPECT_GE(narrow.x, wide.x + 0.049f);
    EXPECT_LE(narrow.y, wide.y - 0.049f);
}

}  // namespace
}  // namespace vfit
