#include "postproc/picture/draw_scene.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkOutlineSource.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty.h>
#include <vtkRenderStepsPass.h>
#include <vtkRenderer.h>
#include <vtkSSAOPass.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTubeFilter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include "common/errors.hpp"
#include "common/output_file.hpp"
#include "postproc/drawing/ticks.hpp"
#include "postproc/picture/heading.hpp"
#include "postproc/picture/offscreen_window.hpp"

namespace mpfem {

namespace {

/// Everything is drawn twice as large in both directions, then averaged.
constexpr int supersampling = 2;
constexpr RodKind rod_kinds[] = {RodKind::intact, RodKind::damaged, RodKind::broken, RodKind::contact};
constexpr double dark_grey[3] = {0.25, 0.25, 0.25};

using MakeColour = std::function<Colour(std::size_t triangle, std::size_t corner)>;

vtkNew<vtkPolyData> mesh_of(const std::vector<SolidTriangle>& triangles, const MakeColour& colour_of) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> normals;
  vtkNew<vtkUnsignedCharArray> colours;
  vtkNew<vtkCellArray> cells;
  normals->SetNumberOfComponents(3);
  colours->SetNumberOfComponents(3);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    cells->InsertNextCell(3);
    for (std::size_t c = 0; c < 3; ++c) {
      const SolidVertex& vertex = triangles[t].corner[c];
      cells->InsertCellPoint(points->InsertNextPoint(vertex.position.data()));
      normals->InsertNextTuple(vertex.normal.data());
      colours->InsertNextTypedTuple(colour_of(t, c).data());
    }
  }
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetPolys(cells);
  mesh->GetPointData()->SetNormals(normals);
  mesh->GetPointData()->SetScalars(colours);
  return mesh;
}

vtkNew<vtkActor> actor_of(vtkPolyData* mesh, bool lit) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetLighting(lit);
  actor->GetProperty()->SetAmbient(0.48);
  actor->GetProperty()->SetDiffuse(0.62);
  actor->GetProperty()->SetSpecular(0);
  return actor;
}

/// Colours that number the grains' faces, from 1: an outline is drawn where they change. 0 is the background.
Colour outline_key(const SolidTriangle& t) {
  const auto number = static_cast<std::uint32_t>(1 + 4 * t.grain + t.face);
  return {static_cast<std::uint8_t>(number & 255U), static_cast<std::uint8_t>(number >> 8U & 255U),
          static_cast<std::uint8_t>(number >> 16U & 255U)};
}

vtkNew<vtkActor> rods_of(const std::vector<PairRod>& rods, RodKind kind) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkDoubleArray> radius;
  for (const PairRod& rod : rods) {
    if (rod.kind != kind) continue;
    lines->InsertNextCell(2);
    for (const Eigen::Vector3d& end : {rod.from, rod.to}) {
      lines->InsertCellPoint(points->InsertNextPoint(end.data()));
      radius->InsertNextValue(rod.radius);
    }
  }
  vtkNew<vtkPolyData> axes;
  axes->SetPoints(points);
  axes->SetLines(lines);
  axes->GetPointData()->SetScalars(radius);
  vtkNew<vtkTubeFilter> tubes;
  tubes->SetInputData(axes);
  tubes->SetVaryRadiusToVaryRadiusByAbsoluteScalar();
  tubes->SetNumberOfSides(16);
  tubes->CappingOn();
  tubes->Update();
  vtkNew<vtkActor> actor = actor_of(tubes->GetOutput(), true);
  actor->GetMapper()->ScalarVisibilityOff();
  const Colour colour = rod_colour(kind);
  actor->GetProperty()->SetColor(colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0);
  return actor;
}

