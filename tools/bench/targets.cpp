#include "bench/targets.h"

#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace vfit::tools {

namespace {

constexpr int kNameWidth = 76, kFigureWidth = 10;

std::string number(double value, int digits, const char* unit) {
    std::ostringstream text;
    if (std::isfinite(value))
        text << std::fixed << std::setprecision(digits) << value << unit;
    else
        text << "none";
    return text.str();
}

const char* sign_of(Aim aim) { return aim == Aim::at_least ? ">=" : aim == Aim::at_most ? "<=" : "="; }

}  // namespace

bool Targets::judge(const std::string& name, double figure, Aim aim, double target, int digits,
                    const char* unit) {
    const bool hit = std::isfinite(figure) && (aim == Aim::at_least  ? figure >= target
                                               : aim == Aim::at_most ? figure <= target
                                                                     : figure == target);
    missed_ += !hit;
    rows_.push_back({{"name", name},
                     {"figure", std::isfinite(figure) ? Json(figure) : Json()},
                     {"aim", sign_of(aim)},
                     {"target", target},
                     {"unit", unit},
                     {"hit", hit}});
    if (!quiet_)
        std::cout << "  " << std::left << std::setw(kNameWidth) << name << std::right
                  << std::setw(kFigureWidth) << number(figure, digits, unit) << "   " << std::setw(2)
                  << sign_of(aim) << " " << std::left << std::setw(kFigureWidth)
                  << number(target, digits, unit) << (hit ? "hit" : "MISS") << std::right << std::endl;
    return hit;
}

}  // namespace vfit::tools
