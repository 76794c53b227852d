// vfit-bench user_map: how well people are found in bare depth images, and how fast. It runs sdk/track
// without the C ABI, as the user map is a step inside the tracker. Figures of virtual and of real people
// stand apart.
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
#include <numeric>
#include <set>

#include "bench/bench.h"
#include "bench/user_map_scenes.h"
#include "track/people_map.h"

namespace vfit::tools {

namespace {

constexpr float kJudgedTo_m = 3.0f;  // pixels with a reading up to there count
constexpr size_t kMostPeople = 8;
// Who is hidden but for this share of their largest view so far is not judged: nobody could say whose hand
// that is.
constexpr double kHiddenShare = 0.1;
constexpr float kFoot_m = 0.10f;  // pixels of the person below that height above the true floor

struct Options {
    std::string shared, only, pictures;
    uint32_t frames = 60;
    bool json = false;
};

/// Counts over a sequence; with several people in it, each of them counts in each image.
struct Figures {
    double iou_sum = 0.0, iou_worst = 1.0;
    uint32_t views = 0, missed = 0;                 // a person in an image, unless hidden; without a label
    std::array<size_t, kMostPeople + 1> largest{};  // view of each person so far, pixels
    size_t foot = 0, foot_found = 0, hit = 0, truth = 0, labelled = 0;
    std::map<int, std::set<int>> ids;       // labels of each person
    double floor_deg = 0.0, floor_m = 0.0;  // of the last frame
    bool floor_found = false;
    std::vector<double> ms;  // of each image

