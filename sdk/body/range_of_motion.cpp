#include "body/range_of_motion.h"

#include <string>

#include "body/range_of_motion_data.h"
#include "core/error.h"
#include "core/json.h"

namespace vfit {

namespace {

struct Angle {
    const char *joint, *motion;
    float* value;
    float sign;  // -1: the least of an interval
};

/// Every angle of the file and where it goes.
template <typename Visit>
void for_every_angle(RangeOfMotion& r, Visit&& visit) {
    const Angle angles[] = {
        {"shoulder", "extension", &r.shoulder_extension, 1},
        {"shoulder", "adduction", &r.shoulder_adduction, 1},
        {"shoulder", "internal_rotation", &r.shoulder_internal, 1},
        {"shoulder", "external_rotation", &r.shoulder_external, 1},
        {"elbow", "flexion", &r.elbow_flexion.most_deg, 1},
        {"elbow", "hyperextension", &r.elbow_flexion.least_deg, -1},
        {"forearm", "pronation", &r.forearm_pronation, 1},
        {"forearm", "supination", &r.forearm_supination, 1},
        {"wrist", "flexion", &r.wrist_flexion.most_deg, 1},
        {"wrist", "extension", &r.wrist_flexion.least_deg, -1},
        {"wrist", "radial", &r.wrist_radial.most_deg, 1},
        {"wrist", "ulnar", &r.wrist_radial.least_deg, -1},
        {"hip", "flexion", &r.hip_flexion.most_deg, 1},
        {"hip", "extension", &r.hip_flexion.least_deg, -1},
        {"hip", "abduction", &r.hip_abduction.most_deg, 1},
        {"hip", "adduction", &r.hip_abduction.least_deg, -1},
        {"hip", "internal_rotation", &r.hip_internal, 1},
        {"hip", "external_rotation", &r.hip_external, 1},
        {"knee", "flexion", &r.knee_flexion.most_deg, 1},
        {"knee", "hyperextension", &r.knee_flexion.least_deg, -1},
        {"knee", "twist", &r.hinge_play, 1},
        {"ankle", "dorsiflexion", &r.ankle_plantarflexion.least_deg, -1},
        {"ankle", "plantarflexion", &r.ankle_plantarflexion.most_deg, 1},
        {"ankle", "inversion", &r.ankle_inversion, 1},
        {"ankle", "eversion", &r.ankle_eversion, 1},
        {"neck", "flexion", &r.neck_flexion.most_deg, 1},
        {"neck", "extension", &r.neck_flexion.least_deg, -1},
        {"neck", "lateral", &r.neck_lateral, 1},
        {"neck", "rotation", &r.neck_rotation, 1},
        {"spine_total", "flexion", &r.spine_flexion.most_deg, 1},
        {"spine_total", "extension", &r.spine_flexion.least_deg, -1},
        {"spine_total", "lateral", &r.spine_lateral, 1},
        {"spine_total", "rotation", &r.spine_rotation, 1},
    };
    for (const Angle& angle : angles) visit(angle);
}

}  // namespace

RangeOfMotion RangeOfMotion::read(std::string_view json, const RangeOfMotion& base) {
    const Json given = parse_json(json, "range of motion");
    if (!given.is_object())
        fail(VFIT_ERROR_DATA, "range of motion: no object {\"knee\": {\"flexion\": 145}, ...}");
    RangeOfMotion out = base;
    for (const auto& [joint, motions] : given.items()) {
        if (joint == "source") continue;
        if (!motions.is_object())
            fail(VFIT_ERROR_DATA, "range of motion: ", joint, " is no object of angles");
        for (const auto& [motion, value] : motions.items()) {
            bool known = false;
            for_every_angle(out, [&](const Angle& angle) {
                if (joint != angle.joint || motion != angle.motion) return;
                known = true;
                if (!value.is_number() || !(value.get<double>() >= 0.0 && value.get<double>() <= 180.0))
                    fail(VFIT_ERROR_DATA, "range of motion: ", joint, ".", motion,
                         " is no angle of 0 to 180 degrees");
                *angle.value = angle.sign * value.get<float>();
            });
            if (!known) fail(VFIT_ERROR_DATA, "range of motion: \"", joint, ".", motion, "\" is not known");
        }
    }
    return out;
}

const RangeOfMotion& RangeOfMotion::natural() {
    static const RangeOfMotion range = read(kRangeOfMotionData, RangeOfMotion());
    return range;
}

}  // namespace vfit
