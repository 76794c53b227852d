// vfit.h, part "avatar and cloth": cloth.
#include <cmath>

#include "api/cloth_desc.h"
#include "api/cloth_object.h"
#include "api/guard.h"
#include "api/structs.h"

using namespace vfit;
using namespace vfit::api;

vfit_result vfit_cloth_create(vfit_avatar avatar_handle, vfit_garment garment_handle,
                              const vfit_cloth_desc* desc, vfit_cloth* out) {
    return guard([&] {
        check_pointer(out, "out");
        out->id = 0;
        Use<AvatarObject, Mode::exclusive> avatar(avatar_handle.id);
        Use<GarmentObject, Mode::read> garment(garment_handle.id);
        if (avatar->context != garment->context)
            fail(VFIT_ERROR_HANDLE, "avatar and garment belong to different contexts");
        const WearOptions options = wear_options(desc, avatar->context->axes);
        if (!avatar->is_body())
            fail(VFIT_ERROR_UNSUPPORTED,
                 "garments are made for vfit's own body, not for a character from a file");
        const auto cloth = make<ClothObject>(avatar.ref(), garment.ref(), options);
        out->id = avatar->context->publish(Kind::cloth, cloth, avatar_handle.id);
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_destroy(vfit_cloth cloth) {
    return guard([&] {
        destroy<ClothObject>(cloth.id);
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_reset(vfit_cloth handle) {
    return guard([&] {
        Use<ClothObject, Mode::exclusive> cloth(handle.id);
        cloth->put_on();
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_step(vfit_cloth handle, float dt) {
    return guard([&] {
        Use<ClothObject, Mode::exclusive> cloth(handle.id);
        cloth->step(dt);
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_begin_step(vfit_cloth handle, float dt) {
    return guard([&] {
        Use<ClothObject, Mode::exclusive> cloth(handle.id);
        cloth->start_step(dt);
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_end_step(vfit_cloth handle) {
    return guard([&] {
        Use<ClothObject, Mode::exclusive> cloth(handle.id);
        cloth->finish_step();
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_set_size(vfit_cloth handle, const char* size_label) {
    return guard([&] {
        Use<ClothObject, Mode::exclusive> cloth(handle.id);
        cloth->change_size(size_label);
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_carry(vfit_cloth handle) {
    return guard([&] {
        Use<ClothObject, Mode::exclusive> cloth(handle.id);
        cloth->reskin();
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_teleport(vfit_cloth handle) {
    return guard([&] {
        Use<ClothObject, Mode::exclusive> cloth(handle.id);
        cloth->worn.teleport();  // a step that runs has taken its pose
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_set_wind(vfit_cloth handle, const float wind[3]) {
    return guard([&] {
        Use<ClothObject, Mode::exclusive> cloth(handle.id);
        check_pointer(wind, "wind");
        cloth->set_wind(cloth->context->axes.point_in({wind[0], wind[1], wind[2]}));
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_set_quality(vfit_cloth handle, uint32_t substeps, float budget_ms) {
    return guard([&] {
        Use<ClothObject, Mode::exclusive> cloth(handle.id);
        if (substeps > kMaxSubsteps)
            fail(VFIT_ERROR_ARGUMENT, "substeps ", substeps, " is more than ", kMaxSubsteps);
        cloth->set_quality(substeps ? substeps : ClothSettings().substeps, budget_ms);
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_wear_over(vfit_cloth handle, vfit_cloth inner_handle) {
    return guard([&] {
        Use<ClothObject, Mode::exclusive> cloth(handle.id);
        if (handle.id == inner_handle.id) fail(VFIT_ERROR_ARGUMENT, "a cloth cannot be worn over itself");
        Use<ClothObject, Mode::any> inner(inner_handle.id);
        cloth->wear_over(inner.ref());
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_hide_skin(vfit_cloth handle, float margin_m, uint8_t* triangles, uint32_t count) {
    return guard([&] {
        Use<ClothObject, Mode::read> cloth(handle.id);
        check_pointer(triangles, "triangles");
        cloth->require_no_step();
        if (!std::isfinite(margin_m) || margin_m < 0.0f)
            fail(VFIT_ERROR_ARGUMENT, "margin_m ", margin_m, " is no distance");
        constexpr float kUsualMargin_m = 0.03f;
        const size_t triangle_count = cloth->avatar->avatar.topology().indices.size() / 3;
        if (count != triangle_count)
            fail(VFIT_ERROR_ARGUMENT, "count is ", count, ", the avatar has ", triangle_count, " triangles");
        const auto hidden = cloth->worn.hidden_skin(margin_m > 0.0f ? margin_m : kUsualMargin_m);
        for (size_t i = 0; i < hidden.size(); ++i)
            if (hidden[i]) triangles[i] = 1;
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_fit(vfit_cloth handle, vfit_fit_zone* items, uint32_t stride, uint32_t* count) {
    return guard([&] {
        Use<ClothObject, Mode::read> cloth(handle.id);
        cloth->require_no_step();
        const auto fits = cloth->worn.fit();
        return write_list(items, stride, count, fits.size(), [&](size_t i) {
            const auto& [girth, verdict] = fits[i];
            vfit_fit_zone zone{};
            zone.fit = verdict == Fit::tight   ? VFIT_FIT_TIGHT
                       : verdict == Fit::loose ? VFIT_FIT_LOOSE
                                               : VFIT_FIT_RIGHT;
            zone.body_m = girth.body_m;
            zone.garment_m = girth.garment_m;
            zone.ease_m = girth.ease_m;
            zone.strain = girth.strain;
            zone.pressure_pa = girth.pressure_pa;
            zone.opening_m = girth.opening_m;
            set_text(zone.key, girth.key);
            return zone;
        });
    });
}

vfit_result vfit_cloth_fit_map(vfit_cloth handle, float* values, uint32_t count) {
    return guard([&] {
        Use<ClothObject, Mode::read> cloth(handle.id);
        check_pointer(values, "values");
        cloth->require_no_step();
        const uint32_t drawn_count = cloth->worn.garment().drawn_count();
        if (count != drawn_count)
            fail(VFIT_ERROR_ARGUMENT, "count is ", count, ", the garment has ", drawn_count, " vertices");
        cloth->write_drawn(cloth->worn.tightness(), values);
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_acquire(vfit_cloth handle, vfit_frame* out) {
    return guard([&] {
        check_pointer(out, "out");
        out->id = 0;
        Use<ClothObject, Mode::any> cloth(handle.id);
        out->id = cloth->context->publish(Kind::frame, cloth->output.latest());
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_describe(vfit_cloth handle, vfit_cloth_stats* out) {
    return guard([&] {
        Use<ClothObject, Mode::read> cloth(handle.id);
        check_output(out, "out");
        cloth->require_no_step();
        const ClothStats s = cloth->worn.stats();
        vfit_cloth_stats stats{};
        stats.vertex_count = s.vertex_count;
        stats.simulated_count = s.simulated_count;
        stats.constraint_count = s.constraint_count;
        stats.strain_mean = s.strain_mean;
        stats.strain_p99 = s.strain_p99;
        stats.strain_max = s.strain_max;
        stats.step_ms = s.step_ms;
        stats.substeps = s.substeps;
        stats.sleeves_taken_up_m = cloth->worn.taken_up().sleeves_m;
        stats.legs_taken_up_m = cloth->worn.taken_up().legs_m;
        stats.collider_count = uint32_t(cloth->worn.collider_count());
        write(out, stats);
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_state_hash(vfit_cloth handle, uint64_t* out) {
    return guard([&] {
        Use<ClothObject, Mode::read> cloth(handle.id);
        check_pointer(out, "out");
        cloth->require_no_step();
        *out = cloth->worn.state_hash();
        return VFIT_OK;
    });
}
