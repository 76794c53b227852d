#include "sample.h"

#include <algorithm>
#include <map>
#include <optional>

#include "body/usual_shape.h"
#include "clutter.h"
#include "posture.h"
#include "solids.h"

namespace vfit::training {

namespace {

struct Sensor {
    uint32_t width, height;
    float focal_px;
    Light light;
    float weight;
};
// Kinect v1 at both sizes, Kinect v2, a stereo camera with a wide view, Azure Kinect (narrow).
constexpr std::array<Sensor, 5> kSensors = {{{320, 240, 285.0f, Light::kStructured, 0.40f},
                                             {640, 480, 575.0f, Light::kStructured, 0.22f},
                                             {512, 424, 365.0f, Light::kTimeOfFlight, 0.18f},
                                             {640, 480, 385.0f, Light::kStructured, 0.10f},
                                             {640, 576, 505.0f, Light::kTimeOfFlight, 0.10f}}};

/// One body in four has proportions that are rare in people and common in drawn characters.
std::vector<float> random_shape(const BodyModel& model, Random& random) {
    const float unlike = random.chance(0.25f) ? 2.0f : 1.0f;
    std::vector<float> shape = model.default_shape(VFIT_SEX_UNKNOWN);
    std::map<std::string, float> sides;  // left and right share their value
    for (size_t i = 0; i < shape.size(); ++i) {
        const ShapeParameter& p = model.parameters()[i];
        float value;
        if (p.key == "gender")
            value = random.chance(0.5f) ? random.between(0, 0.25f) : random.between(0.75f, 1);
        else if (p.key == "age")
            value = random.between(0.4f, 0.9f);
        else if (p.minimum >= 0.0f)
            value = std::clamp(random.normal(0.5f, 0.2f * unlike), 0.05f, 1.0f);
        else {
            const bool sided = p.key.size() > 2 && p.key[1] == '-';
            const std::string key = sided ? p.key.substr(2) : p.key;
            const auto known = sides.find(key);
            value = known != sides.end()
                        ? known->second
                        : std::clamp(random.normal(usual_measure(p.key), 0.22f * unlike), -0.8f, 0.9f);
            sides[key] = value;
        }
        shape[i] = value;
    }
    return shape;
}

/// Mostly towards the sensor; often from the side, where one leg hides the other; every other way now and
/// then.
float random_facing(Random& random) {
    switch (random.pick({0.44f, 0.28f, 0.28f})) {
        case 0: return std::clamp(random.normal(0, glm::radians(22.0f)), -1.2f, 1.2f);
        case 1: return (random.chance(0.5f) ? 1.0f : -1.0f) * glm::radians(random.between(50, 130));
        default: return random.between(-kPi, kPi);
    }
}

/// A board before the person, as of a desk or a counter. Of the board only its edge is left: the rest is a
/// plane, which the user map leaves out.
struct Desk {
    float top_m, half_m, front_z, deep_m, panel_m, x;

    Desk(const Vec3& person, Random& random)
        : top_m(random.between(0.6f, 1.1f)),
          half_m(random.between(0.4f, 1.0f)),
          front_z(person.z + random.between(0.25f, 1.0f)),
          deep_m(front_z - person.z - random.between(0.1f, 0.25f)),
          panel_m(random.chance(0.5f) ? random.between(0.2f, 1.1f) : 0.0f),
          x(person.x + random.normal(0, 0.2f)) {}

