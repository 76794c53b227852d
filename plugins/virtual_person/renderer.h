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
#include "random_body.h"
#include "sensor_noise.h"
#include "surroundings.h"

namespace vfit::virtual_person {

class Renderer {
public:
    Renderer(vfit_context context, const Options& options, const std::map<std::string, float>& shape);

    const SensorModel& model() const { return model_; }
    /// False: the room is shown without the person of the options.
    bool has_person() const { return has_person_; }
    const std::string& measures_json() const { return person_.measures_json(); }
    const vfit_intrinsics& intrinsics() const { return intrinsics_; }
    const vfit_camera& camera() const { return camera_info_; }

    /// Moves to the instant of that frame and renders the clean image.
    void advance(uint64_t frame);
    /// Of the current frame. Strides in bytes.
    void write_depth(uint16_t* pixels, uint32_t row_stride);
    void write_user_map(uint8_t* pixels, uint32_t row_stride) const;
    /// Everybody of whom a joint falls into the image, joints in camera space.
    const std::vector<SeenBody>& bodies();
    /// {"left": 1, "right": 0}
    const char* contacts_json() const;

    /// The picture before noise, with everything in it.
    const CleanImage& clean() const { return *picture_; }
    const Person& person() const { return person_; }

private:
    Renderer(vfit_context context, const Options& options, const RandomBody& body);
    /// Pixels of the person that lie above what the hair leaves to see.
    void find_hair();
    /// Whether something stands before that pixel of the person.
    bool hides(uint32_t pixel) const { return clean().depth_m[pixel] < clean_.depth_m[pixel]; }

    const SensorModel& model_;
    double frame_time_s_;
    Vec3 stand_;  // where the motion's origin is
    Quat facing_;
    bool has_person_;
    Person person_;
    std::unique_ptr<Motion> motion_;
    DepthCamera camera_;
    SensorNoise noise_;
    float black_hair_m_;
    std::vector<uint32_t> swallowed_;  // pixels of the hair
    CleanImage clean_;                 // the person of the options in the bare room
    Surroundings surroundings_;
    const CleanImage* picture_ = &clean_;
    BonePose pose_;
    uint64_t frame_ = 0;
    std::vector<SeenBody> bodies_;
    vfit_intrinsics intrinsics_;
    vfit_camera camera_info_;
};

}  // namespace vfit::virtual_person
