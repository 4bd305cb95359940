#include "postproc/figure/other_studies.hpp"

#include <filesystem>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "common/text_input.hpp"

namespace mpfem {

namespace {

namespace filesystem = std::filesystem;

/// The study in a record study.path (studies/rules.mk); empty if it cannot be read, or is no file any more.
std::string recorded_study(const filesystem::path& record) {
  constexpr std::size_t most_bytes = 1U << 20U;
  std::error_code error;
  if (!filesystem::is_regular_file(record, error)) return {};
  try {
    std::string study = read_text_file(record.string(), most_bytes);
    study.erase(study.find_last_not_of('\n') + 1);
    return filesystem::is_regular_file(study, error) ? study : std::string();
  } catch (const std::runtime_error&) {
    return {};
  }
}

/// The files of the other studies with results in a folder.
std::vector<std::string> other_studies(const std::string& results, const std::string& own) {
  std::vector<std::string> studies;
  std::error_code error; // the folder does not exist before the first result
  for (const auto& entry : filesystem::directory_iterator(results, error)) {
    const std::string study = recorded_study(entry.path() / "study.path");
    if (!study.empty() && !filesystem::equivalent(study, own, error)) studies.push_back(study);
  }
  return studies;
}

/// Runs of a study, its scenarios named by their true paths. None for a study that cannot be read any more; make
/// reports that when it makes this study.
std::optional<RunGraph> runs_of_study(const std::string& path, const DependsRequest& request) {
  DependsRequest quiet = request;
  quiet.note = {};
  try {
    return runs_of(read_figure(filesystem::canonical(path).string(), request.programmes), quiet);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

} // namespace

void refuse_runs_of_other_studies(const Figure& figure, const DependsRequest& request) {
  const auto own = runs_of_study(figure.path, request);
  if (!own) return; // make_rules() says why
  for (const std::string& path : other_studies(request.results.path, figure.path)) {
    const auto others = runs_of_study(path, request);
    if (!others) continue;
    for (const auto& [folder, run] : *own) {
      const auto found = others->find(folder);
      // Studies with powders of their own have different packings.
      if (run.is_packing || found == others->end() || (same_run(run, found->second) && figure.powder.empty())) continue;
      throw InputError(
          fmt::format("{}: folder: found '{}', where {} has another run, allowed: a folder of its own, or make in "
                      "another folder; the two would replace each other",
                      one_line(figure.path), folder, one_line(path)));
    }
  }
}

} // namespace mpfem
