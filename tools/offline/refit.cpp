// vfit refit: garments put on a character's file, offline.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>

#include "avatar/character.h"
#include "avatar/gltf_document.h"
#include "client/assets.h"
#include "client/files.h"
#include "client/outfit.h"
#include "client/output.h"
#include "client/people.h"
#include "core/error.h"
#include "core/files.h"
#include "export/gltf_file.h"
#include "export/worn_character.h"
#include "offline/data_beside.h"
#include "offline/offline.h"
#include "picture/dressed_picture.h"
#include "refit/refit.h"

namespace vfit::tools {

namespace {

struct Options {
    std::string garments, character, out, take_off, bone_map, sex, picture;
    float scale = 1.0f, margin_cm = 0.5f;
    bool json = false;
};

vfit::Garment read_garment(const std::string& name, const FabricLibrary& fabrics) {
    if (name.empty()) throw Failure("a garment has no name");
    const bool is_path = name.find('/') != std::string::npos || name.ends_with(".json");
    const std::string path = is_path ? name : data_beside("garments/" + name + ".json");
    if (!std::filesystem::exists(path)) throw Failure(name + ": neither a garment file nor one of vfit_data");
    try {
        return parse_garment(vfit::read_file(path), fabrics);
    } catch (const Error& error) {
        throw Failure(path + ": " + error.what());
    }
}

/// The picture that a garment's file names: a file beside it, or in a glTF file beside it. Empty: there is
/// none.
std::string picture_bytes(const std::string& garment_file, const std::string& name) {
    if (name.empty() || !std::filesystem::exists(garment_file)) return {};
    const std::filesystem::path folder = std::filesystem::path(garment_file).parent_path();
    const std::string marker = "#/images/";
    const size_t at = name.find(marker);
    const std::filesystem::path file = folder / name.substr(0, at);
    if (!std::filesystem::is_regular_file(file)) return {};
    if (at == std::string::npos) {
        const std::string bytes = read_text(file.string());
        const bool is_picture = bytes.compare(0, 4, "\x89PNG") == 0 || bytes.compare(0, 2, "\xff\xd8") == 0;
        return is_picture ? bytes : std::string();
    }
    const tinygltf::Model model = read_gltf(file.string());
    const size_t image = size_t(std::atoi(name.c_str() + at + marker.size()));
    if (image >= model.images.size()) return {};
    return {model.images[image].image.begin(), model.images[image].image.end()};
}

/// As it is shown: files state linear colors.
Color color_of(const vfit::Garment& garment) {
    if (garment.parts.empty()) return kGarmentColor;
    const Vec3& linear = garment.parts[0].color;
    constexpr float kGamma = 1.0f / 2.2f;
    return {std::pow(linear.x, kGamma), std::pow(linear.y, kGamma), std::pow(linear.z, kGamma)};
}

/// The file with its data plain, and with its pictures.
tinygltf::Model plain_model(const GltfDocument& document, const std::string& path) {
    tinygltf::Model model = document.model();
    model.images = read_gltf(path).images;
    return model;
}

/// A garment is fitted at the size of a person: any scale at which the character can be loaded does.
Character load_any_size(const GltfDocument& document, const std::string& bone_map, float scale) {
    std::string cause;
    for (const float size : {1.0f, 0.01f, 0.3f, 0.1f, 0.001f, 3.0f}) {
        try {
            return load_character(document, bone_map, size * scale);
        } catch (const Error& error) {
            if (cause.empty()) cause = error.what();
            if (cause.find(" m tall") == std::string::npos) throw;
        }
    }
    throw Failure(cause);
}

class Refit {
public:
    explicit Refit(const Options& options)
        : options_(options),
          model_(BodyModel::load(data_beside("body.bin"))),
          fabrics_(FabricLibrary::parse(vfit::read_file(data_beside("fabrics.json")))),
          jobs_(Jobs::own(1)),
          document_(options.character),
          character_(load_any_size(document_, options.bone_map.empty() ? "" : read_text(options.bone_map),
                                   options.scale)) {
        for (const std::string& name : split(options.garments, '+')) {
            names_.push_back(name);
            garments_.push_back(read_garment(name, fabrics_));
        }
        RefitRequest request;
        request.sex = options.sex.empty() ? VFIT_SEX_UNKNOWN : sex_from(options.sex);
        request.margin_m = options.margin_cm / 100.0f;
        if (!options.take_off.empty()) request.taken_off = split(options.take_off, ',');
        refitted_ = refit(character_, garments_, model_, fabrics_, request, *jobs_);
    }

