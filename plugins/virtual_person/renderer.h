// One frame of the virtual person, start to end: motion, body, camera, sensor, ground truth.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "depth_camera.h"
#include "motion.h"
#include "options.h"
#include "person.h"
#include "sensor_noise.h"

namespace vfit::virtual_person {

class Renderer {
public:
    Renderer(vfit_context context, const Options& options, const std::map<std::string, float>& shape);

    const SensorModel& model() const { return model_; }
    const std::string& measures_json() const { return person_.measures_json(); }
    const vfit_intrinsics& intrinsics() const { return intrinsics_; }
    const vfit_camera& camera() const { return camera_info_; }

    /// Moves to the instant of that frame and renders the clean image.
    void advance(uint64_t frame);
    /// Of the current frame. Strides in bytes.
    void write_depth(uint16_t* pixels, uint32_t row_stride);
    void write_user_map(uint8_t* pixels, uint32_t row_stride) const;
    /// All joints in camera space, with their states; flags of the body in body.flags.
    const std::vector<vfit_joint>& joints(vfit_body& body);
    /// {"left": 1, "right": 0}
    const char* contacts_json() const;

    const CleanImage& clean() const { return clean_; }
    const Person& person() const { return person_; }

private:
    bool is_visible(const vfit_joint& joint, const Vec3& camera_point, bool& in_view) const;

    const SensorModel& model_;
    double frame_time_s_;
    Vec3 stand_;  // where the motion's origin is
    Quat facing_;
    Person person_;
    std::unique_ptr<Motion> motion_;
    DepthCamera camera_;
    SensorNoise noise_;
    CleanImage clean_;
    BonePose pose_;
    uint64_t frame_ = 0;
    std::vector<vfit_joint> joints_;
    vfit_intrinsics intrinsics_;
    vfit_camera camera_info_;
};

}  // namespace vfit::virtual_person
