#include "track/tracker.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/clock.h"
#include "frame/in_view.h"

namespace vfit {

namespace {

constexpr float kBeliefShare = 0.3f;   // of the newest answer
constexpr float kLeastBelief = -0.5f;  // logit
constexpr float kSurelyNot = -2.5f;    // logit: one in twelve
constexpr uint32_t kSureAfter = 15;    // frames in a row: who walks in or is being hidden shows an arm alone

/// The image's own up where the camera looks straight down.
Vec2 image_up(const Vec3& up) {
    const Vec2 flat(up.x, up.y);
    const float length = glm::length(flat);
    return length < 0.2f ? Vec2(0, -1) : flat / length;
}

}  // namespace

void find_targets(const DepthImage& image, size_t most, std::vector<TrackTarget>& out) {
    struct Found {
        uint32_t pixels = 0;
        PixelBox box{1 << 20, 1 << 20, 0, 0};
    };
    std::array<Found, 256> found{};
    for (int y = 0; y < int(image.height()); ++y) {
        const uint8_t* row = image.users + image.index(0, uint32_t(y));
        for (int x = 0; x < int(image.width()); ++x) {
            if (row[x] == 0) continue;
            Found& f = found[row[x]];
            ++f.pixels;
            f.box = {std::min(f.box.x0, x), std::min(f.box.y0, y), std::max(f.box.x1, x + 1),
                     std::max(f.box.y1, y + 1)};
        }
    }
    out.clear();
    for (uint32_t id = 1; id < found.size(); ++id)
        if (found[id].pixels >= Cropper::kFewestPixels) out.push_back({id, found[id].box, 0});
    std::sort(out.begin(), out.end(), [&](const TrackTarget& a, const TrackTarget& b) {
        return found[a.id].pixels > found[b.id].pixels;
    });
    if (out.size() > most) out.resize(most);
}

void Tracker::run(const DepthImage& image, int64_t time_ns, std::span<const TrackTarget> targets,
                  std::vector<Body>& out, const Evidence& evidence) {
    out.clear();
    give_hints(image, targets, evidence.hints);
    std::erase_if(people_, [&](const auto& entry) {
        return time_ns < entry.second.seen_ns || seconds_between(entry.second.seen_ns, time_ns) > kForget_s;
    });
    const Vec2 up = image_up(image.camera.floor_normal);
    for (const TrackTarget& target : targets) {
        Body body;
        if (see(image, time_ns, target, up, evidence.elsewhere, people_[target.id], body))
            out.push_back(body);
    }
}

/// A hint is of the person that it names, or whose pixel it is, or in whose box alone it lies.
void Tracker::give_hints(const DepthImage& image, std::span<const TrackTarget> targets,
                         std::span<const JointHint> hints) {
    hints_.clear();
    for (JointHint hint : hints) {
        const int x = int(std::floor(std::clamp(hint.x, -1.0f, 1e6f) + 0.5f)),
                  y = int(std::floor(std::clamp(hint.y, -1.0f, 1e6f) + 0.5f));
        const bool inside = x >= 0 && y >= 0 && x < int(image.width()) && y < int(image.height());
        const uint32_t label = inside ? image.users[image.index(uint32_t(x), uint32_t(y))] : 0;
        uint32_t boxes = 0, owner = 0;
        for (const TrackTarget& target : targets) {
            if (!near_box(hint, target.box) || (hint.person && hint.person != target.id)) continue;
            ++boxes;
            if (owner == 0 || target.id == label) owner = target.id;
        }
        if (boxes > 1 && owner != label) continue;  // whose it is nobody can tell
        hint.person = owner;
        if (owner) hints_.push_back(hint);
    }
}

bool Tracker::turn(const DepthImage& image, const TrackTarget& target, const Vec3& up,
                   Level::Answers& person) {
    crop_.resize(size_t(CropView::kPixels) * CropView::kPixels);
    CropView view;
    for (int k = 0; k < Level::kTurns; ++k) {
        const Vec2 way = image_up(Level::turned(up, k));
        if (!cropper_.run(image, uint8_t(target.id), target.box, way, view, crop_.data())) return false;
        network_->run(crop_.data(), maps_);
        person[size_t(k)] = maps_.person;
    }
    return true;
}

float Tracker::answer(const DepthImage& image, const TrackTarget& target, const Vec3& up) {
    crop_.resize(size_t(CropView::kPixels) * CropView::kPixels);
    CropView view;
    if (!cropper_.run(image, uint8_t(target.id), target.box, image_up(up), view, crop_.data()))
        return kSurelyNot;
    network_->run(crop_.data(), maps_);
    return maps_.person;
}

float Tracker::belief(uint32_t id) const {
    const auto found = people_.find(id);
    return found == people_.end() ? kSurelyNot : found->second.belief;
}

bool Tracker::surely_no_person(uint32_t id) const {
    const auto found = people_.find(id);
    return found != people_.end() && found->second.doubts >= kSureAfter;
}

bool Tracker::see(const DepthImage& image, int64_t time_ns, const TrackTarget& target, const Vec2& up,
                  std::span<const Body> elsewhere, Person& person, Body& out) {
    crop_.resize(size_t(CropView::kPixels) * CropView::kPixels);
    CropView view;
    if (!cropper_.run(image, uint8_t(target.id), target.box, up, view, crop_.data())) return false;
    network_->run(crop_.data(), maps_);
    person.belief =
        person.frames == 0 ? maps_.person : person.belief + kBeliefShare * (maps_.person - person.belief);
    hints_of_one_.clear();
    for (const JointHint& hint : hints_)
        if (hint.person == target.id) hints_of_one_.push_back(hint);
    answer_facing(hints_of_one_, view, maps_);
    apply_hints(hints_of_one_, view, person.facing.away(maps_.away), maps_);
    SeenJoints joints;
    read_maps(maps_, view, image.camera, joints);
    person.facing.apply(maps_.away, image.camera.floor_normal, joints, elsewhere);
    if (steady_) person.steady.run(time_ns, joints);
    person.seen_ns = time_ns;
    ++person.frames;
    person.doubts = person.belief < kSurelyNot ? person.doubts + 1 : 0;
    if (person.belief < kLeastBelief || target.lifeless_s > 0.0f) return false;

    out.id = target.id;
    out.time_ns = time_ns;
    out.flags = target.flags;
    out.facing_logit = person.facing.agreement();
    for (int j = 0; j < kJointCount; ++j) {
        const SeenJoint& seen = joints[size_t(j)];
        out.set(j, seen.position, joint_state_of(seen.confidence), seen.confidence);
    }
    limit_states(out, image.camera);
    return true;
}

}  // namespace vfit
