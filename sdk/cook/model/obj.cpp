#include "cook/model/obj.h"

#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "core/error.h"
#include "core/files.h"

namespace vfit {

namespace {

constexpr uint32_t kMostFaceCorners = 256;
constexpr size_t kMostMaterialBytes = size_t(4) << 20;

bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// A text line by line: one that ends with a backslash goes on in the next, and what follows a # is a remark.
class Lines {
public:
    explicit Lines(std::string_view text) : text_(text) {}

    bool next() {
        if (at_ >= text_.size()) return false;
        joined_.clear();
        first_ = number_ + 1;
        bool goes_on = true;
        while (goes_on && at_ < text_.size()) {
            std::string_view line = text_.substr(at_, text_.find_first_of("\r\n", at_) - at_);
            at_ += line.size();
            if (at_ < text_.size()) at_ += text_.substr(at_, 2) == "\r\n" ? 2 : 1;
            ++number_;
            goes_on = !line.empty() && line.back() == '\\';
            if (goes_on) line.remove_suffix(1);
            if (!goes_on && joined_.empty()) {
                rest_ = line;
                cut_remark();
                return true;
            }
            joined_ += line;
            joined_ += ' ';
        }
        rest_ = joined_;
        cut_remark();
        return true;
    }
    /// Of its first part.
    uint32_t number() const { return first_; }

    /// Empty at the end of the line.
    std::string_view word() {
        while (!rest_.empty() && is_blank(rest_.front())) rest_.remove_prefix(1);
        size_t length = 0;
        while (length < rest_.size() && !is_blank(rest_[length])) ++length;
        const std::string_view found = rest_.substr(0, length);
        rest_.remove_prefix(length);
        return found;
    }
    /// What follows, without blanks about it.
    std::string_view rest() const {
        std::string_view out = rest_;
        while (!out.empty() && is_blank(out.front())) out.remove_prefix(1);
        while (!out.empty() && is_blank(out.back())) out.remove_suffix(1);
        return out;
    }

private:
    void cut_remark() {
        for (size_t i = 0; i < rest_.size(); ++i)
            if (rest_[i] == '#' && (i == 0 || is_blank(rest_[i - 1])))
                return rest_.remove_suffix(rest_.size() - i);
    }

    std::string_view text_, rest_;
    std::string joined_;
    size_t at_ = 0;
    uint32_t number_ = 0, first_ = 0;
};

std::optional<float> number_of(std::string_view word) {
    if (!word.empty() && word.front() == '+') word.remove_prefix(1);
    double value = 0.0;  // what a float cannot hold is too large, or as good as 0
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (fault != std::errc() || end != word.data() + word.size() || word.empty() ||
        !std::isfinite(float(value)))
        return std::nullopt;
    return float(value);
}

std::string shown(std::string_view word) {
    std::string out;
    for (const char c : word.substr(0, 40)) out += static_cast<unsigned char>(c) < 32 || c == 127 ? '?' : c;
    return out;
}

/// Words of which each is followed by that many others in map_Kd, before the picture's name.
size_t option_values(std::string_view option) {
    if (option == "-mm") return 2;
    for (const char* known :
         {"-blendu", "-blendv", "-boost", "-bm", "-cc", "-clamp", "-imfchan", "-texres", "-type"})
        if (option == known) return 1;
    return 0;
}

class ObjReader {
public:
    ObjReader(std::string_view text, const Beside& beside) : lines_(without_mark(text)), beside_(beside) {
        if (text.find('\0') != std::string_view::npos) fail(VFIT_ERROR_DATA, "no OBJ file: it is not text");
    }

