// The files of postproc vtk, opened by VTK's own readers, as ParaView does. Built where VTK is.

#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUtilities.h>

#include "bonded_run.hpp"
#include "postproc/drawing/vtk.hpp"
#include "tests/support/folder.hpp"
#include "tool_run.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

struct Step {
  double time; ///< s
  std::string file;
};

/// What a .pvd file lists.
std::vector<Step> steps_of(const std::string& path) {
  const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(path.c_str()));
  REQUIRE(root);
  vtkXMLDataElement* collection = root->FindNestedElementWithName("Collection");
  REQUIRE(collection);
  std::vector<Step> steps;
  for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* entry = collection->GetNestedElement(i);
    steps.push_back({std::stod(entry->GetAttribute("timestep")), entry->GetAttribute("file")});
  }
  return steps;
}

/// Opens a file with one of VTK's readers, which must not report an error.
template <class Reader>
vtkSmartPointer<Reader> opened(const std::string& path) {
  auto reader = vtkSmartPointer<Reader>::New();
  REQUIRE(reader->CanReadFile(path.c_str()) == 1);
  reader->SetFileName(path.c_str());
  reader->Update();
  REQUIRE(reader->GetErrorCode() == 0);
  return reader;
}

/// At 2 and at 5 microseconds.
RunContents two_snapshots() {
  RunContents run = die_run();
  run.snapshots = {"0000", "0001"};
  run.numbers["/snapshots/0001/time"] = {5e-6};
  return run;
}

void write_series(const Folder& folder, const RunContents& run) {
  write_run(folder / "run.h5", run);
  write_run_as_vtk({folder / "run.h5", schema::FileKind::run}, folder / "vtk", true);
}

} // namespace

TEST_CASE("VTK's readers find every time of a series, with all points, cells and arrays") {
  const Folder folder;
  write_series(folder, two_snapshots());
  const std::vector<Step> steps = steps_of(folder / "vtk/run.pvd");
  REQUIRE(steps.size() == 2);
  CHECK(steps[0].time == 2e-6);
  CHECK(steps[1].time == 5e-6);
  for (const Step& step : steps) {
    const auto reader = opened<vtkXMLUnstructuredGridReader>(folder / ("vtk/" + step.file));
    vtkUnstructuredGrid* grid = reader->GetOutput();
    CHECK(grid->GetNumberOfPoints() == 27); // of a cube of 2 x 2 x 2 blocks
    REQUIRE(grid->GetNumberOfCells() == 48);
    CHECK(grid->GetCellType(17) == VTK_TETRA);
    CHECK(grid->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0) == step.time);
    CHECK(grid->GetFieldData()->GetArray("relative_density")->GetComponent(0, 0) == 0.8);
    vtkCellData* cells = grid->GetCellData();
    for (const char* name : {"von_mises [MPa]", "pressure [MPa]", "plastic_strain", "grain"}) {
      INFO(name);
      REQUIRE(cells->GetArray(name) != nullptr);
      CHECK(cells->GetArray(name)->GetNumberOfTuples() == 48);
    }
    CHECK(cells->GetArray("von_mises [MPa]")->GetComponent(7, 0) == 7);
    CHECK(cells->GetArray("grain")->GetComponent(23, 0) == 0); // per grain: tets of one grain have its number
    CHECK(cells->GetArray("grain")->GetComponent(24, 0) == 1);
    vtkPointData* points = grid->GetPointData();
    REQUIRE(points->GetArray("velocity [mm/s]") != nullptr);
    CHECK(points->GetArray("velocity [mm/s]")->GetNumberOfComponents() == 3);
    REQUIRE(points->GetArray("contact_pressure [MPa]") != nullptr); // per contact, at surface nodes
    CHECK(points->GetArray("contact_pressure [MPa]")->GetNumberOfTuples() == 27);
    double bounds[6];
    grid->GetBounds(bounds);
    for (int k = 0; k < 6; ++k) CHECK(bounds[k] == (k % 2 == 0 ? -1 : 1));
  }
}

