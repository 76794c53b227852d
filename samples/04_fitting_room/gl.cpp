#include "gl.h"

#include <string>

#include "abi.h"

namespace room {

namespace {

GLuint compiled(GLenum kind, const char* source) {
    const GLuint shader = glCreateShader(kind);
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint good = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (!good) {
        char why[512];
        glGetShaderInfoLog(shader, sizeof why, nullptr, why);
        throw Failure(std::string("OpenGL does not compile a shader: ") + why);
    }
    return shader;
}

}  // namespace

GLuint make_program(const char* vertex_source, const char* fragment_source) {
    const GLuint program = glCreateProgram();
    const GLuint shaders[] = {compiled(GL_VERTEX_SHADER, vertex_source),
                              compiled(GL_FRAGMENT_SHADER, fragment_source)};
    for (const GLuint shader : shaders) glAttachShader(program, shader);
    glLinkProgram(program);
    for (const GLuint shader : shaders) glDeleteShader(shader);
    GLint good = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &good);
    if (!good) throw Failure("OpenGL does not link a program");
    return program;
}

void* StreamBuffer::map(size_t bytes) {
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    if (bytes != size_) {
        glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(bytes), nullptr, GL_STREAM_DRAW);
        size_ = bytes;
    }
    void* memory = glMapBufferRange(GL_ARRAY_BUFFER, 0, GLsizeiptr(bytes),
                                    GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT);
    if (!memory) throw Failure("OpenGL gives no memory for vertices");
    return memory;
}

void StreamBuffer::unmap() {
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    glUnmapBuffer(GL_ARRAY_BUFFER);
}

void attribute(GLuint index, GLint floats, size_t stride, size_t offset) {
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, floats, GL_FLOAT, GL_FALSE, GLsizei(stride),
                          reinterpret_cast<const void*>(offset));
}

}  // namespace room
