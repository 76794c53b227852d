// vfit-bench layers: garments worn over each other, in all sizes that the default bodies can wear
// (synthetic).
#include <algorithm>
#include <iomanip>
#include <iostream>

#include "bench/bench.h"
#include "bench/targets.h"
#include "bench/welded.h"
#include "client/assets.h"
#include "client/outfit.h"
#include "client/output.h"

namespace vfit::tools {

namespace {

constexpr float kFrame_s = 1.0f / 60.0f;
constexpr int kFramesToRest = 60;

struct Outfit {
    vfit_sex sex;
    std::vector<const char*> garments;  // from the skin outwards
};
const std::vector<Outfit> kOutfits = {
    {VFIT_SEX_FEMALE, {"sundress_pattern", "duster"}},   {VFIT_SEX_FEMALE, {"jeans_women", "vest"}},
    {VFIT_SEX_FEMALE, {"jeans_women", "duster"}},        {VFIT_SEX_MALE, {"pants_men", "shirt_men"}},
    {VFIT_SEX_MALE, {"pants_men", "shirt_men", "vest"}}, {VFIT_SEX_MALE, {"martial_pants", "martial_jacket"}},
};
const char* const kSizes[] = {"XS", "S", "M", "L", "XL", "XXL", ""};

/// Triangles of the outer one that one of the inner goes through.
size_t crossed(const Welded& outer, const Welded& inner) {
    std::vector<uint32_t> triangles;
    for (const auto& [of_outer, of_inner] : crossings(outer, inner)) triangles.push_back(of_outer);
    std::sort(triangles.begin(), triangles.end());
    return size_t(std::unique(triangles.begin(), triangles.end()) - triangles.begin());
}

/// Layers that were put over others: what that took, and the frame that it left.
struct Added {
    Samples ms;
    size_t crossed = 0;  // of these frames
    Samples max_strain;  // in them
};

void wear_over(const Cloth& cloth, const std::vector<Cloth>& worn, Added& added) {
    const Timer timer;
    for (const Cloth& inner : worn) check(vfit_cloth_wear_over(cloth.get(), inner.get()));
    added.ms.add(timer.ms());
    vfit_cloth_stats stats = vfit_cloth_stats_init();
    check(vfit_cloth_describe(cloth.get(), &stats));
    added.max_strain.add(stats.strain_max);
    const Welded outer = mesh_of(cloth.get());
    added.crossed += std::any_of(worn.begin(), worn.end(), [&](const Cloth& inner) {
        return crossed(outer, mesh_of(inner.get())) > 0;
    });
}

void step(const std::vector<Cloth>& worn) {
    for (const Cloth& each : worn) check(vfit_cloth_step(each.get(), kFrame_s));
}

/// False: one of them cannot be worn in that size.
bool wear(vfit_context context, vfit_avatar avatar, const Outfit& outfit, const char* size,
          std::vector<Cloth>& worn, Added& added) {
    for (const char* name : outfit.garments) {
        const Garment garment = open_garment(context, name);
        vfit_cloth_desc desc = vfit_cloth_desc_init();
        desc.flags = VFIT_CLOTH_SKIN;
        desc.self_thickness_m = kOwnLayers_m;
        desc.size_label = *size ? size : nullptr;
        Cloth cloth;
        const vfit_result made = vfit_cloth_create(avatar, garment.get(), &desc, cloth.out());
        if (made == VFIT_ERROR_NOT_WEARABLE) return false;
        check(made);
        if (!worn.empty()) wear_over(cloth, worn, added);
        worn.push_back(std::move(cloth));
        for (int i = 0; i < kFramesToRest; ++i) step(worn);
    }
    return true;
}

void judge_layers(bool json) {
    const Context context = open_context();
    Json rows = Json::array();
    size_t refused = 0;
    Samples p99, most, crossed_share, moving_mm;
    Added added;
    for (const Outfit& outfit : kOutfits)
        for (const char* size : kSizes) {
            vfit_avatar_desc body = vfit_avatar_desc_init();
            body.sex = outfit.sex;
            Avatar avatar;
            check(vfit_avatar_create_from_shape(context.get(), &body, nullptr, sizeof(vfit_shape_value), 0,
                                                avatar.out()));
            std::vector<Cloth> worn;
            if (!wear(context.get(), avatar.get(), outfit, size, worn, added)) {
                ++refused;
                continue;
            }
            std::vector<Welded> before, layers;
            for (const Cloth& cloth : worn) before.push_back(mesh_of(cloth.get()));
            step(worn);
            for (const Cloth& cloth : worn) layers.push_back(mesh_of(cloth.get()));
            for (size_t i = 1; i < worn.size(); ++i) {
                size_t triangles = 0;
                for (size_t below = 0; below < i; ++below) triangles += crossed(layers[i], layers[below]);
                vfit_cloth_stats stats = vfit_cloth_stats_init();
                check(vfit_cloth_describe(worn[i].get(), &stats));
                const double share = 100.0 * double(triangles) / double(layers[i].indices.size() / 3);
                p99.add(stats.strain_p99), most.add(stats.strain_max), crossed_share.add(share);
                const double way_mm = ways_mm(before[i].positions, layers[i].positions);
                moving_mm.add(way_mm);
                rows.push_back({{"garment", outfit.garments[i]},
                                {"over", outfit.garments[i - 1]},
                                {"size", size},
                                {"strain_p99", stats.strain_p99},
                                {"strain_max", stats.strain_max},
                                {"moving_mm", way_mm},
                                {"crossed_triangles", triangles}});
                if (!json)
                    std::cout << std::left << std::setw(16) << outfit.garments[i] << "over " << std::setw(18)
                              << outfit.garments[i - 1] << std::setw(6) << (*size ? size : "made")
                              << std::right << std::fixed << std::setprecision(2)
                              << "stretch of 99 in 100 threads " << stats.strain_p99 << ", greatest "
                              << stats.strain_max << ", crossed triangles " << triangles << " (" << share
                              << " %)" << std::endl;
            }
        }
    Targets targets(json);
    if (!json)
        std::cout << "\n"
                  << rows.size() << " worn over others, " << refused
                  << " outfits not wearable in that size\n";
    targets.judge("a layer put over others, to the first frame, median", added.ms.quantile(0.5), Aim::at_most,
                  60.0, 0, " ms");
    targets.judge("  the same, 95 %", added.ms.quantile(0.95), Aim::at_most, 60.0, 0, " ms");
    targets.judge("  first frames in which it crosses one below", double(added.crossed), Aim::exactly, 0.0);
    targets.judge("  greatest stretch of a thread in them", added.max_strain.quantile(1.0), Aim::at_most, 0.6,
                  2);
    targets.judge("greatest stretch of a thread of an outer layer", most.quantile(1.0), Aim::at_most, 3.0, 2);
    targets.judge("stretch of 99 in 100 threads, worst", p99.quantile(1.0), Aim::at_most, 0.3, 2);
    targets.judge("triangles of an outer layer that one below goes through, median",
                  crossed_share.quantile(0.5), Aim::at_most, 0.0, 2, " %");
    targets.judge("triangles of an outer layer that one below goes through, worst",
                  crossed_share.quantile(1.0), Aim::at_most, 0.0, 2, " %");
    targets.judge("moving a second later, a frame, 99 of 100 vertices, 95 %", moving_mm.quantile(0.95),
                  Aim::at_most, 1.0, 2, " mm");
    if (json)
        print_document({{"rows", rows},
                        {"refused", refused},
                        {"added_ms", added.ms.json()},
                        {"targets", targets.json()}});
}

}  // namespace

void add_layers(Command& app) {
    Command command =
        app.add_subcommand("layers", "Judge garments worn over each other, in all sizes (synthetic)");
    auto json = std::make_shared<bool>(false);
    command.add_flag("--json", *json, "Print JSON");
    command.callback([json] { judge_layers(*json); });
}

}  // namespace vfit::tools
