#include "reader/library.h"

#include <cstdlib>
#include <string>

#include <dlfcn.h>

namespace openni2 {

Library::Library() {
    const char* named = std::getenv("VFIT_OPENNI2_LIBRARY");
    const std::string path = named && *named ? named : "libOpenNI2.so.0";
    handle_ = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!handle_) {
        const char* why = ::dlerror();
        throw Ended(Ending::no_library,
                    "the OpenNI2 library is not to be had (on Debian the package libopenni2-0): " +
                        std::string(why ? why : path));
    }
#define VFIT_OPENNI2_FIND(function)                                               \
    function = reinterpret_cast<decltype(function)>(::dlsym(handle_, #function)); \
    if (!function) throw Ended(Ending::no_library, path + " is no OpenNI2 library: it has no " #function);
    VFIT_OPENNI2_FUNCTIONS(VFIT_OPENNI2_FIND)
#undef VFIT_OPENNI2_FIND
    oniSetLogConsoleOutput(FALSE);
    oniSetLogFileOutput(FALSE);
    check(oniInitialize(ONI_API_VERSION), "OpenNI2 does not start");
}

void Library::check(OniStatus status, const char* what) const {
    if (status == ONI_STATUS_OK) return;
    std::string text = oniGetExtendedError();
    for (char& c : text)
        if (c == '\n' || c == '\t') c = ' ';
    while (!text.empty() && text.back() == ' ') text.pop_back();
    const Ending ending = status == ONI_STATUS_NO_DEVICE ? Ending::no_device : Ending::failed;
    throw Ended(ending,
                std::string(what) + (text.empty() ? ", status " + std::to_string(status) : ": " + text));
}

}  // namespace openni2
