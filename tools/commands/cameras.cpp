// vfit cameras: how cameras stand to each other, from a person who walks about in view of all.
#include "client/cameras.h"

#include <cmath>
#include <iomanip>
#include <iostream>

#include "client/files.h"
#include "client/output.h"
#include "client/progress.h"
#include "commands/commands.h"

namespace vfit::tools {

namespace {

// Middle joints: left and right may be exchanged.
constexpr vfit_joint_id kMiddle[] = {VFIT_JOINT_PELVIS, VFIT_JOINT_CHEST, VFIT_JOINT_NECK, VFIT_JOINT_HEAD};

// Between places of a joint by two cameras that see the same person: 0.01 to 0.03 m in practice.
constexpr float kMaxApart_m = 0.08f;

struct Options {
    std::vector<std::string> sources;
    std::string out;
    uint32_t frames = 600;
    bool json = false;
    TrackOptions track;
};

/// What two cameras saw of the same joints: three numbers a point.
struct Shared {
    std::vector<float> here, there;

    void add(vfit_frame a, vfit_frame b) {
        const uint32_t body_a = active_body_in_view(a), body_b = active_body_in_view(b);
        if (body_a == 0 || body_b == 0) return;
        const auto joints_a = joints_of(a, body_a), joints_b = joints_of(b, body_b);
        for (const vfit_joint_id id : kMiddle) {
            const vfit_joint *in_a = find(joints_a, id), *in_b = find(joints_b, id);
            if (!in_a || !in_b) continue;
            here.insert(here.end(), in_a->position, in_a->position + 3);
            there.insert(there.end(), in_b->position, in_b->position + 3);
        }
    }
    static const vfit_joint* find(const std::vector<vfit_joint>& joints, vfit_joint_id id) {
        for (const vfit_joint& joint : joints)
            if (joint.joint == id && joint.state == VFIT_JOINT_MEASURED) return &joint;
        return nullptr;
    }
};

struct Found {
    std::vector<CameraPlace> places;
    Json report = Json::array();
};

Found find_places(const Options& o) {
    const Context context = open_context();
    Cameras cameras(context.get(), o.sources, o.track);
    std::vector<Shared> seen(o.sources.size());
    Progress progress("watching");
    for (uint32_t frame = 0; frame < o.frames && cameras.next(); ++frame) {
        for (size_t i = 1; i < seen.size(); ++i) seen[i].add(cameras.tracked(0), cameras.tracked(i));
        progress.at(frame, o.frames);
    }
    Found out;
    out.places.emplace_back();
    for (size_t i = 1; i < seen.size(); ++i) {
        CameraPlace place;
        float rotation[4], rms = 0.0f;
        const uint32_t count = uint32_t(seen[i].here.size() / 3);
        try {
            check(vfit_world_align(context.get(), seen[i].here.data(), seen[i].there.data(), count,
                                   place.position.data(), rotation, &rms));
        } catch (const Failure& failure) {
            throw Failure(o.sources[i] + ": beside " + o.sources[0] + ": " + failure.what());
        }
        if (rms > kMaxApart_m)
            throw Failure(o.sources[i] + ": beside " + o.sources[0] + ": what both saw lies " +
                          std::to_string(rms).substr(0, 4) +
                          " m apart: not the same person at the same moments");
        place.turned_rad = 2.0f * std::atan2(rotation[1], rotation[3]);
        out.places.push_back(place);
        out.report.push_back({{"source", o.sources[i]}, {"points", count}, {"rms_m", rms}});
    }
    return out;
}

}  // namespace

void add_cameras(Command& app) {
    Command command = app.add_subcommand(
        "cameras", "Find how cameras stand to each other: a person walks about in view of all");
    auto o = std::make_shared<Options>();
    command.add_option("sources", o->sources, "Recordings made at the same time, or sensor URIs").required();
    command.add_option("--out", o->out, "File to write them to, for vfit measure --places");
    command.add_option("--frames", o->frames, "Frames to watch at most (default 600)").within(8, 100000);
    command.add_flag("--json", o->json, "Print JSON");
    add_track_options(command, o->track);
    command.callback([o] {
        if (o->sources.size() < 2) throw WrongUsage("name two or more cameras");
        const Found found = find_places(*o);
        const std::string text = places_text(found.places);
        if (!o->out.empty()) write_text(o->out, text);
        if (o->json) {
            Json out = Json::parse(text);
            out["of"] = found.report;
            print_document(out);
            return;
        }
        std::cout << std::fixed;
        for (size_t i = 1; i < found.places.size(); ++i) {
            const CameraPlace& place = found.places[i];
            const Json& report = found.report[i - 1];
            std::cout << o->sources[i] << ": turned by " << std::setprecision(1)
                      << place.turned_rad / kRadPerDegree << " degrees to the left, origin at "
                      << std::setprecision(2) << place.position[0] << " " << place.position[1] << " "
                      << place.position[2] << " m; " << report["points"] << " points, "
                      << std::setprecision(3) << report["rms_m"].get<double>() << " m apart\n";
        }
    });
}

}  // namespace vfit::tools
