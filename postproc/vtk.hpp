#pragma once
// Snapshots as VTK unstructured grids, for ParaView.

#include <string>
#include <vector>

#include "postproc/snapshot.hpp"

namespace mpfem {

/// A .vtu file: XML with the arrays appended as raw bytes (little endian, sizes as UInt64).
std::string vtu_text(const Snapshot& snapshot);

/// A .pvd file that lists .vtu files over time.
struct Frame {
  std::string file;
  double time; ///< s
};
std::string pvd_text(const std::vector<Frame>& frames);

/// Writes FOLDER/NNNN.vtu for every snapshot of a run and FOLDER/run.pvd; makes the folder. Returns the files.
std::vector<std::string> write_run_as_vtk(const schema::FileReader& file, const std::string& folder, bool quiet);

} // namespace mpfem
