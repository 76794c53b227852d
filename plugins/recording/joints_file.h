// joints.csv: the bodies of each frame in camera space, read in step with the frames.
#pragma once

#include <filesystem>
#include <vector>

#include "csv_file.h"
#include "vfit.h"

namespace recording {

struct RecordedBody {
    uint32_t id = 1;
    std::vector<vfit_joint> joints;  // those that were seen
};

class JointsFile {
public:
    /// Checks the header. Fails with VFIT_ERROR_DATA, naming file and column.
    explicit JointsFile(const std::filesystem::path& path);

    /// Reads every row once, for its errors.
    void check();
    void rewind();
    /// The bodies of a frame, valid until the next call; frames are asked for in rising order. The count is
    /// returned; memory is reused.
    size_t bodies(int64_t frame, std::vector<RecordedBody>& out);

private:
    struct JointColumns {
        vfit_joint_id joint = 0;
        int x = -1, y = -1, z = -1, c = -1;
    };
    void read_header();
    bool next();
    void read_row(RecordedBody& body) const;
    bool read_joint(const JointColumns& columns, vfit_joint& joint) const;

    CsvFile csv_;
    std::vector<JointColumns> joints_;
    bool has_id_ = false;
    bool pending_ = false;       // a row was read that belongs to a later frame
    int64_t frame_ = -1;         // of the last row
    std::vector<uint32_t> ids_;  // seen in that frame
};

}  // namespace recording
