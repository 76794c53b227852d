#include "core/platform.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <thread>

#include "core/error.h"

#if defined(_WIN32)
#include <windows.h>
#else
#include <dlfcn.h>
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

DynamicLibrary::DynamicLibrary(const std::string& path) : handle_(dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) {
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

unsigned physical_cores() {
    const unsigned logical = std::max(1u, std::thread::hardware_concurrency());
    // Threads of one core share a line in thread_siblings_list; elsewhere logical cores must do.
    std::set<std::string> cores;
    for (unsigned i = 0; i < logical; ++i) {
        std::ifstream file(text("/sys/devices/system/cpu/cpu", i, "/topology/thread_siblings_list"));
        std::string siblings;
        if (!std::getline(file, siblings)) return logical;
        cores.insert(siblings);
    }
    return static_cast<unsigned>(std::max<size_t>(1, cores.size()));
}

}  // namespace vfit
