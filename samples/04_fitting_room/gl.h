// What the views need of OpenGL 3.3: programs, and buffers that the library writes into.
#pragma once

#include <epoxy/gl.h>

#include <cstddef>

namespace room {

GLuint make_program(const char* vertex_source, const char* fragment_source);

/// A vertex buffer that is written anew for each picture. What was there is thrown away, so that nobody waits
/// until the last picture is drawn.
class StreamBuffer {
public:
    void create() { glGenBuffers(1, &buffer_); }
    GLuint name() const { return buffer_; }
    /// Memory of the driver, to be written and not read.
    void* map(size_t bytes);
    void unmap();

private:
    GLuint buffer_ = 0;
    size_t size_ = 0;
};

/// A float attribute of the buffer that is bound.
void attribute(GLuint index, GLint floats, size_t stride, size_t offset);

}  // namespace room
