#include "wardrobe.h"

#include <filesystem>
#include <fstream>
#include <iterator>

namespace room {

namespace fs = std::filesystem;

namespace {

Garment open(vfit_context context, const std::string& name) {
    Garment garment;
    if (name.find('/') == std::string::npos && fs::path(name).extension() != ".json") {
        check(vfit_garment_open(context, name.c_str(), garment.out()));
        return garment;
    }
    std::ifstream file(name, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    if (!file) throw Failure("garment " + name + ": cannot be read");
    if (vfit_garment_load(context, text.data(), text.size(), garment.out()) < 0)
        throw Failure("garment " + name + ": " + last_error());
    return garment;
}

Piece piece_of(vfit_context context, const std::string& name) {
    Piece piece;
    piece.name = fs::path(name).stem().string();
    piece.garment = open(context, name);
    vfit_garment_info info = vfit_garment_info_init();
    check(vfit_garment_describe(piece.garment.get(), &info));
    piece.kind = info.garment_kind;
    piece.chart = info.size_chart;
    for (uint32_t i = 0; i < info.size_count; ++i) {
        char label[32];
        vfit_garment_size_label(piece.garment.get(), i, label, sizeof label);
        piece.sizes.emplace_back(label);
    }
    piece.sizes.emplace_back(kMadeToMeasure);
    return piece;
}

}  // namespace

Wardrobe::Wardrobe(vfit_context context, const std::vector<std::string>& named) {
    std::vector<std::string> names = named;
    if (names.empty()) {
        uint32_t count = 0;
        check(vfit_garment_list(context, nullptr, sizeof(vfit_data_name), &count));
        std::vector<vfit_data_name> entries(count);
        check(vfit_garment_list(context, entries.data(), sizeof(vfit_data_name), &count));
        for (const vfit_data_name& entry : entries) names.emplace_back(entry.name);
    }
    if (names.empty()) throw Failure("the data folder holds no garment");
    for (const std::string& name : names) pieces_.push_back(piece_of(context, name));
}

}  // namespace room
