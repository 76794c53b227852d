// What is in the room besides the one person whom the options describe: furniture, a box that passes, other
// people.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "depth_camera.h"
#include "motion.h"
#include "occluder.h"
#include "options.h"
#include "person.h"
#include "seen_joints.h"
#include "solids.h"

namespace vfit::virtual_person {

class Surroundings {
public:
    /// `camera`: of the renderer, alive as long as this. `stand`: where the person of the options is.
    Surroundings(vfit_context context, const Options& options, const SensorModel& model,
                 const CameraPlace& place, const DepthCamera& camera, const Vec3& stand);
    ~Surroundings();

    /// Nothing but the person and the room: the image of the person is the whole picture.
    bool empty() const { return furniture_.empty() && !occluder_ && others_.empty(); }
    /// The picture with everything in it; valid until the next call.
    const CleanImage& complete(const CleanImage& person, double t_s);
    /// The other people in the completed picture, ids from 2 on.
    void see_others(std::vector<SeenBody>& out) const;

private:
    struct Other;
    struct Spot {
        size_t pixel;
        float depth_m, cosine;
    };

    void solve_furniture(const std::vector<Solid>& solids, const SensorModel& model);

    const DepthCamera& camera_;
    SolidPainter painter_;
    std::vector<Spot> furniture_;  // does not move: where it is seen from the camera
    std::optional<Occluder> occluder_;
    std::vector<std::unique_ptr<Other>> others_;
    CleanImage picture_;
};

}  // namespace vfit::virtual_person
