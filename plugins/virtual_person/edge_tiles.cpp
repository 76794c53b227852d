#include "edge_tiles.h"

#include <algorithm>

namespace vfit::virtual_person {

void EdgeTiles::find(const CleanImage& image, float jump_m, float least_cosine) {
    columns_ = (image.width + kWidth - 1) / kWidth, rows_ = (image.height + kHeight - 1) / kHeight;
    ranges_.resize(size_t{columns_} * rows_), marked_.resize(ranges_.size());
    low_.resize(image.width), high_.resize(image.width), cosine_.resize(image.width);
    for (uint32_t row = 0; row < rows_; ++row) {
        // Down the columns first, which is done by vectors.
        const uint32_t y0 = row * kHeight, y1 = std::min(y0 + kHeight, image.height), width = image.width;
        float *const low = low_.data(), *const high = high_.data(), *const least = cosine_.data();
        for (uint32_t y = y0; y < y1; ++y) {
            const float* const depth = image.depth_m.data() + size_t{y} * width;
            const float* const cosine = image.cosine.data() + size_t{y} * width;
            if (y == y0) {
                std::copy(depth, depth + width, low), std::copy(depth, depth + width, high);
                std::copy(cosine, cosine + width, least);
                continue;
            }
            for (uint32_t x = 0; x < width; ++x) {
                low[x] = std::min(low[x], depth[x]), high[x] = std::max(high[x], depth[x]);
                least[x] = std::min(least[x], cosine[x]);
            }
        }
        for (uint32_t column = 0; column < columns_; ++column) {
            const uint32_t x0 = column * kWidth, x1 = std::min(x0 + kWidth, width);
            const size_t i = size_t{row} * columns_ + column;
            ranges_[i] = {*std::min_element(low + x0, low + x1), *std::max_element(high + x0, high + x1)};
            marked_[i] = *std::min_element(least + x0, least + x1) < least_cosine;
        }
    }
    for (uint32_t row = 0; row < rows_; ++row) {
        for (uint32_t column = 0; column < columns_; ++column) {
            Range all = ranges_[size_t{row} * columns_ + column];
            for (uint32_t y = row - (row > 0); y <= std::min(row + 1, rows_ - 1); ++y) {
                for (uint32_t x = column - (column > 0); x <= std::min(column + 1, columns_ - 1); ++x) {
                    const Range& r = ranges_[size_t{y} * columns_ + x];
                    all = {std::min(all.low, r.low), std::max(all.high, r.high)};
                }
            }
            marked_[size_t{row} * columns_ + column] |= all.high - all.low > jump_m;
        }
    }
}

}  // namespace vfit::virtual_person
