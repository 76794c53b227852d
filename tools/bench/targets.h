// Figures with the targets that they are held against: each a line "name  figure  target  hit or MISS".
#pragma once

#include <string>

#include "client/client.h"

namespace vfit::tools {

enum class Aim { at_least, at_most, exactly };

class Targets {
public:
    explicit Targets(bool quiet) : quiet_(quiet) {}

    /// Prints the line (with that many digits after the point) and keeps it. A figure that is no number is a
    /// miss.
    bool judge(const std::string& name, double figure, Aim aim, double target, int digits = 0,
               const char* unit = "");
    size_t missed() const { return missed_; }
    size_t count() const { return rows_.size(); }
    /// [{"name", "figure", "aim", "target", "unit", "hit"}, ...]; all since the first.
    const Json& json() const { return rows_; }

private:
    bool quiet_;
    size_t missed_ = 0;
    Json rows_ = Json::array();
};

}  // namespace vfit::tools
