// vfit.h, part "garment and cloth".
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>

#include "api/avatar_object.h"
#include "api/guard.h"
#include "api/structs.h"
#include "cloth/cloth.h"
#include "cloth/garment/body_jump.h"
#include "cloth/garment/dress.h"
#include "cloth/garment/fit.h"
#include "cloth/garment/garment.h"
#include "cloth/garment/grown_below.h"
#include "cloth/garment/hidden_skin.h"
#include "cloth/garment/sag.h"
#include "cloth/garment/skin_below.h"
#include "core/files.h"
#include "measure/mesh_query.h"

using namespace vfit;
using namespace vfit::api;

namespace {

constexpr size_t kMaxGarmentBytes = 256u << 20;
constexpr uint32_t kMaxSubsteps = 256;

struct GarmentObject : ContextChild {
    static constexpr Kind kKind = Kind::garment;
    GarmentObject(Ref<Context> owner, Garment g, FabricMaterial m)
        : ContextChild(std::move(owner)), garment(std::move(g)), material(m) {}
    const Garment garment;
    const FabricMaterial material;

    /// To bodies of that level of detail; made when first asked for. Any thread.
    const BoundGarment& bound(uint32_t detail) const;

private:
    mutable std::mutex mutex_;
    mutable std::array<std::unique_ptr<const BoundGarment>, kCoarseBody + 1> bound_;
};

const BoundGarment& GarmentObject::bound(uint32_t detail) const {
    std::lock_guard lock(mutex_);
    std::unique_ptr<const BoundGarment>& known = bound_[detail];
    if (known) return *known;
    const auto model = context->body_model();
    EvaluatedBody body;
    model->evaluate(model->default_shape(garment.body_sex), body);
    std::vector<Vec3> positions;
    model->subdivide(detail, body.positions, positions);
    const BodyTopology& t = model->topology(detail);
    const size_t count = t.vertex_count;
    known = std::make_unique<const BoundGarment>(
        garment,
        BoundBody{positions, t.indices, std::span(t.skin_bones).first(count),
                  std::span(t.skin_weights).first(count), std::span(t.parts).first(count)},
        context->jobs.get());
    return *known;
}

FabricLibrary fabrics_of(const Context& context) {
    return FabricLibrary::parse(read_file(context.data_dir + "/fabrics.json"));
}

Ref<GarmentObject> parse(const Ref<Context>& context, std::span<const std::byte> bytes) {
    const FabricLibrary fabrics = fabrics_of(*context);
    Garment garment = parse_garment(bytes, fabrics);
    const FabricMaterial material = fabrics.get(garment.fabric);
    auto object = make<GarmentObject>(context, std::move(garment), material);
    object->bound(0);  // bodies of that detail are usual, and who changes clothes does not want to wait
    return object;
}

ClothSettings cloth_settings(const vfit_cloth_desc& d, const FabricMaterial& material, const Axes& axes) {
    for (const float x : {d.gravity[0], d.gravity[1], d.gravity[2], d.friction, d.damping, d.thickness_m,
                          d.wind[0], d.wind[1], d.wind[2], d.drag, d.lift, d.inertia, d.self_thickness_m,
                          d.budget_ms, d.cover_m, d.virtual_m, d.carry_speed_m_s, d.carry_way_m})
        if (!std::isfinite(x)) fail(VFIT_ERROR_ARGUMENT, "desc: a number is not finite");
    if (d.substeps > kMaxSubsteps)
        fail(VFIT_ERROR_ARGUMENT, "desc.substeps ", d.substeps, " is more than ", kMaxSubsteps);
    if (d.damping > 1.0f) fail(VFIT_ERROR_ARGUMENT, "desc.damping ", d.damping, " is more than 1");
    if (d.thickness_m < 0.0f || d.thickness_m > 0.1f)
        fail(VFIT_ERROR_ARGUMENT, "desc.thickness_m ", d.thickness_m, " is not in 0..0.1 m");
    ClothSettings s;
    if (d.substeps) s.substeps = d.substeps;
    if (d.gravity[0] != 0.0f || d.gravity[1] != 0.0f || d.gravity[2] != 0.0f)
        s.gravity = axes.point_in({d.gravity[0], d.gravity[1], d.gravity[2]});
    s.friction = setting(d.friction, material.friction);
    s.damping = setting(d.damping, s.damping);
    if (d.thickness_m > 0.0f) s.thickness_m = d.thickness_m;
    if (d.inertia > 1.0f) fail(VFIT_ERROR_ARGUMENT, "desc.inertia ", d.inertia, " is more than 1");
    s.inertia = setting(d.inertia, 1.0f);
    const auto limit = [](float given, float preset) {
        return given < 0.0f ? INFINITY : setting(given, preset);
    };
    s.carry_speed_m_s = limit(d.carry_speed_m_s, s.carry_speed_m_s);
    s.carry_way_m = limit(d.carry_way_m, s.carry_way_m);
    s.follows_fixed = false;
    if (d.drag < 0.0f || d.lift < 0.0f)
        fail(VFIT_ERROR_ARGUMENT, "desc.drag ", d.drag, " and lift ", d.lift, " must not be negative");
    s.air = {axes.point_in({d.wind[0], d.wind[1], d.wind[2]}), d.drag, d.lift};
    if (d.self_thickness_m < 0.0f || d.self_thickness_m > 0.1f)
        fail(VFIT_ERROR_ARGUMENT, "desc.self_thickness_m ", d.self_thickness_m, " is not in 0..0.1 m");
    s.self_thickness_m = d.self_thickness_m;
    if (d.virtual_m != 0.0f && (d.virtual_m < 0.001f || d.virtual_m > 0.1f))
        fail(VFIT_ERROR_ARGUMENT, "desc.virtual_m ", d.virtual_m, " is not in 0.001..0.1 m");
    s.virtual_m = d.virtual_m;
    constexpr float kFinestCover_m = 0.005f;
    if (d.cover_m != 0.0f && (d.cover_m < kFinestCover_m || d.cover_m > 0.1f))
        fail(VFIT_ERROR_ARGUMENT, "desc.cover_m ", d.cover_m, " is not in ", kFinestCover_m, "..0.1 m");
    if (d.budget_ms < 0.0f) fail(VFIT_ERROR_ARGUMENT, "desc.budget_ms ", d.budget_ms, " is negative");
    s.budget_ms = d.budget_ms;
    s.sleeps = (d.flags & VFIT_CLOTH_AWAKE) == 0;
    s.pressure = (d.flags & VFIT_CLOTH_PRESSURE) != 0;
    return s;
}

DressBody wearer_of(AvatarObject& object) {
    const Avatar& avatar = object.avatar;
    const BodyTopology& topology = avatar.topology();
    const size_t count = topology.vertex_count;
    return {
        {std::span(avatar.rest().positions).first(count), topology.indices, avatar.skin_bones().first(count),
         avatar.skin_weights().first(count), avatar.parts().first(count)},
        avatar.limbs(),
        object.rest_skin()};
}

/// A forearm or a hand: sphere or capsule that starts or ends at a hand.
bool of_hand(const Collider& c) {
    const auto hand = [](int joint) {
        return joint == VFIT_JOINT_LEFT_HAND || joint == VFIT_JOINT_RIGHT_HAND;
    };
    return hand(c.joint) || hand(c.joint_b);
}

SkinCover cover_of(const AvatarObject& avatar, const DressBody& body, std::span<const uint8_t> below,
                   bool with_hands, float tolerance_m) {
    std::vector<Collider> limbs;
    avatar.avatar.rest_colliders(limbs);
    if (!with_hands) std::erase_if(limbs, of_hand);
    return SkinCover(body, below, limbs, tolerance_m);
}

/// What a label means for a garment: lengths of its own, or a share of those around the avatar.
struct DressedSize {
    float ratio = 1.0f;
    const GarmentSize* own = nullptr;
};
DressedSize dressed_size(const GarmentObject& garment, const char* label, AvatarObject& avatar) {
    if (!label) return {};
    const GarmentSize& size = garment.garment.size(label);
    if (!size.flat.empty() || !garment.garment.cut_shape.empty()) return {1.0f, &size};
    return {size_ratio(garment.garment, label, avatar.measures()), nullptr};
}

/// To a tenth, for messages.
float rounded(float value) { return std::round(value * 10.0f) / 10.0f; }

/// A garment of that cut as it lies before it was simulated: does it go around the avatar with what its
/// fabric gives?
void check_wearable(const GarmentObject& garment, const char* label, const Dress& dress,
                    std::span<const Vec2> cut, AvatarObject& avatar) {
    const auto fits =
        fit_of({dress.rest(), dress.indices(), cut, garment.garment.on_arm, {}}, avatar.girth_levels());
    const GirthFit* at = nullptr;
    const float strain = needed_strain(fits, &at);
    if (strain <= garment.material.most_strain) return;
    fail(VFIT_ERROR_NOT_WEARABLE, "garment ", garment.garment.name, " does not close in size ", label, ": ",
         at->key, " of the body is ", rounded(at->body_m * 100.0f), " cm, of the garment ",
         rounded(at->garment_m * 100.0f), " cm; ", garment.garment.fabric, " stretches by at most ",
         rounded(garment.material.most_strain * 100.0f), " %");
}

struct ClothObject : ContextChild {
    static constexpr Kind kKind = Kind::cloth;
    ClothObject(Ref<AvatarObject> avatar_object, Ref<GarmentObject> garment_object, Dress d,
                std::optional<SkinBelow> skin_of_body, std::optional<SkinCover> cover_of_body,
                const ClothSettings& cloth_settings, bool hands, bool own_lengths)
        : ContextChild(avatar_object->context),
          avatar(std::move(avatar_object)),
          garment(std::move(garment_object)),
          with_hands(hands),
          dress(std::move(d)),
          skin(std::move(skin_of_body)),
          cover(std::move(cover_of_body)),
          settings(cloth_settings),
          cloth(dress.fabric(), settings, placed(), context->jobs.get()),
          output(*context) {
        time_ns = avatar->avatar.time_ns();
        stand();
        output.topology().set_indices(garment->garment.drawn_indices(), context->axes);
        output.topology().set_uvs(garment->garment.mesh.uvs, context->axes);
        if (skin) skin_mesh = cloth.add_mesh(skin->skin.vertex_count(), skin->indices);
        // Legs that close carry the fronts of a coat through each other.
        if (own_lengths || settings.self_thickness_m > 0.0f) {
            start_with_legs_apart();
            come_to_lengths(true);
        }
        publish(output.begin());
        later.task = [](void* self, uint32_t) { static_cast<ClothObject*>(self)->step(); };
        later.data = this;
    }
    ~ClothObject() override {
        try {
            if (stepping) finish();
        } catch (...) {
            // The step failed, and nobody is left to tell.
        }
    }

