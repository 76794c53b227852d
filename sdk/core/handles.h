// The table behind all handles, the one process-wide thing of the library. An id is kind (8 bits),
// generation (24) and slot (32): a stale, foreign or invented id is refused, never followed.
#pragma once

#include <cstdint>
#include <vector>

#include "core/object.h"

namespace vfit {

enum class Kind : uint8_t {
    none = 0,
    context,
    sensor,
    frame,
    tracker,
    scan,
    size_chart,
    motion,
    avatar,
    garment,
    cloth,
    recorder,
    prop,
    population
};

const char* kind_name(Kind kind);

class Handles {
public:
    static Handles& instance();

    /// A new id for object, counted once. The id dies with its parent's (0: no parent).
    uint64_t add(Kind kind, Ref<Object> object, uint64_t parent);

    /// The object of a live id of that kind; else fails with VFIT_ERROR_HANDLE, naming null, stale or
    /// foreign.
    Ref<Object> get(uint64_t id, Kind kind) const;

    /// The same with its parent's object (null: none). `enter` runs under the table's lock: what it counts is
    /// counted before anybody can destroy the id.
    struct Entry {
        Ref<Object> object, parent;
    };
    using Enter = void (*)(const Entry& entry);
    Entry find(uint64_t id, Kind kind, Enter enter) const;

    /// One more count on the id; one less, and the id dies with the last.
    void retain(uint64_t id, Kind kind);
    void release(uint64_t id, Kind kind);

    /// Kills the id and all below it; the objects go when their last user lets go of them. Null is a no-op.
    void destroy(uint64_t id, Kind kind);

    /// Live ids of one kind below a parent, and how many ids live below it at all.
    std::vector<uint64_t> children(uint64_t parent, Kind kind) const;
    uint32_t count_below(uint64_t parent) const;

private:
    Handles();
    struct State;
    State* state_;  // never freed: threads may still ask while the process ends
};

}  // namespace vfit
