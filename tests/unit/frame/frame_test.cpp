#include "frame/frame.h"

#include <gtest/gtest.h>

#include <cstring>

#include "core/error.h"

namespace vfit {
namespace {

TEST(Frame, StreamsAreAlignedDistinctAndHaveTheirOwnSerials) {
    auto pool = make<FramePool>(2u);
    const Ref<Frame> frame = pool->take();
    void* depth = frame->add_stream(VFIT_STREAM_DEPTH, VFIT_FORMAT_U16, 33, 7);
    void* users = frame->add_stream(VFIT_STREAM_USER_MAP, VFIT_FORMAT_U8, 33, 7);
    EXPECT_EQ(reinterpret_cast<uintptr_t>(depth) % 16, 0u);
    EXPECT_EQ(reinterpret_cast<uintptr_t>(users) % 16, 0u);
    EXPECT_NE(frame->find(VFIT_STREAM_DEPTH)->serial, frame->find(VFIT_STREAM_USER_MAP)->serial);
    EXPECT_EQ(frame->find(VFIT_STREAM_DEPTH)->row_stride, 66u);
    EXPECT_EQ(frame->find(VFIT_STREAM_COLOR), nullptr);
}

TEST(Frame, WrongStreamsAreRefused) {
    Frame* raw = new Frame;
    const Ref<Frame> frame(raw);
    EXPECT_THROW(frame->add_stream(VFIT_STREAM_DEPTH, 99, 4, 4), Error);
    EXPECT_THROW(frame->add_stream(VFIT_STREAM_DEPTH, VFIT_FORMAT_U16, 0, 4), Error);
    EXPECT_THROW(frame->add_stream(VFIT_STREAM_DEPTH, VFIT_FORMAT_U16, 20000, 20000), Error);
    frame->add_stream(VFIT_STREAM_DEPTH, VFIT_FORMAT_U16, 4, 4);
    EXPECT_THROW(frame->add_stream(VFIT_STREAM_DEPTH, VFIT_FORMAT_U16, 4, 4), Error);
}

TEST(FramePool, IsBoundedAndReusesMemory) {
    auto pool = make<FramePool>(2u);
    Ref<Frame> a = pool->take(), b = pool->take();
    EXPECT_FALSE(pool->take());
    EXPECT_EQ(pool->out(), 2u);
    const void* before = a->add_stream(VFIT_STREAM_DEPTH, VFIT_FORMAT_U16, 64, 64);
    const uint64_t serial = a->find(VFIT_STREAM_DEPTH)->serial;
    a->set_meta("index", "1");
    a = nullptr;
    EXPECT_EQ(pool->out(), 1u);
    a = pool->take();
    EXPECT_EQ(a->find(VFIT_STREAM_DEPTH), nullptr);
    EXPECT_EQ(a->meta("index"), nullptr);
    EXPECT_EQ(a->add_stream(VFIT_STREAM_DEPTH, VFIT_FORMAT_U16, 64, 64), before);
    EXPECT_NE(a->find(VFIT_STREAM_DEPTH)->serial, serial);
}

TEST(Frame, ARowThatFourBytesCannotCountIsRefused) {
    const Ref<Frame> frame(new Frame);
    EXPECT_THROW(frame->add_stream(VFIT_STREAM_BONE_MATRIX, VFIT_FORMAT_F32X16, 1u << 26, 1), Error);
    EXPECT_THROW(frame->add_stream(VFIT_STREAM_SKIN_BONES, VFIT_FORMAT_U16X8, 1u << 28, 1), Error);
    EXPECT_TRUE(frame->kinds().empty());
}

TEST(FramePool, CountsTheMemoryOfItsFramesAlsoTogetherWithOtherPools) {
    auto total = make<FrameBytes>();
    auto a = make<FramePool>(2u, total), b = make<FramePool>(1u, total);
    Ref<Frame> frame = a->take();
    frame->add_stream(VFIT_STREAM_DEPTH, VFIT_FORMAT_U16, 10, 10);
    b->take()->add_stream(VFIT_STREAM_DEPTH, VFIT_FORMAT_U16, 10, 20);
    EXPECT_EQ(a->bytes(), 200u);
    EXPECT_EQ(total->count.load(), 600u);
    frame = nullptr;
    a->take()->add_stream(VFIT_STREAM_DEPTH, VFIT_FORMAT_U16, 5, 5);
    EXPECT_EQ(a->bytes(), 200u) << "the memory is used again";
    a = nullptr;
    EXPECT_EQ(total->count.load(), 400u);
}

TEST(FramePool, FramesOutliveThePoolsOwner) {
    auto pool = make<FramePool>(1u);
    Ref<Frame> frame = pool->take();
    auto* pixels = static_cast<uint8_t*>(frame->add_stream(VFIT_STREAM_USER_MAP, VFIT_FORMAT_U8, 8, 8));
    pool = nullptr;
    std::memset(pixels, 7, 64);
    EXPECT_EQ(frame->find(VFIT_STREAM_USER_MAP)->as<uint8_t>()[63], 7);
}

TEST(Frame, ATrackedFrameSeesItsBasesStreamsAndMeta) {
    auto pool = make<FramePool>(2u);
    Ref<Frame> base = pool->take();
    base->add_stream(VFIT_STREAM_DEPTH, VFIT_FORMAT_U16, 4, 4);
    base->set_meta("index", "12");
    Ref<Frame> tracked = pool->take();
    tracked->base = base;
    tracked->add_stream(VFIT_STREAM_USER_MAP, VFIT_FORMAT_U8, 4, 4);
    base = nullptr;
    EXPECT_NE(tracked->find(VFIT_STREAM_DEPTH), nullptr);
    EXPECT_EQ(*tracked->meta("index"), "12");
    EXPECT_EQ(tracked->kinds(), (std::vector<vfit_stream>{VFIT_STREAM_DEPTH, VFIT_STREAM_USER_MAP}));
}

TEST(Frame, AStreamOfItsOwnHidesTheBasesOne) {
    auto pool = make<FramePool>(2u);
    Ref<Frame> base = pool->take();
    base->add_stream(VFIT_STREAM_USER_MAP, VFIT_FORMAT_U8, 4, 4);
    Ref<Frame> tracked = pool->take();
    tracked->base = base;
    const void* pixels = tracked->add_stream(VFIT_STREAM_USER_MAP, VFIT_FORMAT_U8, 4, 4);
    EXPECT_EQ(tracked->find(VFIT_STREAM_USER_MAP)->data, pixels);
    EXPECT_EQ(tracked->kinds(), std::vector<vfit_stream>{VFIT_STREAM_USER_MAP});
}

}  // namespace
}  // namespace vfit
