#include "frame/frame.h"

#include <cstdlib>
#include <cstring>
#include <new>

#include "core/error.h"

namespace vfit {

namespace {

constexpr size_t kAlignment = 16;
constexpr size_t kReadablePastEnd = 16;   // so that SIMD loads of the last item stay inside
constexpr uint32_t kMaxSide = 16384;      // pixels
constexpr uint32_t kMaxItems = 1u << 28;  // vertices of one stream

}  // namespace

uint32_t format_size(vfit_format format) {
    switch (format) {
        case VFIT_FORMAT_U8: return 1;
        case VFIT_FORMAT_U16: return 2;
        case VFIT_FORMAT_U32: return 4;
        case VFIT_FORMAT_F32: return 4;
        case VFIT_FORMAT_RGBA8: return 4;
        case VFIT_FORMAT_F32X2: return 8;
        case VFIT_FORMAT_F32X3: return 12;
        case VFIT_FORMAT_F32X16: return 64;
        case VFIT_FORMAT_U16X8: return 16;
        case VFIT_FORMAT_F32X8: return 32;
        default: return 0;
    }
}

void AlignedBuffer::resize(size_t bytes) {
    if (bytes <= capacity_) return;
    void* memory = ::operator new(bytes + kReadablePastEnd, std::align_val_t(kAlignment), std::nothrow);
    if (!memory) fail(VFIT_ERROR_OUT_OF_MEMORY, "no memory for ", bytes, " bytes of frame data");
    std::memset(memory, 0, bytes + kReadablePastEnd);
    if (data_) ::operator delete(data_, std::align_val_t(kAlignment));
    data_ = memory;
    capacity_ = bytes;
}

AlignedBuffer::~AlignedBuffer() {
    if (data_) ::operator delete(data_, std::align_val_t(kAlignment));
}

uint64_t Frame::next_serial() {
    static std::atomic<uint64_t> counter{0};
    return counter.fetch_add(1, std::memory_order_relaxed) + 1;
}

void* Frame::add_stream(vfit_stream kind, vfit_format format, uint32_t width, uint32_t height) {
    const uint32_t item = format_size(format);
    if (item == 0) fail(VFIT_ERROR_ARGUMENT, "stream ", kind, ": unknown format ", format);
    if (width == 0 || height == 0 || (height > 1 ? width > kMaxSide || height > kMaxSide : width > kMaxItems))
        fail(VFIT_ERROR_ARGUMENT, "stream ", kind, ": size ", width, " x ", height, " is out of range");
    if (own(kind)) fail(VFIT_ERROR_ARGUMENT, "stream ", kind, " is in the frame already");
    if (stream_count_ == kMaxStreams)
        fail(VFIT_ERROR_ARGUMENT, "a frame holds at most ", kMaxStreams, " streams");
    const uint64_t row_bytes = uint64_t(item) * width;
    if (row_bytes > UINT32_MAX)
        fail(VFIT_ERROR_ARGUMENT, "stream ", kind, ": ", width, " items are too many");
    Slot& slot = slots_[stream_count_];
    const auto row = static_cast<uint32_t>(row_bytes);
    const size_t before = slot.buffer.capacity();
    slot.buffer.resize(size_t(row) * height);
    if (pool_) pool_->count_bytes(slot.buffer.capacity() - before);
    slot.stream = {kind, format, width, height, item, row, slot.buffer.data(), next_serial()};
    ++stream_count_;
    return slot.buffer.data();
}

void Frame::add_view(const Stream& stream) {
    if (own(stream.kind)) fail(VFIT_ERROR_ARGUMENT, "stream ", stream.kind, " is in the frame already");
    if (stream_count_ == kMaxStreams)
        fail(VFIT_ERROR_ARGUMENT, "a frame holds at most ", kMaxStreams, " streams");
    slots_[stream_count_++].stream = stream;
}

const Stream* Frame::own(vfit_stream kind) const {
    for (size_t i = 0; i < stream_count_; ++i)
        if (slots_[i].stream.kind == kind) return &slots_[i].stream;
    return nullptr;
}

const Stream* Frame::find(vfit_stream kind) const {
    const Stream* here = own(kind);
    return here || !base ? here : base->find(kind);
}

std::vector<vfit_stream> Frame::kinds() const {
    std::vector<vfit_stream> out = base ? base->kinds() : std::vector<vfit_stream>{};
    for (size_t i = 0; i < stream_count_; ++i)
        if (!base || !base->find(slots_[i].stream.kind)) out.push_back(slots_[i].stream.kind);
    return out;
}

void Frame::set_meta(const std::string& key, const std::string& json) {
    for (size_t i = 0; i < meta_count_; ++i)
        if (meta_[i].first == key) {
            meta_[i].second = json;
            return;
        }
    // Entries of an earlier use are overwritten in place: their strings keep their memory.
    if (meta_count_ == meta_.size()) meta_.emplace_back();
    meta_[meta_count_].first = key;
    meta_[meta_count_].second = json;
    ++meta_count_;
}

const std::string* Frame::meta(const std::string& key) const {
    for (size_t i = 0; i < meta_count_; ++i)
        if (meta_[i].first == key) return &meta_[i].second;
    return base ? base->meta(key) : nullptr;
}

const Body* Frame::body(uint32_t id) const {
    for (const Body& b : bodies)
        if (b.id == id) return &b;
    return nullptr;
}

DepthImage Frame::depth_image() const {
    const Stream* depth = find(VFIT_STREAM_DEPTH);
    if (!depth) fail(VFIT_ERROR_ARGUMENT, "the frame has no depth stream");
    const Stream* users = find(VFIT_STREAM_USER_MAP);
    return {depth->as<uint16_t>(), users ? users->as<uint8_t>() : nullptr, camera};
}

void Frame::clear() {
    if (host_release) host_release(host_user);
    host_release = nullptr;
    host_user = nullptr;
    time_ns = 0;
    camera = Camera{};
    bodies.clear();
    active.reset();
    base = nullptr;
    owner = nullptr;
    stream_count_ = 0;
    meta_count_ = 0;
}

void Frame::unreferenced() {
    FramePool* pool = pool_;
    clear();
    if (!pool) {
        delete this;
        return;
    }
    pool->give_back(this);
    pool->release();
}

Ref<Frame> FramePool::take() {
    Frame* frame = nullptr;
    {
        std::lock_guard lock(mutex_);
        if (out_.load() >= capacity_) return nullptr;
        if (idle_.empty()) {
            frames_.push_back(std::make_unique<Frame>());
            idle_.reserve(frames_.size());
            frame = frames_.back().get();
            frame->pool_ = this;
        } else {
            frame = idle_.back();
            idle_.pop_back();
        }
        out_.fetch_add(1);
    }
    retain();
    return Ref<Frame>(frame);
}

void FramePool::give_back(Frame* frame) {
    std::lock_guard lock(mutex_);
    idle_.push_back(frame);
    out_.fetch_sub(1);
}

void FramePool::count_bytes(uint64_t more) {
    bytes_.fetch_add(more);
    if (total_) total_->count.fetch_add(more);
}

FramePool::~FramePool() {
    if (total_) total_->count.fetch_sub(bytes_.load());
}

}  // namespace vfit
