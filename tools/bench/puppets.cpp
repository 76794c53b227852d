#include "bench/puppets.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace vfit::tools {

namespace {

constexpr double kRateHz = 30.0;
constexpr float kGravity = 9.81f;
constexpr float kStillM = 0.005f;  // an ankle so close to its place stands: a foot begins to roll unseen
// Of a puppet 1 m high in the hips, metres.
constexpr float kThigh = 0.46f, kShank = 0.45f, kAnkle = 0.08f, kHipHalf = 0.09f;
constexpr Vec3 kBall(0.0f, -0.06f, 0.13f), kHeel(0.0f, -0.08f, -0.05f);  // from the ankle

/// Jerk is least: 0 to 1.
float glide_to(float s) {
    s = std::clamp(s, 0.0f, 1.0f);
    return s * s * s * (10.0f - 15.0f * s + 6.0f * s * s);
}

float bump(float s) {
    s = std::clamp(s, 0.0f, 1.0f);
    const float x = 4.0f * s * (1.0f - s);
    return x * x * x;
}

Quat about_y(float angle) { return glm::angleAxis(angle, Vec3(0, 1, 0)); }
Quat pitched(float yaw, float pitch) { return about_y(yaw) * glm::angleAxis(pitch, Vec3(1, 0, 0)); }

/// On the circle where thigh and shank meet, to the front.
Vec3 knee_between(const Vec3& hip, const Vec3& ankle, const Vec3& front) {
    const Vec3 way = ankle - hip;
    const float d = std::min(glm::length(way), kThigh + kShank);
    const Vec3 down = glm::normalize(way);
    const float along = (kThigh * kThigh - kShank * kShank + d * d) / (2.0f * d);
    const Vec3 ahead = glm::normalize(front - glm::dot(front, down) * down);
    return hip + along * down + std::sqrt(std::max(0.0f, kThigh * kThigh - along * along)) * ahead;
}

struct Place {
    Vec2 at{0.0f};  // of the ankle
    float yaw = 0.0f;
};

/// One foot leaves the floor: up on its ball, through the air, down on its heel.
struct Move {
    int foot = 0;
    float lift_s = 0, land_s = 0;
    Place to;
    float clearance_m = 0.04f;
    float push_s = 0.1f, push_rad = 0.5f;       // on the ball
    float strike_s = 0.06f, strike_rad = 0.2f;  // on the heel
    Vec2 reach{0.0f};                           // out and back again on the way: a kick
};

struct Hop {
    float start_s = 0, speed = 0;  // m/s at take-off
    float flight_s() const { return 2.0f * speed / kGravity; }
};

struct Ankle {
    Vec3 at{0.0f};
    Quat turn{1, 0, 0, 0};
    float off_m = 0.0f;  // from where it stood or will stand, the nearer
};

struct Puppet {
    Place start[2];
    std::vector<Move> moves;
    std::vector<Hop> hops;
    float length_s = 20.0f, squat_m = 0.0f, squat_hz = 0.25f, size = 1.0f;
    float most_reach = 0.985f;  // of a leg's length

