// Shape values to skin and joints: coefficients by products of hat functions, then the sum of displacement
// fields, tile by tile so that the sums stay in the first-level cache.
#include "body/body_model.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "body/body_data.h"
#include "body/body_surface.h"
#include "core/error.h"

namespace vfit {

struct BodyModel::Data {
    explicit Data(BodyData read) : body(std::move(read)), surface(body) {}
    const BodyData body;
    BodySurface surface;
};

BodyModel::BodyModel() = default;
BodyModel::~BodyModel() = default;

std::shared_ptr<const BodyModel> BodyModel::load(const std::string& path) {
    std::shared_ptr<BodyModel> model(new BodyModel);
    model->data_ = std::make_unique<Data>(read_body_data(path));
    return model;
}

const std::vector<ShapeParameter>& BodyModel::parameters() const { return data_->body.parameters; }
const std::vector<RigBone>& BodyModel::bones() const { return data_->body.bones; }

int BodyModel::parameter(const std::string& key) const {
    const auto& all = data_->body.parameters;
    const auto found = std::find_if(all.begin(), all.end(), [&](const ShapeParameter& p) { return p.key == key; });
    return found == all.end() ? -1 : static_cast<int>(found - all.begin());
}

int BodyModel::rig_bone(int humanoid_bone) const {
    const auto& all = data_->body.bones;
    const auto found = std::find_if(all.begin(), all.end(), [&](const RigBone& b) { return b.bone == humanoid_bone; });
    if (humanoid_bone < 0 || found == all.end()) fail(VFIT_ERROR_ARGUMENT, "no humanoid bone ", humanoid_bone);
    return static_cast<int>(found - all.begin());
}

std::vector<float> BodyModel::default_shape(vfit_sex sex) const {
    if (sex != VFIT_SEX_UNKNOWN && sex != VFIT_SEX_FEMALE && sex != VFIT_SEX_MALE)
        fail(VFIT_ERROR_ARGUMENT, "unknown sex ", sex);
    const float male = sex == VFIT_SEX_MALE ? 1.0f : sex == VFIT_SEX_FEMALE ? 0.0f : 0.5f;
    std::vector<float> shape;
    shape.reserve(data_->body.parameters.size());
    for (const ShapeParameter& p : data_->body.parameters) shape.push_back((1.0f - male) * p.female + male * p.male);
    return shape;
}

namespace {

/// The hat functions of one parameter at `value`. The outermost go on linearly beyond the last anchors.
void hat_functions(const Anchors& anchors, float value, float* hats) {
    uint32_t i = 0;
    while (i + 2 < anchors.count && value >= anchors.at[i + 1]) ++i;
    std::fill(hats, hats + kMaxAnchors, 0.0f);
    const float t = (value - anchors.at[i]) / (anchors.at[i + 1] - anchors.at[i]);
    hats[i] = 1.0f - t;
    hats[i + 1] = t;
}

struct ActiveField {
    uint32_t field;
    float scale;  // coefficient times metres of a step
};

void add_steps(float* sum, const int16_t* steps, uint32_t count, float scale) {
    for (uint32_t i = 0; i < count; ++i) sum[i] += scale * static_cast<float>(steps[i]);
}

/// The sum of the base and all active fields over one tile.
void sum_tile(const BodyData& body, uint32_t tile, std::span<const ActiveField> active, float* sum) {
    std::copy_n(body.base.data() + size_t(tile) * kTileFloats, kTileFloats, sum);
    for (const ActiveField& a : active) {
        const size_t cell = size_t(a.field) * body.tile_count + tile;
        const int16_t* steps = body.steps.data() + size_t(body.offsets[cell]) * kBlockFloats;
        const uint64_t mask = body.masks[cell];
        if (mask == ~uint64_t(0)) {
            add_steps(sum, steps, kTileFloats, a.scale);
            continue;
        }
        for (uint64_t rest = mask; rest != 0; rest &= rest - 1, steps += kBlockFloats)
            add_steps(sum + std::countr_zero(rest) * kBlockFloats, steps, kBlockFloats, a.scale);
    }
}

/// Points that a vertex array and then pairs of bone ends receive.
void store_point(const BodyData& body, uint32_t point, const Vec3& p, EvaluatedBody& out) {
    if (point < body.vertex_count) {
        out.positions[point] = p;
    } else {
        const uint32_t end = point - body.vertex_count;
        (end % 2 == 0 ? out.bone_heads : out.bone_tails)[end / 2] = p;
    }
}

}  // namespace

void BodyModel::evaluate(std::span<const float> shape, EvaluatedBody& out) const {
    const BodyData& body = data_->body;
    if (shape.size() != body.parameters.size())
        fail(VFIT_ERROR_ARGUMENT, "a shape of ", shape.size(), " values where the body has ", body.parameters.size());
    out.positions.resize(body.vertex_count);
    out.bone_heads.resize(body.bones.size());
    out.bone_tails.resize(body.bones.size());
    const size_t hat_count = kMaxAnchors * shape.size();
    out.scratch.resize(hat_count + body.scales.size());
    float* hats = out.scratch.data();
    float* coefficients = hats + hat_count;

    for (size_t i = 0; i < shape.size(); ++i) {
        if (!std::isfinite(shape[i]))
            fail(VFIT_ERROR_ARGUMENT, "shape value of ", body.parameters[i].key, " is not finite");
        const float value = std::clamp(shape[i], body.parameters[i].minimum, body.parameters[i].maximum);
        hat_functions(body.anchors[i], value, hats + kMaxAnchors * i);
    }
    std::fill_n(coefficients, body.scales.size(), 0.0f);
    for (const Term& term : body.terms) {
        float product = 1.0f;
        for (uint32_t i = 0; i < term.factor_count; ++i)
            product *= hats[kMaxAnchors * term.factors[i].parameter + term.factors[i].anchor];
        coefficients[term.field] += product;
    }
    out.active.clear();
}

const BodyTopology& BodyModel::topology(uint32_t level) const { return data_->surface.topology(level); }

void BodyModel::subdivide(uint32_t level, const std::vector<Vec3>& base, std::vector<Vec3>& out) const {
    data_->surface.subdivide(level, base, out);
}

}  // namespace vfit
