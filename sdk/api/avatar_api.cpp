// vfit.h, part "avatar".
#include <cmath>

#include "anthropometry/own_measures.h"
#include "api/avatar_object.h"
#include "api/bodies.h"
#include "api/guard.h"
#include "api/measurements.h"
#include "api/scan_object.h"
#include "avatar/gltf_document.h"
#include "body/shape_setting.h"
#include "scan/scanned_body.h"

using namespace vfit;
using namespace vfit::api;

namespace {

constexpr uint32_t kMaxDetail = kCoarseBody;
// Scales beyond these are no people: a wrong unit, or a scan gone wrong.
constexpr float kMinScale = 0.3f, kMaxScale = 2.0f;

AvatarDesc avatar_desc(const vfit_avatar_desc* desc) {
    const vfit_avatar_desc d = read_or_default(desc, "desc");
    check_flags(d.flags,
                VFIT_AVATAR_PAPER_COLLIDERS | VFIT_AVATAR_SINGLE_BONES | VFIT_AVATAR_DUAL_QUATERNIONS |
                    VFIT_AVATAR_LIMBS_AS_POSED,
                "desc.flags");
    check_enum(d.sex, VFIT_SEX_MALE, "desc.sex");
    if (d.detail > kMaxDetail)
        fail(VFIT_ERROR_ARGUMENT, "desc.detail ", d.detail, " is more than ", kMaxDetail);
    AvatarDesc out;
    out.sex = d.sex;
    out.limbs_clear = (d.flags & VFIT_AVATAR_LIMBS_AS_POSED) == 0;
    out.detail = d.detail;
    out.single_bones = (d.flags & VFIT_AVATAR_SINGLE_BONES) != 0;
    if ((d.flags & VFIT_AVATAR_DUAL_QUATERNIONS) != 0) out.skinning = SkinMethod::dual_quaternion;
    out.paper_colliders = (d.flags & VFIT_AVATAR_PAPER_COLLIDERS) != 0;
    return out;
}

float scale_of(const char* what, float measured, float nominal) {
    const float scale = measured / nominal;
    if (!(scale >= kMinScale && scale <= kMaxScale))
        fail(VFIT_ERROR_DATA, what, " of ", measured, " m cannot be reached from a body of ", nominal, " m");
    return scale;
}

/// Algorithm 3 applied to the body: the default body's own height and shoulder breadth are the nominal ones.
Vec2 scale_to(Context& context, vfit_sex sex, const std::vector<Measurement>& measured) {
    const auto& nominal = context.default_measures(sex);
    const Measurement* stature = find(measured, "stature_m");
    const Measurement* breadth = find(measured, "shoulder_breadth_m");
    if (!stature) fail(VFIT_ERROR_DATA, "stature_m is not among the measurements");
    Vec2 scale;
    scale.y = scale_of("stature_m", stature->value, find(nominal, "stature_m")->value);
    // Without a breadth the body keeps its proportions.
    scale.x = breadth
                  ? scale_of("shoulder_breadth_m", breadth->value, find(nominal, "shoulder_breadth_m")->value)
                  : scale.y;
    return scale;
}

/// The largest relative deviation of the girths and lengths that clothes are made by.
float least_sure(const std::vector<Measurement>& measured) {
    float out = 0.0f;
    for (const char* key :
         {"chest_girth_m", "waist_girth_m", "hip_girth_m", "thigh_girth_m", "upper_arm_girth_m",
          "inside_leg_m", "arm_length_m", "stature_m", "shoulder_breadth_m"})
        if (const Measurement* m = find(measured, key)) out = std::max(out, m->sigma / m->value);
    return out;
}

/// The fitted body where there is one that has the form of a person, else the default one in the person's
/// size.
ScannedBody body_of(Context& context, const PersonScan& scan, const std::vector<Measurement>& measured,
                    vfit_sex sex) {
    if (const FitShape* shape = scan.fitted_shape()) {
        try {
            return scanned_body(context.body_model(), *context.fit_model().get(), *shape, measured, sex);
        } catch (const Error& error) {
            if (error.code() != VFIT_ERROR_DATA) throw;
            context.log.info("the avatar has the default body's shape: ", error.what());
        }
    }
    return {{}, scale_to(context, sex, measured)};
}

struct VertexTarget {
    void* data;
    size_t stride;
};

/// Memory of the host for that many vectors, checked.
VertexTarget vertex_target(const vfit_target* target, uint32_t count, const char* name) {
    const vfit_target t = read(target, name);
    constexpr uint64_t kSize = 3 * sizeof(float);
    if (t.format != VFIT_FORMAT_NONE && t.format != VFIT_FORMAT_F32X3)
        fail(VFIT_ERROR_UNSUPPORTED, name, ": vertices are written as three floats, not as format ",
             t.format);
    check_pointer(t.data, name);
    const uint64_t stride = t.item_stride ? t.item_stride : kSize;
    if (stride < kSize) fail(VFIT_ERROR_ARGUMENT, name, ": item_stride ", stride, " is less than ", kSize);
    const uint64_t need = (count - 1) * stride + kSize;
    if (t.capacity < need)
        fail(VFIT_ERROR_CAPACITY, name, ": ", t.capacity, " bytes, ", need, " are needed for ", count,
             " vertices");
    return {t.data, size_t(stride)};
}

void publish(Context& context, const Ref<AvatarObject>& avatar, vfit_avatar* out) {
    out->id = context.publish(Kind::avatar, avatar);
}

vfit_result acquire(const Ref<Frame>& frame, Context& context, vfit_frame* out) {
    out->id = context.publish(Kind::frame, frame);
    return VFIT_OK;
}

}  // namespace