    const Ref<AvatarObject> avatar;
    const Ref<GarmentObject> garment;
    const bool with_hands;
    Dress dress;
    bool any_fit = false;
    std::string size_label;
    TakenUp taken_up = dress.taken_up();
    std::vector<Vec2> cut;                // of its size, one place an index
    const std::optional<SkinBelow> skin;  // of the avatar, where the cloth is kept out of it
    const std::optional<SkinCover> cover;
    const ClothSettings settings;
    std::vector<Vec3> targets, skin_places;
    Dress::Scratch scratch;
    BodyJump body{dress.carry(), dress.rest()};
    bool jumps = false;  // in the next step, however slow it is
    Cloth cloth;
    uint32_t skin_mesh = 0;
    struct Inner {
        Ref<ClothObject> cloth;
        uint32_t mesh;
        GrownBelow grown;  // while this one is put on
        uint32_t grown_mesh;
    };
    std::vector<Inner> worn_over;
    std::vector<Collider> colliders;
    MeshOutput output;

    // One step between begin and end; inputs are taken at begin, so that the avatar may move on.
    bool stepping = false;
    float dt = 0.0f;
    float carried = 0.0f;    // fraction of the body's motion in it that the cloth does not feel
    int64_t time_ns = 0;     // of the pose
    std::vector<Mat4> pose;  // of that step: skinning matrices
    Ref<Frame> next;
    Jobs::Later later;

