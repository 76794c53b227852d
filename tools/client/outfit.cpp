#include "client/outfit.h"

#include <cstdio>

#include "client/assets.h"

namespace vfit::tools {

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts(1);
    for (const char c : text) {
        if (c == separator)
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

std::string default_outfit(vfit_sex sex) {
    return sex == VFIT_SEX_FEMALE ? "sundress" : "pants_men+shirt_men";
}

std::string warned(const std::string& title, const std::string& warning) {
    return warning.empty() ? title : warning + "\n" + title;
}

std::vector<vfit_garment_part> stated_parts(vfit_garment garment) {
    auto parts = list<vfit_garment_part>([&](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_garment_parts(garment, items, stride, n);
    });
    // A file that states no parts is one part without a material.
    if (parts.size() == 1 && parts[0].material[0] == 0) parts.clear();
    return parts;
}

std::vector<Garment> open_outfit(vfit_context context, const std::string& names) {
    std::vector<Garment> out;
    for (const std::string& name : split(names, '+')) {
        if (name.empty()) throw Failure("\"" + names + "\": a garment has no name");
        out.push_back(open_garment(context, name));
    }
    return out;
}

Avatar default_wearer(vfit_context context, const std::string& names) {
    return default_wearer(context, open_outfit(context, names).front().get());
}

Avatar default_wearer(vfit_context context, vfit_garment garment) {
    vfit_garment_info info = vfit_garment_info_init();
    check(vfit_garment_describe(garment, &info));
    vfit_avatar_desc body = vfit_avatar_desc_init();
    body.sex = info.body_sex;
    Avatar avatar;
    check(vfit_avatar_create_from_shape(context, &body, nullptr, 0, 0, avatar.out()));
    return avatar;
}

WornOutfit::WornOutfit(vfit_context context, vfit_avatar avatar, const std::string& names,
                       const vfit_cloth_desc& desc)
    : WornOutfit(avatar, open_outfit(context, names), split(names, '+'), desc) {}

WornOutfit::WornOutfit(vfit_avatar avatar, std::vector<Garment> garments,
                       const std::vector<std::string>& called, const vfit_cloth_desc& desc) {
    for (size_t i = 0; i < garments.size(); ++i) {
        Layer layer;
        layer.name = called[i];
        layer.garment = std::move(garments[i]);
        check(vfit_garment_describe(layer.garment.get(), &layer.info));
        const vfit_result made = vfit_cloth_create(avatar, layer.garment.get(), &desc, layer.cloth.out());
        if (made == VFIT_ERROR_NOT_WEARABLE) throw NotWearable(last_error());
        check(made);
        for (const Layer& inner : layers_) check(vfit_cloth_wear_over(layer.cloth.get(), inner.cloth.get()));
        layers_.push_back(std::move(layer));
    }
}

std::vector<vfit_cloth> WornOutfit::cloths() const {
    std::vector<vfit_cloth> out;
    for (const Layer& layer : layers_) out.push_back(layer.cloth.get());
    return out;
}

void WornOutfit::reset() {
    for (const Layer& layer : layers_) check(vfit_cloth_reset(layer.cloth.get()));
    worst_ = {};
    time_s_ = 0.0f;
}

void WornOutfit::step(float seconds) {
    for (const Layer& layer : layers_) check(vfit_cloth_step(layer.cloth.get(), seconds));
    time_s_ += seconds;
    look_at_strain();
}

void WornOutfit::settle(int frames) {
    constexpr float kFrame_s = 1.0f / 60.0f;
    for (int i = 0; i < frames; ++i) step(kFrame_s);
    forget_worst();
    step(kFrame_s);
}

void WornOutfit::look_at_strain() {
    for (const Layer& layer : layers_) {
        vfit_cloth_stats stats = vfit_cloth_stats_init();
        check(vfit_cloth_describe(layer.cloth.get(), &stats));
        if (stats.strain_max > worst_.strain) worst_ = {stats.strain_max, time_s_, layer.name};
    }
}

std::string WornOutfit::warning_of(const Worst& worst) {
    if (worst.strain <= kMaxPlausibleStrain) return "";
    char text[200];
    std::snprintf(text, sizeof text,
                  "TORN: an edge of %s is %.1f times as long as cut after %.1f s; not a valid fit",
                  worst.garment.c_str(), 1.0 + worst.strain, worst.time_s);
    return text;
}

}  // namespace vfit::tools
