// What a careful caller puts into structs, and what no caller may get wrong: pointers that lead to memory,
// sizes that are those of the memory.
#pragma once

#include "storm.h"
#include "support/tiny_character.h"

namespace storm {

inline void usual(Storm&, vfit_joint& joint, uint32_t i) {
    joint.joint = int32_t(i % VFIT_JOINT_COUNT);
    joint.state = VFIT_JOINT_MEASURED;
    joint.confidence = 1.0f;
    joint.position[0] = 0.1f * float(i % 3) - 0.1f;
    joint.position[1] = 1.7f - 0.07f * float(i);
    joint.position[2] = -2.0f;
}

inline void usual(Storm&, vfit_bone& bone, uint32_t i) {
    bone.bone = int32_t(i % VFIT_BONE_COUNT);
    bone.rotation[3] = 1.0f;
    if (bone.bone == VFIT_BONE_HIPS) bone.position[1] = 1.0f;
}

inline void usual(Storm&, vfit_body& body, uint32_t) { body.body_id = 1; }

inline void usual(Storm& s, vfit_measurement& measurement, uint32_t i) {
    vfit_measure_key(i, measurement.key, sizeof measurement.key);
    measurement.value = i == 0 ? 1.7f : 0.3f + 0.01f * float(s.below(100));
    measurement.sigma = 0.01f;
}

inline void usual(Storm&, vfit_shape_value& value, uint32_t i) {
    static const char* const kKeys[] = {"gender", "age", "muscle", "weight", "height", "proportions"};
    std::strcpy(value.key, kKeys[i % 6]);
    value.value = 0.5f;
}

inline void usual(Storm&, vfit_joint_hint& hint, uint32_t i) {
    hint.joint = int32_t(i % VFIT_JOINT_COUNT);
    hint.x = hint.y = 20.0f;
    hint.confidence = 0.9f;
}

inline void usual(Storm&, vfit_intrinsics& intrinsics, uint32_t) {
    intrinsics.width = 64;
    intrinsics.height = 48;
    intrinsics.fx = intrinsics.fy = 60.0f;
    intrinsics.cx = 31.5f;
    intrinsics.cy = 23.5f;
}

inline void usual(Storm&, vfit_context_desc& desc, uint32_t) { desc.api_version = VFIT_VERSION; }

inline void usual(Storm& s, vfit_target& target, uint32_t) {
    static const vfit_format kFormats[] = {VFIT_FORMAT_F32X3, VFIT_FORMAT_F32X3, VFIT_FORMAT_U32,
                                           VFIT_FORMAT_U16};
    target.format = s.pick(kFormats);
}

inline void usual(Storm& s, vfit_avatar_desc& desc, uint32_t) { desc.sex = int32_t(s.below(3)); }

inline void usual(Storm& s, vfit_prop_desc& desc, uint32_t) {
    desc.shape = int32_t(s.below(4));
    for (float& size : desc.size) size = 0.1f;
}

// ---- what is kept to

inline void quiet(void* user, vfit_log_level, const char* message) {
    static_cast<std::atomic<uint64_t>*>(user)->fetch_add(std::strlen(message));
    vfit_last_error(nullptr, 0);
}
inline std::atomic<uint64_t> logged{0};

inline void restrain(Storm& s, vfit_context_desc& desc) {
    // A host's job system that does all at once. One function without the other is refused.
    desc.log = quiet;
    desc.user = &logged;
    if (s.one_in(4)) {
        desc.submit = [](void*, vfit_task_fn fn, void* task, uint32_t count) -> void* {
            for (uint32_t i = 0; i < count; ++i) fn(task, i);
            return nullptr;
        };
        if (!s.one_in(8)) desc.wait = [](void*, void*) {};
    }
    if (!s.one_in(8)) desc.plugin_dir = desc.data_dir = nullptr;
    if (desc.worker_count > 2 && desc.worker_count <= 256) desc.worker_count = 1;
}

/// Bodies of 1,000 vertices, seldom of 13,700; 219,000 take seconds to make.
inline void restrain(Storm& s, vfit_avatar_desc& desc) {
    if (desc.detail < 3) desc.detail = s.one_in(50) ? 0 : 3;
}

/// The first scan that fits a body lets its context learn how: seconds under a sanitizer.
inline void restrain(Storm& s, vfit_scan_desc& desc) {
    if (desc.method == VFIT_SCAN_FIT && !s.one_in(30)) desc.method = VFIT_SCAN_DEFAULT;
}

inline void restrain(Storm& s, vfit_cloth_desc& desc) {
    if (!s.one_in(20)) desc.cover_m = desc.virtual_m = 0.0f;
    if (desc.substeps > 16 && !s.one_in(50)) desc.substeps = 2;
}

/// A tetrahedron, at times with a hole, a wrong index or a wild vertex.
inline void restrain(Storm& s, vfit_prop_desc& desc) {
    static const float kPositions[] = {0, 0, 0, 0.2f, 0, 0, 0, 0.2f, 0, 0, 0, 0.2f};
    static const uint32_t kIndices[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    float* positions = static_cast<float*>(s.block(sizeof kPositions));
    uint32_t* indices = static_cast<uint32_t*>(s.block(sizeof kIndices));
    std::memcpy(positions, kPositions, sizeof kPositions);
    std::memcpy(indices, kIndices, sizeof kIndices);
    if (s.one_in(8)) positions[s.below(12)] = s.number();
    if (s.one_in(8)) indices[s.below(12)] = s.below(6);
    desc.positions = s.one_in(12) ? nullptr : positions;
    desc.indices = s.one_in(12) ? nullptr : indices;
    desc.vertex_count = s.one_in(40) ? 0xFFFFFFFF : s.one_in(8) ? s.below(5) : 4;
    desc.index_count = s.one_in(40) ? 0xFFFFFFFF : s.one_in(8) ? s.below(13) : 12;
}

inline void restrain(Storm& s, vfit_target& target) {
    static const uint64_t kRooms[] = {0, 12, 4000, 40000, 40000};
    if (s.one_in(12)) return;  // null
    target.capacity = s.pick(kRooms);
    target.data = s.block(target.capacity);
}

inline void restrain(Storm& s, vfit_character_desc& desc) {
    static const std::vector<std::byte> kGlb = vfit::TinyCharacter().glb();
    desc.path = s.one_in(8) ? desc.path : nullptr;
    desc.bytes = nullptr;
    if (s.one_in(8)) return;
    desc.byte_count = s.one_in(2) ? kGlb.size() : s.below(uint32_t(kGlb.size()));
    char* copy = static_cast<char*>(s.block(desc.byte_count));
    std::memcpy(copy, kGlb.data(), desc.byte_count);
    if (s.one_in(2) && desc.byte_count > 0) copy[s.below(uint32_t(desc.byte_count))] ^= char(1 << s.below(8));
    desc.bytes = copy;
    if (!s.one_in(4)) desc.bone_map = nullptr;
}

/// Pixels of the host: depth, and at times a user map and colour, copied or lent.
inline void restrain(Storm& s, vfit_frame_desc& desc) {
    constexpr uint32_t kWidth = 64, kHeight = 48;
    Pixels& pixels = s.pixels();
    static const vfit_stream kStreams[] = {VFIT_STREAM_DEPTH, VFIT_STREAM_USER_MAP, VFIT_STREAM_COLOR};
    static const vfit_format kFormats[] = {VFIT_FORMAT_U16, VFIT_FORMAT_U8, VFIT_FORMAT_RGBA8};
    static const uint32_t kBytes[] = {2, 1, 4};
    auto* streams = static_cast<vfit_stream*>(s.block(3 * sizeof(vfit_stream)));
    auto* views = static_cast<vfit_view*>(s.block(3 * sizeof(vfit_view)));
    for (uint32_t i = 0; i < 3; ++i) {
        streams[i] = s.one_in(40) ? s.an_enum(0, 24) : kStreams[i];
        views[i] = vfit_view{};
        // The first one's is the distance of the others.
        static const uint32_t kWrong[] = {0, 7, 5000, 0xFFFFFFFF};
        views[i].struct_size = s.one_in(40) ? s.pick(kWrong) : uint32_t(sizeof(vfit_view));
        views[i].format = s.one_in(40) ? s.an_enum(0, 10) : kFormats[i];
        views[i].width = kWidth;
        views[i].height = kHeight;
        if (s.one_in(40)) views[i].width = s.below(kWidth);
        if (s.one_in(40)) views[i].item_stride = s.below(kBytes[i] + 1);
        if (s.one_in(40)) views[i].row_stride = s.below(kWidth * kBytes[i] + 1);
        // Room for whatever format was drawn.
        pixels.of[i].resize(size_t(kWidth) * kHeight * (views[i].format == kFormats[i] ? kBytes[i] : 64));
        for (uint32_t y = 0; y < kHeight; ++y)
            for (uint32_t x = 0; x < kWidth; ++x) {
                const bool person = x > 24 && x < 40 && y > 4 && y < 44;
                unsigned char* pixel = &pixels.of[i][(size_t(y) * kWidth + x) * kBytes[i]];
                if (i == 0) {
                    const uint16_t depth = person ? 2000 : 3000;
                    std::memcpy(pixel, &depth, sizeof depth);
                } else {
                    pixel[0] = person;
                }
            }
        if (!s.one_in(40)) views[i].data = pixels.of[i].data();
    }
    desc.streams = s.one_in(40) ? nullptr : streams;
    desc.views = s.one_in(40) ? nullptr : views;
    desc.count = s.one_in(40) ? s.below(4) : 1 + s.below(3);
    desc.release = s.one_in(3) ? Pixels::release : nullptr;
    desc.user = &pixels;
}

}  // namespace storm