    /// What the last finished step left, kept apart from what the one that runs works on, to be carried
    /// between steps.
    struct Finished {
        std::vector<Vec3> positions, normals;
        std::vector<float> strain, pressure;
        std::vector<Mat4> pose;
        Carry::Unposed unposed;  // made when first carried
        bool is_unposed = false;
    };
    Finished finished;
    std::vector<Vec3> carried_positions, carried_normals;

    using Reading = std::unique_ptr<Access, void (*)(Access*)>;
    static Reading reading_of(Access& access, const char* what) {
        access.begin_read(what);
        return Reading(&access, [](Access* a) { a->end_read(); });
    }
    void keep_pose() {
        const auto matrices = avatar->avatar.skinning_matrices();
        pose.assign(matrices.begin(), matrices.end());
    }
    /// The body is in the avatar's pose, and did not move there.
    void stand() {
        keep_pose();
        body.stand(pose);
        jumps = false;
    }
    const std::vector<Vec3>& placed() {
        dress.place(avatar->avatar.skinning_matrices(), targets, scratch, *context->jobs);
        return targets;
    }
    Reading read_avatar() { return reading_of(avatar->access, "avatar"); }
    /// What is met of the avatar's spheres and capsules, none where it is the skin itself, and those that
    /// fill it up.
    void limbs_of(std::span<const Mat4> matrices, std::vector<Collider>& limbs) {
        if (skin)
            limbs.clear();
        else if (!with_hands)
            std::erase_if(limbs, of_hand);
        if (cover) cover->append(matrices, limbs, scratch.bones, scratch.places, *context->jobs);
    }
    void move_skin(std::span<const Mat4> matrices) {
        if (!skin) return;
        skin->skin.carry(matrices, skin_places, scratch.bones, *context->jobs);
        avatar->avatar.creases().open(matrices, skin->creased, skin_places, *context->jobs);
        cloth.move_mesh(skin_mesh, skin_places);
    }
    /// Garments worn below, where their last step left them.
    void move_inner() {
        for (const Inner& inner : worn_over) {
            const auto reading = reading_of(inner.cloth->access, "cloth below");
            if (inner.cloth->stepping)
                fail(VFIT_ERROR_STATE, "a step of the cloth below has begun: end it first");
            cloth.move_mesh(inner.mesh, inner.cloth->cloth.positions());
        }
    }
    /// The caller reads this cloth; those below are read here, as other threads may dress them. Never ends in
    /// `other`, which the caller has for itself.
    bool is_over(const ClothObject& other) const {
        return std::any_of(worn_over.begin(), worn_over.end(), [&](const Inner& inner) {
            if (inner.cloth.get() == &other) return true;
            const auto reading = reading_of(inner.cloth->access, "cloth below");
            return inner.cloth->is_over(other);
        });
    }
    void prepare(float step_dt) {
        if (stepping) fail(VFIT_ERROR_STATE, "a step has begun already: end it first");
        if (!std::isfinite(step_dt) || step_dt < 0.0f)
            fail(VFIT_ERROR_ARGUMENT, "dt ", step_dt, " is no time");
        const auto reading = read_avatar();
        next = output.begin();
        dress.follow(avatar->avatar.skinning_matrices(), targets, scratch, *context->jobs);
        avatar->avatar.colliders(colliders);
        limbs_of(avatar->avatar.skinning_matrices(), colliders);
        move_skin(avatar->avatar.skinning_matrices());
        move_inner();
        time_ns = avatar->avatar.time_ns();
        dt = step_dt;
        if (step_dt == 0.0f) return;  // the cloth stays where the step before left it
        keep_pose();
        const float simulated_dt = std::clamp(step_dt, kMinStep_s, kMaxStep_s);
        body.move_to(pose, simulated_dt);
        jumps = jumps || settings.is_jump(body.way(), simulated_dt);
        carried = jumps ? 1.0f : 1.0f - settings.inertia;
        jumps = false;
    }
    void start_with_legs_apart() {
        std::vector<Mat4> matrices(avatar->avatar.skinning_matrices().size());
        avatar->avatar.while_closing_legs(0.0f, matrices, colliders);
        dress.place(matrices, targets, scratch, *context->jobs);
        cloth.reset(targets);
    }
    /// From how it was carried, or from another size, in the pose that the avatar has. A cloth that is new
    /// starts around legs that stand apart.
    void come_to_lengths(bool is_new) {
        move_inner();
        std::vector<Mat4> matrices(avatar->avatar.skinning_matrices().size());
        cloth.come_to_lengths(
            [&](float share, std::vector<Vec3>& places, std::vector<Collider>& limbs) {
                avatar->avatar.while_closing_legs(is_new ? share : 1.0f, matrices, limbs);
                limbs_of(matrices, limbs);
                move_skin(matrices);
                dress.place(matrices, places, scratch, *context->jobs);
            },
            *context->jobs);
    }
    /// On a body that stands straight and then goes into the avatar's pose.
    void put_on() {
        require_no_step();
        const auto reading = read_avatar();
        next = output.begin();
        time_ns = avatar->avatar.time_ns();
        stand();
        std::vector<Mat4> matrices(avatar->avatar.skinning_matrices().size());
        const auto body = [&](float share, std::vector<Vec3>& places, std::vector<Collider>& limbs) {
            avatar->avatar.while_dressing(share, matrices, limbs);
            limbs_of(matrices, limbs);
            move_skin(matrices);
            dress.place(matrices, places, scratch, *context->jobs);
        };
        for (const Inner& inner : worn_over) cloth.hide_mesh(inner.mesh);
        cloth.put_on(body, *context->jobs);
        if (worn_over.empty()) return;
        avatar->avatar.colliders(colliders);
        limbs_of(avatar->avatar.skinning_matrices(), colliders);
        placed();
        let_inner_grow();
    }
    /// What is worn below is there in the pose alone. It grows from the bones and pushes this one outwards as
    /// a whole: were it there at once, parts of this one would be inside of it and parts outside; and from
    /// the skin, a skirt would come out of two legs, between which this one hangs.
    void let_inner_grow() {
        constexpr int kGrows = 40, kSettles = 10;  // frames
        const std::vector<BoneAxis> axes = avatar->avatar.bone_axes(avatar->avatar.skinning_matrices());
        std::vector<std::vector<Vec3>> within;
        for (const Inner& inner : worn_over) {
            const auto reading = reading_of(inner.cloth->access, "cloth below");
            within.push_back(inner.cloth->dress.carry().on_axes(axes, inner.cloth->cloth.positions()));
        }
        std::vector<Vec3> places;
        for (int frame = 1; frame <= kGrows + kSettles; ++frame) {
            for (size_t i = 0; i < worn_over.size() && frame <= kGrows; ++i) {
                const auto reading = reading_of(worn_over[i].cloth->access, "cloth below");
                worn_over[i].grown.place(worn_over[i].cloth->cloth.positions(), within[i],
                                         float(frame) / float(kGrows), places);
                cloth.move_mesh(worn_over[i].grown_mesh, places);
            }
            if (frame > kGrows) move_inner();
            cloth.step(1.0f / 60.0f, targets, colliders, *context->jobs);
            for (const Inner& inner : worn_over)
                if (frame == kGrows) cloth.hide_mesh(inner.grown_mesh);
        }
    }
    void step() {
        Profile::Scope time(context->profile, Stage::cloth);
        if (dt > 0.0f) carry_along();
        cloth.step(dt, targets, colliders, *context->jobs);
    }
    void carry_along() {
        if (!body.moves() || (carried == 0.0f && !body.follows_jump())) return;
        body.carry(cloth.positions(), carried, *context->jobs);
        cloth.carry_along({carried, body.places(), body.turns(), body.speeds(), body.is_rigid()});
    }
    /// From the pose of the last step.
    void jump_to_pose() {
        const std::span<const Mat4> matrices = avatar->avatar.skinning_matrices();
        body.move_to(matrices, kMaxStep_s);
        carried = 1.0f;
        carry_along();
        body.stand(matrices);
    }
    void finish() {
        stepping = false;
        context->jobs->end(later);
    }
    /// What the step that has just ended left.
    void publish(Ref<Frame> frame) {
        // Of the same sizes each time: nothing is allocated but at first.
        finished.positions = cloth.positions();
        finished.normals = cloth.normals();
        finished.strain = cloth.strain();
        if (settings.pressure) finished.pressure = cloth.pressure();
        finished.pose = pose;
        finished.is_unposed = false;
        fill(*frame, finished.positions, finished.normals, time_ns);
        output.publish(std::move(frame));
    }
    /// The last finished step, in the pose that the avatar has now.
    void carry() {
        const auto reading = read_avatar();
        Ref<Frame> frame = output.begin();
        const Carry& by = dress.carry();
        if (!finished.is_unposed)
            by.take_out(finished.pose, finished.positions, finished.normals, finished.unposed,
                        *context->jobs);
        finished.is_unposed = true;
        carried_positions.resize(by.vertex_count());
        carried_normals.resize(by.vertex_count());
        by.put_in(avatar->avatar.skinning_matrices(), finished.unposed, carried_positions, carried_normals,
                  *context->jobs);
        fill(*frame, carried_positions, carried_normals, avatar->avatar.time_ns());
        output.publish(std::move(frame));
    }
    void fill(Frame& frame, const std::vector<Vec3>& positions, const std::vector<Vec3>& normals,
              int64_t pose_time_ns) const {
        const uint32_t count = garment->garment.drawn_count();
        const auto vertices = output.add_vertices(frame, count, pose_time_ns);
        const Axes& axes = context->axes;
        for_drawn(positions, vertices.positions, [&](const Vec3& p) { return axes.point_out(p); });
        for_drawn(normals, vertices.normals, [&](const Vec3& n) { return axes.direction_out(n); });
        const auto add = [&](vfit_stream stream, const std::vector<float>& values) {
            for_drawn(values, static_cast<float*>(frame.add_stream(stream, VFIT_FORMAT_F32, count, 1)),
                      [](float x) { return x; });
        };
        add(VFIT_STREAM_STRAIN, finished.strain);
        if (settings.pressure) add(VFIT_STREAM_PRESSURE, finished.pressure);
    }
    /// One value a vertex that is drawn, of one a simulated vertex: copies have that of theirs.
    template <typename T, typename Out>
    void for_drawn(const std::vector<T>& values, T* to, Out&& out) const {
        for (const T& value : values) *to++ = out(value);
        for (const uint32_t of : garment->garment.copies) *to++ = out(values[of]);
    }
    /// Once it has come to its lengths, which are more than girths: armholes, neck, crotch.
    void check_not_drawn(const char* label) const {
        const CrotchLine crotch =
            crotch_line({dress.rest(), dress.indices(), cut, {}, {}}, cloth.positions());
        const float crotch_gives = std::max(kCrotchGives, garment->material.most_strain);
        if (crotch.strain > crotch_gives)
            fail(VFIT_ERROR_NOT_WEARABLE, "garment ", garment->garment.name, " is too small in size ", label,
                 ": its ", rounded(crotch.garment_m * 100.0f),
                 " cm from front to back through the crotch would be stretched by ",
                 rounded(crotch.strain * 100.0f), " %; ", garment->garment.fabric, " stretches by at most ",
                 rounded(crotch_gives * 100.0f), " % there");
        const float strain = most_strained(cloth.strain()), most = kDrawn * garment->material.most_strain;
        if (strain > most)
            fail(VFIT_ERROR_NOT_WEARABLE, "garment ", garment->garment.name, " is too small in size ", label,
                 ": a tenth of it would be stretched by more than ", rounded(strain * 100.0f), " %; ",
                 garment->garment.fabric, " stretches by at most ", rounded(most * 100.0f), " %");
        std::vector<uint8_t> counts = garment->garment.simulated;
        for (const LimbHem& hem : dress.hems())
            for (const uint32_t v : hem.vertices) counts[v] = 0;
        const Opening opening =
            tightest_opening({cloth.positions(), dress.indices(), cut, garment->garment.on_arm, {}}, counts);
        const float gives = std::max(kOpeningGives, garment->material.most_strain);
        if (opening.strain > gives)
            fail(VFIT_ERROR_NOT_WEARABLE, "garment ", garment->garment.name, " is too small in size ", label,
                 ": its opening of ", opening.garment_m * 100.0f, " cm at ", opening.middle.y * 100.0f,
                 " cm of height would be stretched by ", opening.strain * 100.0f, " %; ",
                 garment->garment.fabric, " gives ", gives * 100.0f, " % there");
    }
    /// The same garment in other lengths, from how it hangs now.
    void change_size(const char* label_text) {
        require_no_step();
        const DressedSize size = dressed_size(*garment, label_text, *avatar);
        std::vector<Vec2> new_cut = dress.cut(garment->garment, size.ratio, size.own);
        if (label_text && !any_fit) check_wearable(*garment, label_text, dress, new_cut, *avatar);
        TakenUp taken;
        Cloth resized = cloth.with_fabric(dress.fabric_of(garment->garment, garment->material, size.ratio,
                                                          size.own, &taken, context->jobs.get()),
                                          context->jobs.get());
        std::swap(cloth, resized);
        std::swap(cut, new_cut);
        try {
            const auto reading = read_avatar();
            jump_to_pose();
            come_to_lengths(false);
            if (size.own && !any_fit) check_not_drawn(label_text);
        } catch (...) {
            cloth = std::move(resized);
            cut = std::move(new_cut);
            body.stand(pose);
            throw;
        }
        taken_up = taken;
        size_label = label_text ? label_text : "";
    }
    /// The cloth as its last step left it, with the pose taken out.
    struct Worn {
        Carry::Unposed unposed;
        WornGarment view(const ClothObject& of) const {
            return {unposed.positions, of.dress.indices(), of.cut, of.garment->garment.on_arm,
                    of.settings.pressure ? std::span<const float>(of.finished.pressure)
                                         : std::span<const float>()};
        }
    };
    Worn worn() const {
        Worn out;
        dress.carry().take_out(finished.pose, finished.positions, finished.normals, out.unposed,
                               *context->jobs);
        return out;
    }
    void require_no_step() const {
        if (stepping) fail(VFIT_ERROR_STATE, "a step is running: end it first");
    }
};

}  // namespace

