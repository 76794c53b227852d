// The steps of avatar and cloth on the host's job system give what they give on the library's own pool.
#include "contract/host_jobs.h"

#include <cmath>

#include "contract/support.h"

namespace {

using contract::HostJobSystem;
using contract::InlineJobs;
using contract::ThreadPool;

vfit_bone bone(vfit_bone_id id, float x, float w) {
    vfit_bone b = vfit_bone_init();
    b.bone = id;
    b.rotation[0] = x;
    b.rotation[3] = w;
    return b;
}

void pose(vfit_avatar avatar, int step) {
    // The left thigh comes forward, so that body and cloth move.
    const float half = -0.02f * static_cast<float>(step);
    vfit_bone hips = bone(VFIT_BONE_HIPS, 0.0f, 1.0f);
    hips.position[1] = 0.9f;
    const vfit_bone bones[] = {hips, bone(VFIT_BONE_LEFT_UPPER_LEG, half, std::sqrt(1.0f - half * half))};
    vfit_pose header = vfit_pose_init();
    header.time_ns = step;
    ASSERT_EQ(vfit_avatar_pose(avatar, &header, bones, sizeof bones[0], 2), VFIT_OK)
        << contract::last_error();
}

std::vector<float> positions(vfit_frame frame) {
    vfit_view view = vfit_view_init();
    EXPECT_EQ(vfit_frame_view(frame, VFIT_STREAM_POSITION, &view), VFIT_OK) << contract::last_error();
    const auto* p = static_cast<const float*>(view.data);
    std::vector<float> out(p, p + size_t(view.width) * 3);
    EXPECT_EQ(vfit_frame_release(frame), VFIT_OK);
    return out;
}

struct Result {
    std::vector<float> avatar, cloth;
    uint64_t hash = 0;
};

/// Three steps at once and three begun and ended, on the host's job system or, null, on the library's own
/// pool.
Result dress(HostJobSystem* host) {
    Result result;
    vfit_context_desc desc = contract::context_desc();
    desc.flags = VFIT_CONTEXT_DETERMINISTIC;
    desc.worker_count = 2;
    if (host) host->give_to(desc);
    vfit_context context{};
    EXPECT_EQ(vfit_context_create(&desc, &context), VFIT_OK) << contract::last_error();
    vfit_avatar avatar{};
    EXPECT_EQ(vfit_avatar_create_from_shape(context, nullptr, nullptr, 0, 0, &avatar), VFIT_OK);
    vfit_garment garment{};
    EXPECT_EQ(vfit_garment_open(context, "sundress", &garment), VFIT_OK) << contract::last_error();
    vfit_cloth cloth{};
    EXPECT_EQ(vfit_cloth_create(avatar, garment, nullptr, &cloth), VFIT_OK) << contract::last_error();
    for (int step = 0; step < 6; ++step) {
        pose(avatar, step);
        if (step % 2 == 0) {
            EXPECT_EQ(vfit_cloth_step(cloth, 1.0f / 60.0f), VFIT_OK) << contract::last_error();
        } else {
            EXPECT_EQ(vfit_cloth_begin_step(cloth, 1.0f / 60.0f), VFIT_OK) << contract::last_error();
            EXPECT_EQ(vfit_cloth_end_step(cloth), VFIT_OK) << contract::last_error();
        }
    }
    vfit_frame frame{};
    EXPECT_EQ(vfit_avatar_acquire(avatar, &frame), VFIT_OK);
    result.avatar = positions(frame);
    EXPECT_EQ(vfit_cloth_acquire(cloth, &frame), VFIT_OK);
    result.cloth = positions(frame);
    EXPECT_EQ(vfit_cloth_state_hash(cloth, &result.hash), VFIT_OK);
    // One more is running when the context goes.
    EXPECT_EQ(vfit_cloth_begin_step(cloth, 1.0f / 60.0f), VFIT_OK);
    EXPECT_EQ(vfit_context_destroy(context), VFIT_OK);
    if (host) host->destroyed = true;
    return result;
}

void expect_as_own_pool(HostJobSystem& host) {
    static const Result own = dress(nullptr);
    const Result got = dress(&host);
    ASSERT_FALSE(own.cloth.empty());
    EXPECT_EQ(got.avatar, own.avatar);
    EXPECT_EQ(got.cloth, own.cloth);
    EXPECT_EQ(got.hash, own.hash);
    EXPECT_GT(host.submits.load(), 6u) << "the steps are on the host's job system";
    EXPECT_EQ(host.from_items.load(), 0u) << "an item neither submits nor waits";
    EXPECT_EQ(host.late.load(), 0u);
}

TEST(HostJobs, ThreeThreadsOfTheHostGiveWhatTheOwnPoolGives) {
    ThreadPool host(3);
    expect_as_own_pool(host);
}

TEST(HostJobs, OneThreadThatHelpsNobodyCompletesEveryStep) {
    ThreadPool host(1);
    expect_as_own_pool(host);
}

TEST(HostJobs, AHostMayRunTheItemsWithinSubmit) {
    InlineJobs host(false);
    expect_as_own_pool(host);
}

TEST(HostJobs, ANullJobHasRunAlreadyAndIsNotWaitedFor) {
    InlineJobs host(true);
    expect_as_own_pool(host);
    EXPECT_FALSE(host.waited_for_null);
}

}  // namespace
