#pragma once
// A VTK window without a display: an EGL context without a surface, rendered by Mesa in software.

#include <vtkGenericOpenGLRenderWindow.h>

namespace mpfem {

/// Debian's VTK draws only into X windows. This window needs no X server, and its pictures are the same everywhere.
/// New() throws SimulationError where no such context can be made.
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
