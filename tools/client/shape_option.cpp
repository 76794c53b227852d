#include "client/shape_option.h"

#include <cstdio>
#include <cstdlib>

#include "client/client.h"
#include "client/outfit.h"

namespace vfit::tools {

std::vector<vfit_shape_value> shape_values(const std::string& text) {
    std::vector<vfit_shape_value> values;
    if (text.empty()) return values;
    for (const std::string& part : split(text, ',')) {
        const auto parts = split(part, '=');
        vfit_shape_value v = vfit_shape_value_init();
        char* end = nullptr;
        if (parts.size() == 2) v.value = std::strtof(parts[1].c_str(), &end);
        if (parts.size() != 2 || parts[0].size() >= sizeof v.key || !end || end == parts[1].c_str() || *end)
            throw Failure("--shape: \"" + part + "\" is not KEY=NUMBER");
        std::snprintf(v.key, sizeof v.key, "%s", parts[0].c_str());
        values.push_back(v);
    }
    return values;
}

}  // namespace vfit::tools
