// Objects that are destroyed while another thread uses them: the call that runs is finished, the next one
// gets an error, and nothing of the host's is called once its context is gone.
#include <chrono>
#include <functional>
#include <thread>

#include "contract/host_jobs.h"
#include "contract/support.h"

using contract::ContextTest;
using contract::HostImage;

namespace {

using namespace std::chrono_literals;

vfit_context make_context(contract::HostJobSystem* host = nullptr) {
    vfit_context_desc desc = contract::context_desc();
    if (host) host->give_to(desc);
    vfit_context context{};
    EXPECT_EQ(vfit_context_create(&desc, &context), VFIT_OK) << contract::last_error();
    return context;
}

vfit_avatar make_avatar(vfit_context context) {
    vfit_avatar avatar{};
    EXPECT_EQ(vfit_avatar_create_from_shape(context, nullptr, nullptr, 0, 0, &avatar), VFIT_OK)
        << contract::last_error();
    return avatar;
}

vfit_result pose(vfit_avatar avatar) {
    vfit_bone hips = vfit_bone_init();
    hips.rotation[3] = 1.0f;
    hips.position[1] = 0.9f;
    const vfit_pose header = vfit_pose_init();
    return vfit_avatar_pose(avatar, &header, &hips, sizeof hips, 1);
}

/// The result that ended a loop of OKs; the first call has been made when it is constructed.
class Loop {
public:
    explicit Loop(std::function<vfit_result()> call)
        : thread_([this, call] {
              while ((last_ = call()) == VFIT_OK) calls_.fetch_add(1);
              calls_.fetch_add(1);
          }) {
        while (calls_.load() == 0) std::this_thread::yield();
    }
    ~Loop() {
        if (thread_.joinable()) thread_.join();
    }
    vfit_result end() {
        thread_.join();
        return last_;
    }

private:
    std::atomic<uint32_t> calls_{0};
    std::atomic<vfit_result> last_{VFIT_OK};
    std::thread thread_;
};

}  // namespace

TEST(Lifetime, AContextMayGoWhileAnotherThreadStepsOnTheHostsJobs) {
    for (int round = 0; round < 10; ++round) {
        contract::ThreadPool host(2);
        const vfit_context context = make_context(&host);
        const vfit_avatar avatar = make_avatar(context);
        Loop steps([&] { return pose(avatar); });
        std::this_thread::sleep_for(round * 200us);
        EXPECT_EQ(vfit_context_destroy(context), VFIT_OK);
        host.destroyed = true;
        EXPECT_EQ(steps.end(), VFIT_ERROR_HANDLE);
        EXPECT_EQ(host.late.load(), 0u) << "no call of the host's once the context is gone";
    }
}

TEST(Lifetime, LentPixelsComeBackBeforeTheirContextIsGone) {
    struct Count {
        std::atomic<uint32_t> released{0}, late{0};
        std::atomic<bool> destroyed{false};
    };
    for (int round = 0; round < 20; ++round) {
        Count count;
        const vfit_context context = make_context();
        HostImage image;
        vfit_frame_desc desc = image.desc();
        desc.release = [](void* user) {
            auto& c = *static_cast<Count*>(user);
            ++c.released;
            c.late += c.destroyed.load();
        };
        desc.user = &count;
        std::atomic<uint32_t> made{0};
        Loop frames([&] {
            vfit_frame frame{};
            const vfit_result result = vfit_frame_create(context, &desc, &frame);
            if (result != VFIT_OK) return result;
            ++made;
            return vfit_frame_release(frame);
        });
        std::this_thread::sleep_for(round * 100us);
        EXPECT_EQ(vfit_context_destroy(context), VFIT_OK);
        count.destroyed = true;
        EXPECT_EQ(frames.end(), VFIT_ERROR_HANDLE);
        EXPECT_EQ(count.released.load(), made.load()) << "each once";
        EXPECT_EQ(count.late.load(), 0u);
    }
}

TEST_F(ContextTest, AFrameThatTwoThreadsReleaseGoesOnce) {
    HostImage image;
    std::atomic<uint32_t> released{0};
    vfit_frame_desc desc = image.desc();
    desc.release = [](void* user) { ++*static_cast<std::atomic<uint32_t>*>(user); };
    desc.user = &released;
    for (uint32_t round = 1; round <= 200; ++round) {
        vfit_frame frame{};
        ASSERT_EQ(vfit_frame_create(context, &desc, &frame), VFIT_OK) << contract::last_error();
        std::atomic<uint32_t> ready{0}, stale{0};
        const auto release = [&] {
            ++ready;
            while (ready.load() < 2) std::this_thread::yield();
            const vfit_result result = vfit_frame_release(frame);
            EXPECT_TRUE(result == VFIT_OK || result == VFIT_ERROR_HANDLE) << result;
            stale += result == VFIT_ERROR_HANDLE;
        };
        std::thread other(release);
        release();
        other.join();
        ASSERT_EQ(stale.load(), 1u);
        ASSERT_EQ(released.load(), round);
    }
}