    void add_edge(Random& random, Mesh& out) const {
        const float half = random.between(0.008f, 0.025f);
        add_box({x, top_m - half, front_z}, size(half_m, half, 0.01f), out);
    }
    /// Takes from the shot what the board and the panel below it hide.
    void hide(Shot& shot) const {
        const Mat4 to_world = shot.camera.world_from_camera();
        const Vec3 eye(to_world[3]);
        for (int v = 0; v < int(shot.camera.height); ++v)
            for (int u = 0; u < int(shot.camera.width); ++u) {
                float& depth = shot.depth_m[shot.index(u, v)];
                if (depth <= 0.0f) continue;
                const Vec3 p = transform_point(to_world, shot.camera.unproject(float(u), float(v), depth));
                const auto at_z = [&](float z) { return glm::mix(eye, p, (z - eye.z) / (p.z - eye.z)); };
                if (p.z > front_z - 0.02f) continue;
                const Vec3 front = at_z(front_z), back = at_z(std::max(p.z, front_z - deep_m));
                if (std::abs(front.x - x) > half_m) continue;
                const bool through = (front.y - top_m) * (back.y - top_m) < 0.0f;
                const bool panel = front.y < top_m && front.y > top_m - panel_m;
                if (through || panel) depth = 0.0f;
            }
    }
};

}  // namespace

void Sampler::make_person(uint64_t number) {
    if (number == person_) return;
    person_ = number;
    Random random(seed_ ^ 0xB0D1E5ull, number);
    const std::vector<float> shape = random_shape(*model_, random);
    AvatarDesc desc;
    desc.twist_steps = 2;
    avatar_ = std::make_unique<Avatar>(model_, desc, shape, Vec2(1.0f));
    // Statures of grown-ups, now and then of a child.
    const float stature = random.chance(0.08f) ? random.between(1.2f, 1.5f)
                                               : std::clamp(random.normal(1.70f, 0.1f), 1.45f, 2.05f);
    const float scale = stature / avatar_->stature();
    const float breadth = std::clamp(random.normal(1.0f, 0.04f), 0.9f, 1.1f);
    avatar_ = std::make_unique<Avatar>(model_, desc, shape, Vec2(scale * breadth, scale));
    outfit_ = std::make_unique<Outfit>(*avatar_, random);
}

void Sampler::make(uint64_t index, Sample& out) {
    make_person(index / kPostures);
    for (uint64_t attempt = 0;; ++attempt) {
        Random random(seed_, (index << 8) + attempt);
        if (try_once(random, out)) return;
    }
}

bool Sampler::try_once(Random& random, Sample& out) {
    const bool person = random.chance(0.86f);
    const float yaw = random_facing(random);
    const Sensor& sensor = kSensors[random.pick({kSensors[0].weight, kSensors[1].weight, kSensors[2].weight,
                                                 kSensors[3].weight, kSensors[4].weight})];
    const float distance = random.chance(0.8f) ? random.between(1.9f, 3.6f) : random.between(1.3f, 4.3f);
    const float height = random.chance(0.7f) ? random.between(0.6f, 1.3f) : random.between(0.2f, 2.2f);
    const float across = 0.5f * float(sensor.width) / sensor.focal_px;
    // Now and then on the edge of the image, things oftener than people.
    const float beside = random.chance(person ? 0.06f : 0.35f)
                             ? across * distance + random.normal(-0.1f, 0.2f)
                             : random.normal(0, 0.12f) * distance;
    const Vec3 place(random.chance(0.5f) ? beside : -beside, 0.0f, -distance);
    std::optional<Desk> desk;
    if (person && random.chance(0.06f)) desk.emplace(place, random);
    if (person)
        stand_person(yaw + std::atan2(place.x, distance), place, random);
    else {
        random_clutter(random, mesh_);
        for (Vec3& p : mesh_.positions) p += place;
    }

    if (desk) desk->add_edge(random, mesh_);
    Camera camera;
    camera.width = sensor.width, camera.height = sensor.height;
    camera.fx = camera.fy = sensor.focal_px * random.between(0.97f, 1.03f);
    camera.cx = 0.5f * float(sensor.width - 1), camera.cy = 0.5f * float(sensor.height - 1);
    // Aimed at the person's middle, more or less; a wide miss cuts feet or head.
    const float aim = 0.9f + random.normal(0, random.chance(person ? 0.1f : 0.4f) ? 0.45f : 0.1f);
    const float portrait = random.chance(0.05f) ? (random.chance(0.5f) ? 90.0f : -90.0f) : 0.0f;
    const float roll = glm::radians(random.normal(portrait, 2.0f));
    set_floor(camera, height, std::atan2(height - aim, distance), roll, VFIT_FLOOR_GIVEN);
    if (!take_shot(mesh_, camera, 12, shot_)) return false;
    if (desk) desk->hide(shot_);
    look_real(shot_, sensor.light, distance + random.between(0.3f, 3.0f), person, random, real_);

    // What the tracker believes to be up is a little wrong.
    const Vec2 up = glm::normalize(Vec2(camera.floor_normal.x, camera.floor_normal.y));
    const float wrong = random.normal(0, glm::radians(3.0f)), c = std::cos(wrong), s = std::sin(wrong);
    values_.resize(out.crop.size());
    CropView view;
    if (!cropper_.run(real_.image(), 1, {}, {up.x * c - up.y * s, up.x * s + up.y * c}, view, values_.data()))
        return false;
    for (size_t i = 0; i < values_.size(); ++i) out.crop[i] = int16_t(std::lround(values_[i] * 32767.0f));

    out.joints.fill(0.0f), out.inside.fill(0.0f);
    out.yaw_rad = yaw;
    out.person = person ? 1.0f : 0.0f;
    if (person) label(camera, view, out);
    return true;
}

/// Poses and dresses the body at that place of the floor.
void Sampler::stand_person(float turn, const Vec3& place, Random& random) {
    Pose pose = random_posture(avatar_->skeleton(), random);
    pose.rotation[VFIT_BONE_HIPS] = glm::angleAxis(turn, Vec3(0, 1, 0)) * pose.rotation[VFIT_BONE_HIPS];
    pose.hips_position = Vec3(0, 1, 0);
    avatar_->pose(pose, *jobs_);
    float lowest = 1e9f;
    for (const Vec3& p : avatar_->positions()) lowest = std::min(lowest, p.y);
    const float jump = random.chance(0.05f) ? random.between(0, 0.3f) : 0.0f;
    pose.hips_position = place + Vec3(0, 1.0f - lowest + jump, 0);
    avatar_->pose(pose, *jobs_);
    outfit_->dress(*avatar_, random, mesh_);
}

/// `camera` is the whole sensor's; the crop was cut from the window in shot_.
void Sampler::label(const Camera& camera, const CropView& view, Sample& out) const {
    const Body joints = avatar_->joints();
    const Mat4 to_camera = camera.camera_from_world();
    for (int j = 0; j < kJointCount; ++j) {
        const Vec3 p = transform_point(to_camera, joints.at(j));
        const Vec3 c = view.from_camera(shot_.camera, p);
        for (int k = 0; k < 3; ++k) out.joints[size_t(3 * j + k)] = c[k];
        const Vec2 q = camera.project(p);
        out.inside[size_t(j)] =
            p.z > 0.3f && q.x >= 0 && q.y >= 0 && q.x < float(camera.width) && q.y < float(camera.height)
                ? 1.0f
                : 0.0f;
    }
}

}  // namespace vfit::training
