#include "postproc/figure/other_studies.hpp"

#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "common/text_input.hpp"

namespace mpfem {

namespace {

namespace filesystem = std::filesystem;

/// The files of the other studies with results in a folder: each result has its study in study.path (studies/rules.mk).
std::vector<std::string> other_studies(const std::string& results, const std::string& own) {
  constexpr std::size_t most_bytes = 1U << 16U;
  std::vector<std::string> studies;
  std::error_code error; // the folder does not exist before the first result
  for (const auto& entry : filesystem::directory_iterator(results, error)) {
    const filesystem::path record = entry.path() / "study.path";
    if (!filesystem::is_regular_file(record, error)) continue;
    std::string study = read_text_file(record.string(), most_bytes);
    study.erase(study.find_last_not_of('\n') + 1);
    if (!filesystem::is_regular_file(study, error) || filesystem::equivalent(study, own, error)) continue;
    // As make would be told of it: names of scenarios begin with that of its folder.
    studies.push_back(filesystem::path(own).is_absolute() ? study : filesystem::relative(study).string());
  }
  return studies;
}

/// None for a study that cannot be read any more; make will say so when it is asked for that study.
std::optional<RunGraph> runs_of_other(const std::string& path, const DependsRequest& request) {
  DependsRequest of_other = request;
  of_other.note = {};
  try {
    return runs_of(read_figure(path, request.programmes), of_other);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

} // namespace

void refuse_runs_of_other_studies(const Figure& figure, const DependsRequest& request) {
  const RunGraph own = runs_of(figure, request);
  for (const std::string& path : other_studies(request.results.path, figure.path)) {
    const auto others = runs_of_other(path, request);
    if (!others) continue;
    for (const auto& [folder, run] : own) {
      const auto found = others->find(folder);
      // Studies with powders of their own have different packings.
      if (run.is_packing || found == others->end() || (same_run(run, found->second) && figure.powder.empty())) continue;
      throw InputError(
          fmt::format("{}: folder: found '{}', where {} has another run, allowed: a folder of its own; the "
                      "two would replace each other",
                      one_line(figure.path), folder, one_line(path)));
    }
  }
}

} // namespace mpfem
