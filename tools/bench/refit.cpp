// vfit-bench refit: a character's file that wears garments, moved by a person: does the cloth cross what else
// is seen? The file alone is judged, skinned as engines do: one bone a limb, four bones a vertex, linear.
#include <algorithm>
#include <iostream>
#include <map>
#include <set>

#include "bench/bench.h"
#include "bench/welded.h"
#include "client/files.h"
#include "client/outfit.h"
#include "client/output.h"
#include "client/people.h"
#include "client/played_motion.h"
#include "picture/render.h"

namespace vfit::tools {

namespace {

struct Options {
    std::vector<std::string> files;
    std::string motion, garments, pictures;
    int frames = 0, every = 1;
    float scale = 1.0f;
    bool json = false;
};

/// Triangles of the garments, and all others.
struct Split {
    std::vector<uint32_t> cloth, others;
};

Split split_by_mesh(vfit_avatar avatar, const std::vector<uint32_t>& indices,
                    const std::set<std::string>& names, const std::string& file) {
    Split out;
    for (const auto& part : list<vfit_avatar_part>([&](auto* items, uint32_t stride, uint32_t* n) {
             return vfit_avatar_parts(avatar, items, stride, n);
         })) {
        auto& to = names.count(part.mesh) ? out.cloth : out.others;
        to.insert(to.end(), indices.begin() + part.first_index,
                  indices.begin() + part.first_index + part.index_count);
    }
    if (out.cloth.empty()) throw Failure(file + ": has none of the meshes that --garments names");
    return out;
}

/// The place on the body of each vertex, by the humanoid bone that carries most of it.
std::vector<std::string> places_of(vfit_avatar avatar, vfit_frame frame) {
    const std::vector<vfit_rig_bone> rig = rig_of(avatar);
    std::vector<std::string> of_bone;
    for (const vfit_rig_bone& bone : rig) {
        switch (bone.bone) {
            case VFIT_BONE_HEAD: of_bone.push_back("head"); break;
            case VFIT_BONE_LEFT_UPPER_ARM:
            case VFIT_BONE_RIGHT_UPPER_ARM:
            case VFIT_BONE_LEFT_LOWER_ARM:
            case VFIT_BONE_RIGHT_LOWER_ARM: of_bone.push_back("arms"); break;
            case VFIT_BONE_LEFT_HAND:
            case VFIT_BONE_RIGHT_HAND: of_bone.push_back("hands"); break;
            case VFIT_BONE_LEFT_UPPER_LEG:
            case VFIT_BONE_RIGHT_UPPER_LEG:
            case VFIT_BONE_LEFT_LOWER_LEG:
            case VFIT_BONE_RIGHT_LOWER_LEG:
            case VFIT_BONE_LEFT_FOOT:
            case VFIT_BONE_RIGHT_FOOT: of_bone.push_back("legs"); break;
            default:
                of_bone.push_back(bone.bone < 0 && bone.parent >= 0 ? of_bone[size_t(bone.parent)] : "trunk");
        }
    }
    struct Row {
        uint16_t bones[8];
    };
    std::vector<std::string> out;
    for (const Row& row : items_of<Row>(frame, VFIT_STREAM_SKIN_BONES))
        out.push_back(of_bone.at(row.bones[0]));
    return out;
}

RenderMesh drawn(const std::vector<glm::vec3>& positions, const std::vector<glm::vec3>& normals,
                 const std::vector<uint32_t>& indices, const Color& color) {
    RenderMesh mesh;
    mesh.positions = positions, mesh.normals = normals, mesh.indices = indices, mesh.color = color;
    return mesh;
}

Json judge(vfit_context context, const Options& options, const std::string& file) {
    vfit_avatar_desc desc = vfit_avatar_desc_init();
    desc.flags = VFIT_AVATAR_SINGLE_BONES;
    vfit_character_desc character = vfit_character_desc_init();
    character.path = file.c_str();
    character.scale = options.scale;
    Avatar avatar;
    check(vfit_avatar_load(context, &desc, &character, avatar.out()));
    Motion motion;
    check(vfit_motion_create(context, nullptr, motion.out()));
    check(vfit_motion_bind(motion.get(), avatar.get()));
    const std::vector<std::string> names =
        options.garments.empty() ? std::vector<std::string>{} : split(options.garments, '+');
    Split parts;
    std::vector<std::string> places;
    std::map<std::string, size_t> by;  // frames in which that crosses
    size_t not_by_hands = 0;
    size_t frames = 0, crossing = 0, worst = 0, row = 0;
    double worst_s = 0.0;
    std::vector<RenderMesh> picture;
    int64_t start_ns = -1;
    const auto look = [&](int64_t now_ns) {
        if (start_ns < 0) start_ns = now_ns;
        if (row++ % size_t(options.every) != 0) return;
        vfit_pose pose = vfit_pose_init();
        const auto bones = bones_of(motion.get(), pose);
        set_pose(avatar.get(), pose, bones);
        Frame frame;
        check(vfit_avatar_acquire(avatar.get(), frame.out()));
        const auto positions = items_of<glm::vec3>(frame.get(), VFIT_STREAM_POSITION);
        if (frames == 0) places = places_of(avatar.get(), frame.get());
        if (frames == 0)
            parts = split_by_mesh(avatar.get(), items_of<uint32_t>(frame.get(), VFIT_STREAM_INDEX),
                                  {names.begin(), names.end()}, file);
        ++frames;
        const CrossedTriangles crossed = crossings({positions, parts.cloth}, {positions, parts.others});
        const size_t pairs = crossed.size();
        crossing += pairs > 0;
        std::set<std::string> here;
        for (const auto& [cloth, other] : crossed) here.insert(places[parts.others[3 * other]]);
        for (const std::string& place : here) ++by[place];
        not_by_hands += here.size() > here.count("hands");
        if (!picture.empty() && pairs <= worst) return;
        worst = pairs, worst_s = double(now_ns - start_ns) * 1e-9;
        const auto normals = items_of<glm::vec3>(frame.get(), VFIT_STREAM_NORMAL);
        picture = {drawn(positions, normals, parts.others, {0.80f, 0.60f, 0.48f}),
                   drawn(positions, normals, parts.cloth, {0.80f, 0.27f, 0.30f})};
    };
    play_motion(context, motion.get(), options.motion, uint32_t(options.frames), look);
    if (frames == 0) throw Failure(options.motion + ": no pose");
    if (!options.pictures.empty()) {
        glm::vec3 low = picture[0].positions.front(), high = low;
        for (const glm::vec3& p : picture[0].positions) low = glm::min(low, p), high = glm::max(high, p);
        RenderView view;
        view.target = 0.5f * (low + high);
        view.eye = view.target + glm::vec3(0.8f, 0.25f, 2.4f) * (high.y - low.y);
        view.width = 420, view.height = 640;
        step_back_to_show(picture, view);
        render(picture, view).write_png(options.pictures);
    }
    return {{"file", file},
            {"frames", frames},
            {"frames_crossing", crossing},
            {"frames_crossing_not_by_hands", not_by_hands},
            {"frames_by_place", by},
            {"pairs_in_the_worst", worst},
            {"worst_at_s", worst_s}};
}

void refit(const Options& options) {
    const Context context = open_context();
    Json report = Json::array();
    for (const std::string& file : options.files) {
        report.push_back(judge(context.get(), options, file));
        if (!options.json)
            std::cout << file << ": cloth crosses in " << report.back()["frames_crossing"] << " of "
                      << report.back()["frames"] << " frames (" << report.back()["frames_by_place"].dump()
                      << "), at most " << report.back()["pairs_in_the_worst"] << " pairs of triangles\n";
    }
    if (options.json) print_document(report);
}

}  // namespace

void add_refit_bench(Command& app) {
    Command command =
        app.add_subcommand("refit", "Characters that wear garments (vfit refit), moved by a person");
    auto o = std::make_shared<Options>();
    command.add_option("files", o->files, "Files that vfit refit wrote").required();
    command.add_option("--garments", o->garments, "Names of their garments' meshes, A+B").required();
    command.add_option("--motion", o->motion, "Recording, file of joints or BVH file").required();
    command.add_option("--frames", o->frames, "Frames of it (default: all)");
    command.add_option("--every", o->every, "Of the motion's frames each so many is judged (default: 1)")
        .positive();
    command.add_option("--scale", o->scale, "Metres in a unit of the files (default: 1)").positive();
    command.add_option("--picture", o->pictures, "PNG of the worst frame of the last file");
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] { refit(*o); });
}

}  // namespace vfit::tools
