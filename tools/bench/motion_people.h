// Virtual people who walk, step, turn and jump: what the tracker says of them beside the truth.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "frame/body.h"

namespace vfit::tools {

struct PersonFrame {
    Body tracked;                   // world; joints not seen where the tracker found nobody
    Body truth;                     // world, with rotations
    std::array<bool, 2> planted{};  // truth, left and right
};

struct PersonStream {
    std::string motion;
    std::vector<PersonFrame> frames;
};

/// The first virtual person of a URI, seen by the built-in tracker; two in view are not told apart.
std::vector<PersonFrame> person_on_feet(const std::string& uri);

/// Every motion by as many people, seen by the built-in tracker in the images of a Kinect v1.
std::vector<PersonStream> people_on_their_feet(uint32_t people, uint32_t frames);
/// The same with the captured walks of data/cmu_bvh, which are no scripts; empty without the shared folder.
std::vector<PersonStream> captured_walks(const std::string& shared, uint32_t frames);

/// The same people by ideal joints in the place of the tracker's: the truth without rotations, under the
/// noise of NoisySensor.
std::vector<PersonStream> with_noisy_joints(const std::vector<PersonStream>& streams);

}  // namespace vfit::tools
