// Which way is up where no sensor tells. Many cameras are mounted on their side or upside down, and many see
// no floor. People stand upright, and the network's answer is highest for a crop that shows them upright.
#pragma once

#include <array>

#include "frame/body.h"
#include "frame/camera.h"

namespace vfit {

class Level {
public:
    /// Quarter turns about the line of sight.
    static constexpr int kTurns = 4;
    using Answers = std::array<float, kTurns>;
    static Vec3 turned(const Vec3& up, int turns);

    /// Up in camera space, to try on the next image.
    const Vec3& up() const { return up_; }
    /// People have confirmed it.
    bool sure() const { return agreed_ >= kSure; }

    /// No person was found with up(). True where another way is to be tried on the same image; after the last
    /// one up() is what it was at first.
    bool miss(int64_t time_ns);
    /// The network's answers (logits: it is a person) to a person turned by up() and `k` quarters more. False
    /// where that is no person as seen with up(); where another way is right, up() is that from now on.
    bool compare(const Answers& person);
    /// No way showed a person: up() is `up` again, as before the image.
    void keep(const Vec3& up);
    /// A body in camera space was found.
    void see(const Body& body, int64_t time_ns);
    /// Up of a floor that is seen.
    void follow(const Vec3& floor_normal);
    void reset() { *this = {}; }

    /// Puts the floor where people have stood: upright on the soles of their feet. Leaves it open until
    /// a person was seen.
    void place(Camera& camera) const;

private:
    static constexpr int kSure = 5;  // images that agree

    Vec3 up_{0, -1, 0}, best_{0, -1, 0};
    int agreed_ = 0;
    int way_ = 0;            // that is tried
    bool all_ = false;       // each way is tried on this image
    bool weak_now_ = false;  // the answer to the first way was weak
    uint32_t misses_ = 0;    // images in a row, while not sure
    uint32_t weak_ = 0;      // images of a person with weak answers for every way
    int64_t seen_ns_ = 0;
    uint32_t stood_ = 0;            // images with a person who stands upright, up to kEnough
    Vec3 axis_{0.0f}, sole_{0.0f};  // means: from the feet to the neck; of the lowest sole
    bool has_sole_ = false;
};

}  // namespace vfit
