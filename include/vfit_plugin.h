/* vfit_plugin.h - what a sensor plug-in exports and what the host lends it.   SPDX-License-Identifier: Apache-2.0
 *
 * A plug-in is a shared library with one symbol, vfit_plugin_negotiate. C only, no C++ classes cross the
 * border. It may use vfit.h as any program does, with a context of its own.
 *
 * THREADS  The host calls a device from one thread at a time; a plug-in pushes from any thread of its own.
 * FRAMES   frame_begin gives a pooled frame with room for its streams; fill the pixels in place, add
 *          intrinsics, camera, bodies and meta, then frame_push (hands the frame over, whatever it
 *          returns) or frame_drop. Nothing is copied afterwards.
 * PACE     With pace=none a push waits until the frame before was taken or the stream stops; then it
 *          returns VFIT_ERROR_STATE and the plug-in ends its loop.
 * SPACE    Bodies are pushed in camera space (x right, y down, z forward, metres); the host carries them
 *          to world space by the frame's camera.                                                       */
#ifndef VFIT_PLUGIN_H
#define VFIT_PLUGIN_H
#include "vfit.h"
#define VFIT_PLUGIN_ABI 1u              /* bumped only when an existing field changes its meaning     */

#if defined(_WIN32)
#define VFIT_PLUGIN_EXPORT __declspec(dllexport)
#else
#define VFIT_PLUGIN_EXPORT __attribute__((visibility("default")))
#endif

typedef struct vfit_frame_layout {      /* one stream of a frame                                      */
    uint32_t struct_size;
    vfit_stream stream;
    vfit_format format;
    uint32_t width, height, reserved;
} vfit_frame_layout;
VFIT_STRUCT(vfit_frame_layout)

typedef struct vfit_host {              /* valid from negotiate until shutdown returns; all are [any] */
    uint32_t struct_size, abi_min, abi_max, reserved;
    void* self;
    void (*log)(void* self, vfit_log_level level, const char* message);
    void (*sensor_added)(void* self, const vfit_sensor_info* info);
    void (*sensor_removed)(void* self, const char* uri);
    /* VFIT_ERROR_BUSY: the pool is empty, drop this image. VFIT_ERROR_STATE: the stream is stopping.     */
    vfit_result (*frame_begin)(void* self, void* stream, const vfit_frame_layout* layouts, uint32_t stride,
                               uint32_t count, vfit_frame* out);
    vfit_result (*frame_pixels)(void* self, vfit_frame frame, vfit_stream kind, void** pixels,
                                uint32_t* row_stride);
    vfit_result (*frame_intrinsics)(void* self, vfit_frame frame, const vfit_intrinsics* intrinsics);
    vfit_result (*frame_camera)(void* self, vfit_frame frame, const vfit_camera* camera);
    vfit_result (*frame_body)(void* self, vfit_frame frame, const vfit_body* body, const vfit_joint* items,
                              uint32_t stride, uint32_t count);
    vfit_result (*frame_meta)(void* self, vfit_frame frame, const char* key, const char* json);
    vfit_result (*frame_push)(void* self, void* stream, vfit_frame frame, int64_t time_ns);
    void (*frame_drop)(void* self, vfit_frame frame);
    /* END_OF_STREAM, DEVICE_LOST, OK, or the error that ended the stream, with its one sentence.         */
    void (*stream_state)(void* self, void* stream, vfit_result state, const char* message);
    int64_t (*time_ns)(void* self);     /* now, on the clock that frame_push expects                   */
} vfit_host;

typedef struct vfit_plugin {            /* filled by the plug-in; functions that it lacks stay null   */
    uint32_t struct_size, abi, version, caps;
    const char* name;
    const char* schemes;                /* "recording" or "openni2,oni": the URIs that it opens         */
    const char* usb_ids;                /* "1d27:0609,045e:02ae": what discovery watches for it; or null */
    void* self;
    vfit_result (*discover)(void* self);            /* reports by sensor_added; may be null             */
    /* The message of a failed open, set_option or start; copied at once.                               */
    const char* (*last_error)(void* self);
    vfit_result (*open)(void* self, const char* uri, void* stream, void** device);
    vfit_result (*set_option)(void* device, const char* key, const char* value);
    /* Item index of the lists of modes and options; VFIT_END_OF_STREAM past the last. May be null.      */
    vfit_result (*mode)(void* device, uint32_t index, vfit_sensor_mode* out);
    vfit_result (*option)(void* device, uint32_t index, vfit_sensor_option* out);
    vfit_result (*start)(void* device);
    vfit_result (*stop)(void* device);  /* no frame_push after it returns                             */
    void (*close)(void* device);
    void (*shutdown)(void* self);
} vfit_plugin;

/* The one symbol. Pick an abi within [abi_min, abi_max] or return VFIT_ERROR_VERSION. No exception leaves
 * a plug-in.                                                                                          */
typedef vfit_result (*vfit_plugin_negotiate_fn)(const vfit_host* host, vfit_plugin* out);
#ifdef __cplusplus
extern "C"
#endif
VFIT_PLUGIN_EXPORT vfit_result vfit_plugin_negotiate(const vfit_host* host, vfit_plugin* out);
#endif
