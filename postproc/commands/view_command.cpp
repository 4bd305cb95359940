// view: a page that shows the grains in three dimensions.

#include <filesystem>

#include "postproc/commands/command.hpp"
#include "postproc/commands/commands.hpp"
#include "postproc/view/view_page.hpp"

namespace mpfem {

namespace {

class ViewCommand : public RunCommand {
public:
  explicit ViewCommand(CLI::App& app)
      : RunCommand(app, "view",
                   "Write one page for a browser: turn, zoom, cut and colour the grains, see bonds and contacts, step "
                   "through snapshots.\n"
                   "Example: postproc view run.h5 -o view.html",
                   "HTML file to write", html_file) {
    output_option()->required();
    add_number(options(), "--most", most_, Range::between(1, 1000), "",
               "Largest number of snapshots, evenly spread over the run")
        ->capture_default_str();
    options().add_option("--title", title_, "Title of the page (default: the name of the run's file)");
  }

private:
  void execute() const override {
    const std::string title = title_.empty() ? std::filesystem::path(path_of_run()).filename().string() : title_;
    deliver(view_page_of_run(open_run(), most_, title));
  }

  int most_ = 8;
  std::string title_;
};

} // namespace

std::unique_ptr<Command> view_command(CLI::App& app) {
  return std::make_unique<ViewCommand>(app);
}

} // namespace mpfem
