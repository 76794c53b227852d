// vfit-paper meshes: Table 5, vertices and triangles of bodies and garments, and what a step of each garment
// takes on one pinned core. The body walks as a virtual person does: synthetic.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <span>
#include <sstream>
#include <thread>

#include "bench/bench.h"
#include "body/body_model.h"
#include "client/files.h"
#include "client/output.h"
#include "cook/garment_writer.h"
#include "cook/sundress.h"
#include "paper.h"
#include "population/library_file.h"
#include "postures.h"

namespace vfit::tools {

namespace {

struct MeshOptions {
    uint32_t frames = 240;
    bool json = false;
};

// What the paper prints beside Table 5: of its own sundress, and of the blouse of Meng et al. (2,398
// vertices, 4,768 triangles).
constexpr double kPaper_fps = 268.3, kMeng_fps = 63.07;

constexpr float kFrame_s = 1.0f / 60.0f;

/// Vertices and triangles, skinned and simulated.
struct Counts {
    int skinned_vertices, simulated_vertices, skinned_triangles, simulated_triangles;
};

struct Printed5 {
    const char* mesh;
    Counts counts;
    std::vector<const char*> ours;  // garments that make up the same outfit
};
const Printed5 kTable5[] = {{"Duster", {3459, 480, 6660, 840}, {"duster"}},
                            {"Sundress", {1048, 3096, 1951, 6054}, {"sundress", "sundress_pattern"}},
                            {"Flight suit", {21777, 0, 42938, 0}, {"flight_suit"}},
                            {"Pants-shirt", {25088, 0, 49464, 0}, {"pants_men", "shirt_men"}},
                            {"Jeans-vest", {6024, 0, 11930, 0}, {"jeans_women", "vest"}},
                            {"Martial suit", {5512, 778, 10968, 1384}, {"martial_pants", "martial_jacket"}}};

/// A garment's file, and the body that it was made on.
struct Text {
    std::string json;
    vfit_sex sex;
    Counts counts;
};

Text text_of(std::string json) {
    const Json file = Json::parse(json);
    const auto simulated = file.at("simulated").get<std::vector<int>>();
    // Seams double vertices for their texture: the simulation has each once.
    const auto corners =
        file.at(file.contains("corners") ? "corners" : "indices").get<std::vector<uint32_t>>();
    Counts c{};
    for (const int s : simulated) ++(s ? c.simulated_vertices : c.skinned_vertices);
    // A triangle that hangs on skinned cloth with a corner or two moves with the simulated rest.
    for (size_t t = 0; t + 2 < corners.size(); t += 3)
        ++(simulated[corners[t]] || simulated[corners[t + 1]] || simulated[corners[t + 2]]
               ? c.simulated_triangles
               : c.skinned_triangles);
    return {std::move(json), file.at("body_sex") == "m" ? VFIT_SEX_MALE : VFIT_SEX_FEMALE, c};
}

Text built(const std::string& name) {
    return text_of(read_text(library_file("vfit_data/garments/" + name + ".json")));
}

/// The sundress with fewer rows and columns: as many simulated vertices as Meng's blouse has, to 0.1 %.
Text of_mengs_size() {
    constexpr int kColumns = 60, kSkirtRows = 40;  // 2,400
    Json design = Json::parse(read_text(VFIT_PAPER_DESIGNS "/sundress.json"));
    design["columns"] = kColumns, design["skirt_rows"] = kSkirtRows;
    const std::string text = design.dump();
    const auto model = BodyModel::load(library_file("vfit_data/body.bin"));
    return text_of(write_garment(cook_sundress(*model, parse_sundress(std::as_bytes(std::span(text))))));
}

struct Times5 {
    Samples colliders, skin,
        frame;  // a step on spheres and capsules, on the skin; motion, skinning, such a step, buffers
};

Times5 time_steps(const Text& text, uint32_t frames) {
    const Context context = open_context();
    const Avatar avatar = avatar_of_shape(context.get(), text.sex, {}, 0);
    Garment garment;
    check(vfit_garment_load(context.get(), text.json.data(), text.json.size(), garment.out()));
    vfit_cloth_desc desc = vfit_cloth_desc_init();
    desc.flags = VFIT_CLOTH_AWAKE | VFIT_CLOTH_NO_HANDS;
    Cloth on_colliders, on_skin;
    check(vfit_cloth_create(avatar.get(), garment.get(), &desc, on_colliders.out()));
    desc.flags |= VFIT_CLOTH_SKIN;
    check(vfit_cloth_create(avatar.get(), garment.get(), &desc, on_skin.out()));
    Times5 times;
    const std::string source = std::string("virtual:sensor=kinect_v1_320&motion=walk&distance=3.2&sex=") +
                               (text.sex == VFIT_SEX_MALE ? "m" : "f") + "&frames=" + std::to_string(frames);
    Motion motion;
    check(vfit_motion_create(context.get(), nullptr, motion.out()));
    check(vfit_motion_bind(motion.get(), avatar.get()));
    bool worn = false;
    const auto frame = [&](vfit_frame tracked, uint32_t body) {
        const Timer whole;
        check(vfit_motion_step(motion.get(), tracked, body, view_of(tracked, VFIT_STREAM_DEPTH).time_ns));
        vfit_pose pose = vfit_pose_init();
        const auto bones = bones_of(motion.get(), pose);
        set_pose(avatar.get(), pose, bones);
        if (!worn) {
            for (const vfit_cloth cloth : {on_colliders.get(), on_skin.get()}) check(vfit_cloth_reset(cloth));
            worn = true;
            return;
        }
        const Timer step;
        check(vfit_cloth_step(on_colliders.get(), kFrame_s));
        times.colliders.add(step.ms());
        Frame skin, cloth;
        check(vfit_avatar_acquire(avatar.get(), skin.out()));
        check(vfit_cloth_acquire(on_colliders.get(), cloth.out()));
        times.frame.add(whole.ms());
        const Timer other;
        check(vfit_cloth_step(on_skin.get(), kFrame_s));
        times.skin.add(other.ms());
        // Camera images are 1/30 s apart.
        for (const vfit_cloth c : {on_colliders.get(), on_skin.get()}) check(vfit_cloth_step(c, kFrame_s));
    };
    // Some frames in a row, once the sensor's thread, which shares the core, is idle. It lends no more than a
    // few.
    constexpr size_t kInARow = 4;
    std::vector<std::pair<Frame, uint32_t>> waiting;
    Source camera(context.get(), source);
    const Tracker tracker = open_tracker(context.get(), {});
    while (const auto image = camera.next()) {
        Frame tracked;
        check(vfit_tracker_update(tracker.get(), image->get(), tracked.out()));
        const uint32_t body = active_body(tracked.get());
        if (body) waiting.emplace_back(std::move(tracked), body);
        if (waiting.size() < kInARow) continue;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        for (const auto& [seen, id] : waiting) frame(seen.get(), id);
        waiting.clear();
    }
    return times;
}

std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown";
}

Json counts_json(const Counts& c) {
    return {{"skinned_vertices", c.skinned_vertices},
            {"simulated_vertices", c.simulated_vertices},
            {"skinned_triangles", c.skinned_triangles},
            {"simulated_triangles", c.simulated_triangles}};
}

class Table5 {
public:
    explicit Table5(const MeshOptions& options) : options_(options) { out_["processor"] = processor(); }

