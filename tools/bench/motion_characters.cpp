// Characters of other proportions and other rigs, moved by one person: is the skin where the body's own rig
// puts it, do planted feet stand, do hands stay outside.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>

#include "avatar/avatar.h"
#include "avatar/character.h"
#include "avatar/gltf_document.h"
#include "bench/bench.h"
#include "bench/motion_parts.h"
#include "bench/motion_people.h"
#include "core/clock.h"
#include "export/character.h"
#include "geometry/mesh_query.h"
#include "motion/motion.h"

namespace vfit::tools {

namespace {

constexpr size_t kWarmUp = 15;

struct Figure {
    const char* name;
    vfit_sex sex;
    float height, weight, proportions;
};
constexpr Figure kFigures[] = {{"small", VFIT_SEX_FEMALE, 0.15f, 0.4f, 0.2f},
                               {"heavy", VFIT_SEX_MALE, 0.5f, 1.1f, 0.5f},
                               {"tall", VFIT_SEX_MALE, 0.95f, 0.35f, 0.9f}};
constexpr const char* kMotions[] = {"demo", "walk", "step", "jump"};

std::vector<vfit_shape_value> shape_of(const Figure& figure) {
    std::vector<vfit_shape_value> shape;
    const auto add = [&](const char* key, float value) {
        vfit_shape_value v = vfit_shape_value_init();
        std::snprintf(v.key, sizeof v.key, "%s", key);
        v.value = value;
        shape.push_back(v);
    };
    add("height", figure.height);
    add("weight", figure.weight);
    add("proportions", figure.proportions);
    return shape;
}

double quantile(std::vector<double> v, double q) {
    if (v.empty()) return NAN;
    std::sort(v.begin(), v.end());
    return v[size_t(q * double(v.size() - 1))];
}

/// How deep the hands are in trunk and thighs, at most.
double hand_depth_m(const std::vector<Vec3>& positions, const BodyTopology& topology) {
    const auto is_hand = [&](uint32_t v) {
        return topology.parts[v] == BodyPart::kLeftHand || topology.parts[v] == BodyPart::kRightHand;
    };
    const auto is_middle = [&](uint32_t v) {
        const BodyPart p = topology.parts[v];
        return p == BodyPart::kTorso || p == BodyPart::kLeftThigh || p == BodyPart::kRightThigh;
    };
    std::vector<uint32_t> middle;
    for (size_t t = 0; t + 2 < topology.indices.size(); t += 3)
        if (is_middle(topology.indices[t]) && is_middle(topology.indices[t + 1]) &&
            is_middle(topology.indices[t + 2]))
            middle.insert(middle.end(), topology.indices.begin() + std::ptrdiff_t(t),
                          topology.indices.begin() + std::ptrdiff_t(t) + 3);
    const MeshQuery query(positions, middle);
    double deepest = 0.0;
    for (uint32_t v = 0; v < positions.size(); v += 3) {
        if (!is_hand(v)) continue;
        const MeshQuery::Closest near = query.closest(positions[v]);
        // Behind the skin, as its triangle sees it; the shoulders' openings are far from hands.
        if (near.distance < 0.15f && glm::dot(positions[v] - near.point, near.normal) < 0.0f)
            deepest = std::max(deepest, double(near.distance));
    }
    return deepest;
}

struct Tally {
    std::vector<double> apart_m, steps_m, hands_m, hands_as_posed_m;
};

/// One person's motion on one character, beside the body that it was made of.
void play(const PersonStream& stream, vfit::Avatar& character, vfit::Avatar& free_hands, vfit::Avatar& own,
          Tally& tally) {
    vfit::Motion motion{MotionSettings()};
    motion.bind(character.skeleton());
    const auto jobs = Jobs::own(0);
    std::array<Vec3, 2> before{};
    uint32_t contacts_before = 0;
    size_t i = 0;
    for (const PersonFrame& frame : stream.frames) {
        Body body = frame.tracked;
        body.id = 1;
        if (!motion.step(&body, body.time_ns) || ++i < kWarmUp) continue;
        character.pose(motion.pose(), *jobs);
        for (size_t side = 0; side < 2; ++side) {
            const Vec3 ankle =
                character.joints().at(side == 0 ? VFIT_JOINT_LEFT_FOOT : VFIT_JOINT_RIGHT_FOOT);
            const uint32_t contact = side == 0 ? VFIT_CONTACT_LEFT : VFIT_CONTACT_RIGHT;
            if (motion.pose().contacts & contacts_before & contact)
                tally.steps_m.push_back(double(glm::distance(ankle, before[side])));
            before[side] = ankle;
        }
        contacts_before = motion.pose().contacts;
        if (i % 5 != 0) continue;
        free_hands.pose(motion.pose(), *jobs);
        tally.hands_m.push_back(hand_depth_m(character.positions(), character.topology()));
        tally.hands_as_posed_m.push_back(hand_depth_m(free_hands.positions(), free_hands.topology()));
        own.pose(motion.pose(), *jobs);
        const Vec3 shift = own.joints().at(VFIT_JOINT_PELVIS) - free_hands.joints().at(VFIT_JOINT_PELVIS);
        for (size_t v = 0; v < own.positions().size(); v += 7)
            tally.apart_m.push_back(
                double(glm::distance(own.positions()[v], free_hands.positions()[v] + shift)));
    }
}

std::vector<float> own_shape(const BodyModel& model, const Figure& figure) {
    std::vector<float> shape = model.default_shape(figure.sex);
    for (const vfit_shape_value& v : shape_of(figure)) shape[size_t(model.parameter(v.key))] = v.value;
    return shape;
}

}  // namespace

Json judge_characters(const MotionJudge& judge) {
    const auto model = BodyModel::load(library_file("vfit_data/body.bin"));
    const Context context = open_context();
    std::vector<PersonStream> streams;
    for (const char* motion : kMotions)
        streams.push_back(
            {motion,
             person_on_feet(std::string("virtual:sensor=kinect_v1_320&frames=120&motion=") + motion)});
    if (!judge.quiet)
        std::cout << "\nCharacters, moved by one tracked person: skin apart from that of vfit's own rig, "
                     "planted feet, hands\n"
                  << "  figure  rig       apart mean, p99 mm   planted p95 mm/frame   hands deepest p95, as "
                     "posed mm\n";
    Json out = Json::array();
    double worst_planted = 0.0, worst_hands = 0.0;
    const auto folder =
        std::filesystem::temp_directory_path() / ("vfit_characters_" + std::to_string(vfit::now_ns()));
    std::filesystem::create_directories(folder);
    for (const Figure& figure : kFigures)
        for (const std::string& rig : rig_style_names()) {
            const std::string path = (folder / (rig + ".glb")).string();
            vfit_avatar_desc desc = vfit_avatar_desc_init();
            desc.sex = figure.sex;
            export_character(context.get(), desc, shape_of(figure), rig_style_from(rig), path);
            AvatarDesc settings;
            settings.limbs_clear = true;
            vfit::Avatar character(load_character(GltfDocument(path), "").source, settings);
            vfit::Avatar free_hands(load_character(GltfDocument(path), "").source, AvatarDesc());
            AvatarDesc body;
            body.sex = figure.sex;
            vfit::Avatar own(model, body, own_shape(*model, figure), Vec2(1.0f));
            Tally tally;
            for (const PersonStream& stream : streams) play(stream, character, free_hands, own, tally);
            double mean = 0.0;
            for (const double d : tally.apart_m) mean += d / double(tally.apart_m.size());
            const double p99 = quantile(tally.apart_m, 0.99), planted = quantile(tally.steps_m, 0.95);
            const double hands = quantile(tally.hands_m, 0.95),
                         as_posed = quantile(tally.hands_as_posed_m, 0.95);
            worst_planted = std::max(worst_planted, planted);
            worst_hands = std::max(worst_hands, hands);
            if (!judge.quiet)
                std::cout << "  " << std::left << std::setw(8) << figure.name << std::setw(10) << rig
                          << std::right << std::fixed << std::setprecision(1) << std::setw(10) << 1e3 * mean
                          << std::setw(8) << 1e3 * p99 << std::setw(20) << 1e3 * planted << std::setw(22)
                          << 1e3 * hands << std::setw(10) << 1e3 * as_posed << "\n";
            out.push_back({{"figure", figure.name},
                           {"rig", rig},
                           {"apart_mean_m", mean},
                           {"apart_p99_m", p99},
                           {"planted_p95_m", planted},
                           {"hands_p95_m", hands},
                           {"hands_as_posed_p95_m", as_posed}});
        }
    std::filesystem::remove_all(folder);
    judge.targets.judge("planted feet of characters, 95 of 100 frames", 1e3 * worst_planted, Aim::at_most,
                        3.0, 2, " mm");
    judge.targets.judge("hands in trunk or thighs, 95 of 100 frames", 1e3 * worst_hands, Aim::at_most, 10.0,
                        1, " mm");
    return out;
}

}  // namespace vfit::tools
