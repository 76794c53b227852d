/* vfit.h - C ABI of the vfit virtual-fitting SDK.                  SPDX-License-Identifier: Apache-2.0
 *
 * FLOW     open sensor    vfit_sensor_open, vfit_sensor_acquire        -> frame (or vfit_frame_create)
 *          track          vfit_tracker_update, vfit_tracker_submit     -> user map, bodies
 *          measure        vfit_scan_add, vfit_scan_measure             -> measurements with sigma
 *          get size       vfit_size_recommend                          -> labels with probability
 *          step motion    vfit_motion_step                             -> pose (bones, contacts)
 *          step cloth     vfit_avatar_pose, vfit_cloth_step            -> mesh, colliders, garment
 *          fetch buffers  vfit_avatar_acquire, vfit_cloth_acquire, vfit_frame_view, vfit_frame_write
 * RESULT   0 success; > 0 success with news (nothing new, timed out); < 0 error. On error no output
 *          is written but a null handle; vfit_last_error() tells this thread why. No exception
 *          leaves the library and no call ends the process.
 * STRUCT   A struct passed by pointer starts with struct_size: get it from <type>_init(). Fields are
 *          only appended; a zero input field means "default". A struct larger than the library knows
 *          is accepted if the unknown tail is zero, else VFIT_ERROR_UNSUPPORTED; of an output struct
 *          only struct_size bytes are written. In arrays the stride argument takes its place; where it
 *          is larger than the library knows, the tail of each item is zeroed. No implicit padding.
 * HANDLE   64-bit id (kind, slot, generation), by value, 0 is null. A stale or foreign handle gives
 *          VFIT_ERROR_HANDLE, never a crash. Destroying null is a no-op. A parent takes its children
 *          with it. Destroy may come from any thread (a finalizer) and takes effect after the step
 *          that is running. The one process-wide thing in the library is the table of handles.
 * FRAME    The one carrier of bulk data: an immutable, reference counted bundle of views with one
 *          time stamp. acquire gives a reference, retain adds one, release drops one; a view lives
 *          as long as any reference, so it needs no lock. Pools are bounded: hold too many frames
 *          and a sensor drops new ones, a step returns VFIT_ERROR_BUSY and changes nothing.
 * LIST     Lists come item by item: items null sets *count; else up to *count items of stride bytes
 *          are filled and *count is the number filled. A short array gives VFIT_ERROR_CAPACITY with
 *          *count holding the need.
 * TEXT     Calls that fill a char buffer return the length of the whole text (without its end); what
 *          does not fit is cut, and the buffer always ends with 0.
 * MEMORY   vfit never frees your memory and you never free vfit's.
 * THREADS  [any]  any thread at any time, also concurrently on the same object
 *          [read] concurrent with other [read] calls on the object, never with an [excl] one
 *          [excl] one thread at a time per object; distinct objects run in parallel. A breach gives
 *                 VFIT_ERROR_BUSY.
 * CALLBACK Runs on any thread; may call [any] functions only; must not unwind. Never called again
 *          once the destroy of its context has returned.
 * SPACE    World: origin on the floor below the camera, +Y up, right-handed, a person who faces the
 *          camera faces +Z. Bodies, poses, colliders and meshes are in world space. Camera: x right,
 *          y down, z forward, not mirrored. desc.axes changes what vfit writes, so that no binding
 *          converts per vertex: UNITY metre, Y up, left-handed; UNREAL centimetre, Z up, X forward,
 *          left-handed; in left-handed output the winding is reversed; uv origin bottom-left for
 *          UNITY, else top-left. VFIT_CONTEXT_MIRROR swaps left and right of what is written.
 * UNITS    Metre, second, radian; time stamps in ns on one monotonic clock per context; quaternion
 *          xyzw; matrix column-major.
 * TARGETS  64-bit little-endian; cdecl; UTF-8; boolean = uint32_t 0/1; enum = 32 bits.
 * VERSION  0.x may change. From 1.0 on, within one MAJOR, a program built with an older header runs on
 *          a newer library. */
#ifndef VFIT_H
#define VFIT_H
#include <stdint.h>

#define VFIT_MAKE_VERSION(a, b, c) (((uint32_t)(a) << 22) | ((uint32_t)(b) << 12) | (uint32_t)(c))
#define VFIT_VERSION VFIT_MAKE_VERSION(0, 2, 0)

#if defined(_WIN32) && defined(vfit_EXPORTS)
#define VFIT_EXPORT __declspec(dllexport)
#elif defined(_WIN32) && !defined(VFIT_STATIC)
#define VFIT_EXPORT __declspec(dllimport)
#elif defined(__GNUC__)
#define VFIT_EXPORT __attribute__((visibility("default")))
#else
#define VFIT_EXPORT
#endif
#ifdef __cplusplus
#define VFIT_API extern "C" VFIT_EXPORT
#define VFIT_ZERO \
    {             \
    }
#else
#define VFIT_API extern VFIT_EXPORT
#define VFIT_ZERO {0}
#endif
/* Inline on purpose: sizeof is that of the caller's header, not of the library's. */
#define VFIT_STRUCT(T)                       \
    static inline T T##_init(void) {         \
        T s = VFIT_ZERO;                     \
        s.struct_size = (uint32_t)sizeof(T); \
        return s;                            \
    }
#define VFIT_HANDLE(T) \
    typedef struct T { \
        uint64_t id;   \
    } T

typedef int32_t vfit_result;
enum {
    VFIT_OK = 0,
    VFIT_NOT_READY = 1,
    VFIT_TIMEOUT = 2,
    VFIT_INCOMPLETE = 3,
    VFIT_END_OF_STREAM = 4,
    VFIT_ERROR_UNKNOWN = -1,
    VFIT_ERROR_ARGUMENT = -2,
    VFIT_ERROR_HANDLE = -3, /* null, destroyed, or of another kind */
    VFIT_ERROR_STATE = -4,  /* right call, wrong moment */
    VFIT_ERROR_BUSY = -5,
    VFIT_ERROR_CAPACITY = -6, /* array or target too small; *count holds the need */
    VFIT_ERROR_UNSUPPORTED = -7,
    VFIT_ERROR_VERSION = -8,
    VFIT_ERROR_OUT_OF_MEMORY = -9,
    VFIT_ERROR_IO = -10,
    VFIT_ERROR_DATA = -11, /* file, frame or garment content is malformed */
    VFIT_ERROR_DEVICE_LOST = -12,
    VFIT_ERROR_PLUGIN = -13,
    VFIT_ERROR_NOT_WEARABLE = -14 /* the garment in that size does not close around the body */
};

VFIT_HANDLE(vfit_context);
VFIT_HANDLE(vfit_sensor);
VFIT_HANDLE(vfit_frame);
VFIT_HANDLE(vfit_tracker);
VFIT_HANDLE(vfit_scan);
VFIT_HANDLE(vfit_size_chart);
VFIT_HANDLE(vfit_motion);
VFIT_HANDLE(vfit_avatar);
VFIT_HANDLE(vfit_garment);
VFIT_HANDLE(vfit_cloth);
VFIT_HANDLE(vfit_recorder);
VFIT_HANDLE(vfit_prop);
VFIT_HANDLE(vfit_population);

/* ---- context ------------------------------------------------------------------------------------ */
typedef int32_t vfit_axes;
enum { VFIT_AXES_RH_Y_UP = 0, VFIT_AXES_UNITY = 1, VFIT_AXES_UNREAL = 2 };
typedef int32_t vfit_log_level;
enum { VFIT_LOG_ERROR = 0, VFIT_LOG_WARNING = 1, VFIT_LOG_INFO = 2, VFIT_LOG_DEBUG = 3 };
typedef void (*vfit_log_fn)(void* user, vfit_log_level level, const char* message);
/* The host's job system: submit starts count items and returns a job, wait returns when all have run.
 * Both are called only on a thread that is inside a vfit call. An item never waits for one that has not
 * started; one worker alone completes any step. A null job means that all items have run already. */
typedef void (*vfit_task_fn)(void* task, uint32_t index);
typedef void* (*vfit_submit_fn)(void* user, vfit_task_fn fn, void* task, uint32_t count);
typedef void (*vfit_wait_fn)(void* user, void* job);
/* DETERMINISTIC: equal bits for equal input, binary and SIMD level, any worker count. Always so as yet. */
enum {
    VFIT_CONTEXT_VALIDATE = 1, /* reserved for slower checks; this version's are always on */
    VFIT_CONTEXT_DETERMINISTIC = 2,
    VFIT_CONTEXT_MIRROR = 4
};

typedef struct vfit_context_desc {
    uint32_t struct_size;
    uint32_t api_version; /* required: VFIT_VERSION */
    uint32_t flags;       /* VFIT_CONTEXT_* */
    vfit_axes axes;
    vfit_log_fn log;       /* null: errors and warnings to stderr */
    vfit_submit_fn submit; /* null: own small pool */
    vfit_wait_fn wait;
    void* user;             /* first argument of all three */
    const char* plugin_dir; /* null: vfit_plugins beside the library */
    const char* data_dir;   /* null: vfit_data beside the library */
    uint32_t worker_count;  /* 0: physical cores less one */
    uint32_t reserved;
} vfit_context_desc;
typedef struct vfit_library_info {
    uint32_t struct_size, version;
    char simd[16];   /* instruction set in use: "AVX2", "SSE4", "SCALAR", ... */
    char build[112]; /* compiler and build type */
} vfit_library_info;
typedef struct vfit_plugin_info {
    uint32_t struct_size, version;
    char name[64], schemes[64], path[256];
} vfit_plugin_info;
/* A file of data_dir, by the name that opens it. */
typedef struct vfit_data_name {
    uint32_t struct_size;
    char name[64];
} vfit_data_name;
typedef struct vfit_context_stats {
    uint32_t struct_size, handle_count, frame_count, worker_count;
    uint64_t frame_bytes; /* held by this context's frames, pools included */
} vfit_context_stats;
/* Time spent in one stage since the context was created (or since vfit_profile_reset). */
typedef struct vfit_profile {
    uint32_t struct_size, calls;
    double last_ms, mean_ms, max_ms;
    char stage[32];
} vfit_profile;
VFIT_STRUCT(vfit_context_desc)
VFIT_STRUCT(vfit_library_info)
VFIT_STRUCT(vfit_data_name)
VFIT_STRUCT(vfit_plugin_info)
VFIT_STRUCT(vfit_context_stats)
VFIT_STRUCT(vfit_profile)

VFIT_API uint32_t vfit_version(void);                                                       /* [any] */
VFIT_API vfit_result vfit_library_describe(vfit_library_info* out);                         /* [any] */
VFIT_API const char* vfit_result_name(vfit_result result);                                  /* [any] */
VFIT_API uint32_t vfit_last_error(char* buffer, uint32_t capacity);                         /* [any] */
VFIT_API vfit_result vfit_context_create(const vfit_context_desc* desc, vfit_context* out); /* [any] */
VFIT_API vfit_result vfit_context_destroy(vfit_context context); /* joins all threads [excl] */
VFIT_API vfit_result vfit_shutdown(void); /* all contexts; for a host that reloads [excl] */
VFIT_API vfit_result vfit_context_describe(vfit_context context, vfit_context_stats* out); /* [any] */
/* Now, on the clock of all time stamps of this context. [any] */
VFIT_API vfit_result vfit_context_time(vfit_context context, int64_t* time_ns);
VFIT_API vfit_result vfit_profile_list(vfit_context context, vfit_profile* items, uint32_t stride,
                                       uint32_t* count);       /* [any] */
