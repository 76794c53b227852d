// vfit-bench garments: every garment in every size on bodies of several kinds, at rest and when it is changed
// (synthetic).
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <random>

#include "bench/bench.h"
#include "bench/garment_ease.h"
#include "bench/garment_jumps.h"
#include "bench/garment_pushed.h"
#include "bench/garment_recordings.h"
#include "bench/targets.h"
#include "bench/welded.h"
#include "client/assets.h"
#include "client/files.h"
#include "client/output.h"
#include "cloth/crossings.h"
#include "picture/contact_sheet.h"
#include "picture/dressed_picture.h"

namespace vfit::tools {

namespace {

constexpr float kFrame_s = 1.0f / 60.0f, kThickness_m = 0.004f;
constexpr int kFramesToRest = 90;

struct Options {
    std::string garment, size, body, folder, pictures;
    int random = 0;  // bodies; 0: those of kBodies
    bool json = false, quick = false;
};

struct BodyKind {
    std::string name;
    vfit_sex sex;
    std::vector<std::pair<const char*, float>> shape;
};
const std::vector<BodyKind> kBodies = {
    {"woman", VFIT_SEX_FEMALE, {}},
    {"man", VFIT_SEX_MALE, {}},
    {"very tall man", VFIT_SEX_MALE, {{"height", 0.72f}}},
    {"heavy woman", VFIT_SEX_FEMALE, {{"weight", 1.15f}, {"muscle", 0.4f}}},
    {"small woman", VFIT_SEX_FEMALE, {{"height", 0.28f}, {"weight", 0.35f}}},
};

/// Always the same for a number.
std::vector<BodyKind> random_bodies(int count) {
    std::vector<BodyKind> out;
    std::mt19937 random(1);
    const auto between = [&](float low, float high) {
        return low + (high - low) * float(random()) / float(std::mt19937::max());
    };
    for (int i = 0; i < count; ++i) {
        BodyKind kind{"random " + std::to_string(i + 1), i % 2 ? VFIT_SEX_MALE : VFIT_SEX_FEMALE, {}};
        kind.shape = {{"height", between(0.28f, 0.72f)},
                      {"weight", between(0.3f, 1.15f)},
                      {"muscle", between(0.3f, 0.8f)}};
        out.push_back(std::move(kind));
    }
    return out;
}

Avatar make_body(vfit_context context, const BodyKind& kind) {
    vfit_avatar_desc desc = vfit_avatar_desc_init();
    desc.sex = kind.sex;
    std::vector<vfit_shape_value> shape;
    for (const auto& [key, value] : kind.shape) {
        vfit_shape_value v = vfit_shape_value_init();
        std::snprintf(v.key, sizeof v.key, "%s", key);
        v.value = value;
        shape.push_back(v);
    }
    Avatar avatar;
    check(vfit_avatar_create_from_shape(context, &desc, shape.data(), sizeof(vfit_shape_value),
                                        uint32_t(shape.size()), avatar.out()));
    stand(avatar.get(), 0.1f);
    return avatar;
}

std::vector<Vec3> places(vfit_cloth cloth) {
    Frame frame;
    check(vfit_cloth_acquire(cloth, frame.out()));
    return items_of<Vec3>(frame.get(), VFIT_STREAM_POSITION);
}

void settle(vfit_cloth cloth, int frames) {
    for (int i = 0; i < frames; ++i) check(vfit_cloth_step(cloth, kFrame_s));
}

/// Of what touches the skin, in millimetres beyond the thickness, the median.
double gap_mm(vfit_cloth cloth, const Welded& skin) {
    Frame frame;
    check(vfit_cloth_acquire(cloth, frame.out()));
    const auto positions = items_of<Vec3>(frame.get(), VFIT_STREAM_POSITION);
    const auto pressure = items_of<float>(frame.get(), VFIT_STREAM_PRESSURE);
    const MeshQuery query = query_of(skin);
    Samples gaps;
    for (size_t i = 0; i < positions.size(); ++i)
        if (pressure[i] > 0.0f) gaps.add(1e3 * double(query.signed_distance(positions[i]) - kThickness_m));
    return gaps.quantile(0.5);
}

std::vector<vfit_fit_zone> fit_of(vfit_cloth cloth) {
    return list<vfit_fit_zone>(
        [&](auto* items, uint32_t stride, uint32_t* n) { return vfit_cloth_fit(cloth, items, stride, n); });
}

/// What crosses in a frame, and how far it is stretched.
struct Look {
    size_t with_skin, with_self;
    float strain_p99;
};
Look look_at(vfit_cloth cloth, const Welded& skin) {
    const Welded mesh = mesh_of(cloth);
    vfit_cloth_stats stats = vfit_cloth_stats_init();
    check(vfit_cloth_describe(cloth, &stats));
    return {crossed_triangles({mesh.positions, mesh.indices}, {skin.positions, skin.indices}).size(),
            crossed_triangles(mesh.positions, mesh.indices).size(), stats.strain_p99};
}
/// With the skin as it is drawn below the cloth.
uint32_t crossings_drawn(vfit_cloth cloth) {
    Frame frame;
    uint32_t crossings = 0;
    check(vfit_outfit_skin(&cloth, 1, frame.out(), &crossings));
    return crossings;
}

/// First frames: of garments that were put on, or changed to another size.
struct FirstFrames {
    size_t with_skin = 0, with_drawn = 0, with_self = 0;
    Samples ms, strain_p99;