vfit_result vfit_shape_list(vfit_context handle, vfit_shape_value* items, uint32_t stride, uint32_t* count) {
    return guard([&] {
        UseContext<Mode::any> context(handle);
        const auto model = context->body_model();
        const auto& parameters = model->parameters();
        const std::vector<float> halfway = model->default_shape(VFIT_SEX_UNKNOWN);
        return write_list(items, stride, count, parameters.size(), [&](size_t i) {
            vfit_shape_value v{};
            v.value = halfway[i];
            v.minimum = parameters[i].minimum;
            v.maximum = parameters[i].maximum;
            set_text(v.key, parameters[i].key);
            return v;
        });
    });
}

vfit_result vfit_avatar_create_from_shape(vfit_context handle, const vfit_avatar_desc* desc,
                                          const vfit_shape_value* items, uint32_t stride, uint32_t count,
                                          vfit_avatar* out) {
    return guard([&] {
        check_pointer(out, "out");
        out->id = 0;
        UseContext<Mode::any> context(handle);
        const AvatarDesc d = avatar_desc(desc);
        const auto model = context->body_model();
        const Items<vfit_shape_value> values(items, stride, count, "items");
        std::vector<ShapeSetting> settings;
        for (uint32_t i = 0; i < values.size(); ++i) {
            const vfit_shape_value v = values[i];
            settings.push_back({get_text(v.key), v.value});
        }
        const std::vector<float> shape = shape_of(*model, d.sex, settings);
        publish(*context, make<AvatarObject>(context.ref(), d, shape, Vec2(1.0f)), out);
        return VFIT_OK;
    });
}

vfit_result vfit_avatar_create(vfit_context handle, const vfit_avatar_desc* desc,
                               const vfit_measurement* items, uint32_t stride, uint32_t count,
                               vfit_avatar* out) {
    return guard([&] {
        check_pointer(out, "out");
        out->id = 0;
        UseContext<Mode::any> context(handle);
        const AvatarDesc d = avatar_desc(desc);
        const Vec2 scale = scale_to(*context, d.sex, measurements_in(items, stride, count));
        publish(*context, make<AvatarObject>(context.ref(), d, std::span<const float>{}, scale), out);
        return VFIT_OK;
    });
}

vfit_result vfit_avatar_create_from_scan(vfit_context handle, const vfit_avatar_desc* desc,
                                         vfit_scan scan_handle, vfit_avatar* out) {
    return guard([&] {
        check_pointer(out, "out");
        out->id = 0;
        UseContext<Mode::any> context(handle);
        Use<ScanObject, Mode::read> scan(scan_handle.id);
        AvatarDesc d = avatar_desc(desc);
        const std::vector<Measurement> measured = scan->scan.measurements();
        if (d.sex == VFIT_SEX_UNKNOWN) d.sex = scan->scan.likely_sex();
        const ScannedBody body = body_of(*context, scan->scan, measured, d.sex);
        auto avatar = make<AvatarObject>(context.ref(), d, body.shape, body.scale);
        avatar->relative_sigma = least_sure(measured);
        avatar->set_collider_radii(scan->scan.paper().radii());
        publish(*context, avatar, out);
        return VFIT_OK;
    });
}