VFIT_API vfit_result vfit_profile_reset(vfit_context context); /* [any] */
/* The next log line where no callback is wanted (Unity reloads, Python); VFIT_NOT_READY: none. [any] */
VFIT_API vfit_result vfit_log_next(vfit_context context, vfit_log_level* level, char* buffer,
                                   uint32_t capacity);
VFIT_API vfit_result vfit_plugin_load(vfit_context context, const char* path); /* [excl] */
VFIT_API vfit_result vfit_plugin_list(vfit_context context, vfit_plugin_info* items, uint32_t stride,
                                      uint32_t* count); /* [any] */

/* ---- vocabularies: joints (what a sensor sees), bones (what a character has) ----------------------- */
/* One meaning everywhere: SHOULDER is the head of the humerus, HIP that of the femur, HAND the hand's centre
 * of mass in the palm (some 7 cm from the wrist), FOOT the ankle joint; LEFT is the person's own left. */
typedef int32_t vfit_joint_id;
enum {
    VFIT_JOINT_HEAD = 0,
    VFIT_JOINT_NECK = 1,
    VFIT_JOINT_TORSO = 2,
    VFIT_JOINT_LEFT_SHOULDER = 3,
    VFIT_JOINT_RIGHT_SHOULDER = 4,
    VFIT_JOINT_LEFT_ELBOW = 5,
    VFIT_JOINT_RIGHT_ELBOW = 6,
    VFIT_JOINT_LEFT_HAND = 7,
    VFIT_JOINT_RIGHT_HAND = 8,
    VFIT_JOINT_LEFT_HIP = 9,
    VFIT_JOINT_RIGHT_HIP = 10,
    VFIT_JOINT_LEFT_KNEE = 11,
    VFIT_JOINT_RIGHT_KNEE = 12,
    VFIT_JOINT_LEFT_FOOT = 13,
    VFIT_JOINT_RIGHT_FOOT = 14, /* the paper's 15 */
    VFIT_JOINT_PELVIS = 15,
    VFIT_JOINT_CHEST = 16,
    VFIT_JOINT_LEFT_CLAVICLE = 17,
    VFIT_JOINT_RIGHT_CLAVICLE = 18,
    VFIT_JOINT_LEFT_WRIST = 19,
    VFIT_JOINT_RIGHT_WRIST = 20,
    VFIT_JOINT_LEFT_TOES = 21,
    VFIT_JOINT_RIGHT_TOES = 22
};
#define VFIT_JOINT_COUNT 23u
/* VRM humanoid bones; parents stand before children. */
typedef int32_t vfit_bone_id;
enum {
    VFIT_BONE_HIPS = 0,
    VFIT_BONE_SPINE = 1,
    VFIT_BONE_CHEST = 2,
    VFIT_BONE_UPPER_CHEST = 3,
    VFIT_BONE_NECK = 4,
    VFIT_BONE_HEAD = 5,
    VFIT_BONE_LEFT_SHOULDER = 6,
    VFIT_BONE_LEFT_UPPER_ARM = 7,
    VFIT_BONE_LEFT_LOWER_ARM = 8,
    VFIT_BONE_LEFT_HAND = 9,
    VFIT_BONE_RIGHT_SHOULDER = 10,
    VFIT_BONE_RIGHT_UPPER_ARM = 11,
    VFIT_BONE_RIGHT_LOWER_ARM = 12,
    VFIT_BONE_RIGHT_HAND = 13,
    VFIT_BONE_LEFT_UPPER_LEG = 14,
    VFIT_BONE_LEFT_LOWER_LEG = 15,
    VFIT_BONE_LEFT_FOOT = 16,
    VFIT_BONE_LEFT_TOES = 17,
    VFIT_BONE_RIGHT_UPPER_LEG = 18,
    VFIT_BONE_RIGHT_LOWER_LEG = 19,
    VFIT_BONE_RIGHT_FOOT = 20,
    VFIT_BONE_RIGHT_TOES = 21
};
#define VFIT_BONE_COUNT 22u
/* Names "HEAD", "LEFT_ELBOW"; "hips", "leftUpperArm". An unknown id gives length 0 and an empty text.
 * The parent of the first bone is -1; of an unknown one -2. */
VFIT_API uint32_t vfit_joint_name(vfit_joint_id joint, char* buffer, uint32_t capacity); /* [any] */
VFIT_API uint32_t vfit_bone_name(vfit_bone_id bone, char* buffer, uint32_t capacity);    /* [any] */
VFIT_API int32_t vfit_bone_parent(vfit_bone_id bone);                                    /* [any] */
/* Key ("chest_girth_m") and one-line definition of the measure at index; length 0 past the last. */
VFIT_API uint32_t vfit_measure_key(uint32_t index, char* buffer, uint32_t capacity);  /* [any] */
VFIT_API uint32_t vfit_measure_text(uint32_t index, char* buffer, uint32_t capacity); /* [any] */

/* ---- frame -------------------------------------------------------------------------------------- */
typedef int32_t vfit_stream;
enum {
    VFIT_STREAM_DEPTH = 0,    /* U16 in units of vfit_camera.depth_unit_m, 0: no reading */
    VFIT_STREAM_COLOR = 1,    /* RGBA8, registered to depth */
    VFIT_STREAM_USER_MAP = 2, /* U8: 0 background, else the body's id */
    VFIT_STREAM_POSITION = 16,
    VFIT_STREAM_NORMAL = 17,
    VFIT_STREAM_UV = 18,           /* one a vertex */
    VFIT_STREAM_INDEX = 19,        /* U32, three a triangle */
    VFIT_STREAM_BONE_MATRIX = 20,  /* skinning matrices, one a rig bone */
    VFIT_STREAM_SKIN_BONES = 21,   /* U16X8: rig bones that carry a vertex */
    VFIT_STREAM_SKIN_WEIGHTS = 22, /* F32X8: their weights, sum 1, zero where unused */
    VFIT_STREAM_STRAIN = 23,       /* F32, mean edge strain at a vertex, 0 = unstretched */
    VFIT_STREAM_PRESSURE = 24
}; /* F32, Pa: what the body presses with against a vertex */
typedef int32_t vfit_format;
enum {
    VFIT_FORMAT_NONE = 0,
    VFIT_FORMAT_U8 = 1,
    VFIT_FORMAT_U16 = 2,
    VFIT_FORMAT_U32 = 3,
    VFIT_FORMAT_F32 = 4,
    VFIT_FORMAT_RGBA8 = 5,
    VFIT_FORMAT_F32X2 = 6,
    VFIT_FORMAT_F32X3 = 7,
    VFIT_FORMAT_F32X16 = 8,
    VFIT_FORMAT_U16X8 = 9,
    VFIT_FORMAT_F32X8 = 10
};

typedef struct vfit_view {
    uint32_t struct_size;
    vfit_format format;
    const void* data;                 /* 16-byte aligned, 16 readable bytes past the last item; where a
                                       * host lent the pixels: as it lent them */
    uint32_t width, height;           /* items; height is 1 for vertex data */
    uint32_t item_stride, row_stride; /* bytes */
    int64_t time_ns;
    uint64_t serial; /* equal serials of one stream: equal content */
} vfit_view;
/* Where vfit_frame_write writes: item i at data + i * item_stride (0: packed); capacity in bytes. */
typedef struct vfit_target {
    uint32_t struct_size;
    vfit_format format;
    void* data;
    uint64_t capacity;
    uint32_t item_stride, reserved;
} vfit_target;
typedef struct vfit_intrinsics {
    uint32_t struct_size, width, height, reserved;
    float fx, fy, cx, cy, distortion[8];
} vfit_intrinsics;
typedef int32_t vfit_floor_state;
enum {
    VFIT_FLOOR_DEFAULT = 0,   /* nobody knows: level camera, 1 m above the floor */
    VFIT_FLOOR_ESTIMATED = 1, /* seen in the depth image; else below the first body's feet */
    VFIT_FLOOR_GIVEN = 2
}; /* by the sensor, the recording or the host */
typedef struct vfit_camera { /* where the camera stands */
    uint32_t struct_size;
    vfit_floor_state floor_state;
    float depth_unit_m;                 /* 0: 0.001 */
    float height_m, tilt_rad, roll_rad; /* above the floor; tilt > 0 looks down. Outputs only */
    float floor_normal[3];              /* in camera space, pointing up: normal . p + distance = 0 */
    float floor_distance_m;
    float world_from_camera[16]; /* output only; bodies are carried by it; metres whatever axes */
} vfit_camera;
VFIT_STRUCT(vfit_view)
VFIT_STRUCT(vfit_target)
VFIT_STRUCT(vfit_intrinsics)
VFIT_STRUCT(vfit_camera)

/* A frame from pixels of the host (its own camera): views[i] is stream streams[i]. The pixels are
 * copied unless release is given, which is then called once, from any thread, when the last
 * reference has gone (and not at all where the call fails). Lent pixels are packed and aligned to their
 * format. */
typedef void (*vfit_release_fn)(void* user);
typedef struct vfit_frame_desc {
    uint32_t struct_size, count;
    const vfit_stream* streams;        /* DEPTH, COLOR, USER_MAP; depth is required */
    const vfit_view* views;            /* count items, struct_size of the first apart */
    const vfit_intrinsics* intrinsics; /* of the depth image */
    const vfit_camera* camera;         /* null: 1 mm units, floor unknown */
    int64_t time_ns;                   /* 0: now */
    vfit_release_fn release;
    void* user;
} vfit_frame_desc;
VFIT_STRUCT(vfit_frame_desc)
VFIT_API vfit_result vfit_frame_create(vfit_context context, const vfit_frame_desc* desc,
                                       vfit_frame* out);   /* [any] */
VFIT_API vfit_result vfit_frame_retain(vfit_frame frame);  /* [any] */
VFIT_API vfit_result vfit_frame_release(vfit_frame frame); /* [any] */
VFIT_API vfit_result vfit_frame_streams(vfit_frame frame, vfit_stream* items, uint32_t* count);
/* [any] */
VFIT_API vfit_result vfit_frame_view(vfit_frame frame, vfit_stream stream, vfit_view* out); /* [any] */
VFIT_API vfit_result vfit_frame_intrinsics(vfit_frame frame, vfit_intrinsics* out);         /* [any] */
VFIT_API vfit_result vfit_frame_camera(vfit_frame frame, vfit_camera* out);                 /* [any] */
/* What the source says beside the pixels, one JSON document a key: "measures" (ground truth of a virtual
 * person, {"stature_m": ...}), "contacts" (of feet, {"left": 0, "right": 1}: 0 free, 1 the whole foot stands,
 * 2 only its heel or ball does), "index" (the number of a recorded frame), "bodies" (true: the source tells
 * its bodies, also when no person is in view); and of a frame in which the built-in tracker found no body,
 * "no_person" ("nothing is within 6 m", ...: why). *length is the whole text's; no such key:
 * VFIT_NOT_READY. [any] */
VFIT_API vfit_result vfit_frame_meta(vfit_frame frame, const char* key, char* buffer, uint32_t capacity,
                                     uint32_t* length);
