// The object behind vfit_cloth: a worn garment, its frames, and the step that may run beside the host.
#pragma once

#include <vector>

#include "api/avatar_object.h"
#include "api/garment_object.h"
#include "api/mesh_frame.h"
#include "api/prop_object.h"
#include "core/jobs.h"
#include "outfit/worn_garment.h"

namespace vfit::api {

struct ClothObject : ContextChild {
    static constexpr Kind kKind = Kind::cloth;
    /// The caller has the avatar for itself.
    ClothObject(Ref<AvatarObject> avatar_object, Ref<GarmentObject> garment_object,
                const WearOptions& options);
    ~ClothObject() override;

    const Ref<AvatarObject> avatar;
    const Ref<GarmentObject> garment;
    WornGarment worn;
    MeshOutput output;

    /// A step that has begun takes nothing from the avatar any more: that may move on.
    void begin_step(float dt);
    void step();
    void end_step();
    /// begin_step, then a step on another thread.
    void start_step(float dt);
    /// Waits for that one.
    void finish_step();
    void require_no_step() const;

    void put_on();
    void change_size(const char* label);
    /// Publishes the last finished step in the pose that the avatar has now.
    void reskin();
    void wear_over(const Ref<ClothObject>& inner);
    void meet(const Ref<PropObject>& prop);
    void pass(const Ref<PropObject>& prop);

    /// To one value a vertex that is drawn, of one a simulated vertex: copies have that of theirs.
    template <typename T, typename Convert>
    void write_drawn(const std::vector<T>& values, T* to, const Convert& convert) const {
        for (const T& value : values) *to++ = convert(value);
        for (const uint32_t of : worn.garment().copies) *to++ = convert(values[of]);
    }

private:
    Reading read_avatar() { return {avatar->access, "avatar"}; }
    void see_layers();
    const std::vector<Vec3>& stepped() const;
    void drop_destroyed_props();
    class ReadingProps;
    void read_below(const ClothObject& end, std::vector<Reading>& readings) const;
    void publish_step();
    void publish(const FinishedStep::Reskinned& mesh, int64_t time_ns, Ref<Frame> frame);

    std::vector<Ref<ClothObject>> below_;  // the layers of `worn`
    std::vector<Ref<PropObject>> props_;   // that `worn` meets
    std::vector<Reading> prop_readings_;   // room for those of a call
    bool stepping_ = false;                // between start_step and finish_step
    Ref<Frame> next_;                      // of the step that has begun
    Jobs::Later later_;
};

}  // namespace vfit::api
