// Magnitudes: axial noise of structured light by Nguyen, Izadi, Lovell 2012; depth steps by Khoshelham and
// Elberink 2012 (1/8 px of disparity); the rest is drawn widely about what such sensors show.
#include "sensor_look.h"

#include <algorithm>
#include <array>

#include "noise.h"

namespace vfit::training {

namespace {

constexpr float kBaseline_m = 0.075f;        // projector to camera
constexpr float kStepPerSquareM = 2.85e-3f;  // depth step = this * z^2

/// Tiles of noise, made once, read from a random corner: one look-up a pixel.
class Tile {
public:
    static constexpr int kSide = 512;

    explicit Tile(float cell) : values_(size_t(kSide) * kSide) {
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x)
                values_[size_t(y) * kSide + size_t(x)] =
                    smooth_noise(12345u, Vec2(float(x), float(y)) / cell);
    }
    static Tile white() {
        Tile tile(1.0f);
        Random random(7, 7);
        for (float& v : tile.values_) v = std::clamp(random.normal(0, 1), -3.0f, 3.0f);
        return tile;
    }
    float at(int x, int y) const {
        return values_[size_t(y & (kSide - 1)) * kSide + size_t(x & (kSide - 1))];
    }

private:
    std::vector<float> values_;
};

struct Corner {
    int x, y;
    explicit Corner(Random& random) : x(int(random.below(Tile::kSide))), y(int(random.below(Tile::kSide))) {}
};

const Tile& fine() {
    static const Tile tile(2.3f);
    return tile;
}
const Tile& middle() {
    static const Tile tile(7.0f);
    return tile;
}
const Tile& coarse() {
    static const Tile tile(21.0f);
    return tile;
}
const Tile& white() {
    static const Tile tile = Tile::white();
    return tile;
}

class Look {
public:
    Look(const Shot& shot, Light light, float wall_m, Random& random)
        : shot_(shot),
          light_(light),
          wall_m_(wall_m),
          random_(random),
          width_(int(shot.camera.width)),
          height_(int(shot.camera.height)),
          to_world_(shot.camera.world_from_camera()) {
        // Effects that are a few pixels wide on a 320 x 240 image are so in angle.
        scale_ = shot.camera.fx / 285.0f;
    }

    void run(bool person, RealShot& out) {
        jitter();
        if (random_.chance(0.30f)) spread(true);
        if (random_.chance(0.15f)) spread(false);
        if (light_ == Light::kStructured && random_.chance(0.6f)) shadow();
        holes();
        if (light_ == Light::kTimeOfFlight && random_.chance(0.7f)) flying_pixels();
        cut_feet();
        if (random_.chance(0.2f)) keep_floor();
        if (random_.chance(0.05f)) keep_wall();
        if (random_.chance(person ? 0.10f : 0.20f)) occlude();
        if (random_.chance(0.05f)) lose_trousers();
        if (random_.chance(0.08f)) behind_table();
        if (!person && random_.chance(0.5f)) cut_piece();
        if (random_.chance(0.05f)) lose_piece();
        report(out);
    }

private:
    size_t index(int x, int y) const { return size_t(y) * size_t(width_) + size_t(x); }

    /// The person's pixels looked up a little beside their place.
    void jitter() {
        depth_.resize(shot_.pixels()), cosine_.resize(shot_.pixels());
        const float across = random_.between(0.0f, 1.6f) * scale_, along = 0.35f * across;
        const Corner a(random_), b(random_);
        for (int y = 0; y < height_; ++y)
            for (int x = 0; x < width_; ++x) {
                const float jump =
                    0.6f * fine().at(x + a.x, y + a.y) + 0.5f * white().at(x + b.x, y + b.y) * 0.5f;
                const int sx = std::clamp(int(std::lround(float(x) + across * jump)), 0, width_ - 1);
                const int sy = std::clamp(int(std::lround(float(y) + along * fine().at(x + b.x, y + a.y))), 0,
                                          height_ - 1);
                depth_[index(x, y)] = shot_.depth_m[index(sx, sy)];
                cosine_[index(x, y)] = shot_.cosine[index(sx, sy)];
            }
    }

