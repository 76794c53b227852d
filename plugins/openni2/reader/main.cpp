// Reads one device or file through OpenNI2 in a process of its own, so that a driver that crashes, or a file
// that makes the library crash, takes no host with it. Started by the plug-in alone:
//   vfit_openni2_reader list | open [URI]      (its end of the socket is descriptor 3)
#include <cstdio>
#include <cstring>
#include <memory>
#include <thread>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <unistd.h>

#include "reader/camera.h"
#include "socket.h"

namespace openni2 {

namespace {

constexpr int kLook_ms = 20;  // for an image, then for what the plug-in says

void tell(const Socket& socket, const Ended& ended) {
    State state{};
    state.ending = ended.ending();
    std::snprintf(state.text, sizeof state.text, "%s", ended.what());
    socket.send(Kind::state, state);
}

void list(const Socket& socket) {
    const Library library;
    for (const Listed& listed : list_devices(library)) socket.send(Kind::listed, listed);
    socket.send(Kind::list_end);
}

class Session {
public:
    Session(const Socket& socket, const std::string& uri) : socket_(socket), camera_(library_, uri) {}

    void run() {
        socket_.send(Kind::opened, camera_.description());
        for (;;) {
            if (socket_.wait(running_ ? 0 : -1)) obey(socket_.receive_head(-1));
            if (running_) look();
        }
    }

private:
    void obey(const Head& head) {
        if (head.kind == Kind::start && head.bytes == sizeof(Start)) {
            Start start{};
            socket_.receive(&start, sizeof start, -1);
            running_ = true;
            watch([&] { camera_.start(start); });
        } else if (head.kind == Kind::stop) {
            running_ = false;
            camera_.stop();
            socket_.send(Kind::stopped);
        } else {
            throw Broken("it wants what is not known here");
        }
    }
    void look() {
        watch([&] {
            if (!camera_.next(kLook_ms, picture_)) return;
            const size_t depth = picture_.depth.size() * sizeof(uint16_t),
                         color = picture_.image.has_color ? picture_.color.size() : 0;
            const Head head{kMagic, Kind::image, uint32_t(sizeof picture_.image + depth + color), 0};
            socket_.send(&head, sizeof head);
            socket_.send(&picture_.image, sizeof picture_.image);
            socket_.send(picture_.depth.data(), depth);
            socket_.send(picture_.color.data(), color);
        });
    }
    template <typename What>
    void watch(What&& what) {
        try {
            what();
        } catch (const Ended& ended) {
            running_ = false;
            tell(socket_, ended);
        }
    }

    const Socket& socket_;
    const Library library_;
    Camera camera_;
    Picture picture_{};
    bool running_ = false;
};

/// Goes when the plug-in has gone, also where a driver hangs.
void leave_with_the_plugin(int socket) {
    std::thread([socket] {
        pollfd entry{socket, POLLRDHUP, 0};
        while (::poll(&entry, 1, -1) < 0) {
        }
        // Those who read the socket hear of it as well, and close the device in order; a driver that hangs
        // does not.
        std::this_thread::sleep_for(std::chrono::seconds(3));
        ::_exit(1);
    }).detach();
}

/// What a damaged file makes the library ask for, it does not get; and nothing is left of a crash.
void limit_memory() {
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_CORE, &none);
#if !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)  // which want an address space of terabytes
    const rlimit memory{rlim_t(4) << 30, rlim_t(4) << 30};
    ::setrlimit(RLIMIT_AS, &memory);
#endif
}

int run(int count, char** words) {
    const Socket socket(kReaderSocket);
    leave_with_the_plugin(kReaderSocket);
    // Drivers print what no host wants among its own output.
    if (const int nothing = ::open("/dev/null", O_WRONLY); nothing >= 0)
        ::dup2(nothing, 1), ::dup2(nothing, 2);
    try {
        try {
            if (count == 2 && std::strcmp(words[1], "list") == 0)
                list(socket);
            else if (count == 3 && std::strcmp(words[1], "open") == 0)
                Session(socket, words[2]).run();
            else
                return 2;
        } catch (const Ended& ended) {
            tell(socket, ended);
        } catch (const std::bad_alloc&) {
            tell(socket, Ended(Ending::damaged,
                               std::string(words[count - 1]) + ": asks for more memory than there is"));
        }
    } catch (const Broken&) {
        // The plug-in has closed the device.
    }
    return 0;
}

}  // namespace

}  // namespace openni2

int main(int count, char** words) {
    openni2::limit_memory();
    // Not by way of the library's own clean-up: see Library.
    ::_exit(openni2::run(count, words));
}
