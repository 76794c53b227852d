// vfit-bench bodies: the posed body as an obstacle for cloth, on real people's motion: where its skin
// crosses itself, where two parts of it leave no room for cloth, and how fast its joints leap.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <map>

#include "bench/bench.h"
#include "bench/targets.h"
#include "bench/welded.h"
#include "client/assets.h"
#include "client/fitting.h"
#include "client/output.h"
#include "population/body_measures.h"

namespace vfit::tools {

namespace {

constexpr float kRoom_m = 0.01f;   // two layers of cloth at 4 mm, and what they are thick
constexpr float kStart_m = 1e-3f;  // of a ray, off the skin that it starts on

struct Options {
    std::string folder, recording;
    bool json = false, own_tracker = false;
};

using PartCounts = std::array<size_t, kBodyPartCount>;

const char* name_of(BodyPart part) {
    constexpr const char* kNames[] = {"head",      "trunk",   "upper arm", "forearm", "hand",
                                      "upper arm", "forearm", "hand",      "thigh",   "shank",
                                      "foot",      "thigh",   "shank",     "foot"};
    static_assert(std::size(kNames) == kBodyPartCount);
    return kNames[size_t(part)];
}

/// "forearm, trunk": sides are not told apart, except where both are the same limb's or not.
std::string name_of(BodyPart a, BodyPart b) {
    std::string first = name_of(a), second = name_of(b);
    if (second < first) std::swap(first, second);
    const auto side = [](BodyPart part) {
        const int number = int(part);
        return number < int(BodyPart::kLeftUpperArm) ? 0 : number < 5 || (number > 7 && number < 11) ? 1 : 2;
    };
    return first + ", " + second + (side(a) && side(b) && side(a) != side(b) ? " of the other side" : "");
}

/// Cloth of the bench's garments does not come there.
bool is_bare(BodyPart part) {
    return part == BodyPart::kHead || part == BodyPart::kLeftHand || part == BodyPart::kRightHand ||
           part == BodyPart::kLeftFoot || part == BodyPart::kRightFoot;
}

struct Tally {
    size_t frames = 0, crossed = 0, pairs = 0, worst_pairs = 0;
    std::map<std::string, size_t> pairs_of;  // by parts
    PartCounts without_room{}, buried{};     // vertices, of all frames
    double no_room_worst = 0.0;              // share of the covered vertices, worst frame
    std::map<std::string, Samples> speeds;   // by joint, m/s relative to the hips

    void add(const Tally& other) {
        frames += other.frames, crossed += other.crossed, pairs += other.pairs;
        worst_pairs = std::max(worst_pairs, other.worst_pairs);
        no_room_worst = std::max(no_room_worst, other.no_room_worst);
        for (const auto& [key, count] : other.pairs_of) pairs_of[key] += count;
        for (size_t i = 0; i < without_room.size(); ++i)
            without_room[i] += other.without_room[i], buried[i] += other.buried[i];
    }
};

constexpr std::array<std::pair<vfit_joint_id, const char*>, 8> kSpeeds = {{{VFIT_JOINT_LEFT_ELBOW, "elbow"},
                                                                           {VFIT_JOINT_RIGHT_ELBOW, "elbow"},
                                                                           {VFIT_JOINT_LEFT_HAND, "hand"},
                                                                           {VFIT_JOINT_RIGHT_HAND, "hand"},
                                                                           {VFIT_JOINT_LEFT_KNEE, "knee"},
                                                                           {VFIT_JOINT_RIGHT_KNEE, "knee"},
                                                                           {VFIT_JOINT_LEFT_FOOT, "ankle"},
                                                                           {VFIT_JOINT_RIGHT_FOOT, "ankle"}}};

class BodyJudge {
public:
    explicit BodyJudge(const BodyTopology& topology) : topology_(topology) {
        for (size_t v = 0; v < topology.vertex_count; ++v) ++vertices_[size_t(topology.parts[v])];
        for (size_t i = 0; i < vertices_.size(); ++i)
            if (!is_bare(BodyPart(i))) covered_ += vertices_[i];
    }

