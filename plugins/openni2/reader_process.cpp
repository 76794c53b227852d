#include "reader_process.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <thread>

#include <dlfcn.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/failure.h"
#include "vfit_plugin.h"

extern char** environ;

namespace openni2 {

namespace {

constexpr int kGoes_ms = 4000;  // a device closes within that, or never

/// Beside the plug-in.
std::string program() {
    Dl_info info{};
    if (!::dladdr(reinterpret_cast<const void*>(&vfit_plugin_negotiate), &info) || !info.dli_fname)
        plugin::fail(VFIT_ERROR_PLUGIN, "openni2: the plug-in does not find its own folder");
    return (std::filesystem::path(info.dli_fname).parent_path() / "vfit_openni2_reader").string();
}

struct FileActions {
    posix_spawn_file_actions_t actions;
    FileActions() { ::posix_spawn_file_actions_init(&actions); }
    ~FileActions() { ::posix_spawn_file_actions_destroy(&actions); }
};

struct Attributes {
    posix_spawnattr_t attributes;
    /// The host's blocked and ignored signals are its own.
    Attributes() {
        ::posix_spawnattr_init(&attributes);
        sigset_t none, all;
        ::sigemptyset(&none), ::sigfillset(&all);
        ::posix_spawnattr_setsigmask(&attributes, &none);
        ::posix_spawnattr_setsigdefault(&attributes, &all);
        // A group of its own: Ctrl-C in a terminal is the host's to act on.
        ::posix_spawnattr_setpgroup(&attributes, 0);
        ::posix_spawnattr_setflags(&attributes,
                                   POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    }
    ~Attributes() { ::posix_spawnattr_destroy(&attributes); }
};

}  // namespace

ReaderProcess::ReaderProcess(std::vector<std::string> words) {
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        plugin::fail(VFIT_ERROR_IO, "openni2: no socket: ", std::strerror(errno));
    socket_ = std::make_unique<Socket>(ends[0]);
    const Socket other(ends[1]);
    words.insert(words.begin(), program());
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    FileActions files;
    ::posix_spawn_file_actions_adddup2(&files.actions, other.descriptor(), kReaderSocket);
#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 34)
    ::posix_spawn_file_actions_addclosefrom_np(&files.actions, kReaderSocket + 1);
#endif
    const Attributes attributes;
    pid_t process = -1;
    if (const int error = ::posix_spawn(&process, arguments[0], &files.actions, &attributes.attributes,
                                        arguments.data(), environ))
        plugin::fail(VFIT_ERROR_PLUGIN, arguments[0], ": cannot be started: ", std::strerror(error));
    process_ = process;
}

ReaderProcess::~ReaderProcess() {
    socket_.reset();
    if (!ended(kGoes_ms)) end();
}

/// A host that reaps all its children has seen this one's end before.
bool ReaderProcess::ended(int milliseconds) {
    constexpr auto kNap = std::chrono::milliseconds(2);
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(milliseconds);
    while (process_ > 0) {
        const pid_t got = ::waitpid(process_, &status_, WNOHANG);
        if (got == process_ || (got < 0 && errno == ECHILD))
            process_ = -1;
        else if (std::chrono::steady_clock::now() >= until)
            return false;
        else
            std::this_thread::sleep_for(kNap);
    }
    return true;
}

std::string ReaderProcess::end() {
    constexpr int kDies_ms = 500;  // what broke the socket is a moment before the end of the process
    if (!ended(kDies_ms)) {
        ::kill(process_, SIGKILL);
        while (::waitpid(process_, &status_, 0) < 0 && errno == EINTR) {
        }
        process_ = -1;
        return "hung, and was ended";
    }
    if (WIFSIGNALED(status_)) return "crashed (signal " + std::to_string(WTERMSIG(status_)) + ")";
    return "ended with status " + std::to_string(WIFEXITED(status_) ? WEXITSTATUS(status_) : -1);
}

}  // namespace openni2
