#include "clutter.h"

#include "solids.h"

namespace vfit::training {

namespace {

void add_chair(Random& random, Mesh& out) {
    const float seat = random.between(0.4f, 0.55f), half = random.between(0.2f, 0.3f),
                back = random.between(0.35f, 0.7f);
    add_box({0, seat, 0}, size(half, 0.03f, half), out);
    add_box({0, seat + 0.5f * back, -half}, size(half, 0.5f * back, 0.025f), out);
    if (random.chance(0.5f)) {
        for (const float x : {-0.9f, 0.9f})
            for (const float z : {-0.9f, 0.9f})
                add_box({x * half, 0.5f * seat, z * half}, size(0.02f, 0.5f * seat, 0.02f), out);
    } else {
        add_box({0, 0.5f * seat, 0}, size(0.04f, 0.5f * seat, 0.04f), out);
        add_box({0, 0.04f, 0}, size(half, 0.03f, half), out);
    }
    if (random.chance(0.3f))  // a coat over its back
        add_ellipsoid({0, seat + 0.6f * back, -half}, size(half * 1.2f, 0.6f * back, 0.12f), out);
}

void add_rack(Random& random, Mesh& out) {
    const float height = random.between(1.4f, 1.95f);
    add_box({0, 0.5f * height, 0}, size(0.025f, 0.5f * height, 0.025f), out);
    add_box({0, 0.02f, 0}, size(0.22f, 0.02f, 0.22f), out);
    const uint32_t coats = random.below(4);
    for (uint32_t i = 0; i < coats; ++i) {
        const float length = random.between(0.3f, 0.6f), wide = random.between(0.12f, 0.3f);
        const Vec3 at(random.between(-0.15f, 0.15f), height - length - random.between(0.0f, 0.2f),
                      random.between(-0.12f, 0.12f));
        add_ellipsoid(at, size(wide, length, random.between(0.06f, 0.15f)), out);
    }
    if (random.chance(0.4f)) add_ellipsoid({0, height, 0}, size(0.14f, 0.08f, 0.14f), out);  // a hat
}

void add_plant(Random& random, Mesh& out) {
    const float pot = random.between(0.2f, 0.5f), height = random.between(0.7f, 1.8f);
    add_ellipsoid({0, 0.5f * pot, 0}, size(0.16f, 0.5f * pot, 0.16f), out);
    add_box({0, 0.5f * height, 0}, size(0.02f, 0.5f * height, 0.02f), out);
    for (int i = 0; i < 12; ++i)
        add_ellipsoid(
            Vec3(0, height * random.between(0.5f, 1.0f), 0) + 0.3f * random.direction(),
            size(random.between(0.03f, 0.15f), random.between(0.03f, 0.2f), random.between(0.02f, 0.1f)),
            out);
}

void add_pile(Random& random, Mesh& out) {
    float floor = 0.0f;
    const uint32_t count = 1 + random.below(4);
    for (uint32_t i = 0; i < count; ++i) {
        const float half = random.between(0.08f, 0.5f);
        add_box({random.between(-0.15f, 0.15f), floor + half, random.between(-0.1f, 0.1f)},
                size(random.between(0.1f, 0.5f), half, random.between(0.1f, 0.4f)), out);
        floor += 2 * half;
    }
}

/// A board, a door, a screen on its feet: as tall and as wide as a person.
void add_board(Random& random, Mesh& out) {
    const float height = random.between(0.6f, 2.0f),
                foot = random.chance(0.6f) ? 0.0f : random.between(0.1f, 0.7f);
    add_box({0, 0.5f * (foot + height), 0},
            size(random.between(0.15f, 0.6f), 0.5f * (height - foot) + 0.05f, random.between(0.01f, 0.15f)),
            out);
    if (foot > 0.0f) add_box({0, 0.5f * foot, 0}, size(0.03f, 0.5f * foot, 0.03f), out);
}

void add_anything(Random& random, Mesh& out) {
    const uint32_t count = 2 + random.below(7);
    for (uint32_t i = 0; i < count; ++i) {
        const Vec3 at(random.normal(0, 0.25f), random.between(0.1f, 1.6f), random.normal(0, 0.2f));
        const Mat3 axes =
            glm::mat3_cast(glm::angleAxis(random.between(0, 2 * kPi), random.direction())) *
            size(random.between(0.04f, 0.4f), random.between(0.04f, 0.4f), random.between(0.04f, 0.3f));
        if (random.chance(0.5f))
            add_box(at, axes, out);
        else
            add_ellipsoid(at, axes, out);
    }
}

void add_thing(Random& random, Mesh& out) {
    switch (random.below(12)) {
        case 0: add_chair(random, out); break;
        case 1: add_rack(random, out); break;
        case 2: add_plant(random, out); break;
        case 3: add_pile(random, out); break;
        case 4: add_board(random, out); break;
        case 5: add_anything(random, out); break;
        default: add_fitting(random, out);
    }
}

}  // namespace

void random_clutter(Random& random, Mesh& out) {
    out.positions.clear(), out.indices.clear();
    const uint32_t things = random.chance(0.7f) ? 1 : 2 + random.below(2);
    for (uint32_t i = 0; i < things; ++i) {
        const size_t first = out.positions.size();
        add_thing(random, out);
        const Quat turn = glm::angleAxis(random.between(0, 2 * kPi), Vec3(0, 1, 0));
        const Vec3 beside = i == 0 ? Vec3(0) : Vec3(random.normal(0, 0.5f), 0, random.normal(0, 0.15f));
        for (size_t k = first; k < out.positions.size(); ++k)
            out.positions[k] = turn * out.positions[k] + beside;
    }
    if (random.chance(0.15f)) {  // under a sensor that hangs askew, or that was given a wrong way up
        const Quat tilt =
            glm::angleAxis(random.between(0.3f, kPi), glm::normalize(Vec3(random.normal(0, 0.5f), 0, 1)));
        for (Vec3& p : out.positions) p = Vec3(0, 1, 0) + tilt * (p - Vec3(0, 1, 0));
    }
}

}  // namespace vfit::training
