#include "bench/motion_people.h"

#include <algorithm>
#include <filesystem>

#include "bench/motion_noise.h"
#include "bench/track_play.h"
#include "client/people.h"

namespace vfit::tools {

namespace {

constexpr const char* kMotions[] = {"walk", "step", "turn", "jump", "balance", "demo"};

Body body_of(vfit_frame frame, uint32_t id) {
    Body body;
    body.id = id;
    body.time_ns = view_of(frame, VFIT_STREAM_DEPTH).time_ns;
    const auto joints = list<vfit_joint>([&](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_frame_joints(frame, id, items, stride, n);
    });
    for (const vfit_joint& joint : joints) body.joints[size_t(joint.joint)] = joint_in(joint);
    return body;
}

std::array<bool, 2> contacts_of(vfit_frame frame) {
    char text[128] = {};
    check(vfit_frame_meta(frame, "contacts", text, sizeof text, nullptr));
    const Json json = Json::parse(text);
    constexpr int kWholeFoot = 1;  // 2: its heel or ball alone, which rolls
    return {json.at("left").get<int>() == kWholeFoot, json.at("right").get<int>() == kWholeFoot};
}

}  // namespace

std::vector<PersonFrame> person_on_feet(const std::string& uri) {
    std::vector<PersonFrame> frames;
    play_tracked(uri, VFIT_FIT_AUTO, [&](vfit_frame frame, vfit_frame tracked) {
        const auto truth = bodies_of(frame);
        if (truth.empty()) return;  // nobody is in view
        PersonFrame out;
        out.truth = body_of(frame, truth.front().body_id);
        out.planted = contacts_of(frame);
        out.tracked.time_ns = out.truth.time_ns;
        const auto bodies = bodies_of(tracked);
        if (!bodies.empty()) out.tracked = body_of(tracked, bodies.front().body_id);
        frames.push_back(out);
    });
    return frames;
}

std::vector<PersonStream> people_on_their_feet(uint32_t people, uint32_t frames) {
    std::vector<PersonStream> streams;
    for (const char* motion : kMotions)
        for (uint32_t person = 1; person <= people; ++person)
            streams.push_back(
                {motion,
                 person_on_feet("virtual:sensor=kinect_v1&distance=2.9&clothing=0.02&motion=" +
                                std::string(motion) + "&body=" + std::to_string(700 + person) +
                                "&seed=" + std::to_string(person) + "&frames=" + std::to_string(frames))});
    return streams;
}

std::vector<PersonStream> captured_walks(const std::string& shared, uint32_t frames) {
    namespace fs = std::filesystem;
    std::vector<PersonStream> streams;
    const fs::path folder = fs::path(shared) / "data/cmu_bvh";
    if (!fs::is_directory(folder)) return streams;
    std::vector<std::string> files;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".bvh") files.push_back(fs::absolute(entry.path()).string());
    std::sort(files.begin(), files.end());
    for (const std::string& file : files)
        streams.push_back(
            {"captured", person_on_feet("virtual:sensor=kinect_v1&distance=2.9&clothing=0.02&body=711&bvh=" +
                                        file + "&frames=" + std::to_string(frames))});
    return streams;
}

std::vector<PersonStream> with_noisy_joints(const std::vector<PersonStream>& streams) {
    std::vector<PersonStream> out = streams;
    uint32_t seed = 0;
    for (PersonStream& stream : out) {
        NoisySensor noisy(++seed);
        for (PersonFrame& frame : stream.frames) {
            frame.tracked = frame.truth;
            for (Joint& joint : frame.tracked.joints) {
                if (!joint.seen()) continue;
                joint.position = noisy(joint.position);
                joint.has_rotation = false;
                joint.state = VFIT_JOINT_MEASURED;
                joint.confidence = 1.0f;
            }
        }
    }
    return out;
}

}  // namespace vfit::tools
