#include "core/platform.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <thread>
#include <vector>

#include "core/error.h"

#if defined(_WIN32)
#include <windows.h>
#else
#include <dlfcn.h>
#endif
#if defined(__linux__)
#include <sched.h>
#endif

namespace vfit {

#if defined(_WIN32)

DynamicLibrary::DynamicLibrary(const std::string& path)
    : handle_(LoadLibraryW(std::filesystem::path(std::u8string(path.begin(), path.end())).c_str())) {
    if (!handle_) fail(VFIT_ERROR_PLUGIN, path, ": cannot be loaded, error ", GetLastError());
}
DynamicLibrary::~DynamicLibrary() { FreeLibrary(static_cast<HMODULE>(handle_)); }
void* DynamicLibrary::symbol(const char* name) const {
    return reinterpret_cast<void*>(GetProcAddress(static_cast<HMODULE>(handle_), name));
}
std::string library_folder() {
    HMODULE module = nullptr;
    GetModuleHandleExW(GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS | GET_MODULE_HANDLE_EX_FLAG_UNCHANGED_REFCOUNT,
                       reinterpret_cast<LPCWSTR>(&library_folder), &module);
    wchar_t path[32768];
    GetModuleFileNameW(module, path, 32768);
    const std::u8string folder = std::filesystem::path(path).parent_path().u8string();
    return {folder.begin(), folder.end()};
}
const char* library_suffix() { return ".dll"; }

#else

DynamicLibrary::DynamicLibrary(const std::string& path)
    : handle_(dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) {
    if (!handle_) fail(VFIT_ERROR_PLUGIN, "cannot load plug-in: ", dlerror());
}
DynamicLibrary::~DynamicLibrary() { dlclose(handle_); }
void* DynamicLibrary::symbol(const char* name) const { return dlsym(handle_, name); }
std::string library_folder() {
    Dl_info info{};
    if (dladdr(reinterpret_cast<void*>(&library_folder), &info) == 0 || !info.dli_fname) return ".";
    std::error_code ignored;
    std::filesystem::path path = info.dli_fname;
#if defined(__linux__)
    // A program found by PATH is named by its bare name.
    if (!path.has_parent_path()) path = std::filesystem::read_symlink("/proc/self/exe", ignored);
#endif
    path = std::filesystem::weakly_canonical(path, ignored);
    return path.has_parent_path() ? path.parent_path().string() : ".";
}
#if defined(__APPLE__)
const char* library_suffix() { return ".dylib"; }
#else
const char* library_suffix() { return ".so"; }
#endif

#endif

namespace {

/// Logical cores that this thread, and those that it starts, may run on.
std::vector<unsigned> allowed_cores() {
    std::vector<unsigned> out;
#if defined(__linux__)
    // What a container or taskset leaves: hardware_concurrency() may count cores that are out of reach.
    cpu_set_t allowed;
    CPU_ZERO(&allowed);
    if (sched_getaffinity(0, sizeof allowed, &allowed) == 0)
        for (unsigned i = 0; i < CPU_SETSIZE; ++i)
            if (CPU_ISSET(i, &allowed)) out.push_back(i);
#endif
    if (out.empty())
        for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i) out.push_back(i);
    return out;
}

}  // namespace

unsigned physical_cores() {
    const std::vector<unsigned> logical = allowed_cores();
    // Threads of one core share a line in thread_siblings_list; elsewhere logical cores must do.
    std::set<std::string> cores;
    for (const unsigned i : logical) {
        std::ifstream file(text("/sys/devices/system/cpu/cpu", i, "/topology/thread_siblings_list"));
        std::string siblings;
        if (!std::getline(file, siblings)) return unsigned(logical.size());
        cores.insert(siblings);
    }
    return unsigned(cores.size());
}

}  // namespace vfit