/* Copies into memory of the engine (mapped vertex buffer, NativeArray) at its own format and stride;
 * VFIT_NOT_READY and no copy if *serial is already that of the frame. serial may be null. [any] */
VFIT_API vfit_result vfit_frame_write(vfit_frame frame, vfit_stream stream, const vfit_target* target,
                                      uint64_t* serial);

/* ---- sensor: "recording:PATH", "virtual:", "openni2:...", all of them plug-ins --------------------- */
typedef struct vfit_sensor_info {
    uint32_t struct_size, caps;
    char uri[256], name[64], plugin[64];
} vfit_sensor_info;
typedef struct vfit_sensor_mode {
    uint32_t struct_size, width, height;
    float rate_hz;
    char name[64];
} vfit_sensor_mode;
typedef struct vfit_sensor_option {
    uint32_t struct_size, reserved;
    char key[32], value[96], text[128];
} vfit_sensor_option;
typedef struct vfit_sensor_stats {
    uint32_t struct_size, running;
    vfit_result state; /* OK, END_OF_STREAM, DEVICE_LOST or the plug-in's error */
    uint32_t reserved;
    uint64_t received, taken, dropped; /* frames pushed, acquired, replaced before they were acquired */
    int64_t latency_ns;                /* of the last acquire: from time stamp to hand-over */
} vfit_sensor_stats;
VFIT_STRUCT(vfit_sensor_info)
VFIT_STRUCT(vfit_sensor_mode)
VFIT_STRUCT(vfit_sensor_option)
VFIT_STRUCT(vfit_sensor_stats)
VFIT_API vfit_result vfit_sensor_list(vfit_context context, vfit_sensor_info* items, uint32_t stride,
                                      uint32_t* count); /* [any] */
/* Rises when the list may have become another: a USB camera of a kind that a plug-in knows was plugged in or
 * unplugged, a plug-in was loaded. Cheap: ask each frame, and list again when it has changed. [any] */
VFIT_API vfit_result vfit_sensor_changes(vfit_context context, uint64_t* count);
/* Opens a source: a path, or a URI "SCHEME:ADDRESS?KEY=VALUE&KEY=VALUE", such as
 * "recording:PATH?loop=1&start=5", "oni:PATH?start=3" or "openni2:?registration=0". The virtual person has no
 * address: "virtual:motion=demo&sex=f". Each option is set, and fails, as by vfit_sensor_set_option; a key
 * stands at most once. %XX is one byte: %3F is a ? in a path, %26 an & in a value. A path is not decoded: an
 * existing folder is a recording, an existing file goes by its extension, and options may follow:
 * "PATH?start=5". The longest existing path counts, so that a path that exists as written has no options.
 * [any] */
VFIT_API vfit_result vfit_sensor_open(vfit_context context, const char* uri, vfit_sensor* out);
VFIT_API vfit_result vfit_sensor_modes(vfit_sensor sensor, vfit_sensor_mode* items, uint32_t stride,
                                       uint32_t* count); /* [read] */
VFIT_API vfit_result vfit_sensor_options(vfit_sensor sensor, vfit_sensor_option* items, uint32_t stride,
                                         uint32_t* count); /* [read] */
/* Options of every sensor: "mode" (a name from vfit_sensor_modes) and "pace": "realtime" drops as a
 * camera does; "none" (the default of recordings and of the virtual person) makes a push wait until the
 * frame before was taken, so that nothing is dropped. [excl] */
VFIT_API vfit_result vfit_sensor_set_option(vfit_sensor sensor, const char* key, const char* value);
VFIT_API vfit_result vfit_sensor_start(vfit_sensor sensor); /* [excl] */
VFIT_API vfit_result vfit_sensor_stop(vfit_sensor sensor);  /* wakes waiting acquires [excl] */
VFIT_API vfit_result vfit_sensor_close(vfit_sensor sensor); /* [excl] */
/* The newest frame, once; VFIT_END_OF_STREAM when a replay has ended; the error of the stream when it
 * failed. timeout_ns 0 never waits: call it so from a render loop; < 0 waits without end. [any] */
VFIT_API vfit_result vfit_sensor_acquire(vfit_sensor sensor, int64_t timeout_ns, vfit_frame* out);
VFIT_API vfit_result vfit_sensor_describe(vfit_sensor sensor, vfit_sensor_stats* out); /* [any] */

/* ---- recorder: writes the recording folder (docs/recording.md) ------------------------------------- */
typedef struct vfit_recorder_desc {
    uint32_t struct_size, reserved;
    const char* sensor_name; /* for camera.json; null: "unknown" */
    float rate_hz;           /* 0: 30 */
    uint32_t segmented;      /* the background was removed already */
} vfit_recorder_desc;
VFIT_STRUCT(vfit_recorder_desc)
/* path must not exist or be an empty folder. What was written stays readable if the process dies: each
 * file is complete before its name appears. */
VFIT_API vfit_result vfit_recorder_create(vfit_context context, const char* path,
                                          const vfit_recorder_desc* desc, vfit_recorder* out); /* [any] */
VFIT_API vfit_result vfit_recorder_write(vfit_recorder recorder, vfit_frame frame);            /* [excl] */
VFIT_API vfit_result vfit_recorder_destroy(vfit_recorder recorder);                            /* [excl] */

/* ---- bodies and tracker ---------------------------------------------------------------------------- */
typedef int32_t vfit_joint_state;
enum { VFIT_JOINT_NOT_SEEN = 0, VFIT_JOINT_INFERRED = 1, VFIT_JOINT_MEASURED = 2 };
/* rotation: of the joint in world space, relative to a T-pose that faces +Z; all zero: unknown. */
typedef struct vfit_joint {
    uint32_t struct_size;
    vfit_joint_id joint;
    vfit_joint_state state;
    float confidence, position[3], rotation[4];
    uint32_t reserved;
} vfit_joint;
enum {
    VFIT_BODY_CAMERA_SPACE = 1, /* input only: positions are in camera space */
    VFIT_BODY_PARTLY_OUT_OF_VIEW = 2
};
typedef struct vfit_body {
    uint32_t struct_size, body_id;
    int64_t time_ns;
    uint32_t flags, reserved;
} vfit_body;
typedef int32_t vfit_track_source;
enum {
    VFIT_TRACK_AUTO = 0, /* the source's where it tells them, else the built-in tracker's */
    VFIT_TRACK_BUILT_IN = 1,
    VFIT_TRACK_GIVEN = 2
}; /* the source's alone: UNSUPPORTED where it tells none */
/* Joints steadied over time by a one-Euro filter, their states lowered to what their confidence bears out:
 * MEASURED from 0.5 on, INFERRED from 0.15 on; where a body has states and no confidence those stand for it.
 */
typedef int32_t vfit_joint_filter;
enum {
    VFIT_FILTER_AUTO = 0, /* the tracker's own joints and submitted ones; a source's own stay as
                           * they are (a recording's, the truth of a virtual person) */
    VFIT_FILTER_ON = 1,   /* a source's own too */
    VFIT_FILTER_OFF = 2
}; /* none */
/* The active person, whom a mirror serves. Somebody else becomes it who has been better by 0.3 m for one
 * second without a break; who is out of sight is waited for two seconds. */
typedef int32_t vfit_follow;
enum {
    VFIT_FOLLOW_NEAREST = 0, /* to the camera */
    VFIT_FOLLOW_CENTRED = 1, /* least to the side of the camera's axis */
    VFIT_FOLLOW_FIRST = 2,   /* who came first, as long as they stay */
    VFIT_FOLLOW_CHOSEN = 3
}; /* nobody but whom vfit_tracker_set_active names */
typedef int32_t vfit_active_state;
enum {
    VFIT_ACTIVE_NOBODY = 0,
    VFIT_ACTIVE_BY_RULE = 1,
    VFIT_ACTIVE_CHOSEN = 2,
    VFIT_ACTIVE_LOST = 3
}; /* out of sight, waited for: the frame has no such body */
/* The body model fitted to a person's depth and outline, where the tracker finds the joints by itself: they
 * move to the fitted body's and get rotations, as long as it meets the picture. The first frame with a person
 * may take half a second longer. */
typedef int32_t vfit_track_fit;
enum {
    VFIT_FIT_AUTO = 0, /* of the active person */
    VFIT_FIT_OFF = 1,  /* of nobody */
    VFIT_FIT_EVERYBODY = 2
}; /* some 2.5 ms a person */
typedef struct vfit_tracker_desc {
    uint32_t struct_size, reserved;
    const vfit_camera* floor; /* where the floor is, if the frames do not say; null: unknown */
    vfit_track_source joints, user_map;
    vfit_follow follow; /* the rule of the active person */
    vfit_joint_filter filter;
    vfit_track_fit fit;
    uint32_t reserved2;
} vfit_tracker_desc;
/* Where a joint is in the depth image, as a pose network sees it in a registered colour image. LEFT is the
 * person's own left, whatever the context mirrors. */
typedef struct vfit_joint_hint {
    uint32_t struct_size, body_id; /* 0: of whose pixel it is */
    vfit_joint_id joint;
    float x, y;       /* pixel; centres lie at whole coordinates */
    float confidence; /* 0..1: the chance that it is right */
} vfit_joint_hint;
VFIT_STRUCT(vfit_joint)
VFIT_STRUCT(vfit_body)
VFIT_STRUCT(vfit_tracker_desc)
VFIT_STRUCT(vfit_joint_hint)
/* Bodies are part of a tracked frame (or of a recording's, or of the host's own). [any] */
VFIT_API vfit_result vfit_frame_bodies(vfit_frame frame, vfit_body* items, uint32_t stride, uint32_t* count);
/* Only joints that are seen or inferred are listed. [any] */
VFIT_API vfit_result vfit_frame_joints(vfit_frame frame, uint32_t body_id, vfit_joint* items, uint32_t stride,
                                       uint32_t* count);
VFIT_API vfit_result vfit_tracker_create(vfit_context context, const vfit_tracker_desc* desc,
                                         vfit_tracker* out);     /* [any] */
VFIT_API vfit_result vfit_tracker_destroy(vfit_tracker tracker); /* [any] */
/* *tracked shares the images and user map of frame and holds the bodies that its source supplies, or those
 * that the tracker sees in it. Where it looks for people by itself *tracked has a user map of its own, with
 * the ids of its source's bodies where those are taken.
 * VFIT_ERROR_PLUGIN where the tracker has to find joints and the network module is not installed;
 * VFIT_ERROR_IO or VFIT_ERROR_DATA, naming the file, where weights or body data cannot be read.
 * VFIT_ERROR_DATA with the cause where the first depth that it looks into can be none: a wrong unit, raw
 * disparities, impossible intrinsics. [excl] */
VFIT_API vfit_result vfit_tracker_update(vfit_tracker tracker, vfit_frame frame, vfit_frame* tracked);
/* The host's own middleware in place of the built-in tracker, one call a body; frame may be a *tracked
 * of the call before, to add a second body. A joint that is not finite gives VFIT_ERROR_DATA. Positions are
 * filtered over the calls with one body_id, by time_ns, unless desc.filter is OFF. [excl] */
