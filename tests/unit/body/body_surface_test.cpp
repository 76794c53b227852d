// Topology, UV seams and skin of the body at its levels of detail.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <map>
#include <set>

#include "core/error.h"
#include "unit/body/body_fixture.h"

namespace vfit::test {
namespace {

std::vector<Vec3> at_level(uint32_t level) {
    std::vector<Vec3> out;
    body().subdivide(level, evaluated(body().default_shape(VFIT_SEX_FEMALE)).positions, out);
    return out;
}

TEST(BodySurface, LevelsOfDetailHaveTheirCounts) {
    const uint32_t vertices[] = {13718, 54848, 219368}, triangles[] = {27420, 109680, 438720};
    for (uint32_t level = 0; level < kBodyLevels; ++level) {
        const BodyTopology& t = body().topology(level);
        EXPECT_EQ(t.vertex_count, vertices[level]);
        EXPECT_EQ(t.indices.size(), 3u * triangles[level]);
        EXPECT_EQ(t.render_indices.size(), t.indices.size());
        EXPECT_EQ(t.render_vertex_count, t.vertex_count + t.seam_sources.size());
        EXPECT_EQ(t.uvs.size(), t.render_vertex_count);
        EXPECT_EQ(t.skin_bones.size(), t.render_vertex_count);
        EXPECT_EQ(t.skin_weights.size(), t.render_vertex_count);
        EXPECT_EQ(t.parts.size(), t.render_vertex_count);
        EXPECT_GT(t.seam_sources.size(), 0u);
        EXPECT_LT(t.render_vertex_count, t.vertex_count * 11 / 10);
    }
    EXPECT_THROW(body().topology(4), Error);
}

TEST(BodySurface, TheCoarseOneIsThatOfTheFineBodyWithFewerVertices) {
    const BodyTopology& t = body().topology(kCoarseBody);
    EXPECT_NEAR(double(t.vertex_count), double(kCoarseVertices), 0.05 * kCoarseVertices);
    EXPECT_EQ(t.uvs.size(), t.render_vertex_count);
    const auto fine = at_level(0), coarse = at_level(kCoarseBody);
    ASSERT_EQ(coarse.size(), t.vertex_count);
    const auto volume = [](const std::vector<Vec3>& p, const std::vector<uint32_t>& i) {
        double sum = 0.0;
        for (size_t k = 0; k < i.size(); k += 3)
            sum += double(glm::dot(p[i[k]], glm::cross(p[i[k + 1]], p[i[k + 2]]))) / 6.0;
        return sum;
    };
    const double ratio = volume(coarse, t.indices) / volume(fine, body().topology(0).indices);
    std::cout << "coarse body: " << t.vertex_count << " vertices, " << ratio << " of the volume\n";
    EXPECT_NEAR(ratio, 1.0, 0.05);  // its corners lie on the skin, its faces inside
}

TEST(BodySurface, EveryEdgeHasExactlyTwoTrianglesThatRunItInOppositeDirections) {
    for (uint32_t level = 0; level <= kCoarseBody; ++level) {
        const std::vector<uint32_t>& indices = body().topology(level).indices;
        std::set<uint64_t> directed;
        for (size_t i = 0; i < indices.size(); i += 3)
            for (size_t k = 0; k < 3; ++k)
                ASSERT_TRUE(
                    directed.insert(uint64_t(indices[i + k]) << 32 | indices[i + (k + 1) % 3]).second);
        for (uint64_t edge : directed) ASSERT_TRUE(directed.count(edge << 32 | edge >> 32));
    }
}

TEST(BodySurface, RenderTrianglesAreTheGeometricOnes) {
    for (uint32_t level = 0; level <= kCoarseBody; ++level) {
        const BodyTopology& t = body().topology(level);
        for (size_t i = 0; i < t.indices.size(); ++i) {
            const uint32_t v = t.render_indices[i];
            ASSERT_LT(v, t.render_vertex_count);
            ASSERT_EQ(v < t.vertex_count ? v : t.seam_sources[v - t.vertex_count], t.indices[i]);
        }
    }
}

TEST(BodySurface, TrianglesFaceOutwards) {
    for (uint32_t level = 0; level <= kCoarseBody; ++level) {
        const std::vector<uint32_t>& indices = body().topology(level).indices;
        const std::vector<Vec3> p = at_level(level);
        double volume = 0.0;
        for (size_t i = 0; i < indices.size(); i += 3)
            volume += glm::dot(p[indices[i]], glm::cross(p[indices[i + 1]], p[indices[i + 2]])) / 6.0;
        EXPECT_GT(volume, 0.04) << "level " << level;
    }
}

TEST(BodySurface, NoTriangleCrossesTheWholeTexture) {
    for (uint32_t level = 0; level <= kCoarseBody; ++level) {
        const BodyTopology& t = body().topology(level);
        for (const Vec2& uv : t.uvs)
            ASSERT_TRUE(uv.x >= 0.0f && uv.x <= 1.0f && uv.y >= 0.0f && uv.y <= 1.0f);
        float longest = 0.0f;
        for (size_t i = 0; i < t.render_indices.size(); i += 3)
            for (size_t k = 0; k < 3; ++k)
                longest = std::max(longest, glm::distance(t.uvs[t.render_indices[i + k]],
                                                          t.uvs[t.render_indices[i + (k + 1) % 3]]));
        EXPECT_LT(longest, level == kCoarseBody ? 0.2f : 0.1f / float(1u << level)) << "level " << level;
    }
}

TEST(BodySurface, TheTextureCountsVFromTheTopOfThePicture) {
    // The data's head lies in the upper half of its texture.
    const BodyTopology& t = body().topology(0);
    double head_v = 0.0, count = 0.0;
    for (uint32_t i = 0; i < t.vertex_count; ++i)
        if (t.parts[i] == BodyPart::kHead) head_v += t.uvs[i].y, count += 1.0;
    EXPECT_LT(head_v / count, 0.5);
}

TEST(BodySurface, SkinWeightsSumToOneAndAreSorted) {
    for (uint32_t level = 0; level <= kCoarseBody; ++level) {
        const BodyTopology& t = body().topology(level);
        for (uint32_t v = 0; v < t.render_vertex_count; ++v) {
            float sum = 0.0f;
            for (int i = 0; i < kSkinBones; ++i) {
                ASSERT_GE(t.skin_weights[v][i], 0.0f);
                ASSERT_LT(t.skin_bones[v][i], body().bones().size());
                ASSERT_LE(t.skin_weights[v][i], t.skin_weights[v][std::max(i, 1) - 1]);
                sum += t.skin_weights[v][i];
            }
            ASSERT_NEAR(sum, 1.0f, 1e-5f);
        }
    }
}

TEST(BodySurface, SeamCopiesHaveTheSkinOfTheirSource) {
    const BodyTopology& t = body().topology(1);
    for (uint32_t i = 0; i < t.seam_sources.size(); ++i) {
        ASSERT_LT(t.seam_sources[i], t.vertex_count);
        ASSERT_EQ(t.skin_weights[t.vertex_count + i], t.skin_weights[t.seam_sources[i]]);
        ASSERT_NE(t.uvs[t.vertex_count + i], t.uvs[t.seam_sources[i]]);
    }
}

TEST(BodySurface, SubdividedSkinStaysNearTheCoarseSkin) {
    const BodyTopology &coarse = body().topology(0), &fine = body().topology(1);
    double changed = 0.0;
    for (uint32_t v = 0; v < coarse.vertex_count; ++v)
        changed += coarse.skin_bones[v][0] != fine.skin_bones[v][0];
    EXPECT_LT(changed / coarse.vertex_count, 0.03);
}

TEST(BodySurface, SubdivisionKeepsTheBodyWithinAFewMillimetres) {
    const std::vector<Vec3> coarse = at_level(0);
    for (uint32_t level : {1u, 2u}) {
        const std::vector<Vec3> fine = at_level(level);
        ASSERT_EQ(fine.size(), body().topology(level).vertex_count);
        double sum = 0.0;
        float worst = 0.0f, top = 0.0f;
        for (size_t i = 0; i < coarse.size(); ++i) {
            const float moved = glm::distance(coarse[i], fine[i]);
            sum += moved;
            worst = std::max(worst, moved);
        }
        for (const Vec3& p : fine) top = std::max(top, p.y);
        std::cout << "level " << level << ": vertices of level 0 move by " << 1000 * sum / coarse.size()
                  << " mm on average, " << 1000 * worst << " mm at most; stature " << top << " m\n";
        EXPECT_LT(sum / coarse.size(), 0.001);
        EXPECT_LT(worst, 0.012f);
        EXPECT_NEAR(top, 1.628f, 0.004f);
    }
}

TEST(BodySurface, SubdividesWithoutMovingItsBuffer) {
    std::vector<Vec3> out;
    const std::vector<Vec3> base = evaluated(body().default_shape(VFIT_SEX_MALE)).positions;
    body().subdivide(2, base, out);
    const Vec3* data = out.data();
    const auto begin = std::chrono::steady_clock::now();
    body().subdivide(2, base, out);
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - begin;
    std::cout << "subdivision to level 2: " << elapsed.count() << " ms\n";
    EXPECT_EQ(data, out.data());
    EXPECT_THROW(body().subdivide(1, {}, out), Error);
}

TEST(BodyRig, BonesAreTheHumanoidOnesWithTwistSegmentsAndFingers) {
    std::map<std::string, int> index;
    const auto& bones = body().bones();
    for (size_t i = 0; i < bones.size(); ++i) {
        EXPECT_LT(bones[i].parent, int(i));
        index[bones[i].name] = int(i);
    }
    EXPECT_EQ(bones[0].bone, VFIT_BONE_HIPS);
    for (int bone = 0; bone < int(VFIT_BONE_COUNT); ++bone)
        EXPECT_EQ(bones[body().rig_bone(bone)].bone, bone);
    for (const char* twist : {"upperarm02.L", "lowerarm02.R", "upperleg02.L", "lowerleg02.R"})
        EXPECT_EQ(bones.at(index.at(twist)).bone, -1) << twist;
    EXPECT_TRUE(index.count("finger2-3.L"));
    EXPECT_EQ(bones[index.at("toes.L")].parent, index.at("foot.L"));
    for (const auto& [name, i] : index)
        for (const char* gone : {"breast", "eye", "jaw", "tongue", "oris", "toe1", "levator"})
            EXPECT_EQ(name.rfind(gone, 0), std::string::npos) << name;
}

TEST(BodyRig, PartsLieWhereTheirNamesSay) {
    const BodyTopology& t = body().topology(0);
    const std::vector<Vec3> p = at_level(0);
    std::array<Vec3, kBodyPartCount> centre{};
    std::array<float, kBodyPartCount> count{};
    for (uint32_t v = 0; v < t.vertex_count; ++v) {
        centre[size_t(t.parts[v])] += p[v];
        count[size_t(t.parts[v])] += 1.0f;
    }
    for (int i = 0; i < kBodyPartCount; ++i) {
        ASSERT_GT(count[i], 100.0f) << i;
        centre[i] /= count[i];
    }
    const auto at = [&](BodyPart part) { return centre[size_t(part)]; };
    EXPECT_GT(at(BodyPart::kHead).y, at(BodyPart::kTorso).y + 0.2f);
    EXPECT_GT(at(BodyPart::kLeftUpperArm).y, at(BodyPart::kLeftForearm).y);
    EXPECT_GT(at(BodyPart::kLeftForearm).y, at(BodyPart::kLeftHand).y);
    EXPECT_GT(at(BodyPart::kLeftHand).x, 0.2f);
    EXPECT_LT(at(BodyPart::kRightHand).x, -0.2f);
    EXPECT_GT(at(BodyPart::kRightThigh).y, at(BodyPart::kRightShank).y + 0.2f);
    EXPECT_LT(at(BodyPart::kRightFoot).y, 0.1f);
}

}  // namespace
}  // namespace vfit::test
