#pragma once
// Verdicts of several figures and meshes as Markdown.

#include <string>
#include <vector>

namespace mpfem {

/// A mesh and the folder of its results; each figure has a folder with verdict.json in it.
struct MeshVerdicts {
  std::string mesh, folder;
};

/// The verdict.json of each figure in a folder of results. Throws InputError where there is no folder.
std::vector<std::string> verdict_files(const std::string& folder);

/// A heading and a table for each figure of one mesh. The column of the reference is "paper" for figNN, otherwise
/// "expected". Throws InputError where a verdict.json is not a list of statements.
std::string verdicts_of_mesh(const MeshVerdicts& mesh);

/// Numbers of statements of each figNN that agree, differ or could not be judged, mesh by mesh, then all statements
/// with the result of each mesh. Throws InputError where a verdict.json is not a list of statements.
std::string verdicts_of_meshes(const std::vector<MeshVerdicts>& meshes);

} // namespace mpfem
