// Writes frames as a recording folder (docs/recording.md) that stays readable if the process dies: a picture
// is complete before its name appears, and the rows of a frame follow its pictures.
#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "frame/frame.h"
#include "record/png_writer.h"

namespace vfit {

struct RecorderDesc {
    std::string sensor_name = "unknown";
    float rate_hz = 30.0f;
    bool segmented = false;  // the background was removed already
};

class Recorder {
public:
    /// path must not exist or be an empty folder: VFIT_ERROR_ARGUMENT; VFIT_ERROR_IO where it cannot be made.
    Recorder(const std::string& path, const RecorderDesc& desc);
    ~Recorder();

    /// Fails with VFIT_ERROR_DATA where the frame differs in size, streams or intrinsics from the first, with
    /// VFIT_ERROR_IO where the disk does not take it; a frame that failed is not part of the recording.
    void write(const Frame& frame);
    void close();

    uint32_t frame_count() const { return count_; }

private:
    /// Ground truth that a virtual person's frame brings along, as text.
    struct Truth {
        std::string contacts;  // ",1,0"; empty: none
        std::string measures;  // JSON; empty: none, or written already
    };

    void check(const Frame& frame) const;
    Truth read_truth(const Frame& frame) const;
    void begin(const Frame& frame);
    void write_images(const Frame& frame);
    void write_rows(const Frame& frame, const Truth& truth);
    void write_joints(const Frame& frame);
    void open_table(std::ofstream& file, const char* name, const std::string& header);
    void append_row(std::ofstream& file, const char* name, const std::string& header);
    std::string image_path(const char* folder) const;

    const std::string path_;
    RecorderDesc desc_;
    PngWriter png_;
    uint32_t count_ = 0;
    Camera camera_;  // of the first frame
    bool has_mask_ = false, has_color_ = false, has_measures_ = false, closed_ = false;
    std::ofstream timestamps_, joints_file_, contacts_;
    std::string row_;
    std::vector<uint8_t> mask_;
};

}  // namespace vfit
