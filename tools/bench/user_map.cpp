// vfit-bench user_map: how well people are found in bare depth images, and how fast. It runs sdk/track without the
// C ABI, as the user map is a step inside the tracker. Figures of virtual and of real people stand apart.
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>
#include <set>

#include "bench/bench.h"
#include "bench/user_map_scenes.h"
#include "track/people_map.h"

namespace vfit::tools {

namespace {

constexpr float kJudgedTo_m = 3.0f;  // pixels with a reading up to there count
constexpr float kFoot_m = 0.10f;     // pixels of the person below that height above the true floor

struct Options {
    std::string shared, only, pictures;
    uint32_t frames = 60;
    bool json = false;
};

/// Counts of pixels over a sequence.
struct Figures {
    double iou_sum = 0.0, iou_worst = 1.0;
    uint32_t frames = 0, missed = 0;
    size_t foot = 0, foot_found = 0, hit = 0, truth = 0, labelled = 0;
    std::set<uint8_t> ids;
    double floor_deg = 0.0, floor_m = 0.0;  // of the last frame
    bool floor_found = false;
    Samples ms;

    double iou() const { return frames ? iou_sum / frames : 0.0; }
    double recall() const { return truth ? double(hit) / double(truth) : 0.0; }
    double precision() const { return labelled ? double(hit) / double(labelled) : 0.0; }
    double foot_recall() const { return foot ? double(foot_found) / double(foot) : 1.0; }
};

/// Depth in grey; found green, missed red, wrong blue.
void write_picture(const std::string& path, const Shot& shot, const std::vector<uint8_t>& users, uint8_t own) {
    std::ofstream file(path, std::ios::binary);
    file << "P6\n" << shot.camera.width << " " << shot.camera.height << "\n255\n";
    for (size_t i = 0; i < shot.depth.size(); ++i) {
        const int d = shot.depth[i];
        const auto grey = uint8_t(d == 0 ? 0 : 30 + d / 8 % 128);
        uint8_t rgb[3] = {grey, grey, grey};
        if (users[i] && (own == 0 || users[i] == own) && shot.truth[i]) rgb[1] = 255;
        else if (users[i] && (own == 0 || users[i] == own)) rgb[2] = 255;
        else if (shot.truth[i] && d) rgb[0] = 255;
        else if (users[i]) rgb[2] = uint8_t(120 + 20 * users[i]), rgb[0] = 100;
        file.write(reinterpret_cast<const char*>(rgb), 3);
    }
}

Figures judge(const Scene& scene, const Options& o) {
    Figures f;
    PeopleMap map;
    std::vector<uint8_t> users;
    scene.play([&](const Shot& shot) {
        DepthImage image;
        image.depth = shot.depth.data();
        image.camera = shot.camera;
        image.camera.floor_state = VFIT_FLOOR_DEFAULT;
        image.camera.floor_normal = Vec3(0, -1, 0);
        image.camera.floor_distance_m = 1.0f;
        users.resize(shot.depth.size());
        const std::clock_t start = std::clock();  // of the processor: other programs do not count
        map.run(image, shot.time_ns, users.data());
        f.ms.add(double(std::clock() - start) * 1e3 / CLOCKS_PER_SEC);

        std::array<size_t, 256> overlap{};
        for (size_t i = 0; i < users.size(); ++i)
            if (shot.truth[i] && shot.depth[i]) ++overlap[users[i]];
        const auto own = uint8_t(std::max_element(overlap.begin() + 1, overlap.end()) - overlap.begin());
        size_t hit = 0, truth = 0, labelled = 0;
        const Mat3 world(shot.camera.world_from_camera());
        for (uint32_t y = 0; y < shot.camera.height; ++y)
            for (uint32_t x = 0; x < shot.camera.width; ++x) {
                const size_t i = size_t(y) * shot.camera.width + x;
                const float z = float(shot.depth[i]) * shot.camera.depth_unit_m;
                if (z <= 0.0f || z > kJudgedTo_m) continue;
                const bool is = shot.truth[i] != 0, found = scene.alone ? users[i] != 0 : users[i] == own;
                hit += is && found;
                truth += is;
                labelled += found;
                if (is && shot.floor_known &&
                    (world * shot.camera.unproject(float(x), float(y), z)).y + shot.camera.floor_distance_m < kFoot_m) {
                    ++f.foot;
                    f.foot_found += found;
                }
            }
        if (truth > 0) {
            const double iou = double(hit) / double(truth + labelled - hit);
            f.iou_sum += iou;
            f.iou_worst = std::min(f.iou_worst, iou);
            ++f.frames;
            f.missed += hit == 0;
            if (overlap[own] > 0) f.ids.insert(own);
        }
        f.hit += hit;
        f.truth += truth;
        f.labelled += labelled;
        f.floor_found = map.camera().floor_state == VFIT_FLOOR_ESTIMATED;
        if (f.floor_found && shot.floor_known) {
            const float cosine = glm::dot(map.camera().floor_normal, shot.camera.floor_normal);
            f.floor_deg = std::acos(std::min(1.0f, cosine)) * 180.0 / double(kPi);
            f.floor_m = std::abs(map.camera().floor_distance_m - shot.camera.floor_distance_m);
        }
        if (!o.pictures.empty() && f.frames % 15 == 1) {
            std::string name = scene.name + "_" + std::to_string(f.frames);
            for (char& c : name)
                if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
            write_picture(o.pictures + "/" + name + ".ppm", shot, users, scene.alone ? 0 : own);
        }
    });
    return f;
}

Json figures_json(const std::string& name, const Figures& f) {
    return {{"scene", name}, {"frames", f.frames}, {"iou", f.iou()}, {"iou_worst_frame", f.iou_worst},
            {"recall", f.recall()}, {"precision", f.precision()}, {"foot_recall", f.foot_recall()},
            {"frames_missed", f.missed}, {"ids", f.ids.size()}, {"floor_found", f.floor_found},
            {"floor_deg", f.floor_deg}, {"floor_m", f.floor_m}, {"ms", f.ms.json()}};
}

void print(const std::string& name, const Figures& f) {
    std::cout << std::fixed << std::setprecision(3) << "IoU " << f.iou() << " worst " << f.iou_worst << "  R "
              << f.recall() << " P " << f.precision() << "  feet " << f.foot_recall() << "  ids " << f.ids.size();
    if (f.floor_found)
        std::cout << std::setprecision(1) << "  floor " << f.floor_deg << " deg " << f.floor_m * 100 << " cm";
    else
        std::cout << "  no floor";
    std::cout << std::setprecision(2) << "  " << f.ms.quantile(0.5) << " ms (p95 " << f.ms.quantile(0.95) << ")  " << name
              << "\n";
}

/// Mean over sequences, worst sequence, pixels of feet, time.
Json summary(const std::string& group, const std::vector<Figures>& all, bool json) {
    double sum = 0.0, worst = 1.0;
    size_t foot = 0, found = 0, ids = 0;
    Samples ms;
    for (const Figures& f : all) {
        sum += f.iou();
        worst = std::min(worst, f.iou());
        foot += f.foot;
        found += f.foot_found;
        ids += f.ids.size() > 1;
        ms.add(f.ms.quantile(0.5));
    }
    const double mean = sum / double(std::max<size_t>(1, all.size())), feet = foot ? double(found) / double(foot) : 1.0;
    if (!json)
        std::cout << std::setprecision(3) << group << ": " << all.size() << " sequences, IoU mean " << mean << ", worst "
                  << worst << ", foot recall " << feet << ", sequences with a changed id " << ids << ", "
                  << std::setprecision(2) << ms.quantile(0.5) << " ms\n\n";
    return {{"sequences", all.size()}, {"iou", mean}, {"iou_worst_sequence", worst}, {"foot_recall", feet},
            {"sequences_with_changed_id", ids}, {"ms", ms.quantile(0.5)}};
}

Json stills(const std::string& folder, const Options& o) {
    Json rows = Json::array();
    for (const char* name : {"five_people_depth_mm", "person_depth_mm"}) {
        Shot shot = load_still(folder + "/" + name + ".png", 525.0f, 319.5f, 239.5f);
        DepthImage image;
        image.depth = shot.depth.data();
        image.camera = shot.camera;
        image.camera.floor_state = VFIT_FLOOR_DEFAULT;
        std::vector<uint8_t> users(shot.depth.size());
        PeopleMap map;
        const Timer timer;
        const auto people = map.run(image, 1, users.data());
        const double ms = timer.ms();
        const Camera& c = map.camera();
        Json row = {{"picture", name}, {"people", people.size()}, {"first_frame_ms", ms},
                    {"floor_found", c.floor_state == VFIT_FLOOR_ESTIMATED},
                    {"floor", {c.floor_normal.x, c.floor_normal.y, c.floor_normal.z, c.floor_distance_m}}};
        if (!o.json) {
            std::cout << name << ": " << people.size() << " people, ";
            if (c.floor_state == VFIT_FLOOR_ESTIMATED)
                std::cout << std::setprecision(5) << "floor " << c.floor_normal.x << " " << c.floor_normal.y << " "
                          << c.floor_normal.z << " " << c.floor_distance_m << "\n";
            else
                std::cout << "no floor\n";
        }
        for (const PersonRegion& r : people) {
            row["regions"].push_back({{"id", r.id}, {"box", {r.box.x0, r.box.y0, r.box.x1, r.box.y1}},
                                      {"height_m", r.height_m}, {"width_m", r.width_m}, {"pixels", r.pixels},
                                      {"out_of_view", r.out_of_view}});
            if (!o.json)
                std::cout << "  id " << r.id << " box " << r.box.x0 << "," << r.box.y0 << ".." << r.box.x1 << ","
                          << r.box.y1 << std::setprecision(2) << " height " << r.height_m << " m width " << r.width_m
                          << " m pixels " << r.pixels << " out of view " << r.out_of_view << " at " << r.centre.x << " "
                          << r.centre.z << "\n";
        }
        if (!o.pictures.empty()) write_picture(o.pictures + "/" + name + ".ppm", shot, users, 255);
        rows.push_back(row);
    }
    return rows;
}

void run(const Options& o) {
    pin_to_cores(1);
    Json report;
    const auto group = [&](const std::string& name, const std::vector<Scene>& scenes) {
        std::vector<Figures> all;
        Json rows = Json::array();
        for (const Scene& scene : scenes) {
            if (scene.name.find(o.only) == std::string::npos) continue;
            all.push_back(judge(scene, o));
            rows.push_back(figures_json(scene.name, all.back()));
            if (!o.json) print(scene.name, all.back());
        }
        if (!all.empty()) report[name] = {{"summary", summary(name, all, o.json)}, {"scenes", rows}};
    };
    group("virtual person (synthetic)", virtual_scenes(o.frames));
    if (!o.shared.empty()) {
        const std::string scenes = o.shared + "/data/scenes";
        std::vector<Scene> all = real_scenes(o.shared + "/data/recordings", scenes + "/five_people_depth_mm.png");
        for (const char* kind : {"alone", "room", "still"}) {
            std::vector<Scene> some;
            for (const Scene& s : all)
                if (s.name.rfind(kind, 0) == 0) some.push_back(s);
            group(std::string("real people, ") + kind, some);
        }
        if (o.only.empty() || o.only == "pictures") report["real pictures"] = stills(scenes, o);
    }
    if (o.json) std::cout << report.dump(2) << "\n";
}

}  // namespace

void add_user_map(Command& app) {
    Command command = app.add_subcommand("user_map", "User map: overlap with the truth, feet, floor, time");
    auto o = std::make_shared<Options>();
    command.add_option("shared", o->shared, "Folder with data/recordings and data/scenes: judges real people too");
    command.add_option("--frames", o->frames, "Images of each virtual sequence");
    command.add_option("--only", o->only, "Scenes whose name contains this");
    command.add_option("--pictures", o->pictures, "Write every 15th image there, truth and error in colour");
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] { run(*o); });
}

}  // namespace vfit::tools
