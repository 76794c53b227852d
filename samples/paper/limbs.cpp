// vfit-paper motion: Figures 5, 6, 7 and 11: rotations before and after the filters, the two bones of a
// forearm, and the planted foot.
#include <array>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <sstream>

#include "avatar/avatar.h"
#include "body/piece_of_surface.h"
#include "client/people.h"
#include "math/quaternion.h"
#include "paper.h"
#include "picture/foot_curve.h"
#include "picture/render.h"
#include "population/library_file.h"

namespace vfit::tools {

namespace {

struct Options {
    std::string source = "virtual:motion=demo&sensor=kinect_v1&sex=f&seed=7&frames=240";
    std::string feet = "virtual:motion=walk&sensor=kinect_v1&sex=f&seed=7&frames=240";
    std::string out = "paper";
};

constexpr Color kWhite{1, 1, 1}, kSkin{0.80f, 0.60f, 0.48f};
constexpr float kQuarterTurn = -0.5f * kPi;  // of the figure: a yaw of -90 degrees

/// The roll of the right humerus, degrees, frame by frame; those without the person are left out.
CurvePoints humerus_roll(vfit_context context, const std::string& uri, uint32_t flags) {
    Source source(context, uri);
    TrackOptions options;
    options.joints = options.user_map = VFIT_TRACK_BUILT_IN;
    const Tracker tracker = open_tracker(context, options);
    vfit_motion_desc desc = vfit_motion_desc_init();
    desc.flags = flags;
    Motion motion;
    check(vfit_motion_create(context, &desc, motion.out()));
    CurvePoints points;
    float before = 0.0f;
    while (const auto frame = source.next()) {
        Frame tracked;
        check(vfit_tracker_update(tracker.get(), frame->get(), tracked.out()));
        const int64_t now_ns = view_of(tracked.get(), VFIT_STREAM_DEPTH).time_ns;
        if (check(vfit_motion_step(motion.get(), tracked.get(), active_body(tracked.get()), now_ns)) !=
            VFIT_OK)
            continue;
        vfit_pose pose = vfit_pose_init();
        for (const vfit_bone& b : bones_of(motion.get(), pose)) {
            if (b.bone != VFIT_BONE_RIGHT_UPPER_ARM) continue;
            const Quat twist =
                split_swing_twist(Quat(b.rotation[3], b.rotation[0], b.rotation[1], b.rotation[2]),
                                  Vec3(-1, 0, 0))
                    .twist;
            // Unwrapped: a turn past 180 degrees goes on.
            float roll = 2.0f * std::atan2(-twist.x, twist.w) * 180.0f / kPi;
            if (!points.empty()) roll += 360.0f * std::round((before - roll) / 360.0f);
            points.emplace_back(float(source.taken() - 1), before = roll);
        }
    }
    if (points.empty()) throw Failure("Fig. 5: " + uri + " shows no person");
    return points;
}

/// Where the picture's first body part starts and ends, seen from before.
RenderView towards(const vfit::Avatar& avatar) {
    const Body joints = avatar.joints();
    const Vec3 elbow = joints.at(VFIT_JOINT_LEFT_ELBOW), hand = joints.at(VFIT_JOINT_LEFT_HAND);
    RenderView view;
    view.target = 0.5f * (elbow + hand);
    view.eye = view.target + Vec3(0.0f, 0.25f, 1.1f);
    view.fov_y_rad = 0.36f;
    view.width = 560;
    view.height = 360;
    view.floor = false;
    return view;
}

RenderMesh mesh_of(const vfit::Avatar& avatar) {
    RenderMesh mesh;
    mesh.positions = avatar.positions();
    mesh.normals = avatar.normals();
    mesh.indices = avatar.rest().indices;
    mesh.color = kSkin;
    return mesh;
}

/// Pictures beside each other, each with a line of text.
Canvas side_by_side(const std::vector<std::pair<Canvas, std::string>>& pictures) {
    constexpr int kTitle = 30;
    const Canvas& first = pictures.front().first;
    Canvas out(first.width() * int(pictures.size()), first.height() + kTitle, {0.1f, 0.1f, 0.12f});
    for (size_t i = 0; i < pictures.size(); ++i) {
        const auto& [picture, title] = pictures[i];
        const int left = int(i) * first.width();
        out.blit(picture, left, kTitle, picture.width(), picture.height());
        out.text(left + 10, 21, title, 10, kWhite);
    }
    return out;
}

vfit::Avatar make_avatar(bool single, uint32_t twist_steps) {
    AvatarDesc desc;
    desc.sex = VFIT_SEX_FEMALE;
    desc.detail = 1;
    desc.single_bones = single;
    if (!single) desc.twist_steps = twist_steps;
    return vfit::Avatar(BodyModel::load(library_file("vfit_data/body.bin")), desc, {}, Vec2(1.0f));
}

void pose_forearm(vfit::Avatar& avatar, float turn) {
    Pose pose;
    pose.hips_position = avatar.skeleton().offset[VFIT_BONE_HIPS];
    pose.rotation[VFIT_BONE_LEFT_HAND] = glm::angleAxis(turn, Vec3(1, 0, 0));
    avatar.pose(pose, *Jobs::own(0));
}

/// What one bone carries of each vertex, from blue (nothing) to yellow (all).
Canvas weights_of(const vfit::Avatar& avatar, int rig_bone) {
    RenderMesh mesh = mesh_of(avatar);
    for (size_t v = 0; v < mesh.positions.size(); ++v) {
        float weight = 0.0f;
        for (size_t k = 0; k < size_t(kSkinBones); ++k)
            if (avatar.skin_bones()[v][k] == rig_bone) weight += avatar.skin_weights()[v][k];
        mesh.vertex_colors.push_back(
            {0.10f + 0.85f * weight, 0.15f + 0.65f * weight, 0.70f - 0.60f * weight});
    }
    return render({mesh}, towards(avatar));
}

void figure_6(const std::string& path) {
    vfit::Avatar avatar = make_avatar(false, 1);
    pose_forearm(avatar, 0.0f);
    for (const LimbChain& limb : avatar.limbs())
        if (limb.bone == VFIT_BONE_LEFT_LOWER_ARM)
            side_by_side({{weights_of(avatar, limb.rig_bones.front()), "Fig. 6  (a) upper ulna"},
                          {weights_of(avatar, limb.rig_bones.back()), "(b) lower ulna: blue 0, yellow 1"}})
                .write_png(path);
}

void figure_7(const std::string& path) {
    struct Skinning {
        const char* name;
        bool single;
        uint32_t steps;
    };
    std::vector<std::pair<Canvas, std::string>> pictures;
    std::cout
        << "Fig. 7: volume of a forearm whose hand is turned by -90 degrees, beside its volume at rest\n";
    for (const Skinning& s : {Skinning{"(a) one bone", true, 0}, Skinning{"(b) two bones", false, 1},
                              Skinning{"(c) vfit's seven", false, 6}}) {
        vfit::Avatar avatar = make_avatar(s.single, s.steps);
        const auto forearm = triangles_of(avatar.topology(), BodyPart::kLeftForearm);
        pose_forearm(avatar, 0.0f);
        const std::vector<Vec3> straight = avatar.positions();
        const double rest = enclosed_volume(straight, forearm);
        pose_forearm(avatar, kQuarterTurn);
        const double kept = enclosed_volume(avatar.positions(), forearm) / rest;
        // At the wrist and the elbow a single bone tears at its neighbours' skin: the worst stretch of an
        // edge tells.
        double worst = 1.0;
        const auto& posed = avatar.positions();
        const auto& indices = avatar.topology().indices;
        for (size_t t = 0; t < indices.size(); ++t) {
            const uint32_t a = indices[t], b = indices[t % 3 == 2 ? t - 2 : t + 1];
            const BodyPart part = avatar.topology().parts[a];
            if (part != BodyPart::kLeftForearm && part != BodyPart::kLeftUpperArm) continue;
            worst = std::max(
                worst, double(glm::distance(posed[a], posed[b]) / glm::distance(straight[a], straight[b])));
        }
        std::ostringstream title;
        title << (pictures.empty() ? "Fig. 7  " : "") << s.name << std::fixed << std::setprecision(1)
              << ": volume " << 100.0 * kept << " %, longest edge " << std::setprecision(2) << worst
              << " times";
        std::cout << "  " << s.name << std::fixed << std::setprecision(1) << ": " << 100.0 * kept
                  << " % of the volume, an edge stretched " << std::setprecision(2) << worst
                  << " times at most\n";
        pictures.emplace_back(render({mesh_of(avatar)}, towards(avatar)), title.str());
    }
    side_by_side(pictures).write_png(path);
}

void limbs(const Options& o) {
    std::filesystem::create_directories(o.out);
    const auto path = [&](const char* name) { return (std::filesystem::path(o.out) / name).string(); };
    const Context context = open_context();
    Curve roll{"Fig. 5  roll of the right humerus", "frame", "degrees", {}, "filtered", {}};
    constexpr uint32_t kRaw =
        VFIT_MOTION_NO_FILTER | VFIT_MOTION_NO_LIMITS | VFIT_MOTION_NO_SMOOTHING | VFIT_MOTION_NO_FEET;
    roll.behind.push_back({"raw", humerus_roll(context.get(), o.source, kRaw)});
    roll.points = humerus_roll(context.get(), o.source, 0);
    draw_curve(roll, 800, 400).write_png(path("fig_5.png"));
    figure_6(path("fig_6.png"));
    figure_7(path("fig_7.png"));
    Curve foot = foot_correction(context.get(), o.feet, 0);
    foot.title = "Fig. 11  corrected displacement of the feet";
    draw_curve(foot, 800, 400).write_png(path("fig_11.png"));
    std::cout << "fig_5.png, fig_6.png, fig_7.png, fig_11.png in " << o.out << "\n";
}

}  // namespace

void add_limbs(Command& app) {
    Command command = app.add_subcommand("motion", "Figures 5, 6, 7 and 11 as pictures");
    auto o = std::make_shared<Options>();
    command.add_option("--source", o->source,
                       "Recording folder or sensor URI of Fig. 5 (default: a virtual person)");
    command.add_option("--feet", o->feet, "The same of Fig. 11 (default: a virtual person who walks)");
    command.add_option("--out", o->out, "Folder for the pictures (default: paper)");
    command.callback([o] { limbs(*o); });
}

}  // namespace vfit::tools
