// Avatars, garments, cloth and charts through the C ABI: what they give, and what they refuse.
#include <cmath>
#include <cstring>
#include <map>

#include "contract/support.h"

using contract::ContextTest;

namespace {

vfit_measurement measure(const char* key, float value, float sigma = 0.01f) {
    vfit_measurement m = vfit_measurement_init();
    std::snprintf(m.key, sizeof m.key, "%s", key);
    m.value = value;
    m.sigma = sigma;
    return m;
}

class DressingTest : public ContextTest {
protected:
    vfit_avatar make_avatar(uint32_t detail = 0) {
        vfit_avatar_desc desc = vfit_avatar_desc_init();
        desc.sex = VFIT_SEX_FEMALE;
        desc.detail = detail;
        vfit_avatar avatar{};
        EXPECT_EQ(vfit_avatar_create_from_shape(context, &desc, nullptr, 0, 0, &avatar), VFIT_OK)
            << contract::last_error();
        return avatar;
    }
    vfit_cloth make_cloth(vfit_avatar avatar, const vfit_cloth_desc* desc = nullptr) {
        vfit_garment garment{};
        EXPECT_EQ(vfit_garment_open(context, "sundress", &garment), VFIT_OK) << contract::last_error();
        vfit_cloth cloth{};
        EXPECT_EQ(vfit_cloth_create(avatar, garment, desc, &cloth), VFIT_OK) << contract::last_error();
        return cloth;
    }
    static std::map<std::string, float> measures_of(vfit_avatar avatar) {
        uint32_t count = 0;
        EXPECT_EQ(vfit_avatar_measure(avatar, nullptr, 0, &count), VFIT_OK) << contract::last_error();
        std::vector<vfit_measurement> list(count);
        EXPECT_EQ(vfit_avatar_measure(avatar, list.data(), sizeof(vfit_measurement), &count), VFIT_OK);
        std::map<std::string, float> out;
        for (const auto& m : list) out[m.key] = m.value;
        return out;
    }
    static uint32_t width_of(vfit_frame frame, vfit_stream stream) {
        vfit_view view = vfit_view_init();
        EXPECT_EQ(vfit_frame_view(frame, stream, &view), VFIT_OK) << contract::last_error();
        return view.width;
    }
};

vfit_bone bone(vfit_bone_id id) {
    vfit_bone b = vfit_bone_init();
    b.bone = id;
    b.rotation[3] = 1.0f;
    return b;
}

}  // namespace

TEST_F(DressingTest, AnAvatarHasEveryStreamAndItsTopologyFits) {
    const vfit_avatar avatar = make_avatar();
    vfit_frame frame{};
    ASSERT_EQ(vfit_avatar_acquire(avatar, &frame), VFIT_OK);
    const uint32_t vertices = width_of(frame, VFIT_STREAM_POSITION);
    EXPECT_GE(vertices, 13718u);
    for (const vfit_stream stream :
         {VFIT_STREAM_NORMAL, VFIT_STREAM_UV, VFIT_STREAM_SKIN_BONES, VFIT_STREAM_SKIN_WEIGHTS})
        EXPECT_EQ(width_of(frame, stream), vertices) << stream;
    vfit_view indices = vfit_view_init();
    ASSERT_EQ(vfit_frame_view(frame, VFIT_STREAM_INDEX, &indices), VFIT_OK);
    EXPECT_EQ(indices.width, 27420u * 3);
    for (uint32_t i = 0; i < indices.width; ++i)
        ASSERT_LT(static_cast<const uint32_t*>(indices.data)[i], vertices);
    uint32_t bones = 0;
    ASSERT_EQ(vfit_avatar_rig(avatar, nullptr, 0, &bones), VFIT_OK);
    EXPECT_EQ(width_of(frame, VFIT_STREAM_BONE_MATRIX), bones);
}