    void add(double took_ms, vfit_cloth cloth, const Welded& skin) {
        const Look look = look_at(cloth, skin);
        ms.add(took_ms), strain_p99.add(look.strain_p99);
        with_skin += look.with_skin > 0, with_self += look.with_self > 0;
        with_drawn += crossings_drawn(cloth) > 0;
    }
    void judge(const std::string& what, double target_ms, Targets& targets) const {
        targets.judge(what + ": to the first frame, median", ms.quantile(0.5), Aim::at_most, target_ms, 0,
                      " ms");
        targets.judge("  the same, 95 %", ms.quantile(0.95), Aim::at_most, target_ms, 0, " ms");
        targets.judge("  first frames, of " + std::to_string(ms.size()) +
                          ", that cross the skin as vfit_outfit_skin() draws it",
                      double(with_drawn), Aim::exactly, 0.0);
        targets.judge("  that cross the skin as it is posed", double(with_skin), Aim::exactly, 0.0);
        targets.judge("  that cross themselves", double(with_self), Aim::exactly, 0.0);
        targets.judge("  strain p99 in them, worst", strain_p99.quantile(1.0), Aim::at_most, 0.3, 2);
    }
};

struct Tally {
    size_t worn = 0, refused = 0, with_skin = 0, with_self = 0;
    size_t skin_crossings = 0, self_crossings = 0;
    FirstFrames dressed, resized;
    Samples gaps_mm, moving_mm, step_ms;
    std::vector<std::string> crossed;
};

class GarmentJudge {
public:
    explicit GarmentJudge(const Options& options) : options_(options) {}

    Json wear(vfit_avatar avatar, const std::string& body_name, const Welded& skin, vfit_garment garment,
              const std::string& name, const std::vector<std::string>& labels) {
        Json rows = Json::array();
        for (const std::string& label : labels) {
            Json row = {{"garment", name}, {"body", body_name}, {"size", label}};
            vfit_cloth_desc desc = vfit_cloth_desc_init();
            desc.flags = VFIT_CLOTH_SKIN | VFIT_CLOTH_PRESSURE;
            desc.self_thickness_m = kThickness_m;
            desc.size_label = label.empty() ? nullptr : label.c_str();
            Cloth cloth;
            const Timer timer;
            const vfit_result made = vfit_cloth_create(avatar, garment, &desc, cloth.out());
            if (made == VFIT_ERROR_NOT_WEARABLE) {
                row["not_wearable"] = last_error();
                ++tally_.refused;
                say(row);
                rows.push_back(std::move(row));
                continue;
            }
            check(made);
            check(vfit_cloth_step(cloth.get(), kFrame_s));
            row["dress_ms"] = timer.ms();
            tally_.dressed.add(row["dress_ms"], cloth.get(), skin);
            judge(cloth.get(), skin, row);
            if (!options_.pictures.empty()) draw(avatar, cloth.get(), skin, row);
            say(row);
            rows.push_back(std::move(row));
        }
        return rows;
    }

