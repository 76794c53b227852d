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
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const ShapeParameter& p) { return p.key == key; });
    return found == all.end() ? -1 : static_cast<int>(found - all.begin());
}

int BodyModel::rig_bone(int humanoid_bone) const {
    const auto& all = data_->body.bones;
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const RigBone& b) { return b.bone == humanoid_bone; });
    if (humanoid_bone < 0 || found == all.end())
        fail(VFIT_ERROR_ARGUMENT, "no humanoid bone ", humanoid_bone);
    return static_cast<int>(found - all.begin());
}

std::vector<float> BodyModel::default_shape(vfit_sex sex) const {
    if (sex != VFIT_SEX_UNKNOWN && sex != VFIT_SEX_FEMALE && sex != VFIT_SEX_MALE)
        fail(VFIT_ERROR_ARGUMENT, "unknown sex ", sex);
    const float male = sex == VFIT_SEX_MALE ? 1.0f : sex == VFIT_SEX_FEMALE ? 0.0f : 0.5f;
    std::vector<float> shape;
    shape.reserve(data_->body.parameters.size());
    for (const ShapeParameter& p : data_->body.parameters)
        shape.push_back((1.0f - male) * p.female + male * p.male);
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

void add_steps(float* sum, const int16_t* steps, uint32_t count, float scale) {
    for (uint32_t i = 0; i < count; ++i) sum[i] += scale * static_cast<float>(steps[i]);
}

/// The base and all fields, each times its scale, over one tile.
void sum_tile(const BodyData& body, uint32_t tile, const float* scales, float* sum) {
    std::copy_n(body.base.data() + size_t(tile) * kTileFloats, kTileFloats, sum);
    for (size_t field = 0; field < body.scales.size(); ++field) {
        const size_t cell = field * body.tile_count + tile;
        const uint64_t mask = body.masks[cell];
        if (scales[field] == 0.0f || mask == 0) continue;
        const int16_t* steps = body.steps.data() + size_t(body.offsets[cell]) * kBlockFloats;
        if (mask == ~uint64_t(0)) {
            add_steps(sum, steps, kTileFloats, scales[field]);
            continue;
        }
        for (uint64_t rest = mask; rest != 0; rest &= rest - 1, steps += kBlockFloats)
            add_steps(sum + std::countr_zero(rest) * kBlockFloats, steps, kBlockFloats, scales[field]);
    }
}

/// Sums of one tile into the arrays that its points belong to.
void store_tile(const BodyData& body, uint32_t tile, const float* sum, EvaluatedBody& out) {
    const uint32_t first = tile * kTileBlocks * kLanes;
    const uint32_t count =
        std::min(kTileBlocks * kLanes, body.point_count - std::min(first, body.point_count));
    for (uint32_t i = 0; i < count; ++i) {
        const float* x = sum + (i / kLanes) * kBlockFloats + i % kLanes;
        const Vec3 p(x[0], x[kLanes], x[2 * kLanes]);
        const uint32_t point = first + i;
        if (point < body.vertex_count) {
            out.positions[point] = p;
        } else {
            const uint32_t end = point - body.vertex_count;
            (end % 2 == 0 ? out.bone_heads : out.bone_tails)[end / 2] = p;
        }
    }
}

void put_on_floor(EvaluatedBody& out) {
    float floor_y = std::numeric_limits<float>::max();
    for (const Vec3& p : out.positions) floor_y = std::min(floor_y, p.y);
    for (auto* points : {&out.positions, &out.bone_heads, &out.bone_tails})
        for (Vec3& p : *points) p.y -= floor_y;
}

}  // namespace

void BodyModel::evaluate(std::span<const float> shape, EvaluatedBody& out) const {
    const BodyData& body = data_->body;
    if (shape.size() != body.parameters.size())
        fail(VFIT_ERROR_ARGUMENT, "a shape of ", shape.size(), " values where the body has ",
             body.parameters.size());
    out.positions.resize(body.vertex_count);
    out.bone_heads.resize(body.bones.size());
    out.bone_tails.resize(body.bones.size());
    const size_t hat_count = kMaxAnchors * shape.size();
    out.scratch.resize(hat_count + body.scales.size());
    float* hats = out.scratch.data();
    float* scales = hats + hat_count;  // one a field: its coefficient times the metres of a step

    for (size_t i = 0; i < shape.size(); ++i) {
        if (!std::isfinite(shape[i]))
            fail(VFIT_ERROR_ARGUMENT, "shape value of ", body.parameters[i].key, " is not finite");
        const float value = std::clamp(shape[i], body.parameters[i].minimum, body.parameters[i].maximum);
        hat_functions(body.anchors[i], value, hats + kMaxAnchors * i);
    }
    std::fill_n(scales, body.scales.size(), 0.0f);
    for (const Term& term : body.terms) {
        float product = body.scales[term.field];
        for (uint32_t i = 0; i < term.factor_count; ++i)
            product *= hats[kMaxAnchors * term.factors[i].parameter + term.factors[i].anchor];
        scales[term.field] += product;
    }
    std::array<float, kTileFloats> sum;
    for (uint32_t tile = 0; tile < body.tile_count; ++tile) {
        sum_tile(body, tile, scales, sum.data());
        store_tile(body, tile, sum.data(), out);
    }
    put_on_floor(out);
}

const BodyTopology& BodyModel::topology(uint32_t level) const { return data_->surface.topology(level); }

void BodyModel::subdivide(uint32_t level, const std::vector<Vec3>& base, std::vector<Vec3>& out) const {
    data_->surface.subdivide(level, base, out);
}

}  // namespace vfit
