// A window by GLFW, with an OpenGL 3.3 core context.
#include <epoxy/gl.h>
// After the header that brings OpenGL.
#include <GLFW/glfw3.h>

#include <algorithm>
#include <utility>

#include "abi.h"
#include "window.h"

namespace room {

namespace {

Key key_of(int code) {
    switch (code) {
        case GLFW_KEY_LEFT: return Key::left;
        case GLFW_KEY_RIGHT: return Key::right;
        case GLFW_KEY_UP: return Key::up;
        case GLFW_KEY_DOWN: return Key::down;
        case GLFW_KEY_P: return Key::physics;
        case GLFW_KEY_C: return Key::camera;
        case GLFW_KEY_M: return Key::mirror;
        case GLFW_KEY_SPACE: return Key::redress;
        case GLFW_KEY_F: return Key::fit_map;
        case GLFW_KEY_H: return Key::help;
        case GLFW_KEY_ESCAPE: return Key::quit;
        default: return Key::none;
    }
}

std::string why_not() {
    const char* why = nullptr;
    glfwGetError(&why);
    return why ? why : "no reason given";
}

class GlfwWindow : public Window {
public:
    GlfwWindow(int width, int height, const char* title) {
        if (!glfwInit())
            throw Failure("there is no display to open a window on (--offscreen needs none): " + why_not());
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
        window_ = glfwCreateWindow(width, height, title, nullptr, nullptr);
        if (!window_) {
            const std::string why = why_not();
            glfwTerminate();
            throw Failure("no window with OpenGL 3.3 can be opened: " + why);
        }
        glfwMakeContextCurrent(window_);
        glfwSwapInterval(1);
        glfwSetWindowUserPointer(window_, this);
        // A click between two pictures is reported once.
        glfwSetInputMode(window_, GLFW_STICKY_MOUSE_BUTTONS, GLFW_TRUE);
        glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double y) {
            static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window))->wheel_ += float(y);
        });
        glfwSetKeyCallback(window_, [](GLFWwindow* window, int code, int, int action, int) {
            if (action != GLFW_PRESS) return;
            const Key key = key_of(code);
            if (key != Key::none)
                static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window))->keys_.push_back(key);
        });
    }
    ~GlfwWindow() override {
        glfwDestroyWindow(window_);
        glfwTerminate();
    }
    int width() const override { return size().first; }
    int height() const override { return size().second; }
    GLuint framebuffer() const override { return 0; }
    std::vector<Key>& keys() override {
        glfwPollEvents();
        if (glfwWindowShouldClose(window_)) keys_.push_back(Key::quit);
        return keys_;
    }
    Pointer pointer() override {
        // The place is in units of the desktop, the picture in pixels.
        int desktop_width = 0, desktop_height = 0;
        glfwGetWindowSize(window_, &desktop_width, &desktop_height);
        double x = 0.0, y = 0.0;
        glfwGetCursorPos(window_, &x, &y);
        const auto [pixels_x, pixels_y] = size();
        return {float(x) * float(pixels_x) / float(std::max(1, desktop_width)),
                float(y) * float(pixels_y) / float(std::max(1, desktop_height)),
                glfwGetMouseButton(window_, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS,
                std::exchange(wheel_, 0.0f)};
    }
    void present() override { glfwSwapBuffers(window_); }

private:
    std::pair<int, int> size() const {
        int width = 0, height = 0;
        glfwGetFramebufferSize(window_, &width, &height);
        return {width > 0 ? width : 1, height > 0 ? height : 1};  // 0: minimised
    }
    GLFWwindow* window_;
    std::vector<Key> keys_;
    float wheel_ = 0.0f;
};

}  // namespace

std::unique_ptr<Window> open_window(int width, int height, const char* title) {
    return std::make_unique<GlfwWindow>(width, height, title);
}

}  // namespace room
