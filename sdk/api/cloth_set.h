// Cloths that are worn over each other are one set, which is stepped as one; a cloth that is worn alone has a
// set of its own.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "api/access.h"
#include "api/context.h"
#include "core/jobs.h"
#include "outfit/worn_together.h"

namespace vfit::api {

struct ClothObject;

class ClothSet {
public:
    explicit ClothSet(Ref<Context> context);
    ~ClothSet();
    ClothSet(const ClothSet&) = delete;
    ClothSet& operator=(const ClothSet&) = delete;

    void require_no_step() const;
    /// Of garments that have begun theirs, on another thread.
    void start_step(const WornTogether& worn);
    bool is_stepping() const { return stepping_; }
    /// Throws what the step threw.
    void finish_step();
    /// Until no step runs, from any thread.
    void wait();

    std::atomic<uint32_t> begun{0};  // cloths between start_step and finish_step
    /// Whose handles live, under AvatarObject::cloth_sets. Empty: a cloth that was never worn with another.
    std::vector<Ref<ClothObject>> cloths;

private:
    const Ref<Context> context_;
    bool stepping_ = false;  // between start_step and finish_step
    std::optional<WornTogether> worn_;
    Jobs::Later later_;
    std::mutex wait_;
    bool runs_ = false;         // and has not been waited for; under wait_
    std::exception_ptr error_;  // of the step; under wait_
};

/// The cloths of one set, or of two, which a call has for itself.
class ClothsOfCall {
public:
    /// The caller has `cloth` for itself. VFIT_ERROR_BUSY where a call on another thread has one of the
    /// others, VFIT_ERROR_HANDLE where the handle of `cloth` or `other` has died since the call began.
    explicit ClothsOfCall(const ClothObject& cloth, const ClothObject* other = nullptr);
    ~ClothsOfCall();
    ClothsOfCall(const ClothsOfCall&) = delete;
    ClothsOfCall& operator=(const ClothsOfCall&) = delete;

    std::span<const Ref<ClothObject>> cloths() const { return std::span(cloths_).first(count_); }
    WornTogether worn() const;

    /// Takes the pose and all props, and room for the frames. Then a step takes nothing from outside.
    void begin_step(float dt);
    /// Of what step or call left.
    void begin_frames();
    void publish();
    void end_step();
    /// From now on they are one set.
    void unite();

    /// Access to the props of all of them.
    class ReadingProps {
    public:
        explicit ReadingProps(const ClothsOfCall& of);
        ~ReadingProps() { clear(); }
        ReadingProps(const ReadingProps&) = delete;
        ReadingProps& operator=(const ReadingProps&) = delete;

    private:
        void clear();
        const ClothsOfCall& of_;
    };

private:
    void add(const ClothObject& cloth);
    void let_go();

    const ClothObject& of_;
    std::array<Ref<ClothObject>, Fabric::kMaxPieces> cloths_;
    size_t count_ = 0, taken_ = 0;
};

}  // namespace vfit::api
