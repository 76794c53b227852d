/* Opens a context and an avatar: the library, its data and its plug-ins were all found where they are
 * installed. */
#include <stdio.h>
#include <vfit.h>

static int failed(const char* what) {
    char text[256];
    vfit_last_error(text, sizeof text);
    fprintf(stderr, "%s: %s\n", what, text);
    return 1;
}

int main(void) {
    vfit_context_desc desc = vfit_context_desc_init();
    vfit_context context;
    vfit_avatar avatar;
    vfit_sensor sensor;
    desc.api_version = VFIT_VERSION;
    if (vfit_context_create(&desc, &context) != VFIT_OK) return failed("context");
    if (vfit_avatar_create_from_shape(context, NULL, NULL, 0, 0, &avatar) != VFIT_OK) return failed("avatar");
    if (vfit_sensor_open(context, "virtual:", &sensor) != VFIT_OK) return failed("sensor");
    if (vfit_context_destroy(context) != VFIT_OK) return failed("destroy");
    puts("ok");
    return 0;
}
