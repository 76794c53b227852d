#include "track/perception.h"

namespace vfit {

namespace {

void take_floor(Camera& camera, const Camera& from) {
    camera.floor_state = from.floor_state;
    camera.floor_normal = from.floor_normal;
    camera.floor_distance_m = from.floor_distance_m;
}

}  // namespace

void Perception::reset() {
    if (tracker_) tracker_->reset();
    if (people_) people_->reset();
    level_.reset();
    reported_ = {};
}

std::span<const PersonRegion> Perception::map_people(const DepthImage& image, int64_t time_ns, uint8_t* map) {
    if (!people_) people_ = std::make_unique<PeopleMap>();
    return people_->run(image, time_ns, map);
}

void Perception::find_people(DepthImage& image, int64_t time_ns, uint8_t* map) {
    if (!map) {
        find_targets(image, kMaxBodies, targets_);
        return;
    }
    targets_.clear();
    for (const PersonRegion& region : map_people(image, time_ns, map))
        if (targets_.size() < kMaxBodies)
            targets_.push_back({region.id, region.box,
                                region.out_of_view ? uint32_t(VFIT_BODY_PARTLY_OUT_OF_VIEW) : 0u});
    image.users = map;
    image.camera = people_->camera();
}

bool Perception::stands_upright(const DepthImage& image, const Body& body) {
    if (level_.sure()) return true;
    Level::Answers answers;
    for (const TrackTarget& target : targets_)
        if (target.id == body.id)
            return !tracker_->turn(image, target, image.camera.floor_normal, answers) ||
                   level_.compare(answers, people_ && people_->floor_seen());
    return true;
}

void Perception::run(DepthImage& image, int64_t time_ns, uint8_t* map, std::span<const JointHint> hints,
                     std::vector<Body>& bodies) {
    if (!tracker_) tracker_ = std::make_unique<Tracker>(load_(), steady_);
    const bool told = image.camera.floor_state != VFIT_FLOOR_DEFAULT;
    if (!told) level_.place(image.camera);
    find_people(image, time_ns, map);
    tracker_->run(image, time_ns, targets_, bodies, hints);
    if (map)
        for (const TrackTarget& target : targets_)
            if (tracker_->surely_no_person(target.id)) people_->reject(target.id);
    if (told) return;
    const bool floor_found = people_ && people_->floor_found();
    if (!bodies.empty() && !stands_upright(image, bodies.front())) bodies.clear();
    if (bodies.empty()) {
        const bool tried = level_.tries_another();
        const Vec3 up = level_.up();
        level_.miss(time_ns);
        if (people_ && level_.up() != up) people_->forget_people();
        if (tried)
            take_floor(image.camera, reported_);
        else
            reported_ = image.camera;
        return;
    }
    if (floor_found) {
        level_.follow(image.camera.floor_normal);
    } else {
        level_.see(bodies.front(), time_ns);
        level_.place(image.camera);
    }
    reported_ = image.camera;
}

}  // namespace vfit