TEST_F(DressingTest, SkinningTheRestMeshGivesThePosedMesh) {
    struct Weights {
        float w[8];
    };
    struct Bones {
        uint16_t b[8];
    };
    const vfit_avatar avatar = make_avatar();
    vfit_pose pose = vfit_pose_init();
    std::vector<vfit_bone> bones = {bone(VFIT_BONE_HIPS), bone(VFIT_BONE_LEFT_UPPER_ARM)};
    bones[0].position[1] = 0.9f;
    bones[1].rotation[2] = std::sin(-0.4f);
    bones[1].rotation[3] = std::cos(-0.4f);
    ASSERT_EQ(vfit_avatar_pose(avatar, &pose, bones.data(), sizeof(vfit_bone), 2), VFIT_OK)
        << contract::last_error();
    vfit_frame posed{}, rest{};
    ASSERT_EQ(vfit_avatar_acquire(avatar, &posed), VFIT_OK);
    ASSERT_EQ(vfit_avatar_acquire_rest(avatar, &rest), VFIT_OK);
    const auto data = [](vfit_frame frame, vfit_stream stream) {
        vfit_view view = vfit_view_init();
        vfit_frame_view(frame, stream, &view);
        return view.data;
    };
    const auto* p = static_cast<const float*>(data(posed, VFIT_STREAM_POSITION));
    const auto* r = static_cast<const float*>(data(rest, VFIT_STREAM_POSITION));
    const auto* m = static_cast<const float*>(data(posed, VFIT_STREAM_BONE_MATRIX));
    const auto* w = static_cast<const Weights*>(data(rest, VFIT_STREAM_SKIN_WEIGHTS));
    const auto* b = static_cast<const Bones*>(data(rest, VFIT_STREAM_SKIN_BONES));
    for (uint32_t i = 0; i < 13718; i += 97)
        for (int row = 0; row < 3; ++row) {
            float sum = 0.0f;
            for (int k = 0; k < 8; ++k) {
                const float* bone_matrix = m + 16 * b[i].b[k];
                sum += w[i].w[k] * (bone_matrix[row] * r[3 * i] + bone_matrix[4 + row] * r[3 * i + 1] +
                                    bone_matrix[8 + row] * r[3 * i + 2] + bone_matrix[12 + row]);
            }
            ASSERT_NEAR(sum, p[3 * i + row], 2e-4f) << i;
        }
}

TEST_F(DressingTest, LevelsOfDetailAreThreeAndOneForCrowds) {
    const uint32_t least[] = {13718, 54848, 219368};
    for (uint32_t detail = 0; detail < 3; ++detail) {
        vfit_frame frame{};
        const vfit_avatar avatar = make_avatar(detail);
        ASSERT_EQ(vfit_avatar_acquire(avatar, &frame), VFIT_OK);
        EXPECT_GE(width_of(frame, VFIT_STREAM_POSITION), least[detail]);
    }
    vfit_avatar_desc desc = vfit_avatar_desc_init();
    vfit_frame crowd{};
    ASSERT_EQ(vfit_avatar_acquire(make_avatar(3), &crowd), VFIT_OK);
    EXPECT_NEAR(double(width_of(crowd, VFIT_STREAM_POSITION)), 1200.0, 200.0);  // 1000 and copies at seams
    desc.detail = 4;
    vfit_avatar avatar{};
    EXPECT_EQ(vfit_avatar_create_from_shape(context, &desc, nullptr, 0, 0, &avatar), VFIT_ERROR_ARGUMENT);
}

TEST_F(DressingTest, AnAvatarOfMeasuresHasThem) {
    const vfit_measurement wanted[] = {measure("stature_m", 1.81f), measure("shoulder_breadth_m", 0.47f)};
    vfit_avatar avatar{};
    ASSERT_EQ(vfit_avatar_create(context, nullptr, wanted, sizeof wanted[0], 2, &avatar), VFIT_OK)
        << contract::last_error();
    auto got = measures_of(avatar);
    EXPECT_NEAR(got["stature_m"], 1.81f, 0.005f);
    EXPECT_NEAR(got["shoulder_breadth_m"], 0.47f, 0.015f);
    EXPECT_GT(got["chest_girth_m"], 0.6f);
}