    Model run() {
        model_.groups = {"the face in line "};
        while (lines_.next()) {
            const std::string_view key = lines_.word();
            if (key == "v")
                model_.positions.emplace_back(read_vector<3>("vertex"));
            else if (key == "vt")
                add_uv();
            else if (key == "f")
                add_face();
            else if (key == "usemtl")
                material_ = material_named(std::string(lines_.rest()));
            else if (key == "mtllib")
                add_library();
            else
                refuse_curved(key);
            model_.check_count();
        }
        if (model_.positions.empty())
            fail(VFIT_ERROR_DATA, "no OBJ mesh: there is no vertex (a line \"v X Y Z\") in it");
        if (model_.faces.empty())
            fail(VFIT_ERROR_DATA, "no OBJ mesh: there is no face (a line \"f 1 2 3\") in it");
        note_materials();
        return std::move(model_);
    }

private:
    /// Some editors put a byte order mark before UTF-8.
    static std::string_view without_mark(std::string_view text) {
        constexpr std::string_view kMark = "\xef\xbb\xbf";
        return text.substr(0, kMark.size()) == kMark ? text.substr(kMark.size()) : text;
    }

    template <int kCount>
    glm::vec<kCount, float> read_vector(const char* what) {
        glm::vec<kCount, float> out(0.0f);
        for (int i = 0; i < kCount; ++i) {
            const std::string_view word = lines_.word();
            if (word.empty())
                fail(VFIT_ERROR_DATA, "line ", lines_.number(), ": the ", what, " has ", i, " numbers, ",
                     kCount, " are needed: is the file cut?");
            const auto value = number_of(word);
            if (!value)
                fail(VFIT_ERROR_DATA, "line ", lines_.number(), ": \"", shown(word), "\" of the ", what,
                     " is no finite number");
            out[i] = *value;
        }
        return out;
    }

    void add_uv() {
        if (model_.uvs.size() >= Model::kMostCorners)
            fail(VFIT_ERROR_DATA, "the file has more than ", Model::kMostCorners, " uvs");
        const Vec2 uv = read_vector<2>("uv");
        model_.uvs.emplace_back(uv.x, 1.0f - uv.y);  // OBJ counts from the picture's lower edge
    }

    /// Counted from 1, or backwards from the last by -1.
    uint32_t index_of(std::string_view word, size_t count, const char* what) const {
        int64_t value = 0;
        const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (fault != std::errc() || end != word.data() + word.size())
            fail(VFIT_ERROR_DATA, "line ", lines_.number(), ": \"", shown(word),
                 "\" of the face is no index of a ", what);
        if (value == 0 || value > int64_t(count) || value < -int64_t(count))
            fail(VFIT_ERROR_DATA, "line ", lines_.number(), ": the face names ", what, " ", value, " of ",
                 count);
        return uint32_t(value > 0 ? value - 1 : int64_t(count) + value);
    }

    void add_face() {
        ModelFace face{uint32_t(model_.corners.size()), 0, material_, 0, lines_.number()};
        for (std::string_view word = lines_.word(); !word.empty(); word = lines_.word()) {
            const size_t slash = word.find('/');
            ModelCorner corner{index_of(word.substr(0, slash), model_.positions.size(), "vertex"), kNoUv};
            if (slash != std::string_view::npos) {
                const std::string_view rest = word.substr(slash + 1), uv = rest.substr(0, rest.find('/'));
                if (!uv.empty()) corner.uv = index_of(uv, model_.uvs.size(), "uv");
            }
            model_.corners.push_back(corner);
            if (++face.corner_count > kMostFaceCorners)
                fail(VFIT_ERROR_DATA, "line ", lines_.number(), ": the face has more than ", kMostFaceCorners,
                     " corners");
        }
        if (face.corner_count < 3)
            fail(VFIT_ERROR_DATA, "line ", lines_.number(), ": the face has ", face.corner_count,
                 " corners, 3 are needed: is the file cut?");
        model_.faces.push_back(face);
    }

    void refuse_curved(std::string_view key) const {
        for (const char* curved : {"cstype", "curv", "curv2", "surf", "bmat"})
            if (key == curved)
                fail(VFIT_ERROR_UNSUPPORTED, "line ", lines_.number(),
                     ": curves and curved surfaces are not read: export polygons");
    }

