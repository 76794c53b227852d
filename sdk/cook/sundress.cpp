#include "cook/sundress.h"

#include <algorithm>
#include <cmath>

#include "cook/body/body_outline.h"
#include "core/error.h"

namespace vfit {

namespace {

float smooth(float t) {
    t = std::clamp(t, 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

class SundressCutter {
public:
    SundressCutter(const BodyModel& model, const SundressSpec& spec)
        : spec_(spec), body_(model, VFIT_SEX_FEMALE), levels_(body_.levels()) {}

    Garment cut() {
        garment_.name = spec_.name;
        garment_.kind = spec_.kind;
        garment_.size_chart = spec_.size_chart;
        garment_.fabric = spec_.fabric;
        garment_.body_sex = VFIT_SEX_FEMALE;
        garment_.sizes = spec_.sizes;
        find_strap_columns();
        cut_bodice();
        cut_skirt();
        for (const bool left : {true, false}) cut_strap(left);
        clear_skin();
        compute_normals(garment_.mesh.positions, garment_.mesh.indices, garment_.mesh.normals);
        return std::move(garment_);
    }

private:
    uint32_t columns() const { return spec_.columns; }
    uint32_t vertex(uint32_t row, uint32_t column) const { return row * columns() + column % columns(); }
    uint32_t mirrored(uint32_t column) const { return (columns() - column) % columns(); }

    uint32_t add(const Vec3& place, const Vec2& uv, bool simulated, bool backstop) {
        garment_.mesh.positions.push_back(place);
        garment_.mesh.uvs.push_back(uv);
        garment_.simulated.push_back(simulated);
        garment_.backstop.push_back(backstop);
        return garment_.vertex_count() - 1;
    }

    /// The rectangle a b over c d, counter-clockwise seen from outside with b on a's left-hand side of the
    /// body; the diagonal alternates.
    void add_quad(uint32_t a, uint32_t b, uint32_t c, uint32_t d, bool odd) {
        auto& list = garment_.mesh.indices;
        if (odd)
            list.insert(list.end(), {a, c, d, a, d, b});
        else
            list.insert(list.end(), {a, c, b, b, c, d});
    }

    Outline bodice_outline(float y) const {
        Outline outline = body_.at(y);
        outline.grow(spec_.bodice_ease_m);
        return outline;
    }
    std::vector<Vec3> places(const Outline& outline, float y) const {
        std::vector<Vec3> out;
        for (const Vec2& p : outline.spread(columns())) out.emplace_back(p.x, y, p.y + body_.axis_z());
        return out;
    }
    float top_height(float share) const { return glm::mix(levels_.bust, levels_.shoulder, share); }

    /// The straps' middles on the top edge, before and behind.
    void find_strap_columns() {
        const float x = spec_.strap_place * body_.left_shoulder().x;
        const std::vector<Vec3> edge = places(bodice_outline(top_height(spec_.top_side)), 0.0f);
        const auto nearest = [&](uint32_t first, uint32_t last) {
            uint32_t best = first;
            for (uint32_t c = first; c <= last; ++c)
                if (std::abs(edge[c].x - x) < std::abs(edge[best].x - x)) best = c;
            return best - spec_.strap_columns / 2;  // the first column of the strap
        };
        const uint32_t quarter = columns() / 4;
        if (quarter < spec_.strap_columns) fail(VFIT_ERROR_DATA, "sundress: the straps are too wide");
        strap_front_ = nearest(spec_.strap_columns / 2, quarter);
        strap_back_ = nearest(quarter, columns() / 2 - spec_.strap_columns);
        if (strap_front_ + spec_.strap_columns > strap_back_)
            fail(VFIT_ERROR_DATA,
                 "sundress: the straps leave no armhole: \"strap_place\" or \"strap_columns\" is too large");
    }

    /// Height of the top edge at a column: from the middle front up to the strap, down to the side, to the
    /// back.
    float top_edge(uint32_t column) const {
        const float c = float(std::min(column, mirrored(column)));
        const float half = 0.5f * float(spec_.strap_columns - 1);
        const float front = float(strap_front_) + half, side = 0.25f * float(columns()),
                    back = 0.5f * float(columns());
        const float share =
            c < front  ? glm::mix(spec_.top_center, spec_.top_strap, smooth(c / front))
            : c < side ? glm::mix(spec_.top_strap, spec_.top_side, smooth((c - front) / (side - front)))
                       : glm::mix(spec_.top_side, spec_.top_back, smooth((c - side) / (back - side)));
        return top_height(share);
    }

    void cut_bodice() {
        for (uint32_t row = 0; row < spec_.bodice_rows; ++row) {
            std::vector<Vec3> line;
            const float down = float(row) / float(spec_.bodice_rows - 1);
            for (uint32_t c = 0; c < columns(); ++c) {
                const float y = glm::mix(top_edge(c), levels_.waist, down);
                line.push_back(places(bodice_outline(y), y)[c]);
            }
            add_ring(line, false, false);
        }
    }

    /// The skirt hangs from the widest section above each level, and flares from the waist.
    void cut_skirt() {
        const float hem = glm::mix(levels_.knee, levels_.ankle, spec_.hem);
        Outline widest = body_.at(levels_.waist);
        for (uint32_t row = 1; row <= spec_.skirt_rows; ++row) {
            const float y = glm::mix(levels_.waist, hem, float(row) / float(spec_.skirt_rows));
            widest.cover(body_.at(y));
            Outline outline = widest;
            const float to_hip = smooth((levels_.waist - y) / (levels_.waist - levels_.hip));
            outline.grow(glm::mix(spec_.bodice_ease_m, spec_.skirt_ease_m, to_hip) + flare_at(y));
            add_ring(places(outline, y), true, y >= levels_.knee);
        }
    }

    /// Nothing at the waist; grows evenly from halfway to the hips on, with a soft start.
    float flare_at(float y) const {
        const float middle = 0.5f * (levels_.waist + levels_.hip), soft = levels_.waist - middle;
        const float below = (middle - y) / soft;
        const float softened = below <= -1.0f  ? 0.0f
                               : below >= 1.0f ? below
                                               : 0.25f * (below + 1.0f) * (below + 1.0f);
        return spec_.flare * soft * softened;
    }

    /// One row around the body, joined to the row above it. UVs in metres: u along the row from the middle
    /// front (both halves alike, so that there is no seam), v down from the top of the shoulders.
    void add_ring(const std::vector<Vec3>& line, bool simulated, bool backstop) {
        const uint32_t row = garment_.vertex_count() / columns();
        std::vector<float> u(columns(), 0.0f);
        for (uint32_t c = 1; c <= columns() / 2; ++c) {
            u[c] = u[c - 1] + glm::length(line[c] - line[c - 1]);
            u[mirrored(c)] = u[c];
        }
        for (uint32_t c = 0; c < columns(); ++c) {
            const float v = row == 0 ? levels_.shoulder - line[c].y
                                     : garment_.mesh.uvs[vertex(row - 1, c)].y +
                                           glm::length(line[c] - garment_.mesh.positions[vertex(row - 1, c)]);
            add(line[c], {u[c], v}, simulated, backstop);
        }
        if (row == 0) return;
        for (uint32_t c = 0; c < columns(); ++c)
            add_quad(vertex(row - 1, c), vertex(row - 1, c + 1), vertex(row, c), vertex(row, c + 1),
                     (row + c) % 2);
    }

    void cut_strap(bool left) {
        const auto side = [&](uint32_t column) { return left ? column : mirrored(column); };
        const uint32_t width = spec_.strap_columns, length = spec_.strap_rows;
        // Lines of the strap from front to back. Its inner edge in front is its inner edge behind.
        std::vector<std::vector<uint32_t>> lines;
        for (uint32_t k = 0; k < width; ++k) {
            const uint32_t front = vertex(0, side(strap_front_ + k));
            const uint32_t back = vertex(0, side(strap_back_ + width - 1 - k));
            const Vec2 uv0 = garment_.mesh.uvs[front], uv1 = garment_.mesh.uvs[back];
            const std::vector<Vec3> line = body_.over_shoulder(
                garment_.mesh.positions[front], garment_.mesh.positions[back], length, spec_.bodice_ease_m);
            std::vector<uint32_t> indices{front};
            float along = 0.0f;
            const float step = glm::length(line[1] - line[0]);
            for (uint32_t i = 0; i < length; ++i) {
                along = float(i + 1) / float(length + 1);
                // Up in front and down behind, so that a pattern runs on from the bodice at both ends.
                const float climbed = step * float(std::min(i + 1, length - i));
                const Vec2 uv(glm::mix(uv0.x, uv1.x, along), glm::mix(uv0.y, uv1.y, along) - climbed);
                indices.push_back(add(line[i], uv, false, false));
            }
            indices.push_back(back);
            lines.push_back(std::move(indices));
        }
        for (uint32_t k = 0; k + 1 < width; ++k)
            for (uint32_t i = 0; i + 1 < lines[k].size(); ++i) {
                const auto &inner = left ? lines[k] : lines[k + 1], &outer = left ? lines[k + 1] : lines[k];
                add_quad(inner[i + 1], outer[i + 1], inner[i], outer[i], (i + k) % 2);
            }
    }

    /// Rows are drawn level by level; between them, and where the tape's hull is hollow, skin may stand out.
    void clear_skin() { push_out(body_.skin(), spec_.bodice_ease_m, garment_.mesh.positions); }

    const SundressSpec& spec_;
    BodyOutline body_;
    TailorLevels levels_;
    Garment garment_;
    uint32_t strap_front_ = 0, strap_back_ = 0;
};

}  // namespace

Garment cook_sundress(const BodyModel& model, const SundressSpec& spec) {
    return SundressCutter(model, spec).cut();
}

}  // namespace vfit
