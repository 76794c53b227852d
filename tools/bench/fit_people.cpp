#include "bench/fit_people.h"

#include <algorithm>
#include <cmath>

#include "client/client.h"
#include "frame/floor.h"
#include "math/random.h"

namespace vfit::tools {

namespace {

/// The joint whose rotation is each bone's; -1 for the spine, which has none.
int joint_of_bone(int bone) {
    switch (bone) {
        case VFIT_BONE_HIPS: return VFIT_JOINT_PELVIS;
        case VFIT_BONE_CHEST: return VFIT_JOINT_TORSO;
        case VFIT_BONE_UPPER_CHEST: return VFIT_JOINT_CHEST;
        case VFIT_BONE_NECK: return VFIT_JOINT_NECK;
        case VFIT_BONE_HEAD: return VFIT_JOINT_HEAD;
        case VFIT_BONE_LEFT_SHOULDER: return VFIT_JOINT_LEFT_CLAVICLE;
        case VFIT_BONE_RIGHT_SHOULDER: return VFIT_JOINT_RIGHT_CLAVICLE;
        case VFIT_BONE_LEFT_UPPER_ARM: return VFIT_JOINT_LEFT_SHOULDER;
        case VFIT_BONE_RIGHT_UPPER_ARM: return VFIT_JOINT_RIGHT_SHOULDER;
        case VFIT_BONE_LEFT_LOWER_ARM: return VFIT_JOINT_LEFT_ELBOW;
        case VFIT_BONE_RIGHT_LOWER_ARM: return VFIT_JOINT_RIGHT_ELBOW;
        case VFIT_BONE_LEFT_HAND: return VFIT_JOINT_LEFT_WRIST;
        case VFIT_BONE_RIGHT_HAND: return VFIT_JOINT_RIGHT_WRIST;
        case VFIT_BONE_LEFT_UPPER_LEG: return VFIT_JOINT_LEFT_HIP;
        case VFIT_BONE_RIGHT_UPPER_LEG: return VFIT_JOINT_RIGHT_HIP;
        case VFIT_BONE_LEFT_LOWER_LEG: return VFIT_JOINT_LEFT_KNEE;
        case VFIT_BONE_RIGHT_LOWER_LEG: return VFIT_JOINT_RIGHT_KNEE;
        case VFIT_BONE_LEFT_FOOT: return VFIT_JOINT_LEFT_FOOT;
        case VFIT_BONE_RIGHT_FOOT: return VFIT_JOINT_RIGHT_FOOT;
        case VFIT_BONE_LEFT_TOES: return VFIT_JOINT_LEFT_TOES;
        case VFIT_BONE_RIGHT_TOES: return VFIT_JOINT_RIGHT_TOES;
        default: return -1;
    }
}

Pose pose_of(const std::vector<vfit_joint>& joints) {
    std::array<Quat, kBoneCount> world;
    world.fill(Quat(1, 0, 0, 0));
    Pose pose;
    for (int b = 0; b < kBoneCount; ++b)
        for (const vfit_joint& j : joints) {
            if (j.joint != joint_of_bone(b)) continue;
            world[size_t(b)] = Quat(j.rotation[3], j.rotation[0], j.rotation[1], j.rotation[2]);
            if (b == 0) pose.hips_position = {j.position[0], j.position[1], j.position[2]};
        }
    world[VFIT_BONE_SPINE] = glm::slerp(world[VFIT_BONE_HIPS], world[VFIT_BONE_CHEST], 0.5f);
    for (int b = 0; b < kBoneCount; ++b) {
        const int parent = bone_parent(b);
        pose.rotation[size_t(b)] = glm::normalize(
            parent < 0 ? world[size_t(b)] : glm::conjugate(world[size_t(parent)]) * world[size_t(b)]);
    }
    return pose;
}

std::vector<float> random_shape(const BodyModel& model, Random& random) {
    std::vector<float> shape = model.default_shape(VFIT_SEX_UNKNOWN);
    const float gender = random.unit() < 0.5f ? 0.1f : 0.9f;
    for (size_t i = 0; i < shape.size(); ++i) {
        const ShapeParameter& p = model.parameters()[i];
        const float usual = (1.0f - gender) * p.female + gender * p.male;
        float value = usual;
        if (p.key == "gender")
            value = gender;
        else if (p.key == "age")
            value = random.between(0.45f, 0.75f);
        else if (p.minimum >= 0.0f)
            value = usual + 0.15f * random.normal();
        else if (p.key.rfind("measure-", 0) == 0)
            value = 0.2f * random.normal();
        shape[i] = std::clamp(value, p.minimum, p.maximum);
    }
    return shape;
}

/// Thickness of what is worn at each vertex, metres.
std::vector<float> clothes_of(const vfit::Avatar& avatar, Random& random) {
    const float top = random.between(0.01f, 0.03f), trousers = random.between(0.01f, 0.03f);
    const float sleeves = random.between(0.01f, top), hair = random.between(0.005f, 0.025f), shoes = 0.01f;
    const Vec3 phase(random.between(0, 6), random.between(0, 6), random.between(0, 6));
    const auto& rest = avatar.rest().positions;
    std::vector<float> out(avatar.topology().vertex_count);
    float crown = 0.0f;
    for (const Vec3& p : rest) crown = std::max(crown, p.y);
    for (size_t v = 0; v < out.size(); ++v) {
        const Vec3 p = rest[v];
        // Folds of about 25 cm, up to a third of the thickness.
        const float folds = 1.0f + 0.33f * std::sin(25.0f * p.x + phase.x) * std::sin(25.0f * p.y + phase.y) *
                                       std::cos(25.0f * p.z + phase.z);
        float layer = 0.0f;
        switch (avatar.parts()[v]) {
            case BodyPart::kHead: layer = p.y > crown - 0.14f || p.z < -0.02f ? hair : 0.0f; break;
            case BodyPart::kTorso: layer = top; break;
            case BodyPart::kLeftUpperArm:
            case BodyPart::kRightUpperArm:
            case BodyPart::kLeftForearm:
            case BodyPart::kRightForearm: layer = sleeves; break;
            case BodyPart::kLeftHand:
            case BodyPart::kRightHand: break;
            case BodyPart::kLeftFoot:
            case BodyPart::kRightFoot: layer = shoes; break;
            default: layer = trousers;
        }
        out[v] = layer * folds;
    }
    return out;
}

/// Nguyen, Izadi, Lovell 2012 along the ray, outlines a pixel off now and then, steps of 1/8 px of disparity.
void make_noisy(const std::vector<float>& exact, Random& random, FitShot& shot) {
    const int w = int(shot.camera.width), h = int(shot.camera.height);
    shot.depth.assign(exact.size(), 0);
    shot.users.assign(exact.size(), 0);
    constexpr int kReach = 4;  // pixels that an outline may be off
    int x0 = w, y0 = h, x1 = 0, y1 = 0;
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x)
            if (exact[size_t(y * w + x)] > 0.0f)
                x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = y;
    for (int y = std::max(0, y0 - kReach); y <= std::min(h - 1, y1 + kReach); ++y)
        for (int x = std::max(0, x0 - kReach); x <= std::min(w - 1, x1 + kReach); ++x) {
            const int sx = std::clamp(x + int(std::lround(0.8f * random.normal())), 0, w - 1);
            const int sy = std::clamp(y + int(std::lround(0.8f * random.normal())), 0, h - 1);
            const float z = exact[size_t(sy * w + sx)];
            if (z <= 0.0f) continue;
            const float noisy = z + (0.0012f + 0.0019f * (z - 0.4f) * (z - 0.4f)) * random.normal();
            const float step = 2.85e-3f * z * z;
            shot.depth[size_t(y * w + x)] = uint16_t(std::lround(1000.0f * step * std::round(noisy / step)));
            shot.users[size_t(y * w + x)] = 1;
        }
}

}  // namespace

