#include "compute_shader.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>

#include <cstring>
#include <glm/vec4.hpp>

namespace shoal::test {
namespace {

// A function of OpenGL by its name.
template <typename Function>
Function gl(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

// A context of OpenGL 4.3, which has compute shaders, without a surface.
class Context {
 public:
  Context() {
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const auto get_display = gl<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    if (extensions == nullptr || get_display == nullptr ||
        std::strstr(extensions, "EGL_MESA_platform_surfaceless") == nullptr) {
      error_ = "EGL has no display without a window system";
      return;
    }
    display_ = get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (!eglInitialize(display_, nullptr, nullptr) || !eglBindAPI(EGL_OPENGL_API)) {
      error_ = "EGL does not start (Debian's libgl1-mesa-dri)";
      return;
    }
    const EGLint wish[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 3, EGL_NONE};
    context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wish);
    if (context_ == EGL_NO_CONTEXT ||
        !eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
      error_ = "EGL has no OpenGL 4.3 without a surface";
    }
  }
  ~Context() {
    if (context_ == EGL_NO_CONTEXT) return;
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  [[nodiscard]] const std::string& error() const { return error_; }

 private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
  std::string error_;
};

// The program of a compute shader, or 0 with the compiler's words in `log`.
GLuint build(const std::string& source, std::string& log) {
  const GLuint shader = gl<PFNGLCREATESHADERPROC>("glCreateShader")(GL_COMPUTE_SHADER);
  const char* text = source.c_str();
  gl<PFNGLSHADERSOURCEPROC>("glShaderSource")(shader, 1, &text, nullptr);
  gl<PFNGLCOMPILESHADERPROC>("glCompileShader")(shader);
  const GLuint program = gl<PFNGLCREATEPROGRAMPROC>("glCreateProgram")();
  gl<PFNGLATTACHSHADERPROC>("glAttachShader")(program, shader);
  gl<PFNGLLINKPROGRAMPROC>("glLinkProgram")(program);
  GLint linked = GL_FALSE;
  gl<PFNGLGETPROGRAMIVPROC>("glGetProgramiv")(program, GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return program;
  char words[4096] = "";
  gl<PFNGLGETSHADERINFOLOGPROC>("glGetShaderInfoLog")(shader, sizeof words, nullptr, words);
  log = words + source;
  return 0;
}

// A buffer of the shader's, filled.
GLuint make_buffer(GLuint binding, const std::vector<glm::vec4>& content) {
  GLuint buffer = 0;
  gl<PFNGLGENBUFFERSPROC>("glGenBuffers")(1, &buffer);
  gl<PFNGLBINDBUFFERPROC>("glBindBuffer")(GL_SHADER_STORAGE_BUFFER, buffer);
  gl<PFNGLBUFFERDATAPROC>("glBufferData")(
      GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(content.size() * sizeof(glm::vec4)),
      content.data(), GL_STATIC_DRAW);
  gl<PFNGLBINDBUFFERBASEPROC>("glBindBufferBase")(GL_SHADER_STORAGE_BUFFER, binding, buffer);
  return buffer;
}

}  // namespace

ShaderRun run_on_directions(const std::string& source, const std::string& function,
                            const std::vector<glm::dvec3>& directions) {
  ShaderRun run;
  const Context context;
  run.error = context.error();
  if (!run.error.empty()) return run;
  const GLuint program = build(
      "#version 430\n"
      "layout(local_size_x = 1) in;\n"
      "layout(std430, binding = 0) readonly buffer In { vec4 normals[]; };\n"
      "layout(std430, binding = 1) writeonly buffer Out { vec4 values[]; };\n" +
          source +
          "void main() {\n"
          "  uint i = gl_GlobalInvocationID.x;\n"
          "  values[i] = vec4(" +
          function + "(normals[i].xyz), 1.0);\n}\n",
      run.log);
  if (program == 0) return run;
  std::vector<glm::vec4> content;
  for (const glm::dvec3& direction : directions) content.emplace_back(direction, 0.0);
  make_buffer(0, content);
  make_buffer(1, std::vector<glm::vec4>(content.size()));
  gl<PFNGLUSEPROGRAMPROC>("glUseProgram")(program);
  gl<PFNGLDISPATCHCOMPUTEPROC>("glDispatchCompute")(static_cast<GLuint>(content.size()), 1, 1);
  gl<PFNGLMEMORYBARRIERPROC>("glMemoryBarrier")(GL_BUFFER_UPDATE_BARRIER_BIT);
  gl<PFNGLGETBUFFERSUBDATAPROC>("glGetBufferSubData")(
      GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizeiptr>(content.size() * sizeof(glm::vec4)),
      content.data());
  for (const glm::vec4& value : content) run.values.emplace_back(value);
  return run;
}

}  // namespace shoal::test
