#include "foot_plant.h"

#include <algorithm>
#include <cmath>

#include "steps.h"

namespace vfit::virtual_person {

namespace {

// A standing foot is slower than a slow walk's swing by ten, and stays within the roll of the foot of the
// floor.
constexpr float kStill_m_s = 0.20f, kLow_m = 0.04f;
constexpr float kRolls_m_s = 0.35f;  // the ankle over a heel that stands, the joint over a ball that does
constexpr double kShortestContact_s = 0.10, kShortestGap_s = 0.05;
constexpr double kFade_s = 0.20;

struct Span {
    size_t begin, end;  // frames, end excluded
};

std::vector<Span> spans_of(const std::vector<char>& flags) {
    std::vector<Span> spans;
    for (size_t i = 0; i < flags.size(); ++i) {
        if (!flags[i]) continue;
        if (i == 0 || !flags[i - 1]) spans.push_back({i, i});
        spans.back().end = i + 1;
    }
    return spans;
}

float low_height(const std::vector<Vec3>& points) {
    std::vector<float> heights;
    for (const Vec3& p : points) heights.push_back(p.y);
    const auto tenth = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 10);
    std::nth_element(heights.begin(), tenth, heights.end());
    return *tenth;
}

float speed(const std::vector<Vec3>& points, size_t i, double frame_time_s) {
    const size_t reach = std::max<size_t>(1, static_cast<size_t>(0.02 / frame_time_s));
    const size_t a = i > reach ? i - reach : 0, b = std::min(points.size() - 1, i + reach);
    return b == a ? 0.0f
                  : glm::length(points[b] - points[a]) / static_cast<float>(double(b - a) * frame_time_s);
}

float yaw_of(const Quat& q) {
    const Vec3 forward = q * Vec3(0, 0, 1);
    return std::atan2(forward.x, forward.z);
}

struct Correction {
    Vec3 move;
    Quat turn;
};

}  // namespace

void find_contacts(FootTrack& foot, double frame_time_s) {
    const size_t n = foot.ankle.size();
    const float ankle_low = low_height(foot.ankle), ball_low = low_height(foot.ball);
    foot.planted.assign(n, 0);
    for (size_t i = 0; i < n; ++i)
        foot.planted[i] = speed(foot.ankle, i, frame_time_s) < kStill_m_s &&
                          speed(foot.ball, i, frame_time_s) < kStill_m_s &&
                          foot.ankle[i].y < ankle_low + kLow_m && foot.ball[i].y < ball_low + kLow_m;
    foot.rolls.assign(n, 0);
    for (size_t i = 0; i < n; ++i)
        foot.rolls[i] =
            (speed(foot.ankle, i, frame_time_s) < kRolls_m_s && foot.ankle[i].y < ankle_low + kLow_m) ||
            (speed(foot.ball, i, frame_time_s) < kRolls_m_s && foot.ball[i].y < ball_low + kLow_m);
    const std::vector<Span> found = spans_of(foot.planted);
    for (size_t k = 1; k < found.size(); ++k)
        if (double(found[k].begin - found[k - 1].end) * frame_time_s < kShortestGap_s)
            std::fill(foot.planted.begin() + std::ptrdiff_t(found[k - 1].end),
                      foot.planted.begin() + std::ptrdiff_t(found[k].begin), char{1});
    for (const Span& s : spans_of(foot.planted))
        if (double(s.end - s.begin) * frame_time_s < kShortestContact_s)
            std::fill(foot.planted.begin() + std::ptrdiff_t(s.begin),
                      foot.planted.begin() + std::ptrdiff_t(s.end), char{0});
    for (size_t i = 0; i < n; ++i) foot.rolls[i] = foot.rolls[i] && !foot.planted[i];
}

void plant(FootTrack& foot, double frame_time_s, float ankle_height_m) {
    const size_t n = foot.ankle.size();
    const std::vector<Span> contacts = spans_of(foot.planted);
    const std::vector<Vec3> raw_ankle = foot.ankle;
    const std::vector<Quat> raw_rotation = foot.rotation;

    std::vector<Correction> first, last;  // at the ends of each contact
    for (const Span& s : contacts) {
        Vec3 place(0.0f);
        Vec2 direction(0.0f);
        for (size_t i = s.begin; i < s.end; ++i) {
            place += raw_ankle[i];
            const float yaw = yaw_of(raw_rotation[i]);
            direction += Vec2(std::sin(yaw), std::cos(yaw));
        }
        place /= static_cast<float>(s.end - s.begin);
        place.y = ankle_height_m;
        const Quat flat = glm::angleAxis(std::atan2(direction.x, direction.y), Vec3(0, 1, 0));
        for (size_t i = s.begin; i < s.end; ++i) foot.ankle[i] = place, foot.rotation[i] = flat;
        first.push_back({place - raw_ankle[s.begin], flat * glm::conjugate(raw_rotation[s.begin])});
        last.push_back({place - raw_ankle[s.end - 1], flat * glm::conjugate(raw_rotation[s.end - 1])});
    }

    const auto apply = [&](size_t i, const Correction& c, float weight) {
        foot.ankle[i] += c.move * weight;
        const Quat turn = c.turn.w < 0.0f ? -c.turn : c.turn;
        foot.rotation[i] = glm::slerp(kNoRotation, turn, weight) * foot.rotation[i];
    };
    const auto fade_frames = static_cast<float>(kFade_s / frame_time_s);
    for (size_t k = 0; k <= contacts.size(); ++k) {  // the gap before contact k
        const size_t begin = k == 0 ? 0 : contacts[k - 1].end;
        const size_t end = k == contacts.size() ? n : contacts[k].begin;
        const float fade = std::min(fade_frames, static_cast<float>(end - begin + 1));
        for (size_t i = begin; i < end; ++i) {
            if (k > 0) apply(i, last[k - 1], 1.0f - ease(static_cast<float>(i - begin + 1) / fade));
            if (k < contacts.size()) apply(i, first[k], 1.0f - ease(static_cast<float>(end - i) / fade));
        }
    }
}

}  // namespace vfit::virtual_person
