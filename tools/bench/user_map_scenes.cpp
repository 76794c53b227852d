#include "bench/user_map_scenes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <random>

#include "bench/frames.h"
#include "client/client.h"

namespace vfit::tools {

namespace fs = std::filesystem;

namespace {

using Show = std::function<void(const Shot&)>;

constexpr int64_t kFrame_ns = 33'333'333;  // every source here runs at 30 Hz
constexpr float kRoom_m = 0.9f;            // from the person to the wall behind
constexpr float kSideWall_m = 1.7f;        // from the camera
constexpr float kKinectRange_m = 4.0f;     // default mode, from the maker
/// Where the recorded person is put into the still: world x and z.
struct Place {
    const char *name, *means;
    float x_m, z_m;
};
// Five people stand there. Of the places where the feet are in view, the first is the farthest from
// everybody: 0.36 m from its axis to the nearest of their surfaces (a body goes 0.2 m deeper than what is
// seen of it). The second has 0.16 m: arms touch those of who stands beside. The third has 0.05 m: the bodies
// are inside each other, and hands come out of somebody's back.
constexpr Place kPlaces[] = {{"free", "where nobody stands", 0.0f, -2.2f},
                             {"beside", "arm against arm with others", -0.15f, -2.6f},
                             {"into", "in part inside another body", -0.3f, -2.6f}};
constexpr float kStillFocal_px = 525.0f, kStillCx = 319.5f, kStillCy = 239.5f;
const Vec3 kStillNormal{0.01036f, -0.99701f, -0.07656f};  // published with the picture, y down
constexpr float kStillDistance_m = 1.26614f;

/// The plane's depth along the ray of a pixel; 0 behind the camera.
float plane_depth(const Vec3& normal, float distance, const Vec3& ray) {
    const float along = glm::dot(normal, ray);
    return along < -1e-6f ? -distance / along : 0.0f;
}

/// A room of three planes as a Kinect v1 sees it: noise of Nguyen, Izadi and Lovell 2012, steps of disparity
/// of Khoshelham and Elberink 2012.
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
                const float d =
                    float(shot.depth[size_t(v) * shot.camera.width + u]) * shot.camera.depth_unit_m;
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
    if (lowest.empty()) throw Failure(recording + ": no person is in it");
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

void play_in_room(const std::string& recording, const Show& show) {
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

/// Puts a recorded person into the picture by depth test: their floor on its floor, their mean to x and z.
void put(const Shot& source, const Stand& stand, float x_m, float z_m, uint8_t number, Shot& shot) {
    Camera from = source.camera;
    set_floor(from, stand.height_m, 0.0f, 0.0f, VFIT_FLOOR_GIVEN);
    const Camera& to = shot.camera;
    const Mat4 world = from.world_from_camera(), into = to.camera_from_world();
    for (uint32_t v = 0; v < from.height; ++v)
        for (uint32_t u = 0; u < from.width; ++u) {
            const float d = float(source.depth[size_t(v) * from.width + u]) * from.depth_unit_m;
            if (d <= 0.0f) continue;
            Vec3 p = transform_point(world, from.unproject(float(u), float(v), d));
            p += Vec3(x_m - stand.mean_x, 0.0f, z_m + stand.near_z);
            p = transform_point(into, p);
            const Vec2 at = to.project(p);
            // A pixel of the recording covers this many of the picture, and a little more so that none is
            // left out.
            const float half = 0.6f * to.fx / from.fx * d / p.z;
            for (int y = int(std::ceil(at.y - half)); float(y) < at.y + half; ++y)
                for (int x = int(std::ceil(at.x - half)); float(x) < at.x + half; ++x) {
                    if (x < 0 || y < 0 || x >= int(to.width) || y >= int(to.height)) continue;
                    const size_t i = size_t(y) * to.width + size_t(x);
                    const auto units = uint16_t(std::lround(p.z / to.depth_unit_m));
                    if (shot.depth[i] != 0 && shot.depth[i] <= units) continue;
                    shot.depth[i] = units;
                    shot.truth[i] = number;
                }
        }
}

void play_in_still(const std::string& recording, const Shot& still, const Place& place, const Show& show) {
    const Stand stand = stand_of(recording);
    play_source(recording, [&](const Shot& source) {
        Shot shot = still;
        shot.time_ns = source.time_ns;
        put(source, stand, place.x_m, place.z_m, 1, shot);
        show(shot);
    });
}

/// A recorded person and the way they are carried, to and fro if they return.
struct Walker {
    const char* recording;
    float x_m, z_m, to_x_m, to_z_m;
    bool returns = false;
};

struct Crowd {
    const char* name;
    std::vector<Walker> people;
};

const std::vector<Crowd>& crowds() {
    static const std::vector<Crowd> all = {
        {"one", {{"s1_walking_1", 0.0f, -2.5f, 0.0f, -2.5f}}},
        {"three side by side",
         {{"s1_jogging_1", -0.85f, -2.4f, -0.85f, -2.4f},
          {"s5_front_clap_1", 0.0f, -2.75f, 0.0f, -2.75f},
          {"s6_walking_1", 0.85f, -2.4f, 0.85f, -2.4f}}},
        {"five in two rows",
         {{"s1_squat_1", -0.9f, -2.3f, -0.9f, -2.3f},
          {"s2_cross_arms_1", -0.45f, -2.9f, -0.45f, -2.9f},
          {"s5_walking_1", 0.0f, -2.3f, 0.0f, -2.3f},
          {"s6_swipe_left_1", 0.45f, -2.9f, 0.45f, -2.9f},
          {"s1_front_clap_1", 0.9f, -2.3f, 0.9f, -2.3f}}},
        {"two who cross",
         {{"s1_walking_1", -0.8f, -2.2f, 0.8f, -2.2f}, {"s2_walking_1", 0.8f, -2.8f, -0.8f, -2.8f}}},
        {"two who cross close by",
         {{"s5_walking_1", -0.8f, -2.4f, 0.8f, -2.4f}, {"s6_walking_1", 0.8f, -2.75f, -0.8f, -2.75f}}},
        {"two who meet and part",
         {{"s1_walking_1", -0.7f, -2.5f, -0.18f, -2.5f, true},
          {"s6_walking_1", 0.7f, -2.5f, 0.18f, -2.5f, true}}},
        {"one who leaves for a second and comes back",
         {{"s5_walking_1", 0.0f, -2.5f, 2.6f, -2.5f, true}, {"s2_walking_1", -0.7f, -2.7f, -0.7f, -2.7f}}},
    };
    return all;
}

constexpr uint32_t kCrowdFrames = 90;

/// Several recorded people before a Kinect v1 at its full size, in a room.
void play_crowd(const Crowd& crowd, const std::string& folder, const Show& show) {
    std::vector<Stand> stands;
    std::vector<std::vector<Shot>> recordings;
    for (const Walker& walker : crowd.people) {
        const std::string path = folder + "/kinect1_" + walker.recording;
        stands.push_back(stand_of(path));
        play_source(path,
                    [&, &shots = recordings.emplace_back()](const Shot& shot) { shots.push_back(shot); });
    }
    Camera camera = recordings[0][0].camera;
    camera.width *= 2, camera.height *= 2;
    camera.fx *= 2, camera.fy *= 2;
    camera.cx = 2 * camera.cx + 0.5f, camera.cy = 2 * camera.cy + 0.5f;
    set_floor(camera, 1.0f, 0.0f, 0.0f, VFIT_FLOOR_GIVEN);
    const Room room(camera, -3.8f);
    std::mt19937 random(1);
    for (uint32_t frame = 0; frame < kCrowdFrames; ++frame) {
        Shot shot;
        shot.camera = camera;
        shot.floor_known = true;
        shot.time_ns = int64_t(frame + 1) * kFrame_ns;
        room.render(shot.depth, random);
        shot.truth.assign(shot.depth.size(), 0);
        for (size_t i = 0; i < crowd.people.size(); ++i) {
            const Walker& w = crowd.people[i];
            float way = float(frame) / float(kCrowdFrames - 1);
            if (w.returns) way = 1.0f - std::abs(2.0f * way - 1.0f);
            const float x = w.x_m + way * (w.to_x_m - w.x_m), z = w.z_m + way * (w.to_z_m - w.z_m);
            // To and fro through the recording, so that nobody jumps.
            const auto length = uint32_t(recordings[i].size()), turn = frame % (2 * length);
            put(recordings[i][turn < length ? turn : 2 * length - 1 - turn], stands[i], x, z, uint8_t(i + 1),
                shot);
        }
        show(shot);
    }
}

/// The same seen by a camera that lies on its side: the picture turned clockwise.
Shot on_its_side(const Shot& shot) {
    Shot turned;
    turned.time_ns = shot.time_ns;
    turned.floor_known = shot.floor_known;
    Camera& c = turned.camera = shot.camera;
    const uint32_t width = shot.camera.width, height = shot.camera.height;
    c.width = height, c.height = width;
    c.fx = shot.camera.fy, c.fy = shot.camera.fx;
    c.cx = float(height - 1) - shot.camera.cy, c.cy = shot.camera.cx;
    const Vec3 n = shot.camera.floor_normal;
    c.floor_normal = Vec3(-n.y, n.x, n.z);
    turned.depth.resize(shot.depth.size());
    turned.truth.resize(shot.truth.size());
    for (uint32_t v = 0; v < height; ++v)
        for (uint32_t u = 0; u < width; ++u) {
            const size_t from = size_t(v) * width + u, to = size_t(u) * height + (height - 1 - v);
            turned.depth[to] = shot.depth[from];
            turned.truth[to] = shot.truth[from];
        }
    return turned;
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
        shot.time_ns += kFrame_ns;
        show(shot);
    }
}

Shot load_still(const std::string& path, float focal_px, float cx, float cy) {
    // A name of its own: two runs at a time must not share the folder.
    const fs::path folder =
        fs::temp_directory_path() / ("vfit-bench-still-" + std::to_string(std::random_device{}()));
    if (!fs::create_directory(folder)) throw Failure(folder.string() + ": is there already");
    fs::create_directory(folder / "depth");
    fs::copy_file(path, folder / "depth" / "000000.png");
    std::ofstream(folder / "camera.json") << Json{{"format", "vfit-recording"},
                                                  {"version", 1},
                                                  {"sensor", "kinect_v1"},
                                                  {"width", 640},
                                                  {"height", 480},
                                                  {"fx", focal_px},
                                                  {"fy", focal_px},
                                                  {"cx", cx},
                                                  {"cy", cy},
                                                  {"fps", 30},
                                                  {"depth_unit_m", 0.001},
                                                  {"segmented", false}};
    Shot still;
    play_source(folder.string(), [&](const Shot& shot) { still = shot; });
    fs::remove_all(folder);
    if (still.depth.empty()) throw Failure(path + ": holds no picture");
    return still;
}

SceneGroup virtual_scenes(uint32_t frames) {
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
        "motion=walk&distance=2.4&camera_height=2.2&tilt=30&sex=f&seed=12",
        "motion=wave&distance=2.5&camera_height=0.9&tilt=-30&seed=13",  // no floor in view
    };
    const char* const kOnItsSide[] = {
        "motion=scan&distance=2.1&seed=14",
        "motion=squat&distance=2.3&camera_height=2.2&tilt=30&sex=m&seed=15",
    };
    SceneGroup group{"virtual person (synthetic)", {}};
    for (const char* sensor : {"kinect_v1", "tof"}) {
        const auto uri = [&](const char* options) {
            return std::string("virtual:sensor=") + sensor + "&" + options +
                   "&frames=" + std::to_string(frames);
        };
        for (const char* options : kCases)
            group.scenes.push_back({std::string(sensor) + " " + options, true,
                                    [uri = uri(options)](const Show& show) { play_source(uri, show); }});
        for (const char* options : kOnItsSide)
            group.scenes.push_back({std::string(sensor) + " on its side " + options, true,
                                    [uri = uri(options)](const Show& show) {
                                        play_source(uri, [&](const Shot& shot) { show(on_its_side(shot)); });
                                    }});
    }
    return group;
}

std::vector<SceneGroup> real_scenes(const std::string& recordings, const std::string& still_path) {
    std::vector<fs::path> paths;
    for (const auto& entry : fs::directory_iterator(recordings))
        if (entry.is_directory()) paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    SceneGroup alone{"real people, alone", {}}, rooms{"real people, in virtual rooms", {}};
    for (const auto& path : paths) {
        const std::string name = path.filename().string(), uri = path.string();
        alone.scenes.push_back({"alone " + name, true, [uri](const Show& show) {
                                    play_source(uri, [&](const Shot& source) {
                                        Shot shot = source;
                                        for (size_t i = 0; i < shot.depth.size(); ++i)
                                            shot.truth[i] = shot.depth[i] != 0;
                                        shot.floor_known = false;
                                        show(shot);
                                    });
                                }});
        rooms.scenes.push_back({"room " + name, true, [uri](const Show& show) { play_in_room(uri, show); }});
    }
    std::vector<SceneGroup> groups = {std::move(alone), std::move(rooms)};
    if (fs::exists(still_path)) {
        const auto still = std::make_shared<Shot>(load_still(still_path, kStillFocal_px, kStillCx, kStillCy));
        still->camera.floor_normal = glm::normalize(kStillNormal);
        still->camera.floor_distance_m = kStillDistance_m;
        still->floor_known = true;
        for (const Place& place : kPlaces) {
            SceneGroup& group = groups.emplace_back();
            group.name = std::string("real people, in the still ") + place.means;
            for (const auto& path : paths)
                group.scenes.push_back({std::string("still, ") + place.name + " " + path.filename().string(),
                                        false, [uri = path.string(), still, &place](const Show& show) {
                                            play_in_still(uri, *still, place, show);
                                        }});
        }
    }
    SceneGroup& several = groups.emplace_back(SceneGroup{"real people, several in a virtual room", {}});
    for (const Crowd& crowd : crowds())
        several.scenes.push_back(
            {std::string("several, ") + crowd.name, crowd.people.size() == 1,
             [&crowd, recordings](const Show& show) { play_crowd(crowd, recordings, show); }});
    return groups;
}

}  // namespace vfit::tools
