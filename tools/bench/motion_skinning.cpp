// What skinning costs on one core, beside what the memory alone would take, and what a crowd costs.
#include <algorithm>
#include <cstring>
#include <iomanip>
#include <iostream>
#include <numeric>

#include "avatar/avatar.h"
#include "bench/bench.h"
#include "bench/motion_parts.h"
#include "bench/motion_people.h"
#include "motion/motion.h"

namespace vfit::tools {

namespace {

constexpr int kRuns = 300;
constexpr uint32_t kWeights = 4;  // of the meshes that the targets speak of

/// The first vertices of the finest body, each carried by exactly four bones.
struct Load {
    std::vector<Vec3> rest, normals;
    std::vector<SkinBones> bones;
    std::vector<SkinWeights> weights;
};

Load load_of(const vfit::Avatar& avatar, uint32_t vertex_count) {
    Load load;
    const auto rig = avatar.rig_bones();
    for (uint32_t v = 0; v < vertex_count; ++v) {
        load.rest.push_back(avatar.rest().positions[v]);
        load.normals.push_back(avatar.rest().normals[v]);
        SkinBones bones = avatar.skin_bones()[v];
        SkinWeights weights = avatar.skin_weights()[v];
        // Too few: ancestors of the heaviest bone join in.
        int ancestor = bones[0];
        for (uint32_t k = 1; k < kWeights; ++k) {
            if (weights[k] > 0.0f) continue;
            ancestor = std::max(0, rig[size_t(ancestor)].parent);
            bones[k] = uint16_t(ancestor);
            weights[k] = 0.02f;
        }
        for (size_t k = kWeights; k < kSkinBones; ++k) weights[k] = 0.0f;
        const float sum = std::accumulate(weights.begin(), weights.end(), 0.0f);
        for (float& w : weights) w /= sum;
        load.bones.push_back(bones);
        load.weights.push_back(weights);
    }
    return load;
}

/// Reads as many bytes and writes as many as the skin does, and nothing else.
class Copy {
public:
    Copy(size_t read, size_t written) : from_(read / 8, 1), to_(written / 8) {}
    double ms() {
        const Timer timer;
        std::memcpy(to_.data(), from_.data(), to_.size() * 8);
        uint64_t sum = 0;
        for (size_t i = to_.size(); i < from_.size(); ++i) sum += from_[i];
        keep_ = keep_ + sum;
        return timer.ms();
    }

private:
    std::vector<uint64_t> from_, to_;
    volatile uint64_t keep_ = 0;
};

struct Times {
    double ms, copy_ms, megabytes;
};

Times time_skin(const Skin& skin, std::span<const Mat4> matrices, SkinMethod method, size_t stride) {
    const auto jobs = Jobs::own(0);
    std::vector<unsigned char> out(skin.vertex_count() * std::max<size_t>(stride, 24) + 32);
    SkinTarget target;
    target.positions = out.data();
    target.normals = stride == 12 ? out.data() + size_t(skin.vertex_count()) * 12 : out.data() + 12;
    target.position_stride = target.normal_stride = stride;
    Skin::Scratch scratch;
    const size_t written = size_t(skin.vertex_count()) * 24;
    Copy copy(skin.bytes(), written);
    Samples ms, copy_ms;
    for (int run = 0; run < kRuns; ++run) {
        const Timer timer;
        skin.pose(matrices, method, Axes(), target, scratch, *jobs);
        ms.add(timer.ms());
        copy_ms.add(copy.ms());
    }
    return {ms.quantile(0.5), copy_ms.quantile(0.5), 1e-6 * double(skin.bytes() + written)};
}

void print(const std::string& name, const Times& t) {
    std::cout << "  " << std::left << std::setw(48) << name << std::right << std::fixed
              << std::setprecision(3) << std::setw(8) << t.ms << " ms;" << std::setprecision(1)
              << std::setw(6) << t.megabytes << " MB moved, alone " << std::setprecision(3) << t.copy_ms
              << " ms\n";
}

Json json_of(const Times& t) {
    return {{"ms", t.ms}, {"memory_alone_ms", t.copy_ms}, {"megabytes", t.megabytes}};
}

/// A hundred people, each with a tracked body of their own moment of the walk.
double crowd_ms(const std::shared_ptr<const BodyModel>& model, const PersonStream& stream) {
    constexpr size_t kPeople = 100;
    AvatarDesc desc;
    desc.detail = kCoarseBody;
    std::vector<vfit::Avatar> avatars;
    std::vector<vfit::Motion> motions;
    for (size_t i = 0; i < kPeople; ++i) {
        avatars.emplace_back(model, desc, std::span<const float>(), Vec2(0.95f + 0.001f * float(i)));
        motions.emplace_back(MotionSettings());
        motions.back().bind(avatars.back().skeleton());
    }
    const size_t vertices = avatars[0].rest().positions.size();
    std::vector<Vec3> positions(vertices * kPeople), normals(vertices * kPeople);
    const auto jobs = Jobs::own(0);
    Samples ms;
    for (size_t f = 0; f + kPeople < stream.frames.size() + 60; ++f) {
        const Timer timer;
        for (size_t i = 0; i < kPeople; ++i) {
            Body body = stream.frames[(f + i) % (stream.frames.size() - 1)].tracked;
            body.id = 1;
            body.time_ns = int64_t(f) * 33'333'333;
            motions[i].step(&body, body.time_ns);
            avatars[i].move(motions[i].pose());
            SkinTarget target;
            target.positions = &positions[vertices * i];
            target.normals = &normals[vertices * i];
            avatars[i].skin(target, Axes(), *jobs);
        }
        ms.add(timer.ms());
    }
    return ms.quantile(0.5);
}

}  // namespace

Json judge_skinning(const MotionJudge& judge) {
    const auto model = BodyModel::load(library_file("vfit_data/body.bin"));
    const PersonStream stream = {"walk",
                                 person_on_feet("virtual:sensor=kinect_v1_320&motion=walk&frames=120")};
    vfit::Motion motion{MotionSettings()};
    for (size_t i = 0; i < 20; ++i) motion.step(&stream.frames[i].tracked, stream.frames[i].tracked.time_ns);
    Json out;
    if (!judge.quiet) std::cout << "\nSkinning, one core, median of " << kRuns << ": positions and normals\n";

    AvatarDesc finest;
    finest.detail = kBodyLevels - 1;
    vfit::Avatar avatar(model, finest, {}, Vec2(1.0f));
    avatar.move(motion.pose());
    struct Size {
        uint32_t vertices;
        double target_ms;
    };
    for (const Size size : {Size{44'000, 0.5}, Size{120'000, 1.5}}) {
        const Load load = load_of(avatar, size.vertices);
        const Skin skin(load.bones, load.weights, load.rest, load.normals);
        const std::string name = std::to_string(size.vertices / 1000) + "k vertices, 4 weights";
        const Times t = time_skin(skin, avatar.skinning_matrices(), SkinMethod::linear, 12);
        const Times strided = time_skin(skin, avatar.skinning_matrices(), SkinMethod::linear, 32);
        const Times dual = time_skin(skin, avatar.skinning_matrices(), SkinMethod::dual_quaternion, 12);
        if (!judge.quiet) {
            print(name, t);
            print(name + ", into vertices of 32 bytes", strided);
            print(name + ", dual quaternions", dual);
        }
        judge.targets.judge(name, t.ms, Aim::at_most, size.target_ms, 3, " ms");
        judge.targets.judge(name + ", over memory alone", t.ms / t.copy_ms, Aim::at_most, 2.0, 2, " times");
        out[std::to_string(size.vertices)] = {
            {"linear", json_of(t)}, {"strided", json_of(strided)}, {"dual", json_of(dual)}};
    }
    const double crowd = crowd_ms(model, stream);
    judge.targets.judge("100 people: motion and a skin of 1k vertices", crowd, Aim::at_most, 4.0, 2, " ms");
    out["crowd_ms"] = crowd;
    return out;
}

}  // namespace vfit::tools
