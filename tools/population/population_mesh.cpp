#include "population/population_mesh.h"

#include <fstream>
#include <utility>
#include <vector>

#include "avatar/avatar.h"
#include "client/client.h"

namespace vfit::tools {

void write_mesh(const std::string& path, const std::shared_ptr<const BodyModel>& model,
                const PersonOfPopulation& person) {
    std::vector<float> shape = model->default_shape(person.sex);
    for (const auto& [name, value] : person.shape) shape[size_t(model->parameter(name))] = value;
    const vfit::Avatar avatar(model, {person.sex}, shape, Vec2(1.0f));
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
    if (!out.flush()) throw Failure(path + ": cannot be written");
}

}  // namespace vfit::tools
