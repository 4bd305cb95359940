// density-map: solid fraction in a die over radius and height.

#include <filesystem>

#include "postproc/commands/command.hpp"
#include "postproc/commands/commands.hpp"
#include "postproc/drawing/density_map.hpp"
#include "postproc/files/text_file.hpp"
#include "postproc/metrics/round_die.hpp"

namespace mpfem {

namespace {

class DensityMapCommand : public RunCommand {
public:
  explicit DensityMapCommand(CLI::App& app)
      : RunCommand(app, "density-map",
                   "Solid fraction over radius and height of a round die.\n"
                   "Example: postproc density-map run.h5 --snapshot 0 -o density.png --data density.csv\n"
                   "Example: postproc density-map run.h5 --rings 6 --layers 8 -o density.csv",
                   "File to write, .csv or .png (default: CSV on standard output)", csv_or_png_file) {
    add_snapshot(options(), snapshot_);
    add_number(options(), "--rings", rule_.rings, parts, "", "Rings of equal width, from the axis to the wall")
        ->capture_default_str();
    add_number(options(), "--layers", rule_.layers, parts, "", "Layers of equal height between the punches")
        ->capture_default_str();
    add_output("--data", data_, "CSV file to write in addition to a picture", csv_file);
    options().add_option("--title", title_, "Title of the picture (default: the solid fraction of the whole)");
    add_number(options(), "--pixels", pixels_, Range::between(50, 4000), "", "Pixels along the picture's longer side")
        ->capture_default_str();
  }

private:
  static constexpr Range parts = Range::between(1, 100);

  /// A device or a pipe has no ending.
  void check_outputs() const override {
    RunCommand::check_outputs();
    if (std::filesystem::path(output()).has_extension()) refuse_other_endings("--output", output(), {".csv", ".png"});
  }

  void execute() const override {
    if (!output().ends_with(".png")) refuse_given({"--title", "--pixels"}, "without a picture", "with -o FILE.png");
    const schema::FileReader run = open_run();
    refuse_other_than_round_dies(run, true);
    const DensityMap map = density_map(read_snapshot(run, snapshot_), rule_);
    if (!data_.empty()) write_file(data_, density_map_csv(map));
    if (output().ends_with(".png"))
      write_density_picture(output(), map, title_, pixels_);
    else
      deliver(density_map_csv(map));
  }

  DensityMapRule rule_;
  int snapshot_ = -1, pixels_ = 700;
  std::string data_, title_;
};

} // namespace

std::unique_ptr<Command> density_map_command(CLI::App& app) {
  return std::make_unique<DensityMapCommand>(app);
}

} // namespace mpfem
