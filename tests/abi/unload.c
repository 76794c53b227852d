/* A host may unload the library while a thread of it still runs, as Mono does at its end: a plug-in that is
 * slow to end is left to a thread that outlives vfit_shutdown. So the code stays where it is, for good. */
#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <vfit.h>

typedef struct host {
    void* library;
    int ran;
} host;

static void* function(const host* h, const char* name) {
    void* found = h->library ? dlsym(h->library, name) : 0;
    if (!found) fprintf(stderr, "%s: %s\n", name, dlerror());
    return found;
}

/* On a thread of its own, for what a living thread holds of a library keeps that library too. */
static void* stream_and_shut_down(void* given) {
    host* h = given;
    vfit_result (*create)(const vfit_context_desc*, vfit_context*);
    vfit_result (*open)(vfit_context, const char*, vfit_sensor*);
    vfit_result (*start)(vfit_sensor);
    vfit_result (*shutdown)(void);
    *(void**)&create = function(h, "vfit_context_create");
    *(void**)&open = function(h, "vfit_sensor_open");
    *(void**)&start = function(h, "vfit_sensor_start");
    *(void**)&shutdown = function(h, "vfit_shutdown");
    if (!create || !open || !start || !shutdown) return 0;

    vfit_context_desc desc = vfit_context_desc_init();
    desc.api_version = VFIT_VERSION;
    vfit_context context = VFIT_ZERO;
    vfit_sensor sensor = VFIT_ZERO;
    h->ran = create(&desc, &context) == VFIT_OK &&
             open(context, "virtual:pace=realtime&rate=240&sensor=kinect_v1_320", &sensor) == VFIT_OK &&
             start(sensor) == VFIT_OK && shutdown() == VFIT_OK;
    return 0;
}

int main(int count, char** arguments) {
    const char* path = count > 1 ? arguments[1] : "";
    host h = {dlopen(path, RTLD_NOW | RTLD_LOCAL), 0};
    pthread_t thread;
    if (pthread_create(&thread, 0, stream_and_shut_down, &h) || pthread_join(thread, 0) || !h.ran) return 1;
    dlclose(h.library);
    if (dlopen(path, RTLD_NOW | RTLD_NOLOAD)) return 0;
    fprintf(stderr, "%s: unloaded\n", path);
    return 2;
}
