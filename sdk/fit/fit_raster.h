// The model as the camera would see it, on the cells of a FitView: which vertices are visible, and how well
// depth and outline agree.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fit/fit_pose.h"
#include "fit/fit_view.h"

namespace vfit {

struct FitScore {
    float cost = 1.0f;      // mean over the cells of both outlines: |depth difference| / 10 cm, at most 1
    float iou = 0.0f;       // of the outlines; what something before the person hides is left out
    float median_m = 0.0f;  // of |depth difference| where both are
    uint32_t cells = 0;     // where both are
};

class FitRaster {
public:
    /// Does not allocate after its first run on an image of that size.
    void draw(const FitBody& body, const FitView& view);

    /// Of the last draw; view and body as they were.
    FitScore score(const FitView& view) const;
    bool visible(const FitBody& body, const FitView& view, uint32_t vertex) const;
    /// Whether another part of the body lies before the vertex or next to it in the picture.
    bool hidden(const FitBody& body, const FitView& view, uint32_t vertex) const;
    /// Overwrites the last drawing.
    void wipe();
    float depth(const FitView& view, int x, int y) const {
        return depths_[view.index(x, y)];
    }  // 0: not the model

private:
    std::vector<Vec2> projected_;
    std::vector<float> depths_;
};

}  // namespace vfit