    uint32_t material_named(const std::string& name) {
        if (name.empty()) return UINT32_MAX;
        const auto [known, fresh] = index_of_.try_emplace(name, uint32_t(model_.materials.size()));
        if (fresh) model_.materials.push_back({name, "", Vec3(0.8f)});
        return known->second;
    }

    /// One file, whose name may have blanks in it, or several.
    void add_library() {
        const std::string all(lines_.rest());
        if (beside_.find(all).place == Beside::Place::inside) return read_library(all);
        for (std::string_view word = lines_.word(); !word.empty(); word = lines_.word())
            read_library(std::string(word));
    }

    void read_library(const std::string& name) {
        const Beside::Found found = beside_.find(name);
        if (found.place != Beside::Place::inside) {
            model_.notes.push_back("the material library \"" + shown(name) +
                                   (found.place == Beside::Place::outside
                                        ? "\" is outside of the garment's folder: it is not read"
                                        : "\" is not there: materials are grey"));
            return;
        }
        if (!libraries_.insert(found.path).second) return;
        const std::vector<std::byte> bytes = read_file(found.path, kMostMaterialBytes);
        Lines lines(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
        ModelMaterial* material = nullptr;
        while (lines.next()) {
            const std::string_view key = lines.word();
            if (key == "newmtl") {
                const std::string called(lines.rest());
                const uint32_t index = material_named(called);
                defined_.insert(called);
                material = index == UINT32_MAX ? nullptr : &model_.materials[index];
            } else if (material && key == "Kd") {
                read_color(lines, name, *material);
            } else if (material && key == "map_Kd") {
                material->texture = picture_of(lines);
            }
        }
    }

    void read_color(Lines& lines, const std::string& library, ModelMaterial& material) {
        Vec3 color(0.0f);
        for (int i = 0; i < 3; ++i) {
            const std::string_view word = lines.word();
            const auto value =
                word.empty() && i > 0 ? std::optional(color.x) : number_of(word);  // one number: grey
            if (!value || *value < 0.0f || *value > 1.0f) {
                model_.notes.push_back(text("line ", lines.number(), " of ", shown(library),
                                            ": the colour of material \"", material.name,
                                            "\" is not three numbers from 0 to 1: it is grey"));
                return;
            }
            color[i] = *value;
        }
        material.color = color;
    }

    static std::string picture_of(Lines& lines) {
        while (!lines.rest().empty() && lines.rest().front() == '-') {
            const std::string_view option = lines.word();
            for (size_t i = 0; i < option_values(option); ++i) lines.word();
            if (option != "-o" && option != "-s" && option != "-t") continue;
            for (int i = 0; i < 3; ++i) {
                Lines ahead = lines;
                if (!number_of(ahead.word())) break;
                lines.word();
            }
        }
        return std::string(lines.rest());
    }

    void note_materials() {
        std::set<uint32_t> used;
        for (ModelFace& face : model_.faces) {
            if (face.material == UINT32_MAX)
                face.material = uint32_t(model_.materials.size());
            else
                used.insert(face.material);
        }
        for (const uint32_t m : used) {
            const ModelMaterial& material = model_.materials[m];
            const std::string of = " of material \"" + shown(material.name) + "\"";
            if (!defined_.count(material.name))
                model_.notes.push_back("material \"" + shown(material.name) +
                                       "\" is in no material library: it is grey");
            if (!material.texture.empty()) note_missing_texture(beside_, material.texture, of, model_.notes);
        }
    }

    Lines lines_;
    const Beside& beside_;
    Model model_;
    uint32_t material_ = UINT32_MAX;
    std::map<std::string, uint32_t> index_of_;
    std::set<std::string> defined_, libraries_;
};

}  // namespace

Model read_obj(std::string_view text, const Beside& beside) { return ObjReader(text, beside).run(); }

}  // namespace vfit