vtkNew<vtkActor> box_edges(const ShownBox& box, double radius) {
  vtkNew<vtkOutlineSource> edges;
  edges->SetBounds(box.low[0], box.high[0], box.low[1], box.high[1], box.low[2], box.high[2]);
  vtkNew<vtkTubeFilter> tubes;
  tubes->SetInputConnection(edges->GetOutputPort());
  tubes->SetRadius(radius);
  tubes->SetNumberOfSides(8);
  tubes->CappingOn();
  tubes->Update();
  vtkNew<vtkActor> actor = actor_of(tubes->GetOutput(), false);
  actor->GetMapper()->ScalarVisibilityOff();
  actor->GetProperty()->SetColor(dark_grey[0], dark_grey[1], dark_grey[2]);
  return actor;
}

void set_camera(vtkRenderer* renderer, const ViewFrame& view, const ShownBox& shown) {
  const double reach = (shown.high - shown.low).norm();
  const Eigen::Vector3d position = view.focus + 2 * reach * view.towards_camera;
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(view.focus.data());
  camera->SetPosition(position.data());
  camera->SetViewUp(view.up.data());
  camera->SetParallelScale(0.5 * view.pixel * view.size.height);
  camera->SetClippingRange(0.5 * reach, 3.5 * reach);
}

/// One light from the upper left and a weaker one near the camera: the three cut faces look different, and colours stay
/// close to those of the bar.
void set_lights(vtkRenderer* renderer) {
  const struct { double x, y, z, intensity; } lights[] = {{-0.35, 0.6, 1, 0.6}, {0.5, 0.1, 1, 0.35}};
  for (const auto& given : lights) {
    vtkNew<vtkLight> light;
    light->SetLightTypeToCameraLight();
    light->SetPosition(given.x, given.y, given.z);
    light->SetFocalPoint(0, 0, 0);
    light->SetIntensity(given.intensity);
    renderer->AddLight(light);
  }
}

void add_text(vtkRenderer* renderer, const std::string& text, const Eigen::Vector2d& place, double height, bool centred,
              double orientation = 0) {
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  vtkTextProperty* property = actor->GetTextProperty();
  property->SetFontSize(std::max(1, static_cast<int>(std::lround(height))));
  property->SetColor(0, 0, 0);
  property->SetOrientation(orientation);
  property->SetBackgroundColor(1, 1, 1); // grains of a failing sample fly behind the axes' names
  property->SetBackgroundOpacity(0.75);
  if (centred) property->SetJustificationToCentered();
  property->SetVerticalJustificationToCentered();
  actor->SetPosition(place[0], place[1]);
  renderer->AddViewProp(actor);
}

/// A rectangle, in pixels, with one colour at its lower and one at its upper edge.
void add_patch(vtkRenderer* renderer, const Eigen::Vector2d& low, const Eigen::Vector2d& high, const Colour& lower,
               const Colour& upper) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  points->InsertNextPoint(low[0], low[1], 0);
  points->InsertNextPoint(high[0], low[1], 0);
  points->InsertNextPoint(high[0], high[1], 0);
  points->InsertNextPoint(low[0], high[1], 0);
  for (const Colour* colour : {&lower, &lower, &upper, &upper}) colours->InsertNextTypedTuple(colour->data());
  cells->InsertNextCell({0, 1, 2, 3});
  vtkNew<vtkPolyData> patch;
  patch->SetPoints(points);
  patch->SetPolys(cells);
  patch->GetPointData()->SetScalars(colours);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(patch);
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  renderer->AddViewProp(actor);
}

void add_bar(vtkRenderer* renderer, const ColourBar& bar, const PictureSize& size) {
  const double left = 0.855 * size.width, right = 0.88 * size.width, low = 0.2 * size.height, high = 0.8 * size.height;
  const double text = 0.024 * size.height;
  constexpr int patches = 64;
  const auto height_of = [&](double fraction) { return low + fraction * (high - low); };
  for (int i = 0; i < patches; ++i) {
    const double from = static_cast<double>(i) / patches, to = static_cast<double>(i + 1) / patches;
    add_patch(renderer, {left, height_of(from)}, {right, height_of(to)}, scale_colour(from), scale_colour(to));
  }
  constexpr Colour black{0, 0, 0};
  const double tick = 0.006 * size.width, half_line = 0.0008 * size.height;
  for (const double value : round_ticks(bar.range, 6)) {
    const double y = height_of((value - bar.range.first) / (bar.range.second - bar.range.first));
    add_patch(renderer, {right, y - half_line}, {right + tick, y + half_line}, black, black);
    add_text(renderer, fmt::format("{:.6g}", value), {right + 1.6 * tick, y}, text, false);
  }
  const auto ends = bar.end_texts();
  for (const auto& [end, y] : {std::pair{ends[0], low - 0.9 * text}, {ends[1], high + 0.9 * text}})
    if (!end.empty()) add_text(renderer, end, {0.5 * (left + right), y}, text, true);
  add_text(renderer, bar.label, {0.968 * size.width, 0.5 * size.height}, text, true, 90);
}

