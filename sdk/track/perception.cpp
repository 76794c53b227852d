#include "track/perception.h"

#include <algorithm>

#include "core/clock.h"

namespace vfit {

namespace {

constexpr double kFloorKept_s = 2.0;
// Logits of what was split from a person: people who stand half behind others have 3.5 and more, arms and
// legs below 3.
constexpr float kPerson = 5.0f, kPart = 3.0f;
constexpr float kThing_s = 2.0f;              // without a sign of life, after which it becomes background
constexpr int kMaxTries = 2 * Level::kTurns;  // of one image

}  // namespace

void Perception::reset() {
    if (tracker_) tracker_->reset();
    if (people_) people_->reset();
    level_.reset();
}

const char* text_of(Absence why) {
    switch (why) {
        case Absence::kNoReadings: return "the depth image has no readings";
        case Absence::kTooFar: return "nothing is within 6 m";
        case Absence::kBackgroundOnly: return "there is nothing but floor and background";
        case Absence::kNoShape: return "nothing in view has the size and shape of a person";
        case Absence::kNoPerson: return "what is in view does not look like a person";
    }
    return "";
}

Absence Perception::why_absent() const {
    if (mapped_) return people_->why_absent();
    return targets_.empty() ? Absence::kBackgroundOnly : Absence::kNoPerson;
}

std::span<const PersonRegion> Perception::map_people(const DepthImage& image, int64_t time_ns, uint8_t* map) {
    if (!people_) people_ = std::make_unique<PeopleMap>();
    return people_->run(image, time_ns, map);
}

void Perception::find_people(DepthImage& image, int64_t time_ns, uint8_t* map) {
    mapped_ = map != nullptr;
    if (!map) {
        find_targets(image, kMaxBodies, targets_);
        return;
    }
    targets_.clear();
    for (const PersonRegion& region : map_people(image, time_ns, map))
        if (targets_.size() < kMaxBodies)
            targets_.push_back({region.id, region.box,
                                region.out_of_view ? uint32_t(VFIT_BODY_PARTLY_OUT_OF_VIEW) : 0u,
                                region.part_of, region.lifeless_s});
    image.users = map;
    image.camera = people_->camera();
}

/// The one whom the network knows best: a person who is half out of view tells little about up.
const Body& Perception::surest(std::span<const Body> bodies) const {
    return *std::max_element(bodies.begin(), bodies.end(), [&](const Body& a, const Body& b) {
        return tracker_->belief(a.id) < tracker_->belief(b.id);
    });
}

bool Perception::stands_upright(const DepthImage& image, const Body& body) {
    if (level_.sure()) return true;
    const auto target =
        std::find_if(targets_.begin(), targets_.end(), [&](const TrackTarget& t) { return t.id == body.id; });
    Level::Answers answers;
    return target == targets_.end() || !tracker_->turn(image, *target, image.camera.floor_normal, answers) ||
           level_.compare(answers);
}

/// Outlines show two heads on many who raise a shoulder or carry a bag: the network tells whether what was
/// split from a person is one. True where it is none, and the map is to be drawn again.
bool Perception::rejoin_parts(const DepthImage& image) {
    bool rejoined = false;
    for (const TrackTarget& target : targets_) {
        if (!target.part_of) continue;
        const float answer = tracker_->answer(image, target, image.camera.floor_normal);
        if (answer > kPerson) people_->confirm(target.id);
        if (answer > kPart) continue;
        people_->rejoin(target.id);
        rejoined = true;
    }
    return rejoined;
}

bool Perception::look(DepthImage& image, int64_t time_ns, uint8_t* map, const Evidence& evidence,
                      std::vector<Body>& bodies) {
    const Camera unknown = image.camera;
    find_people(image, time_ns, map);
    if (map && rejoin_parts(image)) {
        image.camera = unknown;
        find_people(image, time_ns, map);
    }
    tracker_->run(image, time_ns, targets_, bodies, evidence);
    if (map)
        for (const TrackTarget& target : targets_)
            if (tracker_->surely_no_person(target.id) || target.lifeless_s > kThing_s)
                people_->reject(target.id);
    return !bodies.empty();
}

void Perception::run(DepthImage& image, int64_t time_ns, uint8_t* map, const Evidence& evidence,
                     std::vector<Body>& bodies) {
    if (!tracker_) tracker_ = std::make_unique<Tracker>(load_(), steady_);
    if (image.camera.floor_state != VFIT_FLOOR_DEFAULT) {  // up is known
        look(image, time_ns, map, evidence, bodies);
        return;
    }
    const Camera unknown = image.camera;
    Camera first = unknown;  // as the way that was taken for up shows it
    const Vec3 before = level_.up();
    bool found = false;
    // Two people who are turned against each other, as in a mirror on the floor, could go on for ever.
    int tries = 0;
    for (bool again = true; again && !found && tries < kMaxTries; ++tries) {
        image.camera = unknown;
        level_.place(image.camera);
        const Vec3 up = level_.up();
        found = look(image, time_ns, map, evidence, bodies) && stands_upright(image, surest(bodies));
        if (tries == 0) first = image.camera;
        // What rests without life was seen well enough to be doubted: no other way up shows it better.
        const bool things = std::any_of(targets_.begin(), targets_.end(),
                                        [](const TrackTarget& t) { return t.lifeless_s > 0.0f; });
        again = !found && !things && (level_.up() != up || level_.miss(time_ns));
        // What a wrong way up showed of people counts for nothing with another one.
        if (again && people_) people_->forget_people();
        if (again) tracker_->reset();
    }
    // A floor that is out of sight stays as long as people stand on it.
    if (found || !people_ || !people_->floor_found() || people_->floor_seen())
        floor_ns_ = time_ns;
    else if (time_ns < floor_ns_ || seconds_between(floor_ns_, time_ns) > kFloorKept_s)
        people_->doubt_floor();
    if (!found) {
        bodies.clear();
        // A thing that was taken for a person for a moment tells nothing about up.
        level_.keep(before), image.camera = first;
    } else if (people_ && people_->floor_found()) {
        level_.follow(image.camera.floor_normal);
    } else {
        level_.see(surest(bodies), time_ns);
        level_.place(image.camera);
    }
}

}  // namespace vfit