VFIT_API vfit_result vfit_tracker_submit(vfit_tracker tracker, vfit_frame frame, const vfit_body* body,
                                         const vfit_joint* items, uint32_t stride, uint32_t count,
                                         vfit_frame* tracked);
/* For the next update alone, in place of earlier ones: where the tracker's own network wavers between places
 * of a joint, the hinted one counts more (across the view; depth is the depth image's). Does little where
 * the network is sure, and nothing far from anybody or where the joints are the source's. Bad items:
 * VFIT_ERROR_ARGUMENT or VFIT_ERROR_DATA, none of them is taken. [excl] */
VFIT_API vfit_result vfit_tracker_hint(vfit_tracker tracker, const vfit_joint_hint* items, uint32_t stride,
                                       uint32_t count);
/* A person of another camera's tracked frame, at most about 50 ms old, for the next update alone. It helps to
 * decide which way the person faces: front and back look alike in depth. The evidence of single frames is
 * added up over the cameras; a body of a source or of the host counts as certain. position and rotation
 * (x, y, z, w): the pose of the other camera's world space in this one's (vfit_world_align), to 0.3 m at the
 * person and 20 degrees. VFIT_INCOMPLETE: seen has no such body, as while the active person is lost. Further
 * calls add people or cameras, up to 8: VFIT_ERROR_CAPACITY. No effect where the source supplies the joints.
 * [excl] */
VFIT_API vfit_result vfit_tracker_hint_from(vfit_tracker tracker, vfit_frame seen, uint32_t body_id,
                                            const float position[3], const float rotation[4]);
/* The pose of another camera's world space in this one's, from count points (3 floats each) that both cameras
 * saw at the same times: joints of a person who walks about, MIDDLE joints, as left and right may be
 * exchanged. Up is the same in both. Outliers get little weight. rms (may be null) is the weighted residual.
 * Fewer than 8 points, points within 0.3 m of their mean, or not within 1 km: VFIT_ERROR_DATA. [any] */
VFIT_API vfit_result vfit_world_align(vfit_context context, const float* here, const float* there,
                                      uint32_t count, float position[3], float rotation[4], float* rms);
/* Forgets people, room and choice. [excl] */
VFIT_API vfit_result vfit_tracker_reset(vfit_tracker tracker);
/* From the next update or submit on that person is the active one, whatever the rule; 0: by the rule again.
 * Who is not in view is waited for, then the rule holds again; with VFIT_FOLLOW_CHOSEN for ever. [excl] */
VFIT_API vfit_result vfit_tracker_set_active(vfit_tracker tracker, uint32_t body_id);
/* The body to hand to vfit_scan_add and vfit_motion_step: the active one; 0: nobody. Of a frame that no
 * tracker made: its first body. state may be null. [any] */
VFIT_API vfit_result vfit_frame_active_body(vfit_frame frame, uint32_t* body_id, vfit_active_state* state);

/* ---- scan -> measurements -> size ---------------------------------------------------------------- */
typedef int32_t vfit_sex;
enum { VFIT_SEX_UNKNOWN = 0, VFIT_SEX_FEMALE = 1, VFIT_SEX_MALE = 2 };
typedef int32_t vfit_scan_method;
enum {
    VFIT_SCAN_DEFAULT = 0, /* FIT */
    VFIT_SCAN_PROPORTIONS =
        1, /* the paper's, with anthropometric ratios, weighted means, outliers left out */
    VFIT_SCAN_PROPORTIONS_AS_PRINTED = 2, /* the artists' canon and plain means of the paper's text */
    VFIT_SCAN_FIT = 3
}; /* a body fitted to all frames, measures learnt from it */
typedef int32_t vfit_guidance;
enum {
    VFIT_GUIDANCE_NONE = 0,
    VFIT_GUIDANCE_STEP_BACK = 1,
    VFIT_GUIDANCE_STEP_CLOSER = 2,
    VFIT_GUIDANCE_ARMS_OUT = 3,
    VFIT_GUIDANCE_HOLD_STILL = 4,
    VFIT_GUIDANCE_TURN_SIDEWAYS = 5,
    VFIT_GUIDANCE_FEET_NOT_VISIBLE = 6,
    VFIT_GUIDANCE_ONE_PERSON_ONLY = 7,
    VFIT_GUIDANCE_NOBODY = 8,
    VFIT_GUIDANCE_JOINTS_MISSING = 9,
    VFIT_GUIDANCE_FACE_CAMERA = 10,
    VFIT_GUIDANCE_TURN_ROUND = 11, /* go on turning: that way has been seen */
    VFIT_GUIDANCE_TURN_SLOWER = 12,
    VFIT_GUIDANCE_ARMS_FORWARD = 13 /* from the side an arm hides the trunk */
};
enum {
    VFIT_SCAN_BARE = 1,  /* bits of flags. Bare feet and no hair on the crown: otherwise the deviation
                          * of FIT's stature allows for both */
    VFIT_SCAN_TIGHT = 2, /* of FIT: the clothes lie on the skin, as sportswear does. Otherwise up to 3 cm of
                          * cloth are reckoned with */
    VFIT_SCAN_TURN = 4
}; /* of FIT: after the other frames the person turns once round on the spot, arms held out: girths of the
    * trunk from its surface all around are combined with those of the other views */
#define VFIT_TURN_WAYS 24u
typedef struct vfit_scan_desc {
    uint32_t struct_size;
    vfit_scan_method method;
    uint32_t frame_count; /* 0: 30, as in the paper */
    vfit_sex sex;
    uint32_t side_frame_count; /* of FIT: frames from the side, 15 are enough; 0: none
                                * are waited for */
    uint32_t flags;            /* VFIT_SCAN_* */
    uint32_t camera_count;     /* of FIT: cameras that see the person at the same time (vfit_scan_add_from),
                                * at most 8; 0: one. Where they show front, back and a side, girths of the
                                * trunk are measured on the closed surface and combined with the others. Not
                                * with VFIT_SCAN_TURN */
} vfit_scan_desc;
typedef struct vfit_scan_state {
    uint32_t struct_size, frames_taken, frames_wanted;
    vfit_guidance guidance;                         /* why the last frame was not taken */
    float correction_m;                             /* mean absolute change of depth by the filter (Fig. 9) */
    float compute_ms;                               /* of the last frame */
    uint32_t side_frames_taken, side_frames_wanted; /* frames_taken: from the front */
    /* Of a turn, a bit for each of VFIT_TURN_WAYS ways to face: bit i is i times 15 degrees to the person's
     * left of facing the camera. turn_wanted 0: no turn is asked for. */
    uint32_t turn_seen, turn_wanted;
} vfit_scan_state;
/* key: "stature_m", "chest_girth_m", "body_mass_kg", ... (vfit_measure_key): the unit is in the key;
 * observed 0: inferred from others. sigma is one standard deviation of value; 0: unknown. */
typedef struct vfit_measurement {
    uint32_t struct_size, observed;
    float value, sigma;
    char key[48];
} vfit_measurement;
/* A sphere (joint_b -1), or the tapered capsule of two spheres. */
typedef struct vfit_collider {
    uint32_t struct_size;
    vfit_joint_id joint;
    float center[3], radius;
    vfit_joint_id joint_b;
    float center_b[3], radius_b;
    uint32_t reserved;
} vfit_collider;
/* Algorithm 3: x and y relative to the nominal width and height of a garment kind ("short_sleeves",
 * "long_sleeves", "trousers"); apply to body and garment as a whole, width and depth by x. */
typedef struct vfit_scale {
    uint32_t struct_size;
    float x, y, sigma_x, sigma_y, width_m, height_m;
    uint32_t reserved;
} vfit_scale;
typedef struct vfit_size {
    uint32_t struct_size;
    float probability;
    char label[32];
} vfit_size;
typedef struct vfit_size_row {
    uint32_t struct_size, measure_count;
    char garment_kind[32], label[32];
} vfit_size_row;
/* How a size sits by one measure: ease is the room beyond the body in the middle of the size's range (below
 * 0: too little of it), sigma its deviation; probabilities that the body is above, within and below that
 * range. */
typedef struct vfit_size_zone {
    uint32_t struct_size;
    float ease, sigma, tight, regular, loose;
    char key[48];
} vfit_size_zone;
/* What a shop's own tape says of scans of the same people, by measure. enough 0: too few people, nothing is
 * changed. */
typedef struct vfit_calibrated_measure {
    uint32_t struct_size, people, enough;
    float offset;   /* of the tape from the scan, in the key's unit */
    float widening; /* of sigma */
    char key[48];
} vfit_calibrated_measure;
/* Of whom measures are estimated. */
typedef struct vfit_person {
    uint32_t struct_size;
    vfit_sex sex;    /* VFIT_SEX_UNKNOWN: both are mixed by how well the measures suit each */
    float age_years; /* 18 to 100; 0: not told */
    uint32_t reserved;
} vfit_person;
typedef int32_t vfit_doubt_kind;
enum {
    VFIT_DOUBT_UNLIKELY = 0, /* by the others, and no slip below explains it */
    VFIT_DOUBT_INCHES = 1,   /* inches were taken for centimetres */
    VFIT_DOUBT_POUNDS = 2,   /* pounds were taken for kilograms */
    VFIT_DOUBT_DIGIT = 3,    /* one digit is wrong, or two are in the wrong order */
    VFIT_DOUBT_SWAPPED = 4   /* its value and that of other_key stand in each other's place */
};
/* A measure that does not go with the others of its list. */
typedef struct vfit_doubt {
    uint32_t struct_size;
    vfit_doubt_kind kind;
    float value;           /* as it was given */
    float suggested;       /* what the slip makes of it; of VFIT_DOUBT_UNLIKELY: as expected */
    float expected, sigma; /* by the others */
    char key[48], other_key[48];
} vfit_doubt;
VFIT_STRUCT(vfit_person)
VFIT_STRUCT(vfit_doubt)
VFIT_STRUCT(vfit_scan_desc)
VFIT_STRUCT(vfit_scan_state)
VFIT_STRUCT(vfit_calibrated_measure)
VFIT_STRUCT(vfit_measurement)
VFIT_STRUCT(vfit_scale)
VFIT_STRUCT(vfit_size)
VFIT_STRUCT(vfit_size_row)
VFIT_STRUCT(vfit_collider)
VFIT_STRUCT(vfit_size_zone)
VFIT_API vfit_result vfit_scan_create(vfit_context context, const vfit_scan_desc* desc,
                                      vfit_scan* out);  /* [any] */
VFIT_API vfit_result vfit_scan_destroy(vfit_scan scan); /* wipes the body data [any] */
VFIT_API vfit_result vfit_scan_reset(vfit_scan scan);   /* [excl] */
/* Asks for more frames of this person from the front and the side, also of a complete scan, which then goes
 * on; vfit_scan_reset takes it back. [excl] */
VFIT_API vfit_result vfit_scan_extend(vfit_scan scan, uint32_t frames, uint32_t side_frames);
/* VFIT_INCOMPLETE: the frame was not taken, state->guidance says why. VFIT_NOT_READY: taken, more are
 * wanted. VFIT_OK: the scan is complete (further frames are ignored). state may be null. [excl] */
VFIT_API vfit_result vfit_scan_add(vfit_scan scan, vfit_frame tracked, uint32_t body_id,
                                   vfit_scan_state* state);