    double iou() const { return views ? iou_sum / views : 0.0; }
    double recall() const { return truth ? double(hit) / double(truth) : 0.0; }
    double precision() const { return labelled ? double(hit) / double(labelled) : 0.0; }
    double foot_recall() const { return foot ? double(foot_found) / double(foot) : 1.0; }
    bool id_changed() const {
        return std::any_of(ids.begin(), ids.end(),
                           [](const auto& person) { return person.second.size() > 1; });
    }
};

Samples samples(const std::vector<double>& ms) {
    Samples s;
    for (const double value : ms) s.add(value);
    return s;
}

/// Pixels of one person in one image: with a reading, and no farther than judged.
struct View {
    size_t hit = 0, truth = 0, labelled = 0;
    double iou() const { return double(hit) / double(truth + labelled - hit); }
};

/// The label that most of each person's readings have; 0: none has one.
std::array<uint8_t, kMostPeople + 1> labels_of_people(const Shot& shot, const std::vector<uint8_t>& users) {
    std::array<std::array<uint32_t, 256>, kMostPeople + 1> overlap{};
    for (size_t i = 0; i < users.size(); ++i)
        if (shot.truth[i] && shot.depth[i]) ++overlap[std::min<size_t>(shot.truth[i], kMostPeople)][users[i]];
    std::array<uint8_t, kMostPeople + 1> labels{};
    for (size_t k = 1; k <= kMostPeople; ++k) {
        const auto most = std::max_element(overlap[k].begin() + 1, overlap[k].end());
        labels[k] = *most ? uint8_t(most - overlap[k].begin()) : uint8_t(0);
    }
    return labels;
}

void judge(const Shot& shot, const std::vector<uint8_t>& users, bool alone, Figures& f) {
    const auto own = labels_of_people(shot, users);
    std::array<View, kMostPeople + 1> views{};
    std::array<size_t, 256> labelled{};
    const Mat3 world(shot.camera.world_from_camera());
    for (uint32_t y = 0; y < shot.camera.height; ++y)
        for (uint32_t x = 0; x < shot.camera.width; ++x) {
            const size_t i = size_t(y) * shot.camera.width + x;
            const float z = float(shot.depth[i]) * shot.camera.depth_unit_m;
            if (z <= 0.0f || z > kJudgedTo_m) continue;
            const size_t is = std::min<size_t>(shot.truth[i], kMostPeople);
            const bool found = users[i] != 0 && (alone || (is && users[i] == own[is]));
            if (is) ++views[is].truth, views[is].hit += found;
            ++labelled[users[i]];
            if (is && shot.floor_known &&
                (world * shot.camera.unproject(float(x), float(y), z)).y + shot.camera.floor_distance_m <
                    kFoot_m) {
                ++f.foot;
                f.foot_found += found;
            }
        }
    labelled[0] = 0;
    for (size_t k = 1; k <= kMostPeople; ++k) {
        View& v = views[k];
        v.labelled = labelled[own[k]];
        if (alone && k == 1) v.labelled = std::accumulate(labelled.begin(), labelled.end(), size_t(0));
        f.hit += v.hit;
        f.truth += v.truth;
        f.labelled += v.labelled;
        f.largest[k] = std::max(f.largest[k], v.truth);
        if (double(v.truth) <= kHiddenShare * double(f.largest[k])) continue;
        f.iou_sum += v.iou();
        f.iou_worst = std::min(f.iou_worst, v.iou());
        ++f.views;
        f.missed += v.hit == 0;
        if (own[k] && 2 * v.hit > v.truth) f.ids[int(k)].insert(own[k]);
    }
}

/// Depth in grey; the people of the truth where they are found in green (each a shade), where they are missed
/// in red, where others have their label in blue; people who are not judged in violet.
void write_picture(const std::string& path, const Shot& shot, const std::vector<uint8_t>& users,
                   const std::array<uint8_t, kMostPeople + 1>& own) {
    std::ofstream file(path, std::ios::binary);
    file << "P6\n" << shot.camera.width << " " << shot.camera.height << "\n255\n";
    for (size_t i = 0; i < shot.depth.size(); ++i) {
        const int d = shot.depth[i];
        const auto grey = uint8_t(d == 0 ? 0 : 30 + d / 8 % 128);
        uint8_t rgb[3] = {grey, grey, grey};
        const size_t is = std::min<size_t>(shot.truth[i], kMostPeople);
        if (is && d && users[i] && users[i] == own[is])
            rgb[0] = uint8_t(30 * (is - 1)), rgb[1] = 255;
        else if (is && d)
            rgb[0] = 255;
        else if (users[i] && std::find(own.begin() + 1, own.end(), users[i]) != own.end())
            rgb[2] = 255;
        else if (users[i])
            rgb[0] = uint8_t(60 + 40 * (users[i] % 5)), rgb[1] = 0,
            rgb[2] = uint8_t(120 + 60 * (users[i] % 3));
        file.write(reinterpret_cast<const char*>(rgb), 3);
    }
}

Figures play(const Scene& scene, const Options& o) {
    Figures f;
    PeopleMap map;
    std::vector<uint8_t> users;
    scene.play([&](const Shot& shot) {
        DepthImage image;
        image.depth = shot.depth.data();
        image.camera = shot.camera;
        image.camera.floor_state = VFIT_FLOOR_DEFAULT;
        image.camera.floor_normal = shot.camera.side_up();  // people tell (track/level.h)
        image.camera.floor_distance_m = 1.0f;
        users.resize(shot.depth.size());
        const std::clock_t start = std::clock();  // of the processor: other programs do not count
        map.run(image, shot.time_ns, users.data());
        f.ms.push_back(double(std::clock() - start) * 1e3 / CLOCKS_PER_SEC);

        judge(shot, users, scene.alone, f);
        f.floor_found = map.camera().floor_state == VFIT_FLOOR_ESTIMATED;
        if (f.floor_found && shot.floor_known) {
            const float cosine = glm::dot(map.camera().floor_normal, shot.camera.floor_normal);
            f.floor_deg = std::acos(std::min(1.0f, cosine)) * 180.0 / double(kPi);
            f.floor_m = std::abs(map.camera().floor_distance_m - shot.camera.floor_distance_m);
        }
        if (!o.pictures.empty() && f.ms.size() % 15 == 1) {
            std::string name = scene.name + "_" + std::to_string(f.ms.size());
            for (char& c : name)
                if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
            write_picture(o.pictures + "/" + name + ".ppm", shot, users, labels_of_people(shot, users));
        }
    });
    return f;
}

Json figures_json(const std::string& name, const Figures& f) {
    Json ids = Json::array();
    for (const auto& [person, labels] : f.ids) ids.push_back(labels.size());
    return {{"scene", name},
            {"views", f.views},
            {"iou", f.iou()},
            {"iou_worst_view", f.iou_worst},
            {"recall", f.recall()},
            {"precision", f.precision()},
            {"foot_recall", f.foot_recall()},
            {"views_missed", f.missed},
            {"ids_of_each_person", ids},
            {"floor_found", f.floor_found},
            {"floor_deg", f.floor_deg},
            {"floor_m", f.floor_m},
            {"ms", samples(f.ms).json()}};
}

void print(const std::string& name, const Figures& f) {
    std::cout << std::fixed << std::setprecision(3) << "IoU " << f.iou() << " worst " << f.iou_worst << "  R "
              << f.recall() << " P " << f.precision() << "  feet " << f.foot_recall() << "  ids";
    for (const auto& [person, labels] : f.ids) std::cout << " " << labels.size();
    if (f.missed) std::cout << "  missed " << f.missed;
    if (f.floor_found)
        std::cout << std::setprecision(1) << "  floor " << f.floor_deg << " deg " << f.floor_m * 100 << " cm";
    else
        std::cout << "  no floor";
    const Samples ms = samples(f.ms);
    std::cout << std::setprecision(2) << "  " << ms.quantile(0.5) << " ms (p95 " << ms.quantile(0.95) << ")  "
              << name << "\n";
}

/// Mean over sequences, worst sequence, pixels of feet, time of an image.
Json summary(const std::string& group, const std::vector<Figures>& all, bool json) {
    double sum = 0.0, worst = 1.0;
    size_t foot = 0, found = 0, ids = 0;
    Samples ms;
    for (const Figures& f : all) {
        sum += f.iou();
        worst = std::min(worst, f.iou());
        foot += f.foot;
        found += f.foot_found;
        ids += f.id_changed();
        for (const double value : f.ms) ms.add(value);
    }
    const double mean = sum / double(std::max<size_t>(1, all.size())),
                 feet = foot ? double(found) / double(foot) : 1.0;
    if (!json)
        std::cout << std::setprecision(3) << group << ": " << all.size() << " sequences, IoU mean " << mean
                  << ", worst " << worst << ", foot recall " << feet << ", sequences with a changed id "
                  << ids << ", " << std::setprecision(2) << ms.quantile(0.5) << " ms an image (p95 "
                  << ms.quantile(0.95) << ")\n\n";
    return {{"sequences", all.size()},          {"iou", mean},
            {"iou_worst_sequence", worst},      {"foot_recall", feet},
            {"sequences_with_changed_id", ids}, {"ms", ms.json()}};
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
        Json row = {{"picture", name},
                    {"people", people.size()},
                    {"first_frame_ms", ms},
                    {"floor_found", c.floor_state == VFIT_FLOOR_ESTIMATED},
                    {"floor", {c.floor_normal.x, c.floor_normal.y, c.floor_normal.z, c.floor_distance_m}}};
        if (!o.json) {
            std::cout << name << ": " << people.size() << " people, ";
            if (c.floor_state == VFIT_FLOOR_ESTIMATED)
                std::cout << std::setprecision(5) << "floor " << c.floor_normal.x << " " << c.floor_normal.y
                          << " " << c.floor_normal.z << " " << c.floor_distance_m << "\n";
            else
                std::cout << "no floor\n";
        }
        for (const PersonRegion& r : people) {
            row["regions"].push_back({{"id", r.id},
                                      {"box", {r.box.x0, r.box.y0, r.box.x1, r.box.y1}},
                                      {"height_m", r.height_m},
                                      {"width_m", r.width_m},
                                      {"pixels", r.pixels},
                                      {"out_of_view", r.out_of_view}});
            if (!o.json)
                std::cout << "  id " << r.id << " box " << r.box.x0 << "," << r.box.y0 << ".." << r.box.x1
                          << "," << r.box.y1 << std::setprecision(2) << " height " << r.height_m
                          << " m width " << r.width_m << " m pixels " << r.pixels << " out of view "
                          << r.out_of_view << " at " << r.centre.x << " " << r.centre.z << "\n";
        }
        if (!o.pictures.empty()) write_picture(o.pictures + "/" + name + ".ppm", shot, users, {});
        rows.push_back(row);
    }
    return rows;
}

void run(const Options& o) {
    pin_to_cores(1);
    Json report;
    const auto judge_group = [&](const SceneGroup& group) {
        std::vector<Figures> all;
        Json rows = Json::array();
        for (const Scene& scene : group.scenes) {
            if (scene.name.find(o.only) == std::string::npos) continue;
            all.push_back(play(scene, o));
            rows.push_back(figures_json(scene.name, all.back()));
            if (!o.json) print(scene.name, all.back());
        }
        if (!all.empty())
            report[group.name] = {{"summary", summary(group.name, all, o.json)}, {"scenes", rows}};
    };
    judge_group(virtual_scenes(o.frames));
    if (!o.shared.empty()) {
        const std::string scenes = o.shared + "/data/scenes";
        for (const SceneGroup& group :
             real_scenes(o.shared + "/data/recordings", scenes + "/five_people_depth_mm.png"))
            judge_group(group);
        if (o.only.empty() || o.only == "pictures") report["real pictures"] = stills(scenes, o);
    }
    if (o.json) std::cout << report.dump(2) << "\n";
}

}  // namespace

void add_user_map(Command& app) {
    Command command = app.add_subcommand("user_map", "User map: overlap with the truth, feet, floor, time");
    auto o = std::make_shared<Options>();
    command.add_option("shared", o->shared,
                       "Folder with data/recordings and data/scenes: judges real people too");
    command.add_option("--frames", o->frames, "Images of each virtual sequence");
    command.add_option("--only", o->only, "Scenes whose name contains this");
    command.add_option("--pictures", o->pictures, "Write every 15th image there, truth and error in colour");
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] { run(*o); });
}

}  // namespace vfit::tools
