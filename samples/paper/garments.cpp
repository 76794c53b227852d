// vfit-paper garments: Figures 2, 12, 13, 14 and 15: the colliding body, and people dressed in the six
// outfits.
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <set>
#include <sstream>

#include "client/files.h"
#include "client/output.h"
#include "client/people.h"
#include "collision_body.h"
#include "outfit.h"
#include "paper.h"
#include "picture/contact_sheet.h"
#include "picture/depth_picture.h"
#include "population/library_file.h"
#include "postures.h"
#include "subjects.h"

namespace vfit::tools {

namespace {

constexpr float kClothStep_s = 1.0f / 60.0f;
constexpr float kFront = 0.3f, kBack = 3.45f;  // where the picture is taken from: radians about the person

struct GarmentFigures {
    std::string source = "virtual:motion=demo&sensor=kinect_v1&sex=f&seed=7&frames=780";
    std::string garment = "sundress", out = "paper", figure = "all";
    bool draft = false, json = false;
};

/// What differs between a picture to look at and one of a test.
struct Quality {
    int width, height, samples;  // of a portrait
    float rest_s;                // that a garment is given to come to rest
    uint32_t detail;             // of the body's mesh
    int cell;                    // height of a row of the sheet, pixels
};
constexpr Quality kFine{560, 900, 3, 2.0f, 1, 620}, kDraft{140, 225, 1, 0.3f, 0, 225};

/// Somebody who stands on the floor, however tall, and whose raised arms are in the picture.
Canvas portrait(const std::vector<RenderMesh>& meshes, float yaw, float height_m, const Quality& quality) {
    glm::vec3 low(1e9f), high(-1e9f);
    for (const glm::vec3& p : meshes[0].positions) low = glm::min(low, p), high = glm::max(high, p);
    const glm::vec3 centre(0.5f * (low.x + high.x), 0.0f, 0.5f * (low.z + high.z));
    std::vector<RenderMesh> moved = meshes;
    for (RenderMesh& mesh : moved)
        for (glm::vec3& p : mesh.positions) p -= centre;
    RenderView view;
    view.width = quality.width, view.height = quality.height, view.samples = quality.samples;
    constexpr float kDistance_m = 5.2f, kEye_m = 1.35f, kAround = 1.12f;
    view.eye = {kDistance_m * std::sin(yaw), kEye_m, kDistance_m * std::cos(yaw)};
    view.target = {0.0f, 0.48f * height_m, 0.0f};
    view.fov_y_rad = 2.0f * std::atan(0.5f * kAround * height_m / kDistance_m);
    return render(moved, view);
}

class Figures {
public:
    explicit Figures(const GarmentFigures& options)
        : options_(options), quality_(options.draft ? kDraft : kFine), context_(open_context()) {
        create_folder(options.out);
    }

    void draw() {
        figure("2", [this] { colliding_body(); });
        figure("12", [this] { depth_and_posture(); });
        figure("13", [this] { postures(); });
        figure("14", [this] { default_bodies(); });
        figure("15", [this] { unusual_bodies(); });
        if (options_.json)
            print_document(report_);
        else
            std::cout << written_ << " in " << options_.out << "\n";
    }

private:
    using Rows = std::vector<std::vector<SheetItem>>;

    template <typename Draw>
    void figure(const std::string& number, const Draw& draw) {
        if (options_.figure != "all" && options_.figure != number) return;
        draw();
        written_ += (written_.empty() ? "fig_" : ", fig_") + number + ".png";
    }
    void write(const std::string& number, const std::string& title, const Rows& rows) {
        contact_sheet("Fig. " + number + "  " + title, rows, quality_.cell)
            .write_png((std::filesystem::path(options_.out) / ("fig_" + number + ".png")).string());
    }
    SheetItem picture(const Worn& worn, float yaw, float height_m, const std::string& caption) const {
        return {portrait(worn.meshes(), yaw, height_m, quality_), caption};
    }

