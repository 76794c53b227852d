// What the host lends a plug-in: the vfit_host functions. Everything that comes back through them is checked:
// streams are tokens that are looked up, frames are taken only while this plug-in is filling them.
#pragma once

#include <functional>
#include <mutex>
#include <new>
#include <string>
#include <vector>

#include "core/log.h"
#include "sensor/sensor_stream.h"

namespace vfit {

class HostTable {
public:
    HostTable(Log& log, std::function<uint64_t()> context_id);
    ~HostTable();
    HostTable(const HostTable&) = delete;
    HostTable& operator=(const HostTable&) = delete;

    const vfit_host* table() const { return &table_; }
    /// For log lines, and as the plug-in of the sensors it reports.
    void set_name(const std::string& name);

    /// A token for the stream, never a pointer; remove() makes it unknown. Frames that are being filled stay
    /// the plug-in's until it pushes or drops them, or is retired: a thread of it may still write to them.
    void* add_stream(Ref<SensorStream> stream);
    void remove_stream(void* token);

    /// Sensors that were reported and not removed. Between begin and end those that are reported again stay.
    void begin_discovery();
    void end_discovery(bool forget_others);
    std::vector<vfit_sensor_info> sensors() const;

    /// Takes back all frames and streams; nothing can be begun any more.
    void retire();

    /// Logs what the plug-in did wrong: each sentence once, and not more than a few.
    void complain(const std::string& what);

private:
    struct Filling {
        uint64_t id = 0;
        Ref<Frame> frame;
        void* token = nullptr;
    };
    struct OpenStream {
        void* token = nullptr;
        Ref<SensorStream> stream;
    };
    struct KnownSensor {
        vfit_sensor_info info{};
        bool fresh = false;
    };

    /// Every callback runs inside: nothing that is thrown reaches the plug-in.
    template <typename Body>
    static vfit_result enter(void* self, const char* what, Body&& body) noexcept {
        if (!self) return VFIT_ERROR_ARGUMENT;
        HostTable& table = *static_cast<HostTable*>(self);
        try {
            try {
                body(table);
                return VFIT_OK;
            } catch (const Error& error) {
                // Everyday answers: no frame is free, or the host is stopping the stream.
                if (error.code() != VFIT_ERROR_BUSY && error.code() != VFIT_ERROR_STATE)
                    table.complain(text(what, ": ", error.what()));
                return error.code();
            } catch (const std::bad_alloc&) {
                return VFIT_ERROR_OUT_OF_MEMORY;
            }
        } catch (...) {
            return VFIT_ERROR_UNKNOWN;
        }
    }

    static void log(void* self, vfit_log_level level, const char* message);
    static void sensor_added(void* self, const vfit_sensor_info* info);
    static void sensor_removed(void* self, const char* uri);
    static vfit_result frame_begin(void* self, void* stream, const vfit_frame_layout* layouts,
                                   uint32_t stride, uint32_t count, vfit_frame* out);
    static vfit_result frame_pixels(void* self, vfit_frame frame, vfit_stream kind, void** pixels,
                                    uint32_t* row_stride);
    static vfit_result frame_intrinsics(void* self, vfit_frame frame, const vfit_intrinsics* intrinsics);
    static vfit_result frame_camera(void* self, vfit_frame frame, const vfit_camera* camera);
    static vfit_result frame_body(void* self, vfit_frame frame, const vfit_body* body,
                                  const vfit_joint* items, uint32_t stride, uint32_t count);
    static vfit_result frame_meta(void* self, vfit_frame frame, const char* key, const char* json);
    static vfit_result frame_push(void* self, void* stream, vfit_frame frame, int64_t time_ns);
    static void frame_drop(void* self, vfit_frame frame);
    static void stream_state(void* self, void* stream, vfit_result state, const char* message);
    static int64_t time_ns(void* self);

    Ref<SensorStream> stream(void* token) const;
    bool is_open(void* token) const;     // with mutex_ held
    Filling& filling(vfit_frame frame);  // with mutex_ held
    Filling take_filling(vfit_frame frame);

    Log& log_;
    const std::function<uint64_t()> context_id_;
    vfit_host table_{};

    mutable std::mutex mutex_;
    bool retired_ = false;
    std::string name_ = "plug-in";
    uintptr_t next_token_ = 1;
    std::vector<OpenStream> streams_;
    std::vector<Filling> filling_;
    std::vector<KnownSensor> sensors_;
    std::string scratch_key_, scratch_json_;  // keep their memory from frame to frame
    std::vector<std::string> complaints_;
};

}  // namespace vfit