/* A frame of one of several cameras, each with its own tracker; camera counts from 0. The scan takes front
 * views first, then side views, from any camera, then three frames of each camera; turn_seen holds the ways
 * of these. guidance concerns this camera; once it has shown enough, the first camera that lacks frames.
 * [excl] */
VFIT_API vfit_result vfit_scan_add_from(vfit_scan scan, uint32_t camera, vfit_frame tracked, uint32_t body_id,
                                        vfit_scan_state* state);
/* From the first frame on; the values settle with each. No frame yet: VFIT_ERROR_STATE. [read] */
VFIT_API vfit_result vfit_scan_measure(vfit_scan scan, vfit_measurement* items, uint32_t stride,
                                       uint32_t* count);
/* The sex that the scan was told, else the likelier one, with its probability (1 where it was told). A scan
 * by proportions infers none: VFIT_SEX_UNKNOWN, 0. probability may be null. No frame yet: VFIT_ERROR_STATE.
 * [read] */
VFIT_API vfit_result vfit_scan_sex(vfit_scan scan, vfit_sex* sex, float* probability);
VFIT_API vfit_result vfit_scan_colliders(vfit_scan scan, vfit_collider* items, uint32_t stride,
                                         uint32_t* count); /* centres are those of the last frame [read] */
VFIT_API vfit_result vfit_scan_scale(vfit_scan scan, const char* garment_kind, vfit_scale* out);
/* [read] */
/* Measurements as JSON text, for an app that keeps them with the person's consent (docs/measuring.md). text
 * null sets *capacity to what is needed, the end included; too little: VFIT_ERROR_CAPACITY, and the same.
 * [any] */
VFIT_API vfit_result vfit_measurements_write(const vfit_measurement* items, uint32_t stride, uint32_t count,
                                             vfit_sex sex, char* text, uint32_t* capacity);
/* That text, a report of vfit measure, or {"stature_m": 1.7}. sex may be null. A value that no person has,
 * such as 172 for stature_m: VFIT_ERROR_DATA with the probable unit. [any] */
VFIT_API vfit_result vfit_measurements_read(const void* text, uint64_t byte_count, vfit_measurement* items,
                                            uint32_t stride, uint32_t* count, vfit_sex* sex);
/* Two scans of one person in one list. The statures of two people: VFIT_ERROR_DATA. [any] */
VFIT_API vfit_result vfit_measurements_merge(const vfit_measurement* a, uint32_t a_stride, uint32_t a_count,
                                             const vfit_measurement* b, uint32_t b_stride, uint32_t b_count,
                                             vfit_measurement* items, uint32_t stride, uint32_t* count);
/* Calibration to a shop's own tape, kept by the app as JSON text that holds errors alone, no bodies
 * (docs/measuring.md). vfit_calibration_add: of one more person what a scan told, with sigma, and what the
 * tape told; text null and byte_count 0: the first one. out null sets *capacity to what is needed; too
 * little: VFIT_ERROR_CAPACITY, and the same. No measure in common: VFIT_ERROR_DATA. [any] */
VFIT_API vfit_result vfit_calibration_add(const void* text, uint64_t byte_count,
                                          const vfit_measurement* scanned, uint32_t scanned_stride,
                                          uint32_t scanned_count, const vfit_measurement* taped,
                                          uint32_t taped_stride, uint32_t taped_count, char* out,
                                          uint32_t* capacity);
VFIT_API vfit_result vfit_calibration_measures(const void* text, uint64_t byte_count,
                                               vfit_calibrated_measure* items, uint32_t stride,
                                               uint32_t* count); /* [any] */
/* Measures of a scan as that tape would tell them: for each measure with at least 20 people the value is
 * moved by the offset, and sigma is such that at least 90 % of further people lie within 1.645 of it. [any]
 */
VFIT_API vfit_result vfit_calibration_apply(const void* text, uint64_t byte_count,
                                            const vfit_measurement* scanned, uint32_t scanned_stride,
                                            uint32_t scanned_count, vfit_measurement* items, uint32_t stride,
                                            uint32_t* count);
/* How the measures of people go together (docs/measuring.md): what the measures that a person knows make
 * likely of all the others. Names of those in data_dir/populations, in alphabetical order. [any] */
VFIT_API vfit_result vfit_population_list(vfit_context context, vfit_data_name* items, uint32_t stride,
                                          uint32_t* count);
/* A population as JSON, or by the name of a file in data_dir/populations. [any] */
VFIT_API vfit_result vfit_population_load(vfit_context context, const void* bytes, uint64_t byte_count,
                                          vfit_population* out);
VFIT_API vfit_result vfit_population_open(vfit_context context, const char* name, vfit_population* out);
VFIT_API vfit_result vfit_population_destroy(vfit_population population); /* [any] */
/* Every measure that the population has, of a person of whom those in known are known: typed, taped or
 * scanned, each with its sigma (0: as exact as people know it of themselves). person null: sex and age
 * unknown. Given measures are observed and come closer to what the others say; of the others value and sigma
 * are what is likely. Measures that the population has not are passed through. [read] */
VFIT_API vfit_result vfit_population_estimate(vfit_population population, const vfit_person* person,
                                              const vfit_measurement* known, uint32_t known_stride,
                                              uint32_t known_count, vfit_measurement* items, uint32_t stride,
                                              uint32_t* count);
/* Which of these is probably wrong? An item for each measure that does not go with the others, the worst
 * first; none is often right: with two measures it cannot be told which one it is. [read] */
VFIT_API vfit_result vfit_population_check(vfit_population population, const vfit_person* person,
                                           const vfit_measurement* known, uint32_t known_stride,
                                           uint32_t known_count, vfit_doubt* items, uint32_t stride,
                                           uint32_t* count);
/* Names of the size charts in data_dir/charts, in alphabetical order. [any] */
VFIT_API vfit_result vfit_size_chart_list(vfit_context context, vfit_data_name* items, uint32_t stride,
                                          uint32_t* count);
/* A chart as JSON (docs/size-charts.md), or by the name of a file in data_dir/charts. [any] */
VFIT_API vfit_result vfit_size_chart_load(vfit_context context, const void* bytes, uint64_t byte_count,
                                          vfit_size_chart* out);
VFIT_API vfit_result vfit_size_chart_open(vfit_context context, const char* name, vfit_size_chart* out);
VFIT_API vfit_result vfit_size_chart_destroy(vfit_size_chart chart); /* [any] */
VFIT_API vfit_result vfit_size_chart_rows(vfit_size_chart chart, vfit_size_row* items, uint32_t stride,
                                          uint32_t* count); /* [read] */
/* Every label of that garment kind with its probability, best first; they sum to 1. A garment of one size
 * needs no measurement. A value that no person has: VFIT_ERROR_DATA. [read] */
VFIT_API vfit_result vfit_size_recommend(vfit_size_chart chart, const char* garment_kind,
                                         const vfit_measurement* items, uint32_t stride, uint32_t count,
                                         vfit_size* sizes, uint32_t size_stride, uint32_t* size_count);
/* How that size sits: an item a measure of the garment kind that was given. [read] */
VFIT_API vfit_result vfit_size_zones(vfit_size_chart chart, const char* garment_kind, const char* label,
                                     const vfit_measurement* items, uint32_t stride, uint32_t count,
                                     vfit_size_zone* zones, uint32_t zone_stride, uint32_t* zone_count);

/* ---- motion: raw body in, clean pose out; usable alone with the game's own rig --------------------- */
/* rotation is local to the parent and relative to a T-pose in which every bone has the axes of the world
 * (so that rest is the identity); position is the hips' in world space, else the offset from the parent
 * in that T-pose. */
typedef struct vfit_bone {
    uint32_t struct_size;
    vfit_bone_id bone;
    float rotation[4], position[3];
    uint32_t reserved;
} vfit_bone;
enum { VFIT_CONTACT_LEFT = 1, VFIT_CONTACT_RIGHT = 2 };
typedef struct vfit_pose {
    uint32_t struct_size, contact_flags;
    int64_t time_ns;
    float root_correction[3]; /* what the foot stage moved the root by (Alg. 6, d_root) */
    float foot_correction_m;  /* how far it moved the planted foot (Fig. 11) */
} vfit_pose;
enum {
    VFIT_MOTION_NO_FILTER = 1,    /* positions as they come */
    VFIT_MOTION_NO_LIMITS = 2,    /* no joint limits */
    VFIT_MOTION_NO_SMOOTHING = 4, /* no rotation smoothing (Eq. 8-10) */
    VFIT_MOTION_NO_FEET = 8
}; /* no foot-skate correction (Alg. 5 and 6) */
/* Of joint positions. ADAPTIVE learns how noisy each joint is: it averages over seconds at rest and follows
 * within a frame in motion. HOLT is the paper's, by the five names of the Kinect SDK. All are converted by
 * elapsed time. */
enum { VFIT_POSITION_ADAPTIVE = 0, VFIT_POSITION_HOLT = 1, VFIT_POSITION_ONE_EURO = 2 };
typedef int32_t vfit_position_filter;
/* How feet that stand are found: by a network that has learnt it, or by the paper's thresholds of height and
 * speed (Alg. 5), with hysteresis. */
enum { VFIT_CONTACT_LEARNT = 0, VFIT_CONTACT_THRESHOLDS = 1 };
typedef int32_t vfit_contact_rule;
/* Of the floats, 0 means the default and < 0 means 0 (where 0 is in the range). */
typedef struct vfit_motion_desc {
    uint32_t struct_size, flags;                   /* VFIT_MOTION_* */
    float smoothing, correction, prediction;       /* 0..1; default 0.5, 0.5, 0.5 */
    float jitter_radius_m, max_deviation_radius_m; /* default 0.05, 0.04 */
    float rotation_divisor;                        /* k of Eq. 10 at 30 Hz; default 2 */
    float rotation_divisor_switched;               /* k right after the planted foot changed; default 4 */
    vfit_position_filter filter;
    float min_cutoff_hz, beta, derivative_cutoff_hz; /* One Euro; default 1, 1 (Hz for each m/s), 1 */
    float prediction_s; /* looks ahead of now_ns, to hide latency: 0..0.2; default 0 */
    vfit_contact_rule contact_rule;
    uint32_t reserved;
    const char* range_of_motion; /* null: natural; else JSON, {"knee": {"flexion": 60}}: those angles, in
                                  * degrees, in place of assets/body/range_of_motion.json's */
} vfit_motion_desc;
VFIT_STRUCT(vfit_bone)
VFIT_STRUCT(vfit_pose)
VFIT_STRUCT(vfit_motion_desc)
VFIT_API vfit_result vfit_motion_create(vfit_context context, const vfit_motion_desc* desc,
                                        vfit_motion* out);    /* [any] */
VFIT_API vfit_result vfit_motion_destroy(vfit_motion motion); /* [any] */
VFIT_API vfit_result vfit_motion_reset(vfit_motion motion);   /* [excl] */
/* The proportions that the feet are planted with; without: those of the tracked person. [excl] */
VFIT_API vfit_result vfit_motion_bind(vfit_motion motion, vfit_avatar avatar);
/* A body whose time_ns differs from the last is new; the same or a null frame: the filter predicts to
 * now_ns, so that a 30 Hz camera drives a 600 Hz renderer. Body not in the frame: VFIT_NOT_READY, the
 * pose holds. [excl] */