vfit_result vfit_garment_list(vfit_context handle, vfit_data_name* items, uint32_t stride, uint32_t* count) {
    return guard([&] {
        UseContext<Mode::any> context(handle);
        return write_data_names(data_names(context->data_dir, "garments"), items, stride, count);
    });
}

vfit_result vfit_garment_load(vfit_context handle, const void* bytes, uint64_t byte_count,
                              vfit_garment* out) {
    return guard([&] {
        check_pointer(out, "out");
        out->id = 0;
        UseContext<Mode::any> context(handle);
        check_pointer(bytes, "bytes");
        if (byte_count > kMaxGarmentBytes)
            fail(VFIT_ERROR_ARGUMENT, "byte_count ", byte_count, " is too large");
        const std::span<const std::byte> span(static_cast<const std::byte*>(bytes),
                                              static_cast<size_t>(byte_count));
        out->id = context->publish(Kind::garment, parse(context.ref(), span));
        return VFIT_OK;
    });
}

vfit_result vfit_garment_open(vfit_context handle, const char* name, vfit_garment* out) {
    return guard([&] {
        check_pointer(out, "out");
        out->id = 0;
        UseContext<Mode::any> context(handle);
        check_pointer(name, "name");
        const auto bytes = read_file(data_file(context->data_dir, "garments", name), kMaxGarmentBytes);
        out->id = context->publish(Kind::garment, parse(context.ref(), bytes));
        return VFIT_OK;
    });
}

