#include "avatar/avatar_measures.h"

#include "measure/tape.h"

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

}  // namespace vfit
