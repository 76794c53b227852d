// The room itself: camera, person, avatar and garment, from one picture to the next. Nothing here draws.
#pragma once

#include <array>
#include <chrono>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "abi.h"
#include "options.h"
#include "times.h"
#include "wardrobe.h"

namespace room {

/// As the vertex buffers have them: the library writes straight into these.
struct BodyVertex {
    float position[3], normal[3];
};
struct ClothVertex {
    float position[3], normal[3], strain;
};

/// What the camera sees, small enough for a corner of the picture: grey by depth, the person tinted.
struct CameraPicture {
    static constexpr uint32_t kMaxWidth = 320;
    uint32_t width = 0, height = 0;
    std::vector<uint32_t> rgba;
    uint64_t version = 0;
};

class Room {
public:
    explicit Room(const Options& options);

    // Each picture, in this order.
    /// The newest camera image, if there is one: tracked, and added to the scan as long as that lasts.
    /// Dresses the person once it is complete.
    void sense();
    /// The avatar as it stands now, its skin written to `to` (body_vertices() of them).
    void move(BodyVertex* to);
    /// The garment's clock: a step that has ended is taken, the next begun if it is time for it, and the
    /// cloth carried into the avatar's pose.
    void run_cloth(Times& times);
    void write_cloth(ClothVertex* to);  // cloth_vertices() of them

    // What the keys do.
    void choose_garment(int by);
    void choose_size(int by);
    void redress();
    void switch_physics();
    void switch_camera();

    /// There is a dressed avatar; what follows is of it.
    bool dressed() const { return bool(cloth_); }
    uint32_t body_vertices() const { return body_vertices_; }
    uint32_t cloth_vertices() const { return cloth_vertices_; }
    /// Triangles that can be seen, of the skin not hidden by the garment. The version rises when one of these
    /// changes.
    const std::vector<uint32_t>& body_indices() const { return seen_skin_; }
    const std::vector<uint32_t>& cloth_indices() const { return cloth_indices_; }
    const std::vector<float>& cloth_uvs() const { return cloth_uvs_; }
    uint64_t mesh_version() const { return mesh_version_; }
    struct Place {
        float x = 0, y = 0, z = 0;
    };
    struct Joints {
        Place pelvis, left_foot, right_foot;
        Place low, high;  // the box around all of them
    };
    const Joints& joints() const { return joints_; }
    /// The box around the garment.
    const Place& cloth_low() const { return cloth_low_; }
    const Place& cloth_high() const { return cloth_high_; }

    const CameraPicture& camera_picture() const { return camera_picture_; }
    bool film_ended() const { return ended_; }
    bool camera_on() const { return camera_on_; }
    bool physics() const { return physics_; }
    size_t garment_index() const { return garment_; }
    const Wardrobe& wardrobe() const { return wardrobe_; }
    const std::string& garment() const { return wardrobe_.piece(garment_).name; }
    const std::string& size() const { return wardrobe_.piece(garment_).sizes[size_]; }
    size_t size_index() const { return size_; }
    const std::vector<vfit_measurement>& measures() const { return measures_; }
    struct Person {
        float stature_m = 0, stature_sigma_m = 0;
        std::string size;  // recommended for the garment that is worn
        float probability = 0;
    };
    const Person& person() const { return person_; }
    const vfit_scan_state& scan_state() const { return scan_state_; }
    /// What the person should do, or what is wrong with the camera; empty: nothing.
    const char* message() const;
    double dress_ms() const { return dress_ms_; }  // of the last time that a garment was put on
    uint64_t camera_images() const { return camera_images_; }
    const std::string& source() const { return options_.source; }

private:
    void open_camera();
    void lose_camera(const std::string& why);
    void begin_scan();
    void scan(vfit_frame tracked, uint32_t body_id);
    void meet_person();
    void put_on();
    void recommend();
    void take_mesh();
    void hide_skin();
    void end_step(Times* times);
    void draw_camera(vfit_frame tracked);
    int64_t now_ns() const;

    const Options options_;
    Context context_;
    Wardrobe wardrobe_;
    Tracker tracker_;
    Sensor sensor_;
    bool camera_on_ = true, ended_ = false;
    std::string trouble_;  // with the camera
    std::chrono::steady_clock::time_point looked_for_it_{};

    Frame tracked_;  // the newest
    uint32_t body_id_ = 0;
    int64_t frame_ns_ = 0, nobody_since_ns_ = 0;
    std::chrono::steady_clock::time_point arrived_{};
    uint64_t camera_images_ = 0;
    CameraPicture camera_picture_;

    Scan scan_;
    vfit_scan_state scan_state_ = vfit_scan_state_init();
    bool scan_done_ = false;
    std::vector<vfit_measurement> measures_;
    Person person_;

    Motion motion_;
    Avatar avatar_;
    vfit_pose pose_ = vfit_pose_init();
    std::array<vfit_bone, VFIT_BONE_COUNT> bones_{};
    uint32_t bone_count_ = 0;
    Joints joints_;

    Cloth cloth_;
    Place cloth_low_, cloth_high_;
    size_t garment_ = 0, size_ = 0;
    bool size_chosen_ = false;  // by somebody; else the recommended one
    bool physics_ = true, stepping_ = false;
    int64_t stepped_ns_ = 0;    // when the last step began
    float interval_ms_ = 0.0f;  // that it advances by
    double dress_ms_ = 0.0;

    uint32_t body_vertices_ = 0, cloth_vertices_ = 0;
    std::vector<uint32_t> skin_, seen_skin_, cloth_indices_;
    std::vector<float> cloth_uvs_;
    std::vector<uint8_t> hidden_;
    std::map<std::pair<size_t, size_t>, std::vector<uint8_t>>
        hidden_by_;  // garment and size: found once a person
    uint64_t mesh_version_ = 0;
};

}  // namespace room
