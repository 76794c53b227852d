#include "bench/user_map_scenes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <random>

#include "client/client.h"

namespace vfit::tools {

namespace fs = std::filesystem;

namespace {

constexpr float kRoom_m = 0.9f;        // from the person to the wall behind
constexpr float kSideWall_m = 1.7f;    // from the camera
constexpr float kKinectRange_m = 4.0f;  // default mode, from the maker
// Person in the still: between the two on the left and the two in the middle.
constexpr float kStillX_m = -0.3f, kStillZ_m = -2.6f;
constexpr float kStillFocal_px = 525.0f, kStillCx = 319.5f, kStillCy = 239.5f;
const Vec3 kStillNormal{0.01036f, -0.99701f, -0.07656f};  // published with the picture, y down
constexpr float kStillDistance_m = 1.26614f;

Camera camera_of_frame(vfit_frame frame) {
    vfit_intrinsics k = vfit_intrinsics_init();
    check(vfit_frame_intrinsics(frame, &k));
    const vfit_camera c = camera_of(frame);
    Camera camera;
    camera.width = k.width;
    camera.height = k.height;
    camera.fx = k.fx;
    camera.fy = k.fy;
    camera.cx = k.cx;
    camera.cy = k.cy;
    camera.depth_unit_m = c.depth_unit_m;
    camera.floor_state = c.floor_state;
    camera.floor_normal = Vec3(c.floor_normal[0], c.floor_normal[1], c.floor_normal[2]);
    camera.floor_distance_m = c.floor_distance_m;
    return camera;
}

/// Copies one stream of 640 x 480 or any other size, row by row.
template <typename T>
void copy_pixels(const vfit_view& view, std::vector<T>& out) {
    out.resize(size_t(view.width) * view.height);
    for (uint32_t y = 0; y < view.height; ++y)
        std::memcpy(out.data() + size_t(y) * view.width, static_cast<const char*>(view.data) + size_t(y) * view.row_stride,
                    view.width * sizeof(T));
}

/// The plane's depth along the ray of a pixel; 0 behind the camera.
float plane_depth(const Vec3& normal, float distance, const Vec3& ray) {
    const float along = glm::dot(normal, ray);
    return along < -1e-6f ? -distance / along : 0.0f;
}

/// A room of three planes as a Kinect v1 sees it: noise of Nguyen, Izadi and Lovell 2012, steps of disparity of
/// Khoshelham and Elberink 2012.
class Room {
public:
    Room(const Camera& camera, float wall_z) : camera_(camera), wall_z_(wall_z) {}

