#include <cmath>

#include "clutter.h"
#include "solids.h"

namespace vfit::training {

namespace {

/// A sheet of cloth in folds.
void add_curtain(Random& random, Mesh& out) {
    const float width = random.between(0.25f, 1.4f), top = random.between(1.6f, 2.6f),
                bottom = random.between(0.0f, 0.9f), fold = random.between(0.06f, 0.2f),
                deep = random.between(0.01f, 0.06f), phase = random.between(0, 2 * kPi);
    const int count = 24;
    for (int i = 0; i < count; ++i) {
        const float x = width * ((float(i) + 0.5f) / float(count) - 0.5f);
        const float z = deep * std::sin(2 * kPi * x / fold + phase);
        const float lean = deep / fold * 2 * kPi * std::cos(2 * kPi * x / fold + phase);
        const float half = 0.55f * width / float(count);
        const Mat3 axes(half, 0, half * lean, 0, 0.5f * (top - bottom), 0, 0, 0, 0.004f);
        add_box({x, 0.5f * (top + bottom), z}, axes, out);
    }
}

/// A window or a door: a frame, bars, perhaps a leaf that stands open.
void add_frame(Random& random, Mesh& out) {
    const float half = random.between(0.25f, 0.7f),
                bottom = random.chance(0.5f) ? 0.0f : random.between(0.5f, 1),
                top = random.between(1.6f, 2.4f), bar = random.between(0.02f, 0.07f),
                deep = random.between(0.02f, 0.12f), middle = 0.5f * (top + bottom);
    const float tall = 0.5f * (top - bottom);
    for (const float side : {-1.0f, 1.0f}) {
        if (random.chance(0.8f)) add_box({side * half, middle, 0}, size(bar, tall, deep), out);
        if (random.chance(0.6f)) add_box({0, middle + side * tall, 0}, size(half, bar, deep), out);
    }
    const uint32_t bars = random.below(3);
    for (uint32_t i = 0; i < bars; ++i) {
        const float at = random.between(-0.7f, 0.7f);
        if (random.chance(0.5f))
            add_box({at * half, middle, 0}, size(0.5f * bar, tall, 0.02f), out);
        else
            add_box({0, middle + at * tall, 0}, size(half, 0.5f * bar, 0.02f), out);
    }
    if (random.chance(0.4f)) {
        const float open = random.between(0.2f, 1.6f);
        const Mat3 axes(0.5f * half * std::cos(open), 0, 0.5f * half * std::sin(open), 0, tall, 0,
                        -0.02f * std::sin(open), 0, 0.02f * std::cos(open));
        add_box(Vec3(-half, middle, 0) + axes[0], axes, out);
    }
}

/// Pipes, posts, legs of stands: long and thin, side by side, upright or lying, with lamps and boxes on them.
void add_pipes(Random& random, Mesh& out) {
    const uint32_t count = 1 + random.below(4);
    const bool lying = random.chance(0.3f);
    const float at = lying ? random.between(0.3f, 2.4f) : random.between(0.6f, 1.4f);
    for (uint32_t i = 0; i < count; ++i) {
        const float half = random.between(0.4f, 1.1f), thick = random.between(0.015f, 0.12f);
        const Vec3 place(random.between(-0.25f, 0.25f), at + random.between(-0.15f, 0.15f),
                         random.between(-0.15f, 0.15f));
        const float slant = random.normal(0, 0.06f);
        const Mat3 axes = glm::mat3_cast(glm::angleAxis(slant + (lying ? 0.5f * kPi : 0.0f), Vec3(0, 0, 1)));
        if (random.chance(0.5f))
            add_box(place, axes * size(thick, half, thick), out);
        else
            add_ellipsoid(place, axes * size(thick, half, thick), out);
        if (random.chance(0.4f))
            add_box(place + axes * Vec3(0, random.between(-half, half), 0),
                    size(random.between(0.05f, 0.2f), random.between(0.03f, 0.2f), 0.1f), out);
    }
}

/// Boards between sides, and what lies on them.
void add_shelf(Random& random, Mesh& out) {
    const float half = random.between(0.2f, 0.6f), deep = random.between(0.1f, 0.3f);
    const float bottom = random.chance(0.6f) ? 0.0f : random.between(0.5f, 1.4f);
    const float top = bottom + random.between(0.5f, 1.8f), gap = random.between(0.2f, 0.45f);
    for (const float side : {-1.0f, 1.0f})
        add_box({side * half, 0.5f * (top + bottom), 0}, size(0.015f, 0.5f * (top - bottom), deep), out);
    for (float y = bottom; y < top; y += gap) {
        add_box({0, y, 0}, size(half, 0.012f, deep), out);
        const uint32_t count = random.below(5);
        for (uint32_t i = 0; i < count; ++i) {
            const float tall = random.between(0.05f, 0.45f) * gap;
            add_box({random.between(-0.9f, 0.9f) * half, y + tall, random.between(-0.3f, 0.5f) * deep},
                    size(random.between(0.01f, 0.15f), tall, random.between(0.03f, 0.7f) * deep), out);
        }
    }
}

/// A piece of wall or cupboard front with doors, handles and a relief.
void add_wall(Random& random, Mesh& out) {
    const float half = random.between(0.2f, 1.2f), tall = random.between(0.3f, 1.2f),
                middle = random.between(0.4f, 1.8f);
    add_box({0, middle, -0.05f}, size(half, tall, 0.05f), out);
    const uint32_t count = random.below(6);
    for (uint32_t i = 0; i < count; ++i)
        add_box({random.between(-half, half), middle + random.between(-tall, tall), 0},
                size(random.between(0.05f, 0.5f) * half, random.between(0.05f, 0.5f) * tall,
                     random.between(0.005f, 0.12f)),
                out);
}

void add_seat(Random& random, const Vec3& at, float turn, Mesh& out) {
    const Mat3 frame = glm::mat3_cast(glm::angleAxis(turn, Vec3(0, 1, 0)));
    const float seat = random.between(0.4f, 0.5f), half = random.between(0.19f, 0.26f),
                top = random.between(0.75f, 1.15f), leg = random.between(0.012f, 0.03f);
    const auto box = [&](const Vec3& centre, const Mat3& axes) {
        add_box(at + frame * centre, frame * axes, out);
    };
    box({0, seat, 0}, size(half, random.between(0.01f, 0.06f), half));
    for (const float x : {-0.9f, 0.9f}) {
        box({x * half, 0.5f * seat, 0.9f * half}, size(leg, 0.5f * seat, leg));
        box({x * half, 0.5f * top, -0.9f * half}, size(leg, 0.5f * top, leg));
    }
    const uint32_t bars = random.below(5);
    if (random.chance(0.5f)) {  // a back of bars, upright or lying
        for (uint32_t i = 0; i < bars; ++i) {
            const float part = (float(i) + 0.5f) / float(bars);
            if (random.chance(0.5f))
                box({(2 * part - 1) * half, 0.5f * (seat + top), -0.9f * half},
                    size(leg, 0.5f * (top - seat), 0.01f));
            else
                box({0, seat + part * (top - seat), -0.9f * half}, size(half, 0.03f, 0.01f));
        }
        box({0, top, -0.9f * half}, size(half, 0.03f, 0.015f));
    } else
        box({0, 0.6f * top + 0.4f * seat, -0.9f * half}, size(half, 0.4f * (top - seat), 0.02f));
    if (random.chance(0.3f))
        for (const float x : {-1.0f, 1.0f}) box({x * half, seat + 0.2f, 0}, size(0.025f, 0.02f, half));
}

void add_armchair(Random& random, Mesh& out) {
    const float half = random.between(0.28f, 0.45f), seat = random.between(0.35f, 0.48f),
                top = random.between(0.75f, 1.2f), soft = random.between(0.06f, 0.14f);
    add_ellipsoid({0, 0.6f * seat, 0}, size(1.2f * half, 0.5f * seat, 1.2f * half), out);
    add_ellipsoid({0, 0.5f * top + 0.1f, -half}, size(1.1f * half, 0.55f * top, soft), out);
    for (const float x : {-1.0f, 1.0f}) {
        add_ellipsoid({x * half, seat + 0.1f, 0}, size(soft, 0.2f, 1.1f * half), out);
        add_box({0.8f * x * half, 0.2f * seat, 0.8f * half}, size(0.025f, 0.2f * seat, 0.025f), out);
        add_box({0.8f * x * half, 0.2f * seat, -0.8f * half}, size(0.025f, 0.2f * seat, 0.025f), out);
    }
}

/// A table, what lies on it, and chairs at it.
void add_table(Random& random, Mesh& out) {
    const float half = random.between(0.3f, 0.9f), deep = random.between(0.25f, 0.5f),
                top = random.between(0.45f, 1.05f);
    add_box({0, top, 0}, size(half, 0.02f, deep), out);
    for (const float x : {-0.9f, 0.9f})
        for (const float z : {-0.9f, 0.9f})
            add_box({x * half, 0.5f * top, z * deep}, size(0.03f, 0.5f * top, 0.03f), out);
    const uint32_t things = random.below(5);
    for (uint32_t i = 0; i < things; ++i) {
        const float tall = random.between(0.02f, 0.25f);
        const Vec3 at(random.between(-0.9f, 0.9f) * half, top + tall, random.between(-0.8f, 0.8f) * deep);
        const Mat3 axes = size(random.between(0.03f, 0.3f), tall, random.between(0.02f, 0.15f));
        if (random.chance(0.6f))
            add_box(at, axes, out);
        else
            add_ellipsoid(at, axes, out);
    }
    const uint32_t chairs = random.below(4);
    for (uint32_t i = 0; i < chairs; ++i) {
        const float side = random.chance(0.5f) ? 1.0f : -1.0f;
        add_seat(random, {random.between(-1, 1) * half, 0, side * (deep + random.between(-0.15f, 0.3f))},
                 (side > 0 ? kPi : 0.0f) + random.normal(0, 0.4f), out);
    }
}

}  // namespace

void add_fitting(Random& random, Mesh& out) {
    switch (random.below(8)) {
        case 0: add_curtain(random, out); break;
        case 1: add_frame(random, out); break;
        case 2: add_pipes(random, out); break;
        case 3: add_shelf(random, out); break;
        case 4: add_wall(random, out); break;
        case 5: add_seat(random, Vec3(0), random.between(0, 2 * kPi), out); break;
        case 6: add_armchair(random, out); break;
        default: add_table(random, out);
    }
}

}  // namespace vfit::training