    void write() const {
        WornCharacter worn;
        const std::vector<AvatarBone>& bones = character_.source.bones;
        std::vector<int> joint_of(bones.size(), -1);
        for (const RefittedGarment& garment : refitted_.garments)
            for (size_t v = 0; v < garment.bones.size(); ++v)
                for (size_t k = 0; k < 4; ++k)
                    if (garment.weights[v][k] > 0.0f) joint_of[garment.bones[v][k]] = 0;
        for (size_t b = 0; b < bones.size(); ++b) {
            if (joint_of[b] < 0) continue;
            joint_of[b] = int(worn.joints.size());
            worn.joints.push_back({bones[b].node, character_.node_worlds[size_t(bones[b].node)]});
        }
        const Mat4 to_file = glm::inverse(character_.from_file);
        for (size_t g = 0; g < garments_.size(); ++g) worn.meshes.push_back(mesh_of(g, joint_of, to_file));
        for (const CharacterPart& part : character_.parts) {
            const auto first = refitted_.hidden.begin() + std::ptrdiff_t(part.first_index / 3);
            worn.hidden.push_back({part.node, part.primitive, {first, first + part.index_count / 3}});
        }
        write_worn_character(plain_model(document_, options_.character), worn, options_.out);
    }

    void draw(const std::string& path) const {
        RenderMesh body;
        const Mesh& rest = character_.source.rest;
        body.positions = rest.positions, body.normals = rest.normals;
        body.color = {0.80f, 0.60f, 0.48f};
        for (size_t t = 0; t < refitted_.hidden.size(); ++t)
            if (!refitted_.hidden[t])
                body.indices.insert(body.indices.end(), &rest.indices[3 * t], &rest.indices[3 * t] + 3);
        std::vector<RenderMesh> meshes = {body};
        for (size_t g = 0; g < garments_.size(); ++g) {
            RenderMesh mesh;
            mesh.positions = refitted_.garments[g].positions, mesh.normals = refitted_.garments[g].normals;
            mesh.indices = garments_[g].drawn_indices();
            mesh.color = color_of(garments_[g]);
            meshes.push_back(std::move(mesh));
        }
        Vec3 low = rest.positions.front(), high = low;
        for (const Vec3& p : rest.positions) low = glm::min(low, p), high = glm::max(high, p);
        RenderView view;
        view.target = 0.5f * (low + high);
        view.eye = view.target + Vec3(0.8f, 0.25f, 2.4f) * (high.y - low.y);
        step_back_to_show(meshes, view);
        render(meshes, view).write_png(path);
    }