TEST_CASE("VTK's reader finds the tools where they stand, by number, and none that are withdrawn") {
  const Folder folder;
  RunContents run = die_run();
  write_series(folder, run);
  const std::vector<Step> steps = steps_of(folder / "vtk/tools.pvd");
  REQUIRE(steps.size() == 1);
  const auto reader = opened<vtkXMLPolyDataReader>(folder / ("vtk/" + steps[0].file));
  vtkPolyData* surface = reader->GetOutput();
  CHECK(surface->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0) == 2e-6);
  REQUIRE(surface->GetNumberOfPolys() > 1000);
  CHECK(surface->GetNumberOfPoints() == 3 * surface->GetNumberOfPolys());
  CHECK(surface->GetPointData()->GetNormals() != nullptr);
  vtkDataArray* tool = surface->GetCellData()->GetArray("tool");
  REQUIRE(tool != nullptr);
  // Largest z of each tool: die 1.8; lower punch, whose face it is, -1.4; and the lowest of the upper punch 1.5.
  double highest[4] = {-9, -9, -9, -9}, lowest[4] = {9, 9, 9, 9};
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell) {
    const auto number = static_cast<std::size_t>(tool->GetComponent(cell, 0));
    REQUIRE(number < 4);
    double bounds[6];
    surface->GetCellBounds(cell, bounds);
    lowest[number] = std::min(lowest[number], bounds[4]);
    highest[number] = std::max(highest[number], bounds[5]);
  }
  CHECK(std::abs(highest[0] - 1.8) < 1e-6);
  CHECK(std::abs(lowest[0] + 1.5) < 1e-6);
  CHECK(std::abs(highest[1] + 1.4) < 1e-6);
  CHECK(highest[2] == -9); // the plate is away
  CHECK(std::abs(lowest[3] - 1.5) < 1e-6);
  run.extents["*tools"] = 0;
  run.texts["/snapshots/*/tool_name"] = {};
  run.numbers["/snapshots/*/tool_displacement"] = {};
  write_series(folder, run);
  CHECK(opened<vtkXMLPolyDataReader>(folder / ("vtk/" + steps[0].file))->GetOutput()->GetNumberOfPoints() == 0);
}

TEST_CASE("VTK's reader finds a point for each grain, with its volume and the means of its fields") {
  const Folder folder;
  write_series(folder, two_snapshots());
  const std::vector<Step> steps = steps_of(folder / "vtk/grains.pvd");
  REQUIRE(steps.size() == 2);
  CHECK(steps[1].time == 5e-6);
  const auto reader = opened<vtkXMLPolyDataReader>(folder / ("vtk/" + steps[1].file));
  vtkPolyData* grains = reader->GetOutput();
  REQUIRE(grains->GetNumberOfVerts() == 2);
  vtkCellData* cells = grains->GetCellData();
  CHECK(cells->GetArray("grain")->GetComponent(1, 0) == 1);
  // Tets of equal volume that are numbered from 0, half of them in each grain.
  for (int g = 0; g < 2; ++g) {
    CHECK(std::abs(cells->GetArray("volume [mm^3]")->GetComponent(g, 0) - 4) < 1e-6);
    CHECK(std::abs(cells->GetArray("von_mises [MPa]")->GetComponent(g, 0) - (g == 0 ? 11.5 : 35.5)) < 1e-5);
  }
}

TEST_CASE("VTK's reader finds a line for each pair of grains, with its force, area and bonds") {
  const Folder folder;
  write_series(folder, bonded_run());
  const std::vector<Step> steps = steps_of(folder / "vtk/contacts.pvd");
  REQUIRE(steps.size() == 1);
  const auto reader = opened<vtkXMLPolyDataReader>(folder / ("vtk/" + steps[0].file));
  vtkPolyData* contacts = reader->GetOutput();
  REQUIRE(contacts->GetNumberOfLines() == 2);
  vtkCellData* cells = contacts->GetCellData();
  const auto value = [&](const char* name, vtkIdType pair, int component = 0) {
    INFO(name);
    REQUIRE(cells->GetArray(name) != nullptr);
    return cells->GetArray(name)->GetComponent(pair, component);
  };
  CHECK(value("first_grain", 1) == 0);
  CHECK(value("second_grain", 1) == 2);
  CHECK(value("force [N]", 0, 0) == -10);
  CHECK(value("force [N]", 1, 2) == -1);
  CHECK(value("area [mm^2]", 0) == 4);
  CHECK(value("bonded_area [mm^2]", 0) == 3.5);
  CHECK(value("damage", 0) == 0.5);
  CHECK(value("damage", 1) == -1);
  // From the centre of the first cube to that of the second, which lies next to it along x.
  double ends[2][3];
  for (int e = 0; e < 2; ++e) contacts->GetPoint(contacts->GetCell(0)->GetPointId(e), ends[e]);
  CHECK(std::abs(ends[1][0] - ends[0][0] - 2) < 1e-6);
  CHECK(std::abs(ends[1][2] - ends[0][2]) < 1e-6);
}
