#include "client/assets.h"

#include "client/files.h"

namespace vfit::tools {

namespace {

bool is_path(const std::string& text) {
    constexpr std::string_view kEnd = ".json";
    return text.find_first_of("/\\") != std::string::npos ||
           (text.size() > kEnd.size() && text.compare(text.size() - kEnd.size(), kEnd.size(), kEnd) == 0);
}

template <typename Object, typename Open, typename Load>
Object open_or_load(vfit_context context, const std::string& name, Open open, Load load) {
    Object object;
    if (!is_path(name)) {
        check(open(context, name.c_str(), object.out()));
        return object;
    }
    const std::string text = read_text(name);
    if (load(context, text.data(), text.size(), object.out()) < 0) throw Failure(name + ": " + last_error());
    return object;
}

std::vector<std::string> names_of(const std::vector<vfit_data_name>& entries) {
    std::vector<std::string> names;
    for (const vfit_data_name& entry : entries) names.emplace_back(entry.name);
    return names;
}

}  // namespace

std::vector<std::string> garment_names(vfit_context context) {
    return names_of(list<vfit_data_name>([&](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_garment_list(context, items, stride, n);
    }));
}

std::vector<std::string> chart_names(vfit_context context) {
    return names_of(list<vfit_data_name>([&](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_size_chart_list(context, items, stride, n);
    }));
}

SizeChart open_chart(vfit_context context, const std::string& name_or_path) {
    return open_or_load<SizeChart>(context, name_or_path, vfit_size_chart_open, vfit_size_chart_load);
}

Population open_population(vfit_context context, const std::string& name_or_path) {
    return open_or_load<Population>(context, name_or_path, vfit_population_open, vfit_population_load);
}

Garment open_garment(vfit_context context, const std::string& name_or_path) {
    return open_or_load<Garment>(context, name_or_path, vfit_garment_open, vfit_garment_load);
}

}  // namespace vfit::tools
