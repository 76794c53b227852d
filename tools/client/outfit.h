// Garments worn over each other on one avatar.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "client/client.h"

namespace vfit::tools {

/// The garment, in the size asked for, does not close around the body.
class NotWearable : public Failure {
public:
    using Failure::Failure;
};

/// Cloth whose longest edge exceeds twice its rest length has torn: a picture of it shows no fit.
constexpr float kMaxPlausibleStrain = 1.0f;
/// Of 1/60 s, of garments that are measured or drawn at rest: with few, cloth sags.
constexpr uint32_t kSubstepsAtRest = 32;

/// Between a garment's own layers: then they do not cross, and its edges meet the skin's.
constexpr float kOwnLayers_m = 0.004f;

struct Layer {
    std::string name;  // as it was asked for: a name or a path
    vfit_garment_info info = vfit_garment_info_init();
    Garment garment;
    Cloth cloth;
};

class WornOutfit {
public:
    /// names: garments by name or path from the innermost to the outermost, "A+B": B over A. The avatar must
    /// outlive the outfit. Throws NotWearable where a garment cannot be put on in the size that desc names.
    WornOutfit(vfit_context context, vfit_avatar avatar, const std::string& names,
               const vfit_cloth_desc& desc);

    /// The same with garments that are there, called so.
    WornOutfit(vfit_avatar avatar, std::vector<Garment> garments, const std::vector<std::string>& called,
               const vfit_cloth_desc& desc);

    const std::vector<Layer>& layers() const { return layers_; }
    std::vector<vfit_cloth> cloths() const;

    /// Puts everything on again, from the innermost layer outwards.
    void reset();
    void step(float seconds);
    /// So many steps of 1/60 s; then worst() is of how it lies, not of how it came there.
    void settle(int frames = 90);

    /// The largest strain of any edge since the last reset or forget_worst(): 1 is twice the rest length.
    struct Worst {
        float strain = 0.0f, time_s = 0.0f;
        std::string garment;
    };
    const Worst& worst() const { return worst_; }
    /// From now on worst() is of what comes.
    void forget_worst() { worst_ = {}; }
    /// Empty, or a sentence on the largest strain, where it exceeds kMaxPlausibleStrain.
    static std::string warning_of(const Worst& worst);
    std::string warning() const { return warning_of(worst_); }

private:
    void look_at_strain();

    std::vector<Layer> layers_;
    Worst worst_;
    float time_s_ = 0.0f;
};

/// A picture's title below the warning, so that no reader misses it.
std::string warned(const std::string& title, const std::string& warning);

/// The garment's parts whose look its file states; empty: none.
std::vector<vfit_garment_part> stated_parts(vfit_garment garment);

/// What a person of that sex wears where nothing is asked for: covered from the shoulders down.
std::string default_outfit(vfit_sex sex);

/// Opens the garments of "A+B"; a failure names the one that cannot be opened.
std::vector<Garment> open_outfit(vfit_context context, const std::string& names);

/// The default body of the sex that the first garment of "A+B" is made for.
Avatar default_wearer(vfit_context context, const std::string& names);
Avatar default_wearer(vfit_context context, vfit_garment garment);

/// Splits "a+b" at `separator`.
std::vector<std::string> split(const std::string& text, char separator);

}  // namespace vfit::tools
