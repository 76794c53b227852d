#include "renderer.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace vfit::virtual_person {

namespace {

constexpr float kHeadRadius_m = 0.25f;  // from the head's middle, with hair and whatever the pose

vfit_sex sex_of(const Options& options) {
    const std::string& sex = options.text("sex");
    return sex == "f" ? VFIT_SEX_FEMALE : sex == "m" ? VFIT_SEX_MALE : VFIT_SEX_UNKNOWN;
}

RandomBody body_of(const Options& options, const std::map<std::string, float>& shape) {
    const uint64_t number = options.whole("body");
    return number > 0 ? draw_body(number, sex_of(options), shape) : RandomBody{sex_of(options), shape};
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
    : Renderer(context, options, body_of(options, shape)) {}

Renderer::Renderer(vfit_context context, const Options& options, const RandomBody& body)
    : model_(*find_sensor_model(options.text("sensor"))),
      frame_time_s_(1.0 / options.number("rate")),
      stand_(0, 0, -static_cast<float>(options.number("distance"))),
      facing_(rotate_y(static_cast<float>(options.number("facing")))),
      has_person_(options.whole("people") > 0),
      person_(context, body.sex, static_cast<uint32_t>(options.whole("detail")), body.shape),
      camera_(model_, place_of(options), room_of(options)),
      noise_(model_, noise_of(options)),
      black_hair_m_(static_cast<float>(options.number("black_hair"))),
      surroundings_(context, options, model_, place_of(options), camera_, stand_) {
    const std::string& bvh = options.text("bvh");
    motion_ = bvh.empty()
                  ? make_scripted_motion(options.text("motion"), person_.proportions(), options.whole("seed"),
                                         static_cast<float>(options.number("arms")))
                  : make_bvh_motion(bvh, person_.proportions());
    const auto metres = [&](const char* key) { return static_cast<float>(options.number(key)); };
    person_.wear({metres("clothing"), metres("top"), metres("sleeves"), metres("trousers")},
                 options.whole("seed"));
    if (has_person_) camera_.set_triangles(person_.triangles(), person_.vertex_count());

    intrinsics_ = vfit_intrinsics_init();
    intrinsics_.width = model_.width, intrinsics_.height = model_.height;
    intrinsics_.fx = model_.fx, intrinsics_.fy = model_.fy, intrinsics_.cx = model_.cx,
    intrinsics_.cy = model_.cy;

    const CameraPlace place = place_of(options);
    camera_info_ = vfit_camera_init();
    camera_info_.depth_unit_m = 0.001f;
    if (options.text("floor") == "unknown") return;
    camera_info_.floor_state = VFIT_FLOOR_GIVEN;
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
    if (has_person_ && black_hair_m_ > 0.0f) find_hair();
    if (!surroundings_.empty())
        picture_ = &surroundings_.complete(clean_, static_cast<double>(frame) * frame_time_s_);
}

void Renderer::find_hair() {
    const float* skin = person_.positions();
    // Of the head: a raised hand may be higher.
    const Vec3 head = person_.joint_place(VFIT_JOINT_HEAD);
    float crown = head.y;
    for (size_t v = 0; v < person_.vertex_count(); ++v)
        if (glm::distance(Vec3(skin[3 * v], skin[3 * v + 1], skin[3 * v + 2]), head) < kHeadRadius_m)
            crown = std::max(crown, skin[3 * v + 1]);
    swallowed_.clear();
    for (uint32_t y = 0; y < clean_.height; ++y)
        for (uint32_t x = 0; x < clean_.width; ++x) {
            const uint32_t i = y * clean_.width + x;
            if (clean_.user[i] == 0) continue;
            const float z = clean_.depth_m[i];
            const Vec3 seen(z * (static_cast<float>(x) - model_.cx) / model_.fx,
                            z * (static_cast<float>(y) - model_.cy) / model_.fy, z);
            const Vec3 place = camera_.to_world(seen);
            if (place.y > crown - black_hair_m_ && glm::distance(place, head) < kHeadRadius_m)
                swallowed_.push_back(i);
        }
}

void Renderer::write_depth(uint16_t* pixels, uint32_t row_stride) {
    noise_.apply(clean(), frame_, pixels, row_stride);
    for (const uint32_t i : swallowed_) {
        if (hides(i)) continue;
        auto* row = reinterpret_cast<unsigned char*>(pixels) + size_t{i / clean_.width} * row_stride;
        reinterpret_cast<uint16_t*>(row)[i % clean_.width] = 0;
    }
}

void Renderer::write_user_map(uint8_t* pixels, uint32_t row_stride) const {
    const CleanImage& image = clean();
    for (uint32_t y = 0; y < image.height; ++y)
        std::memcpy(pixels + size_t{y} * row_stride, image.user.data() + size_t{y} * image.width,
                    image.width);
    for (const uint32_t i : swallowed_)
        if (!hides(i)) pixels[size_t{i / image.width} * row_stride + i % image.width] = 0;
}

const std::vector<SeenBody>& Renderer::bodies() {
    bodies_.clear();
    if (has_person_) see_joints(person_.joints(), camera_, clean(), bodies_.emplace_back());
    surroundings_.see_others(bodies_);
    std::erase_if(bodies_, [](const SeenBody& body) { return !body.in_view; });
    return bodies_;
}

const char* Renderer::contacts_json() const {
    static constexpr const char* kTexts[3][3] = {
        {R"({"left": 0, "right": 0})", R"({"left": 0, "right": 1})", R"({"left": 0, "right": 2})"},
        {R"({"left": 1, "right": 0})", R"({"left": 1, "right": 1})", R"({"left": 1, "right": 2})"},
        {R"({"left": 2, "right": 0})", R"({"left": 2, "right": 1})", R"({"left": 2, "right": 2})"}};
    const auto state = [&](size_t side) { return pose_.contact[side] ? 1 : pose_.rolls[side] ? 2 : 0; };
    return kTexts[state(kLeft)][state(kRight)];
}

}  // namespace vfit::virtual_person
