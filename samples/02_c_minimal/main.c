/* The whole chain in C99: open -> scan -> size -> avatar -> cloth -> vertices in a buffer of one's own.
 *     c_minimal [RECORDING or sensor URI]                                                             */
#include <stdio.h>
#include <stdlib.h>
#include <vfit.h>

/* Position and normal of a vertex, as a renderer would map them. */
typedef struct {
    float position[3], normal[3];
} vertex;

static void check(vfit_result result, const char* what) {
    char why[512];
    if (result >= 0) return;
    vfit_last_error(why, sizeof why);
    fprintf(stderr, "%s: %s: %s\n", what, vfit_result_name(result), why);
    exit(1);
}

static void scan_person(vfit_context context, const char* uri, vfit_scan scan, vfit_motion motion) {
    vfit_sensor sensor;
    vfit_tracker tracker;
    vfit_frame frame, tracked;
    vfit_scan_state state = vfit_scan_state_init();
    vfit_result done = VFIT_NOT_READY;
    check(vfit_sensor_open(context, uri, &sensor), "open");
    check(vfit_tracker_create(context, NULL, &tracker), "tracker");
    check(vfit_sensor_start(sensor), "start");
    while (done != VFIT_OK) {
        vfit_body bodies[8] = {{0}};
        vfit_view depth = vfit_view_init();
        uint32_t count = 8;
        const vfit_result got = vfit_sensor_acquire(sensor, -1, &frame);
        check(got, "acquire");
        if (got != VFIT_OK) break; /* the source has ended */
        check(vfit_tracker_update(tracker, frame, &tracked), "track");
        check(vfit_frame_bodies(tracked, bodies, sizeof bodies[0], &count), "bodies");
        check(vfit_frame_view(tracked, VFIT_STREAM_DEPTH, &depth), "depth");
        check(vfit_motion_step(motion, tracked, bodies[0].body_id, depth.time_ns), "motion");
        check(done = vfit_scan_add(scan, tracked, bodies[0].body_id, &state), "scan");
        vfit_frame_release(tracked);
        vfit_frame_release(frame);
    }
    printf("%u of %u frames taken\n", (unsigned)state.frames_taken, (unsigned)state.frames_wanted);
    vfit_tracker_destroy(tracker);
    vfit_sensor_close(sensor);
}

static void print_size(vfit_context context, vfit_scan scan, const char* chart_name,
                       const char* garment_kind) {
    vfit_measurement measures[64];
    vfit_size sizes[32];
    vfit_size_chart chart;
    uint32_t i, measure_count = 64, size_count = 32;
    check(vfit_scan_measure(scan, measures, sizeof measures[0], &measure_count), "measure");
    for (i = 0; i < measure_count; ++i)
        printf("  %-22s %.3f +- %.3f m\n", measures[i].key, measures[i].value, measures[i].sigma);
    check(vfit_size_chart_open(context, chart_name, &chart), "chart");
    check(vfit_size_recommend(chart, garment_kind, measures, sizeof measures[0], measure_count, sizes,
                              sizeof sizes[0], &size_count),
          "size");
    if (size_count > 0) printf("size %s, %.0f %%\n", sizes[0].label, 100.0 * sizes[0].probability);
    vfit_size_chart_destroy(chart);
}

static void fetch(vfit_frame frame, vfit_stream stream, float* first, uint32_t count) {
    vfit_target target = vfit_target_init();
    target.format = VFIT_FORMAT_F32X3;
    target.data = first;
    target.item_stride = sizeof(vertex);
    target.capacity = (uint64_t)(count - 1) * sizeof(vertex) + 3 * sizeof(float);
    check(vfit_frame_write(frame, stream, &target, NULL), "write");
}

int main(int argc, char** argv) {
    vfit_context_desc desc = vfit_context_desc_init();
    vfit_avatar_desc avatar_desc = vfit_avatar_desc_init();
    vfit_garment_info info = vfit_garment_info_init();
    vfit_pose pose = vfit_pose_init();
    vfit_bone bones[VFIT_BONE_COUNT];
    vfit_context context;
    vfit_scan scan;
    vfit_motion motion;
    vfit_avatar avatar;
    vfit_garment garment;
    vfit_cloth cloth;
    vfit_frame frame;
    uint32_t i, bone_count = VFIT_BONE_COUNT;
    vertex* vertices;

    desc.api_version = VFIT_VERSION;
    check(vfit_context_create(&desc, &context), "context");
    check(vfit_scan_create(context, NULL, &scan), "scan");
    check(vfit_motion_create(context, NULL, &motion), "motion");
    check(vfit_garment_open(context, "sundress", &garment), "garment");
    check(vfit_garment_describe(garment, &info), "garment");
    scan_person(context, argc > 1 ? argv[1] : "virtual:motion=demo&sex=f&frames=60&seed=7", scan, motion);
    print_size(context, scan, info.size_chart, info.garment_kind);

    avatar_desc.sex = VFIT_SEX_FEMALE;
    check(vfit_avatar_create_from_scan(context, &avatar_desc, scan, &avatar), "avatar");
    check(vfit_motion_pose(motion, &pose, bones, sizeof bones[0], &bone_count), "pose");
    check(vfit_avatar_pose(avatar, &pose, bones, sizeof bones[0], bone_count), "pose");
    check(vfit_cloth_create(avatar, garment, NULL, &cloth), "cloth");
    for (i = 0; i < 60; ++i) check(vfit_cloth_step(cloth, 1.0f / 60.0f), "step");

    vertices = malloc(info.vertex_count * sizeof(vertex));
    if (!vertices) return 1;
    check(vfit_cloth_acquire(cloth, &frame), "acquire");
    fetch(frame, VFIT_STREAM_POSITION, vertices[0].position, info.vertex_count);
    fetch(frame, VFIT_STREAM_NORMAL, vertices[0].normal, info.vertex_count);
    printf("%u vertices, the first at %.3f %.3f %.3f\n", (unsigned)info.vertex_count, vertices[0].position[0],
           vertices[0].position[1], vertices[0].position[2]);
    vfit_frame_release(frame);
    free(vertices);
    check(vfit_context_destroy(context), "destroy"); /* takes everything in it along */
    return 0;
}
