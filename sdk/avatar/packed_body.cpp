#include "avatar/packed_body.h"

#include "core/bits.h"
#include "core/json.h"

namespace vfit {

namespace {

constexpr uint64_t kVersion = 1;
constexpr int kVersionBits = 8, kModelBits = 16, kSexBits = 2, kScaleBits = 16, kRadiusBits = 9,
              kValueBits = 10, kLabelBits = 5;
constexpr float kLeastScale = 0.25f, kMostScale = 2.25f;
constexpr float kMostRadius_m = 0.511f;

/// Which parameters a shape has, in which order and range (FNV-1a).
uint64_t fingerprint(const BodyModel& model) {
    uint64_t hash = 1469598103934665603u;
    const auto mix = [&](const std::string& text) {
        for (const char c : text) hash = (hash ^ uint8_t(c)) * 1099511628211u;
    };
    for (const ShapeParameter& p : model.parameters()) mix(text(p.key, " ", p.minimum, " ", p.maximum, "\n"));
    return (hash ^ (hash >> 16) ^ (hash >> 32) ^ (hash >> 48)) & ((1u << kModelBits) - 1);
}

}  // namespace

std::vector<uint8_t> pack_body(const BodyModel& model, const PackedBody& body) {
    if (body.size_label.size() > kMaxPackedLabel)
        fail(VFIT_ERROR_ARGUMENT, "the size label \"", body.size_label, "\" has more than ", kMaxPackedLabel,
             " bytes");
    if (!is_utf8(body.size_label)) fail(VFIT_ERROR_ARGUMENT, "the size label is not UTF-8");
    const auto& parameters = model.parameters();
    const size_t bits = kVersionBits + kModelBits + kSexBits + 2 * kScaleBits +
                        kRadiusBits * size_t(kPaperJointCount) + kValueBits * parameters.size() + kLabelBits +
                        8 * body.size_label.size();
    if ((bits + 7) / 8 > kMaxPackedBodyBytes)
        fail(VFIT_ERROR_UNSUPPORTED, "a body of ", parameters.size(), " shape values does not fit a packet");
    std::vector<uint8_t> bytes((bits + 7) / 8);
    BitWriter out(bytes);
    out.put(kVersion, kVersionBits);
    out.put(fingerprint(model), kModelBits);
    out.put(uint64_t(body.sex), kSexBits);
    for (const float s : {body.scale.x, body.scale.y})
        out.put_in_range(s, kLeastScale, kMostScale, kScaleBits);
    for (const float r : body.radii) out.put_in_range(r, 0.0f, kMostRadius_m, kRadiusBits);
    for (size_t i = 0; i < parameters.size(); ++i)
        out.put_in_range(body.shape[i], parameters[i].minimum, parameters[i].maximum, kValueBits);
    out.put(body.size_label.size(), kLabelBits);
    for (const char c : body.size_label) out.put(uint8_t(c), 8);
    return bytes;
}

PackedBody unpack_body(const BodyModel& model, std::span<const uint8_t> bytes) {
    BitReader in(bytes);
    if (const uint64_t version = in.get(kVersionBits); version != kVersion)
        fail(VFIT_ERROR_VERSION, "a packed body of version ", version, ", this library reads version ",
             kVersion);
    if (in.get(kModelBits) != fingerprint(model))
        fail(VFIT_ERROR_VERSION, "the body was packed with another body model");
    PackedBody body;
    const uint64_t sex = in.get(kSexBits);
    if (sex > VFIT_SEX_MALE) fail(VFIT_ERROR_DATA, "the packed body's sex is ", sex);
    body.sex = vfit_sex(sex);
    body.scale.x = in.get_in_range(kLeastScale, kMostScale, kScaleBits);
    body.scale.y = in.get_in_range(kLeastScale, kMostScale, kScaleBits);
    for (float& r : body.radii) r = in.get_in_range(0.0f, kMostRadius_m, kRadiusBits);
    for (const ShapeParameter& p : model.parameters())
        body.shape.push_back(in.get_in_range(p.minimum, p.maximum, kValueBits));
    const uint64_t length = in.get(kLabelBits);
    if (length > kMaxPackedLabel)
        fail(VFIT_ERROR_DATA, "the packed body's size label has ", length, " bytes");
    for (uint64_t i = 0; i < length; ++i) body.size_label += char(in.get(8));
    // The label ends as a string of the host's language, which a byte of a damaged packet could break.
    if (!is_utf8(body.size_label)) fail(VFIT_ERROR_DATA, "the packed body's size label is not UTF-8");
    return body;
}

}  // namespace vfit