vfit_result vfit_garment_destroy(vfit_garment garment) {
    return guard([&] {
        destroy<GarmentObject>(garment.id);
        return VFIT_OK;
    });
}

vfit_result vfit_garment_describe(vfit_garment handle, vfit_garment_info* out) {
    return guard([&] {
        Use<GarmentObject, Mode::read> garment(handle.id);
        check_output(out, "out");
        const Garment& g = garment->garment;
        vfit_garment_info info{};
        info.vertex_count = g.vertex_count();
        info.simulated_count = g.simulated_count();
        info.size_count = static_cast<uint32_t>(g.sizes.size());
        set_text(info.name, g.name);
        set_text(info.garment_kind, g.kind);
        set_text(info.fabric, g.fabric);
        set_text(info.size_chart, g.size_chart);
        info.body_sex = g.body_sex;
        write(out, info);
        return VFIT_OK;
    });
}

uint32_t vfit_garment_size_label(vfit_garment handle, uint32_t index, char* buffer, uint32_t capacity) {
    uint32_t length = 0;
    const vfit_result result = guard([&] {
        Use<GarmentObject, Mode::read> garment(handle.id);
        const auto& sizes = garment->garment.sizes;
        const std::string label = index < sizes.size() ? sizes[index].label : "";
        length = write_text(label.data(), label.size(), buffer, capacity);
        return VFIT_OK;
    });
    if (result != VFIT_OK) write_text("", 0, buffer, capacity);
    return length;
}

