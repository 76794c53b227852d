// A storm of random calls on the C ABI: every function of vfit.h with null, stale, foreign and invented
// handles, with struct sizes, enums, numbers and texts of all kinds, from several threads that share and
// destroy each other's objects. What may not happen: a crash or a sanitizer's report, VFIT_ERROR_UNKNOWN, an
// error without a sentence, a handle left by an error, pixels that are not given back, a function that never
// succeeds, or a library that does its work no more.
//
// A call that takes longer than --patience ends the program, for a debugger to see where it stands.
//
//     storm [--calls N] [--threads N] [--seed N] [--only PREFIX,PREFIX] [--patience SECONDS] [--times]
#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <thread>

#include "storm.h"
#include "usual.h"

namespace storm {
#include "calls.h"

namespace {

struct Options {
    uint64_t calls = 100000, seed = 1;
    uint32_t threads = 1;
    double patience_s = 60.0;
    std::string only;
    bool times = false;
};

/// How many times less often than others a function is called: it takes long, or ends what others would go on
/// with.
uint32_t rarity(const std::string& name) {
    static const std::map<std::string, uint32_t> kRare = {{"vfit_shutdown", 2000},
                                                          {"vfit_context_destroy", 1000},
                                                          {"vfit_context_create", 300},
                                                          {"vfit_plugin_load", 10},
                                                          {"vfit_sensor_list", 100},
                                                          {"vfit_sensor_open", 20},
                                                          {"vfit_sensor_start", 10},
                                                          {"vfit_sensor_close", 40},
                                                          {"vfit_frame_retain", 20},
                                                          {"vfit_frame_release", 4},
                                                          {"vfit_tracker_update", 40},
                                                          {"vfit_tracker_destroy", 10},
                                                          {"vfit_recorder_create", 40},
                                                          {"vfit_recorder_destroy", 20},
                                                          {"vfit_scan_create", 10},
                                                          {"vfit_scan_measure", 20},
                                                          {"vfit_scan_add", 10},
                                                          {"vfit_scan_reset", 200},
                                                          {"vfit_scan_destroy", 20},
                                                          {"vfit_size_chart_destroy", 10},
                                                          {"vfit_motion_destroy", 10},
                                                          {"vfit_avatar_create", 20},
                                                          {"vfit_avatar_create_from_shape", 60},
                                                          {"vfit_avatar_create_from_scan", 40},
                                                          {"vfit_avatar_load", 40},
                                                          {"vfit_avatar_unpack", 60},
                                                          {"vfit_avatar_measure", 300},
                                                          {"vfit_avatar_measure_own", 100},
                                                          {"vfit_avatar_destroy", 100},
                                                          {"vfit_garment_load", 100},
                                                          {"vfit_garment_open", 20},
                                                          {"vfit_garment_destroy", 100},
                                                          {"vfit_cloth_create", 20},
                                                          {"vfit_cloth_reset", 100},
                                                          {"vfit_cloth_hide_skin", 40},
                                                          {"vfit_cloth_destroy", 100},
                                                          {"vfit_cloth_step", 4},
                                                          {"vfit_cloth_begin_step", 4}};
    const auto found = kRare.find(name);
    return found == kRare.end() ? 1 : found->second;
}

bool wanted(const std::string& name, const std::string& only) {
    if (only.empty()) return true;
    for (size_t from = 0; from <= only.size();) {
        const size_t to = std::min(only.find(',', from), only.size());
        if (name.starts_with("vfit_" + only.substr(from, to - from))) return true;
        from = to + 1;
    }
    return false;
}

/// So many calls after the last ones, and where their context is gone, objects that work together are put in.
constexpr uint64_t kSowing = 15000;

struct Tally {
    uint64_t calls = 0, successes = 0;
    double seconds = 0.0, longest_s = 0.0;
    std::string last_error;
};

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// What a thread is in, since when: for the one who looks after calls that do not return.
struct Now {
    std::atomic<const char*> function{nullptr};
    std::atomic<Clock::rep> start{0};
};

void watch(std::stop_token stop, const std::vector<Now>& threads, double patience_s) {
    while (!stop.stop_requested()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        for (const Now& now : threads) {
            const char* const function = now.function;
            if (!function || seconds_since(Clock::time_point(Clock::duration(now.start))) < patience_s)
                continue;
            std::fprintf(stderr, "storm: %s has not returned for %.0f s\n", function, patience_s);
            std::abort();
        }
    }
}

struct Report {
    std::map<std::string, Tally> functions;
    std::map<vfit_result, uint64_t> results;
    std::vector<std::string> broken;
};

void judge(const char* function, vfit_result result, std::string broken, Report& report) {
    if (result < 0) {
        char text[200] = "";
        if (vfit_last_error(text, sizeof text) == 0) broken = "an error without a sentence";
        if (result == VFIT_ERROR_UNKNOWN) broken = std::string("an unexpected exception: ") + text;
        if (result != VFIT_ERROR_HANDLE) report.functions[function].last_error = text;
    }
    if (result < VFIT_ERROR_NOT_WEARABLE || result > VFIT_END_OF_STREAM)
        broken = "an unknown result " + std::to_string(result);
    if (!broken.empty() && report.broken.size() < 20)
        report.broken.push_back(std::string(function) + ": " + broken);
}

/// The documents that loaders get, whole or damaged.
void teach(Pool& pool) {
    const auto file = [](const char* name) {
        std::ifstream in(std::string(VFIT_DATA_DIR) + "/" + name, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    pool.learn("vfit_size_chart_load", file("charts/shirts_men.json"));
    pool.learn("vfit_garment_load", file("garments/sundress.json"));
    pool.learn("vfit_avatar_measure_own", R"({"format": "vfit-own-measures", "version": 1, "measures": [
        {"key": "x_knee_height_m", "height": "LEFT_KNEE"},
        {"key": "x_waist_girth_m", "girth": {"at": "waist", "of": "trunk"}}]})");
    pool.learn("vfit_measurements_write", R"({"stature_m": 1.7})");
}

/// The main job, with objects of its own. What it ends with is the same before and after a storm.
struct MainJob {
    vfit_context context{};
    vfit_sensor sensor{};
    vfit_tracker tracker{};
    vfit_scan scan{};
    vfit_size_chart chart{};
    vfit_motion motion{};
    vfit_avatar avatar{};
    vfit_garment garment{};
    vfit_cloth cloth{}, over{};
    uint64_t hash = 0;  // 0: it failed
    std::string why;