    void look(vfit_avatar avatar, double time_s, Tally& tally) {
        Frame frame;
        check(vfit_avatar_acquire(avatar, frame.out()));
        Welded skin{items_of<Vec3>(frame.get(), VFIT_STREAM_POSITION), topology_.indices};
        const std::vector<Vec3> normals = items_of<Vec3>(frame.get(), VFIT_STREAM_NORMAL);
        skin.positions.resize(topology_.vertex_count);
        ++tally.frames;
        count_crossings(skin, tally);
        count_room(skin, normals, tally);
        count_speeds(avatar, time_s, tally);
    }

    const PartCounts& vertices() const { return vertices_; }
    size_t covered() const { return covered_; }

private:
    void count_crossings(const Welded& skin, Tally& tally) const {
        size_t pairs = 0;
        for (const auto& [a, b] : crossings(skin)) {
            const BodyPart of_a = part_of(a), of_b = part_of(b);
            if (is_bare(of_a) && is_bare(of_b)) continue;
            ++tally.pairs_of[name_of(of_a, of_b)];
            ++pairs;
        }
        tally.crossed += pairs > 0;
        tally.pairs += pairs;
        tally.worst_pairs = std::max(tally.worst_pairs, pairs);
    }
    BodyPart part_of(uint32_t triangle) const { return topology_.parts[topology_.indices[3 * triangle]]; }

    void count_room(const Welded& skin, std::span<const Vec3> normals, Tally& tally) {
        if (!query_)
            query_.emplace(query_of(skin));
        else
            query_->update(skin.positions);
        size_t without = 0;
        for (size_t v = 0; v < skin.positions.size(); ++v) {
            const BodyPart part = topology_.parts[v];
            if (is_bare(part)) continue;
            const Vec3 start = skin.positions[v] + kStart_m * normals[v];
            const bool buried = query_->inside(start);
            const bool none = buried || query_->cast(start, normals[v], kRoom_m - kStart_m).has_value();
            tally.buried[size_t(part)] += buried;
            tally.without_room[size_t(part)] += none;
            without += none;
        }
        tally.no_room_worst = std::max(tally.no_room_worst, double(without) / double(covered_));
    }

    void count_speeds(vfit_avatar avatar, double time_s, Tally& tally) {
        const auto joints = list<vfit_joint>([&](auto* items, uint32_t stride, uint32_t* n) {
            return vfit_avatar_joints(avatar, items, stride, n);
        });
        std::map<int, Vec3> at;
        for (const vfit_joint& j : joints) at[j.joint] = {j.position[0], j.position[1], j.position[2]};
        if (!at_.empty() && time_s > time_s_)
            for (const auto& [joint, name] : kSpeeds) {
                const Vec3 way = (at[joint] - at[VFIT_JOINT_PELVIS]) - (at_[joint] - at_[VFIT_JOINT_PELVIS]);
                tally.speeds[name].add(double(glm::length(way)) / (time_s - time_s_));
            }
        at_ = std::move(at), time_s_ = time_s;
    }

