#include "bench/gait.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <sstream>
#include <vector>

#include "math/types.h"

namespace vfit::tools {

namespace {

constexpr float kRate_hz = 120.0f;
// Flexion by tenths of the cycle from heel strike on, degrees, of a natural walk (after Winter, Biomechanics and
// Motor Control of Human Movement); at the ankle up.
constexpr std::array<float, 10> kHip = {25, 22, 13, 3, -5, -10, -4, 12, 24, 27};
constexpr std::array<float, 10> kKnee = {4, 16, 17, 10, 6, 12, 35, 58, 48, 14};
constexpr std::array<float, 10> kAnkle = {0, -4, 3, 7, 10, 5, -15, -10, 0, 1};

// Metres, of a leg of 0.86; the person's own leg scales all.
constexpr float kHipHalf = 0.09f, kThigh = 0.44f, kShank = 0.42f, kSole = 0.08f, kBall = 0.13f, kHeel = 0.05f;

/// Through the tenths, smoothly and round.
float curve(const std::array<float, 10>& table, float phase) {
    const float x = 10.0f * (phase - std::floor(phase));
    const auto i = size_t(x) % 10;
    const float s = x - std::floor(x);
    const float a = table[(i + 9) % 10], b = table[i], c = table[(i + 1) % 10], d = table[(i + 2) % 10];
    return b + 0.5f * s * (c - a + s * (2 * a - 5 * b + 4 * c - d + s * (3 * (b - c) + d - a)));
}

struct LegAngles {
    float hip = 0, knee = 0, ankle = 0;  // degrees
    float foot_pitch() const { return -hip + knee - ankle; }
};

Vec3 turned_x(const Vec3& v, float degrees) {
    const float a = degrees * kPi / 180.0f;
    return {v.x, v.y * std::cos(a) - v.z * std::sin(a), v.y * std::sin(a) + v.z * std::cos(a)};
}

Vec3 turned_y(const Vec3& v, float degrees) {
    const float a = degrees * kPi / 180.0f;
    return {v.x * std::cos(a) + v.z * std::sin(a), v.y, -v.x * std::sin(a) + v.z * std::cos(a)};
}

/// Heel and ball of a foot, from the middle of the hips, in a body that heads along Z.
std::array<Vec3, 2> sole(int side, const LegAngles& leg) {
    const Vec3 hip(side == 0 ? kHipHalf : -kHipHalf, 0, 0);
    const Vec3 ankle = hip + turned_x({0, -kThigh, 0}, -leg.hip) + turned_x({0, -kShank, 0}, leg.knee - leg.hip);
    return {ankle + turned_x({0, -kSole, -kHeel}, leg.foot_pitch()),
            ankle + turned_x({0, -kSole, kBall}, leg.foot_pitch())};
}

class Walker {
public:
    explicit Walker(uint32_t seed) : engine_(seed) {
        cycle_s_ = uniform(0.9f, 1.7f);
        hip_ = uniform(0.45f, 1.15f), knee_ = uniform(0.6f, 1.2f), ankle_ = uniform(0.5f, 1.3f);
        hip_bias_ = uniform(-4, 4), knee_bias_ = uniform(0, 6), ankle_bias_ = uniform(-3, 3);
        warp_ = uniform(-0.12f, 0.12f);
        arm_ = uniform(5, 35), list_ = uniform(0, 5), twist_ = uniform(0, 8), lean_ = uniform(-3, 6);
        turn_deg_s_ = engine_() % 2 ? uniform(-40, 40) : 0.0f;
        stops_ = engine_() % 2 == 0;
        phase_ = uniform(0, 1);
        length_s_ = uniform(3.0f, 6.0f);
    }