/// A line of the key in the middle of the picture: patches of colour, each beside what it means.
void add_key_line(vtkRenderer* renderer, const std::vector<KeyEntry>& line, double y, const Heading& heading,
                  const PictureSize& size) {
  const double height = heading.note_height;
  double width = -height, x = 0.5 * size.width;
  for (const KeyEntry& entry : line) width += entry_width(entry, height) + height;
  x -= 0.5 * width;
  for (const KeyEntry& entry : line) {
    add_patch(renderer, {x, y - 0.25 * height}, {x + 1.5 * height, y + 0.25 * height}, entry.colour, entry.colour);
    add_text(renderer, entry.text, {x + 2 * height, y}, height, false);
    x += entry_width(entry, height) + height;
  }
}

void add_heading(vtkRenderer* renderer, const Heading& heading, const PictureSize& size) {
  const double middle = 0.5 * size.width;
  double y = 0.99 * size.height;
  for (const std::string& line : heading.title) {
    add_text(renderer, line, {middle, y - 0.5 * heading.title_pitch()}, heading.title_height, true);
    y -= heading.title_pitch();
  }
  for (const std::string& line : heading.note) {
    add_text(renderer, line, {middle, y - 0.5 * heading.note_pitch()}, heading.note_height, true);
    y -= heading.note_pitch();
  }
  for (const auto& line : heading.key) {
    add_key_line(renderer, line, y - 0.5 * heading.note_pitch(), heading, size);
    y -= heading.note_pitch();
  }
}

void add_texts(vtkRenderer* renderer, const PictureScene& scene, const ViewFrame& view) {
  const PictureSize& size = view.size;
  add_heading(renderer, heading_of(scene, size), size);
  const auto places = axis_names_places(view, {scene.box_low, scene.box_high}, scene.triangles);
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (places[axis]) add_text(renderer, std::string(1, "xyz"[axis]), *places[axis], 0.024 * size.height, true);
  if (scene.bar) add_bar(renderer, *scene.bar, size);
}

vtkNew<vtkImageData> drawn(vtkRenderWindow* window, vtkRenderer* renderer) {
  window->AddRenderer(renderer);
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(window);
  grab->ReadFrontBufferOff();
  grab->Update();
  window->RemoveRenderer(renderer);
  vtkNew<vtkImageData> image;
  image->DeepCopy(grab->GetOutput());
  return image;
}

/// The picture with colours, lights, text, and the shade that close grains cast on each other (screen-space ambient
/// occlusion).
vtkNew<vtkImageData> draw_colours(vtkRenderWindow* window, const PictureScene& scene, const ViewFrame& view,
                                  const ShownBox& shown) {
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  const double length = (scene.box_high - scene.box_low).minCoeff();
  renderer->AddActor(
      actor_of(mesh_of(scene.triangles, [&](std::size_t t, std::size_t c) { return scene.colours[t][c]; }), true));
  renderer->AddActor(box_edges({scene.box_low, scene.box_high}, 0.75 * view.pixel * supersampling));
  for (const RodKind kind : rod_kinds) renderer->AddActor(rods_of(scene.rods, kind));
  set_camera(renderer, view, shown);
  set_lights(renderer);
  add_texts(renderer, scene, view);
  vtkNew<vtkRenderStepsPass> steps;
  vtkNew<vtkSSAOPass> shade;
  shade->SetRadius(0.06 * length);
  shade->SetBias(0.002 * length);
  shade->SetKernelSize(48);
  shade->BlurOn();
  shade->SetDelegatePass(steps);
  renderer->SetPass(shade);
  return drawn(window, renderer);
}

