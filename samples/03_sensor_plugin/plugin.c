/* A sensor plug-in: "box:" shows a box that swings to and fro 2 m before a camera. What a real camera's
 * plug-in does differently stands in the README. */
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "vfit_plugin.h"

enum { WIDTH = 320, HEIGHT = 240, RATE_HZ = 30 };

typedef struct device {
    const vfit_host* host;
    void* stream;
    pthread_t thread;
    int running; /* start and stop are called by one thread at a time */
    _Atomic int stopping;
} device;

static int64_t now(const vfit_host* host) { return host->time_ns(host->self); }

static void draw(uint16_t* pixels, uint32_t row_stride, int index) {
    const int left = WIDTH / 2 - 25 + (int)(60.0 * sin(index * 0.05));
    for (int y = 0; y < HEIGHT; ++y)
        for (int x = 0; x < WIDTH; ++x)
            ((uint16_t*)((char*)pixels + y * row_stride))[x] =
                x >= left && x < left + 50 && y > 20 ? 2000 : 3500; /* mm */
}

/* One image: a frame is begun, filled in place, and pushed. */
static vfit_result show(device* d, int index) {
    const vfit_host* host = d->host;
    vfit_frame_layout layout = vfit_frame_layout_init();
    layout.stream = VFIT_STREAM_DEPTH, layout.format = VFIT_FORMAT_U16, layout.width = WIDTH,
    layout.height = HEIGHT;
    vfit_frame frame = {0};
    vfit_result result = host->frame_begin(host->self, d->stream, &layout, sizeof layout, 1, &frame);
    if (result == VFIT_ERROR_BUSY) return VFIT_OK; /* nobody took the last ones: this one is lost */
    if (result < 0) return result;
    void* pixels = NULL;
    uint32_t row_stride = 0;
    host->frame_pixels(host->self, frame, VFIT_STREAM_DEPTH, &pixels, &row_stride);
    draw(pixels, row_stride, index);
    vfit_intrinsics in = vfit_intrinsics_init();
    in.width = WIDTH, in.height = HEIGHT, in.fx = in.fy = 285.0f, in.cx = WIDTH / 2.0f, in.cy = HEIGHT / 2.0f;
    host->frame_intrinsics(host->self, frame, &in);
    return host->frame_push(host->self, d->stream, frame, 0);
}

static void* run(void* arg) {
    device* d = arg;
    const int64_t begin = now(d->host);
    for (int index = 0; !d->stopping; ++index) {
        const int64_t wait = begin + index * 1000000000LL / RATE_HZ - now(d->host);
        const struct timespec nap = {wait / 1000000000LL, wait % 1000000000LL};
        if (wait > 0) nanosleep(&nap, NULL);
        if (show(d, index) < 0) break; /* VFIT_ERROR_STATE: the stream stops */
    }
    return NULL;
}

static vfit_result open_device(void* self, const char* uri, void* stream, void** out) {
    (void)uri;
    device* d = calloc(1, sizeof *d);
    if (!d) return VFIT_ERROR_OUT_OF_MEMORY;
    d->host = self, d->stream = stream;
    *out = d;
    return VFIT_OK;
}
static vfit_result start(void* device_) {
    device* d = device_;
    d->stopping = 0;
    d->running = pthread_create(&d->thread, NULL, run, d) == 0;
    return d->running ? VFIT_OK : VFIT_ERROR_OUT_OF_MEMORY;
}
static vfit_result stop(void* device_) {
    device* d = device_;
    d->stopping = 1;
    if (d->running) pthread_join(d->thread, NULL);
    d->running = 0;
    return VFIT_OK;
}
static void close_device(void* device_) { stop(device_), free(device_); }

vfit_result vfit_plugin_negotiate(const vfit_host* host, vfit_plugin* out) {
    if (host->abi_min > VFIT_PLUGIN_ABI || host->abi_max < VFIT_PLUGIN_ABI) return VFIT_ERROR_VERSION;
    out->abi = VFIT_PLUGIN_ABI;
    out->name = "box";
    out->schemes = "box";
    out->self = (void*)host;
    out->open = open_device, out->start = start, out->stop = stop, out->close = close_device;
    return VFIT_OK;
}
