// Reads the baked body binary. Nothing in it is trusted: sizes and indices are checked before they are used.
#include "body/body_data.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <span>

#include "core/error.h"
#include "core/files.h"

namespace vfit {

namespace {

constexpr char kMagic[8] = {'V', 'F', 'I', 'T', 'B', 'O', 'D', 'Y'};
constexpr uint32_t kVersion = 1;
constexpr uint32_t kMostItems = 1u << 24;  // of any kind; so that no product of counts overflows 64 bits

// The records of the file, little-endian and without padding (write_binary in scripts/bake_body.py).
struct Header {
    char magic[8];
    uint32_t version, section_count;
    uint64_t file_size;
    uint32_t crc32, reserved;  // of all that follows the header
};
struct Section {
    char name[8];
    uint64_t offset, size;
};
struct Counts {
    uint32_t vertices, points, quads, uvs, parameters, bones, terms, fields, tiles;
};
struct ParameterRecord {
    char key[48];
    float minimum, maximum, female, male;
    uint32_t anchor_count;
    float anchors[kMaxAnchors];
};
struct BoneRecord {
    char name[32];
    int32_t parent, bone, part;
};
static_assert(sizeof(Header) == 32 && sizeof(Section) == 24 && sizeof(ParameterRecord) == 84);
static_assert(sizeof(BoneRecord) == 44 && sizeof(Term) == 32 && sizeof(Vec2) == 8);

/// CRC-32 of ISO 3309 (polynomial 0xEDB88320, as in zlib).
uint32_t crc32(std::span<const std::byte> bytes) {
    std::array<uint32_t, 256> table;
    for (uint32_t i = 0; i < 256; ++i) {
        table[i] = i;
        for (int bit = 0; bit < 8; ++bit) table[i] = (table[i] >> 1) ^ (table[i] & 1 ? 0xEDB88320u : 0u);
    }
    uint32_t crc = ~0u;
    for (std::byte b : bytes) crc = (crc >> 8) ^ table[(crc ^ static_cast<uint8_t>(b)) & 0xFF];
    return ~crc;
}

/// Text of a fixed field that ends at its first 0 or fills the field.
template <size_t N>
std::string string_of(const char (&field)[N]) {
    const void* end = std::memchr(field, 0, N);
    return {field, end ? static_cast<size_t>(static_cast<const char*>(end) - field) : N};
}

class Reader {
public:
    explicit Reader(const std::string& path) : path_(path), bytes_(read_file(path)) {
        Header header;
        if (bytes_.size() < sizeof header) refuse("is too short for a body file");
        std::memcpy(&header, bytes_.data(), sizeof header);
        if (std::memcmp(header.magic, kMagic, sizeof kMagic) != 0) refuse("is no body file");
        if (header.version != kVersion)
            fail(VFIT_ERROR_VERSION, path_, ": body file of version ", header.version, ", wanted ", kVersion);
        if (header.file_size != bytes_.size())
            refuse(text("is cut: ", bytes_.size(), " of ", header.file_size, " bytes"));
        if (header.crc32 != crc32(std::span(bytes_).subspan(sizeof header))) refuse("is damaged (checksum)");
        read_sections(header.section_count);
    }

    [[noreturn]] void refuse(const std::string& cause) const { fail(VFIT_ERROR_DATA, path_, ": ", cause); }
    void require(bool condition, const char* what) const {
        if (!condition) refuse(text("holds ", what));
    }

    template <typename T>
    std::vector<T> array(const char* name, size_t count) const {
        const auto found = sections_.find(name);
        if (found == sections_.end()) refuse(text("has no section ", name));
        if (found->second.size() != count * sizeof(T))
            refuse(text("has a section ", name, " of the wrong size"));
        std::vector<T> items(count);
        if (count > 0) std::memcpy(items.data(), found->second.data(), count * sizeof(T));
        return items;
    }
    size_t section_size(const char* name) const {
        const auto found = sections_.find(name);
        return found == sections_.end() ? 0 : found->second.size();
    }

private:
    void read_sections(uint32_t count) {
        const uint64_t size = bytes_.size();
        if (count > (size - sizeof(Header)) / sizeof(Section)) refuse("has a section table that is too long");
        for (uint32_t i = 0; i < count; ++i) {
            Section section;
            std::memcpy(&section, bytes_.data() + sizeof(Header) + i * sizeof(Section), sizeof section);
            if (section.offset > size || section.size > size - section.offset)
                refuse("has a section outside the file");
            sections_[string_of(section.name)] = std::span(bytes_).subspan(section.offset, section.size);
        }
    }

