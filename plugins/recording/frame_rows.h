// timestamps.csv and contacts.csv: at most one row a frame, read in step with the frames.
#pragma once

#include <optional>

#include "csv_file.h"

namespace recording {

/// Time stamps of the recording; a frame without a row lies one period after the frame before.
class TimestampsFile {
public:
    explicit TimestampsFile(const std::filesystem::path& path);
    void check();
    void rewind();
    /// Nanoseconds of a frame if it has a row; frames are asked for in rising order.
    std::optional<int64_t> time_ns(int64_t frame);

private:
    bool next();
    CsvFile csv_;
    bool pending_ = false;
    int64_t frame_ = -1, time_ns_ = 0;
};

/// As "contacts" of a frame's metadata: 0 free, 1 the whole foot stands, 2 only heel or ball does.
struct Contacts {
    int left = 0, right = 0;
};

class ContactsFile {
public:
    explicit ContactsFile(const std::filesystem::path& path);
    void check();
    void rewind();
    std::optional<Contacts> contacts(int64_t frame);

private:
    bool next();
    CsvFile csv_;
    bool pending_ = false;
    int64_t frame_ = -1;
    Contacts contacts_;
};

}  // namespace recording
