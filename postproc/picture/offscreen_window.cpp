#include "postproc/picture/offscreen_window.hpp"

#include <cstdlib>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <vtkObjectFactory.h>
#include <vtk_glew.h>

#include "common/errors.hpp"

namespace mpfem {

vtkStandardNewMacro(OffscreenWindow);

namespace {

/// The display of the surfaceless platform. Extensions are looked up by name; EGL returns a pointer to a function
/// without arguments.
EGLDisplay display_without_surfaces() {
  const auto get_display =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
  return get_display ? get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr) : EGL_NO_DISPLAY;
}

EGLContext make_context(EGLDisplay display) {
  constexpr EGLint attributes[] = {
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 2, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr) || !eglBindAPI(EGL_OPENGL_API))
    return EGL_NO_CONTEXT;
  return eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
}

} // namespace

OffscreenWindow::OffscreenWindow() {
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1); // the same picture with any graphics card
  display_ = display_without_surfaces();
  context_ = make_context(display_);
  if (context_ == EGL_NO_CONTEXT || !eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
    throw SimulationError(
        "OpenGL without a screen is not available; ./bootstrap pictures installs it (libgl1-mesa-dri, libegl1)");
  SetOffScreenRendering(true);
  SetMultiSamples(0);
  SetReadyForRendering(true);
  SetSupportsOpenGL(1);
  SetIsDirect(1);
}

OffscreenWindow::~OffscreenWindow() {
  Finalize(); // frees VTK's buffers while their context exists
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

void OffscreenWindow::MakeCurrent() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
}

bool OffscreenWindow::IsCurrent() {
  return eglGetCurrentContext() == context_;
}

void OffscreenWindow::OpenGLInitContext() {
  // Debian's GLEW also looks for an X display after it has found the functions, and then reports an error that VTK
  // would treat as fatal.
  const GLenum result = glewInit();
  if (result != GLEW_OK && result != GLEW_ERROR_NO_GLX_DISPLAY)
    throw SimulationError("the functions of OpenGL cannot be found");
  Initialized = true;
  Superclass::OpenGLInitContext();
}

} // namespace mpfem