    Json report() const {
        Json list = Json::array(), outside = Json::array();
        for (size_t g = 0; g < garments_.size(); ++g) {
            const RefittedGarment& r = refitted_.garments[g];
            list.push_back({{"garment", names_[g]},
                            {"mesh", garments_[g].name},
                            {"vertices", r.positions.size()},
                            {"skin_crossings", r.skin_crossings},
                            {"self_crossings", r.self_crossings},
                            {"strain_p99", r.strain_p99}});
        }
        for (const Refitted::Outside& part : refitted_.outside)
            outside.push_back({{"mesh", part.mesh},
                               {"material", part.material},
                               {"outside_m", std::round(1e3 * double(part.by_m)) / 1e3}});
        const size_t hidden = size_t(std::count(refitted_.hidden.begin(), refitted_.hidden.end(), 1));
        return {{"out", options_.out},
                {"garments", list},
                {"hidden_triangles", hidden},
                {"triangles", refitted_.hidden.size()},
                {"file_scale", glm::length(Vec3(character_.from_file[0]))},
                {"scale", refitted_.scale},
                {"outside", outside}};
    }

private:
    WornMesh mesh_of(size_t g, const std::vector<int>& joint_of, const Mat4& to_file) const {
        const vfit::Garment& garment = garments_[g];
        const RefittedGarment& fitted = refitted_.garments[g];
        WornMesh mesh;
        mesh.name = garment.name;
        mesh.uvs = garment.drawn_uvs(), mesh.indices = garment.drawn_indices();
        const Mat3 turn(to_file);
        for (size_t v = 0; v < fitted.positions.size(); ++v) {
            mesh.positions.push_back(Vec3(to_file * Vec4(fitted.positions[v], 1.0f)));
            mesh.normals.push_back(glm::normalize(turn * fitted.normals[v]));
            auto& joints = mesh.joints.emplace_back();
            auto& weights = mesh.weights.emplace_back();
            for (size_t k = 0; k < 4; ++k) {
                weights[k] = fitted.weights[v][k];
                joints[k] = weights[k] > 0.0f ? uint16_t(joint_of[fitted.bones[v][k]]) : uint16_t(0);
            }
        }
        for (const GarmentPart& part : garment.parts)
            mesh.parts.push_back({part.material, part.color, picture_bytes(names_[g], part.texture),
                                  3 * part.first_triangle, 3 * part.triangle_count});
        if (mesh.parts.empty())
            mesh.parts.push_back({"", Vec3(0.6f, 0.06f, 0.07f), "", 0, uint32_t(mesh.indices.size())});
        return mesh;
    }

    const Options& options_;
    std::shared_ptr<const BodyModel> model_;
    FabricLibrary fabrics_;
    std::unique_ptr<Jobs> jobs_;
    GltfDocument document_;
    Character character_;
    std::vector<std::string> names_;
    std::vector<vfit::Garment> garments_;
    Refitted refitted_;
};

void print(const Json& report) {
    for (const Json& g : report["garments"])
        std::cout << g["garment"].get<std::string>() << ": " << g["vertices"]
                  << " vertices, crosses the skin " << g["skin_crossings"] << " times and itself "
                  << g["self_crossings"] << " times\n";
    for (const Json& part : report["outside"]) {
        char text[16];
        std::snprintf(text, sizeof text, "%.0f", 100.0 * part["outside_m"].get<double>());
        std::cout << "  warning: the character's " << part["mesh"].get<std::string>() << " ("
                  << part["material"].get<std::string>() << ") reaches " << text
                  << " cm out of the body below the garment: take it off by --take-off\n";
    }
    std::cout << report["hidden_triangles"] << " of " << report["triangles"]
              << " triangles of the character are left out\n"
              << report["out"].get<std::string>() << "\n";
}

}  // namespace

void add_refit(Command& app) {
    Command command = app.add_subcommand("refit", "Put garments on a character's file, for good");
    auto o = std::make_shared<Options>();
    command.add_option("garments", o->garments, "Garments by name or file, A+B: B over A").required();
    command.add_option("character", o->character, "glTF or VRM file of a skinned humanoid").required();
    command.add_option("--out", o->out, "GLB or VRM file to write").required();
    command.add_option("--take-off", o->take_off, "Meshes or materials of the character to leave out, A,B");
    command.add_option("--scale", o->scale, "Metres in a unit of the file (default: 1)").positive();
    command.add_option("--bone-map", o->bone_map, "JSON file {\"hips\": \"name of a node\", ...}");
    command.add_option("--sex", o->sex, "Of the body inside the character (default: the garment's)")
        .one_of({"f", "m"});
    command.add_option("--margin", o->margin_cm,
                       "cm of hidden skin kept at a garment's edges (default: 0.5)");
    command.add_option("--picture", o->picture, "PNG of the character as it stands in its file");
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] {
        std::error_code none;
        if (std::filesystem::equivalent(o->character, o->out, none))
            throw WrongUsage("--out is the character's own file");
        if (!(o->margin_cm >= 0.0f && o->margin_cm <= 100.0f))
            throw WrongUsage("--margin is not in 0 to 100 cm");
        const Refit refit(*o);
        refit.write();
        if (!o->picture.empty()) refit.draw(o->picture);
        if (o->json)
            print_document(refit.report());
        else
            print(refit.report());
    });
}

}  // namespace vfit::tools
