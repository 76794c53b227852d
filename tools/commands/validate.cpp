// vfit validate: scans beside tape measures of the same people, as ISO 20685-1 and Bland and Altman count it.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>

#include "client/agreement.h"
#include "client/csv_rows.h"
#include "client/files.h"
#include "client/output.h"
#include "client/people.h"
#include "client/progress.h"
#include "commands/commands.h"
#include "picture/agreement_plot.h"

namespace vfit::tools {

namespace {

namespace fs = std::filesystem;

constexpr uint32_t kSideFrames = 15, kNotSaid = UINT32_MAX;
constexpr const char* kTable = "tapes.csv";
constexpr const char* kDrawn[] = {"stature_m", "chest_girth_m", "waist_girth_m", "hip_girth_m"};

struct Options {
    std::string folder, calibration, picture;
    uint32_t frames = 0, side_frames = kNotSaid;
    bool json = false, bare = false, tight = false, turn = false;
    TrackOptions track;
};

/// One scan to be made or read, and what a tape told of that person.
struct Case {
    std::string person, scan;  // scan: a recording, a sensor's URI, or a file of measures
    std::optional<std::string> sex;
    std::optional<bool> bare, tight, turn;
    std::map<std::string, double> tape;  // empty: the recording has it
};

bool is_measure(const std::string& name) {
    char key[48];
    for (uint32_t i = 0; vfit_measure_key(i, key, sizeof key) > 0; ++i)
        if (name == key) return true;
    return name.rfind("x_", 0) == 0 && name.size() > 4 && name.substr(name.size() - 2) == "_m";
}

struct Column {
    std::string name;
    double unit = 1.0;
    bool measure = false;
};

/// "waist_girth_m", "waist_girth_cm", "waist_girth_mm" or "waist_girth_in".
Column column_of(const std::string& name, const CsvRows& rows) {
    for (const char* word : {"person", "scan", "sex", "bare", "tight", "turn"})
        if (name == word) return {name};
    if (is_measure(name)) return {name, 1.0, true};
    for (const auto& [end, unit] :
         {std::pair<std::string, double>{"_cm", 0.01}, {"_mm", 0.001}, {"_in", 0.0254}})
        if (name.size() > end.size() && name.substr(name.size() - end.size()) == end) {
            const std::string key = name.substr(0, name.size() - end.size()) + "_m";
            if (is_measure(key)) return {key, unit, true};
        }
    rows.fail("the column \"" + name +
              "\" is none of scan, person, sex, bare, tight, turn, and no measure in m, cm, mm, in or kg");
}

bool yes(const CsvRows& rows, size_t column) {
    const std::string_view text = rows.cell(column);
    if (text == "1" || text == "yes") return true;
    if (text == "0" || text == "no") return false;
    rows.fail(column, "is none of yes, no, 1 and 0");
}

std::vector<Case> cases_of_table(const fs::path& file) {
    std::ifstream in(file);
    if (!in) throw Failure(file.string() + ": cannot be read");
    CsvRows rows(in, file.string());
    if (!rows.next()) throw Failure(file.string() + ": is empty");
    std::vector<Column> columns;
    for (size_t i = 0; i < rows.size(); ++i) {
        columns.push_back(column_of(std::string(rows.cell(i)), rows));
        for (size_t k = 0; k < i; ++k)
            if (columns[k].name == columns[i].name)
                rows.fail(i, "is the second column of " + columns[i].name);
    }
    if (std::none_of(columns.begin(), columns.end(), [](const Column& c) { return c.name == "scan"; }))
        rows.fail("there is no column \"scan\"");
    std::vector<Case> cases;
    while (rows.next()) {
        rows.check_size(columns.size());
        Case one;
        for (size_t i = 0; i < columns.size(); ++i) {
            const std::string text(rows.cell(i));
            const std::string& name = columns[i].name;
            if (text.empty()) continue;
            if (columns[i].measure) {
                one.tape[name] = columns[i].unit * rows.number(i);
                try {
                    measurements_from(Json{{name, one.tape[name]}}.dump());
                } catch (const Failure& failure) {
                    rows.fail(i, std::string("is not plausible: ") + failure.what());
                }
            } else if (name == "scan") {
                const fs::path beside = file.parent_path() / text;
                std::error_code error;
                one.scan = fs::exists(beside, error) ? beside.string() : text;
            } else if (name == "person") {
                one.person = text;
            } else if (name == "sex") {
                if (text != "f" && text != "m") rows.fail(i, "is neither f nor m");
                one.sex = text;
            } else {
                (name == "bare" ? one.bare : name == "tight" ? one.tight : one.turn) = yes(rows, i);
            }
        }
        if (one.scan.empty()) rows.fail("no scan is named");
        if (one.person.empty()) one.person = one.scan;
        cases.push_back(one);
    }
    return cases;
}

/// Recordings that hold their person's measures, in the recording or one folder above.
std::vector<Case> cases_of_folder(const fs::path& folder) {
    std::vector<Case> cases;
    constexpr std::string_view kTexel = ".scan.xml";
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (name.size() >= kTexel.size() &&
            name.compare(name.size() - kTexel.size(), kTexel.size(), kTexel) == 0)
            throw Failure(folder.string() +
                          ": holds scans of a Texel scanner: make recordings of them with " +
                          "python3 tools/import_scans " + folder.string() + " OUT");
        if (name != "camera.json") continue;
        const fs::path recording = entry.path().parent_path(), above = recording.parent_path();
        Case one;
        one.scan = recording.string();
        if (fs::exists(recording / "measures.json"))
            one.person = recording.string();
        else if (fs::exists(above / "measures.json"))
            one.person = above.string();
        else
            continue;
        cases.push_back(one);
    }
    std::sort(cases.begin(), cases.end(), [](const Case& a, const Case& b) { return a.scan < b.scan; });
    return cases;
}

std::vector<Case> find_cases(const std::string& path) {
    std::error_code error;
    if (fs::is_directory(path, error)) {
        if (fs::exists(fs::path(path) / kTable)) return cases_of_table(fs::path(path) / kTable);
        std::vector<Case> cases = cases_of_folder(path);
        if (cases.empty())
            throw Failure(path + ": holds neither " + kTable + " nor a recording with measures.json");
        return cases;
    }
    return cases_of_table(path);
}

/// What the recording itself says of its person.
std::map<std::string, double> tape_of(vfit_frame frame) {
    std::string text(1u << 16, 0);
    uint32_t length = 0;
    std::map<std::string, double> tape;
    if (vfit_frame_meta(frame, "measures", text.data(), uint32_t(text.size()), &length) != VFIT_OK)
        return tape;
    const Json measures = Json::parse(text.c_str());
    for (const auto& [key, value] : measures.items())
        if (is_measure(key)) tape[key] = value.get<double>();
    return tape;
}

std::vector<vfit_measurement> scanned(vfit_context context, const Options& o, Case& one) {
    constexpr std::string_view kEnd = ".json";
    if (one.scan.size() > kEnd.size() &&
        one.scan.compare(one.scan.size() - kEnd.size(), kEnd.size(), kEnd) == 0)
        return read_measures(one.scan).measurements;
    const bool turn = one.turn.value_or(o.turn);
    Frame last;
    const ScanRun run = scan_source(context, one.scan,
                                    {o.frames, sex_from(one.sex.value_or("unknown")), VFIT_SCAN_FIT, o.track,
                                     o.side_frames != kNotSaid ? o.side_frames
                                     : turn                    ? 0u
                                                               : kSideFrames,
                                     (one.bare.value_or(o.bare) ? uint32_t{VFIT_SCAN_BARE} : 0u) |
                                         (one.tight.value_or(o.tight) ? uint32_t{VFIT_SCAN_TIGHT} : 0u) |
                                         (turn ? uint32_t{VFIT_SCAN_TURN} : 0u)},
                                    &last);
    if (one.tape.empty()) one.tape = tape_of(last.get());
    return measurements_of(run.scan.get());
}

using ByMeasure = std::map<std::string, std::vector<Compared>>;

Json validate(const Options& o, ByMeasure& compared) {
    std::vector<Case> cases = find_cases(o.folder);
    const std::string calibration = o.calibration.empty() ? std::string() : read_text(o.calibration);
    const Context context = open_context();
    Json failed = Json::array();
    {
        Progress progress("scans");
        for (size_t i = 0; i < cases.size(); ++i) {
            Case& one = cases[i];
            try {
                std::vector<vfit_measurement> list = scanned(context.get(), o, one);
                if (!calibration.empty()) list = calibrated_measurements(calibration, list);
                if (one.tape.empty()) throw Failure("no tape measure of this person is known");
                bool common = false;
                for (const vfit_measurement& m : list)
                    if (const auto at = one.tape.find(m.key); at != one.tape.end()) {
                        compared[m.key].push_back({one.person, double(m.value), double(m.sigma), at->second});
                        common = true;
                    }
                if (!common) throw Failure("scan and tape have no measure in common");
            } catch (const Failure& failure) {
                failed.push_back({{"scan", one.scan}, {"reason", failure.what()}});
            }
            progress.at(i + 1, cases.size());
        }
    }
    Json out = {{"scans", cases.size()}, {"failed", failed}, {"measures", Json::object()}};
    for (const auto& [key, list] : compared) {
        const Agreement a = agreement(list);
        const double limit = iso_20685_limit_m(key);
        Json one = {
            {"people", a.people}, {"scans", a.scans}, {"bias", a.bias}, {"mean_absolute", a.mean_absolute}};
        if (a.scans > 1) one["sd"] = a.sd, one["limits_of_agreement"] = {a.low, a.high};
        if (a.told > 0) one["within_90_percent"] = a.covered;
        if (std::isfinite(a.confidence)) one["bias_confidence"] = a.confidence;
        if (limit > 0.0) {
            const Verdict verdict = iso_20685_verdict(a, limit);
            one["iso_20685_m"] = limit;
            one["iso_20685"] = verdict == Verdict::kPasses  ? "passes"
                               : verdict == Verdict::kFails ? "fails"
                                                            : "open";
        }
        out["measures"][key] = one;
    }
    return out;
}

std::string text_of(double value, int digits) {
    std::ostringstream out;
    out << std::fixed << std::setprecision(digits) << value;
    return out.str();
}

void print(const Json& result) {
    std::cout << result["scans"] << " scans, " << result["failed"].size() << " of them failed\n";
    for (const Json& failed : result["failed"])
        std::cout << "  " << failed["scan"].get<std::string>() << ": " << failed["reason"].get<std::string>()
                  << "\n";
    std::cout << "mm (kg); bias with 95 % confidence; limits of agreement; scans within the 90 % interval; "
                 "ISO 20685-1: bound of the bias\n"
              << std::left << std::setw(24) << "" << std::right << std::setw(7) << "people" << std::setw(16)
              << "bias" << std::setw(8) << "sd" << std::setw(10) << "absolute" << std::setw(18) << "limits"
              << std::setw(8) << "within" << "  ISO 20685-1\n";
    for (const auto& [key, m] : result["measures"].items()) {
        const bool mass = key.size() > 3 && key.substr(key.size() - 3) == "_kg";
        const double unit = mass ? 1.0 : 1000.0;
        const auto amount = [&](const Json& value) { return unit * value.get<double>(); };
        std::cout << std::left << std::setw(24) << key << std::right << std::setw(7)
                  << m["people"].get<uint32_t>() << std::fixed << std::setprecision(1) << std::setw(8)
                  << amount(m["bias"]);
        if (m.contains("bias_confidence"))
            std::cout << " +-" << std::setw(5) << amount(m["bias_confidence"]);
        else
            std::cout << "        ";
        const bool several = m.contains("sd"), told = m.contains("within_90_percent");
        std::cout << std::setw(8) << (several ? text_of(amount(m["sd"]), 1) : "-") << std::setw(10)
                  << amount(m["mean_absolute"]) << std::setw(9)
                  << (several ? text_of(amount(m["limits_of_agreement"][0]), 1) : "-") << std::setw(9)
                  << (several ? text_of(amount(m["limits_of_agreement"][1]), 1) : "-") << std::setw(6)
                  << (told ? text_of(100.0 * m["within_90_percent"].get<double>(), 0) + " %" : "-")
                  << std::setprecision(0);
        if (m.contains("iso_20685"))
            std::cout << "  " << 1000.0 * m["iso_20685_m"].get<double>()
                      << " mm: " << m["iso_20685"].get<std::string>();
        std::cout << "\n";
    }
    std::cout << "open: fewer than " << kIsoPeople
              << " people, or the interval of the bias reaches over the bound\n";
}

void draw(const Options& o, const ByMeasure& compared) {
    std::vector<AgreementPanel> panels;
    for (const char* key : kDrawn)
        if (const auto at = compared.find(key); at != compared.end())
            panels.push_back({key, at->second, iso_20685_limit_m(key)});
    for (const auto& [key, list] : compared)
        if (panels.empty())
            panels.push_back({key, list, iso_20685_limit_m(key), key.find("_kg") != std::string::npos});
    draw_agreement(panels).write_png(o.picture);
}

}  // namespace