    /// From each size to the next, on one cloth.
    void change_sizes(vfit_avatar avatar, const Welded& skin, vfit_garment garment,
                      const std::vector<std::string>& labels) {
        vfit_cloth_desc desc = vfit_cloth_desc_init();
        desc.flags = VFIT_CLOTH_SKIN | VFIT_CLOTH_ANY_FIT;
        desc.self_thickness_m = kThickness_m;
        desc.size_label = labels.back().c_str();
        Cloth cloth;
        check(vfit_cloth_create(avatar, garment, &desc, cloth.out()));
        settle(cloth.get(), 30);
        for (const std::string& label : labels) {
            const Timer timer;
            check(vfit_cloth_set_size(cloth.get(), label.c_str()));
            check(vfit_cloth_step(cloth.get(), kFrame_s));
            tally_.resized.add(timer.ms(), cloth.get(), skin);
            settle(cloth.get(), 59);
            const auto before = places(cloth.get());
            settle(cloth.get(), 1);
            tally_.moving_mm.add(ways_mm(before, places(cloth.get())));
        }
    }

    const Tally& tally() const { return tally_; }

    void write_sheet(const std::string& body_name) {
        if (pictures_.empty()) return;
        std::string file = "/" + body_name + ".png";
        std::replace(file.begin(), file.end(), ' ', '_');
        std::vector<std::vector<SheetItem>> rows(1);
        for (SheetItem& item : pictures_) {
            if (rows.back().size() == 8) rows.emplace_back();
            rows.back().push_back(std::move(item));
        }
        contact_sheet("on the " + body_name + "; black: crosses the skin, blue: itself", rows, kStyle.width)
            .write_png(options_.pictures + file);
        pictures_.clear();
    }

private:
    void judge(vfit_cloth cloth, const Welded& skin, Json& row) {
        settle(cloth, kFramesToRest);
        const Look look = look_at(cloth, skin);
        vfit_cloth_stats stats = vfit_cloth_stats_init();
        check(vfit_cloth_describe(cloth, &stats));
        row["skin_crossings"] = look.with_skin;
        row["self_crossings"] = look.with_self;
        row["gap_mm"] = gap_mm(cloth, skin);
        row["strain_p99"] = look.strain_p99;
        row["step_ms"] = stats.step_ms;
        Json zones = Json::object();
        for (const vfit_fit_zone& z : fit_of(cloth))
            zones[z.key] = {{"fit", z.fit == VFIT_FIT_TIGHT   ? "tight"
                                    : z.fit == VFIT_FIT_LOOSE ? "loose"
                                                              : "right"},
                            {"body_m", z.body_m},
                            {"garment_m", z.garment_m},
                            {"ease_m", z.ease_m},
                            {"strain", z.strain},
                            {"pressure_pa", z.pressure_pa}};
        row["fit"] = zones;
        ++tally_.worn;
        tally_.with_skin += look.with_skin > 0, tally_.with_self += look.with_self > 0;
        tally_.skin_crossings += look.with_skin, tally_.self_crossings += look.with_self;
        tally_.gaps_mm.add(row["gap_mm"].get<double>());
        tally_.step_ms.add(stats.step_ms);
    }

    void say(const Json& row) const {
        if (options_.json) return;
        std::cout << std::left << std::setw(18) << row["garment"].get<std::string>() << std::setw(15)
                  << row["body"].get<std::string>() << std::setw(5)
                  << (row["size"].get<std::string>().empty() ? "made" : row["size"].get<std::string>())
                  << std::right;
        if (row.contains("not_wearable")) {
            std::cout << "  " << row["not_wearable"].get<std::string>() << std::endl;
            return;
        }
        std::cout << std::fixed << std::setprecision(0) << " skin " << std::setw(4)
                  << row["skin_crossings"].get<int>() << " self " << std::setw(4)
                  << row["self_crossings"].get<int>() << std::setprecision(1) << "  gap "
                  << row["gap_mm"].get<double>() << " mm  strain p99 "
                  << 100.0 * row["strain_p99"].get<double>() << " %  dress " << row["dress_ms"].get<double>()
                  << " ms ";
        for (const auto& [key, zone] : row["fit"].items())
            std::cout << " " << key.substr(0, key.find('_')) << " " << zone["fit"].get<std::string>() << " ("
                      << 100.0 * zone["ease_m"].get<double>() << ")";
        std::cout << std::endl;
    }