    std::string path_;
    std::vector<std::byte> bytes_;
    std::map<std::string, std::span<const std::byte>> sections_;
};

// Bounds that no body comes near; within them no shape adds up to an infinite position.
constexpr float kFarthest_m = 10.0f;
constexpr float kLargestValue = 10.0f;  // of a shape parameter
constexpr float kNearestAnchors = 0.01f;

/// False for NaN as well.
bool within(const std::vector<float>& values, float bound) {
    return std::all_of(values.begin(), values.end(), [=](float x) { return std::abs(x) <= bound; });
}

void read_parameters(const Reader& file, uint32_t count, BodyData& data) {
    for (const ParameterRecord& r : file.array<ParameterRecord>("PARAMS", count)) {
        bool sound = r.anchor_count >= 2 && r.anchor_count <= kMaxAnchors;
        for (uint32_t i = 0; sound && i < r.anchor_count; ++i)
            sound = std::abs(r.anchors[i]) <= kLargestValue &&
                    (i == 0 || r.anchors[i] - r.anchors[i - 1] >= kNearestAnchors);
        sound = sound && std::abs(r.minimum) <= kLargestValue && std::abs(r.maximum) <= kLargestValue;
        for (float value : {r.female, r.male}) sound = sound && value >= r.minimum && value <= r.maximum;
        file.require(sound, "a shape parameter with an unsound range");
        data.parameters.push_back({string_of(r.key), r.minimum, r.maximum, r.female, r.male});
        Anchors anchors{r.anchor_count, {}};
        std::memcpy(anchors.at.data(), r.anchors, sizeof r.anchors);
        data.anchors.push_back(anchors);
    }
}

void read_bones(const Reader& file, uint32_t count, BodyData& data) {
    int index = 0;
    for (const BoneRecord& r : file.array<BoneRecord>("BONES", count)) {
        file.require(r.parent >= -1 && r.parent < index, "a bone before its parent");
        file.require((r.parent == -1) == (index == 0), "not exactly one root bone");
        file.require(r.bone >= -1 && r.bone < int(VFIT_BONE_COUNT), "an unknown humanoid bone");
        file.require(r.part >= 0 && r.part < kBodyPartCount, "an unknown body part");
        data.bones.push_back({string_of(r.name), r.parent, r.bone});
        data.bone_parts.push_back(static_cast<BodyPart>(r.part));
        ++index;
    }
    for (int humanoid = 0; humanoid < int(VFIT_BONE_COUNT); ++humanoid) {
        int found = 0;
        for (const RigBone& bone : data.bones) found += bone.bone == humanoid;
        file.require(found == 1, "a humanoid bone not exactly once");
    }
}

void check_indices(const Reader& file, const std::vector<Quad>& quads, uint32_t count, const char* what) {
    for (const Quad& quad : quads)
        for (uint32_t i : quad) file.require(i < count, what);
}

void read_skin(const Reader& file, BodyData& data) {
    data.skin_bones = file.array<std::array<uint16_t, kSkinBones>>("SKINBONE", data.vertex_count);
    data.skin_weights = file.array<std::array<uint16_t, kSkinBones>>("SKINWGT", data.vertex_count);
    for (uint32_t v = 0; v < data.vertex_count; ++v) {
        uint32_t sum = 0;
        for (uint16_t weight : data.skin_weights[v]) sum += weight;
        file.require(sum == 65535, "skin weights that do not sum to 1");
        for (uint16_t bone : data.skin_bones[v])
            file.require(bone < data.bones.size(), "a skin weight of an unknown bone");
    }
}

void read_fields(const Reader& file, const Counts& counts, BodyData& data) {
    data.terms = file.array<Term>("TERMS", counts.terms);
    for (const Term& term : data.terms) {
        file.require(term.field < counts.fields && term.factor_count <= kMaxFactors, "an unsound term");
        for (uint32_t i = 0; i < term.factor_count; ++i) {
            const Term::Factor factor = term.factors[i];
            file.require(factor.parameter < data.anchors.size() &&
                             factor.anchor < data.anchors[factor.parameter].count,
                         "a term with an unknown factor");
        }
    }
    data.base = file.array<float>("BASE", size_t(counts.tiles) * kTileFloats);
    data.scales = file.array<float>("SCALES", counts.fields);
    file.require(within(data.base, kFarthest_m) && within(data.scales, kFarthest_m / 32767.0f),
                 "lengths that no body has");
    data.masks = file.array<uint64_t>("MASKS", size_t(counts.fields) * counts.tiles);
    data.offsets = file.array<uint32_t>("OFFSETS", data.masks.size());
    const size_t block_bytes = kBlockFloats * sizeof(int16_t);
    const size_t blocks = file.section_size("BLOCKS") / block_bytes;
    data.steps = file.array<int16_t>("BLOCKS", blocks * kBlockFloats);
    for (size_t i = 0; i < data.masks.size(); ++i) {
        size_t used = 0;
        for (uint64_t mask = data.masks[i]; mask != 0; mask &= mask - 1) ++used;
        file.require(data.offsets[i] <= blocks && used <= blocks - data.offsets[i],
                     "a displacement outside its section");
    }
}

}  // namespace

BodyData read_body_data(const std::string& path) {
    const Reader file(path);
    const Counts counts = file.array<Counts>("COUNTS", 1)[0];
    for (uint32_t count : {counts.vertices, counts.points, counts.quads, counts.uvs, counts.parameters,
                           counts.bones, counts.terms, counts.fields, counts.tiles})
        file.require(count > 0 && count < kMostItems, "an unsound count");
    BodyData data;
    data.vertex_count = counts.vertices;
    data.point_count = counts.points;
    data.tile_count = counts.tiles;
    file.require(counts.points == counts.vertices + 2 * counts.bones, "not two points a bone");
    file.require(counts.points <= uint64_t(counts.tiles) * kTileBlocks * kLanes,
                 "too few tiles for its points");
    read_parameters(file, counts.parameters, data);
    read_bones(file, counts.bones, data);
    data.quads = file.array<Quad>("QUADS", counts.quads);
    data.uv_quads = file.array<Quad>("QUADUVS", counts.quads);
    data.uvs = file.array<Vec2>("UVS", counts.uvs);
    for (const Vec2& uv : data.uvs)
        file.require(std::isfinite(uv.x) && std::isfinite(uv.y), "a UV that is not finite");
    check_indices(file, data.quads, counts.vertices, "a face with an unknown vertex");
    check_indices(file, data.uv_quads, counts.uvs, "a face with an unknown UV");
    read_skin(file, data);
    read_fields(file, counts, data);
    return data;
}

}  // namespace vfit