vfit_result vfit_avatar_load(vfit_context handle, const vfit_avatar_desc* desc,
                             const vfit_character_desc* character, vfit_avatar* out) {
    return guard([&] {
        constexpr float kLeastScale = 1e-5f;
        check_pointer(out, "out");
        out->id = 0;
        UseContext<Mode::any> context(handle);
        AvatarDesc d = avatar_desc(desc);
        const vfit_character_desc c = read(character, "character");
        if (c.scale != 0.0f && !(c.scale >= kLeastScale && c.scale <= 1.0f / kLeastScale))
            fail(VFIT_ERROR_ARGUMENT, "character: a scale of ", c.scale, " m in a unit of the file");
        if (!c.path == !c.bytes) fail(VFIT_ERROR_ARGUMENT, "character: either path or bytes must be given");
        const GltfDocument document =
            c.path ? GltfDocument(std::string(c.path))
                   : GltfDocument({static_cast<const std::byte*>(c.bytes), size_t(c.byte_count)});
        Character loaded =
            load_character(document, c.bone_map ? c.bone_map : "", c.scale == 0.0f ? 1.0f : c.scale);
        for (const std::string& note : loaded.notes)
            context->log.info(c.path ? c.path : "character", ": ", note);
        publish(*context, make<AvatarObject>(context.ref(), d, std::move(loaded)), out);
        return VFIT_OK;
    });
}

vfit_result vfit_avatar_describe(vfit_avatar handle, vfit_character_info* out) {
    return guard([&] {
        Use<AvatarObject, Mode::read> avatar(handle.id);
        check_output(out, "out");
        vfit_character_info info{};
        info.kind =
            avatar->is_body() ? VFIT_CHARACTER_BODY : VFIT_CHARACTER_GLTF + int(avatar->character.kind);
        info.vertex_count = uint32_t(avatar->avatar.rest().positions.size());
        info.index_count = uint32_t(avatar->avatar.rest().indices.size());
        info.bone_count = uint32_t(avatar->avatar.rig_bones().size());
        info.part_count = uint32_t(avatar->parts().size());
        info.stature_m = avatar->avatar.stature();
        std::memcpy(info.from_file, &avatar->character.from_file[0][0], sizeof info.from_file);
        set_text(info.name, avatar->character.name);
        write(out, info);
        return VFIT_OK;
    });
}

vfit_result vfit_avatar_parts(vfit_avatar handle, vfit_avatar_part* items, uint32_t stride, uint32_t* count) {
    return guard([&] {
        Use<AvatarObject, Mode::read> avatar(handle.id);
        const auto parts = avatar->parts();
        return write_list(items, stride, count, parts.size(), [&](size_t i) {
            vfit_avatar_part part{};
            part.first_index = parts[i].first_index;
            part.index_count = parts[i].index_count;
            part.material = parts[i].material_index;
            set_text(part.mesh, parts[i].mesh);
            set_text(part.material_name, parts[i].material);
            return part;
        });
    });
}

vfit_result vfit_avatar_pack(vfit_avatar handle, const char* size_label, void* bytes, uint32_t* byte_count) {
    return guard([&] {
        Use<AvatarObject, Mode::read> avatar(handle.id);
        if (!avatar->is_body())
            fail(VFIT_ERROR_UNSUPPORTED, "a character from a file is no body that could be packed");
        PackedBody body = avatar->body;
        body.radii = avatar->radii;
        body.size_label = size_label ? size_label : "";
        const std::vector<uint8_t> packed = pack_body(*avatar->context->body_model(), body);
        return write_bytes(packed.data(), packed.size(), bytes, byte_count);
    });
}

vfit_result vfit_avatar_unpack(vfit_context handle, const vfit_avatar_desc* desc, const void* bytes,
                               uint32_t byte_count, char* size_label, uint32_t capacity, vfit_avatar* out) {
    return guard([&] {
        check_pointer(out, "out");
        out->id = 0;
        UseContext<Mode::any> context(handle);
        AvatarDesc d = avatar_desc(desc);
        check_pointer(bytes, "bytes");
        const PackedBody body =
            unpack_body(*context->body_model(), {static_cast<const uint8_t*>(bytes), byte_count});
        d.sex = body.sex;
        auto avatar = make<AvatarObject>(context.ref(), d, body.shape, body.scale);
        avatar->set_collider_radii(body.radii);
        write_text(body.size_label.data(), body.size_label.size(), size_label, capacity);
        publish(*context, avatar, out);
        return VFIT_OK;
    });
}

vfit_result vfit_avatar_destroy(vfit_avatar avatar) {
    return guard([&] {
        destroy<AvatarObject>(avatar.id);
        return VFIT_OK;
    });
}

vfit_result vfit_avatar_pose(vfit_avatar handle, const vfit_pose* pose, const vfit_bone* items,
                             uint32_t stride, uint32_t count) {
    return guard([&] {
        Use<AvatarObject, Mode::exclusive> avatar(handle.id);
        const vfit_pose p = read(pose, "pose");
        avatar->pose(pose_in(p, Items<vfit_bone>(items, stride, count, "items"), avatar->context->axes));
        return VFIT_OK;
    });
}