    float length_s() const { return length_s_; }
    float heading(float t) const { return turn_deg_s_ * (t - 0.5f * length_s_); }
    /// 0 who stands, 1 who walks.
    float share(float t) const {
        if (!stops_) return 1.0f;
        const float s = std::clamp(std::min(t, length_s_ - t) / 1.0f - 0.4f, 0.0f, 1.0f);
        return s * s * (3.0f - 2.0f * s);
    }
    float cycle(float t, int side) const { return phase_ + t / cycle_s_ + (side == 0 ? 0.0f : 0.5f); }
    LegAngles leg(int side, float t) const {
        // Stance longer than swing, or shorter.
        float p = cycle(t, side);
        p += warp_ * std::sin(2.0f * kPi * p) / (2.0f * kPi);
        const float s = share(t);
        return {s * (hip_ * curve(kHip, p) + hip_bias_), s * (knee_ * curve(kKnee, p) + knee_bias_) + 3.0f * (1 - s),
                s * (ankle_ * curve(kAnkle, p) + ankle_bias_) + 1.5f * (1 - s)};
    }
    float swing(float t, int side) const { return share(t) * std::sin(2.0f * kPi * cycle(t, side)); }
    float arm() const { return arm_; }
    float list() const { return list_; }
    float twist() const { return twist_; }
    float lean() const { return lean_; }

private:
    float uniform(float a, float b) { return std::uniform_real_distribution<float>(a, b)(engine_); }

    std::mt19937 engine_;
    float cycle_s_, hip_, knee_, ankle_, hip_bias_, knee_bias_, ankle_bias_, warp_, arm_, list_, twist_, lean_;
    float turn_deg_s_, phase_, length_s_;
    bool stops_;
};

/// The root's path on which the lowest point of heels and balls stands still.
std::vector<Vec3> path_of(const Walker& walker, size_t frames) {
    std::vector<Vec3> path;
    Vec3 root(0.0f);
    std::array<Vec3, 4> before{};
    for (size_t i = 0; i < frames; ++i) {
        const float t = float(i) / kRate_hz;
        std::array<Vec3, 4> points;
        for (size_t side = 0; side < 2; ++side) {
            const auto two = sole(int(side), walker.leg(int(side), t));
            for (size_t k = 0; k < 2; ++k) points[2 * side + k] = turned_y(two[k], walker.heading(t));
        }
        const auto lowest = size_t(std::min_element(points.begin(), points.end(),
                                                    [](const Vec3& a, const Vec3& b) { return a.y < b.y; }) -
                                   points.begin());
        if (i > 0) root += before[lowest] - points[lowest];
        root.y = -points[lowest].y;
        path.push_back(root);
        before = points;
    }
    // Where heel gives way to ball the path has a kink; bodies have none.
    constexpr size_t kHalf = 6;
    std::vector<Vec3> smooth;
    for (size_t i = 0; i < frames; ++i) {
        Vec3 sum(0.0f);
        const size_t a = i > kHalf ? i - kHalf : 0, b = std::min(frames, i + kHalf + 1);
        for (size_t k = a; k < b; ++k) sum += path[k];
        smooth.push_back(sum / float(b - a));
    }
    return smooth;
}

/// The hierarchy, and the order in which the joints' angles follow: about Z, Y and X.
constexpr const char* kHierarchy = R"(HIERARCHY
ROOT Hips
{ OFFSET 0 0 0 CHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation
  JOINT LeftHip { OFFSET 0.09 0 0 CHANNELS 3 Zrotation Yrotation Xrotation
    JOINT LeftKnee { OFFSET 0 -0.44 0 CHANNELS 3 Zrotation Yrotation Xrotation
      JOINT LeftAnkle { OFFSET 0 -0.42 0 CHANNELS 3 Zrotation Yrotation Xrotation
        JOINT LeftToe { OFFSET 0 -0.06 0.13 CHANNELS 3 Zrotation Yrotation Xrotation
          End Site { OFFSET 0 0 0.07 } } } } }
  JOINT RightHip { OFFSET -0.09 0 0 CHANNELS 3 Zrotation Yrotation Xrotation
    JOINT RightKnee { OFFSET 0 -0.44 0 CHANNELS 3 Zrotation Yrotation Xrotation
      JOINT RightAnkle { OFFSET 0 -0.42 0 CHANNELS 3 Zrotation Yrotation Xrotation
        JOINT RightToe { OFFSET 0 -0.06 0.13 CHANNELS 3 Zrotation Yrotation Xrotation
          End Site { OFFSET 0 0 0.07 } } } } }
  JOINT lowerback { OFFSET 0 0.1 0 CHANNELS 3 Zrotation Yrotation Xrotation
    JOINT Chest { OFFSET 0 0.12 0 CHANNELS 3 Zrotation Yrotation Xrotation
      JOINT Chest2 { OFFSET 0 0.12 0 CHANNELS 3 Zrotation Yrotation Xrotation
        JOINT LeftCollar { OFFSET 0.03 0.12 0 CHANNELS 3 Zrotation Yrotation Xrotation
          JOINT LeftShoulder { OFFSET 0.14 0 0 CHANNELS 3 Zrotation Yrotation Xrotation
            JOINT LeftElbow { OFFSET 0.28 0 0 CHANNELS 3 Zrotation Yrotation Xrotation
              JOINT LeftWrist { OFFSET 0.25 0 0 CHANNELS 3 Zrotation Yrotation Xrotation
                End Site { OFFSET 0.1 0 0 } } } } }
        JOINT RightCollar { OFFSET -0.03 0.12 0 CHANNELS 3 Zrotation Yrotation Xrotation
          JOINT RightShoulder { OFFSET -0.14 0 0 CHANNELS 3 Zrotation Yrotation Xrotation
            JOINT RightElbow { OFFSET -0.28 0 0 CHANNELS 3 Zrotation Yrotation Xrotation
              JOINT RightWrist { OFFSET -0.25 0 0 CHANNELS 3 Zrotation Yrotation Xrotation
                End Site { OFFSET -0.1 0 0 } } } } }
        JOINT Neck { OFFSET 0 0.16 0 CHANNELS 3 Zrotation Yrotation Xrotation
          JOINT Head { OFFSET 0 0.1 0 CHANNELS 3 Zrotation Yrotation Xrotation
            End Site { OFFSET 0 0.15 0 } } } } } }
}
)";

}  // namespace

