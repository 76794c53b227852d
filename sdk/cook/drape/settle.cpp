#include "cook/drape/settle.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "body/mesh.h"
#include "cloth/cloth.h"
#include "cloth/crossings.h"
#include "cloth/garment/clear_skin.h"

namespace vfit {

namespace {

constexpr float kSettleFrame_s = 1.0f / 60.0f;
constexpr uint32_t kFreeSubsteps = 16,
                   kHeldSubsteps = 16;  // of 1/60 s: the more, the less it stretches by its own weight

class Settler {
public:
    Settler(const WholeCloth& cloth, const CookBody& body, const DrapeSettings& settings, Jobs& jobs)
        : cloth_(cloth), body_(body), settings_(settings), jobs_(jobs) {}

    Draped run(std::vector<Vec3> places, const Hold& hold) {
        Draped out;
        const bool has_band = hold.any() && hold.worn_by;
        FabricData data = cook(places, std::vector<uint8_t>(places.size(), 1));
        hold.limit(data);
        fall(std::move(data), places, hold.targets(places), {90, 60, hold.lowered_m, kFreeSubsteps, false});
        part_layers(places);
        look("fallen", places);

        out.simulated.assign(places.size(), 1);
        if (has_band)
            for (uint32_t v = 0; v < places.size(); ++v) out.simulated[v] = !hold.of[v];
        else
            for (const uint32_t v : on_shoulders(places)) out.simulated[v] = 0;
        out.report.strain_p99 =
            fall(cook(places, out.simulated), places, places, {120, 0, 0.0f, kHeldSubsteps, true});
        part_layers(places);
        clear_skin({body_.positions(), body_.indices(), body_.skin()}, cloth_.indices, places);
        look("at rest", places);
        out.positions = std::move(places);
        out.report.self_crossings = uint32_t(crossed_triangles(out.positions, cloth_.indices).size());
        const auto crossed =
            crossed_triangles({out.positions, cloth_.indices}, {body_.positions(), body_.indices()});
        out.report.skin_crossings = uint32_t(crossed.size());
        std::array<size_t, kBodyPartCount> count{};
        for (const auto& [cloth, skin] : crossed) ++count[size_t(body_.parts()[body_.indices()[3 * skin]])];
        if (!crossed.empty())
            out.report.crossed_at =
                part_name(BodyPart(std::max_element(count.begin(), count.end()) - count.begin()));
        return out;
    }

private:
    void look(const char* stage, const std::vector<Vec3>& places) const {
        if (settings_.watch) settings_.watch(stage, places);
    }

    FabricData cook(const std::vector<Vec3>& places, const std::vector<uint8_t>& simulated) const {
        return cook_fabric({places, cloth_.indices, {}, simulated, 1.0f, cloth_.cut}, *cloth_.material);
    }

    struct Fall {
        int frames, lowering_frames;
        float lowered_m;  // of what is held, over these
        uint32_t substeps;
        bool meets_fingers;
    };
    /// With layers of its own, unless its triangles are too small for that. Returns the 99th percentile of
    /// strain.
    float fall(FabricData data, std::vector<Vec3>& places, std::vector<Vec3> targets, const Fall& how) {
        ClothSettings settings;
        settings.substeps = how.substeps * fineness();
        settings.friction = cloth_.material->friction;
        settings.self_friction = 0.0f;  // layers that hold each other would stay stretched
        settings.thickness_m = settings_.thickness_m;
        settings.self_thickness_m =
            keeps_layers_apart(cloth_, settings_.thickness_m) ? settings_.thickness_m : 0.0f;
        settings.damping = 0.95f;
        settings.limits_lengths = false;  // as while it is put on
        Cloth cloth(std::make_shared<const Fabric>(std::move(data)), settings, places);
        const uint32_t skin = cloth.add_mesh(body_.positions().size(), body_.indices(),
                                             how.meets_fingers ? std::vector<uint8_t>() : but_fingers(body_));
        // What gives way at once where it was stretched would fly.
        cloth.move_mesh(skin, body_.positions());
        cloth.come_to_lengths([&](float, std::vector<Vec3>& t, std::vector<Collider>&) { t = targets; },
                              jobs_);
        for (int frame = 0; frame < how.frames; ++frame) {
            cloth.move_mesh(skin, body_.positions());
            if (frame < how.lowering_frames)
                for (Vec3& target : targets) target.y -= how.lowered_m / float(how.lowering_frames);
            cloth.step(kSettleFrame_s, targets, {}, jobs_);
        }
        places = cloth.positions();
        return cloth.stats().strain_p99;
    }

    /// What pulls goes over a side a sub-step: of small ones it takes more of them.
    uint32_t fineness() const {
        constexpr float kSide_m = 0.016f;
        return uint32_t(std::clamp(std::lround(kSide_m / mean_side(cloth_)), 1L, 4L));
    }

    /// Where layers went through each other while they were sewn, as two legs do below the crotch: they meet
    /// with their outsides, so each goes inwards, back to its own limb. Taken back where that parts none.
    void part_layers(std::vector<Vec3>& places) const {
        constexpr int kRounds = 40;
        constexpr float kStep_m = 0.0005f;
        const std::vector<Vec3> before = places;
        std::vector<Vec3> normals;
        compute_normals(places, cloth_.indices, normals);
        double outwards = 0.0;  // seams may have left it inside out
        for (size_t v = 0; v < places.size(); v += 8)
            outwards += double(glm::dot(normals[v], places[v] - body_.skin().closest(places[v]).point));
        const float step_m = outwards < 0.0 ? kStep_m : -kStep_m;
        const size_t first = crossed_triangles(places, cloth_.indices).size();
        size_t left = first;
        for (int round = 0; round < kRounds && left > 0; ++round) {
            std::set<uint32_t> moved;
            for (const auto& [a, b] : crossed_triangles(places, cloth_.indices))
                for (const uint32_t triangle : {a, b})
                    for (size_t k = 0; k < 3; ++k) moved.insert(cloth_.indices[3 * triangle + k]);
            compute_normals(places, cloth_.indices, normals);
            for (const uint32_t v : moved) places[v] += normals[v] * step_m;
            left = crossed_triangles(places, cloth_.indices).size();
        }
        if (left >= first) places = before;
    }

