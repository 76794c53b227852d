#include "bench/garment_pushed.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>
#include <vector>

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include "bench/carried_props.h"
#include "bench/targets.h"
#include "client/assets.h"
#include "client/outfit.h"
#include "client/output.h"

namespace vfit::tools {

namespace {

constexpr float kFrame_s = 1.0f / 60.0f;
constexpr float kExtent_m = 0.3f;   // of each prop
constexpr float kHeight_m = 0.6f;   // about the thighs
constexpr float kTurn_rad = 0.12f;  // a frame, about the body and about itself
constexpr float kFrom_m = 0.45f;    // from the body's axis
constexpr int kFramesToRest = 20, kFramesIn = 60, kFrames = 90, kFramesAfter = 60;

/// How near the middle of a prop comes.
struct Way {
    const char* name;
    float to_m;
};
constexpr Way kWays[] = {{"brushed", 0.34f}, {"pressed", 0.24f}};

struct Mesh {
    std::string name;
    std::vector<float> positions;
    std::vector<uint32_t> indices;
};

/// Fails where the file cannot be read, as one that is compressed by an extension.
tinygltf::Model model_of(const std::filesystem::path& file) {
    tinygltf::TinyGLTF reader;
    const auto no_picture = [](tinygltf::Image*, const int, std::string*, std::string*, int, int,
                               const unsigned char*, int, void*) { return true; };
    reader.SetImageLoader(no_picture, nullptr);
    tinygltf::Model model;
    std::string error, warning;
    const bool is_read = file.extension() == ".glb"
                             ? reader.LoadBinaryFromFile(&model, &error, &warning, file.string())
                             : reader.LoadASCIIFromFile(&model, &error, &warning, file.string());
    if (!is_read) throw Failure(file.string() + ": " + error);
    return model;
}

template <typename T>
float as_float(const unsigned char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return float(value);
}

/// Of one accessor, row by row. Normalised integers are left as they are: the size is changed anyway.
std::vector<float> numbers_of(const tinygltf::Model& model, int number) {
    const tinygltf::Accessor& accessor = model.accessors.at(size_t(number));
    const tinygltf::BufferView& view = model.bufferViews.at(size_t(accessor.bufferView));
    const std::vector<unsigned char>& bytes = model.buffers.at(size_t(view.buffer)).data;
    const auto columns = size_t(tinygltf::GetNumComponentsInType(uint32_t(accessor.type))),
               size = size_t(tinygltf::GetComponentSizeInBytes(uint32_t(accessor.componentType))),
               first = view.byteOffset + accessor.byteOffset, stride = size_t(accessor.ByteStride(view));
    if (accessor.count == 0 || first + (accessor.count - 1) * stride + columns * size > bytes.size())
        throw Failure("a glTF accessor ends beyond its buffer");
    std::vector<float> out;
    for (size_t i = 0; i < accessor.count * columns; ++i) {
        const unsigned char* at = &bytes[first + i / columns * stride + i % columns * size];
        switch (accessor.componentType) {
            case TINYGLTF_COMPONENT_TYPE_BYTE: out.push_back(as_float<int8_t>(at)); break;
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: out.push_back(as_float<uint8_t>(at)); break;
            case TINYGLTF_COMPONENT_TYPE_SHORT: out.push_back(as_float<int16_t>(at)); break;
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: out.push_back(as_float<uint16_t>(at)); break;
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: out.push_back(as_float<uint32_t>(at)); break;
            default: out.push_back(as_float<float>(at));
        }
    }
    return out;
}

/// Its longest side becomes kExtent_m, its middle the origin.
void fit_size(std::vector<float>& positions) {
    float low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < positions.size(); ++i) {
        low[i % 3] = std::min(low[i % 3], positions[i]);
        high[i % 3] = std::max(high[i % 3], positions[i]);
    }
    const float extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
    for (size_t i = 0; i < positions.size(); ++i)
        positions[i] = (positions[i] - 0.5f * (low[i % 3] + high[i % 3])) * (kExtent_m / extent);
}

/// One a part of each mesh.
std::vector<Mesh> meshes_of(const std::filesystem::path& file) {
    std::vector<Mesh> out;
    const tinygltf::Model model = model_of(file);
    for (const tinygltf::Mesh& mesh : model.meshes)
        for (const tinygltf::Primitive& part : mesh.primitives) {
            const auto position = part.attributes.find("POSITION");
            if (position == part.attributes.end() || part.indices < 0) continue;
            Mesh& own = out.emplace_back();
            own.name = file.stem().string() + " " + mesh.name;
            own.positions = numbers_of(model, position->second);
            for (const float index : numbers_of(model, part.indices)) own.indices.push_back(uint32_t(index));
            fit_size(own.positions);
        }
    return out;
}

struct Outcome {
    int crossing = 0;  // frames of kFrames
    float strain_max = 0.0f, strain_after = 0.0f;
};

class PushJudge {
public:
    PushJudge(vfit_context context, const std::string& names)
        : context_(context), avatar_(default_wearer(context, names)) {
        vfit_cloth_desc desc = vfit_cloth_desc_init();
        desc.flags = VFIT_CLOTH_SKIN;
        desc.self_thickness_m = kOwnLayers_m;
        outfit_.emplace(context, avatar_.get(), names, desc);
    }

