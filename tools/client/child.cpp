#include "client/child.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>

#include "client/client.h"

namespace vfit::tools {

namespace {

using Clock = std::chrono::steady_clock;

/// Closed at the end, and in other children at their start.
class Pipe {
public:
    Pipe() {
        if (pipe2(ends_.data(), O_CLOEXEC) != 0)
            throw Failure(std::string("no pipe can be made: ") + std::strerror(errno));
    }
    ~Pipe() { close_reader(), close_writer(); }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    int reader() const { return ends_[0]; }
    int writer() const { return ends_[1]; }
    void close_reader() { close_end(ends_[0]); }
    void close_writer() { close_end(ends_[1]); }

private:
    static void close_end(int& end) {
        if (end >= 0) close(end);
        end = -1;
    }
    std::array<int, 2> ends_{-1, -1};
};

pid_t start(const std::vector<std::string>& command, const Pipe& out, const Pipe& error) {
    std::vector<char*> arguments;
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, out.writer(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, error.writer(), STDERR_FILENO);
    pid_t child = 0;
    const int failed = posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) throw Failure(command[0] + ": cannot be started: " + std::strerror(failed));
    return child;
}

/// Takes what has come; false at the end.
bool take(int from, std::string& text) {
    char block[4096];
    const ssize_t count = read(from, block, sizeof block);
    if (count > 0) text.append(block, size_t(count));
    return count > 0 || (count < 0 && errno == EINTR);
}

}  // namespace

ChildResult run_child(const std::vector<std::string>& command, double limit_s) {
    const Clock::time_point began = Clock::now();
    const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - began).count(); };
    ChildResult result;
    Pipe out, error;
    const pid_t child = start(command, out, error);
    out.close_writer(), error.close_writer();
    bool out_open = true, error_open = true;
    while (out_open || error_open) {
        const double left_s = limit_s - seconds();
        if (left_s <= 0.0) {
            kill(child, SIGKILL);
            result.end = ChildResult::End::over_time;
            break;
        }
        // A negative descriptor is passed over.
        pollfd both[2] = {{out_open ? out.reader() : -1, POLLIN, 0},
                          {error_open ? error.reader() : -1, POLLIN, 0}};
        constexpr double kLongestWait_s = 60.0;
        if (poll(both, 2, int(std::min(left_s, kLongestWait_s) * 1000.0) + 1) <= 0) continue;
        if (both[0].revents) out_open = take(out.reader(), result.out);
        if (both[1].revents) error_open = take(error.reader(), result.error);
    }
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    result.seconds = seconds();
    if (result.end == ChildResult::End::over_time) return result;
    result.end = WIFEXITED(status) ? ChildResult::End::exited : ChildResult::End::crashed;
    result.code = WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status);
    return result;
}

std::string own_program() { return std::filesystem::read_symlink("/proc/self/exe").string(); }

}  // namespace vfit::tools
