// vfit character: what vfit makes of a character's file, the same file moved by somebody, and own bodies as
// characters.
#include <cmath>
#include <filesystem>
#include <iostream>

#include "client/files.h"
#include "client/missing_bones.h"
#include "client/output.h"
#include "client/people.h"
#include "client/played_motion.h"
#include "client/progress.h"
#include "commands/commands.h"
#include "export/character.h"
#include "export/character_animation.h"
#include "picture/render.h"

namespace vfit::tools {

namespace {

struct Options {
    std::string file, bone_map, rig, motion, out, picture, sex;
    float scale = 1.0f;
    bool nodes = false;
    uint32_t frames = 0;
    bool json = false;
};

const char* kind_name(vfit_character_kind kind) {
    switch (kind) {
        case VFIT_CHARACTER_VRM0: return "VRM 0";
        case VFIT_CHARACTER_VRM1: return "VRM 1";
        case VFIT_CHARACTER_GLTF: return "glTF";
        default: return "body";
    }
}

Avatar load(vfit_context context, const Options& options) {
    vfit_character_desc desc = vfit_character_desc_init();
    desc.path = options.file.c_str();
    const std::string map = options.bone_map.empty() ? std::string() : read_text(options.bone_map);
    if (!map.empty()) desc.bone_map = map.c_str();
    desc.scale = options.scale;
    Avatar avatar;
    try {
        check(vfit_avatar_load(context, nullptr, &desc, avatar.out()));
    } catch (const Failure& failure) {
        report_missing_bones(failure, options.nodes);
    }
    return avatar;
}

Json report(vfit_avatar avatar) {
    vfit_character_info info = vfit_character_info_init();
    check(vfit_avatar_describe(avatar, &info));
    Json bones = Json::object(), parts = Json::array();
    for (const vfit_rig_bone& bone : rig_of(avatar))
        if (bone.bone >= 0) bones[bone_name(bone.bone)] = bone.name;
    for (const auto& part : list<vfit_avatar_part>([&](auto* items, uint32_t stride, uint32_t* n) {
             return vfit_avatar_parts(avatar, items, stride, n);
         }))
        parts.push_back(
            {{"mesh", part.mesh}, {"material", part.material_name}, {"triangles", part.index_count / 3}});
    return {{"kind", kind_name(info.kind)},
            {"name", info.name},
            {"stature_m", std::round(1e4 * double(info.stature_m)) / 1e4},
            {"vertices", info.vertex_count},
            {"rig_bones", info.bone_count},
            {"bones", bones},
            {"parts", parts}};
}

void print(const Json& report) {
    std::cout << report["kind"].get<std::string>() << " character, " << report["stature_m"] << " m, "
              << report["vertices"] << " vertices, " << report["rig_bones"] << " bones in the rig\n";
    for (const auto& [bone, node] : report["bones"].items())
        std::cout << "  " << bone << ": " << node.get<std::string>() << "\n";
    for (const auto& part : report["parts"])
        std::cout << "  part " << part["mesh"].get<std::string>() << ", material "
                  << part["material"].get<std::string>() << ", " << part["triangles"] << " triangles\n";
}

/// The source's person moves the character; each frame a key.
void move(vfit_context context, vfit_avatar avatar, const Options& options, CharacterAnimation& animation) {
    Motion motion;
    check(vfit_motion_create(context, nullptr, motion.out()));
    check(vfit_motion_bind(motion.get(), avatar));
    Progress progress("frames", options.json);
    int64_t start_ns = -1;
    const auto add_key = [&](int64_t now_ns) {
        if (start_ns < 0) start_ns = now_ns;
        vfit_pose pose = vfit_pose_init();
        const auto bones = bones_of(motion.get(), pose);
        set_pose(avatar, pose, bones);
        animation.add_key(float(double(now_ns - start_ns) * 1e-9));
    };
    play_motion(context, motion.get(), options.motion, options.frames, add_key,
                [&](uint32_t taken) { progress.at(taken, options.frames); });
    if (animation.key_count() == 0) throw Failure(options.motion + ": no person was seen");
}

void draw(vfit_avatar avatar, const std::string& path) {
    Frame frame;
    check(vfit_avatar_acquire(avatar, frame.out()));
    RenderMesh mesh;
    mesh.positions = items_of<glm::vec3>(frame.get(), VFIT_STREAM_POSITION);
    mesh.normals = items_of<glm::vec3>(frame.get(), VFIT_STREAM_NORMAL);
    mesh.indices = items_of<uint32_t>(frame.get(), VFIT_STREAM_INDEX);
    mesh.color = {0.80f, 0.60f, 0.48f};
    glm::vec3 low = mesh.positions.front(), high = low;
    for (const glm::vec3& p : mesh.positions) low = glm::min(low, p), high = glm::max(high, p);
    RenderView view;
    view.target = 0.5f * (low + high);
    view.eye = view.target + glm::vec3(0.8f, 0.25f, 2.4f) * (high.y - low.y);
    step_back_to_show({mesh}, view);
    render({mesh}, view).write_png(path);
}

void character(const Options& options) {
    const Context context = open_context();
    if (!options.rig.empty()) {
        if (options.out.empty()) throw Failure("--rig needs --out, the file to write");
        vfit_avatar_desc body = vfit_avatar_desc_init();
        body.sex = sex_from(options.sex);
        export_character(context.get(), body, {}, rig_style_from(options.rig), options.out);
        if (!options.json) std::cout << options.out << "\n";
        if (options.file.empty()) return;
    }
    if (options.file.empty()) throw Failure("no character: give a file, or --rig to write one");
    const Avatar avatar = load(context.get(), options);
    if (!avatar.get().id) return;
    const Json about = report(avatar.get());
    if (!options.motion.empty()) {
        CharacterAnimation animation(avatar.get(), options.file);
        move(context.get(), avatar.get(), options, animation);
        if (!options.out.empty()) animation.write(options.out);
    }
    if (!options.picture.empty()) draw(avatar.get(), options.picture);
    if (options.json)
        print_document(about);
    else
        print(about);
}

}  // namespace

void add_character(Command& app) {
    Command command =
        app.add_subcommand("character", "Look at a character's file, move it, or write vfit's body as one");
    auto o = std::make_shared<Options>();
    command.add_option("file", o->file, "glTF or VRM file of a skinned humanoid");
    command.add_option("--scale", o->scale, "Metres in a unit of the file (default: 1)").positive();
    command.add_option("--bone-map", o->bone_map, "JSON file {\"hips\": \"name of a node\", ...}");
    command.add_flag("--nodes", o->nodes,
                     "Where bones are not found: print a bone map to fill in, and the nodes");
    command.add_option(
        "--motion", o->motion,
        "Recording folder, sensor URI, file of joints or BVH file whose person moves the character");
    command.add_option("--frames", o->frames, "Frames of it (default: all)");
    command.add_option("--rig", o->rig, "Write vfit's body with that rig").one_of(rig_style_names());
    command.add_option("--sex", o->sex, "Of that body").one_of({"f", "m"});
    command.add_option("--out", o->out, "GLB or VRM file to write");
    command.add_option("--picture", o->picture, "PNG of the character, posed as it is last");
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] { character(*o); });
}

}  // namespace vfit::tools