TEST_F(ContextTest, AnAvatarMayBeDestroyedByAFinalizerWhileItIsPosedAndRead) {
    for (int round = 0; round < 10; ++round) {
        const vfit_avatar avatar = make_avatar(context);
        Loop steps([&] { return pose(avatar); });
        Loop reads([&] {
            vfit_frame frame{};
            const vfit_result result = vfit_avatar_acquire(avatar, &frame);
            return result == VFIT_OK ? vfit_frame_release(frame) : result;
        });
        std::this_thread::sleep_for(round * 200us);
        EXPECT_EQ(vfit_avatar_destroy(avatar), VFIT_OK);
        EXPECT_EQ(steps.end(), VFIT_ERROR_HANDLE);
        EXPECT_EQ(reads.end(), VFIT_ERROR_HANDLE);
    }
}

TEST_F(ContextTest, AFrameOutlivesTheAvatarThatItShows) {
    const vfit_avatar avatar = make_avatar(context);
    vfit_frame frame{};
    ASSERT_EQ(vfit_avatar_acquire(avatar, &frame), VFIT_OK);
    ASSERT_EQ(vfit_avatar_destroy(avatar), VFIT_OK);
    vfit_view view = vfit_view_init();
    for (const vfit_stream stream : {VFIT_STREAM_POSITION, VFIT_STREAM_UV, VFIT_STREAM_INDEX}) {
        ASSERT_EQ(vfit_frame_view(frame, stream, &view), VFIT_OK);
        volatile unsigned char last =
            static_cast<const unsigned char*>(view.data)[size_t(view.width) * view.item_stride - 1];
        (void)last;
    }
    EXPECT_EQ(vfit_frame_release(frame), VFIT_OK);
}

TEST(Lifetime, ASensorThatWaitsForAFrameIsWokenWhenItsContextGoes) {
    const vfit_context context = make_context();
    vfit_sensor sensor{};
    ASSERT_EQ(vfit_sensor_open(context, "virtual:sensor=kinect_v1_320&frames=2", &sensor), VFIT_OK)
        << contract::last_error();
    ASSERT_EQ(vfit_sensor_start(sensor), VFIT_OK);
    Loop frames([&] {
        vfit_frame frame{};
        const vfit_result result = vfit_sensor_acquire(sensor, -1, &frame);
        if (result == VFIT_OK) return vfit_frame_release(frame);
        return result == VFIT_END_OF_STREAM ? VFIT_OK : result;
    });
    EXPECT_EQ(vfit_context_destroy(context), VFIT_OK);
    const vfit_result end = frames.end();
    EXPECT_TRUE(end == VFIT_ERROR_STATE || end == VFIT_ERROR_HANDLE) << end;
}

TEST(Lifetime, AStreamThatRunsEndsWithoutComplaintWhenItsContextGoes) {
    std::atomic<uint32_t> lines{0};
    vfit_context_desc desc = contract::context_desc();
    desc.log = [](void* user, vfit_log_level level, const char*) {
        *static_cast<std::atomic<uint32_t>*>(user) += level <= VFIT_LOG_WARNING;
    };
    desc.user = &lines;
    for (int round = 0; round < 5; ++round) {
        vfit_context context{};
        ASSERT_EQ(vfit_context_create(&desc, &context), VFIT_OK) << contract::last_error();
        vfit_sensor sensor{};
        ASSERT_EQ(vfit_sensor_open(context, "virtual:sensor=kinect_v1_320&pace=realtime&rate=240", &sensor),
                  VFIT_OK);
        ASSERT_EQ(vfit_sensor_start(sensor), VFIT_OK);
        vfit_frame frame{};
        ASSERT_EQ(vfit_sensor_acquire(sensor, -1, &frame), VFIT_OK) << contract::last_error();
        EXPECT_EQ(vfit_context_destroy(context), VFIT_OK);
    }
    EXPECT_EQ(lines.load(), 0u) << "a stop is no misuse by the plug-in";
}

TEST(Lifetime, TwoThreadsDestroyOneContextOnce) {
    for (int round = 0; round < 20; ++round) {
        const vfit_context context = make_context();
        make_avatar(context);
        std::atomic<uint32_t> ready{0}, done{0};
        const auto destroy = [&] {
            ++ready;
            while (ready.load() < 2) std::this_thread::yield();
            const vfit_result result = vfit_context_destroy(context);
            EXPECT_TRUE(result == VFIT_OK || result == VFIT_ERROR_BUSY || result == VFIT_ERROR_HANDLE)
                << result;
            done += result == VFIT_OK;
        };
        std::thread other(destroy);
        destroy();
        other.join();
        EXPECT_EQ(done.load(), 1u);
    }
}
