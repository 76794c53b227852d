#include "bench/garment_ease.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <iterator>

#include "bench/bench.h"
#include "client/assets.h"
#include "cook/draft/draft.h"
#include "core/files.h"

namespace vfit::tools {

namespace {

constexpr float kFrame_s = 1.0f / 60.0f;
constexpr int kFramesToRest = 60;

/// How a garment is looked at.
struct Look {
    const char* name;
    uint32_t substeps;  // of 1/60 s; 0: the usual ones
    bool stands;        // else at rest, as it was drafted on
};
constexpr Look kLooks[] = {{"standing", 0, true},
                           {"standing, 32 sub-steps", 32, true},
                           {"at rest", 0, false},
                           {"at rest, 32 sub-steps", 32, false}};

std::vector<vfit_fit_zone> worn_by_default_body(vfit_context context, const std::string& garment_name,
                                                vfit_sex sex, const std::string& label, const Look& look) {
    vfit_avatar_desc body = vfit_avatar_desc_init();
    body.sex = sex;
    Avatar avatar;
    check(vfit_avatar_create_from_shape(context, &body, nullptr, sizeof(vfit_shape_value), 0, avatar.out()));
    constexpr float kLeg_rad = 0.1f;
    if (look.stands) stand(avatar.get(), kLeg_rad);
    const Garment garment = open_garment(context, garment_name);
    vfit_cloth_desc desc = vfit_cloth_desc_init();
    desc.flags = VFIT_CLOTH_SKIN;
    desc.size_label = label.c_str();
    desc.substeps = look.substeps;
    Cloth cloth;
    check(vfit_cloth_create(avatar.get(), garment.get(), &desc, cloth.out()));
    for (int i = 0; i < kFramesToRest; ++i) check(vfit_cloth_step(cloth.get(), kFrame_s));
    return list<vfit_fit_zone>([&](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_cloth_fit(cloth.get(), items, stride, n);
    });
}

}  // namespace

Json judge_ease(vfit_context context, bool quiet, Targets& targets) {
    const auto model = BodyModel::load(library_file("vfit_data/body.bin"));
    Json rows = Json::array();
    Samples errors_mm[std::size(kLooks)];
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(VFIT_DESIGN_DIR))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const auto& file : files) {
        const auto text = read_file(file.string());
        if (std::string(reinterpret_cast<const char*>(text.data()), text.size()).find("vfit-design") ==
            std::string::npos)
            continue;
        const GarmentDesign design = parse_design(text);
        const DraftedGarment drafted = draft(*model, design);
        const DraftedSize& size = drafted.sizes[drafted.base];
        for (size_t look = 0; look < std::size(kLooks); ++look)
            for (const vfit_fit_zone& zone :
                 worn_by_default_body(context, file.stem().string(), design.sex, size.label, kLooks[look])) {
                const Measurement* drawn = find(size.finished, zone.key);
                if (!drawn) continue;
                errors_mm[look].add(1e3 * std::abs(double(zone.garment_m - drawn->value)));
                rows.push_back({{"garment", design.name},
                                {"size", size.label},
                                {"key", zone.key},
                                {"look", kLooks[look].name},
                                {"drawn_m", drawn->value},
                                {"worn_m", zone.garment_m},
                                {"ease_m", zone.ease_m}});
                if (!quiet)
                    std::cout << std::left << std::setw(18) << design.name << std::setw(4) << size.label
                              << std::setw(16) << zone.key << std::right << std::fixed << std::setprecision(1)
                              << " ease " << std::setw(6) << 100.0 * double(zone.ease_m)
                              << " cm, of the pattern " << std::setw(6)
                              << 100.0 * double(drawn->value - zone.body_m) << " cm, " << kLooks[look].name
                              << "\n";
            }
    }
    for (size_t look = 0; look < std::size(kLooks); ++look)
        for (const auto& [what, share] : {std::pair("median", 0.5), std::pair("worst", 1.0)})
            targets.judge(
                std::string("ease against the pattern's, ") + kLooks[look].name + ", " + what + " error",
                errors_mm[look].quantile(share), Aim::at_most, 10.0, 1, " mm");
    return rows;
}

}  // namespace vfit::tools
