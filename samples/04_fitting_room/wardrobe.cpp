#include "wardrobe.h"

#include <dlfcn.h>

#include <algorithm>
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
    for (uint32_t i = 0; i < info.size_count; ++i) {
        char label[32];
        vfit_garment_size_label(piece.garment.get(), i, label, sizeof label);
        piece.sizes.emplace_back(label);
    }
    piece.sizes.emplace_back(kMadeToMeasure);
    return piece;
}

}  // namespace

std::string usual_data_dir() {
    Dl_info library{};
    if (!dladdr(reinterpret_cast<void*>(&vfit_version), &library) || !library.dli_fname) return "vfit_data";
    return (fs::weakly_canonical(library.dli_fname).parent_path() / "vfit_data").string();
}

Wardrobe::Wardrobe(vfit_context context, const std::string& data_dir, const std::vector<std::string>& named) {
    std::vector<std::string> names = named;
    const fs::path folder = fs::path(data_dir.empty() ? usual_data_dir() : data_dir) / "garments";
    if (names.empty()) {
        std::error_code none;
        for (const auto& entry : fs::directory_iterator(folder, none))
            if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
        std::sort(names.begin(), names.end());
    }
    if (names.empty()) throw Failure("there is no garment in " + folder.string());
    for (const std::string& name : names) pieces_.push_back(piece_of(context, name));
}

}  // namespace room