TEST_F(DressingTest, ImpossibleMeasuresAndShapesAreRefusedByName) {
    vfit_avatar avatar{};
    const auto create = [&](vfit_measurement m) {
        return vfit_avatar_create(context, nullptr, &m, sizeof m, 1, &avatar);
    };
    EXPECT_EQ(create(measure("stature_m", 172.0f)), VFIT_ERROR_DATA) << "centimetres";
    EXPECT_EQ(create(measure("stature_m", -1.0f)), VFIT_ERROR_DATA);
    EXPECT_EQ(create(measure("stature_m", NAN)), VFIT_ERROR_DATA);
    EXPECT_EQ(create(measure("stature_m", 1.7f, NAN)), VFIT_ERROR_DATA);
    EXPECT_EQ(create(measure("wingspan_m", 1.7f)), VFIT_ERROR_DATA);
    EXPECT_NE(contract::last_error().find("wingspan_m"), std::string::npos);
    EXPECT_EQ(create(measure("chest_girth_m", 1.0f)), VFIT_ERROR_DATA) << "no stature";
    vfit_measurement endless = measure("stature_m", 1.7f);
    std::memset(endless.key, 'x', sizeof endless.key);
    EXPECT_EQ(create(endless), VFIT_ERROR_DATA);
    vfit_shape_value shape = vfit_shape_value_init();
    std::snprintf(shape.key, sizeof shape.key, "weight");
    shape.value = 40.0f;
    EXPECT_EQ(vfit_avatar_create_from_shape(context, nullptr, &shape, sizeof shape, 1, &avatar),
              VFIT_ERROR_ARGUMENT);
    std::snprintf(shape.key, sizeof shape.key, "wings");
    shape.value = 0.5f;
    EXPECT_EQ(vfit_avatar_create_from_shape(context, nullptr, &shape, sizeof shape, 1, &avatar),
              VFIT_ERROR_ARGUMENT);
    EXPECT_NE(contract::last_error().find("wings"), std::string::npos);
    EXPECT_EQ(avatar.id, 0u);
}

TEST_F(DressingTest, BadPosesAreRefusedAndChangeNothing) {
    const vfit_avatar avatar = make_avatar();
    vfit_frame before{}, after{};
    ASSERT_EQ(vfit_avatar_acquire(avatar, &before), VFIT_OK);
    vfit_pose pose = vfit_pose_init();
    vfit_bone bad = bone(VFIT_BONE_HIPS);
    bad.rotation[0] = NAN;
    EXPECT_EQ(vfit_avatar_pose(avatar, &pose, &bad, sizeof bad, 1), VFIT_ERROR_DATA);
    bad = bone(VFIT_BONE_HIPS);
    bad.rotation[3] = 0.0f;
    EXPECT_EQ(vfit_avatar_pose(avatar, &pose, &bad, sizeof bad, 1), VFIT_ERROR_DATA);
    bad = bone(99);
    EXPECT_EQ(vfit_avatar_pose(avatar, &pose, &bad, sizeof bad, 1), VFIT_ERROR_ARGUMENT);
    bad = bone(VFIT_BONE_HEAD);
    EXPECT_EQ(vfit_avatar_pose(avatar, &pose, &bad, sizeof bad, 1), VFIT_ERROR_DATA) << "no hips";
    EXPECT_EQ(vfit_avatar_pose(avatar, nullptr, &bad, sizeof bad, 1), VFIT_ERROR_ARGUMENT);
    ASSERT_EQ(vfit_avatar_acquire(avatar, &after), VFIT_OK);
    vfit_view a = vfit_view_init(), b = vfit_view_init();
    vfit_frame_view(before, VFIT_STREAM_POSITION, &a);
    vfit_frame_view(after, VFIT_STREAM_POSITION, &b);
    EXPECT_EQ(a.serial, b.serial);
}

TEST_F(DressingTest, HoldingAllFramesOfAnAvatarIsBusyAndReleasingOneHelps) {
    const vfit_avatar avatar = make_avatar();
    vfit_pose pose = vfit_pose_init();
    const vfit_bone hips = bone(VFIT_BONE_HIPS);
    std::vector<vfit_frame> held;
    vfit_result result = VFIT_OK;
    while (result == VFIT_OK && held.size() < 100) {
        vfit_frame frame{};
        ASSERT_EQ(vfit_avatar_acquire(avatar, &frame), VFIT_OK);
        held.push_back(frame);
        result = vfit_avatar_pose(avatar, &pose, &hips, sizeof hips, 1);
    }
    EXPECT_EQ(result, VFIT_ERROR_BUSY);
    for (const vfit_frame frame : held) vfit_frame_release(frame);
    EXPECT_EQ(vfit_avatar_pose(avatar, &pose, &hips, sizeof hips, 1), VFIT_OK);
}