    /// What carries a garment: on each side, the cloth that touches the shoulder, and where that is little,
    /// as below a wide collar, what is closest to it.
    std::vector<uint32_t> on_shoulders(const std::vector<Vec3>& places) const {
        constexpr float kTouches_m = 0.006f, kMost_m = 0.05f, kShare = 0.33f;
        constexpr size_t kFewest = 4;
        std::vector<uint32_t> out;
        for (const float side : {1.0f, -1.0f}) {
            std::vector<std::pair<float, uint32_t>> above;  // with the distance from the skin
            for (uint32_t v = 0; v < places.size(); ++v)
                if (const float off = above_shoulder(places[v] * Vec3(side, 1.0f, 1.0f), side); off < kMost_m)
                    above.emplace_back(off, v);
            std::sort(above.begin(), above.end());
            for (size_t i = 0; i < above.size(); ++i)
                if (above[i].first < settings_.thickness_m + kTouches_m ||
                    float(i) < kShare * float(above.size()) || i < kFewest)
                    out.push_back(above[i].second);
        }
        return out;
    }

    /// How far it is from a shoulder below it; INFINITY where there is none.
    float above_shoulder(const Vec3& place, float side) const {
        constexpr float kUpwards = 0.75f, kNeck_m = 0.03f, kBelowJoint_m = 0.02f;
        const Vec3 joint = body_.outline().left_shoulder();
        if (place.x < kNeck_m || place.x > joint.x || place.y < joint.y - kBelowJoint_m) return INFINITY;
        const MeshQuery::Closest skin = body_.skin().closest(place * Vec3(side, 1.0f, 1.0f));
        return skin.normal.y > kUpwards ? skin.distance : INFINITY;
    }

    const WholeCloth& cloth_;
    const CookBody& body_;
    const DrapeSettings& settings_;
    Jobs& jobs_;
};

}  // namespace

std::vector<uint8_t> but_fingers(const CookBody& body) {
    constexpr float kWrist_m = 0.03f;  // so far a hand is no wider than a cuff
    std::vector<uint8_t> counts(body.positions().size(), 1);
    const auto middle_of = [&](BodyPart part) {
        Vec3 sum(0.0f);
        float count = 0.0f;
        for (size_t v = 0; v < counts.size(); ++v)
            if (body.parts()[v] == part) sum += body.positions()[v], count += 1.0f;
        return sum / std::max(count, 1.0f);
    };
    for (const auto& [forearm, hand] : {std::pair(BodyPart::kLeftForearm, BodyPart::kLeftHand),
                                        std::pair(BodyPart::kRightForearm, BodyPart::kRightHand)}) {
        const Vec3 along = glm::normalize(middle_of(hand) - middle_of(forearm));
        float wrist = INFINITY;
        for (size_t v = 0; v < counts.size(); ++v)
            if (body.parts()[v] == hand) wrist = std::min(wrist, glm::dot(body.positions()[v], along));
        for (size_t v = 0; v < counts.size(); ++v)
            if (body.parts()[v] == hand && glm::dot(body.positions()[v], along) > wrist + kWrist_m)
                counts[v] = 0;
    }
    return counts;
}

float mean_side(const WholeCloth& cloth) {
    double sum = 0.0;
    for (size_t i = 0; i < cloth.cut.size(); ++i)
        sum += double(glm::length(cloth.cut[i - i % 3 + (i + 1) % 3] - cloth.cut[i]));
    return float(sum / double(std::max<size_t>(cloth.cut.size(), 1)));
}

bool keeps_layers_apart(const WholeCloth& cloth, float thickness_m) {
    // A skirt gathered to a belt goes through itself in 0 places with triangles of 16 mm, in 100 with 12 mm
    // and in 1800 with 8 mm, there without contact in none.
    constexpr float kLeastSide = 3.5f;  // in thicknesses
    return mean_side(cloth) >= kLeastSide * thickness_m;
}

bool Hold::any() const { return std::find(of.begin(), of.end(), 1) != of.end(); }

void Hold::limit(FabricData& data) const {
    if (!any()) return;
    std::vector<float> inverse_mass = data.inverse_mass;
    for (uint32_t v = 0; v < of.size(); ++v)
        if (of[v]) data.limits.push_back({v, slack_m}), inverse_mass[v] = 0.0f;
    for (const Tether& t : cook_tethers(inverse_mass, data.edges))
        data.limits.push_back({t.vertex, t.length_m + slack_m, t.anchor});
}

std::vector<Vec3> Hold::targets(const std::vector<Vec3>& places) const { return at.empty() ? places : at; }

Draped settle(const WholeCloth& cloth, std::vector<Vec3> places, const Hold& hold, const CookBody& body,
              const DrapeSettings& settings, Jobs& jobs) {
    return Settler(cloth, body, settings, jobs).run(std::move(places), hold);
}

}  // namespace vfit
