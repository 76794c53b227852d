#include "cook/worn.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "geometry/section.h"

namespace vfit {

namespace {

constexpr size_t kDirections = 72;
constexpr float kMet = 0.75f;  // share of the directions; a coat that stands open leaves a quarter
constexpr float kLimb_m = 0.35f;

/// Of the directions about `centre` in the plane square to `along`, the share in which cloth is met within
/// reach_m.
float share_met(std::span<const Vec3> places, std::span<const uint32_t> indices, const Vec3& centre,
                const Vec3& along, float reach_m) {
    const Vec3 side = std::abs(along.x) < 0.8f ? Vec3(1, 0, 0) : Vec3(0, 0, 1);
    const Vec3 a = glm::normalize(glm::cross(along, side)), b = glm::cross(along, a);
    std::vector<uint8_t> met(kDirections, 0);
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        Vec2 cut[2];
        int ends = 0;
        for (size_t k = 0; k < 3 && ends < 2; ++k) {
            const Vec3 p = places[indices[i + k]] - centre, q = places[indices[i + (k + 1) % 3]] - centre;
            const float p_off = glm::dot(p, along), q_off = glm::dot(q, along);
            if ((p_off < 0.0f) == (q_off < 0.0f)) continue;
            const Vec3 at = glm::mix(p, q, p_off / (p_off - q_off));
            cut[ends++] = {glm::dot(at, a), glm::dot(at, b)};
        }
        if (ends < 2 || glm::length(cut[0]) > reach_m || glm::length(cut[1]) > reach_m) continue;
        const auto direction = [](const Vec2& p) {
            return std::atan2(p.y, p.x) / (2.0f * kPi) * float(kDirections) + float(kDirections);
        };
        float from = direction(cut[0]), to = direction(cut[1]);
        if (from > to) std::swap(from, to);
        if (to - from > 0.5f * float(kDirections)) std::swap(from, to), to += float(kDirections);
        for (auto d = size_t(std::ceil(from)); float(d) <= to; ++d) met[d % kDirections] = 1;
        met[size_t(std::lround(from)) % kDirections] = 1;
    }
    return float(std::count(met.begin(), met.end(), 1)) / float(kDirections);
}

}  // namespace

std::vector<std::string> goes_round(std::span<const Vec3> places, std::span<const uint32_t> indices,
                                    const CookBody& body) {
    std::vector<std::string> out;
    const TailorLevels& levels = body.outline().levels();
    const Vec3 up(0, 1, 0);
    const auto add = [&](const char* name, const Vec3& centre, const Vec3& along, float reach_m,
                         float low_m = -0.03f, float high_m = 0.0f) {
        constexpr float kStep_m = 0.015f;
        for (float off_m = high_m; off_m > low_m - 0.5f * kStep_m; off_m -= kStep_m)
            if (share_met(places, indices, centre + off_m * along, along, reach_m) >= kMet) {
                out.push_back(name);
                return;
            }
    };
    constexpr float kFar_m = 2.0f, kNeck_m = 0.25f;
    add("neck", body.joint(VFIT_BONE_NECK), up, kNeck_m);
    // Somewhere along each: a bra's band lies below the bust, hip trousers end below the waist, and a
    // waistband's edge lies at the waist or a little below.
    const float axis_z = body.outline().axis_z();
    constexpr float kBelowBust_m = 0.1f, kBelowHips_m = 0.03f;
    add("chest", {0.0f, levels.bust, axis_z}, up, kFar_m, -kBelowBust_m);
    add("waist", {0.0f, levels.waist, axis_z}, up, kFar_m);
    add("hips", {0.0f, levels.hip, axis_z}, up, kFar_m, -kBelowHips_m, 0.5f * (levels.waist - levels.hip));
    for (const auto& [name, from, to] :
         {std::tuple("left leg", VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_LEFT_LOWER_LEG),
          std::tuple("right leg", VFIT_BONE_RIGHT_UPPER_LEG, VFIT_BONE_RIGHT_LOWER_LEG),
          std::tuple("left arm", VFIT_BONE_LEFT_UPPER_ARM, VFIT_BONE_LEFT_LOWER_ARM),
          std::tuple("right arm", VFIT_BONE_RIGHT_UPPER_ARM, VFIT_BONE_RIGHT_LOWER_ARM)}) {
        const Vec3 root = body.joint(from), end = body.joint(to);
        add(name, glm::mix(root, end, 0.5f), glm::normalize(end - root), kLimb_m);
    }
    return out;
}

void check_worn(const std::vector<std::string>& round, const std::string& kind) {
    const auto has = [&](const char* name) {
        return std::find(round.begin(), round.end(), name) != round.end();
    };
    if (round.empty())
        fail(VFIT_ERROR_DATA,
             "the garment goes round nothing: where it came to rest it is about neither neck, chest, waist, "
             "hips, an arm nor a leg");
    const auto needs = [&](std::initializer_list<const char*> names) {
        for (const char* name : names)
            if (!has(name))
                fail(VFIT_ERROR_DATA, "the garment does not go round the ", name, ", as its kind (", kind,
                     ") does: where it came to rest it goes round ", listed(round));
    };
    if (kind == "trousers" || kind == "overall") needs({"left leg", "right leg"});
    if (kind == "skirt") needs({"hips"});
    if (kind == "short_sleeves" || kind == "long_sleeves" || kind == "shirt" || kind == "jacket" ||
        kind == "vest" || kind == "overall")
        needs({"chest"});
    if (kind == "dress") needs({"waist", "hips"});
}

std::string listed(const std::vector<std::string>& words) {
    std::string out;
    for (size_t i = 0; i < words.size(); ++i)
        out += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
    return out;
}

}  // namespace vfit
