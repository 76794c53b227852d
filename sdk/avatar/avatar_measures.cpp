#include "avatar/avatar_measures.h"

#include <algorithm>
#include <cmath>

#include "anthropometry/tape.h"
#include "anthropometry/tape_landmarks.h"

namespace vfit {

namespace {

/// A posture of the avatar and what its measures refer to.
struct Posed {
    Mesh mesh;
    TapeBody tape;

    Posed(const Avatar& avatar, const MeasuringPosture& posture, vfit_sex sex) {
        mesh = avatar.measuring_mesh(posture, &tape.joints);
        tape.positions = mesh.positions;
        tape.indices = mesh.indices;
        tape.parts = avatar.parts().first(mesh.positions.size());
        tape.sex = sex;
    }
};

}  // namespace

std::vector<Measurement> measure_avatar(const Avatar& avatar, vfit_sex sex) {
    const Posed arms_out(avatar, MeasuringPosture{}, sex), arms_down(avatar, kBideltoidPosture, sex),
        feet_together(avatar, kStaturePosture, sex);
    return tape_measures({arms_out.tape, arms_down.tape, feet_together.tape});
}

std::vector<TrunkLevel> trunk_levels(const Avatar& avatar, vfit_sex sex) {
    const Posed posed(avatar, MeasuringPosture{}, sex);
    const TapeMesh body(posed.tape);
    const float armpit = armpit_height(body), waist = waist_height(body);
    std::vector<TrunkLevel> levels;
    for (const auto& [key, height] :
         {std::pair("chest_girth_m", chest_height(body, armpit)), std::pair("waist_girth_m", waist),
          std::pair("hip_girth_m", hip_height(body, crotch_height(body), waist))}) {
        // The trunk's skin near the tape, as it lies on the body at rest.
        constexpr float kNear_m = 0.015f;
        float offset = 0.0f, front = -INFINITY, back = INFINITY;
        int count = 0;
        for (size_t v = 0; v < posed.mesh.positions.size(); ++v) {
            if (posed.tape.parts[v] != BodyPart::kTorso ||
                std::abs(posed.mesh.positions[v].y - height) > kNear_m)
                continue;
            const Vec3& rest = avatar.rest().positions[v];
            offset += rest.y - posed.mesh.positions[v].y;
            front = std::max(front, rest.z), back = std::min(back, rest.z);
            ++count;
        }
        if (count > 0) levels.push_back({key, height + offset / float(count), 0.5f * (front + back)});
    }
    return levels;
}

}  // namespace vfit
