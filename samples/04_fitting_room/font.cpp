#include "font.h"

#include <algorithm>
#include <cmath>

namespace room {

namespace {

// From the space on. Two hexadecimal digits are a point, x and y; points in a row a stroke; a space begins
// another stroke. x: 0 to 6; y: 3 the line that letters stand on, 8 the top of small letters, b of capitals,
// 0 the lowest tail.
constexpr const char* kStrokes[] = {"",
                                    "3b36 3333",
                                    "2b29 4b49",
                                    "2b23 4b43 0969 0565",
                                    "6a5b1b0a0817576664531304 3c32",
                                    "036b 0b2b29090b 4565634345",
                                    "63191a2b3b4a49160504134366",
                                    "3b39",
                                    "4b292543",
                                    "2b494523",
                                    "3a36 1957 5917",
                                    "1757 3539",
                                    "3421",
                                    "1757",
                                    "3333",
                                    "036b",
                                    "1b0a041353646a5b1b",
                                    "193b33 1353",
                                    "0a1b5b6a680363",
                                    "0a1b5b6a685727 576664531304",
                                    "434b0565",
                                    "6b0b07576664531304",
                                    "6a5b1b0a0413536466571706",
                                    "0b6b23",
                                    "17080a1b5b6a685717060413536466 5766",
                                    "041353646a5b1b0a08175768",
                                    "3838 3434",
                                    "3838 3421",
                                    "5a1754",
                                    "1858 1656",
                                    "1a5714",
                                    "0a1b5b6a683736 3333",
                                    "4648282646576a5b1b0a04135363",
                                    "033b63 1555",
                                    "030b4b5a584707 475766645303",
                                    "6a5b1b0a04135364",
                                    "030b4b69654303",
                                    "6b0b0363 0747",
                                    "6b0b03 0747",
                                    "6a5b1b0a041353646737",
                                    "030b 636b 0767",
                                    "1353 333b 1b5b",
                                    "6b6453130405",
                                    "030b 6b06 2863",
                                    "0b0363",
                                    "030b376b63",
                                    "030b636b",
                                    "1b0a041353646a5b1b",
                                    "030b5b6a685707",
                                    "1b0a041353646a5b1b 4562",
                                    "030b5b6a685707 3763",
                                    "6a5b1b0a0817576664531304",
                                    "0b6b 3b33",
                                    "0b041353646b",
                                    "0b336b",
                                    "0b1338536b",
                                    "036b 0b63",
                                    "0b376b 3733",
                                    "0b6b0363",
                                    "4b2b2343",
                                    "0b63",
                                    "2b4b4323",
                                    "193b59",
                                    "0262",
                                    "2b39",
                                    "5853 5748180704134354",
                                    "0b03 0718485754431304",
                                    "5748180704134354",
                                    "5b53 5748180704134354",
                                    "06565748180704134354",
                                    "5a4b3b2a23 0848",
                                    "5851401001 5748180704134354",
                                    "0b03 0718485753",
                                    "183833 1353 3a3b",
                                    "284841301001 4a4b",
                                    "0b03 5805 2653",
                                    "1b3b33 1353",
                                    "0803 0718283733 3748586763",
                                    "0803 0718485753",
                                    "180704134354574818",
                                    "0800 0718485754431304",
                                    "5850 5748180704134354",
                                    "0803 06284857",
                                    "57481807164554431304",
                                    "2b24334354 0848",
                                    "0804134354 5853",
                                    "083368",
                                    "0813375368",
                                    "0853 0358",
                                    "0833 6810",
                                    "08580353",
                                    "5b4b3a3827363442 5242",
                                    "3c31",
                                    "1b2b3a3847363422 1222",
                                    "07184758 68"};
static_assert(sizeof kStrokes / sizeof kStrokes[0] == 95);

constexpr float kAdvance = 8.0f, kLine = 13.0f;  // of a cell, in units
constexpr float kPen = 0.55f;                    // half a stroke's width, in units

int digit(char c) { return c <= '9' ? c - '0' : c - 'a' + 10; }

struct Point {
    float x, y;
};

float distance(Point p, Point a, Point b) {
    const float dx = b.x - a.x, dy = b.y - a.y, length2 = dx * dx + dy * dy;
    const float t =
        length2 > 0.0f ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length2, 0.0f, 1.0f) : 0.0f;
    return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

float distance(Point p, std::string_view strokes) {
    float nearest = 1e9f;
    for (size_t i = 0; i + 1 < strokes.size();) {
        if (strokes[i] == ' ') {
            ++i;
            continue;
        }
        const Point a{float(digit(strokes[i])), float(digit(strokes[i + 1]))};
        const bool more = i + 3 < strokes.size() && strokes[i + 2] != ' ';
        const Point b = more ? Point{float(digit(strokes[i + 2])), float(digit(strokes[i + 3]))} : a;
        nearest = std::min(nearest, distance(p, a, b));
        i += 2;
    }
    return nearest;
}

}  // namespace

Letters::Letters(float unit)
    : width(int(std::lround(kAdvance * unit))), height(int(std::lround(kLine * unit))) {
    const int pitch = columns * width;
    coverage.assign(size_t(pitch) * size_t(rows * height), 0);
    const float pen = std::max(kPen * unit, 0.6f);  // pixels
    for (int letter = 0; letter < 95; ++letter)
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const Point p{(float(x) + 0.5f) / unit - 1.0f, kLine - 0.5f - (float(y) + 0.5f) / unit};
                const float covered =
                    std::clamp(pen + 0.5f - unit * distance(p, kStrokes[letter]), 0.0f, 1.0f);
                coverage[size_t((letter / columns * height + y) * pitch + letter % columns * width + x)] =
                    uint8_t(std::lround(255.0f * covered));
            }
}

}  // namespace room
