// A body drawn from a number: sex, stature, weight and build of an adult.
#pragma once

#include <map>
#include <string>

#include "vfit.h"

namespace vfit::virtual_person {

struct RandomBody {
    vfit_sex sex;
    std::map<std::string, float> shape;  // keys of vfit_shape_list
};

/// Equal numbers give equal bodies. What `given` says stays as it is; a sex other than UNKNOWN as well.
RandomBody draw_body(uint64_t number, vfit_sex sex, const std::map<std::string, float>& given);

}  // namespace vfit::virtual_person
