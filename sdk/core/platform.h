// All calls to the operating system that the C++ library lacks.
#pragma once

#include <string>
#include <vector>

namespace vfit {

/// A loaded shared library; closed when destroyed.
class DynamicLibrary {
public:
    /// Fails with VFIT_ERROR_PLUGIN and the loader's own words.
    explicit DynamicLibrary(const std::string& path);
    ~DynamicLibrary();
    DynamicLibrary(const DynamicLibrary&) = delete;
    DynamicLibrary& operator=(const DynamicLibrary&) = delete;

    /// Address of a symbol, or null.
    void* symbol(const char* name) const;

private:
    void* handle_;
};

/// The folder that holds the library (or program) this code is linked into.
std::string library_folder();

/// ".so", ".dll" or ".dylib".
const char* library_suffix();

/// Physical cores of this machine that the process may use, at least 1.
unsigned physical_cores();

}  // namespace vfit
