#include "core/handles.h"

#include <mutex>
#include <shared_mutex>

#include "core/error.h"

namespace vfit {

namespace {

constexpr uint32_t kGenerationMask = 0xFFFFFF;

struct Id {
    uint32_t slot;
    uint32_t generation;
    Kind kind;
};

Id unpack(uint64_t id) {
    return {static_cast<uint32_t>(id), static_cast<uint32_t>(id >> 32) & kGenerationMask,
            static_cast<Kind>(id >> 56)};
}

uint64_t pack(uint32_t slot, uint32_t generation, Kind kind) {
    return uint64_t(slot) | uint64_t(generation) << 32 | uint64_t(kind) << 56;
}

struct Slot {
    Ref<Object> object;
    uint64_t parent = 0;
    uint32_t generation = 1;  // never 0, so that no id is 0
    uint32_t count = 0;
    Kind kind = Kind::none;
};

}  // namespace

const char* kind_name(Kind kind) {
    constexpr const char* names[] = {"null",  "context",    "sensor", "frame",     "tracker",
                                     "scan",  "size chart", "motion", "avatar",    "garment",
                                     "cloth", "recorder",   "prop",   "population"};
    const auto i = static_cast<size_t>(kind);
    return i < std::size(names) ? names[i] : "unknown";
}

struct Handles::State {
    mutable std::shared_mutex mutex;
    std::vector<Slot> slots;
    std::vector<uint32_t> free;

    Slot& live(uint64_t id, Kind kind) {
        if (id == 0) fail(VFIT_ERROR_HANDLE, "the ", kind_name(kind), " handle is null");
        const Id key = unpack(id);
        if (key.kind != kind)
            fail(VFIT_ERROR_HANDLE, "a ", kind_name(key.kind), " handle was given where a ", kind_name(kind),
                 " handle is wanted");
        if (key.slot >= slots.size() || slots[key.slot].kind != kind ||
            slots[key.slot].generation != key.generation)
            fail(VFIT_ERROR_HANDLE, "the ", kind_name(kind), " handle is stale: its object was destroyed");
        return slots[key.slot];
    }

    /// Takes one id out of the table and hands out its object, to be let go of outside the lock.
    Ref<Object> take(uint32_t index) {
        Slot& slot = slots[index];
        Ref<Object> object = std::move(slot.object);
        slot.kind = Kind::none;
        slot.generation = slot.generation == kGenerationMask ? 1 : slot.generation + 1;
        free.push_back(index);
        return object;
    }

    /// Takes the id and everything below it out of the table; the objects are left in `out`, so that their
    /// destructors run outside the lock. Children come before parents.
    void remove(uint32_t index, std::vector<Ref<Object>>& out) {
        const uint64_t id = pack(index, slots[index].generation, slots[index].kind);
        for (uint32_t i = 0; i < slots.size(); ++i)
            if (slots[i].kind != Kind::none && slots[i].parent == id) remove(i, out);
        out.emplace_back();  // may throw, and must do so before the object is taken
        out.back() = take(index);
    }
};

Handles::Handles() : state_(new State) {}

Handles& Handles::instance() {
    static Handles* table = new Handles;
    return *table;
}

uint64_t Handles::add(Kind kind, Ref<Object> object, uint64_t parent) {
    std::unique_lock lock(state_->mutex);
    if (parent != 0) state_->live(parent, unpack(parent).kind);
    uint32_t index;
    if (state_->free.empty()) {
        index = static_cast<uint32_t>(state_->slots.size());
        state_->slots.emplace_back();
        // Room for every slot, so that a release never allocates.
        state_->free.reserve(state_->slots.capacity());
    } else {
        index = state_->free.back();
        state_->free.pop_back();
    }
    Slot& slot = state_->slots[index];
    slot.object = std::move(object);
    slot.parent = parent;
    slot.kind = kind;
    slot.count = 1;
    return pack(index, slot.generation, kind);
}

Ref<Object> Handles::get(uint64_t id, Kind kind) const {
    std::shared_lock lock(state_->mutex);
    return state_->live(id, kind).object;
}

Handles::Entry Handles::find(uint64_t id, Kind kind, Enter enter) const {
    std::shared_lock lock(state_->mutex);
    const Slot& slot = state_->live(id, kind);
    Entry entry{slot.object, nullptr};
    if (slot.parent != 0) entry.parent = state_->slots[unpack(slot.parent).slot].object;
    enter(entry);
    return entry;
}

void Handles::retain(uint64_t id, Kind kind) {
    std::unique_lock lock(state_->mutex);
    Slot& slot = state_->live(id, kind);
    if (slot.count == UINT32_MAX) fail(VFIT_ERROR_STATE, "the ", kind_name(kind), " was retained too often");
    ++slot.count;
}

void Handles::release(uint64_t id, Kind kind) {
    Ref<Object> last;
    {
        std::unique_lock lock(state_->mutex);
        Slot& slot = state_->live(id, kind);
        if (--slot.count > 0) return;
        // Counted kinds (frames) have nothing below them: no walk through the table.
        last = state_->take(unpack(id).slot);
    }
}

void Handles::destroy(uint64_t id, Kind kind) {
    if (id == 0) return;
    std::vector<Ref<Object>> gone;
    {
        std::unique_lock lock(state_->mutex);
        state_->live(id, kind);
        state_->remove(unpack(id).slot, gone);
    }
    for (const Ref<Object>& object : gone) object->handle_died();
    for (Ref<Object>& object : gone) object = nullptr;
}

std::vector<uint64_t> Handles::children(uint64_t parent, Kind kind) const {
    std::shared_lock lock(state_->mutex);
    std::vector<uint64_t> out;
    for (uint32_t i = 0; i < state_->slots.size(); ++i) {
        const Slot& slot = state_->slots[i];
        if (slot.kind == kind && slot.parent == parent) out.push_back(pack(i, slot.generation, kind));
    }
    return out;
}

uint32_t Handles::count_below(uint64_t parent) const {
    std::shared_lock lock(state_->mutex);
    uint32_t count = 0;
    for (const Slot& slot : state_->slots) {
        uint64_t above = slot.kind == Kind::none ? 0 : slot.parent;
        while (above != 0 && above != parent) above = state_->slots[unpack(above).slot].parent;
        count += above != 0;
    }
    return count;
}

}  // namespace vfit
