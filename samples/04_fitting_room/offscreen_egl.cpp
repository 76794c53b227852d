// OpenGL without window and display: a surfaceless EGL context that draws into memory.
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include "abi.h"
#include "window.h"

namespace room {

namespace {

class Offscreen : public Window {
public:
    Offscreen(int width, int height) : width_(width), height_(height) {
        if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
            throw Failure(
                "EGL cannot draw without a display here: there is no EGL_MESA_platform_surfaceless");
        display_ = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        if (display_ == EGL_NO_DISPLAY || !eglInitialize(display_, nullptr, nullptr))
            throw Failure("EGL cannot draw without a display here");
        constexpr EGLint kWanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                                      3,
                                      EGL_CONTEXT_MINOR_VERSION,
                                      3,
                                      EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                      EGL_NONE};
        eglBindAPI(EGL_OPENGL_API);
        context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kWanted);
        if (context_ == EGL_NO_CONTEXT ||
            !eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
            eglTerminate(display_);
            throw Failure("EGL has no OpenGL 3.3 here");
        }
        glGenFramebuffers(1, &framebuffer_);
        glGenRenderbuffers(1, &color_);
        glBindRenderbuffer(GL_RENDERBUFFER, color_);
        glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_);
    }
    ~Offscreen() override {
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display_, context_);
        eglTerminate(display_);
    }
    int width() const override { return width_; }
    int height() const override { return height_; }
    GLuint framebuffer() const override { return framebuffer_; }
    std::vector<Key>& keys() override { return none_; }
    Pointer pointer() override { return {}; }
    // Nobody looks, and yet the picture has to be drawn before its time is taken.
    void present() override { glFinish(); }

private:
    const int width_, height_;
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
    GLuint framebuffer_ = 0, color_ = 0;
    std::vector<Key> none_;
};

}  // namespace

std::unique_ptr<Window> open_offscreen(int width, int height) {
    return std::make_unique<Offscreen>(width, height);
}

Renderer renderer() {
    Renderer out;
    const GLubyte* name = glGetString(GL_RENDERER);
    if (name) out.name = reinterpret_cast<const char*>(name);
    for (const char* software : {"llvmpipe", "softpipe", "swrast", "Software Rasterizer"})
        if (out.name.find(software) != std::string::npos) out.software = true;
    return out;
}

}  // namespace room
