// What vfit-bench measures with: pinned threads, medians, and the parts it is made of.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "client/client.h"
#include "client/command_line.h"
#include "population/library_file.h"

namespace vfit::tools {

/// Keeps this thread, and those it starts, on the first cores that the process may use, that many or all
/// there are (Linux; elsewhere nothing).
void pin_to_cores(unsigned count);

class Timer {
public:
    double ms() const {
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Samples of one time, in milliseconds.
class Samples {
public:
    void add(double ms) { values_.push_back(ms); }
    bool empty() const { return values_.empty(); }
    size_t size() const { return values_.size(); }
    double quantile(double q) const;
    /// {"median", "p95", "n"}
    Json json() const;

private:
    std::vector<double> values_;
};

void add_stages(Command& app);
void add_people(Command& app);
void add_population(Command& app);
void add_recordings(Command& app);
void add_track(Command& app);
void add_cloth(Command& app);
void add_drape(Command& app);
void add_user_map(Command& app);
void add_fit(Command& app);
void add_measure(Command& app);
void add_scan_features(Command& app);
void add_odd_scans(Command& app);
void add_motion(Command& app);
void add_contact_features(Command& app);
void add_garments(Command& app);
void add_layers(Command& app);
void add_refit_bench(Command& app);
void add_bodies(Command& app);

}  // namespace vfit::tools