TEST_F(DressingTest, ClothStepsAndItsStateIsHashed) {
    const vfit_avatar avatar = make_avatar();
    const vfit_cloth cloth = make_cloth(avatar);
    uint64_t first = 0, second = 0;
    ASSERT_EQ(vfit_cloth_state_hash(cloth, &first), VFIT_OK);
    ASSERT_EQ(vfit_cloth_step(cloth, 1.0f / 60.0f), VFIT_OK) << contract::last_error();
    ASSERT_EQ(vfit_cloth_state_hash(cloth, &second), VFIT_OK);
    EXPECT_NE(first, second);
    vfit_frame frame{};
    ASSERT_EQ(vfit_cloth_acquire(cloth, &frame), VFIT_OK);
    vfit_view view = vfit_view_init();
    ASSERT_EQ(vfit_frame_view(frame, VFIT_STREAM_POSITION, &view), VFIT_OK);
    for (uint32_t i = 0; i < view.width * 3; ++i)
        ASSERT_TRUE(std::isfinite(static_cast<const float*>(view.data)[i]));
    EXPECT_EQ(width_of(frame, VFIT_STREAM_STRAIN), view.width);
    EXPECT_NE(vfit_frame_view(frame, VFIT_STREAM_PRESSURE, &view), VFIT_OK);
    vfit_cloth_stats stats = vfit_cloth_stats_init();
    ASSERT_EQ(vfit_cloth_describe(cloth, &stats), VFIT_OK);
    EXPECT_EQ(stats.simulated_count, 4144u);
    EXPECT_EQ(stats.vertex_count, view.width);
}

TEST_F(DressingTest, WhoAsksIsToldHowTheBodyPresses) {
    const vfit_avatar avatar = make_avatar();
    vfit_cloth_desc desc = vfit_cloth_desc_init();
    desc.flags = VFIT_CLOTH_PRESSURE;
    const vfit_cloth cloth = make_cloth(avatar, &desc);
    for (int i = 0; i < 30; ++i) ASSERT_EQ(vfit_cloth_step(cloth, 1.0f / 60.0f), VFIT_OK);
    vfit_frame frame{};
    ASSERT_EQ(vfit_cloth_acquire(cloth, &frame), VFIT_OK);
    vfit_view view = vfit_view_init();
    ASSERT_EQ(vfit_frame_view(frame, VFIT_STREAM_PRESSURE, &view), VFIT_OK) << contract::last_error();
    EXPECT_EQ(view.width, width_of(frame, VFIT_STREAM_POSITION));
    uint32_t pressed = 0;
    for (uint32_t i = 0; i < view.width; ++i) {
        const float pressure = static_cast<const float*>(view.data)[i];
        ASSERT_TRUE(std::isfinite(pressure) && pressure >= 0.0f);
        pressed += pressure > 1.0f;
    }
    EXPECT_GT(pressed, 20u);
    EXPECT_LT(pressed, view.width / 2) << "most of a skirt hangs free";
}

TEST_F(DressingTest, AStepBegunIsEndedOnceAndMatchesAStepAtOnce) {
    const vfit_avatar avatar = make_avatar();
    const vfit_cloth a = make_cloth(avatar), b = make_cloth(avatar);
    EXPECT_EQ(vfit_cloth_end_step(a), VFIT_ERROR_STATE);
    for (int i = 0; i < 5; ++i) {
        ASSERT_EQ(vfit_cloth_step(a, 1.0f / 60.0f), VFIT_OK);
        ASSERT_EQ(vfit_cloth_begin_step(b, 1.0f / 60.0f), VFIT_OK);
        EXPECT_EQ(vfit_cloth_begin_step(b, 1.0f / 60.0f), VFIT_ERROR_STATE);
        EXPECT_EQ(vfit_cloth_step(b, 1.0f / 60.0f), VFIT_ERROR_STATE);
        ASSERT_EQ(vfit_cloth_end_step(b), VFIT_OK);
    }
    uint64_t hash_a = 0, hash_b = 0;
    vfit_cloth_state_hash(a, &hash_a);
    vfit_cloth_state_hash(b, &hash_b);
    EXPECT_EQ(hash_a, hash_b);
    ASSERT_EQ(vfit_cloth_begin_step(b, 1.0f / 60.0f), VFIT_OK);
    EXPECT_EQ(vfit_cloth_destroy(b), VFIT_OK) << "a running step is waited for";
}

