// How this plug-in fails: by plugin::Failure, whose sentence may be the library's own.
#pragma once

#include "support/failure.h"

namespace vfit::virtual_person {

using Error = plugin::Failure;
using plugin::fail;

/// Fails with the library's own sentence unless a call of vfit.h succeeded.
inline void check(vfit_result result, const char* call) {
    if (result >= 0) return;
    char why[512];
    vfit_last_error(why, sizeof why);
    fail(result, "virtual: ", call, ": ", why);
}

}  // namespace vfit::virtual_person