vfit_result vfit_garment_parts(vfit_garment handle, vfit_garment_part* items, uint32_t stride,
                               uint32_t* count) {
    return guard([&] {
        Use<GarmentObject, Mode::read> garment(handle.id);
        const Garment& g = garment->garment;
        // A garment that tells of none is one, of one look.
        const std::vector<GarmentPart> whole{
            {"", "", GarmentPart().color, 0, uint32_t(g.mesh.indices.size() / 3)}};
        const std::vector<GarmentPart>& parts = g.parts.empty() ? whole : g.parts;
        return write_list(items, stride, count, parts.size(), [&](size_t i) {
            vfit_garment_part part{};
            part.first_index = 3 * parts[i].first_triangle;
            part.index_count = 3 * parts[i].triangle_count;
            for (int k = 0; k < 3; ++k) part.color[k] = parts[i].color[k];
            set_text(part.material, parts[i].material);
            set_text(part.texture, parts[i].texture);
            return part;
        });
    });
}

vfit_result vfit_cloth_create(vfit_avatar avatar_handle, vfit_garment garment_handle,
                              const vfit_cloth_desc* desc, vfit_cloth* out) {
    return guard([&] {
        check_pointer(out, "out");
        out->id = 0;
        Use<AvatarObject, Mode::exclusive> avatar(avatar_handle.id);
        Use<GarmentObject, Mode::read> garment(garment_handle.id);
        if (avatar->context != garment->context)
            fail(VFIT_ERROR_HANDLE, "avatar and garment belong to different contexts");
        const vfit_cloth_desc d = read_or_default(desc, "desc");
        check_flags(d.flags,
                    VFIT_CLOTH_NO_HANDS | VFIT_CLOTH_SKIN | VFIT_CLOTH_AWAKE | VFIT_CLOTH_PRESSURE |
                        VFIT_CLOTH_ANY_FIT,
                    "desc.flags");
        const ClothSettings settings = cloth_settings(d, garment->material, avatar->context->axes);
        // Forearms that pass through would leave their sleeves.
        const bool hands = (d.flags & VFIT_CLOTH_NO_HANDS) == 0 || garment->garment.has_sleeves();
        if (!avatar->is_body())
            fail(VFIT_ERROR_UNSUPPORTED,
                 "garments are made for vfit's own body, not for a character from a file");
        const DressBody wearer = wearer_of(*avatar);
        const DressedSize size = dressed_size(*garment, d.size_label, *avatar);
        Dress dress(garment->garment, garment->bound(avatar->detail), garment->material, wearer, size.ratio,
                    settings.thickness_m, size.own, avatar->context->jobs.get());
        std::vector<Vec2> cut = dress.cut(garment->garment, size.ratio, size.own);
        const bool any_fit = (d.flags & VFIT_CLOTH_ANY_FIT) != 0;
        if (d.size_label && !any_fit) check_wearable(*garment, d.size_label, dress, cut, *avatar);
        std::optional<SkinBelow> skin;
        std::optional<SkinCover> cover;
        const bool on_skin = (d.flags & VFIT_CLOTH_SKIN) != 0;
        if (on_skin && d.cover_m > 0.0f)
            fail(VFIT_ERROR_ARGUMENT, "desc.cover_m is of no use with VFIT_CLOTH_SKIN");
        if (on_skin || d.cover_m > 0.0f) {
            const std::vector<uint8_t> below =
                below_garment(wearer, dress.rest(), {hands, (d.flags & VFIT_CLOTH_NO_HANDS) == 0});
            if (on_skin)
                skin = skin_below(wearer, avatar->wrapped_rest(), below, avatar->avatar.creases());
            else
                cover = cover_of(*avatar, wearer, below, hands, d.cover_m);
        }
        auto cloth = make<ClothObject>(avatar.ref(), garment.ref(), std::move(dress), std::move(skin),
                                       std::move(cover), settings, hands, size.own != nullptr);
        cloth->any_fit = any_fit;
        cloth->size_label = d.size_label ? d.size_label : "";
        cloth->cut = std::move(cut);
        if (size.own && !any_fit) cloth->check_not_drawn(d.size_label);
        out->id = avatar->context->publish(Kind::cloth, cloth, avatar_handle.id);
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_destroy(vfit_cloth cloth) {
    return guard([&] {
        destroy<ClothObject>(cloth.id);
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_reset(vfit_cloth handle) {
    return guard([&] {
        Use<ClothObject, Mode::exclusive> cloth(handle.id);
        cloth->put_on();
        cloth->publish(std::move(cloth->next));
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_step(vfit_cloth handle, float dt) {
    return guard([&] {
        Use<ClothObject, Mode::exclusive> cloth(handle.id);
        cloth->prepare(dt);
        cloth->step();
        cloth->publish(std::move(cloth->next));
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_begin_step(vfit_cloth handle, float dt) {
    return guard([&] {
        Use<ClothObject, Mode::exclusive> cloth(handle.id);
        cloth->prepare(dt);
        cloth->stepping = true;
        cloth->context->jobs->begin(cloth->later);
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_end_step(vfit_cloth handle) {
    return guard([&] {
        Use<ClothObject, Mode::exclusive> cloth(handle.id);
        if (!cloth->stepping) fail(VFIT_ERROR_STATE, "no step has begun");
        cloth->finish();
        cloth->publish(std::move(cloth->next));
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_set_size(vfit_cloth handle, const char* size_label) {
    return guard([&] {
        Use<ClothObject, Mode::exclusive> cloth(handle.id);
        cloth->change_size(size_label);
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_carry(vfit_cloth handle) {
    return guard([&] {
        Use<ClothObject, Mode::exclusive> cloth(handle.id);
        cloth->carry();
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_teleport(vfit_cloth handle) {
    return guard([&] {
        Use<ClothObject, Mode::exclusive> cloth(handle.id);
        cloth->jumps = true;  // a step that runs has taken its pose
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_set_wind(vfit_cloth handle, const float wind[3]) {
    return guard([&] {
        Use<ClothObject, Mode::exclusive> cloth(handle.id);
        check_pointer(wind, "wind");
        cloth->require_no_step();
        cloth->cloth.set_air({cloth->context->axes.point_in({wind[0], wind[1], wind[2]}),
                              cloth->settings.air.drag, cloth->settings.air.lift});
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_set_quality(vfit_cloth handle, uint32_t substeps, float budget_ms) {
    return guard([&] {
        Use<ClothObject, Mode::exclusive> cloth(handle.id);
        cloth->require_no_step();
        if (substeps > kMaxSubsteps)
            fail(VFIT_ERROR_ARGUMENT, "substeps ", substeps, " is more than ", kMaxSubsteps);
        cloth->cloth.set_quality(substeps ? substeps : ClothSettings().substeps, budget_ms);
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_wear_over(vfit_cloth handle, vfit_cloth inner_handle) {
    return guard([&] {
        Use<ClothObject, Mode::exclusive> cloth(handle.id);
        cloth->require_no_step();
        if (handle.id == inner_handle.id) fail(VFIT_ERROR_ARGUMENT, "a cloth cannot be worn over itself");
        Use<ClothObject, Mode::read> inner(inner_handle.id);
        if (inner->avatar.get() != cloth->avatar.get())
            fail(VFIT_ERROR_ARGUMENT, "both cloths must be of the same avatar");
        if (inner->is_over(*cloth)) fail(VFIT_ERROR_ARGUMENT, "inner is worn over cloth already");
        for (const auto& below : cloth->worn_over)
            if (below.cloth.get() == inner.ref().get()) return VFIT_OK;
        cloth->dress.lift_over(inner->dress, cloth->settings.thickness_m);
        GrownBelow grown(inner->cloth.positions().size(), inner->dress.indices());
        const uint32_t mesh =
            cloth->cloth.add_mesh(inner->cloth.positions().size(), inner->dress.indices(), {}, MeshOf::cloth);
        const uint32_t grown_mesh =
            cloth->cloth.add_mesh(grown.vertex_count(), grown.indices(), {}, MeshOf::coming_cloth);
        cloth->worn_over.push_back({inner.ref(), mesh, std::move(grown), grown_mesh});
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_hide_skin(vfit_cloth handle, float margin_m, uint8_t* triangles, uint32_t count) {
    return guard([&] {
        Use<ClothObject, Mode::read> cloth(handle.id);
        check_pointer(triangles, "triangles");
        cloth->require_no_step();
        if (!std::isfinite(margin_m) || margin_m < 0.0f)
            fail(VFIT_ERROR_ARGUMENT, "margin_m ", margin_m, " is no distance");
        constexpr float kUsualMargin_m = 0.03f;
        const Avatar& avatar = cloth->avatar->avatar;
        const BodyTopology& topology = avatar.topology();
        if (count != topology.indices.size() / 3)
            fail(VFIT_ERROR_ARGUMENT, "count is ", count, ", the avatar has ", topology.indices.size() / 3,
                 " triangles");
        // In a size it may end elsewhere than where it would be made to.
        const ClothObject::Worn worn = cloth->size_label.empty() ? ClothObject::Worn() : cloth->worn();
        const auto hidden = hidden_triangles(
            {std::span(avatar.rest().positions).first(topology.vertex_count), topology.indices,
             worn.unposed.positions.empty() ? cloth->dress.rest() : worn.unposed.positions,
             cloth->dress.indices()},
            margin_m > 0.0f ? margin_m : kUsualMargin_m, *cloth->context->jobs);
        for (size_t i = 0; i < hidden.size(); ++i)
            if (hidden[i]) triangles[i] = 1;
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_fit(vfit_cloth handle, vfit_fit_zone* items, uint32_t stride, uint32_t* count) {
    return guard([&] {
        Use<ClothObject, Mode::read> cloth(handle.id);
        cloth->require_no_step();
        const Garment& garment = cloth->garment->garment;
        const auto worn = cloth->worn();
        WornGarment view = worn.view(*cloth);
        const std::vector<Vec3> raised = without_sag(
            view, garment.simulated, {std::max(0.0f, -cloth->settings.gravity.y), cloth->cloth.substep_s()});
        view.positions = raised;
        const auto fits = fit_of(view, cloth->avatar->girth_levels());
        return write_list(items, stride, count, fits.size(), [&](size_t i) {
            const GirthFit& fit = fits[i];
            const Fit verdict = judge_fit(garment, cloth->size_label, fit);
            vfit_fit_zone zone{};
            zone.fit = verdict == Fit::tight   ? VFIT_FIT_TIGHT
                       : verdict == Fit::loose ? VFIT_FIT_LOOSE
                                               : VFIT_FIT_RIGHT;
            zone.body_m = fit.body_m;
            zone.garment_m = fit.garment_m;
            zone.ease_m = fit.ease_m;
            zone.strain = fit.strain;
            zone.pressure_pa = fit.pressure_pa;
            zone.opening_m = fit.opening_m;
            set_text(zone.key, fit.key);
            return zone;
        });
    });
}

vfit_result vfit_cloth_fit_map(vfit_cloth handle, float* values, uint32_t count) {
    return guard([&] {
        Use<ClothObject, Mode::read> cloth(handle.id);
        check_pointer(values, "values");
        cloth->require_no_step();
        const Garment& garment = cloth->garment->garment;
        if (count != garment.drawn_count())
            fail(VFIT_ERROR_ARGUMENT, "count is ", count, ", the garment has ", garment.drawn_count(),
                 " vertices");
        const auto tightness = tightness_of(cloth->worn().view(*cloth), cloth->cloth.strain(),
                                            cloth->garment->material.most_strain, cloth->avatar->rest_skin());
        cloth->for_drawn(tightness, values, [](float x) { return x; });
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_acquire(vfit_cloth handle, vfit_frame* out) {
    return guard([&] {
        check_pointer(out, "out");
        out->id = 0;
        Use<ClothObject, Mode::any> cloth(handle.id);
        out->id = cloth->context->publish(Kind::frame, cloth->output.latest());
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_describe(vfit_cloth handle, vfit_cloth_stats* out) {
    return guard([&] {
        Use<ClothObject, Mode::read> cloth(handle.id);
        check_output(out, "out");
        cloth->require_no_step();
        const ClothStats s = cloth->cloth.stats();
        vfit_cloth_stats stats{};
        stats.vertex_count = s.vertex_count;
        stats.simulated_count = s.simulated_count;
        stats.constraint_count = s.constraint_count;
        stats.strain_mean = s.strain_mean;
        stats.strain_p99 = s.strain_p99;
        stats.strain_max = s.strain_max;
        stats.step_ms = s.step_ms;
        stats.substeps = s.substeps;
        stats.sleeves_taken_up_m = cloth->taken_up.sleeves_m;
        stats.legs_taken_up_m = cloth->taken_up.legs_m;
        stats.collider_count = uint32_t(cloth->colliders.size());
        write(out, stats);
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_state_hash(vfit_cloth handle, uint64_t* out) {
    return guard([&] {
        Use<ClothObject, Mode::read> cloth(handle.id);
        check_pointer(out, "out");
        cloth->require_no_step();
        *out = cloth->cloth.state_hash();
        return VFIT_OK;
    });
}