    /// It circles the body, nearer and nearer, then it is taken away.
    Outcome of(const Mesh& mesh, float to_m) {
        vfit_prop_desc desc = vfit_prop_desc_init();
        desc.shape = VFIT_PROP_MESH;
        desc.positions = mesh.positions.data(), desc.vertex_count = uint32_t(mesh.positions.size() / 3);
        desc.indices = mesh.indices.data(), desc.index_count = uint32_t(mesh.indices.size());
        Handle<vfit_prop, vfit_prop_destroy> prop;
        check(vfit_prop_create(context_, &desc, prop.out()));
        outfit_->reset();
        step(kFramesToRest);
        alone_ms_.push_back(step_ms());
        for (const vfit_cloth cloth : outfit_->cloths()) check(vfit_cloth_add_prop(cloth, prop.get()));
        Outcome out;
        for (int frame = 0; frame < kFrames; ++frame) {
            const float angle = kTurn_rad * float(frame);
            const float away_m = kFrom_m + (to_m - kFrom_m) * std::min(float(frame) / float(kFramesIn), 1.0f);
            const float position[3] = {away_m * std::sin(angle), kHeight_m, away_m * std::cos(angle)};
            const float rotation[4] = {0.0f, std::sin(0.5f * angle), 0.0f, std::cos(0.5f * angle)};
            check(vfit_prop_move(prop.get(), position, rotation));
            step(1);
            met_ms_.push_back(step_ms());
            out.crossing += prop_crossings(outfit_->cloths()) > 0;
            out.strain_max = std::max(out.strain_max, strain_max());
        }
        for (const vfit_cloth cloth : outfit_->cloths()) check(vfit_cloth_remove_prop(cloth, prop.get()));
        step(kFramesAfter);
        out.strain_after = strain_max();
        return out;
    }

    /// Medians of all steps so far: before a prop was added, and with it.
    float alone_ms() { return median(alone_ms_); }
    float met_ms() { return median(met_ms_); }

private:
    static float median(std::vector<float>& values) {
        std::sort(values.begin(), values.end());
        return values[values.size() / 2];
    }
    void step(int frames) {
        for (int i = 0; i < frames; ++i) outfit_->step(kFrame_s);
    }
    std::vector<vfit_cloth_stats> stats() const {
        std::vector<vfit_cloth_stats> out;
        for (const vfit_cloth cloth : outfit_->cloths()) {
            out.push_back(vfit_cloth_stats_init());
            check(vfit_cloth_describe(cloth, &out.back()));
        }
        return out;
    }
    float strain_max() const {
        float most = 0.0f;
        for (const vfit_cloth_stats& s : stats()) most = std::max(most, s.strain_max);
        return most;
    }
    float step_ms() const {
        float sum = 0.0f;
        for (const vfit_cloth_stats& s : stats()) sum += s.step_ms;
        return sum;
    }

    vfit_context context_;
    Avatar avatar_;
    std::optional<WornOutfit> outfit_;
    std::vector<float> alone_ms_, met_ms_;
};

}  // namespace

void judge_pushed(const PushedOptions& options) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(options.folder))
        if (entry.path().extension() == ".glb" || entry.path().extension() == ".gltf")
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    if (files.empty()) throw Failure(options.folder + " holds no .glb or .gltf file");
    const Context context = open_context();
    PushJudge judge(context.get(), options.garment.empty() ? "sundress" : options.garment);
    Targets targets(options.json);
    Json rows = Json::array();
    for (const Way& way : kWays) {
        int frames = 0, crossing = 0;
        float strain = 0.0f, after = 0.0f;
        for (const std::filesystem::path& file : files)
            for (const Mesh& mesh : meshes_of(file)) {
                const Outcome o = judge.of(mesh, way.to_m);
                frames += kFrames, crossing += o.crossing;
                strain = std::max(strain, o.strain_max), after = std::max(after, o.strain_after);
                rows.push_back({{"mesh", mesh.name},
                                {"way", way.name},
                                {"frames", kFrames},
                                {"frames_crossing", o.crossing},
                                {"strain_max", o.strain_max},
                                {"strain_max_after", o.strain_after}});
                if (!options.json)
                    std::printf("%-44s %s: frames crossing %2d of %d, strain max %.2f, a second after %.2f\n",
                                mesh.name.c_str(), way.name, o.crossing, kFrames, double(o.strain_max),
                                double(o.strain_after));
            }
        const std::string name = std::string(way.name) + ": ";
        targets.judge(name + "frames of " + std::to_string(frames) + " in which cloth crosses the prop",
                      crossing, Aim::exactly, 0);
        targets.judge(name + "strain_max", strain, Aim::at_most, 0.6, 2);
        targets.judge(name + "strain_max a second after it has gone", after, Aim::at_most, 0.6, 2);
    }
    if (options.json)
        print_document({{"rows", rows},
                        {"step_ms", judge.alone_ms()},
                        {"step_with_prop_ms", judge.met_ms()},
                        {"targets", targets.json()}});
    else
        std::printf("A step takes %.2f ms, with a prop %.2f ms (medians)\n", double(judge.alone_ms()),
                    double(judge.met_ms()));
}

}  // namespace vfit::tools