vfit_result vfit_avatar_pose_into(vfit_avatar handle, const vfit_pose* pose, const vfit_bone* items,
                                  uint32_t stride, uint32_t count, const vfit_target* positions,
                                  const vfit_target* normals) {
    return guard([&] {
        Use<AvatarObject, Mode::exclusive> avatar(handle.id);
        const vfit_pose p = read(pose, "pose");
        const uint32_t vertices = uint32_t(avatar->avatar.rest().positions.size());
        const VertexTarget to = vertex_target(positions, vertices, "positions");
        SkinTarget target;
        target.positions = to.data;
        target.position_stride = to.stride;
        if (normals) {
            const VertexTarget n = vertex_target(normals, vertices, "normals");
            target.normals = n.data;
            target.normal_stride = n.stride;
        }
        avatar->pose_into(pose_in(p, Items<vfit_bone>(items, stride, count, "items"), avatar->context->axes),
                          target);
        return VFIT_OK;
    });
}

vfit_result vfit_avatar_colliders(vfit_avatar handle, vfit_collider* items, uint32_t stride,
                                  uint32_t* count) {
    return guard([&] {
        Use<AvatarObject, Mode::read> avatar(handle.id);
        std::vector<Collider> colliders;
        avatar->avatar.colliders(colliders);
        return write_colliders(colliders, avatar->context->axes, items, stride, count);
    });
}

vfit_result vfit_avatar_joints(vfit_avatar handle, vfit_joint* items, uint32_t stride, uint32_t* count) {
    return guard([&] {
        Use<AvatarObject, Mode::read> avatar(handle.id);
        return write_joints(avatar->avatar.joints(), avatar->context->axes, items, stride, count);
    });
}

vfit_result vfit_avatar_rig(vfit_avatar handle, vfit_rig_bone* items, uint32_t stride, uint32_t* count) {
    return guard([&] {
        Use<AvatarObject, Mode::read> avatar(handle.id);
        const auto& bones = avatar->avatar.rig_bones();
        const Axes& axes = avatar->context->axes;
        return write_list(items, stride, count, bones.size(), [&](size_t i) {
            vfit_rig_bone bone{};
            bone.parent = bones[i].parent;
            bone.bone = bones[i].bone < 0 ? -1 : axes.bone_out(bones[i].bone);
            const Vec3 head = axes.point_out(bones[i].rest_head);
            bone.rest_position[0] = head.x;
            bone.rest_position[1] = head.y;
            bone.rest_position[2] = head.z;
            set_text(bone.name, bones[i].name);
            const Quat q = axes.rotation_out(bones[i].rest_rotation);
            bone.rest_rotation[0] = q.x;
            bone.rest_rotation[1] = q.y;
            bone.rest_rotation[2] = q.z;
            bone.rest_rotation[3] = q.w;
            bone.node = bones[i].node;
            return bone;
        });
    });
}

vfit_result vfit_avatar_measure(vfit_avatar handle, vfit_measurement* items, uint32_t stride,
                                uint32_t* count) {
    return guard([&] {
        Use<AvatarObject, Mode::read> avatar(handle.id);
        return write_measurements(avatar->measures(), items, stride, count);
    });
}

vfit_result vfit_avatar_measure_own(vfit_avatar handle, const void* text, uint64_t byte_count,
                                    vfit_measurement* items, uint32_t stride, uint32_t* count) {
    return guard([&] {
        Use<AvatarObject, Mode::read> avatar(handle.id);
        check_pointer(text, "text");
        if (!avatar->is_body())
            fail(VFIT_ERROR_UNSUPPORTED, "a character from a file has no body that could be measured");
        constexpr uint64_t kMostBytes = 1u << 20;
        if (byte_count > kMostBytes) fail(VFIT_ERROR_ARGUMENT, "byte_count ", byte_count, " is too large");
        const auto own =
            OwnMeasures::parse({static_cast<const char*>(text), static_cast<size_t>(byte_count)});
        Body joints;
        const Mesh mesh = avatar->avatar.measuring_mesh({}, &joints);
        std::vector<Measurement> list =
            own.measure({mesh.positions, mesh.indices, avatar->avatar.parts().first(mesh.positions.size()),
                         joints, avatar->sex});
        for (Measurement& m : list) m.sigma = avatar->relative_sigma * m.value;
        return write_measurements(list, items, stride, count);
    });
}

vfit_result vfit_avatar_acquire(vfit_avatar handle, vfit_frame* out) {
    return guard([&] {
        check_pointer(out, "out");
        out->id = 0;
        Use<AvatarObject, Mode::any> avatar(handle.id);
        return acquire(avatar->posed.latest(), *avatar->context, out);
    });
}

vfit_result vfit_avatar_acquire_rest(vfit_avatar handle, vfit_frame* out) {
    return guard([&] {
        check_pointer(out, "out");
        out->id = 0;
        Use<AvatarObject, Mode::any> avatar(handle.id);
        return acquire(avatar->rest.latest(), *avatar->context, out);
    });
}
