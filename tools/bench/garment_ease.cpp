#include "bench/garment_ease.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>

#include "bench/bench.h"
#include "client/assets.h"
#include "cook/draft/draft.h"
#include "core/files.h"

namespace vfit::tools {

namespace {

constexpr float kFrame_s = 1.0f / 60.0f;
constexpr int kFramesToRest = 60;
constexpr float kLeg_rad = 0.1f;
constexpr uint32_t kSubsteps = 32;  // of 1/60 s: cloth that is looked at and need not keep up with anybody

std::vector<vfit_fit_zone> worn_by_default_body(vfit_context context, const std::string& garment_name, vfit_sex sex, const std::string& label) {
    vfit_avatar_desc body = vfit_avatar_desc_init();
    body.sex = sex;
    Avatar avatar;
    check(vfit_avatar_create_from_shape(context, &body, nullptr, sizeof(vfit_shape_value), 0, avatar.out()));
    if (getenv("VST")) stand(avatar.get(), kLeg_rad);
    const Garment garment = open_garment(context, garment_name);
    vfit_cloth_desc desc = vfit_cloth_desc_init();
    desc.flags = VFIT_CLOTH_SKIN;
    desc.size_label = label.c_str();
    desc.substeps = getenv("VSS") ? atoi(getenv("VSS")) : kSubsteps;
    Cloth cloth;
    check(vfit_cloth_create(avatar.get(), garment.get(), &desc, cloth.out()));
    for (int i = 0; i < kFramesToRest; ++i) check(vfit_cloth_step(cloth.get(), kFrame_s));
    return list<vfit_fit_zone>([&](auto* items, uint32_t stride, uint32_t* n) { return vfit_cloth_fit(cloth.get(), items, stride, n); });
}

}  // namespace

Json judge_ease(vfit_context context, bool quiet, Targets& targets) {
    const auto model = BodyModel::load(library_file("vfit_data/body.bin"));
    Json rows = Json::array();
    Samples errors_mm;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(VFIT_DESIGN_DIR)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const auto& file : files) {
        const auto text = read_file(file.string());
        if (std::string(reinterpret_cast<const char*>(text.data()), text.size()).find("vfit-design") == std::string::npos) continue;
        const GarmentDesign design = parse_design(text);
        const DraftedGarment drafted = draft(*model, design);
        const DraftedSize& size = drafted.sizes[drafted.base];
        for (const vfit_fit_zone& zone : worn_by_default_body(context, file.stem().string(), design.sex, size.label)) {
            const Measurement* drawn = find(size.finished, zone.key);
            if (!drawn) continue;
            const double error_mm = 1e3 * double(zone.garment_m - drawn->value);
            errors_mm.add(std::abs(error_mm));
            rows.push_back({{"garment", design.name}, {"size", size.label}, {"key", zone.key}, {"drawn_m", drawn->value}, {"worn_m", zone.garment_m}, {"ease_m", zone.ease_m}});
            if (!quiet)
                std::cout << std::left << std::setw(18) << design.name << std::setw(4) << size.label << std::setw(16) << zone.key << std::right << std::fixed << std::setprecision(1) << " ease " << std::setw(6)
                          << 100.0 * double(zone.ease_m) << " cm, of the pattern " << std::setw(6) << 100.0 * double(drawn->value - zone.body_m) << " cm\n";
        }
    }
    targets.judge("ease at chest, waist, hip against the pattern's, median error", errors_mm.quantile(0.5), Aim::at_most, 10.0, 1, " mm");
    targets.judge("ease at chest, waist, hip against the pattern's, worst error", errors_mm.quantile(1.0), Aim::at_most, 10.0, 1, " mm");
    return rows;
}

}  // namespace vfit::tools
