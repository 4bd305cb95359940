#pragma once
// Snapshots as VTK unstructured grids, and their tools as surfaces, for ParaView.

#include <string>
#include <vector>

#include "postproc/snapshot.hpp"

namespace mpfem {

/// A .vtu file: XML with the arrays appended as raw bytes (little endian, sizes as UInt64).
std::string vtu_text(const Snapshot& snapshot);

/// A .vtp file of the same kind with the surfaces of the tools that are in place, maybe none; the number of a tool is
/// its place in `names`, all tools of the run.
std::string tools_vtp_text(const Snapshot& snapshot, const std::vector<std::string>& names);

/// A .pvd file that lists files over time.
struct Frame {
  std::string file;
  double time; ///< s
};
std::string pvd_text(const std::vector<Frame>& frames);

/// Writes FOLDER/NNNN.vtu for every snapshot of a run and FOLDER/run.pvd, and where the run has tools
/// FOLDER/NNNN-tools.vtp and FOLDER/tools.pvd; makes the folder. Returns the files.
std::vector<std::string> write_run_as_vtk(const schema::FileReader& file, const std::string& folder, bool quiet);

} // namespace mpfem
