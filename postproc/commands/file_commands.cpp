// validate and cost: several files at once.

#include <fmt/format.h>

#include "common/errors.hpp"
#include "postproc/commands/command.hpp"
#include "postproc/commands/commands.hpp"
#include "postproc/files/validate.hpp"
#include "postproc/metrics/summary.hpp"

namespace mpfem {

namespace {

class ValidateCommand : public Command {
public:
  explicit ValidateCommand(CLI::App& app)
      : Command(app, "validate",
                "Check files against the results schema.\nExample: postproc validate run.h5 packing.h5") {
    options().add_option("files", files_, "Files of any kind (HDF5)")->required();
    options().add_flag("--quiet", quiet_, "Print only what is wrong");
  }

private:
  void execute() const override {
    std::size_t bad = 0;
    for (const std::string& path : files_) {
      const Verdict verdict = verdict_on(path);
      if (!verdict.valid || !quiet_) fmt::print("{}", verdict.text);
      bad += !verdict.valid;
    }
    if (bad > 0)
      throw InputError(fmt::format("{} of {} files violate the schema; the lines above say how", bad, files_.size()));
  }

  std::vector<std::string> files_;
  bool quiet_ = false;
};

class CostCommand : public Command {
public:
  explicit CostCommand(CLI::App& app)
      : Command(app, "cost",
                "Total cost of runs as CSV: runs,tet_steps,wall_time_s,core_time_s; a tet-step is one tetrahedron in "
                "one step.\nExample: postproc cost a.h5 b.h5") {
    options().add_option("files", files_, "Run files (HDF5); none: zeros");
  }

private:
  void execute() const override {
    std::vector<Summary> runs;
    for (const std::string& path : files_) runs.push_back(summarise({path, schema::FileKind::run}));
    fmt::print("{}", cost_of_runs(runs));
  }

  std::vector<std::string> files_;
};

} // namespace

std::unique_ptr<Command> validate_command(CLI::App& app) {
  return std::make_unique<ValidateCommand>(app);
}

std::unique_ptr<Command> cost_command(CLI::App& app) {
  return std::make_unique<CostCommand>(app);
}

} // namespace mpfem
