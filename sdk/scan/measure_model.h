// Measures of scans: what the camera plainly sees, and what that is off by, which is learnt from scans of
// virtual people whose bodies are drawn from a survey of real ones: linear in what the fitted body tells and
// bent by where the scan lies among theirs, a Gaussian process, with deviations that follow how sure it can
// be (training/measures). Measures that no view shows are learnt whole.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "anthropometry/measurement.h"
#include "scan/body_scan.h"
#include "scan/radial_basis.h"
#include "scan/seen_measures.h"
#include "scan/turned_measures.h"

namespace vfit {

/// What is known of a scan beside its features.
struct ScanKind {
    bool side = false;   // the features hold a side view
    bool tight = false;  // the clothes lie on the skin
};

class MeasureModel {
public:
    /// VFIT_ERROR_IO, VFIT_ERROR_VERSION or VFIT_ERROR_DATA where the file is not such a model of these
    /// features.
    static std::shared_ptr<const MeasureModel> load(const std::string& path);
    static MeasureModel parse(std::string_view json);

    /// In the order of measure_keys(). Where the sex is unknown the measures of both are mixed by how likely
    /// each is. Of a person unlike those that it has learnt from deviations are wider.
    /// `turn`: what a turn on the spot showed as well; null: none.
    std::vector<Measurement> measure(const ScanFeatures& features, ScanKind kind, vfit_sex sex,
                                     const SeenOfTurn* turn = nullptr) const;
    /// How likely it is a woman whom the features are of.
    float female_probability(const ScanFeatures& features, ScanKind kind) const;

private:
    /// base + weights . x, of standardised features x.
    struct Linear {
        float base = 0.0f;
        std::vector<float> weights;
        float of(const ScanFeatures& x) const;
    };
    /// What all features make likely for a measure that is seen: it stands in where that is not seen or
    /// misread.
    struct StandIn {
        Linear likely;       // metres
        float sigma = 0.0f;  // of what is seen about it
        float trust = 1.0f;  // in what is seen, 0 to 1
    };
    struct Row {
        std::string key;
        bool observed = true;
        Linear value;                     // metres, beside what is seen
        std::optional<StandIn> stand_in;  // of a measure that is seen
        std::vector<float> bends;         // and of each centre
        float log_sigma = 0.0f;
        std::vector<float>
            sigma_weights;  // of the part's sigma_features and, last, of how strange all of them are
    };
    /// A scan as a part looks at it.
    struct Seen {
        SeenMeasures male, female;    // as it is
        ScanFeatures x;               // standardised
        std::vector<float> nearness;  // to each centre, 1 at it
        float doubt = 1.0f;
    };
    /// What is learnt from one kind of scan.
    struct Part {
        std::vector<float> mean, scale;  // of the features
        float usual_strangeness = 1.0f;  // mean square of x that one person of a hundred exceeds
        std::vector<float>
            shape_precision;  // quadratic form of the fitted shape's x: above 1 for one person of ten
        Linear female;        // the logit
        RadialBasis basis;
        std::vector<size_t> sigma_features;
        std::vector<Row> female_rows, male_rows;

        /// What was not seen is taken as the mean.
        ScanFeatures standardised(const ScanFeatures& features) const;
        Seen look(const ScanFeatures& features) const;
        /// How many times wider deviations are than among those that it has learnt from.
        float doubt(const ScanFeatures& features, const ScanFeatures& x) const;
        std::vector<Measurement> measure(vfit_sex sex, const Seen& seen) const;
    };
    MeasureModel() = default;

    std::vector<Measurement> measure_anybody(const ScanFeatures& features, ScanKind kind, vfit_sex sex,
                                             const SeenOfTurn* turn) const;
    const Part& part(ScanKind kind) const { return parts_[(kind.side ? 1u : 0u) + (kind.tight ? 2u : 0u)]; }

    std::array<Part, 4> parts_;
    // Of a turn, of several cameras; any clothes, tight ones; men, women.
    std::array<std::array<std::array<TurnedGirths, 2>, 2>, 2> turned_{};
};

}  // namespace vfit
