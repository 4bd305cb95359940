#pragma once
// Verdicts of several figures, and of several meshes, as Markdown.

#include <string>
#include <vector>

namespace mpfem {

/// A mesh and the folder of its results, in which each figure has a folder with verdict.json.
struct MeshVerdicts {
  std::string mesh, folder;
};

/// A heading and a table for each figure of one mesh. The column of the reference is "paper" for figNN, else
/// "expected". Throws InputError where a verdict.json is not a list of statements.
std::string verdicts_of_mesh(const MeshVerdicts& mesh);

/// How many statements of each figNN agree, differ or could not be judged, mesh by mesh, then all statements with what
/// each mesh found. Throws InputError.
std::string verdicts_of_meshes(const std::vector<MeshVerdicts>& meshes);

} // namespace mpfem
