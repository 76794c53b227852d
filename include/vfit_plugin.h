/* vfit_plugin.h - what a sensor plug-in exports and what the host lends it.   SPDX-License-Identifier:
 * Apache-2.0
 *
 * A plug-in is a shared library with one symbol, vfit_plugin_negotiate. C only, no C++ classes cross the
 * border. It may use vfit.h as any program does, with a context of its own. Each context of the host
 * negotiates once: keep what belongs to one behind vfit_plugin.self, not in globals.
 *
 * THREADS  The host calls one function of a plug-in at a time, for all its devices together, so that
 *          last_error belongs to the call that failed; a plug-in calls the host from any thread of its own.
 *          The host calls nothing after shutdown, and the plug-in nothing once shutdown has returned.
 * URIS     The host splits "SCHEME:ADDRESS?KEY=VALUE&KEY=VALUE": open gets "SCHEME:ADDRESS" with %XX decoded,
 *          then set_option gets each option, decoded, in the order of the URI. sensor_added and
 *          sensor_removed take "SCHEME:ADDRESS" as open does; the host encodes it for vfit_sensor_list.
 *          Where caps has VFIT_PLUGIN_NO_ADDRESS, options follow the colon: "SCHEME:KEY=VALUE&KEY=VALUE";
 *          open gets "SCHEME:", and sensor_added takes a URI as vfit_sensor_open does.
 * STREAMS  A stream is a token for the host's functions, not a pointer; it dies with close.
 * FRAMES   frame_begin gives a pooled frame with room for its streams: DEPTH U16, COLOR RGBA8, USER_MAP U8
 *          of the size of DEPTH, at most 16384 pixels a side. Fill the pixels in place (they hold what was
 *          there before), add intrinsics (of the depth image's size; required with DEPTH), camera, bodies
 *          and meta, then frame_push (hands the frame over, whatever it returns) or frame_drop. Nothing is
 *          copied afterwards. A frame that was begun is the plug-in's until it pushes or drops it, also
 *          after stop and close. Misuse gives an error code.
 * PACE     A plug-in whose option list has an entry "pace" sets the default by its value, "realtime" or
 *          "none", and is told when the host changes it; without one it is realtime. With pace=none a push
 *          waits until the frame before was taken, and frame_begin until one is free, or until the stream
 *          stops; then they return VFIT_ERROR_STATE and the plug-in ends its loop.
 * SPACE    Bodies are pushed in camera space (x right, y down, z forward, metres), with ids 1..255; a
 *          rotation turns a T-pose that has Y up and faces +Z into camera space. The host carries them to
 *          world space by the frame's camera, or, where its floor_state is DEFAULT, by a floor estimated
 *          below the feet of the stream's first body. A body that is not finite is refused with
 *          VFIT_ERROR_DATA, and the frame goes on without it. */
#ifndef VFIT_PLUGIN_H
#define VFIT_PLUGIN_H
#include "vfit.h"
#define VFIT_PLUGIN_ABI 1u /* bumped only when an existing field changes its meaning */

#if defined(_WIN32)
#define VFIT_PLUGIN_EXPORT __declspec(dllexport)
#else
#define VFIT_PLUGIN_EXPORT __attribute__((visibility("default")))
#endif

typedef struct vfit_frame_layout { /* one stream of a frame */
    uint32_t struct_size;
    vfit_stream stream;
    vfit_format format;
    uint32_t width, height, reserved;
} vfit_frame_layout;
VFIT_STRUCT(vfit_frame_layout)

typedef struct vfit_host { /* valid from negotiate until shutdown returns; all are [any] */
    uint32_t struct_size, abi_min, abi_max, reserved;
    void* self;
    void (*log)(void* self, vfit_log_level level, const char* message);
    void (*sensor_added)(void* self, const vfit_sensor_info* info);
    void (*sensor_removed)(void* self, const char* uri);
    /* VFIT_ERROR_BUSY: the pool is empty, drop this image. VFIT_ERROR_STATE: the stream is stopping. */
    vfit_result (*frame_begin)(void* self, void* stream, const vfit_frame_layout* layouts, uint32_t stride,
                               uint32_t count, vfit_frame* out);
    vfit_result (*frame_pixels)(void* self, vfit_frame frame, vfit_stream kind, void** pixels,
                                uint32_t* row_stride);
    vfit_result (*frame_intrinsics)(void* self, vfit_frame frame, const vfit_intrinsics* intrinsics);
    vfit_result (*frame_camera)(void* self, vfit_frame frame, const vfit_camera* camera);
    vfit_result (*frame_body)(void* self, vfit_frame frame, const vfit_body* body, const vfit_joint* items,
                              uint32_t stride, uint32_t count);
    vfit_result (*frame_meta)(void* self, vfit_frame frame, const char* key, const char* json);
    /* time_ns 0: now. The frame's handle is dead afterwards. */
    vfit_result (*frame_push)(void* self, void* stream, vfit_frame frame, int64_t time_ns);
    void (*frame_drop)(void* self, vfit_frame frame);
    /* END_OF_STREAM, DEVICE_LOST, OK (after DEVICE_LOST), or the error that ended the stream, with its one
     * sentence. A frame that waits is taken first. */
    void (*stream_state)(void* self, void* stream, vfit_result state, const char* message);
    int64_t (*time_ns)(void* self); /* now, on the clock that frame_push expects */
} vfit_host;

enum { VFIT_PLUGIN_NO_ADDRESS = 1 }; /* bits of vfit_plugin.caps; see URIS */

/* Filled by the plug-in; functions that it lacks stay null. Required: abi, name, schemes, open, start,
 * stop, close. struct_size holds the host's size before. */
typedef struct vfit_plugin {
    uint32_t struct_size, abi, version, caps;
    const char* name;
    const char* schemes; /* "recording" or "openni2,oni": the URIs that it opens */
    const char* usb_ids; /* "1d27:0609,045e:02ae" or null: the host watches for those */
    void* self;
    vfit_result (*discover)(void* self); /* reports by sensor_added; may be null */
    /* The message of a failed open, set_option or start; copied at once. */
    const char* (*last_error)(void* self);
    vfit_result (*open)(void* self, const char* uri, void* stream, void** device);
    vfit_result (*set_option)(void* device, const char* key, const char* value);
    /* Item index of the lists of modes and options; VFIT_END_OF_STREAM past the last. May be null. */
    vfit_result (*mode)(void* device, uint32_t index, vfit_sensor_mode* out);
    vfit_result (*option)(void* device, uint32_t index, vfit_sensor_option* out);
    vfit_result (*start)(void* device);
    vfit_result (*stop)(void* device); /* no frame_push after it returns */
    void (*close)(void* device);
    void (*shutdown)(void* self);
} vfit_plugin;

/* The one symbol. Pick an abi within [abi_min, abi_max] or return VFIT_ERROR_VERSION. No exception leaves
 * a plug-in. */
typedef vfit_result (*vfit_plugin_negotiate_fn)(const vfit_host* host, vfit_plugin* out);
#ifdef __cplusplus
extern "C"
#endif
    VFIT_PLUGIN_EXPORT vfit_result
    vfit_plugin_negotiate(const vfit_host* host, vfit_plugin* out);
#endif