TEST_F(DressingTest, WrongStepsAndSettingsAreRefused) {
    const vfit_avatar avatar = make_avatar();
    const vfit_cloth cloth = make_cloth(avatar);
    EXPECT_EQ(vfit_cloth_step(cloth, NAN), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_cloth_step(cloth, -1.0f), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_cloth_step(cloth, 1e9f), VFIT_OK) << "a long step is clamped";
    vfit_garment garment{};
    ASSERT_EQ(vfit_garment_open(context, "sundress", &garment), VFIT_OK);
    vfit_cloth other{};
    vfit_cloth_desc desc = vfit_cloth_desc_init();
    desc.substeps = 100000;
    EXPECT_EQ(vfit_cloth_create(avatar, garment, &desc, &other), VFIT_ERROR_ARGUMENT);
    desc = vfit_cloth_desc_init();
    desc.thickness_m = NAN;
    EXPECT_EQ(vfit_cloth_create(avatar, garment, &desc, &other), VFIT_ERROR_ARGUMENT);
    desc = vfit_cloth_desc_init();
    desc.flags = 1u << 20;
    EXPECT_EQ(vfit_cloth_create(avatar, garment, &desc, &other), VFIT_ERROR_ARGUMENT);
    desc = vfit_cloth_desc_init();
    desc.size_label = "gigantic";
    EXPECT_EQ(vfit_cloth_create(avatar, garment, &desc, &other), VFIT_ERROR_ARGUMENT);
    EXPECT_NE(contract::last_error().find("gigantic"), std::string::npos);
    EXPECT_EQ(other.id, 0u);
}

TEST_F(DressingTest, GravityIsReadInTheContextsAxes) {
    ASSERT_EQ(vfit_context_destroy(context), VFIT_OK);
    vfit_context_desc desc = contract::context_desc();
    desc.axes = VFIT_AXES_UNREAL;  // centimetres, Z up
    ASSERT_EQ(vfit_context_create(&desc, &context), VFIT_OK);
    const vfit_avatar avatar = make_avatar();
    const auto mean_height = [&](float gravity_z) {
        vfit_cloth_desc cloth_desc = vfit_cloth_desc_init();
        cloth_desc.gravity[2] = gravity_z;
        const vfit_cloth cloth = make_cloth(avatar, &cloth_desc);
        for (int i = 0; i < 10; ++i) EXPECT_EQ(vfit_cloth_step(cloth, 1.0f / 60.0f), VFIT_OK);
        vfit_frame frame{};
        EXPECT_EQ(vfit_cloth_acquire(cloth, &frame), VFIT_OK);
        vfit_view view = vfit_view_init();
        EXPECT_EQ(vfit_frame_view(frame, VFIT_STREAM_POSITION, &view), VFIT_OK);
        double sum = 0.0;
        for (uint32_t i = 0; i < view.width; ++i) sum += static_cast<const float*>(view.data)[3 * i + 2];
        return sum / view.width;
    };
    const double by_default = mean_height(0.0f);
    EXPECT_NEAR(mean_height(-981.0f), by_default, 0.01);
    EXPECT_GT(mean_height(981.0f), by_default + 0.5) << "upwards";
}

TEST_F(DressingTest, AnIndexThatDoesNotFitSixteenBitsLeavesTheTargetAsItIs) {
    vfit_frame frame{};
    ASSERT_EQ(vfit_avatar_acquire(make_avatar(2), &frame), VFIT_OK);  // 219k vertices
    std::vector<uint16_t> narrow(width_of(frame, VFIT_STREAM_INDEX), 0xABCD);
    vfit_target target = vfit_target_init();
    target.format = VFIT_FORMAT_U16;
    target.data = narrow.data();
    target.capacity = narrow.size() * sizeof(uint16_t);
    EXPECT_EQ(vfit_frame_write(frame, VFIT_STREAM_INDEX, &target, nullptr), VFIT_ERROR_CAPACITY);
    for (const uint16_t index : narrow) ASSERT_EQ(index, 0xABCD);
    ASSERT_EQ(vfit_avatar_acquire(make_avatar(0), &frame), VFIT_OK);
    ASSERT_EQ(vfit_frame_write(frame, VFIT_STREAM_INDEX, &target, nullptr), VFIT_OK)
        << contract::last_error();
    vfit_view wide = vfit_view_init();
    ASSERT_EQ(vfit_frame_view(frame, VFIT_STREAM_INDEX, &wide), VFIT_OK);
    for (uint32_t i = 0; i < wide.width; ++i)
        ASSERT_EQ(narrow[i], static_cast<const uint32_t*>(wide.data)[i]);
}