    MainJob() {
        vfit_context_desc desc = vfit_context_desc_init();
        desc.api_version = VFIT_VERSION;
        desc.log = quiet;
        desc.user = &logged;
        vfit_avatar_desc body = vfit_avatar_desc_init();
        body.detail = 3;
        const bool well = done(vfit_context_create(&desc, &context)) &&
                          done(vfit_sensor_open(context, "virtual:sensor=kinect_v1_320", &sensor)) &&
                          done(vfit_sensor_start(sensor)) &&
                          done(vfit_tracker_create(context, nullptr, &tracker)) &&
                          done(vfit_scan_create(context, nullptr, &scan)) &&
                          done(vfit_size_chart_open(context, "paper", &chart)) &&
                          done(vfit_motion_create(context, nullptr, &motion)) &&
                          done(vfit_avatar_create_from_shape(context, &body, nullptr, 0, 0, &avatar)) &&
                          done(vfit_garment_open(context, "sundress", &garment)) &&
                          done(vfit_cloth_create(avatar, garment, nullptr, &cloth)) &&
                          done(vfit_cloth_create(avatar, garment, nullptr, &over)) && frames();
        if (!well || !done(vfit_cloth_state_hash(cloth, &hash))) hash = 0;
    }

    /// All of it goes into the storm.
    void give_to(Pool& pool, Draw& draw) {
        const auto give = [&](auto... handles) { (pool.put_first(handles, draw), ...); };
        give(context, sensor, tracker, scan, chart, motion, avatar, garment, cloth);
        pool.put(over, draw);
    }

private:
    bool done(vfit_result result) {
        if (result >= 0) return true;
        char text[300];
        vfit_last_error(text, sizeof text);
        why = text;
        return false;
    }
    bool frames() {
        vfit_recorder recorder{};
        vfit_recorder_create(context, "recording", nullptr,
                             &recorder);  // the first job's alone: the folder is there then
        bool well = true;
        for (int i = 0; well && i < 5; ++i) {
            vfit_frame frame{}, tracked{};
            vfit_pose pose = vfit_pose_init();
            vfit_bone bones[VFIT_BONE_COUNT];
            uint32_t count = VFIT_BONE_COUNT, person = 0;
            well = done(vfit_sensor_acquire(sensor, 10'000'000'000, &frame)) &&
                   (recorder.id == 0 || done(vfit_recorder_write(recorder, frame))) &&
                   done(vfit_tracker_update(tracker, frame, &tracked)) &&
                   done(vfit_frame_active_body(tracked, &person, nullptr)) &&
                   done(vfit_scan_add(scan, tracked, person, nullptr)) &&
                   done(vfit_motion_step(motion, tracked, person, int64_t(i + 1) * 33'000'000)) &&
                   done(vfit_motion_pose(motion, &pose, bones, sizeof(vfit_bone), &count)) &&
                   done(vfit_avatar_pose(avatar, &pose, bones, sizeof(vfit_bone), count)) &&
                   done(vfit_cloth_step(cloth, 1.0f / 60.0f));
            vfit_frame_release(tracked);
            vfit_frame_release(frame);
        }
        vfit_recorder_destroy(recorder);
        return well;
    }
};

uint64_t main_job() {
    const MainJob job;
    if (!job.why.empty()) std::printf("the main job: %s\n", job.why.c_str());
    vfit_context_destroy(job.context);
    return job.hash;
}

void run(Pool& pool, const Options& options, uint32_t thread, const std::vector<Call>& calls,
         std::atomic<uint64_t>& done, Now& now, Report& report) {
    Storm storm(pool, options.seed * 1000 + thread);
    uint64_t sown = 0, own = 0;
    while (done.load() < options.calls) {
        const Call& call = calls[storm.below(uint32_t(calls.size()))];
        if (options.only.empty() && !storm.one_in(rarity(call.name))) continue;
        if (++own % 50 == 0 && !pool.first_context_alive()) pool.barren = true;
        if (thread == 0 && (pool.barren || done - sown > kSowing)) {
            sown = done;
            MainJob().give_to(pool, storm);
            pool.barren = false;
        }
        while (thread > 0 && pool.barren && done < options.calls)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        const auto start = Clock::now();
        now.start = start.time_since_epoch().count();
        now.function = call.name;
        const vfit_result result = call.run(storm);
        now.function = nullptr;
        const double seconds = seconds_since(start);
        judge(call.name, result, storm.broken(), report);
        storm.after_call(result);
        Tally& tally = report.functions[call.name];
        ++tally.calls;
        tally.successes += result >= 0;
        tally.seconds += seconds;
        tally.longest_s = std::max(tally.longest_s, seconds);
        ++report.results[result];
        ++done;  // one call too many a thread at the end
    }
}

void print(const Report& report, const Options& options, double seconds) {
    std::printf("%llu calls of %zu functions in %.1f s on %u threads, seed %llu\n",
                (unsigned long long)options.calls, report.functions.size(), seconds, options.threads,
                (unsigned long long)options.seed);
    for (const auto& [result, count] : report.results)
        std::printf("  %-20s %9llu\n", vfit_result_name(result), (unsigned long long)count);
    if (!options.times) return;
    std::vector<std::pair<std::string, Tally>> sorted(report.functions.begin(), report.functions.end());
    std::sort(sorted.begin(), sorted.end(),
              [](const auto& a, const auto& b) { return a.second.seconds > b.second.seconds; });
    std::printf("  %-34s %8s %9s %8s %10s\n", "function", "calls", "succeeded", "seconds", "longest");
    for (const auto& [name, tally] : sorted)
        std::printf("  %-34s %8llu %9llu %8.2f %8.1fms\n", name.c_str(), (unsigned long long)tally.calls,
                    (unsigned long long)tally.successes, tally.seconds, 1e3 * tally.longest_s);
}

bool parse(int argc, char** argv, Options& options) {
    for (int i = 1; i < argc; ++i) {
        const std::string option = argv[i];
        if (option == "--times") {
            options.times = true;
            continue;
        }
        if (i + 1 == argc) return false;
        const char* value = argv[++i];
        if (option == "--calls")
            options.calls = std::strtoull(value, nullptr, 10);
        else if (option == "--threads")
            options.threads = uint32_t(std::max(1, std::atoi(value)));
        else if (option == "--seed")
            options.seed = std::strtoull(value, nullptr, 10);
        else if (option == "--patience")
            options.patience_s = std::atof(value);
        else if (option == "--only")
            options.only = value;
        else
            return false;
    }
    return true;
}

int weather(const Options& options) {
    std::vector<Call> calls;
    for (const Call& call : kCalls)
        if (wanted(call.name, options.only)) calls.push_back(call);
    if (calls.empty()) {
        std::fprintf(stderr, "storm: no function starts with %s\n", options.only.c_str());
        return 2;
    }
    // Recordings go where nobody else writes.
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("vfit-storm-" + std::to_string(getpid()));
    std::filesystem::create_directory(folder);
    std::filesystem::current_path(folder);
    Pool pool;
    teach(pool);
    const uint64_t before = main_job();
    std::vector<Report> reports(options.threads);
    std::atomic<uint64_t> done{0};
    std::vector<Now> now(options.threads);
    const auto start = Clock::now();
    {
        const std::jthread watcher([&](std::stop_token stop) { watch(stop, now, options.patience_s); });
        std::vector<std::jthread> threads;
        for (uint32_t t = 0; t < options.threads; ++t)
            threads.emplace_back([&, t] { run(pool, options, t, calls, done, now[t], reports[t]); });
    }
    const double seconds = seconds_since(start);
    Report all;
    for (Report& report : reports) {
        for (const auto& [name, tally] : report.functions) {
            Tally& sum = all.functions[name];
            sum.calls += tally.calls;
            sum.successes += tally.successes;
            sum.seconds += tally.seconds;
            sum.longest_s = std::max(sum.longest_s, tally.longest_s);
            if (!tally.last_error.empty()) sum.last_error = tally.last_error;
        }
        for (const auto& [result, count] : report.results) all.results[result] += count;
        all.broken.insert(all.broken.end(), report.broken.begin(), report.broken.end());
    }
    print(all, options, seconds);

    if (vfit_shutdown() != VFIT_OK) all.broken.push_back("vfit_shutdown failed at the end");
    if (Pixels::lent != 0)
        all.broken.push_back(std::to_string(Pixels::lent) + " lent images were not given back");
    if (before == 0 || main_job() != before)
        all.broken.push_back("the main job ends otherwise after the storm");
    // A damaged plug-in or a path into nowhere is all that these get.
    static const char* const kNeverSucceed[] = {"vfit_plugin_load"};
    constexpr uint64_t kEnoughTries =
        3000;  // with fewer, slow functions under a sanitizer can be out of luck
    for (const Call& call : calls)
        if (options.only.empty() && all.functions[call.name].calls >= kEnoughTries &&
            all.functions[call.name].successes == 0 &&
            std::ranges::none_of(kNeverSucceed,
                                 [&](const char* name) { return std::string(name) == call.name; }))
            all.broken.push_back(std::string(call.name) + ": never succeeded; " +
                                 all.functions[call.name].last_error);
    std::filesystem::current_path(folder.parent_path());
    std::filesystem::remove_all(folder);
    for (const std::string& what : all.broken) std::printf("BROKEN %s\n", what.c_str());
    return all.broken.empty() ? 0 : 1;
}

}  // namespace
}  // namespace storm

int main(int argc, char** argv) {
    storm::Options options;
    if (!storm::parse(argc, argv, options)) {
        std::fprintf(stderr,
                     "storm [--calls N] [--threads N] [--seed N] [--only PREFIX,PREFIX] [--patience SECONDS] "
                     "[--times]\n");
        return 2;
    }
    return storm::weather(options);
}
