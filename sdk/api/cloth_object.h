// The object behind vfit_cloth: a worn garment, its frames, and the set of cloths that it is stepped with.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "api/avatar_object.h"
#include "api/cloth_set.h"
#include "api/garment_object.h"
#include "api/mesh_frame.h"
#include "api/prop_object.h"
#include "outfit/worn_together.h"

namespace vfit::api {

struct ClothObject : ContextChild {
    static constexpr Kind kKind = Kind::cloth;
    /// The caller has the avatar for itself.
    ClothObject(Ref<AvatarObject> avatar_object, Ref<GarmentObject> garment_object,
                const WearOptions& options);
    ~ClothObject() override;
    void handle_died() override;

    const Ref<AvatarObject> avatar;
    const Ref<GarmentObject> garment;
    WornGarment worn;
    MeshOutput output;

    // Calls on one cloth of a set. They have this cloth for themselves, and take all that are worn with it.
    // The first one that steps in a frame steps all; the others then find it done.
    void step(float dt);
    void start_step(float dt);
    /// Waits for the step of start_step().
    void finish_step();
    void require_no_step() const { set_->require_no_step(); }
    void put_on();
    void change_size(const char* label);
    void set_wind(const Vec3& wind_m_s);
    void set_quality(uint32_t substeps, float budget_ms);
    void wear_over(const Ref<ClothObject>& inner);
    void meet(const Ref<PropObject>& prop);
    void pass(const Ref<PropObject>& prop);

    /// Publishes the last finished step in the pose that the avatar has now.
    void reskin();

    /// To one value a vertex that is drawn, of one a simulated vertex.
    void write_drawn(const std::vector<float>& values, float* to) const;

private:
    friend class ClothsOfCall;

    /// Ends the step of a cloth that was destroyed meanwhile; any other is an error.
    void require_settled();
    Reading read_avatar() { return {avatar->access, "avatar"}; }
    void drop_destroyed_props();
    void publish_step();
    void write_mesh(const FinishedStep::Reskinned& mesh, const MeshOutput::Vertices& to) const;
    void publish(const FinishedStep::Reskinned& mesh, int64_t time_ns, Ref<Frame> frame);

    std::shared_ptr<ClothSet> set_;  // changed by calls that have all of its cloths for themselves, under
                                     // avatar->cloth_sets
    bool is_unnamed_ = false;        // its handle died; under avatar->cloth_sets
    bool has_begun_ = false;         // between start_step and finish_step
    bool is_stepped_ = false;        // in this frame, by a call on another cloth
    bool is_put_on_ = false;         // the same
    std::vector<Ref<PropObject>> props_;  // that `worn` meets
    std::vector<Reading> prop_readings_;  // room for those of a call
    Ref<Frame> next_;                     // of the step that has begun
};

}  // namespace vfit::api
