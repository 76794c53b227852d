// The OpenNI2 library, found at run time: a machine without it still has all other sensors, and a vendor's
// own copy, with drivers beside it, can be named by VFIT_OPENNI2_LIBRARY.
#pragma once

#include <stdexcept>

#include <OniCAPI.h>
#include <OniCProperties.h>

#include "wire.h"

namespace openni2 {

/// Why the device is not, or no longer, to be had.
class Ended : public std::runtime_error {
public:
    Ended(Ending ending, const std::string& text) : std::runtime_error(text), ending_(ending) {}
    Ending ending() const { return ending_; }

private:
    Ending ending_;
};

// clang-format off
#define VFIT_OPENNI2_FUNCTIONS(DO)                \
    DO(oniInitialize)                             \
    DO(oniGetDeviceList)                          \
    DO(oniReleaseDeviceList)                      \
    DO(oniRegisterDeviceCallbacks)                \
    DO(oniUnregisterDeviceCallbacks)              \
    DO(oniWaitForAnyStream)                       \
    DO(oniGetExtendedError)                       \
    DO(oniDeviceOpen)                             \
    DO(oniDeviceClose)                            \
    DO(oniDeviceGetSensorInfo)                    \
    DO(oniDeviceGetInfo)                          \
    DO(oniDeviceCreateStream)                     \
    DO(oniDeviceSetProperty)                      \
    DO(oniDeviceGetProperty)                      \
    DO(oniDeviceIsImageRegistrationModeSupported) \
    DO(oniStreamDestroy)                          \
    DO(oniStreamStart)                            \
    DO(oniStreamStop)                             \
    DO(oniStreamReadFrame)                        \
    DO(oniStreamSetProperty)                      \
    DO(oniStreamGetProperty)                      \
    DO(oniFrameRelease)                           \
    DO(oniSetLogConsoleOutput)                    \
    DO(oniSetLogFileOutput)
// clang-format on

/// Initialised, and never shut down: with its drivers' threads about, that crashes now and then, and the
/// process ends anyway.
class Library {
public:
    Library();
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;

    /// Throws Ended with what the library says.
    void check(OniStatus status, const char* what) const;

#define VFIT_OPENNI2_MEMBER(name) decltype(&::name) name = nullptr;
    VFIT_OPENNI2_FUNCTIONS(VFIT_OPENNI2_MEMBER)
#undef VFIT_OPENNI2_MEMBER

private:
    void* handle_ = nullptr;
};

}  // namespace openni2
