#include "furniture.h"

#include <functional>

#include "error.h"

namespace vfit::virtual_person {

namespace {

constexpr float kBeside_m = 0.9f, kBehind_m = 0.25f;
constexpr float kStoolBehind_m = 0.42f;  // of its middle from the ankles: about a thigh's length

// All sizes are those of common furniture, metres; each piece stands on the world's origin and faces +Z.

void add_legs(float half_width, float half_depth, float height, std::vector<Solid>& out) {
    for (const float x : {-1.0f, 1.0f})
        for (const float z : {-1.0f, 1.0f})
            out.push_back(box({x * (half_width - 0.02f), height / 2, z * (half_depth - 0.02f)},
                              {0.02f, height / 2, 0.02f}));
}

std::vector<Solid> chair() {
    std::vector<Solid> out = {box({0, 0.44f, 0}, {0.22f, 0.025f, 0.21f}),
                              box({0, 0.72f, -0.2f}, {0.20f, 0.20f, 0.015f})};
    add_legs(0.22f, 0.21f, 0.42f, out);
    for (const float x : {-1.0f, 1.0f}) out.push_back(box({x * 0.2f, 0.65f, -0.2f}, {0.018f, 0.25f, 0.018f}));
    return out;
}

// A pole with a foot, a coat on each side and a hat: about as tall and wide as a person.
std::vector<Solid> rack() {
    std::vector<Solid> out = {
        box({0, 0.9f, 0}, {0.02f, 0.9f, 0.02f}), box({0, 0.015f, 0}, {0.25f, 0.015f, 0.03f}),
        box({0, 0.015f, 0}, {0.03f, 0.015f, 0.25f}), ellipsoid({0, 1.78f, 0}, {0.12f, 0.07f, 0.14f})};
    for (const float x : {-1.0f, 1.0f}) {
        out.push_back(ellipsoid({x * 0.13f, 1.25f, 0.02f}, {0.13f, 0.45f, 0.17f}));
        out.push_back(ellipsoid({x * 0.24f, 1.2f, 0.03f}, {0.06f, 0.36f, 0.07f}));  // a sleeve
    }
    return out;
}

std::vector<Solid> stool() {
    std::vector<Solid> out = {box({0, kStoolHeight_m - 0.02f, 0}, {0.18f, 0.02f, 0.18f})};
    add_legs(0.18f, 0.18f, kStoolHeight_m - 0.04f, out);
    return out;
}

struct Piece {
    const char* name;
    std::vector<Solid> (*make)();
    Vec3 place;  // from where the person stands
    bool turns;  // with the person
};
const Piece kPieces[] = {{"chair", chair, {kBeside_m, 0, -kBehind_m}, false},
                         {"rack", rack, {-kBeside_m, 0, -kBehind_m}, false},
                         {"stool", stool, {0, 0, -kStoolBehind_m}, true}};

/// False where the list names something else.
bool for_each_piece(const std::string& list, const std::function<void(const Piece&)>& use) {
    for (size_t at = 0; at < list.size();) {
        const size_t end = std::min(list.find(',', at), list.size());
        const std::string name = list.substr(at, end - at);
        at = end + 1;
        const Piece* found = nullptr;
        for (const Piece& piece : kPieces)
            if (name == piece.name) found = &piece;
        if (!found) return false;
        use(*found);
    }
    return true;
}

}  // namespace

std::string furniture_names() {
    std::string names;
    for (const Piece& p : kPieces) names += (names.empty() ? "" : ", ") + std::string(p.name);
    return names;
}

bool is_furniture(const std::string& list) {
    return for_each_piece(list, [](const Piece&) {});
}

std::vector<Solid> make_furniture(const std::string& list, const Vec3& stand, float facing_deg) {
    std::vector<Solid> out;
    for_each_piece(list, [&](const Piece& piece) {
        const float yaw = piece.turns ? facing_deg : 0.0f;
        const Vec3 by = stand + (piece.turns ? rotate_y(yaw) * piece.place : piece.place);
        for (const Solid& solid : piece.make()) out.push_back(placed(solid, yaw, by));
    });
    return out;
}

}  // namespace vfit::virtual_person
