#include "population/body_measures.h"

#include <fstream>

#include "anthropometry/tape_mesh.h"
#include "avatar/avatar_measures.h"
#include "core/error.h"
#include "geometry/section.h"

namespace vfit::tools {

BodyMeasures measures_of(const std::shared_ptr<const BodyModel>& model, vfit_sex sex,
                         const std::vector<float>& shape, double navel_share) {
    const vfit::Avatar avatar(model, {sex}, shape, Vec2(1.0f));
    BodyMeasures out;
    for (const Measurement& m : measure_avatar(avatar, sex)) out[m.key] = double(m.value);
    Body joints;
    const Mesh mesh = avatar.measuring_mesh({}, &joints);
    const TapeMesh tape(
        {mesh.positions, mesh.indices, avatar.parts().first(mesh.positions.size()), joints, sex});
    const std::vector<Vec2> navel = tape.trunk(float(navel_share * out["stature_m"])).points();
    out["navel_girth_m"] = double(hull_perimeter(navel));
    out["navel_breadth_m"] = double(extent(navel).breadth());
    out["navel_depth_m"] = double(extent(navel).depth());
    return out;
}

void write_mesh(const std::string& path, const std::shared_ptr<const BodyModel>& model, vfit_sex sex,
                const std::vector<float>& shape) {
    const vfit::Avatar avatar(model, {sex}, shape, Vec2(1.0f));
    Body body;
    const Mesh mesh = avatar.measuring_mesh({}, &body);
    std::ofstream out(path);
    for (const int joint : {VFIT_JOINT_NECK, VFIT_JOINT_LEFT_HIP, VFIT_JOINT_RIGHT_HIP}) {
        const Vec3& p = body.at(joint);
        out << "# joint " << joint_name(joint) << " " << p.x << " " << p.y << " " << p.z << "\n";
    }
    for (const Vec3& p : mesh.positions) out << "v " << p.x << " " << p.y << " " << p.z << "\n";
    for (const bool arms : {false, true}) {
        out << (arms ? "g arms\n" : "g body\n");
        for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const uint32_t* f = &mesh.indices[i];
            if (is_arm(avatar.parts()[f[0]]) == arms)
                out << "f " << f[0] + 1 << " " << f[1] + 1 << " " << f[2] + 1 << "\n";
        }
    }
    if (!out.flush()) fail(VFIT_ERROR_IO, path, ": cannot be written");
}

}  // namespace vfit::tools
