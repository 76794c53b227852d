#include "frame_rows.h"

namespace recording {

namespace {

// Largest time stamp, so that differences do not overflow: about 146 years.
constexpr int64_t kMaxTimeNs = INT64_MAX / 2;

void check_header(const CsvFile& csv, const std::vector<std::string>& wanted) {
    if (csv.columns() == wanted) return;
    std::string names;
    for (const std::string& name : wanted) names += (names.empty() ? "" : ",") + name;
    csv.refuse("the header is not ", names);
}

int64_t rising_frame(const CsvFile& csv, int64_t last) {
    const int64_t frame = csv.integer(0, 0);
    if (frame <= last) csv.refuse("frame ", frame, " comes after frame ", last, "; rows must rise");
    return frame;
}

}  // namespace

TimestampsFile::TimestampsFile(const std::filesystem::path& path) : csv_(path) {
    check_header(csv_, {"frame", "time_ns"});
}

bool TimestampsFile::next() {
    if (!csv_.next()) return false;
    const int64_t frame = rising_frame(csv_, frame_);
    const int64_t time = csv_.integer(1, 0);
    if (time > kMaxTimeNs) csv_.refuse("time ", time, " ns is out of range");
    if (frame_ >= 0 && time < time_ns_) csv_.refuse("time ", time, " ns comes after ", time_ns_, " ns");
    frame_ = frame;
    time_ns_ = time;
    return true;
}

void TimestampsFile::check() {
    rewind();
    while (next()) {
    }
    rewind();
}

void TimestampsFile::rewind() {
    csv_.rewind();
    pending_ = false;
    frame_ = -1;
    time_ns_ = 0;
}

std::optional<int64_t> TimestampsFile::time_ns(int64_t frame) {
    while (pending_ || next()) {
        pending_ = frame_ > frame;
        if (pending_) break;
        if (frame_ == frame) return time_ns_;
    }
    return std::nullopt;
}

ContactsFile::ContactsFile(const std::filesystem::path& path) : csv_(path) {
    check_header(csv_, {"frame", "left", "right"});
}

bool ContactsFile::next() {
    if (!csv_.next()) return false;
    frame_ = rising_frame(csv_, frame_);
    const int64_t left = csv_.integer(1, 0), right = csv_.integer(2, 0);
    if (left > 2 || right > 2) csv_.refuse("a contact is 0, 1 or 2");
    contacts_ = {int(left), int(right)};
    return true;
}

void ContactsFile::check() {
    rewind();
    while (next()) {
    }
    rewind();
}

void ContactsFile::rewind() {
    csv_.rewind();
    pending_ = false;
    frame_ = -1;
}

std::optional<Contacts> ContactsFile::contacts(int64_t frame) {
    while (pending_ || next()) {
        pending_ = frame_ > frame;
        if (pending_) break;
        if (frame_ == frame) return contacts_;
    }
    return std::nullopt;
}

}  // namespace recording
