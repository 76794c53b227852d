#include "renderer.h"

#include <cmath>
#include <cstring>

namespace vfit::virtual_person {

namespace {

// A joint lies inside the body: it counts as seen where the skin in front of it is that of its own part, that
// is no farther than the part is thick.
constexpr float kTrunkThickness_m = 0.22f, kLimbThickness_m = 0.12f;

float thickness_m(vfit_joint_id joint) {
    switch (joint) {
        case VFIT_JOINT_HEAD:
        case VFIT_JOINT_NECK:
        case VFIT_JOINT_TORSO:
        case VFIT_JOINT_PELVIS:
        case VFIT_JOINT_CHEST:
        case VFIT_JOINT_LEFT_HIP:
        case VFIT_JOINT_RIGHT_HIP:
        case VFIT_JOINT_LEFT_CLAVICLE:
        case VFIT_JOINT_RIGHT_CLAVICLE: return kTrunkThickness_m;
        default: return kLimbThickness_m;
    }
}

vfit_sex sex_of(const Options& options) {
    const std::string& sex = options.text("sex");
    return sex == "f" ? VFIT_SEX_FEMALE : sex == "m" ? VFIT_SEX_MALE : VFIT_SEX_UNKNOWN;
}

CameraPlace place_of(const Options& options) {
    return {static_cast<float>(options.number("camera_height")),
            glm::radians(static_cast<float>(options.number("tilt")))};
}

Room room_of(const Options& options) {
    const double behind = options.number("wall");
    return {behind > 0 ? static_cast<float>(behind + options.number("distance")) : 0.0f,
            static_cast<float>(options.number("side_wall"))};
}

NoiseSettings noise_of(const Options& options) {
    return {static_cast<float>(options.number("noise")), options.flag("quantise"), options.flag("shadow"),
            options.whole("seed")};
}

}  // namespace

Renderer::Renderer(vfit_context context, const Options& options, const std::map<std::string, float>& shape)
    : model_(*find_sensor_model(options.text("sensor"))),
      frame_time_s_(1.0 / options.number("rate")),
      stand_(0, 0, -static_cast<float>(options.number("distance"))),
      facing_(rotate_y(static_cast<float>(options.number("facing")))),
      person_(context, sex_of(options), static_cast<uint32_t>(options.whole("detail")), shape),
      camera_(model_, place_of(options), room_of(options)),
      noise_(model_, noise_of(options)) {
    const std::string& bvh = options.text("bvh");
    motion_ = bvh.empty()
                  ? make_scripted_motion(options.text("motion"), person_.proportions(), options.whole("seed"))
                  : make_bvh_motion(bvh, person_.proportions());
    camera_.set_triangles(person_.triangles(), person_.vertex_count());

    intrinsics_ = vfit_intrinsics_init();
    intrinsics_.width = model_.width, intrinsics_.height = model_.height;
    intrinsics_.fx = model_.fx, intrinsics_.fy = model_.fy, intrinsics_.cx = model_.cx,
    intrinsics_.cy = model_.cy;

    const CameraPlace place = place_of(options);
    camera_info_ = vfit_camera_init();
    camera_info_.floor_state = VFIT_FLOOR_GIVEN;
    camera_info_.depth_unit_m = 0.001f;
    camera_info_.height_m = place.height_m, camera_info_.tilt_rad = place.tilt_rad;
    const Vec3 up = glm::transpose(camera_.world_from_camera()) * Vec3(0, 1, 0);
    for (int k = 0; k < 3; ++k) camera_info_.floor_normal[k] = up[k];
    camera_info_.floor_distance_m = place.height_m;
}

void Renderer::advance(uint64_t frame) {
    frame_ = frame;
    pose_ = motion_->at(static_cast<double>(frame) * frame_time_s_);
    pose_.hips = facing_ * pose_.hips;
    pose_.rotation[VFIT_BONE_HIPS] = facing_ * pose_.rotation[VFIT_BONE_HIPS];
    person_.pose(pose_, stand_);
    camera_.render(person_.positions(), clean_);
}

void Renderer::write_depth(uint16_t* pixels, uint32_t row_stride) {
    noise_.apply(clean_, frame_, pixels, row_stride);
}

void Renderer::write_user_map(uint8_t* pixels, uint32_t row_stride) const {
    for (uint32_t y = 0; y < clean_.height; ++y)
        std::memcpy(pixels + size_t{y} * row_stride, clean_.user.data() + size_t{y} * clean_.width,
                    clean_.width);
}

bool Renderer::is_visible(const vfit_joint& joint, const Vec3& p, bool& in_view) const {
    in_view = false;
    if (p.z <= 0.0f) return false;
    const Vec2 pixel = camera_.project(p) + 0.5f;
    if (!(pixel.x >= 0.0f && pixel.y >= 0.0f && pixel.x < static_cast<float>(clean_.width) &&
          pixel.y < static_cast<float>(clean_.height)))
        return false;
    in_view = true;
    const size_t i = static_cast<size_t>(pixel.y) * clean_.width + static_cast<size_t>(pixel.x);
    return clean_.user[i] && p.z - clean_.depth_m[i] < thickness_m(joint.joint);
}

const std::vector<vfit_joint>& Renderer::joints(vfit_body& body) {
    joints_.assign(person_.joints().begin(), person_.joints().end());
    const Quat to_camera = glm::quat_cast(glm::transpose(camera_.world_from_camera()));
    for (vfit_joint& joint : joints_) {
        const Vec3 p = camera_.to_camera({joint.position[0], joint.position[1], joint.position[2]});
        for (int k = 0; k < 3; ++k) joint.position[k] = p[k];
        const Quat turned =
            to_camera * Quat(joint.rotation[3], joint.rotation[0], joint.rotation[1], joint.rotation[2]);
        joint.rotation[0] = turned.x, joint.rotation[1] = turned.y;
        joint.rotation[2] = turned.z, joint.rotation[3] = turned.w;
        bool in_view = false;
        const bool seen = is_visible(joint, p, in_view);
        joint.state = seen ? VFIT_JOINT_MEASURED : VFIT_JOINT_INFERRED;
        joint.confidence = 1.0f;  // its place is known exactly either way
        if (!in_view) body.flags |= VFIT_BODY_PARTLY_OUT_OF_VIEW;
    }
    return joints_;
}

const char* Renderer::contacts_json() const {
    static constexpr const char* kTexts[2][2] = {
        {R"({"left": 0, "right": 0})", R"({"left": 0, "right": 1})"},
        {R"({"left": 1, "right": 0})", R"({"left": 1, "right": 1})"}};
    return kTexts[pose_.contact[kLeft]][pose_.contact[kRight]];
}

}  // namespace vfit::virtual_person