    void draw(vfit_avatar avatar, vfit_cloth cloth, const Welded& skin, const Json& row) {
        std::vector<RenderMesh> meshes = dressed_meshes(avatar, std::array{DrawnCloth{cloth}});
        Frame frame;
        check(vfit_avatar_acquire(avatar, frame.out()));
        meshes[0].indices =
            items_of<uint32_t>(frame.get(), VFIT_STREAM_INDEX);  // skin that shines through is to be seen
        RenderMesh& garment = meshes[1];
        garment.vertex_colors.assign(garment.positions.size(), garment.color);
        for (const auto& [triangle, other] :
             crossed_triangles({garment.positions, garment.indices}, {skin.positions, skin.indices}))
            for (size_t k = 0; k < 3; ++k)
                garment.vertex_colors[garment.indices[3 * triangle + k]] = {0.0f, 0.0f, 0.0f};
        const Welded welded = mesh_of(cloth);
        for (const auto& [a, b] :
             crossed_triangles(welded.positions, welded.indices))  // the triangles are in the same order
            for (const uint32_t t : {a, b})
                for (size_t k = 0; k < 3; ++k)
                    garment.vertex_colors[garment.indices[3 * t + k]] = {0.1f, 0.2f, 0.9f};
        const std::string caption =
            row["garment"].get<std::string>() + " " +
            (row["size"].get<std::string>().empty() ? "made" : row["size"].get<std::string>());
        for (const float yaw : {0.35f, 3.5f})
            pictures_.push_back({draw_dressed(meshes, centre_of(meshes[0]), yaw, kStyle), caption});
    }

    static constexpr PortraitStyle kStyle{300, 450, 1};
    const Options& options_;
    Tally tally_;
    std::vector<SheetItem> pictures_;
};

void say_body(vfit_avatar avatar, const char* name) {
    std::cout << name << ":";
    for (const auto& m : list<vfit_measurement>([&](auto* items, uint32_t stride, uint32_t* n) {
             return vfit_avatar_measure(avatar, items, stride, n);
         }))
        for (const char* key : {"stature_m", "chest_girth_m", "waist_girth_m", "hip_girth_m"})
            if (std::string(m.key) == key)
                std::cout << " " << key << " " << std::fixed << std::setprecision(3) << m.value;
    std::cout << std::endl;
}

std::vector<std::string> labels_of(vfit_garment garment) {
    vfit_garment_info info = vfit_garment_info_init();
    check(vfit_garment_describe(garment, &info));
    std::vector<std::string> labels;
    for (uint32_t i = 0; i < info.size_count; ++i) {
        char text[64];
        vfit_garment_size_label(garment, i, text, sizeof text);
        labels.emplace_back(text);
    }
    return labels;
}

void judge_garments(const Options& options) {
    const Context context = open_context();
    const std::string folder = options.folder.empty() ? library_file("vfit_data/garments") : options.folder;
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".json" && entry.path().stem() != "report" &&
            (options.garment.empty() || entry.path().stem() == options.garment))
            files.push_back(entry.path().string());
    std::sort(files.begin(), files.end());
    if (files.empty()) throw Failure("there is no garment " + options.garment + " in " + folder);

    if (!options.pictures.empty()) create_folder(options.pictures);
    GarmentJudge judge(options);
    Json rows = Json::array();
    if (options.random < 0 || options.random > 1000) throw Failure("--random: 1 to 1000 bodies");
    const std::vector<BodyKind> bodies = options.random ? random_bodies(options.random) : kBodies;
    if (!options.body.empty() && std::none_of(bodies.begin(), bodies.end(), [&](const BodyKind& kind) {
            return kind.name == options.body;
        }))
        throw Failure("there is no body " + options.body);
    for (const BodyKind& kind : bodies) {
        if (!options.body.empty() && options.body != kind.name) continue;
        const Avatar avatar = make_body(context.get(), kind);
        const Welded skin = mesh_of(avatar.get());
        if (!options.json) say_body(avatar.get(), kind.name.c_str());
        for (const std::string& file : files) {
            const Garment garment = open_garment(context.get(), file);
            const std::string name = std::filesystem::path(file).stem().string();
            std::vector<std::string> labels = labels_of(garment.get());
            if (options.quick && labels.size() > 1) labels = {labels[labels.size() / 2 - 1]};
            labels.emplace_back();  // made to measure
            if (!options.size.empty()) labels = {options.size};
            for (Json& row : judge.wear(avatar.get(), kind.name, skin, garment.get(), name, labels))
                rows.push_back(std::move(row));
            if (kind.shape.empty() && labels.size() > 1)
                judge.change_sizes(avatar.get(), skin, garment.get(), labels_of(garment.get()));
        }
        judge.write_sheet(kind.name);
    }