    Ankle ankle(int foot, float t) const;
    float flight(float t) const;
    Vec2 middle(float t) const;
    float heading(float t) const;
    Vec3 pelvis(float t) const;
    PersonFrame frame(float t) const;
};

Ankle Puppet::ankle(int foot, float t) const {
    Place from = start[foot];
    Ankle out;
    const auto flat = [](const Place& p) { return Vec3(p.at.x, kAnkle, p.at.y); };
    out.at = flat(from), out.turn = about_y(from.yaw);
    for (const Move& move : moves) {
        if (move.foot != foot || t < move.lift_s) continue;
        if (t >= move.land_s) {
            from = move.to;
            out.at = flat(from), out.turn = about_y(from.yaw);
            continue;
        }
        const float air = move.lift_s + move.push_s, strike = move.land_s - move.strike_s;
        // The ankle over a ball or heel that stands.
        const auto over = [&](const Place& p, const Vec3& point, float pitch) {
            return flat(p) + about_y(p.yaw) * point - pitched(p.yaw, pitch) * point;
        };
        if (t < air) {
            const float pitch = move.push_rad * glide_to((t - move.lift_s) / move.push_s);
            out.at = over(from, kBall, pitch), out.turn = pitched(from.yaw, pitch);
        } else if (t < strike) {
            const float s = (t - air) / (strike - air), g = glide_to(s);
            const Vec3 a = over(from, kBall, move.push_rad), b = over(move.to, kHeel, -move.strike_rad);
            out.at = glm::mix(a, b, g) +
                     bump(s) * (Vec3(move.reach.x, 0.0f, move.reach.y) + Vec3(0.0f, move.clearance_m, 0.0f));
            out.turn =
                pitched(glm::mix(from.yaw, move.to.yaw, g), glm::mix(move.push_rad, -move.strike_rad, g));
        } else {
            const float pitch = -move.strike_rad * (1.0f - glide_to((t - strike) / move.strike_s));
            out.at = over(move.to, kHeel, pitch), out.turn = pitched(move.to.yaw, pitch);
        }
        out.off_m = std::min(glm::distance(out.at, flat(from)), glm::distance(out.at, flat(move.to)));
        break;
    }
    const float up = flight(t);
    out.at.y += up;
    out.off_m += up;
    return out;
}

float Puppet::flight(float t) const {
    for (const Hop& hop : hops) {
        const float in = t - hop.start_s;
        if (in > 0.0f && in < hop.flight_s()) return hop.speed * in - 0.5f * kGravity * in * in;
    }
    return 0.0f;
}

/// Between the feet, as a body glides that knows where it goes.
Vec2 Puppet::middle(float t) const {
    Vec2 sum(0.0f);
    float weights = 0.0f;
    for (int k = -8; k <= 8; ++k) {
        const float w = std::exp(-0.5f * float(k * k) / 16.0f);
        for (const int foot : {0, 1}) {
            const Vec3 at = ankle(foot, t + 0.05f * float(k)).at;
            sum += w * Vec2(at.x, at.z), weights += w;
        }
    }
    return sum / weights;
}

float Puppet::heading(float t) const {
    float sum = 0.0f;
    for (int k = -4; k <= 4; ++k)
        for (const int foot : {0, 1}) {
            const Vec3 ahead = ankle(foot, t + 0.06f * float(k)).turn * Vec3(0, 0, 1);
            sum += std::atan2(ahead.x, ahead.z);
        }
    return sum / 18.0f;
}

Vec3 Puppet::pelvis(float t) const {
    const auto reach = [&](float at_s) {
        const Vec2 m = middle(at_s);
        float y = 10.0f;
        for (const int foot : {0, 1}) {
            const Ankle a = ankle(foot, at_s);
            const float length = most_reach * (kThigh + kShank);
            const Vec3 hip =
                Vec3(m.x, 0.0f, m.y) + about_y(heading(at_s)) * Vec3(foot == 0 ? kHipHalf : -kHipHalf, 0, 0);
            const float aside = glm::length(Vec2(a.at.x - hip.x, a.at.z - hip.z));
            const float up = flight(at_s);
            y = std::min(y, a.at.y - up + std::sqrt(std::max(0.04f, length * length - aside * aside)));
        }
        return y;
    };
    float y = 0.0f;
    for (int k = -2; k <= 2; ++k) y += reach(t + 0.04f * float(k)) / 5.0f;
    y -= squat_m * (0.5f - 0.5f * std::cos(2.0f * kPi * squat_hz * t));
    for (const Hop& hop : hops) {  // knees give way before take-off and after landing
        const float before = (t - hop.start_s + 0.5f) / 0.5f,
                    after = (t - hop.start_s - hop.flight_s()) / 0.4f;
        if (before > 0.0f && before < 1.0f) y -= 0.12f * bump(before);
        if (after > 0.0f && after < 1.0f) y -= 0.10f * bump(after);
    }
    const Vec2 m = middle(t);
    return {m.x, y + flight(t), m.y};
}

PersonFrame Puppet::frame(float t) const {
    PersonFrame out;
    Body& body = out.truth;
    const Vec3 root = pelvis(t);
    const Quat turn = about_y(heading(t));
    const auto put = [&](int joint, const Vec3& at) { body.set(joint, size * at); };
    put(VFIT_JOINT_PELVIS, root + Vec3(0, 0.06f, 0));
    put(VFIT_JOINT_TORSO, root + Vec3(0, 0.28f, 0));
    put(VFIT_JOINT_NECK, root + Vec3(0, 0.53f, 0));
    put(VFIT_JOINT_HEAD, root + turn * Vec3(0, 0.68f, 0.02f));
    for (const int side : {0, 1}) {
        const float x = side == 0 ? 1.0f : -1.0f;
        const float swing = 0.15f * std::sin(2.0f * t + 3.14f * float(side));
        put(VFIT_JOINT_LEFT_SHOULDER + side, root + turn * Vec3(0.18f * x, 0.5f, 0));
        put(VFIT_JOINT_LEFT_ELBOW + side, root + turn * Vec3(0.23f * x, 0.23f, -0.3f * swing));
        put(VFIT_JOINT_LEFT_WRIST + side, root + turn * Vec3(0.25f * x, 0.0f, swing + 0.05f));
        put(VFIT_JOINT_LEFT_HAND + side, root + turn * Vec3(0.25f * x, -0.08f, swing + 0.06f));
        const Ankle foot = ankle(side, t);
        const Vec3 hip = root + turn * Vec3(kHipHalf * x, 0, 0);
        const Vec3 front = turn * Vec3(0, 0, 1) + foot.turn * Vec3(0, 0, 1);
        put(VFIT_JOINT_LEFT_HIP + side, hip);
        put(VFIT_JOINT_LEFT_KNEE + side, knee_between(hip, foot.at, front));
        put(VFIT_JOINT_LEFT_FOOT + side, foot.at);
        put(VFIT_JOINT_LEFT_TOES + side, foot.at + foot.turn * kBall);
        out.planted[size_t(side)] = foot.off_m < kStillM;
    }
    body.id = 1;
    return out;
}

/// Writes the moves of a puppet one after the other.
class Author {
public:
    explicit Author(uint32_t seed) : engine_(seed) {
        puppet_.size = uniform(0.85f, 1.1f);
        const float half = uniform(0.08f, 0.14f);
        for (const int foot : {0, 1})
            puppet_.start[foot] = place_[foot] = {{foot == 0 ? half : -half, 0.0f}, 0.0f};
        half_ = half;
    }
    float uniform(float a, float b) { return std::uniform_real_distribution<float>(a, b)(engine_); }
    void wait(float s) { now_ += s; }
    bool done() const { return now_ > puppet_.length_s - 1.5f; }

