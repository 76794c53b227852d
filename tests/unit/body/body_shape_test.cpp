// Shapes of the parametric body: precision against the uncompressed data, plausibility.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iostream>
#include <limits>
#include <map>
#include <random>
#include <tuple>

#include "core/error.h"
#include "core/files.h"
#include "unit/body/body_fixture.h"

namespace vfit::test {
namespace {

/// The body's enclosed volume, by the divergence theorem.
double volume(const std::vector<Vec3>& positions, const std::vector<uint32_t>& indices) {
    double sum = 0.0;
    for (size_t i = 0; i < indices.size(); i += 3) {
        const Vec3 &a = positions[indices[i]], &b = positions[indices[i + 1]], &c = positions[indices[i + 2]];
        sum += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    return sum;
}

// Written by scripts/bake_body.py --reference from the uncompressed data, in double precision.
struct Reference {
    uint32_t shapes = 0, parameters = 0, points = 0;
    std::vector<float> numbers;  // for each shape: its values, then its points
    const float* values(uint32_t i) const { return numbers.data() + size_t(i) * (parameters + 3 * points); }
};

Reference read_reference() {
    const std::vector<std::byte> bytes =
        read_file(std::string(VFIT_DATA_DIR) + "/../../tests/body_reference.bin");
    Reference reference;
    uint32_t counts[3];
    std::memcpy(counts, bytes.data(), sizeof counts);
    reference.shapes = counts[0];
    reference.parameters = counts[1];
    reference.points = counts[2];
    reference.numbers.resize((bytes.size() - sizeof counts) / sizeof(float));
    std::memcpy(reference.numbers.data(), bytes.data() + sizeof counts,
                reference.numbers.size() * sizeof(float));
    return reference;
}

TEST(BodyShape, EqualsTheUncompressedDataToATenthOfAMillimetre) {
    const Reference reference = read_reference();
    ASSERT_GE(reference.shapes, 8u);
    ASSERT_EQ(reference.parameters, body().parameters().size());
    const size_t vertices = body().topology(0).vertex_count;
    ASSERT_EQ(reference.points, vertices + 2 * body().bones().size());
    std::vector<double> errors_mm;
    EvaluatedBody out;
    for (uint32_t s = 0; s < reference.shapes; ++s) {
        const float* values = reference.values(s);
        body().evaluate({values, reference.parameters}, out);
        for (size_t i = 0; i < reference.points; ++i) {
            const float* exact = values + reference.parameters + 3 * i;
            const size_t end = i - vertices;
            const Vec3 p =
                i < vertices ? out.positions[i] : (end % 2 ? out.bone_tails : out.bone_heads)[end / 2];
            errors_mm.push_back(1000.0 * glm::distance(p, Vec3(exact[0], exact[1], exact[2])));
        }
    }
    std::sort(errors_mm.begin(), errors_mm.end());
    double sum = 0.0;
    for (double e : errors_mm) sum += e;
    std::cout << "error against the uncompressed data, mm: mean " << sum / errors_mm.size() << ", p99 "
              << errors_mm[errors_mm.size() * 99 / 100] << ", max " << errors_mm.back() << " over "
              << reference.shapes << " shapes\n";
    EXPECT_LT(errors_mm.back(), 0.1);
}

TEST(BodyShape, DefaultBodiesHaveTheMeanStatureOfAnsur2) {
    EXPECT_NEAR(stature(evaluated(body().default_shape(VFIT_SEX_FEMALE))), 1.628f, 0.001f);
    EXPECT_NEAR(stature(evaluated(body().default_shape(VFIT_SEX_MALE))), 1.756f, 0.001f);
    const float between = stature(evaluated(body().default_shape(VFIT_SEX_UNKNOWN)));
    EXPECT_GT(between, 1.64f);
    EXPECT_LT(between, 1.75f);
}

TEST(BodyShape, DefaultBodiesHaveAPlausibleVolume) {
    // ANSUR II mean masses are 67.8 and 85.5 kg at a body density near 1 kg/l; the data's bodies are lean.
    const auto& indices = body().topology(0).indices;
    const double female = volume(evaluated(body().default_shape(VFIT_SEX_FEMALE)).positions, indices);
    const double male = volume(evaluated(body().default_shape(VFIT_SEX_MALE)).positions, indices);
    std::cout << "volume of the default bodies, l: " << 1000 * female << " and " << 1000 * male << "\n";
    EXPECT_GT(female, 0.045);
    EXPECT_LT(female, 0.075);
    EXPECT_GT(male, female);
    EXPECT_LT(male, 0.095);
}

TEST(BodyShape, StatureGrowsWithHeight) {
    for (vfit_sex sex : {VFIT_SEX_FEMALE, VFIT_SEX_MALE}) {
        float before = 0.0f;
        for (float height = 0.0f; height <= 1.0f; height += 0.0625f) {
            const float now = stature(evaluated(shape_with(sex, "height", height)));
            EXPECT_GT(now, before) << "height " << height;
            before = now;
        }
    }
}

TEST(BodyShape, VolumeGrowsWithWeightBeyondOne) {
    const auto& indices = body().topology(0).indices;
    double before = 0.0;
    for (float weight : {0.0f, 0.25f, 0.5f, 0.75f, 1.0f, 1.15f}) {
        const double now =
            volume(evaluated(shape_with(VFIT_SEX_FEMALE, "weight", weight)).positions, indices);
        EXPECT_GT(now, before) << "weight " << weight;
        before = now;
    }
}

TEST(BodyShape, StandsOnTheFloorInEveryShape) {
    std::mt19937 random(7);
    for (int i = 0; i < 20; ++i) {
        std::vector<float> shape;
        for (const ShapeParameter& p : body().parameters())
            shape.push_back(std::uniform_real_distribution<float>(p.minimum, p.maximum)(random));
        float lowest = std::numeric_limits<float>::max();
        for (const Vec3& p : evaluated(shape).positions) lowest = std::min(lowest, p.y);
        EXPECT_EQ(lowest, 0.0f);
    }
}

TEST(BodyShape, DefaultBodiesAreSymmetric) {
    for (vfit_sex sex : {VFIT_SEX_FEMALE, VFIT_SEX_MALE}) {
        const EvaluatedBody out = evaluated(body().default_shape(sex));
        // Mirror partners by place: a grid of 1 cm cells, and their neighbours, finds the nearest.
        std::map<std::tuple<int, int, int>, std::vector<Vec3>> grid;
        const auto cell = [](const Vec3& p) {
            return std::tuple(int(std::floor(p.x * 100)), int(std::floor(p.y * 100)),
                              int(std::floor(p.z * 100)));
        };
        for (const Vec3& p : out.positions) grid[cell(p)].push_back(p);
        float worst = 0.0f;
        for (const Vec3& p : out.positions) {
            const Vec3 mirrored(-p.x, p.y, p.z);
            const auto [x, y, z] = cell(mirrored);
            float nearest = 1.0f;
            for (int i = 0; i < 27; ++i) {
                const auto found = grid.find({x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1});
                if (found == grid.end()) continue;
                for (const Vec3& other : found->second)
                    nearest = std::min(nearest, glm::distance(mirrored, other));
            }
            worst = std::max(worst, nearest);
        }
        EXPECT_LT(worst, 0.002f);
        for (size_t i = 0; i < body().bones().size(); ++i) {
            const std::string& name = body().bones()[i].name;
            if (name.size() < 2 || name.substr(name.size() - 2) != ".L") continue;
            const std::string partner = name.substr(0, name.size() - 1) + "R";
            for (size_t j = 0; j < body().bones().size(); ++j) {
                if (body().bones()[j].name != partner) continue;
                const Vec3 mirrored(-out.bone_heads[j].x, out.bone_heads[j].y, out.bone_heads[j].z);
                EXPECT_LT(glm::distance(out.bone_heads[i], mirrored), 0.002f) << name;
            }
        }
    }
}

TEST(BodyShape, LeftIsPositiveXAndItFacesPositiveZ) {
    const EvaluatedBody out = evaluated(body().default_shape(VFIT_SEX_MALE));
    EXPECT_GT(out.bone_heads[body().rig_bone(VFIT_BONE_LEFT_HAND)].x, 0.2f);
    EXPECT_LT(out.bone_heads[body().rig_bone(VFIT_BONE_RIGHT_HAND)].x, -0.2f);
    const int toes = body().rig_bone(VFIT_BONE_LEFT_TOES), foot = body().rig_bone(VFIT_BONE_LEFT_FOOT);
    EXPECT_GT(out.bone_heads[toes].z, out.bone_heads[foot].z + 0.05f);
}

TEST(BodyShape, JointsLieAtTheirShareOfStature) {
    // Bone heads of the data's bodies as shares of stature; women and men differ by 0.01.
    const std::pair<int, float> shares[] = {
        {VFIT_BONE_HIPS, 0.53f},           {VFIT_BONE_NECK, 0.855f},
        {VFIT_BONE_LEFT_UPPER_ARM, 0.80f}, {VFIT_BONE_LEFT_UPPER_LEG, 0.535f},
        {VFIT_BONE_LEFT_LOWER_LEG, 0.29f}, {VFIT_BONE_LEFT_FOOT, 0.04f}};
    for (vfit_sex sex : {VFIT_SEX_FEMALE, VFIT_SEX_MALE}) {
        const EvaluatedBody out = evaluated(body().default_shape(sex));
        for (const auto& [bone, share] : shares)
            EXPECT_NEAR(out.bone_heads[body().rig_bone(bone)].y / stature(out), share, 0.025f) << bone;
    }
}

TEST(BodyShape, ASliderMovesItsOwnPartOnly) {
    const EvaluatedBody plain = evaluated(body().default_shape(VFIT_SEX_FEMALE));
    const EvaluatedBody wide = evaluated(shape_with(VFIT_SEX_FEMALE, "measure-waist-circ", 1.0f));
    const auto& parts = body().topology(0).parts;
    float torso = 0.0f, elsewhere = 0.0f;
    for (size_t i = 0; i < plain.positions.size(); ++i) {
        const float moved = glm::distance(plain.positions[i], wide.positions[i]);
        const bool far = parts[i] == BodyPart::kHead || parts[i] == BodyPart::kLeftShank ||
                         parts[i] == BodyPart::kRightHand;
        float& most = far ? elsewhere : torso;
        most = std::max(most, moved);
    }
    EXPECT_GT(torso, 0.02f);
    EXPECT_LT(elsewhere, 0.0001f);
}

TEST(BodyShape, ValuesBeyondTheRangeAreClamped) {
    const EvaluatedBody most = evaluated(shape_with(VFIT_SEX_MALE, "weight", 1.15f));
    const EvaluatedBody more = evaluated(shape_with(VFIT_SEX_MALE, "weight", 9.0f));
    EXPECT_EQ(most.positions, more.positions);
}

TEST(BodyShape, ShapesThatAreNoShapesAreRefused) {
    EvaluatedBody out;
    std::vector<float> shape = body().default_shape(VFIT_SEX_MALE);
    shape[3] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(body().evaluate(shape, out), Error);
    shape.resize(5);
    EXPECT_THROW(body().evaluate(shape, out), Error);
    EXPECT_THROW(body().default_shape(7), Error);
    EXPECT_EQ(body().parameter("no-such-slider"), -1);
}

TEST(BodyShape, HasThePhenotypesAndTheFitRelevantSliders) {
    for (const char* key :
         {"gender", "age", "muscle", "weight", "height", "proportions", "cupsize", "firmness",
          "measure-bust-circ", "measure-waist-circ", "measure-hips-circ", "measure-neck-circ",
          "measure-shoulder-dist", "measure-upperarm-length", "measure-thigh-circ",
          "measure-napetowaist-dist", "stomach-tone", "buttocks-volume", "l-upperarm-fat"})
        EXPECT_GE(body().parameter(key), 0) << key;
    EXPECT_GE(body().parameters().size(), 108u);
}

TEST(BodyShape, EvaluatesWithoutMovingItsBuffers) {
    EvaluatedBody out;
    body().evaluate(body().default_shape(VFIT_SEX_FEMALE), out);
    const Vec3* positions = out.positions.data();
    const float* scratch = out.scratch.data();
    body().evaluate(body().default_shape(VFIT_SEX_MALE), out);
    EXPECT_EQ(positions, out.positions.data());
    EXPECT_EQ(scratch, out.scratch.data());
}

}  // namespace
}  // namespace vfit::test