std::string rolling_gait(uint32_t seed) {
    const Walker walker(seed);
    const auto frames = size_t(walker.length_s() * kRate_hz);
    const std::vector<Vec3> path = path_of(walker, frames);
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out << kHierarchy << "MOTION\nFrames: " << frames << "\nFrame Time: " << 1.0f / kRate_hz << "\n";
    const auto joint = [&out](float z, float y, float x) { out << ' ' << z << ' ' << y << ' ' << x; };
    for (size_t i = 0; i < frames; ++i) {
        const float t = float(i) / kRate_hz;
        const float left = walker.swing(t, 0);
        out << path[i].x << ' ' << path[i].y << ' ' << path[i].z;
        joint(walker.list() * left, walker.heading(t) + walker.twist() * left, 0);
        for (const int side : {0, 1}) {
            const LegAngles leg = walker.leg(side, t);
            // The hips' own turns are none of the legs'.
            joint(-walker.list() * left, -walker.twist() * left, -leg.hip);
            joint(0, 0, leg.knee);
            joint(0, 0, -leg.ankle);
            joint(0, 0, -std::max(0.0f, leg.foot_pitch()));
        }
        joint(-walker.list() * left, -walker.twist() * left, 0);
        joint(0, -walker.twist() * left, walker.lean());
        joint(0, 0, 0);
        for (const int side : {0, 1}) {
            const float s = side == 0 ? 1.0f : -1.0f;
            joint(0, 0, 0);
            joint(-s * 75.0f, 0, s * walker.arm() * left);
            joint(0, -s * 15.0f, 0);
            joint(0, 0, 0);
        }
        joint(0, 0, -walker.lean());
        joint(0, 0, 0);
        out << '\n';
    }
    return out.str();
}

}  // namespace vfit::tools
