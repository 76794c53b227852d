#include "offline/catalogue.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <thread>

#include "client/child.h"
#include "client/files.h"
#include "client/output.h"

namespace vfit::tools {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* kJournal = "designs.jsonl";

/// GarmentCode's generator writes what was simulated of a specification beside it.
bool is_simulation(const fs::path& mesh) {
    const std::string tail = "_specification.json";
    for (const auto& entry : fs::directory_iterator(mesh.parent_path()))
        if (entry.path().filename().string().ends_with(tail)) return true;
    return false;
}

bool is_below(const fs::path& file, const fs::path& folder) {
    const fs::path inside = fs::weakly_canonical(file), outer = fs::weakly_canonical(folder);
    return std::mismatch(outer.begin(), outer.end(), inside.begin(), inside.end()).first == outer.end();
}

std::vector<fs::path> designs_in(const CatalogueOptions& options) {
    if (fs::weakly_canonical(options.folder) == fs::weakly_canonical(options.out))
        throw Failure(options.out + " is the folder of the designs: garments would take their names (--out)");
    const bool has_out = is_below(options.out, options.folder);  // what lies there was cooked
    std::vector<fs::path> designs;
    for (const auto& entry : fs::recursive_directory_iterator(options.folder))
        if (entry.is_regular_file() &&
            (entry.path().extension() == ".json" || options.is_mesh(entry.path().string())) &&
            !(has_out && is_below(entry.path(), options.out)))
            designs.push_back(entry.path());
    std::sort(designs.begin(), designs.end());
    if (designs.empty())
        throw Failure("there is no design (*.json) and no mesh (*.obj, *.gltf, *.glb) in " + options.folder);
    return designs;
}

bool is_none(const fs::path& design, const CatalogueOptions& options) {
    return options.is_mesh(design.string()) ? is_simulation(design) : !options.is_design(design.string());
}

/// FNV-1a, 64 bits.
class Hash {
public:
    void add(std::string_view bytes) {
        for (const char c : bytes) {
            value_ ^= static_cast<unsigned char>(c);
            value_ *= 0x100000001b3ull;
        }
        value_ *= 0x100000001b3ull;  // between two texts
    }
    std::string text() const {
        char out[17];
        std::snprintf(out, sizeof out, "%016llx", static_cast<unsigned long long>(value_));
        return out;
    }

private:
    uint64_t value_ = 0xcbf29ce484222325ull;
};

/// Of all that a design is made of: its own bytes, what lies beside it and is none, the options, the program.
std::string key_of(const fs::path& design, const CatalogueOptions& options) {
    Hash hash;
    hash.add(std::to_string(vfit_version()));
    for (const std::string& word : options.cook) hash.add(word);
    hash.add(read_text(design.string()));
    std::set<std::string> beside;
    for (const auto& entry : fs::directory_iterator(design.parent_path()))
        if (entry.is_regular_file() && entry.path().extension() != ".json" &&
            !options.is_mesh(entry.path().string()))
            beside.insert(entry.path().filename().string() + " " + std::to_string(entry.file_size()) + " " +
                          std::to_string(entry.last_write_time().time_since_epoch().count()));
    for (const std::string& file : beside) hash.add(file);
    return hash.text();
}

class Catalogue {
public:
    Catalogue(const CatalogueOptions& options, const std::function<void(const Json&)>& tell)
        : options_(options), tell_(tell), designs_(designs_in(options)), rows_(designs_.size()) {}

    Json run() {
        create_folder(options_.out);
        create_folder((fs::path(options_.out) / "pictures").string());
        if (options_.resume) read_journal();
        for (size_t i = 0; i < designs_.size(); ++i) take_up(i);
        rewrite_journal();
        work();
        write_report();
        return report();
    }

private:
    /// A row each of what was cooked before: the last of each design.
    void read_journal() {
        std::ifstream file(fs::path(options_.out) / kJournal);
        for (std::string line; std::getline(file, line);) {
            const Json row = Json::parse(line, nullptr, false);
            if (is_row(row)) old_[row["design"].get<std::string>()] = row;
        }
    }

    /// Of a line that was cut off, or written by hand, nothing is believed.
    static bool is_row(const Json& row) {
        const auto is_text = [](const Json& of, const char* key) {
            return of.is_object() && of.contains(key) && of[key].is_string();
        };
        for (const char* key : {"design", "key", "name", "state"})
            if (!is_text(row, key)) return false;
        if (!row.contains("seconds") || !row["seconds"].is_number()) return false;
        if (row["state"] != "cooked") return is_text(row, "error");
        const auto is_garment = [&](const Json& g) {
            return is_text(g, "file") && is_text(g, "kind") && g.contains("vertices") && g.contains("sizes");
        };
        return row.contains("garments") && row["garments"].is_array() &&
               std::all_of(row["garments"].begin(), row["garments"].end(), is_garment);
    }

    /// Leaves out what is no design, keeps what is known of it, or gives it a name.
    void take_up(size_t i) {
        const fs::path& design = designs_[i];
        if (is_none(design, options_)) {
            rows_[i] = {{"design", design.string()}, {"state", "left_out"}};
            return;
        }
        const std::string key = key_of(design, options_);
        const auto known = old_.find(design.string());
        if (known != old_.end() && known->second["key"] == key && is_there(known->second)) {
            names_.insert(known->second["name"].get<std::string>());
            rows_[i] = known->second;
            return;
        }
        waiting_.push_back({i, key, ""});
    }

    /// What ended by its own word, and all its files with it.
    bool is_there(const Json& row) const {
        if (row["state"] == "failed") return true;
        if (row["state"] != "cooked") return false;
        return std::all_of(row["garments"].begin(), row["garments"].end(),
                           [](const Json& g) { return fs::exists(g["file"].get<std::string>()); });
    }