    const BodyTopology& topology_;
    PartCounts vertices_{};
    size_t covered_ = 0;
    std::optional<MeshQuery> query_;
    std::map<int, Vec3> at_;  // joints of the last frame
    double time_s_ = 0.0;
};

size_t sum_of(const PartCounts& counts) {
    size_t sum = 0;
    for (const size_t count : counts) sum += count;
    return sum;
}

Json json_of(const Tally& t, const BodyJudge& judge) {
    Json regions = Json::object();
    std::map<std::string, std::array<size_t, 3>> by_name;
    for (size_t i = 0; i < t.buried.size(); ++i) {
        if (is_bare(BodyPart(i))) continue;
        auto& [none, buried, all] = by_name[name_of(BodyPart(i))];
        none += t.without_room[i], buried += t.buried[i], all += judge.vertices()[i] * t.frames;
    }
    for (const auto& [name, counts] : by_name)
        regions[name] = {{"no_room", double(counts[0]) / double(counts[2])},
                         {"buried", double(counts[1]) / double(counts[2])}};
    Json speeds = Json::object();
    for (const auto& [name, samples] : t.speeds)
        speeds[name] = {{"median_m_s", samples.quantile(0.5)},
                        {"p99_m_s", samples.quantile(0.99)},
                        {"max_m_s", samples.quantile(1.0)}};
    const double all = double(judge.covered() * t.frames);
    return {{"frames", t.frames},
            {"frames_crossed", t.crossed},
            {"pairs", t.pairs},
            {"pairs_worst", t.worst_pairs},
            {"pairs_by_parts", t.pairs_of},
            {"no_room", double(sum_of(t.without_room)) / all},
            {"no_room_worst", t.no_room_worst},
            {"buried", double(sum_of(t.buried)) / all},
            {"regions", regions},
            {"speeds", speeds}};
}

void say(const std::string& name, const Json& row) {
    std::cout << std::left << std::setw(26) << name << std::right << std::fixed << std::setprecision(2)
              << " frames " << std::setw(3) << row["frames"].get<size_t>() << ", crossed " << std::setw(3)
              << row["frames_crossed"].get<size_t>() << ", pairs " << std::setw(6)
              << row["pairs"].get<size_t>() << " (worst " << row["pairs_worst"].get<size_t>() << "); no room "
              << 100.0 * row["no_room"].get<double>() << " % (worst "
              << 100.0 * row["no_room_worst"].get<double>() << "), buried "
              << 100.0 * row["buried"].get<double>() << " %; m/s p99, max:";
    for (const auto& [joint, speed] : row["speeds"].items())
        std::cout << " " << joint << " " << speed["p99_m_s"].get<double>() << ", "
                  << speed["max_m_s"].get<double>();
    std::cout << std::endl;
}

void judge_bodies(const Options& options) {
    const std::shared_ptr<const BodyModel> model = BodyModel::load(library_file("vfit_data/body.bin"));
    const BodyTopology& topology = model->topology(0);
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(options.folder))
        if (entry.is_directory() &&
            entry.path().filename().string().find(options.recording) != std::string::npos)
            paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    if (paths.empty()) throw Failure(options.folder + ": holds no recordings");

    Json rows = Json::array();
    Tally all;
    for (const auto& path : paths) {
        const Context context = open_context();
        FittingOptions chain;
        chain.source = path.string();
        chain.substeps = 1;  // the outfit is not judged
        if (options.own_tracker) chain.scan.track.joints = chain.scan.track.user_map = VFIT_TRACK_BUILT_IN;
        Fitting fitting(context.get(), chain);
        BodyJudge judge(topology);
        Tally tally;
        fitting.play([&](vfit_frame, double time_s) {
            judge.look(fitting.avatar(), time_s, tally);
            return true;
        });
        Json row = json_of(tally, judge);
        row["recording"] = path.filename().string();
        if (!options.json) say(path.filename().string(), row);
        rows.push_back(std::move(row));
        all.add(tally);
    }
    const Json total = json_of(all, BodyJudge(topology));
    if (!options.json) {
        std::cout << "\n";
        for (const auto& [parts, pairs] : all.pairs_of)
            std::cout << std::setw(10) << pairs << "  " << parts << "\n";
        for (const auto& [region, shares] : total["regions"].items())
            std::cout << std::setw(10) << 100.0 * shares["no_room"].get<double>() << " % without room, "
                      << 100.0 * shares["buried"].get<double>() << " % buried: " << region << "\n";
    }
    Targets targets(options.json);
    targets.judge("frames in which the skin crosses itself", double(all.crossed), Aim::exactly, 0.0);
    targets.judge("pairs of triangles that cross, mean of a frame", double(all.pairs) / double(all.frames),
                  Aim::exactly, 0.0, 1);
    targets.judge("skin without 10 mm of room", 100.0 * total["no_room"].get<double>(), Aim::at_most, 1.0, 2,
                  " %");
    targets.judge("skin inside other skin", 100.0 * total["buried"].get<double>(), Aim::exactly, 0.0, 2,
                  " %");
    if (options.json) print_document({{"rows", rows}, {"all", total}, {"targets", targets.json()}});
}

}  // namespace

void add_bodies(Command& app) {
    Command command = app.add_subcommand(
        "bodies", "Judge the posed body as an obstacle for cloth on real people's motion: crossings, room");
    auto o = std::make_shared<Options>();
    command.add_option("--recordings", o->folder, "Folder of recordings of people").required();
    command.add_option("--recording", o->recording, "Those whose name holds this");
    command.add_flag("--own-tracker", o->own_tracker, "Joints by vfit instead of the recording's");
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] { judge_bodies(*o); });
}

}  // namespace vfit::tools
