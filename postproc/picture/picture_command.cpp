#include "postproc/picture/picture_command.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "postproc/commands/command.hpp"
#include "postproc/picture/draw_scene.hpp"

namespace mpfem {

namespace {

/// The file that -o names, or run.png for run.h5 without it. Throws InputError rather than overwrite an existing
/// run.png.
std::string picture_path(const std::string& output, const std::string& input) {
  if (!output.empty()) return output;
  const std::string path = std::filesystem::path(input).replace_extension(".png").string();
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored))
    throw InputError(fmt::format("{}: already exists, allowed: -o with the picture to write", one_line(path)));
  check_output_path("--output", path, OutputKind::binary);
  try_output(path);
  return path;
}

PictureSize size_of(const std::string& text) {
  PictureSize size;
  char more = 0;
  const int numbers = std::sscanf(text.c_str(), "%dx%d%c", &size.width, &size.height, &more);
  const auto fits = [](int pixels) { return pixels >= 200 && pixels <= 4000; };
  if (numbers != 2 || !fits(size.width) || !fits(size.height))
    throw InputError(fmt::format("--size: found '{}', allowed: WIDTHxHEIGHT, each 200 … 4000 pixels", one_line(text)));
  return size;
}

class PictureCommand : public StateCommand {
public:
  explicit PictureCommand(CLI::App& app)
      : StateCommand(
            app, "picture",
            "Draw a snapshot in three dimensions, cut open.\n"
            "Example: postproc picture run.h5 -o run.png\n"
            "Example: postproc picture run.h5 --snapshot 3 --color plastic-strain --cut z --cut-at 0.6 -o z.png\n"
            "Example: postproc picture run.h5 --frames film\n"
            "Stresses and strains are averaged around nodes; postproc section shows the value of each tetrahedron.",
            "PNG file to write (default: RUN.png next to RUN.h5)", png_file) {
    add_snapshot(options(), snapshot_);
    options().add_option("--frames", frames_, "Draw every snapshot as FOLDER/NNNN.png, all with the same scales");
    add_choices();
    add_number(options(), "--cut-at", request_.cut_at, Range::between(0, 1), "",
               "Position of the cut, as a fraction of the box")
        ->capture_default_str();
    add_numbers(options(), "--camera", camera_, 2, Range::between(-360, 360), "degrees",
                "Azimuth,elevation of the camera: from the x axis towards y, and above the x-y plane")
        ->capture_default_str();
    add_numbers(options(), "--range", range_, 2, Range::between(-1e12, 1e12), "",
                "low,high of the colour scale (default: from the data; for damage 0,1)");
    options().add_option("--size", size_, "WIDTHxHEIGHT in pixels")->capture_default_str();
    options().add_option("--title", request_.title, "Title (default: relative density and mean stress)");
    options().add_flag("--bonds", request_.bonds,
                       "Draw bonds from grain to grain in the part that is cut away: blue, yellow where damage "
                       "exceeds one half, orange where broken; thickness grows with the intact area");
    options().add_flag("--contacts", request_.contacts,
                       "Draw contacts from grain to grain in the part that is cut away, grey, with a thickness "
                       "proportional to the square root of their force");
    options().add_flag("!--without-tools", request_.tools, "Leave out rigid tools");
  }

private:
  /// Names as `postproc section` spells them are accepted, too.
  static std::string hyphens_for_underscores(std::string name) {
    std::replace(name.begin(), name.end(), '_', '-');
    return name;
  }

  void add_choices() {
    options()
        .add_option("--color", request_.colour,
                    "What colours mean (for --packing: grain; with --bonds: plain, which is grey)")
        ->check(one_of(colour_names()))
        ->transform(hyphens_for_underscores)
        ->capture_default_str();
    options()
        .add_option("--cut", request_.cut,
                    "What is cut away: the octant towards the camera, all on the camera's side of a plane normal to "
                    "x, y or z, or none")
        ->check(one_of(cut_names()))
        ->capture_default_str();
  }