    const Tally& tally = judge.tally();
    Targets targets(options.json);
    if (!options.json)
        std::cout << "\n" << tally.worn << " worn, " << tally.refused << " not wearable in that size\n";
    targets.judge("drapes with a triangle that crosses the skin", double(tally.with_skin), Aim::exactly, 0.0);
    targets.judge("drapes that cross themselves", double(tally.with_self), Aim::exactly, 0.0);
    targets.judge("gap beyond the thickness where it touches, worst median", tally.gaps_mm.quantile(1.0),
                  Aim::at_most, 3.0, 1, " mm");
    tally.dressed.judge("garment put on", 50.0, targets);
    if (!tally.moving_mm.empty()) {
        tally.resized.judge("size changed", 30.0, targets);
        targets.judge("moving a second later, a frame, 99 of 100 vertices, 95 %",
                      tally.moving_mm.quantile(0.95), Aim::at_most, 1.0, 2, " mm");
    }
    const Json ease = judge_ease(context.get(), options.json, targets);
    if (options.json)
        print_document({{"rows", rows},
                        {"ease", ease},
                        {"targets", targets.json()},
                        {"worn", tally.worn},
                        {"not_wearable", tally.refused},
                        {"skin_crossings", tally.skin_crossings},
                        {"self_crossings", tally.self_crossings},
                        {"dress_ms", tally.dressed.ms.json()},
                        {"size_ms", tally.resized.ms.json()},
                        {"step_ms", tally.step_ms.json()},
                        {"gap_mm", tally.gaps_mm.json()}});
}

}  // namespace

void add_garments(Command& app) {
    Command command =
        app.add_subcommand("garments", "Judge garments in all sizes on bodies of several kinds (synthetic)");
    auto o = std::make_shared<Options>();
    auto real = std::make_shared<RecordingsOptions>();
    command.add_option("--recordings", real->folder,
                       "Folder of recordings of people: judge garments, made to measure, on their motion");
    command.add_option("--recording", real->recording, "With --recordings: those whose name holds this");
    command.add_flag("--own-tracker", real->own_tracker,
                     "With --recordings: joints by vfit instead of the recording's");
    command.add_flag("--hands,!--no-hands", real->hands,
                     "With --recordings: hands push the garments (default)");
    command.add_flag("--props", real->props,
                     "With --recordings: a scabbard at the hip, a backpack, and a ball that circles");
    command.add_option("--substeps", real->substeps, "With --recordings: sub-steps per 1/60 s")
        .within(1, 256);
    auto jumps = std::make_shared<JumpsOptions>();
    auto with_jumps = std::make_shared<bool>(false);
    command.add_flag("--jumps", *with_jumps,
                     "Judge garments on a body that jumps, turns or moves a limb within one step");
    command.add_flag("--all", jumps->all, "With --jumps: a line for each case");
    command.add_option("--inertia", jumps->inertia, "With --jumps: of the cloth");
    command.add_option("--carry-speed", jumps->carry_speed_m_s,
                       "With --jumps, --recordings: in m/s, what is faster is a jump; below 0: no limit");
    command.add_option(
        "--carry-way", jumps->carry_way_m,
        "With --jumps, --recordings: in metres, what goes further in a step is a jump; below 0: no limit");
    command.add_flag("--spheres", jumps->spheres,
                     "With --jumps: on spheres and capsules instead of the skin");
    auto pushed = std::make_shared<PushedOptions>();
    command.add_option("--props-of", pushed->folder,
                       "Folder of glTF files: judge a garment that their meshes are pushed against");
    command.add_option("--folder", o->folder, "Of cooked garments (default: those of the build)");
    command.add_option("--garment", o->garment, "One garment");
    command.add_option("--size", o->size, "One size");
    command.add_option(
        "--body", o->body,
        "One body: woman, man, very tall man, heavy woman, small woman; with --random: random 1, ...");
    command.add_option(
        "--random", o->random,
        "So many other bodies instead, of any height and weight, always the same for a number");
    command.add_option("--pictures", o->pictures, "Folder for a sheet of pictures of each body");
    command.add_flag("--quick", o->quick, "One size of each");
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o, real, jumps, with_jumps, pushed] {
        if (*with_jumps) {
            jumps->garment = o->garment, jumps->json = o->json;
            return judge_jumps(*jumps);
        }
        if (!pushed->folder.empty()) {
            pushed->garment = o->garment, pushed->json = o->json;
            return judge_pushed(*pushed);
        }
        if (real->folder.empty()) return judge_garments(*o);
        real->carry_speed_m_s = jumps->carry_speed_m_s, real->carry_way_m = jumps->carry_way_m;
        real->garment = o->garment, real->cooked = o->folder, real->pictures = o->pictures,
        real->json = o->json;
        judge_recordings(*real);
    });
}

}  // namespace vfit::tools