    /// The paper's figure, and the skin that it stands for.
    void colliding_body() {
        constexpr float kHeight_m = 1.95f;
        Quality wide = quality_;
        wide.width = wide.height;  // arms held out
        std::vector<SheetItem> row;
        for (const vfit_sex sex : {VFIT_SEX_FEMALE, VFIT_SEX_MALE}) {
            const Avatar avatar = avatar_of_shape(context_.get(), sex, {}, quality_.detail);
            Frame frame;
            check(vfit_avatar_acquire(avatar.get(), frame.out()));
            RenderMesh skin;
            skin.positions = items_of<glm::vec3>(frame.get(), VFIT_STREAM_POSITION);
            skin.normals = items_of<glm::vec3>(frame.get(), VFIT_STREAM_NORMAL);
            skin.indices = items_of<uint32_t>(frame.get(), VFIT_STREAM_INDEX);
            skin.color = {0.86f, 0.67f, 0.56f};
            auto colliders = collider_meshes(colliders_of(avatar.get()));
            row.push_back({portrait({skin}, kFront, kHeight_m, wide),
                           sex == VFIT_SEX_FEMALE ? "default female body" : "default male body"});
            // The picture's middle is that of the first mesh: the skin, of which nothing is drawn.
            skin.indices.clear();
            row.push_back({portrait({skin, colliders[0], colliders[1]}, kFront, kHeight_m, wide),
                           "15 spheres, 16 tapered capsules"});
        }
        write("2", "the colliding body with its default radii", {row});
    }

    /// Depth images and, below each, the dressed avatar in the posture that was tracked in it.
    void depth_and_posture() {
        constexpr size_t kMoments = 5;
        Source source(context_.get(), options_.source);
        ScanOptions scan_options;
        scan_options.method = VFIT_SCAN_FIT;
        scan_options.sex = VFIT_SEX_FEMALE;
        scan_options.track.joints = scan_options.track.user_map = VFIT_TRACK_BUILT_IN;
        const ScanRun run = run_scan(context_.get(), source, scan_options);
        vfit_avatar_desc desc = vfit_avatar_desc_init();
        desc.sex = VFIT_SEX_FEMALE;
        desc.detail = quality_.detail;
        Avatar avatar;
        check(vfit_avatar_create_from_scan(context_.get(), &desc, run.scan.get(), avatar.out()));
        Worn worn(context_.get(), avatar.get(), {options_.garment, VFIT_SEX_FEMALE, {options_.garment}});
        // The demonstration's own: arms held out, turned to both sides, in a step, arms up. Of a shorter
        // source what there is.
        const float moments_s[kMoments] = {1.0f, 11.0f, 13.0f, 17.5f, 24.0f};
        Rows rows(2);
        float cloth_s = 0.0f;
        take_postures(context_.get(), avatar.get(), options_.source, scan_options.track,
                      [&](vfit_frame tracked, float time_s) {
                          if (time_s == 0.0f) worn.put_on(quality_.rest_s);
                          for (; cloth_s < time_s; cloth_s += kClothStep_s) worn.step(kClothStep_s);
                          if (time_s < moments_s[rows[0].size()]) return true;
                          std::ostringstream caption;
                          caption << std::fixed << std::setprecision(1) << time_s << " s";
                          const int scale = view_of(tracked, VFIT_STREAM_DEPTH).width <= 400 ? 4 : 2;
                          Canvas depth = draw_depth(tracked, scale);
                          draw_skeleton(depth, tracked, joints_of(tracked, active_body(tracked)), scale);
                          rows[0].push_back({cropped(depth), caption.str()});
                          rows[1].push_back(picture(worn, 0.0f, 2.05f, options_.garment));
                          return rows[0].size() < kMoments && !(options_.draft && rows[0].size() == 2);
                      });
        report_["fig_12"] = worn.report();
        write("12", "depth map with joints, and the dressed avatar (" + made_of(options_.source) + ")", rows);
    }

    static std::string made_of(const std::string& source) {
        return source.starts_with("virtual:") ? "a virtual person: synthetic" : source;
    }

    /// The middle of a wide picture, as wide as a portrait.
    Canvas cropped(const Canvas& from) const {
        const int width = from.height() * quality_.width / quality_.height, left = (from.width() - width) / 2;
        Canvas out(width, from.height());
        for (int y = 0; y < from.height(); ++y)
            for (int x = 0; x < width; ++x) out.set(x, y, from.get(left + x, y));
        return out;
    }

    /// The default body in motion, as the truth tells it: of its depth images nothing is needed.
    static std::string person(const std::string& motion, vfit_sex sex) {
        return "virtual:sensor=kinect_v1_320&noise=0&distance=3.2&motion=" + motion +
               "&sex=" + (sex == VFIT_SEX_FEMALE ? "f" : "m");
    }