/// The same view with a separate colour for each face of each grain.
vtkNew<vtkImageData> draw_keys(vtkRenderWindow* window, const PictureScene& scene, const ViewFrame& view,
                               const ShownBox& shown) {
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0, 0, 0);
  const vtkNew<vtkActor> faces = actor_of(
      mesh_of(scene.triangles, [&](std::size_t t, std::size_t) { return outline_key(scene.triangles[t]); }), false);
  faces->GetProperty()->SetAmbient(0); // ambient and diffuse shares add up: above 1, high keys would all become 255
  faces->GetProperty()->SetDiffuse(1);
  renderer->AddActor(faces);
  for (const RodKind kind : rod_kinds) {
    vtkNew<vtkActor> rods = rods_of(scene.rods, kind);
    rods->GetProperty()->SetLighting(false);
    renderer->AddActor(rods);
  }
  set_camera(renderer, view, shown);
  return drawn(window, renderer);
}

/// Darkens the pixels at which the key changes: lines of two pixels.
void add_outlines(vtkImageData* image, vtkImageData* keys) {
  int size[3];
  image->GetDimensions(size);
  const auto key_of = [&](int x, int y) {
    const auto* key = static_cast<const std::uint8_t*>(keys->GetScalarPointer(x, y, 0));
    return key[0] | key[1] << 8 | key[2] << 16;
  };
  for (int y = 1; y + 1 < size[1]; ++y)
    for (int x = 1; x + 1 < size[0]; ++x) {
      const int here = key_of(x, y);
      if (here == key_of(x + 1, y) && here == key_of(x, y + 1) && here == key_of(x - 1, y) && here == key_of(x, y - 1))
        continue;
      auto* pixel = static_cast<std::uint8_t*>(image->GetScalarPointer(x, y, 0));
      for (int c = 0; c < 3; ++c) pixel[c] = static_cast<std::uint8_t>(pixel[c] / 4);
    }
}

/// Means over squares of pixels.
vtkNew<vtkImageData> reduced(vtkImageData* large, const PictureSize& size) {
  vtkNew<vtkImageData> image;
  image->SetDimensions(size.width, size.height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      for (int c = 0; c < 3; ++c) {
        int sum = 0;
        for (int i = 0; i < supersampling * supersampling; ++i)
          sum += static_cast<const std::uint8_t*>(large->GetScalarPointer(supersampling * x + i % supersampling,
                                                                          supersampling * y + i / supersampling, 0))[c];
        static_cast<std::uint8_t*>(image->GetScalarPointer(x, y, 0))[c] =
            static_cast<std::uint8_t>(sum / (supersampling * supersampling));
      }
  return image;
}

void write_png(const std::string& path, vtkImageData* image) {
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->WriteToMemoryOn();
  writer->SetCompressionLevel(9);
  writer->Write();
  const vtkUnsignedCharArray* bytes = writer->GetResult();
  write_file(path, {reinterpret_cast<const char*>(const_cast<vtkUnsignedCharArray*>(bytes)->GetPointer(0)),
                    static_cast<std::size_t>(bytes->GetNumberOfValues())});
}

} // namespace

void draw_scene(const std::string& path, const PictureScene& scene, const ShownBox& shown, const PictureSize& size) {
  const PictureSize large{supersampling * size.width, supersampling * size.height};
  const ViewFrame view =
      frame_view(shown, scene.camera, large, {heading_of(scene, large).share(large), scene.bar.has_value()});
  vtkNew<OffscreenWindow> window;
  window->SetSize(large.width, large.height);
  vtkNew<vtkImageData> image = draw_colours(window, scene, view, shown);
  add_outlines(image, draw_keys(window, scene, view, shown));
  write_png(path, reduced(image, size));
}

} // namespace mpfem