    void print() {
        say("Table 5. Vertices and triangles, skinned and simulated; skinned ones move with the bones alone. "
            "Milliseconds of a step of\n"
            "1/60 s are medians of one pinned core (" +
            out_["processor"].get<std::string>() +
            ") on a virtual person who walks (synthetic):\n"
            "on spheres and capsules, as the paper's, and on the skin itself\n"
            "                                vertices            triangles           ms a step         "
            "frames a second:\n"
            "  mesh                      skinned  simulated  skinned  simulated  colliders  skin  step  "
            "motion, skin, step, buffers\n");
        bodies();
        for (const Printed5& p : kTable5) {
            row(std::string("paper: ") + p.mesh, p.counts, nullptr);
            for (const char* name : p.ours) garment(name, built(name));
        }
        say("\nThe paper: " + number(kPaper_fps, 1) +
            " frames a second with its sundress of 3,096 simulated vertices (Core i7-2600, GeForce "
            "GTX560Ti);\n"
            "Meng et al.: " +
            number(kMeng_fps, 2) +
            " with a blouse of 2,398 vertices. Below: vfit's sundress of the same count, and of Meng's\n");
        compare("sundress", "paper_fps", kPaper_fps);
        garment("sundress, Meng's size", of_mengs_size());
        compare("sundress, Meng's size", "meng_fps", kMeng_fps);
        if (options_.json) print_document(out_);
    }

private:
    static std::string number(double value, int digits) {
        std::ostringstream text;
        text << std::fixed << std::setprecision(digits) << value;
        return text.str();
    }
    void say(const std::string& text) const {
        if (!options_.json) std::cout << text;
    }
    void row(const std::string& name, const Counts& c, const Times5* times) const {
        if (options_.json) return;
        std::cout << "  " << std::left << std::setw(25) << name << std::right << std::setw(8)
                  << c.skinned_vertices << std::setw(11) << c.simulated_vertices << std::setw(9)
                  << c.skinned_triangles << std::setw(11) << c.simulated_triangles;
        if (times)
            std::cout << std::fixed << std::setprecision(2) << std::setw(11) << times->colliders.quantile(0.5)
                      << std::setw(6) << times->skin.quantile(0.5) << std::setprecision(0) << std::setw(6)
                      << 1e3 / times->colliders.quantile(0.5) << std::setw(8)
                      << 1e3 / times->frame.quantile(0.5);
        std::cout << "\n";
    }
    void bodies() {
        row("paper: Female", {120382, 0, 234062, 0}, nullptr);
        row("paper: Male", {44262, 0, 88234, 0}, nullptr);
        const Context context = open_context();
        for (uint32_t detail = 0; detail <= 2; ++detail) {
            const Avatar avatar = avatar_of_shape(context.get(), VFIT_SEX_FEMALE, {}, detail);
            Frame frame;
            check(vfit_avatar_acquire_rest(avatar.get(), frame.out()));
            const Counts c{int(view_of(frame.get(), VFIT_STREAM_POSITION).width), 0,
                           int(view_of(frame.get(), VFIT_STREAM_INDEX).width / 3), 0};
            const std::string name = "body, detail " + std::to_string(detail);
            row(name, c, nullptr);
            out_["meshes"][name] = counts_json(c);
        }
    }
    void garment(const std::string& name, const Text& text) {
        const Times5 times = time_steps(text, options_.frames);
        row(name, text.counts, &times);
        Json& mesh = out_["meshes"][name] = counts_json(text.counts);
        mesh["step_ms"] = times.colliders.json(), mesh["step_on_skin_ms"] = times.skin.json(),
        mesh["frame_ms"] = times.frame.json();
    }
    void compare(const std::string& name, const char* key, double theirs) {
        Json& mesh = out_["meshes"][name];
        const auto fps = [&](const char* what) { return 1e3 / mesh.at(what).at("median").get<double>(); };
        mesh["fps"] = {{"step", fps("step_ms")},
                       {"step_on_skin", fps("step_on_skin_ms")},
                       {"frame", fps("frame_ms")},
                       {key, theirs}};
        say("  " + name + ": " + number(fps("step_ms"), 0) + " steps a second, " +
            number(fps("step_on_skin_ms"), 0) + " on the skin, " + number(fps("frame_ms"), 0) +
            " frames a second; theirs " + number(theirs, 2) + "\n");
    }

    const MeshOptions options_;
    Json out_;
};

}  // namespace

void add_meshes(Command& app) {
    Command command = app.add_subcommand("meshes", "Table 5, and what a step of each garment takes");
    auto o = std::make_shared<MeshOptions>();
    command.add_option("--frames", o->frames, "Camera images that each garment is timed for (default 240)")
        .within(2, 100000);
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] {
        pin_to_cores(1);
        Table5(*o).print();
    });
}

}  // namespace vfit::tools