VFIT_API vfit_result vfit_motion_step(vfit_motion motion, vfit_frame tracked, uint32_t body_id,
                                      int64_t now_ns);
/* The same with a body that no frame carries: the joints of any middleware, without a camera, in world space.
 * body.time_ns is the time of the reading; time_ns, now_ns and VFIT_NOT_READY as above. VFIT_NOT_READY also
 * where the joints do not place the trunk. VFIT_ERROR_ARGUMENT with VFIT_BODY_CAMERA_SPACE: without a frame
 * there is no camera. [excl] */
VFIT_API vfit_result vfit_motion_step_body(vfit_motion motion, const vfit_body* body, const vfit_joint* items,
                                           uint32_t stride, uint32_t count, int64_t now_ns);
VFIT_API vfit_result vfit_motion_pose(vfit_motion motion, vfit_pose* pose, vfit_bone* items, uint32_t stride,
                                      uint32_t* count); /* [read] */
/* A pose for the network, at most 120 bytes: rotations to 0.1 degrees, the hips to 0.1 mm, contacts, time.
 * bytes null sets *byte_count to what is needed. It is the same whatever the axes of the two contexts.
 * Unpacked bones come as from vfit_motion_pose, but for positions of all but the hips, which are the
 * receiver's avatar's own: zero. Hips over 800 m away: VFIT_ERROR_DATA; a packet of another version:
 * VFIT_ERROR_VERSION; a damaged one: VFIT_ERROR_DATA. [any] */
VFIT_API vfit_result vfit_pose_pack(vfit_context context, const vfit_pose* pose, const vfit_bone* items,
                                    uint32_t stride, uint32_t count, void* bytes, uint32_t* byte_count);
VFIT_API vfit_result vfit_pose_unpack(vfit_context context, const void* bytes, uint32_t byte_count,
                                      vfit_pose* pose, vfit_bone* items, uint32_t stride, uint32_t* count);
/* A pose as one packet of Open Sound Control 1.0, at most 2,048 bytes, for the host to send by UDP; vfit
 * opens no socket. docs/motion.md has ports and receivers. */
typedef int32_t vfit_osc;
enum {
    VFIT_OSC_VMC = 0,   /* VMC protocol: /VMC/Ext/OK, T (pose.time_ns in seconds), Root/Pos (the origin), and
                         * Bone/Pos of all bones by the names of Unity's HumanBodyBones */
    VFIT_OSC_VRCHAT = 1 /* VRChat's OSC trackers: 1 hips, 2 chest, 3 and 4 feet, 5 and 6 knees, 7 and 8
                         * elbows, left before right, and the head */
};
/* Both are written in Unity's frame (metre, Y up, left-handed, facing +Z), whatever the axes of the context
 * and not mirrored. items: all bones, as vfit_motion_pose gives them; VFIT_ERROR_DATA where one is missing,
 * or where they have no offsets, as those of vfit_pose_unpack. bytes null sets *byte_count to what is needed.
 * Does not allocate. [any] */
VFIT_API vfit_result vfit_pose_osc(vfit_context context, const vfit_pose* pose, const vfit_bone* items,
                                   uint32_t stride, uint32_t count, vfit_osc kind, void* bytes,
                                   uint32_t* byte_count);
/* A motion as the text of a BVH file: centimetres, Y up, right-handed, whatever the axes of the context.
 * items: VFIT_BONE_COUNT bones for each pose, as vfit_motion_pose gives them, pose after pose. The skeleton
 * is that of the last pose, whose lengths are the best known; in the other poses the hips give way so that
 * the feet stay. BVH has one frame time: frame k shows the motion at the time of the first pose plus k *
 * frame_time_s (0: 1/30 s), between two poses interpolated. VFIT_ERROR_DATA where times do not increase. text
 * null sets *capacity to what is needed, the end included. [any] */
VFIT_API vfit_result vfit_pose_bvh(vfit_context context, const vfit_pose* poses, uint32_t pose_stride,
                                   uint32_t pose_count, const vfit_bone* items, uint32_t stride,
                                   uint32_t count, float frame_time_s, char* text, uint32_t* capacity);
/* The filtered joints behind the pose, feet corrected. [read] */
VFIT_API vfit_result vfit_motion_joints(vfit_motion motion, vfit_joint* items, uint32_t stride,
                                        uint32_t* count);

/* ---- avatar and cloth: pose, step, then acquire, once per rendered frame --------------------------- */
enum {
    VFIT_AVATAR_PAPER_COLLIDERS = 1,  /* radii of Algorithm 2 as they are, not clamped to the skin */
    VFIT_AVATAR_SINGLE_BONES = 2,     /* no twist bones in the limbs (Fig. 7a) */
    VFIT_AVATAR_DUAL_QUATERNIONS = 4, /* skinned by dual quaternions in place of linear blending: joints that
                                       * bend or twist far keep their section. An engine that skins by
                                       * BONE_MATRIX shows the linear blend */
    VFIT_AVATAR_LIMBS_AS_POSED = 8    /* arms stay where the pose puts them; without, they are moved out of
                                       * trunk, thighs and each other, with 2 cm of room for cloth, and where
                                       * two parts of a body's skin press into each other, both give way:
                                       * there POSITION differs from what BONE_MATRIX gives */
};
typedef struct vfit_avatar_desc {
    uint32_t struct_size, flags;
    vfit_sex sex;    /* which default body; UNKNOWN: halfway */
    uint32_t detail; /* 0: 13.7k vertices, 1: 54.8k, 2: 219k, 3: 1.0k, for crowds */
} vfit_avatar_desc;
/* key: a phenotype ("gender", "age", "muscle", "weight", "height", "proportions", in 0..1; weight up to
 * 1.15) or a local slider ("measure-waist-circ", in -1..1); see vfit_shape_list. */
typedef struct vfit_shape_value {
    uint32_t struct_size;
    float value, minimum, maximum;
    char key[48];
} vfit_shape_value;
typedef struct vfit_rig_bone {
    uint32_t struct_size;
    int32_t parent;         /* -1: root; parents stand before children */
    vfit_bone_id bone;      /* the humanoid bone that it is, or -1 */
    float rest_position[3]; /* of the bone's head, in the space of the rest mesh */
    char name[48];
    float rest_rotation[4]; /* of the bone's own axes there: posed, they are BONE_MATRIX * rest */
    int32_t node;           /* of the character's file; -1: made by vfit */
    uint32_t reserved;
} vfit_rig_bone;
/* A character of yours: a skinned humanoid from a glTF 2.0 (.glb, .gltf) or VRM 0 or 1 file. */
typedef struct vfit_character_desc {
    uint32_t struct_size;
    float scale;       /* metres in a unit of the file; 0: 1, as glTF says */
    const char* path;  /* or null and */
    const void* bytes; /* the whole file in memory; needed during the call alone */
    uint64_t byte_count;
    const char* bone_map; /* null: as VRM says, else by the names that common tools give; or
                           * {"hips": "name of a node", "leftUpperArm": ...} as JSON */
} vfit_character_desc;
typedef int32_t vfit_character_kind;
enum {
    VFIT_CHARACTER_BODY = 0, /* vfit's own body */
    VFIT_CHARACTER_GLTF = 1,
    VFIT_CHARACTER_VRM0 = 2,
    VFIT_CHARACTER_VRM1 = 3
};
typedef struct vfit_character_info {
    uint32_t struct_size;
    vfit_character_kind kind;
    uint32_t vertex_count, index_count, bone_count, part_count;
    float stature_m;     /* floor to crown, feet together */
    float from_file[16]; /* rest mesh = M * the file's world; right-handed metres whatever axes */
    char name[64];       /* as VRM tells it */
    uint32_t reserved;
} vfit_character_info;
/* Triangles of one material of the file: indices first_index on. vfit's own body is one part without. */
typedef struct vfit_avatar_part {
    uint32_t struct_size, first_index, index_count;
    int32_t material;
    char mesh[48], material_name[48];
} vfit_avatar_part;
VFIT_STRUCT(vfit_avatar_desc)
VFIT_STRUCT(vfit_shape_value)
VFIT_STRUCT(vfit_rig_bone)
VFIT_STRUCT(vfit_character_desc)
VFIT_STRUCT(vfit_character_info)
VFIT_STRUCT(vfit_avatar_part)
VFIT_API vfit_result vfit_shape_list(vfit_context context, vfit_shape_value* items, uint32_t stride,
                                     uint32_t* count); /* [any] */
/* A body of that shape; keys that are not given keep the value of the sex's default body. [any] */
VFIT_API vfit_result vfit_avatar_create_from_shape(vfit_context context, const vfit_avatar_desc* desc,
                                                   const vfit_shape_value* items, uint32_t stride,
                                                   uint32_t count, vfit_avatar* out);
/* The default body scaled to stature_m and, where given, shoulder_breadth_m. [any] */
VFIT_API vfit_result vfit_avatar_create(vfit_context context, const vfit_avatar_desc* desc,
                                        const vfit_measurement* items, uint32_t stride, uint32_t count,
                                        vfit_avatar* out);
/* Size and collider radii of the scanned person; by FIT their shape and girths too. [read] on scan */
VFIT_API vfit_result vfit_avatar_create_from_scan(vfit_context context, const vfit_avatar_desc* desc,
                                                  vfit_scan scan, vfit_avatar* out);
/* Your character as an avatar: bind motion to it, pose it, fetch its buffers. It is turned to face +Z and
 * stood on the floor; whatever its proportions, the bones of a pose turn it, feet that motion plants stand,
 * limbs get twist bones, and arms are kept out of its trunk and thighs (unless desc.flags has
 * LIMBS_AS_POSED). Missing of VRM's optional bones are stood in for. Morph targets, animations and meshes
 * that hang on no bone are left out and logged. desc.sex and detail do not apply. Buffers are read from the
 * file's own folder alone, from memory from nowhere else. VFIT_ERROR_IO; VFIT_ERROR_DATA for a damaged file,
 * one without a humanoid or skin, of no person's size, or that lies down; VFIT_ERROR_UNSUPPORTED for
 * compressed meshes and sparse data. [any] */
VFIT_API vfit_result vfit_avatar_load(vfit_context context, const vfit_avatar_desc* desc,
                                      const vfit_character_desc* character, vfit_avatar* out);
VFIT_API vfit_result vfit_avatar_describe(vfit_avatar avatar, vfit_character_info* out); /* [read] */
VFIT_API vfit_result vfit_avatar_parts(vfit_avatar avatar, vfit_avatar_part* items, uint32_t stride,
                                       uint32_t* count); /* [read] */
/* A body and its clothing size for the network, at most 240 bytes: shape, scale, collider radii, a label of
 * up to 19 bytes (may be null). bytes null sets *byte_count to what is needed. Of a character from a file:
 * VFIT_ERROR_UNSUPPORTED. The receiver gets the label as TEXT; a packet of another version of body or library
 * is VFIT_ERROR_VERSION, a damaged one VFIT_ERROR_DATA; desc.sex is the packet's. [read], [any] */
VFIT_API vfit_result vfit_avatar_pack(vfit_avatar avatar, const char* size_label, void* bytes,
                                      uint32_t* byte_count);
VFIT_API vfit_result vfit_avatar_unpack(vfit_context context, const vfit_avatar_desc* desc, const void* bytes,
                                        uint32_t byte_count, char* size_label, uint32_t capacity,
                                        vfit_avatar* out);
