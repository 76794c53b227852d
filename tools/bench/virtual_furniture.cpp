#include "bench/virtual_furniture.h"

#include <cmath>

namespace vfit::tools {

namespace {

using Solid = VirtualRoom::Solid;
using Shape = VirtualRoom::Solid::Shape;
using Piece = std::vector<Solid>;

Solid box(const Vec3& centre, const Vec3& half) {
    return {Shape::kBox, centre, Mat3(Vec3(half.x, 0, 0), Vec3(0, half.y, 0), Vec3(0, 0, half.z))};
}

Solid ball(const Vec3& centre, const Vec3& half) {
    Solid s = box(centre, half);
    s.shape = Shape::kEllipsoid;
    return s;
}

/// A bar of square section from one point to another.
Solid bar(const Vec3& from, const Vec3& to, float half_m) {
    const Vec3 along = 0.5f * (to - from), way = glm::normalize(along);
    const Vec3 aside =
        glm::normalize(glm::cross(way, std::abs(way.y) < 0.9f ? Vec3(0, 1, 0) : Vec3(1, 0, 0)));
    return {Shape::kBox, 0.5f * (from + to), Mat3(along, half_m * aside, half_m * glm::cross(way, aside))};
}

/// As wide as a cylinder, and as round from the side.
Solid pillar(float x, float z, float low, float high, float radius) {
    return ball({x, 0.5f * (low + high), z}, {radius, 0.6f * (high - low), radius});
}

struct Draw {
    std::mt19937& random;
    float operator()(float low, float high) const {
        return low + (high - low) * float(random() % 4096) / 4095.0f;
    }
    int whole(int low, int high) const { return low + int(random() % uint32_t(high - low + 1)); }
};

void add_star(int arms, float radius, float height, Piece& out) {
    for (int i = 0; i < arms; ++i) {
        const float angle = 2.0f * kPi * float(i) / float(arms) + 0.3f;
        const Vec3 tip(radius * std::cos(angle), 0.5f * height, radius * std::sin(angle));
        out.push_back(bar({0, height, 0}, tip, 0.022f));
        out.push_back(ball({tip.x, 0.03f, tip.z}, Vec3(0.03f)));
    }
}

void add_legs(float x, float z, float height, float half_m, Piece& out) {
    for (const float a : {-x, x})
        for (const float b : {-z, z}) out.push_back(bar({a, 0, b}, {a, height, b}, half_m));
}

Piece swivel_chair(const Draw& draw) {
    Piece out;
    const float seat = draw(0.42f, 0.54f), back = draw(0.4f, 0.75f);
    add_star(5, draw(0.28f, 0.34f), 0.09f, out);
    out.push_back(bar({0, 0.08f, 0}, {0, seat, 0}, 0.03f));
    out.push_back(ball({0, seat, 0}, {0.27f, 0.06f, 0.27f}));
    out.push_back(bar({0, seat, -0.22f}, {0, seat + 0.3f, -0.26f}, 0.03f));
    out.push_back(ball({0, seat + 0.15f + 0.5f * back, -0.25f}, {0.24f, 0.55f * back, 0.06f}));
    if (draw.whole(0, 1))
        out.push_back(ball({0, seat + back + 0.3f, -0.24f}, {0.15f, 0.09f, 0.05f}));  // a head rest
    for (const float s : {-1.0f, 1.0f}) {
        out.push_back(bar({s * 0.27f, seat, 0}, {s * 0.29f, seat + 0.2f, 0}, 0.02f));
        out.push_back(box({s * 0.29f, seat + 0.22f, 0.02f}, {0.04f, 0.02f, 0.13f}));
    }
    return out;
}

Piece chair(const Draw& draw) {
    Piece out;
    const float high = draw(0.8f, 1.05f);
    add_legs(0.2f, 0.2f, 0.44f, 0.02f, out);
    out.push_back(box({0, 0.45f, 0}, {0.22f, 0.025f, 0.21f}));
    out.push_back(box({0, 0.5f * (0.55f + high), -0.21f}, {0.2f, 0.5f * (high - 0.55f), 0.015f}));
    for (const float s : {-0.19f, 0.19f}) out.push_back(bar({s, 0.44f, -0.21f}, {s, high, -0.21f}, 0.018f));
    return out;
}

Piece armchair(const Draw& draw) {
    const float half = draw(0.28f, 0.36f), high = draw(0.8f, 1.1f);
    return {
        box({0, 0.24f, 0}, {half, 0.18f, 0.34f}), box({0, 0.5f * high, -0.34f}, {half, 0.5f * high, 0.1f}),
        box({half + 0.08f, 0.3f, 0}, {0.08f, 0.3f, 0.38f}),
        box({-half - 0.08f, 0.3f, 0}, {0.08f, 0.3f, 0.38f}), ball({0, high, -0.34f}, {half, 0.08f, 0.11f})};
}

Piece stool(const Draw& draw) {
    Piece out;
    const float high = draw(0.42f, 0.8f);
    add_legs(0.16f, 0.16f, high, 0.018f, out);
    out.push_back(ball({0, high, 0}, {0.19f, 0.04f, 0.19f}));
    return out;
}

Piece clothes_rack(const Draw& draw) {
    Piece out;
    const float half = draw(0.35f, 0.75f), high = draw(1.4f, 1.75f);
    for (const float s : {-half, half}) {
        out.push_back(bar({s, 0.05f, 0}, {s, high, 0}, 0.015f));
        out.push_back(bar({s, 0.04f, -0.25f}, {s, 0.04f, 0.25f}, 0.02f));
    }
    out.push_back(bar({-half, high, 0}, {half, high, 0}, 0.015f));
    const int garments = draw.whole(2, 7);
    for (int i = 0; i < garments; ++i) {
        // Hangers are across the rail; a few are turned to the front.
        const float x = half * (-0.85f + 1.7f * (float(i) + draw(0.2f, 0.8f)) / float(garments));
        const float length = draw(0.35f, 0.6f),
                    turn = draw.whole(0, 3) ? draw(-0.3f, 0.3f) : draw(1.0f, 1.6f);
        Piece garment = {ball({0, high - 0.1f - length, 0}, {0.04f, length, 0.22f}),
                         ball({0, high - 0.35f, 0.2f}, {0.04f, 0.25f, 0.06f}),
                         ball({0, high - 0.35f, -0.2f}, {0.04f, 0.25f, 0.06f})};
        place(garment, turn, {x, 0, 0}, out);
    }
    return out;
}

Piece coat_stand(const Draw& draw) {
    Piece out;
    const float high = draw(1.6f, 1.85f);
    out.push_back(bar({0, 0.02f, 0}, {0, high, 0}, 0.02f));
    add_star(4, 0.28f, 0.05f, out);
    const int coats = draw.whole(1, 4);
    for (int i = 0; i < coats; ++i) {
        const float angle = 2.0f * kPi * (float(i) + draw(0.0f, 0.6f)) / float(coats),
                    length = draw(0.35f, 0.5f);
        Piece coat = {ball({0.12f, high - 0.15f - length, 0}, {0.1f, length, 0.17f}),
                      ball({0.14f, high - 0.55f, 0.17f}, {0.06f, 0.33f, 0.06f}),
                      ball({0.14f, high - 0.55f, -0.17f}, {0.06f, 0.33f, 0.06f})};
        place(coat, angle, {0, 0, 0}, out);
    }
    if (draw.whole(0, 1)) out.push_back(ball({0, high + 0.02f, 0}, {0.13f, 0.09f, 0.15f}));  // a hat
    return out;
}

Piece boxes(const Draw& draw) {
    Piece out;
    float low = 0.0f;
    for (int i = draw.whole(2, 4); i > 0; --i) {
        const Vec3 half(draw(0.14f, 0.28f), draw(0.12f, 0.25f), draw(0.14f, 0.28f));
        place({box({0, low + half.y, 0}, half)}, draw(-0.4f, 0.4f),
              {draw(-0.04f, 0.04f), 0, draw(-0.04f, 0.04f)}, out);
        low += 2.0f * half.y;
    }
    return out;
}

Piece plant(const Draw& draw) {
    Piece out = {pillar(0, 0, 0.0f, 0.3f, draw(0.13f, 0.18f)), bar({0, 0.2f, 0}, {0.02f, 1.0f, 0}, 0.015f)};
    const float high = draw(1.0f, 1.8f), wide = draw(0.2f, 0.35f);
    for (int i = 0; i < 40; ++i) {
        const float angle = 2.4f * float(i), reach = wide * draw(0.4f, 1.0f), up = draw(0.45f, high);
        const Vec3 tip(reach * std::cos(angle), up, reach * std::sin(angle));
        const Vec3 root(0, up - 0.15f, 0), way = 0.5f * (tip - root);
        const Vec3 side = 0.04f * glm::normalize(glm::cross(way, Vec3(0, 1, 0)));
        out.push_back({Shape::kEllipsoid, 0.5f * (root + tip),
                       Mat3(way, side, 0.01f * glm::normalize(glm::cross(way, side)))});
    }
    return out;
}

Piece bust(const Draw& draw) {
    const float size = draw(0.92f, 1.08f), hip = draw(0.85f, 1.0f);
    Piece out;
    add_star(draw.whole(3, 5), 0.24f, 0.12f, out);
    out.push_back(bar({0, 0.1f, 0}, {0, hip, 0}, 0.017f));
    out.push_back(ball({0, hip + 0.08f, 0}, Vec3(0.18f, 0.17f, 0.12f) * size));             // hips
    out.push_back(ball({0, hip + 0.27f, 0.01f}, Vec3(0.14f, 0.2f, 0.1f) * size));           // waist
    out.push_back(ball({0, hip + 0.45f, 0.02f}, Vec3(0.17f, 0.18f, 0.12f) * size));         // chest
    out.push_back(ball({0, hip + 0.56f, 0}, Vec3(0.2f, 0.08f, 0.08f) * size));              // shoulders
    out.push_back(pillar(0, 0, hip + 0.58f, hip + 0.7f, 0.055f * size));                    // neck
    if (draw.whole(0, 1)) out.push_back(ball({0, hip + 0.74f, 0}, {0.03f, 0.04f, 0.03f}));  // its knob
    return out;
}

Piece lamp(const Draw& draw) {
    const float high = draw(1.4f, 1.8f);
    return {ball({0, 0.01f, 0}, {0.15f, 0.02f, 0.15f}), bar({0, 0, 0}, {0, high, 0}, 0.012f),
            pillar(0, 0, high - 0.12f, high + 0.12f, draw(0.13f, 0.22f))};
}

Piece trolley(const Draw& draw) {
    Piece out;
    const float half = draw(0.2f, 0.3f), deep = draw(0.3f, 0.45f);
    for (const float y : {0.18f, draw(0.45f, 0.7f)}) out.push_back(box({0, y, 0}, {half, 0.03f, deep}));
    add_legs(half - 0.02f, deep - 0.02f, 0.95f, 0.015f, out);
    out.push_back(bar({-half, 0.95f, -deep}, {half, 0.95f, -deep}, 0.018f));
    for (const float a : {-half, half})
        for (const float b : {-deep, deep}) out.push_back(ball({a, 0.05f, b}, Vec3(0.05f)));
    if (draw.whole(0, 1)) out.push_back(box({0, 0.85f, 0}, {half - 0.03f, 0.18f, deep - 0.05f}));
    return out;
}

Piece robot(const Draw& draw) { return {ball({0, 0.045f, 0}, {draw(0.15f, 0.18f), 0.06f, 0.17f})}; }

Piece door(const Draw& draw) {
    const float half = draw(0.38f, 0.47f), half_height = draw(0.98f, 1.05f);
    return {box({half, half_height, 0}, {half, half_height, 0.02f}),
            box({2.0f * half - 0.08f, 1.05f, 0}, {0.06f, 0.015f, 0.06f})};  // the handle
}

Piece curtain(const Draw& draw) {
    Piece out;
    const float high = draw(1.9f, 2.3f), width = draw(0.35f, 1.3f), fold = draw(0.03f, 0.06f);
    const int folds = int(width / (1.6f * fold));
    for (int i = 0; i < folds; ++i)
        out.push_back(
            ball({-0.5f * width + 1.6f * fold * float(i), 0.5f * high + 0.03f, draw(-0.015f, 0.015f)},
                 {1.1f * fold, 0.62f * high, fold}));
    out.push_back(bar({-0.5f * width, high, 0}, {0.5f * width, high, 0}, 0.02f));
    return out;
}

}  // namespace

const char* name_of(Furniture kind) {
    constexpr const char* kNames[kFurnitureKinds] = {
        "swivel chair", "chair",         "armchair", "stool",         "clothes rack",
        "coat stand",   "stacked boxes", "plant",    "tailor's bust", "floor lamp",
        "trolley",      "vacuum robot",  "door",     "curtain",       "mannequin"};
    return kNames[size_t(kind)];
}

Piece make_furniture(Furniture kind, std::mt19937& random) {
    const Draw draw{random};
    switch (kind) {
        case Furniture::kSwivelChair: return swivel_chair(draw);
        case Furniture::kChair: return chair(draw);
        case Furniture::kArmchair: return armchair(draw);
        case Furniture::kStool: return stool(draw);
        case Furniture::kClothesRack: return clothes_rack(draw);
        case Furniture::kCoatStand: return coat_stand(draw);
        case Furniture::kBoxes: return boxes(draw);
        case Furniture::kPlant: return plant(draw);
        case Furniture::kBust: return bust(draw);
        case Furniture::kLamp: return lamp(draw);
        case Furniture::kTrolley: return trolley(draw);
        case Furniture::kRobot: return robot(draw);
        case Furniture::kDoor: return door(draw);
        case Furniture::kCurtain: return curtain(draw);
        case Furniture::kMannequin: break;
    }
    return {};
}

void place(const Piece& piece, float yaw_rad, const Vec3& by, Piece& out) {
    const float c = std::cos(yaw_rad), s = std::sin(yaw_rad);
    const Mat3 turn(Vec3(c, 0, -s), Vec3(0, 1, 0), Vec3(s, 0, c));
    for (const Solid& solid : piece)
        out.push_back({solid.shape, turn * solid.centre + by, turn * solid.half_axes});
}

}  // namespace vfit::tools
