#include "track/match_bodies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace vfit {

namespace {

/// The label under most of the body's joints; 0 where that is not the majority of those in the image.
uint8_t label_under(const Body& body, const Camera& camera, const uint8_t* users) {
    std::array<int, 256> votes{};
    int inside = 0;
    for (int j = 0; j < kJointCount; ++j) {
        if (!body.has(j) || body.at(j).z < 0.1f) continue;
        const Vec2 q = camera.project(body.at(j)) + 0.5f;
        if (!(q.x >= 0.0f && q.y >= 0.0f && q.x < float(camera.width) && q.y < float(camera.height)))
            continue;
        ++inside;
        ++votes[users[size_t(q.y) * camera.width + size_t(q.x)]];
    }
    const auto most = std::max_element(votes.begin() + 1, votes.end());
    return 2 * *most > inside ? uint8_t(most - votes.begin()) : uint8_t(0);
}

/// Which number each label becomes: always a permutation, so that no two people get one number.
class Numbers {
public:
    Numbers() {
        for (size_t i = 0; i < to_.size(); ++i) to_[i] = uint8_t(i);
    }
    void give(size_t label, uint32_t number) {
        const auto holder = std::find(to_.begin(), to_.end(), uint8_t(number));
        std::swap(*holder, to_[label]);
        given_[label] = true;
    }
    bool given(size_t label) const { return given_[label]; }
    uint8_t operator[](uint8_t label) const { return to_[label]; }

private:
    std::array<uint8_t, 256> to_;
    std::array<bool, 256> given_{};
};

}  // namespace

void number_by_bodies(std::span<const Body> bodies, const Camera& camera,
                      std::span<const PersonRegion> people, uint8_t* users) {
    Numbers numbers;
    std::array<bool, 256> used{true};
    for (const PersonRegion& person : people) used[person.id] = true;
    for (const Body& body : bodies) {
        size_t label = label_under(body, camera, users);
        if (label == 0 || numbers.given(label)) {
            // Nobody, or somebody's already: no person may have that number, so that a label nobody has takes
            // it.
            label = used.size() - 1;
            while (label > 0 && used[label]) --label;
            if (label == 0) continue;
            used[label] = true;
        }
        numbers.give(label, body.id);
    }
    const size_t pixels = size_t(camera.width) * camera.height;
    for (size_t i = 0; i < pixels; ++i)
        if (users[i] != 0) users[i] = numbers[users[i]];
}

}  // namespace vfit