VFIT_API vfit_result vfit_avatar_destroy(vfit_avatar avatar); /* [any] */
/* Arms go from the last pose to this one around each other and around the trunk, and never through, where
 * pose.time_ns is later by at most 0.25 s; else they go there at once. Not so
 * with VFIT_AVATAR_LIMBS_AS_POSED. [excl] */
VFIT_API vfit_result vfit_avatar_pose(vfit_avatar avatar, const vfit_pose* pose, const vfit_bone* items,
                                      uint32_t stride, uint32_t count);
/* The same, the skin written straight into the engine's memory (a mapped vertex buffer), each vertex as three
 * floats in the context's axes at the target's stride: no copy is made, and acquire gives the mesh of the
 * last vfit_avatar_pose. Bones, joints, colliders and cloth follow as with it. normals may be null. Bad
 * targets: VFIT_ERROR_ARGUMENT, UNSUPPORTED or CAPACITY, and nothing moves. [excl] */
VFIT_API vfit_result vfit_avatar_pose_into(vfit_avatar avatar, const vfit_pose* pose, const vfit_bone* items,
                                           uint32_t stride, uint32_t count, const vfit_target* positions,
                                           const vfit_target* normals);
VFIT_API vfit_result vfit_avatar_colliders(vfit_avatar avatar, vfit_collider* items, uint32_t stride,
                                           uint32_t* count); /* [read] */
/* Every joint of the posed avatar, at the avatar's own true place. [read] */
VFIT_API vfit_result vfit_avatar_joints(vfit_avatar avatar, vfit_joint* items, uint32_t stride,
                                        uint32_t* count);
VFIT_API vfit_result vfit_avatar_rig(vfit_avatar avatar, vfit_rig_bone* items, uint32_t stride,
                                     uint32_t* count); /* [read] */
/* Tape measures of the avatar's own body, in the posture of each definition, taken on its mesh. A character
 * from a file has clothes and no body: VFIT_ERROR_UNSUPPORTED. [read] */
VFIT_API vfit_result vfit_avatar_measure(vfit_avatar avatar, vfit_measurement* items, uint32_t stride,
                                         uint32_t* count);
/* Measures of your own (docs/measuring.md: landmarks, planes and paths as JSON), taken on the avatar's mesh.
 * sigma is that of the least sure measure of the scan that it was made from, relative; 0: made of none.
 * [read] */
VFIT_API vfit_result vfit_avatar_measure_own(vfit_avatar avatar, const void* text, uint64_t byte_count,
                                             vfit_measurement* items, uint32_t stride, uint32_t* count);
/* Posed mesh: POSITION, NORMAL, UV, INDEX, BONE_MATRIX, SKIN_BONES, SKIN_WEIGHTS. [any] */
VFIT_API vfit_result vfit_avatar_acquire(vfit_avatar avatar, vfit_frame* out);
/* The same streams of the unposed mesh that the rig binds to. [any] */
VFIT_API vfit_result vfit_avatar_acquire_rest(vfit_avatar avatar, vfit_frame* out);

/* Names of the garments in data_dir/garments, in alphabetical order. [any] */
VFIT_API vfit_result vfit_garment_list(vfit_context context, vfit_data_name* items, uint32_t stride,
                                       uint32_t* count);
/* A garment as JSON (docs/garments.md), or by the name of a file in data_dir/garments. [any] */
VFIT_API vfit_result vfit_garment_load(vfit_context context, const void* bytes, uint64_t byte_count,
                                       vfit_garment* out);
VFIT_API vfit_result vfit_garment_open(vfit_context context, const char* name, vfit_garment* out);
VFIT_API vfit_result vfit_garment_destroy(vfit_garment garment); /* [any] */
typedef struct vfit_garment_info {
    uint32_t struct_size, vertex_count, simulated_count, size_count;
    char name[64];
    char garment_kind[32]; /* as size charts name it */
    char fabric[32];
    char size_chart[60]; /* name of the chart that its labels follow; empty: the file states none */
    vfit_sex body_sex;   /* of the default body that it was made on */
} vfit_garment_info;
VFIT_STRUCT(vfit_garment_info)
VFIT_API vfit_result vfit_garment_describe(vfit_garment garment, vfit_garment_info* out); /* [read] */
/* Triangles of one look: indices first_index on of what vfit_cloth_acquire gives. texture: the path of a
 * picture as the garment's author gave it, or empty; color: linear RGB. */
typedef struct vfit_garment_part {
    uint32_t struct_size, first_index, index_count;
    float color[3];
    char material[48], texture[200];
} vfit_garment_part;
VFIT_STRUCT(vfit_garment_part)
VFIT_API vfit_result vfit_garment_parts(vfit_garment garment, vfit_garment_part* items, uint32_t stride,
                                        uint32_t* count); /* [read] */
/* The label of the size at index; length 0 past the last. [read] */
VFIT_API uint32_t vfit_garment_size_label(vfit_garment garment, uint32_t index, char* buffer,
                                          uint32_t capacity);
enum {
    VFIT_CLOTH_NO_HANDS = 1, /* hands and forearms pass through all but their own sleeve. Without it, they
                              * meet all but the other arm's sleeve; on the skin, an arm that stretches cloth
                              * beyond 1.6 times its length passes until it is free of it. On spheres and
                              * capsules, garments with sleeves always keep both */
    VFIT_CLOTH_SKIN = 2,     /* kept out of the avatar's skin itself, not of its spheres and capsules: closer,
                              * and slower */
    VFIT_CLOTH_AWAKE = 4,    /* stepped even where cloth and body have lain still for half a second */
    VFIT_CLOTH_PRESSURE = 8, /* frames carry PRESSURE */
    VFIT_CLOTH_ANY_FIT = 16
}; /* worn even where it would not close: stretched beyond what its fabric takes */
typedef struct vfit_cloth_desc {
    uint32_t struct_size, substeps; /* 0: 8 a 1/60 s; on the skin up to eight times as many in a step in
                                     * which parts of the body move fast */
    float gravity[3];               /* in the context's axes and unit; all zero: 9.81 m/s2 down */
    float friction;                 /* 0: the fabric's; < 0: none */
    float damping;                  /* share of speed lost a second, 0: 0.5; < 0: none */
    float thickness_m;              /* kept from the colliders, 0: 0.004 */
    const char* size_label;   /* null: made to the avatar, with the ease that the garment was made with */
    uint32_t flags, reserved; /* VFIT_CLOTH_* */
    float wind[3];            /* as vfit_cloth_set_wind */
    float drag, lift;         /* of the air, as of a plate: about 1; both 0: no air */
    float inertia;            /* share of the body's own motion that the cloth feels, 0: all; < 0: none */
    float self_thickness_m;   /* kept between the cloth's own layers, 0: they pass through each other */
    float budget_ms;          /* of a step, 0: none. See vfit_cloth_set_quality */
    float cover_m;   /* more spheres and capsules, until no skin below the garment, but hands and feet, is
                      * so far outside of all; 0.005..0.1; 0: the avatar's 31 alone */
    float virtual_m; /* points of triangles meet spheres and capsules as vertices do: so many that none is
                      * further from the next, 65,536 at most; 0.001..0.1; 0: none. For meshes coarser
                      * than a wrist */
    float carry_speed_m_s; /* a step in which the garment, as the bones move it, or a limb of it against */
    float carry_way_m;     /* the rest, gains more speed on the step before, or all of it goes further, is a
                            * jump, as after vfit_cloth_teleport. 0: 6, and 0.06; < 0: no limit */
} vfit_cloth_desc;
typedef struct vfit_cloth_stats {
    uint32_t struct_size, vertex_count, simulated_count, constraint_count;
    /* Of edges: 1 is twice the rest length; of edges below 2 cm strain_max is a fraction of 2 cm. */
    float strain_mean, strain_p99, strain_max, step_ms;
    uint32_t substeps;       /* of the last step; 0: it slept */
    uint32_t collider_count; /* spheres and capsules that it met */
    /* So much too long, in metres, were sleeves and legs for these limbs: they were
     * taken up to wrist and ankle, but for what folds take (docs/garments.md). */
    float sleeves_taken_up_m, legs_taken_up_m;
} vfit_cloth_stats;
VFIT_STRUCT(vfit_cloth_desc)
VFIT_STRUCT(vfit_cloth_stats)
/* VFIT_ERROR_NOT_WEARABLE where a labelled size would have to stretch around chest, waist or hips by more
 * than its fabric takes, or at an opening or over a tenth of it by far more (docs/garments.md), unless
 * desc.flags has ANY_FIT. */
VFIT_API vfit_result vfit_cloth_create(vfit_avatar avatar, vfit_garment garment, const vfit_cloth_desc* desc,
                                       vfit_cloth* out);   /* [excl] on avatar */
VFIT_API vfit_result vfit_cloth_destroy(vfit_cloth cloth); /* [any] */
/* Put on anew: simulated on a body that stands straight, arms held out, and goes into the pose that the
 * avatar has now, so that limbs push the cloth aside. create carries it into the pose as it is, at once:
 * right for somebody who stands, not for a stride or a hand at the hip. Takes as long as some 35 steps
 * (the sundress 0.1 s), whatever the settings. [excl] */
VFIT_API vfit_result vfit_cloth_reset(vfit_cloth cloth);
/* The same garment in another of its sizes (null: made to the avatar), from how it hangs now: it comes to
 * rest within a second, for which its steps take twice as long. Takes some ten steps' time.
 * VFIT_ERROR_ARGUMENT where it has no such size, VFIT_ERROR_NOT_WEARABLE as with create, and nothing changes.
 * [excl] */
VFIT_API vfit_result vfit_cloth_set_size(vfit_cloth cloth, const char* size_label);
/* Sub-steps inside; dt is clamped to 0.1 ms..0.1 s, 0 changes nothing. Reads the avatar: pose that
 * one first. begin hands the work to a worker and returns, end waits: between the two the engine renders.
 * To a host's job system such a step is one item. [excl] */
VFIT_API vfit_result vfit_cloth_step(vfit_cloth cloth, float dt);
VFIT_API vfit_result vfit_cloth_begin_step(vfit_cloth cloth, float dt);
VFIT_API vfit_result vfit_cloth_end_step(vfit_cloth cloth);
/* Between steps, for cloth that runs on a slower clock than the picture: acquire then gives the cloth as the
 * last step left it, carried from that step's pose into the one that the avatar has now by the bones that
 * carry the garment, at the time of that pose. The next step goes on as if it had not been called. While a
 * step runs it does not wait: the one before is carried, until end_step. [excl] */
VFIT_API vfit_result vfit_cloth_carry(vfit_cloth cloth);
/* Makes the next step (of more than 0 s) a jump, however short the way is from the pose of the last step: a
 * snap turn, a correction over the network. The bones move the cloth as it hangs, each vertex with those that
 * it is skinned to, and nothing is swept through it. It keeps its velocity relative to the body. Longer and
 * faster motions are jumps anyway (vfit_cloth_desc.carry_speed_m_s). Call it for each cloth of an outfit.
 * While a step runs, it applies to the step after it. vfit_cloth_reset cancels it. [excl] */
