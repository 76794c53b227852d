#include "bench/cloth_scene.h"

#include <cstring>
#include <fstream>
#include <iterator>

#include "core/clock.h"
#include "core/error.h"

namespace vfit::bench {

namespace {

// The physics that every solver runs the scene with.
constexpr float kMass_kg = 0.4f;
constexpr float kEdgeCompliance_m_n = 1e-6f;
constexpr float kBendCompliance_m_n = 1.35f;
constexpr float kFriction = 0.3f;
constexpr float kFrame_s = 1.0f / 60.0f;

/// Reads little-endian values off a file's bytes.
class Reader {
public:
    explicit Reader(const std::string& path) : path_(path) {
        std::ifstream file(path, std::ios::binary);
        if (!file) fail(VFIT_ERROR_IO, "cannot read ", path);
        bytes_.assign(std::istreambuf_iterator<char>(file), {});
    }
    template <typename T>
    std::vector<T> take(int64_t count) {
        if (count < 0 || uint64_t(count) > (bytes_.size() - at_) / sizeof(T))
            fail(VFIT_ERROR_DATA, path_, " is cut");
        std::vector<T> values(static_cast<size_t>(count));
        std::memcpy(values.data(), bytes_.data() + at_, values.size() * sizeof(T));
        at_ += values.size() * sizeof(T);
        return values;
    }

private:
    std::string path_;
    std::vector<char> bytes_;
    size_t at_ = 0;
};

void load_mesh(const std::string& path, ClothScene& scene) {
    Reader reader(path);
    const std::vector<int32_t> counts = reader.take<int32_t>(5);
    scene.rest = reader.take<Vec3>(counts[0]);
    FabricData data;
    data.indices = reader.take<uint32_t>(int64_t(counts[1]) * 3);
    const std::vector<uint32_t> edges = reader.take<uint32_t>(int64_t(counts[2]) * 2);
    const std::vector<uint32_t> bends = reader.take<uint32_t>(int64_t(counts[3]) * 4);
    scene.pins = reader.take<uint32_t>(counts[4]);
    const auto distance = [&](uint32_t a, uint32_t b, float compliance) {
        if (a >= scene.rest.size() || b >= scene.rest.size())
            fail(VFIT_ERROR_DATA, path, " names no such vertex");
        return DistanceConstraint{a, b, glm::length(scene.rest[a] - scene.rest[b]), compliance};
    };
    for (size_t i = 0; i < edges.size(); i += 2)
        data.edges.push_back(distance(edges[i], edges[i + 1], kEdgeCompliance_m_n));
    for (size_t i = 0; i < bends.size(); i += 4)
        data.bends.push_back(distance(bends[i + 2], bends[i + 3], kBendCompliance_m_n));
    data.inverse_mass.assign(scene.rest.size(), float(scene.rest.size()) / kMass_kg);
    for (uint32_t pin : scene.pins) {
        if (pin >= scene.rest.size()) fail(VFIT_ERROR_DATA, path, " pins no such vertex");
        data.inverse_mass[pin] = 0.0f;
    }
    data.tethers = cook_tethers(data.inverse_mass, data.edges);
    scene.fabric = std::make_shared<const Fabric>(std::move(data));
}

void load_motion(const std::string& path, ClothScene& scene) {
    Reader reader(path);
    const std::vector<int32_t> counts = reader.take<int32_t>(4);
    if (size_t(counts[3]) != scene.pins.size())
        fail(VFIT_ERROR_DATA, path, " moves other pins than the mesh has");
    const std::vector<int32_t> ends = reader.take<int32_t>(int64_t(counts[2]) * 2);
    const std::vector<float> radii = reader.take<float>(counts[1]);
    for (int32_t end : ends)
        if (end < 0 || end >= counts[1]) fail(VFIT_ERROR_DATA, path, " joins spheres that it lacks");
    for (int32_t frame = 0; frame < counts[0]; ++frame) {
        const std::vector<Vec3> spheres = reader.take<Vec3>(counts[1]);
        std::vector<Collider>& colliders = scene.colliders.emplace_back();
        for (int32_t i = 0; i < counts[1]; ++i) {
            Collider sphere;
            sphere.joint = i;
            sphere.center = spheres[size_t(i)];
            sphere.radius = radii[size_t(i)];
            colliders.push_back(sphere);
        }
        for (size_t i = 0; i < ends.size(); i += 2) {
            Collider capsule = colliders[size_t(ends[i])];
            const Collider& other = colliders[size_t(ends[i + 1])];
            capsule.joint_b = other.joint;
            capsule.center_b = other.center;
            capsule.radius_b = other.radius;
            colliders.push_back(capsule);
        }
        scene.pin_places.push_back(reader.take<Vec3>(counts[3]));
    }
}

}  // namespace

ClothScene load_cloth_scene(const std::string& folder, const std::string& scene) {
    ClothScene out;
    load_mesh(folder + "/mesh.bin", out);
    load_motion(folder + "/motion_" + scene + ".bin", out);
    return out;
}

ClothRun run_cloth_scene(const ClothScene& scene, uint32_t substeps, float self_thickness_m, Jobs& jobs,
                         const std::function<void(std::span<const Vec3>)>& frame) {
    ClothSettings settings;
    settings.substeps = substeps;
    settings.friction = kFriction;
    settings.damping = 0.0f;
    settings.thickness_m = 0.0f;
    settings.self_thickness_m = self_thickness_m;
    Cloth cloth(scene.fabric, settings, scene.rest);
    std::vector<Vec3> targets = scene.rest;
    ClothRun run;
    for (uint32_t f = 1; f < scene.frame_count(); ++f) {
        for (size_t i = 0; i < scene.pins.size(); ++i) targets[scene.pins[i]] = scene.pin_places[f][i];
        const Stopwatch watch;
        cloth.step(kFrame_s, targets, scene.colliders[f], jobs);
        run.frame_ms.push_back(watch.ms());
        frame(cloth.positions());
    }
    run.last = cloth.stats();
    return run;
}

}  // namespace vfit::bench