void draw_depth(const std::vector<Vec3>& positions, const std::vector<uint32_t>& triangles,
                const Camera& camera, std::vector<float>& depth_m) {
    const int w = int(camera.width), h = int(camera.height);
    depth_m.assign(size_t(w) * size_t(h), 0.0f);
    for (size_t t = 0; t + 2 < triangles.size(); t += 3) {
        const Vec3 &a = positions[triangles[t]], &b = positions[triangles[t + 1]],
                   &c = positions[triangles[t + 2]];
        if (a.z < 0.25f || b.z < 0.25f || c.z < 0.25f) continue;
        const Vec2 p = camera.project(a), q = camera.project(b), r = camera.project(c);
        const float area = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
        if (std::abs(area) < 1e-9f) continue;
        const int y1 = std::min(h - 1, int(std::floor(std::max({p.y, q.y, r.y}))));
        const int x1 = std::min(w - 1, int(std::floor(std::max({p.x, q.x, r.x}))));
        for (int y = std::max(0, int(std::ceil(std::min({p.y, q.y, r.y})))); y <= y1; ++y)
            for (int x = std::max(0, int(std::ceil(std::min({p.x, q.x, r.x})))); x <= x1; ++x) {
                const float fx = float(x), fy = float(y);
                const float wa = ((q.x - fx) * (r.y - fy) - (q.y - fy) * (r.x - fx)) / area;
                const float wb = ((r.x - fx) * (p.y - fy) - (r.y - fy) * (p.x - fx)) / area;
                const float wc = 1.0f - wa - wb;
                if (wa < 0 || wb < 0 || wc < 0) continue;
                const float z = 1.0f / (wa / a.z + wb / b.z + wc / c.z);
                float& here = depth_m[size_t(y) * size_t(w) + size_t(x)];
                if (here == 0.0f || z < here) here = z;
            }
    }
}

