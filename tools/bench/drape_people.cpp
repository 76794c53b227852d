// Garments on people who walk: on their skin, a whole frame, a crowd.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <set>

#include "bench/bench.h"
#include "bench/drape_parts.h"
#include "client/client.h"
#include "geometry/mesh_query.h"

namespace vfit::tools {

namespace {

constexpr float kFrame_s = 1.0f / 60.0f, kThickness_m = 0.004f, kDeep_m = 0.002f, kCover_m = 0.01f;

/// Poses of a person who walks, one a tracked frame.
struct Walk {
    std::vector<vfit_pose> poses;
    std::vector<std::vector<vfit_bone>> bones;
};

/// take(tracked frame, body) for each frame of a virtual person who walks.
template <typename Take>
void watch_walk(vfit_context context, const Take& take) {
    Source source(context, "virtual:sensor=kinect_v1_320&sex=f&motion=walk&frames=150");
    Tracker tracker;
    check(vfit_tracker_create(context, nullptr, tracker.out()));
    while (const auto frame = source.next()) {
        Frame tracked;
        check(vfit_tracker_update(tracker.get(), frame->get(), tracked.out()));
        if (const uint32_t body = first_body(tracked.get())) take(tracked.get(), body);
    }
}
int64_t time_of(vfit_frame frame) { return view_of(frame, VFIT_STREAM_DEPTH).time_ns; }

Walk walk(vfit_context context) {
    Motion motion;
    check(vfit_motion_create(context, nullptr, motion.out()));
    Walk out;
    watch_walk(context, [&](vfit_frame tracked, uint32_t body) {
        check(vfit_motion_step(motion.get(), tracked, body, time_of(tracked)));
        vfit_pose pose = vfit_pose_init();
        out.bones.push_back(bones_of(motion.get(), pose));
        out.poses.push_back(pose);
    });
    if (out.poses.empty()) throw Failure("the walk shows no person");
    return out;
}

struct Dressed {
    Avatar avatar;
    Cloth cloth;
};
Dressed dress(vfit_context context, vfit_garment garment, uint32_t detail, uint32_t flags) {
    Dressed d;
    vfit_avatar_desc desc = vfit_avatar_desc_init();
    desc.sex = VFIT_SEX_FEMALE;
    desc.detail = detail;
    check(vfit_avatar_create_from_shape(context, &desc, nullptr, 0, 0, d.avatar.out()));
    vfit_cloth_desc cloth = vfit_cloth_desc_init();
    cloth.thickness_m = kThickness_m;
    cloth.flags = flags | VFIT_CLOTH_AWAKE;
    check(vfit_cloth_create(d.avatar.get(), garment, &cloth, d.cloth.out()));
    return d;
}

/// Of the body that the cloth is on.
uint32_t collider_count(vfit_cloth cloth) {
    check(vfit_cloth_step(cloth, kFrame_s));
    vfit_cloth_stats stats = vfit_cloth_stats_init();
    check(vfit_cloth_describe(cloth, &stats));
    return stats.collider_count;
}

std::vector<Vec3> positions_of(vfit_frame frame) { return items_of<Vec3>(frame, VFIT_STREAM_POSITION); }

/// The corners of all triangles of which one touches the skin, in millimetres beyond the thickness; without
/// those that are carried by bones, which are the same in the other cloth.
std::vector<float> gaps_where_it_rests(vfit_avatar avatar, vfit_cloth cloth, std::span<const Vec3> other) {
    Frame body, garment;
    check(vfit_avatar_acquire(avatar, body.out()));
    check(vfit_cloth_acquire(cloth, garment.out()));
    const MeshQuery skin(positions_of(body.get()), items_of<uint32_t>(body.get(), VFIT_STREAM_INDEX));
    const std::vector<Vec3> places = positions_of(garment.get());
    const auto pressure = items_of<float>(garment.get(), VFIT_STREAM_PRESSURE);
    const auto indices = items_of<uint32_t>(garment.get(), VFIT_STREAM_INDEX);
    std::set<uint32_t> rests;
    for (size_t i = 0; i + 2 < indices.size(); i += 3)
        if (pressure[indices[i]] > 0.0f || pressure[indices[i + 1]] > 0.0f || pressure[indices[i + 2]] > 0.0f)
            rests.insert({indices[i], indices[i + 1], indices[i + 2]});
    std::vector<float> gaps;
    for (const uint32_t v : rests)
        if (places[v] != other[v]) gaps.push_back(1e3f * (skin.signed_distance(places[v]) - kThickness_m));
    return gaps;
}

}  // namespace

Json judge_skin(const DrapeJudge& judge) {
    pin_to_cores(1);
    const vfit::tools::Context context = open_context();
    Garment garment;
    check(vfit_garment_open(context.get(), "sundress", garment.out()));
    const Walk steps = walk(context.get());
    // One avatar in three dresses, so that what its skin carries in all of them is known and left out.
    Dressed capsules = dress(context.get(), garment.get(), 0, 0);
    vfit_cloth_desc desc = vfit_cloth_desc_init();
    desc.thickness_m = kThickness_m;
    desc.flags = VFIT_CLOTH_SKIN | VFIT_CLOTH_AWAKE | VFIT_CLOTH_PRESSURE;
    Cloth on_skin, on_more;
    check(vfit_cloth_create(capsules.avatar.get(), garment.get(), &desc, on_skin.out()));
    desc.flags = VFIT_CLOTH_AWAKE;
    desc.cover_m = kCover_m;
    check(vfit_cloth_create(capsules.avatar.get(), garment.get(), &desc, on_more.out()));
    enum { kCapsules, kSkin, kMore, kKinds };
    const vfit_cloth cloths[kKinds] = {capsules.cloth.get(), on_skin.get(), on_more.get()};
    const auto places = [](vfit_cloth cloth) {
        Frame frame;
        check(vfit_cloth_acquire(cloth, frame.out()));
        return positions_of(frame.get());
    };
    const auto gaps_now = [&](int kind) {
        Frame posed;
        check(vfit_avatar_acquire(capsules.avatar.get(), posed.out()));
        const MeshQuery query(positions_of(posed.get()), items_of<uint32_t>(posed.get(), VFIT_STREAM_INDEX));
        const std::vector<Vec3> other = places(cloths[kind == kCapsules ? kSkin : kCapsules]),
                                own = places(cloths[kind]);
        std::vector<float> gaps;
        for (size_t i = 0; i < own.size(); ++i)
            if (own[i] != other[i]) gaps.push_back(query.signed_distance(own[i]));
        return gaps;
    };
    Samples ms[kKinds];
    const auto step = [&] {
        for (int k = 0; k < kKinds; ++k) {
            const Timer timer;
            check(vfit_cloth_step(cloths[k], kFrame_s));
            ms[k].add(timer.ms());
        }
    };
    const auto deepest_of = [](const std::vector<float>& gaps) {
        return -1e3 * double(*std::min_element(gaps.begin(), gaps.end()));
    };
    set_pose(capsules.avatar.get(), steps.poses[0], steps.bones[0]);
    if (!judge.quiet) {
        std::cout << "\nSpheres and capsules beside the avatar's own, to cover the skin below the sundress:";
        const uint32_t own = collider_count(capsules.cloth.get());
        for (const float cover_m : {0.02f, 0.01f, 0.005f}) {
            Cloth covered;
            desc.cover_m = cover_m;
            check(vfit_cloth_create(capsules.avatar.get(), garment.get(), &desc, covered.out()));
            std::cout << " within " << 1e3f * cover_m << " mm " << collider_count(covered.get()) - own;
        }
        std::cout << "\n";
    }
    for (const vfit_cloth cloth : cloths) check(vfit_cloth_reset(cloth));
    for (int i = 0; i < 180; ++i) step();
    const double deepest_rest_mm = deepest_of(gaps_now(kSkin));
    std::vector<float> resting = gaps_where_it_rests(capsules.avatar.get(), on_skin.get(), places(cloths[0]));
    double deepest_mm[kKinds] = {};
    size_t deep = 0, seen = 0;
    for (Samples& samples : ms) samples = Samples();
    for (size_t i = 0; i < steps.poses.size(); ++i) {
        set_pose(capsules.avatar.get(), steps.poses[i], steps.bones[i]);
        for (int half = 0; half < 2; ++half) step();
        if (i % 3 != 2) continue;
        for (int k = 0; k < kKinds; ++k) deepest_mm[k] = std::max(deepest_mm[k], deepest_of(gaps_now(k)));
        const std::vector<float> gaps = gaps_now(kSkin);
        deep += size_t(std::count_if(gaps.begin(), gaps.end(), [](float gap) { return gap < -kDeep_m; }));
        seen += gaps.size();
    }
    std::sort(resting.begin(), resting.end());
    const auto at = [&](double q) {
        return resting.empty() ? NAN : double(resting[size_t(q * double(resting.size() - 1))]);
    };
    const double capsules_ms = ms[kCapsules].quantile(0.5), skin_ms = ms[kSkin].quantile(0.5);
    if (!judge.quiet)
        std::cout << "\nThe sundress on the avatar's skin, who stands and then walks; one core: "
                  << std::fixed << std::setprecision(2) << capsules_ms
                  << " ms on spheres and capsules (walking, deepest " << deepest_mm[kCapsules]
                  << " mm in the skin), " << ms[kMore].quantile(0.5)
                  << " ms on those that cover it within 10 mm (" << deepest_mm[kMore] << " mm), " << skin_ms
                  << " ms on the skin; walking, " << deep << " of " << seen
                  << " vertices seen deeper than 2 mm in that\n";
    judge.targets.judge("added by the skin", skin_ms - capsules_ms, Aim::at_most, 1.0, 2, " ms");
    judge.targets.judge("deepest vertex, standing", deepest_rest_mm, Aim::at_most, 2.0, 1, " mm");
    judge.targets.judge("deepest vertex, walking", deepest_mm[kSkin], Aim::at_most, 2.0, 1, " mm");
    judge.targets.judge("gap beyond the thickness where it touches, median", at(0.5), Aim::at_most, 3.0, 1,
                        " mm");
    judge.targets.judge("the same, p95", at(0.95), Aim::at_most, 6.0, 1, " mm");
    return {{"colliders_ms", capsules_ms},
            {"skin_ms", skin_ms},
            {"deepest_mm", deepest_mm[kSkin]},
            {"cover_ms", ms[kMore].quantile(0.5)},
            {"cover_deepest_mm", deepest_mm[kMore]},
            {"gap_median_mm", at(0.5)},
            {"gap_p95_mm", at(0.95)}};
}

Json judge_frame(const DrapeJudge& judge) {
    pin_to_cores(1);
    const vfit::tools::Context context = open_context();
    Garment garment;
    check(vfit_garment_open(context.get(), "sundress", garment.out()));
    Motion motion;
    check(vfit_motion_create(context.get(), nullptr, motion.out()));
    const Dressed d = dress(context.get(), garment.get(), 1, 0);
    check(vfit_motion_bind(motion.get(), d.avatar.get()));
    Frame mesh;
    check(vfit_avatar_acquire_rest(d.avatar.get(), mesh.out()));
    const uint32_t vertices = view_of(mesh.get(), VFIT_STREAM_POSITION).width;
    std::vector<Vec3> skin(vertices), normals(vertices);
    vfit_target to[2] = {vfit_target_init(), vfit_target_init()};
    for (int k = 0; k < 2; ++k) {
        to[k].format = VFIT_FORMAT_F32X3;
        to[k].data = k == 0 ? skin.data() : normals.data();
        to[k].capacity = vertices * sizeof(Vec3);
    }
    Samples motion_ms, skin_ms, cloth_ms;
    const auto frame = [&](vfit_frame tracked, uint32_t body) {
        const Timer timer;
        check(vfit_motion_step(motion.get(), tracked, body, time_of(tracked)));
        vfit_pose pose = vfit_pose_init();
        const auto bones = bones_of(motion.get(), pose);
        const double moved = timer.ms();
        check(vfit_avatar_pose_into(d.avatar.get(), &pose, bones.data(), sizeof(vfit_bone),
                                    uint32_t(bones.size()), &to[0], &to[1]));
        const double posed = timer.ms();
        check(vfit_cloth_step(d.cloth.get(), kFrame_s));
        Frame cloth;
        check(vfit_cloth_acquire(d.cloth.get(), cloth.out()));
        const double whole = timer.ms();
        motion_ms.add(moved), skin_ms.add(posed - moved), cloth_ms.add(whole - posed);
        return whole;
    };
    // Some frames in a row, once the tracker has found so many people: the first of them is done with a cold
    // cache.
    constexpr size_t kInARow = 6;
    std::vector<Frame> waiting;
    Samples ms, first_ms;
    watch_walk(context.get(), [&](vfit_frame tracked, uint32_t body) {
        check(vfit_frame_retain(tracked));
        waiting.emplace_back(tracked);
        if (waiting.size() < kInARow) return;
        for (size_t i = 0; i < waiting.size(); ++i)
            (i == 0 ? first_ms : ms).add(frame(waiting[i].get(), body));
        waiting.clear();
    });
    if (!judge.quiet)
        std::cout << "\nA whole frame, one core: motion, " << vertices
                  << " vertices of skin written, the sundress, its buffers; right after the tracker "
                  << std::fixed << std::setprecision(2) << first_ms.quantile(0.5) << " ms\n  motion "
                  << motion_ms.quantile(0.5) << " ms, skin " << skin_ms.quantile(0.5) << " ms, cloth "
                  << cloth_ms.quantile(0.5) << " ms\n";
    judge.targets.judge("whole frame", ms.quantile(0.5), Aim::at_most, 1.0, 2, " ms");
    return {{"vertices", vertices},
            {"ms", ms.quantile(0.5)},
            {"p95_ms", ms.quantile(0.95)},
            {"after_tracker_ms", first_ms.quantile(0.5)}};
}

Json judge_crowd(const DrapeJudge& judge) {
    constexpr uint32_t kPeople = 20;
    pin_to_cores(2);
    const vfit::tools::Context context = open_context();
    Garment garment;
    check(vfit_garment_open(context.get(), "sundress", garment.out()));
    const Walk steps = walk(context.get());
    std::vector<Dressed> people;
    for (uint32_t i = 0; i < kPeople; ++i) {
        people.push_back(dress(context.get(), garment.get(), 3, 0));  // the coarse body
        set_pose(people.back().avatar.get(), steps.poses[i], steps.bones[i]);
        check(vfit_cloth_reset(people.back().cloth.get()));
        // Near ones by 8 sub-steps, the others by 3 and 1; each within its share of the game's budget.
        const uint32_t substeps = i < 4 ? 8 : i < 10 ? 3 : 1;
        check(vfit_cloth_set_quality(people.back().cloth.get(), substeps, i < 4 ? 0.45f : 0.3f));
    }
    Samples ms;
    for (size_t frame = 0; frame + kPeople < steps.poses.size(); ++frame) {
        const Timer timer;
        for (uint32_t i = 0; i < kPeople; ++i) {
            set_pose(people[i].avatar.get(), steps.poses[frame + i], steps.bones[frame + i]);
            check(vfit_cloth_begin_step(people[i].cloth.get(), kFrame_s));
        }
        for (const Dressed& person : people) check(vfit_cloth_end_step(person.cloth.get()));
        ms.add(timer.ms());
    }
    if (!judge.quiet)
        std::cout
            << "\n20 dressed avatars, poses and garments, two cores: 4 by 8 sub-steps, 6 by 3, 10 by 1\n";
    judge.targets.judge("a frame of the crowd", ms.quantile(0.5), Aim::at_most, 6.0, 2, " ms");
    return {{"ms", ms.quantile(0.5)}, {"p95_ms", ms.quantile(0.95)}};
}

}  // namespace vfit::tools