    Move& step(int foot, const Place& to, float swing_s) {
        Move move;
        move.foot = foot, move.lift_s = now_, move.land_s = now_ + swing_s, move.to = place_[foot] = to;
        move.clearance_m = uniform(0.03f, 0.08f), move.push_rad = uniform(0.3f, 0.8f);
        move.push_s = uniform(0.2f, 0.3f) * swing_s, move.strike_s = uniform(0.1f, 0.2f) * swing_s;
        now_ += swing_s;
        puppet_.moves.push_back(move);
        return puppet_.moves.back();
    }
    /// Where that foot stands in a body at `centre` that heads so.
    Place stance(int foot, const Vec2& centre, float yaw) const {
        const float x = foot == 0 ? half_ : -half_;
        return {centre + Vec2(x * std::cos(yaw), -x * std::sin(yaw)), yaw};
    }
    const Place& place(int foot) const { return place_[foot]; }
    void hop(float height_m) {
        puppet_.hops.push_back({now_ + 0.6f, std::sqrt(2.0f * kGravity * height_m)});
        now_ += 0.6f + puppet_.hops.back().flight_s() + 0.6f;
    }
    void squat(float m) { puppet_.squat_m = m; }
    const Puppet& puppet() const { return puppet_; }

private:
    std::mt19937 engine_;
    Puppet puppet_;
    Place place_[2];
    float now_ = 1.5f, half_ = 0.1f;
};

void stroll(Author& a) {
    Vec2 centre(0.0f);
    float yaw = 0.0f, walked = 0.0f;
    const float stride = a.uniform(0.2f, 0.42f), swing = a.uniform(0.4f, 0.6f), rest = a.uniform(0.04f, 0.2f);
    for (int foot = 0; !a.done(); foot = 1 - foot) {
        if (walked > 1.8f) walked = 0.0f, yaw += 2.6f;
        walked += stride;
        const float bend = a.uniform(-0.1f, 0.1f);
        yaw += bend;
        centre += stride * Vec2(std::sin(yaw), std::cos(yaw));
        a.step(foot, a.stance(foot, centre, yaw), swing);
        a.wait(rest);
    }
}

void aside(Author& a) {
    float x = 0.0f, way = a.uniform(0.12f, 0.3f);
    while (!a.done()) {
        x += way;
        const int lead = way > 0.0f ? 0 : 1;
        for (const int foot : {lead, 1 - lead}) {
            a.step(foot, a.stance(foot, {x, 0.0f}, 0.0f), a.uniform(0.3f, 0.5f)).push_rad = 0.25f;
            a.wait(a.uniform(0.05f, 0.3f));
        }
        if (std::abs(x) > 0.7f && x * way > 0.0f) way = -way;
    }
}

void march(Author& a) {
    const float swing = a.uniform(0.4f, 0.7f);
    for (int foot = 0; !a.done(); foot = 1 - foot) {
        a.step(foot, a.place(foot), swing).clearance_m = a.uniform(0.1f, 0.3f);
        a.wait(a.uniform(0.03f, 0.15f));
    }
}

void lunge(Author& a) {
    for (int foot = 0; !a.done(); foot = 1 - foot) {
        const Place home = a.place(foot);
        const float length = a.uniform(0.35f, 0.6f);
        a.step(foot, {home.at + Vec2(0.0f, length), 0.0f}, a.uniform(0.5f, 0.7f));
        a.wait(a.uniform(0.4f, 1.2f));
        a.step(foot, home, a.uniform(0.5f, 0.8f)).strike_rad = 0.0f;
        a.wait(a.uniform(0.2f, 0.6f));
    }
}

void hop(Author& a) {
    while (!a.done()) {
        a.hop(a.uniform(0.06f, 0.3f));
        a.wait(a.uniform(0.0f, 0.6f));
    }
}

void pivot(Author& a) {
    float yaw = 0.0f, by = a.uniform(0.3f, 0.7f);
    while (!a.done()) {
        yaw += by;
        for (const int foot : {by > 0.0f ? 0 : 1, by > 0.0f ? 1 : 0}) {
            a.step(foot, a.stance(foot, {0.0f, 0.0f}, yaw), a.uniform(0.3f, 0.5f));
            a.wait(a.uniform(0.03f, 0.2f));
        }
        if (std::abs(yaw) > 3.0f) by = -by;
    }
}

void kick(Author& a) {
    for (int foot = 0; !a.done(); foot = a.uniform(0.0f, 1.0f) < 0.5f ? 0 : 1) {
        Move& move = a.step(foot, a.place(foot), a.uniform(0.8f, 1.6f));
        move.clearance_m = a.uniform(0.1f, 0.4f);
        move.reach = {a.uniform(-0.1f, 0.1f), a.uniform(0.1f, 0.4f)};
        a.wait(a.uniform(0.3f, 1.0f));
    }
}

void squat(Author& a) { a.squat(a.uniform(0.15f, 0.4f)); }

PersonStream play(const char* name, const Puppet& puppet) {
    PersonStream stream{name, {}};
    const auto frames = size_t(double(puppet.length_s) * kRateHz);
    for (size_t k = 0; k < frames; ++k) {
        PersonFrame frame = puppet.frame(float(double(k) / kRateHz));
        frame.truth.time_ns = int64_t(std::llround(1e9 * double(k) / kRateHz));
        frame.tracked = frame.truth;
        stream.frames.push_back(frame);
    }
    return stream;
}

}  // namespace

PersonStream straight_puppet() {
    Puppet puppet;
    for (const int foot : {0, 1}) puppet.start[foot].at.x = foot == 0 ? kHipHalf : -kHipHalf;
    puppet.most_reach = 1.0f;
    return play("stand", puppet);
}

std::vector<PersonStream> puppets(uint32_t count) {
    constexpr struct {
        const char* name;
        void (*write)(Author&);
    } kScripts[] = {{"stroll", stroll}, {"aside", aside}, {"march", march}, {"lunge", lunge},
                    {"jump", hop},      {"pivot", pivot}, {"kick", kick},   {"squat", squat}};
    std::vector<PersonStream> streams;
    for (uint32_t i = 0; i < count; ++i)
        for (const auto& script : kScripts) {
            Author author(9000 + 100 * i + uint32_t(&script - kScripts));
            script.write(author);
            streams.push_back(play(script.name, author.puppet()));
        }
    return streams;
}

}  // namespace vfit::tools
