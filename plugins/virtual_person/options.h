// The options of a virtual person: one table of keys, defaults and texts.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vfit.h"

namespace vfit::virtual_person {

/// Keys outside the table are taken for shape keys (vfit_shape_list) and checked by whoever owns a context.
class Options {
public:
    Options();

    /// Known key: checked and stored. VFIT_ERROR_ARGUMENT names the key and what it takes. Returns false for
    /// keys that the table does not hold.
    bool set(const std::string& key, const std::string& value);

    const std::string& text(const char* key) const;
    double number(const char* key) const;
    uint64_t whole(const char* key) const;
    bool flag(const char* key) const { return whole(key) != 0; }

    uint32_t count() const;
    void describe(uint32_t index, vfit_sensor_option& out) const;
    /// "sensor, motion, ...", for messages.
    static std::string names();

private:
    std::vector<std::string> values_;
};

/// Fails with VFIT_ERROR_ARGUMENT unless the text is a number within the bounds.
double parse_number(const std::string& key, const std::string& value, double least, double most);

}  // namespace vfit::virtual_person
