// Garments with lengths of their own: sizes, how they sit, what cannot be worn, how they look.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <string_view>

#include "contract/support.h"

namespace {

constexpr float kGarmentStep_s = 1.0f / 60.0f;

class GarmentsTest : public contract::ContextTest {
protected:
    vfit_avatar body(std::vector<std::pair<const char*, float>> shape = {}, vfit_sex sex = VFIT_SEX_FEMALE) {
        vfit_avatar_desc desc = vfit_avatar_desc_init();
        desc.sex = sex;
        std::vector<vfit_shape_value> values;
        for (const auto& [key, value] : shape) {
            values.push_back(vfit_shape_value_init());
            std::strcpy(values.back().key, key);
            values.back().value = value;
        }
        vfit_avatar made{};
        EXPECT_EQ(vfit_avatar_create_from_shape(context, &desc, values.data(), sizeof(vfit_shape_value),
                                                uint32_t(values.size()), &made),
                  VFIT_OK)
            << contract::last_error();
        return made;
    }
    vfit_garment open(const char* name) {
        vfit_garment garment{};
        EXPECT_EQ(vfit_garment_open(context, name, &garment), VFIT_OK) << contract::last_error();
        return garment;
    }
    vfit_result put_on(vfit_avatar avatar, vfit_garment garment, const char* size, uint32_t flags,
                       vfit_cloth& out) {
        vfit_cloth_desc desc = vfit_cloth_desc_init();
        desc.flags = VFIT_CLOTH_SKIN | flags;
        desc.size_label = size;
        return vfit_cloth_create(avatar, garment, &desc, &out);
    }
    vfit_cloth worn(vfit_avatar avatar, vfit_garment garment, const char* size, int steps = 45) {
        vfit_cloth cloth{};
        EXPECT_EQ(put_on(avatar, garment, size, VFIT_CLOTH_ANY_FIT, cloth), VFIT_OK)
            << contract::last_error();
        for (int i = 0; i < steps; ++i)
            EXPECT_EQ(vfit_cloth_step(cloth, kGarmentStep_s), VFIT_OK) << contract::last_error();
        return cloth;
    }
    static std::vector<vfit_fit_zone> fit_of(vfit_cloth cloth) {
        uint32_t count = 0;
        EXPECT_EQ(vfit_cloth_fit(cloth, nullptr, sizeof(vfit_fit_zone), &count), VFIT_OK)
            << contract::last_error();
        std::vector<vfit_fit_zone> zones(count);
        EXPECT_EQ(vfit_cloth_fit(cloth, zones.data(), sizeof(vfit_fit_zone), &count), VFIT_OK)
            << contract::last_error();
        return zones;
    }
    static vfit_fit_zone zone(vfit_cloth cloth, const std::string& key) {
        for (const vfit_fit_zone& z : fit_of(cloth))
            if (key == z.key) return z;
        ADD_FAILURE() << "there is no " << key;
        return vfit_fit_zone_init();
    }
    static float lowest_m(vfit_cloth cloth) {
        float lowest = INFINITY;
        for (const auto& p : positions(cloth)) lowest = std::min(lowest, p[1]);
        return lowest;
    }
    static uint64_t hash(vfit_cloth cloth) {
        uint64_t out = 0;
        EXPECT_EQ(vfit_cloth_state_hash(cloth, &out), VFIT_OK);
        return out;
    }
    static std::vector<std::array<float, 3>> positions(vfit_cloth cloth) {
        vfit_frame frame{};
        EXPECT_EQ(vfit_cloth_acquire(cloth, &frame), VFIT_OK);
        vfit_view view = vfit_view_init();
        EXPECT_EQ(vfit_frame_view(frame, VFIT_STREAM_POSITION, &view), VFIT_OK);
        std::vector<std::array<float, 3>> out(view.width);
        std::memcpy(out.data(), view.data, out.size() * sizeof out[0]);
        vfit_frame_release(frame);
        return out;
    }
};

TEST_F(GarmentsTest, KeepTheirLengthsAndTellHowTheySit) {
    const vfit_avatar avatar = body();
    const vfit_garment dress = open("sundress_pattern");
    const vfit_fit_zone xs = zone(worn(avatar, dress, "XS"), "chest_girth_m"),
                        s = zone(worn(avatar, dress, "S"), "chest_girth_m"),
                        xl = zone(worn(avatar, dress, "XL"), "chest_girth_m");
    EXPECT_EQ(xs.fit, VFIT_FIT_TIGHT);  // the default woman's chest of 84 cm is an S by EN 13402-3
    EXPECT_EQ(s.fit, VFIT_FIT_RIGHT);
    EXPECT_EQ(xl.fit, VFIT_FIT_LOOSE);
    // Drawn with 6 cm of ease over the size's own girth: 78, 86, 113 cm.
    EXPECT_NEAR(xs.garment_m, 0.84f, 0.02f);
    EXPECT_NEAR(s.garment_m, 0.92f, 0.02f);
    EXPECT_NEAR(xl.garment_m, 1.19f, 0.02f);
    for (const vfit_fit_zone& z : {xs, s, xl}) EXPECT_NEAR(z.ease_m, z.garment_m - z.body_m, 1e-5f);
    EXPECT_GT(xs.strain, s.strain);
}

TEST_F(GarmentsTest, TellTheSameGirthsWithFewSubstepsWhichLetThemSag) {
    const vfit_avatar avatar = body();
    vfit_cloth few = worn(avatar, open("duster"), "S", 90);
    const float lowest_few = lowest_m(few), hip_few = zone(few, "hip_girth_m").garment_m;
    ASSERT_EQ(vfit_cloth_set_quality(few, 32, 0.0f), VFIT_OK);
    for (int i = 0; i < 180; ++i) ASSERT_EQ(vfit_cloth_step(few, kGarmentStep_s), VFIT_OK);
    EXPECT_GT(lowest_m(few), lowest_few + 0.015f) << "it did sag";
    EXPECT_NEAR(zone(few, "hip_girth_m").garment_m, hip_few, 0.015f);
}

TEST_F(GarmentsTest, OneThatDoesNotCloseIsRefusedWithTheGirthAndTheFabric) {
    const vfit_avatar heavy = body({{"weight", 1.15f}});
    const vfit_garment jeans = open("jeans_women");
    vfit_cloth cloth{};
    EXPECT_EQ(put_on(heavy, jeans, "XS", 0, cloth), VFIT_ERROR_NOT_WEARABLE);
    EXPECT_EQ(cloth.id, 0u);
    const std::string why = contract::last_error();
    for (const char* word : {"jeans_women", "XS", "hip_girth_m", "denim"})
        EXPECT_NE(why.find(word), std::string::npos) << why;
    EXPECT_EQ(put_on(heavy, jeans, "XS", VFIT_CLOTH_ANY_FIT, cloth), VFIT_OK) << contract::last_error();
    EXPECT_EQ(put_on(heavy, jeans, "XL", 0, cloth), VFIT_OK) << contract::last_error();
    const uint64_t before = hash(cloth);
    EXPECT_EQ(vfit_cloth_set_size(cloth, "XS"), VFIT_ERROR_NOT_WEARABLE);
    EXPECT_EQ(vfit_cloth_set_size(cloth, "XXXXL"), VFIT_ERROR_ARGUMENT);
    EXPECT_NE(std::string(contract::last_error()).find("XS, S, M"), std::string::npos)
        << contract::last_error();
    EXPECT_EQ(hash(cloth), before);
}

TEST_F(GarmentsTest, OneWhoseArmholesAreTooSmallIsRefusedAndTheOldSizeStaysOn) {
    const vfit_avatar tall = body({{"height", 0.72f}}, VFIT_SEX_MALE);
    const vfit_garment vest = open("vest");
    vfit_cloth cloth{};
    EXPECT_EQ(put_on(tall, vest, "M", 0, cloth), VFIT_ERROR_NOT_WEARABLE);  // its chest would close
    const std::string why = contract::last_error();
    for (const char* word : {"vest", "size M", "opening", "wool_suiting"})
        EXPECT_NE(why.find(word), std::string::npos) << why;
    EXPECT_EQ(put_on(tall, vest, "M", VFIT_CLOTH_ANY_FIT, cloth), VFIT_OK) << contract::last_error();
    EXPECT_EQ(put_on(tall, vest, "XXL", 0, cloth), VFIT_OK) << contract::last_error();
    const auto of_xxl = positions(cloth);
    const uint64_t state_of_xxl = hash(cloth);
    EXPECT_EQ(vfit_cloth_set_size(cloth, "M"), VFIT_ERROR_NOT_WEARABLE);
    EXPECT_EQ(hash(cloth), state_of_xxl);
    EXPECT_EQ(positions(cloth), of_xxl);
}

TEST_F(GarmentsTest, TrousersHangWhereTheyWereDrafted) {
    const vfit_avatar man = body({}, VFIT_SEX_MALE);
    vfit_cloth_desc desc = vfit_cloth_desc_init();
    desc.flags = VFIT_CLOTH_SKIN;
    desc.size_label = "S";
    desc.substeps = 32;
    vfit_cloth cloth{};
    ASSERT_EQ(vfit_cloth_create(man, open("pants_men"), &desc, &cloth), VFIT_OK) << contract::last_error();
    for (int i = 0; i < 60; ++i) ASSERT_EQ(vfit_cloth_step(cloth, kGarmentStep_s), VFIT_OK);
    // Drawn with 6.3 cm over this body's hips; 3 cm lower their cloth is 1 cm narrower.
    EXPECT_NEAR(zone(cloth, "hip_girth_m").ease_m, 0.063f, 0.008f);
}

TEST_F(GarmentsTest, TrousersThatAreTooShortInTheRiseAreRefused) {
    const vfit_avatar tall = body({{"height", 0.72f}}, VFIT_SEX_MALE);
    const vfit_garment pants = open("pants_men");
    vfit_cloth cloth{};
    EXPECT_EQ(put_on(tall, pants, "S", 0, cloth),
              VFIT_ERROR_NOT_WEARABLE);  // around waist and hips they would go
    const std::string why = contract::last_error();
    for (const char* word : {"pants_men", "size S", "crotch", "cotton_woven"})
        EXPECT_NE(why.find(word), std::string::npos) << why;
    EXPECT_EQ(put_on(tall, pants, "L", 0, cloth), VFIT_OK) << contract::last_error();
}

TEST_F(GarmentsTest, OneThatClosesButIsStretchedAllOverIsRefused) {
    const vfit_avatar broad = body({{"height", 0.98f}, {"weight", 1.05f}, {"muscle", 0.8f}}, VFIT_SEX_FEMALE);
    const vfit_garment shirt = open("shirt_men");
    vfit_cloth cloth{};
    EXPECT_EQ(put_on(broad, shirt, "L", 0, cloth), VFIT_ERROR_NOT_WEARABLE);
    const std::string why = contract::last_error();
    for (const char* word : {"shirt_men", "size L", "a tenth", "light_woven"})
        EXPECT_NE(why.find(word), std::string::npos) << why;
    EXPECT_EQ(put_on(broad, shirt, "XXL", 0, cloth), VFIT_OK) << contract::last_error();
}

TEST_F(GarmentsTest, OneThatSlidesToWhereItHasRoomIsWorn) {
    const vfit_avatar tall = body({{"height", 0.72f}}, VFIT_SEX_MALE);
    vfit_cloth cloth{};
    // At first a tenth of it is stretched by more than 16 %; cotton_woven gives 15 %.
    ASSERT_EQ(put_on(tall, open("martial_jacket"), "M", 0, cloth), VFIT_OK) << contract::last_error();
    for (int i = 0; i < 60; ++i) ASSERT_EQ(vfit_cloth_step(cloth, kGarmentStep_s), VFIT_OK);
    vfit_cloth_stats stats = vfit_cloth_stats_init();
    ASSERT_EQ(vfit_cloth_describe(cloth, &stats), VFIT_OK);
    EXPECT_LT(stats.strain_p99, 0.2f);
}

TEST_F(GarmentsTest, SleevesAndLegsThatAreTooLongAreTakenUpAndTheirLengthIsTold) {
    const auto taken_up = [](vfit_cloth cloth) {
        vfit_cloth_stats stats = vfit_cloth_stats_init();
        EXPECT_EQ(vfit_cloth_describe(cloth, &stats), VFIT_OK) << contract::last_error();
        return stats;
    };
    const vfit_avatar small = body({{"height", 0.28f}, {"weight", 0.35f}});
    const vfit_cloth_stats trousers = taken_up(worn(small, open("jeans_women"), "M", 1));
    EXPECT_NEAR(trousers.legs_taken_up_m, 0.13f, 0.04f);
    EXPECT_EQ(trousers.sleeves_taken_up_m, 0.0f);
    const vfit_cloth_stats shirt = taken_up(worn(small, open("shirt_men"), "M", 1));
    EXPECT_GT(shirt.sleeves_taken_up_m, 0.05f);
    EXPECT_EQ(shirt.legs_taken_up_m, 0.0f);
    EXPECT_EQ(taken_up(worn(small, open("jeans_women"), nullptr, 1)).legs_taken_up_m, 0.0f)
        << "made to measure";
}

TEST_F(GarmentsTest, ChangeTheirSizeWhileTheyAreWorn) {
    const vfit_avatar avatar = body();
    const vfit_garment dress = open("sundress_pattern");
    vfit_cloth cloth = worn(avatar, dress, "S");
    const auto before = positions(cloth);
    ASSERT_EQ(vfit_cloth_set_size(cloth, "XL"), VFIT_OK) << contract::last_error();
    for (int i = 0; i < 45; ++i) ASSERT_EQ(vfit_cloth_step(cloth, kGarmentStep_s), VFIT_OK);
    EXPECT_EQ(positions(cloth).size(), before.size());
    EXPECT_NEAR(zone(cloth, "chest_girth_m").garment_m,
                zone(worn(avatar, dress, "XL"), "chest_girth_m").garment_m, 0.02f);
    ASSERT_EQ(vfit_cloth_set_size(cloth, nullptr), VFIT_OK) << contract::last_error();
    for (int i = 0; i < 45; ++i) ASSERT_EQ(vfit_cloth_step(cloth, kGarmentStep_s), VFIT_OK);
    // Made to the avatar, who is the body that it was made on: as in the size that it was made in.
    EXPECT_NEAR(zone(cloth, "chest_girth_m").garment_m,
                zone(worn(avatar, dress, "S"), "chest_girth_m").garment_m, 0.02f);
    // The one without lengths of its own has its sizes too.
    vfit_cloth other = worn(avatar, open("sundress"), nullptr, 1);
    EXPECT_EQ(vfit_cloth_set_size(other, "L"), VFIT_OK) << contract::last_error();
    ASSERT_EQ(vfit_cloth_begin_step(other, kGarmentStep_s), VFIT_OK);
    EXPECT_EQ(vfit_cloth_set_size(other, "M"), VFIT_ERROR_STATE);
    EXPECT_EQ(vfit_cloth_end_step(other), VFIT_OK);
}

TEST_F(GarmentsTest, MadeToMeasureKeepsTheEaseItWasMadeWith) {
    const vfit_garment dress = open("sundress_pattern");
    const vfit_fit_zone own = zone(worn(body(), dress, nullptr), "chest_girth_m");
    for (const vfit_avatar avatar :
         {body({{"weight", 1.0f}}), body({{"height", 0.7f}}), body({{"height", 0.35f}, {"weight", 0.4f}})}) {
        const vfit_fit_zone z = zone(worn(avatar, dress, nullptr), "chest_girth_m");
        EXPECT_NEAR(z.ease_m, own.ease_m, 0.02f) << "on a chest of " << z.body_m;
        EXPECT_EQ(z.fit, VFIT_FIT_RIGHT) << "on a chest of " << z.body_m;
    }
}

TEST_F(GarmentsTest, TheFitMapIsAboveZeroWhereItIsTight) {
    const vfit_avatar avatar = body();
    const vfit_garment dress = open("sundress_pattern");
    double means[2];
    int k = 0;
    for (const char* size : {"XS", "XXL"}) {
        vfit_cloth cloth = worn(avatar, dress, size);
        std::vector<float> map(positions(cloth).size(), 7.0f);
        EXPECT_EQ(vfit_cloth_fit_map(cloth, map.data(), uint32_t(map.size()) - 1), VFIT_ERROR_ARGUMENT);
        EXPECT_EQ(vfit_cloth_fit_map(cloth, nullptr, uint32_t(map.size())), VFIT_ERROR_ARGUMENT);
        ASSERT_EQ(vfit_cloth_fit_map(cloth, map.data(), uint32_t(map.size())), VFIT_OK)
            << contract::last_error();
        double sum = 0.0;
        for (const float value : map) {
            ASSERT_GE(value, -1.0f);
            ASSERT_LE(value, 1.0f);
            sum += double(value);
        }
        means[k++] = sum / double(map.size());
    }
    EXPECT_GT(means[0], means[1] + 0.1);
}

TEST_F(GarmentsTest, SeamsHaveAVertexForEachPanelAtOnePlace) {
    vfit_cloth cloth = worn(body(), open("vest"), "M", 1);
    vfit_cloth_stats stats = vfit_cloth_stats_init();
    ASSERT_EQ(vfit_cloth_describe(cloth, &stats), VFIT_OK);
    const auto drawn = positions(cloth);
    EXPECT_GT(drawn.size(), stats.vertex_count);
    const std::set<std::array<float, 3>> places(drawn.begin(), drawn.end());
    EXPECT_EQ(places.size(), stats.vertex_count);
}

TEST_F(GarmentsTest, TellTheirParts) {
    for (const char* name : {"duster", "sundress"}) {
        const vfit_garment garment = open(name);
        uint32_t count = 0;
        ASSERT_EQ(vfit_garment_parts(garment, nullptr, sizeof(vfit_garment_part), &count), VFIT_OK);
        std::vector<vfit_garment_part> parts(count);
        ASSERT_EQ(vfit_garment_parts(garment, parts.data(), sizeof(vfit_garment_part), &count), VFIT_OK);
        ASSERT_GE(count, 1u);
        uint32_t next = 0;
        for (const vfit_garment_part& part : parts) {
            EXPECT_EQ(part.first_index, next) << name;
            next += part.index_count;
            for (const float c : part.color) EXPECT_TRUE(c >= 0.0f && c <= 1.0f);
        }
        EXPECT_GT(next, 0u);
    }
}

TEST_F(GarmentsTest, AreCarriedFromTheBodyThatTheyWereMadeOn) {
    std::ifstream stream(VFIT_DATA_DIR "/garments/sundress_pattern.json", std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    const auto waist_of = [&](vfit_avatar avatar) {
        vfit_garment garment{};
        EXPECT_EQ(vfit_garment_load(context, text.data(), text.size(), &garment), VFIT_OK)
            << contract::last_error();
        return zone(worn(avatar, garment, nullptr, 90), "waist_girth_m").garment_m;
    };
    const vfit_avatar her = body({{"measure-waist-circ", 0.5f}});  // 5 cm more
    const float on_default = waist_of(body()), on_her = waist_of(her);
    // The same dress, said to be made on her, is smaller on everybody.
    for (const auto& [from, to] :
         {std::pair<std::string, std::string>("\"version\": 2", "\"version\": 3"),
          {"\"body_sex\": \"f\"", "\"body_sex\": \"f\", \"body_shape\": {\"measure-waist-circ\": 0.5}"}}) {
        const size_t at = text.find(from);
        ASSERT_NE(at, std::string::npos) << from;
        text.replace(at, from.size(), to);
    }
    EXPECT_LT(waist_of(body()), on_default - 0.02f);
    EXPECT_LT(waist_of(her), on_her - 0.02f);
}

TEST_F(GarmentsTest, ADrawnMeshGoesWithTheSimulatedOne) {
    std::ifstream stream(VFIT_DATA_DIR "/garments/sundress_pattern.json", std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    const auto load = [&] {
        vfit_garment garment{};
        EXPECT_EQ(vfit_garment_load(context, text.data(), text.size(), &garment), VFIT_OK)
            << contract::last_error();
        return garment;
    };
    const auto simulated = positions(worn(body(), load(), nullptr, 20));
    // The corners of a triangle, and a place a centimetre off the first, in place of all others.
    for (const auto& [from, to] :
         {std::pair<std::string, std::string>("\"version\": 2", "\"version\": 4"),
          {"\"parts\"",
           R"("drawn": {"triangles": [100,100,100,100], "weights": [0,0, 1,0, 0,1, 0,0],)"
           R"( "offsets": [0,0,0, 0,0,0, 0,0,0, 0,0,0.01], "normals": [0,0,1, 0,0,1, 0,0,1, 0,0,1],)"
           R"( "uvs": [0,0, 1,0, 0,1, 0,0], "indices": [0,1,2]}, "parts_of_the_other")"}}) {
        const size_t at = text.find(from);
        ASSERT_NE(at, std::string::npos) << from;
        text.replace(at, from.size(), to);
    }
    const vfit_cloth cloth = worn(body(), load(), nullptr, 20);
    const auto drawn = positions(cloth);
    ASSERT_EQ(drawn.size(), 4u);
    const auto apart = [](const auto& a, const auto& b) {
        return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    };
    for (size_t i = 0; i < 3; ++i) {
        float least = INFINITY;
        for (const auto& p : simulated) least = std::min(least, apart(p, drawn[i]));
        EXPECT_LT(least, 1e-5f) << i;
        EXPECT_GT(apart(drawn[i], drawn[(i + 1) % 3]), 0.005f);
    }
    EXPECT_NEAR(apart(drawn[0], drawn[3]), 0.01f, 1e-4f);
    std::vector<float> tight(4);
    EXPECT_EQ(vfit_cloth_fit_map(cloth, tight.data(), 4), VFIT_OK) << contract::last_error();
    EXPECT_EQ(tight[0], tight[3]);
    EXPECT_EQ(vfit_cloth_fit_map(cloth, tight.data(), 3), VFIT_ERROR_ARGUMENT);
}

TEST_F(GarmentsTest, HandsPassWhereTheyAreToldTo) {
    const vfit_avatar avatar = body();
    for (const char* name : {"shirt_men", "sundress_pattern", "duster"}) {
        const vfit_garment garment = open(name);
        // Half of the way down no hand comes to the shirt beside its own sleeve.
        const bool shirt = std::string_view(name) == "shirt_men";
        const float turn = shirt ? 0.38f : 0.7f, rest = shirt ? 0.925f : 0.714f;
        uint64_t hashes[2];
        for (const uint32_t flag : {0u, uint32_t(VFIT_CLOTH_NO_HANDS)}) {
            // Arms that come down from the T-pose onto the dress.
            vfit_pose pose = vfit_pose_init();
            vfit_bone bones[3] = {vfit_bone_init(), vfit_bone_init(), vfit_bone_init()};
            bones[0].bone = VFIT_BONE_HIPS, bones[0].rotation[3] = 1.0f, bones[0].position[1] = 0.9f;
            for (int side = 0; side < 2; ++side) {
                bones[1 + side].bone = side == 0 ? VFIT_BONE_LEFT_UPPER_ARM : VFIT_BONE_RIGHT_UPPER_ARM;
                bones[1 + side].rotation[2] = side == 0 ? -turn : turn, bones[1 + side].rotation[3] = rest;
            }
            ASSERT_EQ(vfit_avatar_pose(avatar, &pose, bones, sizeof bones[0], 1), VFIT_OK)
                << contract::last_error();
            vfit_cloth cloth{};
            ASSERT_EQ(put_on(avatar, garment, nullptr, flag, cloth), VFIT_OK) << contract::last_error();
            ASSERT_EQ(vfit_avatar_pose(avatar, &pose, bones, sizeof bones[0], 3), VFIT_OK)
                << contract::last_error();
            for (int i = 0; i < 10; ++i) ASSERT_EQ(vfit_cloth_step(cloth, kGarmentStep_s), VFIT_OK);
            hashes[flag != 0] = hash(cloth);
            if (flag == 0) continue;
            vfit_cloth_stats stats = vfit_cloth_stats_init();
            ASSERT_EQ(vfit_cloth_describe(cloth, &stats), VFIT_OK);
            EXPECT_LT(stats.strain_max, 0.6f) << name;
        }
        // A sleeve meets its own hand either way.
        if (shirt)
            EXPECT_EQ(hashes[0], hashes[1]);
        else
            EXPECT_NE(hashes[0], hashes[1]) << name;
    }
}

TEST_F(GarmentsTest, AHandThatSwingsBesideASkirtDoesNotGoThrough) {
    const vfit_avatar avatar = body();
    vfit_cloth cloth{};
    int64_t time_ns = 0;
    const auto swing = [&](float angle) {
        vfit_pose pose = vfit_pose_init();
        pose.time_ns = time_ns += 16'666'667;
        std::array<vfit_bone, 3> bones;
        bones.fill(vfit_bone_init());
        bones[0].bone = VFIT_BONE_HIPS, bones[0].rotation[3] = 1.0f, bones[0].position[1] = 0.9f;
        for (size_t side = 0; side < 2; ++side) {
            const float sign = side == 0 ? -1.0f : 1.0f, down = 0.5f * sign * 1.35f,
                        half = 0.5f * sign * angle;
            bones[1 + side].bone = side == 0 ? VFIT_BONE_LEFT_UPPER_ARM : VFIT_BONE_RIGHT_UPPER_ARM;
            float* q = bones[1 + side].rotation;  // about X, of an arm that was turned down about Z
            q[0] = std::sin(half) * std::cos(down), q[1] = -std::sin(half) * std::sin(down);
            q[2] = std::cos(half) * std::sin(down), q[3] = std::cos(half) * std::cos(down);
        }
        ASSERT_EQ(vfit_avatar_pose(avatar, &pose, bones.data(), sizeof bones[0], 3), VFIT_OK)
            << contract::last_error();
    };
    swing(0.0f);
    vfit_cloth_desc desc = vfit_cloth_desc_init();
    desc.flags = VFIT_CLOTH_SKIN, desc.self_thickness_m = 0.004f;
    ASSERT_EQ(vfit_cloth_create(avatar, open("sundress"), &desc, &cloth), VFIT_OK) << contract::last_error();
    ASSERT_EQ(vfit_cloth_reset(cloth), VFIT_OK) << contract::last_error();
    float strain = 0.0f;
    uint32_t pairs = 0;
    for (int i = 0; i < 100; ++i) {
        swing(0.6f * std::sin(0.16f * float(i)));  // both hands, up to 3.5 m/s
        ASSERT_EQ(vfit_cloth_step(cloth, kGarmentStep_s), VFIT_OK) << contract::last_error();
        vfit_cloth_stats stats = vfit_cloth_stats_init();
        ASSERT_EQ(vfit_cloth_describe(cloth, &stats), VFIT_OK);
        strain = std::max(strain, stats.strain_max);
        if (i % 4 != 0) continue;
        std::array<vfit_crossing, 4> crossings;
        crossings.fill(vfit_crossing_init());
        uint32_t count = uint32_t(crossings.size());
        ASSERT_EQ(vfit_outfit_check(&cloth, 1, crossings.data(), sizeof(vfit_crossing), &count), VFIT_OK);
        for (uint32_t k = 0; k < std::min(count, 4u); ++k) pairs = std::max(pairs, crossings[k].pair_count);
    }
    EXPECT_LT(strain, 0.6f);
    EXPECT_LT(pairs, 30u) << "an arm that passes crosses more";
}

TEST_F(GarmentsTest, OnSpheresSleevesKeepForearmsAndHands) {
    const vfit_avatar avatar = body();
    for (const auto& [name, same] : {std::pair("shirt_men", true), std::pair("sundress_pattern", false)}) {
        const vfit_garment garment = open(name);
        uint32_t met[2];
        for (const uint32_t flag : {0u, uint32_t(VFIT_CLOTH_NO_HANDS)}) {
            vfit_cloth_desc desc = vfit_cloth_desc_init();
            desc.flags = flag;
            vfit_cloth cloth{};
            ASSERT_EQ(vfit_cloth_create(avatar, garment, &desc, &cloth), VFIT_OK) << contract::last_error();
            for (int i = 0; i < 3; ++i) ASSERT_EQ(vfit_cloth_step(cloth, kGarmentStep_s), VFIT_OK);
            vfit_cloth_stats stats = vfit_cloth_stats_init();
            ASSERT_EQ(vfit_cloth_describe(cloth, &stats), VFIT_OK);
            met[flag != 0] = stats.collider_count;
        }
        EXPECT_EQ(met[0] == met[1], same) << name << ": spheres and capsules that are met";
    }
}

TEST_F(GarmentsTest, AreTheSameEachTime) {
    const vfit_avatar avatar = body();
    const vfit_garment vest = open("vest");
    EXPECT_EQ(hash(worn(avatar, vest, "L", 5)), hash(worn(avatar, vest, "L", 5)));
}

}  // namespace