    std::string name_for(const fs::path& design) {
        std::string name = design.stem().string();
        if (names_.insert(name).second) return name;
        const std::string first = name = design.parent_path().filename().string() + "_" + name;
        for (int i = 2; !names_.insert(name).second; ++i) name = first + "_" + std::to_string(i);
        return name;
    }

    void rewrite_journal() {
        std::string text;
        for (const Json& row : rows_)
            if (row.contains("key")) text += row.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
        const std::string path = (fs::path(options_.out) / kJournal).string();
        replace_text(path, text);
        journal_.open(path, std::ios::binary | std::ios::app);
    }

    void work() {
        for (Waiting& w : waiting_) w.name = name_for(designs_[w.design]);
        std::vector<std::thread> workers;
        for (int i = 0; i < options_.jobs; ++i) workers.emplace_back([this] { cook_waiting(); });
        for (std::thread& worker : workers) worker.join();
        if (fault_) std::rethrow_exception(fault_);
    }

    void cook_waiting() {
        try {
            for (size_t i = next_++; i < waiting_.size() && !fault_seen_; i = next_++)
                enter(waiting_[i].design, cook(waiting_[i]));
        } catch (...) {
            const std::lock_guard lock(mutex_);
            if (!fault_) fault_ = std::current_exception();
            fault_seen_ = true;
        }
    }

    struct Waiting {
        size_t design;
        std::string key, name;
    };

    Json cook(const Waiting& w) const {
        const std::string file = (fs::path(options_.out) / (w.name + ".json")).string();
        const std::string picture = "pictures/" + w.name + ".png";
        std::vector<std::string> command = {own_program(),
                                            "cook",
                                            designs_[w.design].string(),
                                            "--out",
                                            file,
                                            "--picture",
                                            (fs::path(options_.out) / picture).string(),
                                            "--json"};
        command.insert(command.end(), options_.cook.begin(), options_.cook.end());
        const ChildResult done = run_child(command, options_.limit_s);
        Json row = {{"design", designs_[w.design].string()},
                    {"key", w.key},
                    {"name", w.name},
                    {"seconds", done.seconds}};
        const auto failed = [&](const char* state, const std::string& error) {
            row["state"] = state;
            row["error"] = error;
            return row;
        };
        if (done.end == ChildResult::End::over_time)
            return failed("over_time",
                          "took longer than " + std::to_string(int(options_.limit_s)) + " s (--limit)");
        if (done.end == ChildResult::End::crashed)
            return failed("crashed", "its process was ended by signal " + std::to_string(done.code));
        if (done.code != 0) return failed("failed", message_in(done.error));
        const Json report = Json::parse(done.out, nullptr, false);
        if (!report.is_object()) return failed("crashed", "its process printed no report");
        row["state"] = "cooked";
        row["garments"] = report.contains("garments") ? report["garments"] : Json::array({report});
        if (fs::exists(fs::path(options_.out) / picture)) row["picture"] = picture;
        return row;
    }

    /// "vfit: shirt.obj: ..." without the program and the line's end.
    static std::string message_in(const std::string& error) {
        const std::string opening = "vfit: ";
        std::string message = error.starts_with(opening) ? error.substr(opening.size()) : error;
        while (!message.empty() && message.back() == '\n') message.pop_back();
        return message;
    }

    void enter(size_t design, Json row) {
        const std::lock_guard lock(mutex_);
        journal_ << row.dump(-1, ' ', false, Json::error_handler_t::replace) << std::endl;
        if (!journal_) throw Failure(options_.out + "/" + kJournal + ": cannot be written");
        tell_(row);
        rows_[design] = std::move(row);
        constexpr std::chrono::seconds kBetween{2};  // a report of thousands is long
        if (written_ && Clock::now() - *written_ < kBetween) return;
        write_report();
        written_ = Clock::now();
    }

    void write_report() const {
        const Json whole = report();
        replace_text((fs::path(options_.out) / "report.json").string(), document_text(whole));
        replace_text((fs::path(options_.out) / "report.html").string(), catalogue_page(whole));
    }

    Json report() const {
        Json cooked = Json::array(), failed = Json::array(), left_out = Json::array(),
             designs = Json::array();
        for (size_t i = 0; i < rows_.size(); ++i) {
            const Json& row = rows_[i];
            if (row.is_null()) {
                designs.push_back({{"design", designs_[i].string()}, {"state", "waiting"}});
                continue;
            }
            if (row["state"] == "left_out")
                left_out.push_back(row["design"]);
            else if (row["state"] == "cooked")
                cooked.insert(cooked.end(), row["garments"].begin(), row["garments"].end());
            else
                failed.push_back({{"design", row["design"]}, {"error", row["error"]}});
            designs.push_back(row);
        }
        return {{"cooked", cooked}, {"failed", failed}, {"left_out", left_out}, {"designs", designs}};
    }

    const CatalogueOptions& options_;
    const std::function<void(const Json&)>& tell_;
    const std::vector<fs::path> designs_;
    std::map<std::string, Json> old_;  // by the design's path
    std::set<std::string> names_;
    std::vector<Waiting> waiting_;
    std::atomic<size_t> next_{0};

    std::mutex mutex_;        // of what follows
    std::vector<Json> rows_;  // one a design; null: not yet cooked
    std::ofstream journal_;
    std::optional<Clock::time_point> written_;  // the report was
    std::exception_ptr fault_;
    std::atomic<bool> fault_seen_{false};
};

}  // namespace

Json cook_catalogue(const CatalogueOptions& options, const std::function<void(const Json&)>& tell) {
    return Catalogue(options, tell).run();
}

}  // namespace vfit::tools
