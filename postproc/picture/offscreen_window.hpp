#pragma once
// A window of VTK without a display: an OpenGL context of EGL that belongs to no surface, drawn by Mesa in software.

#include <vtkGenericOpenGLRenderWindow.h>

namespace mpfem {

/// Debian's VTK draws into windows of X alone. This one needs no X server, and its pictures are the same on every
/// machine. New() throws SimulationError where there is no such context.
class OffscreenWindow : public vtkGenericOpenGLRenderWindow {
public:
  static OffscreenWindow* New();
  vtkTypeMacro(OffscreenWindow, vtkGenericOpenGLRenderWindow)

      void MakeCurrent() override;
  bool IsCurrent() override;
  void OpenGLInitContext() override;

protected:
  OffscreenWindow();
  ~OffscreenWindow() override;

private:
  void* display_ = nullptr; ///< EGLDisplay
  void* context_ = nullptr; ///< EGLContext
};

} // namespace mpfem
