#include "bench/track_score.h"

#include <algorithm>
#include <cmath>

namespace vfit::tools {

namespace {

using Vec = std::array<double, 3>;

Vec minus(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec cross(const Vec& a, const Vec& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vec unit(const Vec& a) {
    const double n = std::sqrt(dot(a, a));
    return {a[0] / n, a[1] / n, a[2] / n};
}

/// Across the shoulders, up the trunk, and ahead: the body's own axes.
std::array<Vec, 3> axes_of(const Joints& joints) {
    const auto& at = joints.at;
    const Vec across = unit(minus(at[VFIT_JOINT_LEFT_SHOULDER], at[VFIT_JOINT_RIGHT_SHOULDER]));
    Vec hips;
    for (size_t k = 0; k < 3; ++k) hips[k] = 0.5 * (at[VFIT_JOINT_LEFT_HIP][k] + at[VFIT_JOINT_RIGHT_HIP][k]);
    Vec up = minus(at[VFIT_JOINT_NECK], hips);
    const double along = dot(up, across);
    for (size_t k = 0; k < 3; ++k) up[k] -= along * across[k];
    up = unit(up);
    return {across, up, cross(across, up)};
}

double median_of(std::vector<double> v) {
    if (v.empty()) return std::numeric_limits<double>::quiet_NaN();
    std::nth_element(v.begin(), v.begin() + long(v.size() / 2), v.end());
    return v[v.size() / 2];
}

}  // namespace

Joints joints_in_camera(vfit_frame frame, uint32_t body_id, const vfit_camera& camera) {
    Joints out;
    for (const vfit_joint& j : joints_of(frame, body_id)) {
        if (j.joint >= kScored) continue;
        const Point p = to_camera(camera, j.position);
        out.at[size_t(j.joint)] = {p.x, p.y, p.z};
    }
    return out;
}

double distance(const Joints& a, const Joints& b, int joint) {
    const Vec d = minus(a.at[size_t(joint)], b.at[size_t(joint)]);
    return std::sqrt(dot(d, d));
}

Joints with_sides_exchanged(const Joints& joints) {
    Joints out = joints;
    for (int left = VFIT_JOINT_LEFT_SHOULDER; left < kScored; left += 2)
        std::swap(out.at[size_t(left)], out.at[size_t(left + 1)]);
    return out;
}

bool sides_are_exchanged(const Joints& tracked, const Joints& reference) {
    const auto sum = [&](const Joints& joints) {
        double total = 0.0;
        for (int j = VFIT_JOINT_LEFT_SHOULDER; j < kScored; ++j)
            if (const double d = distance(joints, reference, j); std::isfinite(d)) total += d;
        return total;
    };
    return sum(with_sides_exchanged(tracked)) < sum(tracked);
}

double turned_away_rad(const Joints& joints) {
    // The person's left is on the image's right while they face the camera.
    const Vec left = minus(joints.at[VFIT_JOINT_LEFT_HIP], joints.at[VFIT_JOINT_RIGHT_HIP]);
    return std::acos(std::clamp(left[0] / std::hypot(left[0], left[2]), -1.0, 1.0));
}

void Errors::add_all(const Joints* tracked, const Joints& reference) {
    for (int j = 0; j < kScored; ++j) {
        if (!reference.has(j)) continue;
        if (tracked && tracked->has(j))
            add(j, distance(*tracked, reference, j));
        else
            add_missing(j);
    }
}

void Errors::merge(const Errors& other) {
    for (size_t j = 0; j < kScored; ++j) {
        values_[j].insert(values_[j].end(), other.values_[j].begin(), other.values_[j].end());
        missing_[j] += other.missing_[j];
    }
}

size_t Errors::missing(int joint) const {
    if (joint >= 0) return missing_[size_t(joint)];
    size_t sum = 0;
    for (const size_t n : missing_) sum += n;
    return sum;
}

Offsets Offsets::fit(const std::vector<Pair>& pairs) {
    std::array<std::array<std::vector<double>, 3>, kScored> found;
    for (const Pair& pair : pairs) {
        if (!pair.usable) continue;
        const auto axes = axes_of(pair.tracked);
        for (size_t j = 0; j < kScored; ++j) {
            const Vec d = minus(pair.reference.at[j], pair.tracked.at[j]);
            for (size_t k = 0; k < 3; ++k)
                if (const double x = dot(d, axes[k]); std::isfinite(x)) found[j][k].push_back(x);
        }
    }
    Offsets out;
    for (size_t j = 0; j < kScored; ++j)
        for (size_t k = 0; k < 3; ++k)
            out.by_joint_[j][k] = found[j][k].empty() ? 0.0 : median_of(found[j][k]);
    return out;
}

Joints Offsets::apply(const Joints& tracked) const {
    Joints out = tracked;
    const auto axes = axes_of(tracked);
    for (size_t j = 0; j < kScored; ++j)
        for (size_t k = 0; k < 3; ++k)
            for (size_t a = 0; a < 3; ++a) out.at[j][k] += by_joint_[j][a] * axes[a][k];
    return out;
}

std::vector<double> Errors::values(int joint) const {
    if (joint >= 0) return values_[size_t(joint)];
    std::vector<double> all;
    for (const auto& v : values_) all.insert(all.end(), v.begin(), v.end());
    return all;
}

size_t Errors::count() const { return values(-1).size(); }
double Errors::median(int joint) const { return median_of(values(joint)); }

double Errors::mean(int joint) const {
    const auto v = values(joint);
    double sum = 0.0;
    for (const double x : v) sum += x;
    return v.empty() ? std::numeric_limits<double>::quiet_NaN() : sum / double(v.size());
}

double Errors::within(double metres, int joint) const {
    const auto v = values(joint);
    const auto near = std::count_if(v.begin(), v.end(), [&](double x) { return x <= metres; });
    const size_t all = v.size() + missing(joint);
    return all == 0 ? 0.0 : double(near) / double(all);
}

Json Errors::json() const {
    const auto one = [&](int j) {
        return Json{{"median_m", median(j)},
                    {"mean_m", mean(j)},
                    {"within_10cm", within(0.1, j)},
                    {"n", values(j).size()},
                    {"missing", missing(j)}};
    };
    Json out = one(-1);
    for (int j = 0; j < kScored; ++j)
        if (!values_[size_t(j)].empty() || missing(j)) out["joints"][joint_name(j)] = one(j);
    return out;
}

}  // namespace vfit::tools
