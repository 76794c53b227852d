// The one carrier of bulk data: an immutable, reference-counted bundle of streams with one time stamp, and
// the bounded pool that frames come from and return to.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/object.h"
#include "frame/body.h"
#include "frame/camera.h"
#include "frame/depth_image.h"
#include "vfit.h"

namespace vfit {

/// Bytes of one item of a format; 0 for an unknown one.
uint32_t format_size(vfit_format format);

/// Memory that is 16-byte aligned and has 16 readable bytes past its end. Grows, never shrinks.
class AlignedBuffer {
public:
    void resize(size_t bytes);
    void* data() { return data_; }
    const void* data() const { return data_; }
    size_t capacity() const { return capacity_; }
    AlignedBuffer() = default;
    AlignedBuffer(const AlignedBuffer&) = delete;
    AlignedBuffer& operator=(const AlignedBuffer&) = delete;
    ~AlignedBuffer();

private:
    void* data_ = nullptr;
    size_t capacity_ = 0;
};

struct Stream {
    vfit_stream kind = 0;
    vfit_format format = VFIT_FORMAT_NONE;
    uint32_t width = 0, height = 0;
    uint32_t item_stride = 0, row_stride = 0;
    const void* data = nullptr;
    uint64_t serial = 0;

    template <typename T>
    const T* as() const {
        return static_cast<const T*>(data);
    }
    size_t items() const { return size_t(width) * height; }
};

/// Bytes of frame data, counted over several pools.
class FrameBytes : public Object {
public:
    std::atomic<uint64_t> count{0};
};

class FramePool;

class Frame : public Object {
public:
    int64_t time_ns = 0;
    Camera camera;                           // of the depth image; of no meaning in a mesh frame
    std::vector<Body> bodies;                // world space
    std::optional<ActiveBody> active;        // what the tracker says that made the frame
    Ref<Frame> base;                         // a tracked frame shares its images
    Ref<Object> owner;                       // keeps alive what views of add_view point to
    vfit_release_fn host_release = nullptr;  // pixels lent by the host
    void* host_user = nullptr;

    /// A stream with pixels of its own to fill before the frame is published; at most kMaxStreams. Fails with
    /// VFIT_ERROR_ARGUMENT where the frame has one of its own already or the size is not sane. It hides the
    /// base's.
    void* add_stream(vfit_stream kind, vfit_format format, uint32_t width, uint32_t height);
    /// A stream over memory that outlives the frame (lent by the host, or static topology of a model).
    void add_view(const Stream& stream);
    /// The stream of that kind, here or in the base; null if there is none.
    const Stream* find(vfit_stream kind) const;
    /// Kinds in the order they were added, the base's first, each once.
    std::vector<vfit_stream> kinds() const;

    void set_meta(const std::string& key, const std::string& json);
    const std::string* meta(const std::string& key) const;

    const Body* body(uint32_t id) const;
    /// Depth and user map; fails with VFIT_ERROR_ARGUMENT where the frame has no depth.
    DepthImage depth_image() const;

    /// A number that no other stream has had: equal serials mean equal content.
    static uint64_t next_serial();

private:
    friend class FramePool;
    const Stream* own(vfit_stream kind) const;
    static constexpr size_t kMaxStreams = 8;
    void unreferenced() override;
    void clear();

    struct Slot {
        Stream stream;
        AlignedBuffer buffer;
    };
    std::array<Slot, kMaxStreams> slots_;
    size_t stream_count_ = 0;
    std::vector<std::pair<std::string, std::string>> meta_;
    size_t meta_count_ = 0;
    FramePool* pool_ = nullptr;  // kept alive by the frame while it is out
};

/// A bounded pool. Frames that are out keep it alive.
class FramePool : public Object {
public:
    /// The memory of its frames is counted in `total` as well.
    explicit FramePool(uint32_t capacity, Ref<FrameBytes> total = nullptr)
        : capacity_(capacity), total_(std::move(total)) {}

    /// An empty frame, or null when `capacity` frames are out.
    Ref<Frame> take();
    uint32_t out() const { return out_.load(); }
    uint64_t bytes() const { return bytes_.load(); }

private:
    friend class Frame;
    ~FramePool() override;
    void give_back(Frame* frame);
    void count_bytes(uint64_t more);

    const uint32_t capacity_;
    const Ref<FrameBytes> total_;
    std::atomic<uint64_t> bytes_{0};
    std::atomic<uint32_t> out_{0};
    std::mutex mutex_;
    std::vector<std::unique_ptr<Frame>> frames_;
    std::vector<Frame*> idle_;
};

}  // namespace vfit
