#include "surroundings.h"

#include "furniture.h"
#include "random_body.h"

namespace vfit::virtual_person {

namespace {

constexpr float kOthersBeside_m = 0.85f, kOthersBehind_m = 0.3f;  // of the others, from the person
constexpr const char* kMotions[] = {"sway", "wave"};              // of the second and the third person

Vec3 beside(const Vec3& stand, size_t index) {
    return stand + Vec3(index % 2 == 0 ? -kOthersBeside_m : kOthersBeside_m, 0, -kOthersBehind_m);
}

}  // namespace

// One more person: a body drawn by the seed, in clothes like the first one's.
struct Surroundings::Other {
    Other(vfit_context context, const Options& options, const SensorModel& model, const CameraPlace& place,
          const Vec3& at, size_t index)
        : seed(options.whole("seed") + 1 + index),
          stand(at),
          body(draw_body(seed, VFIT_SEX_UNKNOWN, {})),
          person(context, body.sex, static_cast<uint32_t>(options.whole("detail")), body.shape),
          motion(make_scripted_motion(kMotions[index % std::size(kMotions)], person.proportions(), seed)),
          camera(model, place, {}) {
        person.wear({static_cast<float>(options.number("clothing"))}, seed);
        camera.set_triangles(person.triangles(), person.vertex_count());
        seen.id = static_cast<uint32_t>(2 + index);
    }
    void move(double t_s) {
        person.pose(motion->at(t_s), stand);
        camera.render(person.positions(), image);
    }

    uint64_t seed;
    Vec3 stand;
    RandomBody body;
    Person person;
    std::unique_ptr<Motion> motion;
    DepthCamera camera;
    CleanImage image;
    SeenBody seen;
};

Surroundings::Surroundings(vfit_context context, const Options& options, const SensorModel& model,
                           const CameraPlace& place, const DepthCamera& camera, const Vec3& stand)
    : camera_(camera), painter_(model, camera.world_from_camera(), place.height_m) {
    solve_furniture(
        make_furniture(options.text("furniture"), stand, static_cast<float>(options.number("facing"))),
        model);
    if (const double begin_s = options.number("occluder"); begin_s > 0)
        occluder_.emplace(static_cast<float>(begin_s), stand);
    for (size_t i = 0; i + 1 < options.whole("people"); ++i)
        others_.push_back(std::make_unique<Other>(context, options, model, place, beside(stand, i), i));
}

Surroundings::~Surroundings() = default;

void Surroundings::solve_furniture(const std::vector<Solid>& solids, const SensorModel& model) {
    if (solids.empty()) return;
    CleanImage image;
    image.resize(model.width, model.height);
    painter_.paint(solids, image);
    for (size_t i = 0; i < image.pixel_count(); ++i)
        if (image.depth_m[i] > 0.0f) furniture_.push_back({i, image.depth_m[i], image.cosine[i]});
}

const CleanImage& Surroundings::complete(const CleanImage& person, double t_s) {
    picture_ = person;
    const auto nearer = [&](size_t i, float depth) {
        return depth > 0.0f && (picture_.depth_m[i] <= 0.0f || depth < picture_.depth_m[i]);
    };
    for (const Spot& spot : furniture_)
        if (nearer(spot.pixel, spot.depth_m))
            picture_.depth_m[spot.pixel] = spot.depth_m, picture_.cosine[spot.pixel] = spot.cosine,
            picture_.user[spot.pixel] = 0;
    for (const auto& other : others_) {
        other->move(t_s);
        for (size_t i = 0; i < picture_.pixel_count(); ++i)
            if (other->image.user[i] && nearer(i, other->image.depth_m[i]))
                picture_.depth_m[i] = other->image.depth_m[i], picture_.cosine[i] = other->image.cosine[i],
                picture_.user[i] = static_cast<uint8_t>(other->seen.id);
    }
    if (occluder_) {
        const Solid box = occluder_->at(t_s);
        painter_.paint({&box, 1}, picture_);
    }
    return picture_;
}

void Surroundings::see_others(std::vector<SeenBody>& out) const {
    for (const auto& other : others_) {
        see_joints(other->person.joints(), camera_, picture_, other->seen);
        out.push_back(other->seen);
    }
}

}  // namespace vfit::virtual_person
