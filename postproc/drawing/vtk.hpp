#pragma once
// Snapshots as VTK unstructured grids, and their tools as surfaces, for ParaView.

#include <string>
#include <vector>

#include "postproc/run_data/snapshot.hpp"

namespace mpfem {

/// A .vtu file: XML with the arrays appended as raw bytes (little endian, sizes as UInt64).
std::string vtu_text(const Snapshot& snapshot);

/// A .vtp file in the same encoding with the surfaces of the tools that are in place, possibly none. The number of a
/// tool is its index in `names`, all tools of the run.
std::string tools_vtp_text(const Snapshot& snapshot, const std::vector<std::string>& names);

/// A .vtp file with a point for each grain: number, volume, and volume-weighted means of the tets' fields.
std::string grains_vtp_text(const Snapshot& snapshot);

/// A .vtp file with a line for each pair of grains in contact or bonded: both grains, force of the second on the first
/// (N), area (mm^2); with bonds their area, damage and energies.
std::string contacts_vtp_text(const schema::FileReader& file, const Snapshot& snapshot);

/// A file of a series.
struct Frame {
  std::string file;
  double time; ///< s
};
/// A .pvd file that lists files over time.
std::string pvd_text(const std::vector<Frame>& frames);

/// Writes FOLDER/NNNN.vtu, NNNN-grains.vtp and NNNN-contacts.vtp for every snapshot of a run, run.pvd, grains.pvd and
/// contacts.pvd over time, and where the run has tools NNNN-tools.vtp and tools.pvd; makes the folder. Returns the
/// files' names. Throws InputError for a run without snapshots, StorageError.
std::vector<std::string> write_run_as_vtk(const schema::FileReader& file, const std::string& folder, bool quiet);

} // namespace mpfem