    void render(std::vector<uint16_t>& depth, std::mt19937& random) const {
        depth.assign(size_t(camera_.width) * camera_.height, 0);
        std::normal_distribution<float> noise;
        const Mat3 world(camera_.world_from_camera());
        const float height = camera_.floor_distance_m;
        for (uint32_t y = 0; y < camera_.height; ++y)
            for (uint32_t x = 0; x < camera_.width; ++x) {
                const Vec3 ray = world * camera_.unproject(float(x), float(y), 1.0f);
                float z = 1e9f;
                const auto hit = [&](float at) {
                    if (at > 0.0f) z = std::min(z, at);
                };
                hit(plane_depth({0, 1, 0}, height, ray));
                hit(plane_depth({0, 0, 1}, -wall_z_, ray));
                hit(plane_depth({-1, 0, 0}, kSideWall_m, ray));
                if (z > kKinectRange_m) continue;
                z += noise(random) * (0.0012f + 0.0019f * (z - 0.4f) * (z - 0.4f));
                const float step = 2.85e-3f;  // 1/m of 1 / z
                z = 1.0f / (std::round(1.0f / z / step) * step);
                depth[size_t(y) * camera_.width + x] = uint16_t(std::lround(z / camera_.depth_unit_m));
            }
    }

private:
    Camera camera_;
    float wall_z_;
};

/// Where the recorded person stands: floor below the lowest feet of a level camera, and the way they take.
struct Stand {
    float height_m = 1.0f, near_z = 0.0f, far_z = 0.0f, mean_x = 0.0f;  // camera space
};

Stand stand_of(const std::string& recording) {
    Stand s;
    std::vector<float> lowest, farthest, xs, zs;
    play_source(recording, [&](const Shot& shot) {
        float low = -1e9f, far = 0.0f;
        double x = 0.0, z = 0.0;
        size_t n = 0;
        for (uint32_t v = 0; v < shot.camera.height; ++v)
            for (uint32_t u = 0; u < shot.camera.width; ++u) {
                const float d = float(shot.depth[size_t(v) * shot.camera.width + u]) * shot.camera.depth_unit_m;
                if (d <= 0.0f) continue;
                const Vec3 p = shot.camera.unproject(float(u), float(v), d);
                low = std::max(low, p.y);
                far = std::max(far, p.z);
                x += p.x;
                z += p.z;
                ++n;
            }
        if (n == 0) return;
        lowest.push_back(low);
        farthest.push_back(far);
        xs.push_back(float(x / double(n)));
        zs.push_back(float(z / double(n)));
    });
    if (lowest.empty()) throw Failure(recording + ": nobody is in it");
    const auto median = [](std::vector<float> v) {
        std::nth_element(v.begin(), v.begin() + long(v.size() / 2), v.end());
        return v[v.size() / 2];
    };
    s.height_m = median(lowest);
    s.far_z = *std::max_element(farthest.begin(), farthest.end());
    s.mean_x = median(xs);
    s.near_z = median(zs);
    return s;
}

void play_in_room(const std::string& recording, const std::function<void(const Shot&)>& show) {
    const Stand stand = stand_of(recording);
    std::optional<Room> room;
    std::vector<uint16_t> empty;
    std::mt19937 random(1);
    play_source(recording, [&](const Shot& source) {
        Shot shot = source;
        set_floor(shot.camera, stand.height_m, 0.0f, 0.0f, VFIT_FLOOR_GIVEN);
        shot.floor_known = true;
        if (!room) room.emplace(shot.camera, -(stand.far_z + kRoom_m));
        room->render(empty, random);
        for (size_t i = 0; i < empty.size(); ++i) {
            const bool person = source.depth[i] != 0 && (empty[i] == 0 || source.depth[i] < empty[i]);
            shot.depth[i] = person ? source.depth[i] : empty[i];
            shot.truth[i] = person;
        }
        show(shot);
    });
}

void play_in_still(const std::string& recording, const Shot& still, const std::function<void(const Shot&)>& show) {
    const Stand stand = stand_of(recording);
    play_source(recording, [&](const Shot& source) {
        Shot shot = still;
        shot.time_ns = source.time_ns;
        Camera from = source.camera;
        set_floor(from, stand.height_m, 0.0f, 0.0f, VFIT_FLOOR_GIVEN);
        const Mat4 world = from.world_from_camera(), into = still.camera.camera_from_world();
        for (uint32_t v = 0; v < from.height; ++v)
            for (uint32_t u = 0; u < from.width; ++u) {
                const float d = float(source.depth[size_t(v) * from.width + u]) * from.depth_unit_m;
                if (d <= 0.0f) continue;
                Vec3 p = transform_point(world, from.unproject(float(u), float(v), d));
                p += Vec3(kStillX_m - stand.mean_x, 0.0f, kStillZ_m + stand.near_z);
                p = transform_point(into, p);
                const Vec2 at = still.camera.project(p);
                // A pixel of the recording covers this many of the still, and a little more so that none is left out.
                const float half = 0.6f * still.camera.fx / from.fx * d / p.z;
                for (int y = int(std::ceil(at.y - half)); float(y) < at.y + half; ++y)
                    for (int x = int(std::ceil(at.x - half)); float(x) < at.x + half; ++x) {
                        if (x < 0 || y < 0 || x >= int(still.camera.width) || y >= int(still.camera.height)) continue;
                        const size_t i = size_t(y) * still.camera.width + size_t(x);
                        const auto units = uint16_t(std::lround(p.z / still.camera.depth_unit_m));
                        if (shot.depth[i] != 0 && shot.depth[i] <= units) continue;
                        shot.depth[i] = units;
                        shot.truth[i] = 1;
                    }
            }
        show(shot);
    });
}

}  // namespace

void play_source(const std::string& uri, const std::function<void(const Shot&)>& show) {
    const Context context = open_context();
    Source source(context.get(), uri);
    Shot shot;
    while (const auto frame = source.next()) {
        shot.camera = camera_of_frame(frame->get());
        shot.floor_known = shot.camera.floor_state == VFIT_FLOOR_GIVEN;
        const vfit_view depth = view_of(frame->get(), VFIT_STREAM_DEPTH);
        copy_pixels(depth, shot.depth);
        shot.truth.assign(shot.depth.size(), 0);
        if (has_stream(frame->get(), VFIT_STREAM_USER_MAP))
            copy_pixels(view_of(frame->get(), VFIT_STREAM_USER_MAP), shot.truth);
        shot.time_ns += 33'333'333;  // every source here runs at 30 Hz
        show(shot);
    }
}

Shot load_still(const std::string& path, float focal_px, float cx, float cy) {
    // A name of its own: two runs at a time must not share the folder.
    const fs::path folder = fs::temp_directory_path() / ("vfit-bench-still-" + std::to_string(std::random_device{}()));
    if (!fs::create_directory(folder)) throw Failure(folder.string() + ": is there already");
    fs::create_directory(folder / "depth");
    fs::copy_file(path, folder / "depth" / "000000.png");
    std::ofstream(folder / "camera.json") << Json{{"format", "vfit-recording"}, {"version", 1}, {"sensor", "kinect_v1"},
        {"width", 640}, {"height", 480}, {"fx", focal_px}, {"fy", focal_px}, {"cx", cx}, {"cy", cy}, {"fps", 30},
        {"depth_unit_m", 0.001}, {"segmented", false}};
    Shot still;
    play_source(folder.string(), [&](const Shot& shot) { still = shot; });
    fs::remove_all(folder);
    if (still.depth.empty()) throw Failure(path + ": holds no picture");
    return still;
}

std::vector<Scene> virtual_scenes(uint32_t frames) {
    // What changes from one to the next: motion, distance, where the camera stands, the room, the body.
    const char* const kCases[] = {
        "motion=scan&distance=2.7",
        "motion=scan&distance=2.2&camera_height=1.6&tilt=18&sex=f&seed=2",
        "motion=walk&distance=3.1&seed=3",
        "motion=walk&distance=2.6&camera_height=2.1&tilt=25&sex=m&seed=4",
        "motion=squat&distance=2.6&camera_height=0.8&seed=5",
        "motion=squat&distance=2.4&camera_height=1.8&tilt=20&sex=f&seed=6",
        "motion=wave&distance=2.5&sex=f&height=0.2&seed=7",
        "motion=reach&distance=2.6&sex=m&height=0.8&seed=8",
        "motion=turn&distance=2.7&camera_height=0.4&tilt=-12&seed=9",
        "motion=turn&distance=2.5&wall=0.35&sex=m&weight=0.8&seed=10",
        "motion=demo&distance=2.7&side_wall=1.1&seed=11",
    };
    std::vector<Scene> scenes;
    for (const char* sensor : {"kinect_v1", "tof"})
        for (const char* options : kCases) {
            const std::string uri =
                std::string("virtual:sensor=") + sensor + "&" + options + "&frames=" + std::to_string(frames);
            scenes.push_back({std::string(sensor) + " " + options, false, true,
                              [uri](const std::function<void(const Shot&)>& show) { play_source(uri, show); }});
        }
    return scenes;
}

std::vector<Scene> real_scenes(const std::string& recordings, const std::string& still_path) {
    std::vector<fs::path> paths;
    for (const auto& entry : fs::directory_iterator(recordings))
        if (entry.is_directory()) paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    std::shared_ptr<Shot> still;
    if (!still_path.empty()) {
        still = std::make_shared<Shot>(load_still(still_path, kStillFocal_px, kStillCx, kStillCy));
        still->camera.floor_normal = glm::normalize(kStillNormal);
        still->camera.floor_distance_m = kStillDistance_m;
        still->floor_known = true;
    }
    std::vector<Scene> scenes;
    using Show = std::function<void(const Shot&)>;
    for (const auto& path : paths) {
        const std::string name = path.filename().string(), uri = path.string();
        scenes.push_back({"alone " + name, true, true, [uri](const Show& show) {
                              play_source(uri, [&](const Shot& source) {
                                  Shot shot = source;
                                  for (size_t i = 0; i < shot.depth.size(); ++i) shot.truth[i] = shot.depth[i] != 0;
                                  shot.floor_known = false;
                                  show(shot);
                              });
                          }});
        scenes.push_back({"room " + name, true, true, [uri](const Show& show) { play_in_room(uri, show); }});
        if (still)
            scenes.push_back(
                {"still " + name, true, false, [uri, still](const Show& show) { play_in_still(uri, *still, show); }});
    }
    return scenes;
}

}  // namespace vfit::tools