    void postures() {
        struct Posture {
            const char* motion;
            float at_s;
            const char* name;
        };
        constexpr Posture kPostures[] = {{"scan", 0.3f, "stands"},
                                         {"walk", 2.2f, "walks"},
                                         {"reach", 2.5f, "reaches"},
                                         {"demo", 24.0f, "arms up"},
                                         {"squat", 1.6f, "squats"}};
        Rows rows;
        for (const char* name : {"sundress", "jeans and vest", "flight suit"}) {
            const Outfit& clothes = outfit(name);
            const Avatar avatar = avatar_of_shape(context_.get(), clothes.sex, {}, quality_.detail);
            Worn worn(context_.get(), avatar.get(), clothes);
            rows.emplace_back();
            for (const Posture& p : kPostures) {
                if (options_.draft && rows.back().size() == 2) break;
                pose(avatar.get(), worn, person(p.motion, clothes.sex), p.at_s);
                rows.back().push_back(picture(worn, kFront, clothes.sex == VFIT_SEX_FEMALE ? 2.05f : 2.25f,
                                              std::string(name) + ": " + p.name));
                report_["fig_13"][name][p.name] = worn.report();
            }
        }
        write("13", "a model in different postures", rows);
    }

    /// Put on in the first posture, and moved to the one at that time.
    void pose(vfit_avatar avatar, Worn& worn, const std::string& source, float at_s) {
        float cloth_s = 0.0f;
        take_postures(context_.get(), avatar, source, {}, [&](vfit_frame, float time_s) {
            if (time_s == 0.0f) worn.put_on(quality_.rest_s);
            for (; cloth_s < time_s; cloth_s += kClothStep_s) worn.step(kClothStep_s);
            return time_s < at_s;
        });
    }

    /// An outfit on a body that stands, from before and behind.
    void dress(const std::string& figure, const std::string& person, vfit_avatar avatar,
               const Outfit& clothes, const std::string& source, float height_m,
               std::vector<SheetItem>& row) {
        Worn worn(context_.get(), avatar, clothes);
        pose(avatar, worn, source, 0.3f);
        row.push_back(picture(worn, kFront, height_m, clothes.name));
        row.push_back(picture(worn, kBack, height_m, "the same, from behind"));
        report_[figure][person][clothes.name] = worn.report();
    }

    void default_bodies() {
        Rows rows;
        for (const vfit_sex sex : {VFIT_SEX_FEMALE, VFIT_SEX_MALE}) {
            const Avatar avatar = avatar_of_shape(context_.get(), sex, {}, quality_.detail);
            const std::string source = person("scan", sex);
            rows.emplace_back();
            for (const Outfit& clothes : outfits())
                if (clothes.sex == sex)
                    dress("fig_14", sex == VFIT_SEX_FEMALE ? "female" : "male", avatar.get(), clothes, source,
                          1.9f, rows.back());
        }
        write("14", "the garments of the default female and male body", rows);
    }

    /// The paper's subjects 6 and 7.
    void unusual_bodies() {
        Rows rows;
        for (const Subject& subject : subjects(BodyModel::load(library_file("vfit_data/body.bin")))) {
            if (subject.number < 6) continue;
            const std::string person = subject.number == 6 ? "heavy woman" : "very tall man";
            const Avatar avatar =
                avatar_of_shape(context_.get(), subject.sex, subject.shape, quality_.detail);
            rows.emplace_back();
            for (const Outfit& clothes : outfits())
                if (clothes.sex == subject.sex)
                    dress("fig_15", person, avatar.get(), clothes, subject.uri,
                          0.01f * float(subject.height.real) + 0.12f, rows.back());
            rows.back()[0].caption =
                person + ", " + std::to_string(int(subject.height.real)) + " cm: " + rows.back()[0].caption;
        }
        write("15",
              "an obese woman and a very tall man: virtual people of the dimensions of the paper's subjects "
              "6 and 7",
              rows);
    }

    const GarmentFigures options_;
    const Quality quality_;
    Context context_;
    std::string written_;
    Json report_ = Json::object();
};

}  // namespace

void add_garments(Command& app) {
    Command command = app.add_subcommand("garments", "Figures 2, 12, 13, 14 and 15 as pictures");
    auto o = std::make_shared<GarmentFigures>();
    command.add_option("--source", o->source,
                       "Recording folder or sensor URI of Fig. 12, of a woman (default: a virtual person)");
    command.add_option("--garment", o->garment, "Of Fig. 12 (default: sundress)");
    command.add_option("--figure", o->figure, "One of them alone")
        .one_of({"all", "2", "12", "13", "14", "15"});
    command.add_option("--out", o->out, "Folder for the pictures (default: paper)");
    command.add_flag("--draft", o->draft, "Small pictures of few postures, soon done");
    command.add_flag("--json", o->json,
                     "Print how the garments fare: stretch of the threads, and what upper edges sank by");
    command.callback([o] { Figures(*o).draw(); });
}

}  // namespace vfit::tools
