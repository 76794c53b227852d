// Plays a room with people to the user map, frame by frame at 30 Hz, and judges it against the room's truth.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "room_scene.h"
#include "track/people_map.h"

namespace vfit::testing {

inline constexpr int64_t kFrame_ns = 33'333'333;

class People {
public:
    explicit People(const PeopleMapOptions& options = {}) : map(options) {}

    std::span<const PersonRegion> see(RoomScene& scene) {
        scene.render(uint32_t(time_ns / kFrame_ns) + 1);
        users.resize(scene.depth.size());
        time_ns += kFrame_ns;
        return map.run(scene.bare(), time_ns, users.data());
    }

    /// Of person number `who` of the scene, against the label that covers most of them.
    double iou(const RoomScene& scene, uint8_t who = 1) const {
        const uint8_t label = label_of(scene, who);
        size_t both = 0, either = 0;
        for (size_t i = 0; i < users.size(); ++i) {
            const bool truth = scene.truth[i] == who, found = label != 0 && users[i] == label;
            both += truth && found;
            either += truth || found;
        }
        return either ? double(both) / double(either) : 0.0;
    }

    /// Share of that person's readings that have the label of most of them.
    double recall(const RoomScene& scene, uint8_t who = 1) const {
        const uint8_t label = label_of(scene, who);
        size_t found = 0, all = 0;
        for (size_t i = 0; i < users.size(); ++i) {
            all += scene.truth[i] == who;
            found += scene.truth[i] == who && label != 0 && users[i] == label;
        }
        return all ? double(found) / double(all) : 0.0;
    }

    uint8_t label_of(const RoomScene& scene, uint8_t who) const {
        std::array<size_t, 256> count{};
        for (size_t i = 0; i < users.size(); ++i)
            if (scene.truth[i] == who && users[i]) ++count[users[i]];
        const auto most = std::max_element(count.begin(), count.end());
        return *most ? uint8_t(most - count.begin()) : uint8_t(0);
    }

    PeopleMap map;
    std::vector<uint8_t> users;
    int64_t time_ns = 0;
};

}  // namespace vfit::testing