  SceneRequest request() const {
    SceneRequest request = request_;
    request.camera = {camera_[0], camera_[1]};
    if (!given("--color") && of_packing())
      request.colour = "grain";
    else if (!given("--color") && request.bonds)
      request.colour = "plain"; // the rods have colours of their own
    for (const auto& [rods, option] : {std::pair{request.bonds, "--bonds"}, {request.contacts, "--contacts"}})
      if (rods && (of_packing() || request.cut == "none"))
        throw InputError(fmt::format("{}: found {}, allowed: with a run, and a cut that shows them", option,
                                     of_packing() ? "--packing" : "--cut none"));
    if (request.cut == "none") refuse_given({"--cut-at"}, "with --cut none", "with a cut");
    if (request.colour == "grain" || request.colour == "plain")
      refuse_given({"--range"}, fmt::format("with the colours '{}', which have no scale", request.colour),
                   "with --color of a field");
    if (range_.empty()) return request;
    if (!(range_[1] > range_[0]))
      throw InputError(fmt::format("--range: found '{},{}', allowed: low,high with low < high", range_[0], range_[1]));
    request.range = {range_[0], range_[1]};
    return request;
  }

  PictureScene scene_of(const Snapshot& state, const SceneRequest& request) const {
    PictureScene scene = make_scene(state, request);
    if (!request.bonds && !request.contacts) return scene;
    const schema::FileReader file(path_of_run(), schema::FileKind::run);
    const CutAway away = cut_away(state, request);
    if (request.bonds) {
      scene.rods = bond_rods(file, state, away);
      scene.key = bond_key();
    }
    if (request.contacts) {
      const std::vector<PairRod> contacts = contact_rods(file, state, away);
      scene.rods.insert(scene.rods.end(), contacts.begin(), contacts.end());
      const std::vector<KeyEntry> key = contact_key();
      scene.key.insert(scene.key.end(), key.begin(), key.end());
    }
    return scene;
  }

  void execute() const override {
    const PictureSize size = size_of(size_);
    if (!frames_.empty()) refuse_given({"--snapshot"}, "together with --frames, which draws all", "one of them");
    if (of_packing()) refuse_given({"--snapshot"}, "together with --packing", "with a run");
    if (!frames_.empty()) return draw_frames(request(), size);
    require_run_or_packing();
    const std::string path = picture_path(output(), of_packing() ? path_of_packing() : path_of_run());
    const Snapshot state = read_state(snapshot_);
    const PictureScene scene = scene_of(state, request());
    draw_scene(path, scene, bounds_of(scene), size);
    if (!quiet()) fmt::print("{}\n", path);
  }

  /// All frames share one colour scale, the widest of all snapshots, and one length scale that shows every snapshot.
  void draw_frames(SceneRequest request, const PictureSize& size) const {
    if (of_packing() || !output().empty())
      throw InputError(fmt::format("--frames: found {}, allowed: with a run only", of_packing() ? "--packing" : "-o"));
    require_run_or_packing();
    const int count = static_cast<int>(schema::FileReader(path_of_run(), schema::FileKind::run).snapshots().size());
    if (count == 0) throw InputError(fmt::format("{}: the run has no snapshots", one_line(path_of_run())));
    for (int number = 0; number < count; ++number) refuse_overwriting("--frames", frame_path(number), path_of_run());
    make_folder(frames_);
    try_output(frame_path(0));
    std::optional<ShownBox> shown;
    std::pair<double, double> range{0, 0};
    for (int number = 0; number < count; ++number) {
      const PictureScene scene = make_scene(read_state(number), request);
      const ShownBox bounds = bounds_of(scene);
      shown = shown ? united(*shown, bounds) : bounds;
      if (scene.bar)
        range = {std::min(range.first, scene.bar->range.first), std::max(range.second, scene.bar->range.second)};
    }
    if (!request.range && range.second > range.first) request.range = range;
    for (int number = 0; number < count; ++number) {
      const std::string path = frame_path(number);
      draw_scene(path, scene_of(read_state(number), request), *shown, size);
      if (!quiet()) fmt::print("{}\n", path);
    }
  }

  std::string frame_path(int number) const { return fmt::format("{}/{:04}.png", frames_, number); }

  static void make_folder(const std::string& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (error || !std::filesystem::is_directory(path))
      throw InputError(fmt::format("--frames {}: cannot be made, allowed: a folder, new or not", one_line(path)));
  }

  int snapshot_ = -1;
  std::string frames_, size_ = "1200x1000";
  std::vector<double> camera_{-55, 25}, range_;
  SceneRequest request_; ///< without camera and range, which are checked first
};

} // namespace

std::unique_ptr<Command> picture_command(CLI::App& app) {
  return std::make_unique<PictureCommand>(app);
}

} // namespace mpfem