    /// Grows the nearer surface by a pixel, or takes a pixel from it.
    void spread(bool grow) {
        const std::vector<float> before = depth_;
        const float far = 1e9f;
        const auto value = [&](int x, int y) {
            const float d = before[index(std::clamp(x, 0, width_ - 1), std::clamp(y, 0, height_ - 1))];
            return d > 0.0f ? d : far;
        };
        for (int y = 0; y < height_; ++y)
            for (int x = 0; x < width_; ++x) {
                float best = value(x, y);
                for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}})
                    best =
                        grow ? std::min(best, value(x + dx, y + dy)) : std::max(best, value(x + dx, y + dy));
                depth_[index(x, y)] = best == far ? 0.0f : best;
            }
    }

    /// Strips that the projector, beside the camera, does not reach.
    void shadow() {
        const bool from_right = random_.chance(0.5f);
        const float reach = shot_.camera.fx * kBaseline_m;
        for (int y = 0; y < height_; ++y) {
            float edge = 1e9f;
            for (int i = 0; i < width_; ++i) {
                const int x = from_right ? width_ - 1 - i : i;
                float& d = depth_[index(x, y)];
                if (d <= 0.0f) continue;
                const float along = from_right ? float(x) : float(width_ - 1 - x);
                const float lit = along - reach / d;
                if (lit > edge + 0.7f)
                    d = 0.0f;
                else
                    edge = std::min(edge, lit);
            }
        }
    }

    void holes() {
        const bool patches = random_.chance(0.35f);
        const float patch_level = random_.between(0.45f, 0.8f),
                    speckle = random_.chance(0.4f) ? random_.between(2.2f, 3.0f) : 9.0f;
        const float grazing = random_.between(0.05f, 0.22f);
        const bool wide = random_.chance(0.5f);
        const Corner a(random_), b(random_);
        for (int y = 0; y < height_; ++y)
            for (int x = 0; x < width_; ++x) {
                const size_t i = index(x, y);
                const bool patch = patches && (wide ? coarse() : middle()).at(x + a.x, y + a.y) > patch_level;
                const bool speck = white().at(x + b.x, y + b.y) > speckle;
                const bool graze = cosine_[i] < grazing && white().at(x + a.x, y + b.y) > 0.0f;
                if (patch || speck || graze) depth_[i] = 0.0f;
            }
    }

    /// Readings between the person's edge and what is behind.
    void flying_pixels() {
        const float share = random_.between(0.2f, 1.0f);
        const std::vector<float> before = depth_;
        for (int y = 0; y < height_; ++y)
            for (int x = 1; x + 1 < width_; ++x) {
                const float d = before[index(x, y)];
                if (d <= 0.0f || random_.unit() > share) continue;
                const float left = before[index(x - 1, y)], right = before[index(x + 1, y)];
                if (left > 0.0f && right > 0.0f) continue;
                depth_[index(x, y)] = d + random_.unit() * random_.unit() * 0.25f;
            }
    }

    float height_above_floor(int x, int y, float d) const {
        return transform_point(to_world_, shot_.camera.unproject(float(x), float(y), d)).y;
    }

    /// Segmentation takes the feet's lowest part for floor, raggedly.
    void cut_feet() {
        if (!random_.chance(0.6f)) return;
        const float most = random_.between(0.0f, 0.045f);
        const int block = std::max(1, int(std::lround((random_.chance(0.5f) ? 4.0f : 1.5f) * scale_)));
        const Corner a(random_);
        for (int y = height_ / 2; y < height_; ++y)
            for (int x = 0; x < width_; ++x) {
                float& d = depth_[index(x, y)];
                if (d <= 0.0f) continue;
                const float level = most * (0.7f + 0.6f * white().at(x / block + a.x, a.y) * 0.5f);
                if (height_above_floor(x, y, d) < level) d = 0.0f;
            }
    }

    /// Pieces of floor beside the feet that the segmentation took for the person.
    void keep_floor() {
        const float reach_px = random_.between(2.0f, 9.0f) * scale_, level = random_.between(-0.2f, 0.5f);
        const Corner a(random_);
        const std::vector<float> before = depth_;
        const int r = std::max(1, int(reach_px));
        for (int y = height_ * 2 / 3; y < height_; ++y)
            for (int x = 0; x < width_; ++x) {
                if (before[index(x, y)] > 0.0f || middle().at(x + a.x, y + a.y) < level) continue;
                const float d = floor_depth(x, y);
                if (d <= 0.0f || d > 8.0f) continue;
                bool beside = false;
                for (int dx = -r; dx <= r && !beside; dx += std::max(1, r / 2)) {
                    const int sx = x + dx;
                    if (sx < 0 || sx >= width_) continue;
                    const float foot = before[index(sx, y)];
                    beside = foot > 0.0f && std::abs(foot - d) < 0.15f;
                }
                if (beside) depth_[index(x, y)] = d;
            }
    }

    /// Depth of the floor at a pixel; 0: the line of sight does not meet it.
    float floor_depth(int x, int y) const {
        const Vec3 ray = shot_.camera.unproject(float(x), float(y), 1.0f);
        const float down = -glm::dot(shot_.camera.floor_normal, ray);
        return down > 1e-3f ? shot_.camera.floor_distance_m / down : 0.0f;
    }

    /// Something stands before the person.
    void occlude() {
        const int x0 = int(random_.between(-0.5f, 1.0f) * float(width_)),
                  w = int(random_.between(0.1f, 0.6f) * float(width_));
        const int y0 = int(random_.between(0.2f, 1.1f) * float(height_)),
                  h = int(random_.between(0.1f, 0.6f) * float(height_));
        clear(x0, y0, x0 + w, y0 + h);
    }

    /// Black trousers give no reading, raggedly; shoes may.
    void lose_trousers() {
        const float waist = random_.between(0.5f, 1.1f), hem = random_.between(-0.1f, 0.2f);
        const float kept = random_.chance(0.4f) ? random_.between(0.5f, 0.9f) : 9.0f;
        const Corner a(random_);
        for (int y = 0; y < height_; ++y)
            for (int x = 0; x < width_; ++x) {
                float& d = depth_[index(x, y)];
                if (d <= 0.0f) continue;
                const float ragged = 0.03f * middle().at(x + a.x, y + a.y);
                const float level = height_above_floor(x, y, d) + ragged;
                if (level < waist && level > hem && coarse().at(x + a.y, y + a.x) < kept) d = 0.0f;
            }
    }

    /// The part below the edge of a table, or of the image, is not seen.
    void behind_table() {
        const int edge = int(random_.between(0.3f, 0.65f) * float(height_));
        const float slope = random_.between(-0.06f, 0.06f);
        for (int y = edge - width_; y < height_; ++y)
            for (int x = 0; x < width_; ++x)
                if (y >= 0 && float(y) > float(edge) + slope * float(x)) depth_[index(x, y)] = 0.0f;
    }

    /// What a straight edge, or a ragged one, leaves of a thing.
    void cut_piece() {
        const int cuts = 1 + int(random_.below(2));
        for (int i = 0; i < cuts; ++i) {
            const float turn = random_.between(0, 2 * kPi), c = std::cos(turn), s = std::sin(turn);
            const float edge = random_.between(-0.1f, 0.35f) * float(std::min(width_, height_));
            const float ragged = random_.chance(0.5f) ? random_.between(0.0f, 8.0f) * scale_ : 0.0f;
            const Corner a(random_);
            for (int y = 0; y < height_; ++y)
                for (int x = 0; x < width_; ++x) {
                    const float along = c * (float(x) - 0.5f * float(width_)) +
                                        s * (float(y) - 0.5f * float(height_)) +
                                        ragged * middle().at(x + a.x, y + a.y);
                    if (along > edge) depth_[index(x, y)] = 0.0f;
                }
        }
    }

    /// A wall close behind, of which a fringe beside the person was taken for them.
    void keep_wall() {
        float back = 0.0f;
        for (const float d : depth_) back = std::max(back, d);
        back += random_.between(-0.1f, 0.08f);
        const float level = random_.between(-0.3f, 0.5f);
        const int r = std::max(1, int(random_.between(2.0f, 12.0f) * scale_));
        const Corner a(random_);
        const std::vector<float> before = depth_;
        for (int y = 0; y < height_; ++y)
            for (int x = 0; x < width_; ++x) {
                if (before[index(x, y)] > 0.0f || middle().at(x + a.x, y + a.y) < level) continue;
                bool beside = false;
                for (int dx = -r; dx <= r && !beside; dx += std::max(1, r / 2)) {
                    const int sx = x + dx;
                    beside = sx >= 0 && sx < width_ && before[index(sx, y)] > 0.0f;
                }
                if (beside) depth_[index(x, y)] = back;
            }
    }

    void lose_piece() {
        const int x = int(random_.below(uint32_t(width_))), y = int(random_.below(uint32_t(height_)));
        const int r = int(random_.between(3.0f, 14.0f) * scale_);
        clear(x - r, y - r, x + r, y + r);
    }

    void clear(int x0, int y0, int x1, int y1) {
        for (int y = std::max(0, y0); y < std::min(height_, y1); ++y)
            for (int x = std::max(0, x0); x < std::min(width_, x1); ++x) depth_[index(x, y)] = 0.0f;
    }

    void report(RealShot& out) {
        out.camera = shot_.camera;
        out.depth_mm.assign(depth_.size(), 0), out.users.assign(depth_.size(), 0);
        const float strength = random_.between(0.3f, 1.6f),
                    bias = 1.0f + std::clamp(random_.normal(0, 0.006f), -0.015f, 0.015f);
        const float together = random_.unit();  // share of the noise that neighbours have in common
        const bool steps = light_ == Light::kStructured;
        const Corner a(random_), b(random_);
        for (int y = 0; y < height_; ++y)
            for (int x = 0; x < width_; ++x) {
                const size_t i = index(x, y);
                float z = depth_[i];
                if (z <= 0.0f || z > wall_m_ + 3.0f) continue;
                const float sigma = light_ == Light::kStructured ? 0.0012f + 0.0019f * (z - 0.4f) * (z - 0.4f)
                                                                 : 0.0015f + 0.0007f * z;
                const float grazing = 0.002f * (1.0f / std::max(0.15f, cosine_[i]) - 1.0f);
                const float noise = together * 1.6f * fine().at(x + a.x, y + a.y) +
                                    (1.0f - together) * white().at(x + b.x, y + b.y);
                z = z * bias + strength * (sigma + grazing) * noise;
                if (steps) {
                    const float step = kStepPerSquareM * z * z;
                    z = step * std::round(z / step);
                }
                out.depth_mm[i] = uint16_t(std::clamp(z * 1000.0f + 0.5f, 1.0f, 65000.0f));
                out.users[i] = 1;
            }
    }

    const Shot& shot_;
    const Light light_;
    const float wall_m_;
    Random& random_;
    const int width_, height_;
    const Mat4 to_world_;
    float scale_;
    std::vector<float> depth_, cosine_;
};

}  // namespace

void look_real(const Shot& shot, Light light, float wall_m, bool person, Random& random, RealShot& out) {
    Look(shot, light, wall_m, random).run(person, out);
}

}  // namespace vfit::training