TEST_F(DressingTest, DestroyingAnAvatarTakesItsClothWithIt) {
    const vfit_avatar avatar = make_avatar();
    const vfit_cloth cloth = make_cloth(avatar);
    ASSERT_EQ(vfit_avatar_destroy(avatar), VFIT_OK);
    EXPECT_EQ(vfit_cloth_step(cloth, 0.01f), VFIT_ERROR_HANDLE);
}

TEST_F(DressingTest, BadGarmentsAndChartsSayWhatIsWrong) {
    vfit_garment garment{};
    vfit_size_chart chart{};
    for (const std::string text : {"", "{", "[]", "{\"format\": \"vfit-garment\"}", "\xff\xfe\x00"}) {
        EXPECT_EQ(vfit_garment_load(context, text.data(), text.size(), &garment), VFIT_ERROR_DATA) << text;
        EXPECT_EQ(vfit_size_chart_load(context, text.data(), text.size(), &chart), VFIT_ERROR_DATA) << text;
        EXPECT_FALSE(contract::last_error().empty());
    }
    const std::string winged = R"({"format": "vfit-garment", "version": 3, "name": "x", "kind": "dress",
        "fabric": "cotton_woven", "body_sex": "f", "body_shape": {"wing-span": 1}, "sizes": [],
        "positions": [0,1,0, 1,1,0, 0,0,0], "uvs": [0,0, 1,0, 0,1], "indices": [0,2,1],
        "flat": [0,1, 1,1, 0,0], "copies": [], "corners": [0,2,1], "on_arm": [0,0,0], "parts": [],
        "simulated": [0,0,1], "backstop": [0,0,0]})";
    EXPECT_EQ(vfit_garment_load(context, winged.data(), winged.size(), &garment), VFIT_ERROR_DATA);
    EXPECT_NE(contract::last_error().find("wing-span"), std::string::npos) << contract::last_error();
    EXPECT_EQ(vfit_garment_load(context, nullptr, 5, &garment), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_garment_load(context, "x", uint64_t(1) << 60, &garment), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_garment_open(context, "../../etc/passwd", &garment), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_size_chart_open(context, "nowhere", &chart), VFIT_ERROR_IO);
}

TEST_F(DressingTest, ChartsListTheirRowsAndRecommend) {
    vfit_size_chart chart{};
    ASSERT_EQ(vfit_size_chart_open(context, "en13402_women", &chart), VFIT_OK) << contract::last_error();
    uint32_t count = 0;
    ASSERT_EQ(vfit_size_chart_rows(chart, nullptr, 0, &count), VFIT_OK);
    ASSERT_GT(count, 5u);
    std::vector<vfit_size_row> rows(count);
    ASSERT_EQ(vfit_size_chart_rows(chart, rows.data(), sizeof rows[0], &count), VFIT_OK);
    const vfit_measurement bust = measure("chest_girth_m", 0.94f, 0.02f);
    uint32_t sizes = 0;
    ASSERT_EQ(vfit_size_recommend(chart, rows[0].garment_kind, &bust, sizeof bust, 1, nullptr, 0, &sizes),
              VFIT_OK)
        << contract::last_error();
    std::vector<vfit_size> list(sizes);
    ASSERT_EQ(vfit_size_recommend(chart, rows[0].garment_kind, &bust, sizeof bust, 1, list.data(),
                                  sizeof list[0], &sizes),
              VFIT_OK);
    EXPECT_STREQ(list[0].label, "M");  // EN 13402-3: 90 to 98 cm
    float sum = 0.0f;
    for (const auto& s : list) sum += s.probability;
    EXPECT_NEAR(sum, 1.0f, 1e-4f);
    EXPECT_EQ(vfit_size_recommend(chart, "spacesuit", &bust, sizeof bust, 1, nullptr, 0, &sizes),
              VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_size_recommend(chart, rows[0].garment_kind, nullptr, 0, 0, nullptr, 0, &sizes),
              VFIT_ERROR_DATA);
}

