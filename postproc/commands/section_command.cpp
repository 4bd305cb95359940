// section: a plane cut through the grains.

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "postproc/commands/command.hpp"
#include "postproc/commands/commands.hpp"
#include "postproc/drawing/damage_section.hpp"
#include "postproc/drawing/section_picture.hpp"
#include "postproc/files/text_file.hpp"

namespace mpfem {

namespace {

bool is_interval(double low, double high) {
  return high > low && std::isfinite(high - low);
}

class SectionCommand : public StateCommand {
public:
  explicit SectionCommand(CLI::App& app)
      : StateCommand(
            app, "section",
            "Draw a plane section through the grains.\n"
            "Example: postproc section run.h5 --axis z --position 0.5 --relative --field von_mises -o section.png\n"
            "Example: postproc section run.h5 --axis x --field damage -o damage.png --data boundaries.csv",
            "PNG file to write", png_file) {
    add_snapshot(options(), snapshot_);
    add_plane_options();
    add_picture_options();
    add_output("--data", data_,
               "Also write the section's polygons as CSV; for damage the cut boundaries, one row per segment",
               csv_file);
  }

private:
  void add_plane_options() {
    add_axis(options(), axis_, "Axis that the plane is normal to");
    add_number(options(), "--position", position_, any_length, "",
               "Where on the axis, mm, or with --relative as a fraction of the box")
        ->capture_default_str();
    options().add_flag("--relative", relative_, "Take --position as a fraction of the box (0 … 1)");
  }

  /// Names as `postproc picture` spells them are accepted, too.
  static std::string underscores_for_hyphens(std::string name) {
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
  }

  void add_picture_options() {
    options()
        .add_option("--field", picture_.field,
                    "von_mises, pressure, plastic_strain, grain (for --packing: grain) or, for runs with bonds, "
                    "damage: along the cut boundaries")
        ->transform(underscores_for_hyphens)
        ->capture_default_str();
    add_numbers(options(), "--range", range_, 2, Range::between(-1e12, 1e12), "",
                "low,high of the colour scale (default: from the data; for damage 0,1)");
    add_numbers(
        options(), "--view", view_, 4, any_length, "mm",
        "Part of the plane to show: low,high of its first and of its second coordinate (default: the box, or what "
        "is drawn of tools around it)");
    add_drawing(options(), picture_, "", "the relative density", "the elements");
    options().add_flag("!--without-tools", picture_.tools, "Leave out rigid tools");
  }

  /// Without --position the plane cuts the box in half.
  CutPlane plane_in(const Snapshot& state) const {
    const int number = axis_number(axis_);
    const auto axis = static_cast<std::size_t>(number);
    const double low = state.box_low[axis], length = state.box_high[axis] - low;
    return {number, relative_ || !given("--position") ? low + position_ * length : position_};
  }

  std::optional<std::pair<double, double>> range() const {
    if (range_.empty()) return {};
    if (!is_interval(range_[0], range_[1]))
      throw InputError(fmt::format("--range: found '{},{}', allowed: low,high with low < high", range_[0], range_[1]));
    return {{range_[0], range_[1]}};
  }

  std::optional<View> view() const {
    if (view_.empty()) return {};
    if (!is_interval(view_[0], view_[1]) || !is_interval(view_[2], view_[3]))
      throw InputError(
          fmt::format("--view: found '{}', allowed: low,high,low,high with low < high", fmt::join(view_, ",")));
    return View{{view_[0], view_[2]}, {view_[1], view_[3]}};
  }

  void execute() const override {
    if (output().empty() && data_.empty())
      throw InputError("found neither of --output and --data, allowed: one or both (see postproc section --help)");
    if (output().empty())
      refuse_given({"--range", "--view", "--mesh", "--title", "--pixels", "--without-tools"}, "without a picture",
                   "with -o FILE.png");
    if (of_packing()) refuse_given({"--snapshot"}, "together with --packing", "with a run");
    const Snapshot state = read_state(snapshot_);
    PictureRequest request = picture_;
    request.plane = plane_in(state);
    request.range = range();
    request.view = view();
    if (of_packing() && !given("--field")) request.field = "grain";
    if (request.field == "grain")
      refuse_given({"--range"}, "with the field grain, whose colours have no scale", "with another field");
    if (!data_.empty()) {
      const std::vector<SectionPolygon> polygons = cut_grains(state, request.plane);
      write_file(data_, request.field == "damage" ? damage_section_csv(cut_boundaries(state, request.plane))
                                                  : section_csv(state, polygons, request.field));
    }
    if (!output().empty()) write_section_picture(output(), state, request);
  }

  std::string data_;
  int snapshot_ = -1;
  std::string axis_ = "z";
  double position_ = 0.5; ///< mm, or a fraction of the box
  bool relative_ = false;
  std::vector<double> range_, view_;
  PictureRequest picture_; ///< without plane, range and view, which are set in execute()
};

} // namespace

std::unique_ptr<Command> section_command(CLI::App& app) {
  return std::make_unique<SectionCommand>(app);
}

} // namespace mpfem