void play_person(const std::shared_ptr<const BodyModel>& model, const std::string& motion, uint32_t seed,
                 uint32_t frames, bool clothes, const std::function<void(const FitShot&)>& sink) {
    Random random(seed);
    vfit::Avatar avatar(model, {}, random_shape(*model, random), Vec2(1.0f));
    std::vector<float> layers = clothes_of(avatar, random);
    if (!clothes) std::fill(layers.begin(), layers.end(), 0.0f);
    const Context context = open_context();
    const std::string distance = motion == "walk" ? "3.2" : "2.7";
    Source source(context.get(), "virtual:sensor=kinect_v1_320&noise=0&motion=" + motion +
                                     "&distance=" + distance + "&frames=" + std::to_string(frames) +
                                     "&seed=" + std::to_string(seed));
    FitShot shot;
    shot.camera.width = 640, shot.camera.height = 480;
    shot.camera.fx = shot.camera.fy = 571.26f;
    shot.camera.cx = 319.5f, shot.camera.cy = 239.5f;
    set_floor(shot.camera, 1.0f, 0.0f, 0.0f, VFIT_FLOOR_GIVEN);
    const Mat4 to_camera_space = shot.camera.camera_from_world();
    std::vector<Vec3> seen(avatar.topology().vertex_count);
    std::vector<float> exact;
    const auto jobs = Jobs::own(0);
    while (const auto frame = source.next()) {
        const std::vector<vfit_joint> joints = joints_of(frame->get(), first_body(frame->get()));
        Pose pose = pose_of(joints);
        avatar.pose(pose, *jobs);
        float lowest = 1e9f;  // other legs than the motion's own: back to the floor
        for (const Vec3& p : avatar.positions()) lowest = std::min(lowest, p.y);
        pose.hips_position.y -= lowest;
        avatar.pose(pose, *jobs);
        for (size_t v = 0; v < seen.size(); ++v)
            seen[v] =
                transform_point(to_camera_space, avatar.positions()[v] + layers[v] * avatar.normals()[v]);
        draw_depth(seen, avatar.topology().indices, shot.camera, exact);
        make_noisy(exact, random, shot);
        shot.truth = vfit::to_camera(avatar.joints(), shot.camera);
        shot.time_ns += 33333333;
        sink(shot);
    }
}

}  // namespace vfit::tools
