#include "picture/contact_sheet.h"

#include <algorithm>
#include <sstream>

namespace vfit::tools {

namespace {

constexpr int kMargin = 28, kGap = 16, kCaption = 40, kTitle = 70, kTitleLine = 34;  // pixels
constexpr Color kPaper{0.96f, 0.95f, 0.93f}, kInk{0.16f, 0.17f, 0.20f}, kSoftInk{0.38f, 0.39f, 0.43f};

int width_at(const Canvas& picture, int height) { return picture.width() * height / picture.height(); }

int row_width(const std::vector<SheetItem>& row, int height) {
    int sum = -kGap;
    for (const SheetItem& item : row) sum += width_at(item.picture, height) + kGap;
    return sum;
}

/// As high as wanted, or lower, so that it is no wider.
void write_within(Canvas& sheet, int x, int y, const std::string& text, int height, int width,
                  const Color& color) {
    constexpr int kLegible = 7;
    while (height > kLegible && Canvas::text_width(text, height) > width) --height;
    sheet.text(x, y, text, height, color);
}

}  // namespace

Canvas contact_sheet(const std::string& title, const std::vector<std::vector<SheetItem>>& rows,
                     int cell_height) {
    // Every row is as wide as the widest at the common height: the others grow to fill it.
    int width = 0;
    for (const auto& row : rows) width = std::max(width, row_width(row, cell_height));
    std::vector<int> heights;
    const int lines = 1 + int(std::count(title.begin(), title.end(), '\n'));
    const int head = kTitle + (lines - 1) * kTitleLine;
    int height = head + kMargin;
    for (const auto& row : rows) {
        const int gaps = kGap * (static_cast<int>(row.size()) - 1);
        heights.push_back(cell_height * (width - gaps) / std::max(1, row_width(row, cell_height) - gaps));
        height += heights.back() + kCaption;
    }
    Canvas sheet(width + 2 * kMargin, height + kMargin, kPaper);
    std::istringstream text(title);
    std::string line;
    for (int i = 0; std::getline(text, line); ++i)
        write_within(sheet, kMargin, kTitle - 12 + i * kTitleLine, line, 22, width, kInk);
    int y = head + kMargin / 2;
    for (size_t r = 0; r < rows.size(); ++r) {
        int x = kMargin;
        for (const SheetItem& item : rows[r]) {
            const int w = width_at(item.picture, heights[r]);
            sheet.blit(item.picture, x, y, w, heights[r]);
            write_within(sheet, x, y + heights[r] + 24, item.caption, 13, w, kSoftInk);
            x += w + kGap;
        }
        y += heights[r] + kCaption;
    }
    return sheet;
}

}  // namespace vfit::tools