TEST(Contract, WrittenAxesKeepTheBodyTheSameBody) {
    const auto positions = [](vfit_axes axes, uint32_t flags, float& unit) {
        vfit_context_desc desc = contract::context_desc();
        desc.axes = axes;
        desc.flags = flags;
        vfit_context context{};
        EXPECT_EQ(vfit_context_create(&desc, &context), VFIT_OK);
        vfit_avatar avatar{};
        EXPECT_EQ(vfit_avatar_create_from_shape(context, nullptr, nullptr, 0, 0, &avatar), VFIT_OK);
        vfit_frame frame{};
        EXPECT_EQ(vfit_avatar_acquire(avatar, &frame), VFIT_OK);
        vfit_view view = vfit_view_init();
        vfit_frame_view(frame, VFIT_STREAM_POSITION, &view);
        const auto* p = static_cast<const float*>(view.data);
        std::vector<float> out(p, p + size_t(view.width) * 3);
        // Outward normals stay outward: the signed volume is positive in the axes' own handedness.
        vfit_view indices = vfit_view_init();
        vfit_frame_view(frame, VFIT_STREAM_INDEX, &indices);
        const auto* t = static_cast<const uint32_t*>(indices.data);
        double volume = 0.0;
        for (uint32_t i = 0; i < indices.width; i += 3) {
            const float *a = &out[3 * t[i]], *b = &out[3 * t[i + 1]], *c = &out[3 * t[i + 2]];
            volume += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                      a[2] * (b[0] * c[1] - b[1] * c[0]);
        }
        unit = static_cast<float>(volume / 6.0);
        EXPECT_EQ(vfit_context_destroy(context), VFIT_OK);
        return out;
    };
    float inside = 0, unity = 0, unreal = 0, mirrored = 0;
    const auto a = positions(VFIT_AXES_RH_Y_UP, 0, inside), b = positions(VFIT_AXES_UNITY, 0, unity);
    positions(VFIT_AXES_UNREAL, 0, unreal);
    const auto m = positions(VFIT_AXES_RH_Y_UP, VFIT_CONTEXT_MIRROR, mirrored);
    EXPECT_FLOAT_EQ(b[0], -a[0]);
    EXPECT_FLOAT_EQ(b[1], a[1]);
    EXPECT_FLOAT_EQ(b[2], a[2]);
    EXPECT_FLOAT_EQ(m[0], -a[0]);
    EXPECT_GT(inside, 0.03f);
    EXPECT_NEAR(unity, inside, 1e-3f) << "the winding turns with the handedness";
    EXPECT_NEAR(unreal * 1e-6f, inside, 1e-3f) << "centimetres";
    EXPECT_NEAR(mirrored, inside, 1e-3f);
}

TEST_F(ContextTest, SensorsListOpenPlayAndClose) {
    uint32_t count = 0;
    ASSERT_EQ(vfit_sensor_list(context, nullptr, 0, &count), VFIT_OK);
    EXPECT_GE(count, 1u);
    vfit_sensor sensor{};
    EXPECT_EQ(vfit_sensor_open(context, nullptr, &sensor), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_sensor_open(context, "teapot:1", &sensor), VFIT_ERROR_UNSUPPORTED);
    ASSERT_EQ(vfit_sensor_open(context, "virtual:sensor=kinect_v1_320&frames=3", &sensor), VFIT_OK)
        << contract::last_error();
    vfit_frame frame{};
    EXPECT_EQ(vfit_sensor_acquire(sensor, 0, &frame), VFIT_ERROR_STATE) << "not started";
    EXPECT_EQ(vfit_sensor_set_option(sensor, "no_such", "1"), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_sensor_set_option(sensor, "pace", "sometimes"), VFIT_ERROR_ARGUMENT);
    ASSERT_EQ(vfit_sensor_start(sensor), VFIT_OK) << contract::last_error();
    for (int i = 0; i < 3; ++i) {
        ASSERT_EQ(vfit_sensor_acquire(sensor, -1, &frame), VFIT_OK) << contract::last_error();
        char index[8];
        uint32_t length = 0;
        ASSERT_EQ(vfit_frame_meta(frame, "index", index, sizeof index, &length), VFIT_OK);
        EXPECT_STREQ(index, std::to_string(i).c_str()) << "pace none drops nothing";
        vfit_frame_release(frame);
    }
    EXPECT_EQ(vfit_sensor_acquire(sensor, -1, &frame), VFIT_END_OF_STREAM);
    vfit_sensor_stats stats = vfit_sensor_stats_init();
    ASSERT_EQ(vfit_sensor_describe(sensor, &stats), VFIT_OK);
    EXPECT_EQ(stats.received, 3u);
    EXPECT_EQ(stats.dropped, 0u);
    EXPECT_EQ(vfit_sensor_close(sensor), VFIT_OK);
    EXPECT_EQ(vfit_sensor_close(sensor), VFIT_ERROR_HANDLE);
}