VFIT_API vfit_result vfit_cloth_teleport(vfit_cloth cloth);
/* Velocity of the air, in the context's axes and unit a second, from the next step on. [excl] */
VFIT_API vfit_result vfit_cloth_set_wind(vfit_cloth cloth, const float wind[3]);
/* Sub-steps a 1/60 s (vfit_cloth_desc), and the time that a step may take: where more would take longer,
 * fewer are done (at least one), and then a state is no longer the same on each run. 0 sub-steps: 8; 0 ms: no
 * budget. [excl] */
VFIT_API vfit_result vfit_cloth_set_quality(vfit_cloth cloth, uint32_t substeps, float budget_ms);
/* From now on cloth is worn over inner, a cloth of the same avatar: the two push each other by their mass and
 * do not cross. Within this call cloth goes outside of where the last step of inner left that, in the pose
 * that the avatar has now; acquire then gives that state, of both. Takes as long as 6 to 12 steps.
 * Cloths that are worn over each other, through others too, are simulated as one: the first of them to be
 * stepped in a frame steps all of them, and the steps of the others, in any order, then find theirs done. So
 * does vfit_cloth_reset, in one pose. Wind's velocity, quality and budget are of all of them, step_ms and
 * substeps too. Of what their descs say, all have the largest thickness_m, which is kept between them as
 * well, most substeps and least inertia; none sleeps where one is AWAKE, and a jump for one is a jump for
 * all; size, the other flags, friction, self_thickness_m and cover_m stay each one's own; the rest is the
 * outermost's. A call that is [excl] on one is so on all of them. One that gets destroyed is worn no longer.
 * At most 64. VFIT_ERROR_NOT_WEARABLE where inner reaches far beyond cloth (a wide skirt below trousers):
 * both are then carried into the pose, and cloth is not worn over inner. VFIT_ERROR_ARGUMENT where cloth is
 * worn below inner already, VFIT_ERROR_STATE while a step of either runs. [excl] on both */
VFIT_API vfit_result vfit_cloth_wear_over(vfit_cloth cloth, vfit_cloth inner);
/* A prop: a solid that the host puts beside a body, such as a chair, a weapon, a bag or hair. Cloth stays
 * outside of it by its thickness, and meets its edges too. A prop comes in as a point that grows to its size
 * within 0.25 s and pushes cloth aside, also after vfit_cloth_reset, and where it moves by more than 0.3 m
 * against the body within a step. Where it reaches into the body, cloth meets it outside of that, with room
 * for the cloth between them. One that crosses cloth and stretches it to more than 1.6 times its length
 * passes through it for a while. */
typedef int32_t vfit_prop_shape;
enum { VFIT_PROP_SPHERE = 0, VFIT_PROP_CAPSULE = 1, VFIT_PROP_BOX = 2, VFIT_PROP_MESH = 3 };
typedef struct vfit_prop_desc {
    uint32_t struct_size;
    vfit_prop_shape shape;
    float size[3];           /* context's axes and unit, 1 mm to 10 m. SPHERE: radius. CAPSULE: radius, and
                              * half the way between its two centres, which lie along the up axis. BOX: half
                              * of each edge */
    uint32_t vertex_count;   /* 65,536 at most, also once edges longer than 3 cm (and 1/40 of its extent) are
                              * split: then VFIT_ERROR_DATA */
    const float* positions;  /* MESH: three a vertex, in the prop's own frame; copied */
    const uint32_t* indices; /* MESH: three a triangle, wound as the INDEX that the context writes; copied.
                              * Small holes are filled. What is open otherwise is a shell 4 mm thick */
    uint32_t index_count, reserved; /* 1,048,575 at most */
} vfit_prop_desc;
VFIT_STRUCT(vfit_prop_desc)
/* Its frame is at the origin until it is moved. VFIT_ERROR_DATA for a mesh without triangles, with a wrong
 * index, or inside out. */
VFIT_API vfit_result vfit_prop_create(vfit_context context, const vfit_prop_desc* desc,
                                      vfit_prop* out);  /* [any] */
VFIT_API vfit_result vfit_prop_destroy(vfit_prop prop); /* no step that begins later meets it [any] */
/* Where its frame is at the end of the next step of each cloth that meets it: call it before that step
 * begins. While it is called, no other thread may begin such a step (VFIT_ERROR_BUSY). rotation: xyzw. [excl]
 */
VFIT_API vfit_result vfit_prop_move(vfit_prop prop, const float position[3], const float rotation[4]);
/* The same for the vertices of a MESH, in its own frame: three numbers for each of vertex_count. [excl] */
VFIT_API vfit_result vfit_prop_deform(vfit_prop prop, const float* positions, uint32_t vertex_count);
/* From the next step on, cloth meets that prop of its context; and no longer. Each cloth that shall meet a
 * prop is told so. To add what is there and to remove what is not changes nothing. At most 64 a cloth. Cost
 * of adding: about ten steps. VFIT_ERROR_STATE while a step runs. [excl] on cloth, [read] on prop */
VFIT_API vfit_result vfit_cloth_add_prop(vfit_cloth cloth, vfit_prop prop);
VFIT_API vfit_result vfit_cloth_remove_prop(vfit_cloth cloth, vfit_prop prop);
/* Skin that this garment alone hides from all who do not look up under it by more than 45 degrees:
 * triangles[i] becomes 1 for those triangles of the avatar's INDEX, and stays what it was for the others, so
 * that garments add up. Leave them out of what you draw. Found on the body at rest, of a labelled size as the
 * last step left it there: what is nearer than margin_m to skin that is seen is left, as cloth slides and
 * hems lift (0: 0.03). VFIT_ERROR_STATE while a step runs. Takes as long as some 100 steps: once a garment
 * and size. [read] */
VFIT_API vfit_result vfit_cloth_hide_skin(vfit_cloth cloth, float margin_m, uint8_t* triangles,
                                          uint32_t count);
/* How a garment sits at one girth of the trunk. TIGHT: the body's girth is nearer to the girth of the next
 * larger size, and less than 5 cm of ease are left, or it presses with over 2 kPa; LOOSE: nearer to the girth
 * of the next smaller size, with over 5 cm of ease. Of a garment that tells of no such girth, TIGHT:
 * stretched by over 3 %; LOOSE: over 12 cm of ease. */
typedef int32_t vfit_fit;
enum { VFIT_FIT_RIGHT = 0, VFIT_FIT_TIGHT = 1, VFIT_FIT_LOOSE = 2 };
typedef struct vfit_fit_zone {
    uint32_t struct_size;
    vfit_fit fit;
    float body_m;      /* the avatar's girth */
    float garment_m;   /* of the cloth that lies around it, unstretched */
    float ease_m;      /* garment less body */
    float strain;      /* of that cloth along the girth, as it is worn */
    float pressure_pa; /* mean about the girth; with VFIT_CLOTH_PRESSURE */
    float opening_m;   /* across an open front, beside garment_m; 0: closed */
    char key[48];      /* "chest_girth_m", "waist_girth_m", "hip_girth_m" */
} vfit_fit_zone;
VFIT_STRUCT(vfit_fit_zone)
/* By girths that the garment goes around, of the cloth as it was left by the last step, less what it sags by:
 * let it come to rest first, best on somebody who stands (docs/garments.md). Takes as long as some five
 * steps. [read] */
VFIT_API vfit_result vfit_cloth_fit(vfit_cloth cloth, vfit_fit_zone* items, uint32_t stride, uint32_t* count);
/* The same place by place, one a vertex of what acquire gives: above 0 tight (1: its fabric's most strain, or
 * 2 kPa), below 0 loose (-1: 6 cm off the skin). Takes as long as some ten steps. [read] */
VFIT_API vfit_result vfit_cloth_fit_map(vfit_cloth cloth, float* values, uint32_t count);
/* POSITION, NORMAL, UV, INDEX, STRAIN, and with VFIT_CLOTH_PRESSURE PRESSURE: of a vertex that touches the
 * body, what its threads and its weight pull with against it, over the flat cloth's area; 0 where the garment
 * is skinned. Pa whatever the unit. [any] */
VFIT_API vfit_result vfit_cloth_acquire(vfit_cloth cloth, vfit_frame* out);
VFIT_API vfit_result vfit_cloth_describe(vfit_cloth cloth, vfit_cloth_stats* out); /* [read] */
VFIT_API vfit_result vfit_cloth_state_hash(vfit_cloth cloth, uint64_t* out);       /* [read] */

/* The surfaces that cross. */
typedef int32_t vfit_crossing_kind;
enum {
    VFIT_CROSSING_SELF = 0,  /* the garment and itself */
    VFIT_CROSSING_SKIN = 1,  /* the garment and the skin of the avatar, linearly blended */
    VFIT_CROSSING_CLOTH = 2, /* the garment and another of the list */
    VFIT_CROSSING_PROP = 3   /* the garment and a prop that it meets */
};
/* Two surfaces of an outfit of which triangles cross. */
typedef struct vfit_crossing {
    uint32_t struct_size;
    vfit_crossing_kind kind;
    uint32_t cloth;          /* index in cloths */
    uint32_t other;          /* of CLOTH: index of the other one; of PROP: its number among the props
                              * of cloth in that step, in the order in which they were added; else as cloth */
    uint32_t pair_count;     /* pairs of triangles that cross */
    uint32_t triangle;       /* of the first pair: number in the INDEX stream of cloth */
    uint32_t other_triangle; /* number in the INDEX stream of cloth, of the avatar, or of other, by kind; of
                              * PROP: 0 */
    uint32_t reserved;
} vfit_crossing;
VFIT_STRUCT(vfit_crossing)
/* Tests the last finished steps of an outfit, 1 to 64 cloths of one avatar, for triangles that cross: of each
 * garment with itself, with the skin in the pose of that step, with each later garment of the list, and with
 * its props as it met them in that step, also those that it let pass. Every pair of triangles that share no
 * vertex is tested: an empty list proves that none cross. At most n (n + 3) / 2 items for n cloths, and one
 * for each prop of each: with room for these, one call is enough. VFIT_ERROR_ARGUMENT where a cloth is listed
 * twice or is of another avatar. While a step runs, the one before it is tested. Cost: about eight steps of
 * these cloths. [read] on each cloth */
VFIT_API vfit_result vfit_outfit_check(const vfit_cloth* cloths, uint32_t cloth_count, vfit_crossing* items,
                                       uint32_t stride, uint32_t* count);
/* The skin to draw below an outfit, 1 to 64 cloths of one avatar: a frame with the streams of
 * vfit_avatar_acquire, in the pose in which the first cloth is shown, that of its last finished step or of
 * the last vfit_cloth_carry since. Where the skin would come through a garment as vfit_cloth_acquire gives
 * it, it gives way inwards, as flesh does, until no triangles cross. A patch that would have to give way by
 * more than 2 cm, as that of an arm that goes through the garment, stays. Normals stay. crossing_pairs (may
 * be null): pairs of a triangle of that skin and one of a garment that still cross; 0 proves that there are
 * none. VFIT_ERROR_ARGUMENT as with vfit_outfit_check; VFIT_ERROR_BUSY also where the host holds all frames
 * of the avatar. [excl] on each cloth and on the avatar; a step may run */
VFIT_API vfit_result vfit_outfit_skin(const vfit_cloth* cloths, uint32_t cloth_count, vfit_frame* out,
                                      uint32_t* crossing_pairs);
#endif