void add_validate(Command& app) {
    Command command = app.add_subcommand("validate", "Judge scans by tape measures of the same people");
    auto o = std::make_shared<Options>();
    command
        .add_option("folder", o->folder,
                    "Table of scans and tape measures, folder with tapes.csv, or folder of recordings that "
                    "hold measures.json")
        .required();
    command.add_option("--frames", o->frames, "Frames to average (default 30)").within(1, 3000);
    command
        .add_option("--side-frames", o->side_frames,
                    "Frames to wait for from the side (default 15, with a turn 0)")
        .within(0, 3000);
    command.add_flag("--bare", o->bare, "No shoes, and no hair on the crown, where the table does not say");
    command.add_flag("--tight", o->tight, "The clothes lie on the skin, where the table does not say");
    command.add_flag("--turn", o->turn, "People turn once round, where the table does not say");
    command.add_option("--calibration", o->calibration, "What your own tape differs by (vfit calibrate)");
    command.add_option("--picture", o->picture, "PNG file for Bland and Altman's picture");
    command.add_flag("--json", o->json, "Print JSON");
    add_track_options(command, o->track);
    command.callback([o] {
        ByMeasure compared;
        const Json result = validate(*o, compared);
        if (compared.empty())
            throw Failure("no scan could be compared with a tape" +
                          (result["failed"].empty()
                               ? std::string()
                               : ": " + result["failed"][0]["reason"].get<std::string>()));
        if (o->json)
            print_document(result);
        else
            print(result);
        if (!o->picture.empty()) draw(*o, compared);
    });
}

}  // namespace vfit::tools
